/* The same bytes for every number of threads; two threads on one context; a psp handle serves one call at a time. */

#include <pthread.h>

#include "samples.h"

enum { POINTS = 500, KINDS = 4, ROUNDS = 3 };

static azulejo_mesh *cube;
static float random_xy[2 * POINTS];

static void sample_all(const azulejo_context *context, azulejo_points *out[KINDS]) {
    azulejo_kdrt_options kdrt = kdrt_options(0.01);
    azulejo_maximal_options maximal = maximal_options(0.05);
    azulejo_psp_options psp = psp_options(0.05);
    azulejo_dcr_options dcr = dcr_options(20);
    psp.iterations = 1;
    ACCEPTED(azulejo_kdrt_sample(context, &kdrt, &out[0], NULL));
    ACCEPTED(azulejo_maximal_sample(context, &maximal, &out[1], NULL));
    ACCEPTED(azulejo_psp_sample(context, cube, &psp, &out[2], NULL));
    ACCEPTED(azulejo_dcr_relax(context, &dcr, random_xy, POINTS, &out[3], NULL));
}

static void free_all(azulejo_points *points[KINDS]) {
    int kind;
    for (kind = 0; kind < KINDS; kind++) azulejo_points_free(points[kind]);
}

/* What one of two threads makes; the checks count in the main thread. */
typedef struct {
    const azulejo_context *context;
    azulejo_status status[ROUNDS];
    azulejo_points *points[ROUNDS];
    int named;
} work;

static void *sample_rounds(void *user) {
    work *w = user;
    azulejo_psp_options psp;
    char message[256];
    int round;
    azulejo_psp_options_init(&psp, sizeof psp);
    psp.radius = 0.05;
    psp.iterations = 1;
    for (round = 0; round < ROUNDS; round++)
        w->status[round] = azulejo_psp_sample(w->context, cube, &psp, &w->points[round], NULL);
    /* This thread's own error, while the other thread makes its own. */
    psp.radius = -1;
    azulejo_psp_sample(w->context, cube, &psp, NULL, NULL);
    azulejo_last_error_message(message, sizeof message);
    w->named = strstr(message, "out") != NULL;
    return NULL;
}

static void two_threads_on_one_context(const azulejo_context *context, const azulejo_points *expected) {
    work works[2] = {{context, {-1, -1, -1}, {NULL, NULL, NULL}, 0}, {context, {-1, -1, -1}, {NULL, NULL, NULL}, 0}};
    pthread_t threads[2];
    int i, round;
    REFUSED(AZULEJO_ERROR_INVALID_ARGUMENT, "context", azulejo_psp_sample(NULL, NULL, NULL, UNTOUCHED, NULL));
    for (i = 0; i < 2; i++) CHECK(pthread_create(&threads[i], NULL, sample_rounds, &works[i]) == 0);
    for (i = 0; i < 2; i++) CHECK(pthread_join(threads[i], NULL) == 0);
    CHECK(strstr(last_error(), "context") != NULL);
    for (i = 0; i < 2; i++) {
        CHECK(works[i].named);
        for (round = 0; round < ROUNDS; round++) {
            CHECK(works[i].status[round] == AZULEJO_OK && same_points(works[i].points[round], expected));
            azulejo_points_free(works[i].points[round]);
        }
    }
}

/* Another thread comes while a call is at work on the handle. */
static void *advance_from_elsewhere(void *set) {
    static azulejo_status status;
    status = azulejo_psp_advance(set, 1, NULL);
    return &status;
}

static uint32_t let_another_thread_try(void *user, double done) {
    pthread_t thread;
    void *status;
    (void)done;
    CHECK(pthread_create(&thread, NULL, advance_from_elsewhere, *(azulejo_psp **)user) == 0);
    CHECK(pthread_join(thread, &status) == 0);
    CHECK(*(azulejo_status *)status == AZULEJO_ERROR_BUSY);
    return 0;
}

static void a_psp_handle_serves_one_call_at_a_time(const azulejo_context *context) {
    azulejo_psp_options options = psp_options(0.2);
    azulejo_psp *set = NULL;
    options.progress = let_another_thread_try;
    options.progress_user = &set;
    ACCEPTED(azulejo_psp_create(context, cube, &options, &set));
    ACCEPTED(azulejo_psp_advance(set, 1, NULL));
    azulejo_psp_free(set);
}

int main(void) {
    azulejo_context *one = make_context(1), *four = make_context(4);
    azulejo_points *expected[KINDS] = {NULL}, *points[KINDS] = {NULL};
    int kind;

    cube = make_cube();
    random_points(random_xy, POINTS);
    sample_all(one, expected);
    sample_all(four, points);
    for (kind = 0; kind < KINDS; kind++) {
        CHECK(azulejo_points_count(expected[kind]) > 0);
        CHECK(same_points(points[kind], expected[kind]));
    }
    two_threads_on_one_context(one, expected[2]);
    two_threads_on_one_context(four, expected[2]);
    a_psp_handle_serves_one_call_at_a_time(one);
    a_psp_handle_serves_one_call_at_a_time(four);

    free_all(expected);
    free_all(points);
    azulejo_mesh_free(cube);
    azulejo_context_free(one);
    azulejo_context_free(four);
    return finish();
}
