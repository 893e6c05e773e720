/* Samples the mesh of a file and writes the positions as floats: dragon MESH RADIUS SEED OUT */
#include <azulejo.h>
#include <stdio.h>
#include <stdlib.h>

static void check(azulejo_status status) {
    char message[256];
    if (status == AZULEJO_OK) return;
    azulejo_last_error_message(message, sizeof message);
    fprintf(stderr, "dragon: %s\n", message);
    exit(EXIT_FAILURE);
}

int main(int argc, char **argv) {
    azulejo_context *context;
    azulejo_mesh *mesh;
    azulejo_psp_options options;
    azulejo_points *points;
    size_t count;
    FILE *out;

    if (argc != 5) return 2;
    check(azulejo_context_create(0, &context));
    check(azulejo_mesh_load(argv[1], &mesh));
    check(azulejo_psp_options_init(&options, sizeof options));
    options.radius = atof(argv[2]);
    options.seed = strtoull(argv[3], NULL, 10);
    check(azulejo_psp_sample(context, mesh, &options, &points, NULL));
    count = azulejo_points_count(points);
    out = fopen(argv[4], "wb");
    if (out == NULL || fwrite(azulejo_points_positions(points), 12, count, out) != count || fclose(out) != 0) return 1;
    azulejo_points_free(points);
    azulejo_mesh_free(mesh);
    azulejo_context_free(context);
    return EXIT_SUCCESS;
}
