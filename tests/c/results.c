/* What good calls give: the guarantees, checked naively; boundaries, empty sets, radii larger than the domain; free in any
   order; the library's own analysis against loops over all pairs. */

#include <math.h>

#include "naive.h"
#include "samples.h"

static azulejo_context *context;

/* The squared distance of two points of a domain in double arithmetic. */
static double squared_distance(const float *a, const float *b, int dimension, const double *period) {
    double sum = 0;
    int axis;
    for (axis = 0; axis < dimension; axis++) {
        double d = fabs((double)a[axis] - (double)b[axis]);
        if (period && d > period[axis] / 2) d = period[axis] - d;
        sum += d * d;
    }
    return sum;
}

static double smallest_distance(const float *points, size_t count, int dimension, const double *period) {
    double smallest = INFINITY;
    size_t i, j;
    for (i = 0; i < count; i++)
        for (j = 0; j < i; j++) {
            const double d = squared_distance(points + dimension * i, points + dimension * j, dimension, period);
            if (d < smallest) smallest = d;
        }
    return sqrt(smallest);
}

/* Whether every point of a raster over the domain has a sample within the radius. */
static int covers(const float *xy, size_t count, double radius, const double *low, const double *high,
                  const double *period) {
    int row, column;
    for (row = 0; row < 100; row++)
        for (column = 0; column < 100; column++) {
            const float probe[2] = {(float)(low[0] + (high[0] - low[0]) * (column + 0.5) / 100),
                                    (float)(low[1] + (high[1] - low[1]) * (row + 0.5) / 100)};
            size_t i = 0;
            while (i < count && squared_distance(probe, xy + 2 * i, 2, period) > radius * radius * (1 + 1e-6)) i++;
            if (i == count) return 0;
        }
    return 1;
}

/* A set of the plane keeps all that it promises; frees it. */
static void check_plane(azulejo_points *points, double radius, const double *low, const double *high,
                        int32_t boundary) {
    const double period[2] = {high[0] - low[0], high[1] - low[1]};
    const double *wrap = boundary == AZULEJO_BOUNDARY_PERIODIC ? period : NULL;
    const float *xy = azulejo_points_positions(points);
    const size_t count = azulejo_points_count(points);
    double told = 0, covering = 0, smallest;
    size_t i, outside = 0;

    CHECK(count >= 1 && xy != NULL && azulejo_points_dimension(points) == 2);
    CHECK(azulejo_points_normals(points) == NULL && azulejo_points_triangles(points) == NULL);
    CHECK(azulejo_points_barycentrics(points) == NULL);
    for (i = 0; i < 2 * count; i++) outside += !(xy[i] >= low[i % 2] && xy[i] < high[i % 2]);
    CHECK(outside == 0);
    CHECK(covers(xy, count, radius, low, high, wrap));

    smallest = smallest_distance(xy, count, 2, wrap);
    CHECK(smallest >= radius);
    ACCEPTED(azulejo_plane_smallest_distance(context, PLANE(xy, count, low, high, boundary), &told));
    CHECK(count < 2 ? isinf(told) : fabs(told - smallest) <= 1e-12 * smallest);
    ACCEPTED(azulejo_plane_covering_radius(context, PLANE(xy, count, low, high, boundary), &covering));
    CHECK(covering <= radius * (1 + 1e-6));
    CHECK(covering > 0 && (smallest > 10 || covering > smallest / 2)); /* the middle between two samples */
    azulejo_points_free(points);
}

static void planes(void) {
    const double radii[] = {0.05, 0.3, 0.9, 1.5, 100};
    const int32_t boundaries[] = {AZULEJO_BOUNDARY_PERIODIC, AZULEJO_BOUNDARY_BOUNDED};
    size_t i, j;
    for (i = 0; i < COUNT_OF(radii); i++)
        for (j = 0; j < 2; j++) {
            azulejo_kdrt_options kdrt = kdrt_options(radii[i]);
            azulejo_maximal_options maximal = maximal_options(radii[i]);
            azulejo_points *points = NULL;
            kdrt.boundary = maximal.boundary = boundaries[j];
            kdrt.domain_min[0] = maximal.domain_min[0] = -0.25;
            kdrt.domain_max[1] = maximal.domain_max[1] = 0.7;
            if (ACCEPTED(azulejo_kdrt_sample(context, &kdrt, &points, NULL)))
                check_plane(points, radii[i], kdrt.domain_min, kdrt.domain_max, boundaries[j]);
            if (ACCEPTED(azulejo_maximal_sample(context, &maximal, &points)))
                check_plane(points, radii[i], maximal.domain_min, maximal.domain_max, boundaries[j]);
        }
}

