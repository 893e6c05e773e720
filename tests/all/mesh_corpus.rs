//! The models that the Open Asset Import Library is tested with, as Debian packs them (assimp-testmodels): files of many
//! programs, odd ones among them. Every OBJ, PLY and STL file is loaded, and what is a mesh is sampled, and the sets are
//! proved maximal.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use azulejo::mesh::Mesh;
use azulejo::psp::{self, ProjectionOptions};
use azulejo::{Context, Error};

use crate::common::surface_oracle as oracle;
use crate::common::tolerance::tolerance;

const MODELS: &str = "/usr/share/assimp/models";

const NO_FACES: &str = "indices: 0 triangles; at least one is needed";

/// The files that are no mesh, and how what is said of them begins.
const REFUSED: [(&str, &str); 13] = [
    // Points and lines.
    ("OBJ/point_cloud.obj", NO_FACES),
    ("OBJ/testline.obj", NO_FACES),
    ("OBJ/testpoints.obj", NO_FACES),
    ("PLY/points.ply", NO_FACES),
    ("invalid/empty.obj", NO_FACES),
    ("invalid/empty.ply", "is no PLY file: it does not begin with \"ply\""),
    ("invalid/malformed.obj", "line 23: a face names vertex 12, but there are 8"),
    ("invalid/malformed2.obj", "line 23: a face without corners"),
    ("OBJ/box_UTF16BE.obj", "is encoded in UTF-16; save it as UTF-8"),
    // An exponent without its letter.
    ("OBJ/number_formats.obj", "line 11: position parse error"),
    // A line of the header lacks the word "comment".
    ("PLY/Wuson.ply", "line 3: Couldn't parse line"),
    // Each vertex should have a list of vertices, and has none.
    ("PLY/issue623.ply", "line 1"),
    // A point cloud, which one version of the package has cut.
    ("PLY/pond.0.ply", ""),
];

/// The files of these kinds in a folder and those below.
fn models(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let (folders, files): (Vec<_>, Vec<_>) = entries.partition(|path| path.is_dir());
    let extension = |path: &Path| path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
    let is_model = |path: &PathBuf| ["obj", "ply", "stl"].contains(&&*extension(path));
    files.into_iter().filter(is_model).chain(folders.iter().flat_map(|folder| models(folder))).collect()
}

#[test]
fn files_of_many_programs_are_loaded_and_sampled_or_refused_with_the_reason() {
    // What is not there proves nothing.
    assert!(Path::new(MODELS).is_dir(), "there is no {MODELS}; scripts/setup.sh --tests installs it");
    let context = Context::new(2).unwrap();
    let (mut loaded, mut refused) = (0, 0);
    for path in models(Path::new(MODELS)) {
        let name = path.strip_prefix(MODELS).unwrap().to_string_lossy();
        let reason = REFUSED.iter().find(|(refused, _)| *refused == name).map(|&(_, reason)| reason);
        match (Mesh::load(&path), reason) {
            (Err(Error::Format { reason, .. }), Some(expected)) => {
                assert!(reason.starts_with(expected), "{name}: {reason}");
                refused += 1;
            }
            (Ok(mesh), None) => {
                let mesh = Arc::new(mesh);
                let radius = (mesh.area() / 1000.0).sqrt();
                for iterations in [0, 1] {
                    let options = ProjectionOptions::new(radius);
                    let (samples, _) = psp::project(&context, &mesh, &options, iterations, true, None).unwrap();
                    assert_eq!(oracle::misplaced(&mesh, &samples), None, "{name}");
                    assert_eq!(oracle::conflict(&samples, radius), None, "{name}");
                    assert_eq!(oracle::gap(&mesh, &samples, radius, tolerance(&mesh)), None, "{name}");
                    assert_eq!(samples.interpolated_normals.len(), if mesh.has_normals() { samples.len() } else { 0 });
                }
                loaded += 1;
            }
            // Other versions of the package have more of these.
            (Err(Error::Format { .. }), None) if name.starts_with("invalid/") => refused += 1,
            (Err(error), _) => panic!("{error}"),
            (Ok(_), Some(reason)) => panic!("{name} is loaded, although {reason}"),
        }
    }
    assert!(loaded >= 29 && refused >= REFUSED.len(), "{loaded} files loaded, {refused} refused");

    // One model is there in three formats, and in two sizes.
    let spiders = ["OBJ/spider.obj", "STL/Spider_ascii.stl", "STL/Spider_binary.stl"];
    let [obj, text, binary] = spiders.map(|name| Mesh::load(Path::new(MODELS).join(name)).unwrap());
    for other in [&text, &binary] {
        assert_eq!(other.triangles().len(), obj.triangles().len());
        let ratio =
            |triangle| other.triangle_area(triangle) / obj.triangle_area(triangle) / (other.area() / obj.area());
        assert!((0..10).all(|triangle| (ratio(triangle) - 1.0).abs() < 1e-3), "{:?}", [0, 1, 2].map(ratio));
    }
    assert!((text.area() / binary.area() - 1.0).abs() < 1e-6);
}
