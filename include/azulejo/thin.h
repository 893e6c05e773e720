/* Thinning: points of a cloud that are far from each other.
 * Generated from ffi/azulejo-c by cbindgen; do not edit. The conventions are in azulejo.h. */

#ifndef AZULEJO_THIN_H
#define AZULEJO_THIN_H

#include "base.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Points of a cloud that azulejo_thin selected.
typedef struct azulejo_selection azulejo_selection;

/// Options of azulejo_thin. What is selected follows from `order`, `radius` and `count`:
/// - any order, a radius: in the order of the cloud, each point that no selected one before it is
///   nearer to than the radius;
/// - any order, a count (and a radius): the points that the progressive order would select, in the
///   order of the cloud;
/// - progressive order: each next point is the farthest from those before, the lowest index on
///   ties, until there are `count` points, or no point is left that is at least `radius` from all
///   of them; all points if both are 0.
///
/// Any order with neither is refused.
typedef struct azulejo_thin_options {
    uint32_t struct_size; ///< The size of the struct in bytes; set by the _init function.
    uint32_t order; ///< An AZULEJO_ORDER_ constant; default any.
    double radius; ///< The smallest distance between two selected points, above 0; default 0: none.
    size_t count; ///< The number of points; default 0: none. A smaller cloud is selected whole.
    uint64_t seed; ///< It chooses the first point of the progressive order; default 0.
    azulejo_progress_fn progress; ///< Default NULL: the callback of the context, if it has one.
    void *progress_user; ///< Passed to the progress callback.
} azulejo_thin_options;

/// The report of azulejo_thin.
typedef struct azulejo_thin_report {
    uint32_t struct_size; ///< The size of the struct in bytes; set by the _init function.
    uint32_t reserved; ///< Always 0.
    uint64_t samples; ///< The number of selected points.
    /// No two selected points are closer: the radius by which they were selected, otherwise the
    /// smallest distance of two; infinite for fewer.
    double radius;
    double seconds; ///< Wall time in seconds.
} azulejo_thin_report;

azulejo_status azulejo_thin_options_init(azulejo_thin_options *options, size_t struct_size);

azulejo_status azulejo_thin_report_init(azulejo_thin_report *report, size_t struct_size);

/// Selects points of a cloud that are far from each other and near to all the others. With a
/// radius, the selected points are at least the radius apart; without a count, every other point is
/// nearer than the radius to one of them. Without a radius, no other point is farther from the
/// selected ones than any two of them are from each other, in progressive order for each prefix.
/// Distances are computed in double arithmetic from the floats, without tolerance.
/// - positions: the points, at most 2^32 - 1. They may coincide: by radius one of them is selected,
///   in the progressive order they come last.
/// - dimension: the number of coordinates of a point, 2 or 3.
/// - O(count * log(count)) time; at worst, in clouds made for it, O(count * selected). Up to 150
///   bytes of memory per point. Threads share the sorting of the points, not the selection.
azulejo_status azulejo_thin(const azulejo_context *context,
                            const azulejo_thin_options *options,
                            const float *positions,
                            size_t count,
                            uint32_t dimension,
                            azulejo_selection **out,
                            azulejo_thin_report *report);

/// The number of selected points.
size_t azulejo_selection_count(const azulejo_selection *selection);

/// The indices of the selected points in the cloud: ascending in any order, in the order of
/// selection in the progressive one.
const uint32_t *azulejo_selection_indices(const azulejo_selection *selection);

/// The ranks of the points of a progressive selection: the distance of each from the nearest of
/// those before it, rounded down to a float, so that all points with a rank of at least r are at
/// least r apart. They never rise; the first is infinite. NULL for AZULEJO_ORDER_ANY.
const float *azulejo_selection_ranks(const azulejo_selection *selection);

/// Frees the selection with its arrays.
void azulejo_selection_free(azulejo_selection *selection);

#ifdef __cplusplus
}
#endif

#endif