/* Exactly as many as asked for, with the radius, the coverage and the maximality that the report says. */
static void counts(void) {
    const uint64_t numbers[] = {1, 2, 3, 7, 50, 299, 1000, 3001};
    const int32_t boundaries[] = {AZULEJO_BOUNDARY_PERIODIC, AZULEJO_BOUNDARY_BOUNDED};
    size_t i, j;
    for (i = 0; i < COUNT_OF(numbers); i++)
        for (j = 0; j < 2; j++) {
            azulejo_kdrt_options options = kdrt_options(0);
            azulejo_kdrt_report report = kdrt_report();
            azulejo_points *points = NULL, *without_report = NULL;
            double covering = 0;
            options.count = numbers[i];
            options.boundary = boundaries[j];
            options.domain_min[0] = -0.25;
            options.domain_max[1] = 0.7;
            options.measure_coverage = 1;
            UNWRITTEN(report);
            if (!ACCEPTED(azulejo_kdrt_sample(context, &options, &points, &report))) continue;
            CHECK(azulejo_points_count(points) == numbers[i] && report.samples == numbers[i]);
            CHECK(report.is_maximal == 1 && report.seconds >= 0 && report.seconds < 100);
            ACCEPTED(azulejo_plane_covering_radius(context,
                                                   PLANE(azulejo_points_positions(points), numbers[i],
                                                         options.domain_min, options.domain_max, boundaries[j]),
                                                   &covering));
            CHECK(report.coverage == covering);
            options.measure_coverage = 0;
            ACCEPTED(azulejo_kdrt_sample(context, &options, &without_report, NULL));
            CHECK(same_points(points, without_report));
            azulejo_points_free(without_report);
            check_plane(points, report.radius, options.domain_min, options.domain_max, boundaries[j]);
        }
}

/* A report can be had for a radius too; its coverage is measured only where that is asked for. */
static void report_of_a_radius(void) {
    azulejo_kdrt_options options = kdrt_options(0.05);
    azulejo_kdrt_report report = kdrt_report();
    azulejo_points *points = NULL, *same = NULL;
    options.measure_coverage = 1;
    ACCEPTED(azulejo_kdrt_sample(context, &options, &points, &report));
    options.measure_coverage = 0;
    ACCEPTED(azulejo_kdrt_sample(context, &options, &same, NULL));
    CHECK(same_points(points, same));
    CHECK(report.samples == azulejo_points_count(points) && report.radius == 0.05 && report.is_maximal == 1);
    CHECK(report.coverage > 0.04 && report.coverage <= 0.05 * (1 + 1e-6));
    azulejo_points_free(same);
    ACCEPTED(azulejo_kdrt_sample(context, &options, &same, &report));
    CHECK(same_points(points, same));
    CHECK(report.samples == azulejo_points_count(points) && report.radius == 0.05 && report.coverage == -1);
    azulejo_points_free(points);
    azulejo_points_free(same);
}

/* Samples lie where their barycentrics say, with the normal of their triangle. */
static void check_surface(const azulejo_points *points, const azulejo_mesh *mesh) {
    const float *vertices = azulejo_mesh_positions(mesh), *positions = azulejo_points_positions(points);
    const float *normals = azulejo_points_normals(points), *barycentrics = azulejo_points_barycentrics(points);
    const uint32_t *indices = azulejo_mesh_indices(mesh), *triangles = azulejo_points_triangles(points);
    size_t i, wrong = 0;
    int axis;
    for (i = 0; i < azulejo_points_count(points); i++) {
        const uint32_t *triangle = indices + 3 * (size_t)triangles[i];
        const float *a = vertices + 3 * triangle[0], *b = vertices + 3 * triangle[1], *c = vertices + 3 * triangle[2];
        const double u = barycentrics[2 * i], v = barycentrics[2 * i + 1];
        const float *n = normals + 3 * i;
        wrong += triangles[i] >= azulejo_mesh_triangle_count(mesh) || u < 0 || v < 0 || u + v > 1 + 1e-6;
        wrong += fabs(n[0] * n[0] + n[1] * n[1] + n[2] * n[2] - 1) > 1e-5;
        for (axis = 0; axis < 3; axis++) {
            const double expected = (1 - u - v) * a[axis] + u * b[axis] + v * c[axis];
            const int next = (axis + 1) % 3, last = (axis + 2) % 3;
            const double cross = (double)(b[next] - a[next]) * (c[last] - a[last]) -
                                 (double)(b[last] - a[last]) * (c[next] - a[next]);
            wrong += fabs(positions[3 * i + axis] - expected) > 1e-6;
            wrong += cross * n[axis] < 0; /* the cube's triangles look along the axes */
        }
    }
    CHECK(wrong == 0);
}

