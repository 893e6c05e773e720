/* The ABI of version 0.3 on LP64: constants, sizes and offsets of structs, signatures. Structs may grow at their end; any
   other change needs another SONAME. */

#include <stddef.h>

#include "samples.h"

#define SIZE(type, size) _Static_assert(sizeof(type) == (size), "the size of " #type)
#define FIELD(type, field, offset) _Static_assert(offsetof(type, field) == (offset), "the offset of " #type "." #field)
#define CONSTANT(name, value) _Static_assert((name) == (value), #name)

SIZE(azulejo_status, 4);
SIZE(azulejo_progress_fn, 8);
SIZE(azulejo_kdrt_visit_fn, 8);
SIZE(azulejo_density_fn, 8);
SIZE(azulejo_radius_fn, 8);
SIZE(azulejo_mesh_density_fn, 8);

SIZE(azulejo_space_set, 72);
FIELD(azulejo_space_set, struct_size, 0);
FIELD(azulejo_space_set, boundary, 4);
FIELD(azulejo_space_set, positions, 8);
FIELD(azulejo_space_set, count, 16);
FIELD(azulejo_space_set, domain_min, 24);
FIELD(azulejo_space_set, domain_max, 48);

SIZE(azulejo_plane_set, 56);
FIELD(azulejo_plane_set, struct_size, 0);
FIELD(azulejo_plane_set, boundary, 4);
FIELD(azulejo_plane_set, positions, 8);
FIELD(azulejo_plane_set, count, 16);
FIELD(azulejo_plane_set, domain_min, 24);
FIELD(azulejo_plane_set, domain_max, 40);

SIZE(azulejo_kdrt_options, 136);
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
FIELD(azulejo_kdrt_options, measure_covering_radius, 88);
FIELD(azulejo_kdrt_options, order, 92);
FIELD(azulejo_kdrt_options, quotient, 96);
FIELD(azulejo_kdrt_options, coarsest, 104);
FIELD(azulejo_kdrt_options, given_positions, 112);
FIELD(azulejo_kdrt_options, given_clearances, 120);
FIELD(azulejo_kdrt_options, given_count, 128);

SIZE(azulejo_kdrt_report, 40);
FIELD(azulejo_kdrt_report, struct_size, 0);
FIELD(azulejo_kdrt_report, is_maximal, 4);
FIELD(azulejo_kdrt_report, samples, 8);
FIELD(azulejo_kdrt_report, radius, 16);
FIELD(azulejo_kdrt_report, covering_radius, 24);
FIELD(azulejo_kdrt_report, seconds, 32);

SIZE(azulejo_maximal_options, 72);
FIELD(azulejo_maximal_options, struct_size, 0);
FIELD(azulejo_maximal_options, boundary, 4);
FIELD(azulejo_maximal_options, radius, 8);
FIELD(azulejo_maximal_options, domain_min, 16);
FIELD(azulejo_maximal_options, domain_max, 32);
FIELD(azulejo_maximal_options, seed, 48);
FIELD(azulejo_maximal_options, progress, 56);
FIELD(azulejo_maximal_options, progress_user, 64);

SIZE(azulejo_kdrt_merge_options, 80);
FIELD(azulejo_kdrt_merge_options, struct_size, 0);
FIELD(azulejo_kdrt_merge_options, boundary, 4);
FIELD(azulejo_kdrt_merge_options, radius, 8);
FIELD(azulejo_kdrt_merge_options, domain_min, 16);
FIELD(azulejo_kdrt_merge_options, domain_max, 32);
FIELD(azulejo_kdrt_merge_options, seed, 48);
FIELD(azulejo_kdrt_merge_options, progress, 56);
FIELD(azulejo_kdrt_merge_options, progress_user, 64);
FIELD(azulejo_kdrt_merge_options, maximal_pieces, 72);
FIELD(azulejo_kdrt_merge_options, reserved, 76);

SIZE(azulejo_classes, 32);
FIELD(azulejo_classes, struct_size, 0);
FIELD(azulejo_classes, count, 4);
FIELD(azulejo_classes, radii, 8);
FIELD(azulejo_classes, masks, 16);
FIELD(azulejo_classes, mask_count, 24);

SIZE(azulejo_thin_options, 48);
FIELD(azulejo_thin_options, struct_size, 0);
FIELD(azulejo_thin_options, order, 4);
FIELD(azulejo_thin_options, radius, 8);
FIELD(azulejo_thin_options, count, 16);
FIELD(azulejo_thin_options, seed, 24);
FIELD(azulejo_thin_options, progress, 32);
FIELD(azulejo_thin_options, progress_user, 40);

SIZE(azulejo_classes_report, 152);
FIELD(azulejo_classes_report, struct_size, 0);
FIELD(azulejo_classes_report, classes, 4);
FIELD(azulejo_classes_report, samples, 8);
FIELD(azulejo_classes_report, counts, 16);
FIELD(azulejo_classes_report, seconds, 144);

