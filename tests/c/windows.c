/* Streams of a plane: the bytes of the whole on any number of threads; streams that are left at their start, in their middle
   and at their end, and calls from within a visit. */

#include <pthread.h>

#include "samples.h"

static azulejo_context *one, *four;

static azulejo_points *make_window(const azulejo_context *context, const azulejo_kdrt_options *options, double left,
                                   double bottom, double right, double top) {
    const double low[2] = {left, bottom}, high[2] = {right, top};
    azulejo_points *points = NULL;
    ACCEPTED(azulejo_kdrt_sample_window(context, options, low, high, &points, NULL));
    return points;
}

/* Where a stream goes, and when it is to be left. */
typedef struct {
    float *xy;
    size_t count, capacity;
    int visits, last, strangers, empty;
    pthread_t thread;
} sink;

static uint32_t keep(void *user, const float *xy, size_t count) {
    sink *s = user;
    s->visits++;
    s->strangers += !pthread_equal(s->thread, pthread_self());
    s->empty += count == 0;
    if (s->count + count <= s->capacity) memcpy(s->xy + 2 * s->count, xy, 8 * count);
    s->count += count;
    return s->visits == s->last ? -7 : 0;
}

static sink make_sink(size_t capacity, int last) {
    sink s = {malloc(8 * capacity + 1), 0, capacity, 0, last, 0, 0, pthread_self()};
    return s;
}

/* Gives the number of parts. */
static int streams(const azulejo_context *context, const azulejo_kdrt_options *options, const azulejo_points *whole) {
    const size_t count = azulejo_points_count(whole);
    sink s = make_sink(count, 0);
    ACCEPTED(azulejo_kdrt_stream(context, options, keep, &s, NULL));
    CHECK(s.count == count && s.strangers == 0 && s.empty == 0);
    CHECK(memcmp(s.xy, azulejo_points_positions(whole), 8 * count) == 0);
    free(s.xy);
    return s.visits;
}

static void streams_that_are_left(const azulejo_context *context, const azulejo_kdrt_options *options, int parts) {
    int last;
    for (last = 1; last <= parts; last++) {
        sink s = make_sink(0, last);
        REFUSED(AZULEJO_ERROR_CANCELLED, "cancelled", azulejo_kdrt_stream(context, options, keep, &s, NULL));
        CHECK(s.visits == last && s.strangers == 0);
        free(s.xy);
    }
}

typedef struct {
    double last, limit;
    int falls, late;
} watch;

static uint32_t tell(void *user, double done) {
    watch *w = user;
    w->falls += done < w->last;
    w->late += w->last >= w->limit;
    w->last = done;
    return done >= w->limit;
}

static void progress(const azulejo_context *context, azulejo_kdrt_options options) {
    const double limits[] = {0, 0.3, 0.9, 1, 2};
    size_t i;
    for (i = 0; i < COUNT_OF(limits); i++) {
        watch w = {-1, 0, 0, 0};
        sink s = make_sink(0, 0);
        azulejo_points *points = UNTOUCHED;
        w.limit = limits[i];
        options.progress = tell;
        options.progress_user = &w;
        if (limits[i] > 1) {
            ACCEPTED(azulejo_kdrt_stream(context, &options, keep, &s, NULL));
            CHECK(w.last == 1);
        } else {
            REFUSED(AZULEJO_ERROR_CANCELLED, "cancelled", azulejo_kdrt_stream(context, &options, keep, &s, NULL));
            CHECK(limits[i] > 0 || s.visits == 0);
            CHECK(w.falls == 0 && w.late == 0);
            w.last = -1;
            REFUSED(AZULEJO_ERROR_CANCELLED, "cancelled",
                    azulejo_kdrt_sample_window(context, &options, options.domain_min, options.domain_max, &points, NULL));
            CHECK(points == UNTOUCHED);
        }
        CHECK(w.falls == 0 && w.late == 0);
        free(s.xy);
    }
}

/* A visit that makes a window with the context that the stream runs on. */
static uint32_t look_closer(void *user, const float *xy, size_t count) {
    const azulejo_context *context = user;
    const azulejo_kdrt_options options = plane_options(AZULEJO_BOUNDARY_PERIODIC, 0.005);
    azulejo_points *points = make_window(context, &options, xy[0], xy[1], xy[0] + 1e-6, xy[1] + 1e-6);
    CHECK(count > 0 && azulejo_points_count(points) == 1);
    CHECK(memcmp(azulejo_points_positions(points), xy, 8) == 0);
    azulejo_points_free(points);
    return 0;
}

int main(void) {
    const uint32_t boundaries[] = {AZULEJO_BOUNDARY_PERIODIC, AZULEJO_BOUNDARY_BOUNDED};
    size_t i;
    one = make_context(1);
    four = make_context(4);
    for (i = 0; i < 2; i++) {
        const azulejo_kdrt_options options = plane_options(boundaries[i], 0.005);
        azulejo_points *whole = NULL;
        int parts;
        ACCEPTED(azulejo_kdrt_sample(one, &options, &whole, NULL));
        parts = streams(one, &options, whole);
        CHECK(parts > 1 && streams(four, &options, whole) == parts);
        streams_that_are_left(one, &options, parts);
        streams_that_are_left(four, &options, parts);
        progress(one, options);
        progress(four, options);
        azulejo_points_free(whole);
    }
    {
        const azulejo_kdrt_options options = plane_options(AZULEJO_BOUNDARY_PERIODIC, 0.005);
        ACCEPTED(azulejo_kdrt_stream(one, &options, look_closer, one, NULL));
        ACCEPTED(azulejo_kdrt_stream(four, &options, look_closer, four, NULL));
    }
    azulejo_context_free(one);
    azulejo_context_free(four);
    return finish();
}
