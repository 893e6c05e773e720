/* Sets on meshes that are edited: what a stroke erases and adds, ids, undo, given samples, refusals. */

#include <math.h>

#include "samples.h"

#define INVALID AZULEJO_ERROR_INVALID_ARGUMENT

static azulejo_context *one;
static azulejo_mesh *cube;

static azulejo_psp *make_set(const azulejo_psp_options *options) {
    azulejo_psp *set = NULL;
    if (!ACCEPTED(azulejo_psp_create(one, cube, options, &set)) || !ACCEPTED(azulejo_psp_fill(set, NULL))) exit(finish());
    return set;
}

static azulejo_points *points_of(const azulejo_psp *set) {
    azulejo_points *points = NULL;
    if (!ACCEPTED(azulejo_psp_points(set, &points))) exit(finish());
    return points;
}

static azulejo_region ball(double x, double y, double z, double radius) {
    azulejo_region region;
    ACCEPTED(azulejo_region_init(&region, sizeof region));
    region.centre[0] = x;
    region.centre[1] = y;
    region.centre[2] = z;
    region.radius = radius;
    return region;
}

/* The row of an id in a set, whose ids rise; -1 for none. */
static long row_of(const azulejo_points *points, uint64_t id) {
    const uint64_t *ids = azulejo_points_ids(points);
    size_t i;
    for (i = 0; i < azulejo_points_count(points); i++) {
        if (ids[i] == id) return (long)i;
    }
    return -1;
}

/* All samples of one set that stand in another one, with the same position. */
static size_t common(const azulejo_points *a, const azulejo_points *b) {
    size_t i, count = 0;
    for (i = 0; i < azulejo_points_count(a); i++) {
        const long row = row_of(b, azulejo_points_ids(a)[i]);
        if (row < 0) continue;
        count++;
        CHECK(memcmp(azulejo_points_positions(a) + 3 * i, azulejo_points_positions(b) + 3 * row, 3 * sizeof(float)) == 0);
    }
    return count;
}

static int is_maximal(const azulejo_points *points, double radius) {
    azulejo_coverage_report coverage;
    double smallest = 0;
    ACCEPTED(azulejo_coverage_report_init(&coverage, sizeof coverage));
    ACCEPTED(azulejo_space_smallest_distance(one, azulejo_points_positions(points), azulejo_points_count(points), &smallest));
    ACCEPTED(azulejo_mesh_coverage(one, cube, azulejo_points_positions(points), azulejo_points_count(points),
                                   radius, &coverage));
    return smallest >= radius && coverage.gaps == 0;
}

static void a_stroke_and_its_undo(void) {
    const azulejo_psp_options options = psp_options(0.05);
    const azulejo_region brush = ball(0.5, 0.5, 1, 0.3);
    azulejo_psp *set = make_set(&options);
    azulejo_points *before = points_of(set), *erased = NULL, *added = NULL, *after, *undone, *redone = NULL;
    azulejo_psp_report report = psp_report();
    CHECK(azulejo_points_ids(before) == NULL && azulejo_points_ids(NULL) == NULL);
    ACCEPTED(azulejo_psp_erase(set, &brush, &erased));
    azulejo_points_free(before);
    before = points_of(set);
    ACCEPTED(azulejo_psp_refill(set, 5, &added, &report));
    after = points_of(set);
    CHECK(azulejo_points_count(erased) > 50 && azulejo_points_count(added) > 50);
    CHECK(report.accepted == azulejo_points_count(added) && report.samples == azulejo_points_count(after));
    CHECK(common(before, after) == azulejo_points_count(before) && common(erased, after) == 0);
    CHECK(common(added, after) == azulejo_points_count(added) && is_maximal(after, 0.05));

    ACCEPTED(azulejo_psp_erase_ids(set, azulejo_points_ids(added), azulejo_points_count(added), NULL));
    ACCEPTED(azulejo_psp_restore(set, erased));
    undone = points_of(set);
    CHECK(common(erased, undone) == azulejo_points_count(erased) && is_maximal(undone, 0.05));
    CHECK(azulejo_points_count(undone) == azulejo_points_count(before) + azulejo_points_count(erased));

    ACCEPTED(azulejo_psp_erase(set, &brush, NULL));
    ACCEPTED(azulejo_psp_refill(set, 5, &redone, NULL));
    CHECK(azulejo_points_count(redone) == azulejo_points_count(added) &&
          memcmp(azulejo_points_positions(redone), azulejo_points_positions(added),
                 3 * sizeof(float) * azulejo_points_count(added)) == 0);
    azulejo_psp_free(set);
    azulejo_points_free(before);
    azulejo_points_free(erased);
    azulejo_points_free(added);
    azulejo_points_free(after);
    azulejo_points_free(undone);
    azulejo_points_free(redone);
}

