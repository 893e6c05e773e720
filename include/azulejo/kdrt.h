/* KDRT: maximal Poisson-disk sets in the plane, whole, in windows and in streams, and edited.
 * Generated from ffi/azulejo-c by cbindgen; do not edit. The conventions are in azulejo.h. */

#ifndef AZULEJO_KDRT_H
#define AZULEJO_KDRT_H

#include "base.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Options of azulejo_kdrt_sample, _sample_window, _stream, _create and _create_wide, and with
/// classes of azulejo_kdrt_sample_classes and _create_classes.
typedef struct azulejo_kdrt_options {
    uint32_t struct_size; ///< The size of the struct in bytes; set by the _init function.
    uint32_t boundary; ///< An AZULEJO_BOUNDARY_ constant; default periodic.
    /// The smallest distance between two samples: above 0, and at least 64 float spacings; it has
    /// no default. Must be 0 with a `count` and in calls with classes.
    double radius;
    double domain_min[2]; ///< The lower corner of the domain, x y; default 0 0.
    double domain_max[2]; ///< The upper corner, as in azulejo_plane_set; default 1 1.
    /// The shortest side of the leaves that tile the domain, in radii; at least 6, default 20.
    /// Larger leaves are faster, but need a larger pattern.
    double leaf_size;
    uint64_t seed; ///< Any number; another seed gives another set. Default 0.
    azulejo_progress_fn progress; ///< Default NULL: the callback of the context, if it has one.
    void *progress_user; ///< Passed to the progress callback.
    /// The exact number of samples; default 0: as many as the radius gives. Only for whole sets.
    size_t count;
    /// 1: azulejo_kdrt_sample measures the `covering_radius` of its report, which takes much longer
    /// than the sampling. Default 0. Must be 0 with the report NULL, and in other calls.
    uint32_t measure_covering_radius;
    uint32_t order; ///< An AZULEJO_ORDER_ constant; default any. Must be any for streams.
    double quotient; ///< 1.02 to 1.5; default 0: see "Order". Windows are faster with 2^(1/4).
    /// Of a progressive order: the radius of the coarsest level, at least `radius`. Default 0: the
    /// first level has one sample. Scattered windows of large domains are faster with 16 radii.
    double coarsest;
    const float *given_positions; ///< Default NULL: see "Given samples"; none with a `count`.
    const double *given_clearances; ///< The clearance of each; default NULL.
    size_t given_count; ///< The number of given samples; default 0.
} azulejo_kdrt_options;

/// The report of azulejo_kdrt_sample, _sample_window, _stream and azulejo_maximal_sample.
typedef struct azulejo_kdrt_report {
    uint32_t struct_size; ///< The size of the struct in bytes; set by the _init function.
    /// 1 if the set, of which a window has a part, is maximal for `radius`, else 0.
    uint32_t is_maximal;
    uint64_t samples; ///< The number of samples; the `count` of the options if there is one.
    /// The radius of the options, or the one found for the count. No two samples are closer.
    double radius;
    /// The covering radius, if the options have `measure_covering_radius`; else -1.
    double covering_radius;
    double seconds; ///< Wall time in seconds, without measuring `covering_radius`.
} azulejo_kdrt_report;

/// Called with a part of a set. Returns 0 to continue, any other value to cancel the call.
/// - user: the `user` of the call.
/// - positions: at least one sample, x y each, valid until the callback returns.
typedef uint32_t (*azulejo_kdrt_visit_fn)(void *user, const float *positions, size_t count);

azulejo_status azulejo_kdrt_options_init(azulejo_kdrt_options *options, size_t struct_size);

azulejo_status azulejo_kdrt_report_init(azulejo_kdrt_report *report, size_t struct_size);

