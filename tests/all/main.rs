//! The tests of the crate through its public functions, in one program, so that they are linked once: `cargo test --test all
//! psp::` runs those of `psp.rs`. What must have a process of its own stands beside this folder.

mod adaptive;
mod adaptive_large;
mod adaptive_order;
mod analysis;
mod analysis_awkward;
mod analysis_coverage;
mod analysis_distribution;
mod analysis_exact;
mod analysis_reference;
mod calls;
mod common;
mod dcr;
mod dcr_boundary;
mod dcr_classes;
mod dcr_converged;
mod dcr_density;
mod dcr_density_report;
mod dcr_starts;
mod dcr_thesis;
mod differential;
mod editable;
#[cfg(feature = "embree")]
mod embree_traces;
mod given;
mod given_levels;
mod hostile;
mod house;
mod kdrt;
mod kdrt_classes;
mod kdrt_count;
mod kdrt_merge;
mod kdrt_merge_arguments;
mod kdrt_window;
mod maximal;
mod mesh;
mod mesh_attributes;
mod mesh_corpus;
mod mesh_damaged;
mod mesh_density;
mod mesh_files;
mod order;
mod plane_given;
mod plane_order;
mod psp;
mod psp_bias;
mod psp_classes;
mod psp_count;
mod psp_large;
mod psp_places;
mod remesh;
mod strips;
mod surface_relax;
mod thin;
#[cfg(feature = "embree")]
mod traces;