SIZE(azulejo_volume_options, 144);
FIELD(azulejo_volume_options, struct_size, 0);
FIELD(azulejo_volume_options, boundary, 4);
FIELD(azulejo_volume_options, radius, 8);
FIELD(azulejo_volume_options, domain_min, 16);
FIELD(azulejo_volume_options, domain_max, 40);
FIELD(azulejo_volume_options, seed, 64);
FIELD(azulejo_volume_options, progress, 72);
FIELD(azulejo_volume_options, progress_user, 80);
FIELD(azulejo_volume_options, count, 88);
FIELD(azulejo_volume_options, order, 96);
FIELD(azulejo_volume_options, reserved, 100);
FIELD(azulejo_volume_options, quotient, 104);
FIELD(azulejo_volume_options, given_positions, 112);
FIELD(azulejo_volume_options, given_clearances, 120);
FIELD(azulejo_volume_options, given_count, 128);
FIELD(azulejo_volume_options, leaf_size, 136);

SIZE(azulejo_volume_report, 40);
FIELD(azulejo_volume_report, struct_size, 0);
FIELD(azulejo_volume_report, reserved, 4);
FIELD(azulejo_volume_report, samples, 8);
FIELD(azulejo_volume_report, radius, 16);
FIELD(azulejo_volume_report, seconds, 24);
FIELD(azulejo_volume_report, covering_radius, 32);

SIZE(azulejo_volume_inside_options, 104);
FIELD(azulejo_volume_inside_options, struct_size, 0);
FIELD(azulejo_volume_inside_options, surface, 4);
FIELD(azulejo_volume_inside_options, radius, 8);
FIELD(azulejo_volume_inside_options, tolerance, 16);
FIELD(azulejo_volume_inside_options, seed, 24);
FIELD(azulejo_volume_inside_options, progress, 32);
FIELD(azulejo_volume_inside_options, progress_user, 40);
FIELD(azulejo_volume_inside_options, count, 48);
FIELD(azulejo_volume_inside_options, order, 56);
FIELD(azulejo_volume_inside_options, reserved, 60);
FIELD(azulejo_volume_inside_options, quotient, 64);
FIELD(azulejo_volume_inside_options, given_positions, 72);
FIELD(azulejo_volume_inside_options, given_clearances, 80);
FIELD(azulejo_volume_inside_options, given_count, 88);
FIELD(azulejo_volume_inside_options, thickness, 96);

SIZE(azulejo_volume_adaptive_options, 160);
FIELD(azulejo_volume_adaptive_options, struct_size, 0);
FIELD(azulejo_volume_adaptive_options, boundary, 4);
FIELD(azulejo_volume_adaptive_options, domain_min, 8);
FIELD(azulejo_volume_adaptive_options, domain_max, 32);
FIELD(azulejo_volume_adaptive_options, grid_values, 56);
FIELD(azulejo_volume_adaptive_options, grid_size, 64);
FIELD(azulejo_volume_adaptive_options, radius_function, 88);
FIELD(azulejo_volume_adaptive_options, radius_function_user, 96);
FIELD(azulejo_volume_adaptive_options, smallest, 104);
FIELD(azulejo_volume_adaptive_options, largest, 112);
FIELD(azulejo_volume_adaptive_options, slope, 120);
FIELD(azulejo_volume_adaptive_options, tolerance, 128);
FIELD(azulejo_volume_adaptive_options, seed, 136);
FIELD(azulejo_volume_adaptive_options, progress, 144);
FIELD(azulejo_volume_adaptive_options, progress_user, 152);

SIZE(azulejo_volume_inside_report, 56);
FIELD(azulejo_volume_inside_report, struct_size, 0);
FIELD(azulejo_volume_inside_report, reserved, 4);
FIELD(azulejo_volume_inside_report, samples, 8);
FIELD(azulejo_volume_inside_report, surface_samples, 16);
FIELD(azulejo_volume_inside_report, radius, 24);
FIELD(azulejo_volume_inside_report, covering_radius, 32);
FIELD(azulejo_volume_inside_report, depth, 40);
FIELD(azulejo_volume_inside_report, seconds, 48);
SIZE(azulejo_mask_options, 64);
FIELD(azulejo_mask_options, struct_size, 0);
FIELD(azulejo_mask_options, channels, 4);
FIELD(azulejo_mask_options, width, 8);
FIELD(azulejo_mask_options, height, 16);
FIELD(azulejo_mask_options, depth, 24);
FIELD(azulejo_mask_options, seed, 32);
FIELD(azulejo_mask_options, sigma, 40);
FIELD(azulejo_mask_options, progress, 48);
FIELD(azulejo_mask_options, progress_user, 56);

SIZE(azulejo_mask_report, 32);
FIELD(azulejo_mask_report, struct_size, 0);
FIELD(azulejo_mask_report, reserved, 4);
FIELD(azulejo_mask_report, pixels, 8);
FIELD(azulejo_mask_report, moves, 16);
FIELD(azulejo_mask_report, seconds, 24);

SIZE(azulejo_thin_report, 32);
FIELD(azulejo_thin_report, struct_size, 0);
FIELD(azulejo_thin_report, reserved, 4);
FIELD(azulejo_thin_report, samples, 8);
FIELD(azulejo_thin_report, radius, 16);
FIELD(azulejo_thin_report, seconds, 24);