/// Makes a maximal, conflict-free set of samples of a rectangle: about 0.6966 * area / radius^2, or
/// exactly `count`. Tiles clips of one small pattern over a random kd-tree and repairs the seams
/// (thesis chapter 2). A domain with less area than the pattern, or narrower than 13 radii, is not
/// tiled: it gets the set of azulejo_maximal_sample.
///
/// With a count, small regions of a set of about that many samples are made again until the number
/// is right. If that fails, which is rare, crowded samples of a larger set are dropped:
/// `is_maximal` is 0.
///
/// In progressive order the set consists of nested maximal sets, coarse to fine, sorted by falling
/// rank. Sets of one domain, quotient, coarsest radius and seed share their levels: by default a
/// set is a prefix of those of half its radius, a quarter and so on, bit for bit, and with a count
/// of those with a larger one. Then `radius` in the report is the last rank, `is_maximal` 0.
/// - O(samples) time, and 24 bytes of memory per sample; with a count about twice as much, in
///   progressive order 64 bytes and about fifteen times the time, more with a smaller quotient;
///   O(samples * log samples) to measure the covering radius.
/// - Errors: AZULEJO_ERROR_INVALID_ARGUMENT also for a count whose radius is below 64 float
///   spacings.
azulejo_status azulejo_kdrt_sample(const azulejo_context *context,
                                   const azulejo_kdrt_options *options,
                                   azulejo_points **out,
                                   azulejo_kdrt_report *report);

/// Makes the part of a set of azulejo_kdrt_sample that lies in a window of the domain, and no more:
/// the same floats in the same order, with the same ranks. Windows that partition the domain have
/// every sample once, by threads, processes and machines that do not communicate. For many windows
/// of one plane, azulejo_kdrt_create makes the pattern once.
/// - options: those of the whole set, with a radius.
/// - window_min, window_max: the corners, x y each, with domain_min <= window_min < window_max <=
///   domain_max, of the samples with window_min <= x < window_max. May contain no sample.
/// - O(samples in the window and within 22 radii along x and 18 along y) time and memory, and the
///   making of the pattern, of about 28,000 samples with the default leaves. In progressive order
///   each level, of radius R, adds about 12 R to the margin: in all about 56,000 samples at a
///   quotient of 2^(1/8) or 15,000 at 2^(1/4) for each level. A domain without tiles is made whole.
/// - Errors: AZULEJO_ERROR_TOO_LARGE counts the samples of the window only; the domain may have as
///   many as floats can carry, up to about 10^11.
azulejo_status azulejo_kdrt_sample_window(const azulejo_context *context,
                                          const azulejo_kdrt_options *options,
                                          const double *window_min,
                                          const double *window_max,
                                          azulejo_points **out,
                                          azulejo_kdrt_report *report);

/// Makes the set of azulejo_kdrt_sample and passes it to a callback part by part, in its order,
/// instead of keeping it: up to about 10^11 samples, as many as floats can carry.
/// - options: those of the whole set, with a radius and in any order.
/// - visit: gets parts of at most about 50,000 samples, the same ones for every number of threads.
///   While it runs on the calling thread, the others make the next parts. It can cancel the call.
/// - O(samples) time; memory for the pattern and at most 8 parts per thread. A domain that is not
///   tiled is made as a whole and is one part.
azulejo_status azulejo_kdrt_stream(const azulejo_context *context,
                                   const azulejo_kdrt_options *options,
                                   azulejo_kdrt_visit_fn visit,
                                   void *user,
                                   azulejo_kdrt_report *report);

/// A plane: a set of azulejo_kdrt_sample or _sample_classes whose windows can be made.
typedef struct azulejo_kdrt azulejo_kdrt;

/// Makes what all windows of a plane need: its pattern and tables. The plane keeps neither the
/// context nor any thread, and copies given samples.
/// - options: those of the whole set, with a radius. Only this call calls the progress callback.
/// - O(samples of the pattern) time, about 28,000 with the default leaves. A plane takes about 0.9
///   MB and 1 byte for each radius of the sides of the domain, up to about 10^11 samples. A domain
///   that is not tiled is kept as a whole, in 8 bytes per sample; in progressive order levels of up
///   to 65,536 samples are, unless the coarsest is tiled, in 16 bytes per sample, and each level
///   takes 16 KB. In progressive order and of several classes windows add up to 32 MB.
azulejo_status azulejo_kdrt_create(const azulejo_context *context,
                                   const azulejo_kdrt_options *options,
                                   azulejo_kdrt **out);

