/* DCR: relaxation of point sets in the plane, with a density, and on meshes.
 * Generated from ffi/azulejo-c by cbindgen; do not edit. The conventions are in azulejo.h. */

#ifndef AZULEJO_DCR_H
#define AZULEJO_DCR_H

#include "base.h"
#include "psp.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Neighbours by the Delaunay triangulation: they keep their distance and close holes.
#define AZULEJO_NEIGHBOURHOOD_DELAUNAY 0

#define AZULEJO_NEIGHBOURHOOD_NEAREST 1 ///< The nearest points: they only repel.

/// The momentum method, the default: neighbours in conflict push each other away, holes pull the
/// points around them, points have momentum, and long waves of the density are removed.
#define AZULEJO_METHOD_MOMENTUM 0

#define AZULEJO_METHOD_THESIS 1 ///< The algorithm of thesis chapter 4.

/// Tension is divided between the ends of an edge by their activeness.
#define AZULEJO_DISTRIBUTION_ACTIVENESS 0

#define AZULEJO_DISTRIBUTION_AVERAGE 1 ///< Half of the tension goes to each end.

#define AZULEJO_DISTRIBUTION_DOMINANT 2 ///< All of the tension goes to the neighbour.

#define AZULEJO_DISTRIBUTION_ZERO 3 ///< All of the tension goes to the point itself.

/// 80 per cent of the tension goes to the point, 20 to the neighbour.
#define AZULEJO_DISTRIBUTION_EIGHTY_TWENTY 4

/// An edge is visited from each end that has the other one as a neighbour.
#define AZULEJO_VISITS_BOTH_ENDS 0

/// An edge is visited from one end, the same in every step, chosen by a hash of the seed and the
/// two points. Points move about half as far in a step.
#define AZULEJO_VISITS_ONE_END 1

/// A set has converged when the motion falls to the tolerance.
#define AZULEJO_CONVERGENCE_MOTION 0

/// A set has converged when ten times in succession the variance of the distances to the nearest
/// point changes by less than 0.1 % in a step and more than 99 % of the points move by less than
/// 0.01 d_max (thesis section 4.4.2). Sets of a few hundred points may never do so.
#define AZULEJO_CONVERGENCE_VARIANCE 1

/// The set converged, or there was nothing to move. With AZULEJO_METHOD_MOMENTUM and Delaunay
/// neighbours no points are closer than 0.85 d_max then, and no circumradius is above 0.67 d_max.
#define AZULEJO_STOPPED_CONVERGED 0

#define AZULEJO_STOPPED_STEPS 1 ///< All steps were made.

#define AZULEJO_STOPPED_CANCELLED 2 ///< The progress callback cancelled the call.

/// Options of azulejo_dcr_relax, azulejo_dcr_relax_classes, azulejo_dcr_relax_density and
/// azulejo_dcr_scatter; the last one uses only the domain, the boundary, the seed and the progress
/// callback. The fields from `conflict_radius` on are settings of AZULEJO_METHOD_THESIS, with
/// lengths in units of d_max; with AZULEJO_METHOD_MOMENTUM they must have their defaults.
typedef struct azulejo_dcr_options {
    uint32_t struct_size; ///< The size of the struct in bytes; set by the _init function.
    uint32_t boundary; ///< An AZULEJO_BOUNDARY_ constant; default periodic.
    double domain_min[2]; ///< The lower corner of the domain, x y; default 0 0.
    double domain_max[2]; ///< The upper corner, as in azulejo_plane_set; default 1 1.
    uint32_t neighbourhood; ///< An AZULEJO_NEIGHBOURHOOD_ constant; default Delaunay.
    uint32_t method; ///< An AZULEJO_METHOD_ constant; default momentum.
    /// The largest number of steps; default 100, enough for AZULEJO_METHOD_MOMENTUM from any
    /// points; AZULEJO_METHOD_THESIS may need 1000. 0 returns the points as they are.
    uint32_t max_iterations;
    uint32_t reserved; ///< Must be 0.
    /// It parts coincident points, and draws the points of azulejo_dcr_scatter and those to which
    /// azulejo_dcr_relax_density moves clustered ones; default 0.
    uint64_t seed;
    /// The motion (see the report) at which the set has converged; 0 makes all steps. Any negative
    /// number, such as the default -1, selects 0.001, or with AZULEJO_METHOD_THESIS 0.02 for
    /// Delaunay and 0.005 for nearest neighbours.
    double tolerance;
    azulejo_progress_fn progress; ///< Default NULL: the callback of the context, if it has one.
    void *progress_user; ///< Passed to the progress callback.
    /// Neighbours closer than this repel each other; above 0, at most 1; default 0.95.
    double conflict_radius;
    /// Farther Delaunay neighbours attract each other; at least conflict_radius; default 1.05.
    double attraction_radius;
    double step; ///< The displacement by a tension of 1; above 0, at most 1; default 0.05.
    /// The factor of `step` from one step to the next; above 0, at most 1; default 1. All steps
    /// together are no longer than step / (1 - decay); a random start needs about 10.
    double decay;
    uint32_t neighbours; ///< Of AZULEJO_NEIGHBOURHOOD_NEAREST: their number; at least 1; default 6.
    /// An AZULEJO_DISTRIBUTION_ constant (thesis fig. 4.19); default activeness.
    uint32_t distribution;
    uint32_t visits; ///< An AZULEJO_VISITS_ constant; default both ends.
    uint32_t convergence; ///< An AZULEJO_CONVERGENCE_ constant; default motion.
} azulejo_dcr_options;

