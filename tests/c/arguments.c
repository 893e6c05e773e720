/* Bad arguments: every pointer NULL, numbers outside their range, sizes that overflow. Each is refused with a message
   that names the argument, and leaves the outputs alone. */

#include <math.h>

#include "samples.h"

#define INVALID AZULEJO_ERROR_INVALID_ARGUMENT

static azulejo_context *context;
static azulejo_mesh *cube;

/* Puts the option into options that are in order; the call that samples with them is refused. */
#define REFUSED_OPTION(make, status, part, change, call)      \
    do {                                                      \
        make;                                                 \
        azulejo_points *points = UNTOUCHED;                   \
        (void)(change);                                       \
        REFUSED(status, part, call);                          \
        CHECK(points == UNTOUCHED);                           \
    } while (0)

/* The largest number in a text. */
static double largest_number(const char *text) {
    double largest = 0;
    while (*text) {
        char *end;
        const double number = (*text >= '0' && *text <= '9') ? strtod(text, &end) : (end = (char *)text + 1, 0.0);
        if (number > largest) largest = number;
        text = end;
    }
    return largest;
}

static void names(void) {
    CHECK(strcmp(azulejo_status_name(AZULEJO_OK), "AZULEJO_OK") == 0);
    CHECK(strcmp(azulejo_status_name(AZULEJO_ERROR_BUSY), "AZULEJO_ERROR_BUSY") == 0);
    CHECK(strcmp(azulejo_status_name(AZULEJO_ERROR_INTERNAL), "AZULEJO_ERROR_INTERNAL") == 0);
    CHECK(azulejo_status_name(1) == NULL && azulejo_status_name(INT32_MIN) == NULL);
}

static void contexts(void) {
    azulejo_context *out = UNTOUCHED;
    REFUSED(INVALID, "out", azulejo_context_create(1, NULL));
    REFUSED(INVALID, "num_threads: 4097", azulejo_context_create(4097, &out));
    REFUSED(INVALID, "num_threads", azulejo_context_create(UINT32_MAX, &out));
    CHECK(out == UNTOUCHED);
    CHECK(azulejo_context_num_threads(NULL) == 0);
    CHECK(azulejo_context_num_threads(context) == 2);
    azulejo_context_free(NULL);
}

static void kdrt(void) {
    azulejo_kdrt_options good = kdrt_options(0.1);
    azulejo_points *out = UNTOUCHED;
    REFUSED(INVALID, "context", azulejo_kdrt_sample(NULL, &good, &out, NULL));
    REFUSED(INVALID, "options", azulejo_kdrt_sample(context, NULL, &out, NULL));
    REFUSED(INVALID, "options", azulejo_kdrt_sample(context, (azulejo_kdrt_options *)((char *)&good + 1), &out, NULL));
    REFUSED(INVALID, "out", azulejo_kdrt_sample(context, &good, NULL, NULL));
    CHECK(out == UNTOUCHED);

#define KDRT(status, part, change) \
    REFUSED_OPTION(azulejo_kdrt_options o = good, status, part, change, azulejo_kdrt_sample(context, &o, &points, NULL))
    KDRT(INVALID, "radius", o.radius = 0);
    KDRT(INVALID, "radius", o.radius = -0.1);
    KDRT(INVALID, "radius", o.radius = NAN);
    KDRT(INVALID, "radius", o.radius = INFINITY);
    KDRT(INVALID, "radius", o.radius = -INFINITY);
    KDRT(INVALID, "domain_min", o.domain_min[0] = NAN);
    KDRT(INVALID, "domain_min", o.domain_min[1] = -INFINITY);
    KDRT(INVALID, "domain_max", o.domain_max[0] = INFINITY);
    KDRT(INVALID, "domain_max", o.domain_max[1] = 1e39);
    KDRT(INVALID, "domain_max", o.domain_max[0] = 0);
    KDRT(INVALID, "domain_max", o.domain_max[1] = -1);
    KDRT(INVALID, "boundary", o.boundary = 2);
    KDRT(INVALID, "boundary", o.boundary = -1);
    KDRT(INVALID, "boundary", o.boundary = INT32_MIN);
    KDRT(INVALID, "leaf_size", o.leaf_size = 0);
    KDRT(INVALID, "leaf_size", o.leaf_size = 5.99);
    KDRT(INVALID, "leaf_size", o.leaf_size = -20);
    KDRT(INVALID, "leaf_size", o.leaf_size = NAN);
    /* Floats around a million are 1/16 apart. */
    KDRT(INVALID, "radius", (o.domain_min[0] = 1e6, o.domain_max[0] = 1e6 + 1));
    KDRT(AZULEJO_ERROR_TOO_LARGE, "radius", o.radius = 8.3461e-7);
    CHECK(largest_number(last_error()) > 0.9e12 && largest_number(last_error()) < 1.1e12);
    KDRT(AZULEJO_ERROR_TOO_LARGE, "radius", o.radius = 1e-300);
#undef KDRT
}