/// Makes a wide plane: up to a million radii wide and high and more, wherever it lies. As floats
/// cannot carry so many samples, only azulejo_kdrt_window_into gives them.
/// - options: with a radius, in any order. The samples are others than those of
///   azulejo_kdrt_create. They lie on a lattice whose spacing, azulejo_kdrt_unit, is 1/512 to 1/256
///   of the radius, and every place is within the radius + 3 of these of a sample. The domain is at
///   most 2^29 of them, at least 1,048,576 radii, wide and high, and large enough to be tiled.
/// - O(samples of the pattern) time, and the memory of azulejo_kdrt_create.
azulejo_status azulejo_kdrt_create_wide(const azulejo_context *context,
                                        const azulejo_kdrt_options *options,
                                        azulejo_kdrt **out);

/// Makes the samples of a plane that lie in a window of its domain, with their classes: those of
/// azulejo_kdrt_sample_window, in the same order. All work happens on the calling thread. Very
/// large windows are made faster by azulejo_kdrt_sample_window, on many threads.
/// - window_min, window_max: as in azulejo_kdrt_sample_window.
/// - O(samples in the window and within about 20 radii of it) time and memory; in progressive order
///   also those of each level that is not kept, in the margin that azulejo_kdrt_sample_window has.
///   The plane keeps these, up to 32 MB: the first window in a region takes longest.
azulejo_status azulejo_kdrt_window(const azulejo_kdrt *plane,
                                   const double *window_min,
                                   const double *window_max,
                                   azulejo_points **out);

/// Writes the samples of a window into the caller's arrays, relative to its lower corner. The
/// window of a periodic plane may lie anywhere and cross seams: so the plane goes on without end.
///
/// Positions are differences to window_min, rounded down to floats: at least 0, at most the extent.
/// They are exact if window_min is a multiple of azulejo_kdrt_unit and the window less than 2^24
/// units wide and high; otherwise two samples may be closer than the radius by the spacing of
/// floats at the extent. Windows that share an edge share no sample and lose none.
/// - window_min, window_max: the corners, x y each. Periodic: at most 2^32 periods from the domain,
///   at most one period apart. Bounded: in the domain.
/// - positions: receives x y of each sample. May be NULL if `capacity` is 0.
/// - ranks, classes: receive those of each sample; NULL if they are not wanted, or not there.
/// - capacity: the samples that each array has room for; see azulejo_kdrt_window_capacity.
/// - count: receives the number of samples; above `capacity` nothing else is written.
///
/// Time, memory and threads are those of azulejo_kdrt_window, and so is the order of classes and
/// of ranks; else it is arbitrary, but the same in every call.
/// - Errors: AZULEJO_ERROR_INVALID_ARGUMENT also for a `capacity` below the number of samples, and
///   for `ranks` or `classes` of a plane that has none.
azulejo_status azulejo_kdrt_window_into(const azulejo_kdrt *plane,
                                        const double *window_min,
                                        const double *window_max,
                                        float *positions,
                                        float *ranks,
                                        uint32_t *classes,
                                        size_t capacity,
                                        size_t *count);

/// The most samples that any window of an extent w h can have: 2 / sqrt(3) * w * h / r^2 +
/// (w + h) / r + 1 (Oler 1961), 1.66 times as many as large windows have on average; of several
/// classes the sum of these.
azulejo_status azulejo_kdrt_window_capacity(const azulejo_kdrt *plane,
                                            const double *extent,
                                            size_t *out);

/// The spacing of the lattice on which all samples of a plane lie, a power of two: a float spacing,
/// of a wide plane 1/512 to 1/256 of the radius.
double azulejo_kdrt_unit(const azulejo_kdrt *plane);

