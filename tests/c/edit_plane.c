/* Sets of the plane that are edited: strokes over the seam, ids, undo, given samples, positions of the host, refusals. */

#include <math.h>

#include "samples.h"

#define INVALID AZULEJO_ERROR_INVALID_ARGUMENT

static azulejo_context *one;

static azulejo_plane *make_set(const azulejo_kdrt_options *options, const float *positions, size_t count) {
    azulejo_plane *set = NULL;
    if (!ACCEPTED(azulejo_plane_create(one, options, positions, count, &set))) exit(finish());
    return set;
}

static azulejo_points *points_of(const azulejo_plane *set) {
    azulejo_points *points = NULL;
    if (!ACCEPTED(azulejo_plane_points(set, &points))) exit(finish());
    return points;
}

static azulejo_region disk(double x, double y, double radius) {
    azulejo_region region;
    ACCEPTED(azulejo_region_init(&region, sizeof region));
    region.centre[0] = x;
    region.centre[1] = y;
    region.radius = radius;
    return region;
}

/* True if two sets have the same ids and positions. */
static int same(const azulejo_points *a, const azulejo_points *b) {
    const size_t count = azulejo_points_count(a);
    return azulejo_points_count(b) == count &&
           memcmp(azulejo_points_ids(a), azulejo_points_ids(b), count * sizeof(uint64_t)) == 0 &&
           memcmp(azulejo_points_positions(a), azulejo_points_positions(b), 2 * count * sizeof(float)) == 0;
}

/* The smallest distance and the covering radius of a set of the unit torus are those of a maximal one. */
static int is_maximal(const azulejo_points *points, double radius) {
    azulejo_plane_set set;
    double smallest = 0, covering = 9;
    ACCEPTED(azulejo_plane_set_init(&set, sizeof set));
    set.positions = azulejo_points_positions(points);
    set.count = azulejo_points_count(points);
    ACCEPTED(azulejo_plane_smallest_distance(one, &set, &smallest));
    ACCEPTED(azulejo_plane_covering_radius(one, &set, &covering));
    return smallest >= radius && covering <= radius + 1e-6;
}

static void a_stroke_over_the_seam_and_its_undo(void) {
    const azulejo_kdrt_options options = kdrt_options(0.01);
    const azulejo_region brush = disk(1.0, 0.5, 0.1);
    azulejo_plane *set = make_set(&options, NULL, 0);
    azulejo_points *whole = NULL, *before = points_of(set), *erased = NULL, *added = NULL, *after, *undone, *redone = NULL;
    azulejo_kdrt_report report;
    size_t i, left = 0;
    ACCEPTED(azulejo_kdrt_report_init(&report, sizeof report));
    ACCEPTED(azulejo_kdrt_sample(one, &options, &whole, NULL));
    CHECK(azulejo_points_ids(whole) == NULL && azulejo_points_ids(before)[5] == 5);
    CHECK(azulejo_points_count(whole) == azulejo_points_count(before) &&
          memcmp(azulejo_points_positions(whole), azulejo_points_positions(before),
                 2 * sizeof(float) * azulejo_points_count(whole)) == 0);

    ACCEPTED(azulejo_plane_erase(set, &brush, &erased));
    for (i = 0; i < azulejo_points_count(erased); i++) left += azulejo_points_positions(erased)[2 * i] < 0.5f;
    CHECK(left > 50 && azulejo_points_count(erased) - left > 50 && azulejo_points_dimension(erased) == 2);
    ACCEPTED(azulejo_plane_refill(set, 5, &added, &report));
    after = points_of(set);
    CHECK(azulejo_points_count(added) > 150 && is_maximal(after, 0.01));
    CHECK(report.samples == azulejo_points_count(after) && report.is_maximal == 1 && report.radius == 0.01);

    ACCEPTED(azulejo_plane_erase_ids(set, azulejo_points_ids(added), azulejo_points_count(added), NULL));
    ACCEPTED(azulejo_plane_restore(set, erased));
    undone = points_of(set);
    CHECK(same(undone, before));
    ACCEPTED(azulejo_plane_erase(set, &brush, NULL));
    ACCEPTED(azulejo_plane_refill(set, 5, &redone, NULL));
    CHECK(azulejo_points_count(redone) == azulejo_points_count(added) &&
          memcmp(azulejo_points_positions(redone), azulejo_points_positions(added),
                 2 * sizeof(float) * azulejo_points_count(added)) == 0);
    azulejo_plane_free(set);
    azulejo_points_free(whole);
    azulejo_points_free(before);
    azulejo_points_free(erased);
    azulejo_points_free(added);
    azulejo_points_free(after);
    azulejo_points_free(undone);
    azulejo_points_free(redone);
}

