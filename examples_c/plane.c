/* Fills the unit square with Poisson-disk samples and prints them, x y on each line: plane [radius] */

#include <stdio.h>
#include <stdlib.h>

#include <azulejo.h>

static void check(azulejo_status status) {
    char message[256];
    if (status == AZULEJO_OK) return;
    azulejo_last_error_message(message, sizeof message);
    fprintf(stderr, "plane: %s\n", message);
    exit(EXIT_FAILURE);
}

int main(int argc, char **argv) {
    azulejo_context *context;
    azulejo_kdrt_options options;
    azulejo_points *points;
    const float *xy;
    size_t count, i;

    check(azulejo_context_create(0, &context));
    check(azulejo_kdrt_options_init(&options, sizeof options));
    options.radius = argc > 1 ? atof(argv[1]) : 0.01;
    check(azulejo_kdrt_sample(context, &options, &points, NULL));

    xy = azulejo_points_positions(points);
    count = azulejo_points_count(points);
    for (i = 0; i < count; i++) printf("%.9g %.9g\n", xy[2 * i], xy[2 * i + 1]);

    azulejo_points_free(points);
    azulejo_context_free(context);
    return EXIT_SUCCESS;
}
