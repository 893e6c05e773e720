/* Faults from outside: callbacks that answer with garbage, cancelling at every stage, a fork between create and use, limits
   of memory, a stdout that is not there. */

#include <fcntl.h>
#include <limits.h>
#include <math.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "samples.h"

#define INVALID AZULEJO_ERROR_INVALID_ARGUMENT

static azulejo_mesh *cube;
static float random_xy[400];

/* Every call that makes samples, with an end that a callback may bring about. */
typedef struct {
    azulejo_progress_fn progress;
    void *user;
} watcher;

typedef azulejo_status (*sampler)(const azulejo_context *, watcher, azulejo_points **);

#define WATCHED(options, w) ((options).progress = (w).progress, (options).progress_user = (w).user)

static azulejo_status kdrt(const azulejo_context *context, watcher w, azulejo_points **out) {
    azulejo_kdrt_options o = kdrt_options(0.02);
    WATCHED(o, w);
    return azulejo_kdrt_sample(context, &o, out, NULL);
}

static azulejo_status counted(const azulejo_context *context, watcher w, azulejo_points **out) {
    azulejo_kdrt_options o = kdrt_options(0);
    o.count = 3000;
    WATCHED(o, w);
    return azulejo_kdrt_sample(context, &o, out, NULL);
}

static azulejo_status window(const azulejo_context *context, watcher w, azulejo_points **out) {
    const double low[2] = {0.1, 0.2}, high[2] = {0.7, 0.9};
    azulejo_kdrt_options o = kdrt_options(0.02);
    WATCHED(o, w);
    return azulejo_kdrt_sample_window(context, &o, low, high, out, NULL);
}

static azulejo_status maximal(const azulejo_context *context, watcher w, azulejo_points **out) {
    azulejo_maximal_options o = maximal_options(0.05);
    WATCHED(o, w);
    return azulejo_maximal_sample(context, &o, out, NULL);
}

static azulejo_status merge(const azulejo_context *context, watcher w, azulejo_points **out) {
    const float xy[] = {0.25f, 0.5f, 0.75f, 0.5f};
    const azulejo_kdrt_merge_piece pieces[] = {{xy, 1, {0, 0}, {0.5, 1}}, {xy + 2, 1, {0.5, 0}, {1, 1}}};
    azulejo_kdrt_merge_options o = merge_options(0.05);
    WATCHED(o, w);
    return azulejo_kdrt_merge(context, &o, pieces, 2, sizeof(azulejo_kdrt_merge_piece), NULL, 0, out, NULL);
}

static azulejo_status psp(const azulejo_context *context, watcher w, azulejo_points **out) {
    azulejo_psp_options o = psp_options(0.1);
    o.iterations = 1;
    WATCHED(o, w);
    return azulejo_psp_sample(context, cube, &o, out, NULL);
}

static azulejo_status raster(const azulejo_context *context, watcher w, azulejo_points **out) {
    azulejo_psp_options o = psp_options(0.1);
    o.iterations = 1;
    o.engine = AZULEJO_ENGINE_RASTERISER;
    WATCHED(o, w);
    return azulejo_psp_sample(context, cube, &o, out, NULL);
}

static azulejo_status adaptive(const azulejo_context *context, watcher w, azulejo_points **out) {
    const float radii[8] = {0.1f, 0.1f, 0.1f, 0.1f, 0.3f, 0.3f, 0.3f, 0.3f};
    azulejo_psp_adaptive_options o;
    ACCEPTED(azulejo_psp_adaptive_options_init(&o, sizeof o));
    o.vertex_radii = radii;
    o.vertex_count = 8;
    WATCHED(o, w);
    return azulejo_psp_adaptive_sample(context, cube, &o, out, NULL);
}

static azulejo_status dcr(const azulejo_context *context, watcher w, azulejo_points **out) {
    azulejo_dcr_options o = dcr_options(20);
    WATCHED(o, w);
    return azulejo_dcr_relax(context, &o, random_xy, COUNT_OF(random_xy) / 2, out, NULL);
}

static const sampler samplers[] = {kdrt, counted, window, maximal, merge, psp, raster, adaptive, dcr};

/* Lets so many calls pass and then answers with whatever it is told to. */
typedef struct {
    int passes, calls;
    uint32_t answer;
} stubborn;

