/* Masks: blue-noise masks, and halftones by them.
 * Generated from ffi/azulejo-c by cbindgen; do not edit. The conventions are in azulejo.h. */

#ifndef AZULEJO_MASK_H
#define AZULEJO_MASK_H

#include "base.h"

#ifdef __cplusplus
extern "C" {
#endif

/// A blue-noise mask: a torus in each channel of which every pixel has a rank of its own.
typedef struct azulejo_mask azulejo_mask;

/// Options of azulejo_mask_create.
typedef struct azulejo_mask_options {
    uint32_t struct_size; ///< The size of the struct in bytes; set by the _init function.
    uint32_t channels; ///< The number of independent masks, 1 to 64; default 1.
    size_t width; ///< The pixels along x, 2 to 1024, or to 64 if depth is above 1; has no default.
    size_t height; ///< The pixels along y, 2 to 1024, or to 64 if depth is above 1; has no default.
    size_t depth; ///< The pixels along z, 1 to 64; default 1: a mask of the plane.
    uint64_t seed; ///< Another seed gives another mask; default 0.
    double sigma; ///< The standard deviation of the filter in pixels, 0.5 to 4; default 1.5.
    azulejo_progress_fn progress; ///< Default NULL: the callback of the context, if it has one.
    void *progress_user; ///< Passed to the progress callback.
} azulejo_mask_options;

/// The report of azulejo_mask_create.
typedef struct azulejo_mask_report {
    uint32_t struct_size; ///< The size of the struct in bytes; set by the _init function.
    uint32_t reserved; ///< Always 0.
    uint64_t pixels; ///< The pixels of a channel.
    uint64_t moves; ///< The moves that made the random initial patterns of all channels even.
    double seconds; ///< Wall time in seconds.
} azulejo_mask_report;

azulejo_status azulejo_mask_options_init(azulejo_mask_options *options, size_t struct_size);

azulejo_status azulejo_mask_report_init(azulejo_mask_report *report, size_t struct_size);

/// Makes a blue-noise mask by void and cluster (Ulichney 1993). The pixels whose ranks are below
/// any number are spread evenly over the torus and without a pattern. A mask of space has this in
/// all three axes together, not in slices.
/// - O(pixels * (s + log(pixels))) time for each channel, s being the pixels within six sigma of
///   one, about 400 in the plane and 6,000 in space; 16 bytes per pixel and channel, which threads
///   share.
azulejo_status azulejo_mask_create(const azulejo_context *context,
                                   const azulejo_mask_options *options,
                                   azulejo_mask **out,
                                   azulejo_mask_report *report);

/// The pixels along the axis 0, 1 or 2: the width, height or depth. 0 for other axes.
size_t azulejo_mask_size(const azulejo_mask *mask, uint32_t axis);

/// The number of channels.
size_t azulejo_mask_channels(const azulejo_mask *mask);

/// The ranks of all pixels, channel by channel; in a channel x grows first, then y, then z. Each
/// number from 0 to width * height * depth - 1 occurs once in a channel.
const uint32_t *azulejo_mask_ranks(const azulejo_mask *mask);

/// Writes the ranks as numbers in (0, 1), in the same order: (rank + 0.5) / (width * height *
/// depth), rounded to a float.
/// - out: channels * width * height * depth numbers.
azulejo_status azulejo_mask_values(const azulejo_mask *mask, float *out);

/// Dithers an image to few levels by ordered dithering. A number v becomes one of the levels beside
/// v * (levels - 1), the upper one where the fraction exceeds 1 - t, t being the mask's number at
/// the pixel. The mask is repeated over the image, and its channels over those of the image.
/// - image: the numbers of all pixels, 0 to 1, those of one pixel after each other; x grows first,
///   then y, then z. Light adds up only where numbers are linear, unlike those of sRGB.
/// - depth: 1 for an image of the plane.
/// - channels: the numbers of a pixel, at least 1.
/// - levels: 2 to 256.
/// - out: for each number its level, 0 to levels - 1, in the same order.
azulejo_status azulejo_mask_dither(const azulejo_mask *mask,
                                   const float *image,
                                   size_t width,
                                   size_t height,
                                   size_t depth,
                                   size_t channels,
                                   uint32_t levels,
                                   uint8_t *out);

/// azulejo_mask_dither for an image of numbers from 0 to 255.
azulejo_status azulejo_mask_dither_bytes(const azulejo_mask *mask,
                                         const uint8_t *image,
                                         size_t width,
                                         size_t height,
                                         size_t depth,
                                         size_t channels,
                                         uint32_t levels,
                                         uint8_t *out);

/// Frees the mask with its ranks.
void azulejo_mask_free(azulejo_mask *mask);

#ifdef __cplusplus
}
#endif

#endif
