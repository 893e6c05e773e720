/* Analysis: known figures of a lattice and of random points, gaps that are put in, and each bad input refused with a
   message that names it, leaving the outputs alone. */

#include <math.h>

#include "samples.h"

#define INVALID AZULEJO_ERROR_INVALID_ARGUMENT
#define TOO_LARGE AZULEJO_ERROR_TOO_LARGE

/* A hexagonal lattice of unit spacing on a torus. */
#define COLUMNS 16
#define ROWS 18
#define LATTICE (COLUMNS * ROWS)
#define RANDOM 4000

static azulejo_context *context;
static azulejo_mesh *cube;
static float lattice[LATTICE][2], noise[RANDOM][2];
static double lattice_max[2];
static const double low[2] = {0, 0}, high[2] = {1, 1}, bad[2] = {NAN, 1};

static int near(double a, double b, double tolerance) { return fabs(a - b) <= tolerance; }

static void make_sets(void) {
    const double height = sqrt(0.75);
    int i;
    for (i = 0; i < LATTICE; i++) {
        const int row = i / COLUMNS;
        lattice[i][0] = (float)(i % COLUMNS + 0.5 * (row % 2));
        lattice[i][1] = (float)(row * height);
    }
    lattice_max[0] = COLUMNS;
    lattice_max[1] = ROWS * height;
    random_points(&noise[0][0], RANDOM);
}

static void planes(void) {
    azulejo_plane_report report = plane_report();
    azulejo_coverage_report coverage = coverage_report();
    ACCEPTED(azulejo_plane_measure(context, PLANE(*lattice, LATTICE, low, lattice_max, 0), &report));
    CHECK(report.count == LATTICE && report.triangles == 2 * LATTICE);
    CHECK(near(report.smallest_distance, 1, 1e-5) && near(report.mean_distance, 1, 1e-5));
    CHECK(near(report.hexagonal_distance, 1, 1e-12) && near(report.rho, 1, 1e-5));
    CHECK(near(report.covering_radius, sqrt(1.0 / 3), 1e-5) && near(report.bond_order, 1, 1e-5));
    CHECK(report.angles_below_30_degrees == 0 && report.beyond_4_sigma < 1);
    CHECK(report.obtuse == 0 && report.below_30_degrees == 0 && near(report.edge_mean, 1, 1e-5));
    CHECK(near(report.edge_variation, 0, 1e-9) && near(report.area_variation, 0, 1e-9));
    CHECK(report.reserved == 0 && report.struct_size == sizeof report);

    ACCEPTED(azulejo_plane_measure(context, PLANE(NULL, 0, low, high, 1), &report));
    CHECK(report.count == 0 && isinf(report.smallest_distance) && isinf(report.rho) && isinf(report.covering_radius));
    ACCEPTED(azulejo_plane_measure(context, PLANE(*noise, RANDOM, low, high, 1), &report));
    CHECK(near(report.mean_distance / report.hexagonal_distance, 0.465, 0.02) && near(report.bond_order, 0.365, 0.02));

    ACCEPTED(azulejo_plane_coverage(context, PLANE(*lattice, LATTICE, low, lattice_max, 0), 0.58, &coverage));
    CHECK(coverage.gaps == 0 && near(coverage.covering_radius, sqrt(1.0 / 3), 1e-5) && coverage.reserved == 0);
    /* A gap in each triangle. */
    ACCEPTED(azulejo_plane_coverage(context, PLANE(*lattice, LATTICE, low, lattice_max, 0), 0.55, &coverage));
    CHECK(coverage.gaps == 2 * LATTICE);
    ACCEPTED(azulejo_plane_coverage(context, PLANE(NULL, 0, low, high, 1), 0.5, &coverage));
    CHECK(coverage.gaps == 1 && isinf(coverage.covering_radius));
}

/* The simple cubic lattice of unit spacing on a torus, in the middle of its cells. */
#define SIDE 8
#define CUBES (SIDE * SIDE * SIDE)

static azulejo_space_set cubes(void) {
    static float centres[CUBES][3];
    azulejo_space_set set;
    int i, k;
    for (i = 0; i < CUBES; i++) {
        centres[i][0] = (float)(i % SIDE) + 0.5f;
        centres[i][1] = (float)(i / SIDE % SIDE) + 0.5f;
        centres[i][2] = (float)(i / SIDE / SIDE) + 0.5f;
    }
    ACCEPTED(azulejo_space_set_init(&set, sizeof set));
    for (k = 0; k < 3; k++) set.domain_max[k] = SIDE;
    set.positions = *centres;
    set.count = CUBES;
    return set;
}

