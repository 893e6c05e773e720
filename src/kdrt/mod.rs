//! KDRT: massive maximal Poisson-disk sets in the plane, by randomized tiling.
//!
//! Source: Wang 2019, *Techniques on Mining Effective Parallelism For High-Performance Blue-Noise Sampling*, chapter 2
//! (Wang and Suda 2017). One small maximal set, the *pattern*, is made; the domain is cut by a random kd-tree
//! (`divide.rs`); into every leaf a random part of the pattern is laid (`clip.rs`); at the seams conflicts are
//! eliminated (`conquer.rs`) and gaps filled (`fill.rs`). Most samples are copies that need no test.
//!
//! The thesis processes the seams sequentially. Here every step is a function of position alone, so that a window of
//! the plane (`tiling.rs`) can be made without the rest; this is how threads share the work, and how any part of a
//! plane can be made alone (`plane.rs`). An order whose prefixes are well spread (`progressive.rs`) and several classes
//! (`classes/`) are layers, each filled around those before (`stack.rs`); a plane that is kept remembers what its windows
//! made of them (`cache.rs`). `count.rs` takes a number of samples instead of a radius; sets that were made separately
//! are merged into one by the same two steps (`merge.rs`, `seams.rs`); any set can be edited afterwards (`editable.rs`,
//! `refill.rs`). Each file states its departures from the thesis.

mod blocks;
mod cache;
mod classes;
mod clip;
mod conquer;
mod count;
mod divide;
mod editable;
mod fill;
mod merge;
mod options;
mod patterns;
mod plane;
mod progressive;
mod refill;
mod region;
mod relative;
mod seams;
mod stack;
#[cfg(feature = "stages")]
#[doc(hidden)]
pub mod stages;
mod tiles;
mod tiling;

pub use crate::order::{DEFAULT_QUOTIENT, QUOTIENTS};
pub use count::{CountOptions, CountReport, sample_count};
pub use editable::EditableSet;
pub use merge::{MergeOptions, MergeReport, Piece, merge};
pub use options::{DEFAULT_LEAF_SIZE, Kind, MIN_LEAF_SIZE, Options, Progressive};
pub use plane::{Plane, sample, sample_window};

pub(crate) use divide::{Leaf, Tree};
pub(crate) use patterns::{Key, Patterns};
