/* What C alone can ask: exact counts and their reports, sets that grow by handles, the thesis's relaxation by its
   options. The bytes of sets are compared in sums.c; the promises that sets keep are tested in Rust. */

#include <math.h>

#include "samples.h"

static azulejo_context *context;

/* What the library measures of a set of the plane is what its report says; frees the set. */
static void check_plane(azulejo_points *points, const azulejo_kdrt_options *options, const azulejo_kdrt_report *report) {
    const size_t count = azulejo_points_count(points);
    const azulejo_plane_set set = plane_set(azulejo_points_positions(points), count, options->domain_min,
                                            options->domain_max, options->boundary);
    double smallest = 0, covering = 0;
    CHECK(azulejo_points_positions(points) != NULL && azulejo_points_dimension(points) == 2);
    CHECK(azulejo_points_normals(points) == NULL && azulejo_points_triangles(points) == NULL);
    CHECK(azulejo_points_barycentrics(points) == NULL);
    ACCEPTED(azulejo_plane_smallest_distance(context, &set, &smallest));
    CHECK(count < 2 ? isinf(smallest) : smallest >= report->radius);
    ACCEPTED(azulejo_plane_covering_radius(context, &set, &covering));
    CHECK(report->covering_radius == covering && covering > 0 && covering <= report->radius * (1 + 1e-6));
    azulejo_points_free(points);
}

/* Exactly as many as asked for, with the radius, the coverage and the maximality that the report says. */
static void counts(void) {
    const uint64_t numbers[] = {1, 2, 3, 7, 50, 299, 1000, 3001};
    const uint32_t boundaries[] = {AZULEJO_BOUNDARY_PERIODIC, AZULEJO_BOUNDARY_BOUNDED};
    size_t i, j;
    for (i = 0; i < COUNT_OF(numbers); i++)
        for (j = 0; j < 2; j++) {
            azulejo_kdrt_options options = kdrt_options(0);
            azulejo_kdrt_report report = kdrt_report();
            azulejo_points *points = NULL, *without_report = NULL;
            options.count = numbers[i];
            options.boundary = boundaries[j];
            options.domain_min[0] = -0.25;
            options.domain_max[1] = 0.7;
            options.measure_covering_radius = 1;
            UNWRITTEN(report);
            if (!ACCEPTED(azulejo_kdrt_sample(context, &options, &points, &report))) continue;
            CHECK(azulejo_points_count(points) == numbers[i] && report.samples == numbers[i]);
            CHECK(report.is_maximal == 1 && report.seconds >= 0 && report.seconds < 100);
            options.measure_covering_radius = 0;
            ACCEPTED(azulejo_kdrt_sample(context, &options, &without_report, NULL));
            CHECK(same_points(points, without_report));
            azulejo_points_free(without_report);
            check_plane(points, &options, &report);
        }
}

/* A report can be had for a radius too; its coverage is measured only where that is asked for. */
static void report_of_a_radius(void) {
    azulejo_kdrt_options options = kdrt_options(0.05);
    azulejo_kdrt_report report = kdrt_report();
    azulejo_points *points = NULL, *same = NULL;
    options.measure_covering_radius = 1;
    ACCEPTED(azulejo_kdrt_sample(context, &options, &points, &report));
    options.measure_covering_radius = 0;
    ACCEPTED(azulejo_kdrt_sample(context, &options, &same, NULL));
    CHECK(same_points(points, same));
    CHECK(report.samples == azulejo_points_count(points) && report.radius == 0.05 && report.is_maximal == 1);
    CHECK(report.covering_radius > 0.04 && report.covering_radius <= 0.05 * (1 + 1e-6));
    azulejo_points_free(same);
    ACCEPTED(azulejo_kdrt_sample(context, &options, &same, &report));
    CHECK(same_points(points, same));
    CHECK(report.samples == azulejo_points_count(points) && report.radius == 0.05 && report.covering_radius == -1);
    azulejo_points_free(points);
    azulejo_points_free(same);
}

