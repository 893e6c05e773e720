/* Densities on meshes: by vertices, functions and images; bad arguments. Meshes that are deformed, and places on them. */

#include <math.h>
#include <pthread.h>

#include "samples.h"

#define INVALID AZULEJO_ERROR_INVALID_ARGUMENT

static azulejo_context *context, *one;
static azulejo_mesh *cube;
/* Nothing at the bottom of the cube, all at its top. */
static const float values[8] = {0, 0, 0, 0, 1, 1, 1, 1};
static const float pixels[6] = {0, 0.5f, 1, 0, 0.5f, 1};
static float places[8][2];

typedef struct {
    pthread_t thread;
    int calls, strangers;
    double bad; /* given at the top; 0: nothing bad is */
} guest;

static double height(void *user, const double position[3]) {
    guest *g = user;
    __atomic_add_fetch(&g->calls, 1, __ATOMIC_RELAXED);
    if (!pthread_equal(g->thread, pthread_self())) __atomic_add_fetch(&g->strangers, 1, __ATOMIC_RELAXED);
    return g->bad != 0 && position[2] > 0.9 ? g->bad : 0.25 + 0.75 * position[2];
}

static azulejo_psp_adaptive_options options(void) {
    azulejo_psp_adaptive_options o;
    ACCEPTED(azulejo_psp_adaptive_options_init(&o, sizeof o));
    return o;
}

static azulejo_mesh_density empty(void) {
    azulejo_mesh_density d;
    ACCEPTED(azulejo_mesh_density_init(&d, sizeof d));
    return d;
}

static azulejo_mesh_density by_vertices(void) {
    azulejo_mesh_density d = empty();
    d.vertex_values = values;
    d.vertex_count = 8;
    d.count = 5000;
    return d;
}

static azulejo_mesh_density by_function(guest *g, double bad) {
    azulejo_mesh_density d = empty();
    g->thread = pthread_self();
    g->calls = g->strangers = 0;
    g->bad = bad;
    d.function = height;
    d.function_user = g;
    d.largest = 1;
    d.slope = 0.75;
    d.radius = 0.02;
    return d;
}

static azulejo_mesh_density by_image(void) {
    azulejo_mesh_density d = empty();
    int i;
    for (i = 0; i < 8; i++) {
        places[i][0] = 1.0f / 6 + 2.0f / 3 * cube_positions[i][2];
        places[i][1] = cube_positions[i][0];
    }
    d.image = pixels;
    d.width = 3;
    d.height = 2;
    d.texture = &places[0][0];
    d.texture_count = 8;
    d.count = 5000;
    return d;
}

/* How many samples lie below a height. */
static size_t below(const azulejo_points *points, float z) {
    size_t i, count = 0;
    for (i = 0; i < azulejo_points_count(points); i++) count += azulejo_points_positions(points)[3 * i + 2] < z;
    return count;
}

