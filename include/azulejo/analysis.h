/*
 * Analysis: distances, coverage and spectra of sets.
 * Generated from ffi/azulejo-c by cbindgen; do not edit. The conventions are in azulejo.h.
 */

#ifndef AZULEJO_ANALYSIS_H
#define AZULEJO_ANALYSIS_H

#include "base.h"

#ifdef __cplusplus
extern "C" {
#endif

/// The coverage of a domain or a surface by disks of a radius: the result of
/// azulejo_plane_coverage and azulejo_mesh_coverage.
typedef struct azulejo_coverage_report {
    uint32_t struct_size; ///< The size of the struct in bytes; set by the _init function.
    uint32_t reserved; ///< Always 0.
    /// The covering radius, in the units of the domain or mesh; infinite for no sample.
    double covering_radius;
    /// The number of gaps: 0 if the set is maximal for the radius, up to the rounding of floats.
    uint64_t gaps;
} azulejo_coverage_report;

/// The smallest distance between two points of the plane, in double arithmetic; on a periodic
/// domain around the torus.
/// - set: the points.
/// - out: the distance in the units of the domain; infinite for fewer than two points.
/// - O(count) time for evenly spread points.
/// - Errors: AZULEJO_ERROR_INVALID_ARGUMENT, AZULEJO_ERROR_TOO_LARGE, AZULEJO_ERROR_CANCELLED.
azulejo_status azulejo_plane_smallest_distance(const azulejo_context *context,
                                               const azulejo_plane_set *set,
                                               double *out);

/// The covering radius of points of the plane; on a periodic domain around the torus. The set is
/// maximal for every radius that is not smaller.
/// - set: the points.
/// - out: the covering radius in the units of the domain, too small by less than a billionth of it;
///   infinite for no point.
///
/// Found exactly, by subdivision of the domain: O(count * log count) time for evenly spread points.
/// - Errors: AZULEJO_ERROR_INVALID_ARGUMENT, AZULEJO_ERROR_TOO_LARGE, AZULEJO_ERROR_CANCELLED.
azulejo_status azulejo_plane_covering_radius(const azulejo_context *context,
                                             const azulejo_plane_set *set,
                                             double *out);

/// The smallest straight distance between two points in space, in double arithmetic.
/// - positions: the points, x y z each, finite; `count` of them.
/// - out: the distance in the units of the positions; infinite for fewer than two points.
/// - O(count) time for evenly spread points.
/// - Errors: AZULEJO_ERROR_INVALID_ARGUMENT, AZULEJO_ERROR_TOO_LARGE, AZULEJO_ERROR_CANCELLED.
azulejo_status azulejo_space_smallest_distance(const azulejo_context *context,
                                               const float *positions,
                                               size_t count,
                                               double *out);

/// The fraction of a surface that is farther than a radius from every sample, estimated by random
/// probes.
/// - positions: the samples, x y z each, finite; `count` of them. They need not lie on the mesh.
/// - radius: above 0, in the units of the mesh.
/// - probes: the number of random places of the surface that are examined, at least 1, uniform over
///   its area.
/// - seed: selects the places.
/// - out: the fraction of the probes that are uncovered, 0 to 1; 0 if the mask of the mesh leaves
///   out everything.
/// - O(probes + count) time for evenly spread samples. Probes do not prove coverage,
///   azulejo_mesh_coverage does.
/// - Errors: AZULEJO_ERROR_INVALID_ARGUMENT, AZULEJO_ERROR_TOO_LARGE, AZULEJO_ERROR_CANCELLED.
azulejo_status azulejo_mesh_uncovered_fraction(const azulejo_context *context,
                                               const azulejo_mesh *mesh,
                                               const float *positions,
                                               size_t count,
                                               double radius,
                                               uint64_t probes,
                                               uint64_t seed,
                                               double *out);

/// Writes zeros and the size. `struct_size` is sizeof *report.
/// - Errors: AZULEJO_ERROR_INVALID_ARGUMENT.
azulejo_status azulejo_coverage_report_init(azulejo_coverage_report *report,
                                            size_t struct_size);

/// Counts the gaps that points of the plane leave: the connected parts of the domain, or of the
/// torus, that are farther than a radius from all points, by more than 6 times the spacing of
/// floats at the largest coordinate of the domain. With no gap the set is maximal for the radius,
/// as "Terms" has it, and all maximal sets of this library have none.
/// - set: the points.
/// - radius: above 0, in the units of the domain.
/// - out: the covering radius, as azulejo_plane_covering_radius finds it, and the number of gaps.
///   Every gap deeper than a millionth of the mean spacing is found, however small, and the deepest
///   in any case. An empty set has one gap.
///
/// Found exactly, by the Voronoi diagram: O(count * log count) time for evenly spread points.
/// - Errors: AZULEJO_ERROR_INVALID_ARGUMENT, AZULEJO_ERROR_TOO_LARGE, AZULEJO_ERROR_CANCELLED.
azulejo_status azulejo_plane_coverage(const azulejo_context *context,
                                      const azulejo_plane_set *set,
                                      double radius,
                                      azulejo_coverage_report *out);

/// Counts the gaps that samples leave on a mesh, by straight distance: groups of places that are
/// farther than a radius from all samples, by more than 6 times the spacing of floats at the
/// largest coordinate of the mesh, each within half of the radius of another place of its group.
/// With no gap the set is maximal for the radius, as "Terms" has it, and all maximal sets of this
/// library have none.
/// - positions: the samples, x y z each, finite; `count` of them. They need not lie on the mesh.
/// - radius: above 0, in the units of the mesh.
/// - out: the covering radius, too small by less than a billionth of it, and the number of gaps.
///   Every gap deeper than a millionth of the radius is found, however small, and the deepest in
///   any case. An empty set has an infinite radius and at least one gap; a mesh without area, or
///   whose mask leaves out everything, has 0 and 0.
///
/// Found exactly, by subdivision of the triangles: O((count + triangles) * log count) time for
/// evenly spread samples, and about 100 pieces per radius^2 of uncovered area.
/// - Errors: AZULEJO_ERROR_INVALID_ARGUMENT; AZULEJO_ERROR_TOO_LARGE, also if more than about
///   600,000 * radius^2 of the area is uncovered; AZULEJO_ERROR_CANCELLED.
azulejo_status azulejo_mesh_coverage(const azulejo_context *context,
                                     const azulejo_mesh *mesh,
                                     const float *positions,
                                     size_t count,
                                     double radius,
                                     azulejo_coverage_report *out);

/// The result of azulejo_plane_measure.
typedef struct azulejo_plane_report {
    uint32_t struct_size; ///< The size of the struct in bytes; set by the _init function.
    uint32_t reserved; ///< Always 0.
    uint64_t count; ///< The number of points.
    /// The smallest distance between two points, in the units of the domain; infinite for fewer
    /// than two.
    double smallest_distance;
    /// The mean distance from a point to its nearest neighbour, in the units of the domain;
    /// infinite for fewer than two points.
    double mean_distance;
    double hexagonal_distance; ///< d_max, in the units of the domain; infinite for no point.
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
    double obtuse; ///< The fraction of triangles with an angle above 90 degrees, 0 to 1.
    double below_30_degrees; ///< The fraction of triangles with an angle below 30 degrees, 0 to 1.
    double edge_mean; ///< The mean length of the triangles' edges, in the units of the domain.
    double edge_variation; ///< The variance of the lengths of the edges over their squared mean.
    double area_variation; ///< The variance of the areas of the triangles over their squared mean.
    /// The fraction of the angles of all triangles that are below 30 degrees, 0 to 1.
    double angles_below_30_degrees;
    /// The fraction of triangles whose area is farther than 4 standard deviations from the mean, 0
    /// to 1.
    double beyond_4_sigma;
} azulejo_plane_report;

/// Writes zeros and the size. `struct_size` is sizeof *report.
/// - Errors: AZULEJO_ERROR_INVALID_ARGUMENT.
azulejo_status azulejo_plane_report_init(azulejo_plane_report *report, size_t struct_size);

/// Measures points of the plane: spacing, covering radius, bond order and Delaunay triangles.
/// - set: the points.
/// - out: the report.
/// - O(count * log count) time for evenly spread points.
/// - Errors: AZULEJO_ERROR_INVALID_ARGUMENT, AZULEJO_ERROR_TOO_LARGE, AZULEJO_ERROR_CANCELLED.
azulejo_status azulejo_plane_measure(const azulejo_context *context,
                                     const azulejo_plane_set *set,
                                     azulejo_plane_report *out);

/// The histogram of the distances from points of the plane to their nearest neighbours.
/// - set: the points.
/// - reach: where the last bin ends, above 0, in units of d_max.
/// - bins: the number of bins of equal width from 0 to `reach`, 1 to 65536.
/// - out: an array of `bins` numbers: how many points have their nearest neighbour at such a
///   distance. Distances of `reach` and more, and a single point, are in no bin. Histograms of
///   several sets may be added.
/// - O(count) time for evenly spread points.
/// - Errors: AZULEJO_ERROR_INVALID_ARGUMENT, AZULEJO_ERROR_TOO_LARGE, AZULEJO_ERROR_CANCELLED.
azulejo_status azulejo_plane_nearest_histogram(const azulejo_context *context,
                                               const azulejo_plane_set *set,
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
/// - set: the points, at least 2.
/// - reach: where the last bin ends, in units of d_max: above 0, and at most half of the width or
///   height of the domain.
/// - bins: the number of bins of equal width from 0 to `reach`, 1 to 65536.
/// - out: an array of `bins` numbers: the mean of g in each bin. For sets of one kind and count,
///   the mean of these over the sets is their g.
/// - O(count * (1 + reach^2)) time for evenly spread points.
/// - Errors: AZULEJO_ERROR_INVALID_ARGUMENT, AZULEJO_ERROR_TOO_LARGE, AZULEJO_ERROR_CANCELLED.
azulejo_status azulejo_plane_radial_distribution(const azulejo_context *context,
                                                 const azulejo_plane_set *set,
                                                 double reach,
                                                 size_t bins,
                                                 double *out);

/// The power spectrum of a set of the plane, or the mean of several: |sum of exp(-2 pi i f x)|^2 /
/// count on a square grid of frequencies f. Its mean is 1 for a Poisson process (Ulichney 1988;
/// Lagae and Dutre 2008). Immutable: several threads may use it at once.
///
/// Frequencies are in units of sqrt(count / area), so that sets of different size can be compared;
/// the first ring of blue noise lies near 1.
typedef struct azulejo_spectrum azulejo_spectrum;

/// The result of azulejo_spectrum_measure.
typedef struct azulejo_spectrum_report {
    uint32_t struct_size; ///< The size of the struct in bytes; set by the _init function.
    uint32_t reserved; ///< Always 0.
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
    double frequency; ///< The mean length of its frequencies, in units of sqrt(count / area).
    double power; ///< The mean power: the radial mean; 1 for a Poisson process.
    /// The variance of the power over its squared mean. The spectrum of one isotropic set has 1 (0
    /// dB), the mean of n such spectra has 1/n; preferred directions give more.
    double anisotropy;
    /// The number of its frequencies, a frequency and its opposite counted once; at least 2.
    uint64_t count;
} azulejo_annulus;

/// Writes zeros and the size. `struct_size` is sizeof *report.
/// - Errors: AZULEJO_ERROR_INVALID_ARGUMENT.
azulejo_status azulejo_spectrum_report_init(azulejo_spectrum_report *report,
                                            size_t struct_size);

/// Makes the spectrum of points of the plane, by nonuniform fast Fourier transform in double
/// arithmetic: the power differs from that of the direct sum by no more than its rounding to float.
///
/// A periodic domain has exact frequencies, whole numbers of waves per period. A bounded domain is
/// treated as a window of a larger set: points are weighted by a taper that falls to 0 at the
/// ellipse inside it, so that its edges do not show in the spectrum.
/// - set: the points, which must be finite but may lie outside the domain. In a bounded domain at
///   least one must lie inside the ellipse.
/// - size: the number of frequencies per side, 2 to 4096. The lowest are -(size / 2) steps of 1 /
///   width and 1 / height.
/// - frequency_stride: 1 takes all frequencies; n, up to 4096, every n-th along both axes, so that
///   the spectra of large sets reach as far as those of small ones. For all figures, size *
///   frequency_stride of about 13 * sqrt(count) is enough on a square.
/// - out: the spectrum, to be freed with azulejo_spectrum_free.
/// - O(count + size^2 * log size) time, and about 40 bytes of memory per point and per frequency
///   during the call.
/// - Errors: AZULEJO_ERROR_INVALID_ARGUMENT, AZULEJO_ERROR_TOO_LARGE, AZULEJO_ERROR_CANCELLED.
azulejo_status azulejo_spectrum_create(const azulejo_context *context,
                                       const azulejo_plane_set *set,
                                       uint32_t size,
                                       uint32_t frequency_stride,
                                       azulejo_spectrum **out);

/// Makes the mean of the spectra of sets of one kind. The noise of a single spectrum decreases with
/// the square root of their number. It takes no context: it runs on the calling thread and does not
/// report progress.
/// - spectra: `count` spectra, at least 1, all of one size.
/// - out: the mean, to be freed with azulejo_spectrum_free; the spectra still belong to the caller.
/// - O(count * size^2) time and memory.
/// - Errors: AZULEJO_ERROR_INVALID_ARGUMENT, AZULEJO_ERROR_TOO_LARGE.
azulejo_status azulejo_spectrum_mean(const azulejo_spectrum *const *spectra,
                                     size_t count,
                                     azulejo_spectrum **out);

/// The number of frequencies per side; 0 for NULL.
uint32_t azulejo_spectrum_size(const azulejo_spectrum *spectrum);

/// The power, size * size numbers, row by row from the lowest frequency. Frequency 0, whose power
/// is set to 0, is in row and column size / 2. Valid until azulejo_spectrum_free. NULL for NULL.
const float *azulejo_spectrum_power(const azulejo_spectrum *spectrum);

/// The radial curves of a spectrum, mean and anisotropy, out to its largest circle.
/// - width: the width of an annulus, above 0, in units of sqrt(count / area). Annuli of fewer than
///   two frequencies are left out.
/// - annuli: receives at most `capacity` of them, from the lowest frequency; may be NULL if
///   `capacity` is 0.
/// - annulus_size: sizeof(azulejo_annulus).
/// - out_count: their number, which may exceed the capacity.
/// - O(size^2) time on the calling thread.
/// - Errors: AZULEJO_ERROR_INVALID_ARGUMENT.
azulejo_status azulejo_spectrum_radial(const azulejo_spectrum *spectrum,
                                       double width,
                                       azulejo_annulus *annuli,
                                       size_t capacity,
                                       size_t annulus_size,
                                       size_t *out_count);

/// Measures a spectrum: effective Nyquist frequency, oscillation, contrast and the highest peak.
/// - width: the width of the annuli of the radial mean, above 0, in units of sqrt(count / area);
///   0.05 suits sets of some thousand points.
/// - low, high: the range of frequencies for contrast and peak, finite, in units of sqrt(count /
///   area).
/// - out: the report.
/// - O(size^2) time on the calling thread.
/// - Errors: AZULEJO_ERROR_INVALID_ARGUMENT.
azulejo_status azulejo_spectrum_measure(const azulejo_spectrum *spectrum,
                                        double width,
                                        double low,
                                        double high,
                                        azulejo_spectrum_report *out);

/// Frees the spectrum. NULL is allowed.
void azulejo_spectrum_free(azulejo_spectrum *spectrum);

/// The cells per side of the grid of azulejo_differences_density.
#define AZULEJO_DIFFERENCES_SIZE 128

/// The extent of the grid from the difference 0 along both axes, in mean spacings.
#define AZULEJO_DIFFERENCES_GRID_REACH 4

#define AZULEJO_DIFFERENCES_SHELLS 512 ///< The shells of equal width of azulejo_differences_radial.

/// The distance at which the last shell ends, in mean spacings.
#define AZULEJO_DIFFERENCES_REACH 8

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

/// Measures the differences of samples on a mesh. They are divided by those with random points of
/// the mesh, so that boundaries, curvature and other sheets nearby cancel out (Davis and Peebles
/// 1983).
/// - mesh: must have area that its mask does not leave out.
/// - positions: the samples, x y z each, finite; `count` of them, at least 2.
/// - normals: the normals of the samples' triangles, x y z each, as azulejo_points_normals returns
///   them; `count` of them.
/// - direction: three numbers, not all 0: the x axis of the offsets is its projection onto the
///   tangent plane.
/// - seed: selects the random points, two per sample.
/// - out: the differences, to be freed with azulejo_differences_free.
/// - O(count) time for evenly spread samples.
/// - Errors: AZULEJO_ERROR_INVALID_ARGUMENT, AZULEJO_ERROR_TOO_LARGE, AZULEJO_ERROR_CANCELLED.
azulejo_status azulejo_differences_create(const azulejo_context *context,
                                          const azulejo_mesh *mesh,
                                          const float *positions,
                                          const float *normals,
                                          size_t count,
                                          const double *direction,
                                          uint64_t seed,
                                          azulejo_differences **out);

/// Combines the differences of sets of one kind. Their noise decreases with the square root of the
/// number of sets. It takes no context: it runs on the calling thread and does not report progress.
/// - differences: `count` of them, at least 1.
/// - out: the mean, to be freed with azulejo_differences_free; those given still belong to the
///   caller.
/// - O(count) time and memory.
/// - Errors: AZULEJO_ERROR_INVALID_ARGUMENT, AZULEJO_ERROR_TOO_LARGE.
azulejo_status azulejo_differences_mean(const azulejo_differences *const *differences,
                                        size_t count,
                                        azulejo_differences **out);

/// p(d): AZULEJO_DIFFERENCES_SIZE squared numbers, row by row from the lowest offset; 0 where not
/// even random points have a pair. The offset 0 is in the middle, where four cells meet. Valid
/// until azulejo_differences_free. NULL for NULL.
const double *azulejo_differences_density(const azulejo_differences *differences);

/// The radial mean of p(d), the radial distribution function: AZULEJO_DIFFERENCES_SHELLS numbers.
/// Valid until azulejo_differences_free. NULL for NULL.
const double *azulejo_differences_radial(const azulejo_differences *differences);

/// The radial mean of the power spectrum, by Hankel transform of the radial mean of p(d) - 1; 1 for
/// a Poisson process. Its resolution is one over AZULEJO_DIFFERENCES_REACH.
/// - frequencies: `count` frequencies from -32 to 32, in units of one over the mean spacing; may be
///   NULL if `count` is 0.
/// - out: receives the power at each, `count` numbers; may be NULL if `count` is 0.
/// - O(count) time on the calling thread.
/// - Errors: AZULEJO_ERROR_INVALID_ARGUMENT, AZULEJO_ERROR_TOO_LARGE.
azulejo_status azulejo_differences_power(const azulejo_differences *differences,
                                         const double *frequencies,
                                         size_t count,
                                         double *out);

/// Frees the differences. NULL is allowed.
void azulejo_differences_free(azulejo_differences *differences);

#ifdef __cplusplus
}
#endif

#endif
