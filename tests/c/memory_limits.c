/* Under any limit of address space (ulimit -v) a call succeeds or is refused with AZULEJO_ERROR_TOO_LARGE: it never aborts
   the process. And it is not refused where 1.3 times its peak is free (MOST_ASKED). Each call runs in a child process,
   whose limit leaves so much more than the child has; a refused call says what it needs, which is the next child's limit.

   memory_limits COUNT... prints the peaks of all calls for so many samples, or for as many as are tested if that is 0,
   and what they ask for: docs/design/memory.md.

   glibc gives a thread an arena of 64 MB of address space if it finds them at an aligned place, sooner or later, which
   nothing can foresee: calls of two threads abort then, now and again. So they are tested with one arena for both. */

#ifdef __linux__
#include <malloc.h>
#endif
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "samples.h"

#define MOST 4000000

/* Quads along a side of hilly squares: of many triangles, and of few. */
#define MANY 512
#define FEW 8
#define VERTICES(side) ((size_t)((side) + 1) * ((side) + 1))

/* What calls are given: random points of the unit square and of the unit cube, meshes, a density for each vertex of the
   square of few triangles, and a picture on it. */
static float cloud[3 * MOST];
static uint32_t class_of[MOST];
static float vertices[VERTICES(MANY)][3], weights[VERTICES(FEW)], texture[VERTICES(FEW)][2], picture[64][64];
static uint32_t indices[MANY * MANY][2][3];
static azulejo_mesh *cube, *hilly, *sheet;

/* A call that makes or takes about so many samples. */
typedef azulejo_status (*call)(const azulejo_context *context, size_t count);

static azulejo_status freed(azulejo_status status, azulejo_points *points) {
    azulejo_points_free(points);
    return status;
}

/* The radius of so many samples on an area. */
static double radius_of(size_t count, double area) { return sqrt(0.6966 * area / (double)count); }

static azulejo_status maximal(const azulejo_context *context, size_t count) {
    const azulejo_maximal_options o = maximal_options(radius_of(count, 1));
    azulejo_points *points = NULL;
    return freed(azulejo_maximal_sample(context, &o, &points, NULL), points);
}

static azulejo_status of_cube(const azulejo_context *context, const azulejo_volume_options *options) {
    azulejo_points *points = NULL;
    return freed(azulejo_volume_sample(context, options, &points, NULL), points);
}

static double volume_radius(size_t count) { return cbrt(0.7336 / (double)count); }

static azulejo_status volume(const azulejo_context *context, size_t count) {
    const azulejo_volume_options o = volume_options(volume_radius(count));
    return of_cube(context, &o);
}

static azulejo_status volume_tiled(const azulejo_context *context, size_t count) {
    azulejo_volume_options o = volume_options(volume_radius(count));
    o.leaf_size = 20;
    return of_cube(context, &o);
}

/* Of radii that grow along x by a ratio, which jump back at the seam of the torus. The mean of 1 / radius^3 is
   (1 + ratio) / (2 ratio^2) in least radii. */
static azulejo_status volume_ramp(const azulejo_context *context, size_t count, double ratio) {
    const double least = cbrt(0.7336 * (1 + ratio) / (2 * ratio * ratio) / (double)count);
    const float radii[2] = {(float)least, (float)(ratio * least)};
    azulejo_volume_adaptive_options o;
    azulejo_points *points = NULL;
    ACCEPTED(azulejo_volume_adaptive_options_init(&o, sizeof o));
    o.grid_values = radii;
    o.grid_size[0] = 2;
    o.grid_size[1] = o.grid_size[2] = 1;
    return freed(azulejo_volume_adaptive_sample(context, NULL, &o, &points, NULL), points);
}

static azulejo_status volume_adaptive(const azulejo_context *c, size_t n) { return volume_ramp(c, n, 2.1); }
static azulejo_status volume_steep(const azulejo_context *c, size_t n) { return volume_ramp(c, n, 64); }

/* Of the cube, which has a volume of 1, or of a shell of it. */
static azulejo_status inside_cube(const azulejo_context *context, double radius, double thickness) {
    azulejo_volume_inside_options o;
    azulejo_points *points = NULL;
    ACCEPTED(azulejo_volume_inside_options_init(&o, sizeof o));
    o.radius = radius;
    o.thickness = thickness;
    return freed(azulejo_volume_sample_inside(context, cube, &o, &points, NULL), points);
}

static azulejo_status volume_inside(const azulejo_context *context, size_t count) {
    return inside_cube(context, volume_radius(count), 0);
}

/* A shell with a volume of .488. */
static azulejo_status volume_shell(const azulejo_context *context, size_t count) {
    return inside_cube(context, volume_radius(count) * cbrt(0.488), 0.1);
}

static azulejo_status volume_progressive(const azulejo_context *context, size_t count) {
    azulejo_volume_options o = volume_options(volume_radius(count));
    o.order = AZULEJO_ORDER_PROGRESSIVE;
    return of_cube(context, &o);
}

static azulejo_status volume_count(const azulejo_context *context, size_t count) {
    azulejo_volume_options o = volume_options(0);
    o.count = count;
    return of_cube(context, &o);
}

static azulejo_status volume_count_progressive(const azulejo_context *context, size_t count) {
    azulejo_volume_options o = volume_options(0);
    o.count = count;
    o.order = AZULEJO_ORDER_PROGRESSIVE;
    return of_cube(context, &o);
}

static azulejo_status around_in_cube(const azulejo_context *context, size_t count, size_t given_count) {
    azulejo_volume_options o = volume_options(volume_radius(count));
    o.given_positions = cloud;
    o.given_count = given_count;
    return of_cube(context, &o);
}

static azulejo_status volume_around(const azulejo_context *context, size_t count) {
    return around_in_cube(context, count, count / 4);
}

static azulejo_status volume_around_many(const azulejo_context *context, size_t count) {
    return around_in_cube(context, count, 20 * count);
}

static azulejo_status of_plane(const azulejo_context *context, const azulejo_kdrt_options *options) {
    azulejo_points *points = NULL;
    return freed(azulejo_kdrt_sample(context, options, &points, NULL), points);
}

