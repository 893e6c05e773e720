/* Volumes: maximal Poisson-disk sets of cuboids and inside meshes, and their relaxation.
 * Generated from ffi/azulejo-c by cbindgen; do not edit. The conventions are in azulejo.h. */

#ifndef AZULEJO_VOLUME_H
#define AZULEJO_VOLUME_H

#include "base.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Options of azulejo_volume_sample.
typedef struct azulejo_volume_options {
    uint32_t struct_size; ///< The size of the struct in bytes; set by the _init function.
    uint32_t boundary; ///< An AZULEJO_BOUNDARY_ constant; default periodic.
    /// Above 0, and at least 64 float spacings; it has no default. With a `count` it must be 0.
    double radius;
    double domain_min[3]; ///< The lower corner of the domain, x y z; default 0 0 0.
    double domain_max[3]; ///< The upper one, as in azulejo_space_set; default 1 1 1.
    uint64_t seed; ///< Any number; another seed gives another set. Default 0.
    azulejo_progress_fn progress; ///< Default NULL: the callback of the context, if it has one.
    void *progress_user; ///< Passed to the progress callback.
    size_t count; ///< The exact number of samples; default 0: as many as the radius gives.
    uint32_t order; ///< An AZULEJO_ORDER_ constant; default any.
    uint32_t reserved; ///< Always 0.
    double quotient; ///< 1.02 to 1.5; default 0: see "Order" in azulejo.h.
    const float *given_positions; ///< Default NULL: see "Given samples" in azulejo.h.
    const double *given_clearances; ///< The clearance of each; default NULL.
    size_t given_count; ///< The number of given samples; default 0.
    double leaf_size; ///< The shortest side of tiles in radii, 6 or more; default 0: not tiled.
} azulejo_volume_options;

/// The report of azulejo_volume_sample.
typedef struct azulejo_volume_report {
    uint32_t struct_size; ///< The size of the struct in bytes; set by the _init function.
    uint32_t reserved; ///< Always 0.
    uint64_t samples; ///< The number of samples.
    double radius; ///< No two samples are nearer: the radius, also that of the set of a count.
    double seconds; ///< Wall time in seconds.
    /// No place of the domain is farther from all samples and outside of all given ones, up to
    /// the tolerance: the radius, with a count mostly up to 1.1 times it.
    double covering_radius;
} azulejo_volume_report;

azulejo_status azulejo_volume_options_init(azulejo_volume_options *options,
                                           size_t struct_size);

azulejo_status azulejo_volume_report_init(azulejo_volume_report *report, size_t struct_size);

/// Makes a maximal, conflict-free set of samples of a cuboid, x y z each: no place of it is farther
/// from every sample than the radius and 3.5 float spacings. On a torus about 0.7336 * volume /
/// radius^3 samples, up to 0.3 % more than by darts that are thrown one after the other; a bounded
/// cuboid has more, since samples stand on its faces. If a period of a torus is below the radius, a
/// sample does not conflict with its own image. Samples are sorted by blocks of 9 to 18 radii.
///
/// Around given samples the tolerance is 7 float spacings, in progressive order 9.
/// - O(samples) time and memory. Source: Ebeida et al. 2012.
azulejo_status azulejo_volume_sample(const azulejo_context *context,
                                     const azulejo_volume_options *options,
                                     azulejo_points **out,
                                     azulejo_volume_report *report);

/// Makes samples of several classes in a cuboid, as azulejo_classes says, up to 7 float spacings.
/// They are sorted by class. O(samples). Options: domain, boundary, seed, given samples, progress.
azulejo_status azulejo_volume_sample_classes(const azulejo_context *context,
                                             const azulejo_volume_options *options,
                                             const azulejo_classes *classes,
                                             azulejo_points **out,
                                             azulejo_classes_report *report);

#define AZULEJO_SURFACE_OPEN 0 ///< Samples lie anywhere inside.

/// A maximal set of the surface comes first, and the inside is filled around it.
#define AZULEJO_SURFACE_FIRST 1

/// Options of azulejo_volume_sample_inside.
typedef struct azulejo_volume_inside_options {
    uint32_t struct_size; ///< The size of the struct in bytes; set by the _init function.
    /// An AZULEJO_SURFACE_ constant; default open. `first` takes a radius, and any order.
    uint32_t surface;
    double radius; ///< Above 0, and at least 64 float spacings; has no default. 0 with a `count`.
    /// Places inside may stay open that are nearer to the surface than sqrt(3) times this many
    /// radii: 1/256 to 1/2; default 0.0625. A smaller one takes longer.
    double tolerance;
    uint64_t seed; ///< Default 0.
    azulejo_progress_fn progress; ///< Default NULL: the callback of the context, if it has one.
    void *progress_user; ///< Passed to the progress callback.
    size_t count; ///< The exact number of samples; default 0: as many as the radius gives.
    uint32_t order; ///< An AZULEJO_ORDER_ constant; default any.
    uint32_t reserved; ///< Always 0.
    double quotient; ///< 1.02 to 1.5; default 0: see "Order" in azulejo.h.
    const float *given_positions; ///< Default NULL: see "Given samples" in azulejo.h.
    const double *given_clearances; ///< The clearance of each; default NULL.
    size_t given_count; ///< Their number; default 0.
    double thickness; ///< Only places this near the surface, at least 1/256 radius; default 0: all.
} azulejo_volume_inside_options;

