/* Thinning: points in one place, no points, cancelling; each bad input is refused with a message that names it, leaving the
   output alone. */

#include <math.h>

#include "samples.h"

#define INVALID AZULEJO_ERROR_INVALID_ARGUMENT
#define POINTS 2000

static azulejo_context *one, *four;
static float cloud[POINTS * 3];

static void small_clouds(void) {
    const float same[8] = {3, 4, 3, 4, 3, 4, 3, 4};
    azulejo_thin_options options = thin_options(0, 10, AZULEJO_ORDER_PROGRESSIVE);
    azulejo_selection *selection = NULL;
    size_t i;
    ACCEPTED(azulejo_thin(four, &options, same, 4, 2, &selection, NULL));
    CHECK(azulejo_selection_count(selection) == 4);
    for (i = 1; i < 4; i++) CHECK(azulejo_selection_ranks(selection)[i] == 0);
    azulejo_selection_free(selection);
    options.radius = 1e-30;
    ACCEPTED(azulejo_thin(one, &options, same, 4, 2, &selection, NULL));
    CHECK(azulejo_selection_count(selection) == 1);
    azulejo_selection_free(selection);
    ACCEPTED(azulejo_thin(one, &options, NULL, 0, 3, &selection, NULL));
    CHECK(selection != NULL && azulejo_selection_count(selection) == 0);
    CHECK(azulejo_selection_indices(selection) == NULL && azulejo_selection_ranks(selection) == NULL);
    azulejo_selection_free(selection);
    CHECK(azulejo_selection_count(NULL) == 0 && azulejo_selection_indices(NULL) == NULL);
    CHECK(azulejo_selection_ranks(NULL) == NULL);
    azulejo_selection_free(NULL);
}

static void refused(void) {
    const float xyz[6] = {0, 1, 2, 3, 4, NAN}, *misaligned = (const float *)((const char *)xyz + 2);
    const azulejo_thin_options good = thin_options(0.1, 0, AZULEJO_ORDER_ANY);
    azulejo_thin_options bad = good;
    azulejo_selection *out = UNTOUCHED;
    REFUSED(INVALID, "context", azulejo_thin(NULL, &good, xyz, 1, 3, &out, NULL));
    REFUSED(INVALID, "options", azulejo_thin(one, NULL, xyz, 1, 3, &out, NULL));
    REFUSED(INVALID, "positions: is NULL", azulejo_thin(one, &good, NULL, 1, 3, &out, NULL));
    REFUSED(INVALID, "positions: ", azulejo_thin(one, &good, misaligned, 1, 3, &out, NULL));
    REFUSED(INVALID, "out", azulejo_thin(one, &good, xyz, 1, 3, NULL, NULL));
    REFUSED(INVALID, "dimension: 1 is", azulejo_thin(one, &good, xyz, 1, 1, &out, NULL));
    REFUSED(INVALID, "dimension: 4 is", azulejo_thin(one, &good, xyz, 1, 4, &out, NULL));
    REFUSED(INVALID, "positions: point 1 is [3.0, 4.0, NaN]", azulejo_thin(one, &good, xyz, 2, 3, &out, NULL));
    REFUSED(INVALID, "positions: point 2 is [4.0, NaN]", azulejo_thin(one, &good, xyz, 3, 2, &out, NULL));
    REFUSED(AZULEJO_ERROR_TOO_LARGE, "count", azulejo_thin(one, &good, xyz, SIZE_MAX / 8, 3, &out, NULL));
    bad.radius = -1;
    REFUSED(INVALID, "radius: -1", azulejo_thin(one, &bad, xyz, 1, 3, &out, NULL));
    bad.radius = NAN;
    REFUSED(INVALID, "radius: NaN", azulejo_thin(one, &bad, xyz, 1, 3, &out, NULL));
    bad.radius = 0;
    REFUSED(INVALID, "radius: 0", azulejo_thin(one, &bad, xyz, 1, 3, &out, NULL));
    bad.order = 2;
    REFUSED(INVALID, "order: 2 is no", azulejo_thin(one, &bad, xyz, 1, 3, &out, NULL));
    bad = good;
    bad.struct_size = 8;
    REFUSED(INVALID, "struct_size", azulejo_thin(one, &bad, xyz, 1, 3, &out, NULL));
    CHECK(out == UNTOUCHED);
}

static uint32_t stop_at(void *user, double done) { return done >= *(const double *)user; }

static void cancelled(const azulejo_context *context) {
    double limits[] = {0, 0.2, 0.6, 1};
    azulejo_selection *out = UNTOUCHED;
    size_t i;
    for (i = 0; i < COUNT_OF(limits); i++) {
        azulejo_thin_options options = thin_options(0, 0, AZULEJO_ORDER_PROGRESSIVE);
        options.progress = stop_at;
        options.progress_user = &limits[i];
        REFUSED(AZULEJO_ERROR_CANCELLED, "cancelled", azulejo_thin(context, &options, cloud, POINTS, 3, &out, NULL));
    }
    CHECK(out == UNTOUCHED);
}

int main(void) {
    uint32_t state = 1;
    size_t i;
    for (i = 0; i < COUNT_OF(cloud); i++) {
        state = state * 1664525u + 1013904223u;
        cloud[i] = (float)(state >> 8) / (1 << 24);
    }
    one = make_context(1);
    four = make_context(4);
    small_clouds();
    refused();
    cancelled(one);
    cancelled(four);
    azulejo_context_free(one);
    azulejo_context_free(four);
    return finish();
}
