/* Progress: on the calling thread, growing from 0 to 1; cancelling at the start, in the middle and at the end; callbacks
   that call the library. */

#include <pthread.h>

#include "samples.h"

/* What a callback saw, and when it is to cancel. */
typedef struct {
    double limit; /* cancels from here on; above 1: never */
    double first, last;
    int calls, falls, late, strangers;
    pthread_t thread;
} watch;

static int32_t tell(void *user, double done) {
    watch *w = user;
    if (w->calls++ == 0) w->first = done;
    w->falls += done < w->last;
    w->late += w->last >= w->limit;
    w->strangers += !pthread_equal(w->thread, pthread_self());
    w->last = done;
    return done >= w->limit ? 42 : 0;
}

static watch make_watch(double limit) {
    watch w = {limit, -1, -1, 0, 0, 0, 0, pthread_self()};
    return w;
}

static azulejo_context *context;
static azulejo_mesh *cube;
static float random_xy[400];

/* The calls with progress, each made with a watch. */
typedef azulejo_status (*watched_call)(watch *, azulejo_points **);

static azulejo_status kdrt(watch *w, azulejo_points **out) {
    azulejo_kdrt_options o = kdrt_options(0.02);
    o.progress = tell;
    o.progress_user = w;
    return azulejo_kdrt_sample(context, &o, out, NULL);
}

/* With the coverage of the report measured, which is part of the call. */
static azulejo_status covered(watch *w, azulejo_points **out) {
    azulejo_kdrt_options o = kdrt_options(0.02);
    azulejo_kdrt_report report = kdrt_report();
    o.measure_coverage = 1;
    o.progress = tell;
    o.progress_user = w;
    return azulejo_kdrt_sample(context, &o, out, &report);
}

static azulejo_status counted(watch *w, azulejo_points **out) {
    azulejo_kdrt_options o = kdrt_options(0);
    azulejo_kdrt_report report = kdrt_report();
    o.count = 20000;
    o.measure_coverage = 1;
    o.progress = tell;
    o.progress_user = w;
    return azulejo_kdrt_sample(context, &o, out, &report);
}

static azulejo_status maximal(watch *w, azulejo_points **out) {
    azulejo_maximal_options o = maximal_options(0.05);
    o.progress = tell;
    o.progress_user = w;
    return azulejo_maximal_sample(context, &o, out);
}

static azulejo_status psp(watch *w, azulejo_points **out) {
    azulejo_psp_options o = psp_options(0.1);
    o.progress = tell;
    o.progress_user = w;
    return azulejo_psp_sample(context, cube, &o, out, NULL);
}

static azulejo_status scattered(watch *w, azulejo_points **out) {
    static const float image[4] = {1, 2, 3, 4};
    azulejo_dcr_options o = dcr_options(20);
    azulejo_density density;
    ACCEPTED(azulejo_density_init(&density, sizeof density));
    density.values = image;
    density.width = density.height = 2;
    o.progress = tell;
    o.progress_user = w;
    return azulejo_dcr_scatter(context, &o, &density, 3000, out);
}

static azulejo_status dcr(watch *w, azulejo_points **out) {
    azulejo_dcr_options o = dcr_options(20);
    o.progress = tell;
    o.progress_user = w;
    return azulejo_dcr_relax(context, &o, random_xy, COUNT_OF(random_xy) / 2, out, NULL);
}

static void tells_and_stops(watched_call call) {
    const double limits[] = {0, 0.3, 0.6, 1};
    azulejo_points *points = NULL;
    watch w = make_watch(2);
    size_t i;
    ACCEPTED(call(&w, &points));
    CHECK(azulejo_points_count(points) > 0);
    CHECK(w.first == 0 && w.last == 1 && w.falls == 0 && w.strangers == 0);
    azulejo_points_free(points);

    for (i = 0; i < COUNT_OF(limits); i++) {
        points = UNTOUCHED;
        w = make_watch(limits[i]);
        REFUSED(AZULEJO_ERROR_CANCELLED, "cancelled", call(&w, &points));
        CHECK(points == UNTOUCHED);
        CHECK(w.late == 0 && w.strangers == 0);
    }
}

/* What a callback sees of a call whose report is not written yet. */
typedef struct {
    const azulejo_kdrt_report *report;
    int ones, early;
} writing;

static int32_t look_at_the_report(void *user, double done) {
    writing *w = user;
    w->ones += done == 1;
    w->early += w->report->samples != 0;
    return 0;
}

