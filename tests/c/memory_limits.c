/* Under any limit of address space (ulimit -v) a call succeeds or is refused with AZULEJO_ERROR_TOO_LARGE: it never aborts
   the process. Each call runs in a child process, whose limit leaves so many MB more than the child has.

   glibc gives a thread an arena of 64 MB of address space if it finds them at an aligned place, sooner or later, which
   nothing can foresee: calls of two threads abort then, now and again. So they are tested with one arena for both. */

#ifdef __linux__
#include <malloc.h>
#endif
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "samples.h"

#define POINTS 200000

static float cloud[3 * POINTS];

typedef azulejo_status (*call)(const azulejo_context *context);

static azulejo_status freed(azulejo_status status, azulejo_points *points) {
    azulejo_points_free(points);
    return status;
}

static azulejo_status maximal(const azulejo_context *context) {
    azulejo_maximal_options o;
    azulejo_points *points = NULL;
    azulejo_maximal_options_init(&o, sizeof o);
    o.radius = 0.002;
    return freed(azulejo_maximal_sample(context, &o, &points, NULL), points);
}

static azulejo_status of_plane(const azulejo_context *context, const azulejo_kdrt_options *options) {
    azulejo_points *points = NULL;
    return freed(azulejo_kdrt_sample(context, options, &points, NULL), points);
}

static azulejo_status tiled(const azulejo_context *context) {
    const azulejo_kdrt_options o = kdrt_options(0.0012);
    return of_plane(context, &o);
}

static azulejo_status not_tiled(const azulejo_context *context) {
    azulejo_kdrt_options o = kdrt_options(1);
    o.domain_max[0] = 10;
    o.domain_max[1] = 30000;
    return of_plane(context, &o);
}

static azulejo_status progressive(const azulejo_context *context) {
    azulejo_kdrt_options o = kdrt_options(0.002);
    o.order = AZULEJO_ORDER_PROGRESSIVE;
    return of_plane(context, &o);
}

static azulejo_status counted(const azulejo_context *context) {
    azulejo_kdrt_options o = kdrt_options(0);
    o.count = 300000;
    return of_plane(context, &o);
}

static azulejo_status of_mesh(const azulejo_context *context) {
    const azulejo_psp_options o = psp_options(0.02);
    azulejo_mesh *mesh = make_cube();
    azulejo_points *points = NULL;
    const azulejo_status status = azulejo_psp_sample(context, mesh, &o, &points, NULL);
    azulejo_mesh_free(mesh);
    return freed(status, points);
}

static azulejo_status varying(const azulejo_context *context) {
    const float radii[8] = {0.03f, 0.03f, 0.03f, 0.03f, 0.05f, 0.05f, 0.05f, 0.05f};
    azulejo_psp_adaptive_options o;
    azulejo_mesh *mesh = make_cube();
    azulejo_points *points = NULL;
    azulejo_status status;
    azulejo_psp_adaptive_options_init(&o, sizeof o);
    o.vertex_radii = radii;
    o.vertex_count = 8;
    status = azulejo_psp_adaptive_sample(context, mesh, &o, &points, NULL);
    azulejo_mesh_free(mesh);
    return freed(status, points);
}

static azulejo_status classes(const azulejo_context *context) {
    const double radii[4] = {0.006, 0.003, 0.003, 0.003};
    const azulejo_kdrt_options o = kdrt_options(0);
    azulejo_classes of;
    azulejo_points *points = NULL;
    azulejo_classes_init(&of, sizeof of);
    of.count = 2;
    of.radii = radii;
    return freed(azulejo_kdrt_sample_classes(context, &o, &of, &points, NULL), points);
}

static azulejo_status relaxed(const azulejo_context *context) {
    const azulejo_dcr_options o = dcr_options(2);
    azulejo_points *points = NULL;
    return freed(azulejo_dcr_relax(context, &o, cloud, POINTS / 4, &points, NULL), points);
}

static azulejo_status thinned(const azulejo_context *context) {
    const azulejo_thin_options o = thin_options(0, 1000, AZULEJO_ORDER_PROGRESSIVE);
    azulejo_selection *selection = NULL;
    const azulejo_status status = azulejo_thin(context, &o, cloud, POINTS, 3, &selection, NULL);
    azulejo_selection_free(selection);
    return status;
}

/* The address space of this process, in bytes. */
static rlim_t used(void) {
    char line[200];
    unsigned long kilobytes = 0;
    FILE *status = fopen("/proc/self/status", "r");
    while (status != NULL && fgets(line, sizeof line, status) != NULL) {
        if (sscanf(line, "VmSize: %lu", &kilobytes) == 1) break;
    }
    if (status != NULL) fclose(status);
    return (rlim_t)kilobytes << 10;
}

/* What waitpid says of a child that makes the call with so much memory. */
static int child(call make, uint32_t threads, unsigned megabytes) {
    int state = 0;
    const pid_t pid = fork();
    if (pid == 0) {
        struct rlimit limit;
        azulejo_context *context = NULL;
        azulejo_status status;
        fclose(stderr);
#ifdef M_ARENA_MAX
        if (threads > 1) (void)mallopt(M_ARENA_MAX, 1);
#endif
        limit.rlim_cur = limit.rlim_max = used() + ((rlim_t)megabytes << 20);
        if (setrlimit(RLIMIT_AS, &limit) != 0) _exit(3);
        if (azulejo_context_create(threads, &context) != AZULEJO_OK) _exit(1);
        status = make(context);
        _exit(status == AZULEJO_OK ? 0 : status == AZULEJO_ERROR_TOO_LARGE ? 1 : 2);
    }
    CHECK(pid > 0 && waitpid(pid, &state, 0) == pid);
    return state;
}

static void grid(const char *name, call make) {
    static const unsigned megabytes[] = {12, 20, 28, 40, 56, 80, 112, 150, 210, 400};
    uint32_t threads;
    for (threads = 1; threads <= 2; threads++) {
        size_t i, succeeded = 0;
        for (i = 0; i < COUNT_OF(megabytes); i++) {
            const int state = child(make, threads, megabytes[i]);
            const int is_sound = WIFEXITED(state) && WEXITSTATUS(state) <= 1;
            if (!is_sound) fprintf(stderr, "%s, %u threads, %u MB: state %d\n", name, threads, megabytes[i], state);
            CHECK(is_sound);
            succeeded += is_sound && WEXITSTATUS(state) == 0;
        }
        if (succeeded == 0) fprintf(stderr, "%s, %u threads: never\n", name, threads);
        CHECK(succeeded > 0);
    }
}

int main(void) {
#ifdef __SANITIZE_ADDRESS__
    const int is_limited = 0; /* Shadow memory takes terabytes of address space. */
#else
    const int is_limited = getenv("AZULEJO_MEMORY_IS_WATCHED") == NULL; /* So does valgrind. */
#endif
    CHECK(used() > 0);
    random_points(cloud, COUNT_OF(cloud) / 2);
    if (is_limited) {
        grid("maximal", maximal);
        grid("tiled", tiled);
        grid("not tiled", not_tiled);
        grid("progressive", progressive);
        grid("counted", counted);
        grid("of a mesh", of_mesh);
        grid("varying", varying);
        grid("classes", classes);
        grid("relaxed", relaxed);
        grid("thinned", thinned);
    }
    return finish();
}