/// The report of azulejo_dcr_relax, _relax_classes and _relax_density.
typedef struct azulejo_dcr_report {
    uint32_t struct_size; ///< The size of the struct in bytes; set by the _init function.
    uint32_t iterations; ///< The steps made.
    uint32_t stopped; ///< Why no more steps were made: an AZULEJO_STOPPED_ constant.
    uint32_t reserved; ///< Always 0.
    /// Half of the distance that points moved, root mean square, in units of d_max: over the last
    /// 10 steps, or with AZULEJO_METHOD_THESIS over the last steps whose sizes add up to 2.
    double motion;
    /// The smallest distance between two points; infinite for fewer than two.
    double smallest_distance;
    /// The same in units of d_max: about 0.77 for a maximal Poisson-disk set, at most 1 on a torus.
    double rho;
    /// The covering radius in units of d_max; infinite for no point.
    double relative_covering_radius;
} azulejo_dcr_report;

azulejo_status azulejo_dcr_options_init(azulejo_dcr_options *options, size_t struct_size);

azulejo_status azulejo_dcr_report_init(azulejo_dcr_report *report, size_t struct_size);

/// Relaxes a set of points: neighbours that are too close repel each other and holes close, until
/// the set has converged or all steps are made (thesis chapter 4). AZULEJO_METHOD_MOMENTUM levels a
/// clustered set before the first step: any set ends as a random one, about as soon.
/// - positions: the points, x y each.
/// - out: the points, in the same order. With AZULEJO_METHOD_MOMENTUM and Delaunay neighbours, of
///   the states before and after whole steps the one in which the fewest points have a neighbour
///   closer than 0.85 d_max or a Delaunay triangle with a circumradius above 0.67 d_max; otherwise
///   the last.
/// - O(count) time for each step, O(count * log count) where the triangulation is built again:
///   while more than 64 points have holes as wide as the domain, with AZULEJO_METHOD_THESIS also
///   after steps that turn a triangle over. A bounded domain takes up to four times the time and
///   memory of a periodic one. O(count) memory.
azulejo_status azulejo_dcr_relax(const azulejo_context *context,
                                 const azulejo_dcr_options *options,
                                 const float *positions,
                                 size_t count,
                                 azulejo_points **out,
                                 azulejo_dcr_report *report);

