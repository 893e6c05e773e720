//! Meshes of other packages, and vertices with faces of any number of corners.

use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;

use azulejo_core::mesh;

use crate::array::{Array, as_array};
use crate::error::invalid;
use crate::frame::Positions;
use crate::mesh::Mesh;
use crate::watch::unlocked;

/// The places where packages keep vertices and faces, by the attributes of their meshes: trimesh and libigl's wrappers, Open3D,
/// PyVista.
const PLACES: [(&str, &str); 3] = [("vertices", "faces"), ("vertices", "triangles"), ("points", "faces")];

/// The argument `mesh`: a [`Mesh`], or what one can be made of.
pub(crate) fn mesh(object: &Bound<'_, PyAny>) -> PyResult<Mesh> {
    if let Ok(mesh) = object.cast::<Mesh>() {
        return Ok(mesh.get().clone());
    }
    if let Ok((vertices, faces)) = object.extract::<(Bound<'_, PyAny>, Bound<'_, PyAny>)>() {
        return made(&vertices, &faces);
    }
    for (vertices, faces) in PLACES {
        if let (Ok(vertices), Ok(faces)) = (object.getattr(vertices), object.getattr(faces)) {
            return made(&vertices, &faces);
        }
    }
    // Open3D's tensors.
    let tensor = |group: &str, name: &str| object.getattr(group)?.getattr(name)?.call_method0("numpy");
    if let (Ok(vertices), Ok(faces)) = (tensor("vertex", "positions"), tensor("triangle", "indices")) {
        return made(&vertices, &faces);
    }
    let kind = object.get_type().name()?;
    Err(PyTypeError::new_err(format!(
        "mesh: a {kind} is no azulejo.Mesh, has no vertices and faces, and is no tuple of both"
    )))
}

fn made(vertices: &Bound<'_, PyAny>, faces: &Bound<'_, PyAny>) -> PyResult<Mesh> {
    let (positions, origin, _) = Positions::read("positions", vertices)?.centred()?;
    let (positions, indices) = (positions.get()?.to_vec(), triangles(faces)?);
    let made = unlocked(vertices.py(), || mesh::Mesh::new(positions, indices))?;
    Ok(made.with_origin(origin).into())
}

/// The argument `indices`: faces, which become fans of triangles. Rows of their corners; or, as VTK has them, one line in
/// which the corners of each follow their number.
pub(crate) fn triangles(faces: &Bound<'_, PyAny>) -> PyResult<Vec<[u32; 3]>> {
    let faces = Array::<u32>::read("indices", &as_array("indices", faces)?)?;
    let mut triangles = Vec::new();
    match *faces.shape() {
        [_, 3] | [0] => return Ok(faces.rows()?.to_vec()),
        [_, corners] if corners > 3 => {
            faces.entries().chunks_exact(corners).for_each(|face| triangles.extend(fan(face)));
        }
        [_] => {
            let mut rest = faces.entries();
            while let [corners, behind @ ..] = rest {
                let Some((face, next)) = behind.split_at_checked(*corners as usize) else {
                    let reason = format!("a face of {corners} corners, but {} numbers follow", behind.len());
                    return Err(invalid("indices", reason));
                };
                triangles.extend(fan(face));
                rest = next;
            }
        }
        ref shape => return Err(invalid("indices", format!("its shape is {shape:?}, not [t, 3]"))),
    }
    Ok(triangles)
}

/// The triangles of a polygon.
fn fan(face: &[u32]) -> impl Iterator<Item = [u32; 3]> + '_ {
    face.get(1..).unwrap_or_default().windows(2).map(|pair| [face[0], pair[0], pair[1]])
}
