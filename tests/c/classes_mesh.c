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
    if (azulejo_has_embree()) { /* without it the rasteriser is the default */
        REFUSED_WITH(o.engine = AZULEJO_ENGINE_RASTERISER, (void)c, "engine");
    }
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

int main(void) {
    one = make_context(1);
    three = make_context(3);
    cube = make_cube();
    refused();
    reported();
    azulejo_mesh_free(cube);
    azulejo_context_free(one);
    azulejo_context_free(three);
    return finish();
}
