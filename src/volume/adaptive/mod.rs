//! Adaptive sampling of volumes: maximal Poisson-disk samples of cuboids, and of the inside of meshes, whose radius
//! varies.
//!
//! The rule is that of [meshes](crate::psp::adaptive), thesis §3.4.4. The radius is given by a function of the position with
//! stated bounds, or by values on a grid ([`Radius`]).
//!
//! * *Conflict-free*: two samples are no closer than the mean of their radii, in `f64` from the returned positions and radii:
//!   balls of half the radius around the samples do not overlap. On a torus distances wrap.
//! * *Maximal*: no place is farther from every sample than the mean of the radii of the two. Tolerance: 3.5 float spacings at
//!   the domain's largest coordinate, and the change of the radius over that distance; inside a mesh the voxels at its surface
//!   ([`sample_inside`]).
//! * *Dense*: where the radius changes little from sample to sample there are 0.7336 / radius³ samples in a volume of 1.
//! * *Deterministic*: the samples and their order depend on domain or mesh, radii and seed only.
//!
//! A random kd-tree has blocks of 9 to 18 of their smallest radii, which are filled octave by octave from small radii to large
//! ones (`blocks.rs`, `set.rs`), each around the samples that stand there. A block is filled as in a set of one radius
//! (`fill.rs`): what a ball covers depends on a lower bound of the radius in a voxel (`grid.rs`), which follows from the slope
//! (`field.rs`). The prototype had all radii in one order and took 9 µs a sample where they differ by 16
//! (docs/design/volume.md).

mod blocks;
mod complete;
mod field;
mod fill;
mod grid;
mod ground;
mod options;
mod sample;
mod set;
mod values;

pub use options::{InsideOptions, Options, Radius};
pub use sample::{sample, sample_inside};
