//! The report of calls that sample meshes.

use azulejo_core::psp::Report;

use crate::growing::{self, Growing, growing};
use crate::status::azulejo_status;

/// The report of a call that samples a mesh. Times are wall times.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct azulejo_psp_report {
    /// The size of the struct in bytes; set by the _init function.
    pub struct_size: u32,
    /// The iterations that the call made.
    pub iterations: u32,
    /// The samples of the set after the call.
    pub samples: u64,
    /// The samples that the call added.
    pub accepted: u64,
    /// The rays that meet the box of the mesh, or the points of those tiles of the rasteriser, at
    /// most 48 radii wide, that have triangles near them.
    pub rays: u64,
    /// The places where rays met the mesh.
    pub hits: u64,
    /// The hits rejected because of an earlier one on the same ray.
    pub restart_conflicts: u64,
    /// The darts thrown into uncovered surface.
    pub darts: u64,
    /// The hits and darts rejected because of other samples.
    pub conflicts: u64,
    /// The time of the call in seconds.
    pub seconds: f64,
    /// The part of it in which patterns and, for Embree, the scene were made.
    pub prepare_seconds: f64,
    /// The part of it in which hits were found.
    pub project_seconds: f64,
    /// The part of it in which samples were chosen among the hits.
    pub merge_seconds: f64,
    /// The part of it in which gaps were searched for and filled.
    pub fill_seconds: f64,
    /// The radius of the set in units of d_max: about 0.78 for a maximal set, 0 for no samples.
    pub rho: f64,
    /// If the call filled gaps: about the share of the area uncovered before. Else -1.
    pub uncovered_before: f64,
    /// If the call filled gaps: 0, what is uncovered after it. Else -1.
    pub uncovered_after: f64,
    /// The radius of the set: the one asked for, or found for a count. No two samples are closer. 0
    /// where radii vary; in progressive order then the factor of radii, 1, or for a density the
    /// radius at density 1.
    pub radius: f64,
    /// A bound of the covering radius, up to 6 float spacings, or where `radius` is a factor of
    /// radii, of that factor: `radius` after a fill, a little more for a count. -1: unknown.
    pub covering_radius: f64,
}

growing!(azulejo_psp_report requires samples {
    iterations: 0,
    samples: 0,
    accepted: 0,
    rays: 0,
    hits: 0,
    restart_conflicts: 0,
    darts: 0,
    conflicts: 0,
    seconds: 0.0,
    prepare_seconds: 0.0,
    project_seconds: 0.0,
    merge_seconds: 0.0,
    fill_seconds: 0.0,
    rho: 0.0,
    uncovered_before: 0.0,
    uncovered_after: 0.0,
    radius: 0.0,
    covering_radius: 0.0,
});

impl From<Report> for azulejo_psp_report {
    fn from(report: Report) -> Self {
        Self {
            samples: report.samples,
            accepted: report.accepted,
            rays: report.rays,
            hits: report.hits,
            restart_conflicts: report.restart_conflicts,
            darts: report.darts,
            conflicts: report.conflicts,
            seconds: report.seconds,
            iterations: report.iterations,
            prepare_seconds: report.prepare_seconds,
            project_seconds: report.project_seconds,
            merge_seconds: report.merge_seconds,
            fill_seconds: report.fill_seconds,
            rho: report.rho,
            uncovered_before: report.uncovered_before.unwrap_or(-1.0),
            uncovered_after: report.uncovered_after.unwrap_or(-1.0),
            radius: report.radius,
            covering_radius: report.covering_radius.unwrap_or(-1.0),
            ..Self::DEFAULT
        }
    }
}

/// Writes zeros and the size.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_psp_report_init(
    report: *mut azulejo_psp_report,
    struct_size: usize,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    unsafe { growing::init("report", report, struct_size) }
}