static void spaces(void) {
    const azulejo_space_set lattice_set = cubes();
    azulejo_space_set set = lattice_set;
    azulejo_space_report report = space_report();
    azulejo_coverage_report coverage = coverage_report();
    ACCEPTED(azulejo_space_measure(context, &set, 1.0001, &report));
    CHECK(report.count == CUBES && report.conflicts == 3 * CUBES && report.reserved == 0);
    CHECK(report.smallest_distance == 1 && near(report.mean_distance, 1, 1e-12));
    CHECK(near(report.packed_distance, cbrt(sqrt(2.0)), 1e-12) && near(report.rho, 1 / cbrt(sqrt(2.0)), 1e-12));
    CHECK(near(report.covering_radius, sqrt(0.75), 1e-8));
    CHECK(near(report.relative_covering_radius, sqrt(0.75) / cbrt(sqrt(2.0)), 1e-8));
    ACCEPTED(azulejo_space_measure(context, &set, 1, &report));
    CHECK(report.conflicts == 0 && report.struct_size == sizeof report);
    ACCEPTED(azulejo_space_coverage(context, &set, 0.87, &coverage));
    CHECK(coverage.gaps == 0 && coverage.covering_radius == report.covering_radius && coverage.reserved == 0);
    /* A gap in the middle of eight points. */
    ACCEPTED(azulejo_space_coverage(context, &set, 0.86, &coverage));
    CHECK(coverage.gaps == CUBES);
    set.boundary = AZULEJO_BOUNDARY_BOUNDED;
    ACCEPTED(azulejo_space_coverage(context, &set, 0.86, &coverage));
    CHECK(coverage.gaps == (SIDE + 1) * (SIDE + 1) * (SIDE + 1));
    set.count = 0;
    ACCEPTED(azulejo_space_measure(context, &set, 1, &report));
    CHECK(report.count == 0 && isinf(report.smallest_distance) && isinf(report.rho) && isinf(report.covering_radius));
    ACCEPTED(azulejo_space_coverage(context, &set, 0.5, &coverage));
    CHECK(coverage.gaps == 1 && isinf(coverage.covering_radius));

    set = lattice_set;
    coverage.gaps = report.count = 77;
    REFUSED(INVALID, "context", azulejo_space_measure(NULL, &set, 1, &report));
    REFUSED(INVALID, "context", azulejo_space_coverage(NULL, &set, 1, &coverage));
    REFUSED(INVALID, "set: is NULL", azulejo_space_measure(context, NULL, 1, &report));
    REFUSED(INVALID, "set: is NULL", azulejo_space_coverage(context, NULL, 1, &coverage));
    REFUSED(INVALID, "out", azulejo_space_measure(context, &set, 1, NULL));
    REFUSED(INVALID, "out", azulejo_space_coverage(context, &set, 1, NULL));
    REFUSED(INVALID, "radius", azulejo_space_measure(context, &set, -1, &report));
    REFUSED(INVALID, "radius", azulejo_space_measure(context, &set, NAN, &report));
    REFUSED(INVALID, "radius", azulejo_space_coverage(context, &set, 0, &coverage));
    set.struct_size = 71;
    REFUSED(INVALID, "azulejo_space_set_init", azulejo_space_measure(context, &set, 1, &report));
    set = lattice_set;
    set.boundary = 2;
    REFUSED(INVALID, "boundary", azulejo_space_measure(context, &set, 1, &report));
    set = lattice_set;
    set.domain_max[2] = 0;
    REFUSED(INVALID, "domain_max: [2]", azulejo_space_coverage(context, &set, 1, &coverage));
    set.domain_max[2] = 7;
    REFUSED(INVALID, "positions: point 448", azulejo_space_coverage(context, &set, 1, &coverage));
    set = lattice_set;
    set.count = SIZE_MAX / 3;
    REFUSED(TOO_LARGE, "count", azulejo_space_measure(context, &set, 1, &report));
    set.count = 1;
    set.positions = NULL;
    REFUSED(INVALID, "positions", azulejo_space_measure(context, &set, 1, &report));
    set.positions = lattice_set.positions;
    REFUSED(TOO_LARGE, "radius", azulejo_space_coverage(context, &set, 1e-3, &coverage));
    CHECK(coverage.gaps == 77 && report.count == 77);
}

