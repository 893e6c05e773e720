/* DCR with a density: images and functions, what is returned, bad arguments, callbacks on one thread and on several. */

#include <math.h>
#include <pthread.h>

#include "samples.h"

#define INVALID AZULEJO_ERROR_INVALID_ARGUMENT
#define COUNT 1200

static azulejo_context *context, *one;
static const float image[6] = {0, 1, 3, 0, 1, 3}; /* two rows alike: white, light, dark */
static float xy[2 * COUNT];

static azulejo_density with_image(void) {
    azulejo_density density;
    ACCEPTED(azulejo_density_init(&density, sizeof density));
    density.values = image;
    density.width = 3;
    density.height = 2;
    return density;
}

/* What a callback is to give beyond x = 0.9, unless 0, and who called it. */
typedef struct {
    double bad;
    pthread_t thread;
    int strangers, calls;
} guest;

static double ramp(void *user, const double position[2]) {
    guest *g = user;
    if (!pthread_equal(g->thread, pthread_self())) __atomic_add_fetch(&g->strangers, 1, __ATOMIC_RELAXED);
    __atomic_add_fetch(&g->calls, 1, __ATOMIC_RELAXED);
    return g->bad != 0 && position[0] > 0.9 ? g->bad : position[0];
}

static azulejo_density with_function(guest *g, double bad) {
    azulejo_density density;
    ACCEPTED(azulejo_density_init(&density, sizeof density));
    g->bad = bad;
    g->thread = pthread_self();
    g->strangers = g->calls = 0;
    density.function = ramp;
    density.function_user = g;
    return density;
}

static azulejo_dcr_options bounded(uint32_t steps) {
    azulejo_dcr_options options = dcr_options(steps);
    options.boundary = AZULEJO_BOUNDARY_BOUNDED;
    return options;
}

static double share_left_of(const azulejo_points *points, double x) {
    size_t i, found = 0;
    for (i = 0; i < azulejo_points_count(points); i++) found += azulejo_points_positions(points)[2 * i] < x;
    return (double)found / (double)azulejo_points_count(points);
}

static void an_image(void) {
    azulejo_density density = with_image();
    azulejo_dcr_options options = bounded(100);
    azulejo_points *start = NULL, *same = NULL, *points = NULL, *again = NULL;
    azulejo_dcr_report report = dcr_report();
    CHECK(density.struct_size == sizeof density && density.reserved == 0);
    CHECK(density.function == NULL && density.function_user == NULL);
    ACCEPTED(azulejo_dcr_scatter(context, &options, &density, COUNT, &start));
    ACCEPTED(azulejo_dcr_scatter(one, &options, &density, COUNT, &same));
    CHECK(azulejo_points_count(start) == COUNT && same_points(start, same));
    memcpy(xy, azulejo_points_positions(start), sizeof xy);
    ACCEPTED(azulejo_dcr_relax_density(context, &options, &density, xy, COUNT, &points, &report));
    ACCEPTED(azulejo_dcr_relax_density(one, &options, &density, xy, COUNT, &again, NULL));
    CHECK(same_points(points, again));
    CHECK(report.rho > 0.7 && report.rho < 1.1 && report.relative_covering_radius < 1 && report.iterations > 0);
    /* Linear between the centres of the pixels: the left half has an eighth. */
    CHECK(fabs(share_left_of(points, 0.5) - 0.125) < 0.01);
    CHECK(share_left_of(points, 1.0 / 6) < 0.005);
    azulejo_points_free(start);
    azulejo_points_free(same);
    azulejo_points_free(points);
    azulejo_points_free(again);
}

static void a_function(void) {
    guest g, alone;
    azulejo_density density = with_function(&g, 0), serial = with_function(&alone, 0);
    azulejo_dcr_options options = bounded(60);
    azulejo_points *points = NULL, *again = NULL;
    random_points(xy, COUNT);
    ACCEPTED(azulejo_dcr_relax_density(context, &options, &density, xy, COUNT, &points, NULL));
    ACCEPTED(azulejo_dcr_relax_density(one, &options, &serial, xy, COUNT, &again, NULL));
    CHECK(same_points(points, again));
    CHECK(g.strangers > 0 && g.calls == alone.calls);
    CHECK(alone.strangers == 0); /* one thread: the caller's */
    CHECK(fabs(share_left_of(points, 0.5) - 0.25) < 0.02);
    azulejo_points_free(points);
    azulejo_points_free(again);
}

static void nothing_and_one(void) {
    azulejo_density density = with_image();
    azulejo_dcr_options options = bounded(10);
    azulejo_points *points = NULL;
    const float single[2] = {0.25f, 0.75f};
    ACCEPTED(azulejo_dcr_relax_density(context, &options, &density, NULL, 0, &points, NULL));
    CHECK(azulejo_points_count(points) == 0);
    azulejo_points_free(points);
    ACCEPTED(azulejo_dcr_scatter(context, &options, &density, 0, &points));
    CHECK(azulejo_points_count(points) == 0);
    azulejo_points_free(points);
    ACCEPTED(azulejo_dcr_relax_density(context, &options, &density, single, 1, &points, NULL));
    CHECK(memcmp(azulejo_points_positions(points), single, sizeof single) == 0);
    azulejo_points_free(points);
}

