/* Several classes on a mesh: their report, their order, and what does not go with classes. */

#include <math.h>
#include <string.h>

#include "samples.h"

static azulejo_context *one, *three;
static azulejo_mesh *cube;

static azulejo_classes classes_of(const double *radii, uint32_t count) {
    azulejo_classes classes;
    ACCEPTED(azulejo_classes_init(&classes, sizeof classes));
    classes.count = count;
    classes.radii = radii;
    return classes;
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
        REFUSED(AZULEJO_ERROR_INVALID_ARGUMENT, part, azulejo_psp_sample_classes(one, cube, &o, &c, &out, NULL));      \
    } while (0)
    REFUSED_WITH(o.radius = 0.1, (void)c, "radius");
    REFUSED_WITH(o.count = 5, (void)c, "count");
    REFUSED_WITH(o.order = 2, (void)c, "order");
    REFUSED_WITH(o.quotient = 1.2, (void)c, "quotient");
    REFUSED_WITH((o.order = AZULEJO_ORDER_PROGRESSIVE, o.quotient = 2), (void)c, "quotient");
    REFUSED_WITH(o.iterations = 1, (void)c, "iterations");
    REFUSED_WITH(o.maximal = 0, (void)c, "maximal");
    REFUSED_WITH(o.priority = AZULEJO_PRIORITY_PROJECTOR, (void)c, "priority");
    REFUSED_WITH(o.projectors = AZULEJO_PROJECTORS_GLOBAL, (void)c, "projectors");
    REFUSED_WITH(o.engine = AZULEJO_ENGINE_RASTERISER, (void)c, "engine");
    REFUSED_WITH((void)o, c.count = 0, "count");
    REFUSED_WITH((void)o, c.count = 17, "count");
    REFUSED_WITH((void)o, c.radii = NULL, "radii");
    REFUSED_WITH((void)o, (c.masks = masks, c.mask_count = 1), "mask_count");
    REFUSED_WITH((void)o, c.mask_count = 12, "masks");
    REFUSED(AZULEJO_ERROR_INVALID_ARGUMENT, "context", azulejo_psp_sample_classes(NULL, cube, &good, &fine, &out, NULL));
    REFUSED(AZULEJO_ERROR_INVALID_ARGUMENT, "mesh", azulejo_psp_sample_classes(one, NULL, &good, &fine, &out, NULL));
    REFUSED(AZULEJO_ERROR_INVALID_ARGUMENT, "options", azulejo_psp_sample_classes(one, cube, NULL, &fine, &out, NULL));
    REFUSED(AZULEJO_ERROR_INVALID_ARGUMENT, "classes", azulejo_psp_sample_classes(one, cube, &good, NULL, &out, NULL));
    REFUSED(AZULEJO_ERROR_INVALID_ARGUMENT, "out", azulejo_psp_sample_classes(one, cube, &good, &fine, NULL, NULL));
    CHECK(out == NULL);
}

/* The report counts the samples of each class, and in progressive order the ranks of each class fall. */
static void reported(void) {
    const double radii[4] = {0.2, 0.1, 0.1, 0.1};
    const azulejo_classes two = classes_of(radii, 2);
    azulejo_psp_options o = psp_options(0);
    azulejo_classes_report report;
    azulejo_points *points = NULL, *same = NULL;
    uint64_t counts[2] = {0, 0};
    size_t i;
    o.order = AZULEJO_ORDER_PROGRESSIVE;
    ACCEPTED(azulejo_classes_report_init(&report, sizeof report));
    ACCEPTED(azulejo_psp_sample_classes(three, cube, &o, &two, &points, &report));
    ACCEPTED(azulejo_psp_sample_classes(one, cube, &o, &two, &same, NULL));
    CHECK(same_points(points, same));
    const uint32_t *const class = azulejo_points_classes(points);
    const float *const ranks = azulejo_points_ranks(points);
    for (i = 0; i < azulejo_points_count(points); i++) {
        counts[class[i]]++;
        CHECK(ranks[i] >= (float)radii[3 * class[i]] * 0.9999999f);
        CHECK(i == 0 || (class[i - 1] == class[i] ? ranks[i - 1] >= ranks[i] : class[i - 1] < class[i]));
    }
    CHECK(report.classes == 2 && report.samples == azulejo_points_count(points) && report.seconds > 0);
    CHECK(counts[0] > 50 && counts[1] > 2 * counts[0] && memcmp(report.counts, counts, sizeof counts) == 0);
    CHECK(report.counts[2] == 0 && report.counts[AZULEJO_MAX_CLASSES - 1] == 0);
    azulejo_points_free(points);
    azulejo_points_free(same);
    o.order = AZULEJO_ORDER_ANY;
    ACCEPTED(azulejo_psp_sample_classes(one, cube, &o, &two, &points, &report));
    CHECK(azulejo_points_ranks(points) == NULL && report.samples == azulejo_points_count(points));
    azulejo_points_free(points);
}