static uint32_t never_visited(void *user, const float *xy, size_t count) {
    (void)xy, (void)count;
    ++*(int *)user;
    return 0;
}

static void kdrt_windows(void) {
    const double low[2] = {0.25, 0.5}, high[2] = {0.75, 1}, flat[2] = {0.75, 0.5}, *misaligned;
    azulejo_kdrt_options good = kdrt_options(0.1);
    azulejo_points *out = UNTOUCHED;
    misaligned = (const double *)((const char *)low + 1);
    REFUSED(INVALID, "context", azulejo_kdrt_sample_window(NULL, &good, low, high, &out, NULL));
    REFUSED(INVALID, "options", azulejo_kdrt_sample_window(context, NULL, low, high, &out, NULL));
    REFUSED(INVALID, "window_min: is NULL", azulejo_kdrt_sample_window(context, &good, NULL, high, &out, NULL));
    REFUSED(INVALID, "window_max: is NULL", azulejo_kdrt_sample_window(context, &good, low, NULL, &out, NULL));
    REFUSED(INVALID, "window_min", azulejo_kdrt_sample_window(context, &good, misaligned, high, &out, NULL));
    REFUSED(INVALID, "window_max", azulejo_kdrt_sample_window(context, &good, low, misaligned, &out, NULL));
    REFUSED(INVALID, "out", azulejo_kdrt_sample_window(context, &good, low, high, NULL, NULL));
    REFUSED(INVALID, "window_max", azulejo_kdrt_sample_window(context, &good, low, low, &out, NULL));
    REFUSED(INVALID, "window_max: [1] is 0.5", azulejo_kdrt_sample_window(context, &good, low, flat, &out, NULL));
    REFUSED(INVALID, "window_max: [0] is 0.25", azulejo_kdrt_sample_window(context, &good, high, low, &out, NULL));

#define WINDOW(status, part, change)                                                 \
    do {                                                                             \
        azulejo_kdrt_options o = good;                                               \
        double min[2] = {0.25, 0.5}, max[2] = {0.75, 1};                             \
        (void)(change);                                                              \
        REFUSED(status, part, azulejo_kdrt_sample_window(context, &o, min, max, &out, NULL)); \
    } while (0)
    WINDOW(INVALID, "window_min: [0]", min[0] = NAN);
    WINDOW(INVALID, "window_min: [1]", min[1] = NAN);
    WINDOW(INVALID, "window_min: [0]", min[0] = -1e-9);
    WINDOW(INVALID, "window_min: [1]", min[1] = -INFINITY);
    WINDOW(INVALID, "window_min: [0]", min[0] = 2);
    WINDOW(INVALID, "window_max: [0]", max[0] = NAN);
    WINDOW(INVALID, "window_max: [1]", max[1] = NAN);
    WINDOW(INVALID, "window_max: [1]", max[1] = 1.000001);
    WINDOW(INVALID, "window_max: [0]", max[0] = INFINITY);
    WINDOW(INVALID, "window_max: [0]", max[0] = -1);
    WINDOW(INVALID, "window_max: [1]", (o.domain_max[1] = 0.75));
    WINDOW(INVALID, "domain_max", o.domain_max[0] = 0);
    WINDOW(INVALID, "radius", o.radius = NAN);
    WINDOW(INVALID, "boundary", o.boundary = 2);
    WINDOW(INVALID, "leaf_size", o.leaf_size = 5);
    WINDOW(AZULEJO_ERROR_TOO_LARGE, "radius", o.radius = 4e-6);
    CHECK(largest_number(last_error()) > 1.0e10 && largest_number(last_error()) < 1.2e10);
#undef WINDOW
    CHECK(out == UNTOUCHED);
}

