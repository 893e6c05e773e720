//! Several classes of samples in one plane (Wei 2010; future work in thesis §3.4.6 and ch. 5).
//!
//! Classes come by falling own radius; those of equal radii are a *group*, and are filled together at equal rates. Each
//! group fills what the samples of the groups before, given samples and its own samples leave it (`group.rs`), each of
//! them a circle of the distance between the two classes (`room.rs`). If the first group is one class, and the domain
//! is worth tiling, it is a set of KDRT.
//!
//! # Why no class can take another sample
//! A group ends when for each of its classes every lattice point lies in a circle. Later groups only add circles.
//!
//! # Parts
//! Each group is made by blocks: a part of a group depends on the groups before in a part that is larger by a margin
//! (`stack.rs`).

mod group;
mod passes;
mod room;
#[allow(unsafe_code)] // Vector instructions.
mod vectors;

use crate::classes::Classes;
use crate::error::Result;
use crate::given::Given;
use crate::job::Job;
use crate::kdrt::around::Around;
use crate::kdrt::base::Base;
use crate::kdrt::options::Options;
use crate::kdrt::stack::Stack;
use crate::kdrt::tiling::Tiling;
use crate::plane::lattice::Lattice;
use crate::points::Points;

pub use group::Group;
use group::Sample;

/// The groups of a plane of several classes on its lattice.
pub fn stack(job: &Job, lattice: &Lattice, options: &Options, classes: &Classes) -> Result<Stack<Group>> {
    let &Options { ref domain, leaf_size, seed, given, .. } = options;
    let groups = classes.groups();
    let base = match groups[0][..] {
        [class] => {
            let (radius, lattice) = (classes.own(class), lattice.with_radius(classes.own(class)));
            let clearances = given.clearances_of_class(class, classes.count());
            let given = Given { positions: given.positions, clearances: clearances.as_deref() };
            let around = || Around::new(domain, &lattice, radius, &given);
            let is_tiled = Tiling::is_worthwhile(&lattice, leaf_size);
            is_tiled.then(|| Base::new(job, lattice.clone(), leaf_size, seed, around().into())).transpose()?
        }
        _ => None,
    };
    let base = base.map(|base| (base, Sample { point: [0; 2], class: groups[0][0] as u32 }));
    let filled = (usize::from(base.is_some())..groups.len())
        .map(|number| Group::new(domain, lattice, classes, number, &given, seed));
    let filled = filled.collect();
    Ok(Stack::new(lattice.clone(), base, filled))
}

/// Puts samples in order.
pub fn ordered(lattice: &Lattice, mut samples: Vec<Sample>) -> Points<2> {
    samples.sort_unstable_by_key(|sample| (sample.class, sample.point[1], sample.point[0]));
    Points {
        positions: samples.iter().map(|sample| lattice.position(sample.point)).collect(),
        classes: samples.iter().map(|sample| sample.class).collect(),
        ..Points::default()
    }
}
