/* Masks: ranks of all pixels, the same for any number of threads; halftones; each bad input is refused with a message that
   names it, leaving the output alone. */

#include <math.h>

#include "samples.h"

#define INVALID AZULEJO_ERROR_INVALID_ARGUMENT

static azulejo_context *one, *three;

static azulejo_mask_options mask_options(size_t width, size_t height) {
    azulejo_mask_options options;
    ACCEPTED(azulejo_mask_options_init(&options, sizeof options));
    options.width = width;
    options.height = height;
    return options;
}

static void makes(void) {
    enum { WIDTH = 40, HEIGHT = 30, DEPTH = 2, CHANNELS = 2, PIXELS = WIDTH * HEIGHT * DEPTH };
    static float values[CHANNELS * PIXELS];
    static char seen[PIXELS];
    azulejo_mask_options o = mask_options(WIDTH, HEIGHT);
    azulejo_mask_report report;
    azulejo_mask *mask = NULL, *again = NULL;
    const uint32_t *ranks;
    size_t i;
    ACCEPTED(azulejo_mask_report_init(&report, sizeof report));
    o.depth = DEPTH;
    o.channels = CHANNELS;
    o.seed = 7;
    if (!ACCEPTED(azulejo_mask_create(one, &o, &mask, &report))) return;
    CHECK(report.pixels == PIXELS && report.moves > 0 && report.seconds > 0);
    CHECK(azulejo_mask_size(mask, 0) == WIDTH && azulejo_mask_size(mask, 1) == HEIGHT);
    CHECK(azulejo_mask_size(mask, 2) == DEPTH && azulejo_mask_size(mask, 3) == 0);
    CHECK(azulejo_mask_channels(mask) == CHANNELS);
    ranks = azulejo_mask_ranks(mask);
    ACCEPTED(azulejo_mask_values(mask, values));
    for (i = 0; i < CHANNELS * PIXELS; i++) {
        const char turn = (char)(1 + i / PIXELS);
        CHECK(ranks[i] < PIXELS && seen[ranks[i]] == turn - 1);
        seen[ranks[i]] = turn;
        CHECK(values[i] == (float)(((double)ranks[i] + 0.5) / PIXELS));
    }
    if (ACCEPTED(azulejo_mask_create(three, &o, &again, NULL))) {
        CHECK(memcmp(azulejo_mask_ranks(again), ranks, CHANNELS * PIXELS * sizeof *ranks) == 0);
    }
    azulejo_mask_free(again);
    azulejo_mask_free(mask);
    CHECK(azulejo_mask_channels(NULL) == 0 && azulejo_mask_size(NULL, 0) == 0 && azulejo_mask_ranks(NULL) == NULL);
    azulejo_mask_free(NULL);
}

static void dithers(void) {
    enum { SIZE = 32, NUMBERS = SIZE * SIZE * 3 };
    static float image[NUMBERS];
    static uint8_t bytes[NUMBERS], out[NUMBERS];
    const azulejo_mask_options o = mask_options(16, 16);
    azulejo_mask *mask = NULL;
    size_t i, ones[3] = {0, 0, 0};
    if (!ACCEPTED(azulejo_mask_create(one, &o, &mask, NULL))) return;
    for (i = 0; i < NUMBERS; i++) {
        image[i] = 0.25f * (float)(i % 3 + 1);
        bytes[i] = (uint8_t)(i % 3 * 127.5);
    }
    ACCEPTED(azulejo_mask_dither(mask, image, SIZE, SIZE, 1, 3, 2, out));
    for (i = 0; i < NUMBERS; i++) ones[i % 3] += out[i];
    CHECK(ones[0] == SIZE * SIZE / 4 && ones[1] == SIZE * SIZE / 2 && ones[2] == SIZE * SIZE * 3 / 4);
    ACCEPTED(azulejo_mask_dither_bytes(mask, bytes, SIZE, SIZE, 1, 3, 256, out));
    CHECK(memcmp(out, bytes, sizeof out) == 0);

    memset(out, 9, sizeof out);
    REFUSED(INVALID, "mask", azulejo_mask_dither(NULL, image, 2, 2, 1, 1, 2, out));
    REFUSED(INVALID, "image", azulejo_mask_dither(mask, NULL, 2, 2, 1, 1, 2, out));
    REFUSED(INVALID, "out", azulejo_mask_dither(mask, image, 2, 2, 1, 1, 2, NULL));
    REFUSED(INVALID, "levels: 1 ", azulejo_mask_dither(mask, image, 2, 2, 1, 1, 1, out));
    REFUSED(INVALID, "levels: 257 ", azulejo_mask_dither_bytes(mask, bytes, 2, 2, 1, 1, 257, out));
    REFUSED(INVALID, "channels: 0", azulejo_mask_dither(mask, image, 2, 2, 1, 0, 2, out));
    REFUSED(AZULEJO_ERROR_TOO_LARGE, "image", azulejo_mask_dither(mask, image, SIZE_MAX, 2, 1, 1, 2, out));
    image[5] = NAN;
    REFUSED(INVALID, "image: [5] is NaN", azulejo_mask_dither(mask, image, 3, 2, 1, 1, 2, out));
    for (i = 0; i < sizeof out; i++) CHECK(out[i] == 9);
    REFUSED(INVALID, "out", azulejo_mask_values(mask, NULL));
    azulejo_mask_free(mask);
}

static uint32_t cancels(void *user, double fraction) {
    (void)user;
    return fraction > 0.3;
}

static void refused(void) {
    const azulejo_mask_options good = mask_options(64, 64);
    azulejo_mask_options bad = good;
    azulejo_mask *out = UNTOUCHED;
    REFUSED(INVALID, "context", azulejo_mask_create(NULL, &good, &out, NULL));
    REFUSED(INVALID, "options", azulejo_mask_create(one, NULL, &out, NULL));
    REFUSED(INVALID, "out", azulejo_mask_create(one, &good, NULL, NULL));
    bad.width = 0;
    REFUSED(INVALID, "width: 0 ", azulejo_mask_create(one, &bad, &out, NULL));
    bad = good;
    bad.height = 1025;
    REFUSED(INVALID, "height: 1025 ", azulejo_mask_create(one, &bad, &out, NULL));
    bad = good;
    bad.depth = 65;
    REFUSED(INVALID, "depth: 65 ", azulejo_mask_create(one, &bad, &out, NULL));
    bad = good;
    bad.channels = 0;
    REFUSED(INVALID, "channels: 0 ", azulejo_mask_create(one, &bad, &out, NULL));
    bad = good;
    bad.sigma = NAN;
    REFUSED(INVALID, "sigma: NaN ", azulejo_mask_create(one, &bad, &out, NULL));
    bad = good;
    bad.struct_size = 8;
    REFUSED(INVALID, "struct_size", azulejo_mask_create(one, &bad, &out, NULL));
    bad = good;
    bad.progress = cancels;
    REFUSED(AZULEJO_ERROR_CANCELLED, "cancelled", azulejo_mask_create(one, &bad, &out, NULL));
    CHECK(out == UNTOUCHED);
}

int main(void) {
    one = make_context(1);
    three = make_context(3);
    makes();
    dithers();
    refused();
    azulejo_context_free(one);
    azulejo_context_free(three);
    return finish();
}
