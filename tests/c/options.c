/* Options structs of other versions: shorter ones, longer ones with a zero or non-zero tail, sizes that cannot be. */

#include <stddef.h>

#include "samples.h"

#define INVALID AZULEJO_ERROR_INVALID_ARGUMENT

static azulejo_context *context;

/* A program built against a later header, whose struct has two fields more. */
typedef struct {
    azulejo_kdrt_options known;
    double later;
    uint64_t last;
} later_options;

static azulejo_points *sample(const azulejo_kdrt_options *options) {
    azulejo_points *points = NULL;
    ACCEPTED(azulejo_kdrt_sample(context, options, &points, NULL));
    return points;
}

static void defaults(void) {
    azulejo_kdrt_options kdrt;
    azulejo_maximal_options maximal;
    azulejo_kdrt_merge_options merge;
    azulejo_psp_options psp;
    azulejo_dcr_options dcr;
    azulejo_dcr_surface_options surface;
    azulejo_psp_adaptive_options adaptive;
    azulejo_density density;
    azulejo_plane_set set;
    azulejo_thin_options thin;
    azulejo_volume_options volume;
    azulejo_mask_options mask;
    memset(&mask, 0x55, sizeof mask);
    memset(&volume, 0x55, sizeof volume);
    memset(&thin, 0x55, sizeof thin);
    memset(&surface, 0x55, sizeof surface);
    memset(&adaptive, 0x55, sizeof adaptive);
    memset(&density, 0x55, sizeof density);
    memset(&set, 0x55, sizeof set);
    memset(&kdrt, 0x55, sizeof kdrt);
    memset(&maximal, 0x55, sizeof maximal);
    memset(&merge, 0x55, sizeof merge);
    memset(&psp, 0x55, sizeof psp);
    memset(&dcr, 0x55, sizeof dcr);
    ACCEPTED(azulejo_kdrt_options_init(&kdrt, sizeof kdrt));
    ACCEPTED(azulejo_maximal_options_init(&maximal, sizeof maximal));
    ACCEPTED(azulejo_kdrt_merge_options_init(&merge, sizeof merge));
    ACCEPTED(azulejo_psp_options_init(&psp, sizeof psp));
    ACCEPTED(azulejo_dcr_options_init(&dcr, sizeof dcr));
    ACCEPTED(azulejo_dcr_surface_options_init(&surface, sizeof surface));
    ACCEPTED(azulejo_psp_adaptive_options_init(&adaptive, sizeof adaptive));
    ACCEPTED(azulejo_density_init(&density, sizeof density));
    ACCEPTED(azulejo_plane_set_init(&set, sizeof set));
    ACCEPTED(azulejo_thin_options_init(&thin, sizeof thin));
    ACCEPTED(azulejo_volume_options_init(&volume, sizeof volume));
    ACCEPTED(azulejo_mask_options_init(&mask, sizeof mask));

    CHECK(kdrt.struct_size == sizeof kdrt && maximal.struct_size == sizeof maximal);
    CHECK(psp.struct_size == sizeof psp && dcr.struct_size == sizeof dcr);
    CHECK(kdrt.radius == 0 && maximal.radius == 0 && psp.radius == 0);
    CHECK(kdrt.domain_min[0] == 0 && kdrt.domain_min[1] == 0 && kdrt.domain_max[0] == 1 && kdrt.domain_max[1] == 1);
    CHECK(dcr.domain_min[0] == 0 && dcr.domain_min[1] == 0 && dcr.domain_max[0] == 1 && dcr.domain_max[1] == 1);
    CHECK(kdrt.boundary == AZULEJO_BOUNDARY_PERIODIC && dcr.boundary == AZULEJO_BOUNDARY_PERIODIC);
    CHECK(kdrt.leaf_size == 20 && kdrt.seed == 0 && kdrt.progress == NULL && kdrt.progress_user == NULL);
    CHECK(kdrt.count == 0 && kdrt.measure_covering_radius == 0 && kdrt.order == AZULEJO_ORDER_ANY);
    CHECK(kdrt.quotient == 0 && kdrt.coarsest == 0);
    CHECK(kdrt.given_positions == NULL && kdrt.given_clearances == NULL && kdrt.given_count == 0);
    CHECK(merge.struct_size == sizeof merge && merge.radius == 0 && merge.seed == 0 && merge.progress == NULL);
    CHECK(merge.domain_min[0] == 0 && merge.domain_min[1] == 0 && merge.domain_max[0] == 1 && merge.domain_max[1] == 1);
    CHECK(merge.boundary == AZULEJO_BOUNDARY_PERIODIC && merge.progress_user == NULL);
    CHECK(psp.maximal == 1 && psp.iterations == AZULEJO_ITERATIONS_DEFAULT && psp.seed == 0 && psp.progress == NULL);
    CHECK(psp.priority == AZULEJO_PRIORITY_SQUARENESS && psp.engine == AZULEJO_ENGINE_AUTO);
    CHECK(psp.projectors == AZULEJO_PROJECTORS_LOCAL && psp.reserved == 0);
    CHECK(dcr.neighbourhood == AZULEJO_NEIGHBOURHOOD_DELAUNAY && dcr.max_iterations > 0 && dcr.progress == NULL);
    CHECK(dcr.method == AZULEJO_METHOD_MOMENTUM && dcr.conflict_radius == 0.95 && dcr.attraction_radius == 1.05);
    CHECK(dcr.step == 0.05 && dcr.decay == 1 && dcr.neighbours == 6 && dcr.tolerance < 0 && dcr.reserved == 0);
    CHECK(dcr.distribution == AZULEJO_DISTRIBUTION_ACTIVENESS && dcr.visits == AZULEJO_VISITS_BOTH_ENDS);
    CHECK(dcr.convergence == AZULEJO_CONVERGENCE_MOTION);
    CHECK(surface.struct_size == sizeof surface && surface.max_iterations == 100 && surface.tolerance < 0);
    CHECK(surface.seed == 0 && surface.progress == NULL && surface.progress_user == NULL);
    CHECK(adaptive.struct_size == sizeof adaptive && adaptive.order == AZULEJO_ORDER_ANY && adaptive.quotient == 0 && adaptive.vertex_radii == NULL);
    CHECK(adaptive.vertex_count == 0 && adaptive.radius_function == NULL && adaptive.slope == 0 && adaptive.cosine == -1);
    CHECK(density.struct_size == sizeof density && density.values == NULL && density.width == 0 && density.height == 0);
    CHECK(density.function == NULL && density.function_user == NULL && density.reserved == 0);
    CHECK(set.struct_size == sizeof set && set.positions == NULL && set.count == 0);
    CHECK(set.domain_min[0] == 0 && set.domain_min[1] == 0 && set.domain_max[0] == 1 && set.domain_max[1] == 1);
    CHECK(set.boundary == AZULEJO_BOUNDARY_PERIODIC);
    CHECK(thin.struct_size == sizeof thin && thin.order == AZULEJO_ORDER_ANY && thin.radius == 0 && thin.count == 0);
    CHECK(thin.seed == 0 && thin.progress == NULL && thin.progress_user == NULL);
    CHECK(mask.struct_size == sizeof mask && mask.width == 0 && mask.height == 0 && mask.depth == 1 && mask.channels == 1);
    CHECK(mask.seed == 0 && mask.sigma == 1.5 && mask.progress == NULL && mask.progress_user == NULL);
    CHECK(volume.struct_size == sizeof volume && volume.boundary == AZULEJO_BOUNDARY_PERIODIC && volume.radius == 0);
    CHECK(volume.domain_min[0] == 0 && volume.domain_min[2] == 0 && volume.domain_max[0] == 1 && volume.domain_max[2] == 1);
    CHECK(volume.seed == 0 && volume.progress == NULL && volume.progress_user == NULL);
    CHECK(volume.count == 0 && volume.order == AZULEJO_ORDER_ANY && volume.reserved == 0 && volume.quotient == 0);
    CHECK(volume.given_positions == NULL && volume.given_clearances == NULL && volume.given_count == 0);
    CHECK(volume.leaf_size == 0);
}