/* Of a lattice of cubes all power is at the multiples of one wave per cube, and all pairs at the lengths of its vectors. */
static void spaces_of_waves(void) {
    azulejo_space_set set = cubes();
    azulejo_annulus annuli[16];
    double power[2 * SIDE], density[20];
    size_t count = 0, again = 77;
    ACCEPTED(azulejo_space_spectrum(context, &set, 1.05, 1, 0.1, annuli, COUNT_OF(annuli), sizeof *annuli, &count));
    CHECK(count > 5 && count <= 11);
    for (size_t i = 0; i < count; i++) {
        CHECK(i == 0 || annuli[i].frequency > annuli[i - 1].frequency);
        CHECK(annuli[i].count >= 2 && (annuli[i].frequency < 0.99 ? annuli[i].power < 1e-6 : annuli[i].power > 1));
    }
    ACCEPTED(azulejo_space_spectrum(context, &set, 1.05, 1, 0.1, NULL, 0, sizeof *annuli, &again));
    CHECK(again == count);
    for (uint32_t axis = 0; axis < 3; axis++) {
        ACCEPTED(azulejo_space_axis_power(context, &set, axis, COUNT_OF(power), power));
        for (int i = 0; i < 2 * SIDE; i++) CHECK(near(power[i], (i + 1) % SIDE ? 0 : CUBES, 1e-6 * CUBES));
    }
    /* Six neighbours at 1, twelve at sqrt(2), 1.26 of the unit, cbrt(sqrt(2)). */
    ACCEPTED(azulejo_space_radial_distribution(context, &set, 1.5, COUNT_OF(density), density));
    for (int i = 0; i < 20; i++) CHECK((density[i] > 0) == (i == 11 || i == 16));

    power[0] = density[0] = 77;
    count = 77;
    REFUSED(INVALID, "context", azulejo_space_spectrum(NULL, &set, 1, 1, 0.1, annuli, 1, sizeof *annuli, &count));
    REFUSED(INVALID, "set: is NULL", azulejo_space_spectrum(context, NULL, 1, 1, 0.1, annuli, 1, sizeof *annuli, &count));
    REFUSED(INVALID, "frequency_reach", azulejo_space_spectrum(context, &set, 0, 1, 0.1, annuli, 1, sizeof *annuli, &count));
    REFUSED(INVALID, "frequency_reach",
            azulejo_space_spectrum(context, &set, 1e9, 1, 0.1, annuli, 1, sizeof *annuli, &count));
    REFUSED(INVALID, "frequency_stride", azulejo_space_spectrum(context, &set, 1, 0, 0.1, annuli, 1, sizeof *annuli, &count));
    REFUSED(INVALID, "width", azulejo_space_spectrum(context, &set, 1, 1, NAN, annuli, 1, sizeof *annuli, &count));
    REFUSED(INVALID, "annuli", azulejo_space_spectrum(context, &set, 1, 1, 0.1, NULL, 1, sizeof *annuli, &count));
    REFUSED(INVALID, "annulus_size: 24", azulejo_space_spectrum(context, &set, 1, 1, 0.1, annuli, 1, 24, &count));
    REFUSED(INVALID, "out_count", azulejo_space_spectrum(context, &set, 1, 1, 0.1, annuli, 1, sizeof *annuli, NULL));
    REFUSED(INVALID, "context", azulejo_space_axis_power(NULL, &set, 0, 1, power));
    REFUSED(INVALID, "axis", azulejo_space_axis_power(context, &set, 3, 1, power));
    REFUSED(INVALID, "count: 0", azulejo_space_axis_power(context, &set, 0, 0, power));
    REFUSED(INVALID, "count: 65537", azulejo_space_axis_power(context, &set, 0, 65537, power));
    REFUSED(INVALID, "out", azulejo_space_axis_power(context, &set, 0, 1, NULL));
    REFUSED(INVALID, "context", azulejo_space_radial_distribution(NULL, &set, 1, 4, density));
    REFUSED(INVALID, "reach", azulejo_space_radial_distribution(context, &set, 100, 4, density));
    REFUSED(INVALID, "bins", azulejo_space_radial_distribution(context, &set, 1, 0, density));
    REFUSED(INVALID, "out", azulejo_space_radial_distribution(context, &set, 1, 4, NULL));
    set.count = 1;
    REFUSED(INVALID, "positions", azulejo_space_radial_distribution(context, &set, 1, 4, density));
    CHECK(count == 77 && power[0] == 77 && density[0] == 77);
}