static azulejo_status tiled(const azulejo_context *context, size_t count) {
    const azulejo_kdrt_options o = kdrt_options(radius_of(count, 1));
    return of_plane(context, &o);
}

static azulejo_status not_tiled(const azulejo_context *context, size_t count) {
    azulejo_kdrt_options o = kdrt_options(1);
    o.domain_max[0] = 10;
    o.domain_max[1] = (double)count / 6.966;
    return of_plane(context, &o);
}

static azulejo_status plane_around(const azulejo_context *context, size_t count) {
    azulejo_kdrt_options o = kdrt_options(radius_of(count, 1));
    o.given_positions = cloud;
    o.given_count = count / 4;
    return of_plane(context, &o);
}

static azulejo_status plane_progressive(const azulejo_context *context, size_t count) {
    azulejo_kdrt_options o = kdrt_options(radius_of(count, 1));
    o.order = AZULEJO_ORDER_PROGRESSIVE;
    return of_plane(context, &o);
}

static azulejo_status plane_count(const azulejo_context *context, size_t count) {
    azulejo_kdrt_options o = kdrt_options(0);
    o.count = count;
    return of_plane(context, &o);
}

static azulejo_status plane_count_progressive(const azulejo_context *context, size_t count) {
    azulejo_kdrt_options o = kdrt_options(0);
    o.count = count;
    o.order = AZULEJO_ORDER_PROGRESSIVE;
    return of_plane(context, &o);
}

static azulejo_status window(const azulejo_context *context, size_t count) {
    const double min[2] = {0.1, 0.1}, max[2] = {0.8, 0.8};
    const azulejo_kdrt_options o = kdrt_options(radius_of(count, 0.49));
    azulejo_points *points = NULL;
    return freed(azulejo_kdrt_sample_window(context, &o, min, max, &points, NULL), points);
}

static azulejo_classes classes_of(double *radii, uint32_t classes, const double *own) {
    azulejo_classes of;
    ACCEPTED(azulejo_classes_init(&of, sizeof of));
    ACCEPTED(azulejo_classes_radii(own, classes, 1, radii));
    of.count = classes;
    of.radii = radii;
    return of;
}

static azulejo_status plane_of_classes(const azulejo_context *context, size_t count, uint32_t number, uint32_t order) {
    const double r = radius_of(count, 1), own[4] = {2 * r, r, r, r};
    double radii[16];
    const azulejo_classes of = classes_of(radii, number, own);
    azulejo_kdrt_options o = kdrt_options(0);
    azulejo_points *points = NULL;
    o.order = order;
    return freed(azulejo_kdrt_sample_classes(context, &o, &of, &points, NULL), points);
}

static azulejo_status plane_classes(const azulejo_context *context, size_t count) {
    return plane_of_classes(context, count, 2, AZULEJO_ORDER_ANY);
}

static azulejo_status plane_classes_narrow(const azulejo_context *context, size_t count) {
    const double own[2] = {2, 1};
    double radii[4];
    const azulejo_classes of = classes_of(radii, 2, own);
    azulejo_kdrt_options o = kdrt_options(0);
    azulejo_points *points = NULL;
    o.domain_max[0] = 8;
    o.domain_max[1] = (double)count / 5.57;
    return freed(azulejo_kdrt_sample_classes(context, &o, &of, &points, NULL), points);
}

static azulejo_status volume_of_classes(const azulejo_context *context, size_t count, double larger) {
    const double r = volume_radius(count), own[2] = {larger * r, r};
    double radii[4];
    const azulejo_classes of = classes_of(radii, 2, own);
    const azulejo_volume_options o = volume_options(0);
    azulejo_points *points = NULL;
    return freed(azulejo_volume_sample_classes(context, &o, &of, &points, NULL), points);
}

static azulejo_status volume_classes(const azulejo_context *c, size_t n) { return volume_of_classes(c, n, 1.5); }
static azulejo_status volume_equal_classes(const azulejo_context *c, size_t n) { return volume_of_classes(c, n, 1); }

static azulejo_status plane_4_classes(const azulejo_context *context, size_t count) {
    return plane_of_classes(context, count, 4, AZULEJO_ORDER_ANY);
}

static azulejo_status plane_classes_progressive(const azulejo_context *context, size_t count) {
    return plane_of_classes(context, count, 2, AZULEJO_ORDER_PROGRESSIVE);
}

/* Two halves of a set are merged. They are made before, with the same memory. */
static azulejo_status merged(const azulejo_context *context, size_t count) {
    const double r = radius_of(count, 1);
    const azulejo_kdrt_merge_options o = merge_options(r);
    azulejo_kdrt_options half = kdrt_options(r);
    azulejo_kdrt_merge_piece pieces[2];
    azulejo_points *points = NULL, *halves[2] = {NULL, NULL};
    azulejo_status status = AZULEJO_OK;
    unsigned i;
    half.boundary = AZULEJO_BOUNDARY_BOUNDED;
    for (i = 0; i < 2 && status == AZULEJO_OK; i++) {
        half.domain_min[0] = i / 2.0;
        half.domain_max[0] = (i + 1) / 2.0;
        status = azulejo_kdrt_sample(context, &half, &halves[i], NULL);
        memset(&pieces[i], 0, sizeof pieces[i]);
        pieces[i].positions = azulejo_points_positions(halves[i]);
        pieces[i].count = azulejo_points_count(halves[i]);
        memcpy(pieces[i].min, half.domain_min, sizeof pieces[i].min);
        memcpy(pieces[i].max, half.domain_max, sizeof pieces[i].max);
    }
    if (status == AZULEJO_OK)
        status = azulejo_kdrt_merge(context, &o, pieces, 2, sizeof *pieces, NULL, 0, &points, NULL);
    for (i = 0; i < 2; i++) azulejo_points_free(halves[i]);
    return freed(status, points);
}

/* Options for so many samples on the cube. */
static azulejo_psp_options cube_options(size_t count) { return psp_options(radius_of(count, 6)); }

static azulejo_status of_mesh(const azulejo_context *context, const azulejo_mesh *mesh, const azulejo_psp_options *o) {
    azulejo_points *points = NULL;
    return freed(azulejo_psp_sample(context, mesh, o, &points, NULL), points);
}