/* The 1 comes once, after the coverage is measured; a call that is cancelled then has written nothing. */
static void the_one_comes_after_the_coverage(void) {
    azulejo_kdrt_options o = kdrt_options(0.02);
    azulejo_kdrt_report report = kdrt_report(), before;
    azulejo_points *points = NULL;
    watch w = make_watch(1), sampling = make_watch(2);
    writing seen = {&report, 0, 0};
    o.progress = look_at_the_report;
    o.progress_user = &seen;
    o.measure_coverage = 1;
    ACCEPTED(azulejo_kdrt_sample(context, &o, &points, &report));
    CHECK(seen.ones > 0 && seen.early == 0 && report.samples == azulejo_points_count(points) && report.coverage > 0);
    azulejo_points_free(points);

    before = report = kdrt_report();
    points = UNTOUCHED;
    o.progress = tell;
    o.progress_user = &w;
    REFUSED(AZULEJO_ERROR_CANCELLED, "cancelled", azulejo_kdrt_sample(context, &o, &points, &report));
    CHECK(points == UNTOUCHED && memcmp(&report, &before, sizeof report) == 0);

    points = NULL;
    o.measure_coverage = 0;
    o.progress_user = &sampling;
    ACCEPTED(azulejo_kdrt_sample(context, &o, &points, &report));
    CHECK(sampling.last == 1 && report.coverage == -1);
    azulejo_points_free(points);
}

/* The calls without options, which tell the callback of their context. */
typedef azulejo_status (*measuring_call)(const azulejo_context *);

static const double low[2] = {0, 0}, high[2] = {1, 1};
static float many_xy[6000], cube_xyz[3000], cube_normals[3000];

static azulejo_status smallest(const azulejo_context *c) {
    double distance;
    return azulejo_plane_smallest_distance(c, PLANE(many_xy, COUNT_OF(many_xy) / 2, low, high, 0), &distance);
}

static azulejo_status covering(const azulejo_context *c) {
    double radius;
    return azulejo_plane_covering_radius(c, PLANE(many_xy, COUNT_OF(many_xy) / 2, low, high, 1), &radius);
}

static azulejo_status plane(const azulejo_context *c) {
    azulejo_plane_report report = plane_report();
    return azulejo_plane_measure(c, PLANE(many_xy, COUNT_OF(many_xy) / 2, low, high, 0), &report);
}

static azulejo_status plane_gaps(const azulejo_context *c) {
    azulejo_coverage_report coverage = coverage_report();
    return azulejo_plane_coverage(c, PLANE(many_xy, COUNT_OF(many_xy) / 2, low, high, 0), 0.02, &coverage);
}

static azulejo_status nearest(const azulejo_context *c) {
    uint64_t histogram[20];
    return azulejo_plane_nearest_histogram(c, PLANE(many_xy, COUNT_OF(many_xy) / 2, low, high, 0), 2, 20, histogram);
}

static azulejo_status distribution(const azulejo_context *c) {
    double density[20];
    return azulejo_plane_radial_distribution(c, PLANE(many_xy, COUNT_OF(many_xy) / 2, low, high, 0), 4, 20, density);
}

static azulejo_status spectrum(const azulejo_context *c) {
    azulejo_spectrum *made = UNTOUCHED;
    const azulejo_status status =
        azulejo_spectrum_create(c, PLANE(many_xy, COUNT_OF(many_xy) / 2, low, high, 0), 200, 1, &made);
    if (status == AZULEJO_OK) azulejo_spectrum_free(made);
    else CHECK(made == UNTOUCHED);
    return status;
}

static azulejo_status space(const azulejo_context *c) {
    double distance;
    return azulejo_space_smallest_distance(c, cube_xyz, COUNT_OF(cube_xyz) / 3, &distance);
}

static azulejo_status uncovered(const azulejo_context *c) {
    double share;
    return azulejo_mesh_uncovered_fraction(c, cube, cube_xyz, COUNT_OF(cube_xyz) / 3, 0.1, 20000, 1, &share);
}

static azulejo_status surface_gaps(const azulejo_context *c) {
    azulejo_coverage_report coverage = coverage_report();
    return azulejo_mesh_coverage(c, cube, cube_xyz, COUNT_OF(cube_xyz) / 3, 0.1, &coverage);
}

static azulejo_status differences(const azulejo_context *c) {
    const double direction[3] = {1, 0, 0};
    azulejo_differences *made = UNTOUCHED;
    const azulejo_status status = azulejo_differences_create(c, cube, cube_xyz, cube_normals, COUNT_OF(cube_xyz) / 3,
                                                             direction, 1, &made);
    if (status == AZULEJO_OK) azulejo_differences_free(made);
    else CHECK(made == UNTOUCHED);
    return status;
}

/* Cancels at a certain call, which must be the last. */
typedef struct {
    int calls, last;
} stop;

static int32_t stop_there(void *user, double done) {
    stop *s = user;
    CHECK(done >= 0 && done <= 1);
    CHECK(s->calls < s->last);
    return ++s->calls == s->last;
}

