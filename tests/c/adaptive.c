/* Samples whose radius varies: the rule on what is returned, bad arguments, callbacks on one thread and on several. */

#include <math.h>
#include <pthread.h>

#include "samples.h"

#define INVALID AZULEJO_ERROR_INVALID_ARGUMENT

static azulejo_context *context, *one;
static azulejo_mesh *cube;
static const float corner_radii[8] = {0.1f, 0.2f, 0.1f, 0.2f, 0.3f, 0.1f, 0.1f, 0.25f};

static azulejo_psp_adaptive_options with_vertices(void) {
    azulejo_psp_adaptive_options options;
    ACCEPTED(azulejo_psp_adaptive_options_init(&options, sizeof options));
    options.vertex_radii = corner_radii;
    options.vertex_count = 8;
    return options;
}

#define FINE 0.02

/* What a callback is to do, and who called it. */
typedef struct {
    double base; /* the radius at z = 0, twice as large at z = 1 */
    double bad;  /* given beyond x = 0.9; 0: nothing bad is */
    pthread_t thread;
    int strangers;
} guest;

static double fade(void *user, const double position[3]) {
    guest *g = user;
    if (!pthread_equal(g->thread, pthread_self())) __atomic_add_fetch(&g->strangers, 1, __ATOMIC_RELAXED);
    return g->bad != 0 && position[0] > 0.9 ? g->bad : g->base * (1 + position[2]);
}

static azulejo_psp_adaptive_options with_fading(guest *g, double base) {
    azulejo_psp_adaptive_options options;
    ACCEPTED(azulejo_psp_adaptive_options_init(&options, sizeof options));
    g->base = base;
    g->bad = 0;
    g->thread = pthread_self();
    g->strangers = 0;
    options.radius_function = fade;
    options.radius_function_user = g;
    options.smallest = base;
    options.largest = 2 * base;
    options.slope = base;
    return options;
}

static azulejo_psp_adaptive_options with_function(guest *g, double bad) {
    const azulejo_psp_adaptive_options options = with_fading(g, 0.1);
    g->bad = bad;
    return options;
}

/* The smallest distance of two samples over the mean of their radii; with a cosine, of those that see each other. */
static double closest(const azulejo_points *points, double cosine) {
    const float *p = azulejo_points_positions(points), *n = azulejo_points_normals(points);
    const double *r = azulejo_points_radii(points);
    const size_t count = azulejo_points_count(points);
    double least = INFINITY;
    size_t i, j, k;
    for (i = 0; i < count; i++)
        for (j = 0; j < i; j++) {
            double squared = 0, dot = 0;
            for (k = 0; k < 3; k++) {
                const double d = (double)p[3 * i + k] - p[3 * j + k];
                squared += d * d;
                dot += (double)n[3 * i + k] * n[3 * j + k];
            }
            if ((cosine == -1 || dot >= cosine) && sqrt(squared) < least * 0.5 * (r[i] + r[j]))
                least = sqrt(squared) / (0.5 * (r[i] + r[j]));
        }
    return least;
}

static void radii_of_vertices(void) {
    azulejo_psp_adaptive_options options = with_vertices();
    azulejo_points *points = NULL, *again = NULL, *apart = NULL;
    azulejo_psp_report report = psp_report();
    size_t i, wrong = 0;
    CHECK(options.struct_size == sizeof options && options.cosine == -1 && options.seed == 0);
    CHECK(options.radius_function == NULL && options.smallest == 0 && options.largest == 0 && options.slope == 0);

    ACCEPTED(azulejo_psp_adaptive_sample(context, cube, &options, &points, &report));
    CHECK(azulejo_points_count(points) > 100 && azulejo_points_count(points) == report.samples);
    CHECK(report.accepted == report.samples && report.darts == report.accepted + report.conflicts);
    CHECK(report.rays == 0 && report.hits == 0 && report.iterations == 0 && report.seconds >= 0);
    CHECK(closest(points, -1) >= 1 && closest(points, -1) < 1.2);
    for (i = 0; i < azulejo_points_count(points); i++) {
        const uint32_t *t = cube_indices[azulejo_points_triangles(points)[i]];
        const double u = azulejo_points_barycentrics(points)[2 * i], v = azulejo_points_barycentrics(points)[2 * i + 1];
        const double radius = (1 - u - v) * corner_radii[t[0]] + u * corner_radii[t[1]] + v * corner_radii[t[2]];
        wrong += fabs(azulejo_points_radii(points)[i] - radius) > 1e-15;
    }
    CHECK(wrong == 0);

    ACCEPTED(azulejo_psp_adaptive_sample(one, cube, &options, &again, NULL));
    CHECK(same_points(points, again));
    CHECK(memcmp(azulejo_points_radii(points), azulejo_points_radii(again), 8 * azulejo_points_count(points)) == 0);

    options.cosine = 0.5; /* each side of the cube for itself */
    ACCEPTED(azulejo_psp_adaptive_sample(context, cube, &options, &apart, NULL));
    CHECK(azulejo_points_count(apart) > azulejo_points_count(points));
    CHECK(closest(apart, 0.5) >= 1 && closest(apart, -1) < 0.9);

    azulejo_points_free(points);
    azulejo_points_free(again);
    azulejo_points_free(apart);
}

