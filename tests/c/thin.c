/* Thinning: selections are what the definitions say, the same for any number of threads, and each bad input is refused
   with a message that names it, leaving the output alone. */

#include <math.h>

#include "samples.h"

#define INVALID AZULEJO_ERROR_INVALID_ARGUMENT
#define POINTS 2000

static azulejo_context *one, *four;
static float cloud[POINTS * 3];

static double distance(const float *a, const float *b, uint32_t dimensions) {
    double squared = 0;
    uint32_t axis;
    for (axis = 0; axis < dimensions; axis++) {
        const double difference = (double)a[axis] - (double)b[axis];
        squared += difference * difference;
    }
    return sqrt(squared);
}

static azulejo_selection *select_from(const azulejo_thin_options *options, size_t count, uint32_t dimensions) {
    azulejo_selection *selection = NULL, *same = NULL;
    ACCEPTED(azulejo_thin(one, options, cloud, count, dimensions, &selection));
    ACCEPTED(azulejo_thin(four, options, cloud, count, dimensions, &same));
    CHECK(azulejo_selection_count(selection) == azulejo_selection_count(same));
    CHECK(memcmp(azulejo_selection_indices(selection), azulejo_selection_indices(same),
                 azulejo_selection_count(selection) * sizeof(uint32_t)) == 0);
    azulejo_selection_free(same);
    return selection;
}

static void by_radius(uint32_t dimensions) {
    const double radius = dimensions == 2 ? 0.04 : 0.11;
    const azulejo_thin_options options = thin_options(radius, 0, AZULEJO_ORDER_ANY);
    azulejo_selection *selection = select_from(&options, POINTS, dimensions);
    const uint32_t *indices = azulejo_selection_indices(selection);
    const size_t count = azulejo_selection_count(selection);
    size_t kept = 0, i, j;
    for (i = 0; i < POINTS; i++) {
        for (j = 0; j < kept; j++) {
            if (distance(cloud + dimensions * indices[j], cloud + dimensions * i, dimensions) < radius) break;
        }
        if (j < kept) continue;
        if (!CHECK(kept < count && indices[kept] == i)) break;
        kept++;
    }
    CHECK(kept == count && count > 100 && count < POINTS / 2);
    CHECK(azulejo_selection_ranks(selection) == NULL);
    azulejo_selection_free(selection);
}

static void progressive(uint32_t dimensions) {
    azulejo_thin_options options = thin_options(0, 0, AZULEJO_ORDER_PROGRESSIVE);
    azulejo_selection *all = select_from(&options, POINTS, dimensions), *first;
    const uint32_t *indices = azulejo_selection_indices(all);
    const float *ranks = azulejo_selection_ranks(all);
    static double nearest[POINTS];
    size_t i, point;
    CHECK(azulejo_selection_count(all) == POINTS && isinf(ranks[0]));
    for (point = 0; point < POINTS; point++) nearest[point] = INFINITY;
    for (i = 0; i + 1 < POINTS; i++) {
        size_t farthest = indices[i];
        nearest[indices[i]] = -1;
        for (point = 0; point < POINTS; point++) {
            const double d = distance(cloud + dimensions * indices[i], cloud + dimensions * point, dimensions);
            if (d < nearest[point]) nearest[point] = d;
            if (nearest[point] > nearest[farthest]) farthest = point;
        }
        if (!CHECK(indices[i + 1] == farthest && ranks[i + 1] <= nearest[farthest] && ranks[i + 1] <= ranks[i])) break;
        CHECK(nextafterf(ranks[i + 1], INFINITY) > nearest[farthest]);
    }
    options.count = 300;
    first = select_from(&options, POINTS, dimensions);
    CHECK(azulejo_selection_count(first) == 300);
    CHECK(memcmp(azulejo_selection_indices(first), indices, 300 * sizeof *indices) == 0);
    azulejo_selection_free(first);
    options.radius = (double)ranks[100];
    first = select_from(&options, POINTS, dimensions);
    CHECK(azulejo_selection_count(first) > 100 && azulejo_selection_count(first) < 110);
    azulejo_selection_free(first);
    options.order = AZULEJO_ORDER_ANY;
    options.radius = 0;
    first = select_from(&options, POINTS, dimensions);
    CHECK(azulejo_selection_count(first) == 300 && azulejo_selection_ranks(first) == NULL);
    for (i = 1; i < 300; i++) CHECK(azulejo_selection_indices(first)[i - 1] < azulejo_selection_indices(first)[i]);
    azulejo_selection_free(first);
    azulejo_selection_free(all);
}

