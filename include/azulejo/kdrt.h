/*
 * KDRT: maximal Poisson-disk sets in the plane, whole, in windows and in streams, and edited.
 *
 * Generated from ffi/azulejo-c by cbindgen; do not edit. The conventions are in azulejo.h.
 */

#ifndef AZULEJO_KDRT_H
#define AZULEJO_KDRT_H

#include "base.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Options of azulejo_kdrt_sample, azulejo_kdrt_sample_window, azulejo_kdrt_stream,
/// azulejo_kdrt_create, azulejo_kdrt_create_wide and, with classes, azulejo_kdrt_sample_classes and
/// azulejo_kdrt_create_classes.
typedef struct azulejo_kdrt_options {
    /// The size of the struct in bytes; set by the _init function.
    uint32_t struct_size;
    /// An AZULEJO_BOUNDARY_ constant; default periodic.
    uint32_t boundary;
    /// The smallest distance between two samples, in the units of the domain: above 0, and at least
    /// 64 times the spacing of floats at the largest coordinate. It has no default. Must be 0 if
    /// there is a `count`, from which the radius follows, and in calls with classes, which have
    /// radii of their own.
    double radius;
    /// The lower corner of the domain, x y; finite; default 0 0.
    double domain_min[2];
    /// The upper corner of the domain, x y; finite and above the lower corner on both axes; default
    /// 1 1. Neither side may be longer than 2^100 times the other.
    double domain_max[2];
    /// The shortest side of the leaves that tile the domain, in radii; at least 6, default 20.
    /// Sides are random, up to twice as long. Larger leaves are faster and have fewer seams, but
    /// need a larger pattern.
    double leaf_size;
    /// Any number; another seed gives another set. Default 0.
    uint64_t seed;
    /// Called during the call; default NULL: the callback of the context, if it has one.
    azulejo_progress_fn progress;
    /// Passed to the progress callback.
    void *progress_user;
    /// The exact number of samples; default 0: as many as the radius gives. Must be 0 for windows,
    /// streams and planes that are kept, which are made by radius.
    size_t count;
    /// 1: azulejo_kdrt_sample measures the `covering_radius` in its report, which takes much longer
    /// than the sampling. Default 0. Must be 0 with the report NULL, and in other calls.
    uint32_t measure_covering_radius;
    /// An AZULEJO_ORDER_ constant; default any. In progressive order every prefix of the set is
    /// well spread, and azulejo_points_ranks says how well. Must be any for streams, which come
    /// place by place.
    uint32_t order;
    /// Of a progressive order: how many times longer the radius of each level is than that of the
    /// next, 1.02 to 1.5. Every prefix of 100 samples and more covers the domain within this times
    /// its last rank, smaller ones within twice that rank, or the square of the quotient times it
    /// if that is more. Default 0: 2^(1/8). Scattered windows of large domains are several times as
    /// fast with 2^(1/4).
    double quotient;
    /// Of a progressive order: the radius of the coarsest level, at least `radius`. Default 0: as
    /// coarse as the domain, so that the first level has one sample. Scattered windows of large
    /// domains are faster with a shorter one, such as 16 radii.
    double coarsest;
    /// Samples that stand already, x y each, finite, anywhere in the plane; on a torus they wrap.
    /// Read during the call only, but for azulejo_kdrt_create, which copies them. Default NULL:
    /// none. Must be none where there is a `count`.
    const float *given_positions;
    /// The clearance of each, finite and 0 or more, in the units of the domain: new samples are at
    /// least so far from it, and what is nearer to it is covered. 0 has no effect. Default NULL:
    /// all have the `radius`. In calls with classes it has a row for each given sample, with a
    /// clearance for each class.
    const double *given_clearances;
    /// The number of given samples; default 0.
    size_t given_count;
} azulejo_kdrt_options;

/// The report of azulejo_kdrt_sample, azulejo_kdrt_sample_window, azulejo_kdrt_stream and
/// azulejo_maximal_sample.
typedef struct azulejo_kdrt_report {
    /// The size of the struct in bytes; set by the _init function.
    uint32_t struct_size;
    /// 1 if the set, of which a window has a part, is maximal for `radius`, else 0.
    uint32_t is_maximal;
    /// The number of samples; the `count` of the options if there is one.
    uint64_t samples;
    /// The radius, that of the options or the one found for the count, in the units of the domain.
    /// No two samples are closer.
    double radius;
    /// The covering radius as azulejo_plane_covering_radius measures it, in the units of the
    /// domain, if the options have `measure_covering_radius`; else -1.
    double covering_radius;
    /// Wall time in seconds, without the measuring of `covering_radius`.
    double seconds;
} azulejo_kdrt_report;