static azulejo_status mesh_plain(const azulejo_context *context, size_t count) {
    const azulejo_psp_options o = cube_options(count);
    return of_mesh(context, cube, &o);
}

/* As many triangles as fit the large mesh: half a million. */
static azulejo_status mesh_hilly(const azulejo_context *context, size_t count) {
    const azulejo_psp_options o = psp_options(radius_of(count, azulejo_mesh_area(hilly)));
    return of_mesh(context, hilly, &o);
}

static azulejo_status mesh_iterated(const azulejo_context *context, size_t count) {
    azulejo_psp_options o = cube_options(count);
    o.iterations = 2;
    o.engine = AZULEJO_ENGINE_RASTERISER;
    return of_mesh(context, cube, &o);
}

static azulejo_status mesh_progressive(const azulejo_context *context, size_t count) {
    azulejo_psp_options o = cube_options(count);
    o.order = AZULEJO_ORDER_PROGRESSIVE;
    return of_mesh(context, cube, &o);
}

static azulejo_status mesh_count(const azulejo_context *context, size_t count) {
    azulejo_psp_options o = psp_options(0);
    o.count = count;
    return of_mesh(context, cube, &o);
}

static azulejo_status mesh_count_progressive(const azulejo_context *context, size_t count) {
    azulejo_psp_options o = psp_options(0);
    o.count = count;
    o.order = AZULEJO_ORDER_PROGRESSIVE;
    return of_mesh(context, cube, &o);
}

static azulejo_status mesh_around(const azulejo_context *context, size_t count) {
    azulejo_psp_options o = cube_options(count);
    o.given_positions = cloud;
    o.given_count = count / 4;
    return of_mesh(context, cube, &o);
}

static azulejo_status mesh_around_many(const azulejo_context *context, size_t count) {
    azulejo_psp_options o = cube_options(count / 4);
    o.given_positions = cloud;
    o.given_count = count;
    return of_mesh(context, cube, &o);
}

static azulejo_status mesh_of_classes(const azulejo_context *context, size_t count, uint32_t order) {
    const double r = radius_of(count, 6), own[2] = {2 * r, r};
    double radii[4];
    const azulejo_classes of = classes_of(radii, 2, own);
    azulejo_psp_options o = psp_options(0);
    azulejo_points *points = NULL;
    o.order = order;
    return freed(azulejo_psp_sample_classes(context, cube, &o, &of, &points, NULL), points);
}

static azulejo_status mesh_classes(const azulejo_context *context, size_t count) {
    return mesh_of_classes(context, count, AZULEJO_ORDER_ANY);
}

static azulejo_status mesh_classes_progressive(const azulejo_context *context, size_t count) {
    return mesh_of_classes(context, count, AZULEJO_ORDER_PROGRESSIVE);
}

/* Two classes that follow a density, the smaller one by itself with as many samples. */
static azulejo_status classes_of_density(const azulejo_context *context, size_t count, uint32_t order) {
    const double own[2] = {2, 1};
    double radii[4];
    const azulejo_classes of = classes_of(radii, 2, own);
    azulejo_psp_options o = psp_options(0);
    azulejo_mesh_density density;
    azulejo_points *points = NULL;
    ACCEPTED(azulejo_mesh_density_init(&density, sizeof density));
    density.vertex_values = weights;
    density.vertex_count = COUNT_OF(weights);
    density.count = (double)count;
    o.order = order;
    return freed(azulejo_psp_classes_with_density(context, sheet, &o, &of, &density, &points, NULL), points);
}

static azulejo_status mesh_classes_density(const azulejo_context *context, size_t count) {
    return classes_of_density(context, count, AZULEJO_ORDER_ANY);
}

static azulejo_status mesh_classes_density_progressive(const azulejo_context *context, size_t count) {
    return classes_of_density(context, count, AZULEJO_ORDER_PROGRESSIVE);
}

static azulejo_status of_handle(const azulejo_context *context, size_t count) {
    const azulejo_psp_options o = cube_options(count);
    azulejo_psp *psp = NULL;
    azulejo_points *points = NULL;
    azulejo_status status = azulejo_psp_create(context, cube, &o, &psp);
    if (status == AZULEJO_OK) status = azulejo_psp_fill(psp, NULL);
    if (status == AZULEJO_OK) status = azulejo_psp_points(psp, &points);
    azulejo_psp_free(psp);
    return freed(status, points);
}

/* A set that is erased where it is low and filled again. */
static azulejo_status edited(const azulejo_context *context, size_t count) {
    const azulejo_psp_options o = cube_options(count);
    azulejo_region region;
    azulejo_psp *psp = NULL;
    azulejo_status status = azulejo_psp_create(context, cube, &o, &psp);
    ACCEPTED(azulejo_region_init(&region, sizeof region));
    region.max[2] = 0.2;
    if (status == AZULEJO_OK) status = azulejo_psp_fill(psp, NULL);
    if (status == AZULEJO_OK) status = azulejo_psp_erase(psp, &region, NULL);
    if (status == AZULEJO_OK) status = azulejo_psp_refill(psp, 1, NULL, NULL);
    azulejo_psp_free(psp);
    return status;
}

static azulejo_status in_region(const azulejo_context *context, size_t count) {
    const azulejo_psp_options o = cube_options(2 * count);
    azulejo_region region;
    azulejo_points *points = NULL;
    ACCEPTED(azulejo_region_init(&region, sizeof region));
    region.max[0] = 0.5;
    return freed(azulejo_psp_sample_region(context, cube, &o, &region, &points, NULL), points);
}

static azulejo_status radii_by_vertex(const azulejo_context *context, size_t count, uint32_t order) {
    const double r = radius_of(count, 6);
    float radii[8];
    azulejo_psp_adaptive_options o;
    azulejo_points *points = NULL;
    unsigned i;
    for (i = 0; i < 8; i++) radii[i] = (float)(i < 4 ? 0.8 * r : 1.3 * r);
    ACCEPTED(azulejo_psp_adaptive_options_init(&o, sizeof o));
    o.vertex_radii = radii;
    o.vertex_count = 8;
    o.order = order;
    return freed(azulejo_psp_adaptive_sample(context, cube, &o, &points, NULL), points);
}