/* At every call of the callback; with threads, which call as often as time allows, at the first ones. */
static void measuring_tells_and_stops(measuring_call call) {
    azulejo_context *watching = NULL;
    watch w = make_watch(2);
    stop s = {0, 0};
    int last, step;
    ACCEPTED(azulejo_context_watch(context, tell, &w, &watching));
    CHECK(azulejo_context_num_threads(watching) == azulejo_context_num_threads(context));
    ACCEPTED(call(watching));
    CHECK(w.first == 0 && w.last == 1 && w.falls == 0 && w.strangers == 0 && w.calls >= 2);
    ACCEPTED(call(context));
    azulejo_context_free(watching);

    last = azulejo_context_num_threads(context) > 1 ? 2 : w.calls;
    step = 1 + last / 50;
    ACCEPTED(azulejo_context_watch(context, stop_there, &s, &watching));
    for (s.last = 1; s.last <= last; s.last += step) {
        s.calls = 0;
        REFUSED(AZULEJO_ERROR_CANCELLED, "cancelled", call(watching));
        CHECK(s.calls == s.last);
    }
    azulejo_context_free(watching);
}

/* Calls with options tell the callback of these, or that of the context if there is none; a psp handle keeps it. */
static void contexts_that_are_watched(void) {
    azulejo_maximal_options o = maximal_options(0.1);
    azulejo_psp_options psp = psp_options(0.2);
    azulejo_context *first = make_context(2), *watching = NULL, *again = UNTOUCHED;
    azulejo_points *points = NULL;
    azulejo_psp *set = NULL;
    watch of_context = make_watch(2), own = make_watch(2);
    ACCEPTED(azulejo_context_watch(first, tell, &of_context, &watching));
    azulejo_context_free(first);
    ACCEPTED(azulejo_maximal_sample(watching, &o, &points));
    CHECK(of_context.first == 0 && of_context.last == 1);
    azulejo_points_free(points);

    of_context = make_watch(2);
    o.progress = tell;
    o.progress_user = &own;
    ACCEPTED(azulejo_maximal_sample(watching, &o, &points));
    CHECK(of_context.calls == 0 && own.last == 1);
    azulejo_points_free(points);

    ACCEPTED(azulejo_psp_create(watching, cube, &psp, &set));
    ACCEPTED(azulejo_context_watch(watching, NULL, NULL, &again));
    azulejo_context_free(watching);
    of_context = make_watch(0);
    REFUSED(AZULEJO_ERROR_CANCELLED, "cancelled", azulejo_psp_advance(set, 1, NULL));
    CHECK(of_context.calls == 1);
    azulejo_psp_free(set);

    ACCEPTED(smallest(again));
    CHECK(of_context.calls == 1);
    azulejo_context_free(again);

    again = UNTOUCHED;
    REFUSED(AZULEJO_ERROR_INVALID_ARGUMENT, "context", azulejo_context_watch(NULL, tell, &own, &again));
    CHECK(again == UNTOUCHED);
    REFUSED(AZULEJO_ERROR_INVALID_ARGUMENT, "out", azulejo_context_watch(context, tell, &own, NULL));
}

/* A relaxation that is cancelled succeeds, with what it has. */
static void a_relaxation_returns_what_it_has(void) {
    const double limits[] = {0, 0.3, 0.6, 1};
    azulejo_dcr_options o = dcr_options(20);
    azulejo_dcr_report report = dcr_report();
    azulejo_points *points = NULL;
    watch w = make_watch(2);
    uint32_t before = 0;
    size_t i;
    ACCEPTED(dcr(&w, &points));
    CHECK(w.first == 0 && w.last == 1 && w.falls == 0 && w.strangers == 0);
    azulejo_points_free(points);

    o.progress = tell;
    o.progress_user = &w;
    for (i = 0; i < COUNT_OF(limits); i++) {
        const size_t count = COUNT_OF(random_xy) / 2;
        w = make_watch(limits[i]);
        if (!ACCEPTED(azulejo_dcr_relax(context, &o, random_xy, count, &points, &report))) continue;
        CHECK(azulejo_points_count(points) == count && w.late == 0 && w.strangers == 0);
        CHECK(report.stopped == AZULEJO_STOPPED_CANCELLED);
        CHECK(report.iterations >= before && report.iterations <= 20 && (i > 0 || report.iterations == 0));
        before = report.iterations;
        azulejo_points_free(points);
    }
    CHECK(before == 20);
}