static void surface_measures(const azulejo_mesh *cube, const azulejo_points *points, double radius) {
    const float *positions = azulejo_points_positions(points);
    const size_t count = azulejo_points_count(points);
    const double smallest = smallest_distance(positions, count, 3, NULL);
    double told = 0, uncovered = 1;
    CHECK(smallest >= radius);
    ACCEPTED(azulejo_space_smallest_distance(context, positions, count, &told));
    CHECK(fabs(told - smallest) <= 1e-12 * smallest);
    CHECK(naive_gaps_of_cube(positions, count, radius + 1e-6) == 0);
    CHECK(naive_gaps_of_cube(positions, count - 1, radius - 1e-6) > 0);
    ACCEPTED(azulejo_mesh_uncovered_fraction(context, cube, positions, count, radius, 50000, 1, &uncovered));
    CHECK(uncovered == 0);
    /* One sample covers a disk of pi / 100 of the cube's area of 6, or less at an edge. */
    ACCEPTED(azulejo_mesh_uncovered_fraction(context, cube, positions, 1, radius, 50000, 1, &uncovered));
    CHECK(uncovered > 1 - 0.0070 && uncovered < 1 - 0.0030);
    ACCEPTED(azulejo_mesh_uncovered_fraction(context, cube, NULL, 0, radius, 10, 1, &uncovered));
    CHECK(uncovered == 1);
}

/* The same mesh from another layout gives the same points. */
static void strided_surface(const azulejo_points *points, const azulejo_psp_options *options) {
    azulejo_mesh *strided = NULL;
    azulejo_points *same = NULL;
    float wide[8][5];
    size_t i;
    for (i = 0; i < 8; i++) {
        memcpy(wide[i], cube_positions[i], 12);
        wide[i][3] = wide[i][4] = NAN; /* is not read */
    }
    ACCEPTED(azulejo_mesh_create(wide[0], 8, sizeof *wide, &cube_indices[0][0], 12, &strided));
    ACCEPTED(azulejo_psp_sample(context, strided, options, &same, NULL));
    CHECK(same_points(points, same));
    azulejo_points_free(same);
    azulejo_mesh_free(strided);
}

/* Each option that chooses another method gives another set. */
static void surface_options(const azulejo_mesh *cube, const azulejo_points *points, azulejo_psp_options options) {
    azulejo_psp_options other = options;
    azulejo_points *set = NULL, *filled = NULL;
    azulejo_psp_report report = psp_report();

    other.iterations = AZULEJO_ITERATIONS_DEFAULT; /* the same as 0 */
    ACCEPTED(azulejo_psp_sample(context, cube, &other, &filled, NULL));
    other.iterations = 0;
    ACCEPTED(azulejo_psp_sample(context, cube, &other, &set, &report));
    CHECK(report.iterations == 0 && report.rays == 0);
    CHECK(same_points(filled, set) && !same_points(points, set));
    azulejo_points_free(set);
    azulejo_points_free(filled);

    other = options;
    other.priority = AZULEJO_PRIORITY_PROJECTOR;
    ACCEPTED(azulejo_psp_sample(context, cube, &other, &set, NULL));
    CHECK(!same_points(points, set));
    azulejo_points_free(set);

    other = options;
    other.engine = AZULEJO_ENGINE_RASTERISER;
    ACCEPTED(azulejo_psp_sample(context, cube, &other, &set, &report));
    check_surface(set, cube);
    CHECK(report.iterations > 0 && report.rays > 0 && report.hits > 0);
    CHECK(same_points(points, set) == !azulejo_has_embree()); /* without Embree it is the default */
    azulejo_points_free(set);

    other = options;
    other.radius = 1000; /* larger than the mesh: one sample is enough, and not more fit */
    ACCEPTED(azulejo_psp_sample(context, cube, &other, &set, NULL));
    CHECK(azulejo_points_count(set) == 1);
    azulejo_points_free(set);
}

