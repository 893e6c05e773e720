/* Windows in the caller's arrays, relative to their corner: on all images of a periodic plane the samples of the whole, tiles
   that fit together, ranks and classes, arrays that are too small, a million radii;
   bad arguments are refused and nothing is written. */

#include <math.h>

#include "samples.h"

#define INVALID AZULEJO_ERROR_INVALID_ARGUMENT
#define MOST 4096

static azulejo_context *one;
static float positions[2 * MOST], ranks[MOST];
static uint32_t classes[MOST];

static azulejo_kdrt_options wide_options(double radius) {
    azulejo_kdrt_options options = kdrt_options(radius);
    options.domain_min[0] = -1;
    options.domain_min[1] = 2;
    options.domain_max[0] = 3;
    options.domain_max[1] = 4;
    return options;
}

static azulejo_kdrt *make_plane(const azulejo_kdrt_options *options) {
    azulejo_kdrt *plane = NULL;
    if (!ACCEPTED(azulejo_kdrt_create(one, options, &plane))) exit(finish());
    return plane;
}

/* The number of images of samples of the whole in a window; those that the arrays lack count as wrong. */
static size_t images(const azulejo_points *whole, const double min[2], const double max[2], size_t count, int *wrong) {
    const float *xy = azulejo_points_positions(whole), *rank = azulejo_points_ranks(whole);
    size_t i, j, found = 0;
    for (i = 0; i < azulejo_points_count(whole); i++) {
        const double x = xy[2 * i] + 4 * ceil((min[0] - xy[2 * i]) / 4);
        const double y = xy[2 * i + 1] + 2 * ceil((min[1] - xy[2 * i + 1]) / 2);
        if (x >= max[0] || y >= max[1]) continue;
        found++;
        for (j = 0; j < count; j++) {
            if (positions[2 * j] == (float)(x - min[0]) && positions[2 * j + 1] == (float)(y - min[1])) break;
        }
        *wrong += j == count || (rank && ranks[j] != rank[i]);
    }
    return found;
}

static void windows_anywhere(azulejo_kdrt_options options) {
    const double corners[][2] = {{0, 2}, {2.75, 3.875}, {-1e6 - 0.25, 0.5}, {3.5e8, -7e7}, {-1.125, 1.875}};
    azulejo_kdrt *plane = make_plane(&options);
    azulejo_points *whole = NULL;
    const double extent[2] = {0.5, 0.375};
    size_t i, count = 0, room = 0;
    CHECK(azulejo_kdrt_unit(plane) == ldexp(1, -22));
    ACCEPTED(azulejo_kdrt_sample(one, &options, &whole, NULL));
    ACCEPTED(azulejo_kdrt_window_capacity(plane, extent, &room));
    CHECK(room <= MOST);
    for (i = 0; i < COUNT_OF(corners); i++) {
        const double *min = corners[i], max[2] = {corners[i][0] + extent[0], corners[i][1] + extent[1]};
        int wrong = 0;
        memset(positions, 0xff, sizeof positions);
        ACCEPTED(azulejo_kdrt_window_into(plane, min, max, positions, options.order ? ranks : NULL, NULL, room, &count));
        CHECK(count > 20 && count <= room && images(whole, min, max, count, &wrong) == count && wrong == 0);
        CHECK(isnan(positions[2 * count])); /* and no more */
        /* As many as there are suffice; one less does not, and nothing is written but the number. */
        ACCEPTED(azulejo_kdrt_window_into(plane, min, max, positions, NULL, NULL, count, &count));
        memset(positions, 0xff, sizeof positions);
        wrong = (int)count;
        count = 0;
        REFUSED(INVALID, "capacity",
                azulejo_kdrt_window_into(plane, min, max, positions, NULL, NULL, (size_t)wrong - 1, &count));
        CHECK(count == (size_t)wrong && isnan(positions[0]));
        count = 0;
        REFUSED(INVALID, "capacity: 0 is below", azulejo_kdrt_window_into(plane, min, max, NULL, NULL, NULL, 0, &count));
        CHECK(count == (size_t)wrong);
    }
    azulejo_points_free(whole);
    azulejo_kdrt_free(plane);
}