static void radii_by_position(void) {
    guest g, alone;
    /* As many samples as make work for more than one thread. */
    azulejo_psp_adaptive_options options = with_fading(&g, FINE), serial = with_fading(&alone, FINE);
    azulejo_points *points = NULL, *again = NULL;
    size_t i, wrong = 0;
    ACCEPTED(azulejo_psp_adaptive_sample(context, cube, &options, &points, NULL));
    ACCEPTED(azulejo_psp_adaptive_sample(one, cube, &serial, &again, NULL));
    CHECK(same_points(points, again));
    CHECK(g.strangers > 0);
    CHECK(alone.strangers == 0); /* one thread: the caller's */
    CHECK(closest(points, -1) >= 1);
    for (i = 0; i < azulejo_points_count(points); i++)
        wrong += azulejo_points_radii(points)[i] != FINE * (1 + (double)azulejo_points_positions(points)[3 * i + 2]);
    CHECK(wrong == 0);
    azulejo_points_free(points);
    azulejo_points_free(again);
}

/* Ranks are what the radii of a prefix are multiplied by; the whole set has the radii themselves. */
static void order(void) {
    azulejo_psp_adaptive_options options = with_vertices();
    azulejo_points *points = NULL, *again = NULL;
    azulejo_psp_report report = psp_report();
    const float *p, *ranks;
    const double *r;
    size_t i, j, k, count;
    options.order = AZULEJO_ORDER_PROGRESSIVE;
    ACCEPTED(azulejo_psp_adaptive_sample(context, cube, &options, &points, &report));
    ACCEPTED(azulejo_psp_adaptive_sample(one, cube, &options, &again, NULL));
    p = azulejo_points_positions(points);
    r = azulejo_points_radii(points);
    ranks = azulejo_points_ranks(points);
    count = azulejo_points_count(points);
    if (!CHECK(ranks != NULL && count > 100 && count == report.samples)) return;
    CHECK(same_points(points, again) && memcmp(ranks, azulejo_points_ranks(again), count * sizeof *ranks) == 0);
    CHECK(report.radius == 1 && report.covering_radius == 1 && isinf(ranks[0]) && ranks[count - 1] >= 1);
    for (i = 1; i < count; i++)
        for (j = 0; j < i; j++) {
            double squared = 0;
            for (k = 0; k < 3; k++) squared += pow((double)p[3 * i + k] - p[3 * j + k], 2);
            if (!CHECK(ranks[i] <= ranks[j] && sqrt(squared) >= (double)ranks[i] * 0.5 * (r[i] + r[j]))) return;
        }
    azulejo_points_free(again);
    options.order = AZULEJO_ORDER_ANY;
    ACCEPTED(azulejo_psp_adaptive_sample(context, cube, &options, &again, NULL));
    CHECK(azulejo_points_ranks(again) == NULL);
    azulejo_points_free(points);
    azulejo_points_free(again);
}

