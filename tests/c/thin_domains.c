/* Domains that are lines for all floats, or beyond them: each call refuses them or does what it says, and ends. */

#include "samples.h"

#define ENDS(call)                                                                              \
    do {                                                                                        \
        const azulejo_status status = (call);                                                   \
        CHECK(status == AZULEJO_OK || status == AZULEJO_ERROR_INVALID_ARGUMENT ||               \
              status == AZULEJO_ERROR_TOO_LARGE);                                               \
        if (status == AZULEJO_OK) azulejo_points_free(out);                                     \
        out = NULL;                                                                             \
    } while (0)

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
        ENDS(azulejo_kdrt_sample(context, &tiled, &out, NULL));
        ENDS(azulejo_maximal_sample(context, &maximal, &out));
        ENDS(azulejo_dcr_relax(context, &relaxed, origin, 1, &out, NULL));
        ENDS(azulejo_dcr_relax_density(context, &relaxed, &density, origin, 1, &out, NULL));
        ENDS(azulejo_dcr_scatter(context, &relaxed, &density, 10, &out));
        ENDS(azulejo_plane_measure(context, PLANE(origin, 1, low, high, 0), &report));
        ENDS(azulejo_plane_coverage(context, PLANE(origin, 1, low, high, 1), 0.1, &coverage));
        ENDS(azulejo_plane_nearest_histogram(context, PLANE(origin, 1, low, high, 0), 1, 4, histogram));
    }
    azulejo_context_free(context);
    return finish();
}