/// Frees a plane. NULL is allowed.
void azulejo_kdrt_free(azulejo_kdrt *plane);

/// Makes samples of several classes in a rectangle, as azulejo_classes says. Classes of equal radii
/// get equal shares. A single class of the largest own radius has all the samples that it would
/// have alone, those of azulejo_kdrt_sample; smaller ones have what is left, about 0.8 of that with
/// the matrix of azulejo_classes_radii and factor 1, 0.95 with factor 0.7 (docs/classes.md).
///
/// In progressive order the samples of each class are sorted coarse to fine, so that a host can
/// show the first part of each. Of the classes of equal own radii R, the samples up to a rank t are
/// at least r_ij t / R apart, and every place is within `quotient` times r_ij t / R of one of them,
/// or within r_ij of a sample of a class of larger own radius; where a class has less than 100 of
/// them, within 2 or the square of `quotient` times that. It takes about 8 times the time.
/// - options: `radius`, `count` and `measure_covering_radius` must be 0. `coarsest` is the radius
///   of the first level of each class, at least the largest own radius.
/// - out: the samples with their classes, sorted by these, then by y and x or in order by rank.
/// - O(samples) time, for a given number of classes, and 64 bytes of memory per sample. Where the
///   domain is a torus narrower than about 10 times the largest r_ij between classes of equal own
///   radii, these classes are filled by one thread, with 512 bytes per sample.
/// - Errors: AZULEJO_ERROR_INVALID_ARGUMENT also for an own radius below 64 float spacings.
azulejo_status azulejo_kdrt_sample_classes(const azulejo_context *context,
                                           const azulejo_kdrt_options *options,
                                           const azulejo_classes *classes,
                                           azulejo_points **out,
                                           azulejo_classes_report *report);

/// Makes what all windows of a plane of several classes need: azulejo_kdrt_window then makes the
/// samples of azulejo_kdrt_sample_classes that lie in any of them, in the same order. The plane is
/// kept as by azulejo_kdrt_create.
/// - options, classes: those of the whole set. Only this call calls the progress callback.
/// - O(samples of the pattern) time, and the memory of azulejo_kdrt_create. A window takes
///   O(samples in and around it): classes of one own radius depend on what lies within about 30
///   times the largest r_ij between them, and all classes of larger radii on what lies around that
///   again. In progressive order each level adds 30 times its r_ij: windows of large domains need a
///   `coarsest` of a few times the largest own radius. On a torus narrower than about 10 times the
///   largest r_ij between classes of equal own radii, these and the classes before are kept, in 12
///   bytes per sample.
azulejo_status azulejo_kdrt_create_classes(const azulejo_context *context,
                                           const azulejo_kdrt_options *options,
                                           const azulejo_classes *classes,
                                           azulejo_kdrt **out);

/// Options of azulejo_kdrt_merge.
typedef struct azulejo_kdrt_merge_options {
    uint32_t struct_size; ///< The size of the struct in bytes; set by the _init function.
    uint32_t boundary; ///< An AZULEJO_BOUNDARY_ constant; default periodic.
    /// As in azulejo_kdrt_options: above 0, and at least 64 float spacings. It has no default.
    double radius;
    double domain_min[2]; ///< The lower corner of the domain, x y; default 0 0.
    double domain_max[2]; ///< The upper corner, as in azulejo_plane_set; default 1 1.
    uint64_t seed; ///< Any number; another seed gives another set. Default 0.
    azulejo_progress_fn progress; ///< Default NULL: the callback of the context, if it has one.
    void *progress_user; ///< Passed to the progress callback.
    /// 1: the pieces are maximal sets of this radius, at least farther than it from their edges.
    /// Then only their seams are tested: the same set in less time. Default 0.
    uint32_t maximal_pieces;
    uint32_t reserved; ///< Must be 0.
} azulejo_kdrt_merge_options;

