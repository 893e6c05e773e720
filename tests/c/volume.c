/* Volumes: a box filled from C, its samples in pairs and against random places; the same for any number of threads; each bad
   input is refused with a message that names it, leaving the output alone. */

#include <math.h>

#include "samples.h"

#define INVALID AZULEJO_ERROR_INVALID_ARGUMENT

static azulejo_context *one, *three;

/* The distance of two places; on a torus of the nearest images. */
static double distance(const azulejo_volume_options *o, const float *a, const double *b) {
    double sum = 0;
    int k;
    for (k = 0; k < 3; k++) {
        double d = fabs((double)a[k] - b[k]), period = o->domain_max[k] - o->domain_min[k];
        if (o->boundary == AZULEJO_BOUNDARY_PERIODIC && d > period - d) d = period - d;
        sum += d * d;
    }
    return sqrt(sum);
}

/* The distance of a place from the nearest of the samples from `first` on. */
static double nearest(const azulejo_volume_options *o, const float *positions, size_t first, size_t count, const double *place) {
    double least = INFINITY;
    size_t i;
    for (i = first; i < count; i++) least = fmin(least, distance(o, positions + 3 * i, place));
    return least;
}

static double random_number(uint64_t *state) {
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 11) / 9007199254740992.0;
}

static void fills(uint32_t boundary) {
    azulejo_volume_options o = volume_options(0.11);
    azulejo_volume_report report;
    azulejo_points *points = NULL, *again = NULL;
    const float *positions;
    uint64_t state = 1;
    size_t i, count;
    int k;
    double farthest = 0, least = INFINITY;
    ACCEPTED(azulejo_volume_report_init(&report, sizeof report));
    o.boundary = boundary;
    o.domain_min[0] = -0.5;
    o.domain_max[1] = 1.25;
    o.seed = 3;
    if (!ACCEPTED(azulejo_volume_sample(one, &o, &points, &report))) return;
    count = azulejo_points_count(points);
    positions = azulejo_points_positions(points);
    CHECK(azulejo_points_dimension(points) == 3 && azulejo_points_triangles(points) == NULL);
    CHECK(azulejo_points_normals(points) == NULL && azulejo_points_ranks(points) == NULL);
    CHECK(count > 900 && report.samples == count && report.radius == 0.11 && report.seconds > 0);
    for (i = 0; i < count; i++) {
        double place[3];
        for (k = 0; k < 3; k++) {
            place[k] = positions[3 * i + k];
            CHECK(place[k] >= o.domain_min[k] && place[k] < o.domain_max[k]);
        }
        least = fmin(least, nearest(&o, positions, i + 1, count, place));
    }
    CHECK(least >= 0.11);
    for (i = 0; i < 20000; i++) {
        double place[3];
        for (k = 0; k < 3; k++) place[k] = o.domain_min[k] + random_number(&state) * (o.domain_max[k] - o.domain_min[k]);
        farthest = fmax(farthest, nearest(&o, positions, 0, count, place));
    }
    CHECK(farthest <= 0.11 + 3.5 / 8388608.0 && farthest > 0.1);
    if (ACCEPTED(azulejo_volume_sample(three, &o, &again, NULL))) {
        CHECK(azulejo_points_count(again) == count);
        CHECK(memcmp(azulejo_points_positions(again), positions, 3 * count * sizeof *positions) == 0);
    }
    azulejo_points_free(again);
    azulejo_points_free(points);
}

/* A tiled set: no two samples are nearer than the radius, and it has more of them than one that is not tiled. */
static void tiles(uint32_t boundary) {
    azulejo_volume_options o = volume_options(0.0288);
    azulejo_points *plain = NULL, *points = NULL;
    azulejo_space_report figures;
    azulejo_space_set set;
    size_t count;
    ACCEPTED(azulejo_space_report_init(&figures, sizeof figures));
    ACCEPTED(azulejo_space_set_init(&set, sizeof set));
    o.boundary = boundary;
    if (!ACCEPTED(azulejo_volume_sample(three, &o, &plain, NULL))) return;
    count = azulejo_points_count(plain);
    azulejo_points_free(plain);
    o.leaf_size = 6;
    if (!ACCEPTED(azulejo_volume_sample(three, &o, &points, NULL))) return;
    CHECK((double)azulejo_points_count(points) > 1.005 * (double)count);
    CHECK((double)azulejo_points_count(points) < 1.06 * (double)count);
    set.boundary = boundary;
    set.positions = azulejo_points_positions(points);
    set.count = azulejo_points_count(points);
    if (ACCEPTED(azulejo_space_measure(three, &set, o.radius, &figures))) {
        CHECK(figures.conflicts == 0 && figures.smallest_distance >= o.radius);
        CHECK(figures.covering_radius <= o.radius + 3.5 / 8388608.0);
    }
    azulejo_points_free(points);
}

