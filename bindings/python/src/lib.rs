//! The Python module `azulejo`. What users read is in the doc comments of its functions and classes, and in azulejo.pyi.

mod adaptive;
mod analysis;
mod argument;
mod array;
mod classes;
mod edit;
mod error;
mod frame;
mod growing;
mod inside;
mod mask;
mod mesh;
mod plane;
mod points;
mod psp;
mod psp_classes;
mod relax;
mod remesh;
mod report;
mod spectrum;
mod stream;
mod taken;
mod thin;
mod volume;
mod volume_adaptive;
mod watch;

/// Blue-noise sampling: maximal Poisson-disk sets in the plane, on triangle meshes and in space, and their relaxation.
///
/// The plane: kdrt_sample, kdrt_sample_window, KdrtPlane, kdrt_sample_classes, kdrt_stream, kdrt_merge, maximal_sample,
/// Plane. Meshes: Mesh, psp_sample, psp_sample_classes, psp_classes_with_density, psp_adaptive_sample,
/// psp_adaptive_with_density, Psp. Space: volume_sample, volume_sample_classes, volume_sample_inside, volume_adaptive_sample.
/// Relaxation: dcr_relax, dcr_relax_classes, dcr_relax_density, dcr_scatter, dcr_relax_to_correlation, dcr_correlation_of_power,
/// dcr_surface_relax, volume_relax, volume_relax_inside, dcr_remesh.
/// Clouds: thin. Pixels: mask_create, mask_dither. Analysis: plane_measure, plane_coverage, space_measure,
/// space_coverage, mesh_coverage, Spectrum, Differences and others. Plane and Psp are sets that are edited.
///
/// A radius is the smallest distance of two samples, centre to centre. The same arguments and seed give the same bytes,
/// for any number of threads and on every machine.
///
/// Arrays are read in place if they are C-contiguous and of the type that is named, and copied otherwise; results are not
/// copied. Calls release the interpreter's lock: other threads run on, and must not change arrays that are being read.
///
/// Bad arguments raise ValueError or TypeError, requests that memory cannot hold MemoryError, files that cannot be read
/// OSError. Ctrl-C interrupts a call.
#[pyo3::pymodule]
mod azulejo {
    use pyo3::prelude::*;

    #[pymodule_export]
    use crate::adaptive::{psp_adaptive_sample, psp_adaptive_with_density};
    #[pymodule_export]
    use crate::analysis::{
        CoverageReport, PlaneReport, SpaceReport, mesh_coverage, mesh_uncovered_fraction, plane_coverage,
        plane_covering_radius, plane_measure, plane_nearest_histogram, plane_radial_distribution,
        plane_smallest_distance, space_coverage, space_measure, space_radial_distribution, space_smallest_distance,
    };
    #[pymodule_export]
    use crate::classes::classes_radii;
    #[pymodule_export]
    use crate::edit::Plane;
    #[pymodule_export]
    use crate::error::Cancelled;
    #[pymodule_export]
    use crate::growing::Psp;
    #[pymodule_export]
    use crate::inside::{VolumeInsideReport, volume_sample_inside};
    #[pymodule_export]
    use crate::mask::{mask_create, mask_dither};
    #[pymodule_export]
    use crate::mesh::{_mesh, Mesh};
    #[pymodule_export]
    use crate::plane::{
        KdrtMergeReport, KdrtPlane, KdrtReport, kdrt_merge, kdrt_sample, kdrt_sample_classes, kdrt_sample_window,
        maximal_sample,
    };
    #[pymodule_export]
    use crate::points::{_points, Points};
    #[pymodule_export]
    use crate::psp::{PspReport, psp_sample};
    #[pymodule_export]
    use crate::psp_classes::{psp_classes_with_density, psp_sample_classes};
    #[pymodule_export]
    use crate::relax::{
        DcrReport, dcr_correlation_of_power, dcr_relax, dcr_relax_classes, dcr_relax_density, dcr_relax_to_correlation,
        dcr_scatter, dcr_surface_relax, volume_relax, volume_relax_inside,
    };
    #[pymodule_export]
    use crate::remesh::{DcrRemeshReport, dcr_remesh};
    #[pymodule_export]
    use crate::spectrum::{Differences, Spectrum, SpectrumReport, space_axis_power, space_spectrum};
    #[pymodule_export]
    use crate::stream::kdrt_stream;
    #[pymodule_export]
    use crate::thin::{_selection, Selection, thin};
    #[pymodule_export]
    use crate::volume::{VolumeReport, volume_sample, volume_sample_classes};
    #[pymodule_export]
    use crate::volume_adaptive::volume_adaptive_sample;

    #[pymodule_export]
    #[allow(non_upper_case_globals)]
    const __version__: &str = env!("CARGO_PKG_VERSION");

    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        crate::array::load(module.py())
    }
}
