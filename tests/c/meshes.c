/* What meshes of callers are like: normals and masks, good and bad; any stride, size and place. */

#include <math.h>

#include "samples.h"

#define INVALID AZULEJO_ERROR_INVALID_ARGUMENT
#define TOO_LARGE AZULEJO_ERROR_TOO_LARGE

static azulejo_context *context;
static azulejo_mesh *cube;

static azulejo_points *sample(const azulejo_mesh *mesh, double radius) {
    const azulejo_psp_options options = psp_options(radius);
    azulejo_points *points = NULL;
    if (!ACCEPTED(azulejo_psp_sample(context, mesh, &options, &points, NULL))) exit(finish());
    return points;
}

static void bad_normals(void) {
    const float *normals = &cube_positions[0][0];
    const uint32_t *indices = &cube_indices[0][0];
    float bad[24] = {0};
    azulejo_mesh *out = UNTOUCHED;
    int i;

#define NORMALS(status, part, ...) REFUSED(status, part, azulejo_mesh_with_normals(__VA_ARGS__, &out))
    NORMALS(INVALID, "mesh", NULL, normals, 8, 12, NULL, 0);
    NORMALS(INVALID, "normals", cube, NULL, 8, 12, NULL, 0);
    NORMALS(INVALID, "normals", cube, (const float *)((const char *)normals + 2), 4, 12, indices, 12);
    NORMALS(INVALID, "normal_indices", cube, normals, 8, 12, NULL, 12);
    NORMALS(INVALID, "normal_indices", cube, normals, 8, 12, (const uint32_t *)((const char *)indices + 1), 12);
    REFUSED(INVALID, "out", azulejo_mesh_with_normals(cube, normals, 8, 12, NULL, 0, NULL));
    NORMALS(INVALID, "stride_bytes: 0", cube, normals, 8, 0, NULL, 0);
    NORMALS(INVALID, "stride_bytes: 8", cube, normals, 8, 8, NULL, 0);
    NORMALS(INVALID, "stride_bytes: 14", cube, normals, 6, 14, indices, 12);
    NORMALS(INVALID, "normals: 0", cube, NULL, 0, 12, NULL, 0);
    NORMALS(INVALID, "normals: 7", cube, normals, 7, 12, NULL, 0);
    NORMALS(INVALID, "triangle_count: 0", cube, normals, 8, 12, indices, 0);
    NORMALS(INVALID, "triangle_count: 11", cube, normals, 8, 12, indices, 11);
    NORMALS(INVALID, "triangle_count", cube, normals, 8, 12, indices, SIZE_MAX);
    NORMALS(INVALID, "normal_indices", cube, normals, 7, 12, indices, 12);
    NORMALS(TOO_LARGE, "normal_count", cube, normals, SIZE_MAX, 12, NULL, 0);
    NORMALS(TOO_LARGE, "normal_count", cube, normals, 2, SIZE_MAX / 4 * 4, NULL, 0);
    for (i = 0; i < 24; i++) {
        bad[i] = i % 3 == 0 ? NAN : i % 3 == 1 ? INFINITY : -INFINITY;
        NORMALS(INVALID, "normals: normal", cube, bad, 8, 12, NULL, 0);
        bad[i] = 0;
    }
#undef NORMALS
    CHECK(out == UNTOUCHED);
    CHECK(azulejo_mesh_has_normals(NULL) == 0);
    CHECK(azulejo_points_interpolated_normals(NULL) == NULL);
}

static void bad_masks(void) {
    const uint8_t mask[13] = {1};
    azulejo_mesh *out = UNTOUCHED;
    REFUSED(INVALID, "mesh", azulejo_mesh_with_mask(NULL, mask, 12, &out));
    REFUSED(INVALID, "mask", azulejo_mesh_with_mask(cube, NULL, 12, &out));
    REFUSED(INVALID, "out", azulejo_mesh_with_mask(cube, mask, 12, NULL));
    REFUSED(INVALID, "triangle_count: 0", azulejo_mesh_with_mask(cube, NULL, 0, &out));
    REFUSED(INVALID, "triangle_count: 11", azulejo_mesh_with_mask(cube, mask, 11, &out));
    REFUSED(INVALID, "triangle_count: 13", azulejo_mesh_with_mask(cube, mask, 13, &out));
    REFUSED(INVALID, "triangle_count", azulejo_mesh_with_mask(cube, mask, SIZE_MAX, &out));
    CHECK(out == UNTOUCHED);
}

