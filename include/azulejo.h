/*
 * azulejo: blue-noise sampling of planes and triangle meshes, and the relaxation of point sets.
 *
 * This header is generated from ffi/azulejo-c by cbindgen; do not edit it. It is C99; C++ programs may prefer
 * azulejo.hpp, which wraps it.
 *
 * Conventions, which hold for every function unless its own text says otherwise:
 *
 * Status. A call that can fail returns an azulejo_status: AZULEJO_OK (0) or one of the negative AZULEJO_ERROR_ codes.
 *   azulejo_last_error_message then says which argument is wrong, its value and its range. Arguments are checked before
 *   any work starts. Outputs are written on success only. Nothing is thrown or unwound into C, and nothing is printed
 *   to stdout; a panic inside the library, which is a bug, prints to stderr and becomes AZULEJO_ERROR_INTERNAL.
 *
 * Handles. azulejo_context, azulejo_mesh, azulejo_psp, azulejo_points, azulejo_spectrum and azulejo_differences are made
 *   by the library and given back with their own _free, which allows NULL. They may be freed in any order: what a handle
 *   needs of another one, it keeps. Accessors allow NULL too and answer 0 or NULL. Pointers into a handle live until it is
 *   freed.
 *
 * Pointers. An argument may be NULL only where that is said. Arrays are packed and read during the call only; the
 *   pointer of an empty array may be NULL, with the count 0. Arrays and options that are not aligned for their type are
 *   refused.
 *   Beyond that no library can tell a wrong pointer or a wrong count from a right one.
 *
 * Options. Every options struct begins with struct_size and is filled with defaults by its _options_init, which must
 *   be called first: azulejo_kdrt_options o; azulejo_kdrt_options_init(&o, sizeof o); o.radius = 0.01; ...
 *   A field exists for the library iff struct_size reaches its end, so that structs can grow: a program built against
 *   an older header goes on working, and one built against a newer header works as long as what the library does not
 *   know is zero. A struct with a non-zero tail, an unknown constant or a flag other than 0 and 1 is refused. Reports
 *   are written by the library and need no preparation; they never grow, their reserved fields are zero.
 *
 * Progress. The callback in the options, or without one that of the context (azulejo_context_watch), is called on the thread
 *   that makes the call, with the finished share, which never falls, from 0 to 1 (the 1 comes if the call succeeds). Any
 *   return value but 0 cancels the call, which then returns AZULEJO_ERROR_CANCELLED; only azulejo_dcr_relax,
 *   azulejo_dcr_relax_density and azulejo_dcr_relax_surface return what they have, as their reports say. Only
 *   azulejo_dcr_scatter, calls that take no context, and the making of a psp handle tell nobody. The callback may call the library, also with the same context. It must return:
 *   an exception that leaves it ends the process, a longjmp is undefined. The same holds for the callback of
 *   azulejo_kdrt_stream. Only an azulejo_radius_fn and an azulejo_density_fn are called on other threads, and several at
 *   once.
 *
 * Threads. Every function may be called from any thread at any time. A context can be used by several threads at
 *   once; a psp handle serves one changing call at a time and refuses a second one. The last error belongs to the
 *   thread that made the call. In a process that is forked, contexts with more than one thread and what was made with
 *   them refuse to work, with AZULEJO_ERROR_THREADS, since their threads are in the other process; everything can be
 *   freed. Contexts of one thread, and those made after the fork, work; but Embree's own threads are gone as well, so
 *   that a process that used it before it forked should use AZULEJO_ENGINE_RASTERISER after.
 *
 * Results. The same options and seed give the same bytes, for every number of threads and whatever was called before.
 *   A radius is always the smallest distance allowed between the centres of two samples; where it varies, the mean of
 *   their two radii is. Conflict-free: no two samples are closer than the radius, in double arithmetic on the returned
 *   floats, without tolerance. Maximal: no place of the domain or surface is farther than the radius from every sample,
 *   up to the rounding of the returned floats: 3 times the spacing of floats at the largest coordinate in the plane, 6
 *   times where sets are merged and on a mesh.
 *
 * Memory. Sizes that cannot be held are refused with AZULEJO_ERROR_TOO_LARGE before memory is taken: what the machine has
 *   left counts, and the limits of the process (ulimit -v) and of its control groups. When there is no memory left in the
 *   middle of a call nevertheless, the process is aborted, as by every Rust library.
 *
 * The algorithms are those of T. Wang, Techniques on Mining Effective Parallelism For High-Performance Blue-Noise
 * Sampling, University of Tokyo, 2019 ("thesis" below).
 */

#ifndef AZULEJO_H
#define AZULEJO_H

#include <stddef.h>
#include <stdint.h>

/// The call did what it says.
#define AZULEJO_OK 0

/// An argument or an option is outside its documented range.
#define AZULEJO_ERROR_INVALID_ARGUMENT -1

/// The call asks for more than can be indexed or held; refused before memory was taken, with the estimate.
#define AZULEJO_ERROR_TOO_LARGE -2

/// A file could not be read.
#define AZULEJO_ERROR_IO -3

/// A file was read, but is not what it should be.
#define AZULEJO_ERROR_FORMAT -4

/// A callback of the caller cancelled the call.
#define AZULEJO_ERROR_CANCELLED -5

/// Memory for a copy of the caller's arrays could not be had.
#define AZULEJO_ERROR_OUT_OF_MEMORY -6

/// Embree refused: no device, no memory, or a scene that it cannot build.
#define AZULEJO_ERROR_EMBREE -7

/// Threads could not be started, or are in the process that this one was forked from.
#define AZULEJO_ERROR_THREADS -8

/// A bug of the library, please report it. Handles that took part in the call can only be freed.
#define AZULEJO_ERROR_INTERNAL -100

/// The major version of this header. It changes when programs must be changed.
#define AZULEJO_VERSION_MAJOR 0

/// The minor version of this header. It changes when something is added; before 1.0 also when programs must be changed.
#define AZULEJO_VERSION_MINOR 2

/// The patch level of this header.
#define AZULEJO_VERSION_PATCH 0

/// The version of this header as one number: major * 10000 + minor * 100 + patch.
#define AZULEJO_VERSION (((AZULEJO_VERSION_MAJOR * 10000) + (AZULEJO_VERSION_MINOR * 100)) + AZULEJO_VERSION_PATCH)

/// The domain is a torus: distances wrap with the period domain_max - domain_min.
#define AZULEJO_BOUNDARY_PERIODIC 0

/// Nothing lies beyond the domain: only its own samples count, and they alone cover it.
#define AZULEJO_BOUNDARY_BOUNDED 1

/// Where two candidates of an iteration are too close, that one comes first that its projector faces more squarely: the
/// default, which finds more samples. Existing samples come before all candidates.
#define AZULEJO_PRIORITY_SQUARENESS 0

/// The candidate of the earlier projector comes first, as in the thesis (§3.3.2). Existing samples come before all.
#define AZULEJO_PRIORITY_PROJECTOR 1

/// Embree's ray packets find where patterns meet the mesh: the default.
#define AZULEJO_ENGINE_EMBREE 0

/// Triangles are drawn over the patterns in exact integer arithmetic (thesis §3.4.3): other machines and other Embrees
/// find the same. The hits are those of Embree but for rounding, which moves points and edges against each other by up
/// to 2e-7 of the mesh's diagonal: a point that near to an edge may hit the triangle on its other side.
#define AZULEJO_ENGINE_RASTERISER 1

/// A point's neighbours are those of the Delaunay triangulation: they keep their distance and close holes.
#define AZULEJO_NEIGHBOURHOOD_DELAUNAY 0

/// A point's neighbours are its nearest points: they repel only.
#define AZULEJO_NEIGHBOURHOOD_NEAREST 1

/// Neighbours in conflict push each other away, holes pull their borders in, points have momentum, and long waves of the
/// density are removed: the default.
#define AZULEJO_METHOD_MOMENTUM 0

/// The algorithm of thesis chapter 4.
#define AZULEJO_METHOD_THESIS 1

/// The tension of an edge is divided between its ends by their activeness: the default.
#define AZULEJO_DISTRIBUTION_ACTIVENESS 0

/// Half of the tension to each end.
#define AZULEJO_DISTRIBUTION_AVERAGE 1

/// All of the tension to the neighbour.
#define AZULEJO_DISTRIBUTION_DOMINANT 2

/// All of the tension to the point itself.
#define AZULEJO_DISTRIBUTION_ZERO 3

/// 80 per cent of the tension to the point itself, 20 to the neighbour.
#define AZULEJO_DISTRIBUTION_EIGHTY_TWENTY 4

/// An edge is visited from each end that has the other in its neighbourhood: the default.
#define AZULEJO_VISITS_BOTH_ENDS 0

/// An edge is visited from one end, the same in every step, by a coin keyed by the seed and the two points: points get about
/// half as far in a step, and the constant distributions differ with Delaunay neighbours too.
#define AZULEJO_VISITS_ONE_END 1

/// A set has converged when the motion falls to the tolerance: the default.
#define AZULEJO_CONVERGENCE_MOTION 0

/// A set has converged when ten times in a row the variance of the distances to the nearest point changes by less than 0.1
/// per cent in a step, and more than 99 per cent of the points move by less than 0.01 d_max (thesis section 4.4.2). The
/// smaller the step, the earlier that happens; in sets of a few hundred points it may never.
#define AZULEJO_CONVERGENCE_VARIANCE 1

/// The motion came to its end, or there was nothing to move. With AZULEJO_METHOD_MOMENTUM and Delaunay neighbours no points are
/// closer than 0.85 d_max then, nor a circumradius above 0.67 d_max, up to the last step.
#define AZULEJO_STOPPED_CONVERGED 0

/// All steps were made.
#define AZULEJO_STOPPED_STEPS 1

