/* Relaxation on a mesh: a cancelled call returns what it has, a set becomes the vertices of a mesh, and each bad input is
   refused with a message that names it, leaving the outputs alone. */

#include <math.h>

#include "samples.h"

#define INVALID AZULEJO_ERROR_INVALID_ARGUMENT

static azulejo_context *one, *four;
static azulejo_mesh *cube;
static azulejo_points *darts;

static azulejo_dcr_surface_options surface_options(void) {
    azulejo_dcr_surface_options options;
    ACCEPTED(azulejo_dcr_surface_options_init(&options, sizeof options));
    return options;
}

static azulejo_status relax(const azulejo_context *context, const azulejo_dcr_surface_options *options,
                            azulejo_points **out, azulejo_dcr_surface_report *report) {
    return azulejo_dcr_surface_relax(context, cube, options, azulejo_points_triangles(darts),
                                     azulejo_points_barycentrics(darts), azulejo_points_count(darts), out, report);
}

/* Whether each sample is where its triangle and barycentrics say. */
static int on_triangles(const azulejo_points *points) {
    const float *xyz = azulejo_points_positions(points), *uv = azulejo_points_barycentrics(points);
    const uint32_t *triangles = azulejo_points_triangles(points);
    size_t i, count = azulejo_points_count(points);
    int axis;
    for (i = 0; i < count; i++) {
        const uint32_t *corners = cube_indices[triangles[i]];
        const double u = uv[2 * i], v = uv[2 * i + 1];
        if (!(u >= 0 && v >= 0 && u + v <= 1)) return 0;
        for (axis = 0; axis < 3; axis++) {
            const double a = cube_positions[corners[0]][axis], b = cube_positions[corners[1]][axis];
            const double c = cube_positions[corners[2]][axis];
            if (xyz[3 * i + axis] != (float)((1 - u - v) * a + u * b + v * c)) return 0;
        }
    }
    return count > 0;
}

static uint32_t stop_at(void *user, double done) { return done >= *(const double *)user; }

static void cancelled(const azulejo_context *context) {
    double limits[] = {0, 0.5, 1};
    size_t i;
    for (i = 0; i < COUNT_OF(limits); i++) {
        azulejo_dcr_surface_options options = surface_options();
        azulejo_dcr_surface_report report = surface_report();
        azulejo_points *points = NULL;
        options.progress = stop_at;
        options.progress_user = &limits[i];
        if (!ACCEPTED(relax(context, &options, &points, &report))) continue;
        CHECK(report.stopped == AZULEJO_STOPPED_CANCELLED && on_triangles(points));
        CHECK(i == 0 ? report.iterations == 0 : report.iterations > 10);
        azulejo_points_free(points);
    }
}

static azulejo_mesh_density no_density(void) {
    azulejo_mesh_density density;
    ACCEPTED(azulejo_mesh_density_init(&density, sizeof density));
    return density;
}

/* 1 on the upper half of the cube, 0 below. */
static double upper_half(void *user, const double *position) {
    (void)user;
    return position[2] > 0.5 ? 1 : 0;
}

/* As many samples, none of them where none is wanted; options from before there were densities are still read. */
static void dense(const azulejo_context *context) {
    azulejo_dcr_surface_options options = surface_options();
    azulejo_mesh_density density = no_density();
    azulejo_dcr_surface_report report = surface_report();
    azulejo_points *points = NULL;
    size_t i;
    density.function = upper_half;
    density.largest = 1;
    density.slope = 1e6;
    options.density = &density;
    if (!ACCEPTED(relax(context, &options, &points, &report))) return;
    CHECK(azulejo_points_count(points) == azulejo_points_count(darts) && on_triangles(points) && report.rho > 0.7);
    for (i = 0; i < azulejo_points_count(points); i++) CHECK(azulejo_points_positions(points)[3 * i + 2] > 0.5f);
    azulejo_points_free(points);
    density.slope = -1;
    options.struct_size = offsetof(azulejo_dcr_surface_options, density);
    if (ACCEPTED(relax(context, &options, &points, &report))) azulejo_points_free(points);
}

