/* Sets of meshes of exact counts and in progressive order: what is refused. */

#include <math.h>

#include "samples.h"

#define INVALID AZULEJO_ERROR_INVALID_ARGUMENT

static azulejo_context *one, *four;
static azulejo_mesh *cube;

static azulejo_psp_options of_count(size_t count, uint32_t order) {
    azulejo_psp_options options = psp_options(0);
    options.count = count;
    options.order = order;
    return options;
}

static void refusals(void) {
    azulejo_psp_options o;
    azulejo_points *out = UNTOUCHED;
    azulejo_psp *psp = UNTOUCHED;
#define COUNTED(status, part, change) \
    (o = of_count(100, AZULEJO_ORDER_PROGRESSIVE), (void)(change), \
     REFUSED(status, part, azulejo_psp_sample(one, cube, &o, &out, NULL)))
    COUNTED(INVALID, "radius", o.count = 0);
    COUNTED(INVALID, "count: 100 with radius 0.1; give one of the two", o.radius = 0.1);
    COUNTED(INVALID, "count", o.radius = NAN);
    COUNTED(INVALID, "order: 2", o.order = 2);
    COUNTED(INVALID, "quotient: 1.6", o.quotient = 1.6);
    COUNTED(INVALID, "quotient", o.quotient = NAN);
    COUNTED(INVALID, "quotient: 1.2 has no effect in any order", (o.order = AZULEJO_ORDER_ANY, o.quotient = 1.2));
    COUNTED(INVALID, "iterations: 1", o.iterations = 1);
    COUNTED(INVALID, "iterations: 1", (o.order = AZULEJO_ORDER_ANY, o.iterations = 1));
    COUNTED(INVALID, "maximal", (o.iterations = 0, o.maximal = 0));
    COUNTED(AZULEJO_ERROR_TOO_LARGE, "count", o.count = (size_t)1 << 40);
    COUNTED(AZULEJO_ERROR_TOO_LARGE, "count", o.count = SIZE_MAX);
#undef COUNTED
    o = of_count(100, AZULEJO_ORDER_ANY);
    REFUSED(INVALID, "count: 100 has no effect in azulejo_psp_create", azulejo_psp_create(one, cube, &o, &psp));
    o = psp_options(0.1);
    o.order = AZULEJO_ORDER_PROGRESSIVE;
    REFUSED(INVALID, "order: 1 has no effect in azulejo_psp_create", azulejo_psp_create(one, cube, &o, &psp));
    CHECK(out == UNTOUCHED && psp == UNTOUCHED);
}

int main(void) {
    one = make_context(1);
    four = make_context(4);
    cube = make_cube();
    refusals();
    azulejo_mesh_free(cube);
    azulejo_context_free(one);
    azulejo_context_free(four);
    return finish();
}