/// The report of azulejo_volume_sample_inside.
typedef struct azulejo_volume_inside_report {
    uint32_t struct_size; ///< The size of the struct in bytes; set by the _init function.
    uint32_t reserved; ///< Always 0.
    uint64_t samples; ///< The number of samples.
    uint64_t surface_samples; ///< The number of samples of the surface, which come first.
    double radius; ///< No two samples are nearer: the radius, also that of the set of a count.
    /// No place inside that is deeper than `depth` is farther from all samples and outside of all
    /// given ones: the radius, with a count mostly up to 1.1 times it.
    double covering_radius;
    double depth; ///< Places this near to the surface, or a shell's inner border, can be open.
    double seconds; ///< Wall time in seconds.
} azulejo_volume_inside_report;

azulejo_status azulejo_volume_inside_options_init(azulejo_volume_inside_options *options,
                                                  size_t struct_size);

azulejo_status azulejo_volume_inside_report_init(azulejo_volume_inside_report *report,
                                                 size_t struct_size);

/// Makes a maximal, conflict-free set of samples inside a mesh that encloses something, x y z each:
/// no place inside is farther from every sample than the radius and 7 float spacings, unless it is
/// nearer to the surface, or a shell's inner border, than the report's `depth`. Holes are closed by
/// caps, about where the winding number is 1/2, which count as surface. No sample is outside but
/// those of the surface without caps, which azulejo_psp_sample makes with the same radius and seed.
/// The result has positions only. Count, order, given samples: as in azulejo_volume_sample.
/// - O(samples) time and memory, and O(triangles * log triangles) for the first call on a mesh.
azulejo_status azulejo_volume_sample_inside(const azulejo_context *context,
                                            const azulejo_mesh *mesh,
                                            const azulejo_volume_inside_options *options,
                                            azulejo_points **out,
                                            azulejo_volume_inside_report *report);

/// 1 if an even number of triangles shares each edge of the mesh, so that it has an inside, else 0.
/// The direction of triangles does not matter, nor do intersections; vertices at one place are one.
/// O(triangles) the first time.
uint32_t azulejo_mesh_is_closed(const azulejo_mesh *mesh);

/// Writes to `inside` for each of `count` points, x y z each, 1 if it is inside the mesh, else 0.
/// Inside of a closed mesh are the points whose ray along +x crosses an odd number of triangles,
/// without rounding: meshes that share a face share no point. In any other mesh the generalised
/// winding number is at least 1/2, or at most -1/2, up to .02 if the boundary has more than 2,048
/// edges. O(triangles * log triangles) the first time, then about O(log triangles) for a point.
azulejo_status azulejo_mesh_contains(const azulejo_context *context,
                                     const azulejo_mesh *mesh,
                                     const float *positions,
                                     size_t count,
                                     uint8_t *inside);

/// Options of azulejo_volume_adaptive_sample, which requires `grid_values` or `radius_function`.
typedef struct azulejo_volume_adaptive_options {
    uint32_t struct_size; ///< The size of the struct in bytes; set by the _init function.
    uint32_t boundary; ///< An AZULEJO_BOUNDARY_ constant; default periodic. Not inside a mesh.
    double domain_min[3]; ///< The lower corner, x y z; default 0 0 0. Not inside a mesh.
    double domain_max[3]; ///< The upper corner; default 1 1 1. Not inside a mesh.
    const float *grid_values; ///< Radii above 0, x fastest, then y. Default NULL.
    size_t grid_size[3]; ///< Their number along x, y, z: at least 1 1 1. Default 0 0 0: no grid.
    azulejo_radius_fn radius_function; ///< Instead of a grid. Default NULL.
    void *radius_function_user; ///< Passed to `radius_function`.
    double smallest; ///< The smallest value of `radius_function`, above 0. Default 0: no function.
    double largest; ///< Its largest value. Default 0.
    double slope; ///< As in azulejo_psp_adaptive_options; default 0.
    double tolerance; ///< Of the inside of a mesh, in radii: 1/256 to 1/2; default 0.0625.
    uint64_t seed; ///< Any number; another seed gives another set. Default 0.
    azulejo_progress_fn progress; ///< Default NULL: the callback of the context, if it has one.
    void *progress_user; ///< Passed to the progress callback.
} azulejo_volume_adaptive_options;

azulejo_status azulejo_volume_adaptive_options_init(azulejo_volume_adaptive_options *options,
                                                    size_t struct_size);