static azulejo_status varying(const azulejo_context *context, size_t count) {
    return radii_by_vertex(context, count, AZULEJO_ORDER_ANY);
}

static azulejo_status varying_progressive(const azulejo_context *context, size_t count) {
    return radii_by_vertex(context, count, AZULEJO_ORDER_PROGRESSIVE);
}

static azulejo_status of_density(const azulejo_context *context, size_t count, int is_picture, uint32_t order) {
    azulejo_psp_adaptive_options o;
    azulejo_mesh_density density;
    azulejo_points *points = NULL;
    ACCEPTED(azulejo_psp_adaptive_options_init(&o, sizeof o));
    ACCEPTED(azulejo_mesh_density_init(&density, sizeof density));
    o.order = order;
    density.count = (double)count;
    if (is_picture) {
        density.image = &picture[0][0];
        density.width = density.height = 64;
        density.texture = &texture[0][0];
        density.texture_count = COUNT_OF(texture);
    } else {
        density.vertex_values = weights;
        density.vertex_count = COUNT_OF(weights);
    }
    return freed(azulejo_psp_adaptive_with_density(context, sheet, &o, &density, &points, NULL), points);
}

static azulejo_status density_by_vertex(const azulejo_context *context, size_t count) {
    return of_density(context, count, 0, AZULEJO_ORDER_ANY);
}

static azulejo_status density_by_picture(const azulejo_context *context, size_t count) {
    return of_density(context, count, 1, AZULEJO_ORDER_ANY);
}

static azulejo_status density_progressive(const azulejo_context *context, size_t count) {
    return of_density(context, count, 0, AZULEJO_ORDER_PROGRESSIVE);
}

static azulejo_status relaxed_by(const azulejo_context *context, size_t count, uint32_t boundary, uint32_t neighbourhood,
                                 uint32_t method) {
    azulejo_dcr_options o = dcr_options(2);
    azulejo_points *points = NULL;
    o.boundary = boundary;
    o.neighbourhood = neighbourhood;
    o.method = method;
    return freed(azulejo_dcr_relax(context, &o, cloud, count, &points, NULL), points);
}

static azulejo_status relaxed(const azulejo_context *context, size_t count) {
    return relaxed_by(context, count, AZULEJO_BOUNDARY_PERIODIC, AZULEJO_NEIGHBOURHOOD_DELAUNAY, AZULEJO_METHOD_MOMENTUM);
}

static azulejo_status relaxed_nearest(const azulejo_context *context, size_t count) {
    return relaxed_by(context, count, AZULEJO_BOUNDARY_PERIODIC, AZULEJO_NEIGHBOURHOOD_NEAREST, AZULEJO_METHOD_MOMENTUM);
}

static azulejo_status relaxed_thesis(const azulejo_context *context, size_t count) {
    return relaxed_by(context, count, AZULEJO_BOUNDARY_PERIODIC, AZULEJO_NEIGHBOURHOOD_DELAUNAY, AZULEJO_METHOD_THESIS);
}

/* A bounded domain is mirrored at its sides. */
static azulejo_status relaxed_bounded(const azulejo_context *context, size_t count) {
    return relaxed_by(context, count, AZULEJO_BOUNDARY_BOUNDED, AZULEJO_NEIGHBOURHOOD_DELAUNAY, AZULEJO_METHOD_MOMENTUM);
}

static azulejo_status relaxed_bounded_nearest(const azulejo_context *context, size_t count) {
    return relaxed_by(context, count, AZULEJO_BOUNDARY_BOUNDED, AZULEJO_NEIGHBOURHOOD_NEAREST, AZULEJO_METHOD_MOMENTUM);
}

static azulejo_status relaxed_bounded_thesis(const azulejo_context *context, size_t count) {
    return relaxed_by(context, count, AZULEJO_BOUNDARY_BOUNDED, AZULEJO_NEIGHBOURHOOD_DELAUNAY, AZULEJO_METHOD_THESIS);
}

static azulejo_status relaxed_to_correlation(const azulejo_context *context, size_t count) {
    azulejo_dcr_options o = dcr_options(2);
    azulejo_points *points = NULL;
    const double none = 0.0;
    double correlation[256];
    azulejo_status status = azulejo_dcr_correlation_of_power(0.5, &none, 1, 12.0, 256, correlation);
    if (status != AZULEJO_OK) return status;
    return freed(azulejo_dcr_relax_to_correlation(context, &o, cloud, count, 12.0, correlation, 256, NULL, &points, NULL),
                 points);
}

static azulejo_status relaxed_classes_on(const azulejo_context *context, size_t count, uint32_t boundary) {
    azulejo_dcr_options o = dcr_options(2);
    azulejo_points *points = NULL;
    o.boundary = boundary;
    return freed(azulejo_dcr_relax_classes(context, &o, cloud, class_of, count, 2, NULL, NULL, &points, NULL), points);
}

static azulejo_status relaxed_classes(const azulejo_context *context, size_t count) {
    return relaxed_classes_on(context, count, AZULEJO_BOUNDARY_PERIODIC);
}

static azulejo_status relaxed_classes_bounded(const azulejo_context *context, size_t count) {
    return relaxed_classes_on(context, count, AZULEJO_BOUNDARY_BOUNDED);
}

static azulejo_density of_picture(void) {
    azulejo_density density;
    ACCEPTED(azulejo_density_init(&density, sizeof density));
    density.values = &picture[0][0];
    density.width = density.height = 64;
    return density;
}

static azulejo_status scattered(const azulejo_context *context, size_t count) {
    const azulejo_dcr_options o = dcr_options(2);
    const azulejo_density density = of_picture();
    azulejo_points *points = NULL;
    return freed(azulejo_dcr_scatter(context, &o, &density, count, &points), points);
}

static azulejo_status relaxed_to(const azulejo_context *context, size_t count, uint32_t boundary) {
    azulejo_dcr_options o = dcr_options(2);
    const azulejo_density density = of_picture();
    azulejo_points *points = NULL;
    o.boundary = boundary;
    return freed(azulejo_dcr_relax_density(context, &o, &density, cloud, count, &points, NULL), points);
}