/// The progress callback cancelled the call.
#define AZULEJO_STOPPED_CANCELLED 2

/// The grid of azulejo_differences_density has so many cells per side ...
#define AZULEJO_DIFFERENCES_SIZE 128

/// ... and reaches so far from the difference 0 along both axes, in mean spacings.
#define AZULEJO_DIFFERENCES_GRID_REACH 4

/// azulejo_differences_radial has so many shells of equal width ...
#define AZULEJO_DIFFERENCES_SHELLS 512

/// ... out to this distance, in mean spacings.
#define AZULEJO_DIFFERENCES_REACH 8

/// A pool of threads of its own; give it to every call that works for long. One context for a whole program is usual.
/// It can be used by several threads at once.
typedef struct azulejo_context azulejo_context;

/// The distribution p(d) of the differences d of all pairs of samples on a mesh, or of several sets (Wei and Wang 2011,
/// "Differential domain analysis for non-uniform sampling"): the density of other samples at an offset from a sample, over
/// the mean density. 1 for a Poisson process. Its Fourier transform is the power spectrum, which a surface has no other
/// way to have. Never changes.
///
/// The offset of a pair is projected onto the tangent plane of its first sample and keeps its straight length. Lengths are
/// in mean spacings, sqrt(area / count), and frequencies in units of one over it.
typedef struct azulejo_differences azulejo_differences;

/// A checked triangle mesh: immutable, may be used by several threads at once. Any soup of triangles will do: open,
/// non-manifold, of many parts and mixed winding. It may carry normals and a mask; meshes that are made of one another
/// share what they have in common.
typedef struct azulejo_mesh azulejo_mesh;

/// The samples that a call made: immutable, may be read by several threads at once. All arrays of a set have one entry
/// per sample, in the same order, and live until azulejo_points_free.
typedef struct azulejo_points azulejo_points;

/// A set of samples on a mesh that grows. It keeps its context and its mesh, which may be freed before it.
///
/// One call at a time may change it; a call that comes in between, from another thread or from the progress callback,
/// is refused. Several threads at once may take its points.
typedef struct azulejo_psp azulejo_psp;

/// The power spectrum of a set of the plane, or the mean of several: |sum of exp(-2 pi i f x)|^2 / count on a square grid of
/// frequencies f. 1 on average for a Poisson process (Ulichney 1988; Lagae and Dutre 2008). Never changes.
///
/// Frequencies are in units of sqrt(density), the density being count / area: sets of different size can be compared, and
/// the first ring of blue noise lies near 1.
typedef struct azulejo_spectrum azulejo_spectrum;

/// What a call answers: AZULEJO_OK or a negative AZULEJO_ERROR_ code. Codes are never reused; new ones may come.
typedef int32_t azulejo_status;

/// Called now and then during a long call, on the thread that made it. See "Progress" at the top.
///
/// user: the progress_user of the options or of azulejo_context_watch.
///
/// done: the fraction of the call that is done, from 0 to 1; it never decreases.
///
/// Returns 0 to go on, anything else to cancel the call.
typedef int32_t (*azulejo_progress_fn)(void *user, double done);

/// Points of the plane and their domain, for the calls that measure them.
typedef struct azulejo_plane_set {
    /// The size of the caller's struct in bytes; set by the init function.
    uint32_t struct_size;
    /// An AZULEJO_BOUNDARY_ constant; periodic by default.
    int32_t boundary;
    /// The points, x y each, in domain_min <= x < domain_max. NULL, the default, if there are none.
    const float *positions;
    /// The number of points; 0 by default.
    size_t count;
    /// The lower corner of the domain, x y; 0 0 by default.
    double domain_min[2];
    /// The upper corner of the domain, above the lower one on both axes; 1 1 by default.
    double domain_max[2];
} azulejo_plane_set;

/// What azulejo_kdrt_sample achieved.
typedef struct azulejo_kdrt_report {
    /// The size of the caller's struct in bytes; set by the init function.
    uint32_t struct_size;
    /// 1 if the set is maximal for `radius`, else 0.
    uint32_t is_maximal;
    /// The number of samples: the count, if there was one.
    uint64_t samples;
    /// The radius: that of the options, or the one that was found for the count. No two samples are closer.
    double radius;
    /// The covering radius: the farthest that any place of the domain is from all samples, as
    /// azulejo_plane_covering_radius measures it.
    double coverage;
    /// Wall time, without the measuring of `coverage`.
    double seconds;
} azulejo_kdrt_report;

/// Options of azulejo_kdrt_sample, azulejo_kdrt_sample_with_report, azulejo_kdrt_sample_window and azulejo_kdrt_stream.
typedef struct azulejo_kdrt_options {
    /// The size of the caller's struct in bytes; set by the init function.
    uint32_t struct_size;
    /// An AZULEJO_BOUNDARY_ constant; periodic by default.
    int32_t boundary;
    /// The smallest distance between two samples, in the units of the domain. Above 0; there is no default. With a
    /// count it must be 0: the radius follows.
    double radius;
    /// The lower corner of the domain, x y; 0 0 by default.
    double domain_min[2];
    /// The upper corner of the domain, above the lower one on both axes; 1 1 by default.
    double domain_max[2];
    /// The shortest side of the leaves that tile the domain, in radii: at least 6, by default 20; sides are random, up
    /// to twice this. Larger leaves are faster and have fewer seams, but need a larger pattern.
    double leaf_size;
    /// Any number; another seed gives another set.
    uint64_t seed;
    /// Called during the call, unless NULL, which is the default.
    azulejo_progress_fn progress;
    /// Handed to the progress callback.
    void *progress_user;
    /// How many samples there shall be, exactly; 0, the default, takes as many as the radius gives. Windows and streams
    /// need a radius.
    size_t count;
    /// 1: azulejo_kdrt_sample measures the `coverage` of its report. 0, the default: it does not.
    uint32_t measure_coverage;
    /// Must be 0.
    uint32_t reserved;
} azulejo_kdrt_options;

/// Called with a part of a set of samples, on the thread that made the call. What holds for progress callbacks holds
/// for it too: it may call the library, and must return.
///
/// user: what was given to the call.
///
/// xy: the samples, x y each, until the callback returns; `count` of them, at least one.
///
/// Returns 0 to go on, anything else to cancel.
typedef int32_t (*azulejo_kdrt_visit_fn)(void *user, const float *xy, size_t count);

/// Options of azulejo_maximal_sample.
typedef struct azulejo_maximal_options {
    /// The size of the caller's struct in bytes; set by the init function.
    uint32_t struct_size;
    /// An AZULEJO_BOUNDARY_ constant; periodic by default.
    int32_t boundary;
    /// The smallest distance between two samples, in the units of the domain. Above 0; there is no default.
    double radius;
    /// The lower corner of the domain, x y; 0 0 by default.
    double domain_min[2];
    /// The upper corner of the domain, above the lower one on both axes; 1 1 by default.
    double domain_max[2];
    /// Any number; another seed gives another set.
    uint64_t seed;
    /// Called during the call, unless NULL, which is the default.
    azulejo_progress_fn progress;
    /// Handed to the progress callback.
    void *progress_user;
} azulejo_maximal_options;

/// Options of azulejo_kdrt_merge.
typedef struct azulejo_kdrt_merge_options {
    /// The size of the caller's struct in bytes; set by the init function.
    uint32_t struct_size;
    /// An AZULEJO_BOUNDARY_ constant; periodic by default.
    int32_t boundary;
    /// The smallest distance between two samples, that of the pieces. Above 0; there is no default.
    double radius;
    /// The lower corner of the domain, x y; 0 0 by default.
    double domain_min[2];
    /// The upper corner of the domain, above the lower one on both axes; 1 1 by default.
    double domain_max[2];
    /// Any number; another seed gives another set.
    uint64_t seed;
    /// Called during the call, unless NULL, which is the default.
    azulejo_progress_fn progress;
    /// Handed to the progress callback.
    void *progress_user;
} azulejo_kdrt_merge_options;

/// What became of the samples of the pieces. The result has first the fixed points, then those kept, then the inserted
/// ones.
typedef struct azulejo_kdrt_merge_report {
    /// The size of the caller's struct in bytes; set by the init function.
    uint32_t struct_size;
    /// 0.
    uint32_t reserved;
    /// Samples of the pieces that are in the result.
    uint64_t kept;
    /// Samples of the pieces that are not.
    uint64_t eliminated;
    /// New samples.
    uint64_t inserted;
} azulejo_kdrt_merge_report;

/// A set of samples that was made by itself, such as by azulejo_kdrt_sample on a bounded domain or by
/// azulejo_kdrt_sample_window. It has no struct_size and never grows.
typedef struct azulejo_kdrt_merge_piece {
    /// The samples, x y each, in min <= x < max, no two of them closer than the radius; read during the call only. Any
    /// floats will do, and they need not be maximal. NULL if there are none.
    const float *xy;
    /// How many there are.
    size_t count;
    /// The lower corner of the piece's rectangle, x y.
    double min[2];
    /// The upper corner, above the lower one on both axes.
    double max[2];
} azulejo_kdrt_merge_piece;

/// A geometry of triangles in a scene of the caller's. Embree does not tell the sizes of its buffers: the caller does.
typedef struct azulejo_embree_geometry {
    /// Its number in the scene.
    uint32_t geometry_id;
    /// Bytes from one vertex to the next: a multiple of 4 from 12 on.
    uint32_t vertex_stride;
    /// Bytes from one triangle to the next: a multiple of 4 from 12 on.
    uint32_t index_stride;
    /// Must be 0.
    uint32_t reserved;
    /// Vertices in its buffer of type RTC_BUFFER_TYPE_VERTEX, slot 0, of format RTC_FORMAT_FLOAT3.
    size_t vertex_count;
    /// Triangles in its buffer of type RTC_BUFFER_TYPE_INDEX, of format RTC_FORMAT_UINT3.
    size_t triangle_count;
} azulejo_embree_geometry;

