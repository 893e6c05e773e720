/* A progress callback that counts what it sees, and cancels where it is to. */

#ifndef AZULEJO_TESTS_WATCH_H
#define AZULEJO_TESTS_WATCH_H

#include <pthread.h>

#include "samples.h"

/* What a callback saw, and when it is to cancel. */
typedef struct {
    double limit; /* cancels from here on; above 1: never */
    double first, last;
    int calls, falls, late, strangers;
    pthread_t thread;
} watch;

static inline uint32_t tell(void *user, double done) {
    watch *w = user;
    if (w->calls++ == 0) w->first = done;
    w->falls += done < w->last;
    w->late += w->last >= w->limit;
    w->strangers += !pthread_equal(w->thread, pthread_self());
    w->last = done;
    return done >= w->limit ? 42 : 0;
}

static inline watch make_watch(double limit) {
    watch w = {limit, -1, -1, 0, 0, 0, 0, pthread_self()};
    return w;
}

#endif