/* Around a given sample, in order, and a count: distances, ranks and the report. */
static void around_in_order_and_counted(uint32_t boundary) {
    const float centre[3] = {0.5f, 0.5f, 0.9f};
    const double clearance = 0.3, place[3] = {0.5, 0.5, 0.9f};
    azulejo_volume_options o = volume_options(0.11);
    azulejo_volume_report report;
    azulejo_points *points = NULL;
    size_t i;
    o.boundary = boundary;
    o.given_positions = centre;
    o.given_clearances = &clearance;
    o.given_count = 1;
    o.order = AZULEJO_ORDER_PROGRESSIVE;
    o.quotient = 1.25;
    ACCEPTED(azulejo_volume_report_init(&report, sizeof report));
    if (!ACCEPTED(azulejo_volume_sample(one, &o, &points, &report))) return;
    CHECK(report.samples > 300 && report.radius == 0.11 && report.covering_radius == 0.11);
    for (i = 1; i < report.samples; i++) {
        const float *p = azulejo_points_positions(points) + 3 * i, *ranks = azulejo_points_ranks(points);
        const double here[3] = {p[0], p[1], p[2]};
        CHECK(ranks[i] <= ranks[i - 1] && nearest(&o, azulejo_points_positions(points), 0, i, here) >= ranks[i]);
        CHECK(distance(&o, p, place) >= clearance);
    }
    azulejo_points_free(points);
    o.radius = 0;
    o.count = 500;
    o.order = AZULEJO_ORDER_ANY;
    o.quotient = 0;
    points = NULL;
    if (!ACCEPTED(azulejo_volume_sample(one, &o, &points, &report))) return;
    CHECK(report.samples == 500 && azulejo_points_count(points) == 500 && azulejo_points_ranks(points) == NULL);
    CHECK(report.radius > 0 && report.covering_radius >= report.radius && report.covering_radius < 1.2 * report.radius);
    for (i = 0; i < 500; i++) {
        const float *p = azulejo_points_positions(points) + 3 * i;
        const double here[3] = {p[0], p[1], p[2]};
        CHECK(nearest(&o, azulejo_points_positions(points), i + 1, 500, here) >= report.radius);
        CHECK(distance(&o, p, place) >= clearance);
    }
    azulejo_points_free(points);
}