static azulejo_status relaxed_density(const azulejo_context *context, size_t count) {
    return relaxed_to(context, count, AZULEJO_BOUNDARY_PERIODIC);
}

static azulejo_status relaxed_density_bounded(const azulejo_context *context, size_t count) {
    return relaxed_to(context, count, AZULEJO_BOUNDARY_BOUNDED);
}

static azulejo_status relaxed_in_space(const azulejo_context *context, size_t count) {
    azulejo_volume_relax_options o;
    azulejo_points *points = NULL;
    ACCEPTED(azulejo_volume_relax_options_init(&o, sizeof o));
    o.max_iterations = 2;
    return freed(azulejo_volume_relax(context, &o, cloud, count, &points, NULL), points);
}

static azulejo_status relaxed_inside(const azulejo_context *context, size_t count) {
    azulejo_relax_inside_options o;
    azulejo_points *points = NULL;
    ACCEPTED(azulejo_relax_inside_options_init(&o, sizeof o));
    o.max_iterations = 2;
    return freed(azulejo_volume_relax_inside(context, cube, &o, cloud, count, &points, NULL), points);
}

/* The triangles are those of the cube in turn. */
static azulejo_status relaxed_on_mesh(const azulejo_context *context, size_t count) {
    static uint32_t triangles[MOST];
    static float barycentrics[2 * MOST];
    azulejo_dcr_surface_options o;
    azulejo_points *points = NULL;
    size_t i;
    for (i = 0; i < count; i++) {
        const int is_outside = cloud[2 * i] + cloud[2 * i + 1] > 1;
        triangles[i] = (uint32_t)(i % 12);
        barycentrics[2 * i] = is_outside ? 1 - cloud[2 * i] : cloud[2 * i];
        barycentrics[2 * i + 1] = is_outside ? 1 - cloud[2 * i + 1] : cloud[2 * i + 1];
    }
    ACCEPTED(azulejo_dcr_surface_options_init(&o, sizeof o));
    o.max_iterations = 2;
    return freed(azulejo_dcr_surface_relax(context, cube, &o, triangles, barycentrics, count, &points, NULL), points);
}

static azulejo_status thinned_to(const azulejo_context *context, size_t count, uint32_t dimension, size_t kept, double r,
                                 uint32_t order) {
    const azulejo_thin_options o = thin_options(r, kept, order);
    azulejo_selection *selection = NULL;
    const azulejo_status status = azulejo_thin(context, &o, cloud, count, dimension, &selection, NULL);
    azulejo_selection_free(selection);
    return status;
}

/* The filter of least reach, which takes the least time and the same memory. */
static azulejo_status masked(const azulejo_context *context, size_t count) {
    azulejo_mask_options o;
    azulejo_mask *mask = NULL;
    ACCEPTED(azulejo_mask_options_init(&o, sizeof o));
    o.width = 256;
    o.height = count / 256 / 64;
    o.channels = 64;
    o.sigma = 0.5;
    const azulejo_status status = azulejo_mask_create(context, &o, &mask, NULL);
    azulejo_mask_free(mask);
    return status;
}

static azulejo_status thinned(const azulejo_context *context, size_t count) {
    return thinned_to(context, count, 3, count / 10, 0, AZULEJO_ORDER_PROGRESSIVE);
}

static azulejo_status thinned_all(const azulejo_context *context, size_t count) {
    return thinned_to(context, count, 3, count, 0, AZULEJO_ORDER_PROGRESSIVE);
}

static azulejo_status thinned_plane(const azulejo_context *context, size_t count) {
    return thinned_to(context, count, 2, 0, radius_of(count / 4, 1), AZULEJO_ORDER_ANY);
}

/* The analysis of so many random points. */
static azulejo_plane_set cloud_in_plane(size_t count) {
    azulejo_plane_set set;
    ACCEPTED(azulejo_plane_set_init(&set, sizeof set));
    set.positions = cloud;
    set.count = count;
    return set;
}

static azulejo_status measured(const azulejo_context *context, size_t count) {
    const azulejo_plane_set set = cloud_in_plane(count);
    azulejo_plane_report report;
    ACCEPTED(azulejo_plane_report_init(&report, sizeof report));
    return azulejo_plane_measure(context, &set, &report);
}

static azulejo_status gaps_of_plane(const azulejo_context *context, size_t count, double radius) {
    const azulejo_plane_set set = cloud_in_plane(count);
    azulejo_coverage_report report;
    ACCEPTED(azulejo_coverage_report_init(&report, sizeof report));
    return azulejo_plane_coverage(context, &set, radius, &report);
}

static azulejo_status coverage_of_plane(const azulejo_context *context, size_t count) {
    return gaps_of_plane(context, count, 1);
}

/* No point covers more than itself. */
static azulejo_status all_gaps_of_plane(const azulejo_context *context, size_t count) {
    return gaps_of_plane(context, count, 1e-6);
}

static azulejo_status pairs_of_plane(const azulejo_context *context, size_t count) {
    const azulejo_plane_set set = cloud_in_plane(count);
    double density[16];
    return azulejo_plane_radial_distribution(context, &set, 1, COUNT_OF(density), density);
}

static azulejo_space_set cloud_in_space(size_t count) {
    azulejo_space_set set;
    ACCEPTED(azulejo_space_set_init(&set, sizeof set));
    set.positions = cloud;
    set.count = count;
    return set;
}

static azulejo_status measured_space(const azulejo_context *context, size_t count) {
    const azulejo_space_set set = cloud_in_space(count);
    azulejo_space_report report;
    ACCEPTED(azulejo_space_report_init(&report, sizeof report));
    return azulejo_space_measure(context, &set, 0, &report);
}

static azulejo_status coverage_of_space(const azulejo_context *context, size_t count) {
    const azulejo_space_set set = cloud_in_space(count);
    azulejo_coverage_report report;
    ACCEPTED(azulejo_coverage_report_init(&report, sizeof report));
    return azulejo_space_coverage(context, &set, 1, &report);
}

