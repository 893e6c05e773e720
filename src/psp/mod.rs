//! Poisson-disk samples on triangle meshes: by filling, and by progressive sample projection (PSP; thesis chapter 3).
//!
//! [`sample`] fills a mesh: darts fall on all parts that may be uncovered, which are found by subdividing triangles, round
//! after round until none is open (`fill/`).
//!
//! An iteration of projection precedes the fill where that takes less time (`project/rule.rs`), or as many as are asked
//! for ([`project`], [`Psp::advance`]); in sets that need not be maximal they replace it. A planar Poisson-disk pattern is
//! projected onto the mesh, along a direction for each part of it ([`Projectors::Local`]) or along three orthogonal
//! directions through all of it ([`Projectors::Global`]), by a rasteriser or by rays of Embree ([`Engine`]); all hits are
//! candidates; those that conflict with nothing of higher priority become samples. More iterations with other projectors
//! only add samples, and [`Psp::fill`] closes the gaps.
//!
//! * *Conflict-free*: no two samples are closer than the radius, in `f64` from the returned floats, in straight lines
//!   through space (not along the surface).
//! * *Maximal*: no point of the surface, except where the mesh's mask excludes it, is farther from every sample than
//!   the radius and [`TOLERANCE`] float spacings at the largest coordinate of the mesh.
//! * *Around given samples* ([`Options::given`]): new samples keep the clearance of each, and a place within the
//!   clearance of one is covered. Given samples are not compared with each other, nor returned.
//! * *Of several classes* ([`sample_classes`]): the same for every class, around samples of the others.
//! * *Deterministic*: the samples and their order depend on mesh, radius, seed and the sequence of calls, not on the
//!   number of threads. Only with Embree and global projectors the last bits of a hit can differ between machines
//!   whose Embree traces packets of another width.

pub mod adaptive;
mod classes;
mod editable;
mod fill;
mod fragment;
mod given;
mod instances;
mod levels;
mod options;
mod progressive;
mod project;
mod report;
mod set;

pub use crate::levels::Amount;
pub use classes::sample_classes;
pub use editable::{EditableSet, sample_region};
pub use fill::rounds::TOLERANCE;
pub(crate) use fragment::Fragment;
pub use instances::{Instance, sample_instances};
pub use options::{
    ClassOptions, DEFAULT_QUOTIENT, Engine, FlatOptions, InstanceOptions, Options, Priority, ProjectionOptions,
    Projectors, RegionOptions,
};
pub use progressive::{Psp, project, sample};
pub use report::Report;
