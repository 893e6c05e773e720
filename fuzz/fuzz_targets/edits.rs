//! Sets of the plane are edited in any order: what stands keeps its id and its bytes, what is refused changes nothing, and
//! a refill leaves no gap.

#![no_main]

use std::collections::BTreeMap;
use std::ptr::null;

use azulejo_c::kdrt::{azulejo_kdrt_options, azulejo_kdrt_report_init};
use azulejo_c::plane_edit::*;
use azulejo_c::points::{azulejo_points, azulejo_points_count, azulejo_points_ids};
use azulejo_c::region::{azulejo_region, azulejo_region_init};
use azulejo_fuzz::calls::{Arrays, Out, Owned, Patience, accepted, array, context, create, report};
use azulejo_fuzz::input::Input;
use azulejo_fuzz::plane::{Given, Set, any_options, check_covered, check_set};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let mut input = Input::new(bytes);
    let patience = Patience::new(u32::MAX);
    let Some(options) = any_options(&mut input, &patience) else { return };
    let Some(mut session) = Session::begin(&options, &mut input) else { return };
    for _ in 0..input.below(16) {
        patience.again(if input.one_in(8) { input.below(4) } else { u32::MAX });
        session.edit(&mut input);
        session.check();
    }
    patience.again(u32::MAX);
    session.refill(&mut input);
    session.check();
});

/// The samples of a set by their ids, to the bit.
type Samples = BTreeMap<u64, [u32; 2]>;

/// A set, and what stands in it by all that its calls have said.
struct Session {
    set: Owned<azulejo_plane>,
    options: azulejo_kdrt_options,
    samples: Samples,
    given: BTreeMap<u64, ([f32; 2], f64)>,
    next_given: u64,
    /// The erased samples, to be put back.
    erased: Vec<Owned<azulejo_points>>,
}

impl Session {
    /// Begins with the set of the options, or with no more than a few positions.
    fn begin(options: &azulejo_kdrt_options, input: &mut Input) -> Option<Self> {
        let given = Given::any(options, input);
        let request = given.in_options(options);
        let own = if input.one_in(4) { input.rows::<2>(3) } else { Vec::new() };
        // SAFETY: the options have the size in their `struct_size`, and there are so many positions.
        let make =
            |out: Out<_>| unsafe { azulejo_plane_create(context(), &request, own.as_ptr().cast(), own.len(), out) };
        let set = create(make)?;
        let clearances = (0..given.positions.len()).map(|i| given.clearance(options, i));
        let given: BTreeMap<_, _> = (0..).zip(given.positions.iter().copied().zip(clearances)).collect();
        let mut session = Self {
            set,
            options: *options,
            samples: Samples::new(),
            next_given: given.len() as u64,
            given,
            erased: Vec::new(),
        };
        session.samples = session.points();
        assert!(session.samples.keys().copied().eq(0..session.samples.len() as u64));
        Some(session)
    }

    fn points(&self) -> Samples {
        // SAFETY: the set lives.
        let make = |out: Out<_>| unsafe { azulejo_plane_points(self.set.get(), out) };
        by_id(&create(make).expect("a set has its samples"))
    }

    /// The set has the samples that it should have.
    fn check(&self) {
        assert_eq!(self.points(), self.samples);
    }

    fn edit(&mut self, input: &mut Input) {
        match input.below(6) {
            0 => self.erase(input),
            1 => self.erase_ids(input),
            2 => self.restore(input),
            3 => self.add_given(input),
            4 => self.remove_given(input),
            _ => self.refill(input),
        }
    }

    fn erase(&mut self, input: &mut Input) {
        let mut region: azulejo_region = report(azulejo_region_init);
        for axis in 0..2 {
            let (min, max) = (self.options.domain_min[axis], self.options.domain_max[axis]);
            region.centre[axis] = min + (max - min) * f64::from(input.any::<u8>()) / 255.0;
        }
        region.radius = self.options.radius * input.number();
        if input.one_in(4) {
            region.min[0] = region.centre[0];
            region.max[1] = if input.one_in(8) { input.number() } else { region.centre[1] };
        }
        // SAFETY: the set lives, and the region has the size in its `struct_size`.
        let erased = create(|out| unsafe { azulejo_plane_erase(self.set.get(), &region, out) });
        self.lose(erased);
    }