static void refused(void) {
    azulejo_mesh_density density = no_density();
    const float values[12] = {0};
    azulejo_dcr_surface_options good = surface_options();
    azulejo_dcr_surface_report report, before;
    azulejo_points *out = UNTOUCHED;
    uint32_t triangles[] = {3, 4};
    float uv[] = {0.25f, 0.5f, 0.5f, 0.25f};
    UNWRITTEN(report);
    before = report;
#define CALL(context, mesh, options, triangles, uv, count, out) \
    azulejo_dcr_surface_relax(context, mesh, options, triangles, uv, count, out, &report)
    REFUSED(INVALID, "context", CALL(NULL, cube, &good, triangles, uv, 2, &out));
    REFUSED(INVALID, "mesh", CALL(one, NULL, &good, triangles, uv, 2, &out));
    REFUSED(INVALID, "options", CALL(one, cube, NULL, triangles, uv, 2, &out));
    REFUSED(INVALID, "triangles", CALL(one, cube, &good, NULL, uv, 2, &out));
    REFUSED(INVALID, "barycentrics", CALL(one, cube, &good, triangles, NULL, 2, &out));
    REFUSED(INVALID, "out", CALL(one, cube, &good, triangles, uv, 2, NULL));
    REFUSED(AZULEJO_ERROR_TOO_LARGE, "count", CALL(one, cube, &good, triangles, uv, SIZE_MAX / 2, &out));
    good.tolerance = NAN;
    REFUSED(INVALID, "tolerance", CALL(one, cube, &good, triangles, uv, 2, &out));
    good.tolerance = 0;
    good.struct_size = 3;
    REFUSED(INVALID, "struct_size", CALL(one, cube, &good, triangles, uv, 2, &out));
    good.struct_size = sizeof good;
    triangles[1] = 12;
    REFUSED(INVALID, "triangles: [1] is 12", CALL(one, cube, &good, triangles, uv, 2, &out));
    triangles[1] = 4;
    uv[3] = 0.51f;
    REFUSED(INVALID, "barycentrics: [1] is (0.5, 0.51)", CALL(one, cube, &good, triangles, uv, 2, &out));
    uv[3] = NAN;
    REFUSED(INVALID, "barycentrics: [1] is ", CALL(one, cube, &good, triangles, uv, 2, &out));
    uv[3] = 0.25f;
    good.density = &density;
    REFUSED(INVALID, "vertex_values: one of", CALL(one, cube, &good, triangles, uv, 2, &out));
    density.vertex_values = values;
    density.vertex_count = 3;
    REFUSED(INVALID, "vertex_count: 3", CALL(one, cube, &good, triangles, uv, 2, &out));
    density.vertex_count = azulejo_mesh_vertex_count(cube);
    REFUSED(INVALID, "density: 0 everywhere", CALL(one, cube, &good, triangles, uv, 2, &out));
    density.radius = 1;
    REFUSED(INVALID, "radius: ", CALL(one, cube, &good, triangles, uv, 2, &out));
    density.radius = 0;
    density.struct_size = 3;
    REFUSED(INVALID, "struct_size", CALL(one, cube, &good, triangles, uv, 2, &out));
#undef CALL
    CHECK(out == UNTOUCHED && memcmp(&report, &before, sizeof report) == 0);
}

/* The relaxed samples of a cube as a mesh: a closed surface of the same vertices, that of a sphere. */
static void remeshed(void) {
    const azulejo_dcr_surface_options options = surface_options();
    azulejo_dcr_remesh_report report, before;
    azulejo_points *points = NULL;
    azulejo_mesh *made = NULL, *untouched = UNTOUCHED;
    uint32_t bad[3] = {0, 0, 12};
    const float uv[6] = {0.25f, 0.25f, 0.5f, 0.25f, 0.25f, 0.5f};
    const uint32_t *indices;
    size_t i, count, vertices;
    ACCEPTED(azulejo_dcr_remesh_report_init(&report, sizeof report));
    if (!ACCEPTED(relax(four, &options, &points, NULL))) return;
    vertices = azulejo_points_count(points);
#define CALL(context, mesh, triangles, uv, count, out, report) \
    azulejo_dcr_remesh(context, mesh, triangles, uv, count, out, report)
    ACCEPTED(CALL(four, cube, azulejo_points_triangles(points), azulejo_points_barycentrics(points), vertices, &made,
                  &report));
    count = azulejo_mesh_triangle_count(made);
    indices = azulejo_mesh_indices(made);
    CHECK(azulejo_mesh_vertex_count(made) == vertices && report.triangles == count && report.unused_vertices == 0);
    CHECK(memcmp(azulejo_mesh_positions(made), azulejo_points_positions(points), vertices * 3 * sizeof(float)) == 0);
    for (i = 0; i < 3 * count; i++) CHECK(indices[i] < vertices);
    CHECK(report.boundary_edges == 0 && report.non_manifold_edges == 0 && report.non_manifold_vertices == 0);
    CHECK(report.euler == 2 && count == 2 * vertices - 4 && report.inner_edges == 3 * vertices - 6);
    CHECK(report.smallest_angle > 20 && report.largest_angle < 140 && report.mean_smallest_angle > 45);
    CHECK(fabs(azulejo_mesh_area(made) - 6) < 0.2);
    azulejo_mesh_free(made);

    UNWRITTEN(report);
    before = report;
    REFUSED(INVALID, "context", CALL(NULL, cube, bad, uv, 2, &untouched, &report));
    REFUSED(INVALID, "mesh", CALL(one, NULL, bad, uv, 2, &untouched, &report));
    REFUSED(INVALID, "triangles", CALL(one, cube, NULL, uv, 2, &untouched, &report));
    REFUSED(INVALID, "barycentrics", CALL(one, cube, bad, NULL, 2, &untouched, &report));
    REFUSED(INVALID, "out", CALL(one, cube, bad, uv, 2, NULL, &report));
    REFUSED(INVALID, "triangles: [2] is 12", CALL(one, cube, bad, uv, 3, &untouched, &report));
    REFUSED(INVALID, "triangles: 2 samples form no triangle", CALL(one, cube, bad, uv, 2, &untouched, &report));
    REFUSED(AZULEJO_ERROR_TOO_LARGE, "count", CALL(one, cube, bad, uv, SIZE_MAX / 2, &untouched, &report));
#undef CALL
    CHECK(untouched == UNTOUCHED && memcmp(&report, &before, sizeof report) == 0);
    azulejo_points_free(points);
}

int main(void) {
    azulejo_psp_options options = psp_options(0.05);
    one = make_context(1);
    four = make_context(4);
    cube = make_cube();
    if (!ACCEPTED(azulejo_psp_sample(four, cube, &options, &darts, NULL))) return finish();
    cancelled(one);
    cancelled(four);
    dense(one);
    dense(four);
    refused();
    remeshed();
    azulejo_points_free(darts);
    azulejo_mesh_free(cube);
    azulejo_context_free(one);
    azulejo_context_free(four);
    return finish();
}
