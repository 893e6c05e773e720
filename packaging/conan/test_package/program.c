/* A set of the plane, made by the library that the package has. */
#include <azulejo.h>
#include <stdio.h>

int main(void) {
    azulejo_context *context;
    azulejo_kdrt_options options;
    azulejo_points *points;
    size_t count;
    if (azulejo_context_create(1, &context) != AZULEJO_OK) return 1;
    azulejo_kdrt_options_init(&options, sizeof options);
    options.radius = 0.1;
    if (azulejo_kdrt_sample(context, &options, &points, NULL) != AZULEJO_OK) return 1;
    count = azulejo_points_count(points);
    printf("%zu samples\n", count);
    azulejo_points_free(points);
    azulejo_context_free(context);
    return count > 50 ? 0 : 1;
}