static void densities(void) {
    const azulejo_psp_adaptive_options o = options();
    azulejo_mesh_density d = by_vertices();
    azulejo_points *points = NULL, *again = NULL;
    azulejo_psp_report report = psp_report();
    guest g, alone;
    size_t i, count, wrong = 0;
    CHECK(d.struct_size == sizeof d && d.function == NULL && d.radius == 0);
    ACCEPTED(azulejo_psp_adaptive_with_density(context, cube, &o, &d, &points, &report));
    ACCEPTED(azulejo_psp_adaptive_with_density(one, cube, &o, &d, &again, NULL));
    count = azulejo_points_count(points);
    CHECK(same_points(points, again));
    CHECK(count == report.samples && count > 4700 && count < 5300);
    /* Of the integral, 4 sides of a half and a top of 1, sides below a half have 4 eighths of 3; the bottom has none. */
    CHECK(fabs((double)below(points, 0.5f) / (double)count - 1.0 / 6) < 0.02 && below(points, 1e-6f) < 5);
    azulejo_points_free(points);
    azulejo_points_free(again);
    points = again = NULL;

    d = by_image(); /* the same density by an image */
    ACCEPTED(azulejo_psp_adaptive_with_density(context, cube, &o, &d, &points, NULL));
    CHECK(fabs((double)azulejo_points_count(points) / (double)count - 1) < 0.03);
    CHECK(fabs((double)below(points, 0.5f) / (double)count - 1.0 / 6) < 0.02);
    azulejo_points_free(points);
    points = NULL;
    {
        static float corners[36][2];
        for (i = 0; i < 36; i++) memcpy(corners[i], places[cube_indices[i / 3][i % 3]], sizeof *corners);
        d.texture = &corners[0][0];
        d.texture_count = 36;
        d.by_corners = 1;
        ACCEPTED(azulejo_psp_adaptive_with_density(context, cube, &o, &d, &again, NULL));
        CHECK(fabs((double)azulejo_points_count(again) / (double)count - 1) < 0.03);
        azulejo_points_free(again);
        again = NULL;
    }

    d = by_function(&g, 0);
    ACCEPTED(azulejo_psp_adaptive_with_density(context, cube, &o, &d, &points, NULL));
    d = by_function(&alone, 0);
    ACCEPTED(azulejo_psp_adaptive_with_density(one, cube, &o, &d, &again, NULL));
    CHECK(same_points(points, again));
    CHECK(g.strangers > 0 && alone.strangers == 0);
    for (i = 0; i < azulejo_points_count(points); i++) {
        const double z = azulejo_points_positions(points)[3 * i + 2];
        wrong += fabs(azulejo_points_radii(points)[i] - 0.02 / sqrt(0.25 + 0.75 * z)) > 1e-7;
    }
    CHECK(wrong == 0);
    azulejo_points_free(points);
    azulejo_points_free(again);
    points = again = NULL;

    d = by_function(&g, 0);
    d.at_vertices = 1;
    d.largest = d.slope = 0;
    ACCEPTED(azulejo_psp_adaptive_with_density(context, cube, &o, &d, &points, NULL));
    CHECK(g.calls == 8 && g.strangers == 0);
    azulejo_points_free(points);
}

/* Exactly so many samples, of which the first are the set of a smaller count. */
static void order(void) {
    azulejo_psp_adaptive_options o = options();
    azulejo_mesh_density d = by_vertices();
    azulejo_points *points = NULL, *fewer = NULL;
    azulejo_psp_report report = psp_report();
    const float *ranks;
    size_t i, rising = 0;
    o.order = AZULEJO_ORDER_PROGRESSIVE;
    o.quotient = 1.2;
    d.count = 3000;
    ACCEPTED(azulejo_psp_adaptive_with_density(context, cube, &o, &d, &points, &report));
    ranks = azulejo_points_ranks(points);
    if (!CHECK(azulejo_points_count(points) == 3000 && ranks != NULL)) return;
    CHECK(report.samples == 3000 && report.radius == (double)ranks[2999]);
    CHECK(report.covering_radius >= report.radius && report.covering_radius < 1.2001 * report.radius);
    for (i = 1; i < 3000; i++) rising += ranks[i] > ranks[i - 1];
    CHECK(rising == 0 && fabs((double)below(points, 0.5f) / 3000 - 1.0 / 6) < 0.02);
    d.count = 1234;
    ACCEPTED(azulejo_psp_adaptive_with_density(one, cube, &o, &d, &fewer, NULL));
    CHECK(azulejo_points_count(fewer) == 1234);
    CHECK(memcmp(azulejo_points_positions(fewer), azulejo_points_positions(points), 1234 * 3 * sizeof(float)) == 0);
    CHECK(memcmp(azulejo_points_ranks(fewer), ranks, 1234 * sizeof *ranks) == 0);
    azulejo_points_free(points);
    azulejo_points_free(fewer);
}