static void distributions(void) {
    double density[40];
    uint64_t histogram[41], sum = 0;
    int i;
    ACCEPTED(azulejo_plane_nearest_histogram(context, PLANE(*lattice, LATTICE, low, lattice_max, 0), 2.05, 41, histogram));
    for (i = 0; i < 41; i++) sum += histogram[i];
    CHECK(histogram[19] + histogram[20] == LATTICE && sum == LATTICE);
    ACCEPTED(azulejo_plane_radial_distribution(context, PLANE(*lattice, LATTICE, low, lattice_max, 0), 1.65, 33, density));
    CHECK(density[19] + density[20] > 5 && density[18] == 0 && density[25] == 0);
    for (i = 0; i <= 1; i++) {
        int bin;
        ACCEPTED(azulejo_plane_radial_distribution(context, PLANE(*noise, RANDOM, low, high, i), 8, 40, density));
        for (bin = 5; bin < 40; bin++) CHECK(near(density[bin], 1, 0.1));
    }
}

static void spectra(void) {
    azulejo_spectrum *spectrum = NULL, *other = NULL, *mean = NULL;
    const azulejo_spectrum *both[2];
    azulejo_spectrum_report report = spectrum_report();
    azulejo_annulus annuli[200];
    struct {
        azulejo_annulus known;
        uint64_t later;
    } wide[2];
    size_t count = 0, again = 0, i, k;

    ACCEPTED(azulejo_spectrum_create(context, PLANE(*lattice, LATTICE, low, lattice_max, 0), 241, 1, &spectrum));
    CHECK(azulejo_spectrum_size(spectrum) == 241);
    /* The lowest frequency of the dual lattice along y, ROWS waves, and one that is in no sum. */
    CHECK(near(azulejo_spectrum_power(spectrum)[(120 + ROWS) * 241 + 120 + COLUMNS / 2], 0, 1e-3));
    CHECK(near(azulejo_spectrum_power(spectrum)[(120 + ROWS / 2) * 241 + 120 + COLUMNS], LATTICE, 1e-2));
    CHECK(azulejo_spectrum_power(spectrum)[120 * 241 + 120] == 0);
    ACCEPTED(azulejo_spectrum_measure(spectrum, 0.02, 0.5, 2, &report));
    CHECK(near(report.effective_nyquist, 0.5 * pow(4.0 / 3, 0.25), 0.01));
    CHECK(near(hypot(report.peak_frequency[0], report.peak_frequency[1]), 1.0746, 1e-3) || report.peak > 1);
    CHECK(near(report.frequency_step[0], 1 / (COLUMNS * sqrt(LATTICE / (lattice_max[0] * lattice_max[1]))), 1e-9));
    azulejo_spectrum_free(spectrum);

    ACCEPTED(azulejo_spectrum_create(context, PLANE(*noise, RANDOM / 2, low, high, 0), 300, 2, &spectrum));
    ACCEPTED(azulejo_spectrum_create(context, PLANE(noise[RANDOM / 2], RANDOM / 2, low, high, 0), 300, 2, &other));
    both[0] = spectrum;
    both[1] = other;
    ACCEPTED(azulejo_spectrum_mean(both, 2, &mean));
    for (i = 0; i < 3; i++) {
        const azulejo_spectrum *of = i < 2 ? both[i] : mean;
        ACCEPTED(azulejo_spectrum_measure(of, 0.1, 0.3, 3, &report));
        CHECK(near(report.contrast * (i < 2 ? 1 : 2), 1, 0.1));
        CHECK(report.peak > 3 && report.peak < 25 && report.effective_nyquist >= 0 && report.effective_nyquist < 0.1);
        CHECK(report.oscillation >= 0 && report.oscillation < 1 && report.reserved == 0);
        ACCEPTED(azulejo_spectrum_radial(of, 0.1, annuli, COUNT_OF(annuli), sizeof(azulejo_annulus), &count));
        CHECK(count > 60 && count < COUNT_OF(annuli));
        for (k = 5; k < count; k++) CHECK(near(annuli[k].power, 1, 0.35) && annuli[k].count > 20);
    }
    ACCEPTED(azulejo_spectrum_radial(mean, 0.1, NULL, 0, sizeof(azulejo_annulus), &again));
    CHECK(again == count);
    annuli[1].count = 77;
    ACCEPTED(azulejo_spectrum_radial(mean, 0.1, annuli, 1, sizeof(azulejo_annulus), &again));
    CHECK(again == count && annuli[1].count == 77);
    REFUSED(INVALID, "annulus_size: 24", azulejo_spectrum_radial(mean, 0.1, annuli, 1, sizeof *annuli - 8, &again));
    /* Elements of a later version: the field that is not known here stays. */
    memset(wide, 0x55, sizeof wide);
    ACCEPTED(azulejo_spectrum_radial(mean, 0.1, &wide->known, 2, sizeof *wide, &again));
    ACCEPTED(azulejo_spectrum_radial(mean, 0.1, annuli, 2, sizeof *annuli, &again));
    for (i = 0; i < 2; i++) {
        CHECK(memcmp(&wide[i].known, &annuli[i], sizeof *annuli) == 0 && wide[i].later == 0x5555555555555555u);
    }
    /* A small one does not reach far enough. */
    azulejo_spectrum_free(other);
    ACCEPTED(azulejo_spectrum_create(context, PLANE(*noise, RANDOM, low, high, 1), 16, 1, &other));
    ACCEPTED(azulejo_spectrum_measure(other, 0.02, 5, 6, &report));
    CHECK(report.effective_nyquist == -1 && report.oscillation == -1 && report.contrast == 0 && report.peak == 0);
    both[1] = other;
    REFUSED(INVALID, "sizes", azulejo_spectrum_mean(both, 2, &mean));
    azulejo_spectrum_free(spectrum);
    azulejo_spectrum_free(other);
    azulejo_spectrum_free(mean);
}