static void kdrt_streams(void) {
    azulejo_kdrt_options good = kdrt_options(0.1);
    int visits = 0;
    REFUSED(INVALID, "context", azulejo_kdrt_stream(NULL, &good, never_visited, &visits, NULL));
    REFUSED(INVALID, "options", azulejo_kdrt_stream(context, NULL, never_visited, &visits, NULL));
    REFUSED(INVALID, "visit: is NULL", azulejo_kdrt_stream(context, &good, NULL, &visits, NULL));
#define STREAM(status, part, change)                                                   \
    do {                                                                               \
        azulejo_kdrt_options o = good;                                                 \
        (void)(change);                                                                \
        REFUSED(status, part, azulejo_kdrt_stream(context, &o, never_visited, &visits, NULL)); \
    } while (0)
    STREAM(INVALID, "radius", o.radius = 0);
    STREAM(INVALID, "radius: 1e-7 is below", o.radius = 1e-7);
    STREAM(INVALID, "domain_min", o.domain_min[0] = NAN);
    STREAM(INVALID, "boundary", o.boundary = -1);
    STREAM(INVALID, "leaf_size", o.leaf_size = NAN);
    STREAM(AZULEJO_ERROR_TOO_LARGE, "radius", (o.radius = 4e-6, o.leaf_size = 1e9)); /* not tiled */
#undef STREAM
    CHECK(visits == 0);
}

static void maximal(void) {
    azulejo_maximal_options good = maximal_options(0.1);
    azulejo_points *out = UNTOUCHED;
    REFUSED(INVALID, "context", azulejo_maximal_sample(NULL, &good, &out, NULL));
    REFUSED(INVALID, "options", azulejo_maximal_sample(context, NULL, &out, NULL));
    REFUSED(INVALID, "out", azulejo_maximal_sample(context, &good, NULL, NULL));
    CHECK(out == UNTOUCHED);

#define MAXIMAL(status, part, change)                                              \
    REFUSED_OPTION(azulejo_maximal_options o = good, status, part, change, \
                   azulejo_maximal_sample(context, &o, &points, NULL))
    MAXIMAL(INVALID, "radius", o.radius = 0);
    MAXIMAL(INVALID, "radius", o.radius = NAN);
    MAXIMAL(INVALID, "domain_min", o.domain_min[0] = NAN);
    MAXIMAL(INVALID, "domain_max", o.domain_max[1] = 0);
    MAXIMAL(INVALID, "boundary", o.boundary = 7);
    MAXIMAL(AZULEJO_ERROR_TOO_LARGE, "radius", o.radius = 8.3461e-7);
    CHECK(largest_number(last_error()) > 0.9e12 && largest_number(last_error()) < 1.1e12);
#undef MAXIMAL
}

