//! The parts of the tests against Embree traces: meshes and rays, an oracle, and the files of recorded hits.

pub mod file;
pub mod meshes;
pub mod oracle;