/// The fate of the samples of the pieces.
typedef struct azulejo_kdrt_merge_report {
    uint32_t struct_size; ///< The size of the struct in bytes; set by the _init function.
    uint32_t reserved; ///< Always 0.
    uint64_t kept; ///< The samples of the pieces that are in the result.
    uint64_t eliminated; ///< The samples of the pieces that are not.
    uint64_t inserted; ///< The new samples.
} azulejo_kdrt_merge_report;

/// A set that was made independently, such as by azulejo_kdrt_sample or _sample_window.
typedef struct azulejo_kdrt_merge_piece {
    /// The samples, x y each, with min <= x < max, none closer than the radius; maximal or not.
    const float *positions;
    size_t count; ///< The number of samples.
    double min[2]; ///< The lower corner of the piece's rectangle, x y.
    double max[2]; ///< The upper corner, above the lower one on both axes.
} azulejo_kdrt_merge_piece;

azulejo_status azulejo_kdrt_merge_options_init(azulejo_kdrt_merge_options *options,
                                               size_t struct_size);

azulejo_status azulejo_kdrt_merge_report_init(azulejo_kdrt_merge_report *report,
                                              size_t struct_size);

/// Merges sets of samples on rectangles that do not overlap, and points that must stay, into one
/// maximal, conflict-free set of the domain (thesis section 2.4.4). Only the seams change.
///
/// Whatever no sample covers is filled: where a piece is not maximal, where there is no piece, and
/// the whole domain if nothing is given. A sample of a piece is removed only if it is closer than
/// the radius to a fixed point or to a sample that stays of another piece or, across a seam, of its
/// own; which one depends on the seed and the order of the pieces. Of maximal pieces, new samples
/// lie within the radius of a removed sample or of the edge of a piece.
/// - pieces: `piece_count` rectangles in the domain. piece_size: sizeof(azulejo_kdrt_merge_piece).
/// - fixed: `fixed_count` points that must stay, no two of them closer than the radius.
/// - out: all fixed points, then the kept samples piece by piece, both in their order and bit for
///   bit as given, then the new ones.
/// - O(samples) time and memory, and at most O(piece_count^2) time for the rectangles. A periodic
///   domain narrower than about 10 radii is filled on one thread.
/// - Errors: AZULEJO_ERROR_INVALID_ARGUMENT also for rectangles that overlap or leave the domain,
///   samples outside theirs, and two samples of one piece (of `maximal_pieces` only near edges) or
///   two fixed points that are closer than the radius (the message has their indices).
azulejo_status azulejo_kdrt_merge(const azulejo_context *context,
                                  const azulejo_kdrt_merge_options *options,
                                  const azulejo_kdrt_merge_piece *pieces,
                                  size_t piece_count,
                                  size_t piece_size,
                                  const float *fixed,
                                  size_t fixed_count,
                                  azulejo_points **out,
                                  azulejo_kdrt_merge_report *report);

/// A set of the plane that is edited. It keeps its context, which may be freed before it.
typedef struct azulejo_plane azulejo_plane;

/// Makes a set of the plane that is edited. Its samples have ids (azulejo_points_ids), at first 0,
/// 1, 2 and so on in their order. A sample keeps id and bytes; no other gets that id.
/// - options: `count`, `order` and `measure_covering_radius` must have their defaults, and with
///   positions `leaf_size` too. Given samples have ids of their own, also from 0 on. The handle
///   keeps the progress callback for all its calls.
/// - positions: any floats of the domain, no two closer than the radius and none closer to a given
///   sample than its clearance. The first azulejo_plane_refill looks for gaps everywhere.
/// - count: the number of positions. 0: it begins with the set of azulejo_kdrt_sample.
/// - O(samples) time, and about 40 bytes of memory per sample.
azulejo_status azulejo_plane_create(const azulejo_context *context,
                                    const azulejo_kdrt_options *options,
                                    const float *positions,
                                    size_t count,
                                    azulejo_plane **out);

/// Copies the samples in their present state, with their ids, by rising ids. O(samples).
azulejo_status azulejo_plane_points(const azulejo_plane *plane, azulejo_points **out);

