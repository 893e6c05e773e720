/* PSP: maximal Poisson-disk sets on triangle meshes, also with a radius that varies.
 * Generated from ffi/azulejo-c by cbindgen; do not edit. The conventions are in azulejo.h. */

#ifndef AZULEJO_PSP_H
#define AZULEJO_PSP_H

#include "base.h"

#ifdef __cplusplus
extern "C" {
#endif

/// The report of a call that samples a mesh. Times are wall times.
typedef struct azulejo_psp_report {
    uint32_t struct_size; ///< The size of the struct in bytes; set by the _init function.
    uint32_t iterations; ///< The iterations that the call made.
    uint64_t samples; ///< The samples of the set after the call.
    uint64_t accepted; ///< The samples that the call added.
    /// The rays that meet the box of the mesh, or the points of those tiles of the rasteriser, at
    /// most 48 radii wide, that have triangles near them.
    uint64_t rays;
    uint64_t hits; ///< The places where rays met the mesh.
    uint64_t restart_conflicts; ///< The hits rejected because of an earlier one on the same ray.
    uint64_t darts; ///< The darts thrown into uncovered surface.
    uint64_t conflicts; ///< The hits and darts rejected because of other samples.
    double seconds; ///< The time of the call in seconds.
    /// The part of it in which patterns and, for Embree, the scene were made.
    double prepare_seconds;
    double project_seconds; ///< The part of it in which hits were found.
    double merge_seconds; ///< The part of it in which samples were chosen among the hits.
    double fill_seconds; ///< The part of it in which gaps were searched for and filled.
    /// The radius of the set in units of d_max: about 0.78 for a maximal set, 0 for no samples.
    double rho;
    /// If the call filled gaps: about the share of the area uncovered before. Else -1.
    double uncovered_before;
    double uncovered_after; ///< If the call filled gaps: 0, what is uncovered after it. Else -1.
    /// The radius of the set: the one asked for, or found for a count. No two samples are closer. 0
    /// where radii vary; in progressive order then the factor of radii, 1, or for a density the
    /// radius at density 1.
    double radius;
    /// A bound of the covering radius, up to 6 float spacings, or where `radius` is a factor of
    /// radii, of that factor: `radius` after a fill, a little more for a count. -1: unknown.
    double covering_radius;
} azulejo_psp_report;

azulejo_status azulejo_psp_report_init(azulejo_psp_report *report, size_t struct_size);

/// If two candidates of an iteration are too close, the one that its projector faces more squarely
/// is kept: the default, which finds more samples. Existing samples are always kept.
#define AZULEJO_PRIORITY_SQUARENESS 0

/// The candidate of the earlier projector is kept, as in the thesis (section 3.3.2).
#define AZULEJO_PRIORITY_PROJECTOR 1

/// A projector for every part of the mesh in a cube of 48 radii that faces about one direction.
#define AZULEJO_PROJECTORS_LOCAL 0

/// Three orthogonal projectors for the whole mesh in each iteration (thesis section 3.3.1).
#define AZULEJO_PROJECTORS_GLOBAL 1

#define AZULEJO_ENGINE_EMBREE 0 ///< Ray packets of Embree find where patterns meet the mesh.

/// Triangles are rasterised over the patterns (thesis section 3.4.3). With local projectors the
/// samples are Embree's, to the bit; with global ones hits differ by 2e-7 of its diagonal at most.
#define AZULEJO_ENGINE_RASTERISER 1

/// The default: the rasteriser for local projectors, which took the least time on every mesh
/// measured, and for global ones Embree where there is one.
#define AZULEJO_ENGINE_AUTO 2

/// The `iterations` of azulejo_psp_options that stand for a rule.
#define AZULEJO_ITERATIONS_DEFAULT 4294967295

/// A set of samples on a mesh that can grow. It keeps its context and mesh.
typedef struct azulejo_psp azulejo_psp;

/// Options of azulejo_psp_create and azulejo_psp_sample.
typedef struct azulejo_psp_options {
    uint32_t struct_size; ///< The size of the struct in bytes; set by the _init function.
    /// The number of projections of patterns onto the whole mesh by azulejo_psp_sample, before it
    /// fills the gaps. AZULEJO_ITERATIONS_DEFAULT, the default: 1 where the set is made sooner with
    /// it, by a rule of mesh, radius and given samples, or if `maximal` is 0, else 0. 0 with a
    /// `maximal` of 0 is refused. azulejo_psp_create refuses any value but the default.
    uint32_t iterations;
    /// The smallest straight distance between two samples: above 0, and at least 64 float spacings;
    /// it has no default. With a `count` it must be 0.
    double radius;
    uint64_t seed; ///< Any number; another seed gives another set. Default 0.
    /// 1, the default: azulejo_psp_sample fills all gaps. 0: it stops after the iterations, as the
    /// thesis does, and leaves some per cent of the surface uncovered; not in azulejo_psp_create.
    uint32_t maximal;
    uint32_t priority; ///< An AZULEJO_PRIORITY_ constant; default squareness.
    uint32_t engine; ///< An AZULEJO_ENGINE_ constant; default auto.
    /// An AZULEJO_ORDER_ constant; default any. Progressive order refuses `iterations` above 0 and
    /// a `maximal` of 0. Must be any in azulejo_psp_create.
    uint32_t order;
    /// Default NULL: the callback of the context. A psp handle keeps it for all its calls.
    azulejo_progress_fn progress;
    void *progress_user; ///< Passed to the progress callback.
    /// The exact number of samples; default 0: as many as the radius gives. As in progressive order
    /// there are no iterations. Must be 0 in azulejo_psp_create.
    size_t count;
    double quotient; ///< 1.02 to 1.5; default 0: see "Order" in azulejo.h.
    const float *given_positions; ///< Default NULL: see "Given samples" in azulejo.h.
    const double *given_clearances; ///< The clearance of each; default NULL.
    size_t given_count; ///< The number of given samples; default 0.
    /// Samples on triangles whose normals have a smaller cosine than this ignore each other, so
    /// that the two sides of a thin wall are sampled as if far apart; triangles must be wound
    /// consistently. From -1, the default, which turns it off, to 1, with which only samples with
    /// the same normal see each other. Given samples act on all sides. Above -1 no iterations.
    double cosine;
    uint32_t projectors; ///< An AZULEJO_PROJECTORS_ constant; default local.
    uint32_t reserved; ///< Must be 0.
} azulejo_psp_options;

azulejo_status azulejo_psp_options_init(azulejo_psp_options *options, size_t struct_size);

/// Makes an empty set on a mesh. It does not report progress.
/// - options: `iterations`, `maximal`, `count` and `order` must have their defaults.
/// - O(triangles + given samples) time at most.
/// - Errors: AZULEJO_ERROR_TOO_LARGE has the estimated number of samples without given ones.
azulejo_status azulejo_psp_create(const azulejo_context *context,
                                  const azulejo_mesh *mesh,
                                  const azulejo_psp_options *options,
                                  azulejo_psp **out);

/// Adds samples: projects patterns of samples onto the mesh, in each iteration along three
/// orthogonal directions of a random frame, and keeps what does not conflict with the set (thesis
/// chapter 3). Two calls add what one call with the sum of their iterations adds.
/// - iterations: how many, 0 or more. A set that has been edited makes none. None is made, nor
///   reported, where the box of the mesh is out of all proportion to its surface: above 20 rays per
///   sample that there is room for and 10 million in all.
/// - O((diagonal of the mesh / radius)^2 + hits) time for each iteration, and for the first one
///   O(triangles * log triangles).
/// - Errors: AZULEJO_ERROR_INVALID_ARGUMENT also for a `cosine` above -1; AZULEJO_ERROR_EMBREE;
///   AZULEJO_ERROR_CANCELLED: the set then holds what was finished, and can still grow.
azulejo_status azulejo_psp_advance(azulejo_psp *psp,
                                   uint32_t iterations,
                                   azulejo_psp_report *report);

/// Makes the set maximal: finds the parts of the surface that are farther than the radius from
/// every sample and throws darts into them until there is none. A set that has been edited is
/// filled as by azulejo_psp_refill, with the seed of its options.
/// - O(samples + triangles) time, more for parts that darts hit rarely.
/// - Errors: AZULEJO_ERROR_CANCELLED: the set then holds what was finished, and can still grow.
azulejo_status azulejo_psp_fill(azulejo_psp *psp, azulejo_psp_report *report);

/// Copies the set with normals, triangles and barycentrics, an edited one by ids. O(samples).
azulejo_status azulejo_psp_points(const azulejo_psp *psp, azulejo_points **out);

/// Frees the handle. Not from its own progress callback.
void azulejo_psp_free(azulejo_psp *psp);

/// Samples a mesh in one call: azulejo_psp_create, azulejo_psp_advance by `iterations` and, if
/// `maximal` is 1, azulejo_psp_fill, whose complexity and errors it has.
///
/// With a `count` the set has exactly so many samples: no two are closer than `radius` in the
/// report, and every place is within its `covering_radius` of one, mostly less than 1.1 times that
/// radius. It takes about twice the time of a set of known radius.
///
/// In progressive order the samples are sorted coarse to fine, from a single one on. A set with a
/// smaller count is a prefix of one with a larger count, bit for bit, for the same mesh, quotient
/// and seed: levels of detail nest. Sets of two radii share all samples with ranks of at least
/// `quotient` times the larger radius, of the first 100 those of at least 2.25 times it. It takes
/// several times as long as a set in any order, more with many triangles per sample: each of the
/// log(diagonal / radius) / log(quotient) levels visits all.
/// - out: the samples with normals, triangles and barycentrics.
/// - Errors: AZULEJO_ERROR_INVALID_ARGUMENT also for a `count` that is more than floats can carry.
azulejo_status azulejo_psp_sample(const azulejo_context *context,
                                  const azulejo_mesh *mesh,
                                  const azulejo_psp_options *options,
                                  azulejo_points **out,
                                  azulejo_psp_report *report);

/// Samples a mesh with several classes at once, as azulejo_classes says, each where it may stand.
/// Shares, and in progressive order prefixes, are as azulejo_kdrt_sample_classes says; infinite
/// ranks count as the diagonal of the mesh's box.
/// - options: `radius` must be 0, as the classes have radii. `count`, `iterations`, `maximal`,
///   `projectors`, `priority` and `engine` must have their defaults.
/// - classes: the radii, and where each class may stand.
/// - out: the samples with normals, triangles, barycentrics and classes, by which they are sorted.
/// - O(samples + classes * triangles) time. With two classes a sample takes about twice the time of
///   one of azulejo_psp_sample, with eight four times, in progressive order seven times that.
/// - Errors: AZULEJO_ERROR_INVALID_ARGUMENT also for `radii` above 0 below 64 float spacings.
azulejo_status azulejo_psp_sample_classes(const azulejo_context *context,
                                          const azulejo_mesh *mesh,
                                          const azulejo_psp_options *options,
                                          const azulejo_classes *classes,
                                          azulejo_points **out,
                                          azulejo_classes_report *report);

/// Erases the samples of a set in a region. From the first edit on the set can be filled again
/// (azulejo_psp_refill, azulejo_psp_fill) but makes no more iterations, and every sample has an id
/// (azulejo_points_ids): 0, 1, 2 and so on in their order at that time. A sample keeps its id and
/// all its bytes until it is erased, and no other sample ever gets that id.
///
/// To undo a stroke of a brush, erase what azulejo_psp_refill added, by azulejo_psp_erase_ids, and
/// put back what this call erased, by azulejo_psp_restore: the set is then as before, bit for bit.
/// To redo it, erase the same region again and refill with the same seed.
/// - erased: the erased samples with their ids, by rising ids; NULL if they are not wanted.
/// - O(samples in the cubes of 24 radii that the region touches); the first edit O(samples).
azulejo_status azulejo_psp_erase(azulejo_psp *psp,
                                 const azulejo_region *region,
                                 azulejo_points **erased);

/// Erases samples by their ids.
/// - ids: `count` ids, each of a sample of the set, none twice.
/// - erased: as in azulejo_psp_erase.
/// - O(samples in the cubes of 24 radii that they are in).
azulejo_status azulejo_psp_erase_ids(azulejo_psp *psp,
                                     const uint64_t *ids,
                                     size_t count,
                                     azulejo_points **erased);

/// Puts samples back that were erased from the set, with their ids and all their bytes.
/// - points: from an edit of this handle.
/// - O(points + samples in the cubes of 24 radii around them).
/// - Errors: AZULEJO_ERROR_INVALID_ARGUMENT also for samples that are not this set's, that stand
///   already, or that are too close to a sample or a given sample by now.
azulejo_status azulejo_psp_restore(azulejo_psp *psp, const azulejo_points *points);

/// Adds given samples to those of the options, and erases samples within their clearances.
/// - clearances: one for each, 0 or more; NULL: the radius of the set.
/// - first_id: the id of the first of them, which the others follow; NULL if it is not wanted.
///   Those of the options have the ids from 0 on. Samples have ids of their own.
/// - erased: as in azulejo_psp_erase.
/// - O(samples in the cubes of 24 radii that the clearances touch), for each.
azulejo_status azulejo_psp_add_given(azulejo_psp *psp,
                                     const float *positions,
                                     const double *clearances,
                                     size_t count,
                                     uint64_t *first_id,
                                     azulejo_points **erased);

/// Removes given samples by their ids: azulejo_psp_refill then fills what they covered.
/// - O(given samples).
azulejo_status azulejo_psp_remove_given(azulejo_psp *psp, const uint64_t *ids, size_t count);

/// Makes the set maximal again after edits: as azulejo_psp_fill, but only where samples were erased
/// or given samples removed since the last refill. All samples that stand stay as they are.
///
/// The new samples depend on `seed`, on the edits and on what stands within a radius of a region.
/// - added: the new samples with their ids, by rising ids; NULL if they are not wanted.
/// - O(surface in and around the edited regions + given samples); at first also O(triangles).
azulejo_status azulejo_psp_refill(azulejo_psp *psp,
                                  uint64_t seed,
                                  azulejo_points **added,
                                  azulejo_psp_report *report);

/// Samples the part of a mesh in a region, once, as azulejo_psp_fill: what lies outside counts as
/// covered. Samples stand in the region, or at most 6 radii outside it on a triangle that it
/// touches. For many edits of one set see azulejo_psp_erase.
/// - options: `iterations`, `maximal`, `count`, `order`, `projectors`, `priority` and `engine` must
///   have their defaults.
/// - out: the samples with normals, triangles and barycentrics.
/// - report: `rho` is 0, `covering_radius` and `uncovered_after` are -1.
/// - O(surface in the region + given samples + triangles / 16); the first call on a mesh
///   O(triangles).
azulejo_status azulejo_psp_sample_region(const azulejo_context *context,
                                         const azulejo_mesh *mesh,
                                         const azulejo_psp_options *options,
                                         const azulejo_region *region,
                                         azulejo_points **out,
                                         azulejo_psp_report *report);

/// A mesh placed in the world.
typedef struct azulejo_instance {
    uint32_t prototype; ///< The index of its mesh among the prototypes.
    uint32_t reserved; ///< Must be 0.
    /// Three rows of four: their products with (x, y, z, 1) are the place of a vertex. Finite,
    /// otherwise any. Of Embree it is RTC_FORMAT_FLOAT3X4_ROW_MAJOR.
    double transform[12];
} azulejo_instance;

/// Samples instances of meshes in world space, as if all their triangles were one mesh: no conflict
/// and no gap across instances. The triangles of one instance for each thread are in memory.
/// - prototypes: `prototype_count` meshes, such as of azulejo_mesh_create_from_embree.
/// - instances: of two that overlap the first one is sampled first.
/// - instance_size: sizeof(azulejo_instance).
/// - options: as in azulejo_psp_sample_region; `cosine` acts within each instance only.
/// - out: by instance (azulejo_points_instances), with triangles and barycentrics of the prototypes
///   and normals on the side that is their front.
/// - report: counts and times of all instances together; `uncovered_before` is -1.
/// - O(samples + triangles of all instances + instances * given samples) time.
azulejo_status azulejo_psp_sample_instances(const azulejo_context *context,
                                            const azulejo_mesh *const *prototypes,
                                            size_t prototype_count,
                                            const azulejo_instance *instances,
                                            size_t instance_count,
                                            size_t instance_size,
                                            const azulejo_psp_options *options,
                                            azulejo_points **out,
                                            azulejo_psp_report *report);

/// Options of azulejo_psp_adaptive_sample, which requires either `vertex_radii` or
/// `radius_function`, and of azulejo_psp_adaptive_with_density.
typedef struct azulejo_psp_adaptive_options {
    uint32_t struct_size; ///< The size of the struct in bytes; set by the _init function.
    uint32_t order; ///< As in azulejo_psp_options; default any.
    /// A radius for each vertex of the mesh, above 0, interpolated by the barycentrics in double
    /// arithmetic. It may change arbitrarily steeply. Default NULL.
    const float *vertex_radii;
    size_t vertex_count; ///< The number of vertices, or 0, the default.
    azulejo_radius_fn radius_function; ///< NULL, the default, if `vertex_radii` is set.
    void *radius_function_user; ///< Passed to `radius_function`.
    double smallest; ///< Its smallest value, above 0. Must be 0, the default, with vertex_radii.
    double largest; ///< Its largest value. Must be 0, the default, with vertex_radii.
    /// The most by which `radius_function` changes per unit of distance between two places of a
    /// triangle; 0, the default: it is constant on each. Coverage is proved with it: a violation
    /// that is detected makes the call fail, one that is not can leave gaps. From about 1 on the
    /// work grows with its square, and from about 30 on it may be refused: for images and other
    /// data with edges vertex_radii are better. At most `smallest` / 24 per float spacing. Must be
    /// 0 with vertex_radii.
    double slope;
    double cosine; ///< As in azulejo_psp_options, from -1, the default, to 1.
    uint64_t seed; ///< Any number; another seed gives another set. Default 0.
    azulejo_progress_fn progress; ///< Default NULL: the callback of the context, if it has one.
    void *progress_user; ///< Passed to the progress callback.
    const float *given_positions; ///< Default NULL: see "Given samples" in azulejo.h.
    const double *given_clearances; ///< The clearance of each, required; default NULL.
    size_t given_count; ///< The number of given samples; default 0.
    double quotient; ///< 1.02 to 1.5; default 0: see "Order" in azulejo.h.
} azulejo_psp_adaptive_options;

azulejo_status azulejo_psp_adaptive_options_init(azulejo_psp_adaptive_options *options,
                                                 size_t struct_size);

/// Makes a maximal set of samples on a mesh, each with a radius of its own (thesis section 3.4.4).
///
/// Conflict-free: two samples are no closer than the mean of their radii. Maximal: no place of the
/// surface is farther from every sample than the mean of the two radii, up to 6 float spacings and
/// the change of the radius over that length; with vertex_radii, also up to 2^-22 of the largest
/// difference of two radii on a triangle. Where the radius changes little there are about 0.6966 /
/// radius^2 samples per unit of area. Radii are at most four times the diagonal of the box.
///
/// In progressive order ranks are what all radii are multiplied by: with its radii times the i-th
/// rank the prefix of i samples is conflict-free, and with all radii times `quotient` times that
/// rank it is maximal (for i below 100 see azulejo_points_ranks). The last rank is 1 or a little
/// more. Each of the log(diagonal / smallest radius) / log(quotient) levels visits all triangles
/// and calls `radius_function`. Where the radius jumps, samples of the larger radius, which come
/// first, leave fewer on the other side.
/// - out: the samples with normals, triangles, barycentrics and radii.
/// - report: no iterations, rays and hits; in progressive order both radii are 1.
/// - O(samples + triangles) time for radii that change slowly; see `slope`.
/// - Errors: AZULEJO_ERROR_INVALID_ARGUMENT also for radii below 64 float spacings, and if
///   `radius_function` leaves `smallest` to `largest` or changes faster than `slope`;
///   AZULEJO_ERROR_TOO_LARGE also if coverage would take thousands of evaluations per sample.
azulejo_status azulejo_psp_adaptive_sample(const azulejo_context *context,
                                           const azulejo_mesh *mesh,
                                           const azulejo_psp_adaptive_options *options,
                                           azulejo_points **out,
                                           azulejo_psp_report *report);

/// Gives the density at a position of a mesh, at least 0. See "Callbacks" in azulejo.h; with
/// `at_vertices` it is called once for each vertex, on the thread that made the call.
/// - user: the `function_user` of the azulejo_mesh_density.
/// - position: x y z of a place on the mesh.
typedef double (*azulejo_mesh_density_fn)(void *user, const double *position);

/// The number of samples of a mesh per unit of area, from place to place: at least 0, and not 0
/// everywhere. One of `vertex_values`, `function` and `image` must be set, and one of `radius` and
/// `count`, but neither in a relaxation; what is not set has its default, NULL or 0.
typedef struct azulejo_mesh_density {
    uint32_t struct_size; ///< The size of the struct in bytes; set by the _init function.
    /// 1: `function` is called at the vertices only, and interpolated on the triangles. Default 0.
    uint32_t at_vertices;
    /// A density for each vertex of the mesh, interpolated on the triangles.
    const float *vertex_values;
    size_t vertex_count; ///< The number of vertices.
    azulejo_mesh_density_fn function; ///< Gives the density at a position.
    void *function_user; ///< Passed to `function`.
    double largest; ///< The largest value of `function`, above 0. Must be 0 with `at_vertices`.
    /// The most by which `function` changes per unit of distance between two places of a triangle,
    /// at least 0, as in azulejo_psp_adaptive_options. Where the density is 0, or nearly so, over
    /// many times the radius beside it, the call is refused as too much: use `at_vertices` there.
    /// Must be 0 where `largest` must.
    double slope;
    /// An image that is laid on the mesh by texture coordinates, linear between the centres of its
    /// pixels, and repeated: `height` rows of `width` densities, the first along v = 0.
    const float *image;
    size_t width; ///< The number of pixels in a row, from u = 0 to 1.
    size_t height; ///< The number of rows.
    /// Texture coordinates of an image, u v each, at most 1e6 in absolute value: one for each
    /// vertex, or one for each corner of each triangle.
    const float *texture;
    size_t texture_count; ///< That of the vertices or of the corners.
    uint32_t by_corners; ///< 1: by corners, so that those along a seam differ. Default 0.
    uint32_t reserved; ///< Must be 0.
    /// The radius at density 1, above 0: that of a maximal set. At d it is this over sqrt(d).
    double radius;
    /// About how many samples the whole set has, above 0: fewer where parts of the surface are
    /// nearer to each other than the radius, and some more along boundaries. In progressive order
    /// there are exactly so many, and it must be a whole number.
    double count;
} azulejo_mesh_density;

azulejo_status azulejo_mesh_density_init(azulejo_mesh_density *density, size_t struct_size);

/// Makes a maximal set of samples on a mesh with a density: azulejo_psp_adaptive_sample, where the
/// radius at a density d is that at density 1 over sqrt(d). What is said there holds for the radii
/// that are returned. Where the density falls to 0 within a few radii, radii are limited to four
/// times the least one on a piece of the surface of about that length.
///
/// In progressive order ranks are radii at density 1, and so are both radii of the report. Sets of
/// smaller counts are prefixes, bit for bit but for the radii, which are those of each set. A set
/// with a radius shares all samples with ranks of at least `quotient` times that radius, of the
/// first 100 those of at least 2.25 times it.
/// - options: vertex_radii and radius_function must be NULL, and what belongs to them 0.
/// - out: the samples with normals, triangles, barycentrics and radii.
/// - O(samples + triangles) time for densities that change slowly.
/// - Errors: as of azulejo_psp_adaptive_sample, for densities and `largest`.
azulejo_status azulejo_psp_adaptive_with_density(const azulejo_context *context,
                                                 const azulejo_mesh *mesh,
                                                 const azulejo_psp_adaptive_options *options,
                                                 const azulejo_mesh_density *density,
                                                 azulejo_points **out,
                                                 azulejo_psp_report *report);

/// Samples a mesh with several classes and a density: azulejo_psp_sample_classes, where the radii
/// of the classes are multiples of the local radius of azulejo_psp_adaptive_with_density. Two
/// samples of classes i and j are at least r_ij times the mean of their local radii apart, and for
/// each class every place is nearer than that to some sample. So all classes follow the density,
/// with the shares that they have without one. Where it jumps, larger classes, which come first,
/// leave fewer samples of smaller ones.
/// - options: as in azulejo_psp_sample_classes; given samples need clearances, which are lengths.
///   In progressive order ranks, over the own radius of the class, are factors of all local radii.
/// - density: with `radius` 1 the radii of the classes are those at density 1; a `count` is about
///   that of a class of radius 1 by itself, in any order.
/// - out: as of azulejo_psp_sample_classes, and with the local radii.
/// - Errors: those of both calls.
azulejo_status azulejo_psp_classes_with_density(const azulejo_context *context,
                                                const azulejo_mesh *mesh,
                                                const azulejo_psp_options *options,
                                                const azulejo_classes *classes,
                                                const azulejo_mesh_density *density,
                                                azulejo_points **out,
                                                azulejo_classes_report *report);

#ifdef __cplusplus
}
#endif

#endif
