/* What several test programs start from: contexts, options that are in order, a small mesh. */

#ifndef AZULEJO_TESTS_SAMPLES_H
#define AZULEJO_TESTS_SAMPLES_H

#include "check.h"

/* The unit cube, wound outwards. */
static const float cube_positions[8][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0},
                                           {0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}};
static const uint32_t cube_indices[12][3] = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                                             {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};

static inline azulejo_context *make_context(uint32_t num_threads) {
    azulejo_context *context = NULL;
    if (!ACCEPTED(azulejo_context_create(num_threads, &context))) exit(finish());
    return context;
}

static inline azulejo_mesh *make_cube(void) {
    azulejo_mesh *mesh = NULL;
    if (!ACCEPTED(azulejo_mesh_create(&cube_positions[0][0], 8, sizeof *cube_positions, &cube_indices[0][0], 12, &mesh)))
        exit(finish());
    return mesh;
}

static inline azulejo_kdrt_options kdrt_options(double radius) {
    azulejo_kdrt_options options;
    ACCEPTED(azulejo_kdrt_options_init(&options, sizeof options));
    options.radius = radius;
    return options;
}

static inline azulejo_maximal_options maximal_options(double radius) {
    azulejo_maximal_options options;
    ACCEPTED(azulejo_maximal_options_init(&options, sizeof options));
    options.radius = radius;
    return options;
}

static inline azulejo_kdrt_merge_options merge_options(double radius) {
    azulejo_kdrt_merge_options options;
    ACCEPTED(azulejo_kdrt_merge_options_init(&options, sizeof options));
    options.radius = radius;
    return options;
}

static inline azulejo_volume_options volume_options(double radius) {
    azulejo_volume_options options;
    ACCEPTED(azulejo_volume_options_init(&options, sizeof options));
    options.radius = radius;
    return options;
}

static inline azulejo_thin_options thin_options(double radius, size_t count, uint32_t order) {
    azulejo_thin_options options;
    ACCEPTED(azulejo_thin_options_init(&options, sizeof options));
    options.radius = radius;
    options.count = count;
    options.order = order;
    return options;
}

static inline azulejo_psp_options psp_options(double radius) {
    azulejo_psp_options options;
    ACCEPTED(azulejo_psp_options_init(&options, sizeof options));
    options.radius = radius;
    return options;
}

static inline azulejo_dcr_options dcr_options(uint32_t max_iterations) {
    azulejo_dcr_options options;
    ACCEPTED(azulejo_dcr_options_init(&options, sizeof options));
    options.max_iterations = max_iterations;
    return options;
}

/* Reports that calls can write. */
static inline azulejo_kdrt_report kdrt_report(void) {
    azulejo_kdrt_report report;
    ACCEPTED(azulejo_kdrt_report_init(&report, sizeof report));
    return report;
}

static inline azulejo_kdrt_merge_report merge_report(void) {
    azulejo_kdrt_merge_report report;
    ACCEPTED(azulejo_kdrt_merge_report_init(&report, sizeof report));
    return report;
}

static inline azulejo_psp_report psp_report(void) {
    azulejo_psp_report report;
    ACCEPTED(azulejo_psp_report_init(&report, sizeof report));
    return report;
}

static inline azulejo_dcr_report dcr_report(void) {
    azulejo_dcr_report report;
    ACCEPTED(azulejo_dcr_report_init(&report, sizeof report));
    return report;
}

static inline azulejo_dcr_surface_report surface_report(void) {
    azulejo_dcr_surface_report report;
    ACCEPTED(azulejo_dcr_surface_report_init(&report, sizeof report));
    return report;
}

static inline azulejo_plane_report plane_report(void) {
    azulejo_plane_report report;
    ACCEPTED(azulejo_plane_report_init(&report, sizeof report));
    return report;
}

static inline azulejo_space_report space_report(void) {
    azulejo_space_report report;
    ACCEPTED(azulejo_space_report_init(&report, sizeof report));
    return report;
}

static inline azulejo_coverage_report coverage_report(void) {
    azulejo_coverage_report report;
    ACCEPTED(azulejo_coverage_report_init(&report, sizeof report));
    return report;
}

static inline azulejo_spectrum_report spectrum_report(void) {
    azulejo_spectrum_report report;
    ACCEPTED(azulejo_spectrum_report_init(&report, sizeof report));
    return report;
}

/* Makes a report one that no call has written: its size is right, all else is garbage. */
#define UNWRITTEN(report) (memset(&(report), 0x55, sizeof(report)), (void)((report).struct_size = sizeof(report)))

static inline azulejo_plane_set plane_set(const float *positions, size_t count, const double *domain_min,
                                          const double *domain_max, uint32_t boundary) {
    azulejo_plane_set set;
    ACCEPTED(azulejo_plane_set_init(&set, sizeof set));
    set.positions = positions;
    set.count = count;
    set.boundary = boundary;
    memcpy(set.domain_min, domain_min, sizeof set.domain_min);
    memcpy(set.domain_max, domain_max, sizeof set.domain_max);
    return set;
}

/* A plane set as an argument. */
#define PLANE(...) ((const azulejo_plane_set[1]){plane_set(__VA_ARGS__)})

/* Random points of the unit square, the same ones on every machine. */
static inline void random_points(float *xy, size_t count) {
    uint32_t state = 1;
    size_t i;
    for (i = 0; i < 2 * count; i++) {
        state = state * 1664525u + 1013904223u;
        xy[i] = (float)(state >> 8) / (1 << 24);
    }
}

/* Whether two sets are the same, byte for byte. */
static inline int same_points(const azulejo_points *a, const azulejo_points *b) {
    const size_t count = azulejo_points_count(a), dimension = azulejo_points_dimension(a);
    if (count != azulejo_points_count(b) || dimension != azulejo_points_dimension(b)) return 0;
    if (count == 0) return 1;
    if (memcmp(azulejo_points_positions(a), azulejo_points_positions(b), 4 * dimension * count) != 0) return 0;
    return dimension == 2 ||
           (memcmp(azulejo_points_normals(a), azulejo_points_normals(b), 12 * count) == 0 &&
            memcmp(azulejo_points_triangles(a), azulejo_points_triangles(b), 4 * count) == 0 &&
            memcmp(azulejo_points_barycentrics(a), azulejo_points_barycentrics(b), 8 * count) == 0);
}

/* Planes off the origin, and not square: at a radius of 0.005 one that is tiled, of about 46,000 samples, at 0.05 one that
   is made as a whole. */
static inline azulejo_kdrt_options plane_options(uint32_t boundary, double radius) {
    azulejo_kdrt_options options = kdrt_options(radius);
    options.boundary = boundary;
    options.domain_min[0] = -1.5;
    options.domain_max[0] = 0.15;
    options.leaf_size = 8;
    options.seed = 5;
    return options;
}

/* Whether a window has the samples of the whole that lie in it, in their order. */
static inline int is_part(const azulejo_points *window, const azulejo_points *whole, double left, double bottom,
                          double right, double top) {
    const float *xy = azulejo_points_positions(whole), *found = azulejo_points_positions(window);
    size_t i, count = 0;
    for (i = 0; i < azulejo_points_count(whole); i++, xy += 2) {
        if (!(left <= xy[0] && xy[0] < right && bottom <= xy[1] && xy[1] < top)) continue;
        if (count == azulejo_points_count(window) || memcmp(xy, found + 2 * count, 8) != 0) return 0;
        count++;
    }
    return count == azulejo_points_count(window);
}

#endif
