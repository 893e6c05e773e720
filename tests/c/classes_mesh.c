/* Several classes on a mesh: all distances of the matrix are kept, on any number of threads, masks and clearances by class
   are heeded, and what does not go with classes is refused. */

#include <math.h>

#include "samples.h"

static azulejo_context *one, *three;
static azulejo_mesh *cube;

static double distance(const float *a, const float *b) {
    const double x = (double)a[0] - b[0], y = (double)a[1] - b[1], z = (double)a[2] - b[2];
    return sqrt(x * x + y * y + z * z);
}

static azulejo_classes classes_of(const double *radii, uint32_t count) {
    azulejo_classes classes;
    ACCEPTED(azulejo_classes_init(&classes, sizeof classes));
    classes.count = count;
    classes.radii = radii;
    return classes;
}

/* The set, the same on one thread and on three. */
static azulejo_points *sample(const azulejo_psp_options *options, const azulejo_classes *classes) {
    azulejo_points *points = NULL, *again = NULL;
    size_t count;
    if (!ACCEPTED(azulejo_psp_sample_classes(one, cube, options, classes, &points))) exit(finish());
    if (!ACCEPTED(azulejo_psp_sample_classes(three, cube, options, classes, &again))) exit(finish());
    count = azulejo_points_count(points);
    CHECK(count == azulejo_points_count(again));
    CHECK(memcmp(azulejo_points_positions(points), azulejo_points_positions(again), 3 * count * sizeof(float)) == 0);
    CHECK(memcmp(azulejo_points_classes(points), azulejo_points_classes(again), count * sizeof(uint32_t)) == 0);
    azulejo_points_free(again);
    return points;
}

static void keeps_radii(const azulejo_points *points, const double *radii, uint32_t count) {
    const float *xyz = azulejo_points_positions(points);
    const uint32_t *class_of = azulejo_points_classes(points);
    size_t i, j, len = azulejo_points_count(points), conflicts = 0;
    for (i = 0; i < len; i++) {
        CHECK(class_of[i] < count && (i == 0 || class_of[i - 1] <= class_of[i]));
        for (j = 0; j < i; j++)
            conflicts += distance(xyz + 3 * i, xyz + 3 * j) < radii[class_of[i] * count + class_of[j]];
    }
    CHECK(len > 0 && conflicts == 0);
}

/* No place of the cube's top can take a sample of any class. */
static void covers_top(const azulejo_points *points, const double *radii, uint32_t count) {
    const float *xyz = azulejo_points_positions(points);
    const uint32_t *class_of = azulejo_points_classes(points);
    size_t j, len = azulejo_points_count(points);
    uint32_t class;
    int x, y, gaps = 0;
    for (class = 0; class < count; class++)
        for (y = 0; y <= 50; y++)
            for (x = 0; x <= 50; x++) {
                const float place[3] = {(float)x / 50, (float)y / 50, 1};
                for (j = 0; j < len; j++)
                    if (distance(place, xyz + 3 * j) <= radii[class * count + class_of[j]] + 1e-6) break;
                gaps += j == len;
            }
    CHECK(gaps == 0);
}

static void matrices(void) {
    const double own[3] = {0.1, 0.25, 0.1};
    const double own_rule[9] = {0.1, 0, 0.3, 0, 0.1, 0.05, 0.3, 0.05, 0.2};
    const double factors[3] = {1, 0.7, 0};
    double radii[9];
    const azulejo_psp_options options = psp_options(0);
    int i;
    for (i = 0; i < 4; i++) {
        azulejo_classes classes;
        azulejo_points *points;
        if (i < 3)
            ACCEPTED(azulejo_classes_radii(own, 3, factors[i], radii));
        else
            memcpy(radii, own_rule, sizeof radii);
        classes = classes_of(radii, 3);
        points = sample(&options, &classes);
        keeps_radii(points, radii, 3);
        covers_top(points, radii, 3);
        CHECK(azulejo_points_dimension(points) == 3 && azulejo_points_normals(points) && azulejo_points_triangles(points));
        CHECK(azulejo_points_ranks(points) == NULL);
        azulejo_points_free(points);
    }
}

/* Class 0 stands on the first six triangles only, class 1 on the others; a given sample keeps the centre of the top clear of
   class 1 alone. */