/// Called with a part of a set, on the thread that made the call. See "Callbacks" at the top.
///
/// user: the `user` of the call.
///
/// positions: the samples, x y each, valid until the callback returns; `count` of them, at least
/// one.
///
/// Returns 0 to continue, any other value to cancel the call.
typedef uint32_t (*azulejo_kdrt_visit_fn)(void *user, const float *positions, size_t count);

/// Writes the defaults. `struct_size` is sizeof *options.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT.
azulejo_status azulejo_kdrt_options_init(azulejo_kdrt_options *options, size_t struct_size);

/// Writes zeros and the size. `struct_size` is sizeof *report.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT.
azulejo_status azulejo_kdrt_report_init(azulejo_kdrt_report *report, size_t struct_size);

/// Makes a maximal, conflict-free set of samples of a rectangle: about 0.6966 * area / radius^2 of
/// them, or exactly `count`.
///
/// Tiles clips of one small pattern over a random kd-tree and repairs the seams (thesis chapter 2).
/// Its only bias is at the seams. A domain with less area than the pattern, or narrower than 13
/// radii, is not tiled: it gets the set of azulejo_maximal_sample. A radius longer than the
/// diagonal of the domain gives one sample.
///
/// With a count, the radius follows from the density of maximal sets. The samples by which that set
/// differs from the count, mostly a few per thousand, are corrected by making small regions again,
/// so the set is still conflict-free and maximal. If no maximal set of exactly that many samples is
/// found, which is rare, the most crowded samples of a larger set are dropped and `is_maximal` is
/// 0.
///
/// In progressive order the set is made of nested maximal sets, coarse to fine, each filled around
/// the one before, and sorted by falling rank (azulejo_points_ranks). The first of its samples, any
/// number of them, are a set with fewer samples: at least as far apart as the last of their ranks,
/// and within `quotient` times that of every point of the domain; if they are less than 100, within
/// twice that, or the square of the quotient times it if that is more. So levels of detail are
/// nested.
/// Sets of one domain, quotient, coarsest radius and seed share their levels. With default options
/// a set is a prefix of those whose radius is half of its own, a quarter and so on, bit for bit;
/// and with a count, a prefix of those with a larger one. Then `radius` in the report is the last
/// rank, and `is_maximal` is 0.
///
/// Around given samples the set is conflict-free and maximal as well: new samples are at least the
/// clearance of each given one from it, in double arithmetic from the floats, and every point of
/// the domain is within the radius of a new sample or the clearance of a given one, up to 6 float
/// spacings at the largest coordinate. Given samples are not moved, dropped, compared with each
/// other or part of the result. They take about a microsecond each, more than that only where their
/// clearances are of very many radii. In progressive order they cover from the first level on.
///
/// options: with a radius or a count, not both.
///
/// out: the samples, x y each, to be freed with azulejo_points_free. With a count, samples that
/// were made again take the places of others in the order.
///
/// report: what the call achieved, or NULL. It costs nothing unless `measure_covering_radius` is 1;
/// then progress includes the measuring.
///
/// O(samples) time, and 24 bytes of memory per sample; with a count about twice as much, in
/// progressive order 64 bytes and about fifteen times the time, more with a smaller quotient.
/// Measuring the covering radius takes O(samples * log samples).
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT, also for a radius (or a count whose radius is) below 64
/// times the spacing of floats at the largest coordinate; AZULEJO_ERROR_TOO_LARGE, with the
/// estimate, for 2^32 samples or more, or more than memory holds; AZULEJO_ERROR_CANCELLED.
azulejo_status azulejo_kdrt_sample(const azulejo_context *context,
                                   const azulejo_kdrt_options *options,
                                   azulejo_points **out,
                                   azulejo_kdrt_report *report);