/// Options of azulejo_psp_create and azulejo_psp_sample.
typedef struct azulejo_psp_options {
    /// The size of the caller's struct in bytes; set by the init function.
    uint32_t struct_size;
    /// How often azulejo_psp_sample projects its patterns before it fills the gaps, 3 directions each time. More
    /// iterations leave less to the filling, which costs more per sample. The default is the fastest.
    uint32_t iterations;
    /// The smallest straight distance between two samples, in the units of the mesh. Above 0; there is no default.
    double radius;
    /// Any number; another seed gives another set.
    uint64_t seed;
    /// 1, the default: azulejo_psp_sample fills all gaps. 0: it stops after the iterations, as the thesis does, with
    /// some per cent of the surface uncovered.
    uint32_t maximal;
    /// An AZULEJO_PRIORITY_ constant; by squareness by default.
    int32_t priority;
    /// An AZULEJO_ENGINE_ constant; Embree by default.
    int32_t engine;
    /// Must be 0.
    uint32_t reserved;
    /// Called during the calls, unless NULL, which is the default. A psp handle keeps it for all its calls.
    azulejo_progress_fn progress;
    /// Handed to the progress callback.
    void *progress_user;
} azulejo_psp_options;

/// What a call did.
typedef struct azulejo_psp_report {
    /// The size of the caller's struct in bytes; set by the init function.
    uint32_t struct_size;
    /// The iterations of projection that it made.
    uint32_t iterations;
    /// The samples of the set after the call.
    uint64_t samples;
    /// The samples that the call added.
    uint64_t accepted;
    /// The rays that it traced: those that meet the mesh's box. With the rasteriser, the points of its tiles (at most 48
    /// radii wide) that have triangles near them.
    uint64_t rays;
    /// The places where they met the mesh.
    uint64_t hits;
    /// The hits that were lost to an earlier one on the same ray.
    uint64_t restart_conflicts;
    /// The darts that it threw into uncovered surface.
    uint64_t darts;
    /// The hits and darts that were lost to other samples.
    uint64_t conflicts;
    /// Wall time.
    double seconds;
    /// The part of the time in which patterns and, for Embree, the scene were made: in the first iteration of a set.
    double prepare_seconds;
    /// The part of the time in which the hits were found.
    double project_seconds;
    /// The part of the time in which samples were chosen among the hits.
    double merge_seconds;
    /// The part of the time in which uncovered surface was searched and filled.
    double fill_seconds;
    /// The relative radius of the set after the call, radius / d_max: d_max = sqrt(2 A / (sqrt(3) N)) would be the distance
    /// of N neighbours in hexagonal order on the area A. 0.78 for a maximal set; 0 for no samples. The smallest distance
    /// is taken to be the radius; that of a large set is less than a millionth above.
    double rho;
    /// If the call filled, the share of the area that was uncovered before, else -1. It is an estimate from above, two or
    /// three times too large: the area of the small fragments that no single sample covers when the search comes to them.
    double uncovered_before;
    /// If the call filled, the share of the area that is uncovered after, which is 0, else -1.
    double uncovered_after;
} azulejo_psp_report;

/// Gives the radius at a place.
///
/// It is called from several threads at once, the library's own; only where the context has one thread it is called on
/// the thread that made the call. It must give the same radius for the same place, must return (an exception
/// that leaves it ends the process, a longjmp is undefined), and must not call the library with the same context.
///
/// user: the radius_user of the options.
///
/// position: x y z of a place on the mesh; for a sample, the floats that are returned.
///
/// Returns the radius, from `smallest` to `largest`.
typedef double (*azulejo_radius_fn)(void *user, const double *position);

/// Options of azulejo_psp_adaptive_sample. Either `vertex_radii` or `radius` is to be set.
typedef struct azulejo_psp_adaptive_options {
    /// The size of the caller's struct in bytes; set by the init function.
    uint32_t struct_size;
    /// Must be 0.
    uint32_t reserved;
    /// A radius for each vertex of the mesh, above 0. At the barycentrics u v of a sample on the triangle (a, b, c) the
    /// radius is (1 - u - v) * a + u * b + v * c, in double arithmetic. It may change as steeply as it likes. NULL, the
    /// default, where `radius` is set.
    const float *vertex_radii;
    /// How many vertex_radii there are: as many as vertices of the mesh.
    size_t vertex_count;
    /// Gives the radius at a place, unless NULL, which is the default.
    azulejo_radius_fn radius;
    /// Handed to `radius`.
    void *radius_user;
    /// The least that `radius` gives, above 0. There is no default; not used with vertex_radii.
    double smallest;
    /// The largest that `radius` gives. There is no default; not used with vertex_radii.
    double largest;
    /// How much `radius` changes at most per unit of distance between two places of a triangle; 0, the default, says
    /// that it is constant there. What is covered is proved with it, so it must hold: a violation that is seen makes the
    /// call fail, one that is not can leave gaps. From about 1 on the work grows with its square; vertex_radii, which
    /// carry their own slopes, are the better choice for images and other data with edges. From about 30 on it may be too
    /// much, which is refused. At most `smallest` / 24 per float spacing at the largest coordinate of the mesh. Not used
    /// with vertex_radii.
    double slope;
    /// Samples on triangles whose normals have a smaller cosine than this ignore each other, so that the two sides of a
    /// thin wall are sampled as if they were far apart; the triangles must be wound consistently. From -1, the default,
    /// which is off, to 1, where only samples with the same normal see each other.
    double cosine;
    /// Any number; another seed gives another set.
    uint64_t seed;
    /// Called during the call, unless NULL, which is the default.
    azulejo_progress_fn progress;
    /// Handed to the progress callback.
    void *progress_user;
} azulejo_psp_adaptive_options;

/// What a relaxation did.
typedef struct azulejo_dcr_report {
    /// The size of the caller's struct in bytes; set by the init function.
    uint32_t struct_size;
    /// The steps made.
    uint32_t iterations;
    /// Why no more steps were made: an AZULEJO_STOPPED_ constant.
    int32_t stopped;
    /// 0.
    uint32_t reserved;
    /// Half of how far points got, root mean square, in units of d_max: over the last 10 steps, or with
    /// AZULEJO_METHOD_THESIS over the last steps whose sizes add up to 2, which is the same for small and large steps.
    double motion;
    /// The smallest distance between two of the points, in the units of the domain; infinite for less than two points.
    double smallest_distance;
    /// The smallest distance in units of d_max: 0.77 for a maximal set, at most 1 on a periodic domain.
    double rho;
    /// The largest distance of a place in the domain from the points, in units of d_max; infinite for no point.
    double coverage;
} azulejo_dcr_report;

/// Options of azulejo_dcr_relax. Radii are in units of d_max = sqrt(2 * area / (sqrt(3) * count)), the distance of
/// neighbours if the same number of points stood in hexagonal arrangement.
typedef struct azulejo_dcr_options {
    /// The size of the caller's struct in bytes; set by the init function.
    uint32_t struct_size;
    /// An AZULEJO_BOUNDARY_ constant; periodic by default.
    int32_t boundary;
    /// The lower corner of the domain, x y; 0 0 by default.
    double domain_min[2];
    /// The upper corner of the domain, above the lower one on both axes; 1 1 by default.
    double domain_max[2];
    /// An AZULEJO_NEIGHBOURHOOD_ constant; Delaunay by default.
    int32_t neighbourhood;
    /// An AZULEJO_METHOD_ constant; momentum by default.
    int32_t method;
    /// The largest number of steps, 100 by default, which is what AZULEJO_METHOD_MOMENTUM takes; AZULEJO_METHOD_THESIS may
    /// take 1000. 0 returns the points as they are. Fewer are made where the motion ends before.
    uint32_t max_iterations;
    /// Must be 0.
    uint32_t reserved;
    /// Parts points that coincide; used for nothing else.
    uint64_t seed;
    /// The motion (see the report) at which the set has converged. 0 makes all steps; a negative number, the default,
    /// takes 0.0005, or with AZULEJO_METHOD_THESIS 0.02 for Delaunay and 0.005 for nearest neighbours.
    double tolerance;
    /// Called during the call, unless NULL, which is the default.
    azulejo_progress_fn progress;
    /// Handed to the progress callback.
    void *progress_user;
    /// Neighbours closer than this repel each other; above 0, at most 1; 0.95 by default.
    double conflict_radius;
    /// Delaunay neighbours farther apart than this attract each other; at least conflict_radius; 1.05 by default.
    double attraction_radius;
    /// The displacement by a tension of 1; above 0, at most 1; 0.05 by default.
    double step;
    /// What `step` is multiplied with after every step; above 0, at most 1; 1 by default. All steps together are no longer
    /// than step / (1 - decay): about 10 are needed from a random start.
    double decay;
    /// How many neighbours AZULEJO_NEIGHBOURHOOD_NEAREST takes; at least 1; 6 by default.
    uint32_t neighbours;
    /// An AZULEJO_DISTRIBUTION_ constant (thesis figure 4.19); by activeness by default.
    int32_t distribution;
    /// An AZULEJO_VISITS_ constant; from both ends by default.
    int32_t visits;
    /// An AZULEJO_CONVERGENCE_ constant; by motion by default.
    int32_t convergence;
} azulejo_dcr_options;

/// Gives the density at a place.
///
/// It is called from several threads at once, the library's own; only where the context has one thread it is called on
/// the thread that made the call. It is called once for each place of a lattice of up to some hundred places per point,
/// all before the first step, and not before or in the first report of progress. It must return (no exception and no
/// longjmp may leave it), and must not call the library with the same context.
///
/// user: the user of the azulejo_density.
///
/// position: x y of a place in the domain.
///
/// Returns the density, 0 or above and finite.
typedef double (*azulejo_density_fn)(void *user, const double *position);