/* Of a few points that cover little, so that gaps have about so many places. */
static azulejo_status gaps_of_space(const azulejo_context *context, size_t count) {
    const azulejo_space_set set = cloud_in_space(8);
    azulejo_coverage_report report;
    ACCEPTED(azulejo_coverage_report_init(&report, sizeof report));
    return azulejo_space_coverage(context, &set, 13 / cbrt((double)count), &report);
}

static azulejo_status distance_in_space(const azulejo_context *context, size_t count) {
    double smallest;
    return azulejo_space_smallest_distance(context, cloud, count, &smallest);
}

static azulejo_status coverage_of_mesh(const azulejo_context *context, size_t count) {
    azulejo_coverage_report report;
    ACCEPTED(azulejo_coverage_report_init(&report, sizeof report));
    return azulejo_mesh_coverage(context, hilly, cloud, count, 1, &report);
}

static azulejo_status gaps_of_mesh(const azulejo_context *context, size_t count) {
    azulejo_coverage_report report;
    ACCEPTED(azulejo_coverage_report_init(&report, sizeof report));
    return azulejo_mesh_coverage(context, cube, cloud, 8, 26 / sqrt((double)count), &report);
}

static azulejo_status uncovered_of_mesh(const azulejo_context *context, size_t count) {
    double uncovered;
    return azulejo_mesh_uncovered_fraction(context, hilly, cloud, count, 0.01, 1000, 0, &uncovered);
}

/* So many frequencies along each axis that they are as many as the points. */
static azulejo_status spectrum_of_plane(const azulejo_context *context, size_t count) {
    const azulejo_plane_set set = cloud_in_plane(count);
    azulejo_spectrum *spectrum = NULL;
    const azulejo_status status = azulejo_spectrum_create(context, &set, (uint32_t)sqrt((double)count), 1, &spectrum);
    azulejo_spectrum_free(spectrum);
    return status;
}

static azulejo_status spectrum_of_space(const azulejo_context *context, size_t count) {
    const azulejo_space_set set = cloud_in_space(count);
    static azulejo_annulus annuli[256];
    size_t found;
    return azulejo_space_spectrum(context, &set, 1, 1, 0.05, annuli, COUNT_OF(annuli), sizeof *annuli, &found);
}

/* The most that a call asks for, over its peak, beside some MB for tables. More where arrays that double make peaks uneven,
   which also differ from one allocator to the next, and where radii vary: how finely that cuts triangles is only known
   afterwards. */
#define MOST_ASKED 1.3
#define SLACK ((size_t)4 << 20)
#define MOST_ASKED_UNEVENLY 1.7

/* The first limit, and the most demands of a call that asks again when it knows more. */
#define LEAST ((size_t)1 << 20)
#define MOST_DEMANDS 20

/* Around given samples it is not known before how many of them a block has. */
#define MOST_ASKED_AROUND 2

