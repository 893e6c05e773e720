/* Progress of calls without a callback of their own: those of the analysis, which have no options, and others, by the
   callback of their context. */

#include "watch.h"

static azulejo_context *context;
static azulejo_mesh *cube;

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

static uint32_t stop_there(void *user, double done) {
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
    ACCEPTED(azulejo_maximal_sample(watching, &o, &points, NULL));
    CHECK(of_context.first == 0 && of_context.last == 1);
    azulejo_points_free(points);

    of_context = make_watch(2);
    o.progress = tell;
    o.progress_user = &own;
    ACCEPTED(azulejo_maximal_sample(watching, &o, &points, NULL));
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

static const measuring_call measuring[] = {smallest,     covering, plane, plane_gaps, nearest,      distribution,
                                           spectrum,     space,    uncovered, surface_gaps, differences};

int main(void) {
    uint32_t threads;
    size_t i;
    random_points(many_xy, COUNT_OF(many_xy) / 2);
    random_points(cube_xyz, COUNT_OF(cube_xyz) / 2);
    for (i = 2; i < COUNT_OF(cube_normals); i += 3) cube_normals[i] = 1;
    cube = make_cube();
    for (threads = 1; threads <= 3; threads += 2) {
        context = make_context(threads);
        for (i = 0; i < COUNT_OF(measuring); i++) measuring_tells_and_stops(measuring[i]);
        contexts_that_are_watched();
        azulejo_context_free(context);
    }
    azulejo_mesh_free(cube);
    return finish();
}
