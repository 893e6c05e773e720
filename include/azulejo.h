/*
 * azulejo: blue-noise sampling of planes and triangle meshes, and relaxation of point sets.
 *
 * This header is generated from ffi/azulejo-c by cbindgen; do not edit it. It is C99. C++ programs
 * may prefer azulejo.hpp, which wraps it.
 *
 * The shortest program (link with -lazulejo):
 *
 *   azulejo_context *context;
 *   azulejo_kdrt_options options;
 *   azulejo_points *points;
 *   azulejo_context_create(0, &context);
 *   azulejo_kdrt_options_init(&options, sizeof options);
 *   options.radius = 0.01;
 *   if (azulejo_kdrt_sample(context, &options, &points, NULL) == AZULEJO_OK) {
 *       const float *positions = azulejo_points_positions(points);
 *       size_t count = azulejo_points_count(points);
 *       ... positions[2 * i] and positions[2 * i + 1] for i from 0 to count - 1 ...
 *       azulejo_points_free(points);
 *   }
 *   azulejo_context_free(context);
 *
 * Contents: azulejo_kdrt_ maximal Poisson-disk sets in the plane, by radius or by number;
 * azulejo_psp_ the same on triangle meshes, also with a radius that varies; azulejo_dcr_
 * relaxation of point sets, in the plane, with a density, and on meshes; azulejo_thin points of a
 * cloud that are far from each other; azulejo_maximal_ the slow unbiased reference; azulejo_plane_,
 * azulejo_mesh_, azulejo_spectrum_ and azulejo_differences_ analysis.
 *
 * The following holds for every function unless its own text says otherwise.
 *
 * Terms. A radius is the smallest distance allowed between the centres of two samples; where it
 *   varies from sample to sample, the mean of the two radii is. A set is conflict-free if no two
 *   samples are closer than the radius, in double arithmetic on the returned floats, without
 *   tolerance. It is maximal if no place of the domain or surface is farther than the radius from
 *   every sample, up to the rounding of the returned floats: 3 times the spacing of floats at the
 *   largest coordinate in the plane, 6 times for merged sets and on meshes. The covering radius of
 *   a set is the distance from its samples of the place that is farthest from all of them. d_max
 *   is sqrt(2 * area / (sqrt(3) * count)), the distance of neighbours if as many samples stood in
 *   hexagonal arrangement; rho is the smallest distance in units of d_max.
 *
 * Status. A call that can fail returns an azulejo_status: AZULEJO_OK (0) or a negative
 *   AZULEJO_ERROR_ code. azulejo_last_error_message then names the argument, its value and its
 *   range. Arguments are checked before any work starts. Outputs are written on success only. Each
 *   function lists its codes except two, which are possible in most: AZULEJO_ERROR_THREADS in
 *   calls with a context (see "Threads"), and AZULEJO_ERROR_INTERNAL for a panic inside the
 *   library, which is a bug. AZULEJO_ERROR_INVALID_ARGUMENT is returned for a pointer that is NULL
 *   or not aligned and for a value outside its documented range. azulejo_status_name gives the name
 *   of a code. No exception leaves the library.
 *   Nothing is printed to stdout; a panic prints to stderr.
 *
 * Handles. azulejo_context, azulejo_kdrt, azulejo_mesh, azulejo_psp, azulejo_points,
 *   azulejo_selection, azulejo_spectrum and azulejo_differences are made by the library. The
 *   caller owns them and frees each with its own _free function, which allows NULL. They may be
 *   freed in any order: a handle keeps what it needs of another one. Accessors return 0 or NULL
 *   for NULL. Pointers into a handle are valid until the handle is freed. A handle begins with a
 *   tag, which is overwritten when it is freed. A handle of another type is always refused. A
 *   freed one is refused as long as its memory has not been used again; that is no promise, as
 *   the allocator may have given the memory away or back to the system. Accessors return 0 or
 *   NULL for what is refused, _free functions leave it as it is, and both set the last error.
 *
 * Pointers. An argument may be NULL only where its text says so. Arrays are packed, and are read
 *   during the call only. The pointer of an empty array may be NULL, with the count 0. Pointers
 *   that are not aligned for their type, handles and outputs included, are refused. Other invalid
 *   pointers, and counts that exceed an array, cannot be detected.
 *
 * Structs that can grow. Options, reports, azulejo_plane_set, azulejo_density and
 *   azulejo_mesh_density begin with struct_size and must be filled by their _init function before
 *   use: it writes the defaults to options and zeros to reports. A field exists for the library if
 *   struct_size reaches its end: options that lack a field get its default, and a field that a
 *   report lacks is not written. So a program built against an older header of the same SONAME
 *   keeps working. One built against a newer header works as long as the option fields that this
 *   library does not know are zero; report fields that it does not know stay as _init left them. A
 *   struct_size out of range, a non-zero field beyond the known ones, an unknown constant, a flag
 *   other than 0 and 1, and an option that its text excludes from the call are refused. A reserved
 *   field must be 0 in options and is 0 in reports. The options of azulejo_X and azulejo_X_verb
 *   are azulejo_X_options, the report azulejo_X_report. Structs that a call takes an array of have
 *   no struct_size; the call takes their size, and the same holds.
 *
 * Types. Attributes that the host has for each vertex, pixel or sample are float: positions,
 *   normals, barycentrics, radii of vertices, densities, ranks. Distances by which conflicts are
 *   judged are double: radius, clearances, radii of samples and classes, corners of the domain, and
 *   all figures of reports. Constants, flags and what callbacks return are uint32_t, sizes and
 *   counts of arrays size_t. Results come last: `out`, then `report`.
 *
 * Progress. A call with a context calls a progress callback on the thread that made the call: the
 *   one in its options or, if that is NULL, the one of the context (azulejo_context_watch). It
 *   gets the fraction of the call that is done, which never decreases, from 0 to 1; the 1 comes
 *   last, and only if the call succeeds. A return value other than 0 cancels the call, which
 *   returns AZULEJO_ERROR_CANCELLED and writes no output. The exceptions are azulejo_dcr_relax,
 *   azulejo_dcr_relax_density and azulejo_dcr_surface_relax: they succeed with the state after the
 *   last whole step, and say so in their report. azulejo_psp_create and calls without a context or
 *   a psp handle do not report progress.
 *
 * Callbacks. A callback may call the library, also with the context that is calling it, unless its
 *   type says otherwise. It must return: an exception that leaves it ends the process, a longjmp
 *   out of it is undefined. Progress and azulejo_kdrt_visit_fn callbacks are called on the thread
 *   that made the call. azulejo_radius_fn and azulejo_density_fn callbacks are called on other
 *   threads as well, by several at once, so they must be thread-safe.
 *
 * Threads. Every function may be called from any thread at any time. Several threads may use one
 *   context at once, make windows of one plane, and read one mesh, set of points, selection,
 *   spectrum or differences. A psp handle serves one changing call at a time and refuses a second
 *   one with AZULEJO_ERROR_BUSY. A handle must not be freed while another thread uses it. The last
 *   error belongs to the thread that made the call. After fork, in the child, contexts with more
 *   than one thread and psp handles made with them return AZULEJO_ERROR_THREADS, since their
 *   threads exist in the parent only; they can still be freed. Planes, contexts of one thread, and
 *   contexts made after the fork work. Embree's own threads are lost as well: a process that used
 *   Embree before it forked should use AZULEJO_ENGINE_RASTERISER in the child.
 *
 * Determinism. The same options and seed give the same bytes, for every number of threads and
 *   whatever was called before, on every processor and system: elementary functions are the
 *   library's own, and vector instructions change nothing. Only AZULEJO_ENGINE_EMBREE depends on
 *   the version of Embree and on the instruction set. Callbacks must return the same as well.
 *
 * Memory. Requests that memory cannot hold are refused with AZULEJO_ERROR_TOO_LARGE before memory
 *   is taken; the free memory of the machine counts, and the limits of the process (ulimit -v) and
 *   of its control groups. Only Linux is asked for these. If memory runs out during a call
 *   nevertheless, the process is aborted.
 *
 * Complexity is that of the whole call on one thread; all threads of the context share the work,
 *   except where a text says otherwise. "Evenly spread" points are as dense, up to a small factor,
 *   everywhere in their domain or on their surface, as samples of this library are. For points in
 *   clusters, searches for neighbours take longer, at worst O(count^2).
 *
 * The algorithms are those of T. Wang, Techniques on Mining Effective Parallelism For
 * High-Performance Blue-Noise Sampling, University of Tokyo, 2019 ("thesis" below).
 */

#ifndef AZULEJO_H
#define AZULEJO_H

#include <stddef.h>
#include <stdint.h>

/// The call succeeded.
#define AZULEJO_OK 0

/// An argument or an option is outside its documented range.
#define AZULEJO_ERROR_INVALID_ARGUMENT -1

/// The call asks for more than can be indexed or held in memory. It is refused before memory is
/// taken; the message has the estimate.
#define AZULEJO_ERROR_TOO_LARGE -2

/// A file could not be read.
#define AZULEJO_ERROR_IO -3

/// A file was read, but its content is not valid.
#define AZULEJO_ERROR_FORMAT -4

/// A callback of the caller cancelled the call.
#define AZULEJO_ERROR_CANCELLED -5

/// There is no memory for a copy of the caller's arrays.
#define AZULEJO_ERROR_OUT_OF_MEMORY -6

/// Embree failed: it is not there, has no memory, or cannot build a scene.
#define AZULEJO_ERROR_EMBREE -7

/// Threads could not be started, or the context's threads are in the process from which this one
/// was forked.
#define AZULEJO_ERROR_THREADS -8

/// A handle is in use by another call, from another thread or around the callback that makes this
/// one. The same call succeeds later.
#define AZULEJO_ERROR_BUSY -9

/// The library was built without what the call needs: Embree. azulejo_has_embree tells before.
#define AZULEJO_ERROR_UNSUPPORTED -10

/// A bug in the library; please report it. Handles that took part in the call can only be freed.
#define AZULEJO_ERROR_INTERNAL -100

/// The major version of this header. It changes when programs must be changed.
#define AZULEJO_VERSION_MAJOR 0

/// The minor version of this header. It changes when something is added; before 1.0 also when
/// programs must be changed.
#define AZULEJO_VERSION_MINOR 3

/// The patch version of this header.
#define AZULEJO_VERSION_PATCH 0

/// The version of this header as one number: major * 10000 + minor * 100 + patch.
#define AZULEJO_VERSION 300

/// The domain is a torus: distances wrap with the period domain_max - domain_min.
#define AZULEJO_BOUNDARY_PERIODIC 0

/// The domain ends at its edges: samples beyond them neither exist nor cover anything.
#define AZULEJO_BOUNDARY_BOUNDED 1

/// No set has more classes.
#define AZULEJO_MAX_CLASSES 16

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

/// A point's neighbours are those of the Delaunay triangulation: they keep their distance and close
/// holes.
#define AZULEJO_NEIGHBOURHOOD_DELAUNAY 0

/// A point's neighbours are its nearest points: they only repel.
#define AZULEJO_NEIGHBOURHOOD_NEAREST 1

/// The momentum method, the default: neighbours in conflict push each other away, holes pull the
/// points around them, points have momentum, and long waves of the density are removed.
#define AZULEJO_METHOD_MOMENTUM 0

/// The algorithm of thesis chapter 4.
#define AZULEJO_METHOD_THESIS 1

/// The tension of an edge is divided between its ends according to their activeness: the default.
#define AZULEJO_DISTRIBUTION_ACTIVENESS 0

/// Half of the tension goes to each end.
#define AZULEJO_DISTRIBUTION_AVERAGE 1

/// All of the tension goes to the neighbour.
#define AZULEJO_DISTRIBUTION_DOMINANT 2

/// All of the tension goes to the point itself.
#define AZULEJO_DISTRIBUTION_ZERO 3