static void refused_inits(void) {
    azulejo_kdrt_options options, before;
    memset(&options, 0x55, sizeof options);
    before = options;
    REFUSED(INVALID, "options", azulejo_kdrt_options_init(NULL, sizeof options));
    REFUSED(INVALID, "options", azulejo_maximal_options_init(NULL, sizeof options));
    REFUSED(INVALID, "options", azulejo_kdrt_merge_options_init(NULL, sizeof options));
    REFUSED(INVALID, "options", azulejo_psp_options_init(NULL, sizeof options));
    REFUSED(INVALID, "options", azulejo_thin_options_init(NULL, sizeof options));
    REFUSED(INVALID, "options", azulejo_volume_options_init(NULL, sizeof options));
    REFUSED(INVALID, "options", azulejo_mask_options_init(NULL, sizeof options));
    REFUSED(INVALID, "options", azulejo_dcr_options_init(NULL, sizeof options));
    REFUSED(INVALID, "options", azulejo_dcr_surface_options_init(NULL, sizeof options));
    REFUSED(INVALID, "options", azulejo_psp_adaptive_options_init(NULL, sizeof options));
    REFUSED(INVALID, "set", azulejo_plane_set_init(NULL, sizeof options));
    REFUSED(INVALID, "set: struct_size 8 is not", azulejo_plane_set_init((azulejo_plane_set *)&options, 8));
    REFUSED(INVALID, "struct_size", azulejo_kdrt_options_init(&options, 0));
    REFUSED(INVALID, "struct_size", azulejo_kdrt_options_init(&options, 4));
    REFUSED(INVALID, "struct_size", azulejo_kdrt_options_init(&options, 4097));
    REFUSED(INVALID, "struct_size", azulejo_kdrt_options_init(&options, SIZE_MAX));
    CHECK(memcmp(&options, &before, sizeof options) == 0);
}