static void bad_densities(void) {
    azulejo_psp_adaptive_options o = options();
    azulejo_points *points = UNTOUCHED;
    azulejo_psp_report report, before;
    static const float negative[8] = {0, 1, -1, 1, 1, 1, 1, 1}, zeros[8] = {0};
    guest g;
    UNWRITTEN(report);
    before = report;
    {
        azulejo_mesh_density d = by_vertices();
        REFUSED(INVALID, "context", azulejo_psp_adaptive_with_density(NULL, cube, &o, &d, &points, &report));
        REFUSED(INVALID, "mesh", azulejo_psp_adaptive_with_density(context, NULL, &o, &d, &points, &report));
        REFUSED(INVALID, "options", azulejo_psp_adaptive_with_density(context, cube, NULL, &d, &points, &report));
        REFUSED(INVALID, "density", azulejo_psp_adaptive_with_density(context, cube, &o, NULL, &points, &report));
        REFUSED(INVALID, "out", azulejo_psp_adaptive_with_density(context, cube, &o, &d, NULL, &report));
        REFUSED(INVALID, "density", azulejo_mesh_density_init(NULL, sizeof d));
        o.vertex_radii = values;
        REFUSED(INVALID, "vertex_radii: is set", azulejo_psp_adaptive_with_density(context, cube, &o, &d, &points, &report));
        o = options();
        o.slope = 1;
        REFUSED(INVALID, "slope: 1.0 has no effect", azulejo_psp_adaptive_with_density(context, cube, &o, &d, &points, &report));
        o = options();
    }
#define DENSITY(status, part, start, change)                                                             \
    do {                                                                                                 \
        azulejo_mesh_density d = start;                                                                  \
        (void)(change);                                                                                  \
        REFUSED(status, part, azulejo_psp_adaptive_with_density(context, cube, &o, &d, &points, &report));      \
    } while (0)
    DENSITY(INVALID, "struct_size", by_vertices(), d.struct_size = 0);
    o.order = AZULEJO_ORDER_PROGRESSIVE;
    DENSITY(INVALID, "count: 10.5 is not a whole number", by_vertices(), d.count = 10.5);
    o.quotient = 1.55;
    DENSITY(INVALID, "quotient: 1.55", by_vertices(), 0);
    o = options();
    o.order = 7;
    DENSITY(INVALID, "order: 7", by_vertices(), 0);
    o = options();
    DENSITY(INVALID, "reserved: 1", by_vertices(), d.reserved = 1);
    DENSITY(INVALID, "radius: is 0", by_vertices(), d.count = 0);
    DENSITY(INVALID, "count: is set", by_vertices(), d.radius = 1);
    DENSITY(INVALID, "radius", by_vertices(), (d.count = 0, d.radius = NAN));
    DENSITY(INVALID, "radius", by_vertices(), (d.count = 0, d.radius = -1));
    DENSITY(INVALID, "count", by_vertices(), d.count = INFINITY);
    DENSITY(INVALID, "count", by_vertices(), d.count = -5);
    DENSITY(INVALID, "vertex_values: one of", by_vertices(), d.vertex_values = NULL);
    DENSITY(INVALID, "vertex_values: one of", by_vertices(), (d.function = height, d.function_user = &g));
    DENSITY(INVALID, "vertex_values: one of", by_image(), d.vertex_values = values);
    DENSITY(INVALID, "vertex_count", by_vertices(), d.vertex_count = 7);
    DENSITY(AZULEJO_ERROR_TOO_LARGE, "vertex_count", by_vertices(), d.vertex_count = SIZE_MAX);
    DENSITY(INVALID, "density: vertex 2", by_vertices(), d.vertex_values = negative);
    DENSITY(INVALID, "density: 0 everywhere", by_vertices(), d.vertex_values = zeros);
    DENSITY(INVALID, "at_vertices: 2", by_function(&g, 0), d.at_vertices = 2);
    DENSITY(INVALID, "at_vertices: 1 has no effect", by_vertices(), d.at_vertices = 1);
    DENSITY(INVALID, "largest", by_function(&g, 0), d.at_vertices = 1);
    DENSITY(INVALID, "largest", by_function(&g, 0), d.largest = 0);
    DENSITY(INVALID, "largest", by_vertices(), d.largest = 1);
    DENSITY(INVALID, "slope", by_function(&g, 0), d.slope = NAN);
    DENSITY(INVALID, "density", by_function(&g, 0), d.slope = 1e-3); /* it is steeper */
    DENSITY(INVALID, "is not in 0..=1", by_function(&g, 1.5), 0);
    DENSITY(INVALID, "density: NaN", by_function(&g, NAN), 0);
    DENSITY(INVALID, "width: 0", by_image(), d.width = 0);
    DENSITY(AZULEJO_ERROR_TOO_LARGE, "width", by_image(), d.width = SIZE_MAX);
    DENSITY(INVALID, "texture", by_image(), d.texture = NULL);
    DENSITY(INVALID, "texture: 7 texture coordinates", by_image(), d.texture_count = 7);
    DENSITY(INVALID, "texture_count: 8 is not a multiple of 3", by_image(), d.by_corners = 1);
    DENSITY(INVALID, "width: 3 has no effect", by_vertices(), d.width = 3);
#undef DENSITY
    CHECK(points == UNTOUCHED);
    CHECK(memcmp(&report, &before, sizeof report) == 0);
}