static void surfaces(void) {
    const double up[3] = {0, 0, 1}, frequencies[2] = {0.3, 1};
    azulejo_psp_options options = psp_options(0.05);
    azulejo_points *points = NULL;
    azulejo_coverage_report coverage = coverage_report();
    azulejo_differences *one = NULL, *both = NULL;
    const azulejo_differences *all[2];
    double power[2] = {0, 0};
    const float *positions;
    size_t count;
    options.iterations = 0;
    ACCEPTED(azulejo_psp_sample(context, cube, &options, &points, NULL));
    positions = azulejo_points_positions(points);
    count = azulejo_points_count(points);
    ACCEPTED(azulejo_mesh_coverage(context, cube, positions, count, 0.05 + 1e-6, &coverage));
    CHECK(coverage.gaps == 0 && coverage.covering_radius > 0.045 && coverage.reserved == 0);
    ACCEPTED(azulejo_mesh_coverage(context, cube, positions, 1, 0.05, &coverage));
    CHECK(coverage.gaps == 1 && coverage.covering_radius > 0.8);
    ACCEPTED(azulejo_mesh_coverage(context, cube, NULL, 0, 0.05, &coverage));
    CHECK(coverage.gaps >= 1 && isinf(coverage.covering_radius));

    ACCEPTED(azulejo_differences_create(context, cube, positions, azulejo_points_normals(points), count, up, 3, &one));
    all[0] = all[1] = one;
    ACCEPTED(azulejo_differences_mean(all, 2, &both));
    CHECK(azulejo_differences_radial(one)[30] == 0); /* half a spacing; the radius is 0.83 of one */
    CHECK(azulejo_differences_radial(both)[60] > 1.2 && near(azulejo_differences_radial(both)[511], 1, 0.2));
    CHECK(azulejo_differences_density(both)[64 * 128 + 64] == 0);
    ACCEPTED(azulejo_differences_power(both, frequencies, 2, power));
    CHECK(power[0] < 0.3 && power[1] > 0.7);
    ACCEPTED(azulejo_differences_power(both, NULL, 0, NULL));

    REFUSED(INVALID, "NULL", azulejo_differences_create(NULL, cube, positions, positions, count, up, 3, &one));
    REFUSED(INVALID, "mesh", azulejo_differences_create(context, NULL, positions, positions, count, up, 3, &one));
    REFUSED(INVALID, "positions", azulejo_differences_create(context, cube, NULL, positions, count, up, 3, &one));
    REFUSED(INVALID, "positions", azulejo_differences_create(context, cube, positions, positions, 1, up, 3, &one));
    REFUSED(INVALID, "normals", azulejo_differences_create(context, cube, positions, NULL, count, up, 3, &one));
    REFUSED(INVALID, "direction", azulejo_differences_create(context, cube, positions, positions, count, NULL, 3, &one));
    REFUSED(TOO_LARGE, "count", azulejo_differences_create(context, cube, positions, positions, SIZE_MAX, up, 3, &one));
    REFUSED(INVALID, "out", azulejo_differences_create(context, cube, positions, positions, count, up, 3, NULL));
    REFUSED(INVALID, "differences", azulejo_differences_mean(NULL, 1, &both));
    REFUSED(INVALID, "differences", azulejo_differences_mean(all, 0, &both));
    all[1] = NULL;
    REFUSED(INVALID, "differences: [1]", azulejo_differences_mean(all, 2, &both));
    REFUSED(INVALID, "frequencies", azulejo_differences_power(one, NULL, 2, power));
    REFUSED(INVALID, "frequencies: [0]", azulejo_differences_power(one, bad, 2, power));
    REFUSED(INVALID, "out", azulejo_differences_power(one, frequencies, 2, NULL));
    REFUSED(INVALID, "differences", azulejo_differences_power(NULL, frequencies, 2, power));
    CHECK(azulejo_differences_density(NULL) == NULL && azulejo_differences_radial(NULL) == NULL);
    azulejo_differences_free(one);
    azulejo_differences_free(both);
    azulejo_differences_free(NULL);
    azulejo_points_free(points);
}