static void refused(void) {
    const azulejo_volume_options good = volume_options(0.2);
    azulejo_volume_options bad = good;
    azulejo_points *out = UNTOUCHED;
    REFUSED(INVALID, "context", azulejo_volume_sample(NULL, &good, &out, NULL));
    REFUSED(INVALID, "options", azulejo_volume_sample(one, NULL, &out, NULL));
    REFUSED(INVALID, "out", azulejo_volume_sample(one, &good, NULL, NULL));
    bad.radius = NAN;
    REFUSED(INVALID, "radius: NaN", azulejo_volume_sample(one, &bad, &out, NULL));
    bad.radius = 0;
    REFUSED(INVALID, "radius: 0", azulejo_volume_sample(one, &bad, &out, NULL));
    bad.radius = 1e-4;
    REFUSED(AZULEJO_ERROR_TOO_LARGE, "radius: 0.0001 asks for", azulejo_volume_sample(one, &bad, &out, NULL));
    bad = good;
    bad.boundary = 2;
    REFUSED(INVALID, "boundary: 2 is no", azulejo_volume_sample(one, &bad, &out, NULL));
    bad = good;
    bad.domain_max[2] = 0;
    REFUSED(INVALID, "domain_max: [2] is 0", azulejo_volume_sample(one, &bad, &out, NULL));
    bad = good;
    bad.domain_min[1] = -INFINITY;
    REFUSED(INVALID, "domain_min: [1] is -inf", azulejo_volume_sample(one, &bad, &out, NULL));
    bad = good;
    bad.domain_min[0] = 1e7;
    bad.domain_max[0] = 1e7 + 1;
    REFUSED(INVALID, "radius: 0.2 is below 64.0", azulejo_volume_sample(one, &bad, &out, NULL));
    bad = good;
    bad.count = 5;
    REFUSED(INVALID, "radius: 0.2 has no effect beside a count", azulejo_volume_sample(one, &bad, &out, NULL));
    bad = good;
    bad.quotient = 1.2;
    REFUSED(INVALID, "quotient: 1.2 has no effect in any order", azulejo_volume_sample(one, &bad, &out, NULL));
    bad.order = AZULEJO_ORDER_PROGRESSIVE;
    bad.quotient = 2;
    REFUSED(INVALID, "quotient: 2.0 is not in", azulejo_volume_sample(one, &bad, &out, NULL));
    bad = good;
    bad.given_count = 1;
    REFUSED(INVALID, "given_positions", azulejo_volume_sample(one, &bad, &out, NULL));
    bad = good;
    bad.leaf_size = 5;
    REFUSED(INVALID, "leaf_size: 5.0 is neither 0", azulejo_volume_sample(one, &bad, &out, NULL));
    bad.leaf_size = 20;
    bad.order = AZULEJO_ORDER_PROGRESSIVE;
    REFUSED(INVALID, "leaf_size: 20.0 has no effect in", azulejo_volume_sample(one, &bad, &out, NULL));
    bad = good;
    bad.struct_size = 8;
    REFUSED(INVALID, "struct_size", azulejo_volume_sample(one, &bad, &out, NULL));
    CHECK(out == UNTOUCHED);
}

/* Points that are random at first. */
enum { RELAXED = 600 };

static azulejo_volume_relax_options relax_options(void) {
    azulejo_volume_relax_options options;
    ACCEPTED(azulejo_volume_relax_options_init(&options, sizeof options));
    return options;
}

static void relaxes(uint32_t boundary) {
    azulejo_volume_relax_options options = relax_options();
    azulejo_volume_relax_report report;
    azulejo_points *points = NULL, *again = NULL;
    float positions[3 * RELAXED];
    azulejo_volume_options unit = volume_options(1);
    const float *xyz;
    double smallest = INFINITY;
    size_t i;
    uint64_t state = 7;
    for (i = 0; i < 3 * RELAXED; i++) positions[i] = (float)(0.999 * random_number(&state));
    options.boundary = unit.boundary = boundary;
    ACCEPTED(azulejo_volume_relax_report_init(&report, sizeof report));
    ACCEPTED(azulejo_volume_relax(one, &options, positions, RELAXED, &points, &report));
    ACCEPTED(azulejo_volume_relax(three, &options, positions, RELAXED, &again, NULL));
    CHECK(azulejo_points_count(points) == RELAXED && azulejo_points_dimension(points) == 3);
    xyz = azulejo_points_positions(points);
    CHECK(memcmp(xyz, azulejo_points_positions(again), sizeof positions) == 0);
    for (i = 0; i < RELAXED; i++) {
        const double place[3] = {xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]};
        smallest = fmin(smallest, nearest(&unit, xyz, i + 1, RELAXED, place));
        CHECK(xyz[3 * i] >= 0 && xyz[3 * i] < 1 && xyz[3 * i + 2] >= 0 && xyz[3 * i + 2] < 1);
    }
    CHECK(fabs(smallest / report.smallest_distance - 1) < 1e-9);
    CHECK(fabs(smallest / cbrt(sqrt(2) / RELAXED) / report.rho - 1) < 1e-9);
    CHECK(report.rho > 0.88 && report.iterations <= 100);
    azulejo_points_free(points);
    azulejo_points_free(again);
    points = NULL;
    options.max_iterations = 0;
    ACCEPTED(azulejo_volume_relax(one, &options, positions, RELAXED, &points, NULL));
    CHECK(memcmp(azulejo_points_positions(points), positions, sizeof positions) == 0);
    azulejo_points_free(points);
}