/* A row of tiles beyond a million periods: two samples of neighbours are at least the radius apart. */
static void tiles_fit_together(void) {
    const azulejo_kdrt_options options = wide_options(0.02);
    azulejo_kdrt *plane = make_plane(&options);
    static double row[2 * MOST];
    size_t samples = 0, tile, i, j, count = 0, conflicts = 0;
    for (tile = 0; tile < 12; tile++) {
        const double left = 5e6 + 0.375 * (double)tile, min[2] = {left, 1e6}, max[2] = {left + 0.375, 1e6 + 0.125};
        ACCEPTED(azulejo_kdrt_window_into(plane, min, max, positions, NULL, NULL, MOST, &count));
        CHECK(count > 0 && samples + count <= MOST);
        for (i = 0; i < count; i++, samples++) {
            row[2 * samples] = left - 5e6 + positions[2 * i];
            row[2 * samples + 1] = positions[2 * i + 1];
        }
    }
    CHECK(samples > 800);
    for (i = 0; i < samples; i++) {
        for (j = 0; j < i; j++) {
            const double dx = row[2 * i] - row[2 * j], dy = row[2 * i + 1] - row[2 * j + 1];
            conflicts += sqrt(dx * dx + dy * dy) < 0.02;
        }
    }
    CHECK(conflicts == 0);
    azulejo_kdrt_free(plane);
}

static void several_classes(void) {
    const double own[4] = {0.08, 0.05, 0.05, 0.06}, min[2] = {2.5, 3.5}, max[2] = {3.5, 4.5};
    azulejo_kdrt_options options = wide_options(0);
    azulejo_classes kinds;
    azulejo_kdrt *plane = NULL;
    size_t count = 0, room = 0, i, of_class[2] = {0, 0};
    const double extent[2] = {1, 1};
    azulejo_classes_init(&kinds, sizeof kinds);
    kinds.count = 2;
    kinds.radii = own;
    ACCEPTED(azulejo_kdrt_create_classes(one, &options, &kinds, &plane));
    ACCEPTED(azulejo_kdrt_window_capacity(plane, extent, &room));
    ACCEPTED(azulejo_kdrt_window_into(plane, min, max, positions, NULL, classes, MOST, &count));
    CHECK(count <= room);
    for (i = 0; i < count && classes[i] < 2; i++) of_class[classes[i]]++;
    CHECK(of_class[0] > 50 && of_class[1] > 50 && of_class[0] + of_class[1] == count);
    REFUSED(INVALID, "ranks: the plane has no ranks",
            azulejo_kdrt_window_into(plane, min, max, positions, ranks, classes, MOST, &count));
    azulejo_kdrt_free(plane);
}

/* A million radii a side: tiles at its end, across its seam, and at the same place some periods on. */
static void wide_planes(void) {
    azulejo_kdrt_options options = kdrt_options(1);
    azulejo_kdrt *plane = UNTOUCHED;
    azulejo_points *points = UNTOUCHED;
    static float first[2 * MOST];
    const double extent[2] = {32, 32};
    size_t i, count = 0, again = 0, room = 0;
    options.domain_max[0] = options.domain_max[1] = 1048576;
    REFUSED(INVALID, "radius: 1", azulejo_kdrt_create(one, &options, &plane));
    ACCEPTED(azulejo_kdrt_create_wide(one, &options, &plane));
    ACCEPTED(azulejo_kdrt_window_capacity(plane, extent, &room));
    CHECK(room <= MOST && azulejo_kdrt_unit(plane) == 1.0 / 256);
    for (i = 0; i < 4; i++) {
        const double corner = 1048576 - 11, min[2] = {corner, corner - 300 * (double)i};
        const double max[2] = {min[0] + 32, min[1] + 32};
        const double next[2] = {min[0] + 5 * 1048576.0, min[1] - 3e6 * 1048576.0};
        const double next_max[2] = {next[0] + 32, next[1] + 32};
        ACCEPTED(azulejo_kdrt_window_into(plane, min, max, first, NULL, NULL, room, &count));
        ACCEPTED(azulejo_kdrt_window_into(plane, next, next_max, positions, NULL, NULL, room, &again));
        CHECK(count > 600 && count == again && memcmp(first, positions, 8 * count) == 0);
    }
    REFUSED(INVALID, "plane: is wide", azulejo_kdrt_window(plane, options.domain_min, extent, &points));
    CHECK(points == UNTOUCHED);
    azulejo_kdrt_free(plane);
    plane = UNTOUCHED;
    options.order = AZULEJO_ORDER_PROGRESSIVE;
    REFUSED(INVALID, "order", azulejo_kdrt_create_wide(one, &options, &plane));
    options.order = AZULEJO_ORDER_ANY;
    options.domain_max[0] = options.domain_max[1] = 90;
    REFUSED(INVALID, "domain_max: 90 by 90", azulejo_kdrt_create_wide(one, &options, &plane));
    REFUSED(INVALID, "options", azulejo_kdrt_create_wide(one, NULL, &plane));
    REFUSED(INVALID, "context", azulejo_kdrt_create_wide(NULL, &options, &plane));
    REFUSED(INVALID, "out", azulejo_kdrt_create_wide(one, &options, NULL));
    CHECK(plane == UNTOUCHED);
}