static void given_samples_come_and_go(void) {
    const float places[2][3] = {{0.5f, 0.5f, 1}, {0.2f, 0.2f, 1.1f}};
    const double clearances[2] = {0.25, 0.2};
    uint64_t first = 77, none = 99;
    azulejo_psp_options options = psp_options(0.05);
    azulejo_psp *set;
    azulejo_points *erased = NULL, *points;
    size_t i, count;
    options.given_positions = places[0];
    options.given_clearances = clearances;
    options.given_count = 1;
    set = make_set(&options);
    ACCEPTED(azulejo_psp_add_given(set, places[1], &clearances[1], 1, &first, &erased));
    CHECK(first == 1 && azulejo_points_count(erased) > 10);
    ACCEPTED(azulejo_psp_refill(set, 1, NULL, NULL));
    points = points_of(set);
    for (i = 0; i < azulejo_points_count(points); i++) {
        const float *p = azulejo_points_positions(points) + 3 * i;
        int j;
        for (j = 0; j < 2; j++) {
            const double x = (double)p[0] - places[j][0], y = (double)p[1] - places[j][1], z = (double)p[2] - places[j][2];
            CHECK(sqrt(x * x + y * y + z * z) >= clearances[j]);
        }
    }
    count = azulejo_points_count(points);
    azulejo_points_free(points);
    first = 0;
    ACCEPTED(azulejo_psp_remove_given(set, &first, 1));
    REFUSED(INVALID, "ids: [0] is 0, which no given sample has", azulejo_psp_remove_given(set, &first, 1));
    first = 1;
    ACCEPTED(azulejo_psp_remove_given(set, &first, 1));
    ACCEPTED(azulejo_psp_fill(set, NULL));
    points = points_of(set);
    CHECK(azulejo_points_count(points) > count + 20 && is_maximal(points, 0.05));
    ACCEPTED(azulejo_psp_add_given(set, NULL, NULL, 0, NULL, NULL));
    REFUSED(INVALID, "given_positions", azulejo_psp_add_given(set, NULL, NULL, 1, &none, NULL));
    REFUSED(INVALID, "given_clearances: [0] is -1", azulejo_psp_add_given(set, places[0], (double[]){-1}, 1, &none, NULL));
    REFUSED(INVALID, "first_id: ", azulejo_psp_add_given(set, places[0], NULL, 1, (uint64_t *)(void *)((char *)&none + 1), NULL));
    CHECK(none == 99);
    azulejo_points_free(erased);
    azulejo_points_free(points);
    azulejo_psp_free(set);
}

/* A progress callback that edits the set that is being filled, which is refused, and then cancels. */
typedef struct {
    azulejo_psp *set;
    int refused;
} meddler;

static uint32_t meddle(void *user, double done) {
    meddler *self = user;
    const azulejo_region all = ball(0, 0, 0, 9);
    (void)done;
    self->refused = azulejo_psp_erase(self->set, &all, NULL) != AZULEJO_OK;
    return 1;
}

