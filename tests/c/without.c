/* A library that was built without Embree: what needs it is refused by a clear status, everything else is there. */
#include "samples.h"

static void is_refused(azulejo_context *context, const azulejo_mesh *mesh) {
    azulejo_embree_geometry geometry = {0, 12, 12, 0, 3, 1};
    azulejo_psp_options options;
    azulejo_points *points = NULL;
    azulejo_psp *set = NULL;
    azulejo_mesh *copy = NULL;
    char scene[64];
    azulejo_psp_options_init(&options, sizeof options);
    CHECK(options.engine == AZULEJO_ENGINE_AUTO);
    options.radius = 0.1;
    options.iterations = 1;
    options.engine = AZULEJO_ENGINE_EMBREE;
    REFUSED(AZULEJO_ERROR_UNSUPPORTED, "this build has none", azulejo_psp_sample(context, mesh, &options, &points, NULL));
    CHECK(points == NULL);
    options.iterations = AZULEJO_ITERATIONS_DEFAULT;
    ACCEPTED(azulejo_psp_create(context, mesh, &options, &set));
    CHECK(azulejo_psp_advance(set, 1, NULL) == AZULEJO_ERROR_UNSUPPORTED);
    azulejo_psp_free(set);
    REFUSED(AZULEJO_ERROR_UNSUPPORTED, "this build has none", azulejo_mesh_create_from_embree(scene, &geometry, 1, sizeof(azulejo_embree_geometry), &copy));
    CHECK(copy == NULL);
}

static void is_there(azulejo_context *context, const azulejo_mesh *mesh) {
    azulejo_psp_options options;
    azulejo_points *filled, *projected;
    azulejo_psp_options_init(&options, sizeof options);
    options.radius = 0.1;
    ACCEPTED(azulejo_psp_sample(context, mesh, &options, &filled, NULL));
    options.iterations = 1;
    ACCEPTED(azulejo_psp_sample(context, mesh, &options, &projected, NULL));
    CHECK(azulejo_points_count(filled) > 30 && azulejo_points_count(projected) > 30);
    azulejo_points_free(filled);
    azulejo_points_free(projected);
}

int main(void) {
    azulejo_context *context = make_context(2);
    azulejo_mesh *mesh = make_cube();
    CHECK(azulejo_has_embree() == 0);
    is_refused(context, mesh);
    is_there(context, mesh);
    azulejo_mesh_free(mesh);
    azulejo_context_free(context);
    return finish();
}
