/* Report structs of every size: those of other versions get the fields that they have and not a byte more; sizes that
   cannot be are refused by name, before any work; NULL is allowed where the call has another result. */

#include <stddef.h>

#include "samples.h"

#define INVALID AZULEJO_ERROR_INVALID_ARGUMENT

static azulejo_context *context;
static azulejo_mesh *cube;
static azulejo_points *samples;
static azulejo_spectrum *spectrum;
static azulejo_psp *set;
static float random_xy[400];
static int progress_calls;

/* Memory of a program whose report is shorter or longer than this version's. */
typedef union {
    uint32_t struct_size;
    unsigned char bytes[512];
    uint64_t aligned[64];
} memory;

/* The calls that write a report; the callback of the context counts whether any work began. */
typedef azulejo_status (*reporting_call)(void *report);

static azulejo_status kdrt(void *report) {
    const azulejo_kdrt_options o = kdrt_options(0.1);
    azulejo_points *out = NULL;
    const azulejo_status status = azulejo_kdrt_sample(context, &o, &out, report);
    CHECK((out != NULL) == (status == AZULEJO_OK));
    azulejo_points_free(out);
    return status;
}

static azulejo_status window(void *report) {
    const azulejo_kdrt_options o = kdrt_options(0.1);
    const double min[2] = {0.25, 0.25}, max[2] = {0.75, 0.75};
    azulejo_points *out = NULL;
    const azulejo_status status = azulejo_kdrt_sample_window(context, &o, min, max, &out, report);
    CHECK((out != NULL) == (status == AZULEJO_OK));
    azulejo_points_free(out);
    return status;
}

static uint32_t count_samples(void *user, const float *xy, size_t count) {
    (void)xy;
    *(size_t *)user += count;
    return 0;
}

static azulejo_status stream(void *report) {
    const azulejo_kdrt_options o = kdrt_options(0.1);
    size_t count = 0;
    return azulejo_kdrt_stream(context, &o, count_samples, &count, report);
}

static azulejo_status maximal(void *report) {
    azulejo_maximal_options o;
    azulejo_points *out = NULL;
    azulejo_status status;
    ACCEPTED(azulejo_maximal_options_init(&o, sizeof o));
    o.radius = 0.1;
    status = azulejo_maximal_sample(context, &o, &out, report);
    CHECK((out != NULL) == (status == AZULEJO_OK));
    azulejo_points_free(out);
    return status;
}

static azulejo_status thin(void *report) {
    const azulejo_thin_options o = thin_options(0.1, 0, AZULEJO_ORDER_ANY);
    azulejo_selection *out = NULL;
    const azulejo_status status = azulejo_thin(context, &o, random_xy, COUNT_OF(random_xy) / 2, 2, &out, report);
    CHECK((out != NULL) == (status == AZULEJO_OK));
    azulejo_selection_free(out);
    return status;
}

static azulejo_status mask(void *report) {
    azulejo_mask_options o;
    azulejo_mask *out = NULL;
    azulejo_status status;
    ACCEPTED(azulejo_mask_options_init(&o, sizeof o));
    o.width = o.height = 16;
    status = azulejo_mask_create(context, &o, &out, report);
    CHECK((out != NULL) == (status == AZULEJO_OK));
    azulejo_mask_free(out);
    return status;
}

static azulejo_classes two_classes(void) {
    static const double radii[4] = {0.2, 0.1, 0.1, 0.1};
    azulejo_classes classes;
    ACCEPTED(azulejo_classes_init(&classes, sizeof classes));
    classes.count = 2;
    classes.radii = radii;
    return classes;
}

static azulejo_status classes_of_plane(void *report) {
    const azulejo_kdrt_options o = kdrt_options(0);
    const azulejo_classes two = two_classes();
    azulejo_points *out = NULL;
    const azulejo_status status = azulejo_kdrt_sample_classes(context, &o, &two, &out, report);
    CHECK((out != NULL) == (status == AZULEJO_OK));
    azulejo_points_free(out);
    return status;
}

