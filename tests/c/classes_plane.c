/* Several classes in the plane: refusals, and relaxation with its reports for each class. */

#include <math.h>
#include <string.h>

#include "samples.h"

#define INVALID AZULEJO_ERROR_INVALID_ARGUMENT
#define CLASSES 3

static azulejo_context *context;
static double matrix[CLASSES * CLASSES];
static const float given[2][2] = {{0.25f, 0.5f}, {1.75f, 0.5f}};
/* The second class has nothing to do with the first given sample. */
static const double clearances[2][CLASSES] = {{0.1, 0, 0.05}, {0.02, 0.2, 0.01}};

static azulejo_classes three_classes(void) {
    azulejo_classes classes;
    ACCEPTED(azulejo_classes_init(&classes, sizeof classes));
    classes.count = CLASSES;
    classes.radii = matrix;
    return classes;
}

static azulejo_kdrt_options around(void) {
    azulejo_kdrt_options options = kdrt_options(0);
    options.leaf_size = 6;
    options.given_positions = &given[0][0];
    options.given_clearances = &clearances[0][0];
    options.given_count = 2;
    return options;
}

static void refused(void) {
    azulejo_kdrt_options o;
    azulejo_classes c;
    azulejo_points *out = UNTOUCHED;
    azulejo_kdrt *plane = UNTOUCHED;
#define NO_SET(status, part, change)                                                   \
    do {                                                                               \
        o = around();                                                                  \
        c = three_classes();                                                           \
        (void)(change);                                                                \
        REFUSED(status, part, azulejo_kdrt_sample_classes(context, &o, &c, &out, NULL));     \
        REFUSED(status, part, azulejo_kdrt_create_classes(context, &o, &c, &plane));   \
        CHECK(out == UNTOUCHED && plane == UNTOUCHED);                                 \
    } while (0)
    NO_SET(INVALID, "radius: 0.1", o.radius = 0.1);
    NO_SET(INVALID, "count: 7", o.count = 7);
    NO_SET(INVALID, "measure_covering_radius", o.measure_covering_radius = 1);
    NO_SET(INVALID, "order", o.order = 2);
    NO_SET(INVALID, "coarsest", (o.order = AZULEJO_ORDER_PROGRESSIVE, o.coarsest = 1e-9));
    NO_SET(INVALID, "quotient", o.quotient = 1.2);
    NO_SET(INVALID, "struct_size", o.struct_size = 8);
    NO_SET(INVALID, "given_positions", o.given_positions = NULL);
    NO_SET(AZULEJO_ERROR_TOO_LARGE, "given_count", o.given_count = SIZE_MAX / 2);
    NO_SET(INVALID, "count: 0 classes", c.count = 0);
    NO_SET(INVALID, "mask_count: 4", c.mask_count = 4);
    NO_SET(INVALID, "count: 17 classes", c.count = 17);
    NO_SET(INVALID, "radii", c.radii = NULL);
    NO_SET(INVALID, "radii: [0][1]", c.radii = matrix + 1);
    NO_SET(INVALID, "struct_size", c.struct_size = 4);
#undef NO_SET
    o = around();
    c = three_classes();
    REFUSED(INVALID, "context", azulejo_kdrt_sample_classes(NULL, &o, &c, &out, NULL));
    REFUSED(INVALID, "options", azulejo_kdrt_sample_classes(context, NULL, &c, &out, NULL));
    REFUSED(INVALID, "classes", azulejo_kdrt_sample_classes(context, &o, NULL, &out, NULL));
    REFUSED(INVALID, "out", azulejo_kdrt_sample_classes(context, &o, &c, NULL, NULL));
    REFUSED(INVALID, "context", azulejo_kdrt_create_classes(NULL, &o, &c, &plane));
    REFUSED(INVALID, "options", azulejo_kdrt_create_classes(context, NULL, &c, &plane));
    REFUSED(INVALID, "classes", azulejo_kdrt_create_classes(context, &o, NULL, &plane));
    REFUSED(INVALID, "out", azulejo_kdrt_create_classes(context, &o, &c, NULL));
}

