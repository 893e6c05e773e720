//! Points of all kinds are made and relaxed to densities of all kinds: images and functions.

#![no_main]

use std::cell::Cell;
use std::ffi::c_void;

use azulejo_c::dcr::*;
use azulejo_c::density::*;
use azulejo_fuzz::calls::{Arrays, Out, Patience, context, create, report};
use azulejo_fuzz::input::Input;
use azulejo_fuzz::relaxation;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let mut input = Input::new(bytes);
    let patience = Patience::new(if input.one_in(4) { input.below(50) } else { u32::MAX });
    let mut options = relaxation::options(&mut input, &patience);
    if !input.one_in(8) {
        options = momentum(options);
    }
    let points = relaxation::points(&mut input, &options);
    if input.one_in(2) {
        let image = Image::new(&mut input);
        let density =
            azulejo_density { values: image.values.as_ptr(), width: image.width, height: image.height, ..none() };
        relax(&options, &density, &points, image.is_constant());
    } else {
        let guest = Guest::new(&options, &mut input);
        let user = (&raw const guest).cast_mut().cast();
        relax(
            &options,
            &azulejo_density { function: Some(density_at), function_user: user, ..none() },
            &points,
            guest.kind == 7,
        );
    }
});

/// Options for which densities are made: the thesis's settings at their defaults.
fn momentum(options: azulejo_dcr_options) -> azulejo_dcr_options {
    azulejo_dcr_options {
        method: AZULEJO_METHOD_MOMENTUM,
        neighbourhood: 0,
        conflict_radius: 0.95,
        attraction_radius: 1.05,
        step: 0.05,
        decay: 1.0,
        neighbours: 6,
        distribution: 0,
        visits: 0,
        convergence: 0,
        ..options
    }
}

fn none() -> azulejo_density {
    azulejo_density {
        struct_size: size_of::<azulejo_density>() as u32,
        reserved: 0,
        values: std::ptr::null(),
        width: 0,
        height: 0,
        function: None,
        function_user: std::ptr::null_mut(),
    }
}

/// Pixels that are mostly densities.
struct Image {
    values: Vec<f32>,
    width: usize,
    height: usize,
}

impl Image {
    fn new(input: &mut Input) -> Self {
        let (mut width, mut height) = (input.below(9) as usize, input.below(9) as usize);
        if input.one_in(16) {
            (width, height) = (1 + input.below(300) as usize, 1);
        }
        let hostile = input.one_in(8);
        let pixel = |_| if hostile { input.coordinate() } else { f32::from(input.any::<u8>() / 2) };
        // At least one, for a pointer that is not NULL.
        let mut values: Vec<f32> = (0..(width * height).max(1)).map(pixel).collect();
        if input.one_in(4) {
            let first = values[0];
            values.fill(first);
        }
        Self { values, width, height }
    }

    fn is_constant(&self) -> bool {
        self.values.iter().all(|value| value == &self.values[0])
    }
}

/// A function of the caller's, which need not be one.
struct Guest {
    low: [f64; 2],
    scale: [f64; 2],
    factor: f64,
    kind: u32,
    calls: Cell<u32>,
}

impl Guest {
    fn new(options: &azulejo_dcr_options, input: &mut Input) -> Self {
        let (low, high) = (options.domain_min, options.domain_max);
        let scale = std::array::from_fn(|axis| 1.0 / (high[axis] - low[axis]));
        Self { low, scale, factor: input.number(), kind: input.below(8), calls: Cell::new(0) }
    }

    fn at(&self, position: [f64; 2]) -> f64 {
        let [x, y] = std::array::from_fn(|axis| (position[axis] - self.low[axis]) * self.scale[axis]);
        let calls = self.calls.replace(self.calls.get().wrapping_add(1));
        match self.kind {
            0 => x + y,
            1 => (x * self.factor).exp(),
            2 => f64::from(u8::from(x < y)),
            3 => (self.factor * x).sin().abs().powi(30),
            4 => f64::from(calls % 5),
            5 => (x - 0.5).powi(2) * self.factor,
            7 => self.factor,
            _ => f64::from(u8::from((x - 0.5).abs() < 0.01 && (y - 0.5).abs() < 0.01)) * 1e30,
        }
    }
}

unsafe extern "C-unwind" fn density_at(user: *mut c_void, position: *const f64) -> f64 {
    // SAFETY: the density above leads here with these two.
    unsafe { (*user.cast::<Guest>()).at(*position.cast()) }
}

/// Where the density is the same everywhere, the figures are those of sets without one.
fn relax(options: &azulejo_dcr_options, density: &azulejo_density, points: &[[f32; 2]], is_constant: bool) {
    let (xy, count) = (points.as_ptr().cast(), points.len());
    // SAFETY: options and density have the sizes in their `struct_size`, and their arrays too.
    let call = |out: Out<_>| unsafe { azulejo_dcr_scatter(context(), options, density, count, out) };
    let scattered = create(call).map(|points| Arrays::of(&points).positions.as_chunks::<2>().0.to_vec());
    if let Some(scattered) = &scattered {
        assert_eq!(scattered.len(), count);
        relaxation::check(options, scattered);
    }
    let mut report = report(azulejo_dcr_report_init);
    // SAFETY: as above.
    let call = |out: Out<_>| unsafe {
        azulejo_dcr_relax_density(context(), options, density, xy, count, out, &raw mut report)
    };
    let Some(relaxed) = create(call) else { return };
    let (relaxed, _) = Arrays::of(&relaxed).positions.as_chunks::<2>();
    assert_eq!(relaxed.len(), count);
    relaxation::check(options, relaxed);
    assert!(report.iterations <= options.max_iterations && report.motion >= 0.0 && report.rho >= 0.0, "{}", report.rho);
    assert!(report.relative_covering_radius >= 0.0, "{}", report.relative_covering_radius);
    if is_constant {
        // The spacing is that of floats.
        let rho = report.smallest_distance / relaxation::unit(options, count);
        // Coincident points have 0.
        assert!(count < 2 || (report.rho - rho).abs() <= 1e-5 * rho, "{} is not {rho}", report.rho);
        relaxation::check_report(options, relaxed, &azulejo_dcr_report { rho, ..report });
    }
}
