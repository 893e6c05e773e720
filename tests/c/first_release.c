/* A program that was compiled with the header of the first release: its structs, frozen, each right before a page that
   must not be touched. It works with this library as it did with that one. */

#include <sys/mman.h>
#include <unistd.h>

#include "samples.h"

typedef struct {
    uint32_t struct_size;
    int32_t boundary;
    double radius, domain_min[2], domain_max[2], leaf_size;
    uint64_t seed;
    int32_t (*progress)(void *user, double done);
    void *progress_user;
} first_kdrt_options;

typedef struct {
    uint32_t struct_size;
    int32_t boundary;
    double radius, domain_min[2], domain_max[2];
    uint64_t seed;
    int32_t (*progress)(void *user, double done);
    void *progress_user;
} first_maximal_options;

typedef struct {
    uint32_t struct_size, iterations;
    double radius;
    uint64_t seed;
    int32_t maximal;
    uint32_t reserved;
    int32_t (*progress)(void *user, double done);
    void *progress_user;
} first_psp_options;

typedef struct {
    uint64_t samples, accepted, rays, hits, restart_conflicts, darts, conflicts;
    double seconds;
    uint32_t iterations, reserved[15];
} first_psp_report;

typedef struct {
    uint32_t struct_size;
    int32_t boundary;
    double domain_min[2], domain_max[2];
    int32_t neighbourhood;
    uint32_t max_iterations;
    uint64_t seed;
    double conflict_radius, attraction_radius, step, tolerance;
    uint32_t neighbours;
    int32_t distribution;
    int32_t (*progress)(void *user, double done);
    void *progress_user;
} first_dcr_options;

typedef struct {
    uint32_t iterations;
    int32_t converged;
    double motion, smallest_distance, rho;
    uint32_t reserved[8];
} first_dcr_report;

static azulejo_context *context;

/* Room for a struct of the first release, before memory in which a byte read or written ends the program. */
static void *at_the_edge(size_t size) {
    const size_t page = (size_t)sysconf(_SC_PAGESIZE);
    char *pages = mmap(NULL, 2 * page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (pages == MAP_FAILED || mprotect(pages + page, page, PROT_NONE) != 0) abort();
    return pages + page - size;
}

static int32_t go_on(void *user, double done) {
    *(double *)user = done;
    return 0;
}

static void planes(void) {
    first_kdrt_options *first = at_the_edge(sizeof *first);
    first_maximal_options *maximal = at_the_edge(sizeof *maximal);
    const azulejo_kdrt_options now = kdrt_options(0.05);
    azulejo_points *before = NULL, *after = NULL, *reference = NULL;
    double done = 0;
    ACCEPTED(azulejo_kdrt_options_init((void *)first, sizeof *first));
    CHECK(first->struct_size == sizeof *first && first->leaf_size == 20 && first->domain_max[1] == 1);
    first->radius = 0.05;
    first->seed = now.seed;
    first->progress = go_on;
    first->progress_user = &done;
    ACCEPTED(azulejo_kdrt_sample(context, (const void *)first, &before));
    ACCEPTED(azulejo_kdrt_sample(context, &now, &after));
    CHECK(done == 1 && same_points(before, after));

    ACCEPTED(azulejo_maximal_options_init((void *)maximal, sizeof *maximal));
    maximal->radius = 0.05;
    ACCEPTED(azulejo_maximal_sample(context, (const void *)maximal, &reference));
    CHECK(azulejo_points_count(reference) > 200);
    azulejo_points_free(before);
    azulejo_points_free(after);
    azulejo_points_free(reference);
}

static void surfaces(void) {
    first_psp_options *first = at_the_edge(sizeof *first);
    first_psp_report *report = at_the_edge(sizeof *report);
    const azulejo_psp_options now = psp_options(0.1);
    azulejo_mesh *cube = make_cube();
    azulejo_points *before = NULL, *after = NULL;
    ACCEPTED(azulejo_psp_options_init((void *)first, sizeof *first));
    CHECK(first->struct_size == sizeof *first && first->maximal == 1 && first->iterations > 0);
    first->radius = now.radius;
    first->iterations = now.iterations;
    first->seed = now.seed;
    first->maximal = now.maximal;
    ACCEPTED(azulejo_psp_sample(context, cube, (const void *)first, &before, (void *)report));
    ACCEPTED(azulejo_psp_sample(context, cube, &now, &after, NULL));
    CHECK(same_points(before, after) && report->samples == azulejo_points_count(after));
    CHECK(report->seconds > 0 && report->iterations == now.iterations);
    azulejo_points_free(before);
    azulejo_points_free(after);
    azulejo_mesh_free(cube);
}

static void relaxations(void) {
    first_dcr_options *first = at_the_edge(sizeof *first);
    first_dcr_report *report = at_the_edge(sizeof *report);
    const float xy[] = {0.1f, 0.1f, 0.11f, 0.1f, 0.7f, 0.6f};
    azulejo_points *points = NULL;
    ACCEPTED(azulejo_dcr_options_init((void *)first, sizeof *first));
    CHECK(first->struct_size == sizeof *first && first->domain_max[0] == 1 && first->max_iterations > 0);
    ACCEPTED(azulejo_dcr_relax(context, (const void *)first, xy, 3, &points, (void *)report));
    CHECK(azulejo_points_count(points) == 3 && report->iterations > 0 && report->rho > 0.2);
    azulejo_points_free(points);
}

int main(void) {
    ACCEPTED(azulejo_context_create(2, &context));
    planes();
    surfaces();
    relaxations();
    azulejo_context_free(context);
    return finish();
}