/// How dense points shall be from place to place, in any unit: twice the density gives the same set. Densities are 0 or
/// above and finite, and not 0 everywhere; where they are 0 no points are wanted. Either `values` or `function` is to be
/// set.
typedef struct azulejo_density {
    /// The size of the caller's struct in bytes; set by the init function.
    uint32_t struct_size;
    /// Must be 0.
    uint32_t reserved;
    /// An image that is stretched over the domain, linear between the centres of its pixels: height rows of width
    /// densities each, of which the first lies along the lower border (domain_min[1]). NULL, the default, where `function`
    /// is set. Used during the call only.
    const float *values;
    /// Pixels in a row; at least 1. Not used with `function`.
    size_t width;
    /// Rows; at least 1. Not used with `function`.
    size_t height;
    /// Gives the density at a place, unless NULL, which is the default.
    azulejo_density_fn function;
    /// Handed to `function`.
    void *user;
} azulejo_density;

/// Options of azulejo_dcr_surface_relax. d_max = sqrt(2 * area / (sqrt(3) * count)) is the distance of neighbours if the
/// samples stood in hexagonal arrangement on a plane of the mesh's area.
typedef struct azulejo_dcr_surface_options {
    /// The size of the caller's struct in bytes; set by the init function.
    uint32_t struct_size;
    /// The largest number of steps, 100 by default. 0 returns the samples as they are, those that rounding has put outside
    /// their triangle on its edge. Fewer are made where the motion ends before.
    uint32_t max_iterations;
    /// The motion (see the report) at which the set has converged. 0 makes all steps; a negative number, the default,
    /// takes 0.0005.
    double tolerance;
    /// Parts samples that coincide, or lie on the edges of triangles; used for nothing else.
    uint64_t seed;
    /// Called during the call, unless NULL, which is the default.
    azulejo_progress_fn progress;
    /// Handed to the progress callback.
    void *progress_user;
} azulejo_dcr_surface_options;

/// What a relaxation on a surface did.
typedef struct azulejo_dcr_surface_report {
    /// The size of the caller's struct in bytes; set by the init function.
    uint32_t struct_size;
    /// The steps made.
    uint32_t iterations;
    /// Why no more steps were made: an AZULEJO_STOPPED_ constant.
    int32_t stopped;
    /// 0.
    uint32_t reserved;
    /// Half of how far samples got over the last 10 steps, root mean square, in units of d_max.
    double motion;
    /// The smallest straight distance between two of the samples, whether or not they are near on the surface, which is no
    /// less than it was; infinite for less than two samples.
    double smallest_distance;
    /// The smallest distance in units of d_max: 0.77 for a maximal set; for a relaxed one 0.85 on the bunny, 0.84 on the dragon,
    /// and less, 0.75, where there are thin blades: parts nearer to each other than samples are.
    double rho;
} azulejo_dcr_surface_report;

/// How a set covers a domain or a surface with disks of a radius. See azulejo_plane_coverage, azulejo_mesh_coverage.
typedef struct azulejo_coverage_report {
    /// The size of the caller's struct in bytes; set by the init function.
    uint32_t struct_size;
    /// 0.
    uint32_t reserved;
    /// The covering radius: the distance from the samples of the place that is farthest from all of them. Infinite for no
    /// sample.
    double covering_radius;
    /// The number of gaps; 0 for a set that is maximal for the radius.
    uint64_t gaps;
} azulejo_coverage_report;

/// The figures of a set of the plane. The unit d_max is sqrt(2 area / (sqrt(3) count)), the distance of neighbours if as
/// many points stood in hexagonal arrangement.
typedef struct azulejo_plane_report {
    /// The size of the caller's struct in bytes; set by the init function.
    uint32_t struct_size;
    /// 0.
    uint32_t reserved;
    /// The number of points.
    uint64_t count;
    /// The smallest distance between two points, in the units of the domain; infinite for less than two, as the mean is.
    double smallest_distance;
    /// The mean distance from a point to its nearest neighbour, in the units of the domain.
    double mean_distance;
    /// d_max, in the units of the domain; infinite for no point.
    double hexagonal_distance;
    /// The smallest distance in units of d_max: at most 1 on a periodic domain, about 0.77 for maximal Poisson-disk sets.
    double rho;
    /// The covering radius, in the units of the domain: see azulejo_plane_covering_radius. d_max / sqrt(3) for a hexagonal
    /// lattice; infinite for no point.
    double covering_radius;
    /// The bond order psi6, 0 to 1: the mean over the points of |sum of exp(6 i angle)| / n for the n directions of their
    /// Delaunay neighbours (Nelson and Halperin 1979). 1 for a hexagonal lattice, 0.36 for a Poisson process.
    double bond_order;
    /// The number of Delaunay triangles; in a bounded domain those that do not cross the border when the set is mirrored
    /// by it.
    uint64_t triangles;
    /// The share of triangles with an angle above 90 degrees, 0 to 1.
    double obtuse;
    /// The share of triangles with an angle below 30 degrees, 0 to 1.
    double below_30_degrees;
    /// The mean length of the edges of the triangles, in the units of the domain.
    double edge_mean;
    /// The variance of the lengths of the edges over the square of their mean.
    double edge_variation;
    /// The variance of the areas of the triangles over the square of their mean.
    double area_variation;
    /// The share of angles, of all triangles, below 30 degrees, 0 to 1.
    double angles_below_30_degrees;
    /// The share of triangles whose area is farther than 4 standard deviations from the mean, 0 to 1.
    double beyond_4_sigma;
} azulejo_plane_report;

/// The figures of a spectrum.
typedef struct azulejo_spectrum_report {
    /// The size of the caller's struct in bytes; set by the init function.
    uint32_t struct_size;
    /// 0.
    uint32_t reserved;
    /// The distance of neighbouring columns and rows, in units of sqrt(density).
    double frequency_step[2];
    /// The effective Nyquist frequency, in units of sqrt(density): half of the largest frequency up to which the mean power
    /// is below 0.1 (Heck et al. 2013). 0.5 for a square lattice, 0.537 for a hexagonal one, 0 for a Poisson process; the
    /// tables of the literature divide it by 0.5. -1 if the spectrum ends too early: frequencies up to 1.5 mostly do.
    double effective_nyquist;
    /// The oscillation, without unit: ten times the root mean square of the power's deviation from 1, by area, from where it
    /// first is 0.98 to 5 sqrt(density) above (Heck et al. 2013). 0 for a Poisson process. -1 if the spectrum ends too
    /// early: frequencies up to 6.5 mostly do.
    double oscillation;
    /// How much the power scatters about its radial mean, over the frequencies from `low` to `high`: 1 for one set without
    /// order over long distances, 1/n for the mean of n, more where parts are repeated. 0 if there are none.
    double contrast;
    /// The largest power of a frequency from `low` to `high`, over the radial mean there. By chance alone it is about ln n
    /// for n frequencies of one set. 0 if there are none.
    double peak;
    /// Where that is, along x and y, in units of sqrt(density); its opposite is as high.
    double peak_frequency[2];
} azulejo_spectrum_report;

/// The frequencies of about one length: a point of the radial curves.
typedef struct azulejo_annulus {
    /// The mean length of its frequencies, in units of sqrt(density).
    double frequency;
    /// The mean power: the radial mean; 1 for a Poisson process.
    double power;
    /// The variance of the power over its squared mean. The spectrum of one isotropic set has 1 (0 dB), the mean of n has
    /// 1/n; directions that stand out give more.
    double anisotropy;
    /// The number of its frequencies, not counting a frequency and its opposite twice; at least 2.
    uint64_t count;
} azulejo_annulus;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

/// Copies the message of this thread's last failed call: one line of UTF-8, ended by a NUL, empty if none failed.
///
/// Calls that succeed leave the message as it is: ask right after the call that failed.
///
/// buffer: where to write at most `capacity` bytes, the NUL among them; a longer message is cut between two
/// characters. May be NULL if `capacity` is 0.
///
/// Returns the bytes that the whole message needs, the NUL among them.
size_t azulejo_last_error_message(char *buffer,
                                  size_t capacity);

/// The version of the library that the program runs with, to compare with AZULEJO_VERSION.
uint32_t azulejo_version(void);

/// Starts the threads.
///
/// num_threads: 1 to 4096, or 0 for one per core. With 1 no thread is made: all work happens in the caller's. This bounds
/// Embree's threads, too; but Embree knows one bound for a process, the largest that one of its devices has, and sets it
/// for all that uses TBB. Beside a device of the program's that has more threads, a build of this library can use as many;
/// a device with fewer can use `num_threads` while a psp handle that has made iterations lives, and has its own number
/// again after that. TBB may leave threads of its own behind, also with 1, which do no work. AZULEJO_ENGINE_RASTERISER
/// makes no device and wakes nobody.
///
/// out: the context, to be freed with azulejo_context_free.
azulejo_status azulejo_context_create(uint32_t num_threads,
                                      struct azulejo_context **out);

/// Makes a context that has the threads of another one and a progress callback: it is told of each call that is made with
/// this context, or with a psp handle made with it, and whose options have no callback of their own. So calls without
/// options, as those of the analysis, can be watched and cancelled.
///
/// context: the other one, which may be freed before. A callback that it has is not taken over.
///
/// progress, progress_user: the callback, or NULL for none, and what it is handed. See "Progress" in the conventions. When
/// several threads use the context, each calls it.
///
/// out: the context, to be freed with azulejo_context_free. No thread is made.
azulejo_status azulejo_context_watch(const struct azulejo_context *context,
                                     azulejo_progress_fn progress,
                                     void *progress_user,
                                     struct azulejo_context **out);

/// The number of threads that work on a call; 0 for NULL.
uint32_t azulejo_context_num_threads(const struct azulejo_context *context);