/// 80 per cent of the tension goes to the point itself, 20 to the neighbour.
#define AZULEJO_DISTRIBUTION_EIGHTY_TWENTY 4

/// An edge is visited from each end that has the other one in its neighbourhood: the default.
#define AZULEJO_VISITS_BOTH_ENDS 0

/// An edge is visited from one end, the same in every step, chosen by a hash of the seed and the
/// two points. Points move about half as far in a step, and the constant distributions differ with
/// Delaunay neighbours too.
#define AZULEJO_VISITS_ONE_END 1

/// A set has converged when the motion falls to the tolerance: the default.
#define AZULEJO_CONVERGENCE_MOTION 0

/// A set has converged when ten times in succession the variance of the distances to the nearest
/// point changes by less than 0.1 per cent in a step and more than 99 per cent of the points move
/// by less than 0.01 d_max (thesis section 4.4.2). The smaller the step, the earlier that happens;
/// in sets of a few hundred points it may never happen.
#define AZULEJO_CONVERGENCE_VARIANCE 1

/// The set converged, or there was nothing to move. With AZULEJO_METHOD_MOMENTUM and Delaunay
/// neighbours no points are then closer than 0.85 d_max and no circumradius is above 0.67 d_max, up
/// to the last step.
#define AZULEJO_STOPPED_CONVERGED 0

/// All steps were made.
#define AZULEJO_STOPPED_STEPS 1

/// The progress callback cancelled the call.
#define AZULEJO_STOPPED_CANCELLED 2

/// In no particular order.
#define AZULEJO_ORDER_ANY 0

/// Coarse to fine: the first points are a sparser set of the same kind, whatever their number.
#define AZULEJO_ORDER_PROGRESSIVE 1

/// The cells per side of the grid of azulejo_differences_density.
#define AZULEJO_DIFFERENCES_SIZE 128

/// The extent of the grid from the difference 0 along both axes, in mean spacings.
#define AZULEJO_DIFFERENCES_GRID_REACH 4

/// The shells of equal width of azulejo_differences_radial.
#define AZULEJO_DIFFERENCES_SHELLS 512

/// The distance at which the last shell ends, in mean spacings.
#define AZULEJO_DIFFERENCES_REACH 8

/// A pool of threads, passed to every call that does long work. One context for a whole program is
/// usual; several threads may use it at once.
typedef struct azulejo_context azulejo_context;

/// The distribution p(d) of the differences d of all pairs of samples on a mesh, or of several sets
/// (Wei and Wang 2011, "Differential domain analysis for non-uniform sampling"): the density of
/// other samples at an offset from a sample, over the mean density. 1 for a Poisson process. Its
/// Fourier transform takes the place of the power spectrum, which is not defined on a surface.
/// Immutable: several threads may use it at once.
///
/// The offset of a pair is projected onto the tangent plane of its first sample and keeps its
/// straight length. Lengths are in mean spacings, sqrt(area / count), and frequencies in units of
/// one over that.
typedef struct azulejo_differences azulejo_differences;

/// A plane: a set of azulejo_kdrt_sample or azulejo_kdrt_sample_classes of which any window can be
/// made at any time. Immutable: several threads may make windows of it at once.
typedef struct azulejo_kdrt azulejo_kdrt;

/// A checked triangle mesh. Immutable: several threads may use it at once. Any triangle soup is
/// accepted: open, non-manifold, of many parts and mixed winding. A mesh may carry normals and a
/// mask. Meshes made from one another share what they have in common.
typedef struct azulejo_mesh azulejo_mesh;

/// The samples that a call made. Immutable: several threads may read it at once. All its arrays
/// have one entry per sample, in the same order, and are valid until azulejo_points_free.
typedef struct azulejo_points azulejo_points;

/// A set of samples on a mesh that can grow. It keeps its context and its mesh, which may be freed
/// before it.
///
/// One call at a time may change it; another one, from another thread or from the progress
/// callback, is refused with AZULEJO_ERROR_BUSY. Several threads may copy its points at once.
typedef struct azulejo_psp azulejo_psp;

/// Points of a cloud that azulejo_thin selected. Immutable: several threads may read it at once.
/// Its arrays have one entry per selected point, in the same order, and are valid until
/// azulejo_selection_free.
typedef struct azulejo_selection azulejo_selection;

/// The power spectrum of a set of the plane, or the mean of several: |sum of exp(-2 pi i f x)|^2 /
/// count on a square grid of frequencies f. Its mean is 1 for a Poisson process (Ulichney 1988;
/// Lagae and Dutre 2008). Immutable: several threads may use it at once.
///
/// Frequencies are in units of sqrt(count / area), so that sets of different size can be compared;
/// the first ring of blue noise lies near 1.
typedef struct azulejo_spectrum azulejo_spectrum;

/// The result of a call: AZULEJO_OK or a negative AZULEJO_ERROR_ code. Codes are never reused;
/// later versions may add some.
typedef int32_t azulejo_status;

/// Called repeatedly during a call, on the thread that made it. See "Progress" at the top.
///
/// user: the progress_user of the options or of azulejo_context_watch.
///
/// done: the fraction of the call that is done, from 0 to 1; it never decreases.
///
/// Returns 0 to continue, any other value to cancel the call.
typedef uint32_t (*azulejo_progress_fn)(void *user, double done);

/// Points of the plane and their domain: the input of the calls that measure them.
typedef struct azulejo_plane_set {
    /// The size of the struct in bytes; set by the _init function.
    uint32_t struct_size;
    /// An AZULEJO_BOUNDARY_ constant; default periodic.
    uint32_t boundary;
    /// The points, x y each, with domain_min <= x < domain_max on both axes. Default NULL: none.
    const float *positions;
    /// The number of points; default 0.
    size_t count;
    /// The lower corner of the domain, x y; finite; default 0 0.
    double domain_min[2];
    /// The upper corner of the domain, x y; finite and above the lower corner on both axes; default
    /// 1 1. Neither side may be longer than 2^100 times the other.
    double domain_max[2];
} azulejo_plane_set;

/// Classes of samples that stand in each other's way: the matrix of their distances. Samples of
/// classes i and j are at least r_ij apart, and no class can take another sample: for each class i
/// every place is within r_ij of some sample of some class j.
///
/// Classes of larger own radii r_ii come first, those of smaller ones fill what these leave them;
/// classes of equal radii are treated alike. So two radii that are nearly equal give other shares
/// than two equal ones: of own radii 1 and 0.9 the first class has its full density.
typedef struct azulejo_classes {
    /// The size of the struct in bytes; set by the _init function.
    uint32_t struct_size;
    /// The number of classes, 1 to AZULEJO_MAX_CLASSES. Required.
    uint32_t count;
    /// count * count radii, row by row, in the units of the domain or mesh; symmetric, finite, 0 or
    /// more, and above 0 on the diagonal. Two classes whose radius is 0 ignore each other.
    /// azulejo_classes_radii makes such a matrix. Required; read during the call only.
    const double *radii;
    /// On meshes, where each class may stand: for each triangle a number with a bit for each
    /// class, the lowest for class 0. A class has no samples, and needs no cover, where its bit is
    /// 0; other bits are ignored. If the mesh has a mask, both must allow a sample. NULL, the
    /// default: all classes may stand everywhere. Read during the call only.
    const uint32_t *masks;
    /// The number of masks: that of the mesh's triangles, or 0 if there are none. Default 0.
    size_t mask_count;
} azulejo_classes;

/// Options of azulejo_kdrt_sample, azulejo_kdrt_sample_window, azulejo_kdrt_stream,
/// azulejo_kdrt_create and, with classes, azulejo_kdrt_sample_classes and
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
    /// if that is more. Default 0: 2^(1/8). Windows of large domains are several times as fast with
    /// 2^(1/4).
    double quotient;
    /// Of a progressive order: the radius of the coarsest level, at least `radius`. Default 0: as
    /// coarse as the domain, so that the first level has one sample. Windows of large domains are
    /// faster with a shorter one, such as 16 radii.
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

/// A geometry of triangles in a scene that the program has made with Embree. Embree does not report
/// the sizes of its buffers, so the caller gives them.
typedef struct azulejo_embree_geometry {
    /// Its number in the scene.
    uint32_t geometry_id;
    /// Bytes from one vertex to the next: a multiple of 4, at least 12.
    uint32_t vertex_stride;
    /// Bytes from one triangle to the next: a multiple of 4, at least 12.
    uint32_t index_stride;
    /// Must be 0.
    uint32_t reserved;
    /// The vertices in its buffer of type RTC_BUFFER_TYPE_VERTEX, slot 0, of format
    /// RTC_FORMAT_FLOAT3.
    size_t vertex_count;
    /// The triangles in its buffer of type RTC_BUFFER_TYPE_INDEX, of format RTC_FORMAT_UINT3.
    size_t triangle_count;
} azulejo_embree_geometry;

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

/// A part of space: the points that lie in a box and within a distance of a centre, the boundary
/// included. Both are without end by default: set `centre` and `radius` for a ball, `min` and `max`
/// for a box, or all four for what they have in common.
typedef struct azulejo_region {
    /// The size of the struct in bytes; set by the _init function.
    uint32_t struct_size;
    /// Must be 0.
    uint32_t reserved;
    /// The lowest coordinates of the box; default minus infinity.
    double min[3];
    /// The highest coordinates of the box, not below `min`; default infinity.
    double max[3];
    /// The centre of the ball, finite; default 0.
    double centre[3];
    /// The radius of the ball, 0 or more; default infinity.
    double radius;
} azulejo_region;

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

/// Options of azulejo_dcr_relax, azulejo_dcr_relax_density and azulejo_dcr_scatter. The latter uses
/// only the domain, the boundary, the seed and the progress callback; the struct is shared so that
/// a scattered set is relaxed on the same domain.
///
/// The fields from `conflict_radius` on are settings of AZULEJO_METHOD_THESIS; with
/// AZULEJO_METHOD_MOMENTUM they must have their defaults.
typedef struct azulejo_dcr_options {
    /// The size of the struct in bytes; set by the _init function.
    uint32_t struct_size;
    /// An AZULEJO_BOUNDARY_ constant; default periodic.
    uint32_t boundary;
    /// The lower corner of the domain, x y; finite; default 0 0.
    double domain_min[2];
    /// The upper corner of the domain, x y; finite and above the lower corner on both axes; default
    /// 1 1. Neither side may be longer than 2^100 times the other.
    double domain_max[2];
    /// An AZULEJO_NEIGHBOURHOOD_ constant; default Delaunay.
    uint32_t neighbourhood;
    /// An AZULEJO_METHOD_ constant; default momentum.
    uint32_t method;
    /// The largest number of steps; default 100, which is enough for AZULEJO_METHOD_MOMENTUM from
    /// any points; AZULEJO_METHOD_THESIS may need 1000. 0 returns the points as they are. The call
    /// ends earlier when the set has converged.
    uint32_t max_iterations;
    /// Must be 0.
    uint32_t reserved;
    /// Directions in which coincident points are separated, for azulejo_dcr_scatter the points, for
    /// azulejo_dcr_relax_density those of a clustered set's redistribution; any number, default 0.
    uint64_t seed;
    /// The motion (see the report) at which the set has converged, at least 0; 0 makes all steps.
    /// Any negative number, such as the default -1, selects the tolerance of the method: 0.001, or
    /// with AZULEJO_METHOD_THESIS 0.02 for Delaunay and 0.005 for nearest neighbours.
    double tolerance;
    /// Called during the call; default NULL: the callback of the context, if it has one.
    azulejo_progress_fn progress;
    /// Passed to the progress callback.
    void *progress_user;
    /// Neighbours closer than this, in units of d_max, repel each other; above 0, at most 1;
    /// default 0.95.
    double conflict_radius;
    /// Delaunay neighbours farther apart than this, in units of d_max, attract each other; at least
    /// conflict_radius; default 1.05.
    double attraction_radius;
    /// The displacement by a tension of 1, in units of d_max; above 0, at most 1; default 0.05.
    double step;
    /// The factor of `step` from one step to the next; above 0, at most 1; default 1. All steps
    /// together are no longer than step / (1 - decay); from a random start about 10 are needed.
    double decay;
    /// The number of neighbours of AZULEJO_NEIGHBOURHOOD_NEAREST; at least 1; default 6.
    uint32_t neighbours;
    /// An AZULEJO_DISTRIBUTION_ constant (thesis figure 4.19); default activeness.
    uint32_t distribution;
    /// An AZULEJO_VISITS_ constant; default both ends.
    uint32_t visits;
    /// An AZULEJO_CONVERGENCE_ constant; default motion.
    uint32_t convergence;
} azulejo_dcr_options;