/* Every size that stands in a struct and cannot be its size. */
static void refused_sizes(void) {
    const uint32_t sizes[] = {0, 1, 4, 8, 4097, 0x80000000u, UINT32_MAX};
    azulejo_kdrt_options kdrt = kdrt_options(0.1);
    azulejo_maximal_options maximal = maximal_options(0.1);
    azulejo_kdrt_merge_options merge = merge_options(0.1);
    azulejo_psp_options psp = psp_options(0.1);
    azulejo_dcr_options dcr = dcr_options(1);
    azulejo_mesh *mesh = make_cube();
    const float xy[2] = {0, 0};
    azulejo_points *out = UNTOUCHED;
    size_t i;
    for (i = 0; i < COUNT_OF(sizes); i++) {
        kdrt.struct_size = maximal.struct_size = merge.struct_size = psp.struct_size = dcr.struct_size = sizes[i];
        REFUSED(INVALID, "struct_size", azulejo_kdrt_sample(context, &kdrt, &out, NULL));
        REFUSED(INVALID, "azulejo_maximal_options_init", azulejo_maximal_sample(context, &maximal, &out, NULL));
        REFUSED(INVALID, "struct_size", azulejo_kdrt_merge(context, &merge, NULL, 0, sizeof(azulejo_kdrt_merge_piece), NULL, 0, &out, NULL));
        REFUSED(INVALID, "struct_size", azulejo_psp_sample(context, mesh, &psp, &out, NULL));
        REFUSED(INVALID, "struct_size", azulejo_dcr_relax(context, &dcr, xy, 1, &out, NULL));
    }
    CHECK(out == UNTOUCHED);
    azulejo_mesh_free(mesh);
}

/* A shorter struct: the fields that it does not have take their defaults, whatever stands in that memory. */
static void older_structs(void) {
    azulejo_kdrt_options plain = kdrt_options(0.1), other = plain, older;
    azulejo_points *with_default, *with_other, *points;

    other.seed = 7;
    with_default = sample(&plain);
    with_other = sample(&other);
    CHECK(!same_points(with_default, with_other));

    older = other;
    older.progress = (azulejo_progress_fn)NULL;
    older.struct_size = offsetof(azulejo_kdrt_options, progress); /* has the seed, but no progress */
    memset(&older.progress, 0x55, sizeof older.progress);
    points = sample(&older);
    CHECK(same_points(points, with_other));
    azulejo_points_free(points);

    older = other;
    older.struct_size = offsetof(azulejo_kdrt_options, count); /* from before there were counts */
    older.count = 12345;
    points = sample(&older);
    CHECK(same_points(points, with_other));
    azulejo_points_free(points);

    older.struct_size = offsetof(azulejo_kdrt_options, seed);
    points = sample(&older);
    CHECK(same_points(points, with_default));
    azulejo_points_free(points);

    older.struct_size = offsetof(azulejo_kdrt_options, seed) + 7; /* most of a field is none */
    points = sample(&older);
    CHECK(same_points(points, with_default));
    azulejo_points_free(points);

    older.struct_size = offsetof(azulejo_kdrt_options, domain_min); /* the shortest */
    memset(older.domain_min, 0xff, sizeof older.domain_min);
    points = sample(&older);
    CHECK(same_points(points, with_default));
    azulejo_points_free(points);

    memset(&older, 0x55, sizeof older);
    ACCEPTED(azulejo_kdrt_options_init(&older, offsetof(azulejo_kdrt_options, seed)));
    CHECK(older.struct_size == offsetof(azulejo_kdrt_options, seed));
    CHECK(older.leaf_size == 20 && older.seed == 0x5555555555555555u);

    azulejo_points_free(with_default);
    azulejo_points_free(with_other);
}

static void later_structs(void) {
    azulejo_kdrt_options plain = kdrt_options(0.1);
    azulejo_points *expected = sample(&plain), *points = UNTOUCHED;
    later_options later;

    memset(&later, 0x55, sizeof later);
    ACCEPTED(azulejo_kdrt_options_init((azulejo_kdrt_options *)&later, sizeof later));
    CHECK(later.known.struct_size == sizeof later && later.later == 0 && later.last == 0);
    later.known.radius = 0.1;
    points = sample((azulejo_kdrt_options *)&later);
    CHECK(same_points(points, expected));
    azulejo_points_free(points);

    points = UNTOUCHED;
    later.last = (uint64_t)1 << 63;
    REFUSED(INVALID, "struct_size", azulejo_kdrt_sample(context, (azulejo_kdrt_options *)&later, &points, NULL));
    later.last = 0;
    later.later = 1;
    REFUSED(INVALID, "struct_size", azulejo_kdrt_sample(context, (azulejo_kdrt_options *)&later, &points, NULL));
    CHECK(points == UNTOUCHED);
    azulejo_points_free(expected);
}

int main(void) {
    context = make_context(1);
    defaults();
    refused_inits();
    refused_sizes();
    older_structs();
    later_structs();
    azulejo_context_free(context);
    return finish();
}