static azulejo_status classes_of_cuboid(void *report) {
    const azulejo_volume_options o = volume_options(0);
    const azulejo_classes two = two_classes();
    azulejo_points *out = NULL;
    const azulejo_status status = azulejo_volume_sample_classes(context, &o, &two, &out, report);
    CHECK((out != NULL) == (status == AZULEJO_OK));
    azulejo_points_free(out);
    return status;
}

static azulejo_status classes_of_mesh(void *report) {
    const azulejo_psp_options o = psp_options(0);
    const azulejo_classes two = two_classes();
    azulejo_points *out = NULL;
    const azulejo_status status = azulejo_psp_sample_classes(context, cube, &o, &two, &out, report);
    CHECK((out != NULL) == (status == AZULEJO_OK));
    azulejo_points_free(out);
    return status;
}

static azulejo_status classes_with_density(void *report) {
    static const float values[8] = {1, 1, 1, 1, 2, 2, 2, 2};
    const azulejo_psp_options o = psp_options(0);
    const azulejo_classes two = two_classes();
    azulejo_mesh_density density;
    azulejo_points *out = NULL;
    ACCEPTED(azulejo_mesh_density_init(&density, sizeof density));
    density.vertex_values = values;
    density.vertex_count = 8;
    density.radius = 1;
    const azulejo_status status = azulejo_psp_classes_with_density(context, cube, &o, &two, &density, &out, report);
    CHECK((out != NULL) == (status == AZULEJO_OK));
    azulejo_points_free(out);
    return status;
}

static azulejo_status merge(void *report) {
    const azulejo_kdrt_merge_options o = merge_options(0.1);
    azulejo_points *out = NULL;
    const azulejo_status status = azulejo_kdrt_merge(context, &o, NULL, 0, sizeof(azulejo_kdrt_merge_piece), NULL, 0, &out, report);
    CHECK((out != NULL) == (status == AZULEJO_OK));
    azulejo_points_free(out);
    return status;
}

static azulejo_status psp(void *report) {
    const azulejo_psp_options o = psp_options(0.3);
    azulejo_points *out = NULL;
    const azulejo_status status = azulejo_psp_sample(context, cube, &o, &out, report);
    CHECK((out != NULL) == (status == AZULEJO_OK));
    azulejo_points_free(out);
    return status;
}

static azulejo_status advance(void *report) { return azulejo_psp_advance(set, 1, report); }

static azulejo_status fill(void *report) { return azulejo_psp_fill(set, report); }

static azulejo_status adaptive(void *report) {
    const float radii[8] = {0.3f, 0.3f, 0.3f, 0.3f, 0.3f, 0.3f, 0.3f, 0.3f};
    azulejo_psp_adaptive_options o;
    azulejo_points *out = NULL;
    azulejo_status status;
    ACCEPTED(azulejo_psp_adaptive_options_init(&o, sizeof o));
    o.vertex_radii = radii;
    o.vertex_count = 8;
    status = azulejo_psp_adaptive_sample(context, cube, &o, &out, report);
    CHECK((out != NULL) == (status == AZULEJO_OK));
    azulejo_points_free(out);
    return status;
}

static azulejo_status dcr(void *report) {
    const azulejo_dcr_options o = dcr_options(3);
    azulejo_points *out = NULL;
    const azulejo_status status = azulejo_dcr_relax(context, &o, random_xy, COUNT_OF(random_xy) / 2, &out, report);
    CHECK((out != NULL) == (status == AZULEJO_OK));
    azulejo_points_free(out);
    return status;
}

static azulejo_status graded(void *report) {
    const azulejo_dcr_options o = dcr_options(3);
    const float image[2] = {1, 2};
    azulejo_density density;
    azulejo_points *out = NULL;
    azulejo_status status;
    ACCEPTED(azulejo_density_init(&density, sizeof density));
    density.values = image;
    density.width = 2;
    density.height = 1;
    status = azulejo_dcr_relax_density(context, &o, &density, random_xy, COUNT_OF(random_xy) / 2, &out, report);
    CHECK((out != NULL) == (status == AZULEJO_OK));
    azulejo_points_free(out);
    return status;
}