    fn erase_ids(&mut self, input: &mut Input) {
        let some = input.any::<u64>();
        let mut ids: Vec<u64> = self.samples.keys().copied().filter(|id| some >> (id % 64) & 1 == 1).collect();
        if input.one_in(4) {
            ids.push(input.any());
        }
        // SAFETY: the set lives, and there are so many ids.
        let erased = create(|out| unsafe { azulejo_plane_erase_ids(self.set.get(), ids.as_ptr(), ids.len(), out) });
        if let Some(erased) = &erased {
            assert!(by_id(erased).into_keys().all(|id| ids.contains(&id)));
        }
        self.lose(erased);
    }

    /// Erased samples stood, as they are told.
    fn lose(&mut self, erased: Option<Owned<azulejo_points>>) {
        let Some(erased) = erased else { return };
        for (id, position) in by_id(&erased) {
            assert_eq!(self.samples.remove(&id), Some(position), "{id}");
        }
        self.erased.push(erased);
    }

    fn restore(&mut self, input: &mut Input) {
        if self.erased.is_empty() {
            return;
        }
        let erased = &self.erased[input.below(self.erased.len() as u32) as usize];
        // SAFETY: both live.
        if accepted(unsafe { azulejo_plane_restore(self.set.get(), erased.get()) }) {
            for (id, position) in by_id(erased) {
                assert_eq!(self.samples.insert(id, position), None, "{id}");
            }
        }
    }

    fn add_given(&mut self, input: &mut Input) {
        let added = Given::any(&self.options, input);
        let clearances = added.clearances.as_ref().map_or(null(), |clearances| clearances.as_ptr());
        let (positions, count) = (added.positions.as_ptr().cast(), added.positions.len());
        let mut first = u64::MAX;
        // SAFETY: the set lives, and the arrays have the given length.
        let call = |out: Out<_>| unsafe {
            azulejo_plane_add_given(self.set.get(), positions, clearances, count, &raw mut first, out)
        };
        let Some(erased) = create(call) else { return };
        self.lose(Some(erased));
        assert!(count == 0 || first == self.next_given, "{first}, not {}", self.next_given);
        for (index, &position) in added.positions.iter().enumerate() {
            self.given.insert(self.next_given, (position, added.clearance(&self.options, index)));
            self.next_given += 1;
        }
    }

    fn remove_given(&mut self, input: &mut Input) {
        let some = input.any::<u64>();
        let mut ids: Vec<u64> = self.given.keys().copied().filter(|id| some >> (id % 64) & 1 == 1).collect();
        if input.one_in(4) {
            ids.push(input.any());
        }
        // SAFETY: the set lives, and there are so many ids.
        if accepted(unsafe { azulejo_plane_remove_given(self.set.get(), ids.as_ptr(), ids.len()) }) {
            ids.iter().for_each(|id| assert!(self.given.remove(id).is_some(), "{id}"));
        }
    }

    /// A refill that is not cancelled adds samples with ids of their own, and leaves no gap.
    fn refill(&mut self, input: &mut Input) {
        let (seed, mut figures) = (input.any(), report(azulejo_kdrt_report_init));
        // SAFETY: the set lives, and both are outputs.
        let call = |out: Out<_>| unsafe { azulejo_plane_refill(self.set.get(), seed, out, &raw mut figures) };
        let Some(added) = create(call) else { return };
        assert_eq!(figures.samples, (self.samples.len() + added.read(azulejo_points_count)) as u64);
        for (id, position) in by_id(&added) {
            assert_eq!(self.samples.insert(id, position), None, "{id}");
        }
        let (positions, clearances) = self.given.values().copied().unzip();
        let given = Given { positions, clearances: Some(clearances) };
        let positions = self.samples.values().map(|sample| sample.map(f32::from_bits)).collect();
        let set = Set { positions, ranks: Vec::new() };
        check_set(&self.options, &given, &set);
        check_covered(&self.options, &given, &set);
    }
}

fn by_id(points: &Owned<azulejo_points>) -> Samples {
    let count = points.read(azulejo_points_count);
    // SAFETY: the header says how long the array is.
    let ids = unsafe { array(points.read(azulejo_points_ids), count) };
    let (positions, _) = Arrays::of(points).positions.as_chunks::<2>();
    assert_eq!((ids.len(), positions.len()), (count, count));
    ids.iter().copied().zip(positions.iter().map(|position| position.map(f32::to_bits))).collect()
}