/// The report of azulejo_dcr_relax and azulejo_dcr_relax_density.
typedef struct azulejo_dcr_report {
    /// The size of the struct in bytes; set by the _init function.
    uint32_t struct_size;
    /// The steps made.
    uint32_t iterations;
    /// Why no more steps were made: an AZULEJO_STOPPED_ constant.
    uint32_t stopped;
    /// Always 0.
    uint32_t reserved;
    /// Half of the distance that points moved, root mean square, in units of d_max: over the last
    /// 10 steps, or with AZULEJO_METHOD_THESIS over the last steps whose sizes add up to 2, so that
    /// it does not depend on the step size.
    double motion;
    /// The smallest distance between two of the points, in the units of the domain; infinite for
    /// fewer than two points.
    double smallest_distance;
    /// The smallest distance in units of d_max: about 0.77 for a maximal Poisson-disk set, at most
    /// 1 on a periodic domain; infinite for fewer than two points.
    double rho;
    /// The covering radius in units of d_max; infinite for no point.
    double relative_covering_radius;
} azulejo_dcr_report;

/// Gives the density at a position.
///
/// It is called on other threads than the one that made the call, by several at once, unless the
/// context has one thread: then on that thread only. It must be thread-safe, return (see
/// "Callbacks" at the top), and must not call the library with the same context. It is called once
/// for each place of a lattice of up to some hundred places per point: by azulejo_dcr_relax_density
/// before its first report of progress, by azulejo_dcr_scatter after that.
///
/// user: the `function_user` of the azulejo_density.
///
/// position: x y of a place in the domain.
///
/// Returns the density, finite and at least 0.
typedef double (*azulejo_density_fn)(void *user, const double *position);

/// A density of points from place to place, in any unit: twice the density gives the same set.
/// Densities are finite, at least 0, and not 0 everywhere; where they are 0 no points are wanted.
/// Either `values` or `function` must be set.
typedef struct azulejo_density {
    /// The size of the struct in bytes; set by the _init function.
    uint32_t struct_size;
    /// Must be 0.
    uint32_t reserved;
    /// An image that is stretched over the domain, linear between the centres of its pixels:
    /// `height` rows of `width` densities, the first row along the lower edge of the domain
    /// (domain_min[1]). Used during the call only. NULL, the default, if `function` is set.
    const float *values;
    /// The number of pixels in a row, at least 1. Must be 0, the default, if `function` is set.
    size_t width;
    /// The number of rows, at least 1. Must be 0, the default, if `function` is set.
    size_t height;
    /// Gives the density at a position. NULL, the default, if `values` is set.
    azulejo_density_fn function;
    /// Passed to `function`.
    void *function_user;
} azulejo_density;

/// Options of azulejo_dcr_surface_relax.
typedef struct azulejo_dcr_surface_options {
    /// The size of the struct in bytes; set by the _init function.
    uint32_t struct_size;
    /// The largest number of steps; default 100. 0 returns the samples as they are, those outside
    /// their triangle by rounding moved to its edge. The call ends earlier when the set has
    /// converged.
    uint32_t max_iterations;
    /// The motion (see the report) at which the set has converged, at least 0; 0 makes all steps.
    /// Any negative number, such as the default -1, selects 0.0005.
    double tolerance;
    /// Directions in which samples are separated that coincide or lie on edges of triangles, and
    /// the points onto which clustered samples are redistributed; any number, default 0.
    uint64_t seed;
    /// Called during the call; default NULL: the callback of the context, if it has one.
    azulejo_progress_fn progress;
    /// Passed to the progress callback.
    void *progress_user;
} azulejo_dcr_surface_options;

/// The report of azulejo_dcr_surface_relax. Its d_max is that of a plane of the mesh's area.
typedef struct azulejo_dcr_surface_report {
    /// The size of the struct in bytes; set by the _init function.
    uint32_t struct_size;
    /// The steps made.
    uint32_t iterations;
    /// Why no more steps were made: an AZULEJO_STOPPED_ constant.
    uint32_t stopped;
    /// Always 0.
    uint32_t reserved;
    /// Half of the distance that samples moved over the last 10 steps, root mean square, in units
    /// of d_max.
    double motion;
    /// The smallest straight distance between two of the samples, whether or not they are near on
    /// the surface, in the units of the mesh. It is never less than before the call; infinite for
    /// fewer than two samples.
    double smallest_distance;
    /// The smallest distance in units of d_max: about 0.77 for a maximal set, more for a relaxed
    /// one, except on meshes with parts that are nearer to each other than samples are. Infinite
    /// for fewer than two samples.
    double rho;
} azulejo_dcr_surface_report;

/// The report of azulejo_dcr_remesh. The mesh is a manifold if
/// `non_manifold_vertices` is 0, and closed if `boundary_edges` is 0 too: no edge has more than two
/// triangles, and two triangles at an edge are wound alike.
typedef struct azulejo_dcr_remesh_report {
    /// The size of the struct in bytes; set by the _init function.
    uint32_t struct_size;
    /// Always 0.
    uint32_t reserved;
    /// The triangles of the mesh.
    uint64_t triangles;
    /// Those of them that not all of their three corners have in their Delaunay stars.
    uint64_t disputed;
    /// The triangles of stars that are not in the mesh because they do not go with others.
    uint64_t left_out;
    /// The edges with one triangle, which are the boundary.
    uint64_t boundary_edges;
    /// The edges with two triangles.
    uint64_t inner_edges;
    /// The edges with more than two triangles: always 0.
    uint64_t non_manifold_edges;
    /// The samples whose triangles are not all connected by edges at the sample.
    uint64_t non_manifold_vertices;
    /// The samples without a triangle.
    uint64_t unused_vertices;
    /// Euler's characteristic, vertices - edges + triangles, without unused vertices: 2 for a
    /// sphere, 0 for a torus, 1 for a disk.
    int64_t euler;
    /// The smallest angle of all triangles, in degrees.
    double smallest_angle;
    /// The largest angle of all triangles, in degrees.
    double largest_angle;
    /// The mean over all triangles of their smallest angle, in degrees.
    double mean_smallest_angle;
} azulejo_dcr_remesh_report;

/// Options of azulejo_thin. What is selected follows from `order`, `radius` and `count`:
///
///   any order, a radius: in the order of the cloud, each point that no selected one before it is
///     nearer to than the radius;
///   any order, a count (and a radius): the points that the progressive order would select, in the
///     order of the cloud;
///   progressive order: each next point is the farthest from those before, the lowest index on
///     ties, until there are `count` points, or no point is left that is at least `radius` from
///     all of them; all points if both are 0.
///
/// Any order with neither is refused.
typedef struct azulejo_thin_options {
    /// The size of the struct in bytes; set by the _init function.
    uint32_t struct_size;
    /// An AZULEJO_ORDER_ constant; default any.
    uint32_t order;
    /// The smallest distance between two selected points, above 0; default 0: none.
    double radius;
    /// The number of points to select. A cloud that has fewer is selected whole. Default 0: none.
    size_t count;
    /// Any number. It chooses the first point of the progressive order, on which the others depend;
    /// a selection in any order without a count uses no random numbers. Default 0.
    uint64_t seed;
    /// Called during the call; default NULL: the callback of the context, if it has one.
    azulejo_progress_fn progress;
    /// Passed to the progress callback.
    void *progress_user;
} azulejo_thin_options;

/// The report of azulejo_thin.
typedef struct azulejo_thin_report {
    /// The size of the struct in bytes; set by the _init function.
    uint32_t struct_size;
    /// Always 0.
    uint32_t reserved;
    /// The number of selected points.
    uint64_t samples;
    /// No two selected points are closer: the radius by which they were selected, otherwise the
    /// smallest distance of two. Infinite for less than two points.
    double radius;
    /// Wall time in seconds.
    double seconds;
} azulejo_thin_report;

/// The coverage of a domain or a surface by disks of a radius: the result of
/// azulejo_plane_coverage and azulejo_mesh_coverage.
typedef struct azulejo_coverage_report {
    /// The size of the struct in bytes; set by the _init function.
    uint32_t struct_size;
    /// Always 0.
    uint32_t reserved;
    /// The covering radius, in the units of the domain or mesh; infinite for no sample.
    double covering_radius;
    /// The number of gaps: 0 if the set is maximal for the radius, up to the rounding of floats.
    uint64_t gaps;
} azulejo_coverage_report;

/// The result of azulejo_plane_measure.
typedef struct azulejo_plane_report {
    /// The size of the struct in bytes; set by the _init function.
    uint32_t struct_size;
    /// Always 0.
    uint32_t reserved;
    /// The number of points.
    uint64_t count;
    /// The smallest distance between two points, in the units of the domain; infinite for fewer
    /// than two.
    double smallest_distance;
    /// The mean distance from a point to its nearest neighbour, in the units of the domain;
    /// infinite for fewer than two points.
    double mean_distance;
    /// d_max, in the units of the domain; infinite for no point.
    double hexagonal_distance;
    /// The smallest distance in units of d_max: about 0.77 for maximal Poisson-disk sets, at most 1
    /// on a periodic domain.
    double rho;
    /// The covering radius, in the units of the domain: see azulejo_plane_covering_radius. d_max /
    /// sqrt(3) for a hexagonal lattice; infinite for no point.
    double covering_radius;
    /// The bond order psi6, 0 to 1: the mean over the points of |sum of exp(6 i angle)| / n for the
    /// n directions of their Delaunay neighbours (Nelson and Halperin 1979). 1 for a hexagonal
    /// lattice, 0.36 for a Poisson process.
    double bond_order;
    /// The number of Delaunay triangles; in a bounded domain those that do not cross its edges when
    /// the set is mirrored at them.
    uint64_t triangles;
    /// The fraction of triangles with an angle above 90 degrees, 0 to 1.
    double obtuse;
    /// The fraction of triangles with an angle below 30 degrees, 0 to 1.
    double below_30_degrees;
    /// The mean length of the triangles' edges, in the units of the domain.
    double edge_mean;
    /// The variance of the lengths of the edges over their squared mean.
    double edge_variation;
    /// The variance of the areas of the triangles over their squared mean.
    double area_variation;
    /// The fraction of the angles of all triangles that are below 30 degrees, 0 to 1.
    double angles_below_30_degrees;
    /// The fraction of triangles whose area is farther than 4 standard deviations from the mean, 0
    /// to 1.
    double beyond_4_sigma;
} azulejo_plane_report;

