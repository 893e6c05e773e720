/* Analysis: distances, coverage and spectra of sets.
 * Generated from ffi/azulejo-c by cbindgen; do not edit. The conventions are in azulejo.h. */

#ifndef AZULEJO_ANALYSIS_H
#define AZULEJO_ANALYSIS_H

#include "base.h"

#ifdef __cplusplus
extern "C" {
#endif

/// The coverage of a domain or a surface by disks or balls of a radius.
typedef struct azulejo_coverage_report {
    uint32_t struct_size; ///< The size of the struct in bytes; set by the _init function.
    uint32_t reserved; ///< Always 0.
    double covering_radius; ///< The covering radius; infinite for no sample.
    uint64_t gaps; ///< The number of gaps: 0 if the set is maximal for the radius.
} azulejo_coverage_report;

/// The smallest distance between two points of the plane, in double arithmetic, on a periodic
/// domain around the torus; infinite for fewer than two points. O(count) time.
azulejo_status azulejo_plane_smallest_distance(const azulejo_context *context,
                                               const azulejo_plane_set *set,
                                               double *out);

/// The covering radius of points of the plane, on a periodic domain around the torus, too small by
/// less than a billionth of it; infinite for no point. Exact, by subdivision: O(count * log count).
azulejo_status azulejo_plane_covering_radius(const azulejo_context *context,
                                             const azulejo_plane_set *set,
                                             double *out);

/// The smallest straight distance between two points in space, x y z each, in double arithmetic;
/// infinite for fewer than two points. O(count) time.
azulejo_status azulejo_space_smallest_distance(const azulejo_context *context,
                                               const float *positions,
                                               size_t count,
                                               double *out);

/// The fraction of a surface that is farther than a radius from every sample, estimated by random
/// probes; 0 if the mask of the mesh leaves out everything. Probes do not prove coverage,
/// azulejo_mesh_coverage does. O(probes + count) time.
/// - positions: the samples, x y z each. They need not lie on the mesh.
/// - radius: above 0.
/// - probes: the number of random places, at least 1, uniform over the area of the surface.
azulejo_status azulejo_mesh_uncovered_fraction(const azulejo_context *context,
                                               const azulejo_mesh *mesh,
                                               const float *positions,
                                               size_t count,
                                               double radius,
                                               uint64_t probes,
                                               uint64_t seed,
                                               double *out);

azulejo_status azulejo_coverage_report_init(azulejo_coverage_report *report,
                                            size_t struct_size);

/// Counts the gaps that points of the plane leave: the connected parts of the domain, or of the
/// torus, that are farther than a radius from all points, by more than 6 float spacings. With no
/// gap the set is maximal for the radius, as all maximal sets of this library.
/// - radius: above 0.
/// - out: the covering radius, as azulejo_plane_covering_radius finds it, and the number of gaps.
///   Every gap deeper than a millionth of the mean spacing is found, however small, and the deepest
///   in any case. An empty set has one gap.
/// - O(count * log count) time: they are found exactly, by the Voronoi diagram.
azulejo_status azulejo_plane_coverage(const azulejo_context *context,
                                      const azulejo_plane_set *set,
                                      double radius,
                                      azulejo_coverage_report *out);

/// Counts the gaps that points of a cuboid leave: groups of places that are farther than a radius
/// from all points, by more than 6 float spacings, each within half of the radius of another place
/// of its group. With no gap the set is maximal for the radius.
/// - radius: above 0.
/// - out: the covering radius, too small by less than a billionth of it, and the number of gaps.
///   Every gap deeper than a millionth of the radius is found, however small, and the deepest in
///   any case. An empty set has an infinite radius and one gap.
/// - O(count * log count) time, by subdivision, and some 1,000 cells per uncovered radius^3.
/// - Errors: AZULEJO_ERROR_TOO_LARGE also if more than about 25,000 * radius^3 is uncovered.
azulejo_status azulejo_space_coverage(const azulejo_context *context,
                                      const azulejo_space_set *set,
                                      double radius,
                                      azulejo_coverage_report *out);

/// Counts the gaps that samples leave on a mesh, by straight distance, as azulejo_space_coverage.
/// - positions: the samples, x y z each. They need not lie on the mesh.
/// - radius: above 0.
/// - out: the covering radius, too small by less than a billionth of it, and the number of gaps.
///   Every gap deeper than a millionth of the radius is found, however small, and the deepest in
///   any case. An empty set has an infinite radius and at least one gap; no area has 0 and 0.
/// - O((count + triangles) * log count) time, and about 100 pieces per radius^2 of gaps.
/// - Errors: AZULEJO_ERROR_TOO_LARGE also if more than about 600,000 * radius^2 is uncovered.
azulejo_status azulejo_mesh_coverage(const azulejo_context *context,
                                     const azulejo_mesh *mesh,
                                     const float *positions,
                                     size_t count,
                                     double radius,
                                     azulejo_coverage_report *out);

/// The result of azulejo_plane_measure. Distances between points are infinite for fewer than two.
typedef struct azulejo_plane_report {
    uint32_t struct_size; ///< The size of the struct in bytes; set by the _init function.
    uint32_t reserved; ///< Always 0.
    uint64_t count; ///< The number of points.
    double smallest_distance; ///< The smallest distance between two points.
    double mean_distance; ///< The mean distance from a point to its nearest neighbour.
    double hexagonal_distance; ///< d_max; infinite for no point.
    /// The smallest distance in units of d_max: about 0.77 for maximal sets, at most 1 on a torus.
    double rho;
    /// The covering radius: d_max / sqrt(3) for a hexagonal lattice; infinite for no point.
    double covering_radius;
    /// The bond order psi6: the mean over the points of |sum of exp(6 i angle)| / n for the n
    /// directions of Delaunay neighbours (Nelson, Halperin 1979). 1 in a lattice, 0.36 at random.
    double bond_order;
    /// The number of Delaunay triangles; in a bounded domain without those across its edges.
    uint64_t triangles;
    double obtuse; ///< The fraction of triangles with an angle above 90 degrees.
    double below_30_degrees; ///< The fraction of triangles with an angle below 30 degrees.
    double edge_mean; ///< The mean length of the triangles' edges.
    double edge_variation; ///< The variance of the edges' lengths over their squared mean.
    double area_variation; ///< The variance of the triangles' areas over their squared mean.
    double angles_below_30_degrees; ///< The fraction of all angles that are below 30 degrees.
    /// The fraction of triangles whose area is farther than 4 standard deviations from the mean.
    double beyond_4_sigma;
} azulejo_plane_report;

/// The result of azulejo_space_measure. Distances between points are infinite for fewer than two.
typedef struct azulejo_space_report {
    uint32_t struct_size; ///< The size of the struct in bytes; set by the _init function.
    uint32_t reserved; ///< Always 0.
    uint64_t count; ///< The number of points.
    double smallest_distance; ///< The smallest distance between two points.
    double mean_distance; ///< The mean distance from a point to its nearest neighbour.
    /// The number of pairs of points that are nearer to each other than `radius`.
    uint64_t conflicts;
    /// cbrt(sqrt(2) * volume / count), that of neighbours in the densest packing.
    double packed_distance;
    /// The same in units of packed_distance: about 0.80 for maximal sets, at most 1 on a torus.
    double rho;
    /// The covering radius, too small by less than a billionth of it; infinite for no point.
    double covering_radius;
    /// The same in units of packed_distance: 0.71 for the densest packing, 0.63 for the
    /// body-centred cubic lattice, which covers best.
    double relative_covering_radius;
} azulejo_space_report;

azulejo_status azulejo_plane_report_init(azulejo_plane_report *report, size_t struct_size);

/// Measures points of the plane: spacing, cover, bonds, Delaunay triangles. O(count * log count).
azulejo_status azulejo_plane_measure(const azulejo_context *context,
                                     const azulejo_plane_set *set,
                                     azulejo_plane_report *out);

azulejo_status azulejo_space_report_init(azulejo_space_report *report, size_t struct_size);

/// Measures points of a cuboid: spacing, conflicts, cover. O(count * log count + conflicts).
/// - radius: pairs of points that are nearer are conflicts; 0 counts none.
azulejo_status azulejo_space_measure(const azulejo_context *context,
                                     const azulejo_space_set *set,
                                     double radius,
                                     azulejo_space_report *out);

/// The histogram of the distances from points of the plane to their nearest neighbours. Histograms
/// of several sets may be added. O(count) time.
/// - reach: where the last bin ends, above 0, in units of d_max.
/// - bins: the number of bins of equal width from 0 to `reach`, 1 to 65536.
/// - out: an array of `bins` numbers: how many points have their nearest neighbour at such a
///   distance. Distances of `reach` and more, and a single point, are in no bin.
azulejo_status azulejo_plane_nearest_histogram(const azulejo_context *context,
                                               const azulejo_plane_set *set,
                                               double reach,
                                               size_t bins,
                                               uint64_t *out);

/// The radial distribution function g of points of the plane, also called pair correlation: the
/// density of other points at a distance from a point, over the mean density. 1 for a Poisson
/// process; a hexagonal lattice has peaks at 1, sqrt(3), 2, ... d_max. In a bounded domain pairs
/// are weighted to correct for the edges (Ohser and Stoyan 1981). O(count * (1 + reach^2)) time.
/// - set: the points, at least 2.
/// - reach: where the last bin ends, in units of d_max: above 0, at most half of either side.
/// - bins: the number of bins of equal width from 0 to `reach`, 1 to 65536.
/// - out: an array of `bins` numbers: the mean of g in each bin.
azulejo_status azulejo_plane_radial_distribution(const azulejo_context *context,
                                                 const azulejo_plane_set *set,
                                                 double reach,
                                                 size_t bins,
                                                 double *out);

/// The radial distribution function of points of a cuboid, in units of packed_distance, of which
/// `reach` is at most half of the shortest side. O(count * (1 + reach^3)) time.
azulejo_status azulejo_space_radial_distribution(const azulejo_context *context,
                                                 const azulejo_space_set *set,
                                                 double reach,
                                                 size_t bins,
                                                 double *out);

/// The power spectrum of a set of the plane, or the mean of several: |sum of exp(-2 pi i f x)|^2 /
/// count on a square grid of frequencies f (Ulichney 1988; Lagae and Dutre 2008). Its mean is 1 for
/// a Poisson process. Frequencies are in units of sqrt(count / area): blue noise has a first ring
/// near 1.
typedef struct azulejo_spectrum azulejo_spectrum;

/// The result of azulejo_spectrum_measure.
typedef struct azulejo_spectrum_report {
    uint32_t struct_size; ///< The size of the struct in bytes; set by the _init function.
    uint32_t reserved; ///< Always 0.
    double frequency_step[2]; ///< The distances of neighbouring columns and rows.
    /// The effective Nyquist frequency: half of the largest frequency up to which the mean power is
    /// below 0.1 (Heck et al. 2013, who divide it by 0.5). 0.537 for a hexagonal lattice, 0 for a
    /// Poisson process. -1 if the spectrum ends too early, below about 1.5.
    double effective_nyquist;
    /// The oscillation: ten times the root mean square of the power's deviation from 1, by area,
    /// from the frequency where it first reaches 0.98 to 5 above it (Heck et al. 2013). 0 for a
    /// Poisson process. -1 if the spectrum ends too early; frequencies up to 6.5 mostly suffice.
    double oscillation;
    /// The scatter of the power about its radial mean, over the frequencies from `low` to `high`: 1
    /// for one set without order over long distances, 1/n for the mean of n, more if parts repeat.
    double contrast;
    /// The largest power of a frequency from `low` to `high`, over the radial mean there: by chance
    /// about ln n for n frequencies of one set.
    double peak;
    double peak_frequency[2]; ///< That frequency, x y; its opposite has the same power.
} azulejo_spectrum_report;

/// The frequencies of about one length: a point of the radial curves.
typedef struct azulejo_annulus {
    double frequency; ///< The mean length of its frequencies.
    double power; ///< The mean power: the radial mean; 1 for a Poisson process.
    /// The variance of the power over its squared mean: 1 (0 dB) for one isotropic set, 1/n for the
    /// mean of n; preferred directions give more.
    double anisotropy;
    uint64_t count; ///< The number of its frequencies, at least 2; one and its opposite count once.
} azulejo_annulus;

azulejo_status azulejo_spectrum_report_init(azulejo_spectrum_report *report,
                                            size_t struct_size);

/// Makes the spectrum of points of the plane, by nonuniform fast Fourier transform: exact up to the
/// rounding to float. A periodic domain has whole numbers of waves per period. In a bounded one
/// points have the weights of a taper that is 0 from the inscribed ellipse on.
/// - set: the points may lie outside the domain; of a bounded one, at least one inside the ellipse.
/// - size: the number of frequencies per side, 2 to 4096. From -(size / 2) steps of 1 / width and
///   height.
/// - frequency_stride: n takes every n-th frequency along both axes, 1 to 4096, so that the spectra
///   of large sets reach as far as those of small ones. For all figures, size * frequency_stride of
///   about 13 * sqrt(count) is enough on a square.
/// - O(count + size^2 * log size) time, and about 40 bytes of memory per point and per frequency.
azulejo_status azulejo_spectrum_create(const azulejo_context *context,
                                       const azulejo_plane_set *set,
                                       uint32_t size,
                                       uint32_t frequency_stride,
                                       azulejo_spectrum **out);

/// Makes the mean of spectra of sets of one kind; noise decreases with the square root of `count`.
/// O(count * size^2) time and memory, on the calling thread.
/// - spectra: `count` spectra, at least 1, all of one size. They still belong to the caller.
azulejo_status azulejo_spectrum_mean(const azulejo_spectrum *const *spectra,
                                     size_t count,
                                     azulejo_spectrum **out);

/// The number of frequencies per side.
uint32_t azulejo_spectrum_size(const azulejo_spectrum *spectrum);

/// The power, size * size numbers, row by row from the lowest frequency. Frequency 0, whose power
/// is set to 0, is in row and column size / 2.
const float *azulejo_spectrum_power(const azulejo_spectrum *spectrum);

/// The radial curves of a spectrum, mean and anisotropy, out to its largest circle. O(size^2).
/// - width: the width of an annulus, above 0. Annuli of fewer than two frequencies are left out.
/// - annuli: receives at most `capacity` of them, from the lowest frequency; may be NULL for 0.
/// - annulus_size: sizeof(azulejo_annulus).
/// - out_count: their number, which may exceed the capacity.
azulejo_status azulejo_spectrum_radial(const azulejo_spectrum *spectrum,
                                       double width,
                                       azulejo_annulus *annuli,
                                       size_t capacity,
                                       size_t annulus_size,
                                       size_t *out_count);

/// Measures a spectrum: effective Nyquist frequency, oscillation, contrast, peak. O(size^2).
/// - width: that of the annuli of the radial mean, above 0; 0.05 suits some thousand points.
/// - low, high: the range of frequencies for contrast and peak.
azulejo_status azulejo_spectrum_measure(const azulejo_spectrum *spectrum,
                                        double width,
                                        double low,
                                        double high,
                                        azulejo_spectrum_report *out);

/// The radial curves of the power spectrum of points of a cuboid, as azulejo_spectrum_create and
/// azulejo_spectrum_radial, with frequencies in units of cbrt(count / volume).
/// - frequency_reach: the largest frequency, above 0. For each point there are 8 * (frequency_reach
///   / frequency_stride)^3 of them, 25 bytes each: AZULEJO_ERROR_TOO_LARGE if memory is short.
/// - out_count: at most frequency_reach / width + 1.
azulejo_status azulejo_space_spectrum(const azulejo_context *context,
                                      const azulejo_space_set *set,
                                      double frequency_reach,
                                      uint32_t frequency_stride,
                                      double width,
                                      azulejo_annulus *annuli,
                                      size_t capacity,
                                      size_t annulus_size,
                                      size_t *out_count);

/// The power of points of a cuboid on an axis of frequencies, 1 for a Poisson process. Planes
/// across the axis, such as faces of blocks, show here and not in the radial mean.
/// - axis: 0 to 2. out: the power at 1, 2, ... `count` waves along this side. count: 1 to 65536.
azulejo_status azulejo_space_axis_power(const azulejo_context *context,
                                        const azulejo_space_set *set,
                                        uint32_t axis,
                                        size_t count,
                                        double *out);

/// Frees the spectrum.
void azulejo_spectrum_free(azulejo_spectrum *spectrum);

/// The cells per side of the grid of azulejo_differences_density.
#define AZULEJO_DIFFERENCES_SIZE 128

/// The extent of the grid from the difference 0 along both axes, in mean spacings.
#define AZULEJO_DIFFERENCES_GRID_REACH 4

#define AZULEJO_DIFFERENCES_SHELLS 512 ///< The shells of equal width of azulejo_differences_radial.

/// The distance at which the last shell ends, in mean spacings.
#define AZULEJO_DIFFERENCES_REACH 8

/// The distribution p(d) of the differences d of all pairs of samples on a mesh, or of several sets
/// (Wei and Wang 2011): the density of other samples at an offset from a sample, over the mean
/// density. 1 for a Poisson process. Its Fourier transform takes the place of the power spectrum.
///
/// The offset of a pair is projected onto the tangent plane of its first sample and keeps its
/// straight length. Lengths are in mean spacings, sqrt(area / count), frequencies in their inverse.
typedef struct azulejo_differences azulejo_differences;

/// Measures the differences of samples on a mesh, divided by those with random points of it, so
/// that boundaries, curvature and sheets nearby cancel (Davis and Peebles 1983). O(count) time.
/// - mesh: must have area that its mask does not leave out.
/// - positions: the samples, x y z each, at least 2.
/// - normals: those of the samples' triangles, x y z each, as azulejo_points_normals returns them.
/// - direction: three numbers, not all 0, whose projection on the tangent plane is the x axis.
/// - seed: selects the random points, two per sample.
azulejo_status azulejo_differences_create(const azulejo_context *context,
                                          const azulejo_mesh *mesh,
                                          const float *positions,
                                          const float *normals,
                                          size_t count,
                                          const double *direction,
                                          uint64_t seed,
                                          azulejo_differences **out);

/// Combines the differences of `count` sets of one kind, at least 1. Their noise decreases with the
/// square root of it. O(count) time and memory, on the calling thread.
azulejo_status azulejo_differences_mean(const azulejo_differences *const *differences,
                                        size_t count,
                                        azulejo_differences **out);

/// p(d): AZULEJO_DIFFERENCES_SIZE squared numbers, row by row from the lowest offset; 0 where not
/// even random points have a pair. The offset 0 is in the middle, where four cells meet.
const double *azulejo_differences_density(const azulejo_differences *differences);

/// The radial mean of p(d), the radial distribution function: AZULEJO_DIFFERENCES_SHELLS numbers.
const double *azulejo_differences_radial(const azulejo_differences *differences);

/// The radial mean of the power spectrum, by Hankel transform of the radial mean of p(d) - 1; 1 for
/// a Poisson process. Its resolution is one over AZULEJO_DIFFERENCES_REACH. O(count) time.
/// - frequencies: `count` frequencies from -32 to 32.
/// - out: receives the power at each, `count` numbers.
azulejo_status azulejo_differences_power(const azulejo_differences *differences,
                                         const double *frequencies,
                                         size_t count,
                                         double *out);

/// Frees the differences.
void azulejo_differences_free(azulejo_differences *differences);

#ifdef __cplusplus
}
#endif

#endif