static void no_radii(void) {
    azulejo_kdrt_options plane = kdrt_options(0.1);
    azulejo_psp_options uniform = psp_options(0.3);
    azulejo_points *points = NULL;
    CHECK(azulejo_points_radii(NULL) == NULL);
    ACCEPTED(azulejo_kdrt_sample(context, &plane, &points, NULL));
    CHECK(azulejo_points_radii(points) == NULL);
    azulejo_points_free(points);
    ACCEPTED(azulejo_psp_sample(context, cube, &uniform, &points, NULL));
    CHECK(azulejo_points_radii(points) == NULL);
    azulejo_points_free(points);
}

static void bad_arguments(void) {
    azulejo_psp_adaptive_options good = with_vertices();
    azulejo_points *points = UNTOUCHED;
    azulejo_psp_report report, before;
    const float bad_radii[5][8] = {{0, 1, 1, 1, 1, 1, 1, 1},
                                   {1, -1, 1, 1, 1, 1, 1, 1},
                                   {1, 1, NAN, 1, 1, 1, 1, 1},
                                   {1, 1, 1, INFINITY, 1, 1, 1, 1},
                                   {1, 1, 1, 1, 1e-7f, 1, 1, 1}};
    const float tiny[8] = {4e-6f, 4e-6f, 4e-6f, 4e-6f, 4e-6f, 4e-6f, 4e-6f, 4e-6f};
    const double clearances[2] = {0.1, -2};
    guest g;
    int i;
    UNWRITTEN(report);
    before = report;
    REFUSED(INVALID, "context", azulejo_psp_adaptive_sample(NULL, cube, &good, &points, &report));
    REFUSED(INVALID, "mesh", azulejo_psp_adaptive_sample(context, NULL, &good, &points, &report));
    REFUSED(INVALID, "options", azulejo_psp_adaptive_sample(context, cube, NULL, &points, &report));
    REFUSED(INVALID, "out", azulejo_psp_adaptive_sample(context, cube, &good, NULL, &report));
    REFUSED(INVALID, "options", azulejo_psp_adaptive_options_init(NULL, sizeof good));

#define ADAPTIVE(status, part, start, change)                                                             \
    do {                                                                                                  \
        azulejo_psp_adaptive_options o = start;                                                               \
        (void)(change);                                                                                   \
        REFUSED(status, part, azulejo_psp_adaptive_sample(context, cube, &o, &points, &report));          \
        REFUSED(status, part, azulejo_psp_adaptive_sample(one, cube, &o, &points, &report));              \
    } while (0)
    ADAPTIVE(INVALID, "struct_size", good, o.struct_size = 0);
    ADAPTIVE(INVALID, "order: 2 is no AZULEJO_ORDER_", good, o.order = 2);
    ADAPTIVE(INVALID, "quotient: 1.2 has no effect in any order", good, o.quotient = 1.2);
    ADAPTIVE(INVALID, "quotient: 1.01", good, (o.order = AZULEJO_ORDER_PROGRESSIVE, o.quotient = 1.01));
    ADAPTIVE(INVALID, "quotient: 1.6", good, (o.order = AZULEJO_ORDER_PROGRESSIVE, o.quotient = 1.6));
    ADAPTIVE(INVALID, "quotient", good, (o.order = AZULEJO_ORDER_PROGRESSIVE, o.quotient = NAN));
    ADAPTIVE(INVALID, "radius_function: is NULL", good, o.vertex_radii = NULL);
    ADAPTIVE(INVALID, "radius_function: is set", good, (o.radius_function = fade, o.radius_function_user = &g));
    ADAPTIVE(INVALID, "vertex_radii", good, o.vertex_radii = (const float *)((const char *)corner_radii + 1));
    ADAPTIVE(INVALID, "vertex_count: 7", good, o.vertex_count = 7);
    ADAPTIVE(INVALID, "vertex_count: 0", good, o.vertex_count = 0);
    ADAPTIVE(AZULEJO_ERROR_TOO_LARGE, "vertex_count", good, o.vertex_count = SIZE_MAX);
    for (i = 0; i < 5; i++) ADAPTIVE(INVALID, "vertex_radii", good, o.vertex_radii = bad_radii[i]);
    ADAPTIVE(AZULEJO_ERROR_TOO_LARGE, "vertex_radii", good, o.vertex_radii = tiny);
    ADAPTIVE(INVALID, "given_clearances", good, (o.given_positions = cube_positions[0], o.given_count = 8));
    ADAPTIVE(INVALID, "given_positions: is NULL", good, (o.given_clearances = clearances, o.given_count = 1));
    ADAPTIVE(INVALID, "given_clearances: [1] is -2.0", good,
             (o.given_positions = cube_positions[0], o.given_clearances = clearances, o.given_count = 2));
    ADAPTIVE(AZULEJO_ERROR_TOO_LARGE, "given_count", good,
             (o.given_positions = cube_positions[0], o.given_clearances = clearances, o.given_count = SIZE_MAX));
    ADAPTIVE(INVALID, "cosine", good, o.cosine = NAN);
    ADAPTIVE(INVALID, "cosine", good, o.cosine = 1.01);
    ADAPTIVE(INVALID, "cosine", good, o.cosine = -1.01);

    ADAPTIVE(INVALID, "smallest: 0.1 has no effect with vertex_radii", good, o.smallest = 0.1);
    ADAPTIVE(INVALID, "largest: 0.3 has no effect with vertex_radii", good, o.largest = 0.3);
    ADAPTIVE(INVALID, "slope: 0.5 has no effect with vertex_radii", good, o.slope = 0.5);
    ADAPTIVE(INVALID, "slope: NaN has no effect with vertex_radii", good, o.slope = NAN);
    ADAPTIVE(INVALID, "vertex_count: 8 has no effect with radius_function", with_function(&g, 0), o.vertex_count = 8);

    ADAPTIVE(INVALID, "smallest", with_function(&g, 0), o.smallest = 0);
    ADAPTIVE(INVALID, "smallest", with_function(&g, 0), o.smallest = NAN);
    ADAPTIVE(INVALID, "smallest", with_function(&g, 0), o.smallest = 1e-9);
    ADAPTIVE(INVALID, "largest", with_function(&g, 0), o.largest = 0.09);
    ADAPTIVE(INVALID, "largest", with_function(&g, 0), o.largest = INFINITY);
    ADAPTIVE(INVALID, "slope", with_function(&g, 0), o.slope = -1);
    ADAPTIVE(INVALID, "slope", with_function(&g, 0), o.slope = NAN);
    ADAPTIVE(INVALID, "slope", with_function(&g, 0), o.slope = 1e-4); /* it is steeper */
    ADAPTIVE(INVALID, "radius_function: NaN", with_function(&g, NAN), 0);
    ADAPTIVE(INVALID, "is not in", with_function(&g, 0.21), 0);
    ADAPTIVE(INVALID, "is not in", with_function(&g, -0.1), 0);
    ADAPTIVE(INVALID, "is not in", with_function(&g, 1e-300), 0);
    ADAPTIVE(INVALID, "radius_function: inf", with_function(&g, INFINITY), 0);
#undef ADAPTIVE
    CHECK(points == UNTOUCHED);
    CHECK(memcmp(&report, &before, sizeof report) == 0);
}

static uint32_t stop(void *user, double done) { return done >= *(double *)user; }

static void cancelled(void) {
    azulejo_psp_adaptive_options options = with_vertices();
    double limits[4] = {0, 0.1, 0.6, 1};
    int i;
    for (i = 0; i < 4; i++) {
        azulejo_points *points = UNTOUCHED;
        options.progress = stop;
        options.progress_user = &limits[i];
        REFUSED(AZULEJO_ERROR_CANCELLED, "cancelled",
                azulejo_psp_adaptive_sample(context, cube, &options, &points, NULL));
        REFUSED(AZULEJO_ERROR_CANCELLED, "cancelled", azulejo_psp_adaptive_sample(one, cube, &options, &points, NULL));
        CHECK(points == UNTOUCHED);
    }
}

int main(void) {
    context = make_context(3);
    one = make_context(1);
    cube = make_cube();
    radii_of_vertices();
    radii_by_position();
    order();
    no_radii();
    bad_arguments();
    cancelled();
    azulejo_mesh_free(cube);
    azulejo_context_free(one);
    azulejo_context_free(context);
    return finish();
}
