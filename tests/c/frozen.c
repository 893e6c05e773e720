/* A program that was compiled with the structs of 0.2, by the names of 0.3: its structs, frozen, each right before a page that must not be
   touched. It works with this library as it did with that one; structs have grown at their end at most. */

#include <stddef.h>
#include <sys/mman.h>
#include <unistd.h>

#include "samples.h"

typedef uint32_t (*frozen_progress)(void *user, double done);

typedef struct {
    uint32_t struct_size;
    uint32_t boundary;
    const float *positions;
    size_t count;
    double domain_min[2], domain_max[2];
} frozen_plane_set;

typedef struct {
    uint32_t struct_size;
    uint32_t boundary;
    double radius, domain_min[2], domain_max[2], leaf_size;
    uint64_t seed;
    frozen_progress progress;
    void *progress_user;
    size_t count;
    uint32_t measure_covering_radius, reserved;
} frozen_kdrt_options;

typedef struct {
    uint32_t struct_size, is_maximal;
    uint64_t samples;
    double radius, covering_radius, seconds;
} frozen_kdrt_report;

typedef struct {
    uint32_t struct_size;
    uint32_t boundary;
    double radius, domain_min[2], domain_max[2];
    uint64_t seed;
    frozen_progress progress;
    void *progress_user;
} frozen_maximal_options;

typedef frozen_maximal_options frozen_kdrt_merge_options;

typedef struct {
    uint32_t struct_size, reserved;
    uint64_t kept, eliminated, inserted;
} frozen_kdrt_merge_report;

typedef struct {
    uint32_t struct_size, iterations;
    double radius;
    uint64_t seed;
    uint32_t maximal;
    uint32_t priority, engine;
    uint32_t reserved;
    frozen_progress progress;
    void *progress_user;
} frozen_psp_options;

typedef struct {
    uint32_t struct_size, iterations;
    uint64_t samples, accepted, rays, hits, restart_conflicts, darts, conflicts;
    double seconds, prepare_seconds, project_seconds, merge_seconds, fill_seconds, rho, uncovered_before, uncovered_after;
} frozen_psp_report;

typedef struct {
    uint32_t struct_size, reserved;
    const float *vertex_radii;
    size_t vertex_count;
    double (*radius_function)(void *user, const double *position);
    void *radius_function_user;
    double smallest, largest, slope, cosine;
    uint64_t seed;
    frozen_progress progress;
    void *progress_user;
} frozen_psp_adaptive_options;

typedef struct {
    uint32_t struct_size;
    uint32_t boundary;
    double domain_min[2], domain_max[2];
    uint32_t neighbourhood, method;
    uint32_t max_iterations, reserved;
    uint64_t seed;
    double tolerance;
    frozen_progress progress;
    void *progress_user;
    double conflict_radius, attraction_radius, step, decay;
    uint32_t neighbours;
    uint32_t distribution, visits, convergence;
} frozen_dcr_options;

typedef struct {
    uint32_t struct_size, iterations;
    uint32_t stopped;
    uint32_t reserved;
    double motion, smallest_distance, rho, relative_covering_radius;
} frozen_dcr_report;

typedef struct {
    uint32_t struct_size, reserved;
    const float *values;
    size_t width, height;
    double (*function)(void *user, const double *position);
    void *function_user;
} frozen_density;

typedef struct {
    uint32_t struct_size, max_iterations;
    double tolerance;
    uint64_t seed;
    frozen_progress progress;
    void *progress_user;
} frozen_dcr_surface_options;

typedef struct {
    uint32_t struct_size, iterations;
    uint32_t stopped;
    uint32_t reserved;
    double motion, smallest_distance, rho;
} frozen_dcr_surface_report;

typedef struct {
    uint32_t struct_size, reserved;
    double covering_radius;
    uint64_t gaps;
} frozen_coverage_report;

typedef struct {
    uint32_t struct_size, reserved;
    uint64_t count;
    double smallest_distance, mean_distance, hexagonal_distance, rho, covering_radius, bond_order;
    uint64_t triangles;
    double obtuse, below_30_degrees, edge_mean, edge_variation, area_variation, angles_below_30_degrees, beyond_4_sigma;
} frozen_plane_report;

typedef struct {
    uint32_t struct_size, reserved;
    double frequency_step[2], effective_nyquist, oscillation, contrast, peak, peak_frequency[2];
} frozen_spectrum_report;

