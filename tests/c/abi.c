/* The ABI of version 0.1 on LP64: constants, struct sizes and offsets. A change here needs another SONAME. */

#include <stddef.h>

#include "samples.h"

#define SIZE(type, size) _Static_assert(sizeof(type) == (size), "the size of " #type)
#define FIELD(type, field, offset) _Static_assert(offsetof(type, field) == (offset), "the offset of " #type "." #field)
#define CONSTANT(name, value) _Static_assert((name) == (value), #name)

SIZE(azulejo_status, 4);
SIZE(azulejo_progress_fn, 8);
SIZE(azulejo_kdrt_window_fn, 8);

SIZE(azulejo_kdrt_options, 88);
FIELD(azulejo_kdrt_options, struct_size, 0);
FIELD(azulejo_kdrt_options, boundary, 4);
FIELD(azulejo_kdrt_options, radius, 8);
FIELD(azulejo_kdrt_options, domain_min, 16);
FIELD(azulejo_kdrt_options, domain_max, 32);
FIELD(azulejo_kdrt_options, leaf_size, 48);
FIELD(azulejo_kdrt_options, seed, 56);
FIELD(azulejo_kdrt_options, progress, 64);
FIELD(azulejo_kdrt_options, progress_user, 72);
FIELD(azulejo_kdrt_options, count, 80);

SIZE(azulejo_kdrt_report, 64);
FIELD(azulejo_kdrt_report, samples, 0);
FIELD(azulejo_kdrt_report, radius, 8);
FIELD(azulejo_kdrt_report, coverage, 16);
FIELD(azulejo_kdrt_report, seconds, 24);
FIELD(azulejo_kdrt_report, is_maximal, 32);
FIELD(azulejo_kdrt_report, reserved, 36);

SIZE(azulejo_maximal_options, 72);
FIELD(azulejo_maximal_options, struct_size, 0);
FIELD(azulejo_maximal_options, boundary, 4);
FIELD(azulejo_maximal_options, radius, 8);
FIELD(azulejo_maximal_options, domain_min, 16);
FIELD(azulejo_maximal_options, domain_max, 32);
FIELD(azulejo_maximal_options, seed, 48);
FIELD(azulejo_maximal_options, progress, 56);
FIELD(azulejo_maximal_options, progress_user, 64);

SIZE(azulejo_merge_options, 72);
FIELD(azulejo_merge_options, struct_size, 0);
FIELD(azulejo_merge_options, boundary, 4);
FIELD(azulejo_merge_options, radius, 8);
FIELD(azulejo_merge_options, domain_min, 16);
FIELD(azulejo_merge_options, domain_max, 32);
FIELD(azulejo_merge_options, seed, 48);
FIELD(azulejo_merge_options, progress, 56);
FIELD(azulejo_merge_options, progress_user, 64);

SIZE(azulejo_merge_piece, 48);
FIELD(azulejo_merge_piece, xy, 0);
FIELD(azulejo_merge_piece, count, 8);
FIELD(azulejo_merge_piece, min, 16);
FIELD(azulejo_merge_piece, max, 32);

SIZE(azulejo_merge_report, 64);
FIELD(azulejo_merge_report, kept, 0);
FIELD(azulejo_merge_report, eliminated, 8);
FIELD(azulejo_merge_report, inserted, 16);
FIELD(azulejo_merge_report, reserved, 24);

SIZE(azulejo_psp_options, 56);
FIELD(azulejo_psp_options, struct_size, 0);
FIELD(azulejo_psp_options, iterations, 4);
FIELD(azulejo_psp_options, radius, 8);
FIELD(azulejo_psp_options, seed, 16);
FIELD(azulejo_psp_options, maximal, 24);
FIELD(azulejo_psp_options, reserved, 28);
FIELD(azulejo_psp_options, progress, 32);
FIELD(azulejo_psp_options, progress_user, 40);
FIELD(azulejo_psp_options, order, 48);
FIELD(azulejo_psp_options, engine, 52);

SIZE(azulejo_embree_geometry, 32);
FIELD(azulejo_embree_geometry, geometry_id, 0);
FIELD(azulejo_embree_geometry, vertex_stride, 4);
FIELD(azulejo_embree_geometry, index_stride, 8);
FIELD(azulejo_embree_geometry, reserved, 12);
FIELD(azulejo_embree_geometry, vertex_count, 16);
FIELD(azulejo_embree_geometry, triangle_count, 24);

