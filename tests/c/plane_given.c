/* Sets of the plane around given samples: what new ones keep from them, windows and planes, and what is refused. */

#include <math.h>

#include "samples.h"

#define INVALID AZULEJO_ERROR_INVALID_ARGUMENT
#define GIVEN 400

static azulejo_context *context;
static float positions[GIVEN][2];
static double clearances[GIVEN];

static azulejo_kdrt_options around(double radius) {
    azulejo_kdrt_options options = kdrt_options(radius);
    options.leaf_size = 6;
    options.given_positions = &positions[0][0];
    options.given_clearances = clearances;
    options.given_count = GIVEN;
    return options;
}

static azulejo_points *sample(const azulejo_kdrt_options *options) {
    azulejo_points *points = NULL;
    if (!ACCEPTED(azulejo_kdrt_sample(context, options, &points, NULL))) exit(finish());
    return points;
}

/* The distance on the unit torus, of points anywhere. */
static double torus_distance(const float *a, const float *b) {
    double along[2];
    int axis;
    for (axis = 0; axis < 2; axis++) {
        along[axis] = fmod(fabs((double)a[axis] - b[axis]), 1);
        along[axis] = fmin(along[axis], 1 - along[axis]);
    }
    return sqrt(along[0] * along[0] + along[1] * along[1]);
}

static void sets(void) {
    azulejo_kdrt_options options = around(0.007);
    azulejo_points *points = sample(&options), *equal, *again = NULL;
    const double low[2] = {0.1, 0.3}, high[2] = {0.6, 0.5};
    azulejo_kdrt *plane = NULL;
    size_t i, j;
    CHECK(azulejo_points_count(points) > 1000);
    for (i = 0; i < azulejo_points_count(points); i++)
        for (j = 0; j < GIVEN; j++)
            CHECK(torus_distance(azulejo_points_positions(points) + 2 * i, positions[j]) >= clearances[j]);

    ACCEPTED(azulejo_kdrt_create(context, &options, &plane));
    ACCEPTED(azulejo_kdrt_window(plane, low, high, &again));
    CHECK(azulejo_points_count(again) > 100 && is_part(again, points, low[0], low[1], high[0], high[1]));
    azulejo_points_free(again);
    ACCEPTED(azulejo_kdrt_sample_window(context, &options, low, high, &again));
    CHECK(is_part(again, points, low[0], low[1], high[0], high[1]));
    azulejo_points_free(again);
    azulejo_kdrt_free(plane);

    /* Around a maximal set of the radius there is no place, with its clearances or without. */
    options.given_count = 0;
    equal = sample(&options);
    options.given_positions = azulejo_points_positions(equal);
    options.given_clearances = NULL;
    options.given_count = azulejo_points_count(equal);
    again = sample(&options);
    CHECK(azulejo_points_count(again) == 0);
    azulejo_points_free(again);
    azulejo_points_free(equal);
    azulejo_points_free(points);
}

static void refused(void) {
    azulejo_kdrt_options o;
    azulejo_points *out = UNTOUCHED;
    const float bad[2] = {0.5f, NAN};
    const double negative[2] = {0.5, -0.5}, endless[1] = {INFINITY};
#define NO_SET(status, part, change)                                           \
    do {                                                                       \
        o = around(0.1);                                                       \
        (void)(change);                                                        \
        REFUSED(status, part, azulejo_kdrt_sample(context, &o, &out, NULL));   \
        CHECK(out == UNTOUCHED);                                               \
    } while (0)
    NO_SET(INVALID, "given_positions", o.given_positions = NULL);
    NO_SET(INVALID, "given_positions: [0]", (o.given_positions = bad, o.given_count = 1));
    NO_SET(INVALID, "given_clearances: [1]", (o.given_clearances = negative, o.given_count = 2));
    NO_SET(INVALID, "given_clearances: [0]", (o.given_clearances = endless, o.given_count = 1));
    NO_SET(AZULEJO_ERROR_TOO_LARGE, "given_count", o.given_count = SIZE_MAX / 2);
    NO_SET(INVALID, "given_count", (o.radius = 0, o.count = 10));
#undef NO_SET
}

int main(void) {
    size_t i;
    context = make_context(2);
    /* Some outside of the domain, some in one place; clearances from 0 on. */
    for (i = 0; i < GIVEN; i++) {
        positions[i][0] = (float)(fmod((double)(i / 2 * 2) * 0.618034, 1.2) - 0.1);
        positions[i][1] = (float)(fmod((double)(i / 2 * 2) * 0.414214, 1.0));
        clearances[i] = 0.0001 * (double)(i % 300);
    }
    sets();
    refused();
    azulejo_context_free(context);
    return finish();
}