/// Makes the part of a set of azulejo_kdrt_sample that lies in a window of the domain, without
/// making the rest: the same floats in the same order.
///
/// Windows that partition the domain have every sample once, and can be made in any order, by
/// threads, processes and machines that do not communicate. The samples in a window depend on
/// nothing farther from it than 22 radii along x and 18 along y.
///
/// In progressive order a window has the samples of the whole set that lie in it, with their ranks,
/// sorted in the same way, so prefixes of equal last rank fit together. Each level adds about 12 of
/// its radii to the margin in which the levels before are needed: for a level of radius R that is
/// about 145 R at a quotient of 2^(1/8), 75 R at 2^(1/4) and 41 R at 2^(1/2), in all about 56,000,
/// 15,000 and 4,500 samples, as long as the domain is larger than that. A level costs about 0.2
/// microseconds for each of them. From `coarsest` down to `radius` there are 8, 4 or 2 levels for
/// each factor of two.
///
/// options: those of the whole set, with a radius.
///
/// window_min, window_max: the corners, x y each, with domain_min <= window_min < window_max <=
/// domain_max. The window has the samples with window_min <= x < window_max. It may be smaller than
/// the radius and may contain no sample.
///
/// out: the samples, x y each, to be freed with azulejo_points_free.
///
/// report: what the call achieved, or NULL.
///
/// O(samples in and around the window) time and memory, and in every call the making of the
/// pattern, of about 28,000 samples with the default leaves: for many windows of one plane,
/// azulejo_kdrt_create makes it once. A domain that is not tiled is made as a whole.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT as azulejo_kdrt_sample; AZULEJO_ERROR_TOO_LARGE for the
/// samples of the window, while the domain may have as many as floats can carry, up to about 10^11;
/// AZULEJO_ERROR_CANCELLED.
azulejo_status azulejo_kdrt_sample_window(const azulejo_context *context,
                                          const azulejo_kdrt_options *options,
                                          const double *window_min,
                                          const double *window_max,
                                          azulejo_points **out,
                                          azulejo_kdrt_report *report);

/// Makes the set of azulejo_kdrt_sample and passes it to a callback part by part, in its order,
/// instead of keeping it: for sets of any size that are written or consumed at once.
///
/// options: those of the whole set, with a radius.
///
/// visit: gets the parts: windows at most about 270 radii wide, of at most about 50,000 samples,
/// the same ones for every number of threads. While it runs on the calling thread, the threads of
/// the context make the next parts.
///
/// user: passed to `visit`.
///
/// report: what the call achieved, or NULL.
///
/// O(samples) time; memory for the pattern and at most 8 parts per thread. A domain that is not
/// tiled is made as a whole and is one part.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT as azulejo_kdrt_sample, so for more samples than floats
/// can carry, about 10^11; AZULEJO_ERROR_TOO_LARGE for a domain that is not tiled;
/// AZULEJO_ERROR_CANCELLED, also if `visit` cancels. A progressive order is refused.
azulejo_status azulejo_kdrt_stream(const azulejo_context *context,
                                   const azulejo_kdrt_options *options,
                                   azulejo_kdrt_visit_fn visit,
                                   void *user,
                                   azulejo_kdrt_report *report);

/// A plane: a set of azulejo_kdrt_sample or azulejo_kdrt_sample_classes of which any window can be
/// made at any time. Immutable: several threads may make windows of it at once.
typedef struct azulejo_kdrt azulejo_kdrt;

/// Makes what all windows of a plane need: its pattern and tables.
///
/// options: those of the whole set, with a radius. The progress callback is called during this call
/// only.
///
/// out: the plane, to be freed with azulejo_kdrt_free. It keeps neither the context nor any thread.
///
/// O(samples of the pattern) time: about 28,000 samples with the default leaves. The plane takes 32
/// bytes of memory for each of them, 0.9 MB in all, and 1 byte for each radius of the sides of the
/// domain, however many samples the domain has. A domain that is not tiled (see
/// azulejo_kdrt_sample) is made as a whole and kept, in 8 bytes per sample. In progressive order
/// the plane also takes 16 KB per level and, unless its coarsest level is tiled, makes and keeps
/// the levels that have up to 65,536 samples in the whole domain, in 16 bytes per sample. In
/// progressive order and of several classes it also keeps what windows make, in up to 32 MB.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT as azulejo_kdrt_sample, so for more samples than floats
/// can carry, about 10^11; AZULEJO_ERROR_TOO_LARGE for a domain that is not tiled;
/// AZULEJO_ERROR_CANCELLED.
azulejo_status azulejo_kdrt_create(const azulejo_context *context,
                                   const azulejo_kdrt_options *options,
                                   azulejo_kdrt **out);