/* Every wrong argument of a function that takes a set of the plane; further ones and the output go to the end. */
#define REFUSES_SET(function, status, part, change, ...)                         \
    do {                                                                         \
        azulejo_plane_set set = plane_set(*noise, RANDOM, low, high, 0);         \
        (void)(change);                                                          \
        REFUSED(status, part, function(context, &set, __VA_ARGS__));             \
    } while (0)
#define REFUSES_PLANES(function, ...)                                                                        \
    do {                                                                                                     \
        const float outside[4] = {0.5f, 0.5f, NAN, 0.5f};                                                    \
        azulejo_plane_set good = plane_set(*noise, RANDOM, low, high, 0);                                    \
        const azulejo_plane_set *misaligned = (const azulejo_plane_set *)((const char *)&good + 2);          \
        REFUSED(INVALID, "context", function(NULL, &good, __VA_ARGS__));                                     \
        REFUSED(INVALID, "set: is NULL", function(context, NULL, __VA_ARGS__));                              \
        REFUSED(INVALID, "set: ", function(context, misaligned, __VA_ARGS__));                               \
        REFUSES_SET(function, INVALID, "set: struct_size 0 is not", set.struct_size = 0, __VA_ARGS__);       \
        REFUSES_SET(function, INVALID, "azulejo_plane_set_init", set.struct_size = 55, __VA_ARGS__);         \
        REFUSES_SET(function, INVALID, "set: struct_size", set.struct_size = UINT32_MAX, __VA_ARGS__);       \
        REFUSES_SET(function, INVALID, "positions: is NULL", set.positions = NULL, __VA_ARGS__);             \
        REFUSES_SET(function, INVALID, "positions: ", (set.positions = outside, set.count = 2), __VA_ARGS__); \
        REFUSES_SET(function, TOO_LARGE, "count", set.count = SIZE_MAX, __VA_ARGS__);                        \
        REFUSES_SET(function, INVALID, "domain_min", set.domain_min[0] = NAN, __VA_ARGS__);                  \
        REFUSES_SET(function, INVALID, "domain_max", set.domain_max[1] = -INFINITY, __VA_ARGS__);            \
        REFUSES_SET(function, INVALID, "domain_max", set.domain_max[0] = 0, __VA_ARGS__);                    \
        REFUSES_SET(function, INVALID, "boundary", set.boundary = 2, __VA_ARGS__);                           \
    } while (0)