static void samples_follow_a_mesh(void) {
    azulejo_psp_options o = psp_options(0.05);
    azulejo_mesh *moved = NULL, *untouched = UNTOUCHED;
    azulejo_points *points = NULL, *again = NULL, *there = NULL, *none = UNTOUCHED;
    float positions[8][3], flat[8][3] = {{0}};
    size_t i, k, count, wrong = 0;
    const uint32_t beyond = 12;
    const float uv[2] = {0.25f, NAN};
    for (i = 0; i < 8; i++)
        for (k = 0; k < 3; k++) positions[i][k] = 2 * cube_positions[i][k] + (float)k;
    ACCEPTED(azulejo_psp_sample(context, cube, &o, &points, NULL));
    count = azulejo_points_count(points);
    ACCEPTED(azulejo_mesh_points(cube, azulejo_points_triangles(points), azulejo_points_barycentrics(points), count,
                                 &again));
    CHECK(same_points(points, again));
    ACCEPTED(azulejo_mesh_deform(cube, &positions[0][0], 8, sizeof *positions, &moved));
    CHECK(azulejo_mesh_triangle_count(moved) == 12 && azulejo_mesh_area(moved) == 24);
    ACCEPTED(azulejo_mesh_points(moved, azulejo_points_triangles(points), azulejo_points_barycentrics(points), count,
                                 &there));
    for (i = 0; i < count; i++)
        for (k = 0; k < 3; k++) {
            const double from = azulejo_points_positions(points)[3 * i + k];
            wrong += fabs(azulejo_points_positions(there)[3 * i + k] - (2 * from + (double)k)) > 1e-6;
        }
    CHECK(wrong == 0 && azulejo_points_count(there) == count);

    REFUSED(INVALID, "mesh", azulejo_mesh_deform(NULL, &positions[0][0], 8, 12, &untouched));
    REFUSED(INVALID, "positions", azulejo_mesh_deform(cube, NULL, 8, 12, &untouched));
    REFUSED(INVALID, "positions", azulejo_mesh_deform(cube, &positions[0][0], 7, 12, &untouched));
    REFUSED(INVALID, "stride_bytes", azulejo_mesh_deform(cube, &positions[0][0], 8, 11, &untouched));
    REFUSED(INVALID, "no area", azulejo_mesh_deform(cube, &flat[0][0], 8, 12, &untouched));
    REFUSED(INVALID, "out", azulejo_mesh_deform(cube, &positions[0][0], 8, 12, NULL));
    positions[3][1] = NAN;
    REFUSED(INVALID, "vertex 3", azulejo_mesh_deform(cube, &positions[0][0], 8, 12, &untouched));
    REFUSED(INVALID, "mesh", azulejo_mesh_points(NULL, &beyond, uv, 0, &none));
    REFUSED(INVALID, "triangles: [0] is 12", azulejo_mesh_points(cube, &beyond, uv, 1, &none));
    REFUSED(INVALID, "triangles", azulejo_mesh_points(cube, NULL, uv, 1, &none));
    REFUSED(INVALID, "barycentrics", azulejo_mesh_points(cube, &cube_indices[0][0], uv, 1, &none));
    REFUSED(INVALID, "out", azulejo_mesh_points(cube, NULL, NULL, 0, NULL));
    CHECK(untouched == UNTOUCHED && none == UNTOUCHED);
    azulejo_points_free(points);
    azulejo_points_free(again);
    points = again = NULL;
    azulejo_points_free(there);
    azulejo_mesh_free(moved);
}

int main(void) {
    context = make_context(3);
    one = make_context(1);
    cube = make_cube();
    densities();
    order();
    bad_densities();
    samples_follow_a_mesh();
    azulejo_mesh_free(cube);
    azulejo_context_free(one);
    azulejo_context_free(context);
    return finish();
}