static void bad_arguments(void) {
    const azulejo_kdrt_options options = wide_options(0.02);
    azulejo_kdrt *plane = make_plane(&options);
    const double min[2] = {0, 3}, max[2] = {1, 3.5};
    const double *misaligned = (const double *)((const char *)min + 1);
    float *odd = (float *)((char *)positions + 1);
    size_t count = 77, room = 77;
#define NO_WINDOW(part, call)                    \
    do {                                         \
        positions[0] = 5;                        \
        REFUSED(INVALID, part, call);            \
        CHECK(count == 77 && positions[0] == 5); \
    } while (0)
    NO_WINDOW("plane", azulejo_kdrt_window_into(NULL, min, max, positions, NULL, NULL, MOST, &count));
    NO_WINDOW("window_min", azulejo_kdrt_window_into(plane, NULL, max, positions, NULL, NULL, MOST, &count));
    NO_WINDOW("window_min", azulejo_kdrt_window_into(plane, misaligned, max, positions, NULL, NULL, MOST, &count));
    NO_WINDOW("window_max", azulejo_kdrt_window_into(plane, min, NULL, positions, NULL, NULL, MOST, &count));
    NO_WINDOW("window_max: [0] is 0", azulejo_kdrt_window_into(plane, min, min, positions, NULL, NULL, MOST, &count));
    NO_WINDOW("positions", azulejo_kdrt_window_into(plane, min, max, NULL, NULL, NULL, MOST, &count));
    NO_WINDOW("positions", azulejo_kdrt_window_into(plane, min, max, odd, NULL, NULL, MOST, &count));
    NO_WINDOW("ranks", azulejo_kdrt_window_into(plane, min, max, positions, odd, NULL, MOST, &count));
    NO_WINDOW("classes", azulejo_kdrt_window_into(plane, min, max, positions, NULL, classes, MOST, &count));
    NO_WINDOW("count", azulejo_kdrt_window_into(plane, min, max, positions, NULL, NULL, MOST, NULL));
    REFUSED(AZULEJO_ERROR_TOO_LARGE, "capacity",
            azulejo_kdrt_window_into(plane, min, max, positions, NULL, NULL, SIZE_MAX / 4, &count));
    {
        const double too_wide[2] = {4.5, 3.5}, nan[2] = {NAN, 0}, far[2] = {1e30, 0};
        NO_WINDOW("window_max: [0] is 4.5, more than the period 4",
                  azulejo_kdrt_window_into(plane, min, too_wide, positions, NULL, NULL, MOST, &count));
        NO_WINDOW("window_min: [0]", azulejo_kdrt_window_into(plane, nan, max, positions, NULL, NULL, MOST, &count));
        NO_WINDOW("window_min: [0]", azulejo_kdrt_window_into(plane, far, far, positions, NULL, NULL, MOST, &count));
    }
#undef NO_WINDOW
    {
        const double none[2] = {0, 1}, vast[2] = {1e9, 1e9};
        REFUSED(INVALID, "extent: [0] is 0", azulejo_kdrt_window_capacity(plane, none, &room));
        REFUSED(INVALID, "extent: is NULL", azulejo_kdrt_window_capacity(plane, NULL, &room));
        REFUSED(INVALID, "plane", azulejo_kdrt_window_capacity(NULL, max, &room));
        REFUSED(INVALID, "out", azulejo_kdrt_window_capacity(plane, max, NULL));
        REFUSED(AZULEJO_ERROR_TOO_LARGE, "extent", azulejo_kdrt_window_capacity(plane, vast, &room));
        CHECK(room == 77 && azulejo_kdrt_unit(NULL) == 0);
    }
    azulejo_kdrt_free(plane);
}

int main(void) {
    azulejo_kdrt_options options = wide_options(0.02);
    one = make_context(1);
    windows_anywhere(options);
    options.order = AZULEJO_ORDER_PROGRESSIVE;
    windows_anywhere(options);
    tiles_fit_together();
    several_classes();
    wide_planes();
    bad_arguments();
    azulejo_context_free(one);
    return finish();
}
