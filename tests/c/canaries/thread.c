/* Changes points while the library reads them: ThreadSanitizer has to see it. */

#include <pthread.h>

#include "../samples.h"

enum { POINTS = 1000 };
static float xy[2 * POINTS];

static void *change(void *user) {
    int round;
    (void)user;
    for (round = 0; round < 2000; round++) random_points(xy, POINTS);
    return NULL;
}

int main(void) {
    azulejo_context *context = make_context(1);
    azulejo_dcr_options options = dcr_options(20);
    azulejo_points *points = NULL;
    pthread_t thread;
    random_points(xy, POINTS);
    if (pthread_create(&thread, NULL, change, NULL) != 0) return EXIT_FAILURE;
    if (azulejo_dcr_relax(context, &options, xy, POINTS, &points, NULL) == AZULEJO_OK) azulejo_points_free(points);
    pthread_join(thread, NULL);
    azulejo_context_free(context);
    return EXIT_SUCCESS;
}