/// Relaxes points of several classes, such as those of azulejo_kdrt_sample_classes: the union of
/// all points and each class by itself get more even, though less so than a set of one class. From
/// maximal sets of 2 to 7 classes of a torus, rho ends above 0.7 and the covering radius below 0.82
/// d_max, in the union and in each class. No distance of two classes is promised. A clustered class
/// is levelled before the first step. Only AZULEJO_METHOD_MOMENTUM with
/// AZULEJO_NEIGHBOURHOOD_DELAUNAY. Source: thesis chapter 4, with Wei 2010.
/// - positions: the points, x y each.
/// - classes: the class of each point, below class_count.
/// - class_count: the number of classes, 1 to AZULEJO_MAX_CLASSES.
/// - class_rho, class_relative_covering_radius: class_count numbers each, or NULL: `rho` and
///   `relative_covering_radius` of each class, in units of its own d_max.
/// - out: the points after the last whole step, in the same order.
/// - report: with the figures of the union.
/// - O(count) memory, and about 2.5 times the time of azulejo_dcr_relax.
azulejo_status azulejo_dcr_relax_classes(const azulejo_context *context,
                                         const azulejo_dcr_options *options,
                                         const float *positions,
                                         const uint32_t *classes,
                                         size_t count,
                                         uint32_t class_count,
                                         double *class_rho,
                                         double *class_relative_covering_radius,
                                         azulejo_points **out,
                                         azulejo_dcr_report *report);

/// Makes the pair correlation g(r) of sets with a radial mean of the power, for
/// azulejo_dcr_relax_to_correlation: g(r) = 1 + the integral of (P - 1) J0(2 pi frequency r)
/// 2 pi frequency over the frequencies, r in units of 1 / sqrt(density) (Heck et al. 2013).
/// - power: `count` numbers, 1 to 65536, at least 0: the power in bins of equal width from
///   frequency 0 to `highest`, in units of sqrt(density); beyond it is 1. One 0 is step noise.
/// - reach: where the last bin of `out` ends, above 0, in units of d_max: 12 is enough.
/// - out: an array of `bins` numbers, 1 to 65536: g in the middles of bins of equal width from 0 to
///   `reach`. Bins of 0.05 or less show all that is matched.
/// - O(count * bins) time.
azulejo_status azulejo_dcr_correlation_of_power(double highest,
                                                const double *power,
                                                size_t count,
                                                double reach,
                                                size_t bins,
                                                double *out);

/// Moves points of a periodic domain until their pair correlation g(r), and with it the radial mean
/// of their power, is the one wanted: general spectra (thesis eq. 4.3, 4.4 and 5.2; Heck et al.
/// 2013). Random points are a good start; a clustered set is levelled first. Method and
/// neighbourhood must have their defaults; `tolerance` is that of the residual, by default 0.005.
/// - positions: the points, x y each.
/// - reach: where the last bin ends, above 0, in units of d_max. Correlations are matched up to
///   this, 11.2 d_max and 0.42 of the shorter period, whichever is least.
/// - correlation: `bins` finite numbers, 1 to 65536: g in bins of equal width from 0 to `reach`, as
///   azulejo_plane_radial_distribution measures it (times (n - 1) / n for n points, to the last) or
///   azulejo_dcr_correlation_of_power makes it.
/// - residual: a number, or NULL: the root mean square, over frequencies up to 2 sqrt(density), of
///   the difference of the power and the one wanted, both smoothed over about 1 / reach; 0 for
///   fewer than two points.
/// - out: of the states, the one with the least residual, in the order of the positions. A
///   correlation that no set has is no error: `stopped` is not AZULEJO_STOPPED_CONVERGED then.
/// - O(count * reach^2) time for each step, O(count) memory.
azulejo_status azulejo_dcr_relax_to_correlation(const azulejo_context *context,
                                                const azulejo_dcr_options *options,
                                                const float *positions,
                                                size_t count,
                                                double reach,
                                                const double *correlation,
                                                size_t bins,
                                                double *residual,
                                                azulejo_points **out,
                                                azulejo_dcr_report *report);

/// Gives the density at a position, at least 0. See "Callbacks" in azulejo.h. It is called once for
/// each place of a lattice of up to some hundred places per point.
/// - user: the `function_user` of the azulejo_density.
/// - position: x y of a place in the domain.
typedef double (*azulejo_density_fn)(void *user, const double *position);

/// A density of points from place to place, in any unit: at least 0, and not 0 everywhere. Either
/// `values` or `function` must be set; what is not set has its default, NULL or 0.
typedef struct azulejo_density {
    uint32_t struct_size; ///< The size of the struct in bytes; set by the _init function.
    uint32_t reserved; ///< Must be 0.
    /// An image that is stretched over the domain, linear between the centres of its pixels:
    /// `height` rows of `width` densities, the first row along the lower edge (domain_min[1]).
    const float *values;
    size_t width; ///< The number of pixels in a row.
    size_t height; ///< The number of rows.
    azulejo_density_fn function; ///< Gives the density at a position.
    void *function_user; ///< Passed to `function`.
} azulejo_density;

