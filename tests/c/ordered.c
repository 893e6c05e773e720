/* Sets of meshes of exactly so many samples and in progressive order; bad input to both. */

#include <math.h>

#include "naive.h"
#include "samples.h"

#define INVALID AZULEJO_ERROR_INVALID_ARGUMENT

static azulejo_context *one, *four;
static azulejo_mesh *cube;

static azulejo_psp_options of_count(size_t count, uint32_t order) {
    azulejo_psp_options options = psp_options(0);
    options.count = count;
    options.order = order;
    return options;
}

static azulejo_points *sample(const azulejo_psp_options *options, azulejo_psp_report *report) {
    azulejo_points *points = NULL, *same = NULL;
    ACCEPTED(azulejo_psp_sample(one, cube, options, &points, report));
    ACCEPTED(azulejo_psp_sample(four, cube, options, &same, NULL));
    CHECK(same_points(points, same));
    azulejo_points_free(same);
    return points;
}

static double distance(const float *a, const float *b) {
    return sqrt(pow((double)a[0] - b[0], 2) + pow((double)a[1] - b[1], 2) + pow((double)a[2] - b[2], 2));
}

/* Whether the first samples cover the cube within a distance: by the crossings of circles, and azulejo says so, too. */
static int covers(const azulejo_points *points, size_t count, double within) {
    azulejo_coverage_report report = coverage_report();
    const float *at = azulejo_points_positions(points);
    ACCEPTED(azulejo_mesh_coverage(one, cube, at, count, 10, &report));
    return naive_gaps_of_cube(at, count, within + 1e-6) == 0 && report.covering_radius <= within + 1e-6;
}

static void counts(void) {
    const size_t numbers[] = {1, 2, 3, 10, 1000, 5432};
    size_t n, i, j;
    for (n = 0; n < COUNT_OF(numbers); n++) {
        const azulejo_psp_options options = of_count(numbers[n], AZULEJO_ORDER_ANY);
        azulejo_psp_report report = psp_report();
        azulejo_points *points = sample(&options, &report);
        const float *at = azulejo_points_positions(points);
        CHECK(azulejo_points_count(points) == numbers[n] && report.samples == numbers[n] && report.radius > 0);
        CHECK(azulejo_points_ranks(points) == NULL && report.coverage < 1.11 * report.radius);
        for (i = 0; i < numbers[n]; i++) {
            for (j = 0; j < i && distance(at + 3 * i, at + 3 * j) >= report.radius; j++) {}
            if (!CHECK(j == i)) break;
        }
        CHECK(covers(points, numbers[n], report.coverage));
        CHECK(!covers(points, numbers[n] - 1, report.radius - 2e-6));
        azulejo_points_free(points);
    }
}

static void order(void) {
    azulejo_psp_options options = of_count(3000, AZULEJO_ORDER_PROGRESSIVE);
    azulejo_psp_report report = psp_report();
    azulejo_points *points = sample(&options, &report), *fewer, *by_radius;
    const float *at = azulejo_points_positions(points), *ranks = azulejo_points_ranks(points);
    size_t i, j;
    if (!CHECK(azulejo_points_count(points) == 3000 && ranks != NULL && isinf(ranks[0]))) return;
    CHECK(report.radius == (double)ranks[2999] && report.coverage <= 1.0906 * report.radius);
    for (i = 1; i < 3000; i++) {
        for (j = 0; j < i && distance(at + 3 * i, at + 3 * j) >= (double)ranks[i]; j++) {}
        if (!CHECK(j == i && ranks[i] <= ranks[i - 1])) break;
    }
    for (i = 2; i < 3000; i += i / 2) {
        CHECK(covers(points, i, (i < 100 ? 2.0 : 1.0906) * (double)ranks[i - 1]));
    }
    options.count = 777;
    fewer = sample(&options, NULL);
    CHECK(azulejo_points_count(fewer) == 777);
    CHECK(memcmp(azulejo_points_positions(fewer), at, 777 * 3 * sizeof *at) == 0);
    CHECK(memcmp(azulejo_points_ranks(fewer), ranks, 777 * sizeof *ranks) == 0);
    options.count = 0;
    options.radius = report.radius;
    options.quotient = 1.3;
    by_radius = sample(&options, &report);
    CHECK(report.coverage == options.radius && report.radius == options.radius);
    CHECK(covers(by_radius, azulejo_points_count(by_radius), options.radius));
    azulejo_points_free(points);
    azulejo_points_free(fewer);
    azulejo_points_free(by_radius);
    CHECK(azulejo_points_ranks(NULL) == NULL);
}

static void refusals(void) {
    azulejo_psp_options o;
    azulejo_points *out = UNTOUCHED;
    azulejo_psp *psp = UNTOUCHED;
#define COUNTED(status, part, change) \
    (o = of_count(100, AZULEJO_ORDER_PROGRESSIVE), (void)(change), \
     REFUSED(status, part, azulejo_psp_sample(one, cube, &o, &out, NULL)))
    COUNTED(INVALID, "radius", o.count = 0);
    COUNTED(INVALID, "count: 100 samples and radius 0.1 are asked for at once", o.radius = 0.1);
    COUNTED(INVALID, "count", o.radius = NAN);
    COUNTED(INVALID, "order: 2", o.order = 2);
    COUNTED(INVALID, "quotient: 1.6", o.quotient = 1.6);
    COUNTED(INVALID, "quotient", o.quotient = NAN);
    COUNTED(INVALID, "quotient: 1.2 has no effect in any order", (o.order = AZULEJO_ORDER_ANY, o.quotient = 1.2));
    COUNTED(INVALID, "iterations: 1", o.iterations = 1);
    COUNTED(INVALID, "iterations: 1", (o.order = AZULEJO_ORDER_ANY, o.iterations = 1));
    COUNTED(INVALID, "maximal", (o.iterations = 0, o.maximal = 0));
    COUNTED(AZULEJO_ERROR_TOO_LARGE, "count", o.count = (size_t)1 << 40);
    COUNTED(AZULEJO_ERROR_TOO_LARGE, "count", o.count = SIZE_MAX);
#undef COUNTED
    o = of_count(100, AZULEJO_ORDER_ANY);
    REFUSED(INVALID, "count: 100 has no effect in azulejo_psp_create", azulejo_psp_create(one, cube, &o, &psp));
    o = psp_options(0.1);
    o.order = AZULEJO_ORDER_PROGRESSIVE;
    REFUSED(INVALID, "order: 1 has no effect in azulejo_psp_create", azulejo_psp_create(one, cube, &o, &psp));
    CHECK(out == UNTOUCHED && psp == UNTOUCHED);
}

int main(void) {
    one = make_context(1);
    four = make_context(4);
    cube = make_cube();
    counts();
    order();
    refusals();
    azulejo_mesh_free(cube);
    azulejo_context_free(one);
    azulejo_context_free(four);
    return finish();
}