/* A handle whose calls are cancelled goes on growing, to the same guarantees. */
static void a_psp_handle_survives_cancelling(void) {
    azulejo_psp_options o = psp_options(0.1);
    azulejo_psp *set = NULL;
    azulejo_psp_report report = psp_report();
    azulejo_points *points = NULL;
    double smallest = 0, uncovered = 1;
    watch w = make_watch(2);
    o.progress = tell;
    o.progress_user = &w;
    ACCEPTED(azulejo_psp_create(context, cube, &o, &set));

    w = make_watch(0);
    REFUSED(AZULEJO_ERROR_CANCELLED, "cancelled", azulejo_psp_advance(set, 1, NULL));
    w = make_watch(0.4);
    REFUSED(AZULEJO_ERROR_CANCELLED, "cancelled", azulejo_psp_advance(set, 3, NULL));
    w = make_watch(1);
    REFUSED(AZULEJO_ERROR_CANCELLED, "cancelled", azulejo_psp_fill(set, NULL));
    w = make_watch(2);
    ACCEPTED(azulejo_psp_advance(set, 1, &report));
    CHECK(w.first == 0 && w.last == 1 && w.falls == 0 && w.strangers == 0);
    CHECK(report.iterations == 1);
    w = make_watch(2);
    ACCEPTED(azulejo_psp_fill(set, &report));
    CHECK(w.first == 0 && w.last == 1 && w.falls == 0 && w.strangers == 0);

    ACCEPTED(azulejo_psp_points(set, &points));
    CHECK(report.samples == azulejo_points_count(points));
    ACCEPTED(azulejo_space_smallest_distance(context, azulejo_points_positions(points), azulejo_points_count(points),
                                             &smallest));
    ACCEPTED(azulejo_mesh_uncovered_fraction(context, cube, azulejo_points_positions(points),
                                             azulejo_points_count(points), 0.1, 20000, 1, &uncovered));
    CHECK(smallest >= 0.1);
    CHECK(uncovered == 0);
    azulejo_points_free(points);
    azulejo_psp_free(set);
}

/* A callback that samples with the context of the call that it watches. */
static int32_t sample_too(void *user, double done) {
    azulejo_kdrt_options o = kdrt_options(0.2);
    azulejo_points *points = NULL;
    (void)done;
    ACCEPTED(azulejo_kdrt_sample(context, &o, &points, NULL));
    *(size_t *)user += azulejo_points_count(points);
    azulejo_points_free(points);
    return 0;
}

/* A callback that wants more of the handle that is calling it. */
static int32_t advance_too(void *user, double done) {
    azulejo_psp *set = *(azulejo_psp **)user;
    azulejo_points *points = UNTOUCHED;
    (void)done;
    REFUSED(AZULEJO_ERROR_INVALID_ARGUMENT, "psp", azulejo_psp_advance(set, 1, NULL));
    REFUSED(AZULEJO_ERROR_INVALID_ARGUMENT, "psp", azulejo_psp_fill(set, NULL));
    REFUSED(AZULEJO_ERROR_INVALID_ARGUMENT, "psp", azulejo_psp_points(set, &points));
    CHECK(points == UNTOUCHED);
    return 0;
}

static void callbacks_that_call_back(void) {
    azulejo_kdrt_options kdrt = kdrt_options(0.1);
    azulejo_psp_options o = psp_options(0.2);
    azulejo_points *points = NULL;
    azulejo_psp *set = NULL;
    size_t inner = 0;

    kdrt.progress = sample_too;
    kdrt.progress_user = &inner;
    ACCEPTED(azulejo_kdrt_sample(context, &kdrt, &points, NULL));
    CHECK(inner > 0);
    azulejo_points_free(points);

    o.progress = advance_too;
    o.progress_user = &set;
    ACCEPTED(azulejo_psp_create(context, cube, &o, &set));
    ACCEPTED(azulejo_psp_advance(set, 1, NULL));
    azulejo_psp_free(set);
}

static const measuring_call measuring[] = {smallest,     covering, plane, plane_gaps, nearest,      distribution,
                                           spectrum,     space,    uncovered, surface_gaps, differences};

int main(void) {
    uint32_t threads;
    size_t i;
    random_points(random_xy, COUNT_OF(random_xy) / 2);
    random_points(many_xy, COUNT_OF(many_xy) / 2);
    random_points(cube_xyz, COUNT_OF(cube_xyz) / 2);
    for (i = 2; i < COUNT_OF(cube_normals); i += 3) cube_normals[i] = 1;
    cube = make_cube();
    for (threads = 1; threads <= 3; threads += 2) {
        context = make_context(threads);
        tells_and_stops(kdrt);
        tells_and_stops(covered);
        tells_and_stops(counted);
        tells_and_stops(scattered);
        the_one_comes_after_the_coverage();
        tells_and_stops(maximal);
        tells_and_stops(psp);
        a_relaxation_returns_what_it_has();
        a_psp_handle_survives_cancelling();
        callbacks_that_call_back();
        for (i = 0; i < COUNT_OF(measuring); i++) measuring_tells_and_stops(measuring[i]);
        contexts_that_are_watched();
        azulejo_context_free(context);
    }
    azulejo_mesh_free(cube);
    return finish();
}