SIZE(azulejo_kdrt_merge_piece, 48);
FIELD(azulejo_kdrt_merge_piece, positions, 0);
FIELD(azulejo_kdrt_merge_piece, count, 8);
FIELD(azulejo_kdrt_merge_piece, min, 16);
FIELD(azulejo_kdrt_merge_piece, max, 32);

SIZE(azulejo_kdrt_merge_report, 32);
FIELD(azulejo_kdrt_merge_report, struct_size, 0);
FIELD(azulejo_kdrt_merge_report, reserved, 4);
FIELD(azulejo_kdrt_merge_report, kept, 8);
FIELD(azulejo_kdrt_merge_report, eliminated, 16);
FIELD(azulejo_kdrt_merge_report, inserted, 24);

SIZE(azulejo_psp_options, 112);
FIELD(azulejo_psp_options, struct_size, 0);
FIELD(azulejo_psp_options, iterations, 4);
FIELD(azulejo_psp_options, radius, 8);
FIELD(azulejo_psp_options, seed, 16);
FIELD(azulejo_psp_options, maximal, 24);
FIELD(azulejo_psp_options, priority, 28);
FIELD(azulejo_psp_options, engine, 32);
FIELD(azulejo_psp_options, order, 36);
FIELD(azulejo_psp_options, progress, 40);
FIELD(azulejo_psp_options, progress_user, 48);
FIELD(azulejo_psp_options, count, 56);
FIELD(azulejo_psp_options, quotient, 64);
FIELD(azulejo_psp_options, given_positions, 72);
FIELD(azulejo_psp_options, given_clearances, 80);
FIELD(azulejo_psp_options, given_count, 88);
FIELD(azulejo_psp_options, cosine, 96);
FIELD(azulejo_psp_options, projectors, 104);
FIELD(azulejo_psp_options, reserved, 108);

SIZE(azulejo_instance, 104);
FIELD(azulejo_instance, prototype, 0);
FIELD(azulejo_instance, reserved, 4);
FIELD(azulejo_instance, transform, 8);
SIZE(azulejo_embree_geometry, 32);
FIELD(azulejo_embree_geometry, geometry_id, 0);
FIELD(azulejo_embree_geometry, vertex_stride, 4);
FIELD(azulejo_embree_geometry, index_stride, 8);
FIELD(azulejo_embree_geometry, reserved, 12);
FIELD(azulejo_embree_geometry, vertex_count, 16);
FIELD(azulejo_embree_geometry, triangle_count, 24);

SIZE(azulejo_psp_report, 144);
FIELD(azulejo_psp_report, struct_size, 0);
FIELD(azulejo_psp_report, iterations, 4);
FIELD(azulejo_psp_report, samples, 8);
FIELD(azulejo_psp_report, accepted, 16);
FIELD(azulejo_psp_report, rays, 24);
FIELD(azulejo_psp_report, hits, 32);
FIELD(azulejo_psp_report, restart_conflicts, 40);
FIELD(azulejo_psp_report, darts, 48);
FIELD(azulejo_psp_report, conflicts, 56);
FIELD(azulejo_psp_report, seconds, 64);
FIELD(azulejo_psp_report, prepare_seconds, 72);
FIELD(azulejo_psp_report, project_seconds, 80);
FIELD(azulejo_psp_report, merge_seconds, 88);
FIELD(azulejo_psp_report, fill_seconds, 96);
FIELD(azulejo_psp_report, rho, 104);
FIELD(azulejo_psp_report, uncovered_before, 112);
FIELD(azulejo_psp_report, uncovered_after, 120);
FIELD(azulejo_psp_report, radius, 128);
FIELD(azulejo_psp_report, covering_radius, 136);

SIZE(azulejo_psp_adaptive_options, 128);
FIELD(azulejo_psp_adaptive_options, struct_size, 0);
FIELD(azulejo_psp_adaptive_options, order, 4);
FIELD(azulejo_psp_adaptive_options, vertex_radii, 8);
FIELD(azulejo_psp_adaptive_options, vertex_count, 16);
FIELD(azulejo_psp_adaptive_options, radius_function, 24);
FIELD(azulejo_psp_adaptive_options, radius_function_user, 32);
FIELD(azulejo_psp_adaptive_options, smallest, 40);
FIELD(azulejo_psp_adaptive_options, largest, 48);
FIELD(azulejo_psp_adaptive_options, slope, 56);
FIELD(azulejo_psp_adaptive_options, cosine, 64);
FIELD(azulejo_psp_adaptive_options, seed, 72);
FIELD(azulejo_psp_adaptive_options, progress, 80);
FIELD(azulejo_psp_adaptive_options, progress_user, 88);
FIELD(azulejo_psp_adaptive_options, given_positions, 96);
FIELD(azulejo_psp_adaptive_options, given_clearances, 104);
FIELD(azulejo_psp_adaptive_options, given_count, 112);
FIELD(azulejo_psp_adaptive_options, quotient, 120);