/// Makes a wide plane: up to a million radii wide and high and more, wherever it lies. Floats
/// cannot carry so many samples, so that they are only given by azulejo_kdrt_window_into; other
/// calls refuse the plane.
///
/// options: with a radius, in any order. It has other samples than azulejo_kdrt_create makes with
/// the same options. They lie on a lattice whose spacing, azulejo_kdrt_unit, is 1/512 to 1/256 of
/// the radius, and every place is within the radius + 3 of these of a sample. The domain is at most
/// 2^29 of them, at least 1,048,576 radii, wide and high, and large enough to be tiled (see
/// azulejo_kdrt_sample).
///
/// out: the plane, to be freed with azulejo_kdrt_free. It keeps neither the context nor any thread.
///
/// Time and memory are those of azulejo_kdrt_create.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT, for `order` and `domain_max` too;
/// AZULEJO_ERROR_CANCELLED.
azulejo_status azulejo_kdrt_create_wide(const azulejo_context *context,
                                        const azulejo_kdrt_options *options,
                                        azulejo_kdrt **out);

/// Makes the samples of a plane that lie in a window of its domain: the same floats in the same
/// order as azulejo_kdrt_sample_window and the whole set. Those of several classes have
/// azulejo_points_classes.
///
/// All work happens on the calling thread, and other threads may make windows of the same plane
/// meanwhile. Very large windows are made faster by azulejo_kdrt_sample_window, on the threads of a
/// context.
///
/// window_min, window_max: as in azulejo_kdrt_sample_window.
///
/// out: the samples, x y each, to be freed with azulejo_points_free.
///
/// O(samples in the window and within about 20 radii of it) time and memory; in progressive order
/// also those of each level that is not kept, in the margin that azulejo_kdrt_sample_window has for
/// it. The plane keeps these, up to 32 MB, for the windows that follow: the first window in a
/// region takes long, those near it do not. The samples do not depend on what is kept.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT; AZULEJO_ERROR_TOO_LARGE for 2^32 samples or more in the
/// window, or more than memory holds.
azulejo_status azulejo_kdrt_window(const azulejo_kdrt *plane,
                                   const double *window_min,
                                   const double *window_max,
                                   azulejo_points **out);

/// Writes the samples of a window into the caller's arrays, relative to its lower corner. The
/// window of a periodic plane may lie anywhere and cross seams: so the plane goes on without end.
///
/// Positions are differences to window_min, rounded down to floats: at least 0, and at most the
/// extent of the window. They are exact, and so at least the radius apart, if window_min is a
/// multiple of azulejo_kdrt_unit and the window less than 2^24 units wide and high; otherwise two
/// samples may be closer than the radius by the spacing of floats at the extent of the window.
/// Windows that share an edge, given by the same number, share no sample and lose none, and window
/// corners far from 0 cost no precision of the positions.
///
/// window_min, window_max: the corners, x y each. Periodic: at most 2^32 periods from the domain,
/// at most one period apart. Bounded: in the domain.
///
/// positions: receives x y of each sample. NULL is allowed if `capacity` is 0.
///
/// ranks, classes: receive those of each sample; NULL if they are not wanted, or not there.
///
/// capacity: the number of samples that each array has room for. azulejo_kdrt_window_capacity has a
/// number that suffices for all windows of a size.
///
/// count: receives the number of samples of the window. If it is above `capacity`, the call fails
/// and writes nothing else.
///
/// Work, memory and threads are those of azulejo_kdrt_window. Without levels and classes the order
/// is arbitrary, but the same in every call.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT, for `capacity` if it is below the number of samples, for
/// `ranks` and `classes` if the plane has none; AZULEJO_ERROR_TOO_LARGE as azulejo_kdrt_window.
azulejo_status azulejo_kdrt_window_into(const azulejo_kdrt *plane,
                                        const double *window_min,
                                        const double *window_max,
                                        float *positions,
                                        float *ranks,
                                        uint32_t *classes,
                                        size_t capacity,
                                        size_t *count);

