/* Tells the library of one point more than there is: AddressSanitizer has to see that the library reads it. */

#include <stdlib.h>

#include "../samples.h"

int main(void) {
    azulejo_context *context = make_context(1);
    azulejo_plane_set set;
    float *xy = calloc(3, 2 * sizeof *xy);
    double distance;
    if (xy == NULL) return EXIT_FAILURE;
    azulejo_plane_set_init(&set, sizeof set);
    set.boundary = AZULEJO_BOUNDARY_BOUNDED;
    set.positions = xy;
    set.count = 4;
    azulejo_plane_smallest_distance(context, &set, &distance);
    free(xy);
    azulejo_context_free(context);
    return EXIT_SUCCESS;
}