static void masks_and_given(void) {
    const double radii[4] = {0.1, 0, 0, 0.1};
    const float centre[3] = {0.5f, 0.5f, 1};
    const double clearances[2] = {0, 0.4};
    azulejo_psp_options options = psp_options(0);
    azulejo_classes classes = classes_of(radii, 2);
    azulejo_points *points;
    uint32_t masks[12];
    size_t i, near[2] = {0, 0};
    for (i = 0; i < 12; i++) masks[i] = i < 6 ? 0xfffffffdu : 2;
    classes.masks = masks;
    classes.mask_count = 12;
    points = sample(&options, &classes);
    keeps_radii(points, radii, 2);
    for (i = 0; i < azulejo_points_count(points); i++)
        CHECK((azulejo_points_triangles(points)[i] < 6) == (azulejo_points_classes(points)[i] == 0));
    azulejo_points_free(points);

    classes.masks = NULL;
    classes.mask_count = 0;
    options.given_positions = centre;
    options.given_clearances = clearances;
    options.given_count = 1;
    points = sample(&options, &classes);
    keeps_radii(points, radii, 2);
    for (i = 0; i < azulejo_points_count(points); i++)
        if (distance(azulejo_points_positions(points) + 3 * i, centre) < 0.4) near[azulejo_points_classes(points)[i]]++;
    CHECK(near[0] > 0 && near[1] == 0);
    azulejo_points_free(points);
}

static void refused(void) {
    const double radii[4] = {0.2, 0.1, 0.1, 0.2};
    const uint32_t masks[1] = {1};
    const azulejo_psp_options good = psp_options(0);
    const azulejo_classes fine = classes_of(radii, 2);
    azulejo_points *out = NULL;
#define REFUSED_WITH(change_of_options, change_of_classes, part)                                                       \
    do {                                                                                                               \
        azulejo_psp_options o = good;                                                                                  \
        azulejo_classes c = fine;                                                                                      \
        change_of_options;                                                                                             \
        change_of_classes;                                                                                             \
        REFUSED(AZULEJO_ERROR_INVALID_ARGUMENT, part, azulejo_psp_sample_classes(one, cube, &o, &c, &out));            \
    } while (0)
    REFUSED_WITH(o.radius = 0.1, (void)c, "radius");
    REFUSED_WITH(o.count = 5, (void)c, "count");
    REFUSED_WITH(o.order = AZULEJO_ORDER_PROGRESSIVE, (void)c, "order");
    REFUSED_WITH(o.iterations = 1, (void)c, "iterations");
    REFUSED_WITH(o.maximal = 0, (void)c, "maximal");
    REFUSED_WITH(o.priority = AZULEJO_PRIORITY_PROJECTOR, (void)c, "priority");
    if (azulejo_has_embree()) { /* without it the rasteriser is the default */
        REFUSED_WITH(o.engine = AZULEJO_ENGINE_RASTERISER, (void)c, "engine");
    }
    REFUSED_WITH((void)o, c.count = 0, "count");
    REFUSED_WITH((void)o, c.count = 17, "count");
    REFUSED_WITH((void)o, c.radii = NULL, "radii");
    REFUSED_WITH((void)o, (c.masks = masks, c.mask_count = 1), "mask_count");
    REFUSED_WITH((void)o, c.mask_count = 12, "masks");
    REFUSED(AZULEJO_ERROR_INVALID_ARGUMENT, "context", azulejo_psp_sample_classes(NULL, cube, &good, &fine, &out));
    REFUSED(AZULEJO_ERROR_INVALID_ARGUMENT, "mesh", azulejo_psp_sample_classes(one, NULL, &good, &fine, &out));
    REFUSED(AZULEJO_ERROR_INVALID_ARGUMENT, "options", azulejo_psp_sample_classes(one, cube, NULL, &fine, &out));
    REFUSED(AZULEJO_ERROR_INVALID_ARGUMENT, "classes", azulejo_psp_sample_classes(one, cube, &good, NULL, &out));
    REFUSED(AZULEJO_ERROR_INVALID_ARGUMENT, "out", azulejo_psp_sample_classes(one, cube, &good, &fine, NULL));
    CHECK(out == NULL);
}

int main(void) {
    one = make_context(1);
    three = make_context(3);
    cube = make_cube();
    matrices();
    masks_and_given();
    refused();
    azulejo_mesh_free(cube);
    azulejo_context_free(one);
    azulejo_context_free(three);
    return finish();
}