/* The union and each class get more even; what is no class is refused. */
static void relaxed(void) {
    const azulejo_classes c = three_classes();
    const azulejo_kdrt_options o = kdrt_options(0);
    azulejo_dcr_options relax;
    azulejo_dcr_report before, after;
    double rho[2][CLASSES + 1], coverage[2][CLASSES + 1];
    azulejo_points *set = NULL, *out = NULL;
    uint32_t i;
    ACCEPTED(azulejo_dcr_options_init(&relax, sizeof relax));
    ACCEPTED(azulejo_dcr_report_init(&before, sizeof before));
    ACCEPTED(azulejo_dcr_report_init(&after, sizeof after));
    if (!ACCEPTED(azulejo_kdrt_sample_classes(context, &o, &c, &set, NULL))) return;
    const float *const xy = azulejo_points_positions(set);
    const uint32_t *const of = azulejo_points_classes(set);
    const size_t count = azulejo_points_count(set);
    relax.max_iterations = 0;
    ACCEPTED(azulejo_dcr_relax_classes(context, &relax, xy, of, count, CLASSES + 1, rho[0], coverage[0], &out, &before));
    CHECK(azulejo_points_count(out) == count && memcmp(azulejo_points_positions(out), xy, count * 2 * sizeof *xy) == 0);
    azulejo_points_free(out);
    relax.max_iterations = 100;
    ACCEPTED(azulejo_dcr_relax_classes(context, &relax, xy, of, count, CLASSES + 1, rho[1], coverage[1], &out, &after));
    CHECK(azulejo_points_count(out) == count && after.iterations > 50);
    CHECK(after.relative_covering_radius < before.relative_covering_radius - 0.03 && after.rho > before.rho - 0.03);
    for (i = 0; i < CLASSES; i++) {
        CHECK(rho[1][i] > 0.65 && rho[0][i] > 0.6 && coverage[1][i] < 0.85 && coverage[1][i] < coverage[0][i]);
    }
    CHECK(isinf(rho[1][CLASSES]) && isinf(coverage[1][CLASSES])); /* a class without points */
    azulejo_points_free(out);
    ACCEPTED(azulejo_dcr_relax_classes(context, &relax, xy, of, count, CLASSES, NULL, NULL, &out, NULL));
    azulejo_points_free(out);
    out = UNTOUCHED;
#define NO_SET(status, part, ...) \
    do {                          \
        REFUSED(status, part, azulejo_dcr_relax_classes(__VA_ARGS__, NULL, NULL, &out, NULL)); \
        CHECK(out == UNTOUCHED);  \
    } while (0)
    NO_SET(INVALID, "context", NULL, &relax, xy, of, count, CLASSES);
    NO_SET(INVALID, "options", context, NULL, xy, of, count, CLASSES);
    NO_SET(INVALID, "positions", context, &relax, NULL, of, count, CLASSES);
    NO_SET(INVALID, "classes", context, &relax, xy, NULL, count, CLASSES);
    NO_SET(INVALID, "classes: [", context, &relax, xy, of, count, CLASSES - 1);
    NO_SET(INVALID, "class_count: 0", context, &relax, xy, of, count, 0);
    NO_SET(INVALID, "class_count: 17", context, &relax, xy, of, count, 17);
    relax.method = AZULEJO_METHOD_THESIS;
    NO_SET(INVALID, "method", context, &relax, xy, of, count, CLASSES);
    relax.method = AZULEJO_METHOD_MOMENTUM;
    relax.neighbourhood = AZULEJO_NEIGHBOURHOOD_NEAREST;
    NO_SET(INVALID, "neighbourhood", context, &relax, xy, of, count, CLASSES);
#undef NO_SET
    azulejo_points_free(set);
}

int main(void) {
    const double own[CLASSES] = {0.04, 0.02, 0.01};
    context = make_context(2);
    ACCEPTED(azulejo_classes_radii(own, CLASSES, 1, matrix));
    refused();
    relaxed();
    azulejo_context_free(context);
    return finish();
}
