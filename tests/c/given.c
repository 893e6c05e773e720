/* Samples around given ones: each clearance is kept, what a clearance covers stays empty, and what is given may be freed
   once a call has returned or a handle is made. Bad input is refused in arguments.c and adaptive.c. */

#include <math.h>

#include "samples.h"

#define COUNT 40

static azulejo_context *one, *three;
static azulejo_mesh *cube;
static float positions[COUNT][3];
static double clearances[COUNT];

/* Some on the cube, some near it, some far away; clearances over five orders, and 0. */
static void make_given(void) {
    uint32_t state = 1;
    int i, axis;
    for (i = 0; i < COUNT; i++) {
        for (axis = 0; axis < 3; axis++) {
            state = state * 1664525u + 1013904223u;
            positions[i][axis] = (float)(state >> 8) / 16777216.0f * 1.2f - 0.1f;
        }
        positions[i][i % 3] = i % 2 ? 0.0f : 1.02f;
        clearances[i] = 0.3 * pow(10, -5.0 * i / COUNT);
    }
    clearances[7] = 0;
    positions[8][0] = 3e38f;
}

static double distance(const float *a, const float *b) {
    const double x = (double)a[0] - b[0], y = (double)a[1] - b[1], z = (double)a[2] - b[2];
    return sqrt(x * x + y * y + z * z);
}

/* Whether all samples keep `radius` from each other and from given samples their clearances, or `radius`. */
static int keeps_clear(const azulejo_points *points, double radius, const double *from_given, size_t given) {
    const float *xyz = azulejo_points_positions(points);
    size_t i, j, count = azulejo_points_count(points);
    for (i = 0; i < count; i++) {
        for (j = 0; j < i; j++)
            if (distance(xyz + 3 * i, xyz + 3 * j) < radius) return 0;
        for (j = 0; j < given; j++)
            if (distance(xyz + 3 * i, positions[j]) < (from_given ? from_given[j] : radius)) return 0;
    }
    return count > 0;
}

static int same(const azulejo_points *a, const azulejo_points *b) {
    const size_t count = azulejo_points_count(a);
    return count == azulejo_points_count(b) &&
           memcmp(azulejo_points_positions(a), azulejo_points_positions(b), count * 3 * sizeof(float)) == 0;
}

static azulejo_psp_options options_with(const double *own) {
    azulejo_psp_options options = psp_options(0.06);
    options.given_positions = positions[0];
    options.given_clearances = own;
    options.given_count = COUNT;
    return options;
}

static void around_given(void) {
    const double *both[2] = {clearances, NULL};
    azulejo_psp_report report;
    int i;
    ACCEPTED(azulejo_psp_report_init(&report, sizeof report));
    for (i = 0; i < 2; i++) {
        azulejo_psp_options options = options_with(both[i]);
        azulejo_points *points = NULL, *again = NULL;
        ACCEPTED(azulejo_psp_sample(three, cube, &options, &points, &report));
        ACCEPTED(azulejo_psp_sample(one, cube, &options, &again, NULL));
        CHECK(keeps_clear(points, 0.06, both[i], COUNT) && same(points, again));
        CHECK(report.uncovered_before > 0.3 && report.uncovered_before < 1 && report.uncovered_after == 0);
        azulejo_points_free(points);
        azulejo_points_free(again);
    }
}

/* A ball that holds the cube leaves no room. */
static void all_covered(void) {
    azulejo_psp_options options = psp_options(0.1);
    azulejo_points *points = NULL;
    const float centre[3] = {0.5f, 0.5f, 0.5f};
    const double clearance = 2;
    options.given_positions = centre;
    options.given_clearances = &clearance;
    options.given_count = 1;
    ACCEPTED(azulejo_psp_sample(three, cube, &options, &points, NULL));
    CHECK(azulejo_points_count(points) == 0);
    azulejo_points_free(points);
}

/* What is left of a set after an edit is given, and what fills the hole fits to it. */
static void hole(void) {
    azulejo_psp_options options = psp_options(0.06);
    azulejo_points *before = NULL, *after = NULL;
    size_t i, j, count, kept = 0;
    float *outside;
    const float *xyz;
    int clear = 1;
    ACCEPTED(azulejo_psp_sample(three, cube, &options, &before, NULL));
    count = azulejo_points_count(before);
    xyz = azulejo_points_positions(before);
    outside = malloc(count * 3 * sizeof *outside);
    if (outside == NULL) exit(EXIT_FAILURE);
    for (i = 0; i < count; i++)
        if (xyz[3 * i] < 0.7f) memcpy(outside + 3 * kept++, xyz + 3 * i, 3 * sizeof *outside);
    options.given_positions = outside;
    options.given_count = kept;
    options.seed = 5;
    ACCEPTED(azulejo_psp_sample(three, cube, &options, &after, NULL));
    xyz = azulejo_points_positions(after);
    for (i = 0; i < azulejo_points_count(after); i++)
        for (j = 0; j < kept; j++)
            clear = clear && distance(xyz + 3 * i, outside + 3 * j) >= 0.06 && xyz[3 * i] > 0.6f;
    CHECK(clear);
    CHECK(azulejo_points_count(after) > (count - kept) / 2 && azulejo_points_count(after) < 2 * (count - kept));
    free(outside);
    azulejo_points_free(before);
    azulejo_points_free(after);
}

