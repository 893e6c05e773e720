/* Progress: on the calling thread, growing from 0 to 1; cancelling at the start, in the middle and at the end; callbacks
   that call the library. */

#include "watch.h"

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
    o.measure_covering_radius = 1;
    o.progress = tell;
    o.progress_user = w;
    return azulejo_kdrt_sample(context, &o, out, &report);
}

static azulejo_status counted(watch *w, azulejo_points **out) {
    azulejo_kdrt_options o = kdrt_options(0);
    azulejo_kdrt_report report = kdrt_report();
    o.count = 20000;
    o.measure_covering_radius = 1;
    o.progress = tell;
    o.progress_user = w;
    return azulejo_kdrt_sample(context, &o, out, &report);
}

static azulejo_status maximal(watch *w, azulejo_points **out) {
    azulejo_maximal_options o = maximal_options(0.05);
    o.progress = tell;
    o.progress_user = w;
    return azulejo_maximal_sample(context, &o, out, NULL);
}

static azulejo_status volume(watch *w, azulejo_points **out) {
    azulejo_volume_options o = volume_options(0.04);
    o.progress = tell;
    o.progress_user = w;
    return azulejo_volume_sample(context, &o, out, NULL);
}

static azulejo_status psp(watch *w, azulejo_points **out) {
    azulejo_psp_options o = psp_options(0.1);
    o.iterations = 1;
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

static uint32_t look_at_the_report(void *user, double done) {
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
    o.measure_covering_radius = 1;
    ACCEPTED(azulejo_kdrt_sample(context, &o, &points, &report));
    CHECK(seen.ones > 0 && seen.early == 0 && report.samples == azulejo_points_count(points) && report.covering_radius > 0);
    azulejo_points_free(points);

    before = report = kdrt_report();
    points = UNTOUCHED;
    o.progress = tell;
    o.progress_user = &w;
    REFUSED(AZULEJO_ERROR_CANCELLED, "cancelled", azulejo_kdrt_sample(context, &o, &points, &report));
    CHECK(points == UNTOUCHED && memcmp(&report, &before, sizeof report) == 0);

    points = NULL;
    o.measure_covering_radius = 0;
    o.progress_user = &sampling;
    ACCEPTED(azulejo_kdrt_sample(context, &o, &points, &report));
    CHECK(sampling.last == 1 && report.covering_radius == -1);
    azulejo_points_free(points);
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

/* A handle whose calls are cancelled goes on growing, to a set that is maximal up to some float spacings. */
static void a_psp_handle_survives_cancelling(void) {
    azulejo_psp_options o = psp_options(0.1);
    azulejo_psp *set = NULL;
    azulejo_psp_report report = psp_report();
    azulejo_points *points = NULL;
    azulejo_coverage_report coverage = coverage_report();
    double smallest = 0;
    const float *xyz;
    size_t count;
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
    count = azulejo_points_count(points);
    xyz = azulejo_points_positions(points);
    ACCEPTED(azulejo_space_smallest_distance(context, xyz, count, &smallest));
    CHECK(smallest >= 0.1);
    ACCEPTED(azulejo_mesh_coverage(context, cube, xyz, count, 0.1 + 6.0 / (1 << 24), &coverage));
    CHECK(coverage.gaps == 0);
    azulejo_points_free(points);
    azulejo_psp_free(set);
}

/* A callback that samples with the context of the call that it watches. */
static uint32_t sample_too(void *user, double done) {
    azulejo_kdrt_options o = kdrt_options(0.2);
    azulejo_points *points = NULL;
    (void)done;
    ACCEPTED(azulejo_kdrt_sample(context, &o, &points, NULL));
    *(size_t *)user += azulejo_points_count(points);
    azulejo_points_free(points);
    return 0;
}

/* A callback that wants more of the handle that is calling it. */
static uint32_t advance_too(void *user, double done) {
    azulejo_psp *set = *(azulejo_psp **)user;
    azulejo_points *points = UNTOUCHED;
    (void)done;
    REFUSED(AZULEJO_ERROR_BUSY, "psp: is in use", azulejo_psp_advance(set, 1, NULL));
    REFUSED(AZULEJO_ERROR_BUSY, "psp: is in use", azulejo_psp_fill(set, NULL));
    REFUSED(AZULEJO_ERROR_BUSY, "psp: is in use", azulejo_psp_points(set, &points));
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

int main(void) {
    uint32_t threads;
    random_points(random_xy, COUNT_OF(random_xy) / 2);
    cube = make_cube();
    for (threads = 1; threads <= 3; threads += 2) {
        context = make_context(threads);
        tells_and_stops(kdrt);
        tells_and_stops(covered);
        tells_and_stops(counted);
        tells_and_stops(scattered);
        the_one_comes_after_the_coverage();
        tells_and_stops(maximal);
        tells_and_stops(volume);
        tells_and_stops(psp);
        a_relaxation_returns_what_it_has();
        a_psp_handle_survives_cancelling();
        callbacks_that_call_back();
        azulejo_context_free(context);
    }
    azulejo_mesh_free(cube);
    return finish();
}