static void bad_arguments(void) {
    azulejo_density good = with_image();
    azulejo_dcr_options options = bounded(5);
    azulejo_points *points = UNTOUCHED;
    azulejo_dcr_report report, before;
    const float bad_images[4][6] = {
        {0, 0, 0, 0, 0, 0}, {1, 1, 1, 1, -1, 1}, {1, NAN, 1, 1, 1, 1}, {1, 1, INFINITY, 1, 1, 1}};
    guest g;
    int i;
    UNWRITTEN(report);
    before = report;
    random_points(xy, 8);
#define RELAX(context, options, density, xy, count, out) \
    azulejo_dcr_relax_density(context, options, density, xy, count, out, &report)
    REFUSED(INVALID, "context", RELAX(NULL, &options, &good, xy, 4, &points));
    REFUSED(INVALID, "options", RELAX(context, NULL, &good, xy, 4, &points));
    REFUSED(INVALID, "density", RELAX(context, &options, NULL, xy, 4, &points));
    REFUSED(INVALID, "positions", RELAX(context, &options, &good, NULL, 4, &points));
    REFUSED(INVALID, "out", RELAX(context, &options, &good, xy, 4, NULL));
    REFUSED(AZULEJO_ERROR_TOO_LARGE, "count", RELAX(context, &options, &good, xy, SIZE_MAX, &points));
    REFUSED(INVALID, "context", azulejo_dcr_scatter(NULL, &options, &good, 4, &points));
    REFUSED(INVALID, "options", azulejo_dcr_scatter(context, NULL, &good, 4, &points));
    REFUSED(INVALID, "density", azulejo_dcr_scatter(context, &options, NULL, 4, &points));
    REFUSED(INVALID, "out", azulejo_dcr_scatter(context, &options, &good, 4, NULL));
    REFUSED(AZULEJO_ERROR_TOO_LARGE, "count", azulejo_dcr_scatter(context, &options, &good, SIZE_MAX, &points));
    REFUSED(INVALID, "density", azulejo_density_init(NULL, sizeof good));
    REFUSED(INVALID, "struct_size", azulejo_density_init(&good, 8));
    good = with_image();

#define DENSITY(status, part, start, change)                                            \
    do {                                                                                \
        azulejo_density d = start;                                                      \
        (void)(change);                                                                 \
        REFUSED(status, part, RELAX(context, &options, &d, xy, 4, &points));            \
        REFUSED(status, part, azulejo_dcr_scatter(one, &options, &d, 4, &points));      \
    } while (0)
    DENSITY(INVALID, "struct_size", good, d.struct_size = 0);
    DENSITY(INVALID, "reserved: 1", good, d.reserved = 1);
    DENSITY(INVALID, "function: is NULL", good, d.values = NULL);
    DENSITY(INVALID, "function: is set", good, (d.function = ramp, d.function_user = &g));
    DENSITY(INVALID, "values", good, d.values = (const float *)((const char *)image + 1));
    DENSITY(INVALID, "width: 0", good, d.width = 0);
    DENSITY(INVALID, "height: 0", good, d.height = 0);
    DENSITY(AZULEJO_ERROR_TOO_LARGE, "width", good, d.width = SIZE_MAX);
    DENSITY(AZULEJO_ERROR_TOO_LARGE, "width", good, d.width = SIZE_MAX / 8);
    for (i = 0; i < 4; i++) DENSITY(INVALID, "density", good, d.values = bad_images[i]);
    DENSITY(INVALID, "width: 3 has no effect with function", with_function(&g, 0), d.width = 3);
    DENSITY(INVALID, "height: 2 has no effect with function", with_function(&g, 0), d.height = 2);
    DENSITY(INVALID, "density: -1.0", with_function(&g, -1), 0);
    DENSITY(INVALID, "density: NaN", with_function(&g, NAN), 0);
    DENSITY(INVALID, "density: inf", with_function(&g, INFINITY), 0);
#undef DENSITY
    options.neighbourhood = AZULEJO_NEIGHBOURHOOD_NEAREST;
    REFUSED(INVALID, "neighbourhood", RELAX(context, &options, &good, xy, 4, &points));
    options = bounded(5);
    options.method = AZULEJO_METHOD_THESIS;
    REFUSED(INVALID, "method", RELAX(context, &options, &good, xy, 4, &points));
#undef RELAX
    CHECK(points == UNTOUCHED);
    CHECK(memcmp(&report, &before, sizeof report) == 0);
}

static uint32_t stop(void *user, double done) { return done >= *(double *)user; }

static void cancelled(void) {
    azulejo_density density = with_image();
    azulejo_dcr_options options = bounded(50);
    double limits[3] = {0, 0.5, 1};
    int i;
    random_points(xy, COUNT);
    for (i = 0; i < 3; i++) {
        azulejo_points *points = UNTOUCHED;
        options.progress = stop;
        options.progress_user = &limits[i];
        REFUSED(AZULEJO_ERROR_CANCELLED, "cancelled", azulejo_dcr_scatter(context, &options, &density, COUNT, &points));
        REFUSED(AZULEJO_ERROR_CANCELLED, "cancelled", azulejo_dcr_scatter(one, &options, &density, COUNT, &points));
        CHECK(points == UNTOUCHED);
    }
    for (i = 0; i < 3; i++) {
        azulejo_points *points = NULL;
        azulejo_dcr_report report = dcr_report();
        options.progress = stop;
        options.progress_user = &limits[i];
        ACCEPTED(azulejo_dcr_relax_density(context, &options, &density, xy, COUNT, &points, &report));
        CHECK(report.stopped == AZULEJO_STOPPED_CANCELLED && azulejo_points_count(points) == COUNT);
        CHECK((memcmp(azulejo_points_positions(points), xy, sizeof xy) == 0) == (i == 0));
        azulejo_points_free(points);
    }
}

int main(void) {
    context = make_context(3);
    one = make_context(1);
    an_image();
    a_function();
    nothing_and_one();
    bad_arguments();
    cancelled();
    azulejo_context_free(one);
    azulejo_context_free(context);
    return finish();
}