azulejo_status azulejo_density_init(azulejo_density *density, size_t struct_size);

/// Makes `count` random points with a density: a start for azulejo_dcr_relax_density. O(count * log
/// count) time, O(count) calls of a density function and memory.
azulejo_status azulejo_dcr_scatter(const azulejo_context *context,
                                   const azulejo_dcr_options *options,
                                   const azulejo_density *density,
                                   size_t count,
                                   azulejo_points **out);

/// Relaxes a set of points to a density: as azulejo_dcr_relax, but the points become as dense from
/// place to place as the density says, and evenly spaced relative to it (thesis section 4.2.3).
/// Points of about the density, as of azulejo_dcr_scatter and azulejo_psp_adaptive_sample, need the
/// default 100 steps, others may need more. A set of more than 64 points that is far from it is
/// redistributed before the first step, onto points of azulejo_dcr_scatter. Only
/// AZULEJO_METHOD_MOMENTUM with AZULEJO_NEIGHBOURHOOD_DELAUNAY.
///
/// The unit of length is the local spacing: d_max for the mean density and proportional to 1 /
/// sqrt(density) elsewhere, increasing by at most half of the distance from place to place. Details
/// smaller than an eighth of d_max are lost.
/// - positions: the points, x y each.
/// - out: the points after the last whole step, in the same order.
/// - report: rho is the least of all distances over the mean of the two spacings, the relative
///   covering radius the largest circumradius of a Delaunay triangle over the spacing at its
///   centre, without the limit to its increase; the motion is in units of d_max.
/// - O(count) calls of a density function, then O(count) time for each step, with a factor for
///   densities that vary by orders of magnitude; O(count) memory.
azulejo_status azulejo_dcr_relax_density(const azulejo_context *context,
                                         const azulejo_dcr_options *options,
                                         const azulejo_density *density,
                                         const float *positions,
                                         size_t count,
                                         azulejo_points **out,
                                         azulejo_dcr_report *report);

/// Options of azulejo_dcr_surface_relax.
typedef struct azulejo_dcr_surface_options {
    uint32_t struct_size; ///< The size of the struct in bytes; set by the _init function.
    /// The largest number of steps; default 100. 0: none moves, except into its triangle.
    uint32_t max_iterations;
    /// The motion (see the report) at which the set has converged; 0 makes all steps. Any negative
    /// number, such as the default -1, selects 0.0005.
    double tolerance;
    /// It parts samples that coincide or lie on edges of triangles, and draws the points onto which
    /// clustered samples are redistributed; default 0.
    uint64_t seed;
    azulejo_progress_fn progress; ///< Default NULL: the callback of the context, if it has one.
    void *progress_user; ///< Passed to the progress callback.
    /// The density that samples shall have, without `radius` and `count`. Default NULL: constant.
    const azulejo_mesh_density *density;
} azulejo_dcr_surface_options;

/// The report of azulejo_dcr_surface_relax. Its d_max is that of a plane of the mesh's area.
typedef struct azulejo_dcr_surface_report {
    uint32_t struct_size; ///< The size of the struct in bytes; set by the _init function.
    uint32_t iterations; ///< The steps made.
    uint32_t stopped; ///< Why no more steps were made: an AZULEJO_STOPPED_ constant.
    uint32_t reserved; ///< Always 0.
    /// Half of the distance that samples moved over the last 10 steps, root mean square, in d_max.
    double motion;
    /// The smallest straight distance between two samples: never less than before the call.
    double smallest_distance;
    /// In units of d_max, with a density of its mean at both samples: about 0.77 for a maximal set,
    /// more for a relaxed one, except where parts of the mesh are nearer to each other.
    double rho;
} azulejo_dcr_surface_report;

azulejo_status azulejo_dcr_surface_options_init(azulejo_dcr_surface_options *options,
                                                size_t struct_size);

azulejo_status azulejo_dcr_surface_report_init(azulejo_dcr_surface_report *report,
                                               size_t struct_size);