/// The most samples that a window of a plane can have, so that one array suffices for all windows
/// of a size.
///
/// Of samples at least r apart a rectangle has at most 2 / sqrt(3) * w * h / r^2 + (w + h) / r + 1
/// (Oler 1961), 1.66 times as many as large windows have on average; of several classes the sum of
/// these.
///
/// extent: the width and height of the window, finite and above 0.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT; AZULEJO_ERROR_TOO_LARGE for 2^32 samples or more.
azulejo_status azulejo_kdrt_window_capacity(const azulejo_kdrt *plane,
                                            const double *extent,
                                            size_t *out);

/// The spacing of the lattice on which all samples of a plane lie: a power of two, the spacing of
/// floats at the largest coordinate of the domain; of a wide plane 1/512 to 1/256 of the radius. 0
/// for NULL.
double azulejo_kdrt_unit(const azulejo_kdrt *plane);

/// Frees a plane. NULL is allowed.
void azulejo_kdrt_free(azulejo_kdrt *plane);

/// Makes samples of several classes in a rectangle: samples of classes i and j are at least r_ij
/// apart, and for each class i every point of the domain is within r_ij of some sample of some
/// class j, up to 3 float spacings at the largest coordinate (6 around given samples).
///
/// Classes come by falling own radius; those of equal radii are filled together and get equal
/// shares. The class of the largest own radius, if no other has the same, has all the samples that
/// it would have alone, and where the domain is tiled (see azulejo_kdrt_sample) it has the very
/// samples of azulejo_kdrt_sample. Those of smaller radii have what is left: with three classes of
/// own radii 1, 1/2 and 1/4 and the matrix of azulejo_classes_radii with factor 1, the second and
/// the third have about 0.82 of the samples that they would have alone. Three classes of equal
/// radii have 0.79 each, 0.90 with factor 0.85, 0.95 with factor 0.7. Two radii that are nearly
/// equal give other shares than two equal ones: 1 and 0.9 give 1 and 0.68.
///
/// In progressive order the samples of each class are sorted coarse to fine, and
/// azulejo_points_ranks has their ranks, which are radii of levels. Of the classes of equal own
/// radii R, the samples up to a rank t are at least r_ij t / R apart, and every point of the domain
/// is within `quotient` times r_ij t / R of one of them, or within r_ij of a sample of a class of
/// larger own radius; where a class has less than 100 of them, within 2 or the square of `quotient`
/// times that instead. So a host can show the first part of each class, near parts of a scene more
/// than far ones. It takes about eight times the time.
///
/// options: `radius` must be 0, since classes have radii of their own; `count` and
/// `measure_covering_radius` must be 0. `coarsest` is the radius of the first level of each class,
/// at least the largest own radius. `given_clearances`, if not NULL, has given_count rows, each
/// with a clearance for each class; NULL: each class's own radius.
///
/// classes: with at least one class. A single class has the set of azulejo_kdrt_sample, in its
/// order.
///
/// out: the samples, x y each, with azulejo_points_classes, sorted by class, and within a class by
/// y and x, in progressive order by falling rank; to be freed with azulejo_points_free.
///
/// report: how many samples each class has, or NULL.
///
/// O(samples) time, for a given number of classes, and 64 bytes of memory per sample. Where the
/// domain is a torus narrower than about 10 times the largest r_ij between classes of equal own
/// radii, these classes are filled by one thread, with 512 bytes per sample.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT, also for an own radius below 64 times the spacing of
/// floats at the largest coordinate; AZULEJO_ERROR_TOO_LARGE for 2^32 samples or more, or more than
/// memory holds; AZULEJO_ERROR_CANCELLED.
azulejo_status azulejo_kdrt_sample_classes(const azulejo_context *context,
                                           const azulejo_kdrt_options *options,
                                           const azulejo_classes *classes,
                                           azulejo_points **out,
                                           azulejo_classes_report *report);

/// Makes what all windows of a plane of several classes need. azulejo_kdrt_window then makes any of
/// its windows: the samples of azulejo_kdrt_sample_classes that lie in it, in the same order, with
/// azulejo_points_classes.
///
/// options, classes: those of the whole set. The progress callback is called during this call only.
///
/// out: the plane, to be freed with azulejo_kdrt_free. It keeps neither the context nor any thread.
///
/// A window takes O(samples in and around it) time and memory: classes of one own radius depend on
/// what lies within about 30 times the largest r_ij between two of them, and one between them and
/// classes of larger radii, and these on what lies around that again. In progressive order each
/// level adds 30 times its r_ij: windows of large domains need a `coarsest` of a few times the
/// largest own radius.
///
/// O(samples of the pattern) time. The plane takes what that of azulejo_kdrt_create takes for the
/// largest own radius, and 1 byte for each of the other radii on the sides of the domain. On a
/// torus that is narrower than about 10 times the largest r_ij between classes of equal own radii,
/// these and the classes before are made as a whole and kept, in 12 bytes per sample.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT as azulejo_kdrt_sample_classes; AZULEJO_ERROR_CANCELLED.
/// The domain may have more samples than can be held.
azulejo_status azulejo_kdrt_create_classes(const azulejo_context *context,
                                           const azulejo_kdrt_options *options,
                                           const azulejo_classes *classes,
                                           azulejo_kdrt **out);

