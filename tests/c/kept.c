/* Planes that are kept: windows on several threads at once, without the context of the plane; bad arguments are refused. */

#include <math.h>
#include <pthread.h>

#include "samples.h"

#define INVALID AZULEJO_ERROR_INVALID_ARGUMENT

static azulejo_context *two;

/* The plane, made with a context that does not live longer. */
static azulejo_kdrt *make_plane(const azulejo_kdrt_options *options) {
    azulejo_context *context = make_context(2);
    azulejo_kdrt *plane = NULL;
    if (!ACCEPTED(azulejo_kdrt_create(context, options, &plane))) exit(finish());
    azulejo_context_free(context);
    return plane;
}

/* A window with a sample: small and large ones, narrow and wide, of one float, and from the lower corner on. */
static void window_of(const azulejo_kdrt_options *options, const float *sample, size_t i, double low[2],
                      double high[2]) {
    const double width = options->radius * pow(2, (double)(i % 9) - 3);
    const double sides[2] = {width, 60 * options->radius - width};
    int axis;
    for (axis = 0; axis < 2; axis++) {
        const double min = options->domain_min[axis], max = options->domain_max[axis];
        low[axis] = i % 5 == 1 ? min : sample[axis];
        high[axis] = i % 4 == 0 ? nextafterf(sample[axis], 1) : sample[axis] + sides[axis];
        if (high[axis] > max) high[axis] = max;
    }
}

/* What one of several threads makes of a plane; the checks count in the main thread. */
typedef struct {
    const azulejo_kdrt *plane;
    const azulejo_kdrt_options *options;
    const azulejo_points *whole;
    size_t first;
    int wrong;
} work;

static void *make_windows(void *user) {
    work *w = user;
    size_t i;
    for (i = w->first; i < w->first + 30; i++) {
        const float *sample = azulejo_points_positions(w->whole) + 2 * (i * 104729 % azulejo_points_count(w->whole));
        azulejo_points *window = NULL;
        double low[2], high[2];
        window_of(w->options, sample, i, low, high);
        if (azulejo_kdrt_window(w->plane, low, high, &window) != AZULEJO_OK) w->wrong++;
        w->wrong += !is_part(window, w->whole, low[0], low[1], high[0], high[1]);
        azulejo_points_free(window);
    }
    return NULL;
}

static void threads_on_one_plane(const azulejo_kdrt_options *options) {
    azulejo_kdrt *plane = make_plane(options);
    azulejo_points *whole = NULL;
    pthread_t threads[4];
    work works[4];
    size_t i;
    ACCEPTED(azulejo_kdrt_sample(two, options, &whole, NULL));
    for (i = 0; i < 4; i++) {
        const work w = {plane, options, whole, 30 * i, 0};
        works[i] = w;
        CHECK(pthread_create(&threads[i], NULL, make_windows, &works[i]) == 0);
    }
    for (i = 0; i < 4; i++) CHECK(pthread_join(threads[i], NULL) == 0 && works[i].wrong == 0);
    azulejo_points_free(whole);
    azulejo_kdrt_free(plane);
}

static void no_planes(void) {
    azulejo_kdrt_options good = kdrt_options(0.1);
    azulejo_kdrt *out = UNTOUCHED;
    REFUSED(INVALID, "context", azulejo_kdrt_create(NULL, &good, &out));
    REFUSED(INVALID, "options", azulejo_kdrt_create(two, NULL, &out));
    REFUSED(INVALID, "options", azulejo_kdrt_create(two, (azulejo_kdrt_options *)((char *)&good + 1), &out));
    REFUSED(INVALID, "out", azulejo_kdrt_create(two, &good, NULL));
#define NO_PLANE(status, part, change)                              \
    do {                                                            \
        azulejo_kdrt_options o = good;                              \
        (void)(change);                                             \
        REFUSED(status, part, azulejo_kdrt_create(two, &o, &out));  \
        CHECK(out == UNTOUCHED);                                    \
    } while (0)
    NO_PLANE(INVALID, "radius", o.radius = 0);
    NO_PLANE(INVALID, "radius", o.radius = NAN);
    NO_PLANE(INVALID, "radius", o.radius = 1e-6);
    NO_PLANE(INVALID, "leaf_size", o.leaf_size = 5.9);
    NO_PLANE(INVALID, "boundary", o.boundary = 2);
    NO_PLANE(INVALID, "domain_max: [1]", o.domain_max[1] = -1);
    NO_PLANE(INVALID, "domain_min", o.domain_min[0] = -INFINITY);
    NO_PLANE(INVALID, "count", o.count = 100);
    NO_PLANE(INVALID, "measure_covering_radius", o.measure_covering_radius = 1);
    NO_PLANE(INVALID, "order", o.order = 2);
    NO_PLANE(INVALID, "quotient", (o.order = AZULEJO_ORDER_PROGRESSIVE, o.quotient = 1.6));
    NO_PLANE(INVALID, "coarsest", (o.order = AZULEJO_ORDER_PROGRESSIVE, o.coarsest = o.radius / 2));
    NO_PLANE(INVALID, "struct_size", o.struct_size = 3);
    NO_PLANE(AZULEJO_ERROR_TOO_LARGE, "radius", (o.radius = 8.5e-6, o.leaf_size = 1e30));
#undef NO_PLANE
    azulejo_kdrt_free(NULL);
}