/* A handle keeps what it needs: the arrays of the caller may go. */
static void handle(void) {
    azulejo_psp_options options = options_with(clearances);
    azulejo_points *expected = NULL, *points = NULL;
    azulejo_psp *psp = NULL;
    float *copy = malloc(sizeof positions);
    if (copy == NULL) exit(EXIT_FAILURE);
    ACCEPTED(azulejo_psp_sample(three, cube, &options, &expected, NULL));
    memcpy(copy, positions, sizeof positions);
    options.given_positions = copy;
    ACCEPTED(azulejo_psp_create(three, cube, &options, &psp));
    memset(copy, 0, sizeof positions);
    free(copy);
    ACCEPTED(azulejo_psp_fill(psp, NULL));
    ACCEPTED(azulejo_psp_points(psp, &points));
    CHECK(same(points, expected));
    ACCEPTED(azulejo_psp_advance(psp, 1, NULL));
    azulejo_points_free(points);
    points = NULL;
    ACCEPTED(azulejo_psp_points(psp, &points));
    CHECK(same(points, expected));
    azulejo_points_free(points);
    azulejo_points_free(expected);
    azulejo_psp_free(psp);
}

static void varying(void) {
    const float radii[8] = {0.06f, 0.06f, 0.06f, 0.06f, 0.09f, 0.09f, 0.09f, 0.09f};
    azulejo_psp_adaptive_options options;
    azulejo_points *points = NULL;
    ACCEPTED(azulejo_psp_adaptive_options_init(&options, sizeof options));
    options.vertex_radii = radii;
    options.vertex_count = 8;
    options.given_positions = positions[0];
    options.given_clearances = clearances;
    options.given_count = COUNT;
    ACCEPTED(azulejo_psp_adaptive_sample(three, cube, &options, &points, NULL));
    CHECK(keeps_clear(points, 0.06, clearances, COUNT));
    azulejo_points_free(points);
}

/* Two squares back to back: with a normal cone both are sampled. */
static void thin_wall(void) {
    const float corners[8][3] = {{0, 0, 0},      {1, 0, 0},      {0, 1, 0},      {1, 1, 0},
                                 {0, 0, 0.001f}, {1, 0, 0.001f}, {0, 1, 0.001f}, {1, 1, 0.001f}};
    const uint32_t triangles[4][3] = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};
    azulejo_psp_options options = psp_options(0.05);
    azulejo_points *shared = NULL, *apart = NULL, *none = UNTOUCHED;
    azulejo_mesh *wall = NULL;
    azulejo_psp *psp = NULL;
    ACCEPTED(azulejo_mesh_create(corners[0], 8, sizeof *corners, triangles[0], 4, &wall));
    ACCEPTED(azulejo_psp_sample(three, wall, &options, &shared, NULL));
    options.cosine = 0.5;
    ACCEPTED(azulejo_psp_sample(three, wall, &options, &apart, NULL));
    CHECK(10 * azulejo_points_count(apart) > 18 * azulejo_points_count(shared));
    ACCEPTED(azulejo_psp_create(three, wall, &options, &psp));
    REFUSED(AZULEJO_ERROR_INVALID_ARGUMENT, "cosine: 0.5", azulejo_psp_advance(psp, 1, NULL));
    options.iterations = 1;
    REFUSED(AZULEJO_ERROR_INVALID_ARGUMENT, "cosine: 0.5", azulejo_psp_sample(three, wall, &options, &none, NULL));
    CHECK(none == UNTOUCHED);
    azulejo_psp_free(psp);
    azulejo_points_free(shared);
    azulejo_points_free(apart);
    azulejo_mesh_free(wall);
}

int main(void) {
    one = make_context(1);
    three = make_context(3);
    cube = make_cube();
    make_given();
    around_given();
    all_covered();
    hole();
    handle();
    varying();
    thin_wall();
    azulejo_mesh_free(cube);
    azulejo_context_free(one);
    azulejo_context_free(three);
    return finish();
}
