/* The C functions return the bytes of the Rust calls: the sums of tests/sums.txt, with 1 and 3 threads. The promises that
   sets keep are tested in Rust. */

#include <math.h>

#include "samples.h"
#include "sha256.h"

#define COLUMNS 96
#define ROWS 64

static azulejo_context *context;
static char *sums; /* the text of tests/sums.txt */

static char *read_sums(void) {
    static const char file[] = __FILE__, name[] = "../sums.txt";
    char *path = malloc(sizeof file + sizeof name), *slash, *text;
    FILE *in;
    long size;
    strcpy(path, file);
    slash = strrchr(path, '/');
    strcpy(slash ? slash + 1 : path, name);
    in = fopen(path, "rb");
    free(path);
    if (!CHECK(in != NULL)) exit(finish());
    fseek(in, 0, SEEK_END);
    size = ftell(in);
    rewind(in);
    text = calloc(1, (size_t)size + 1);
    CHECK(fread(text, 1, (size_t)size, in) == (size_t)size);
    fclose(in);
    return text;
}

/* Whether the file has this sum for this call. */
static void check_sum(const char *name, sha256 *sum) {
    char line[256], digits[65];
    const uint64_t size = sum->length;
    sha256_digits(sum, digits);
    sprintf(line, "%s  %s (%lu bytes)\n", digits, name, (unsigned long)size);
    if (!CHECK(strstr(sums, line) != NULL)) printf("    %s", line);
}

static void check_bytes(const char *name, const void *bytes, size_t size) {
    sha256 sum;
    sha256_init(&sum);
    sha256_add(&sum, bytes, size);
    check_sum(name, &sum);
}

/* All fields, one after the other, as tests/sums/list.rs hashes them. */
static void check_points(const char *name, const azulejo_points *points) {
    const size_t count = azulejo_points_count(points);
    sha256 sum;
    sha256_init(&sum);
#define FIELD(field, numbers)                                              \
    do {                                                                   \
        const void *data = azulejo_points_##field(points);                 \
        if (data) sha256_add(&sum, data, count * (numbers));               \
    } while (0)
    FIELD(positions, azulejo_points_dimension(points) * sizeof(float));
    FIELD(normals, 3 * sizeof(float));
    FIELD(interpolated_normals, 3 * sizeof(float));
    FIELD(triangles, sizeof(uint32_t));
    FIELD(barycentrics, 2 * sizeof(float));
    FIELD(ranks, sizeof(float));
    FIELD(classes, sizeof(uint32_t));
    FIELD(radii, sizeof(double));
#undef FIELD
    check_sum(name, &sum);
}

/* Makes points by the call and compares them. */
#define POINTS(name, call)                       \
    do {                                         \
        azulejo_points *points = NULL;           \
        ACCEPTED(call);                          \
        check_points(name, points);              \
        azulejo_points_free(points);             \
    } while (0)

static azulejo_kdrt_options kdrt(double radius, double leaf_size, uint64_t seed) {
    azulejo_kdrt_options o = kdrt_options(radius);
    o.leaf_size = leaf_size;
    o.seed = seed;
    return o;
}

static azulejo_kdrt_options far_away(azulejo_kdrt_options o) {
    o.domain_min[0] = 1000, o.domain_min[1] = -3, o.domain_max[0] = 1004, o.domain_max[1] = -1;
    return o;
}

static uint32_t add_to_sum(void *sum, const float *xy, size_t count) {
    sha256_add(sum, xy, 2 * count * sizeof *xy);
    return 0;
}