static uint32_t answer(void *user, double done) {
    stubborn *s = user;
    (void)done;
    return s->calls++ < s->passes ? 0 : s->answer;
}

/* Wherever a call is cancelled, by whatever number, it ends there and leaves the context as good as new. */
static void cancelled_at_every_stage(const azulejo_context *context) {
    const uint32_t garbage[] = {1, -1, INT_MIN, INT_MAX, 0x5555};
    size_t i;
    for (i = 0; i < COUNT_OF(samplers); i++) {
        azulejo_points *expected = NULL, *points;
        int passes, stages = 1;
        ACCEPTED(samplers[i](context, (watcher){NULL, NULL}, &expected));
        for (passes = 0; passes < stages; passes += 1 + stages / 12) {
            stubborn s = {passes, 0, garbage[passes % 5]};
            const watcher w = {answer, &s};
            azulejo_status status;
            points = UNTOUCHED;
            status = samplers[i](context, w, &points);
            if (samplers[i] == dcr) { /* which returns what it has */
                if (CHECK(status == AZULEJO_OK)) azulejo_points_free(points);
            } else if (status != AZULEJO_OK) {
                CHECK(status == AZULEJO_ERROR_CANCELLED && points == UNTOUCHED);
            } else {
                azulejo_points_free(points);
                break;
            }
            CHECK(s.calls <= passes + 1);
            /* The number of calls depends on time where there are threads. */
            stages = s.calls > passes ? s.calls + 1 : passes;
        }
        CHECK(passes > 1);
        points = NULL;
        ACCEPTED(samplers[i](context, (watcher){NULL, NULL}, &points));
        CHECK(same_points(points, expected));
        azulejo_points_free(points);
        azulejo_points_free(expected);
    }
}

static double garbage_radius(void *user, const double *position) {
    (void)position;
    return *(const double *)user;
}

static void radii_that_are_garbage(const azulejo_context *context) {
    double garbage[] = {NAN, INFINITY, -INFINITY, 0, -0.1, 1e308, 1e-308, 0.0999};
    size_t i;
    for (i = 0; i < COUNT_OF(garbage); i++) {
        azulejo_points *out = UNTOUCHED;
        azulejo_psp_adaptive_options o;
        ACCEPTED(azulejo_psp_adaptive_options_init(&o, sizeof o));
        o.radius_function = garbage_radius;
        o.radius_function_user = &garbage[i];
        o.smallest = 0.1;
        o.largest = 0.2;
        REFUSED(INVALID, "radius", azulejo_psp_adaptive_sample(context, cube, &o, &out, NULL));
        CHECK(out == UNTOUCHED);
    }
}

/* Functions that are steeper than is said, and slopes that nothing can be proved with: the call ends, and says why. */
static double steep(void *user, const double *position) {
    (void)user;
    return position[0] < 0.4142 ? 0.1 : 0.2;
}

static double even(void *user, const double *position) {
    (void)user, (void)position;
    return 0.4;
}

static azulejo_psp_adaptive_options by_function(azulejo_radius_fn radius, double smallest, double largest, double slope) {
    azulejo_psp_adaptive_options o;
    ACCEPTED(azulejo_psp_adaptive_options_init(&o, sizeof o));
    o.radius_function = radius;
    o.smallest = smallest;
    o.largest = largest;
    o.slope = slope;
    return o;
}

static void radii_that_are_not_as_told(const azulejo_context *context) {
    const azulejo_psp_adaptive_options lying = by_function(steep, 0.1, 0.2, 0.25), vain = by_function(even, 0.2, 0.6, 100);
    azulejo_psp_adaptive_options apart = by_function(even, 0.4, 0.4, 0);
    azulejo_points *out = UNTOUCHED;
    REFUSED(INVALID, "slope 0.25", azulejo_psp_adaptive_sample(context, cube, &lying, &out, NULL));
    REFUSED(AZULEJO_ERROR_TOO_LARGE, "slope: 100.0", azulejo_psp_adaptive_sample(context, cube, &vain, &out, NULL));
    CHECK(out == UNTOUCHED);
    /* A triangle's samples see each other even if nobody else does. */
    apart.cosine = 1;
    ACCEPTED(azulejo_psp_adaptive_sample(context, cube, &apart, &out, NULL));
    CHECK(azulejo_points_count(out) > 6 && azulejo_points_count(out) < 200);
    azulejo_points_free(out);
}