static void small_clouds(void) {
    const float same[8] = {3, 4, 3, 4, 3, 4, 3, 4};
    azulejo_thin_options options = thin_options(0, 10, AZULEJO_ORDER_PROGRESSIVE);
    azulejo_selection *selection = NULL;
    size_t i;
    ACCEPTED(azulejo_thin(four, &options, same, 4, 2, &selection));
    CHECK(azulejo_selection_count(selection) == 4);
    for (i = 1; i < 4; i++) CHECK(azulejo_selection_ranks(selection)[i] == 0);
    azulejo_selection_free(selection);
    options.radius = 1e-30;
    ACCEPTED(azulejo_thin(one, &options, same, 4, 2, &selection));
    CHECK(azulejo_selection_count(selection) == 1);
    azulejo_selection_free(selection);
    ACCEPTED(azulejo_thin(one, &options, NULL, 0, 3, &selection));
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
    REFUSED(INVALID, "context", azulejo_thin(NULL, &good, xyz, 1, 3, &out));
    REFUSED(INVALID, "options", azulejo_thin(one, NULL, xyz, 1, 3, &out));
    REFUSED(INVALID, "positions: is NULL", azulejo_thin(one, &good, NULL, 1, 3, &out));
    REFUSED(INVALID, "positions: ", azulejo_thin(one, &good, misaligned, 1, 3, &out));
    REFUSED(INVALID, "out", azulejo_thin(one, &good, xyz, 1, 3, NULL));
    REFUSED(INVALID, "dimensions: 1 is", azulejo_thin(one, &good, xyz, 1, 1, &out));
    REFUSED(INVALID, "dimensions: 4 is", azulejo_thin(one, &good, xyz, 1, 4, &out));
    REFUSED(INVALID, "positions: point 1 is [3.0, 4.0, NaN]", azulejo_thin(one, &good, xyz, 2, 3, &out));
    REFUSED(INVALID, "positions: point 2 is [4.0, NaN]", azulejo_thin(one, &good, xyz, 3, 2, &out));
    REFUSED(AZULEJO_ERROR_TOO_LARGE, "count", azulejo_thin(one, &good, xyz, SIZE_MAX / 8, 3, &out));
    bad.radius = -1;
    REFUSED(INVALID, "radius: -1", azulejo_thin(one, &bad, xyz, 1, 3, &out));
    bad.radius = NAN;
    REFUSED(INVALID, "radius: NaN", azulejo_thin(one, &bad, xyz, 1, 3, &out));
    bad.radius = 0;
    REFUSED(INVALID, "radius: 0", azulejo_thin(one, &bad, xyz, 1, 3, &out));
    bad.order = 2;
    REFUSED(INVALID, "order: 2 is no", azulejo_thin(one, &bad, xyz, 1, 3, &out));
    bad = good;
    bad.struct_size = 8;
    REFUSED(INVALID, "struct_size", azulejo_thin(one, &bad, xyz, 1, 3, &out));
    CHECK(out == UNTOUCHED);
}

static int32_t stop_at(void *user, double done) { return done >= *(const double *)user; }

static void cancelled(const azulejo_context *context) {
    double limits[] = {0, 0.2, 0.6, 1};
    azulejo_selection *out = UNTOUCHED;
    size_t i;
    for (i = 0; i < COUNT_OF(limits); i++) {
        azulejo_thin_options options = thin_options(0, 0, AZULEJO_ORDER_PROGRESSIVE);
        options.progress = stop_at;
        options.progress_user = &limits[i];
        REFUSED(AZULEJO_ERROR_CANCELLED, "cancelled", azulejo_thin(context, &options, cloud, POINTS, 3, &out));
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
    by_radius(2);
    by_radius(3);
    progressive(2);
    progressive(3);
    small_clouds();
    refused();
    cancelled(one);
    cancelled(four);
    azulejo_context_free(one);
    azulejo_context_free(four);
    return finish();
}