/// The result of azulejo_spectrum_measure.
typedef struct azulejo_spectrum_report {
    /// The size of the struct in bytes; set by the _init function.
    uint32_t struct_size;
    /// Always 0.
    uint32_t reserved;
    /// The distances of neighbouring columns and rows, in units of sqrt(count / area).
    double frequency_step[2];
    /// The effective Nyquist frequency, in units of sqrt(count / area): half of the largest
    /// frequency up to which the mean power is below 0.1 (Heck et al. 2013). 0.5 for a square
    /// lattice, 0.537 for a hexagonal one, 0 for a Poisson process; the tables of the literature
    /// divide it by 0.5. -1 if the spectrum ends too early; frequencies up to 1.5 mostly suffice.
    double effective_nyquist;
    /// The oscillation, a number: ten times the root mean square of the power's deviation from 1,
    /// by area, from where it first reaches 0.98 to 5 sqrt(count / area) above (Heck et al. 2013).
    /// 0 for a Poisson process. -1 if the spectrum ends too early; frequencies up to 6.5 mostly
    /// suffice.
    double oscillation;
    /// The scatter of the power about its radial mean, over the frequencies from `low` to `high`: 1
    /// for one set without order over long distances, 1/n for the mean of n, more if parts are
    /// repeated. 0 if there are no such frequencies.
    double contrast;
    /// The largest power of a frequency from `low` to `high`, over the radial mean there. By chance
    /// alone it is about ln n for n frequencies of one set. 0 if there are no such frequencies.
    double peak;
    /// That frequency, x y, in units of sqrt(count / area); its opposite has the same power.
    double peak_frequency[2];
} azulejo_spectrum_report;

/// The frequencies of about one length: a point of the radial curves.
typedef struct azulejo_annulus {
    /// The mean length of its frequencies, in units of sqrt(count / area).
    double frequency;
    /// The mean power: the radial mean; 1 for a Poisson process.
    double power;
    /// The variance of the power over its squared mean. The spectrum of one isotropic set has 1 (0
    /// dB), the mean of n such spectra has 1/n; preferred directions give more.
    double anisotropy;
    /// The number of its frequencies, a frequency and its opposite counted once; at least 2.
    uint64_t count;
} azulejo_annulus;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

/// Copies the message of this thread's last failed call: one line of UTF-8, terminated by a NUL;
/// empty if no call has failed.
///
/// Calls that succeed leave the message as it is, so ask right after the call that failed. O(length
/// of the message).
///
/// buffer: receives at most `capacity` bytes including the NUL; a longer message is cut between two
/// characters. May be NULL if `capacity` is 0.
///
/// Returns the size of the whole message in bytes, including the NUL.
size_t azulejo_last_error_message(char *buffer, size_t capacity);

/// The name of a status: "AZULEJO_ERROR_BUSY" for AZULEJO_ERROR_BUSY. NULL for a number that is
/// none of this library's. The text is never freed.
const char *azulejo_status_name(azulejo_status status);

/// The version of the library that the program runs with, to be compared with AZULEJO_VERSION.
uint32_t azulejo_version(void);

/// 1 if the library was built with Embree, 0 otherwise. Without it AZULEJO_ENGINE_EMBREE and
/// azulejo_mesh_create_from_embree are refused with AZULEJO_ERROR_UNSUPPORTED, and everything else
/// is there: sets on meshes are filled, as by default, or projected by the rasteriser.
///
/// Embree is loaded by the first call that uses it. If the machine has none, such calls are refused
/// with AZULEJO_ERROR_EMBREE, and the message names the file that was not found.
uint32_t azulejo_has_embree(void);

/// Makes a context and starts its threads.
///
/// num_threads: the number of threads, 1 to 4096, or 0 for one per core. With 1 no thread is
/// started: all work happens on the calling thread.
///
/// out: the context, to be freed with azulejo_context_free.
///
/// Embree's scenes are built by as many threads, but not more than there are cores, and by none of
/// TBB's. Bounds that the program sets for TBB stay as they are. Embree, however, has one bound for
/// the whole process, the largest of its devices, and a scene of the library has none: where a
/// device of the program has one (threads=), it is suspended while a mesh exists on which a set has
/// made iterations with AZULEJO_ENGINE_EMBREE (or a handle of such a set).
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT; AZULEJO_ERROR_THREADS if the threads cannot be started.
azulejo_status azulejo_context_create(uint32_t num_threads, struct azulejo_context **out);

/// Makes a context that shares the threads of another one and adds a progress callback. The
/// callback is used by every call that is made with this context, or with a psp handle made with
/// it, and whose options have no callback of their own. So calls without options, such as the
/// analysis, can report progress and be cancelled.
///
/// context: the other context. It may be freed before this one. Its own callback, if any, is not
/// inherited.
///
/// progress: the callback, or NULL for none. Each thread that makes a call with the context calls
/// it.
///
/// progress_user: passed to the callback.
///
/// out: the context, to be freed with azulejo_context_free. No thread is started. O(1).
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT.
azulejo_status azulejo_context_watch(const struct azulejo_context *context,
                                     azulejo_progress_fn progress,
                                     void *progress_user,
                                     struct azulejo_context **out);

/// The number of threads that work on a call; 0 for NULL.
uint32_t azulejo_context_num_threads(const struct azulejo_context *context);

/// Frees a context. Its threads end when no call and no handle uses them any more. NULL is allowed.
void azulejo_context_free(struct azulejo_context *context);

/// Writes the defaults: no points on the unit torus. `struct_size` is sizeof *set.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT.
azulejo_status azulejo_plane_set_init(struct azulejo_plane_set *set, size_t struct_size);

/// The number of samples; 0 for NULL.
size_t azulejo_points_count(const struct azulejo_points *points);

/// The number of coordinates of a position: 2 for samples of the plane, 3 for samples on a mesh; 0
/// for NULL.
uint32_t azulejo_points_dimension(const struct azulejo_points *points);

/// The positions, x y or x y z of each sample, interleaved; NULL for NULL and for an empty set.
///
/// Samples of the plane lie in domain_min <= x < domain_max. Samples on a mesh lie on their
/// triangle, up to the rounding of the floats: they are computed from the barycentrics in double
/// arithmetic and rounded once.
const float *azulejo_points_positions(const struct azulejo_points *points);

/// The unit normals of the samples' triangles, x y z each, on the side from which their vertices
/// appear counter-clockwise, whether or not the mesh carries normals of its own. NULL for NULL, an
/// empty set and samples of the plane.
const float *azulejo_points_normals(const struct azulejo_points *points);

/// The normals that the mesh carries, from azulejo_mesh_with_normals or from its file, interpolated
/// with the samples' barycentrics and normalised, x y z each; the normal of the triangle where the
/// sum is zero. NULL for a mesh without normals, NULL, an empty set and samples of the plane.
const float *azulejo_points_interpolated_normals(const struct azulejo_points *points);

/// The index of each sample's triangle; NULL for NULL, an empty set and samples of the plane.
const uint32_t *azulejo_points_triangles(const struct azulejo_points *points);

/// The barycentric coordinates u v of each sample in its triangle (a, b, c), as in Embree: the
/// position is (1-u-v)*a + u*b + v*c, and other attributes of the vertices are interpolated in the
/// same manner. NULL for NULL, an empty set and samples of the plane.
const float *azulejo_points_barycentrics(const struct azulejo_points *points);

/// The radius of each sample of azulejo_psp_adaptive_sample and azulejo_psp_adaptive_with_density,
/// in the units of the mesh; NULL for NULL, an empty set and all other sets.
const double *azulejo_points_radii(const struct azulejo_points *points);

/// The ranks of the samples of a set in progressive order, in the units of the domain or the mesh:
/// for each sample the distance to the nearest one that was there when it was accepted, or on
/// meshes a little less, rounded down to a float. They never rise. The first i samples are at least
/// as far apart as the i-th rank. NULL for NULL, an empty set and sets in any order.
///
/// No place is farther from the first i samples than the quotient of the options times the i-th
/// rank, and 6 float spacings at the largest coordinate; if i is below 100, than twice the rank, or
/// the square of the quotient times it if that is more. In the plane this holds from the samples
/// of the coarsest level on, those with the rank of the first: one sample only, unless the options
/// have a shorter `coarsest` radius. On meshes it holds for every i; the first rank is infinite.
///
/// Where radii vary, distances are divided by the mean of two radii: see
/// azulejo_psp_adaptive_sample, and for a density azulejo_psp_adaptive_with_density.
const float *azulejo_points_ranks(const struct azulejo_points *points);

/// The class of each sample of a set of several classes, its row in the matrix of azulejo_classes;
/// NULL for NULL, an empty set and sets made without classes.
const uint32_t *azulejo_points_classes(const struct azulejo_points *points);

/// The ids of the samples of a psp handle that has been edited (azulejo_psp_erase): a sample keeps
/// its id as long as it stands, and no other one ever gets it. NULL for NULL, an empty set and all
/// other sets.
const uint64_t *azulejo_points_ids(const struct azulejo_points *points);

/// Frees the set with all its arrays. NULL is allowed.
void azulejo_points_free(struct azulejo_points *points);

/// Writes the defaults. `struct_size` is sizeof *classes.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT.
azulejo_status azulejo_classes_init(struct azulejo_classes *classes, size_t struct_size);

/// Makes a matrix of radii from those of each class alone, as in Wei, "Multi-class blue noise
/// sampling", 2010: two classes keep the distance that a set of all samples of both, and of all
/// classes of larger radii, would have.
///
/// own: for each class the distance of its samples, positive and finite; `count` numbers.
///
/// count: the number of classes, 1 to AZULEJO_MAX_CLASSES.
///
/// factor: what the radii of two different classes are multiplied by, finite and 0 or more; 1 for
/// Wei's. Smaller factors leave each class nearer to the density that it has alone, and let samples
/// of two classes come nearer to each other.
///
/// matrix_out: count * count numbers, row by row.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT; then matrix_out is not written.
azulejo_status azulejo_classes_radii(const double *own,
                                     uint32_t count,
                                     double factor,
                                     double *matrix_out);

/// Writes the defaults. `struct_size` is sizeof *options.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT.
azulejo_status azulejo_kdrt_options_init(struct azulejo_kdrt_options *options, size_t struct_size);

/// Writes zeros and the size. `struct_size` is sizeof *report.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT.
azulejo_status azulejo_kdrt_report_init(struct azulejo_kdrt_report *report, size_t struct_size);

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
azulejo_status azulejo_kdrt_sample(const struct azulejo_context *context,
                                   const struct azulejo_kdrt_options *options,
                                   struct azulejo_points **out,
                                   struct azulejo_kdrt_report *report);

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
azulejo_status azulejo_kdrt_sample_window(const struct azulejo_context *context,
                                          const struct azulejo_kdrt_options *options,
                                          const double *window_min,
                                          const double *window_max,
                                          struct azulejo_points **out,
                                          struct azulejo_kdrt_report *report);

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
azulejo_status azulejo_kdrt_stream(const struct azulejo_context *context,
                                   const struct azulejo_kdrt_options *options,
                                   azulejo_kdrt_visit_fn visit,
                                   void *user,
                                   struct azulejo_kdrt_report *report);

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
/// options: `radius` must be 0, since classes have radii of their own; `count` and
/// `measure_covering_radius` must be 0 and `order` any. `given_clearances`, if not NULL, has
/// given_count rows, each with a clearance for each class; NULL: each class's own radius.
///
/// classes: with at least one class. A single class has the set of azulejo_kdrt_sample, in its
/// order.
///
/// out: the samples, x y each, with azulejo_points_classes, sorted by class, and within a class by
/// y and x; to be freed with azulejo_points_free.
///
/// O(samples) time, for a given number of classes, and 64 bytes of memory per sample. Where the
/// domain is a torus narrower than about 10 times the largest r_ij between classes of equal own
/// radii, these classes are filled by one thread, with 512 bytes per sample.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT, also for an own radius below 64 times the spacing of
/// floats at the largest coordinate; AZULEJO_ERROR_TOO_LARGE for 2^32 samples or more, or more than
/// memory holds; AZULEJO_ERROR_CANCELLED.
azulejo_status azulejo_kdrt_sample_classes(const struct azulejo_context *context,
                                           const struct azulejo_kdrt_options *options,
                                           const struct azulejo_classes *classes,
                                           struct azulejo_points **out);

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
/// classes of larger radii, and these on what lies around that again.
///
/// O(samples of the pattern) time. The plane takes what that of azulejo_kdrt_create takes for the
/// largest own radius, and 1 byte for each of the other radii on the sides of the domain. On a
/// torus that is narrower than about 10 times the largest r_ij between classes of equal own radii,
/// these and the classes before are made as a whole and kept, in 12 bytes per sample.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT as azulejo_kdrt_sample_classes; AZULEJO_ERROR_CANCELLED.
/// The domain may have more samples than can be held.
azulejo_status azulejo_kdrt_create_classes(const struct azulejo_context *context,
                                           const struct azulejo_kdrt_options *options,
                                           const struct azulejo_classes *classes,
                                           struct azulejo_kdrt **out);

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
/// the levels that have up to 65,536 samples in the whole domain, in 16 bytes per sample.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT as azulejo_kdrt_sample, so for more samples than floats
/// can carry, about 10^11; AZULEJO_ERROR_TOO_LARGE for a domain that is not tiled;
/// AZULEJO_ERROR_CANCELLED.
azulejo_status azulejo_kdrt_create(const struct azulejo_context *context,
                                   const struct azulejo_kdrt_options *options,
                                   struct azulejo_kdrt **out);

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
/// it.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT; AZULEJO_ERROR_TOO_LARGE for 2^32 samples or more in the
/// window, or more than memory holds.
azulejo_status azulejo_kdrt_window(const struct azulejo_kdrt *plane,
                                   const double *window_min,
                                   const double *window_max,
                                   struct azulejo_points **out);