static void planes(void) {
    const double far_low[2] = {1000, -2.5}, far_high[2] = {1000.4, -1.5};
    const double low[2] = {0.93, 0}, high[2] = {1, 0.05}, part_low[2] = {0.8, 0.3}, part_high[2] = {1, 0.6};
    azulejo_maximal_options maximal = maximal_options(0.01);
    azulejo_volume_options volume = volume_options(0.02);
    azulejo_kdrt_options o = kdrt(0.002, 20, 3);
    azulejo_kdrt *plane = NULL;
    sha256 stream;
    maximal.seed = 1;
    POINTS("maximal periodic", azulejo_maximal_sample(context, &maximal, &points, NULL));
    POINTS("kdrt 20r", azulejo_kdrt_sample(context, &o, &points, NULL));
    o = kdrt(0.002, 6, 4);
    POINTS("kdrt 6r", azulejo_kdrt_sample(context, &o, &points, NULL));
    o = far_away(kdrt(0.01, 20, 7));
    POINTS("kdrt far", azulejo_kdrt_sample(context, &o, &points, NULL));
    o = kdrt(0.0001, 20, 10);
    POINTS("window", azulejo_kdrt_sample_window(context, &o, low, high, &points, NULL));
    o = far_away(kdrt(0.0045, 20, 12));
    sha256_init(&stream);
    ACCEPTED(azulejo_kdrt_stream(context, &o, add_to_sum, &stream, NULL));
    check_sum("stream", &stream);
    o = far_away(kdrt_options(0.02));
    o.order = AZULEJO_ORDER_PROGRESSIVE;
    o.coarsest = 0.1;
    POINTS("ordered window", azulejo_kdrt_sample_window(context, &o, far_low, far_high, &points, NULL));
    volume.seed = 71;
    POINTS("volume torus", azulejo_volume_sample(context, &volume, &points, NULL));
    o = kdrt(0.003, 20, 62);
    ACCEPTED(azulejo_kdrt_create(context, &o, &plane));
    POINTS("torus kept window", azulejo_kdrt_window(plane, part_low, part_high, &points));
    azulejo_kdrt_free(plane);
    o = kdrt(0, 20, 14);
    o.count = 1000;
    POINTS("count 1000", azulejo_kdrt_sample(context, &o, &points, NULL));
    o = kdrt(0, 20, 64);
    o.count = 4000;
    o.order = AZULEJO_ORDER_PROGRESSIVE;
    POINTS("torus count, ordered", azulejo_kdrt_sample(context, &o, &points, NULL));
}

/* Sets of several classes, around given samples, and of two halves. */
static void planes_of_parts(void) {
    const double equal[4] = {0.01, 0.01, 0.01, 0.01};
    double matrix[16], clearances[2000];
    static float positions[2000][2];
    azulejo_classes classes;
    azulejo_kdrt_options o = kdrt_options(0);
    azulejo_kdrt_merge_options merge = merge_options(0.005);
    azulejo_kdrt_merge_piece pieces[2];
    azulejo_points *halves[2] = {NULL, NULL};
    const float fixed[4] = {0.25f, 0.75f, 0.5f, 0.5f};
    uint32_t i;
    ACCEPTED(azulejo_classes_init(&classes, sizeof classes));
    ACCEPTED(azulejo_classes_radii(equal, 4, 0.7, matrix));
    classes.count = 4;
    classes.radii = matrix;
    o.boundary = AZULEJO_BOUNDARY_BOUNDED;
    o.seed = 26;
    POINTS("classes equal", azulejo_kdrt_sample_classes(context, &o, &classes, &points, NULL));

    for (i = 0; i < 2000; i++) {
        positions[i][0] = (float)(i * 619 % 2003) / 1900.0f;
        positions[i][1] = (float)(i * 415 % 1999) / 1999.0f;
        clearances[i] = 1e-6 * (i % 500) * (i % 40);
    }
    o = kdrt(0.004, 20, 25);
    o.given_positions = positions[0];
    o.given_count = 2000;
    POINTS("around equal", azulejo_kdrt_sample(context, &o, &points, NULL));
    o.given_clearances = clearances;
    POINTS("around periodic", azulejo_kdrt_sample(context, &o, &points, NULL));

    for (i = 0; i < 2; i++) {
        o = kdrt(0.005, 20, 16 + i);
        o.boundary = AZULEJO_BOUNDARY_BOUNDED;
        o.domain_min[0] = 0.5 * i, o.domain_max[0] = 0.5 * (i + 1);
        ACCEPTED(azulejo_kdrt_sample(context, &o, &halves[i], NULL));
        memset(&pieces[i], 0, sizeof pieces[i]);
        pieces[i].positions = azulejo_points_positions(halves[i]);
        pieces[i].count = azulejo_points_count(halves[i]);
        memcpy(pieces[i].min, o.domain_min, sizeof o.domain_min);
        memcpy(pieces[i].max, o.domain_max, sizeof o.domain_max);
    }
    merge.seed = 18;
    POINTS("merge", azulejo_kdrt_merge(context, &merge, pieces, 2, sizeof(azulejo_kdrt_merge_piece), fixed, 2, &points, NULL));
    azulejo_points_free(halves[0]);
    azulejo_points_free(halves[1]);
}

static double everywhere(void *user, const double *position) {
    (void)user, (void)position;
    return 1;
}

