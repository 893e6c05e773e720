/*
 * PSP: maximal Poisson-disk sets on triangle meshes, also with a radius that varies.
 *
 * Generated from ffi/azulejo-c by cbindgen; do not edit. The conventions are in azulejo.h.
 */

#ifndef AZULEJO_PSP_H
#define AZULEJO_PSP_H

#include "base.h"

#ifdef __cplusplus
extern "C" {
#endif

/// The report of a call that samples a mesh. Times are wall times.
typedef struct azulejo_psp_report {
    /// The size of the struct in bytes; set by the _init function.
    uint32_t struct_size;
    /// The iterations of projection that the call made.
    uint32_t iterations;
    /// The samples of the set after the call.
    uint64_t samples;
    /// The samples that the call added.
    uint64_t accepted;
    /// The rays that meet the box of the mesh, which the call traced. For the rasteriser: the
    /// points of those of its tiles, at most 48 radii wide, that have triangles near them.
    uint64_t rays;
    /// The places where rays met the mesh.
    uint64_t hits;
    /// The hits that were rejected because of an earlier one on the same ray.
    uint64_t restart_conflicts;
    /// The darts thrown into uncovered surface.
    uint64_t darts;
    /// The hits and darts that were rejected because of other samples.
    uint64_t conflicts;
    /// The time of the call in seconds.
    double seconds;
    /// The part of it in which patterns and, for Embree, the scene were made: in the first
    /// iteration of a set.
    double prepare_seconds;
    /// The part of it in which hits were found.
    double project_seconds;
    /// The part of it in which samples were chosen among the hits.
    double merge_seconds;
    /// The part of it in which uncovered surface was searched for and filled.
    double fill_seconds;
    /// The radius of the set in units of d_max after the call: about 0.78 for a maximal set, 0 for
    /// no samples. The smallest distance is taken to be the radius, which it hardly exceeds in
    /// large sets.
    double rho;
    /// If the call filled gaps: the fraction of the area that was uncovered before, estimated with
    /// random points on the parts of the surface that no single sample covered when the search came
    /// to them: at least 1,024, or above about 25,000 samples 64 for each cube of 24 radii.
    /// Else -1.
    double uncovered_before;
    /// If the call filled gaps: the fraction of the area that is uncovered after it, which is 0.
    /// Else -1.
    double uncovered_after;
    /// The radius of the set: the one asked for or, for a count, the one that was found. No two
    /// samples are closer. 0 where radii vary; in progressive order then what they are multiplied
    /// by, which is 1, or for a density the radius at density 1.
    double radius;
    /// A bound of the covering radius, where one is known: no place is farther from all samples, up
    /// to 6 spacings of floats at the largest coordinate. The radius itself after gaps were filled,
    /// a little more for a count. Where `radius` is not a distance, the bound of what radii are
    /// multiplied by. Else -1.
    double covering_radius;
} azulejo_psp_report;

/// Writes zeros and the size. `struct_size` is sizeof *report.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT.
azulejo_status azulejo_psp_report_init(azulejo_psp_report *report, size_t struct_size);

/// If two candidates of an iteration are too close, the one that its projector faces more squarely
/// is kept: the default, which finds more samples. Existing samples are always kept.
#define AZULEJO_PRIORITY_SQUARENESS 0

/// The candidate of the earlier projector is kept, as in the thesis (section 3.3.2). Existing
/// samples are always kept.
#define AZULEJO_PRIORITY_PROJECTOR 1

/// Ray packets of Embree find where patterns meet the mesh: the default.
#define AZULEJO_ENGINE_EMBREE 0

/// Triangles are rasterised over the patterns in exact integer arithmetic (thesis section 3.4.3):
/// the result does not depend on the machine or on Embree. The hits are those of Embree except for
/// rounding, which moves points and edges relative to each other by up to 2e-7 of the mesh's
/// diagonal: a point so close to an edge may hit the triangle on its other side.
#define AZULEJO_ENGINE_RASTERISER 1

/// The number of iterations of azulejo_psp_options that stands for a rule.
#define AZULEJO_ITERATIONS_DEFAULT 4294967295

/// A set of samples on a mesh that can grow. It keeps its context and its mesh, which may be freed
/// before it.
///
/// One call at a time may change it; another one, from another thread or from the progress
/// callback, is refused with AZULEJO_ERROR_BUSY. Several threads may copy its points at once.
typedef struct azulejo_psp azulejo_psp;

/// Options of azulejo_psp_create and azulejo_psp_sample.
typedef struct azulejo_psp_options {
    /// The size of the struct in bytes; set by the _init function.
    uint32_t struct_size;
    /// The number of projections of patterns by azulejo_psp_sample, in 3 directions each, before it
    /// fills the gaps. AZULEJO_ITERATIONS_DEFAULT, the default: 0 if `maximal` is 1, on every mesh
    /// and with every radius, since a set that is only filled is made sooner and prefers no
    /// direction; 1 if `maximal` is 0. Where no more than 25,000 samples are expected, on the area
    /// and along edges longer than the radius, a set that is only filled is filled in one piece and
    /// is unbiased; a larger one is filled cube by cube and holds up to about 0.8 % more samples
    /// than unbiased darts give, at the seams of the cubes. azulejo_psp_create refuses any value
    /// but the default, azulejo_psp_sample 0 with a `maximal` of 0.
    uint32_t iterations;
    /// The smallest straight distance between two samples, in the units of the mesh: above 0, and
    /// at least 64 times the spacing of floats at the largest coordinate. It has no default; with a
    /// `count` it must be 0.
    double radius;
    /// Any number; another seed gives another set. Default 0.
    uint64_t seed;
    /// 1, the default: azulejo_psp_sample fills all gaps. 0: it stops after the iterations, as the
    /// thesis does, and leaves some per cent of the surface uncovered. azulejo_psp_create refuses
    /// any value but the default.
    uint32_t maximal;
    /// An AZULEJO_PRIORITY_ constant; default squareness.
    uint32_t priority;
    /// An AZULEJO_ENGINE_ constant; default Embree, or the rasteriser in a library without Embree
    /// (azulejo_has_embree).
    uint32_t engine;
    /// An AZULEJO_ORDER_ constant; default any. In progressive order every prefix of the set is
    /// well spread, and azulejo_points_ranks says how well. The set is filled only, as by default:
    /// `iterations` above 0 and a `maximal` of 0 are refused. Must be any in azulejo_psp_create.
    uint32_t order;
    /// Called during the call; default NULL: the callback of the context, if it has one. A psp
    /// handle keeps it for all its calls.
    azulejo_progress_fn progress;
    /// Passed to the progress callback.
    void *progress_user;
    /// The exact number of samples; default 0: as many as the radius gives. The report says which
    /// radius they have, and a bound of the covering radius. The set is filled only, as in
    /// progressive order. Must be 0 in azulejo_psp_create.
    size_t count;
    /// Of a progressive order: every prefix of 100 samples and more covers the surface within this
    /// times its last rank, 1.02 to 1.5; smaller ones within twice that rank, or the square of the
    /// quotient times it if that is more. The smaller, the more levels there are, each of which
    /// takes time. Default 0: 2^(1/8).
    double quotient;
    /// Samples that stand already, around which the set is made, x y z each; NULL, the default,
    /// for none. They may lie anywhere, on the mesh or not, in any number. They are never moved,
    /// dropped or compared with each other, and are not returned: new samples are at least the
    /// clearance from each of them, and every place of the surface is within the radius of a new
    /// sample or within the clearance of a given one. A psp handle copies what it needs of them.
    const float *given_positions;
    /// The clearance of each given sample, finite and 0 or more, in the units of the mesh; 0 has
    /// no effect. NULL, the default: all have the radius of the set. Must not be NULL with a
    /// `count`, unless there are no given samples. For azulejo_psp_sample_classes a row for each
    /// given sample, with a clearance for each class.
    const double *given_clearances;
    /// The number of given samples; default 0.
    size_t given_count;
    /// Samples on triangles whose normals have a smaller cosine than this ignore each other, so
    /// that the two sides of a thin wall are sampled as if they were far apart; triangles must be
    /// wound consistently. From -1, the default, which turns it off, to 1, with which only samples
    /// with the same normal see each other. Given samples act on all sides. Above -1 iterations are
    /// refused, as projection does not tell sides apart.
    double cosine;
} azulejo_psp_options;

/// Writes the defaults. `struct_size` is sizeof *options.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT.
azulejo_status azulejo_psp_options_init(azulejo_psp_options *options, size_t struct_size);

/// Makes an empty set on a mesh. It does not report progress.
///
/// mesh: kept by the handle as long as it needs it.
///
/// options: `iterations`, `maximal`, `count` and `order` must have their defaults: here each call
/// says what it does.
///
/// out: the handle, to be freed with azulejo_psp_free.
///
/// At most O(triangles + given samples) time.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT, also for a radius below 64 times the spacing of floats
/// at the largest coordinate, and for a given sample out of range, with its index;
/// AZULEJO_ERROR_TOO_LARGE, with the estimated number of samples on the surface without given ones.
azulejo_status azulejo_psp_create(const azulejo_context *context,
                                  const azulejo_mesh *mesh,
                                  const azulejo_psp_options *options,
                                  azulejo_psp **out);

/// Adds samples: projects patterns of samples onto the mesh, in each iteration along three
/// orthogonal directions of a random frame, and keeps what does not conflict with the set (thesis
/// chapter 3). Samples are only added. Two calls add what one call with the sum of their iterations
/// adds. The first call prepares the mesh for the engine.
///
/// An iteration is not made, and not reported, where the box of the mesh is out of all proportion
/// to its surface, as for small parts far apart: with more than 20 rays per sample that there is
/// room for, and more than 10 million rays in all. There azulejo_psp_fill is faster.
///
/// With AZULEJO_ENGINE_EMBREE the bytes depend on the version of Embree and on the instruction set:
/// the last bits of a hit may differ, and with them which of two candidates is taken.
///
/// iterations: how often; 0 does nothing. A set that has been edited makes none.
///
/// report: what this call did, or NULL.
///
/// O((diagonal of the mesh / radius)^2 + hits) time for each iteration, and for the first one
/// O(triangles * log triangles).
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT, also for a `cosine` above -1; AZULEJO_ERROR_BUSY while
/// another call uses the handle; AZULEJO_ERROR_EMBREE; AZULEJO_ERROR_CANCELLED: the set then holds
/// what was finished, and can still grow.
azulejo_status azulejo_psp_advance(azulejo_psp *psp,
                                   uint32_t iterations,
                                   azulejo_psp_report *report);

/// Makes the set maximal: finds the parts of the surface that are farther than the radius from
/// every sample and throws darts into them until there is none.
///
/// A set that has been edited is filled as by azulejo_psp_refill, with the seed of its options.
///
/// report: what this call did, or NULL.
///
/// O(samples + triangles) time, more for parts that darts hit rarely.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT; AZULEJO_ERROR_BUSY while another call uses the handle;
/// AZULEJO_ERROR_CANCELLED: the set then holds what was finished, and can still grow.
azulejo_status azulejo_psp_fill(azulejo_psp *psp, azulejo_psp_report *report);

/// Copies the set in its present state; one that has been edited by rising ids. Several threads may
/// do so at once.
///
/// out: the samples with normals, triangles and barycentrics, to be freed with azulejo_points_free.
///
/// O(samples).
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT; AZULEJO_ERROR_BUSY while another call changes the
/// handle.
azulejo_status azulejo_psp_points(const azulejo_psp *psp, azulejo_points **out);

/// Frees the handle, but not the points taken from it. Must not be called from its own progress
/// callback. NULL is allowed.
void azulejo_psp_free(azulejo_psp *psp);

/// Samples a mesh in one call: azulejo_psp_create, azulejo_psp_advance by `iterations` and, if
/// `maximal` is 1, azulejo_psp_fill, with one progress for all.
///
/// With a `count` the set has exactly so many samples: no two are closer than `radius` in the
/// report, and every place of the surface is within `covering_radius` of one, in most cases less
/// than 1.1 times that radius. It takes about twice the time of a set of known radius.
///
/// In progressive order the samples are sorted coarse to fine (azulejo_points_ranks), from a single
/// one on: the first of them, any number, are at least as far apart as their last rank, and cover
/// the surface within `quotient` times that, or, if they are less than 100, within twice that (the
/// square of the quotient times it if that is more). A set with a smaller count is a prefix of one
/// with a larger count, bit for bit, for the same mesh, quotient and seed: levels of detail nest.
/// Sets of two radii share all samples with ranks of at least `quotient` times the larger radius,
/// of the first 100 those with ranks of at least 2.25 times it. It takes several times
/// as long as a set in any order (docs/order.md), and more with many triangles per sample: some
/// log(diagonal / radius) / log(quotient) levels visit all triangles.
///
/// out: the samples with normals, triangles and barycentrics, to be freed with azulejo_points_free.
///
/// report: what the call did, or NULL.
///
/// Complexity and errors: those of the three; AZULEJO_ERROR_INVALID_ARGUMENT also for a `count`
/// that is more than floats can carry on the mesh.
azulejo_status azulejo_psp_sample(const azulejo_context *context,
                                  const azulejo_mesh *mesh,
                                  const azulejo_psp_options *options,
                                  azulejo_points **out,
                                  azulejo_psp_report *report);

/// Samples a mesh with several classes at once.
///
/// No two samples of classes i and j are closer than r_ij. No class can take another sample: for
/// each class i every place of the surface is within r_ij of a sample of some class j, up to the
/// tolerance of azulejo_psp_fill.
///
/// Shares: of own radii 1, 1/2, 1/4 with the cross radii of azulejo_classes_radii and factor 1 the
/// classes have about 100, 82 and 82 per cent of the samples that each would have alone. Equal
/// radii have equal shares: two about 77 per cent each, eight 83, and two with factor 0.7 have 95.
/// Of 1.1 and 1 the first has 100 and the second 68: shares jump where radii become equal.
///
/// In progressive order the samples of each class are sorted coarse to fine, and
/// azulejo_points_ranks has their ranks. The first samples of a class, any number of them, are at
/// least as far apart as the last of their ranks. Of the classes of equal own radii R, the samples
/// up to a rank t are at least r_ij t / R apart (of infinite ranks, r_ij d / R for the diagonal d
/// of the mesh's box), and where these classes may stand every place is within `quotient` times
/// r_ij t / R of one of them, or within r_ij of a sample of a class of larger radius; of less than
/// 100 of them, within 2 or the square of `quotient` times that instead. So a host can show the
/// first part of each class, near parts of a scene more than far ones. The order takes about seven
/// times the time.
///
/// options: `radius` must be 0, as the classes have radii. `count`, `iterations`, `maximal`,
/// `priority` and `engine` must have their defaults. `given_clearances` has a row for each given
/// sample with a clearance for each class; NULL stands for each class's own radius.
///
/// classes: the radii, and where each class may stand.
///
/// out: the samples with normals, triangles, barycentrics and azulejo_points_classes, by which they
/// are sorted; to be freed with azulejo_points_free.
///
/// report: how many samples each class has, or NULL.
///
/// With two classes each sample takes about twice the time of one of azulejo_psp_sample, with eight
/// about four times; all triangles are visited once for each class.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT, also for `radii` above 0 below 64 times the spacing of
/// floats at the largest coordinate; AZULEJO_ERROR_TOO_LARGE, with the estimated number of samples;
/// AZULEJO_ERROR_CANCELLED by the progress callback.
azulejo_status azulejo_psp_sample_classes(const azulejo_context *context,
                                          const azulejo_mesh *mesh,
                                          const azulejo_psp_options *options,
                                          const azulejo_classes *classes,
                                          azulejo_points **out,
                                          azulejo_classes_report *report);

/// Erases the samples of a set in a region. From the first edit on the set can be filled again
/// (azulejo_psp_refill, azulejo_psp_fill) but makes no more iterations, and every sample has an id
/// (azulejo_points_ids): 0, 1, 2 and so on for those that stand then, in their order. A sample
/// keeps its id and all its bytes until it is erased, and no other sample ever gets that id.
///
/// To undo a stroke of a brush, erase what azulejo_psp_refill added, by azulejo_psp_erase_ids, and
/// give back what this call erased, by azulejo_psp_restore: the set is then as before, bit for bit.
/// To redo it, erase the same region again and refill with the same seed.
///
/// erased: the erased samples with their ids, by rising ids, to be freed with azulejo_points_free;
/// NULL if they are not wanted.
///
/// O(samples in the cubes of 24 radii that the region touches); the first edit O(samples).
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT, also for a region with a bound that is NaN;
/// AZULEJO_ERROR_BUSY while another call uses the handle.
azulejo_status azulejo_psp_erase(azulejo_psp *psp,
                                 const azulejo_region *region,
                                 azulejo_points **erased);

/// Erases samples by their ids.
///
/// ids: `count` ids, each of a sample of the set, none twice; NULL if `count` is 0.
///
/// erased: as in azulejo_psp_erase.
///
/// O(samples in the cubes of 24 radii that they are in).
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT, also for an id that no sample of the set has;
/// AZULEJO_ERROR_BUSY while another call uses the handle. Nothing is erased then.
azulejo_status azulejo_psp_erase_ids(azulejo_psp *psp,
                                     const uint64_t *ids,
                                     size_t count,
                                     azulejo_points **erased);

/// Puts samples back that were erased from the set, with their ids and all their bytes.
///
/// points: from an edit of this handle; not changed, and still to be freed.
///
/// O(points + samples in the cubes of 24 radii around them).
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT, also for samples that are not this set's, that stand
/// already, or that are too close to a sample or a given sample by now; AZULEJO_ERROR_BUSY while
/// another call uses the handle. Nothing is put back then.
azulejo_status azulejo_psp_restore(azulejo_psp *psp, const azulejo_points *points);

/// Adds given samples to those of the options. Samples of the set that are closer to one than its
/// clearance are erased.
///
/// positions: x y z each. clearances: one for each, finite and 0 or more; NULL: the radius of the
/// set.
///
/// first_id: the id of the first of them, which the others follow; NULL if it is not wanted. Those
/// of the options have the ids from 0 on. Ids of given samples and of samples are independent.
///
/// erased: as in azulejo_psp_erase.
///
/// O(samples in the cubes of 24 radii that the clearances touch), for each.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT; AZULEJO_ERROR_BUSY while another call uses the handle.
/// Nothing is changed then.
azulejo_status azulejo_psp_add_given(azulejo_psp *psp,
                                     const float *positions,
                                     const double *clearances,
                                     size_t count,
                                     uint64_t *first_id,
                                     azulejo_points **erased);

/// Removes given samples by their ids: the surface that they covered is filled by the next
/// azulejo_psp_refill.
///
/// O(given samples).
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT, also for an id that no given sample has;
/// AZULEJO_ERROR_BUSY while another call uses the handle. Nothing is removed then.
azulejo_status azulejo_psp_remove_given(azulejo_psp *psp, const uint64_t *ids, size_t count);

/// Makes the set maximal again after edits: as azulejo_psp_fill, but only where samples were erased
/// or given samples removed since the last refill. All samples that stand stay as they are.
///
/// The new samples depend on `seed`, on the edits and on what stands around them. They can lie up
/// to a radius outside a region that was erased, since that is how far the erased samples covered
/// the surface.
///
/// added: the new samples with their ids, by rising ids, to be freed with azulejo_points_free; NULL
/// if they are not wanted.
///
/// report: what this call did, or NULL.
///
/// O(surface in and around the edited regions + given samples); the first call on a handle also
/// O(triangles).
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT; AZULEJO_ERROR_BUSY while another call uses the handle;
/// AZULEJO_ERROR_CANCELLED: nothing is added then, and the call can be repeated.
azulejo_status azulejo_psp_refill(azulejo_psp *psp,
                                  uint64_t seed,
                                  azulejo_points **added,
                                  azulejo_psp_report *report);

/// Samples the part of a mesh in a region, once: no place of the surface in the region is farther
/// than the radius from all samples or than its clearance from all given ones, up to the tolerance
/// of azulejo_psp_fill. What lies outside counts as covered. Samples stand in the region, or at
/// most 6 radii outside it on a triangle that it touches. For many edits of one set see
/// azulejo_psp_erase.
///
/// options: `iterations`, `maximal`, `count`, `order`, `priority` and `engine` must have their
/// defaults.
///
/// out: the samples with normals, triangles and barycentrics, to be freed with azulejo_points_free.
///
/// report: what the call did, or NULL; `rho` is 0, and `covering_radius` and `uncovered_after` are
/// -1.
///
/// O(surface in the region + given samples + triangles / 16); the first call on a mesh
/// O(triangles).
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT; AZULEJO_ERROR_TOO_LARGE; AZULEJO_ERROR_CANCELLED.
azulejo_status azulejo_psp_sample_region(const azulejo_context *context,
                                         const azulejo_mesh *mesh,
                                         const azulejo_psp_options *options,
                                         const azulejo_region *region,
                                         azulejo_points **out,
                                         azulejo_psp_report *report);

/// Gives the radius at a position.
///
/// It is called on other threads than the one that made the call, by several at once, unless the
/// context has one thread: then on that thread only. It must be thread-safe, give the same radius
/// for the same position, return (see "Callbacks" at the top), and must not call the library with
/// the same context.
///
/// user: the radius_function_user of the options.
///
/// position: x y z of a place on the mesh; for a sample, the floats that are returned.
///
/// Returns the radius in the units of the mesh, from `smallest` to `largest`.
typedef double (*azulejo_radius_fn)(void *user, const double *position);

/// Options of azulejo_psp_adaptive_sample. Either `vertex_radii` or `radius_function`
/// must be set.
typedef struct azulejo_psp_adaptive_options {
    /// The size of the struct in bytes; set by the _init function.
    uint32_t struct_size;
    /// An AZULEJO_ORDER_ constant; default any. In progressive order every prefix of the set is
    /// well spread, and azulejo_points_ranks says how well.
    uint32_t order;
    /// A radius for each vertex of the mesh, above 0, in its units; used during the call only. At
    /// the barycentrics u v of a sample on the triangle (a, b, c) it is (1-u-v)*a + u*b + v*c, in
    /// double arithmetic. It may change arbitrarily steeply. NULL, the default, if
    /// `radius_function` is set.
    const float *vertex_radii;
    /// The number of vertex_radii: that of the vertices of the mesh. Must be 0, the default, if
    /// `radius_function` is set.
    size_t vertex_count;
    /// Gives the radius at a position. NULL, the default, if `vertex_radii` is set.
    azulejo_radius_fn radius_function;
    /// Passed to `radius_function`.
    void *radius_function_user;
    /// The smallest value of `radius_function`, above 0. Must be 0, the default, with vertex_radii.
    double smallest;
    /// The largest value of `radius_function`. Must be 0, the default, with vertex_radii.
    double largest;
    /// The most by which `radius_function` changes per unit of distance between two places of a
    /// triangle; 0, the default: it is constant on each triangle. Coverage is proved with it, so it
    /// must hold: a violation that is detected makes the call fail, one that is not can leave gaps.
    /// From about 1 on the work grows with its square, and from about 30 on it may be refused as
    /// too much; for images and other data with edges vertex_radii, which carry their own slopes,
    /// are the better choice. At most `smallest` / 24 per spacing of floats at the largest
    /// coordinate of the mesh. Must be 0 with vertex_radii.
    double slope;
    /// Samples on triangles whose normals have a smaller cosine than this ignore each other, so
    /// that the two sides of a thin wall are sampled as if they were far apart; triangles must be
    /// wound consistently. From -1, the default, which turns it off, to 1, with which only samples
    /// with the same normal see each other.
    double cosine;
    /// Any number; another seed gives another set. Default 0.
    uint64_t seed;
    /// Called during the call; default NULL: the callback of the context, if it has one.
    azulejo_progress_fn progress;
    /// Passed to the progress callback.
    void *progress_user;
    /// Samples that stand already, around which the set is made, x y z each; NULL, the default,
    /// for none. They may lie anywhere, on the mesh or not, in any number. They are never moved,
    /// dropped or compared with each other, and are not returned: new samples are at least the
    /// clearance from each of them, and every place of the surface is within the radius of a new
    /// sample or within the clearance of a given one. They act on all sides of a thin wall.
    const float *given_positions;
    /// The clearance of each given sample, finite and 0 or more, in the units of the mesh; 0 has
    /// no effect. NULL, the default, only if there are none: no radius could stand for it.
    const double *given_clearances;
    /// The number of given samples; default 0.
    size_t given_count;
    /// Of a progressive order: every prefix of 100 samples and more covers the surface at this
    /// times its last rank, 1.02 to 1.5; smaller ones at twice that rank, or the square of the
    /// quotient times it if that is more. The smaller, the more levels there are, each of which
    /// takes time. Default 0: 2^(1/8).
    double quotient;
} azulejo_psp_adaptive_options;

/// Writes the defaults. `struct_size` is sizeof *options.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT.
azulejo_status azulejo_psp_adaptive_options_init(azulejo_psp_adaptive_options *options,
                                                 size_t struct_size);

/// Makes a maximal set of samples on a mesh, each with a radius of its own (thesis section 3.4.4).
/// Embree is not used.
///
/// Conflict-free: two samples are no closer than the mean of their radii, in double arithmetic on
/// the returned positions and radii. Maximal: no place of the surface is farther from every sample
/// than the mean of the two radii, up to 6 times the spacing of floats at the largest coordinate
/// and the change of the radius over that length; with vertex_radii, also up to 2^-22 of the
/// largest difference of two radii on a triangle. Where the radius changes little from sample to
/// sample there are about 0.6966 / radius^2 samples per unit of area. Radii above four times the
/// diagonal of the mesh's box are reduced to that, those of vertices before interpolation.
///
/// In progressive order the samples are sorted coarse to fine. Ranks are what all radii are
/// multiplied by: with its radii times the i-th rank the prefix of i samples is conflict-free, and
/// with all radii times `quotient` times that rank it is maximal (see there for i below 100). Ranks
/// never rise, and the last one is 1 or a little more. `vertex_radii` and `radius_function` keep
/// their meaning: the whole set is maximal at them. Some log(diagonal / smallest radius) /
/// log(quotient) levels visit all triangles and call `radius_function`; where radii are small
/// beside the triangles it takes several times as long as a set in any order. Where the radius
/// jumps, samples of the larger radius that came first leave fewer on the other side than in any
/// order.
///
/// out: the samples with normals, triangles, barycentrics and radii, and ranks in progressive
/// order, to be freed with azulejo_points_free.
///
/// report: what the call did, or NULL; iterations, rays and hits are 0. In progressive order its
/// `radius` is 1, as the radii are those asked for, and `covering_radius` as well.
///
/// O(samples + triangles) time for radii that change slowly; see `slope`.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT, also for radii that are not positive and finite or below
/// 64 times the spacing of floats at the largest coordinate, for a given sample out of range, with
/// its index, and if `radius_function` returns a value outside `smallest` to `largest` or changes
/// faster than `slope`; AZULEJO_ERROR_TOO_LARGE with the estimated number of samples, or for radii
/// that change so fast that finding out what is covered would take thousands of evaluations per
/// sample; AZULEJO_ERROR_CANCELLED.
azulejo_status azulejo_psp_adaptive_sample(const azulejo_context *context,
                                           const azulejo_mesh *mesh,
                                           const azulejo_psp_adaptive_options *options,
                                           azulejo_points **out,
                                           azulejo_psp_report *report);

/// Gives the density at a position of a mesh.
///
/// With `at_vertices` it is called once for each vertex of the mesh, on the thread that made the
/// call. Otherwise it is called on other threads, too, by several at once, unless the context has
/// one thread, and must be thread-safe. It must give the same density for the same position, return
/// (see "Callbacks" at the top), and must not call the library with the same context.
///
/// user: the `function_user` of the azulejo_mesh_density.
///
/// position: x y z of a place on the mesh.
///
/// Returns the density, finite and at least 0.
typedef double (*azulejo_mesh_density_fn)(void *user, const double *position);

/// The number of samples of a mesh per unit of area, from place to place. Densities are
/// finite, at least 0, and not 0 everywhere; where they are 0 there are no samples, which
/// does not affect the density beside it. One of `vertex_values`, `function` and `image` must be
/// set, and one of `radius` and `count`.
typedef struct azulejo_mesh_density {
    /// The size of the struct in bytes; set by the _init function.
    uint32_t struct_size;
    /// 1: `function` is called at the vertices only, and interpolated on the triangles; nothing
    /// need be known of it. Default 0. Must be 0 without a function.
    uint32_t at_vertices;
    /// A density for each vertex of the mesh, interpolated on the triangles; used during the call
    /// only. Default NULL.
    const float *vertex_values;
    /// The number of vertex_values: that of the vertices of the mesh. Default 0.
    size_t vertex_count;
    /// Gives the density at a position. Default NULL.
    azulejo_mesh_density_fn function;
    /// Passed to `function`.
    void *function_user;
    /// The largest value of `function`, above 0. Must be 0, the default, without a function, and
    /// with `at_vertices`.
    double largest;
    /// The most by which `function` changes per unit of distance between two places of a triangle,
    /// at least 0. Coverage is proved with it, so it must hold: a violation that is detected makes
    /// the call fail. Where the density is 0, or nearly so, over many times the radius beside it,
    /// the call would take very many evaluations and is refused: use `at_vertices` there. Must be
    /// 0, the default, where `largest` must.
    double slope;
    /// An image that is laid on the mesh by texture coordinates, linear between the centres of its
    /// pixels, and repeated: `height` rows of `width` densities, the first row along v = 0. Used
    /// during the call only. Default NULL.
    const float *image;
    /// The number of pixels in a row, which is as long as u goes from 0 to 1; at least 1. Must be
    /// 0, the default, without an image.
    size_t width;
    /// The number of rows, at least 1. Must be 0, the default, without an image.
    size_t height;
    /// Texture coordinates, u v each, finite and at most 1e6 in absolute value: one for each
    /// vertex, or one for each corner of each triangle, three times as many as there are triangles.
    /// NULL, the default, without an image.
    const float *texture;
    /// The number of texture coordinates: that of the vertices or, if `by_corners` is 1, of the
    /// corners.
    size_t texture_count;
    /// 1: `texture` is by corners, so that those along a seam differ. Default 0: by vertices.
    uint32_t by_corners;
    /// Must be 0.
    uint32_t reserved;
    /// The radius at density 1, above 0: a maximal set of this radius has density 1. The radius at
    /// a density d is this over sqrt(d). 0, the default, with a count.
    double radius;
    /// About how many samples the whole set has, above 0: the radius follows from the integral of
    /// the density. There are fewer where parts of the surface are nearer to each other than the
    /// radius, and some more along the boundaries of the surface. In progressive order there are
    /// exactly so many, and it must be a whole number. 0, the default, with a radius.
    double count;
} azulejo_mesh_density;

/// Writes the defaults. `struct_size` is sizeof *density.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT.
azulejo_status azulejo_mesh_density_init(azulejo_mesh_density *density, size_t struct_size);

/// Makes a maximal set of samples on a mesh with a density: azulejo_psp_adaptive_sample, where the
/// radius at a density d is that at density 1 over sqrt(d). Embree is not used.
///
/// What azulejo_psp_adaptive_sample says of conflicts and of coverage holds for the radii that are
/// returned. Where the density falls to 0 within a few radii, radii are limited to four times the
/// least one on a piece of the surface of about that length.
///
/// In progressive order ranks are radii at density 1, and a `count` is exact: the report has the
/// radius at density 1, which is the last rank, and a bound of the radius at density 1 at which the
/// set is maximal. All else is as azulejo_psp_adaptive_sample says. Sets of smaller counts are
/// prefixes, bit for bit but for the radii, which are those of each set: levels of detail nest. A
/// set with a radius shares all samples with ranks of at least `quotient` times that radius, of the
/// first 100 those with ranks of at least 2.25 times it.
///
/// options: those of azulejo_psp_adaptive_sample without any radii: vertex_radii and radius must be
/// NULL.
///
/// density: the density; used during the call only.
///
/// out: the samples with normals, triangles, barycentrics and radii, and ranks in progressive
/// order, to be freed with azulejo_points_free.
///
/// report: what the call did, or NULL; iterations, rays and hits are 0.
///
/// O(samples + triangles) time for densities that change slowly.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT, also for densities that are negative, not finite, or 0
/// everywhere, above `largest`, or change faster than `slope`; AZULEJO_ERROR_TOO_LARGE as
/// azulejo_psp_adaptive_sample; AZULEJO_ERROR_CANCELLED.
azulejo_status azulejo_psp_adaptive_with_density(const azulejo_context *context,
                                                 const azulejo_mesh *mesh,
                                                 const azulejo_psp_adaptive_options *options,
                                                 const azulejo_mesh_density *density,
                                                 azulejo_points **out,
                                                 azulejo_psp_report *report);

#ifdef __cplusplus
}
#endif

#endif
