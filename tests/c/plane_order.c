/* Sets of the plane in progressive order: the ranks of prefixes, sets that are nested, exact counts, windows, and what
   is refused. */

#include <math.h>

#include "naive.h"
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

/* The distance on the unit torus. */
static double torus_distance(const float *a, const float *b) {
    double dx = fabs((double)a[0] - b[0]), dy = fabs((double)a[1] - b[1]);
    dx = fmin(dx, 1 - dx);
    dy = fmin(dy, 1 - dy);
    return sqrt(dx * dx + dy * dy);
}

/* The promise of some prefixes, by all pairs and by the crossings of circles, and by azulejo's own measure of coverage. */
static void prefixes(void) {
    azulejo_kdrt_options options = progressive(0.03);
    const double quotients[2] = {0, 1.3}, low[2] = {0, 0}, high[2] = {1, 1};
    int q;
    for (q = 0; q < 2; q++) {
        const double quotient = quotients[q] == 0 ? pow(2, 0.125) : quotients[q];
        azulejo_points *points;
        const float *xy, *ranks;
        size_t count, i, j;
        options.quotient = quotients[q];
        points = sample(&options, NULL);
        count = azulejo_points_count(points);
        xy = azulejo_points_positions(points);
        ranks = azulejo_points_ranks(points);
        if (!CHECK(count > 700 && ranks != NULL)) return;
        for (i = 1; i < count; i++) {
            CHECK(ranks[i] <= ranks[i - 1]);
            for (j = 0; j < i; j++) CHECK(torus_distance(xy + 2 * i, xy + 2 * j) >= ranks[i]);
        }
        for (i = 1; i <= count; i += 1 + i / 3) {
            const double bound = (i < 100 ? 2 : quotient) * ranks[i - 1] + 1e-6;
            double covering = 0;
            CHECK(i == 1 || naive_gaps_of_plane(xy, i, bound, low, high, 1) == 0);
            CHECK(i == 1 || naive_gaps_of_plane(xy, i - 1, ranks[i - 1] - 1e-6, low, high, 1) > 0);
            ACCEPTED(azulejo_plane_covering_radius(context, PLANE(xy, i, low, high, AZULEJO_BOUNDARY_PERIODIC), &covering));
            CHECK(covering <= bound);
        }
        azulejo_points_free(points);
    }
}

/* Whether one set begins with the other, with the same ranks. */
static int is_prefix(const azulejo_points *set, const azulejo_points *of) {
    const size_t count = azulejo_points_count(set);
    return count <= azulejo_points_count(of) &&
           memcmp(azulejo_points_positions(set), azulejo_points_positions(of), 2 * count * sizeof(float)) == 0 &&
           memcmp(azulejo_points_ranks(set), azulejo_points_ranks(of), count * sizeof(float)) == 0;
}

static void nested(void) {
    azulejo_kdrt_options options = progressive(0.04), by_count = progressive(0);
    azulejo_kdrt_report report = kdrt_report();
    azulejo_points *coarse = sample(&options, &report), *fine, *few, *many;
    CHECK(report.is_maximal == 1 && report.radius == 0.04 && report.samples == azulejo_points_count(coarse));
    options.radius = 0.01;
    fine = sample(&options, NULL);
    CHECK(is_prefix(coarse, fine));
    by_count.count = 123;
    few = sample(&by_count, &report);
    CHECK(azulejo_points_count(few) == 123 && report.samples == 123 && report.is_maximal == 0);
    CHECK(report.radius == azulejo_points_ranks(few)[122]);
    by_count.count = 1000;
    many = sample(&by_count, NULL);
    CHECK(azulejo_points_count(many) == 1000 && is_prefix(few, many));
    azulejo_points_free(coarse);
    azulejo_points_free(fine);
    azulejo_points_free(few);
    azulejo_points_free(many);
}

static void windows(void) {
    const double low[2] = {0.2, 0.7}, high[2] = {0.5, 0.9};
    azulejo_kdrt_options options = progressive(0.004);
    azulejo_points *whole, *window = NULL, *kept = NULL;
    azulejo_kdrt *plane = NULL;
    size_t i, inside = 0;
    const float *xy, *ranks;
    options.quotient = 1.4;
    options.coarsest = 0.006;
    options.leaf_size = 6;
    whole = sample(&options, NULL);
    ACCEPTED(azulejo_kdrt_sample_window(context, &options, low, high, &window));
    ACCEPTED(azulejo_kdrt_create(context, &options, &plane));
    ACCEPTED(azulejo_kdrt_window(plane, low, high, &kept));
    CHECK(azulejo_points_count(kept) == azulejo_points_count(window) && is_prefix(kept, window));
    xy = azulejo_points_positions(whole);
    ranks = azulejo_points_ranks(whole);
    for (i = 0; i < azulejo_points_count(whole); i++, xy += 2) {
        if (xy[0] < low[0] || xy[0] >= high[0] || xy[1] < low[1] || xy[1] >= high[1]) continue;
        if (!CHECK(inside < azulejo_points_count(window))) break;
        CHECK(memcmp(azulejo_points_positions(window) + 2 * inside, xy, 2 * sizeof *xy) == 0);
        CHECK(azulejo_points_ranks(window)[inside] == ranks[i]);
        inside++;
    }
    CHECK(inside > 1000 && inside == azulejo_points_count(window));
    azulejo_points_free(whole);
    azulejo_points_free(window);
    azulejo_points_free(kept);
    azulejo_kdrt_free(plane);
}

static int32_t never_visited(void *user, const float *xy, size_t count) {
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
    REFUSED(INVALID, "order", azulejo_kdrt_stream(context, &o, never_visited, NULL));
    o.order = AZULEJO_ORDER_ANY;
    out = sample(&o, NULL);
    CHECK(azulejo_points_ranks(out) == NULL && azulejo_points_ranks(NULL) == NULL);
    azulejo_points_free(out);
}

int main(void) {
    context = make_context(2);
    prefixes();
    nested();
    windows();
    refused();
    azulejo_context_free(context);
    return finish();
}