static void relaxation_refused(void) {
    const azulejo_volume_relax_options good = relax_options();
    azulejo_volume_relax_options bad = good;
    const float inside[3] = {0.5f, 0.5f, 0.5f}, outside[3] = {0.5f, 1, 0.5f};
    azulejo_points *out = UNTOUCHED;
    REFUSED(INVALID, "context", azulejo_volume_relax(NULL, &good, inside, 1, &out, NULL));
    REFUSED(INVALID, "options", azulejo_volume_relax(one, NULL, inside, 1, &out, NULL));
    REFUSED(INVALID, "positions", azulejo_volume_relax(one, &good, NULL, 1, &out, NULL));
    REFUSED(INVALID, "positions: point 0", azulejo_volume_relax(one, &good, outside, 1, &out, NULL));
    REFUSED(INVALID, "out", azulejo_volume_relax(one, &good, inside, 1, NULL, NULL));
    bad.tolerance = NAN;
    REFUSED(INVALID, "tolerance", azulejo_volume_relax(one, &bad, inside, 1, &out, NULL));
    bad = good;
    bad.boundary = 2;
    REFUSED(INVALID, "boundary: 2 is no", azulejo_volume_relax(one, &bad, inside, 1, &out, NULL));
    bad = good;
    bad.domain_max[1] = 0;
    REFUSED(INVALID, "domain_max: [1] is 0", azulejo_volume_relax(one, &bad, inside, 1, &out, NULL));
    CHECK(out == UNTOUCHED);
}

typedef struct { double least, slope; } ramp;

static double along_x(void *user, const double *position) {
    const ramp *r = user;
    return r->least + r->slope * position[0];
}

/* All pairs of a ramp on a torus, and random places of it; and the same radii on a grid. */
static void follows_a_radius(void) {
    ramp r = {0.06, 0.12};
    azulejo_volume_adaptive_options o;
    azulejo_volume_report report;
    azulejo_points *points = NULL, *again = NULL, *grid = NULL, *out = UNTOUCHED;
    const float ends[2] = {0.06f, 0.18f};
    const float *xyz;
    const double *radii;
    uint64_t state = 11;
    size_t i, j, k, found = 0;
    ACCEPTED(azulejo_volume_adaptive_options_init(&o, sizeof o));
    ACCEPTED(azulejo_volume_report_init(&report, sizeof report));
    REFUSED(INVALID, "radius_function: is NULL", azulejo_volume_adaptive_sample(one, NULL, &o, &out, NULL));
    o.radius_function = along_x;
    o.radius_function_user = &r;
    o.smallest = 0.06;
    o.largest = 0.18;
    o.slope = 0.12;
    o.seed = 5;
    ACCEPTED(azulejo_volume_adaptive_sample(one, NULL, &o, &points, &report));
    ACCEPTED(azulejo_volume_adaptive_sample(three, NULL, &o, &again, NULL));
    xyz = azulejo_points_positions(points);
    radii = azulejo_points_radii(points);
    CHECK(report.samples > 500 && report.radius >= 0.06 && report.covering_radius == 0.18);
    CHECK(azulejo_points_count(again) == report.samples);
    CHECK(memcmp(xyz, azulejo_points_positions(again), 3 * report.samples * sizeof *xyz) == 0);
    for (i = 0; i < report.samples + 3000; i++) {
        double place[3], radius, excess = 1;
        const int is_sample = i < report.samples;
        for (k = 0; k < 3; k++) place[k] = is_sample ? xyz[3 * i + k] : random_number(&state);
        radius = along_x(&r, place);
        if (is_sample) CHECK(radii[i] == radius);
        for (j = 0; j < (is_sample ? i : report.samples); j++) {
            double square = 0;
            for (k = 0; k < 3; k++) {
                const double d = fabs(place[k] - xyz[3 * j + k]), turned = fmin(d, 1 - d);
                square += turned * turned;
            }
            excess = fmin(excess, sqrt(square) - (radius + radii[j]) / 2);
        }
        if (is_sample) CHECK(excess >= 0);
        else CHECK(excess <= 1e-6);
    }
    o.radius_function_user = NULL;
    o.radius_function = NULL;
    o.smallest = o.largest = o.slope = 0;
    o.grid_values = ends;
    REFUSED(INVALID, "grid_size: [0, 0, 0]", azulejo_volume_adaptive_sample(one, NULL, &o, &out, NULL));
    o.grid_size[0] = 2;
    o.grid_size[1] = o.grid_size[2] = 1;
    ACCEPTED(azulejo_volume_adaptive_sample(one, NULL, &o, &grid, NULL));
    found = azulejo_points_count(grid);
    CHECK(found > 500 && found < 1.1 * (double)report.samples && 1.1 * (double)found > (double)report.samples);
    o.slope = 0.1;
    REFUSED(INVALID, "slope: 0.1 has no effect", azulejo_volume_adaptive_sample(one, NULL, &o, &out, NULL));
    o.slope = 0;
    o.tolerance = 0.1;
    REFUSED(INVALID, "tolerance: 0.1 has no effect", azulejo_volume_adaptive_sample(one, NULL, &o, &out, NULL));
    CHECK(out == UNTOUCHED);
    azulejo_points_free(points);
    azulejo_points_free(again);
    azulejo_points_free(grid);
}