static void thinned(const char *name, azulejo_thin_options o, const float *xy, size_t count, uint64_t seed) {
    azulejo_selection *selection = NULL;
    sha256 sum;
    o.seed = seed;
    ACCEPTED(azulejo_thin(context, &o, xy, count, 2, &selection, NULL));
    count = azulejo_selection_count(selection);
    sha256_init(&sum);
    sha256_add(&sum, azulejo_selection_indices(selection), count * sizeof(uint32_t));
    if (azulejo_selection_ranks(selection)) sha256_add(&sum, azulejo_selection_ranks(selection), count * sizeof(float));
    check_sum(name, &sum);
    azulejo_selection_free(selection);
}

/* Random points, a part of them, and their relaxation. */
static void clouds(void) {
    azulejo_dcr_options o = dcr_options(0), defaults;
    azulejo_density density;
    azulejo_points *cloud = NULL;
    azulejo_dcr_report report = dcr_report();
    double numbers[3];
    const float *xy;
    ACCEPTED(azulejo_dcr_options_init(&defaults, sizeof defaults));
    ACCEPTED(azulejo_density_init(&density, sizeof density));
    density.function = everywhere;
    o = defaults;
    o.seed = 20;
    ACCEPTED(azulejo_dcr_scatter(context, &o, &density, 3000, &cloud));
    check_points("scatter", cloud);
    xy = azulejo_points_positions(cloud);
    thinned("thin by radius, plane", thin_options(0.02, 0, AZULEJO_ORDER_ANY), xy, 3000, 0);
    thinned("thin by count, plane", thin_options(0, 1000, AZULEJO_ORDER_ANY), xy, 3000, 21);
    thinned("thin progressive, plane", thin_options(0, 0, AZULEJO_ORDER_PROGRESSIVE), xy, 3000, 22);
    o.seed = 21;
    POINTS("relax delaunay", azulejo_dcr_relax(context, &o, xy, 3000, &points, &report));
    numbers[0] = report.motion, numbers[1] = report.rho, numbers[2] = report.relative_covering_radius;
    check_bytes("relax delaunay: report", numbers, sizeof numbers);
    o.seed = 24;
    o.neighbourhood = AZULEJO_NEIGHBOURHOOD_NEAREST;
    o.boundary = AZULEJO_BOUNDARY_BOUNDED;
    POINTS("relax nearest bounded", azulejo_dcr_relax(context, &o, xy, 3000, &points, NULL));
    azulejo_points_free(cloud);
}

/* Three coordinates each, and what is not read. */
static float torus_positions[COLUMNS * ROWS][5];

/* The closed torus of tests/sums/meshes.rs. */
static azulejo_mesh *torus(void) {
    static float normals[COLUMNS * ROWS][3];
    static uint32_t triangles[2 * COLUMNS * ROWS][3];
    const double tau = 6.283185307179586477;
    azulejo_mesh *bare = NULL, *mesh = NULL;
    uint32_t column, row, count = 0;
    for (column = 0; column < COLUMNS; column++) {
        for (row = 0; row < ROWS; row++) {
            const double hole = tau * column / COLUMNS, tube = tau * row / ROWS;
            const double east = cos(hole), north = sin(hole);
            const volatile double bulge = 0.4 * cos(tube); /* never fused with the sum */
            const double radius = 1 + bulge;
            const uint32_t next = (column + 1) % COLUMNS * ROWS, above = (row + 1) % ROWS;
            const uint32_t near = column * ROWS + row, far = next + above;
            float *position = torus_positions[near], *normal = normals[near];
            position[0] = (float)(radius * east), position[1] = (float)(radius * north);
            position[2] = (float)(0.4 * sin(tube));
            position[3] = position[4] = NAN;
            normal[0] = (float)(cos(tube) * east), normal[1] = (float)(cos(tube) * north);
            normal[2] = (float)sin(tube);
            triangles[count][0] = near, triangles[count][1] = next + row, triangles[count++][2] = far;
            triangles[count][0] = near, triangles[count][1] = far, triangles[count++][2] = column * ROWS + above;
        }
    }
    ACCEPTED(azulejo_mesh_create(torus_positions[0], COLUMNS * ROWS, sizeof *torus_positions, triangles[0], count, &bare));
    ACCEPTED(azulejo_mesh_with_normals(bare, normals[0], COLUMNS * ROWS, sizeof *normals, NULL, 0, &mesh));
    azulejo_mesh_free(bare);
    return mesh;
}