/// Relaxes samples on a mesh: they move on the surface, away from neighbours that are too close and
/// into holes (the future work of thesis chapter 4). Neighbours are near on the surface, not on the
/// other side of a thin wall. Triangles are connected by edges between the same two positions; any
/// other edge is a boundary, which samples do not cross.
///
/// No two samples get nearer to each other than the nearest two were before: straight distances, in
/// double arithmetic, without tolerance. More than 64 samples that are clustered are redistributed
/// before the first step, by the area of each connected part, where the same distance allows it.
/// With a density, distances are judged in the mean of its d_max at both samples, and no sample
/// ends where it is 0; they may shrink, and sets of other densities are redistributed.
/// - triangles, barycentrics: one triangle and u v for each sample. Barycentrics outside their
///   triangle by at most 1e-6 are moved onto it; those farther outside, and triangles that have no
///   area or are left out by the mask, are refused.
/// - out: after the last whole step, in the same order, with normals, triangles and barycentrics.
/// - O(triangles) time once, and O(count) for each step. O(count + triangles) memory.
azulejo_status azulejo_dcr_surface_relax(const azulejo_context *context,
                                         const azulejo_mesh *mesh,
                                         const azulejo_dcr_surface_options *options,
                                         const uint32_t *triangles,
                                         const float *barycentrics,
                                         size_t count,
                                         azulejo_points **out,
                                         azulejo_dcr_surface_report *report);

/// The report of azulejo_dcr_remesh. The mesh is a manifold if `non_manifold_vertices` is 0, closed
/// if `boundary_edges` is 0 too, and wound alike at each edge.
typedef struct azulejo_dcr_remesh_report {
    uint32_t struct_size; ///< The size of the struct in bytes; set by the _init function.
    uint32_t reserved; ///< Always 0.
    uint64_t triangles; ///< The triangles of the mesh.
    uint64_t disputed; ///< Those that not all of their three corners have in their Delaunay stars.
    uint64_t left_out; ///< Those of stars that are not in the mesh.
    uint64_t boundary_edges; ///< The edges with one triangle, which are the boundary.
    uint64_t inner_edges; ///< The edges with two triangles.
    uint64_t non_manifold_edges; ///< The edges with more than two triangles: always 0.
    /// The samples whose triangles are not all connected by edges at the sample.
    uint64_t non_manifold_vertices;
    uint64_t unused_vertices; ///< The samples without a triangle.
    /// Vertices - edges + triangles, all of them used: 2 for a sphere, 0 for a torus, 1 for a disk.
    int64_t euler;
    double smallest_angle; ///< The smallest angle of all triangles, in degrees.
    double largest_angle; ///< The largest angle of all triangles, in degrees.
    double mean_smallest_angle; ///< The mean of the triangles' smallest angles, in degrees.
} azulejo_dcr_remesh_report;

azulejo_status azulejo_dcr_remesh_report_init(azulejo_dcr_remesh_report *report,
                                              size_t struct_size);

/// Makes a mesh whose vertices are samples of another mesh (thesis fig. 1.12): remeshing, to more
/// triangles or to fewer. The samples must be spread about evenly, as maximal and, with better
/// angles, relaxed sets are. Triangles are those of the samples' Delaunay stars that go together.
///
/// Samples that resolve the features of a closed surface, wound alike everywhere, give a closed
/// manifold of the same topology; elsewhere, as on thin blades, there are holes. Triangles do not
/// cross open boundaries: the new boundary is that of the outermost samples.
/// - triangles, barycentrics: as for azulejo_dcr_surface_relax.
/// - out: the new mesh. Vertex i is sample i, also if it has no triangle; triangles are wound as
///   those of the old mesh under their corners.
/// - O(n log n) time and O(n) memory in samples and triangles.
/// - Errors: AZULEJO_ERROR_INVALID_ARGUMENT also for samples that form no triangle.
azulejo_status azulejo_dcr_remesh(const azulejo_context *context,
                                  const azulejo_mesh *mesh,
                                  const uint32_t *triangles,
                                  const float *barycentrics,
                                  size_t count,
                                  azulejo_mesh **out,
                                  azulejo_dcr_remesh_report *report);

#ifdef __cplusplus
}
#endif

#endif