/// Makes a maximal set of samples, each with a radius of its own (azulejo_points_radii), of a
/// cuboid or, unless `mesh` is NULL, inside a mesh. Rule and errors are those of
/// azulejo_psp_adaptive_sample, the tolerance that of azulejo_volume_sample, inside a mesh with
/// the radius of the place, and the change of the radius over it. A grid lies over the cuboid or
/// the box around the mesh, its first and last radii on the faces, linear along each axis. A
/// function is called some 60 times a sample; its slope need not hold across the seam of a torus.
/// The report has the least radius of a sample, and the largest that there can be. O(samples) time
/// and memory for slopes below about 1.
azulejo_status azulejo_volume_adaptive_sample(const azulejo_context *context,
                                              const azulejo_mesh *mesh,
                                              const azulejo_volume_adaptive_options *options,
                                              azulejo_points **out,
                                              azulejo_volume_report *report);

/// Options of azulejo_volume_relax.
typedef struct azulejo_volume_relax_options {
    uint32_t struct_size; ///< The size of the struct in bytes; set by the _init function.
    uint32_t boundary; ///< An AZULEJO_BOUNDARY_ constant; default periodic.
    double domain_min[3]; ///< The lower corner of the domain, x y z; default 0 0 0.
    double domain_max[3]; ///< The upper corner, as in azulejo_space_set; default 1 1 1.
    /// The most steps; default 100. 0 returns the points as they are. Forces depend on it.
    uint32_t max_iterations;
    uint32_t reserved; ///< Must be 0.
    uint64_t seed; ///< It parts coincident points and moves clustered ones; default 0.
    /// The motion (see the report) at which the set has converged; 0 makes all steps. Any negative
    /// number, such as the default -1, selects 0.001.
    double tolerance;
    azulejo_progress_fn progress; ///< Default NULL: the callback of the context, if it has one.
    void *progress_user; ///< Passed to the progress callback.
} azulejo_volume_relax_options;

/// The report of both relaxations. d_fcc is the distance of neighbours in the densest packing,
/// the face-centred cubic one, of as many points in the volume: (sqrt(2) volume / count)^(1/3).
typedef struct azulejo_volume_relax_report {
    uint32_t struct_size; ///< The size of the struct in bytes; set by the _init function.
    uint32_t iterations; ///< The steps made.
    uint32_t stopped; ///< Why no more steps were made: an AZULEJO_STOPPED_ constant.
    uint32_t reserved; ///< Always 0.
    /// Half of the distance that points moved over the last 10 steps, root mean square, in d_fcc.
    double motion;
    double smallest_distance; ///< The smallest distance; infinite for fewer than two points.
    double rho; ///< The same in d_fcc: about 0.80 for a maximal set, 0.94 for a relaxed one.
} azulejo_volume_relax_report;

/// Options of azulejo_volume_relax_inside; as those of azulejo_volume_relax.
typedef struct azulejo_relax_inside_options {
    uint32_t struct_size; ///< The size of the struct in bytes; set by the _init function.
    uint32_t max_iterations; ///< Default 100.
    uint64_t seed; ///< Default 0.
    double tolerance; ///< Default -1: 0.001.
    azulejo_progress_fn progress; ///< Default NULL: the callback of the context, if it has one.
    void *progress_user; ///< Passed to the progress callback.
    /// One byte per point: any value but 0 keeps it where it is. Default NULL: none stays.
    const uint8_t *fixed;
    size_t fixed_count; ///< 0, the default, for none, or the number of points.
    const uint8_t *sliding; ///< Likewise: it stays on the surface. Default NULL: none.
    size_t sliding_count; ///< Default 0, as fixed_count.
} azulejo_relax_inside_options;

azulejo_status azulejo_volume_relax_options_init(azulejo_volume_relax_options *options,
                                                 size_t struct_size);

azulejo_status azulejo_volume_relax_report_init(azulejo_volume_relax_report *report,
                                                size_t struct_size);

/// Relaxes points of a cuboid: they push each other away until the set has converged or all steps
/// are made, with which the call succeeds as well. From random points 100 steps end at a rho of
/// about 0.94. Lattices do not stay. Points that are clustered are redistributed over the cuboid
/// before the first step. A periodic domain wraps, a bounded one has walls.
/// - positions: the points, x y z each, in domain_min <= x < domain_max.
/// - out: after the last whole step, in the same order; positions only.
/// - O(count) time for each step, and O(count) memory. Source: thesis chapter 4, in space.
azulejo_status azulejo_volume_relax(const azulejo_context *context,
                                    const azulejo_volume_relax_options *options,
                                    const float *positions,
                                    size_t count,
                                    azulejo_points **out,
                                    azulejo_volume_relax_report *report);

azulejo_status azulejo_relax_inside_options_init(azulejo_relax_inside_options *options,
                                                 size_t struct_size);

/// Relaxes points inside a mesh, as azulejo_volume_relax does in a bounded domain. None leaves the
/// inside (azulejo_volume_sample_inside). Clustered ones are not redistributed.
/// positions: those that are fixed in the box around the mesh, those that slide on its surface.
azulejo_status azulejo_volume_relax_inside(const azulejo_context *context,
                                           const azulejo_mesh *mesh,
                                           const azulejo_relax_inside_options *options,
                                           const float *positions,
                                           size_t count,
                                           azulejo_points **out,
                                           azulejo_volume_relax_report *report);

#ifdef __cplusplus
}
#endif

#endif
