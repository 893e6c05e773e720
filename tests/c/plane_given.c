/* Sets of the plane around given samples: what is refused. */

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
    refused();
    azulejo_context_free(context);
    return finish();
}
