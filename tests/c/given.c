/* Samples around given ones, which may be freed once a call has returned or a handle is made; with a cosine no handle
   projects. Bad input is refused in arguments.c and adaptive.c. */

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
    handle();
    thin_wall();
    azulejo_mesh_free(cube);
    azulejo_context_free(one);
    azulejo_context_free(three);
    return finish();
}
