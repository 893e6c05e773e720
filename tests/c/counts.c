/* Bad input to sets of exactly N samples, and where there is no such thing. */

#include <math.h>

#include "samples.h"

#define INVALID AZULEJO_ERROR_INVALID_ARGUMENT

static azulejo_context *context;

static azulejo_kdrt_options of_count(uint64_t count) {
    azulejo_kdrt_options options = kdrt_options(0);
    options.count = count;
    return options;
}

/* A call that fails writes neither of its outputs. */
static void refused(const azulejo_kdrt_options *options, azulejo_status status, const char *part) {
    azulejo_points *out = UNTOUCHED;
    azulejo_kdrt_report report, before;
    UNWRITTEN(report);
    before = report;
    REFUSED(status, part, azulejo_kdrt_sample(context, options, &out, &report));
    CHECK(out == UNTOUCHED && memcmp(&report, &before, sizeof report) == 0);
    REFUSED(status, part, azulejo_kdrt_sample(context, options, &out, NULL));
    CHECK(out == UNTOUCHED);
}

static void pointers(void) {
    const azulejo_kdrt_options good = of_count(100);
    azulejo_points *out = UNTOUCHED;
    azulejo_kdrt_report report = kdrt_report();
    REFUSED(INVALID, "context", azulejo_kdrt_sample(NULL, &good, &out, &report));
    REFUSED(INVALID, "options", azulejo_kdrt_sample(context, NULL, &out, &report));
    REFUSED(INVALID, "out", azulejo_kdrt_sample(context, &good, NULL, &report));
    CHECK(out == UNTOUCHED);
    ACCEPTED(azulejo_kdrt_sample(context, &good, &out, NULL));
    CHECK(azulejo_points_count(out) == 100);
    azulejo_points_free(out);
}

static void options(void) {
    azulejo_kdrt_options o;
#define COUNTED(status, part, change) (o = of_count(100), (void)(change), refused(&o, status, part))
    COUNTED(INVALID, "radius", o.count = 0); /* neither */
    COUNTED(INVALID, "count: 100 samples and radius 0.1 are asked for at once", o.radius = 0.1);
    COUNTED(INVALID, "count", o.radius = -0.1);
    COUNTED(INVALID, "count", o.radius = NAN);
    COUNTED(INVALID, "domain_min", o.domain_min[0] = NAN);
    COUNTED(INVALID, "domain_max", o.domain_max[1] = -1);
    COUNTED(INVALID, "boundary", o.boundary = 2);
    COUNTED(INVALID, "leaf_size", o.leaf_size = 5.99);
    /* Floats around a million are 1/16 apart. */
    COUNTED(INVALID, "count: 100 asks for a radius", (o.domain_min[0] = 1e6, o.domain_max[0] = 1e6 + 1));
    COUNTED(AZULEJO_ERROR_TOO_LARGE, "count", o.count = UINT64_MAX);
    COUNTED(AZULEJO_ERROR_TOO_LARGE, "count", o.count = (uint64_t)1 << 40);
#undef COUNTED
}

static uint32_t never_visited(void *user, const float *xy, size_t count) {
    (void)xy, (void)count;
    ++*(int *)user;
    return 0;
}

/* Parts of a set are made without the rest, so nobody can know how many samples there are. */
static void windows_and_streams(void) {
    const double low[2] = {0.25, 0.5}, high[2] = {0.75, 1};
    azulejo_kdrt_options counted = of_count(100), both = kdrt_options(0.1);
    azulejo_points *out = UNTOUCHED;
    int visits = 0;
    both.count = 100;
    REFUSED(INVALID, "count: 100 is not 0", azulejo_kdrt_sample_window(context, &counted, low, high, &out, NULL));
    REFUSED(INVALID, "count: 100 is not 0", azulejo_kdrt_sample_window(context, &both, low, high, &out, NULL));
    REFUSED(INVALID, "count: 100 is not 0", azulejo_kdrt_stream(context, &counted, never_visited, &visits, NULL));
    REFUSED(INVALID, "count: 100 is not 0", azulejo_kdrt_stream(context, &both, never_visited, &visits, NULL));
    CHECK(out == UNTOUCHED && visits == 0);
}

/* Coverage is measured for a report: where there is none the flag is refused, before any work. */
static void coverage_without_a_report(void) {
    const double low[2] = {0.25, 0.5}, high[2] = {0.75, 1};
    azulejo_kdrt_options o = kdrt_options(0.1), counted = of_count(100);
    azulejo_kdrt_report report;
    azulejo_points *out = UNTOUCHED;
    int visits = 0;
    o.measure_covering_radius = counted.measure_covering_radius = 1;
    REFUSED(INVALID, "measure_covering_radius: 1, but report is NULL", azulejo_kdrt_sample(context, &o, &out, NULL));
    REFUSED(INVALID, "measure_covering_radius: 1, but report is NULL", azulejo_kdrt_sample(context, &counted, &out, NULL));
    REFUSED(INVALID, "measure_covering_radius: 1", azulejo_kdrt_sample_window(context, &o, low, high, &out, NULL));
    REFUSED(INVALID, "measure_covering_radius: 1", azulejo_kdrt_stream(context, &o, never_visited, &visits, NULL));
    UNWRITTEN(report);
    o.measure_covering_radius = 2;
    REFUSED(INVALID, "measure_covering_radius: 2", azulejo_kdrt_sample(context, &o, &out, &report));
    REFUSED(INVALID, "measure_covering_radius: 2", azulejo_kdrt_sample_window(context, &o, low, high, &out, NULL));
    o.measure_covering_radius = 0;
    o.order = 2;
    REFUSED(INVALID, "order: 2", azulejo_kdrt_sample(context, &o, &out, &report));
    REFUSED(INVALID, "order: 2", azulejo_kdrt_sample_window(context, &o, low, high, &out, NULL));
    REFUSED(INVALID, "order: 2", azulejo_kdrt_stream(context, &o, never_visited, &visits, NULL));
    CHECK(out == UNTOUCHED && visits == 0);
}

int main(void) {
    context = make_context(2);
    pointers();
    options();
    windows_and_streams();
    coverage_without_a_report();
    azulejo_context_free(context);
    return finish();
}