static void surfaces(void) {
    static float radii[COLUMNS * ROWS];
    static uint32_t masks[2 * COLUMNS * ROWS];
    const double own[3] = {0.05, 0.1, 0.05};
    double matrix[9], numbers[4];
    azulejo_mesh *mesh = torus();
    azulejo_psp_options o = psp_options(0.02);
    azulejo_psp_adaptive_options adaptive;
    azulejo_dcr_surface_options relax;
    azulejo_classes classes;
    azulejo_points *filled = NULL;
    azulejo_psp_report report = psp_report();
    uint32_t i;
    o.iterations = 0;
    o.seed = 28;
    ACCEPTED(azulejo_psp_sample(context, mesh, &o, &filled, &report));
    check_points("fill only", filled);
    numbers[0] = (double)report.samples, numbers[1] = (double)report.darts, numbers[2] = (double)report.conflicts;
    numbers[3] = report.rho;
    check_bytes("fill only: report", numbers, sizeof numbers);
    o.iterations = 1;
    o.projectors = AZULEJO_PROJECTORS_GLOBAL;
    o.engine = AZULEJO_ENGINE_RASTERISER;
    o.seed = 29;
    POINTS("rasteriser 1", azulejo_psp_sample(context, mesh, &o, &points, NULL));
    o.projectors = AZULEJO_PROJECTORS_LOCAL;
    POINTS("local 1", azulejo_psp_sample(context, mesh, &o, &points, NULL));
    o = psp_options(0.05);
    o.order = AZULEJO_ORDER_PROGRESSIVE;
    o.seed = 43;
    POINTS("ordered", azulejo_psp_sample(context, mesh, &o, &points, NULL));
    o.radius = 0;
    o.count = 1234;
    o.quotient = 1.3;
    o.seed = 44;
    POINTS("ordered count", azulejo_psp_sample(context, mesh, &o, &points, NULL));

    ACCEPTED(azulejo_classes_init(&classes, sizeof classes));
    ACCEPTED(azulejo_classes_radii(own, 3, 1, matrix));
    for (i = 0; i < COUNT_OF(masks); i++) masks[i] = i % 9 < 5 ? 7 : i % 8;
    classes.count = 3;
    classes.radii = matrix;
    classes.masks = masks;
    classes.mask_count = COUNT_OF(masks);
    o = psp_options(0);
    o.seed = 46;
    POINTS("classes", azulejo_psp_sample_classes(context, mesh, &o, &classes, &points, NULL));

    ACCEPTED(azulejo_psp_adaptive_options_init(&adaptive, sizeof adaptive));
    for (i = 0; i < COLUMNS * ROWS; i++) {
        const volatile float more = 0.03f * (torus_positions[i][0] + 1.4f);
        radii[i] = 0.02f + more;
    }
    adaptive.vertex_radii = radii;
    adaptive.vertex_count = COLUMNS * ROWS;
    adaptive.seed = 35;
    POINTS("adaptive vertices", azulejo_psp_adaptive_sample(context, mesh, &adaptive, &points, NULL));

    ACCEPTED(azulejo_dcr_surface_options_init(&relax, sizeof relax));
    relax.max_iterations = 30;
    POINTS("relax surface",
           azulejo_dcr_surface_relax(context, mesh, &relax, azulejo_points_triangles(filled),
                                     azulejo_points_barycentrics(filled), azulejo_points_count(filled), &points, NULL));
    azulejo_points_free(filled);
    azulejo_mesh_free(mesh);
}

/* The sum is that of the standard, and another text has another. */
static void sums_notice(void) {
    sha256 sum;
    char digits[65];
    sha256_init(&sum);
    sha256_add(&sum, "abc", 3);
    sha256_digits(&sum, digits);
    CHECK(strcmp(digits, "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad") == 0);
    sha256_init(&sum);
    sha256_add(&sum, "abd", 3);
    sha256_digits(&sum, digits);
    CHECK(strcmp(digits, "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad") != 0);
}

int main(void) {
    static const uint32_t threads[2] = {3, 1};
    /* Emulated and watched, one round takes long enough. */
    const size_t rounds = getenv("AZULEJO_ROUNDS") ? 1 : COUNT_OF(threads);
    size_t i;
    sums = read_sums();
    sums_notice();
    for (i = 0; i < rounds; i++) {
        context = make_context(threads[i]);
        planes();
        planes_of_parts();
        clouds();
        surfaces();
        azulejo_context_free(context);
    }
    free(sums);
    return finish();
}