static void refusals(void) {
    azulejo_psp_options options = psp_options(0.1);
    azulejo_kdrt_options plane = kdrt_options(0.2);
    azulejo_region region = ball(0, 0, 0, 0.5);
    azulejo_points *out = UNTOUCHED, *flat = NULL, *erased = NULL, *points;
    azulejo_psp *set;
    meddler user = {NULL, 0};
    const uint64_t ids[2] = {3, 1000000}, twice[2] = {3, 3};
    size_t count;
    options.progress = meddle;
    options.progress_user = &user;
    ACCEPTED(azulejo_psp_create(one, cube, &options, &set));
    user.set = set;
    ACCEPTED(azulejo_kdrt_sample(one, &plane, &flat, NULL));

    REFUSED(INVALID, "psp", azulejo_psp_erase(NULL, &region, &out));
    REFUSED(INVALID, "region", azulejo_psp_erase(set, NULL, &out));
    REFUSED(INVALID, "psp", azulejo_psp_refill(NULL, 0, &out, NULL));
    REFUSED(INVALID, "psp", azulejo_psp_restore(NULL, flat));
    REFUSED(INVALID, "points: is NULL", azulejo_psp_restore(set, NULL));
    REFUSED(INVALID, "points: are samples of the plane", azulejo_psp_restore(set, flat));
    REFUSED(INVALID, "ids", azulejo_psp_erase_ids(set, NULL, 1, &out));
    region.radius = NAN;
    REFUSED(INVALID, "region: radius is NaN", azulejo_psp_erase(set, &region, &out));
    region.radius = 0.5;
    region.min[2] = 1;
    region.max[2] = 0;
    REFUSED(INVALID, "region: max[2] is 0.0, not from min[2] 1.0 on", azulejo_psp_erase(set, &region, &out));
    region.min[2] = -1;
    region.reserved = 1;
    REFUSED(INVALID, "reserved", azulejo_psp_erase(set, &region, &out));
    region.reserved = 0;

    /* The set was never filled: the first refill does, and is cancelled once. */
    REFUSED(AZULEJO_ERROR_CANCELLED, "cancelled", azulejo_psp_refill(set, 1, &out, NULL));
    CHECK(user.refused && out == UNTOUCHED);
    points = points_of(set);
    CHECK(azulejo_points_count(points) == 0);
    azulejo_points_free(points);
    azulejo_psp_free(set);

    options.progress = NULL;
    set = make_set(&options);
    REFUSED(INVALID, "ids: [1] is 1000000, which no sample", azulejo_psp_erase_ids(set, ids, 2, &out));
    REFUSED(INVALID, "ids: 3 is listed twice", azulejo_psp_erase_ids(set, twice, 2, &out));
    points = points_of(set);
    count = azulejo_points_count(points);
    REFUSED(INVALID, "points: [0] stands already", azulejo_psp_restore(set, points));
    ACCEPTED(azulejo_psp_erase_ids(set, ids, 1, &erased));
    ACCEPTED(azulejo_psp_refill(set, 9, NULL, NULL));
    azulejo_points_free(points);
    points = points_of(set);
    CHECK(row_of(points, 3) < 0);
    if (azulejo_points_count(points) == count) REFUSED(INVALID, "conflicts with sample", azulejo_psp_restore(set, erased));
    REFUSED(INVALID, "psp: has been edited", azulejo_psp_advance(set, 1, NULL));
    CHECK(out == UNTOUCHED);
    azulejo_points_free(points);
    azulejo_points_free(erased);
    azulejo_points_free(flat);
    azulejo_psp_free(set);
}

int main(void) {
    one = make_context(1);
    cube = make_cube();
    a_stroke_and_its_undo();
    given_samples_come_and_go();
    refusals();
    azulejo_mesh_free(cube);
    azulejo_context_free(one);
    return finish();
}
