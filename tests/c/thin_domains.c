/* Domains that are lines for all floats, or beyond them: each call refuses them or does what it says, and ends. */

#include "samples.h"

#define ENDS(call, expected)                                                                    \
    do {                                                                                        \
        const azulejo_status status = (call);                                                   \
        CHECK(status == AZULEJO_OK || status == AZULEJO_ERROR_INVALID_ARGUMENT ||               \
              status == AZULEJO_ERROR_TOO_LARGE);                                               \
        if (status == AZULEJO_OK && out != NULL) read_and_free(out, low, high, expected);       \
        out = NULL;                                                                             \
    } while (0)

/* Every coordinate lies in the domain; there are as many points as expected, 0: one at least. */
static void read_and_free(azulejo_points *points, const double *low, const double *high, size_t expected) {
    const size_t count = azulejo_points_count(points);
    const float *xy = azulejo_points_positions(points);
    size_t i, outside = 0;
    CHECK(expected == 0 ? count > 0 : count == expected);
    for (i = 0; i < 2 * count; i++) outside += !((double)xy[i] >= low[i % 2] && (double)xy[i] < high[i % 2]);
    if (!CHECK(outside == 0)) printf("    %g x %g: %d coordinates outside\n", high[0], high[1], (int)outside);
    azulejo_points_free(points);
}

int main(void) {
    const double corners[][2] = {{1e-30, 1e30}, {1e-15, 1e15}, {1e-12, 3e38}, {1e-38, 1e-38}, {1e-300, 1}, {1e-45, 1e-45}};
    const double low[2] = {0, 0};
    const float white = 1, origin[2] = {0, 0};
    azulejo_context *context = make_context(1);
    size_t i;
    for (i = 0; i < COUNT_OF(corners); i++) {
        const double *high = corners[i];
        azulejo_kdrt_options tiled = kdrt_options(0.1);
        azulejo_maximal_options maximal = maximal_options(0.1);
        azulejo_dcr_options relaxed = dcr_options(3);
        azulejo_density density;
        azulejo_plane_report report = plane_report();
        azulejo_coverage_report coverage = coverage_report();
        uint64_t histogram[4];
        azulejo_points *out = NULL;
        memcpy(tiled.domain_max, high, sizeof tiled.domain_max);
        memcpy(maximal.domain_max, high, sizeof maximal.domain_max);
        memcpy(relaxed.domain_max, high, sizeof relaxed.domain_max);
        ACCEPTED(azulejo_density_init(&density, sizeof density));
        density.values = &white;
        density.width = density.height = 1;
        ENDS(azulejo_kdrt_sample(context, &tiled, &out, NULL), 0);
        ENDS(azulejo_maximal_sample(context, &maximal, &out, NULL), 0);
        ENDS(azulejo_dcr_relax(context, &relaxed, origin, 1, &out, NULL), 1);
        ENDS(azulejo_dcr_relax_density(context, &relaxed, &density, origin, 1, &out, NULL), 1);
        ENDS(azulejo_dcr_scatter(context, &relaxed, &density, 10, &out), 10);
        ENDS(azulejo_plane_measure(context, PLANE(origin, 1, low, high, 0), &report), 0);
        ENDS(azulejo_plane_coverage(context, PLANE(origin, 1, low, high, 1), 0.1, &coverage), 0);
        ENDS(azulejo_plane_nearest_histogram(context, PLANE(origin, 1, low, high, 0), 1, 4, histogram), 0);
    }
    azulejo_context_free(context);
    return finish();
}