SIZE(azulejo_psp_report, 128);
FIELD(azulejo_psp_report, samples, 0);
FIELD(azulejo_psp_report, accepted, 8);
FIELD(azulejo_psp_report, rays, 16);
FIELD(azulejo_psp_report, hits, 24);
FIELD(azulejo_psp_report, restart_conflicts, 32);
FIELD(azulejo_psp_report, darts, 40);
FIELD(azulejo_psp_report, conflicts, 48);
FIELD(azulejo_psp_report, seconds, 56);
FIELD(azulejo_psp_report, iterations, 64);
FIELD(azulejo_psp_report, reserved, 68);
FIELD(azulejo_psp_report, prepare_seconds, 72);
FIELD(azulejo_psp_report, project_seconds, 80);
FIELD(azulejo_psp_report, merge_seconds, 88);
FIELD(azulejo_psp_report, fill_seconds, 96);
FIELD(azulejo_psp_report, rho, 104);
FIELD(azulejo_psp_report, uncovered_before, 112);
FIELD(azulejo_psp_report, uncovered_after, 120);

SIZE(azulejo_radius_fn, 8);

SIZE(azulejo_adaptive_options, 96);
FIELD(azulejo_adaptive_options, struct_size, 0);
FIELD(azulejo_adaptive_options, reserved, 4);
FIELD(azulejo_adaptive_options, vertex_radii, 8);
FIELD(azulejo_adaptive_options, vertex_count, 16);
FIELD(azulejo_adaptive_options, radius, 24);
FIELD(azulejo_adaptive_options, radius_user, 32);
FIELD(azulejo_adaptive_options, smallest, 40);
FIELD(azulejo_adaptive_options, largest, 48);
FIELD(azulejo_adaptive_options, slope, 56);
FIELD(azulejo_adaptive_options, cosine, 64);
FIELD(azulejo_adaptive_options, seed, 72);
FIELD(azulejo_adaptive_options, progress, 80);
FIELD(azulejo_adaptive_options, progress_user, 88);

SIZE(azulejo_dcr_options, 136);
FIELD(azulejo_dcr_options, struct_size, 0);
FIELD(azulejo_dcr_options, boundary, 4);
FIELD(azulejo_dcr_options, domain_min, 8);
FIELD(azulejo_dcr_options, domain_max, 24);
FIELD(azulejo_dcr_options, neighbourhood, 40);
FIELD(azulejo_dcr_options, max_iterations, 44);
FIELD(azulejo_dcr_options, seed, 48);
FIELD(azulejo_dcr_options, conflict_radius, 56);
FIELD(azulejo_dcr_options, attraction_radius, 64);
FIELD(azulejo_dcr_options, step, 72);
FIELD(azulejo_dcr_options, tolerance, 80);
FIELD(azulejo_dcr_options, neighbours, 88);
FIELD(azulejo_dcr_options, distribution, 92);
FIELD(azulejo_dcr_options, progress, 96);
FIELD(azulejo_dcr_options, progress_user, 104);
FIELD(azulejo_dcr_options, method, 112);
FIELD(azulejo_dcr_options, reserved, 116);
FIELD(azulejo_dcr_options, visits, 120);
FIELD(azulejo_dcr_options, convergence, 124);
FIELD(azulejo_dcr_options, decay, 128);

SIZE(azulejo_dcr_report, 64);
FIELD(azulejo_dcr_report, iterations, 0);
FIELD(azulejo_dcr_report, converged, 4);
FIELD(azulejo_dcr_report, motion, 8);
FIELD(azulejo_dcr_report, smallest_distance, 16);
FIELD(azulejo_dcr_report, rho, 24);
FIELD(azulejo_dcr_report, coverage, 32);
FIELD(azulejo_dcr_report, stopped, 40);
FIELD(azulejo_dcr_report, reserved, 44);

SIZE(azulejo_coverage, 32);
FIELD(azulejo_coverage, covering_radius, 0);
FIELD(azulejo_coverage, gaps, 8);
FIELD(azulejo_coverage, reserved, 16);