/// Erases the samples in a region. On a torus a sample lies in it if one of its images lies in the
/// box, and one in the ball, so that a brush may reach over the seam. Undo is as of
/// azulejo_psp_erase.
/// - erased: the erased samples with their ids, by rising ids; NULL if they are not wanted.
/// - O(samples in the tiles of 12 to 24 radii that the region touches).
azulejo_status azulejo_plane_erase(azulejo_plane *plane,
                                   const azulejo_region *region,
                                   azulejo_points **erased);

/// Erases samples by their ids, as azulejo_psp_erase_ids. O(samples in the tiles that they are in).
azulejo_status azulejo_plane_erase_ids(azulejo_plane *plane,
                                       const uint64_t *ids,
                                       size_t count,
                                       azulejo_points **erased);

/// Puts erased samples back, as azulejo_psp_restore. O(points + samples in the tiles around them).
azulejo_status azulejo_plane_restore(azulejo_plane *plane, const azulejo_points *points);

/// Adds given samples, x y each, to those of the options, as azulejo_psp_add_given. O(samples in
/// the tiles that the clearances touch), for each.
azulejo_status azulejo_plane_add_given(azulejo_plane *plane,
                                       const float *positions,
                                       const double *clearances,
                                       size_t count,
                                       uint64_t *first_id,
                                       azulejo_points **erased);

/// Removes given samples by their ids: azulejo_plane_refill fills the gaps. O(given samples).
azulejo_status azulejo_plane_remove_given(azulejo_plane *plane,
                                          const uint64_t *ids,
                                          size_t count);

/// Makes the set maximal again after edits, but looks only where samples were erased or given
/// samples removed since the last refill. All samples that stand stay as they are. The new ones
/// depend on `seed`, on the edits and on what stands around them, and can lie up to a radius
/// outside a region that was erased.
/// - added: the new samples with their ids, by rising ids; NULL if they are not wanted.
/// - report: of the set after the call; `covering_radius` is -1.
/// - O(area in and around the edited regions + given samples). If cancelled, repeat it.
azulejo_status azulejo_plane_refill(azulejo_plane *plane,
                                    uint64_t seed,
                                    azulejo_points **added,
                                    azulejo_kdrt_report *report);

/// Frees a set. NULL is allowed.
void azulejo_plane_free(azulejo_plane *plane);

/// Options of azulejo_maximal_sample.
typedef struct azulejo_maximal_options {
    uint32_t struct_size; ///< The size of the struct in bytes; set by the _init function.
    uint32_t boundary; ///< An AZULEJO_BOUNDARY_ constant; default periodic.
    /// As in azulejo_kdrt_options: above 0, and at least 64 float spacings. It has no default.
    double radius;
    double domain_min[2]; ///< The lower corner of the domain, x y; default 0 0.
    double domain_max[2]; ///< The upper corner, as in azulejo_plane_set; default 1 1.
    uint64_t seed; ///< Any number; another seed gives another set. Default 0.
    azulejo_progress_fn progress; ///< Default NULL: the callback of the context, if it has one.
    void *progress_user; ///< Passed to the progress callback.
} azulejo_maximal_options;

azulejo_status azulejo_maximal_options_init(azulejo_maximal_options *options,
                                            size_t struct_size);

/// Makes a maximal, conflict-free set of samples of a rectangle by throwing darts into what is
/// uncovered, one after the other: about 0.6966 * area / radius^2 samples without any bias. The
/// reference for other sets, and much slower than azulejo_kdrt_sample. O(samples) time and memory
/// (Ebeida et al., A Simple Algorithm for Maximal Poisson-Disk Sampling, 2012).
azulejo_status azulejo_maximal_sample(const azulejo_context *context,
                                      const azulejo_maximal_options *options,
                                      azulejo_points **out,
                                      azulejo_kdrt_report *report);

#ifdef __cplusplus
}
#endif

#endif