static void refused_sets(void) {
    azulejo_plane_report report, report_before;
    azulejo_coverage_report coverage, coverage_before;
    azulejo_spectrum *spectrum = UNTOUCHED;
    uint64_t histogram[4] = {7, 7, 7, 7};
    double density[4] = {7, 7, 7, 7};
    UNWRITTEN(report);
    UNWRITTEN(coverage);
    report_before = report;
    coverage_before = coverage;

    REFUSES_PLANES(azulejo_plane_measure, &report);
    REFUSES_PLANES(azulejo_plane_coverage, 0.1, &coverage);
    REFUSES_PLANES(azulejo_plane_nearest_histogram, 2, 4, histogram);
    REFUSES_PLANES(azulejo_plane_radial_distribution, 2, 4, density);
    REFUSES_PLANES(azulejo_spectrum_create, 16, 1, &spectrum);
    REFUSED(INVALID, "out", azulejo_plane_measure(context, PLANE(*noise, RANDOM, low, high, 0), NULL));
    REFUSED(INVALID, "out", azulejo_plane_coverage(context, PLANE(*noise, RANDOM, low, high, 0), 0.1, NULL));
    REFUSED(INVALID, "radius", azulejo_plane_coverage(context, PLANE(*noise, RANDOM, low, high, 0), NAN, &coverage));
    REFUSED(INVALID, "radius", azulejo_plane_coverage(context, PLANE(*noise, RANDOM, low, high, 0), 0, &coverage));

#define BINS(part, reach, bins, array)                                                                                 \
    REFUSED(INVALID, part, azulejo_plane_##array(context, PLANE(*noise, RANDOM, low, high, 0), reach, bins, out))
    {
        uint64_t *out = histogram;
        BINS("reach", 0, 4, nearest_histogram);
        BINS("reach", INFINITY, 4, nearest_histogram);
        BINS("bins", 1, 0, nearest_histogram);
        BINS("bins", 1, SIZE_MAX, nearest_histogram);
        out = NULL;
        BINS("out", 1, 4, nearest_histogram);
    }
    {
        double *out = density;
        BINS("reach", NAN, 4, radial_distribution);
        BINS("reach", 1000, 4, radial_distribution);
        BINS("bins", 1, 0, radial_distribution);
        BINS("bins", 1, 65537, radial_distribution);
        out = NULL;
        BINS("out", 1, 4, radial_distribution);
        REFUSED(INVALID, "positions",
            azulejo_plane_radial_distribution(context, PLANE(*noise, 1, low, high, 0), 1, 4, density));
    }
#undef BINS

    REFUSED(INVALID, "positions", azulejo_spectrum_create(context, PLANE(NULL, 0, low, high, 0), 16, 1, &spectrum));
    REFUSED(INVALID, "size", azulejo_spectrum_create(context, PLANE(*noise, RANDOM, low, high, 0), 0, 1, &spectrum));
    REFUSED(INVALID, "size",
            azulejo_spectrum_create(context, PLANE(*noise, RANDOM, low, high, 0), UINT32_MAX, 1, &spectrum));
    REFUSED(INVALID, "stride", azulejo_spectrum_create(context, PLANE(*noise, RANDOM, low, high, 0), 16, 0, &spectrum));
    REFUSED(INVALID, "stride",
            azulejo_spectrum_create(context, PLANE(*noise, RANDOM, low, high, 0), 16, UINT32_MAX, &spectrum));
    REFUSED(INVALID, "out", azulejo_spectrum_create(context, PLANE(*noise, RANDOM, low, high, 0), 16, 1, NULL));
    CHECK(spectrum == UNTOUCHED && histogram[0] == 7 && density[3] == 7);
    CHECK(memcmp(&report, &report_before, sizeof report) == 0);
    CHECK(memcmp(&coverage, &coverage_before, sizeof coverage) == 0);
}

static void refused_spectra(void) {
    azulejo_spectrum *spectrum = NULL, *mean = UNTOUCHED;
    const azulejo_spectrum *none[1] = {NULL};
    azulejo_spectrum_report report = spectrum_report();
    azulejo_annulus annulus;
    azulejo_coverage_report coverage = coverage_report();
    size_t count = 7;
    ACCEPTED(azulejo_spectrum_create(context, PLANE(*noise, RANDOM, low, high, 0), 16, 1, &spectrum));
    REFUSED(INVALID, "spectra", azulejo_spectrum_mean(NULL, 1, &mean));
    REFUSED(INVALID, "spectra: [0]", azulejo_spectrum_mean(none, 1, &mean));
    REFUSED(INVALID, "periodograms", azulejo_spectrum_mean(none, 0, &mean));
    REFUSED(TOO_LARGE, "count", azulejo_spectrum_mean(none, SIZE_MAX, &mean));
    REFUSED(INVALID, "spectrum", azulejo_spectrum_radial(NULL, 0.1, &annulus, 1, sizeof(azulejo_annulus), &count));
    REFUSED(INVALID, "width", azulejo_spectrum_radial(spectrum, 0, &annulus, 1, sizeof(azulejo_annulus), &count));
    REFUSED(INVALID, "annuli", azulejo_spectrum_radial(spectrum, 0.1, NULL, 1, sizeof(azulejo_annulus), &count));
    REFUSED(INVALID, "out_count", azulejo_spectrum_radial(spectrum, 0.1, &annulus, 1, sizeof(azulejo_annulus), NULL));
    REFUSED(INVALID, "spectrum", azulejo_spectrum_measure(NULL, 0.1, 0, 1, &report));
    REFUSED(INVALID, "width", azulejo_spectrum_measure(spectrum, NAN, 0, 1, &report));
    REFUSED(INVALID, "low", azulejo_spectrum_measure(spectrum, 0.1, NAN, 1, &report));
    REFUSED(INVALID, "high", azulejo_spectrum_measure(spectrum, 0.1, 0, INFINITY, &report));
    REFUSED(INVALID, "out", azulejo_spectrum_measure(spectrum, 0.1, 0, 1, NULL));
    CHECK(mean == UNTOUCHED && count == 7);
    CHECK(azulejo_spectrum_size(NULL) == 0 && azulejo_spectrum_power(NULL) == NULL);
    azulejo_spectrum_free(spectrum);
    azulejo_spectrum_free(NULL);

    REFUSED(INVALID, "context", azulejo_mesh_coverage(NULL, cube, cube_positions[0], 8, 0.1, &coverage));
    REFUSED(INVALID, "mesh", azulejo_mesh_coverage(context, NULL, cube_positions[0], 8, 0.1, &coverage));
    REFUSED(INVALID, "positions", azulejo_mesh_coverage(context, cube, NULL, 8, 0.1, &coverage));
    REFUSED(TOO_LARGE, "count", azulejo_mesh_coverage(context, cube, cube_positions[0], SIZE_MAX, 0.1, &coverage));
    REFUSED(INVALID, "radius", azulejo_mesh_coverage(context, cube, cube_positions[0], 8, -1, &coverage));
    REFUSED(TOO_LARGE, "radius", azulejo_mesh_coverage(context, cube, cube_positions[0], 8, 1e-9, &coverage));
    REFUSED(INVALID, "out", azulejo_mesh_coverage(context, cube, cube_positions[0], 8, 0.1, NULL));
}

static void refused_measures(void) {
    float xyz[6] = {0.1f, 0.1f, 0.5f, 0.6f, 0.2f, 0.5f};
    double out = 7;

    REFUSES_PLANES(azulejo_plane_smallest_distance, &out);
    REFUSES_PLANES(azulejo_plane_covering_radius, &out);
    REFUSED(INVALID, "out", azulejo_plane_smallest_distance(context, PLANE(xyz, 3, low, high, 0), NULL));
    REFUSED(INVALID, "out", azulejo_plane_covering_radius(context, PLANE(xyz, 3, low, high, 0), NULL));

    REFUSED(INVALID, "context", azulejo_space_smallest_distance(NULL, xyz, 2, &out));
    REFUSED(INVALID, "positions", azulejo_space_smallest_distance(context, NULL, 2, &out));
    REFUSED(INVALID, "out", azulejo_space_smallest_distance(context, xyz, 2, NULL));
    REFUSED(TOO_LARGE, "count", azulejo_space_smallest_distance(context, xyz, SIZE_MAX / 3, &out));

    REFUSED(INVALID, "context", azulejo_mesh_uncovered_fraction(NULL, cube, xyz, 2, 0.1, 10, 0, &out));
    REFUSED(INVALID, "mesh", azulejo_mesh_uncovered_fraction(context, NULL, xyz, 2, 0.1, 10, 0, &out));
    REFUSED(INVALID, "positions", azulejo_mesh_uncovered_fraction(context, cube, NULL, 2, 0.1, 10, 0, &out));
    REFUSED(INVALID, "out", azulejo_mesh_uncovered_fraction(context, cube, xyz, 2, 0.1, 10, 0, NULL));
    REFUSED(INVALID, "radius", azulejo_mesh_uncovered_fraction(context, cube, xyz, 2, NAN, 10, 0, &out));
    REFUSED(INVALID, "radius", azulejo_mesh_uncovered_fraction(context, cube, xyz, 2, -1, 10, 0, &out));
    REFUSED(INVALID, "probes", azulejo_mesh_uncovered_fraction(context, cube, xyz, 2, 0.1, 0, 0, &out));

    xyz[2] = NAN;
    REFUSED(INVALID, "positions", azulejo_plane_smallest_distance(context, PLANE(xyz, 3, low, high, 0), &out));
    REFUSED(INVALID, "positions", azulejo_space_smallest_distance(context, xyz, 2, &out));
    REFUSED(INVALID, "positions", azulejo_mesh_uncovered_fraction(context, cube, xyz, 2, 0.1, 10, 0, &out));
    CHECK(out == 7);
}

int main(void) {
    context = make_context(2);
    cube = make_cube();
    make_sets();
    planes();
    spaces();
    spaces_of_waves();
    distributions();
    spectra();
    surfaces();
    refused_sets();
    refused_spectra();
    refused_measures();
    azulejo_mesh_free(cube);
    azulejo_context_free(context);
    return finish();
}
