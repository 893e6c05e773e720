/* Several classes in the plane: what they keep from each other and from given samples, kept planes, refusals. */

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

/* The distance on the unit torus, of points anywhere. */
static double torus_distance(const float *a, const float *b) {
    double along[2];
    int axis;
    for (axis = 0; axis < 2; axis++) {
        along[axis] = fmod(fabs((double)a[axis] - b[axis]), 1);
        along[axis] = fmin(along[axis], 1 - along[axis]);
    }
    return sqrt(along[0] * along[0] + along[1] * along[1]);
}

static void sets(void) {
    const azulejo_kdrt_options options = around();
    const azulejo_classes classes = three_classes();
    const double low[2] = {0.1, 0.3}, high[2] = {0.6, 0.5};
    azulejo_points *points = NULL, *part = NULL;
    azulejo_kdrt *plane = NULL;
    const uint32_t *of;
    const float *xy;
    size_t counts[CLASSES] = {0}, count, i, j, next = 0;
    if (!ACCEPTED(azulejo_kdrt_sample_classes(context, &options, &classes, &points))) exit(finish());
    count = azulejo_points_count(points);
    xy = azulejo_points_positions(points);
    of = azulejo_points_classes(points);
    CHECK(azulejo_points_dimension(points) == 2 && azulejo_points_ranks(points) == NULL);
    for (i = 0; i < count; i++) {
        CHECK(of[i] < CLASSES && (i == 0 || of[i - 1] <= of[i]));
        counts[of[i]]++;
        for (j = 0; j < i; j++)
            CHECK(torus_distance(xy + 2 * i, xy + 2 * j) >= matrix[of[i] * CLASSES + of[j]]);
        for (j = 0; j < 2; j++) CHECK(torus_distance(xy + 2 * i, given[j]) >= clearances[j][of[i]]);
    }
    CHECK(counts[0] > 200 && counts[1] > counts[0] && counts[2] > counts[1]);

    if (!ACCEPTED(azulejo_kdrt_create_classes(context, &options, &classes, &plane))) exit(finish());
    ACCEPTED(azulejo_kdrt_window(plane, low, high, &part));
    CHECK(azulejo_points_count(part) > 100);
    for (i = 0; i < count; i++) {
        const float *sample = xy + 2 * i;
        if (sample[0] < low[0] || sample[0] >= high[0] || sample[1] < low[1] || sample[1] >= high[1]) continue;
        CHECK(next < azulejo_points_count(part) && azulejo_points_classes(part)[next] == of[i]);
        CHECK(memcmp(azulejo_points_positions(part) + 2 * next, sample, 2 * sizeof *sample) == 0);
        next++;
    }
    CHECK(next == azulejo_points_count(part));
    azulejo_points_free(part);
    azulejo_kdrt_free(plane);
    azulejo_points_free(points);
}

/* A single class is the set of its radius, with a class for each sample. */
static void one_class(void) {
    const azulejo_kdrt_options options = kdrt_options(0.02), none = kdrt_options(0);
    const double radius = 0.02;
    azulejo_classes classes = three_classes();
    azulejo_points *points = NULL, *same = NULL;
    size_t i;
    classes.count = 1;
    classes.radii = &radius;
    if (!ACCEPTED(azulejo_kdrt_sample(context, &options, &points, NULL))) exit(finish());
    if (!ACCEPTED(azulejo_kdrt_sample_classes(context, &none, &classes, &same))) exit(finish());
    CHECK(azulejo_points_classes(points) == NULL);
    CHECK(azulejo_points_count(points) == azulejo_points_count(same));
    CHECK(memcmp(azulejo_points_positions(points), azulejo_points_positions(same),
                 2 * sizeof(float) * azulejo_points_count(same)) == 0);
    for (i = 0; i < azulejo_points_count(same); i++) CHECK(azulejo_points_classes(same)[i] == 0);
    azulejo_points_free(points);
    azulejo_points_free(same);
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
        REFUSED(status, part, azulejo_kdrt_sample_classes(context, &o, &c, &out));     \
        REFUSED(status, part, azulejo_kdrt_create_classes(context, &o, &c, &plane));   \
        CHECK(out == UNTOUCHED && plane == UNTOUCHED);                                 \
    } while (0)
    NO_SET(INVALID, "radius: 0.1", o.radius = 0.1);
    NO_SET(INVALID, "count: 7", o.count = 7);
    NO_SET(INVALID, "measure_coverage", o.measure_coverage = 1);
    NO_SET(INVALID, "order", o.order = AZULEJO_ORDER_PROGRESSIVE);
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
    REFUSED(INVALID, "context", azulejo_kdrt_sample_classes(NULL, &o, &c, &out));
    REFUSED(INVALID, "options", azulejo_kdrt_sample_classes(context, NULL, &c, &out));
    REFUSED(INVALID, "classes", azulejo_kdrt_sample_classes(context, &o, NULL, &out));
    REFUSED(INVALID, "out", azulejo_kdrt_sample_classes(context, &o, &c, NULL));
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
    if (!ACCEPTED(azulejo_kdrt_sample_classes(context, &o, &c, &set))) return;
    const float *const xy = azulejo_points_positions(set);
    const uint32_t *const of = azulejo_points_classes(set);
    const size_t count = azulejo_points_count(set);
    relax.max_iterations = 0;
    ACCEPTED(azulejo_dcr_relax_classes(context, &relax, xy, of, count, CLASSES + 1, &out, &before, rho[0], coverage[0]));
    CHECK(azulejo_points_count(out) == count && memcmp(azulejo_points_positions(out), xy, count * 2 * sizeof *xy) == 0);
    azulejo_points_free(out);
    relax.max_iterations = 100;
    ACCEPTED(azulejo_dcr_relax_classes(context, &relax, xy, of, count, CLASSES + 1, &out, &after, rho[1], coverage[1]));
    CHECK(azulejo_points_count(out) == count && after.iterations > 50);
    CHECK(after.coverage < before.coverage - 0.03 && after.rho > before.rho - 0.03);
    for (i = 0; i < CLASSES; i++) {
        CHECK(rho[1][i] > 0.65 && rho[0][i] > 0.6 && coverage[1][i] < 0.85 && coverage[1][i] < coverage[0][i]);
    }
    CHECK(isinf(rho[1][CLASSES]) && isinf(coverage[1][CLASSES])); /* a class without points */
    azulejo_points_free(out);
    ACCEPTED(azulejo_dcr_relax_classes(context, &relax, xy, of, count, CLASSES, &out, NULL, NULL, NULL));
    azulejo_points_free(out);
    out = UNTOUCHED;
#define NO_SET(status, part, ...) \
    do {                          \
        REFUSED(status, part, azulejo_dcr_relax_classes(__VA_ARGS__, &out, NULL, NULL, NULL)); \
        CHECK(out == UNTOUCHED);  \
    } while (0)
    NO_SET(INVALID, "context", NULL, &relax, xy, of, count, CLASSES);
    NO_SET(INVALID, "options", context, NULL, xy, of, count, CLASSES);
    NO_SET(INVALID, "xy", context, &relax, NULL, of, count, CLASSES);
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
    sets();
    one_class();
    refused();
    relaxed();
    azulejo_context_free(context);
    return finish();
}