/* A frozen struct has its size of then, and its last field is where it was: abi.c has all of them. */
#define FROZEN(name, size, last)                                                                          \
    _Static_assert(sizeof(frozen_##name) == (size) && sizeof(azulejo_##name) >= (size), #name);           \
    _Static_assert(offsetof(frozen_##name, last) == offsetof(azulejo_##name, last), #name "." #last)
FROZEN(plane_set, 56, domain_max);
FROZEN(kdrt_options, 96, measure_covering_radius); /* order has taken the place of reserved */
FROZEN(kdrt_report, 40, seconds);
FROZEN(maximal_options, 72, progress_user);
FROZEN(kdrt_merge_options, 72, progress_user);
FROZEN(kdrt_merge_report, 32, inserted);
FROZEN(psp_options, 56, progress_user);
FROZEN(psp_report, 128, uncovered_after);
FROZEN(psp_adaptive_options, 96, progress_user); /* order has taken the place of reserved */
FROZEN(dcr_options, 136, convergence);
FROZEN(dcr_report, 48, relative_covering_radius);
FROZEN(density, 48, function_user);
FROZEN(dcr_surface_options, 40, progress_user);
FROZEN(dcr_surface_report, 40, rho);
FROZEN(coverage_report, 24, gaps);
FROZEN(plane_report, 128, beyond_4_sigma);
FROZEN(spectrum_report, 72, peak_frequency);

static azulejo_context *context;
static azulejo_mesh *cube;

/* Memory for a frozen struct, before a page in which a byte read or written ends the program. */
static void *at_the_edge(size_t size) {
    const size_t page = (size_t)sysconf(_SC_PAGESIZE);
    char *pages = mmap(NULL, 2 * page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (pages == MAP_FAILED || mprotect(pages + page, page, PROT_NONE) != 0) abort();
    return memset(pages + page - size, 0x55, size);
}

/* A frozen struct at the edge, filled by its init function. */
#define MAKE(type, name)                                                       \
    frozen_##type *name = at_the_edge(sizeof *name);                           \
    ACCEPTED(azulejo_##type##_init((void *)name, sizeof *name));               \
    CHECK(name->struct_size == sizeof *name)

static uint32_t go_on(void *user, double done) {
    *(double *)user = done;
    return 0;
}

static void planes(void) {
    const azulejo_kdrt_options now = kdrt_options(0.05);
    azulejo_points *before = NULL, *after = NULL, *reference = NULL, *merged = NULL, *window = NULL;
    azulejo_kdrt *plane = NULL;
    double done = 0;
    MAKE(kdrt_options, options);
    MAKE(kdrt_report, report);
    MAKE(maximal_options, maximal);
    MAKE(kdrt_merge_options, merge);
    MAKE(kdrt_merge_report, merging);
    CHECK(options->leaf_size == 20 && options->domain_max[1] == 1 && options->count == 0);
    options->radius = now.radius;
    options->seed = now.seed;
    options->progress = go_on;
    options->progress_user = &done;
    options->measure_covering_radius = 1;
    ACCEPTED(azulejo_kdrt_sample(context, (void *)options, &before, (void *)report));
    ACCEPTED(azulejo_kdrt_sample(context, &now, &after, NULL));
    CHECK(done == 1 && same_points(before, after));
    CHECK(report->struct_size == sizeof *report && report->samples == azulejo_points_count(after));
    CHECK(report->is_maximal == 1 && report->radius == 0.05 && report->seconds > 0);
    CHECK(report->covering_radius > 0.04 && report->covering_radius < 0.0500001);

    done = 0;
    options->measure_covering_radius = 0;
    ACCEPTED(azulejo_kdrt_create(context, (void *)options, &plane));
    ACCEPTED(azulejo_kdrt_window(plane, options->domain_min, options->domain_max, &window));
    CHECK(done == 1 && same_points(window, after));

    maximal->radius = merge->radius = 0.05;
    ACCEPTED(azulejo_maximal_sample(context, (void *)maximal, &reference, NULL));
    CHECK(azulejo_points_count(reference) > 200);
    ACCEPTED(azulejo_kdrt_merge(context, (void *)merge, NULL, 0, sizeof(azulejo_kdrt_merge_piece), NULL, 0, &merged, (void *)merging));
    CHECK(merging->inserted == azulejo_points_count(merged) && merging->kept == 0 && merging->reserved == 0);
    azulejo_points_free(before);
    azulejo_points_free(after);
    azulejo_points_free(reference);
    azulejo_points_free(merged);
    azulejo_points_free(window);
    azulejo_kdrt_free(plane);
}

static void surfaces(void) {
    const azulejo_psp_options now = psp_options(0.1);
    const float radii[8] = {0.2f, 0.2f, 0.2f, 0.2f, 0.2f, 0.2f, 0.2f, 0.2f};
    azulejo_points *before = NULL, *after = NULL, *adaptive = NULL, *relaxed = NULL;
    MAKE(psp_options, options);
    MAKE(psp_report, report);
    MAKE(psp_adaptive_options, varying);
    MAKE(psp_report, varied);
    MAKE(dcr_surface_options, relaxation);
    MAKE(dcr_surface_report, done);
    MAKE(coverage_report, coverage);
    CHECK(options->maximal == 1 && options->iterations == AZULEJO_ITERATIONS_DEFAULT && varying->cosine == -1);
    options->radius = now.radius;
    options->seed = now.seed;
    ACCEPTED(azulejo_psp_sample(context, cube, (void *)options, &before, (void *)report));
    ACCEPTED(azulejo_psp_sample(context, cube, &now, &after, NULL));
    CHECK(same_points(before, after) && report->samples == azulejo_points_count(after));
    CHECK(report->seconds > 0 && report->iterations == 0 && report->uncovered_after == 0);

    varying->vertex_radii = radii;
    varying->vertex_count = 8;
    ACCEPTED(azulejo_psp_adaptive_sample(context, cube, (void *)varying, &adaptive, (void *)varied));
    CHECK(varied->samples == azulejo_points_count(adaptive) && varied->samples > 50);

    ACCEPTED(azulejo_dcr_surface_relax(context, cube, (void *)relaxation, azulejo_points_triangles(after),
                                       azulejo_points_barycentrics(after), azulejo_points_count(after), &relaxed,
                                       (void *)done));
    CHECK(done->iterations > 0 && done->rho > 0.7 && done->reserved == 0);
    ACCEPTED(azulejo_mesh_coverage(context, cube, azulejo_points_positions(after), azulejo_points_count(after), 0.100001,
                                   (void *)coverage));
    CHECK(coverage->gaps == 0 && coverage->covering_radius > 0.09 && coverage->reserved == 0);
    azulejo_points_free(before);
    azulejo_points_free(after);
    azulejo_points_free(adaptive);
    azulejo_points_free(relaxed);
}

static void relaxations(void) {
    const float xy[] = {0.1f, 0.1f, 0.11f, 0.1f, 0.7f, 0.6f}, white = 1;
    azulejo_points *points = NULL, *scattered = NULL;
    MAKE(dcr_options, options);
    MAKE(dcr_report, report);
    MAKE(density, density);
    CHECK(options->domain_max[0] == 1 && options->max_iterations > 0 && options->step == 0.05);
    ACCEPTED(azulejo_dcr_relax(context, (void *)options, xy, 3, &points, (void *)report));
    CHECK(azulejo_points_count(points) == 3 && report->iterations > 0 && report->rho > 0.2 && report->reserved == 0);
    density->values = &white;
    density->width = density->height = 1;
    ACCEPTED(azulejo_dcr_scatter(context, (void *)options, (void *)density, 10, &scattered));
    CHECK(azulejo_points_count(scattered) == 10);
    azulejo_points_free(points);
    azulejo_points_free(scattered);
}

static void measures(void) {
    const float xy[] = {0.1f, 0.1f, 0.1f, 0.6f, 0.6f, 0.1f, 0.6f, 0.6f};
    azulejo_spectrum *spectrum = NULL;
    double distance = 0;
    MAKE(plane_set, set);
    MAKE(plane_report, figures);
    MAKE(coverage_report, coverage);
    MAKE(spectrum_report, spectral);
    CHECK(set->positions == NULL && set->count == 0 && set->domain_max[0] == 1 && set->boundary == 0);
    set->positions = xy;
    set->count = 4;
    ACCEPTED(azulejo_plane_smallest_distance(context, (void *)set, &distance));
    CHECK(distance > 0.4999999 && distance < 0.5000001);
    ACCEPTED(azulejo_plane_measure(context, (void *)set, (void *)figures));
    CHECK(figures->count == 4 && figures->smallest_distance == distance && figures->triangles == 8);
    ACCEPTED(azulejo_plane_coverage(context, (void *)set, 0.3, (void *)coverage));
    CHECK(coverage->gaps == 4 && coverage->covering_radius == figures->covering_radius);
    ACCEPTED(azulejo_spectrum_create(context, (void *)set, 16, 1, &spectrum));
    ACCEPTED(azulejo_spectrum_measure(spectrum, 0.5, 0, 3, (void *)spectral));
    CHECK(spectral->frequency_step[0] == 0.5 && spectral->peak > 0 && spectral->reserved == 0);
    azulejo_spectrum_free(spectrum);
}

int main(void) {
    context = make_context(2);
    cube = make_cube();
    planes();
    surfaces();
    relaxations();
    measures();
    azulejo_mesh_free(cube);
    azulejo_context_free(context);
    return finish();
}
