/* Tells the library of one point more than there is: AddressSanitizer has to see that the library reads it. */

#include <stdlib.h>

#include "../samples.h"

int main(void) {
    const double low[2] = {0, 0}, high[2] = {1, 1};
    azulejo_context *context = make_context(1);
    float *xy = calloc(3, 2 * sizeof *xy);
    double distance;
    if (xy == NULL) return EXIT_FAILURE;
    azulejo_plane_smallest_distance(context, xy, 4, low, high, AZULEJO_BOUNDARY_BOUNDED, &distance);
    free(xy);
    azulejo_context_free(context);
    return EXIT_SUCCESS;
}