/// Ends the threads, once no call and no psp handle uses them any more. NULL is allowed.
void azulejo_context_free(struct azulejo_context *context);

/// Writes the defaults: no points on the unit torus. `struct_size` is sizeof *set.
azulejo_status azulejo_plane_set_init(struct azulejo_plane_set *set, size_t struct_size);

/// The number of samples; 0 for NULL.
size_t azulejo_points_count(const struct azulejo_points *points);

/// The number of coordinates of each position: 2 for samples of the plane, 3 for samples of a mesh; 0 for NULL.
uint32_t azulejo_points_dimension(const struct azulejo_points *points);

/// The positions, x y or x y z of each sample, interleaved; NULL for NULL and for an empty set.
///
/// Samples of the plane lie in domain_min <= x < domain_max. Samples of a mesh lie on their triangle, up to the rounding
/// of the floats: they are computed from the barycentrics in double arithmetic and rounded once.
const float *azulejo_points_positions(const struct azulejo_points *points);

/// The unit normals of the samples' triangles, x y z each, seen from where their vertices run counter-clockwise, whether
/// or not the mesh carries normals of its own; NULL for NULL, an empty set and samples of the plane.
const float *azulejo_points_normals(const struct azulejo_points *points);

/// The normals that the mesh carries, from azulejo_mesh_with_normals or from its file, interpolated to the samples with
/// their barycentrics, of length 1, x y z each; that of the triangle where they add up to nothing. NULL for a mesh that
/// carries none, NULL, an empty set and samples of the plane.
const float *azulejo_points_interpolated_normals(const struct azulejo_points *points);

/// The index of the triangle that each sample lies on; NULL for NULL, an empty set and samples of the plane.
const uint32_t *azulejo_points_triangles(const struct azulejo_points *points);

/// The barycentric coordinates u v of each sample in its triangle (a, b, c), as in Embree: the position is
/// (1 - u - v) * a + u * b + v * c, and so is every other attribute of the vertices.
/// NULL for NULL, an empty set and samples of the plane.
const float *azulejo_points_barycentrics(const struct azulejo_points *points);

/// The radius of each sample of azulejo_psp_adaptive_sample; NULL for NULL, an empty set and all other sets, whose radius
/// is the one that was asked for.
const double *azulejo_points_radii(const struct azulejo_points *points);

/// Frees the set with all its arrays. NULL is allowed.
void azulejo_points_free(struct azulejo_points *points);

/// Writes the defaults. `struct_size` is sizeof *report.
azulejo_status azulejo_kdrt_report_init(struct azulejo_kdrt_report *report, size_t struct_size);

/// Writes the defaults. `struct_size` is sizeof *options.
azulejo_status azulejo_kdrt_options_init(struct azulejo_kdrt_options *options, size_t struct_size);

/// DOC kdrt_sample
azulejo_status azulejo_kdrt_sample(const struct azulejo_context *context,
                                   const struct azulejo_kdrt_options *options,
                                   struct azulejo_points **out,
                                   struct azulejo_kdrt_report *report);

/// Makes the part of azulejo_kdrt_sample's set that lies in a window of the domain, without making the rest: the same
/// floats in the same order.
///
/// So windows that cut the domain in any way have every sample once, and can be made in any order, by threads,
/// processes and machines that know nothing of each other. What lies in a window depends on nothing farther from it
/// than 22 radii along x and 18 along y.
///
/// window_min, window_max: two numbers each, domain_min <= window_min < window_max <= domain_max; the window has the
/// samples with window_min <= x < window_max. It may be smaller than the radius, and may turn out to have no sample.
///
/// out: the samples, x y each, to be freed with azulejo_points_free.
///
/// O(samples of the window and around it) time and memory, after the making of the pattern (about 28000 samples with the
/// default leaves), which every call repeats. A domain that is not tiled is made as a whole.
///
/// Errors: as azulejo_kdrt_sample, but AZULEJO_ERROR_TOO_LARGE for the samples of the window: the domain may have as
/// many as floats can carry, up to about 10^11.
azulejo_status azulejo_kdrt_sample_window(const struct azulejo_context *context,
                                          const struct azulejo_kdrt_options *options,
                                          const double *window_min,
                                          const double *window_max,
                                          struct azulejo_points **out);

/// Makes the set of azulejo_kdrt_sample and hands it out part by part, in its order, instead of keeping it: for sets that
/// are written or used up, of any size.
///
/// visit: gets the parts, windows of at most about 270 radii (50000 samples), the same ones for every number of threads.
/// While it works on the calling thread, the threads of the context make the next parts.
///
/// user: handed to it.
///
/// O(samples) time; memory for the pattern and at most 8 parts per thread. A domain that is not tiled is made as a whole
/// and is one part.
///
/// Errors: as azulejo_kdrt_sample, but a domain that is tiled may have as many samples as floats can carry, up to about
/// 10^11; AZULEJO_ERROR_CANCELLED also when `visit` cancels.
azulejo_status azulejo_kdrt_stream(const struct azulejo_context *context,
                                   const struct azulejo_kdrt_options *options,
                                   azulejo_kdrt_visit_fn visit,
                                   void *user);

/// Writes the defaults. `struct_size` is sizeof *options.
azulejo_status azulejo_maximal_options_init(struct azulejo_maximal_options *options,
                                            size_t struct_size);

/// Makes a maximal, conflict-free set of samples of a rectangle by throwing darts into what is still uncovered, one
/// after the other: without any bias, much slower than azulejo_kdrt_sample and on one thread. It is the reference that
/// other sets are compared with, about 0.6966 * area / radius^2 samples, in O(samples) time.
///
/// out: the samples, x y each, to be freed with azulejo_points_free.
///
/// Errors: as azulejo_kdrt_sample.
///
/// Source: M. S. Ebeida et al., A Simple Algorithm for Maximal Poisson-Disk Sampling in High Dimensions, 2012.
azulejo_status azulejo_maximal_sample(const struct azulejo_context *context,
                                      const struct azulejo_maximal_options *options,
                                      struct azulejo_points **out);

/// Writes the defaults. `struct_size` is sizeof *options.
azulejo_status azulejo_kdrt_merge_options_init(struct azulejo_kdrt_merge_options *options,
                                               size_t struct_size);

/// Writes zeros. `struct_size` is sizeof *report.
azulejo_status azulejo_kdrt_merge_report_init(struct azulejo_kdrt_merge_report *report,
                                              size_t struct_size);

/// Glues sets of samples on rectangles that do not overlap, and points that must stay, into one maximal, conflict-free
/// set of the domain (thesis section 2.4.4). Only the seams change.
///
/// Conflict-free and maximal as in the conventions, but maximal up to 6 times the spacing of floats; whatever no sample
/// covers is filled, also where a piece is not maximal, where there is no piece, and the whole domain if there is
/// nothing. A sample of a piece goes only if it is closer than the radius to a fixed point, or to a sample that stays of
/// another piece or, over the seam of a periodic domain, of its own; which one goes depends on the seed and the places of
/// the pieces in the array. If the pieces are maximal as azulejo_kdrt_sample makes them, new samples lie within the radius
/// of a sample that went or of the border of a piece's rectangle.
///
/// pieces: `piece_count` of them, in the domain; NULL if there are none.
///
/// fixed: the points that must stay, x y each, in domain_min <= x < domain_max, no two of them closer than the radius;
/// `fixed_count` of them; NULL if there are none.
///
/// out: the samples, x y each, to be freed with azulejo_points_free: first all fixed points, then the samples of the
/// pieces that are kept, piece by piece, both in the order and with the bits that they were given; then new ones.
///
/// report: what became of the pieces, or NULL.
///
/// O(samples) time with all threads of the context, and O(piece_count^2) at most. A periodic domain narrower than about
/// 10 radii is filled on one thread.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT, also for rectangles that overlap or leave the domain, samples outside of
/// their rectangle, two samples of one piece or two fixed points that are closer than the radius (the message has their
/// indices), and where floats are too coarse to carry the radius; AZULEJO_ERROR_TOO_LARGE; AZULEJO_ERROR_CANCELLED.
azulejo_status azulejo_kdrt_merge(const struct azulejo_context *context,
                                  const struct azulejo_kdrt_merge_options *options,
                                  const struct azulejo_kdrt_merge_piece *pieces,
                                  size_t piece_count,
                                  const float *fixed,
                                  size_t fixed_count,
                                  struct azulejo_points **out,
                                  struct azulejo_kdrt_merge_report *report);

/// Copies the triangles of a scene that the caller has made with Embree. Nothing of the scene and of its device is
/// changed: flags, error function, thread count (as far as that is the device's alone: see azulejo_context_create). The
/// mesh does not need them any more once it is made; what is sampled on it is traced in a scene and on a device of its own.
///
/// Triangles are numbered in the order of `geometries`: triangle i of the mesh is primitive i of the first one, those of
/// the second follow, and so on. The same for vertices.
///
/// scene: a committed RTCScene that no thread changes during the call. It must come from the same libembree that
/// libazulejo has loaded: what happens otherwise is undefined, though another version is refused in most cases. Instances
/// in it are not followed.
///
/// geometries: `geometry_count` of them, at least one, each attached to the scene as RTC_GEOMETRY_TYPE_TRIANGLE. Where an
/// id, a size or a type is not that of the scene, what happens is undefined.
///
/// out: the mesh, to be freed with azulejo_mesh_free.
///
/// Errors: those of azulejo_mesh_create; AZULEJO_ERROR_EMBREE for a scene of another version of Embree.
azulejo_status azulejo_mesh_create_from_embree(void *scene,
                                               const struct azulejo_embree_geometry *geometries,
                                               size_t geometry_count,
                                               struct azulejo_mesh **out);