SIZE(azulejo_dcr_options, 136);
FIELD(azulejo_dcr_options, struct_size, 0);
FIELD(azulejo_dcr_options, boundary, 4);
FIELD(azulejo_dcr_options, domain_min, 8);
FIELD(azulejo_dcr_options, domain_max, 24);
FIELD(azulejo_dcr_options, neighbourhood, 40);
FIELD(azulejo_dcr_options, method, 44);
FIELD(azulejo_dcr_options, max_iterations, 48);
FIELD(azulejo_dcr_options, reserved, 52);
FIELD(azulejo_dcr_options, seed, 56);
FIELD(azulejo_dcr_options, tolerance, 64);
FIELD(azulejo_dcr_options, progress, 72);
FIELD(azulejo_dcr_options, progress_user, 80);
FIELD(azulejo_dcr_options, conflict_radius, 88);
FIELD(azulejo_dcr_options, attraction_radius, 96);
FIELD(azulejo_dcr_options, step, 104);
FIELD(azulejo_dcr_options, decay, 112);
FIELD(azulejo_dcr_options, neighbours, 120);
FIELD(azulejo_dcr_options, distribution, 124);
FIELD(azulejo_dcr_options, visits, 128);
FIELD(azulejo_dcr_options, convergence, 132);

SIZE(azulejo_dcr_report, 48);
FIELD(azulejo_dcr_report, struct_size, 0);
FIELD(azulejo_dcr_report, iterations, 4);
FIELD(azulejo_dcr_report, stopped, 8);
FIELD(azulejo_dcr_report, reserved, 12);
FIELD(azulejo_dcr_report, motion, 16);
FIELD(azulejo_dcr_report, smallest_distance, 24);
FIELD(azulejo_dcr_report, rho, 32);
FIELD(azulejo_dcr_report, relative_covering_radius, 40);

SIZE(azulejo_density, 48);
FIELD(azulejo_density, struct_size, 0);
FIELD(azulejo_density, reserved, 4);
FIELD(azulejo_density, values, 8);
FIELD(azulejo_density, width, 16);
FIELD(azulejo_density, height, 24);
FIELD(azulejo_density, function, 32);
FIELD(azulejo_density, function_user, 40);

SIZE(azulejo_mesh_density, 120);
FIELD(azulejo_mesh_density, struct_size, 0);
FIELD(azulejo_mesh_density, at_vertices, 4);
FIELD(azulejo_mesh_density, vertex_values, 8);
FIELD(azulejo_mesh_density, vertex_count, 16);
FIELD(azulejo_mesh_density, function, 24);
FIELD(azulejo_mesh_density, function_user, 32);
FIELD(azulejo_mesh_density, largest, 40);
FIELD(azulejo_mesh_density, slope, 48);
FIELD(azulejo_mesh_density, image, 56);
FIELD(azulejo_mesh_density, width, 64);
FIELD(azulejo_mesh_density, height, 72);
FIELD(azulejo_mesh_density, texture, 80);
FIELD(azulejo_mesh_density, texture_count, 88);
FIELD(azulejo_mesh_density, by_corners, 96);
FIELD(azulejo_mesh_density, reserved, 100);
FIELD(azulejo_mesh_density, radius, 104);
FIELD(azulejo_mesh_density, count, 112);

SIZE(azulejo_dcr_surface_options, 48);
FIELD(azulejo_dcr_surface_options, struct_size, 0);
FIELD(azulejo_dcr_surface_options, max_iterations, 4);
FIELD(azulejo_dcr_surface_options, tolerance, 8);
FIELD(azulejo_dcr_surface_options, seed, 16);
FIELD(azulejo_dcr_surface_options, progress, 24);
FIELD(azulejo_dcr_surface_options, progress_user, 32);
FIELD(azulejo_dcr_surface_options, density, 40);

SIZE(azulejo_dcr_surface_report, 40);
FIELD(azulejo_dcr_surface_report, struct_size, 0);
FIELD(azulejo_dcr_surface_report, iterations, 4);
FIELD(azulejo_dcr_surface_report, stopped, 8);
FIELD(azulejo_dcr_surface_report, reserved, 12);
FIELD(azulejo_dcr_surface_report, motion, 16);
FIELD(azulejo_dcr_surface_report, smallest_distance, 24);
FIELD(azulejo_dcr_surface_report, rho, 32);

SIZE(azulejo_volume_relax_options, 96);
FIELD(azulejo_volume_relax_options, struct_size, 0);
FIELD(azulejo_volume_relax_options, boundary, 4);
FIELD(azulejo_volume_relax_options, domain_min, 8);
FIELD(azulejo_volume_relax_options, domain_max, 32);
FIELD(azulejo_volume_relax_options, max_iterations, 56);
FIELD(azulejo_volume_relax_options, reserved, 60);
FIELD(azulejo_volume_relax_options, seed, 64);
FIELD(azulejo_volume_relax_options, tolerance, 72);
FIELD(azulejo_volume_relax_options, progress, 80);
FIELD(azulejo_volume_relax_options, progress_user, 88);

