/* Sets of the plane in progressive order: what is refused. */

#include <math.h>

#include "samples.h"

#define INVALID AZULEJO_ERROR_INVALID_ARGUMENT

static azulejo_context *context;

static azulejo_kdrt_options progressive(double radius) {
    azulejo_kdrt_options options = kdrt_options(radius);
    options.order = AZULEJO_ORDER_PROGRESSIVE;
    return options;
}

static azulejo_points *sample(const azulejo_kdrt_options *options, azulejo_kdrt_report *report) {
    azulejo_points *points = NULL;
    if (!ACCEPTED(azulejo_kdrt_sample(context, options, &points, report))) exit(finish());
    return points;
}

static uint32_t never_visited(void *user, const float *xy, size_t count) {
    (void)user;
    (void)xy;
    (void)count;
    CHECK(!"visited");
    return 0;
}

static void refused(void) {
    azulejo_kdrt_options o;
    azulejo_points *out = UNTOUCHED;
#define NO_SET(part, change)                                                    \
    do {                                                                        \
        o = progressive(0.1);                                                   \
        (void)(change);                                                         \
        REFUSED(INVALID, part, azulejo_kdrt_sample(context, &o, &out, NULL));   \
        CHECK(out == UNTOUCHED);                                                \
    } while (0)
    NO_SET("order: 2", o.order = 2);
    NO_SET("quotient: 1.01", o.quotient = 1.01);
    NO_SET("quotient", o.quotient = 1.51);
    NO_SET("quotient", o.quotient = -1);
    NO_SET("quotient", o.quotient = NAN);
    NO_SET("coarsest", o.coarsest = 0.09);
    NO_SET("coarsest", o.coarsest = NAN);
    NO_SET("coarsest", (o.radius = 0, o.count = 5, o.coarsest = 0.05));
    NO_SET("quotient: 1.2 has no effect", (o.order = AZULEJO_ORDER_ANY, o.quotient = 1.2));
    NO_SET("coarsest: 1.0 has no effect", (o.order = AZULEJO_ORDER_ANY, o.coarsest = 1));
#undef NO_SET
    o = progressive(0.1);
    REFUSED(INVALID, "order", azulejo_kdrt_stream(context, &o, never_visited, NULL, NULL));
    o.order = AZULEJO_ORDER_ANY;
    out = sample(&o, NULL);
    CHECK(azulejo_points_ranks(out) == NULL && azulejo_points_ranks(NULL) == NULL);
    azulejo_points_free(out);
}

int main(void) {
    context = make_context(2);
    refused();
    azulejo_context_free(context);
    return finish();
}