SIZE(azulejo_plane_report, 192);
FIELD(azulejo_plane_report, count, 0);
FIELD(azulejo_plane_report, smallest_distance, 8);
FIELD(azulejo_plane_report, mean_distance, 16);
FIELD(azulejo_plane_report, hexagonal_distance, 24);
FIELD(azulejo_plane_report, rho, 32);
FIELD(azulejo_plane_report, covering_radius, 40);
FIELD(azulejo_plane_report, bond_order, 48);
FIELD(azulejo_plane_report, triangles, 56);
FIELD(azulejo_plane_report, obtuse, 64);
FIELD(azulejo_plane_report, below_30_degrees, 72);
FIELD(azulejo_plane_report, edge_mean, 80);
FIELD(azulejo_plane_report, edge_variation, 88);
FIELD(azulejo_plane_report, area_variation, 96);
FIELD(azulejo_plane_report, angles_below_30_degrees, 104);
FIELD(azulejo_plane_report, beyond_4_sigma, 112);
FIELD(azulejo_plane_report, reserved, 120);

SIZE(azulejo_annulus, 32);
FIELD(azulejo_annulus, frequency, 0);
FIELD(azulejo_annulus, power, 8);
FIELD(azulejo_annulus, anisotropy, 16);
FIELD(azulejo_annulus, count, 24);

SIZE(azulejo_spectrum_report, 96);
FIELD(azulejo_spectrum_report, frequency_step, 0);
FIELD(azulejo_spectrum_report, effective_nyquist, 16);
FIELD(azulejo_spectrum_report, oscillation, 24);
FIELD(azulejo_spectrum_report, contrast, 32);
FIELD(azulejo_spectrum_report, peak, 40);
FIELD(azulejo_spectrum_report, peak_frequency, 48);
FIELD(azulejo_spectrum_report, reserved, 64);
SIZE(azulejo_density_fn, 8);

SIZE(azulejo_density, 48);
FIELD(azulejo_density, struct_size, 0);
FIELD(azulejo_density, reserved, 4);
FIELD(azulejo_density, values, 8);
FIELD(azulejo_density, width, 16);
FIELD(azulejo_density, height, 24);
FIELD(azulejo_density, function, 32);
FIELD(azulejo_density, user, 40);

SIZE(azulejo_dcr_surface_options, 40);
FIELD(azulejo_dcr_surface_options, struct_size, 0);
FIELD(azulejo_dcr_surface_options, max_iterations, 4);
FIELD(azulejo_dcr_surface_options, tolerance, 8);
FIELD(azulejo_dcr_surface_options, seed, 16);
FIELD(azulejo_dcr_surface_options, progress, 24);
FIELD(azulejo_dcr_surface_options, progress_user, 32);

SIZE(azulejo_dcr_surface_report, 56);
FIELD(azulejo_dcr_surface_report, iterations, 0);
FIELD(azulejo_dcr_surface_report, stopped, 4);
FIELD(azulejo_dcr_surface_report, motion, 8);
FIELD(azulejo_dcr_surface_report, smallest_distance, 16);
FIELD(azulejo_dcr_surface_report, rho, 24);
FIELD(azulejo_dcr_surface_report, reserved, 32);

CONSTANT(AZULEJO_OK, 0);
CONSTANT(AZULEJO_ERROR_INVALID_ARGUMENT, -1);
CONSTANT(AZULEJO_ERROR_TOO_LARGE, -2);
CONSTANT(AZULEJO_ERROR_IO, -3);
CONSTANT(AZULEJO_ERROR_FORMAT, -4);
CONSTANT(AZULEJO_ERROR_CANCELLED, -5);
CONSTANT(AZULEJO_ERROR_OUT_OF_MEMORY, -6);
CONSTANT(AZULEJO_ERROR_EMBREE, -7);
CONSTANT(AZULEJO_ERROR_THREADS, -8);
CONSTANT(AZULEJO_ERROR_INTERNAL, -100);
CONSTANT(AZULEJO_BOUNDARY_PERIODIC, 0);
CONSTANT(AZULEJO_BOUNDARY_BOUNDED, 1);
CONSTANT(AZULEJO_NEIGHBOURHOOD_DELAUNAY, 0);
CONSTANT(AZULEJO_NEIGHBOURHOOD_NEAREST, 1);
CONSTANT(AZULEJO_DISTRIBUTION_ACTIVENESS, 0);
CONSTANT(AZULEJO_DISTRIBUTION_AVERAGE, 1);
CONSTANT(AZULEJO_DISTRIBUTION_DOMINANT, 2);
CONSTANT(AZULEJO_DISTRIBUTION_ZERO, 3);
CONSTANT(AZULEJO_DISTRIBUTION_EIGHTY_TWENTY, 4);
CONSTANT(AZULEJO_DIFFERENCES_SIZE, 128);
CONSTANT(AZULEJO_DIFFERENCES_GRID_REACH, 4);
CONSTANT(AZULEJO_DIFFERENCES_SHELLS, 512);
CONSTANT(AZULEJO_DIFFERENCES_REACH, 8);
CONSTANT(AZULEJO_VISITS_BOTH_ENDS, 0);
CONSTANT(AZULEJO_VISITS_ONE_END, 1);
CONSTANT(AZULEJO_CONVERGENCE_MOTION, 0);
CONSTANT(AZULEJO_CONVERGENCE_VARIANCE, 1);

