/* Covers a mesh with about 10,000 Poisson-disk samples and prints them, x y z nx ny nz on each line:
   surface MESH.obj|MESH.ply */

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include <azulejo.h>

static void check(azulejo_status status) {
    char message[256];
    if (status == AZULEJO_OK) return;
    azulejo_last_error_message(message, sizeof message);
    fprintf(stderr, "surface: %s\n", message);
    exit(EXIT_FAILURE);
}

int main(int argc, char **argv) {
    azulejo_context *context;
    azulejo_mesh *mesh;
    azulejo_psp_options options;
    azulejo_psp_report report;
    azulejo_points *points;
    const float *p, *n;
    size_t i;

    if (argc != 2) {
        fprintf(stderr, "usage: surface MESH.obj|MESH.ply\n");
        return 2;
    }
    check(azulejo_context_create(0, &context));
    check(azulejo_mesh_load(argv[1], &mesh));
    check(azulejo_psp_options_init(&options, sizeof options));
    check(azulejo_psp_report_init(&report, sizeof report));
    options.radius = sqrt(0.69656 * azulejo_mesh_area(mesh) / 10000);
    check(azulejo_psp_sample(context, mesh, &options, &points, &report));
    fprintf(stderr, "%zu samples in %.3f s\n", azulejo_points_count(points), report.seconds);

    p = azulejo_points_positions(points);
    n = azulejo_points_normals(points);
    for (i = 0; i < azulejo_points_count(points); i++, p += 3, n += 3)
        printf("%.9g %.9g %.9g %.9g %.9g %.9g\n", p[0], p[1], p[2], n[0], n[1], n[2]);

    azulejo_points_free(points);
    azulejo_mesh_free(mesh);
    azulejo_context_free(context);
    return EXIT_SUCCESS;
}
