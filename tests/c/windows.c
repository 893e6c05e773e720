/* Windows of a plane and streams of it: the same bytes as the whole, for every partition and number of threads; streams
   that are left at their start, in their middle and at their end. */

#include <pthread.h>

#include "samples.h"

static azulejo_context *one, *four;

static azulejo_points *make_window(const azulejo_context *context, const azulejo_kdrt_options *options, double left,
                                   double bottom, double right, double top) {
    const double low[2] = {left, bottom}, high[2] = {right, top};
    azulejo_points *points = NULL;
    ACCEPTED(azulejo_kdrt_sample_window(context, options, low, high, &points));
    return points;
}

/* Every row and column of windows, cut where nothing else is. */
static void windows(const azulejo_kdrt_options *options, const azulejo_points *whole) {
    const double x[] = {options->domain_min[0], -1.4999, -1.1, -0.3, -0.25, options->domain_max[0]};
    const double y[] = {options->domain_min[1], 0.37, 0.3712, 0.99, options->domain_max[1]};
    size_t i, j, sum = 0;
    for (j = 0; j + 1 < COUNT_OF(y); j++)
        for (i = 0; i + 1 < COUNT_OF(x); i++) {
            azulejo_points *mine = make_window(one, options, x[i], y[j], x[i + 1], y[j + 1]);
            azulejo_points *theirs = make_window(four, options, x[i], y[j], x[i + 1], y[j + 1]);
            CHECK(same_points(mine, theirs));
            CHECK(is_part(mine, whole, x[i], y[j], x[i + 1], y[j + 1]));
            sum += azulejo_points_count(mine);
            azulejo_points_free(mine);
            azulejo_points_free(theirs);
        }
    CHECK(sum == azulejo_points_count(whole));
}

static void the_whole_as_a_window(const azulejo_kdrt_options *options, const azulejo_points *whole) {
    azulejo_points *window = NULL;
    ACCEPTED(azulejo_kdrt_sample_window(four, options, options->domain_min, options->domain_max, &window));
    CHECK(same_points(window, whole));
    azulejo_points_free(window);
}

/* Where a stream goes, and when it is to be left. */
typedef struct {
    float *xy;
    size_t count, capacity;
    int visits, last, strangers, empty;
    pthread_t thread;
} sink;

static int32_t keep(void *user, const float *xy, size_t count) {
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
    ACCEPTED(azulejo_kdrt_stream(context, options, keep, &s));
    CHECK(s.count == count && s.strangers == 0 && s.empty == 0);
    CHECK(memcmp(s.xy, azulejo_points_positions(whole), 8 * count) == 0);
    free(s.xy);
    return s.visits;
}

static void streams_that_are_left(const azulejo_context *context, const azulejo_kdrt_options *options, int parts) {
    int last;
    for (last = 1; last <= parts; last++) {
        sink s = make_sink(0, last);
        REFUSED(AZULEJO_ERROR_CANCELLED, "cancelled", azulejo_kdrt_stream(context, options, keep, &s));
        CHECK(s.visits == last && s.strangers == 0);
        free(s.xy);
    }
}

typedef struct {
    double last, limit;
    int falls, late;
} watch;

static int32_t tell(void *user, double done) {
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
            ACCEPTED(azulejo_kdrt_stream(context, &options, keep, &s));
            CHECK(w.last == 1);
        } else {
            REFUSED(AZULEJO_ERROR_CANCELLED, "cancelled", azulejo_kdrt_stream(context, &options, keep, &s));
            CHECK(limits[i] > 0 || s.visits == 0);
            CHECK(w.falls == 0 && w.late == 0);
            w.last = -1;
            REFUSED(AZULEJO_ERROR_CANCELLED, "cancelled",
                    azulejo_kdrt_sample_window(context, &options, options.domain_min, options.domain_max, &points));
            CHECK(points == UNTOUCHED);
        }
        CHECK(w.falls == 0 && w.late == 0);
        free(s.xy);
    }
}

/* A visit that makes a window with the context that the stream runs on. */
static int32_t look_closer(void *user, const float *xy, size_t count) {
    const azulejo_context *context = user;
    const azulejo_kdrt_options options = plane_options(AZULEJO_BOUNDARY_PERIODIC, 0.005);
    azulejo_points *points = make_window(context, &options, xy[0], xy[1], xy[0] + 1e-6, xy[1] + 1e-6);
    CHECK(count > 0 && azulejo_points_count(points) == 1);
    CHECK(memcmp(azulejo_points_positions(points), xy, 8) == 0);
    azulejo_points_free(points);
    return 0;
}

/* 1.7e9 samples, more than anyone wants to hold here. */
static void a_huge_plane(void) {
    azulejo_kdrt_options options = kdrt_options(2e-5);
    azulejo_points *window = make_window(four, &options, 0.8, 0.1, 0.801, 0.101);
    azulejo_points *same = make_window(one, &options, 0.7999, 0.0999, 0.8011, 0.1011);
    sink s = make_sink(0, 3);
    CHECK(azulejo_points_count(window) > 1700 && azulejo_points_count(window) < 1800); /* 1741 */
    CHECK(is_part(window, same, 0.8, 0.1, 0.801, 0.101));
    azulejo_points_free(window);
    azulejo_points_free(same);
    REFUSED(AZULEJO_ERROR_CANCELLED, "cancelled", azulejo_kdrt_stream(four, &options, keep, &s));
    CHECK(s.visits == 3 && s.count > 50000);
    free(s.xy);
}

/* Less than the pattern: not tiled. */
static void a_small_plane(void) {
    const azulejo_kdrt_options options = kdrt_options(0.1);
    azulejo_points *whole = NULL, *window;
    ACCEPTED(azulejo_kdrt_sample(one, &options, &whole, NULL));
    CHECK(streams(four, &options, whole) == 1);
    window = make_window(four, &options, 0.25, 0, 0.8, 1);
    CHECK(is_part(window, whole, 0.25, 0, 0.8, 1));
    azulejo_points_free(window);
    window = make_window(one, &options, 0.5, 0.5, 0.5000001, 0.5000001);
    CHECK(azulejo_points_count(window) == 0 && azulejo_points_positions(window) == NULL);
    azulejo_points_free(window);
    azulejo_points_free(whole);
}

int main(void) {
    const int32_t boundaries[] = {AZULEJO_BOUNDARY_PERIODIC, AZULEJO_BOUNDARY_BOUNDED};
    size_t i;
    one = make_context(1);
    four = make_context(4);
    for (i = 0; i < 2; i++) {
        const azulejo_kdrt_options options = plane_options(boundaries[i], 0.005);
        azulejo_points *whole = NULL;
        int parts;
        ACCEPTED(azulejo_kdrt_sample(one, &options, &whole, NULL));
        windows(&options, whole);
        the_whole_as_a_window(&options, whole);
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
        ACCEPTED(azulejo_kdrt_stream(one, &options, look_closer, one));
        ACCEPTED(azulejo_kdrt_stream(four, &options, look_closer, four));
    }
    a_huge_plane();
    a_small_plane();
    azulejo_context_free(one);
    azulejo_context_free(four);
    return finish();
}
