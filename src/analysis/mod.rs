//! Analysis: what a set of samples is like.

pub mod spectrum;