SIZE(azulejo_relax_inside_options, 72);
FIELD(azulejo_relax_inside_options, struct_size, 0);
FIELD(azulejo_relax_inside_options, max_iterations, 4);
FIELD(azulejo_relax_inside_options, seed, 8);
FIELD(azulejo_relax_inside_options, tolerance, 16);
FIELD(azulejo_relax_inside_options, progress, 24);
FIELD(azulejo_relax_inside_options, progress_user, 32);
FIELD(azulejo_relax_inside_options, fixed, 40);
FIELD(azulejo_relax_inside_options, fixed_count, 48);
FIELD(azulejo_relax_inside_options, sliding, 56);
FIELD(azulejo_relax_inside_options, sliding_count, 64);

SIZE(azulejo_volume_relax_report, 40);
FIELD(azulejo_volume_relax_report, struct_size, 0);
FIELD(azulejo_volume_relax_report, iterations, 4);
FIELD(azulejo_volume_relax_report, stopped, 8);
FIELD(azulejo_volume_relax_report, reserved, 12);
FIELD(azulejo_volume_relax_report, motion, 16);
FIELD(azulejo_volume_relax_report, smallest_distance, 24);
FIELD(azulejo_volume_relax_report, rho, 32);

SIZE(azulejo_dcr_remesh_report, 104);
FIELD(azulejo_dcr_remesh_report, struct_size, 0);
FIELD(azulejo_dcr_remesh_report, reserved, 4);
FIELD(azulejo_dcr_remesh_report, triangles, 8);
FIELD(azulejo_dcr_remesh_report, disputed, 16);
FIELD(azulejo_dcr_remesh_report, left_out, 24);
FIELD(azulejo_dcr_remesh_report, boundary_edges, 32);
FIELD(azulejo_dcr_remesh_report, inner_edges, 40);
FIELD(azulejo_dcr_remesh_report, non_manifold_edges, 48);
FIELD(azulejo_dcr_remesh_report, non_manifold_vertices, 56);
FIELD(azulejo_dcr_remesh_report, unused_vertices, 64);
FIELD(azulejo_dcr_remesh_report, euler, 72);
FIELD(azulejo_dcr_remesh_report, smallest_angle, 80);
FIELD(azulejo_dcr_remesh_report, largest_angle, 88);
FIELD(azulejo_dcr_remesh_report, mean_smallest_angle, 96);

SIZE(azulejo_coverage_report, 24);
FIELD(azulejo_coverage_report, struct_size, 0);
FIELD(azulejo_coverage_report, reserved, 4);
FIELD(azulejo_coverage_report, covering_radius, 8);
FIELD(azulejo_coverage_report, gaps, 16);

SIZE(azulejo_space_report, 72);
FIELD(azulejo_space_report, struct_size, 0);
FIELD(azulejo_space_report, reserved, 4);
FIELD(azulejo_space_report, count, 8);
FIELD(azulejo_space_report, smallest_distance, 16);
FIELD(azulejo_space_report, mean_distance, 24);
FIELD(azulejo_space_report, conflicts, 32);
FIELD(azulejo_space_report, packed_distance, 40);
FIELD(azulejo_space_report, rho, 48);
FIELD(azulejo_space_report, covering_radius, 56);
FIELD(azulejo_space_report, relative_covering_radius, 64);

SIZE(azulejo_plane_report, 128);
FIELD(azulejo_plane_report, struct_size, 0);
FIELD(azulejo_plane_report, reserved, 4);
FIELD(azulejo_plane_report, count, 8);
FIELD(azulejo_plane_report, smallest_distance, 16);
FIELD(azulejo_plane_report, mean_distance, 24);
FIELD(azulejo_plane_report, hexagonal_distance, 32);
FIELD(azulejo_plane_report, rho, 40);
FIELD(azulejo_plane_report, covering_radius, 48);
FIELD(azulejo_plane_report, bond_order, 56);
FIELD(azulejo_plane_report, triangles, 64);
FIELD(azulejo_plane_report, obtuse, 72);
FIELD(azulejo_plane_report, below_30_degrees, 80);
FIELD(azulejo_plane_report, edge_mean, 88);
FIELD(azulejo_plane_report, edge_variation, 96);
FIELD(azulejo_plane_report, area_variation, 104);
FIELD(azulejo_plane_report, angles_below_30_degrees, 112);
FIELD(azulejo_plane_report, beyond_4_sigma, 120);

SIZE(azulejo_annulus, 32);
FIELD(azulejo_annulus, frequency, 0);
FIELD(azulejo_annulus, power, 8);
FIELD(azulejo_annulus, anisotropy, 16);
FIELD(azulejo_annulus, count, 24);

SIZE(azulejo_spectrum_report, 72);
FIELD(azulejo_spectrum_report, struct_size, 0);
FIELD(azulejo_spectrum_report, reserved, 4);
FIELD(azulejo_spectrum_report, frequency_step, 8);
FIELD(azulejo_spectrum_report, effective_nyquist, 24);
FIELD(azulejo_spectrum_report, oscillation, 32);
FIELD(azulejo_spectrum_report, contrast, 40);
FIELD(azulejo_spectrum_report, peak, 48);
FIELD(azulejo_spectrum_report, peak_frequency, 56);

