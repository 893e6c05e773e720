//! What the tests against Embree traces are made of: meshes and rays, an oracle, and the files of recorded hits.

pub mod file;
pub mod meshes;
pub mod oracle;