/* The fixed signatures: assignments that compile only if they are these. */
static void signatures(void) {
    azulejo_status (*context_create)(uint32_t, azulejo_context **) = azulejo_context_create;
    azulejo_status (*kdrt_sample)(const azulejo_context *, const azulejo_kdrt_options *, azulejo_points **) =
        azulejo_kdrt_sample;
    azulejo_status (*kdrt_sample_with_report)(const azulejo_context *, const azulejo_kdrt_options *, azulejo_points **,
                                              azulejo_kdrt_report *) = azulejo_kdrt_sample_with_report;
    azulejo_status (*kdrt_sample_window)(const azulejo_context *, const azulejo_kdrt_options *, const double *,
                                         const double *, azulejo_points **) = azulejo_kdrt_sample_window;
    azulejo_status (*kdrt_stream)(const azulejo_context *, const azulejo_kdrt_options *,
                                  int32_t (*)(void *, const float *, size_t), void *) = azulejo_kdrt_stream;
    azulejo_status (*kdrt_merge)(const azulejo_context *, const azulejo_merge_options *, const azulejo_merge_piece *,
                                 size_t, const float *, size_t, azulejo_points **, azulejo_merge_report *) =
        azulejo_kdrt_merge;
    azulejo_status (*mesh_create)(const float *, size_t, size_t, const uint32_t *, size_t, azulejo_mesh **) =
        azulejo_mesh_create;
    azulejo_status (*mesh_with_normals)(const azulejo_mesh *, const float *, size_t, size_t, const uint32_t *, size_t,
                                        azulejo_mesh **) = azulejo_mesh_with_normals;
    azulejo_status (*mesh_with_mask)(const azulejo_mesh *, const uint8_t *, size_t, azulejo_mesh **) =
        azulejo_mesh_with_mask;
    azulejo_status (*mesh_load)(const char *, azulejo_mesh **) = azulejo_mesh_load;
    azulejo_status (*psp_create)(const azulejo_context *, const azulejo_mesh *, const azulejo_psp_options *,
                                 azulejo_psp **) = azulejo_psp_create;
    azulejo_status (*psp_advance)(azulejo_psp *, uint32_t, azulejo_psp_report *) = azulejo_psp_advance;
    azulejo_status (*psp_fill)(azulejo_psp *, azulejo_psp_report *) = azulejo_psp_fill;
    azulejo_status (*psp_points)(const azulejo_psp *, azulejo_points **) = azulejo_psp_points;
    azulejo_status (*psp_sample)(const azulejo_context *, const azulejo_mesh *, const azulejo_psp_options *,
                                 azulejo_points **, azulejo_psp_report *) = azulejo_psp_sample;
    azulejo_status (*psp_sample_adaptive)(const azulejo_context *, const azulejo_mesh *,
                                          const azulejo_adaptive_options *, azulejo_points **, azulejo_psp_report *) =
        azulejo_psp_sample_adaptive;
    azulejo_status (*dcr_relax)(const azulejo_context *, const azulejo_dcr_options *, const float *, size_t,
                                azulejo_points **, azulejo_dcr_report *) = azulejo_dcr_relax;
    size_t (*last_error_message)(char *, size_t) = azulejo_last_error_message;
    CHECK(context_create && kdrt_sample && mesh_create && mesh_load && psp_create && psp_advance && psp_fill);
    CHECK(psp_points && psp_sample && dcr_relax && last_error_message && kdrt_sample_window && kdrt_stream);
    CHECK(kdrt_sample_with_report);
    CHECK(kdrt_merge);
    CHECK(mesh_with_normals && mesh_with_mask);
    CHECK(psp_sample_adaptive);
}

int main(void) {
    signatures();
    CHECK(AZULEJO_VERSION_MAJOR == 0); /* the number in the SONAME */
    CHECK(AZULEJO_VERSION == AZULEJO_VERSION_MAJOR * 10000 + AZULEJO_VERSION_MINOR * 100 + AZULEJO_VERSION_PATCH);
    return finish();
}