CONSTANT(AZULEJO_OK, 0);
CONSTANT(AZULEJO_ERROR_INVALID_ARGUMENT, -1);
CONSTANT(AZULEJO_ERROR_TOO_LARGE, -2);
CONSTANT(AZULEJO_ERROR_IO, -3);
CONSTANT(AZULEJO_ERROR_FORMAT, -4);
CONSTANT(AZULEJO_ERROR_CANCELLED, -5);
CONSTANT(AZULEJO_ERROR_OUT_OF_MEMORY, -6);
CONSTANT(AZULEJO_ERROR_EMBREE, -7);
CONSTANT(AZULEJO_ERROR_THREADS, -8);
CONSTANT(AZULEJO_ERROR_BUSY, -9);
CONSTANT(AZULEJO_ERROR_UNSUPPORTED, -10);
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
CONSTANT(AZULEJO_METHOD_MOMENTUM, 0);
CONSTANT(AZULEJO_METHOD_THESIS, 1);
CONSTANT(AZULEJO_STOPPED_CONVERGED, 0);
CONSTANT(AZULEJO_STOPPED_STEPS, 1);
CONSTANT(AZULEJO_STOPPED_CANCELLED, 2);
CONSTANT(AZULEJO_PRIORITY_SQUARENESS, 0);
CONSTANT(AZULEJO_PRIORITY_PROJECTOR, 1);
CONSTANT(AZULEJO_ENGINE_EMBREE, 0);
CONSTANT(AZULEJO_ENGINE_RASTERISER, 1);
CONSTANT(AZULEJO_ENGINE_AUTO, 2);
CONSTANT(AZULEJO_PROJECTORS_LOCAL, 0);
CONSTANT(AZULEJO_PROJECTORS_GLOBAL, 1);