/// Options of azulejo_kdrt_merge.
typedef struct azulejo_kdrt_merge_options {
    /// The size of the struct in bytes; set by the _init function.
    uint32_t struct_size;
    /// An AZULEJO_BOUNDARY_ constant; default periodic.
    uint32_t boundary;
    /// The smallest distance between two samples, that of the pieces, in the units of the domain:
    /// above 0, and at least 64 times the spacing of floats at the largest coordinate. It has no
    /// default.
    double radius;
    /// The lower corner of the domain, x y; finite; default 0 0.
    double domain_min[2];
    /// The upper corner of the domain, x y; finite and above the lower corner on both axes; default
    /// 1 1. Neither side may be longer than 2^100 times the other.
    double domain_max[2];
    /// Any number; another seed gives another set. Default 0.
    uint64_t seed;
    /// Called during the call; default NULL: the callback of the context, if it has one.
    azulejo_progress_fn progress;
    /// Passed to the progress callback.
    void *progress_user;
} azulejo_kdrt_merge_options;

/// The fate of the samples of the pieces. The result has the fixed points first, then the kept
/// samples, then the inserted ones.
typedef struct azulejo_kdrt_merge_report {
    /// The size of the struct in bytes; set by the _init function.
    uint32_t struct_size;
    /// Always 0.
    uint32_t reserved;
    /// The samples of the pieces that are in the result.
    uint64_t kept;
    /// The samples of the pieces that are not.
    uint64_t eliminated;
    /// The new samples.
    uint64_t inserted;
} azulejo_kdrt_merge_report;

/// A set of samples that was made independently, such as by azulejo_kdrt_sample on a bounded domain
/// or by azulejo_kdrt_sample_window.
typedef struct azulejo_kdrt_merge_piece {
    /// The samples, x y each, with min <= x < max, no two of them closer than the radius; read
    /// during the call only. They need not be maximal. NULL if there are none.
    const float *positions;
    /// The number of samples.
    size_t count;
    /// The lower corner of the piece's rectangle, x y.
    double min[2];
    /// The upper corner of the rectangle, above the lower one on both axes.
    double max[2];
} azulejo_kdrt_merge_piece;

/// Writes the defaults. `struct_size` is sizeof *options.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT.
azulejo_status azulejo_kdrt_merge_options_init(azulejo_kdrt_merge_options *options,
                                               size_t struct_size);

/// Writes zeros and the size. `struct_size` is sizeof *report.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT.
azulejo_status azulejo_kdrt_merge_report_init(azulejo_kdrt_merge_report *report,
                                              size_t struct_size);

/// Merges sets of samples on rectangles that do not overlap, and points that must stay, into one
/// maximal, conflict-free set of the domain (thesis section 2.4.4). Only the seams change.
///
/// Whatever no sample covers is filled: where a piece is not maximal, where there is no piece, and
/// the whole domain if nothing is given. A sample of a piece is removed only if it is closer than
/// the radius to a fixed point, or to a sample that stays of another piece or, across the seam of a
/// periodic domain, of its own; which of the two is removed depends on the seed and the order of
/// the pieces. If the pieces are maximal as azulejo_kdrt_sample makes them, new samples lie within
/// the radius of a removed sample or of the edge of a piece's rectangle.
///
/// pieces: `piece_count` of them, in the domain; NULL if there are none.
///
/// piece_size: sizeof(azulejo_kdrt_merge_piece).
///
/// fixed: the points that must stay, x y each, with domain_min <= x < domain_max, no two of them
/// closer than the radius; `fixed_count` of them; NULL if there are none.
///
/// out: the samples, x y each, to be freed with azulejo_points_free: all fixed points, then the
/// kept samples piece by piece, both in their order and bit for bit as given, then the new ones.
///
/// report: what became of the pieces, or NULL.
///
/// O(samples) time and memory, and at most O(piece_count^2) time for the rectangles. A periodic
/// domain narrower than about 10 radii is filled on one thread.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT, also for rectangles that overlap or leave the domain,
/// samples outside their rectangle, two samples of one piece or two fixed points that are closer
/// than the radius (the message has their indices), and a radius below 64 times the spacing of
/// floats; AZULEJO_ERROR_TOO_LARGE; AZULEJO_ERROR_CANCELLED.
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
///
/// One call at a time may change it; another one, from another thread or from the progress
/// callback, is refused with AZULEJO_ERROR_BUSY. Several threads may copy its points at once.
typedef struct azulejo_plane azulejo_plane;