static azulejo_status surface(void *report) {
    azulejo_dcr_surface_options o;
    azulejo_points *out = NULL;
    azulejo_status status;
    ACCEPTED(azulejo_dcr_surface_options_init(&o, sizeof o));
    o.max_iterations = 3;
    status = azulejo_dcr_surface_relax(context, cube, &o, azulejo_points_triangles(samples),
                                       azulejo_points_barycentrics(samples), azulejo_points_count(samples), &out, report);
    CHECK((out != NULL) == (status == AZULEJO_OK));
    azulejo_points_free(out);
    return status;
}

static azulejo_status spatial(void *report) {
    azulejo_volume_relax_options o;
    azulejo_points *out = NULL;
    azulejo_status status;
    ACCEPTED(azulejo_volume_relax_options_init(&o, sizeof o));
    o.max_iterations = 3;
    status = azulejo_volume_relax(context, &o, random_xy, COUNT_OF(random_xy) / 3, &out, report);
    CHECK((out != NULL) == (status == AZULEJO_OK));
    azulejo_points_free(out);
    return status;
}

static azulejo_status solid(void *report) {
    const float inside[6] = {0.5f, 0.5f, 0.5f, 0.25f, 0.5f, 0.5f};
    azulejo_relax_inside_options o;
    azulejo_points *out = NULL;
    azulejo_status status;
    ACCEPTED(azulejo_relax_inside_options_init(&o, sizeof o));
    o.max_iterations = 3;
    status = azulejo_volume_relax_inside(context, cube, &o, inside, 2, &out, report);
    CHECK((out != NULL) == (status == AZULEJO_OK));
    azulejo_points_free(out);
    return status;
}

static const double low[2] = {0, 0}, high[2] = {1, 1};

static azulejo_status plane(void *report) {
    return azulejo_plane_measure(context, PLANE(random_xy, COUNT_OF(random_xy) / 2, low, high, 0), report);
}

static azulejo_status plane_gaps(void *report) {
    return azulejo_plane_coverage(context, PLANE(random_xy, COUNT_OF(random_xy) / 2, low, high, 0), 0.1, report);
}

static azulejo_status remeshed(void *report) {
    azulejo_mesh *made = NULL;
    const azulejo_status status =
        azulejo_dcr_remesh(context, cube, azulejo_points_triangles(samples), azulejo_points_barycentrics(samples),
                                   azulejo_points_count(samples), &made, report);
    azulejo_mesh_free(made);
    return status;
}

static azulejo_status surface_gaps(void *report) {
    return azulejo_mesh_coverage(context, cube, azulejo_points_positions(samples), azulejo_points_count(samples), 0.3,
                                 report);
}

static azulejo_status spectral(void *report) { return azulejo_spectrum_measure(spectrum, 0.2, 0, 3, report); }

#define INIT(type)                                                                        \
    static azulejo_status init_##type(void *report, size_t size) {                        \
        return azulejo_##type##_report_init(report, size);                                \
    }
INIT(kdrt)
INIT(kdrt_merge)
INIT(thin)
INIT(mask)
INIT(classes)
INIT(psp)
INIT(dcr)
INIT(dcr_surface)
INIT(dcr_remesh)
INIT(volume_relax)
INIT(plane)
INIT(coverage)
INIT(spectrum)

/* A call, its report's size, where the fields that no struct may lack end, where the last field begins, and where seconds,
   which differ from call to call, begin and end. */
typedef struct {
    reporting_call call;
    azulejo_status (*init)(void *report, size_t size);
    const char *name;
    size_t size, required, last, times_begin, times_end;
    int null_allowed;
} entry;

