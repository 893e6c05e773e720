/* Handles and outputs that are none: misaligned pointers, handles of another type, and freed ones as far as that can be
   seen. Each is refused, leaves the outputs alone, and can be told from its message. */

#include "samples.h"

#define INVALID AZULEJO_ERROR_INVALID_ARGUMENT

/* A pointer that is off by some bytes: of this type, and not aligned for it. */
#define OFF(pointer, bytes) ((void *)((char *)(pointer) + (bytes)))

static azulejo_context *context;
static azulejo_mesh *cube;

static void misaligned(void) {
    const azulejo_kdrt_options kdrt = kdrt_options(0.2);
    const azulejo_psp_options options = psp_options(0.3);
    azulejo_points *points[2] = {UNTOUCHED, UNTOUCHED};
    azulejo_psp *set = NULL;
    azulejo_context *watched = UNTOUCHED;
    azulejo_plane_set plane;
    double distance[2] = {-1, -1};
    const float xy[4] = {0.1f, 0.1f, 0.6f, 0.6f};
    int bytes;
    ACCEPTED(azulejo_psp_create(context, cube, &options, &set));
    azulejo_plane_set_init(&plane, sizeof plane);
    plane.positions = xy;
    plane.count = 2;
    for (bytes = 1; bytes < 8; bytes++) {
        REFUSED(INVALID, "context: 0x", azulejo_kdrt_sample(OFF(context, bytes), &kdrt, points, NULL));
        REFUSED(INVALID, "is not aligned to 8 bytes", azulejo_context_watch(OFF(context, bytes), NULL, NULL, &watched));
        REFUSED(INVALID, "mesh: 0x", azulejo_psp_sample(context, OFF(cube, bytes), &options, points, NULL));
        REFUSED(INVALID, "psp: 0x", azulejo_psp_advance(OFF(set, bytes), 1, NULL));
        REFUSED(INVALID, "psp: 0x", azulejo_psp_fill(OFF(set, bytes), NULL));
        REFUSED(INVALID, "psp: 0x", azulejo_psp_points(OFF(set, bytes), points));
        REFUSED(INVALID, "out: 0x", azulejo_psp_points(set, OFF(points, bytes)));
        REFUSED(INVALID, "out: 0x", azulejo_kdrt_sample(context, &kdrt, OFF(points, bytes), NULL));
        REFUSED(INVALID, "out: 0x", azulejo_context_create(1, OFF(points, bytes)));
        REFUSED(INVALID, "out: 0x", azulejo_plane_smallest_distance(context, &plane, OFF(distance, bytes)));
        CHECK(azulejo_mesh_area(OFF(cube, bytes)) == 0 && azulejo_mesh_positions(OFF(cube, bytes)) == NULL);
        CHECK(strstr(last_error(), "mesh: 0x") != NULL && strstr(last_error(), "is not aligned to 8 bytes") != NULL);
        azulejo_mesh_free(OFF(cube, bytes));
    }
    CHECK(points[0] == UNTOUCHED && points[1] == UNTOUCHED && watched == UNTOUCHED);
    CHECK(distance[0] == -1 && distance[1] == -1);
    CHECK(azulejo_mesh_triangle_count(cube) == 12);
    azulejo_psp_free(set);
}

static void of_another_type(void) {
    const azulejo_kdrt_options kdrt = kdrt_options(0.2);
    const azulejo_psp_options options = psp_options(0.3);
    const azulejo_differences *list[1];
    azulejo_differences *mean = UNTOUCHED;
    azulejo_points *points = UNTOUCHED, *samples;
    ACCEPTED(azulejo_kdrt_sample(context, &kdrt, &samples, NULL));
    REFUSED(INVALID, "is no azulejo_context: it is a handle of another type",
            azulejo_kdrt_sample((azulejo_context *)cube, &kdrt, &points, NULL));
    REFUSED(INVALID, "is no azulejo_mesh: ", azulejo_psp_sample(context, (azulejo_mesh *)context, &options, &points, NULL));
    REFUSED(INVALID, "is no azulejo_psp: ", azulejo_psp_fill((azulejo_psp *)samples, NULL));
    REFUSED(INVALID, "is no azulejo_kdrt: ", azulejo_kdrt_window((azulejo_kdrt *)cube, kdrt.domain_min, kdrt.domain_max, &points));
    list[0] = (azulejo_differences *)samples;
    REFUSED(INVALID, "differences: [0]: 0x", azulejo_differences_mean(list, 1, &mean));
    list[0] = NULL;
    REFUSED(INVALID, "differences: [0]: is NULL", azulejo_differences_mean(list, 1, &mean));
    CHECK(points == UNTOUCHED && mean == UNTOUCHED);
    CHECK(azulejo_points_count((azulejo_points *)cube) == 0);
    CHECK(strstr(last_error(), "is no azulejo_points: ") != NULL);
    CHECK(azulejo_selection_indices((azulejo_selection *)samples) == NULL);
    CHECK(azulejo_spectrum_size((azulejo_spectrum *)samples) == 0 && azulejo_context_num_threads((azulejo_context *)cube) == 0);

    /* What is freed by the function of another type stays as it is. */
    azulejo_mesh_free((azulejo_mesh *)samples);
    CHECK(strstr(last_error(), "is no azulejo_mesh: ") != NULL);
    azulejo_context_free((azulejo_context *)cube);
    CHECK(azulejo_points_count(samples) > 10 && azulejo_mesh_triangle_count(cube) == 12);
    azulejo_points_free(samples);
}

/* Reads memory that was freed: the sanitizers of the library and valgrind rightly complain of it. */
static void freed(void) {
    const azulejo_kdrt_options kdrt = kdrt_options(0.2);
    const azulejo_psp_options options = psp_options(0.3);
    azulejo_context *old_context = make_context(1);
    azulejo_mesh *old_mesh = make_cube();
    azulejo_points *points = UNTOUCHED;
    azulejo_psp *set;
    ACCEPTED(azulejo_psp_create(context, cube, &options, &set));
    azulejo_psp_free(set);
    REFUSED(INVALID, "is no azulejo_psp: it ", azulejo_psp_fill(set, NULL));
    azulejo_mesh_free(old_mesh);
    REFUSED(INVALID, "is no azulejo_mesh: it ", azulejo_psp_sample(context, old_mesh, &options, &points, NULL));
    azulejo_mesh_free(old_mesh);
    CHECK(strstr(last_error(), "is no azulejo_mesh: it ") != NULL);
    azulejo_context_free(old_context);
    REFUSED(INVALID, "is no azulejo_context: it ", azulejo_kdrt_sample(old_context, &kdrt, &points, NULL));
    azulejo_context_free(old_context);
    CHECK(points == UNTOUCHED);
}

int main(void) {
    context = make_context(2);
    cube = make_cube();
    misaligned();
    of_another_type();
    if (getenv("AZULEJO_MEMORY_IS_WATCHED") == NULL) freed();
    azulejo_mesh_free(cube);
    azulejo_context_free(context);
    return finish();
}
