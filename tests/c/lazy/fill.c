/* Fills a square and a cube; with an argument, also iterates on the cube. Says what is refused.
 *
 *   fill [iterate] */
#include "../samples.h"

int main(int argc, char **argv) {
    azulejo_context *context = make_context(1);
    azulejo_mesh *cube = make_cube();
    const azulejo_kdrt_options plane = kdrt_options(0.1);
    azulejo_psp_options surface = psp_options(0.2);
    azulejo_points *points = NULL;
    azulejo_status status;
    (void)argv;
    ACCEPTED(azulejo_kdrt_sample(context, &plane, &points, NULL));
    azulejo_points_free(points);
    ACCEPTED(azulejo_psp_sample(context, cube, &surface, &points, NULL));
    azulejo_points_free(points);
    if (argc > 1) {
        surface.iterations = 1;
        surface.engine = AZULEJO_ENGINE_EMBREE;
        points = UNTOUCHED;
        status = azulejo_psp_sample(context, cube, &surface, &points, NULL);
        if (status == AZULEJO_OK) {
            azulejo_points_free(points);
        } else {
            printf("status %d: %s\n", (int)status, last_error());
            CHECK(points == UNTOUCHED);
            /* The other engine needs no library. */
            surface.engine = AZULEJO_ENGINE_RASTERISER;
            ACCEPTED(azulejo_psp_sample(context, cube, &surface, &points, NULL));
            azulejo_points_free(points);
        }
    }
    azulejo_mesh_free(cube);
    azulejo_context_free(context);
    return finish();
}
