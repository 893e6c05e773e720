/* num_threads, measured for each call that works: how many threads exist, and how many of them work. */

#include <dirent.h>
#include <time.h>
#include <unistd.h>

#include "samples.h"

enum { MOST = 256 };

/* The threads of this process by name, and the nanoseconds that they have worked. */
typedef struct {
    int count, ours;
    long id[MOST];
    unsigned long long work[MOST];
} census;

static void read_line(long task, const char *file, char *line, size_t size) {
    char path[64];
    FILE *open;
    snprintf(path, sizeof path, "/proc/self/task/%ld/%s", task, file);
    line[0] = '\0';
    open = fopen(path, "r");
    if (open == NULL) return; /* it has just ended */
    if (fgets(line, (int)size, open) == NULL) line[0] = '\0';
    fclose(open);
}

static void take(census *now) {
    DIR *tasks = opendir("/proc/self/task");
    struct dirent *entry;
    char line[128];
    memset(now, 0, sizeof *now);
    if (!CHECK(tasks != NULL)) return;
    while ((entry = readdir(tasks)) != NULL && now->count < MOST) {
        const long task = atol(entry->d_name);
        if (task == 0) continue;
        read_line(task, "comm", line, sizeof line);
        now->ours += strncmp(line, "azulejo-", 8) == 0;
        read_line(task, "schedstat", line, sizeof line);
        now->id[now->count] = task;
        now->work[now->count++] = strtoull(line, NULL, 10);
    }
    closedir(tasks);
}

/* How many threads but the caller's have worked for 2 ms and a fiftieth of the whole work; and the whole, in `all`. */
static int workers(const census *before, const census *after, unsigned long long *all) {
    unsigned long long done[MOST];
    int i, j, count = 0;
    *all = 0;
    for (i = 0; i < after->count; i++) {
        done[i] = after->work[i];
        for (j = 0; j < before->count; j++) {
            if (before->id[j] == after->id[i]) done[i] -= before->work[j];
        }
        *all += done[i];
    }
    for (i = 0; i < after->count; i++)
        count += after->id[i] != (long)getpid() && done[i] > 2000000 && done[i] > *all / 50;
    return count;
}

static double now_in_ns(void) {
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return 1e9 * (double)now.tv_sec + (double)now.tv_nsec;
}

static azulejo_context *context;
static azulejo_mesh *cube;
static float *random_xy;
enum { POINTS = 100000, TRIES = 10 };

static azulejo_status kdrt(azulejo_points **out) {
    const azulejo_kdrt_options o = kdrt_options(0.0008);
    return azulejo_kdrt_sample(context, &o, out, NULL);
}

static azulejo_status counted(azulejo_points **out) {
    azulejo_kdrt_options o = kdrt_options(0);
    o.count = 300000;
    return azulejo_kdrt_sample(context, &o, out, NULL);
}

static azulejo_status window(azulejo_points **out) {
    const double low[2] = {0.1, 0.1}, high[2] = {0.9, 0.9};
    const azulejo_kdrt_options o = kdrt_options(0.0008);
    return azulejo_kdrt_sample_window(context, &o, low, high, out, NULL);
}

static uint32_t ignore(void *user, const float *xy, size_t count) {
    (void)user, (void)xy, (void)count;
    return 0;
}

static azulejo_status stream(azulejo_points **out) {
    const azulejo_kdrt_options o = kdrt_options(0.0008);
    *out = NULL;
    return azulejo_kdrt_stream(context, &o, ignore, NULL, NULL);
}

static azulejo_status maximal(azulejo_points **out) {
    const azulejo_maximal_options o = maximal_options(0.002);
    return azulejo_maximal_sample(context, &o, out, NULL);
}

static azulejo_status merge(azulejo_points **out) {
    const azulejo_kdrt_merge_options o = merge_options(0.002);
    return azulejo_kdrt_merge(context, &o, NULL, 0, sizeof(azulejo_kdrt_merge_piece), NULL, 0, out, NULL);
}

static azulejo_status psp(azulejo_points **out) {
    azulejo_psp_options o = psp_options(0.008);
    o.iterations = 1;
    return azulejo_psp_sample(context, cube, &o, out, NULL);
}

static azulejo_status raster(azulejo_points **out) {
    azulejo_psp_options o = psp_options(0.008);
    o.iterations = 1;
    o.engine = AZULEJO_ENGINE_RASTERISER;
    return azulejo_psp_sample(context, cube, &o, out, NULL);
}