static void surfaces(void) {
    azulejo_mesh *cube = make_cube();
    azulejo_psp_options options = psp_options(0.1);
    azulejo_points *points = NULL;
    azulejo_psp_report report = psp_report();
    size_t count;

    CHECK(azulejo_mesh_area(cube) == 6);
    CHECK(azulejo_mesh_vertex_count(cube) == 8 && azulejo_mesh_triangle_count(cube) == 12);
    CHECK(memcmp(azulejo_mesh_positions(cube), cube_positions, sizeof cube_positions) == 0);
    CHECK(memcmp(azulejo_mesh_indices(cube), cube_indices, sizeof cube_indices) == 0);

    options.iterations = 1;
    UNWRITTEN(report);
    ACCEPTED(azulejo_psp_sample(context, cube, &options, &points, &report));
    count = azulejo_points_count(points);
    CHECK(azulejo_points_dimension(points) == 3);
    CHECK(count > 300 && count < 600); /* 0.69656 * 6 / 0.1^2 = 418 */
    CHECK(report.samples == count && report.accepted == count && report.seconds >= 0 && report.rays > 0);
    CHECK(report.prepare_seconds > 0 && report.project_seconds > 0 && report.merge_seconds > 0 && report.fill_seconds > 0);
    CHECK(report.prepare_seconds + report.project_seconds + report.merge_seconds + report.fill_seconds <= report.seconds);
    CHECK(fabs(report.rho - options.radius / sqrt(2 * 6 / (sqrt(3) * (double)count))) < 1e-12);
    CHECK(report.uncovered_before > 0 && report.uncovered_before < 0.5 && report.uncovered_after == 0);
    check_surface(points, cube);

    surface_measures(cube, points, options.radius);
    strided_surface(points, &options);
    surface_options(cube, points, options);
    azulejo_points_free(points);
    azulejo_mesh_free(cube);
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

static void relaxations(void) {
    enum { COUNT = 300 };
    static float xy[2 * COUNT], same_place[6];
    const double period[2] = {1, 1};
    const int32_t neighbourhoods[] = {AZULEJO_NEIGHBOURHOOD_DELAUNAY, AZULEJO_NEIGHBOURHOOD_NEAREST};
    azulejo_dcr_options options = dcr_options(300);
    azulejo_points *points = NULL;
    azulejo_dcr_report report = dcr_report();
    size_t i, j;

    random_points(xy, COUNT);
    for (j = 0; j < 8; j++) {
        double smallest;
        options.method = j < 4 ? AZULEJO_METHOD_MOMENTUM : AZULEJO_METHOD_THESIS;
        options.neighbourhood = neighbourhoods[j / 2 % 2];
        options.boundary = j % 2 ? AZULEJO_BOUNDARY_BOUNDED : AZULEJO_BOUNDARY_PERIODIC;
        UNWRITTEN(report);
        if (!ACCEPTED(azulejo_dcr_relax(context, &options, xy, COUNT, &points, &report))) continue;
        CHECK(azulejo_points_count(points) == COUNT && azulejo_points_dimension(points) == 2);
        smallest = smallest_distance(azulejo_points_positions(points), COUNT, 2, j % 2 ? NULL : period);
        CHECK(fabs(smallest - report.smallest_distance) <= 1e-12);
        CHECK(fabs(report.rho * sqrt(2 / (sqrt(3) * COUNT)) - smallest) <= 1e-9);
        CHECK(report.rho > (j < 4 ? 0.8 : 0.4) && report.rho <= 1);
        CHECK(report.coverage > 0.577 && report.coverage < 1.5);
        CHECK(report.iterations > 0 && report.iterations <= 300);
        CHECK(report.stopped == AZULEJO_STOPPED_CONVERGED ||
              (report.stopped == AZULEJO_STOPPED_STEPS && report.iterations == 300));
        CHECK(report.reserved == 0);
        for (i = 0; i < 2 * COUNT; i++)
            if (!(azulejo_points_positions(points)[i] >= 0 && azulejo_points_positions(points)[i] < 1)) break;
        CHECK(i == 2 * COUNT);
        azulejo_points_free(points);
    }

    options.max_iterations = 0;
    ACCEPTED(azulejo_dcr_relax(context, &options, xy, COUNT, &points, NULL));
    CHECK(memcmp(azulejo_points_positions(points), xy, sizeof xy) == 0);
    azulejo_points_free(points);

    options.max_iterations = 50;
    options.method = AZULEJO_METHOD_MOMENTUM;
    for (j = 0; j <= 3; j++) { /* no point at all, and few points at one place */
        ACCEPTED(azulejo_dcr_relax(context, &options, j ? same_place : NULL, j, &points, &report));
        CHECK(azulejo_points_count(points) == j);
        CHECK(j < 2 ? isinf(report.smallest_distance) : report.smallest_distance > 0);
        azulejo_points_free(points);
    }
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
    planes();
    counts();
    report_of_a_radius();
    surfaces();
    growing_sets();
    relaxations();
    thesis_relaxations();
    azulejo_context_free(context);
    return finish();
}