/// Makes a set of the plane that is edited. Its samples have ids (azulejo_points_ids), at first 0,
/// 1, 2 and so on in their order. A sample keeps its id and all its bytes until it is erased, and
/// no other sample ever gets that id.
///
/// options: `count`, `order` and `measure_covering_radius` must have their defaults, and with
/// positions `leaf_size` too. Given samples have the ids 0, 1, 2 and so on, independent of those of
/// the samples. The handle keeps the progress callback for all its calls.
///
/// positions: x y each, any floats of the domain, no two closer than the radius and none closer to
/// a given sample than its clearance: a set of an earlier call, or of the host. The first
/// azulejo_plane_refill looks for gaps everywhere, and takes as long as that.
///
/// count: the number of positions. 0: it begins with the set of azulejo_kdrt_sample.
///
/// out: the handle, to be freed with azulejo_plane_free.
///
/// O(samples) time, and about 40 bytes of memory per sample.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT; AZULEJO_ERROR_TOO_LARGE; AZULEJO_ERROR_CANCELLED.
azulejo_status azulejo_plane_create(const azulejo_context *context,
                                    const azulejo_kdrt_options *options,
                                    const float *positions,
                                    size_t count,
                                    azulejo_plane **out);

/// Copies the set in its present state, by rising ids. Several threads may do so at once.
///
/// out: the samples, x y each, with their ids, to be freed with azulejo_points_free.
///
/// O(samples).
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT; AZULEJO_ERROR_BUSY while another call changes the
/// handle.
azulejo_status azulejo_plane_points(const azulejo_plane *plane, azulejo_points **out);

/// Erases the samples in a region. On a torus a sample lies in it if one of its images lies in the
/// box, and one in the ball, so that a brush may reach over the seam.
///
/// To undo a stroke of a brush, erase what azulejo_plane_refill added, by azulejo_plane_erase_ids,
/// and give back what this call erased, by azulejo_plane_restore: the set is then as before, bit
/// for bit. To redo it, erase the same region again and refill with the same seed.
///
/// erased: the erased samples with their ids, by rising ids, to be freed with azulejo_points_free;
/// NULL if they are not wanted.
///
/// O(samples in the tiles of 12 to 24 radii that the region touches).
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT, also for a region with a bound that is NaN;
/// AZULEJO_ERROR_BUSY while another call uses the handle.
azulejo_status azulejo_plane_erase(azulejo_plane *plane,
                                   const azulejo_region *region,
                                   azulejo_points **erased);

/// Erases samples by their ids.
///
/// ids: `count` ids, each of a sample of the set, none twice; NULL if `count` is 0.
///
/// erased: as in azulejo_plane_erase.
///
/// O(samples in the tiles of 12 to 24 radii that they are in).
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT, also for an id that no sample of the set has;
/// AZULEJO_ERROR_BUSY while another call uses the handle. Nothing is erased then.
azulejo_status azulejo_plane_erase_ids(azulejo_plane *plane,
                                       const uint64_t *ids,
                                       size_t count,
                                       azulejo_points **erased);

/// Puts samples back that were erased from the set, with their ids and all their bytes.
///
/// points: from an edit of this handle; not changed, and still to be freed.
///
/// O(points + samples in the tiles of 12 to 24 radii around them).
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT, also for samples that are not this set's, that stand
/// already, or that are too close to a sample or a given sample by now; AZULEJO_ERROR_BUSY while
/// another call uses the handle. Nothing is put back then.
azulejo_status azulejo_plane_restore(azulejo_plane *plane, const azulejo_points *points);