/* A handle grows, keeps what it needs of what is freed before it, and its points outlive it. */
static void growing_sets(void) {
    azulejo_context *own = make_context(2);
    azulejo_mesh *cube = make_cube();
    azulejo_psp_options options = psp_options(0.1);
    azulejo_psp *set = NULL;
    azulejo_points *empty = NULL, *first = NULL, *second = NULL;
    azulejo_psp_report report = psp_report();
    size_t one, two;

    ACCEPTED(azulejo_psp_create(own, cube, &options, &set));
    azulejo_context_free(own);
    azulejo_mesh_free(cube);

    ACCEPTED(azulejo_psp_points(set, &empty));
    CHECK(azulejo_points_count(empty) == 0 && azulejo_points_positions(empty) == NULL);
    CHECK(azulejo_points_dimension(empty) == 3 && azulejo_points_normals(empty) == NULL);
    ACCEPTED(azulejo_psp_advance(set, 0, &report));
    CHECK(report.samples == 0 && report.accepted == 0 && report.iterations == 0);
    CHECK(report.rho == 0 && report.uncovered_before == -1 && report.uncovered_after == -1);
    ACCEPTED(azulejo_psp_advance(set, 1, &report));
    CHECK(report.rho > 0.6 && report.fill_seconds == 0 && report.uncovered_before == -1);
    ACCEPTED(azulejo_psp_points(set, &first));
    CHECK(report.samples == azulejo_points_count(first) && report.samples == report.accepted);
    ACCEPTED(azulejo_psp_fill(set, &report));
    CHECK(report.uncovered_before > 0 && report.uncovered_after == 0 && report.project_seconds == 0);
    ACCEPTED(azulejo_psp_points(set, &second));
    azulejo_psp_free(set);

    one = azulejo_points_count(first);
    two = azulejo_points_count(second);
    CHECK(0 < one && one < two && report.samples == two && report.accepted == two - one);
    CHECK(one > 0 && memcmp(azulejo_points_positions(first), azulejo_points_positions(second), 12 * one) == 0);
    azulejo_points_free(empty);
    azulejo_points_free(first);
    azulejo_points_free(second);
}

/* What the thesis's algorithm can be varied by reaches the core. */
static void thesis_relaxations(void) {
    enum { COUNT = 1000 };
    static float xy[2 * COUNT];
    azulejo_dcr_options plain = dcr_options(400), options;
    azulejo_points *points = NULL, *varied = NULL;
    azulejo_dcr_report report = dcr_report();

    random_points(xy, COUNT);
    plain.method = AZULEJO_METHOD_THESIS;
    plain.tolerance = 0;
    CHECK(plain.visits == AZULEJO_VISITS_BOTH_ENDS && plain.convergence == AZULEJO_CONVERGENCE_MOTION && plain.decay == 1);
    options = plain;
    options.max_iterations = 2;
    options.distribution = AZULEJO_DISTRIBUTION_ZERO;
    ACCEPTED(azulejo_dcr_relax(context, &options, xy, COUNT, &points, NULL));
    options.distribution = AZULEJO_DISTRIBUTION_DOMINANT;
    options.visits = AZULEJO_VISITS_ONE_END;
    ACCEPTED(azulejo_dcr_relax(context, &options, xy, COUNT, &varied, NULL));
    CHECK(!same_points(points, varied));
    azulejo_points_free(varied);
    options.visits = AZULEJO_VISITS_BOTH_ENDS;
    options.decay = 0.5;
    ACCEPTED(azulejo_dcr_relax(context, &options, xy, COUNT, &varied, NULL));
    CHECK(!same_points(points, varied));
    azulejo_points_free(varied);
    azulejo_points_free(points);

    options = plain;
    ACCEPTED(azulejo_dcr_relax(context, &options, xy, COUNT, &points, &report));
    CHECK(report.stopped == AZULEJO_STOPPED_STEPS && report.iterations == 400);
    azulejo_points_free(points);
    options.convergence = AZULEJO_CONVERGENCE_VARIANCE;
    options.step = 0.0125;
    ACCEPTED(azulejo_dcr_relax(context, &options, xy, COUNT, &points, &report));
    CHECK(report.stopped == AZULEJO_STOPPED_CONVERGED && report.iterations > 10);
    azulejo_points_free(points);
}

int main(void) {
    CHECK(azulejo_version() == AZULEJO_VERSION);
    context = make_context(2);
    counts();
    report_of_a_radius();
    growing_sets();
    thesis_relaxations();
    azulejo_context_free(context);
    return finish();
}