/* The cube with normals that point away from its centre, as a sphere has them. */
static void interpolated_normals(void) {
    float normals[8][4];
    azulejo_mesh *smooth = NULL, *flat = NULL;
    azulejo_points *plain = sample(cube, 0.1), *points;
    size_t i, wrong = 0;
    int axis;

    for (i = 0; i < 8; i++) {
        for (axis = 0; axis < 3; axis++) normals[i][axis] = cube_positions[i][axis] - 0.5f;
        normals[i][3] = NAN; /* is not read */
    }
    CHECK(azulejo_mesh_has_normals(cube) == 0 && azulejo_points_interpolated_normals(plain) == NULL);
    ACCEPTED(azulejo_mesh_with_normals(cube, normals[0], 8, sizeof *normals, NULL, 0, &smooth));
    ACCEPTED(azulejo_mesh_with_normals(smooth, normals[0], 8, sizeof *normals, &cube_indices[0][0], 12, &flat));
    CHECK(azulejo_mesh_has_normals(smooth) == 1 && azulejo_mesh_positions(smooth) == azulejo_mesh_positions(cube));
    azulejo_mesh_free(smooth); /* the other one lives on */

    points = sample(flat, 0.1);
    CHECK(same_points(plain, points));
    for (i = 0; i < azulejo_points_count(points); i++) {
        const float *position = azulejo_points_positions(points) + 3 * i;
        const float *normal = azulejo_points_interpolated_normals(points) + 3 * i;
        double length = 0;
        for (axis = 0; axis < 3; axis++) length += pow(position[axis] - 0.5, 2);
        length = sqrt(length);
        for (axis = 0; axis < 3; axis++) wrong += fabs(normal[axis] - (position[axis] - 0.5) / length) > 1e-6;
    }
    CHECK(wrong == 0);
    azulejo_points_free(points);
    azulejo_points_free(plain);
    azulejo_mesh_free(flat);
}

static void masks(void) {
    uint8_t mask[12] = {0};
    azulejo_mesh *part = NULL, *none = NULL, *whole = NULL;
    azulejo_points *points, *expected = sample(cube, 0.1);
    azulejo_psp_options options = psp_options(0.1);
    azulejo_psp *psp = NULL;
    azulejo_psp_report report = psp_report();
    azulejo_coverage_report coverage = coverage_report();
    double uncovered = 1;
    size_t i, wrong = 0;

    ACCEPTED(azulejo_mesh_with_mask(cube, mask, 12, &none));
    mask[2] = 1, mask[3] = 255;
    ACCEPTED(azulejo_mesh_with_mask(none, mask, 12, &part));
    CHECK(azulejo_mesh_area(none) == 0 && azulejo_mesh_area(part) == 1 && azulejo_mesh_area(cube) == 6);
    CHECK(azulejo_mesh_triangle_count(part) == 12 && azulejo_mesh_vertex_count(none) == 8);

    points = sample(part, 0.1);
    for (i = 0; i < azulejo_points_count(points); i++) {
        const uint32_t triangle = azulejo_points_triangles(points)[i];
        wrong += triangle != 2 && triangle != 3;
        wrong += azulejo_points_positions(points)[3 * i + 2] != 1; /* the two are the cube's upper face */
    }
    CHECK(wrong == 0 && azulejo_points_count(points) > 60);
    ACCEPTED(azulejo_mesh_coverage(context, part, azulejo_points_positions(points), azulejo_points_count(points),
                                   0.1 + 1e-6, &coverage));
    CHECK(coverage.gaps == 0);
    ACCEPTED(azulejo_mesh_uncovered_fraction(context, part, azulejo_points_positions(points),
                                             azulejo_points_count(points), 0.1, 10000, 1, &uncovered));
    CHECK(uncovered == 0);
    azulejo_points_free(points);

    points = sample(none, 0.1);
    CHECK(azulejo_points_count(points) == 0 && azulejo_points_positions(points) == NULL);
    azulejo_points_free(points);
    ACCEPTED(azulejo_mesh_uncovered_fraction(context, none, NULL, 0, 0.1, 10, 1, &uncovered));
    CHECK(uncovered == 0);
    ACCEPTED(azulejo_psp_create(context, none, &options, &psp));
    ACCEPTED(azulejo_psp_advance(psp, 2, &report));
    CHECK(report.samples == 0 && report.iterations == 0);
    ACCEPTED(azulejo_psp_fill(psp, &report));
    CHECK(report.samples == 0 && report.darts == 0);
    azulejo_psp_free(psp);

    /* A mask takes the place of the one before. */
    memset(mask, 1, sizeof mask);
    ACCEPTED(azulejo_mesh_with_mask(none, mask, 12, &whole));
    points = sample(whole, 0.1);
    CHECK(same_points(points, expected));
    azulejo_points_free(points);
    azulejo_points_free(expected);
    azulejo_mesh_free(whole);
    azulejo_mesh_free(part);
    azulejo_mesh_free(none);
}