/// Adds given samples to those of the options. Samples of the set that are closer to one than its
/// clearance are erased.
///
/// positions: x y each. clearances: one for each, finite and 0 or more; NULL: the radius of the
/// set.
///
/// first_id: the id of the first of them, which the others follow; NULL if it is not wanted.
///
/// erased: as in azulejo_plane_erase.
///
/// O(samples in the tiles of 12 to 24 radii that the clearances touch), for each.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT; AZULEJO_ERROR_BUSY while another call uses the handle.
/// Nothing is changed then.
azulejo_status azulejo_plane_add_given(azulejo_plane *plane,
                                       const float *positions,
                                       const double *clearances,
                                       size_t count,
                                       uint64_t *first_id,
                                       azulejo_points **erased);

/// Removes given samples by their ids: what they covered is filled by the next
/// azulejo_plane_refill.
///
/// O(given samples).
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT, also for an id that no given sample has;
/// AZULEJO_ERROR_BUSY while another call uses the handle. Nothing is removed then.
azulejo_status azulejo_plane_remove_given(azulejo_plane *plane,
                                          const uint64_t *ids,
                                          size_t count);

/// Makes the set maximal again after edits, but looks only where samples were erased or given
/// samples removed since the last refill. All samples that stand stay as they are.
///
/// The new samples depend on `seed`, on the edits and on what stands around them. They can lie up
/// to a radius outside a region that was erased, since that is how far the erased samples covered
/// the plane. Every point of the domain is then within the radius of a sample or the clearance of a
/// given one, up to 6 float spacings at the largest coordinate.
///
/// added: the new samples with their ids, by rising ids, to be freed with azulejo_points_free; NULL
/// if they are not wanted.
///
/// report: the set after the call, or NULL; `covering_radius` is -1.
///
/// O(area in and around the edited regions + given samples).
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT; AZULEJO_ERROR_BUSY while another call uses the handle;
/// AZULEJO_ERROR_CANCELLED: nothing is added then, and the call can be repeated.
azulejo_status azulejo_plane_refill(azulejo_plane *plane,
                                    uint64_t seed,
                                    azulejo_points **added,
                                    azulejo_kdrt_report *report);

/// Frees a set. NULL is allowed.
void azulejo_plane_free(azulejo_plane *plane);

/// Options of azulejo_maximal_sample.
typedef struct azulejo_maximal_options {
    /// The size of the struct in bytes; set by the _init function.
    uint32_t struct_size;
    /// An AZULEJO_BOUNDARY_ constant; default periodic.
    uint32_t boundary;
    /// The smallest distance between two samples, in the units of the domain: above 0, and at least
    /// 64 times the spacing of floats at the largest coordinate. It has no default.
    double radius;
    /// The lower corner of the domain, x y; finite; default 0 0.
    double domain_min[2];
    /// The upper corner of the domain, x y; finite and above the lower corner on both axes; default
    /// 1 1. Neither side may be longer than 2^100 times the other.
    double domain_max[2];
    /// Any number; another seed gives another set. Default 0.
    uint64_t seed;
    /// Called during the call; default NULL: the callback of the context, if it has one.
    azulejo_progress_fn progress;
    /// Passed to the progress callback.
    void *progress_user;
} azulejo_maximal_options;

/// Writes the defaults. `struct_size` is sizeof *options.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT.
azulejo_status azulejo_maximal_options_init(azulejo_maximal_options *options,
                                            size_t struct_size);

/// Makes a maximal, conflict-free set of samples of a rectangle by throwing darts into what is
/// uncovered, one after the other: about 0.6966 * area / radius^2 samples without any bias. It is
/// the reference with which other sets are compared. It is much slower than azulejo_kdrt_sample.
/// The threads of the context share the work; the set is the same for every number of them.
///
/// Source: M. S. Ebeida et al., A Simple Algorithm for Maximal Poisson-Disk Sampling in High
/// Dimensions, 2012.
///
/// out: the samples, x y each, to be freed with azulejo_points_free.
///
/// report: what the call achieved, or NULL.
///
/// O(samples) time and memory.
///
/// Errors: as azulejo_kdrt_sample.
azulejo_status azulejo_maximal_sample(const azulejo_context *context,
                                      const azulejo_maximal_options *options,
                                      azulejo_points **out,
                                      azulejo_kdrt_report *report);

#ifdef __cplusplus
}
#endif

#endif