#define REPORT(type, required, last)                                                                              \
    init_##type, "azulejo_" #type "_report", sizeof(azulejo_##type##_report), required,                                    \
        offsetof(azulejo_##type##_report, last)
#define KDRT_TIMES offsetof(azulejo_kdrt_report, seconds), sizeof(azulejo_kdrt_report)
#define CLASSES_TIMES offsetof(azulejo_classes_report, seconds), sizeof(azulejo_classes_report)
#define PSP_TIMES offsetof(azulejo_psp_report, seconds), offsetof(azulejo_psp_report, rho)
static const entry entries[] = {
    {kdrt, REPORT(kdrt, 16, seconds), KDRT_TIMES, 1},
    {window, REPORT(kdrt, 16, seconds), KDRT_TIMES, 1},
    {stream, REPORT(kdrt, 16, seconds), KDRT_TIMES, 1},
    {maximal, REPORT(kdrt, 16, seconds), KDRT_TIMES, 1},
    {thin, REPORT(thin, 16, seconds), offsetof(azulejo_thin_report, seconds), sizeof(azulejo_thin_report), 1},
    {mask, REPORT(mask, 16, seconds), offsetof(azulejo_mask_report, seconds), sizeof(azulejo_mask_report), 1},
    {classes_of_plane, REPORT(classes, 16, seconds), CLASSES_TIMES, 1},
    {classes_of_cuboid, REPORT(classes, 16, seconds), CLASSES_TIMES, 1},
    {classes_of_mesh, REPORT(classes, 16, seconds), CLASSES_TIMES, 1},
    {classes_with_density, REPORT(classes, 16, seconds), CLASSES_TIMES, 1},
    {merge, REPORT(kdrt_merge, 16, inserted), 0, 0, 1},
    {psp, REPORT(psp, 16, covering_radius), PSP_TIMES, 1},
    {adaptive, REPORT(psp, 16, covering_radius), PSP_TIMES, 1},
    {dcr, REPORT(dcr, 8, relative_covering_radius), 0, 0, 1},
    {graded, REPORT(dcr, 8, relative_covering_radius), 0, 0, 1},
    {surface, REPORT(dcr_surface, 8, rho), 0, 0, 1},
    {spatial, REPORT(volume_relax, 8, rho), 0, 0, 1},
    {solid, REPORT(volume_relax, 8, rho), 0, 0, 1},
    {remeshed, REPORT(dcr_remesh, 16, mean_smallest_angle), 0, 0, 1},
    {plane, REPORT(plane, 16, beyond_4_sigma), 0, 0, 0},
    {plane_gaps, REPORT(coverage, 16, gaps), 0, 0, 0},
    {surface_gaps, REPORT(coverage, 16, gaps), 0, 0, 0},
    {spectral, REPORT(spectrum, 24, peak_frequency), 0, 0, 0},
};

static uint32_t count_calls(void *user, double done) {
    (void)user, (void)done;
    progress_calls++;
    return 0;
}

static int is_filled(const unsigned char *bytes, size_t count, unsigned char value) {
    while (count > 0 && bytes[count - 1] == value) count--;
    return count == 0;
}

/* Whether the first bytes of two reports are the same, apart from seconds and the size. */
static int same_fields(const entry *e, const memory *a, const memory *b, size_t count) {
    size_t i;
    for (i = sizeof(uint32_t); i < count; i++)
        if ((i < e->times_begin || i >= e->times_end) && a->bytes[i] != b->bytes[i]) return 0;
    return 1;
}

/* Structs of other versions: what fits is what a struct of this version gets, and nothing behind it is touched. */
static void every_size(const entry *e) {
    memory whole, part;
    size_t size;
    memset(&whole, 0x55, sizeof whole);
    ACCEPTED(e->init(&whole, e->size));
    CHECK(is_filled(whole.bytes + 4, e->size - 4, 0) && is_filled(whole.bytes + e->size, sizeof whole - e->size, 0x55));
    if (!ACCEPTED(e->call(&whole))) return;
    CHECK(whole.struct_size == e->size && is_filled(whole.bytes + e->size, sizeof whole - e->size, 0x55));
    CHECK(!is_filled(whole.bytes + 4, e->size - 4, 0));
    for (size = e->required; size <= e->size + 16; size += size < e->last ? 8 : 3) {
        /* The fields are in rows of 8 bytes but for one, and half a field is none. */
        const size_t wide = e->init == init_classes ? offsetof(azulejo_classes_report, counts) : e->last;
        const size_t row = size / 8 * 8, some = row < wide ? row : row < e->last ? wide : e->last;
        const size_t known = size >= e->size ? e->size : some;
        memset(&part, 0x55, sizeof part);
        part.struct_size = (uint32_t)size;
        ACCEPTED(e->call(&part));
        CHECK(part.struct_size == size && same_fields(e, &whole, &part, known));
        CHECK(is_filled(part.bytes + known, sizeof part - known, 0x55));
    }
}

/* A program built against a later header: the fields that this version does not know stay as its init function left
   them. */
static void later_structs(const entry *e) {
    memory later;
    memset(&later, 0x55, sizeof later);
    ACCEPTED(e->init(&later, 400));
    CHECK(later.struct_size == 400 && is_filled(later.bytes + 4, 396, 0) && later.bytes[400] == 0x55);
    ACCEPTED(e->call(&later));
    CHECK(later.struct_size == 400 && is_filled(later.bytes + e->size, 400 - e->size, 0) && later.bytes[400] == 0x55);
    /* What a later version wrote there before is neither read nor written. */
    memset(later.bytes + e->size, 0xaa, 400 - e->size);
    ACCEPTED(e->call(&later));
    CHECK(is_filled(later.bytes + e->size, 400 - e->size, 0xaa));
}

static void refused_sizes(const entry *e) {
    const uint32_t sizes[] = {0, 1, 4, (uint32_t)e->required - 1, 4097, 0x80000000u, UINT32_MAX};
    memory report, before;
    char hint[100];
    size_t i;
    snprintf(hint, sizeof hint, "call %s_init", e->name);
    memset(&report, 0x55, sizeof report);
    progress_calls = 0;
    for (i = 0; i < COUNT_OF(sizes); i++) {
        report.struct_size = sizes[i];
        before = report;
        REFUSED(INVALID, hint, e->call(&report));
        CHECK(strstr(last_error(), e->null_allowed ? "report: struct_size " : "out: struct_size ") != NULL);
        CHECK(memcmp(&report, &before, sizeof report) == 0);
        REFUSED(INVALID, "report: struct_size", e->init(&report, sizes[i]));
        CHECK(memcmp(&report, &before, sizeof report) == 0);
    }
    report.struct_size = (uint32_t)e->size;
    REFUSED(INVALID, "is not aligned", e->call(report.bytes + 2));
    REFUSED(INVALID, "report: is NULL", e->init(NULL, e->size));
    if (e->null_allowed) {
        CHECK(progress_calls == 0);
        ACCEPTED(e->call(NULL));
    } else {
        REFUSED(INVALID, "out: is NULL", e->call(NULL));
        CHECK(progress_calls == 0);
    }
}

/* A handle that grows: its reports differ from call to call. */
static void reports_of_a_handle(void) {
    const reporting_call calls[] = {advance, fill};
    size_t i;
    for (i = 0; i < COUNT_OF(calls); i++) {
        azulejo_psp_report report = psp_report();
        progress_calls = 0;
        report.struct_size = 7;
        REFUSED(INVALID, "report: struct_size 7 is not in 16..=4096; call azulejo_psp_report_init", calls[i](&report));
        CHECK(progress_calls == 0 && report.samples == 0);
        report.struct_size = offsetof(azulejo_psp_report, accepted);
        report.accepted = 77;
        ACCEPTED(calls[i](&report));
        CHECK(report.samples > 0 && report.accepted == 77);
        ACCEPTED(calls[i](NULL));
    }
}

int main(void) {
    azulejo_context *own = make_context(2);
    azulejo_psp_options options = psp_options(0.3);
    size_t i;
    random_points(random_xy, COUNT_OF(random_xy) / 2);
    cube = make_cube();
    ACCEPTED(azulejo_context_watch(own, count_calls, NULL, &context));
    ACCEPTED(azulejo_psp_sample(own, cube, &options, &samples, NULL));
    ACCEPTED(azulejo_psp_create(context, cube, &options, &set));
    ACCEPTED(azulejo_spectrum_create(own, PLANE(random_xy, COUNT_OF(random_xy) / 2, low, high, 0), 32, 1, &spectrum));
    for (i = 0; i < COUNT_OF(entries); i++) {
        every_size(&entries[i]);
        later_structs(&entries[i]);
        refused_sizes(&entries[i]);
    }
    reports_of_a_handle();
    azulejo_spectrum_free(spectrum);
    azulejo_psp_free(set);
    azulejo_points_free(samples);
    azulejo_mesh_free(cube);
    azulejo_context_free(context);
    azulejo_context_free(own);
    return finish();
}