static const uint32_t faces[36] = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                                   2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};

/* The shell of the cube: its samples in pairs and against the nearest face, and random places of it. */
static void fills_shells(void) {
    azulejo_volume_inside_options o;
    azulejo_volume_inside_report report;
    const azulejo_volume_options distances = {.boundary = AZULEJO_BOUNDARY_BOUNDED};
    azulejo_mesh *cube = NULL;
    azulejo_points *points = NULL, *again = NULL, *out = UNTOUCHED;
    const float *xyz;
    float corners[24];
    uint64_t state = 4;
    size_t i, k, tested = 0;
    for (i = 0; i < 24; i++) corners[i] = (float)(i / 3 >> i % 3 & 1);
    ACCEPTED(azulejo_mesh_create(corners, 8, 12, faces, 12, &cube));
    ACCEPTED(azulejo_volume_inside_options_init(&o, sizeof o));
    ACCEPTED(azulejo_volume_inside_report_init(&report, sizeof report));
    CHECK(o.thickness == 0);
    o.radius = 0.11;
    o.thickness = 0.15;
    ACCEPTED(azulejo_volume_sample_inside(one, cube, &o, &points, &report));
    ACCEPTED(azulejo_volume_sample_inside(three, cube, &o, &again, NULL));
    xyz = azulejo_points_positions(points);
    CHECK(report.samples > 300 && azulejo_points_count(again) == report.samples && report.depth < 0.02);
    CHECK(memcmp(xyz, azulejo_points_positions(again), 3 * report.samples * sizeof *xyz) == 0);
    for (i = 0; i < report.samples; i++) {
        const float *p = xyz + 3 * i;
        const double here[3] = {p[0], p[1], p[2]};
        double depth = 1;
        for (k = 0; k < 3; k++) depth = fmin(depth, fmin(here[k], 1 - here[k]));
        CHECK(depth >= 0 && depth <= 0.15);
        CHECK(nearest(&distances, xyz, i + 1, report.samples, here) >= 0.11);
    }
    while (tested < 3000) {
        double place[3], depth = 1;
        for (k = 0; k < 3; k++) place[k] = random_number(&state);
        for (k = 0; k < 3; k++) depth = fmin(depth, fmin(place[k], 1 - place[k]));
        if (depth <= report.depth || depth >= 0.15 - report.depth) continue;
        CHECK(nearest(&distances, xyz, 0, report.samples, place) < 0.11 + 1e-6);
        tested++;
    }
    o.thickness = NAN;
    REFUSED(INVALID, "thickness: NaN", azulejo_volume_sample_inside(one, cube, &o, &out, NULL));
    o.thickness = 0.0004;
    REFUSED(INVALID, "thickness: 0.0004 is neither 0 nor", azulejo_volume_sample_inside(one, cube, &o, &out, NULL));
    CHECK(out == UNTOUCHED);
    azulejo_points_free(points);
    azulejo_points_free(again);
    azulejo_mesh_free(cube);
}

