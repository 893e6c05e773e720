/* Instances of meshes: their arrays, and bad input. */

#include <math.h>
#include <string.h>

#include "samples.h"

static azulejo_context *one, *three;
static azulejo_mesh *cube;

static const azulejo_instance pair[2] = {{0, 0, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}},
                                         {0, 0, {0, -2, 0, 0.5, 2, 0, 0, 0.25, 0, 0, 2, 0.75}}};

static azulejo_status sampled(const azulejo_context *context, const azulejo_instance *instances, size_t count,
                              const azulejo_psp_options *options, azulejo_points **out, azulejo_psp_report *report) {
    const azulejo_mesh *const prototypes[1] = {cube};
    return azulejo_psp_sample_instances(context, prototypes, 1, instances, count, sizeof *instances, options, out, report);
}

/* No two samples are closer than the radius, each lies on its instance, and threads do not matter. */
static void together(void) {
    const azulejo_psp_options options = psp_options(0.1);
    azulejo_psp_report report = psp_report();
    azulejo_points *points = NULL, *same = NULL;
    ACCEPTED(sampled(one, pair, 2, &options, &points, &report));
    ACCEPTED(sampled(three, pair, 2, &options, &same, NULL));
    CHECK(same_points(points, same));
    const size_t count = azulejo_points_count(points);
    const float *p = azulejo_points_positions(points), *uv = azulejo_points_barycentrics(points);
    const uint32_t *instances = azulejo_points_instances(points), *triangles = azulejo_points_triangles(points);
    CHECK(count > 1500 && report.samples == count && report.covering_radius == 0.1 && report.uncovered_before == -1);
    size_t close = 0, astray = 0, of_second = 0;
    for (size_t i = 0; i < count; i++) {
        for (size_t j = 0; j < i; j++) {
            const double x = (double)p[3 * i] - p[3 * j], y = (double)p[3 * i + 1] - p[3 * j + 1],
                         z = (double)p[3 * i + 2] - p[3 * j + 2];
            close += x * x + y * y + z * z < 0.1 * 0.1;
        }
        const uint32_t *corners = cube_indices[triangles[i]];
        const double u = uv[2 * i], v = uv[2 * i + 1], *m = pair[instances[i]].transform;
        for (int axis = 0; axis < 3; axis++, m += 4) {
            double at[3];
            for (int c = 0; c < 3; c++) {
                const float *corner = cube_positions[corners[c]];
                at[c] = m[0] * corner[0] + m[1] * corner[1] + m[2] * corner[2] + m[3];
            }
            astray += fabs((1 - u - v) * at[0] + u * at[1] + v * at[2] - p[3 * i + axis]) > 1e-6;
        }
        astray += i > 0 && instances[i] < instances[i - 1];
        of_second += instances[i] == 1;
    }
    CHECK(close == 0 && astray == 0 && of_second > 1200 && of_second < count - 200);
    azulejo_points_free(points);
    azulejo_points_free(same);
    points = NULL;
    ACCEPTED(sampled(one, NULL, 0, &options, &points, NULL));
    CHECK(azulejo_points_count(points) == 0 && azulejo_points_instances(points) == NULL);
    azulejo_points_free(points);
    CHECK(azulejo_points_instances(NULL) == NULL);
}

static void refused(void) {
    const azulejo_psp_options good = psp_options(0.1);
    const azulejo_mesh *const prototypes[2] = {cube, NULL};
    azulejo_points *out = NULL;
    azulejo_instance bad[2];
#define REFUSED_WITH(change, part)                                                                                     \
    do {                                                                                                               \
        azulejo_psp_options o = good;                                                                                  \
        memcpy(bad, pair, sizeof bad);                                                                                 \
        change;                                                                                                        \
        REFUSED(AZULEJO_ERROR_INVALID_ARGUMENT, part, sampled(one, bad, 2, &o, &out, NULL));                           \
    } while (0)
    REFUSED_WITH((bad[1].prototype = 1, (void)o), "instances: [1]: prototype is 1, and there are 1");
    REFUSED_WITH((bad[1].reserved = 1, (void)o), "instances: [1]: reserved is 1");
    REFUSED_WITH((bad[0].transform[7] = NAN, (void)o), "instances: [0]: transform[7]");
    REFUSED_WITH((bad[0].transform[3] = 1e39, (void)o), "instances: [0]: ");
    REFUSED_WITH((bad[0].transform[3] = 1e6, (void)o), "radius: 0.1 is below 4.0");
    REFUSED_WITH(o.radius = 0, "radius");
    REFUSED_WITH(o.count = 5, "count");
    REFUSED_WITH(o.order = AZULEJO_ORDER_PROGRESSIVE, "order");
    REFUSED_WITH(o.iterations = 1, "iterations");
    REFUSED_WITH(o.maximal = 0, "maximal");
    REFUSED_WITH(o.engine = AZULEJO_ENGINE_RASTERISER, "engine: 1 has no effect with instances");
    REFUSED_WITH(o.cosine = 2, "cosine");
    const azulejo_status invalid = AZULEJO_ERROR_INVALID_ARGUMENT;
    const size_t size = sizeof *pair;
    REFUSED(invalid, "context", sampled(NULL, pair, 2, &good, &out, NULL));
    REFUSED(invalid, "instances", sampled(one, NULL, 2, &good, &out, NULL));
    REFUSED(invalid, "options", sampled(one, pair, 2, NULL, &out, NULL));
    REFUSED(invalid, "out", sampled(one, pair, 2, &good, NULL, NULL));
    REFUSED(invalid, "prototypes", azulejo_psp_sample_instances(one, NULL, 1, pair, 2, size, &good, &out, NULL));
    REFUSED(invalid, "prototypes: [1]", azulejo_psp_sample_instances(one, prototypes, 2, pair, 2, size, &good, &out, NULL));
    REFUSED(invalid, "instance_size", azulejo_psp_sample_instances(one, prototypes, 1, pair, 2, 96, &good, &out, NULL));
    CHECK(out == NULL);
}

int main(void) {
    one = make_context(1);
    three = make_context(3);
    cube = make_cube();
    together();
    refused();
    azulejo_mesh_free(cube);
    azulejo_context_free(one);
    azulejo_context_free(three);
    return finish();
}