/* Runs a part of the test in a process of its own, which has a minute; its exit code, or 128 and the signal. */
static int in_child(void (*part)(void *), void *user) {
    int status = 0;
    pid_t child;
    fflush(NULL);
    child = fork();
    if (child == 0) {
        check_counts.passed = check_counts.failed = 0;
        alarm(60);
        part(user);
        fflush(NULL);
        /* Another program exits: valgrind would look for leaks here, and find what was the parent's threads'. */
        execl("/bin/sh", "sh", "-c", check_counts.failed == 0 ? "exit 0" : "exit 1", (char *)NULL);
        _exit(2);
    }
    if (child < 0 || waitpid(child, &status, 0) != child) return -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

typedef struct {
    azulejo_context *one, *two;
    azulejo_psp *set;
    azulejo_points *points;
    azulejo_kdrt *plane;
} made_before;

/* What was made before a fork, after it. */
static void forked(void *user) {
    made_before *before = user;
    azulejo_context *after = NULL;
    size_t i;
    for (i = 0; i < COUNT_OF(samplers); i++) {
        azulejo_points *points = UNTOUCHED;
        REFUSED(AZULEJO_ERROR_THREADS, "forked", samplers[i](before->two, (watcher){NULL, NULL}, &points));
        CHECK(points == UNTOUCHED);
    }
    REFUSED(AZULEJO_ERROR_THREADS, "forked", azulejo_psp_fill(before->set, NULL));
    CHECK(azulejo_context_num_threads(before->two) == 2 && azulejo_points_count(before->points) > 0);
    {
        const double low[2] = {0.25, 0.5}, high[2] = {0.5, 0.75};
        azulejo_points *window = NULL;
        ACCEPTED(azulejo_kdrt_window(before->plane, low, high, &window));
        CHECK(azulejo_points_count(window) > 300);
        azulejo_points_free(window);
    }

    ACCEPTED(azulejo_context_create(2, &after));
    for (i = 0; i < COUNT_OF(samplers); i++) {
        azulejo_points *points[2] = {NULL, NULL};
        if (samplers[i] == psp) continue; /* Embree's threads are not there */
        ACCEPTED(samplers[i](before->one, (watcher){NULL, NULL}, &points[0]));
        ACCEPTED(samplers[i](after, (watcher){NULL, NULL}, &points[1]));
        CHECK(same_points(points[0], points[1]));
        azulejo_points_free(points[0]);
        azulejo_points_free(points[1]);
    }
    azulejo_kdrt_free(before->plane);
    azulejo_psp_free(before->set);
    azulejo_points_free(before->points);
    azulejo_context_free(before->two);
    azulejo_context_free(before->one);
    azulejo_context_free(after);
    azulejo_mesh_free(cube);
}

static void forks(void) {
    azulejo_psp_options o = psp_options(0.1);
    azulejo_kdrt_options p = kdrt_options(0.01);
    made_before before = {make_context(1), make_context(2), NULL, NULL, NULL};
    p.leaf_size = 6;
    p.domain_max[0] = 2;
    ACCEPTED(azulejo_kdrt_create(before.two, &p, &before.plane));
    ACCEPTED(azulejo_psp_create(before.two, cube, &o, &before.set));
    ACCEPTED(azulejo_psp_advance(before.set, 1, NULL));
    ACCEPTED(azulejo_psp_points(before.set, &before.points));
    CHECK(in_child(forked, &before) == 0);
    /* The fork is nothing to the parent. */
    ACCEPTED(azulejo_psp_fill(before.set, NULL));
    azulejo_kdrt_free(before.plane);
    azulejo_psp_free(before.set);
    azulejo_points_free(before.points);
    azulejo_context_free(before.two);
    azulejo_context_free(before.one);
}

/* With an address space of 2 GiB more than is used, what needs more is refused and not begun. */
static void in_little_memory(void *context) {
    azulejo_kdrt_options plane = kdrt_options(1e-5);
    azulejo_psp_options surface = psp_options(1e-4);
    azulejo_dcr_options relaxed = dcr_options(1);
    azulejo_density density;
    const float white = 1;
    azulejo_points *out = UNTOUCHED;
    char line[256];
    unsigned long pages = 0;
    FILE *statm = fopen("/proc/self/statm", "r");
    struct rlimit limit;
    CHECK(statm != NULL && fgets(line, sizeof line, statm) != NULL && sscanf(line, "%lu", &pages) == 1);
    if (statm != NULL) fclose(statm);
    limit.rlim_cur = limit.rlim_max = (rlim_t)pages * (rlim_t)sysconf(_SC_PAGESIZE) + ((rlim_t)2 << 30);
    CHECK(setrlimit(RLIMIT_AS, &limit) == 0);
    REFUSED(AZULEJO_ERROR_TOO_LARGE, "radius", azulejo_kdrt_sample(context, &plane, &out, NULL));
    REFUSED(AZULEJO_ERROR_TOO_LARGE, "radius", azulejo_psp_sample(context, cube, &surface, &out, NULL));
    plane.radius = 0;
    plane.count = 1000000000;
    REFUSED(AZULEJO_ERROR_TOO_LARGE, "count", azulejo_kdrt_sample(context, &plane, &out, NULL));
    ACCEPTED(azulejo_density_init(&density, sizeof density));
    density.values = &white;
    density.width = density.height = 1;
    REFUSED(AZULEJO_ERROR_TOO_LARGE, "count", azulejo_dcr_scatter(context, &relaxed, &density, 1000000000, &out));
    CHECK(out == UNTOUCHED);
}

/* Arrays whose sizes no memory has are refused before they are read. */
static void arrays_of_any_size(void) {
    const size_t huge = SIZE_MAX / 64;
    azulejo_mesh *out = UNTOUCHED;
    REFUSED(AZULEJO_ERROR_OUT_OF_MEMORY, "positions",
            azulejo_mesh_create(&cube_positions[0][0], huge, 12, &cube_indices[0][0], 12, &out));
    REFUSED(AZULEJO_ERROR_OUT_OF_MEMORY, "indices",
            azulejo_mesh_create(&cube_positions[0][0], 8, 12, &cube_indices[0][0], huge, &out));
    REFUSED(AZULEJO_ERROR_OUT_OF_MEMORY, "normals",
            azulejo_mesh_with_normals(cube, &cube_positions[0][0], huge, 12, NULL, 0, &out));
    CHECK(out == UNTOUCHED);
}

/* Refusals and results of all kinds, with a stdout that is a file and one that is closed: nothing is written to it. */
static void say_nothing(void *closed) {
    char name[] = "/tmp/azulejo-stdout-XXXXXX";
    const int file = mkstemp(name), kept = dup(STDOUT_FILENO);
    azulejo_context *context = NULL;
    azulejo_mesh *mesh = UNTOUCHED;
    azulejo_points *points = NULL;
    size_t i;
    if (!CHECK(file >= 0 && kept >= 0)) return;
    if (closed) close(STDOUT_FILENO);
    else CHECK(dup2(file, STDOUT_FILENO) == STDOUT_FILENO);

    azulejo_context_create(2, &context);
    for (i = 0; i < COUNT_OF(samplers); i++)
        if (samplers[i](context, (watcher){NULL, NULL}, &points) == AZULEJO_OK) azulejo_points_free(points);
    azulejo_mesh_load("/no/such/file.obj", &mesh);
    azulejo_mesh_load(name, &mesh);
    azulejo_kdrt_sample(NULL, NULL, NULL, NULL);
    azulejo_context_free(context);
    azulejo_mesh_free(cube);

    CHECK(lseek(file, 0, SEEK_END) == 0);
    CHECK(dup2(kept, STDOUT_FILENO) == STDOUT_FILENO);
    close(file);
    unlink(name);
}

int main(void) {
    azulejo_context *one = make_context(1), *three = make_context(3);
    random_points(random_xy, COUNT_OF(random_xy) / 2);
    cube = make_cube();
    cancelled_at_every_stage(one);
    cancelled_at_every_stage(three);
    radii_that_are_garbage(one);
    radii_that_are_garbage(three);
    radii_that_are_not_as_told(one);
    radii_that_are_not_as_told(three);
    arrays_of_any_size();
    forks();
    CHECK(in_child(in_little_memory, one) == 0);
    CHECK(in_child(say_nothing, NULL) == 0);
    CHECK(in_child(say_nothing, "closed") == 0);
    azulejo_mesh_free(cube);
    azulejo_context_free(one);
    azulejo_context_free(three);
    return finish();
}
