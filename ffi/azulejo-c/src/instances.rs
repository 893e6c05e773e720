//! PSP on instances of meshes.

use std::sync::Arc;

use azulejo_core::psp::{Instance, sample_instances};

use crate::boundary::Out;
use crate::context::azulejo_context;
use crate::growing::{self, Output, elements};
use crate::handles;
use crate::mesh::azulejo_mesh;
use crate::points::azulejo_points;
use crate::psp::azulejo_psp_options;
use crate::psp_report::azulejo_psp_report;
use crate::status::{Failure, azulejo_status};

/// A mesh placed in the world.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct azulejo_instance {
    /// The index of its mesh among the prototypes.
    pub prototype: u32,
    /// Must be 0.
    pub reserved: u32,
    /// Three rows of four: their products with (x, y, z, 1) are the place of a vertex. Finite,
    /// otherwise any. Of Embree it is RTC_FORMAT_FLOAT3X4_ROW_MAJOR.
    pub transform: [f64; 12],
}

/// Samples instances of meshes in world space, as if all their triangles were one mesh: no conflict
/// and no gap across instances. The triangles of one instance for each thread are in memory.
///
/// prototypes: `prototype_count` meshes, such as of azulejo_mesh_create_from_embree.
///
/// instances: of two that overlap the first one is sampled first.
///
/// instance_size: sizeof(azulejo_instance).
///
/// options: as in azulejo_psp_sample_region; `cosine` acts within each instance only.
///
/// out: by instance (azulejo_points_instances), with triangles and barycentrics of the prototypes
/// and normals on the side that is their front.
///
/// report: counts and times of all instances together; `uncovered_before` is -1.
///
/// O(samples + triangles of all instances + instances * given samples) time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_psp_sample_instances(
    context: *const azulejo_context,
    prototypes: *const *const azulejo_mesh,
    prototype_count: usize,
    instances: *const azulejo_instance,
    instance_count: usize,
    instance_size: usize,
    options: *const azulejo_psp_options,
    out: *mut *mut azulejo_points,
    report: *mut azulejo_psp_report,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    let out = unsafe { Out::new(out) };
    handles::create(out, || {
        // SAFETY: handed on from the caller.
        let context = unsafe { handles::get("context", context) }?;
        // SAFETY: handed on from the caller.
        let prototypes = unsafe { handles::all("prototypes", "prototype_count", prototypes, prototype_count) }?;
        let prototypes: Vec<_> = prototypes.into_iter().map(|mesh: &azulejo_mesh| Arc::clone(&mesh.shared)).collect();
        let names = ["instances", "instance_count", "instance_size"];
        // SAFETY: handed on from the caller.
        let instances = unsafe { elements(names, instances, instance_count, instance_size) }?;
        let instances: Vec<_> = (0..).zip(&instances).map(azulejo_instance::instance).collect::<Result<_, _>>()?;
        // SAFETY: handed on from the caller.
        let (options, report) = unsafe { (growing::read("options", options)?, Output::optional("report", report)?) };
        // SAFETY: handed on from the caller.
        let request = unsafe { options.request_of_region("with instances") }?;
        let (samples, done) = context.run(options.watch(), |context, progress| {
            sample_instances(context, &prototypes, &instances, &request, progress)
        })?;
        if let Some(report) = report {
            report.write(done);
        }
        Ok(azulejo_points::space(samples))
    })
}

impl azulejo_instance {
    /// The instance of this number.
    fn instance((number, instance): (usize, &Self)) -> Result<Instance, Failure> {
        let &Self { prototype, reserved, transform } = instance;
        if reserved != 0 {
            return Err(Failure::invalid("instances", format!("[{number}]: reserved is {reserved}, not 0")));
        }
        let row = |row: usize| [0, 1, 2, 3].map(|column| transform[4 * row + column]);
        Ok(Instance { prototype, transform: [row(0), row(1), row(2)] })
    }
}
