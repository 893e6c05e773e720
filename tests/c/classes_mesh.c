/* Several classes on a mesh: what does not go with classes is refused. */

#include <math.h>

#include "samples.h"

static azulejo_context *one, *three;
static azulejo_mesh *cube;

static azulejo_classes classes_of(const double *radii, uint32_t count) {
    azulejo_classes classes;
    ACCEPTED(azulejo_classes_init(&classes, sizeof classes));
    classes.count = count;
    classes.radii = radii;
    return classes;
}

static void refused(void) {
    const double radii[4] = {0.2, 0.1, 0.1, 0.2};
    const uint32_t masks[1] = {1};
    const azulejo_psp_options good = psp_options(0);
    const azulejo_classes fine = classes_of(radii, 2);
    azulejo_points *out = NULL;
#define REFUSED_WITH(change_of_options, change_of_classes, part)                                                       \
    do {                                                                                                               \
        azulejo_psp_options o = good;                                                                                  \
        azulejo_classes c = fine;                                                                                      \
        change_of_options;                                                                                             \
        change_of_classes;                                                                                             \
        REFUSED(AZULEJO_ERROR_INVALID_ARGUMENT, part, azulejo_psp_sample_classes(one, cube, &o, &c, &out));            \
    } while (0)
    REFUSED_WITH(o.radius = 0.1, (void)c, "radius");
    REFUSED_WITH(o.count = 5, (void)c, "count");
    REFUSED_WITH(o.order = AZULEJO_ORDER_PROGRESSIVE, (void)c, "order");
    REFUSED_WITH(o.iterations = 1, (void)c, "iterations");
    REFUSED_WITH(o.maximal = 0, (void)c, "maximal");
    REFUSED_WITH(o.priority = AZULEJO_PRIORITY_PROJECTOR, (void)c, "priority");
    if (azulejo_has_embree()) { /* without it the rasteriser is the default */
        REFUSED_WITH(o.engine = AZULEJO_ENGINE_RASTERISER, (void)c, "engine");
    }
    REFUSED_WITH((void)o, c.count = 0, "count");
    REFUSED_WITH((void)o, c.count = 17, "count");
    REFUSED_WITH((void)o, c.radii = NULL, "radii");
    REFUSED_WITH((void)o, (c.masks = masks, c.mask_count = 1), "mask_count");
    REFUSED_WITH((void)o, c.mask_count = 12, "masks");
    REFUSED(AZULEJO_ERROR_INVALID_ARGUMENT, "context", azulejo_psp_sample_classes(NULL, cube, &good, &fine, &out));
    REFUSED(AZULEJO_ERROR_INVALID_ARGUMENT, "mesh", azulejo_psp_sample_classes(one, NULL, &good, &fine, &out));
    REFUSED(AZULEJO_ERROR_INVALID_ARGUMENT, "options", azulejo_psp_sample_classes(one, cube, NULL, &fine, &out));
    REFUSED(AZULEJO_ERROR_INVALID_ARGUMENT, "classes", azulejo_psp_sample_classes(one, cube, &good, NULL, &out));
    REFUSED(AZULEJO_ERROR_INVALID_ARGUMENT, "out", azulejo_psp_sample_classes(one, cube, &good, &fine, NULL));
    CHECK(out == NULL);
}

int main(void) {
    one = make_context(1);
    three = make_context(3);
    cube = make_cube();
    refused();
    azulejo_mesh_free(cube);
    azulejo_context_free(one);
    azulejo_context_free(three);
    return finish();
}