/// Copies a mesh of the caller's.
///
/// positions: the vertices; the x y z of each begin `stride_bytes` after those of the one before.
///
/// stride_bytes: at least 12, a multiple of 4. What lies between the positions is not read.
///
/// indices: three for each triangle, below `vertex_count`; triangles keep their order. Triangles without area are
/// allowed and get no samples.
///
/// out: the mesh, to be freed with azulejo_mesh_free.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT for positions that are not finite, indices out of range, no triangle at all
/// and triangles without any area; AZULEJO_ERROR_TOO_LARGE for 2^32 - 1 vertices or triangles or more, and for sizes
/// that overflow; AZULEJO_ERROR_OUT_OF_MEMORY.
azulejo_status azulejo_mesh_create(const float *positions,
                                   size_t vertex_count,
                                   size_t stride_bytes,
                                   const uint32_t *indices,
                                   size_t triangle_count,
                                   struct azulejo_mesh **out);

/// Loads a mesh from a file: Wavefront OBJ, PLY or STL (text and binary), told apart by the extension .obj, .ply or .stl,
/// otherwise by what the file begins with. Polygons become fans of triangles, in the order of the faces. Vertices keep
/// the order of the file; those of STL facets are three for each, not merged.
///
/// Normals of OBJ corners (vn) and of PLY vertices (nx ny nz) are read; a corner without, or with one that is not finite,
/// in a file that has some, counts as one with a zero normal: see azulejo_mesh_with_normals. Points, lines, materials,
/// texture coordinates, colours and normals of STL facets are left aside.
///
/// path: the name of the file as the operating system wants it.
///
/// out: the mesh, to be freed with azulejo_mesh_free.
///
/// Errors: AZULEJO_ERROR_IO if the file cannot be read, AZULEJO_ERROR_FORMAT if it is broken, or what it holds would be
/// refused by azulejo_mesh_create.
azulejo_status azulejo_mesh_load(const char *path,
                                 struct azulejo_mesh **out);

/// A mesh with normals of the caller's, in place of those that it may carry, such as the smooth ones of a shaded surface.
/// The samples are the same; azulejo_points_interpolated_normals gives the normals at them.
///
/// mesh: the mesh, which stays as it is.
///
/// normals: of any length; the x y z of each begin `stride_bytes` after those of the one before. Where the three of a
/// triangle add up to nothing at a sample, as zeros do, the sample gets the normal of the triangle.
///
/// normal_count: the number of vertices, where there are no indices.
///
/// stride_bytes: at least 12, a multiple of 4.
///
/// normal_indices: three for each triangle, below `normal_count`, where corners that share a vertex differ in their
/// normals; NULL for one normal for each vertex.
///
/// triangle_count: the number of triangles of the mesh; 0 for NULL.
///
/// out: the new mesh, to be freed with azulejo_mesh_free. It shares vertices, triangles and mask with `mesh`; the two
/// are freed in any order.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT for normals that are not finite or not as many as there are vertices, and for
/// indices out of range; AZULEJO_ERROR_TOO_LARGE for 2^32 - 1 normals or more, and for sizes that overflow;
/// AZULEJO_ERROR_OUT_OF_MEMORY.
azulejo_status azulejo_mesh_with_normals(const struct azulejo_mesh *mesh,
                                         const float *normals,
                                         size_t normal_count,
                                         size_t stride_bytes,
                                         const uint32_t *normal_indices,
                                         size_t triangle_count,
                                         struct azulejo_mesh **out);

/// A mesh with a mask, in place of the one that it may have: triangles whose entry is 0 are left out. They keep their
/// number. The rest is sampled as if they were not there, to the bit: they get no samples, add nothing to the area, and
/// need not be covered; nor do they hide or divide anything, so samples on both sides of them keep their distance through
/// space. A mask may leave out everything: then a maximal set is empty.
///
/// mesh: the mesh, which stays as it is.
///
/// mask: one byte for each triangle: 0 leaves it out, any other value samples it.
///
/// triangle_count: the number of triangles of the mesh.
///
/// out: the new mesh, to be freed with azulejo_mesh_free. It shares vertices, triangles and normals with `mesh`; the two
/// are freed in any order.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT for a mask that is not as long as there are triangles;
/// AZULEJO_ERROR_OUT_OF_MEMORY.
azulejo_status azulejo_mesh_with_mask(const struct azulejo_mesh *mesh,
                                      const uint8_t *mask,
                                      size_t triangle_count,
                                      struct azulejo_mesh **out);

/// Whether the mesh carries normals besides those of its triangles: 1 or 0; 0 for NULL.
int32_t azulejo_mesh_has_normals(const struct azulejo_mesh *mesh);

/// The number of vertices; 0 for NULL.
size_t azulejo_mesh_vertex_count(const struct azulejo_mesh *mesh);

/// The number of triangles, those that a mask leaves out among them; 0 for NULL.
size_t azulejo_mesh_triangle_count(const struct azulejo_mesh *mesh);

/// The vertices, x y z each, packed; they live until azulejo_mesh_free. NULL for NULL.
const float *azulejo_mesh_positions(const struct azulejo_mesh *mesh);

/// The three vertices of each triangle, counter-clockwise seen from the front; they live until azulejo_mesh_free. NULL for NULL.
const uint32_t *azulejo_mesh_indices(const struct azulejo_mesh *mesh);

/// The area of all triangles together that no mask leaves out, in squared units of the positions; 0 for NULL. A maximal
/// set of N samples has a radius of about sqrt(0.69656 * area / N), as long as that is small against the features of the
/// surface.
double azulejo_mesh_area(const struct azulejo_mesh *mesh);

/// Frees the mesh, once no psp handle uses it any more. NULL is allowed.
void azulejo_mesh_free(struct azulejo_mesh *mesh);

/// Writes the defaults. `struct_size` is sizeof *options.
azulejo_status azulejo_psp_options_init(struct azulejo_psp_options *options, size_t struct_size);

/// Writes zeros. `struct_size` is sizeof *report.
azulejo_status azulejo_psp_report_init(struct azulejo_psp_report *report, size_t struct_size);

/// Makes an empty set on a mesh.
///
/// options: `iterations` and `maximal` play no part here, but are checked.
///
/// out: the handle, to be freed with azulejo_psp_free.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT, also where floats are too coarse to carry the radius (their spacing at the
/// largest coordinate is above radius / 64); AZULEJO_ERROR_TOO_LARGE with the estimated count.
azulejo_status azulejo_psp_create(const struct azulejo_context *context,
                                  const struct azulejo_mesh *mesh,
                                  const struct azulejo_psp_options *options,
                                  struct azulejo_psp **out);

/// Adds samples: projects patterns of samples onto the mesh, each iteration in three orthogonal directions of a random
/// frame, and keeps what is in no conflict with the set (thesis chapter 3). Samples are only ever added, in time that
/// grows with the hits and with the squared diagonal of the mesh over the squared radius. The first call prepares the
/// mesh for the engine. Two calls add what one call with the sum of their iterations adds.
///
/// Where the box of the mesh is out of all proportion to its surface, as for small parts far apart (more than 20 rays
/// for each sample that there is room for, and 10 million rays at all), the call does nothing and reports no iteration:
/// azulejo_psp_fill is much faster there.
///
/// The same calls give the same bytes on one machine; with another version of Embree or another instruction set the last
/// bits of a hit may differ, and with them which of two candidates is taken.
///
/// iterations: how often; 0 does nothing.
///
/// report: what this call did, or NULL.
///
/// Errors: AZULEJO_ERROR_EMBREE; AZULEJO_ERROR_CANCELLED: the set then holds what was finished, and can grow on.
azulejo_status azulejo_psp_advance(struct azulejo_psp *psp,
                                   uint32_t iterations,
                                   struct azulejo_psp_report *report);

/// Makes the set maximal: finds the parts of the surface that are farther than the radius from every sample and throws
/// darts into them until none is left.
///
/// report: what this call did, or NULL.
///
/// Errors: AZULEJO_ERROR_CANCELLED: the set then holds what was finished, and can grow on.
azulejo_status azulejo_psp_fill(struct azulejo_psp *psp,
                                struct azulejo_psp_report *report);

/// Copies the set as it is now.
///
/// out: the samples with normals, triangles and barycentrics, to be freed with azulejo_points_free.
azulejo_status azulejo_psp_points(const struct azulejo_psp *psp, struct azulejo_points **out);

/// Frees the set, but not the points taken from it. Not to be called from its own progress callback. NULL is allowed.
void azulejo_psp_free(struct azulejo_psp *psp);

/// Samples a mesh in one call: azulejo_psp_create, azulejo_psp_advance by `iterations` and, if `maximal` is 1,
/// azulejo_psp_fill, with one progress for all.
///
/// out: the samples with normals, triangles and barycentrics, to be freed with azulejo_points_free.
///
/// report: what the call did, or NULL.
///
/// Errors: those of the three.
azulejo_status azulejo_psp_sample(const struct azulejo_context *context,
                                  const struct azulejo_mesh *mesh,
                                  const struct azulejo_psp_options *options,
                                  struct azulejo_points **out,
                                  struct azulejo_psp_report *report);

/// Writes the defaults. `struct_size` is sizeof *options.
azulejo_status azulejo_psp_adaptive_options_init(struct azulejo_psp_adaptive_options *options,
                                                 size_t struct_size);