/* The fixed signatures: assignments that compile only if they are these. */
static void signatures(void) {
    azulejo_status (*context_create)(uint32_t, azulejo_context **) = azulejo_context_create;
    azulejo_status (*kdrt_sample)(const azulejo_context *, const azulejo_kdrt_options *, azulejo_points **,
                                  azulejo_kdrt_report *) = azulejo_kdrt_sample;
    azulejo_status (*kdrt_sample_window)(const azulejo_context *, const azulejo_kdrt_options *, const double *,
                                         const double *, azulejo_points **, azulejo_kdrt_report *) =
        azulejo_kdrt_sample_window;
    azulejo_status (*kdrt_create)(const azulejo_context *, const azulejo_kdrt_options *, azulejo_kdrt **) =
        azulejo_kdrt_create;
    azulejo_status (*kdrt_create_wide)(const azulejo_context *, const azulejo_kdrt_options *, azulejo_kdrt **) =
        azulejo_kdrt_create_wide;
    azulejo_status (*kdrt_window)(const azulejo_kdrt *, const double *, const double *, azulejo_points **) =
        azulejo_kdrt_window;
    azulejo_status (*kdrt_window_into)(const azulejo_kdrt *, const double *, const double *, float *, float *, uint32_t *,
                                       size_t, size_t *) = azulejo_kdrt_window_into;
    azulejo_status (*kdrt_window_capacity)(const azulejo_kdrt *, const double *, size_t *) =
        azulejo_kdrt_window_capacity;
    double (*kdrt_unit)(const azulejo_kdrt *) = azulejo_kdrt_unit;
    void (*kdrt_free)(azulejo_kdrt *) = azulejo_kdrt_free;
    azulejo_status (*kdrt_stream)(const azulejo_context *, const azulejo_kdrt_options *,
                                  uint32_t (*)(void *, const float *, size_t), void *, azulejo_kdrt_report *) =
        azulejo_kdrt_stream;
    azulejo_status (*kdrt_merge)(const azulejo_context *, const azulejo_kdrt_merge_options *,
                                 const azulejo_kdrt_merge_piece *, size_t, size_t, const float *, size_t,
                                 azulejo_points **, azulejo_kdrt_merge_report *) =
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
    azulejo_status (*psp_sample_instances)(const azulejo_context *, const azulejo_mesh *const *, size_t,
                                           const azulejo_instance *, size_t, size_t, const azulejo_psp_options *,
                                           azulejo_points **, azulejo_psp_report *) = azulejo_psp_sample_instances;
    azulejo_status (*psp_sample_classes)(const azulejo_context *, const azulejo_mesh *, const azulejo_psp_options *,
                                         const azulejo_classes *, azulejo_points **, azulejo_classes_report *) =
        azulejo_psp_sample_classes;
    azulejo_status (*psp_classes_with_density)(const azulejo_context *, const azulejo_mesh *,
                                               const azulejo_psp_options *, const azulejo_classes *,
                                               const azulejo_mesh_density *, azulejo_points **,
                                               azulejo_classes_report *) = azulejo_psp_classes_with_density;
    azulejo_status (*psp_adaptive_sample)(const azulejo_context *, const azulejo_mesh *,
                                          const azulejo_psp_adaptive_options *, azulejo_points **, azulejo_psp_report *) =
        azulejo_psp_adaptive_sample;
    azulejo_status (*dcr_relax)(const azulejo_context *, const azulejo_dcr_options *, const float *, size_t,
                                azulejo_points **, azulejo_dcr_report *) = azulejo_dcr_relax;
    azulejo_status (*dcr_relax_classes)(const azulejo_context *, const azulejo_dcr_options *, const float *,
                                        const uint32_t *, size_t, uint32_t, double *, double *,
                                        azulejo_points **, azulejo_dcr_report *) = azulejo_dcr_relax_classes;
    azulejo_status (*dcr_correlation_of_power)(double, const double *, size_t, double, size_t, double *) =
        azulejo_dcr_correlation_of_power;
    azulejo_status (*dcr_relax_to_correlation)(const azulejo_context *, const azulejo_dcr_options *, const float *, size_t,
                                               double, const double *, size_t, double *, azulejo_points **,
                                               azulejo_dcr_report *) = azulejo_dcr_relax_to_correlation;
    azulejo_status (*dcr_surface_relax)(const azulejo_context *, const azulejo_mesh *,
                                        const azulejo_dcr_surface_options *, const uint32_t *, const float *, size_t,
                                        azulejo_points **, azulejo_dcr_surface_report *) = azulejo_dcr_surface_relax;
    azulejo_status (*dcr_remesh)(const azulejo_context *, const azulejo_mesh *, const uint32_t *, const float *, size_t,
                                 azulejo_mesh **, azulejo_dcr_remesh_report *) = azulejo_dcr_remesh;
    azulejo_status (*volume_options_init)(azulejo_volume_options *, size_t) = azulejo_volume_options_init;
    azulejo_status (*volume_report_init)(azulejo_volume_report *, size_t) = azulejo_volume_report_init;
    azulejo_status (*volume_sample)(const azulejo_context *, const azulejo_volume_options *, azulejo_points **,
                                    azulejo_volume_report *) = azulejo_volume_sample;
    azulejo_status (*classes_in_space)(const azulejo_context *, const azulejo_volume_options *, const azulejo_classes *,
                                       azulejo_points **, azulejo_classes_report *) = azulejo_volume_sample_classes;
    azulejo_status (*volume_adaptive_init)(azulejo_volume_adaptive_options *, size_t) =
        azulejo_volume_adaptive_options_init;
    azulejo_status (*volume_adaptive)(const azulejo_context *, const azulejo_mesh *, const azulejo_volume_adaptive_options *,
                                      azulejo_points **, azulejo_volume_report *) = azulejo_volume_adaptive_sample;
    azulejo_status (*inside_options_init)(azulejo_volume_inside_options *, size_t) = azulejo_volume_inside_options_init;
    azulejo_status (*inside_report_init)(azulejo_volume_inside_report *, size_t) = azulejo_volume_inside_report_init;
    azulejo_status (*sample_inside)(const azulejo_context *, const azulejo_mesh *, const azulejo_volume_inside_options *,
                                    azulejo_points **, azulejo_volume_inside_report *) = azulejo_volume_sample_inside;
    azulejo_status (*relax_options_init)(azulejo_volume_relax_options *, size_t) = azulejo_volume_relax_options_init;
    azulejo_status (*relax_report_init)(azulejo_volume_relax_report *, size_t) = azulejo_volume_relax_report_init;
    azulejo_status (*volume_relax)(const azulejo_context *, const azulejo_volume_relax_options *, const float *, size_t,
                                   azulejo_points **, azulejo_volume_relax_report *) = azulejo_volume_relax;
    azulejo_status (*relax_inside_init)(azulejo_relax_inside_options *, size_t) =
        azulejo_relax_inside_options_init;
    azulejo_status (*relax_inside)(const azulejo_context *, const azulejo_mesh *,
                                   const azulejo_relax_inside_options *, const float *, size_t, azulejo_points **,
                                   azulejo_volume_relax_report *) = azulejo_volume_relax_inside;
    uint32_t (*mesh_is_closed)(const azulejo_mesh *) = azulejo_mesh_is_closed;
    azulejo_status (*mesh_contains)(const azulejo_context *, const azulejo_mesh *, const float *, size_t, uint8_t *) =
        azulejo_mesh_contains;
    azulejo_status (*mask_create)(const azulejo_context *, const azulejo_mask_options *, azulejo_mask **,
                                  azulejo_mask_report *) = azulejo_mask_create;
    size_t (*mask_size)(const azulejo_mask *, uint32_t) = azulejo_mask_size;
    const uint32_t *(*mask_ranks)(const azulejo_mask *) = azulejo_mask_ranks;
    azulejo_status (*mask_values)(const azulejo_mask *, float *) = azulejo_mask_values;
    azulejo_status (*mask_dither)(const azulejo_mask *, const float *, size_t, size_t, size_t, size_t, uint32_t,
                                  uint8_t *) = azulejo_mask_dither;
    azulejo_status (*mask_dither_bytes)(const azulejo_mask *, const uint8_t *, size_t, size_t, size_t, size_t, uint32_t,
                                        uint8_t *) = azulejo_mask_dither_bytes;
    void (*mask_free)(azulejo_mask *) = azulejo_mask_free;
    azulejo_status (*thin)(const azulejo_context *, const azulejo_thin_options *, const float *, size_t, uint32_t,
                           azulejo_selection **, azulejo_thin_report *) = azulejo_thin;
    size_t (*selection_count)(const azulejo_selection *) = azulejo_selection_count;
    const uint32_t *(*selection_indices)(const azulejo_selection *) = azulejo_selection_indices;
    const float *(*selection_ranks)(const azulejo_selection *) = azulejo_selection_ranks;
    void (*selection_free)(azulejo_selection *) = azulejo_selection_free;
    azulejo_status (*plane_smallest_distance)(const azulejo_context *, const azulejo_plane_set *, double *) =
        azulejo_plane_smallest_distance;
    azulejo_status (*plane_covering_radius)(const azulejo_context *, const azulejo_plane_set *, double *) =
        azulejo_plane_covering_radius;
    azulejo_status (*plane_coverage)(const azulejo_context *, const azulejo_plane_set *, double,
                                     azulejo_coverage_report *) = azulejo_plane_coverage;
    azulejo_status (*plane_measure)(const azulejo_context *, const azulejo_plane_set *, azulejo_plane_report *) =
        azulejo_plane_measure;
    azulejo_status (*space_coverage)(const azulejo_context *, const azulejo_space_set *, double,
                                     azulejo_coverage_report *) = azulejo_space_coverage;
    azulejo_status (*space_measure)(const azulejo_context *, const azulejo_space_set *, double, azulejo_space_report *) =
        azulejo_space_measure;
    azulejo_status (*plane_nearest_histogram)(const azulejo_context *, const azulejo_plane_set *, double, size_t,
                                              uint64_t *) = azulejo_plane_nearest_histogram;
    azulejo_status (*plane_radial_distribution)(const azulejo_context *, const azulejo_plane_set *, double, size_t,
                                                double *) = azulejo_plane_radial_distribution;
    azulejo_status (*space_radial_distribution)(const azulejo_context *, const azulejo_space_set *, double, size_t,
                                                double *) = azulejo_space_radial_distribution;
    azulejo_status (*space_spectrum)(const azulejo_context *, const azulejo_space_set *, double, uint32_t, double,
                                     azulejo_annulus *, size_t, size_t, size_t *) = azulejo_space_spectrum;
    azulejo_status (*space_axis_power)(const azulejo_context *, const azulejo_space_set *, uint32_t, size_t, double *) =
        azulejo_space_axis_power;
    azulejo_status (*spectrum_create)(const azulejo_context *, const azulejo_plane_set *, uint32_t, uint32_t,
                                      azulejo_spectrum **) = azulejo_spectrum_create;
    const char *(*status_name)(azulejo_status) = azulejo_status_name;
    size_t (*last_error_message)(char *, size_t) = azulejo_last_error_message;
    CHECK(context_create && kdrt_sample && mesh_create && mesh_load && psp_create && psp_advance && psp_fill);
    CHECK(psp_points && psp_sample && psp_sample_classes && psp_sample_instances && psp_classes_with_density && dcr_relax && dcr_relax_classes && dcr_correlation_of_power && dcr_relax_to_correlation && last_error_message && kdrt_sample_window && kdrt_stream);
    CHECK(dcr_remesh && kdrt_merge && dcr_surface_relax && status_name);
    CHECK(plane_smallest_distance && plane_covering_radius && plane_coverage);
    CHECK(space_coverage && space_measure && space_radial_distribution && space_spectrum && space_axis_power);
    CHECK(relax_options_init && relax_report_init && volume_relax && relax_inside_init && relax_inside);
    CHECK(plane_measure && plane_nearest_histogram && plane_radial_distribution && spectrum_create);
    CHECK(mesh_with_normals && mesh_with_mask);
    CHECK(psp_adaptive_sample && kdrt_create && kdrt_window && kdrt_free);
    CHECK(kdrt_create_wide && kdrt_window_into && kdrt_window_capacity && kdrt_unit);
    CHECK(volume_options_init && volume_report_init && volume_sample && classes_in_space);
    CHECK(volume_adaptive_init && volume_adaptive);
    CHECK(inside_options_init && inside_report_init && sample_inside && mesh_is_closed && mesh_contains);
    CHECK(mask_create && mask_size && mask_ranks && mask_values && mask_dither && mask_dither_bytes && mask_free);
    CHECK(thin && selection_count && selection_indices && selection_ranks && selection_free);
}

int main(void) {
    signatures();
    CHECK(AZULEJO_VERSION_MAJOR == 0 && AZULEJO_VERSION_MINOR == 3); /* the numbers in the SONAME */
    CHECK(AZULEJO_VERSION == AZULEJO_VERSION_MAJOR * 10000 + AZULEJO_VERSION_MINOR * 100 + AZULEJO_VERSION_PATCH);
    return finish();
}