static azulejo_status adaptive(azulejo_points **out) {
    const float radii[8] = {0.01f, 0.01f, 0.01f, 0.01f, 0.02f, 0.02f, 0.02f, 0.02f};
    azulejo_psp_adaptive_options o;
    ACCEPTED(azulejo_psp_adaptive_options_init(&o, sizeof o));
    o.vertex_radii = radii;
    o.vertex_count = 8;
    return azulejo_psp_adaptive_sample(context, cube, &o, out, NULL);
}

static azulejo_status dcr(azulejo_points **out) {
    const azulejo_dcr_options o = dcr_options(10);
    return azulejo_dcr_relax(context, &o, random_xy, POINTS, out, NULL);
}

static azulejo_status nearest(azulejo_points **out) {
    azulejo_dcr_options o = dcr_options(10);
    o.method = AZULEJO_METHOD_THESIS;
    o.neighbourhood = AZULEJO_NEIGHBOURHOOD_NEAREST;
    return azulejo_dcr_relax(context, &o, random_xy, POINTS, out, NULL);
}

static azulejo_status measures(azulejo_points **out) {
    const double low[2] = {0, 0}, high[2] = {1, 1};
    double figure;
    azulejo_status status;
    *out = NULL;
    status = azulejo_plane_smallest_distance(context, PLANE(random_xy, POINTS, low, high, 0), &figure);
    if (status != AZULEJO_OK) return status;
    status = azulejo_plane_covering_radius(context, PLANE(random_xy, POINTS, low, high, 0), &figure);
    if (status != AZULEJO_OK) return status;
    status = azulejo_space_smallest_distance(context, random_xy, POINTS / 2, &figure);
    if (status != AZULEJO_OK) return status;
    return azulejo_mesh_uncovered_fraction(context, cube, random_xy, POINTS / 2, 0.01, 200000, 1, &figure);
}

static azulejo_status (*const calls[])(azulejo_points **) = {kdrt,     counted, window, stream,  maximal, merge,
                                                            raster,   adaptive, dcr,   nearest, measures, psp};

/* How many threads a call had work: never more than `expected`, and never more at once than `num_threads`. */
static int worked_in(size_t call, int num_threads, int expected) {
    azulejo_points *points = NULL;
    census before, after;
    unsigned long long work;
    double time;
    int worked;
    take(&before);
    time = now_in_ns();
    ACCEPTED(calls[call](&points));
    time = now_in_ns() - time;
    take(&after);
    azulejo_points_free(points);
    worked = workers(&before, &after, &work);
    if (!CHECK(worked <= expected)) printf("    call %d: %d threads worked, not %d\n", (int)call, worked, expected);
    if (!CHECK((double)work <= (num_threads + 0.1) * time + 5e6))
        printf("    call %d: %.2f threads at once instead of %d\n", (int)call, (double)work / time, num_threads);
    CHECK(after.ours == expected);
    /* Embree brings TBB along, whose threads build none of the library's scenes. */
    CHECK(after.count == before.count);
    return worked;
}

static void honoured(int num_threads) {
    /* With one there is none: the caller's works, which otherwise waits, prepares and tells. */
    const int expected = num_threads > 1 ? num_threads : 0;
    census start, before;
    size_t i;
    take(&start);
    context = make_context((uint32_t)num_threads);
    take(&before);
    CHECK(azulejo_context_num_threads(context) == (uint32_t)num_threads);
    CHECK(before.count == start.count + expected);
    for (i = 0; i < COUNT_OF(calls); i++) {
        /* A short call on a busy machine may end before the last thread has had its turn, but not again and again. */
        int tries, most = -1;
        for (tries = 0; tries < TRIES && most < expected; tries++) {
            const int worked = worked_in(i, num_threads, expected);
            if (worked > most) most = worked;
        }
        if (!CHECK(most == expected))
            printf("    call %d: %d of %d threads worked in %d tries\n", (int)i, most, expected, tries);
    }
    azulejo_context_free(context);
}

/* Until the threads of contexts that were freed have ended. */
static void settle(int count) {
    census now;
    int tries = 0;
    do {
        usleep(10000);
        take(&now);
    } while (now.ours > count && ++tries < 500);
    CHECK(now.ours == count);
}

int main(void) {
    int num_threads;
    random_xy = malloc(2 * POINTS * sizeof *random_xy);
    if (random_xy == NULL) return EXIT_FAILURE;
    random_points(random_xy, POINTS);
    cube = make_cube();
    for (num_threads = 1; num_threads <= 3; num_threads++) {
        honoured(num_threads);
        settle(0);
    }
    azulejo_mesh_free(cube);
    free(random_xy);
    return finish();
}