/// Makes a maximal set of samples on a mesh, each with a radius of its own (thesis section 3.4.4).
///
/// Conflict-free: two samples are no closer than the mean of their radii, in double arithmetic on the returned positions
/// and radii. Maximal: no place of the surface is farther from every sample than the mean of the two radii, up to 6
/// times the spacing of floats at the largest coordinate and what the radius changes on that way; with vertex_radii also
/// 2^-22 of the largest difference of two radii on a triangle. Where the radius changes little from sample to sample
/// there are 0.6966 / radius^2 samples on an area of 1. Radii above four times the diagonal of the mesh's box are taken
/// as that, those of vertices before they are interpolated.
///
/// The same options give the same bytes. Embree is not used. Time grows with samples and triangles.
///
/// out: the samples with normals, triangles, barycentrics and radii, to be freed with azulejo_points_free.
///
/// report: what the call did, or NULL; iterations, rays and hits are 0.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT, also for radii that are not positive and finite or below 64 times the spacing
/// of floats at the largest coordinate, and where `radius` gives what is not in `smallest` to `largest` or changes
/// faster than `slope`; AZULEJO_ERROR_TOO_LARGE with the estimated count, or for radii that change so fast that it takes
/// thousands of looks per sample to find out what is covered; AZULEJO_ERROR_CANCELLED.
azulejo_status azulejo_psp_adaptive_sample(const struct azulejo_context *context,
                                           const struct azulejo_mesh *mesh,
                                           const struct azulejo_psp_adaptive_options *options,
                                           struct azulejo_points **out,
                                           struct azulejo_psp_report *report);

/// Writes zeros. `struct_size` is sizeof *report.
azulejo_status azulejo_dcr_report_init(struct azulejo_dcr_report *report, size_t struct_size);

/// Writes the defaults. `struct_size` is sizeof *options.
azulejo_status azulejo_dcr_options_init(struct azulejo_dcr_options *options, size_t struct_size);

/// Relaxes a set of points: neighbours that are too close repel, holes close, until the motion ends or the steps do (thesis
/// chapter 4). O(count) time for each step, O(count log count) with AZULEJO_METHOD_THESIS.
///
/// AZULEJO_METHOD_MOMENTUM with Delaunay neighbours returns, of the states after whole steps and the points as they came, the one in
/// which the fewest points have a neighbour closer than 0.85 d_max or a Delaunay triangle with a circumradius above 0.67
/// d_max. All else returns the points after the last whole step. A call that its progress callback cancels succeeds and
/// does the same, with AZULEJO_STOPPED_CANCELLED in the report.
///
/// xy: the points, x y each, in domain_min <= x < domain_max; `count` of them.
///
/// out: the points, in the same order, to be freed with azulejo_points_free.
///
/// report: what the call did, or NULL.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT, AZULEJO_ERROR_TOO_LARGE.
azulejo_status azulejo_dcr_relax(const struct azulejo_context *context,
                                 const struct azulejo_dcr_options *options,
                                 const float *xy,
                                 size_t count,
                                 struct azulejo_points **out,
                                 struct azulejo_dcr_report *report);

/// Writes the defaults. `struct_size` is sizeof *density.
azulejo_status azulejo_density_init(struct azulejo_density *density, size_t struct_size);

/// Makes random points of the domain of the options, as dense as asked for: a start for azulejo_dcr_relax_density. Of the
/// options domain, boundary and seed play a part.
///
/// The same arguments give the same bytes. O(count log count) time and O(count) memory.
///
/// count: how many points there shall be.
///
/// out: the points, to be freed with azulejo_points_free.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT, AZULEJO_ERROR_TOO_LARGE.
azulejo_status azulejo_dcr_scatter(const struct azulejo_context *context,
                                   const struct azulejo_dcr_options *options,
                                   const struct azulejo_density *density,
                                   size_t count,
                                   struct azulejo_points **out);

/// Relaxes a set of points to a density: as azulejo_dcr_relax, but the points become as dense from place to place as the
/// density asks for, and evenly spread (thesis section 4.2.3). Points that are about as dense before, as
/// azulejo_dcr_scatter and azulejo_psp_sample_adaptive make them, need no more than the usual 100 steps; others may take
/// 800.
///
/// The unit of length is the local spacing: d_max for the mean density, as 1 / sqrt(density) elsewhere, but it grows by no
/// more than half of the distance from place to place, so that it is finite where the density is 0. The report's rho is the
/// least of all distances over the mean of the spacings of the two points; its coverage the largest circumradius of a
/// Delaunay triangle over what the density at its centre asks for; its motion is in units of d_max. Details of the
/// density that are finer than an eighth of d_max are lost.
///
/// options: AZULEJO_METHOD_MOMENTUM and AZULEJO_NEIGHBOURHOOD_DELAUNAY, the defaults; no others are accepted.
///
/// density: how dense the points shall be; used during the call only.
///
/// xy: the points, x y each, in domain_min <= x < domain_max; `count` of them.
///
/// out: the points after the last step, in the same order, to be freed with azulejo_points_free.
///
/// report: what the call did, or NULL.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT, also for densities that are negative or not finite, or 0 everywhere;
/// AZULEJO_ERROR_TOO_LARGE. A call that its progress callback cancels succeeds, as azulejo_dcr_relax does.
azulejo_status azulejo_dcr_relax_density(const struct azulejo_context *context,
                                         const struct azulejo_dcr_options *options,
                                         const struct azulejo_density *density,
                                         const float *xy,
                                         size_t count,
                                         struct azulejo_points **out,
                                         struct azulejo_dcr_report *report);

/// Writes the defaults. `struct_size` is sizeof *options.
azulejo_status azulejo_dcr_surface_options_init(struct azulejo_dcr_surface_options *options,
                                                size_t struct_size);

/// Writes zeros. `struct_size` is sizeof *report.
azulejo_status azulejo_dcr_surface_report_init(struct azulejo_dcr_surface_report *report,
                                               size_t struct_size);

/// Relaxes samples of a mesh: they walk on the surface, away from neighbours that are too close and into holes, until the
/// motion ends or the steps do (the future work of thesis chapter 4). Neighbours are near on the surface, not on the other
/// side of a thin wall. Triangles are connected by edges between the same places; any other edge is a border, which samples
/// do not cross. O(count) time for each step, and O(triangles * log triangles) once.
///
/// No two samples get nearer to each other than the nearest two were, on whatever sides of walls and borders: straight
/// distances, in double arithmetic on the positions, without tolerance, after any number of steps. Barycentrics outside
/// their triangle count as brought into it.
///
/// A call that its progress callback cancels succeeds: it returns the samples after the last whole step, and
/// AZULEJO_STOPPED_CANCELLED in the report.
///
/// triangles, barycentrics: a triangle and the barycentrics u v of each of `count` samples, as azulejo_points_triangles and
/// azulejo_points_barycentrics give them.
///
/// out: the samples after the last step, in the same order, with normals, triangles and barycentrics, to be freed with
/// azulejo_points_free.
///
/// report: what the call did, or NULL.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT, also for triangles that the mesh does not have, without area, or left out by
/// its mask, and for barycentrics outside the triangle by more than 1e-6; AZULEJO_ERROR_TOO_LARGE.
azulejo_status azulejo_dcr_surface_relax(const struct azulejo_context *context,
                                         const struct azulejo_mesh *mesh,
                                         const struct azulejo_dcr_surface_options *options,
                                         const uint32_t *triangles,
                                         const float *barycentrics,
                                         size_t count,
                                         struct azulejo_points **out,
                                         struct azulejo_dcr_surface_report *report);

/// The smallest distance between two points of the plane, in double arithmetic; on a periodic domain around the torus.
///
/// set: the points.
///
/// out: the distance; infinite for less than two points.
///
/// O(count) time for points that are spread evenly.
azulejo_status azulejo_plane_smallest_distance(const struct azulejo_context *context,
                                               const struct azulejo_plane_set *set,
                                               double *out);

/// The covering radius of points of the plane: how far the place of the domain that is farthest from all of them is. A
/// set is maximal for a radius that is not smaller. On a periodic domain points cover around the torus.
///
/// set: the points.
///
/// out: the covering radius, by less than a billionth of it too small; infinite for no point.
///
/// Found exactly, by subdividing the domain: O(count log count) time.
azulejo_status azulejo_plane_covering_radius(const struct azulejo_context *context,
                                             const struct azulejo_plane_set *set,
                                             double *out);

/// The smallest straight distance between two points in space, in double arithmetic.
///
/// positions: the points, x y z each; `count` of them.
///
/// out: the distance; infinite for less than two points.
///
/// O(count) time for points that are spread evenly.
azulejo_status azulejo_space_smallest_distance(const struct azulejo_context *context,
                                               const float *positions,
                                               size_t count,
                                               double *out);

/// The part of a surface that is farther than a radius from every one of some points, seen by random probes.
///
/// positions: the points, x y z each; `count` of them.
///
/// radius: above 0, in the units of the mesh.
///
/// probes, seed: how many random places of the surface are looked at, spread evenly over its area, and which.
///
/// out: the share of probes that are not covered, 0 to 1; 0 if the mask of the mesh leaves nothing to be looked at.
///
/// O(probes + count) time. Probes do not prove coverage, as azulejo_mesh_coverage does: they find a gap of a millionth of the
/// area with two million of them most of the time, and miss smaller ones.
azulejo_status azulejo_mesh_uncovered_fraction(const struct azulejo_context *context,
                                               const struct azulejo_mesh *mesh,
                                               const float *positions,
                                               size_t count,
                                               double radius,
                                               uint64_t probes,
                                               uint64_t seed,
                                               double *out);

/// Writes zeros. `struct_size` is sizeof *report.
azulejo_status azulejo_coverage_report_init(struct azulejo_coverage_report *report,
                                            size_t struct_size);

/// The gaps that points of the plane leave: the connected parts of the domain, or of the torus, that are farther than a
/// radius from all of them. With no gap the set is maximal for the radius.
///
/// set: the points.
///
/// radius: above 0, in the units of the domain.
///
/// out: the covering radius, as azulejo_plane_covering_radius finds it, and the number of gaps. Every gap deeper than a
/// millionth of the mean spacing is found, however small, and the deepest in any case. An empty set has one.
///
/// Found exactly, by the Voronoi diagram: O(count log count) time.
azulejo_status azulejo_plane_coverage(const struct azulejo_context *context,
                                      const struct azulejo_plane_set *set,
                                      double radius,
                                      struct azulejo_coverage_report *out);

