/* Points that another thread has written, and the library reads with nothing that orders the two: ThreadSanitizer has
   to see it. A relaxed flag orders nothing, but lets the write come first, always: the access that is reported is then
   the library's, and its stack is known. */

#include <pthread.h>

#include "../samples.h"

enum { POINTS = 1000 };
static float xy[2 * POINTS];
static int written;

static void *write_points(void *user) {
    (void)user;
    random_points(xy, POINTS);
    __atomic_store_n(&written, 1, __ATOMIC_RELAXED);
    return NULL;
}

int main(void) {
    azulejo_context *context = make_context(1);
    azulejo_dcr_options options = dcr_options(20);
    azulejo_points *points = NULL;
    pthread_t thread;
    if (pthread_create(&thread, NULL, write_points, NULL) != 0) return EXIT_FAILURE;
    while (!__atomic_load_n(&written, __ATOMIC_RELAXED)) {}
    if (azulejo_dcr_relax(context, &options, xy, POINTS, &points, NULL) == AZULEJO_OK) azulejo_points_free(points);
    pthread_join(thread, NULL);
    azulejo_context_free(context);
    return EXIT_SUCCESS;
}