/* The radii of the classes are multiples of those that the density gives. */
static void with_density(void) {
    static const float values[8] = {1, 1, 1, 1, 9, 9, 9, 9};
    const double radii[4] = {0.4, 0.2, 0.2, 0.2}, clearances[2] = {0.5, 0.3};
    const float given[3] = {0.5f, 0.5f, 1};
    const azulejo_classes two = classes_of(radii, 2);
    azulejo_psp_options o = psp_options(0);
    azulejo_mesh_density density;
    azulejo_classes_report report;
    azulejo_points *points = NULL, *same = NULL;
    size_t i, j, near = 0, above = 0;
    ACCEPTED(azulejo_classes_report_init(&report, sizeof report));
    ACCEPTED(azulejo_mesh_density_init(&density, sizeof density));
    density.vertex_values = values;
    density.vertex_count = 8;
    density.radius = 1;
    ACCEPTED(azulejo_psp_classes_with_density(three, cube, &o, &two, &density, &points, &report));
    ACCEPTED(azulejo_psp_classes_with_density(one, cube, &o, &two, &density, &same, NULL));
    CHECK(same_points(points, same));
    const size_t count = azulejo_points_count(points);
    const uint32_t *const class = azulejo_points_classes(points);
    const double *const local = azulejo_points_radii(points);
    const float(*const positions)[3] = (const float(*)[3])azulejo_points_positions(points);
    CHECK(report.samples == count && report.counts[0] + report.counts[1] == count && report.counts[1] > report.counts[0]);
    for (i = 0; i < count; i++) {
        CHECK(local[i] >= 1.0 / 3 - 1e-12 && local[i] <= 1 + 1e-12);
        above += positions[i][2] > 0.5f;
        for (j = 0; j < i; j++) {
            const double x = (double)positions[i][0] - (double)positions[j][0];
            const double y = (double)positions[i][1] - (double)positions[j][1];
            const double z = (double)positions[i][2] - (double)positions[j][2];
            near += sqrt(x * x + y * y + z * z) < radii[2 * class[i] + class[j]] * ((local[i] + local[j]) / 2);
        }
    }
    CHECK(near == 0 && count > 50 && 3 * above > 2 * count);
    azulejo_points_free(points);
    azulejo_points_free(same);
    points = NULL;
    o.given_positions = given;
    o.given_count = 1;
    REFUSED(AZULEJO_ERROR_INVALID_ARGUMENT, "given_clearances", azulejo_psp_classes_with_density(one, cube, &o, &two, &density, &points, NULL));
    o.given_clearances = clearances;
    o.order = AZULEJO_ORDER_PROGRESSIVE;
    ACCEPTED(azulejo_psp_classes_with_density(one, cube, &o, &two, &density, &points, NULL));
    CHECK(azulejo_points_ranks(points) != NULL && azulejo_points_radii(points) != NULL);
    azulejo_points_free(points);
    points = NULL;
    density.count = 100;
    REFUSED(AZULEJO_ERROR_INVALID_ARGUMENT, "count", azulejo_psp_classes_with_density(one, cube, &o, &two, &density, &points, NULL));
    density.count = 0;
    o.radius = 0.1;
    REFUSED(AZULEJO_ERROR_INVALID_ARGUMENT, "radius", azulejo_psp_classes_with_density(one, cube, &o, &two, &density, &points, NULL));
    o.radius = 0;
    REFUSED(AZULEJO_ERROR_INVALID_ARGUMENT, "context", azulejo_psp_classes_with_density(NULL, cube, &o, &two, &density, &points, NULL));
    REFUSED(AZULEJO_ERROR_INVALID_ARGUMENT, "mesh", azulejo_psp_classes_with_density(one, NULL, &o, &two, &density, &points, NULL));
    REFUSED(AZULEJO_ERROR_INVALID_ARGUMENT, "options", azulejo_psp_classes_with_density(one, cube, NULL, &two, &density, &points, NULL));
    REFUSED(AZULEJO_ERROR_INVALID_ARGUMENT, "classes", azulejo_psp_classes_with_density(one, cube, &o, NULL, &density, &points, NULL));
    REFUSED(AZULEJO_ERROR_INVALID_ARGUMENT, "density", azulejo_psp_classes_with_density(one, cube, &o, &two, NULL, &points, NULL));
    REFUSED(AZULEJO_ERROR_INVALID_ARGUMENT, "out", azulejo_psp_classes_with_density(one, cube, &o, &two, &density, NULL, NULL));
    CHECK(points == NULL);
}

int main(void) {
    one = make_context(1);
    three = make_context(3);
    cube = make_cube();
    refused();
    reported();
    with_density();
    azulejo_mesh_free(cube);
    azulejo_context_free(one);
    azulejo_context_free(three);
    return finish();
}