/* In the cube: those that are fixed stay, the others stay inside. */
static void relaxes_inside(void) {
    azulejo_relax_inside_options options;
    azulejo_volume_relax_report report;
    azulejo_mesh *cube = NULL, *open = NULL;
    azulejo_points *points = NULL, *again = NULL, *out = UNTOUCHED;
    float corners[24], positions[3 * RELAXED];
    unsigned char fixed[RELAXED], inside[RELAXED];
    const float *xyz;
    uint64_t state = 9;
    size_t i;
    for (i = 0; i < 24; i++) corners[i] = (float)(i / 3 >> i % 3 & 1);
    for (i = 0; i < 3 * RELAXED; i++) positions[i] = (float)(0.999 * random_number(&state));
    for (i = 0; i < RELAXED; i++) fixed[i] = i % 5 == 0;
    ACCEPTED(azulejo_mesh_create(corners, 8, 12, faces, 12, &cube));
    ACCEPTED(azulejo_mesh_create(corners, 8, 12, faces, 11, &open));
    ACCEPTED(azulejo_relax_inside_options_init(&options, sizeof options));
    ACCEPTED(azulejo_volume_relax_report_init(&report, sizeof report));
    options.fixed = fixed;
    options.fixed_count = RELAXED;
    ACCEPTED(azulejo_volume_relax_inside(one, cube, &options, positions, RELAXED, &points, &report));
    ACCEPTED(azulejo_volume_relax_inside(three, cube, &options, positions, RELAXED, &again, NULL));
    xyz = azulejo_points_positions(points);
    CHECK(memcmp(xyz, azulejo_points_positions(again), sizeof positions) == 0);
    ACCEPTED(azulejo_mesh_contains(one, cube, xyz, RELAXED, inside));
    for (i = 0; i < RELAXED; i++) {
        CHECK(inside[i]);
        CHECK((memcmp(xyz + 3 * i, positions + 3 * i, 3 * sizeof *xyz) == 0) == fixed[i]);
    }
    CHECK(report.iterations == 100 && report.rho > 0);
    azulejo_points_free(points);
    azulejo_points_free(again);
    ACCEPTED(azulejo_volume_relax_inside(one, open, &options, positions, RELAXED, &points, NULL));
    azulejo_points_free(points);
    REFUSED(INVALID, "fixed: has 600 entries for 2 points",
            azulejo_volume_relax_inside(one, cube, &options, positions, 2, &out, NULL));
    options.fixed = NULL;
    REFUSED(INVALID, "fixed", azulejo_volume_relax_inside(one, cube, &options, positions, RELAXED, &out, NULL));
    options.fixed_count = 0;
    options.sliding_count = RELAXED;
    REFUSED(INVALID, "sliding: is NULL", azulejo_volume_relax_inside(one, cube, &options, positions, RELAXED, &out, NULL));
    options.sliding = fixed;
    REFUSED(INVALID, "positions: point 0", azulejo_volume_relax_inside(one, cube, &options, positions, RELAXED, &out, NULL));
    for (i = 0; i < RELAXED; i += 5) positions[3 * i + i % 3] = 0;
    ACCEPTED(azulejo_volume_relax_inside(one, cube, &options, positions, RELAXED, &points, NULL));
    xyz = azulejo_points_positions(points);
    for (i = 0; i < 3 * RELAXED; i += 15) {
        const float *p = xyz + i;
        CHECK(p[0] * p[1] * p[2] * (1 - p[0]) * (1 - p[1]) * (1 - p[2]) < 1e-6f);
    }
    azulejo_points_free(points);
    options.sliding = NULL;
    options.sliding_count = 0;
    positions[4] = 1.5f;
    REFUSED(INVALID, "positions: point 1", azulejo_volume_relax_inside(one, cube, &options, positions, 2, &out, NULL));
    positions[4] = NAN;
    REFUSED(INVALID, "positions: point 1", azulejo_volume_relax_inside(one, cube, &options, positions, 2, &out, NULL));
    REFUSED(INVALID, "mesh", azulejo_volume_relax_inside(one, NULL, &options, positions, 1, &out, NULL));
    CHECK(out == UNTOUCHED);
    azulejo_mesh_free(cube);
    azulejo_mesh_free(open);
}