static void no_windows(const azulejo_kdrt_options *options) {
    const double inner[2] = {-1.25, 0.5};
    azulejo_kdrt *plane = make_plane(options);
    azulejo_points *out = UNTOUCHED;
    const double *misaligned = (const double *)((const char *)inner + 1);
    REFUSED(INVALID, "plane: is NULL", azulejo_kdrt_window(NULL, options->domain_min, inner, &out));
    REFUSED(INVALID, "window_min: is NULL", azulejo_kdrt_window(plane, NULL, inner, &out));
    REFUSED(INVALID, "window_max: is NULL", azulejo_kdrt_window(plane, inner, NULL, &out));
    REFUSED(INVALID, "window_min", azulejo_kdrt_window(plane, misaligned, options->domain_max, &out));
    REFUSED(INVALID, "window_max", azulejo_kdrt_window(plane, options->domain_min, misaligned, &out));
    REFUSED(INVALID, "out", azulejo_kdrt_window(plane, options->domain_min, inner, NULL));
    REFUSED(INVALID, "window_max: [0] is -1.25", azulejo_kdrt_window(plane, inner, inner, &out));
    REFUSED(INVALID, "window_max: [0] is -1.25", azulejo_kdrt_window(plane, options->domain_max, inner, &out));
#define NO_WINDOW(part, change)                                         \
    do {                                                                \
        double min[2] = {-1, 0.25}, max[2] = {0, 0.75};                 \
        (void)(change);                                                 \
        REFUSED(INVALID, part, azulejo_kdrt_window(plane, min, max, &out)); \
    } while (0)
    NO_WINDOW("window_min: [0]", min[0] = NAN);
    NO_WINDOW("window_min: [1]", min[1] = NAN);
    NO_WINDOW("window_min: [0]", min[0] = -1.5000001);
    NO_WINDOW("window_min: [1]", min[1] = -INFINITY);
    NO_WINDOW("window_max: [0]", max[0] = NAN);
    NO_WINDOW("window_max: [1]", max[1] = NAN);
    NO_WINDOW("window_max: [0]", max[0] = 0.1500001);
    NO_WINDOW("window_max: [1]", max[1] = INFINITY);
    NO_WINDOW("window_max: [1]", max[1] = 0.25);
    NO_WINDOW("window_max: [1]", max[1] = 0);
#undef NO_WINDOW
    CHECK(out == UNTOUCHED);
    azulejo_kdrt_free(plane);
}

typedef struct {
    double last, limit;
    int calls;
} watch;

static uint32_t tell(void *user, double done) {
    watch *w = user;
    w->last = done;
    w->calls++;
    return done >= w->limit;
}

/* The making is watched and cancelled; windows are not. */
static void progress(azulejo_kdrt_options options) {
    watch w = {-1, 2, 0};
    azulejo_kdrt *plane = UNTOUCHED;
    azulejo_context *cold = NULL;
    azulejo_points *window = NULL;
    int calls;
    options.progress = tell;
    options.progress_user = &w;
    /* A context that keeps no pattern yet: where one does, hardly anything is left to be watched. */
    ACCEPTED(azulejo_context_create(2, &cold));
    ACCEPTED(azulejo_kdrt_create(cold, &options, &plane));
    azulejo_context_free(cold);
    CHECK(w.last == 1 && w.calls > 2);
    calls = w.calls;
    ACCEPTED(azulejo_kdrt_window(plane, options.domain_min, options.domain_max, &window));
    CHECK(w.calls == calls);
    azulejo_points_free(window);
    azulejo_kdrt_free(plane);
    plane = UNTOUCHED;
    for (w.limit = 0; w.limit <= 1; w.limit += 0.5) {
        REFUSED(AZULEJO_ERROR_CANCELLED, "cancelled", azulejo_kdrt_create(two, &options, &plane));
        CHECK(plane == UNTOUCHED);
    }
}

int main(void) {
    const uint32_t boundaries[] = {AZULEJO_BOUNDARY_PERIODIC, AZULEJO_BOUNDARY_BOUNDED};
    size_t i;
    two = make_context(2);
    no_planes();
    for (i = 0; i < 2; i++) {
        const azulejo_kdrt_options tiled = plane_options(boundaries[i], 0.005);
        const azulejo_kdrt_options whole = plane_options(boundaries[i], 0.05);
        threads_on_one_plane(&tiled);
        threads_on_one_plane(&whole);
        no_windows(&tiled);
        no_windows(&whole);
        progress(tiled);
        progress(whole);
    }
    azulejo_context_free(two);
    return finish();
}