/// The gaps that samples leave on a mesh, by straight distance: groups of places that are farther than a radius from all of
/// them, in which each place is within half of the radius of another one. With no gap the set is maximal for the radius.
///
/// positions: the samples, x y z each; `count` of them. They need not lie on the mesh.
///
/// radius: above 0, in the units of the mesh.
///
/// out: the covering radius, by less than a billionth of it too small, and the number of gaps. Every gap deeper than a
/// millionth of the radius is found, however small, and the deepest in any case. An empty set has infinity and 1 at least;
/// a mesh without area, or whose mask leaves none, has 0 and 0.
///
/// Found exactly, by subdividing the triangles: O((count + triangles) log count) time for samples that are spread evenly,
/// and about 100 pieces for each square of the radius that is uncovered.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT, AZULEJO_ERROR_CANCELLED, and AZULEJO_ERROR_TOO_LARGE where more than about 600,000
/// times the square of the radius is uncovered.
azulejo_status azulejo_mesh_coverage(const struct azulejo_context *context,
                                     const struct azulejo_mesh *mesh,
                                     const float *positions,
                                     size_t count,
                                     double radius,
                                     struct azulejo_coverage_report *out);

/// Writes zeros. `struct_size` is sizeof *report.
azulejo_status azulejo_plane_report_init(struct azulejo_plane_report *report, size_t struct_size);

/// Measures points of the plane: spacing, covering radius, bond order and Delaunay triangles.
///
/// set: the points.
///
/// out: the figures.
///
/// O(count log count) time for points that leave no large holes and are not clustered: some seconds for a million.
azulejo_status azulejo_plane_measure(const struct azulejo_context *context,
                                     const struct azulejo_plane_set *set,
                                     struct azulejo_plane_report *out);

/// The histogram of the distances from points of the plane to their nearest neighbours.
///
/// set: the points.
///
/// reach: where the last bin ends, above 0, in units of d_max (see azulejo_plane_report).
///
/// bins: how many bins of equal width there are from 0 to `reach`, 1 to 65536.
///
/// out: an array of `bins` numbers, how many points have their nearest neighbour at such a distance. Those at `reach` or
/// farther, and a point that is alone, are in none. Histograms of several sets add up.
///
/// O(count) time for points that are spread evenly.
azulejo_status azulejo_plane_nearest_histogram(const struct azulejo_context *context,
                                               const struct azulejo_plane_set *set,
                                               double reach,
                                               size_t bins,
                                               uint64_t *out);

/// The radial distribution function g of points of the plane, also called pair correlation: the density of other points at
/// a distance from a point, over the mean density. 1 for a Poisson process; a hexagonal lattice has peaks at 1, sqrt(3),
/// 2, ... d_max.
///
/// In a bounded domain each pair counts by one over the share of the domain that stays in it when it is moved by their
/// difference, which makes up for the border (Ohser and Stoyan 1981).
///
/// xy: the points, x y each, in the domain; `count` of them, at least 2.
///
/// domain_min, domain_max, boundary: two numbers, two numbers and a constant, as in the options.
///
/// reach: where the last bin ends, in units of d_max (see azulejo_plane_report): above 0, and at most half the width or
/// height of the domain.
///
/// bins: how many bins of equal width there are from 0 to `reach`, 1 to 65536.
///
/// out: an array of `bins` numbers, the mean of g in each bin. The mean over sets of one kind and count is their g.
///
/// O(count * (1 + reach^2)) time for points that are spread evenly.
azulejo_status azulejo_plane_radial_distribution(const struct azulejo_context *context,
                                                 const struct azulejo_plane_set *set,
                                                 double reach,
                                                 size_t bins,
                                                 double *out);

/// Writes zeros. `struct_size` is sizeof *report.
azulejo_status azulejo_spectrum_report_init(struct azulejo_spectrum_report *report,
                                            size_t struct_size);

/// Makes the spectrum of points of the plane, by nonuniform fast Fourier transform in double arithmetic: the power differs
/// from that of the sum itself by no more than its rounding to float.
///
/// A periodic domain has exact frequencies, whole numbers of waves per period. A bounded one is taken for a window onto a
/// larger set: its points are weighted by a taper that falls to 0 towards the ellipse inside it, so that the spectrum does
/// not show the border.
///
/// xy: the points, x y each, finite; `count` of them. In a bounded domain at least one must lie inside the ellipse.
///
/// domain_min, domain_max, boundary: two numbers, two numbers and a constant, as in the options.
///
/// size: the frequencies per side, 2 to 4096. The lowest are -(size / 2) steps of 1 / width and 1 / height.
///
/// stride: 1 takes all frequencies; n, up to 4096, only every n-th along both axes, so that the spectra of large sets reach
/// as far as those of small ones. For all figures, size * stride of about 13 sqrt(count) is enough on a square.
///
/// out: the spectrum, to be freed with azulejo_spectrum_free.
///
/// O(count + size^2 log size) time, and about 40 bytes of memory for each point and each frequency while it runs.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT, AZULEJO_ERROR_CANCELLED.
azulejo_status azulejo_spectrum_create(const struct azulejo_context *context,
                                       const struct azulejo_plane_set *set,
                                       uint32_t size,
                                       uint32_t stride,
                                       struct azulejo_spectrum **out);

/// Makes the mean of the spectra of sets of one kind. The speckle of a single one fades with the square root of their
/// number.
///
/// spectra: `count` spectra, at least 1, all of one size.
///
/// out: the mean, to be freed with azulejo_spectrum_free; the spectra stay the caller's.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT.
azulejo_status azulejo_spectrum_mean(const struct azulejo_spectrum *const *spectra,
                                     size_t count,
                                     struct azulejo_spectrum **out);

/// The frequencies per side; 0 for NULL.
uint32_t azulejo_spectrum_size(const struct azulejo_spectrum *spectrum);

/// The power, size * size numbers, row by row from the lowest frequency; frequency 0, where it is 0, stands in row and column
/// size / 2. NULL for NULL.
const float *azulejo_spectrum_power(const struct azulejo_spectrum *spectrum);

/// The radial curves of a spectrum, mean and anisotropy, out to its largest circle.
///
/// width: the width of an annulus, above 0, in units of sqrt(density). Annuli of fewer than two frequencies are left out.
///
/// annuli: where to write at most `capacity` of them, from the lowest frequency; may be NULL if `capacity` is 0.
///
/// out_count: how many there are, whatever the capacity.
///
/// O(size^2) time.
azulejo_status azulejo_spectrum_radial(const struct azulejo_spectrum *spectrum,
                                       double width,
                                       struct azulejo_annulus *annuli,
                                       size_t capacity,
                                       size_t *out_count);

/// Measures a spectrum: aliasing, contrast and the highest peak.
///
/// width: the width of the annuli of which the radial mean is made, above 0, in units of sqrt(density). 0.05 is good for
/// sets of some thousand points.
///
/// low, high: the range of frequencies for contrast and peak, in units of sqrt(density).
///
/// out: the figures.
///
/// O(size^2) time.
azulejo_status azulejo_spectrum_measure(const struct azulejo_spectrum *spectrum,
                                        double width,
                                        double low,
                                        double high,
                                        struct azulejo_spectrum_report *out);

/// Frees the spectrum. NULL is allowed.
void azulejo_spectrum_free(struct azulejo_spectrum *spectrum);

/// Measures the differences of samples on a mesh. They are divided by those with random points of the mesh, so that
/// borders, curvature and other sheets near by cancel (Davis and Peebles 1983).
///
/// mesh: has to have some area that its mask does not leave out.
///
/// positions: the samples, x y z each; `count` of them, at least 2.
///
/// normals: the normal of the triangle of each sample, x y z each, as azulejo_points_normals gives them; `count` of them.
///
/// direction: three numbers, not all 0: along its projection onto the tangent plane points the x axis of the offsets.
///
/// seed: selects the random points, two for each sample.
///
/// out: the differences, to be freed with azulejo_differences_free.
///
/// O(count) time for samples that are spread evenly, about 600 pairs for each.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT, AZULEJO_ERROR_CANCELLED.
azulejo_status azulejo_differences_create(const struct azulejo_context *context,
                                          const struct azulejo_mesh *mesh,
                                          const float *positions,
                                          const float *normals,
                                          size_t count,
                                          const double *direction,
                                          uint64_t seed,
                                          struct azulejo_differences **out);

/// Takes the differences of sets of one kind together. Noise fades with the square root of their number.
///
/// differences: `count` of them, at least 1.
///
/// out: all of them, to be freed with azulejo_differences_free; those given stay the caller's.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT.
azulejo_status azulejo_differences_mean(const struct azulejo_differences *const *differences,
                                        size_t count,
                                        struct azulejo_differences **out);

/// p(d), AZULEJO_DIFFERENCES_SIZE squared numbers, row by row from the lowest offset; 0 where not even random points have a
/// pair. The offset 0 is in the middle, where four cells meet. NULL for NULL.
const double *azulejo_differences_density(const struct azulejo_differences *differences);

/// The radial mean of p(d), the radial distribution function: AZULEJO_DIFFERENCES_SHELLS numbers. NULL for NULL.
const double *azulejo_differences_radial(const struct azulejo_differences *differences);

/// The radial mean of the power spectrum, by Hankel transform of the radial mean of p(d) - 1; 1 for a Poisson process. Seen
/// through a blur of one over AZULEJO_DIFFERENCES_REACH.
///
/// frequencies: `count` frequencies of at most 32, in units of one over the mean spacing; may be NULL if there is none.
///
/// out: the power at each, `count` numbers; may be NULL if there is none.
///
/// O(count) time.
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