/* The spacing of floats where a float is. */
static double spacing_at(float x) { return nextafterf(fabsf(x), INFINITY) - (double)fabsf(x); }

/* The cube with so many floats to a vertex, of this size, its corner so far from the origin. */
static void any_mesh(size_t floats, double scale, double offset) {
    float *positions = malloc(8 * floats * sizeof *positions);
    azulejo_mesh *mesh = NULL;
    azulejo_points *points;
    double smallest = 0;
    size_t i, wrong = 0;
    int axis;

    if (!CHECK(positions != NULL)) exit(finish());
    for (i = 0; i < 8 * floats; i++) positions[i] = NAN; /* is not read */
    for (i = 0; i < 8; i++) {
        for (axis = 0; axis < 3; axis++) positions[floats * i + axis] = (float)(cube_positions[i][axis] * scale + offset);
    }
    ACCEPTED(azulejo_mesh_create(positions, 8, floats * sizeof *positions, &cube_indices[0][0], 12, &mesh));
    points = sample(mesh, 0.2 * scale);
    CHECK(azulejo_points_count(points) > 80 && azulejo_points_count(points) < 160);
    ACCEPTED(azulejo_space_smallest_distance(context, azulejo_points_positions(points), azulejo_points_count(points),
                                             &smallest));
    CHECK(smallest >= 0.2 * scale);
    for (i = 0; i < azulejo_points_count(points); i++) {
        const uint32_t *triangle = cube_indices[azulejo_points_triangles(points)[i]];
        const float *uv = azulejo_points_barycentrics(points) + 2 * i;
        const float *position = azulejo_points_positions(points) + 3 * i;
        const double u = uv[0], v = uv[1];
        wrong += !(u >= 0 && v >= 0 && u + v <= 1);
        for (axis = 0; axis < 3; axis++) {
            const double exact = (1 - u - v) * positions[floats * triangle[0] + axis] +
                                 u * positions[floats * triangle[1] + axis] + v * positions[floats * triangle[2] + axis];
            wrong += !(fabs(position[axis] - exact) <= 0.5 * spacing_at(position[axis]));
        }
    }
    CHECK(wrong == 0);
    azulejo_points_free(points);
    azulejo_mesh_free(mesh);
    free(positions);
}

int main(void) {
    const size_t floats[] = {3, 4, 8};
    size_t i;
    context = make_context(2);
    cube = make_cube();
    bad_normals();
    bad_masks();
    interpolated_normals();
    masks();
    for (i = 0; i < COUNT_OF(floats); i++) {
        any_mesh(floats[i], 1, 0);
        any_mesh(floats[i], 1, -1e4);
        any_mesh(floats[i], 1e-6, 0);
        any_mesh(floats[i], 1e6, 0);
        any_mesh(floats[i], 100, 1e6);
    }
    any_mesh(3, 1e-30, 0);
    any_mesh(3, 1e30, 0);
    azulejo_mesh_free(cube);
    azulejo_context_free(context);
    return finish();
}
