//! The meshes of files that benchmarks take where they are found.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use azulejo::mesh::Mesh;

/// The bunny (`AZULEJO_BENCH_BUNNY`) and the dragon (`AZULEJO_BENCH_DRAGON`, or out/dragon.ply, which the demo fetches).
pub fn loaded() -> impl Iterator<Item = (&'static str, Arc<Mesh>)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let file = |variable: &str, path: &str| std::env::var_os(variable).map_or(root.join(path), PathBuf::from);
    let files = [
        ("bunny", file("AZULEJO_BENCH_BUNNY", "../shared/meshes/bunny.obj")),
        ("dragon", file("AZULEJO_BENCH_DRAGON", "out/dragon.ply")),
    ];
    files.into_iter().filter_map(|(name, path)| Some((name, Arc::new(Mesh::load(path).ok()?))))
}