/* Two of one radius and a smaller one: their distances, also from a given sample, the same for any threads; and bad input. */
static void has_classes(void) {
    static const double own[3] = {0.2, 0.2, 0.12};
    static const float at[3] = {0.5f, 0.5f, 0.5f};
    static const double clearances[3] = {0.3, 0, 0.1};
    double radii[9];
    azulejo_volume_options o = volume_options(0);
    azulejo_classes c;
    azulejo_points *points = NULL, *again = NULL, *out = UNTOUCHED;
    const float *xyz;
    const uint32_t *of;
    size_t i, j;
    ACCEPTED(azulejo_classes_init(&c, sizeof c));
    ACCEPTED(azulejo_classes_radii(own, 3, 1, radii));
    c.count = 3;
    c.radii = radii;
    o.given_positions = at;
    o.given_clearances = clearances;
    o.given_count = 1;
    ACCEPTED(azulejo_volume_sample_classes(one, &o, &c, &points, NULL));
    ACCEPTED(azulejo_volume_sample_classes(three, &o, &c, &again, NULL));
    xyz = azulejo_points_positions(points);
    of = azulejo_points_classes(points);
    CHECK(azulejo_points_count(points) == azulejo_points_count(again) && azulejo_points_count(points) > 200);
    CHECK(memcmp(xyz, azulejo_points_positions(again), 3 * azulejo_points_count(points) * sizeof *xyz) == 0);
    for (i = 0; i < azulejo_points_count(points); i++) {
        const double here[3] = {xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]};
        CHECK(distance(&o, at, here) >= clearances[of[i]]);
        for (j = 0; j < i; j++) CHECK(distance(&o, xyz + 3 * j, here) >= radii[3 * of[i] + of[j]]);
    }
    azulejo_points_free(points);
    azulejo_points_free(again);
#define NO_SET(part, change)                                                                          \
    do {                                                                                              \
        azulejo_volume_options o = volume_options(0);                                                 \
        azulejo_classes d = c;                                                                        \
        (void)(change);                                                                               \
        REFUSED(INVALID, part, azulejo_volume_sample_classes(one, &o, &d, &out, NULL));               \
        CHECK(out == UNTOUCHED);                                                                      \
    } while (0)
    NO_SET("radius: 0.1 has no effect with classes", o.radius = 0.1);
    NO_SET("count: 7 has no effect", o.count = 7);
    NO_SET("order: 1 has no effect", o.order = AZULEJO_ORDER_PROGRESSIVE);
    NO_SET("quotient: 1.2 has no effect", o.quotient = 1.2);
    NO_SET("leaf_size: 20.0 has no effect", o.leaf_size = 20);
    NO_SET("domain_max: ", o.domain_max[2] = 0);
    NO_SET("given_positions", o.given_count = 1);
    NO_SET("count: 0 classes", d.count = 0);
    NO_SET("radii", d.radii = NULL);
    NO_SET("mask_count: 4 has no effect in space", d.mask_count = 4);
#undef NO_SET
    REFUSED(INVALID, "classes", azulejo_volume_sample_classes(one, &o, NULL, &out, NULL));
    REFUSED(INVALID, "options", azulejo_volume_sample_classes(one, NULL, &c, &out, NULL));
    REFUSED(INVALID, "out", azulejo_volume_sample_classes(one, &o, &c, NULL, NULL));
}

int main(void) {
    one = make_context(1);
    three = make_context(3);
    fills(AZULEJO_BOUNDARY_PERIODIC);
    fills(AZULEJO_BOUNDARY_BOUNDED);
    tiles(AZULEJO_BOUNDARY_PERIODIC);
    tiles(AZULEJO_BOUNDARY_BOUNDED);
    around_in_order_and_counted(AZULEJO_BOUNDARY_PERIODIC);
    around_in_order_and_counted(AZULEJO_BOUNDARY_BOUNDED);
    refused();
    follows_a_radius();
    fills_shells();
    has_classes();
    relaxes(AZULEJO_BOUNDARY_PERIODIC);
    relaxes(AZULEJO_BOUNDARY_BOUNDED);
    relaxation_refused();
    relaxes_inside();
    azulejo_context_free(one);
    azulejo_context_free(three);
    return finish();
}