/* All calls, each with a number of samples for which it takes some tens of MB. */
static const struct {
    const char *name;
    call make;
    size_t count;
    double most;
} calls[] = {
    {"maximal", maximal, 250000, MOST_ASKED},
    {"volume", volume, 1000000, MOST_ASKED},
    {"volume, tiled", volume_tiled, 1000000, MOST_ASKED},
    {"volume, adaptive", volume_adaptive, 500000, MOST_ASKED_UNEVENLY},
    {"volume, adaptive, steep", volume_steep, 100000, MOST_ASKED_UNEVENLY},
    {"volume, inside a mesh", volume_inside, 500000, MOST_ASKED_AROUND},
    {"volume, shell of a mesh", volume_shell, 250000, MOST_ASKED_AROUND},
    {"volume, progressive", volume_progressive, 400000, MOST_ASKED_UNEVENLY},
    {"volume, count", volume_count, 400000, MOST_ASKED_UNEVENLY},
    {"volume, count, progressive", volume_count_progressive, 400000, MOST_ASKED_UNEVENLY},
    {"volume, given samples", volume_around, 500000, MOST_ASKED_AROUND},
    {"volume, many given samples", volume_around_many, 25000, MOST_ASKED_AROUND},
    {"plane, tiled", tiled, 8000000, MOST_ASKED},
    {"plane, not tiled", not_tiled, 300000, MOST_ASKED},
    {"plane, given samples", plane_around, 2000000, MOST_ASKED},
    {"plane, progressive", plane_progressive, 1000000, MOST_ASKED},
    {"plane, count", plane_count, 6000000, MOST_ASKED},
    {"plane, count, progressive", plane_count_progressive, 1000000, MOST_ASKED},
    {"plane, window", window, 8000000, MOST_ASKED},
    {"plane, 2 classes", plane_classes, 1000000, MOST_ASKED},
    {"plane, 4 classes", plane_4_classes, 500000, MOST_ASKED},
    {"volume, classes", volume_classes, 250000, MOST_ASKED},
    {"volume, equal classes", volume_equal_classes, 250000, MOST_ASKED_UNEVENLY},
    {"plane, 2 classes, progressive", plane_classes_progressive, 500000, MOST_ASKED_UNEVENLY},
    {"plane, 2 classes, narrow", plane_classes_narrow, 100000, MOST_ASKED},
    {"merge", merged, 1000000, MOST_ASKED},
    {"mesh", mesh_plain, 300000, MOST_ASKED},
    {"mesh, 524,288 triangles", mesh_hilly, 100000, MOST_ASKED_UNEVENLY},
    {"mesh, 2 iterations", mesh_iterated, 250000, MOST_ASKED},
    {"mesh, progressive", mesh_progressive, 150000, MOST_ASKED_UNEVENLY},
    {"mesh, count", mesh_count, 250000, MOST_ASKED},
    {"mesh, count, progressive", mesh_count_progressive, 125000, MOST_ASKED_UNEVENLY},
    {"mesh, given samples", mesh_around, 300000, MOST_ASKED},
    {"mesh, many given samples", mesh_around_many, 300000, MOST_ASKED_UNEVENLY},
    {"mesh, 2 classes", mesh_classes, 300000, MOST_ASKED},
    {"mesh, 2 classes, progressive", mesh_classes_progressive, 100000, MOST_ASKED_UNEVENLY},
    {"mesh, 2 classes, density", mesh_classes_density, 150000, MOST_ASKED_UNEVENLY},
    {"mesh, 2 classes, density, progressive", mesh_classes_density_progressive, 100000, MOST_ASKED_UNEVENLY},
    {"mesh, handle", of_handle, 300000, MOST_ASKED},
    {"mesh, edited", edited, 150000, MOST_ASKED},
    {"mesh, region", in_region, 200000, MOST_ASKED},
    {"mesh, radii of vertices", varying, 150000, MOST_ASKED_UNEVENLY},
    {"mesh, radii of vertices, progressive", varying_progressive, 100000, MOST_ASKED_UNEVENLY},
    {"mesh, density of vertices", density_by_vertex, 300000, MOST_ASKED_UNEVENLY},
    {"mesh, density of a picture", density_by_picture, 300000, MOST_ASKED_UNEVENLY},
    {"mesh, density of vertices, progressive", density_progressive, 100000, MOST_ASKED_UNEVENLY},
    {"relax", relaxed, 125000, MOST_ASKED},
    {"relax, nearest", relaxed_nearest, 250000, MOST_ASKED_UNEVENLY},
    {"relax, thesis", relaxed_thesis, 125000, MOST_ASKED},
    {"relax, bounded", relaxed_bounded, 62500, MOST_ASKED},
    {"relax, bounded, nearest", relaxed_bounded_nearest, 125000, MOST_ASKED_UNEVENLY},
    {"relax, bounded, thesis", relaxed_bounded_thesis, 125000, MOST_ASKED},
    {"relax, correlation", relaxed_to_correlation, 125000, MOST_ASKED},
    {"relax, 2 classes", relaxed_classes, 100000, MOST_ASKED},
    {"relax, 2 classes, bounded", relaxed_classes_bounded, 50000, MOST_ASKED},
    {"scatter", scattered, 300000, MOST_ASKED},
    {"relax, density", relaxed_density, 100000, MOST_ASKED},
    {"relax, density, bounded", relaxed_density_bounded, 60000, MOST_ASKED},
    {"relax, mesh", relaxed_on_mesh, 100000, MOST_ASKED},
    {"relax, volume", relaxed_in_space, 125000, MOST_ASKED_UNEVENLY},
    {"relax, inside a mesh", relaxed_inside, 125000, MOST_ASKED_UNEVENLY},
    {"mask, 64 channels", masked, 2097152, MOST_ASKED},
    {"thin, 3-D, a tenth", thinned, 500000, MOST_ASKED},
    {"thin, 3-D, all in order", thinned_all, 500000, MOST_ASKED},
    {"thin, 2-D, radius", thinned_plane, 1000000, MOST_ASKED},
    {"analysis, plane", measured, 125000, MOST_ASKED_UNEVENLY},
    {"coverage, plane", coverage_of_plane, 250000, MOST_ASKED},
    {"coverage, plane, all gaps", all_gaps_of_plane, 62500, MOST_ASKED_UNEVENLY},
    {"pairs, plane", pairs_of_plane, 1000000, MOST_ASKED},
    {"analysis, cuboid", measured_space, 250000, MOST_ASKED},
    {"coverage, cuboid", coverage_of_space, 250000, MOST_ASKED},
    {"coverage, cuboid, gaps", gaps_of_space, 250000, MOST_ASKED_UNEVENLY},
    {"smallest distance, space", distance_in_space, 1000000, MOST_ASKED},
    {"coverage, mesh", coverage_of_mesh, 250000, MOST_ASKED},
    {"coverage, mesh, gaps", gaps_of_mesh, 250000, MOST_ASKED_UNEVENLY},
    {"uncovered, mesh", uncovered_of_mesh, 1000000, MOST_ASKED},
    {"spectrum, plane", spectrum_of_plane, 500000, MOST_ASKED},
    {"spectrum, cuboid", spectrum_of_space, 125000, MOST_ASKED},
};

/* A hilly square of this many quads along a side. */
static azulejo_mesh *make_hills(size_t side) {
    azulejo_mesh *mesh = NULL;
    size_t i;
    for (i = 0; i < VERTICES(side); i++) {
        const double x = (double)(i % (side + 1)) / (double)side, y = (double)(i / (side + 1)) / (double)side;
        vertices[i][0] = (float)x;
        vertices[i][1] = (float)y;
        vertices[i][2] = (float)(0.05 * sin(20 * x) * cos(20 * y));
    }
    for (i = 0; i < side * side; i++) {
        const uint32_t corner = (uint32_t)(i + i / side), above = corner + (uint32_t)side + 1;
        const uint32_t both[2][3] = {{corner, corner + 1, above}, {above, corner + 1, above + 1}};
        memcpy(indices[i], both, sizeof both);
    }
    ACCEPTED(azulejo_mesh_create(vertices[0], VERTICES(side), sizeof *vertices, indices[0][0], 2 * side * side, &mesh));
    return mesh;
}

static void prepare(void) {
    size_t i;
    random_points(cloud, COUNT_OF(cloud) / 2);
    for (i = 0; i < COUNT_OF(class_of); i++) class_of[i] = (uint32_t)(i % 2);
    for (i = 0; i < 64 * 64; i++) picture[i / 64][i % 64] = 0.2f + 0.8f * (float)(i % 64) / 63;
    cube = make_cube();
    hilly = make_hills(MANY);
    sheet = make_hills(FEW);
    for (i = 0; i < COUNT_OF(weights); i++) {
        memcpy(texture[i], vertices[i], sizeof texture[i]);
        weights[i] = 0.2f + texture[i][0];
    }
}

/* An entry of the table of this process, in bytes: its address space or the peak of it. */
static size_t used(const char *entry) {
    char line[200];
    unsigned long kilobytes = 0;
    const size_t length = strlen(entry);
    FILE *status = fopen("/proc/self/status", "r");
    while (status != NULL && fgets(line, sizeof line, status) != NULL) {
        if (strncmp(line, entry, length) == 0 && sscanf(line + length, ": %lu", &kilobytes) == 1) break;
    }
    if (status != NULL) fclose(status);
    return (size_t)kilobytes << 10;
}