static void given_samples_and_positions_of_the_host(void) {
    const float placed[4] = {0.25f, 0.5f, 0.7f, 0.1234567f}, house[2] = {0.7f, 0.2f};
    const double clearance = 0.2;
    uint64_t first = 77;
    azulejo_kdrt_options options = kdrt_options(0.05);
    azulejo_plane *set = make_set(&options, placed, 2);
    azulejo_points *erased = NULL, *points;
    size_t i, count;
    ACCEPTED(azulejo_plane_refill(set, 1, NULL, NULL));
    points = points_of(set);
    CHECK(memcmp(azulejo_points_positions(points), placed, sizeof placed) == 0 && is_maximal(points, 0.05));
    azulejo_points_free(points);

    ACCEPTED(azulejo_plane_add_given(set, house, &clearance, 1, &first, &erased));
    CHECK(first == 0 && azulejo_points_count(erased) > 10 && azulejo_points_ids(erased)[0] == 1);
    ACCEPTED(azulejo_plane_refill(set, 1, NULL, NULL));
    points = points_of(set);
    count = azulejo_points_count(points);
    for (i = 0; i < count; i++) {
        const float *p = azulejo_points_positions(points) + 2 * i;
        CHECK(hypot((double)p[0] - house[0], (double)p[1] - house[1]) >= clearance);
    }
    azulejo_points_free(points);
    ACCEPTED(azulejo_plane_remove_given(set, &first, 1));
    REFUSED(INVALID, "ids: [0] is 0, which no given sample has", azulejo_plane_remove_given(set, &first, 1));
    ACCEPTED(azulejo_plane_refill(set, 2, NULL, NULL));
    points = points_of(set);
    CHECK(azulejo_points_count(points) > count + 20 && is_maximal(points, 0.05));
    azulejo_points_free(points);
    azulejo_points_free(erased);
    azulejo_plane_free(set);
}

/* A progress callback that edits the set that is being filled, which is refused, and then cancels. */
typedef struct {
    azulejo_plane *set;
    int refused;
} meddler;

static uint32_t meddle(void *user, double done) {
    meddler *self = user;
    const azulejo_region all = disk(0, 0, 9);
    azulejo_points *out = UNTOUCHED;
    (void)done;
    if (self->set == NULL) return 0;
    self->refused = azulejo_plane_erase(self->set, &all, NULL) == AZULEJO_ERROR_BUSY &&
                    azulejo_plane_points(self->set, &out) == AZULEJO_ERROR_BUSY && out == UNTOUCHED;
    return 1;
}

static void refusals(void) {
    const float near[4] = {0.5f, 0.5f, 0.55f, 0.5f};
    const uint64_t ids[2] = {3, 1000000}, twice[2] = {3, 3};
    azulejo_kdrt_options options = kdrt_options(0.1);
    azulejo_psp_options on_mesh = psp_options(0.5);
    azulejo_region region = disk(0, 0, 0.5);
    azulejo_points *out = UNTOUCHED, *solid = NULL, *flat = NULL;
    azulejo_plane *set = UNTOUCHED;
    azulejo_mesh *cube = make_cube();
    meddler user = {NULL, 0};
    REFUSED(INVALID, "positions: [1] is closer to [0]", azulejo_plane_create(one, &options, near, 2, &set));
    REFUSED(INVALID, "positions", azulejo_plane_create(one, &options, NULL, 2, &set));
    options.order = AZULEJO_ORDER_PROGRESSIVE;
    REFUSED(INVALID, "order: progressive", azulejo_plane_create(one, &options, NULL, 0, &set));
    options.order = AZULEJO_ORDER_ANY;
    options.count = 9;
    REFUSED(INVALID, "count", azulejo_plane_create(one, &options, NULL, 0, &set));
    options.count = 0;
    CHECK(set == UNTOUCHED);
    ACCEPTED(azulejo_kdrt_sample(one, &options, &flat, NULL));
    options.progress = meddle;
    options.progress_user = &user;
    set = make_set(&options, NULL, 0);
    user.set = set;
    ACCEPTED(azulejo_psp_sample(one, cube, &on_mesh, &solid, NULL));

    REFUSED(INVALID, "plane", azulejo_plane_erase(NULL, &region, &out));
    REFUSED(INVALID, "region", azulejo_plane_erase(set, NULL, &out));
    REFUSED(INVALID, "plane", azulejo_plane_refill(NULL, 0, &out, NULL));
    REFUSED(INVALID, "points: are samples of a mesh", azulejo_plane_restore(set, solid));
    REFUSED(INVALID, "points: are not samples of a set that is edited", azulejo_plane_restore(set, flat));
    REFUSED(INVALID, "is no azulejo_plane: ", azulejo_plane_points((azulejo_plane *)flat, &out));
    REFUSED(INVALID, "ids: [1] is 1000000, which no sample", azulejo_plane_erase_ids(set, ids, 2, &out));
    REFUSED(INVALID, "ids: 3 is listed twice", azulejo_plane_erase_ids(set, twice, 2, &out));
    REFUSED(INVALID, "given_positions", azulejo_plane_add_given(set, NULL, NULL, 1, NULL, &out));
    region.radius = NAN;
    REFUSED(INVALID, "region: radius is NaN", azulejo_plane_erase(set, &region, &out));
    REFUSED(AZULEJO_ERROR_CANCELLED, "cancelled", azulejo_plane_refill(set, 1, &out, NULL));
    CHECK(user.refused && out == UNTOUCHED);
    azulejo_points_free(solid);
    azulejo_points_free(flat);
    azulejo_mesh_free(cube);
    azulejo_plane_free(set);
    azulejo_plane_free(NULL);
}

int main(void) {
    one = make_context(1);
    a_stroke_over_the_seam_and_its_undo();
    given_samples_and_positions_of_the_host();
    refusals();
    azulejo_context_free(one);
    return finish();
}
