/* Relaxes 1,024 random points of the unit square and prints them, x y on each line. */

#include <stdio.h>
#include <stdlib.h>

#include <azulejo.h>

enum { COUNT = 1024 };

static void check(azulejo_status status) {
    char message[256];
    if (status == AZULEJO_OK) return;
    azulejo_last_error_message(message, sizeof message);
    fprintf(stderr, "relax: %s\n", message);
    exit(EXIT_FAILURE);
}

int main(void) {
    static float random[2 * COUNT];
    azulejo_context *context;
    azulejo_dcr_options options;
    azulejo_dcr_report report;
    azulejo_points *points;
    const float *xy;
    size_t i;

    for (i = 0; i < 2 * COUNT; i++) random[i] = (float)(rand() % 32768) / 32768;

    check(azulejo_context_create(0, &context));
    check(azulejo_dcr_options_init(&options, sizeof options));
    check(azulejo_dcr_report_init(&report, sizeof report));
    check(azulejo_dcr_relax(context, &options, random, COUNT, &points, &report));
    fprintf(stderr, "smallest distance %.5f (rho %.3f) after %u steps\n", report.smallest_distance, report.rho,
            (unsigned)report.iterations);

    xy = azulejo_points_positions(points);
    for (i = 0; i < azulejo_points_count(points); i++) printf("%.9g %.9g\n", xy[2 * i], xy[2 * i + 1]);

    azulejo_points_free(points);
    azulejo_context_free(context);
    return EXIT_SUCCESS;
}