static void meshes(void) {
    const float *positions = &cube_positions[0][0];
    const uint32_t *indices = &cube_indices[0][0];
    const size_t stride = 12;
    azulejo_mesh *out = UNTOUCHED;
    float bad_positions[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    uint32_t bad_indices[6] = {0, 1, 2, 0, 1, 3};
    const uint32_t flat[6] = {0, 1, 1, 2, 2, 2};
    int i;

    REFUSED(INVALID, "positions", azulejo_mesh_create(NULL, 8, stride, indices, 12, &out));
    REFUSED(INVALID, "indices", azulejo_mesh_create(positions, 8, stride, NULL, 12, &out));
    REFUSED(INVALID, "out", azulejo_mesh_create(positions, 8, stride, indices, 12, NULL));
    REFUSED(INVALID, "positions",
            azulejo_mesh_create((const float *)((const char *)positions + 1), 4, stride, indices, 1, &out));
    REFUSED(INVALID, "indices",
            azulejo_mesh_create(positions, 8, stride, (const uint32_t *)((const char *)indices + 2), 4, &out));

    REFUSED(INVALID, "stride_bytes: 0", azulejo_mesh_create(positions, 8, 0, indices, 12, &out));
    REFUSED(INVALID, "stride_bytes: 8", azulejo_mesh_create(positions, 8, 8, indices, 12, &out));
    REFUSED(INVALID, "stride_bytes: 11", azulejo_mesh_create(positions, 8, 11, indices, 12, &out));
    REFUSED(INVALID, "stride_bytes: 13", azulejo_mesh_create(positions, 4, 13, indices, 1, &out));

    REFUSED(INVALID, "indices", azulejo_mesh_create(positions, 8, stride, NULL, 0, &out));
    REFUSED(INVALID, "indices", azulejo_mesh_create(NULL, 0, stride, NULL, 0, &out));
    REFUSED(INVALID, "indices", azulejo_mesh_create(NULL, 0, stride, indices, 12, &out));
    REFUSED(INVALID, "indices", azulejo_mesh_create(positions, 7, stride, indices, 12, &out));
    REFUSED(INVALID, "indices", azulejo_mesh_create(bad_positions, 3, stride, bad_indices, 2, &out));
    bad_indices[5] = UINT32_MAX;
    REFUSED(INVALID, "indices", azulejo_mesh_create(bad_positions, 3, stride, bad_indices, 2, &out));
    REFUSED(INVALID, "area", azulejo_mesh_create(positions, 8, stride, flat, 2, &out));

    for (i = 0; i < 9; i++) {
        const float good = bad_positions[i];
        bad_positions[i] = i % 3 == 0 ? NAN : i % 3 == 1 ? INFINITY : -INFINITY;
        REFUSED(INVALID, "positions", azulejo_mesh_create(bad_positions, 3, stride, bad_indices, 1, &out));
        bad_positions[i] = good;
    }

    REFUSED(AZULEJO_ERROR_TOO_LARGE, "vertex_count", azulejo_mesh_create(positions, SIZE_MAX, 12, indices, 12, &out));
    REFUSED(AZULEJO_ERROR_TOO_LARGE, "vertex_count", azulejo_mesh_create(positions, 3, SIZE_MAX / 4 * 4, indices, 1, &out));
    REFUSED(AZULEJO_ERROR_TOO_LARGE, "vertex_count",
            azulejo_mesh_create(positions, SIZE_MAX / 8, 16, indices, 12, &out));
    REFUSED(AZULEJO_ERROR_TOO_LARGE, "triangle_count", azulejo_mesh_create(positions, 8, 12, indices, SIZE_MAX, &out));
    REFUSED(AZULEJO_ERROR_TOO_LARGE, "triangle_count",
            azulejo_mesh_create(positions, 8, 12, indices, SIZE_MAX / 12 + 2, &out));

    REFUSED(INVALID, "path", azulejo_mesh_load(NULL, &out));
    REFUSED(INVALID, "out", azulejo_mesh_load("cube.obj", NULL));
    CHECK(out == UNTOUCHED);
    azulejo_mesh_free(NULL);
    CHECK(azulejo_mesh_area(NULL) == 0);
    double origin[3] = {9, 9, 9};
    azulejo_mesh_origin(NULL, NULL);
    azulejo_mesh_origin(NULL, origin);
    CHECK(origin[0] == 0 && origin[1] == 0 && origin[2] == 0);
    CHECK(azulejo_mesh_vertex_count(NULL) == 0 && azulejo_mesh_triangle_count(NULL) == 0);
    CHECK(azulejo_mesh_positions(NULL) == NULL && azulejo_mesh_indices(NULL) == NULL);
}

static void psp(void) {
    azulejo_psp_options good = psp_options(0.2), zeros;
    const float bad_given[6] = {0, 0, 0, 0, 0, INFINITY}, good_given[6] = {0, 0, 0, 1, 1, 1};
    const double bad_clearances[3] = {-1, 0.5, NAN};
    azulejo_points *points = UNTOUCHED;
    azulejo_psp *out = UNTOUCHED;
    azulejo_psp_report report, before;
    UNWRITTEN(report);
    before = report;

    REFUSED(INVALID, "context", azulejo_psp_create(NULL, cube, &good, &out));
    REFUSED(INVALID, "mesh", azulejo_psp_create(context, NULL, &good, &out));
    REFUSED(INVALID, "options", azulejo_psp_create(context, cube, NULL, &out));
    REFUSED(INVALID, "out", azulejo_psp_create(context, cube, &good, NULL));
    REFUSED(INVALID, "context", azulejo_psp_sample(NULL, cube, &good, &points, &report));
    REFUSED(INVALID, "mesh", azulejo_psp_sample(context, NULL, &good, &points, &report));
    REFUSED(INVALID, "options", azulejo_psp_sample(context, cube, NULL, &points, &report));
    REFUSED(INVALID, "out", azulejo_psp_sample(context, cube, &good, NULL, &report));
    REFUSED(INVALID, "psp", azulejo_psp_advance(NULL, 1, &report));
    REFUSED(INVALID, "psp", azulejo_psp_fill(NULL, &report));
    REFUSED(INVALID, "psp", azulejo_psp_points(NULL, &points));

#define PSP(status, part, change)                                                                                \
    do {                                                                                                         \
        azulejo_psp_options o = good;                                                                            \
        (void)(change);                                                                                          \
        REFUSED(status, part, azulejo_psp_sample(context, cube, &o, &points, &report));                          \
        REFUSED(status, part, azulejo_psp_create(context, cube, &o, &out));                                      \
    } while (0)
    PSP(INVALID, "radius", o.radius = 0);
    PSP(INVALID, "radius", o.radius = -1);
    PSP(INVALID, "radius", o.radius = NAN);
    PSP(INVALID, "radius", o.radius = INFINITY);
    PSP(INVALID, "maximal", o.maximal = 2);
    PSP(INVALID, "maximal", o.maximal = -1);
    PSP(INVALID, "order", o.order = 2);
    PSP(INVALID, "quotient: 1.1 has no effect in any order", o.quotient = 1.1);
    PSP(INVALID, "count", o.count = 5);
    PSP(INVALID, "priority", o.priority = 2);
    PSP(INVALID, "priority", o.priority = -1);
    PSP(INVALID, "projectors", o.projectors = 2);
    PSP(INVALID, "reserved", o.reserved = 1);
    PSP(INVALID, "engine", o.engine = 3);
    PSP(INVALID, "engine", o.engine = -1);
    PSP(INVALID, "cosine: NaN", o.cosine = NAN);
    PSP(INVALID, "cosine: 1.5", o.cosine = 1.5);
    PSP(INVALID, "given_positions: is NULL", o.given_count = 1);
    PSP(INVALID, "given_positions: [1]", (o.given_positions = bad_given, o.given_count = 2));
    PSP(INVALID, "given_positions", (o.given_positions = (const float *)((const char *)bad_given + 2), o.given_count = 1));
    PSP(INVALID, "given_clearances: [0] is -1.0", (o.given_positions = bad_given, o.given_clearances = bad_clearances, o.given_count = 1));
    PSP(INVALID, "given_clearances: [1] is NaN", (o.given_positions = good_given, o.given_clearances = bad_clearances + 1, o.given_count = 2));
    PSP(AZULEJO_ERROR_TOO_LARGE, "given_count", (o.given_positions = good_given, o.given_count = SIZE_MAX));
    PSP(AZULEJO_ERROR_TOO_LARGE, "given_count", (o.given_positions = good_given, o.given_count = SIZE_MAX / 4));
    PSP(AZULEJO_ERROR_TOO_LARGE, "radius", o.radius = 2.0443e-6);
    CHECK(largest_number(last_error()) > 0.9e12 && largest_number(last_error()) < 1.1e12);
    PSP(AZULEJO_ERROR_TOO_LARGE, "radius", o.radius = 1e-300);
#undef PSP
    memset(&zeros, 0, sizeof zeros);
    zeros.struct_size = sizeof zeros;
    zeros.radius = 0.2;
    REFUSED(INVALID, "iterations: 0 with maximal off", azulejo_psp_sample(context, cube, &zeros, &points, &report));
    good.iterations = 2;
    REFUSED(INVALID, "iterations: 2 has no effect in azulejo_psp_create", azulejo_psp_create(context, cube, &good, &out));
    good.iterations = AZULEJO_ITERATIONS_DEFAULT;
    good.maximal = 0;
    REFUSED(INVALID, "maximal: 0 has no effect in azulejo_psp_create", azulejo_psp_create(context, cube, &good, &out));
    good.maximal = 1;
    CHECK(out == UNTOUCHED && points == UNTOUCHED);
    CHECK(memcmp(&report, &before, sizeof report) == 0);

    CHECK(azulejo_psp_create(context, cube, &good, &out) == AZULEJO_OK);
    REFUSED(INVALID, "out", azulejo_psp_points(out, NULL));
    azulejo_psp_free(out);
    azulejo_psp_free(NULL);
}

static void dcr(void) {
    azulejo_dcr_options good = dcr_options(5);
    float xy[8] = {0.1f, 0.1f, 0.6f, 0.2f, 0.3f, 0.8f, 0.9f, 0.9f};
    azulejo_points *out = UNTOUCHED;
    azulejo_dcr_report report, before;
    UNWRITTEN(report);
    before = report;

    REFUSED(INVALID, "context", azulejo_dcr_relax(NULL, &good, xy, 4, &out, &report));
    REFUSED(INVALID, "options", azulejo_dcr_relax(context, NULL, xy, 4, &out, &report));
    REFUSED(INVALID, "positions", azulejo_dcr_relax(context, &good, NULL, 4, &out, &report));
    REFUSED(INVALID, "positions", azulejo_dcr_relax(context, &good, (float *)((char *)xy + 2), 2, &out, &report));
    REFUSED(INVALID, "out", azulejo_dcr_relax(context, &good, xy, 4, NULL, &report));
    REFUSED(AZULEJO_ERROR_TOO_LARGE, "count", azulejo_dcr_relax(context, &good, xy, SIZE_MAX, &out, &report));
    REFUSED(AZULEJO_ERROR_TOO_LARGE, "count", azulejo_dcr_relax(context, &good, xy, SIZE_MAX / 8 + 2, &out, &report));

    /* Numbers out of range, and numbers in range that have no effect. */
    good.method = AZULEJO_METHOD_THESIS;
#define DCR(part, change) \
    REFUSED_OPTION(azulejo_dcr_options o = good, INVALID, part, change, \
                   azulejo_dcr_relax(context, &o, xy, 4, &points, &report))
    DCR("domain_min", o.domain_min[0] = NAN);
    DCR("domain_max", o.domain_max[1] = 0);
    DCR("boundary", o.boundary = 2);
    DCR("neighbourhood", o.neighbourhood = 2);
    DCR("neighbourhood", o.neighbourhood = -1);
    DCR("distribution", o.distribution = 5);
    DCR("distribution", o.distribution = -1);
    DCR("conflict_radius", o.conflict_radius = 0);
    DCR("conflict_radius", o.conflict_radius = 1.01);
    DCR("conflict_radius", o.conflict_radius = NAN);
    DCR("attraction_radius", o.attraction_radius = 0.9);
    DCR("attraction_radius", o.attraction_radius = NAN);
    DCR("step", o.step = 0);
    DCR("step", o.step = 1.5);
    DCR("step", o.step = NAN);
    DCR("neighbours", o.neighbours = 0);
    DCR("method", o.method = 2);
    DCR("method", o.method = -1);
    DCR("reserved", o.reserved = 1);
    DCR("tolerance", o.tolerance = NAN);
    DCR("visits", o.visits = 2);
    DCR("visits", o.visits = -1);
    DCR("convergence", o.convergence = 2);
    DCR("convergence", o.convergence = -1);
    DCR("decay", o.decay = 0);
    DCR("decay", o.decay = 1.01);
    DCR("decay", o.decay = NAN);
    good.method = AZULEJO_METHOD_MOMENTUM;
    DCR("conflict_radius: 0.9 has no effect with AZULEJO_METHOD_MOMENTUM", o.conflict_radius = 0.9);
    DCR("conflict_radius", o.conflict_radius = NAN);
    DCR("attraction_radius: 1.1 has no effect", o.attraction_radius = 1.1);
    DCR("step: 0.1 has no effect", o.step = 0.1);
    DCR("step", o.step = 0);
    DCR("decay: 0.5 has no effect", o.decay = 0.5);
    DCR("neighbours: 7 has no effect", o.neighbours = 7);
    DCR("distribution: 1 has no effect", o.distribution = AZULEJO_DISTRIBUTION_AVERAGE);
    DCR("visits: 1 has no effect", o.visits = AZULEJO_VISITS_ONE_END);
    DCR("convergence: 1 has no effect", o.convergence = AZULEJO_CONVERGENCE_VARIANCE);
    DCR("positions", xy[3] = NAN);
    DCR("positions", xy[3] = INFINITY);
    DCR("positions", xy[3] = 1); /* the upper boundary belongs to the next period */
    DCR("positions", xy[3] = -1e-6f);
#undef DCR
    CHECK(out == UNTOUCHED);
    CHECK(memcmp(&report, &before, sizeof report) == 0);
}

static void points(void) {
    CHECK(azulejo_points_count(NULL) == 0 && azulejo_points_dimension(NULL) == 0);
    CHECK(azulejo_points_positions(NULL) == NULL && azulejo_points_normals(NULL) == NULL);
    CHECK(azulejo_points_triangles(NULL) == NULL && azulejo_points_barycentrics(NULL) == NULL);
    azulejo_points_free(NULL);
}

int main(void) {
    char message[8] = "xxxxxxx";
    CHECK(azulejo_last_error_message(NULL, 0) == 1);
    CHECK(azulejo_last_error_message(message, sizeof message) == 1 && message[0] == '\0');

    context = make_context(2);
    cube = make_cube();
    names();
    contexts();
    kdrt();
    kdrt_windows();
    kdrt_streams();
    maximal();
    meshes();
    psp();
    dcr();
    points();
    azulejo_mesh_free(cube);
    azulejo_context_free(context);
    return finish();
}