/* The end of a child that made a call. */
typedef struct {
    azulejo_status status;
    size_t peak;
    char message[200];
} outcome;

/* Makes a call in a child that may take so many bytes, or any number if that is 0. False if it did not come to an end. */
static int child(call make, size_t count, uint32_t threads, size_t bytes, outcome *out) {
    int state = 0, ends[2];
    pid_t pid;
    CHECK(pipe(ends) == 0);
    pid = fork();
    if (pid == 0) {
        struct rlimit limit;
        azulejo_context *context = NULL;
        const size_t before = used("VmSize");
        outcome own;
        if (freopen("/dev/null", "w", stderr) == NULL) _exit(3);
#ifdef M_ARENA_MAX
        if (threads > 1) (void)mallopt(M_ARENA_MAX, 1);
#endif
        limit.rlim_cur = limit.rlim_max = before + bytes;
        if (bytes != 0 && setrlimit(RLIMIT_AS, &limit) != 0) _exit(3);
        memset(&own, 0, sizeof own);
        own.status = AZULEJO_ERROR_TOO_LARGE;
        if (azulejo_context_create(threads, &context) == AZULEJO_OK) own.status = make(context, count);
        if (own.status != AZULEJO_OK) azulejo_last_error_message(own.message, sizeof own.message);
        own.peak = used("VmPeak") - before;
        _exit(write(ends[1], &own, sizeof own) == (ssize_t)sizeof own ? 0 : 3);
    }
    close(ends[1]);
    memset(out, 0, sizeof *out);
    out->status = -1;
    if (pid > 0 && read(ends[0], out, sizeof *out) != (ssize_t)sizeof *out) out->status = -1;
    close(ends[0]);
    return pid > 0 && waitpid(pid, &state, 0) == pid && WIFEXITED(state) && WEXITSTATUS(state) == 0;
}

static double megabytes(size_t bytes) { return (double)bytes / (1 << 20); }

/* Makes a call in a child that may take so many bytes: it succeeds or is refused, and does not abort. */
static int is_answered(size_t i, size_t count, uint32_t threads, size_t bytes, outcome *out) {
    const int is_over = child(calls[i].make, count, threads, bytes, out);
    if (CHECK(is_over && (out->status == AZULEJO_OK || out->status == AZULEJO_ERROR_TOO_LARGE))) return 1;
    printf("    %s, %u threads: aborts with %.1f MB\n", calls[i].name, threads, megabytes(bytes));
    return 0;
}

/* The bytes that a call lacked, as its message has them to a tenth of a MiB; half of what it had if it has none. */
static size_t lacking(const outcome *refused, size_t bytes) {
    const char *demand = strstr(refused->message, " need ");
    double needed, available;
    char units[2];
    if (demand == NULL) return bytes / 2;
    if (sscanf(demand, " need %lf %ciB, %lf %ciB", &needed, units, &available, units + 1) != 4) return bytes / 2;
    if (units[0] == 'G') needed *= 1024;
    if (units[1] == 'G') available *= 1024;
    return (size_t)((needed - available + 0.1) * (1 << 20));
}

/* Makes a call with ever more memory, until it has what it asks for: with exactly that it succeeds, which it could not if
   its peak were above. The bytes of that; none if it fails. */
static size_t granted(size_t i, size_t count, uint32_t threads, outcome *out) {
    size_t bytes = LEAST;
    int demands;
    for (demands = 0; demands < MOST_DEMANDS; demands++) {
        if (!is_answered(i, count, threads, bytes, out)) return 0;
        if (out->status == AZULEJO_OK) return bytes;
        bytes += lacking(out, bytes);
    }
    CHECK(out->status == AZULEJO_OK);
    printf("    %s: refused with %.1f MB: %s\n", calls[i].name, megabytes(bytes), out->message);
    return 0;
}

/* A call asks for its peak at least, and not for too much more; with a part of that it is refused. Refusals come before
   work, so that a row takes little more than one call. Two threads share one arena (child), and ask for what one asks or
   more. */
static void grid(size_t i) {
    const size_t count = calls[i].count;
    outcome one;
    const size_t bytes = granted(i, count, 1, &one), enough = (size_t)(calls[i].most * (double)one.peak) + SLACK;
    if (bytes == 0) return;
    if (bytes > enough && !CHECK(child(calls[i].make, count, 1, enough, &one) && one.status == AZULEJO_OK))
        printf("    %s: refused with %.1f MB: %s\n", calls[i].name, megabytes(enough), one.message);
    (void)is_answered(i, count, 2, bytes / 10 * 9, &one);
}

/* A row of the table: the peak, and what the call asked for over that. */
static void measure(size_t i, size_t count, uint32_t threads) {
    outcome one;
    const size_t bytes = granted(i, count, threads, &one);
    if (bytes == 0) return;
    printf("| %s | %zu | %u | %.1f | %.1f | %.2f |\n", calls[i].name, count, threads, megabytes(one.peak),
           (double)one.peak / (double)count, (double)bytes / (double)one.peak);
    fflush(stdout);
}

int main(int argc, char **argv) {
#ifdef __SANITIZE_ADDRESS__
    const int is_limited = 0; /* Shadow memory takes terabytes of address space. */
#else
    const int is_limited = getenv("AZULEJO_MEMORY_IS_WATCHED") == NULL; /* So does valgrind. */
#endif
    size_t i;
    int k;
    CHECK(used("VmSize") > 0);
    if (!is_limited) return finish();
    prepare();
    for (k = 1; k < argc; k++) {
        const size_t count = (size_t)strtoul(argv[k], NULL, 10);
        for (i = 0; i < COUNT_OF(calls); i++) {
            measure(i, count == 0 ? calls[i].count : count, 1);
            measure(i, count == 0 ? calls[i].count : count, 2);
        }
    }
    for (i = 0; argc == 1 && i < COUNT_OF(calls); i += getenv("AZULEJO_ROUNDS") ? 8 : 1) grid(i);
    azulejo_mesh_free(cube);
    azulejo_mesh_free(hilly);
    azulejo_mesh_free(sheet);
    return finish();
}