/// Frees a plane. NULL is allowed.
void azulejo_kdrt_free(struct azulejo_kdrt *plane);

/// Writes the defaults. `struct_size` is sizeof *options.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT.
azulejo_status azulejo_maximal_options_init(struct azulejo_maximal_options *options,
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
azulejo_status azulejo_maximal_sample(const struct azulejo_context *context,
                                      const struct azulejo_maximal_options *options,
                                      struct azulejo_points **out,
                                      struct azulejo_kdrt_report *report);

/// Writes the defaults. `struct_size` is sizeof *options.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT.
azulejo_status azulejo_kdrt_merge_options_init(struct azulejo_kdrt_merge_options *options,
                                               size_t struct_size);

/// Writes zeros and the size. `struct_size` is sizeof *report.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT.
azulejo_status azulejo_kdrt_merge_report_init(struct azulejo_kdrt_merge_report *report,
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
azulejo_status azulejo_kdrt_merge(const struct azulejo_context *context,
                                  const struct azulejo_kdrt_merge_options *options,
                                  const struct azulejo_kdrt_merge_piece *pieces,
                                  size_t piece_count,
                                  size_t piece_size,
                                  const float *fixed,
                                  size_t fixed_count,
                                  struct azulejo_points **out,
                                  struct azulejo_kdrt_merge_report *report);

/// Makes a mesh from a copy of the triangles of a scene that the program has made with Embree. The
/// scene and its device are not changed: neither flags nor error function nor thread count (but see
/// azulejo_context_create). The mesh does not need them after the call; its samples are traced in a
/// scene and on a device of the library's.
///
/// Triangles are numbered in the order of `geometries`: triangle i of the mesh is primitive i of
/// the first geometry, those of the second follow, and so on. The same holds for vertices.
///
/// scene: a committed RTCScene that no thread changes during the call. It must come from the
/// libembree that the program has linked or, where it has linked none that all its libraries see,
/// from the one that libazulejo loads by its SONAME: otherwise, as for an Embree that is linked
/// statically, the behaviour is undefined. Another version of a linked one is refused. Instances in
/// it are not followed.
///
/// geometries: `geometry_count` of them, at least one, each attached to the scene as
/// RTC_GEOMETRY_TYPE_TRIANGLE. If an id, a size or a type is not that of the scene, the behaviour
/// is undefined.
///
/// geometry_size: sizeof(azulejo_embree_geometry).
///
/// out: the mesh, to be freed with azulejo_mesh_free.
///
/// O(vertices + triangles).
///
/// Errors: those of azulejo_mesh_create; AZULEJO_ERROR_EMBREE for a scene of another version of
/// Embree, and where no Embree is found.
azulejo_status azulejo_mesh_create_from_embree(void *scene,
                                               const struct azulejo_embree_geometry *geometries,
                                               size_t geometry_count,
                                               size_t geometry_size,
                                               struct azulejo_mesh **out);

/// Makes a mesh from a copy of the caller's arrays.
///
/// positions: the vertices, x y z each, `stride_bytes` from one to the next; `vertex_count` of
/// them. What lies between is not read.
///
/// stride_bytes: a multiple of 4, at least 12.
///
/// indices: three per triangle, below `vertex_count`; triangles keep their order. Triangles without
/// area are allowed and get no samples.
///
/// out: the mesh, to be freed with azulejo_mesh_free.
///
/// O(vertices + triangles).
///
/// Memory: 12 bytes per vertex, 12 per triangle. What later calls make of the mesh whatever the
/// radius and the seed is kept with it, so that the next call does not pay for it again, on any
/// thread, and is freed with it: for any set, a summary of areas and edges, half a byte per
/// triangle, and one byte more from the second set of few samples or the first of many on (with a
/// mask, 4 bytes more for each that it keeps); for relaxation and triangulation, which edges are
/// shared, 12 bytes per triangle and 4 per vertex; for iterations of AZULEJO_ENGINE_EMBREE,
/// Embree's scene, about 100 bytes per triangle, and its device (see azulejo_context_create). A
/// mesh with other normals made from this one shares all that; one with another mask does not.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT for positions that are not finite, indices out of range,
/// no triangles, and triangles without any area; AZULEJO_ERROR_TOO_LARGE for 2^32 - 1 vertices or
/// triangles or more, and for sizes that overflow; AZULEJO_ERROR_OUT_OF_MEMORY.
azulejo_status azulejo_mesh_create(const float *positions,
                                   size_t vertex_count,
                                   size_t stride_bytes,
                                   const uint32_t *indices,
                                   size_t triangle_count,
                                   struct azulejo_mesh **out);

/// Loads a mesh from a file: Wavefront OBJ, PLY or STL (text and binary), distinguished by the
/// extension .obj, .ply or .stl, otherwise by the first bytes. Polygons become fans of triangles,
/// in the order of the faces. Vertices keep the order of the file; STL facets have three each,
/// which are not merged.
///
/// Normals of OBJ corners (vn) and of PLY vertices (nx ny nz) are read. In a file that has some, a
/// corner without a normal, or with one that is not finite, gets a zero normal: see
/// azulejo_mesh_with_normals. Points, lines, materials, texture coordinates, colours and normals of
/// STL facets are ignored.
///
/// path: the file name, terminated by a NUL: in the encoding of the operating system, on Windows in
/// UTF-8, whatever the code page.
///
/// out: the mesh, to be freed with azulejo_mesh_free.
///
/// O(size of the file), on the calling thread. The file is read block by block and is never in
/// memory as a whole; only an OBJ file with lines that go on in the next one, or with an error, is.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT; AZULEJO_ERROR_IO if the file cannot be read;
/// AZULEJO_ERROR_FORMAT if it is invalid, or has a mesh that azulejo_mesh_create would refuse.
azulejo_status azulejo_mesh_load(const char *path, struct azulejo_mesh **out);

/// Makes a mesh with the caller's normals in place of any that it has, such as the smooth ones of a
/// shaded surface. Samples are the same with and without; azulejo_points_interpolated_normals has
/// the normals at them.
///
/// mesh: the mesh, which is not changed.
///
/// normals: of any length, x y z each, `stride_bytes` from one to the next; `normal_count` of them.
/// Where the three normals of a triangle add up to zero at a sample, as zeros do, the sample gets
/// the normal of the triangle.
///
/// normal_count: the number of vertices, if there are no indices.
///
/// stride_bytes: a multiple of 4, at least 12.
///
/// normal_indices: three per triangle, below `normal_count`, for corners that share a vertex but
/// not its normal; NULL for one normal per vertex.
///
/// triangle_count: the number of triangles of the mesh; 0 if `normal_indices` is NULL.
///
/// out: the new mesh, to be freed with azulejo_mesh_free. It shares vertices, triangles and mask
/// with `mesh`; the two may be freed in any order.
///
/// O(normals + triangles).
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT for normals that are not finite or not as many as there
/// are vertices, and for indices out of range; AZULEJO_ERROR_TOO_LARGE for 2^32 - 1 normals or
/// more, and for sizes that overflow; AZULEJO_ERROR_OUT_OF_MEMORY.
azulejo_status azulejo_mesh_with_normals(const struct azulejo_mesh *mesh,
                                         const float *normals,
                                         size_t normal_count,
                                         size_t stride_bytes,
                                         const uint32_t *normal_indices,
                                         size_t triangle_count,
                                         struct azulejo_mesh **out);

/// Makes a mesh with a mask, in place of any that it has: triangles whose entry is 0 are left out
/// but keep their numbers. The rest is sampled, bit for bit, as if they did not exist: they get no
/// samples, have no area, and need not be covered. They do not separate anything either: samples on
/// both sides of them keep their distance through space. A mask may leave out everything; then a
/// maximal set is empty.
///
/// mesh: the mesh, which is not changed.
///
/// mask: one byte per triangle: 0 leaves it out, any other value keeps it.
///
/// triangle_count: the number of triangles of the mesh.
///
/// out: the new mesh, to be freed with azulejo_mesh_free. It shares vertices, triangles and normals
/// with `mesh`; the two may be freed in any order.
///
/// O(triangles).
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT for another count than that of the triangles;
/// AZULEJO_ERROR_OUT_OF_MEMORY.
azulejo_status azulejo_mesh_with_mask(const struct azulejo_mesh *mesh,
                                      const uint8_t *mask,
                                      size_t triangle_count,
                                      struct azulejo_mesh **out);

/// Makes a mesh with its vertices moved, such as for the next frame of an animation. Triangles and
/// mask stay; normals of azulejo_mesh_with_normals or of a file go. With azulejo_mesh_points the
/// samples of one mesh follow to the other.
///
/// mesh: the mesh, which is not changed.
///
/// positions: the vertices, x y z each, `stride_bytes` from one to the next; `vertex_count` of
/// them.
///
/// vertex_count: the number of vertices of the mesh.
///
/// stride_bytes: a multiple of 4, at least 12.
///
/// out: the new mesh, to be freed with azulejo_mesh_free. It shares triangles and mask with `mesh`;
/// the two may be freed in any order.
///
/// O(vertices + triangles).
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT for positions that are not finite or leave no area, and
/// for another count; AZULEJO_ERROR_OUT_OF_MEMORY.
azulejo_status azulejo_mesh_deform(const struct azulejo_mesh *mesh,
                                   const float *positions,
                                   size_t vertex_count,
                                   size_t stride_bytes,
                                   struct azulejo_mesh **out);

/// Evaluates places of a mesh, given by triangle and barycentrics, with the rounding of every
/// sampler: places of samples of this mesh give the samples, bit for bit, and on a mesh of
/// azulejo_mesh_deform each sample goes with its triangle.
///
/// triangles: the triangle of each place, below azulejo_mesh_triangle_count; `count` of them.
/// Triangles without area and masked triangles are allowed.
///
/// barycentrics: u v of each place, finite; `count` of them.
///
/// out: the positions with normals, triangles and barycentrics, in the same order, to be freed with
/// azulejo_points_free.
///
/// O(count).
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT; AZULEJO_ERROR_TOO_LARGE for sizes that overflow.
azulejo_status azulejo_mesh_points(const struct azulejo_mesh *mesh,
                                   const uint32_t *triangles,
                                   const float *barycentrics,
                                   size_t count,
                                   struct azulejo_points **out);

/// 1 if the mesh carries normals besides those of its triangles, else 0; 0 for NULL.
uint32_t azulejo_mesh_has_normals(const struct azulejo_mesh *mesh);

/// The number of vertices; 0 for NULL.
size_t azulejo_mesh_vertex_count(const struct azulejo_mesh *mesh);

/// The number of triangles, including masked ones; 0 for NULL.
size_t azulejo_mesh_triangle_count(const struct azulejo_mesh *mesh);

/// The vertices, x y z each, packed; valid until azulejo_mesh_free. NULL for NULL.
const float *azulejo_mesh_positions(const struct azulejo_mesh *mesh);

/// The three vertices of each triangle, counter-clockwise seen from the front; valid until
/// azulejo_mesh_free. NULL for NULL.
const uint32_t *azulejo_mesh_indices(const struct azulejo_mesh *mesh);

/// The area of all triangles that no mask leaves out, in squared units of the positions; 0 for
/// NULL. A maximal set of n samples has a radius of about sqrt(0.69656 * area / n), if that is
/// small compared with the features of the surface.
double azulejo_mesh_area(const struct azulejo_mesh *mesh);

/// Frees the mesh once no psp handle uses it any more. NULL is allowed.
void azulejo_mesh_free(struct azulejo_mesh *mesh);

/// Writes the defaults. `struct_size` is sizeof *options.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT.
azulejo_status azulejo_psp_options_init(struct azulejo_psp_options *options, size_t struct_size);

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
azulejo_status azulejo_psp_create(const struct azulejo_context *context,
                                  const struct azulejo_mesh *mesh,
                                  const struct azulejo_psp_options *options,
                                  struct azulejo_psp **out);

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
azulejo_status azulejo_psp_advance(struct azulejo_psp *psp,
                                   uint32_t iterations,
                                   struct azulejo_psp_report *report);

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
azulejo_status azulejo_psp_fill(struct azulejo_psp *psp, struct azulejo_psp_report *report);

/// Copies the set in its present state; one that has been edited by rising ids. Several threads may
/// do so at once.
///
/// out: the samples with normals, triangles and barycentrics, to be freed with azulejo_points_free.
///
/// O(samples).
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT; AZULEJO_ERROR_BUSY while another call changes the
/// handle.
azulejo_status azulejo_psp_points(const struct azulejo_psp *psp, struct azulejo_points **out);

/// Frees the handle, but not the points taken from it. Must not be called from its own progress
/// callback. NULL is allowed.
void azulejo_psp_free(struct azulejo_psp *psp);

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
azulejo_status azulejo_psp_sample(const struct azulejo_context *context,
                                  const struct azulejo_mesh *mesh,
                                  const struct azulejo_psp_options *options,
                                  struct azulejo_points **out,
                                  struct azulejo_psp_report *report);

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
/// options: `radius` must be 0, as the classes have radii. `count`, `order`, `iterations`,
/// `maximal`, `priority` and `engine` must have their defaults. `given_clearances` has a row for
/// each given sample with a clearance for each class; NULL stands for each class's own radius.
///
/// classes: the radii, and where each class may stand.
///
/// out: the samples with normals, triangles, barycentrics and azulejo_points_classes, by which they
/// are sorted; to be freed with azulejo_points_free.
///
/// With two classes each sample takes about twice the time of one of azulejo_psp_sample, with eight
/// about four times; all triangles are visited once for each class.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT, also for `radii` above 0 below 64 times the spacing of
/// floats at the largest coordinate; AZULEJO_ERROR_TOO_LARGE, with the estimated number of samples;
/// AZULEJO_ERROR_CANCELLED by the progress callback.
azulejo_status azulejo_psp_sample_classes(const struct azulejo_context *context,
                                          const struct azulejo_mesh *mesh,
                                          const struct azulejo_psp_options *options,
                                          const struct azulejo_classes *classes,
                                          struct azulejo_points **out);

/// Writes the defaults: all of space. `struct_size` is sizeof *region.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT.
azulejo_status azulejo_region_init(struct azulejo_region *region, size_t struct_size);

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
azulejo_status azulejo_psp_erase(struct azulejo_psp *psp,
                                 const struct azulejo_region *region,
                                 struct azulejo_points **erased);

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
azulejo_status azulejo_psp_erase_ids(struct azulejo_psp *psp,
                                     const uint64_t *ids,
                                     size_t count,
                                     struct azulejo_points **erased);

/// Puts samples back that were erased from the set, with their ids and all their bytes.
///
/// points: from an edit of this handle; not changed, and still to be freed.
///
/// O(points + samples in the cubes of 24 radii around them).
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT, also for samples that are not this set's, that stand
/// already, or that are too close to a sample or a given sample by now; AZULEJO_ERROR_BUSY while
/// another call uses the handle. Nothing is put back then.
azulejo_status azulejo_psp_restore(struct azulejo_psp *psp, const struct azulejo_points *points);

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
azulejo_status azulejo_psp_add_given(struct azulejo_psp *psp,
                                     const float *positions,
                                     const double *clearances,
                                     size_t count,
                                     uint64_t *first_id,
                                     struct azulejo_points **erased);

/// Removes given samples by their ids: the surface that they covered is filled by the next
/// azulejo_psp_refill.
///
/// O(given samples).
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT, also for an id that no given sample has;
/// AZULEJO_ERROR_BUSY while another call uses the handle. Nothing is removed then.
azulejo_status azulejo_psp_remove_given(struct azulejo_psp *psp, const uint64_t *ids, size_t count);

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
azulejo_status azulejo_psp_refill(struct azulejo_psp *psp,
                                  uint64_t seed,
                                  struct azulejo_points **added,
                                  struct azulejo_psp_report *report);

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
azulejo_status azulejo_psp_sample_region(const struct azulejo_context *context,
                                         const struct azulejo_mesh *mesh,
                                         const struct azulejo_psp_options *options,
                                         const struct azulejo_region *region,
                                         struct azulejo_points **out,
                                         struct azulejo_psp_report *report);

/// Writes zeros and the size. `struct_size` is sizeof *report.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT.
azulejo_status azulejo_psp_report_init(struct azulejo_psp_report *report, size_t struct_size);

/// Writes the defaults. `struct_size` is sizeof *options.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT.
azulejo_status azulejo_psp_adaptive_options_init(struct azulejo_psp_adaptive_options *options,
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
azulejo_status azulejo_psp_adaptive_sample(const struct azulejo_context *context,
                                           const struct azulejo_mesh *mesh,
                                           const struct azulejo_psp_adaptive_options *options,
                                           struct azulejo_points **out,
                                           struct azulejo_psp_report *report);

/// Writes the defaults. `struct_size` is sizeof *density.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT.
azulejo_status azulejo_mesh_density_init(struct azulejo_mesh_density *density, size_t struct_size);

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
azulejo_status azulejo_psp_adaptive_with_density(const struct azulejo_context *context,
                                                 const struct azulejo_mesh *mesh,
                                                 const struct azulejo_psp_adaptive_options *options,
                                                 const struct azulejo_mesh_density *density,
                                                 struct azulejo_points **out,
                                                 struct azulejo_psp_report *report);

/// Writes the defaults. `struct_size` is sizeof *options.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT.
azulejo_status azulejo_dcr_options_init(struct azulejo_dcr_options *options, size_t struct_size);

/// Writes zeros and the size. `struct_size` is sizeof *report.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT.
azulejo_status azulejo_dcr_report_init(struct azulejo_dcr_report *report, size_t struct_size);

/// Relaxes a set of points: neighbours that are too close repel each other and holes close, until
/// the set has converged or all steps are made (thesis chapter 4).
///
/// AZULEJO_METHOD_MOMENTUM levels a clustered set before the first step, one in which points are
/// crowded in some places and missing in others: any set ends as a random one does, and after about
/// the same time. A call that makes all steps succeeds whether or not it has converged; the report
/// has the figures.
///
/// With AZULEJO_METHOD_MOMENTUM and Delaunay neighbours the result is, of the set before the first
/// step and the states after whole steps, the one in which the fewest points have a neighbour
/// closer than 0.85 d_max or a Delaunay triangle with a circumradius above 0.67 d_max. Otherwise it
/// is the set after the last whole step. A call that its progress callback cancels succeeds with
/// what there is then, and AZULEJO_STOPPED_CANCELLED in the report.
///
/// positions: the points, x y each, with domain_min <= x < domain_max; `count` of them.
///
/// out: the points, in the same order, to be freed with azulejo_points_free.
///
/// report: what the call did, or NULL.
///
/// O(count) time for each step from evenly spread points. O(count * log count) where the
/// triangulation is built again: in each step of AZULEJO_METHOD_THESIS, and with
/// AZULEJO_METHOD_MOMENTUM in sets of a few points and in the first steps of sets with holes as
/// wide as the domain. A bounded domain takes up to four times the time and memory of a periodic
/// one. O(count) memory.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT, AZULEJO_ERROR_TOO_LARGE.
azulejo_status azulejo_dcr_relax(const struct azulejo_context *context,
                                 const struct azulejo_dcr_options *options,
                                 const float *positions,
                                 size_t count,
                                 struct azulejo_points **out,
                                 struct azulejo_dcr_report *report);

/// Relaxes points of several classes, such as those of azulejo_kdrt_sample_classes: the union
/// of all points and each class by itself get more even. They cannot be as even as a set of one
/// class, as a good lattice does not divide into good lattices: from maximal sets of 2 to 7
/// classes of a periodic domain, rho ends above 0.7 and the covering radius below 0.82 d_max,
/// in the union and in each class, where before some covering radii were 1 d_max and more. No
/// distance between points of two classes is promised.
///
/// Only AZULEJO_METHOD_MOMENTUM with AZULEJO_NEIGHBOURHOOD_DELAUNAY. The result is the set
/// after the last whole step; it mostly makes all of them. A class whose points are crowded in
/// some places and missing in others is levelled before the first step. A call that its
/// progress callback cancels succeeds with what there is then, and AZULEJO_STOPPED_CANCELLED in
/// the report.
///
/// positions: the points, x y each, with domain_min <= x < domain_max; `count` of them.
///
/// classes: the class of each point, below class_count; `count` of them.
///
/// class_count: the number of classes, at least 1 and at most AZULEJO_MAX_CLASSES.
///
/// class_rho, class_relative_covering_radius: class_count numbers each, or NULL: `rho` and
/// `relative_covering_radius` of each class, as in the report, in units of the d_max of its own
/// number of points; infinite where a class has fewer than two points, or none.
///
/// out: the points, in the same order, to be freed with azulejo_points_free.
///
/// report: what the call did, with the figures of the union, or NULL.
///
/// About 2.5 times the time of azulejo_dcr_relax, and O(count) memory. Source: the constraints
/// of thesis chapter 4 for each of the sets; several classes after Wei 2010.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT, AZULEJO_ERROR_TOO_LARGE.
azulejo_status azulejo_dcr_relax_classes(const struct azulejo_context *context,
                                         const struct azulejo_dcr_options *options,
                                         const float *positions,
                                         const uint32_t *classes,
                                         size_t count,
                                         uint32_t class_count,
                                         double *class_rho,
                                         double *class_relative_covering_radius,
                                         struct azulejo_points **out,
                                         struct azulejo_dcr_report *report);

/// Writes the defaults. `struct_size` is sizeof *density.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT.
azulejo_status azulejo_density_init(struct azulejo_density *density, size_t struct_size);

/// Makes random points with a density: a start for azulejo_dcr_relax_density.
///
/// options: the domain, the boundary, the seed and the progress callback are used; the other fields
/// are checked only.
///
/// density: the density of the points.
///
/// count: the number of points.
///
/// out: the points, x y each, to be freed with azulejo_points_free.
///
/// O(count * log count) time, and O(count) calls of a density function; O(count) memory.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT, also for densities that are negative or not finite, or 0
/// everywhere; AZULEJO_ERROR_TOO_LARGE; AZULEJO_ERROR_CANCELLED.
azulejo_status azulejo_dcr_scatter(const struct azulejo_context *context,
                                   const struct azulejo_dcr_options *options,
                                   const struct azulejo_density *density,
                                   size_t count,
                                   struct azulejo_points **out);

/// Relaxes a set of points to a density: as azulejo_dcr_relax, but the points become as dense from
/// place to place as the density says, and evenly spaced relative to it (thesis section 4.2.3).
/// Points whose density is about right, such as those of azulejo_dcr_scatter and
/// azulejo_psp_adaptive_sample, need no more than the default 100 steps. A set of more than 64
/// points that is far from it is redistributed before the first step, onto points as
/// azulejo_dcr_scatter makes them from the seed; those in between may need more steps.
///
/// The unit of length is the local spacing: d_max for the mean density and proportional to 1 /
/// sqrt(density) elsewhere, but it increases by no more than half of the distance from place to
/// place, so that it is finite where the density is 0. The report's rho is the least of all
/// distances over the mean of the spacings of the two points; its coverage is the largest
/// circumradius of a Delaunay triangle over the spacing at its centre, without the limit to its
/// increase; its motion is in units of d_max. Details of the density smaller than an eighth of
/// d_max are lost.
///
/// options: AZULEJO_METHOD_MOMENTUM and AZULEJO_NEIGHBOURHOOD_DELAUNAY, the defaults; others are
/// refused.
///
/// density: the density of the points; used during the call only.
///
/// positions: the points, x y each, with domain_min <= x < domain_max; `count` of them.
///
/// out: the points after the last whole step, in the same order, to be freed with
/// azulejo_points_free. A call that its progress callback cancels succeeds, as that of
/// azulejo_dcr_relax does.
///
/// report: what the call did, or NULL.
///
/// O(count) calls of a density function, then O(count) time for each step, with a factor for
/// densities that vary by orders of magnitude; O(count) memory.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT, also for densities that are negative or not finite, or 0
/// everywhere; AZULEJO_ERROR_TOO_LARGE.
azulejo_status azulejo_dcr_relax_density(const struct azulejo_context *context,
                                         const struct azulejo_dcr_options *options,
                                         const struct azulejo_density *density,
                                         const float *positions,
                                         size_t count,
                                         struct azulejo_points **out,
                                         struct azulejo_dcr_report *report);

/// Writes the defaults. `struct_size` is sizeof *options.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT.
azulejo_status azulejo_dcr_surface_options_init(struct azulejo_dcr_surface_options *options,
                                                size_t struct_size);

/// Writes zeros and the size. `struct_size` is sizeof *report.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT.
azulejo_status azulejo_dcr_surface_report_init(struct azulejo_dcr_surface_report *report,
                                               size_t struct_size);

/// Relaxes samples on a mesh: they move on the surface, away from neighbours that are too close and
/// into holes, until the set has converged or all steps are made (the future work of thesis chapter
/// 4). Neighbours are near on the surface, not on the other side of a thin wall. Triangles are
/// connected by edges between the same two positions; any other edge is a boundary, which samples
/// do not cross.
///
/// No two samples get nearer to each other than the nearest two were before, on whatever sides of
/// walls and boundaries: straight distances, in double arithmetic on the positions, without
/// tolerance, after any number of steps. A call that its progress callback cancels succeeds: it
/// returns the samples after the last whole step, and AZULEJO_STOPPED_CANCELLED in the report.
///
/// More than 64 samples that are clustered on a part of the surface are redistributed over all of
/// it before the first step, onto random points that are no nearer to each other than the nearest
/// samples were: each connected part receives samples by its area. Without room for that they stay.
///
/// triangles, barycentrics: the triangle and the barycentrics u v of each of `count` samples, as
/// azulejo_points_triangles and azulejo_points_barycentrics return them. Barycentrics outside their
/// triangle by at most 1e-6 are moved onto it.
///
/// out: the samples after the last whole step, in the same order, with normals, triangles and
/// barycentrics, to be freed with azulejo_points_free.
///
/// report: what the call did, or NULL.
///
/// O(triangles) time once, and for evenly spread samples O(count) for each step, somewhat more with
/// many triangles between neighbouring samples. Steps take longer beside many boundaries and for
/// clustered samples. O(count + triangles) memory. The call is cancelled between steps.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT, also for triangles that do not exist, have no area or
/// are left out by the mask, and for barycentrics farther outside; AZULEJO_ERROR_TOO_LARGE.
azulejo_status azulejo_dcr_surface_relax(const struct azulejo_context *context,
                                         const struct azulejo_mesh *mesh,
                                         const struct azulejo_dcr_surface_options *options,
                                         const uint32_t *triangles,
                                         const float *barycentrics,
                                         size_t count,
                                         struct azulejo_points **out,
                                         struct azulejo_dcr_surface_report *report);

/// Writes zeros and the size. `struct_size` is sizeof *report.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT.
azulejo_status azulejo_dcr_remesh_report_init(struct azulejo_dcr_remesh_report *report,
                                              size_t struct_size);

/// Makes a mesh whose vertices are samples of another mesh (thesis fig. 1.12): remeshing, to more
/// triangles or to fewer. The samples must be spread about evenly, as maximal and relaxed sets are;
/// relaxed ones give the better angles. The triangles are those of the samples' Delaunay stars that
/// go together.
///
/// No edge has more than two triangles, and two triangles at an edge are wound alike. Samples that
/// resolve the features of a closed surface, wound alike everywhere, give a closed manifold of the
/// same topology. Where they do not, as on thin blades and between faces that are wound against
/// each other, there are holes. Triangles do not cross open boundaries: the new boundary is that of
/// the outermost samples.
///
/// triangles, barycentrics: as for azulejo_dcr_surface_relax.
///
/// out: the new mesh, to be freed with azulejo_mesh_free. Vertex i is sample i, also if it has no
/// triangle; triangles are wound as those of the old mesh under their corners. See
/// azulejo_mesh_positions and azulejo_mesh_indices.
///
/// report: what was made, or NULL.
///
/// O(n log n) time and O(n) memory in samples and triangles. Progress is that of
/// azulejo_context_watch.
///
/// Errors: those of azulejo_dcr_surface_relax; AZULEJO_ERROR_INVALID_ARGUMENT for samples that form
/// no triangle; AZULEJO_ERROR_CANCELLED.
azulejo_status azulejo_dcr_remesh(const struct azulejo_context *context,
                                  const struct azulejo_mesh *mesh,
                                  const uint32_t *triangles,
                                  const float *barycentrics,
                                  size_t count,
                                  struct azulejo_mesh **out,
                                  struct azulejo_dcr_remesh_report *report);

/// Writes the defaults. `struct_size` is sizeof *options.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT.
azulejo_status azulejo_thin_options_init(struct azulejo_thin_options *options, size_t struct_size);

/// Writes zeros and the size. `struct_size` is sizeof *report.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT.
azulejo_status azulejo_thin_report_init(struct azulejo_thin_report *report, size_t struct_size);

/// Selects points of a cloud that are far from each other and near to all the others.
///
/// With a radius, the selected points are at least the radius apart; without a count, every other
/// point is nearer than the radius to one of them. Without a radius, no other point is farther from
/// the selected ones than any two of them are from each other. In the progressive order this holds
/// for the first points of the selection as well, for any number of them. Distances are computed in
/// double arithmetic from the floats, without tolerance.
///
/// positions: the points, x y or x y z each, finite; `count` of them, at most 2^32 - 1. They may
/// coincide: by radius one of them is selected, in the progressive order they come last.
///
/// dimension: the number of coordinates of a point, 2 or 3.
///
/// out: the selected points, to be freed with azulejo_selection_free.
///
/// report: what the call did, or NULL.
///
/// O(count * log(count)) time, whether or not the density of the cloud varies; at worst, in clouds
/// made for it, O(count * selected). Up to 150 bytes of memory per point. The threads of the
/// context share the sorting of the points; the selection itself runs on one.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT, for a point that is not finite with its index;
/// AZULEJO_ERROR_TOO_LARGE; AZULEJO_ERROR_CANCELLED.
azulejo_status azulejo_thin(const struct azulejo_context *context,
                            const struct azulejo_thin_options *options,
                            const float *positions,
                            size_t count,
                            uint32_t dimension,
                            struct azulejo_selection **out,
                            struct azulejo_thin_report *report);

/// The number of selected points; 0 for NULL.
size_t azulejo_selection_count(const struct azulejo_selection *selection);

/// The indices of the selected points in the cloud: ascending in any order, in the order of
/// selection in the progressive one. NULL for NULL and for an empty selection.
const uint32_t *azulejo_selection_indices(const struct azulejo_selection *selection);

/// The ranks of the points of a progressive selection: the distance of each from the nearest of
/// those before it, rounded down to a float. They never rise; the first is infinite, those of
/// points that coincide with one before are 0. All points with a rank of at least r are at least r
/// apart. NULL for NULL, an empty selection and AZULEJO_ORDER_ANY.
const float *azulejo_selection_ranks(const struct azulejo_selection *selection);

/// Frees the selection with its arrays. NULL is allowed.
void azulejo_selection_free(struct azulejo_selection *selection);

/// The smallest distance between two points of the plane, in double arithmetic; on a periodic
/// domain around the torus.
///
/// set: the points.
///
/// out: the distance in the units of the domain; infinite for fewer than two points.
///
/// O(count) time for evenly spread points.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT, AZULEJO_ERROR_TOO_LARGE, AZULEJO_ERROR_CANCELLED.
azulejo_status azulejo_plane_smallest_distance(const struct azulejo_context *context,
                                               const struct azulejo_plane_set *set,
                                               double *out);

/// The covering radius of points of the plane; on a periodic domain around the torus. The set is
/// maximal for every radius that is not smaller.
///
/// set: the points.
///
/// out: the covering radius in the units of the domain, too small by less than a billionth of it;
/// infinite for no point.
///
/// Found exactly, by subdivision of the domain: O(count * log count) time for evenly spread points.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT, AZULEJO_ERROR_TOO_LARGE, AZULEJO_ERROR_CANCELLED.
azulejo_status azulejo_plane_covering_radius(const struct azulejo_context *context,
                                             const struct azulejo_plane_set *set,
                                             double *out);

/// The smallest straight distance between two points in space, in double arithmetic.
///
/// positions: the points, x y z each, finite; `count` of them.
///
/// out: the distance in the units of the positions; infinite for fewer than two points.
///
/// O(count) time for evenly spread points.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT, AZULEJO_ERROR_TOO_LARGE, AZULEJO_ERROR_CANCELLED.
azulejo_status azulejo_space_smallest_distance(const struct azulejo_context *context,
                                               const float *positions,
                                               size_t count,
                                               double *out);

/// The fraction of a surface that is farther than a radius from every sample, estimated by random
/// probes.
///
/// positions: the samples, x y z each, finite; `count` of them. They need not lie on the mesh.
///
/// radius: above 0, in the units of the mesh.
///
/// probes: the number of random places of the surface that are examined, at least 1, uniform over
/// its area.
///
/// seed: selects the places.
///
/// out: the fraction of the probes that are uncovered, 0 to 1; 0 if the mask of the mesh leaves out
/// everything.
///
/// O(probes + count) time for evenly spread samples. Probes do not prove coverage,
/// azulejo_mesh_coverage does.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT, AZULEJO_ERROR_TOO_LARGE, AZULEJO_ERROR_CANCELLED.
azulejo_status azulejo_mesh_uncovered_fraction(const struct azulejo_context *context,
                                               const struct azulejo_mesh *mesh,
                                               const float *positions,
                                               size_t count,
                                               double radius,
                                               uint64_t probes,
                                               uint64_t seed,
                                               double *out);

/// Writes zeros and the size. `struct_size` is sizeof *report.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT.
azulejo_status azulejo_coverage_report_init(struct azulejo_coverage_report *report,
                                            size_t struct_size);

/// Counts the gaps that points of the plane leave: the connected parts of the domain, or of the
/// torus, that are farther than a radius from all points, by more than 6 times the spacing of
/// floats at the largest coordinate of the domain. With no gap the set is maximal for the radius,
/// as "Terms" has it, and all maximal sets of this library have none.
///
/// set: the points.
///
/// radius: above 0, in the units of the domain.
///
/// out: the covering radius, as azulejo_plane_covering_radius finds it, and the number of gaps.
/// Every gap deeper than a millionth of the mean spacing is found, however small, and the deepest
/// in any case. An empty set has one gap.
///
/// Found exactly, by the Voronoi diagram: O(count * log count) time for evenly spread points.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT, AZULEJO_ERROR_TOO_LARGE, AZULEJO_ERROR_CANCELLED.
azulejo_status azulejo_plane_coverage(const struct azulejo_context *context,
                                      const struct azulejo_plane_set *set,
                                      double radius,
                                      struct azulejo_coverage_report *out);

/// Counts the gaps that samples leave on a mesh, by straight distance: groups of places that are
/// farther than a radius from all samples, by more than 6 times the spacing of floats at the
/// largest coordinate of the mesh, each within half of the radius of another place of its group.
/// With no gap the set is maximal for the radius, as "Terms" has it, and all maximal sets of this
/// library have none.
///
/// positions: the samples, x y z each, finite; `count` of them. They need not lie on the mesh.
///
/// radius: above 0, in the units of the mesh.
///
/// out: the covering radius, too small by less than a billionth of it, and the number of gaps.
/// Every gap deeper than a millionth of the radius is found, however small, and the deepest in any
/// case. An empty set has an infinite radius and at least one gap; a mesh without area, or whose
/// mask leaves out everything, has 0 and 0.
///
/// Found exactly, by subdivision of the triangles: O((count + triangles) * log count) time for
/// evenly spread samples, and about 100 pieces per radius^2 of uncovered area.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT; AZULEJO_ERROR_TOO_LARGE, also if more than about 600,000
/// * radius^2 of the area is uncovered; AZULEJO_ERROR_CANCELLED.
azulejo_status azulejo_mesh_coverage(const struct azulejo_context *context,
                                     const struct azulejo_mesh *mesh,
                                     const float *positions,
                                     size_t count,
                                     double radius,
                                     struct azulejo_coverage_report *out);

/// Writes zeros and the size. `struct_size` is sizeof *report.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT.
azulejo_status azulejo_plane_report_init(struct azulejo_plane_report *report, size_t struct_size);

/// Measures points of the plane: spacing, covering radius, bond order and Delaunay triangles.
///
/// set: the points.
///
/// out: the report.
///
/// O(count * log count) time for evenly spread points.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT, AZULEJO_ERROR_TOO_LARGE, AZULEJO_ERROR_CANCELLED.
azulejo_status azulejo_plane_measure(const struct azulejo_context *context,
                                     const struct azulejo_plane_set *set,
                                     struct azulejo_plane_report *out);

/// The histogram of the distances from points of the plane to their nearest neighbours.
///
/// set: the points.
///
/// reach: where the last bin ends, above 0, in units of d_max.
///
/// bins: the number of bins of equal width from 0 to `reach`, 1 to 65536.
///
/// out: an array of `bins` numbers: how many points have their nearest neighbour at such a
/// distance. Distances of `reach` and more, and a single point, are in no bin. Histograms of
/// several sets may be added.
///
/// O(count) time for evenly spread points.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT, AZULEJO_ERROR_TOO_LARGE, AZULEJO_ERROR_CANCELLED.
azulejo_status azulejo_plane_nearest_histogram(const struct azulejo_context *context,
                                               const struct azulejo_plane_set *set,
                                               double reach,
                                               size_t bins,
                                               uint64_t *out);

/// The radial distribution function g of points of the plane, also called pair correlation: the
/// density of other points at a distance from a point, over the mean density. 1 for a Poisson
/// process; a hexagonal lattice has peaks at 1, sqrt(3), 2, ... d_max.
///
/// In a bounded domain each pair is weighted by one over the fraction of the domain that overlaps
/// with the domain translated by their difference, which corrects for the edges (Ohser and Stoyan
/// 1981).
///
/// set: the points, at least 2.
///
/// reach: where the last bin ends, in units of d_max: above 0, and at most half of the width or
/// height of the domain.
///
/// bins: the number of bins of equal width from 0 to `reach`, 1 to 65536.
///
/// out: an array of `bins` numbers: the mean of g in each bin. For sets of one kind and count, the
/// mean of these over the sets is their g.
///
/// O(count * (1 + reach^2)) time for evenly spread points.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT, AZULEJO_ERROR_TOO_LARGE, AZULEJO_ERROR_CANCELLED.
azulejo_status azulejo_plane_radial_distribution(const struct azulejo_context *context,
                                                 const struct azulejo_plane_set *set,
                                                 double reach,
                                                 size_t bins,
                                                 double *out);

/// Writes zeros and the size. `struct_size` is sizeof *report.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT.
azulejo_status azulejo_spectrum_report_init(struct azulejo_spectrum_report *report,
                                            size_t struct_size);

/// Makes the spectrum of points of the plane, by nonuniform fast Fourier transform in double
/// arithmetic: the power differs from that of the direct sum by no more than its rounding to float.
///
/// A periodic domain has exact frequencies, whole numbers of waves per period. A bounded domain is
/// treated as a window of a larger set: points are weighted by a taper that falls to 0 at the
/// ellipse inside it, so that its edges do not show in the spectrum.
///
/// set: the points, which must be finite but may lie outside the domain. In a bounded domain at
/// least one must lie inside the ellipse.
///
/// size: the number of frequencies per side, 2 to 4096. The lowest are -(size / 2) steps of 1 /
/// width and 1 / height.
///
/// frequency_stride: 1 takes all frequencies; n, up to 4096, every n-th along both axes, so that
/// the spectra of large sets reach as far as those of small ones. For all figures, size *
/// frequency_stride of about 13 * sqrt(count) is enough on a square.
///
/// out: the spectrum, to be freed with azulejo_spectrum_free.
///
/// O(count + size^2 * log size) time, and about 40 bytes of memory per point and per frequency
/// during the call.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT, AZULEJO_ERROR_TOO_LARGE, AZULEJO_ERROR_CANCELLED.
azulejo_status azulejo_spectrum_create(const struct azulejo_context *context,
                                       const struct azulejo_plane_set *set,
                                       uint32_t size,
                                       uint32_t frequency_stride,
                                       struct azulejo_spectrum **out);

/// Makes the mean of the spectra of sets of one kind. The noise of a single spectrum decreases with
/// the square root of their number. It takes no context: it runs on the calling thread and does not
/// report progress.
///
/// spectra: `count` spectra, at least 1, all of one size.
///
/// out: the mean, to be freed with azulejo_spectrum_free; the spectra still belong to the caller.
///
/// O(count * size^2) time and memory.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT, AZULEJO_ERROR_TOO_LARGE.
azulejo_status azulejo_spectrum_mean(const struct azulejo_spectrum *const *spectra,
                                     size_t count,
                                     struct azulejo_spectrum **out);

/// The number of frequencies per side; 0 for NULL.
uint32_t azulejo_spectrum_size(const struct azulejo_spectrum *spectrum);

/// The power, size * size numbers, row by row from the lowest frequency. Frequency 0, whose power
/// is set to 0, is in row and column size / 2. Valid until azulejo_spectrum_free. NULL for NULL.
const float *azulejo_spectrum_power(const struct azulejo_spectrum *spectrum);

/// The radial curves of a spectrum, mean and anisotropy, out to its largest circle.
///
/// width: the width of an annulus, above 0, in units of sqrt(count / area). Annuli of fewer than
/// two frequencies are left out.
///
/// annuli: receives at most `capacity` of them, from the lowest frequency; may be NULL if
/// `capacity` is 0.
///
/// annulus_size: sizeof(azulejo_annulus).
///
/// out_count: their number, which may exceed the capacity.
///
/// O(size^2) time on the calling thread.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT.
azulejo_status azulejo_spectrum_radial(const struct azulejo_spectrum *spectrum,
                                       double width,
                                       struct azulejo_annulus *annuli,
                                       size_t capacity,
                                       size_t annulus_size,
                                       size_t *out_count);

/// Measures a spectrum: effective Nyquist frequency, oscillation, contrast and the highest peak.
///
/// width: the width of the annuli of the radial mean, above 0, in units of sqrt(count / area); 0.05
/// suits sets of some thousand points.
///
/// low, high: the range of frequencies for contrast and peak, finite, in units of sqrt(count /
/// area).
///
/// out: the report.
///
/// O(size^2) time on the calling thread.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT.
azulejo_status azulejo_spectrum_measure(const struct azulejo_spectrum *spectrum,
                                        double width,
                                        double low,
                                        double high,
                                        struct azulejo_spectrum_report *out);

/// Frees the spectrum. NULL is allowed.
void azulejo_spectrum_free(struct azulejo_spectrum *spectrum);

/// Measures the differences of samples on a mesh. They are divided by those with random points of
/// the mesh, so that boundaries, curvature and other sheets nearby cancel out (Davis and Peebles
/// 1983).
///
/// mesh: must have area that its mask does not leave out.
///
/// positions: the samples, x y z each, finite; `count` of them, at least 2.
///
/// normals: the normals of the samples' triangles, x y z each, as azulejo_points_normals returns
/// them; `count` of them.
///
/// direction: three numbers, not all 0: the x axis of the offsets is its projection onto the
/// tangent plane.
///
/// seed: selects the random points, two per sample.
///
/// out: the differences, to be freed with azulejo_differences_free.
///
/// O(count) time for evenly spread samples.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT, AZULEJO_ERROR_TOO_LARGE, AZULEJO_ERROR_CANCELLED.
azulejo_status azulejo_differences_create(const struct azulejo_context *context,
                                          const struct azulejo_mesh *mesh,
                                          const float *positions,
                                          const float *normals,
                                          size_t count,
                                          const double *direction,
                                          uint64_t seed,
                                          struct azulejo_differences **out);

/// Combines the differences of sets of one kind. Their noise decreases with the square root of the
/// number of sets. It takes no context: it runs on the calling thread and does not report progress.
///
/// differences: `count` of them, at least 1.
///
/// out: the mean, to be freed with azulejo_differences_free; those given still belong to the
/// caller.
///
/// O(count) time and memory.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT, AZULEJO_ERROR_TOO_LARGE.
azulejo_status azulejo_differences_mean(const struct azulejo_differences *const *differences,
                                        size_t count,
                                        struct azulejo_differences **out);

/// p(d): AZULEJO_DIFFERENCES_SIZE squared numbers, row by row from the lowest offset; 0 where not
/// even random points have a pair. The offset 0 is in the middle, where four cells meet. Valid
/// until azulejo_differences_free. NULL for NULL.
const double *azulejo_differences_density(const struct azulejo_differences *differences);

/// The radial mean of p(d), the radial distribution function: AZULEJO_DIFFERENCES_SHELLS numbers.
/// Valid until azulejo_differences_free. NULL for NULL.
const double *azulejo_differences_radial(const struct azulejo_differences *differences);

/// The radial mean of the power spectrum, by Hankel transform of the radial mean of p(d) - 1; 1 for
/// a Poisson process. Its resolution is one over AZULEJO_DIFFERENCES_REACH.
///
/// frequencies: `count` frequencies from -32 to 32, in units of one over the mean spacing; may be
/// NULL if `count` is 0.
///
/// out: receives the power at each, `count` numbers; may be NULL if `count` is 0.
///
/// O(count) time on the calling thread.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT, AZULEJO_ERROR_TOO_LARGE.
azulejo_status azulejo_differences_power(const struct azulejo_differences *differences,
                                         const double *frequencies,
                                         size_t count,
                                         double *out);

/// Frees the differences. NULL is allowed.
void azulejo_differences_free(struct azulejo_differences *differences);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* AZULEJO_H */
