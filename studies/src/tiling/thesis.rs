//! The algorithms of thesis chapter 2 as they are printed there, plain and unhurried: Algorithm 1 divides, 2 lays the
//! tiles, 3 and 4 eliminate conflicts and insert circumcentres. All on the unit torus, decided in `f64` from floats.

pub mod conquer;
pub mod divide;
mod grid;
pub mod tiles;
