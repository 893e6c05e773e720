/*
 * Volumes: maximal Poisson-disk sets of cuboids.
 * Generated from ffi/azulejo-c by cbindgen; do not edit. The conventions are in azulejo.h.
 */

#ifndef AZULEJO_VOLUME_H
#define AZULEJO_VOLUME_H

#include "base.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Options of azulejo_volume_sample.
typedef struct azulejo_volume_options {
    uint32_t struct_size; ///< The size of the struct in bytes; set by the _init function.
    uint32_t boundary; ///< An AZULEJO_BOUNDARY_ constant; default periodic.
    /// Above 0, and at least 64 float spacings; it may exceed the domain. It has no default.
    double radius;
    double domain_min[3]; ///< The lower corner of the domain, x y z; default 0 0 0.
    /// The upper corner, above the lower one on all axes; default 1 1 1. No side may be longer than
    /// 2^100 times another.
    double domain_max[3];
    uint64_t seed; ///< Any number; another seed gives another set. Default 0.
    azulejo_progress_fn progress; ///< Default NULL: the callback of the context, if it has one.
    void *progress_user; ///< Passed to the progress callback.
} azulejo_volume_options;

/// The report of azulejo_volume_sample.
typedef struct azulejo_volume_report {
    uint32_t struct_size; ///< The size of the struct in bytes; set by the _init function.
    uint32_t reserved; ///< Always 0.
    uint64_t samples; ///< The number of samples.
    double radius; ///< The radius of the set.
    double seconds; ///< Wall time in seconds.
} azulejo_volume_report;

/// Writes the defaults.
azulejo_status azulejo_volume_options_init(azulejo_volume_options *options,
                                           size_t struct_size);

/// Writes zeros and the size.
azulejo_status azulejo_volume_report_init(azulejo_volume_report *report, size_t struct_size);

/// Makes a maximal, conflict-free set of samples of a cuboid, x y z each: no place of it is farther
/// from every sample than the radius and 3.5 float spacings. On a torus about 0.7336 * volume /
/// radius^3 samples, up to 0.3 % more than by darts that are thrown one after the other; a bounded
/// cuboid has more, since samples stand on its faces. If a period of a torus is below the radius, a
/// sample does not conflict with its own image. Samples are sorted by blocks of 9 to 18 radii.
/// - O(samples) time and memory. Source: M. S. Ebeida et al., A Simple Algorithm for Maximal
///   Poisson-Disk Sampling in High Dimensions, 2012.
azulejo_status azulejo_volume_sample(const azulejo_context *context,
                                     const azulejo_volume_options *options,
                                     azulejo_points **out,
                                     azulejo_volume_report *report);

#ifdef __cplusplus
}
#endif

#endif
