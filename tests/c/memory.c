/* Nothing stays: after 1,000 rounds of making and freeing everything, memory, threads and open files are what they were.
   AZULEJO_ROUNDS makes it fewer, for tools that are slow and look for leaks by themselves. */

#include <dirent.h>
#include <malloc.h>
#include <unistd.h>

#include "samples.h"

static float random_xy[100];

static void one_round(uint32_t num_threads, int32_t engine) {
    azulejo_context *context = make_context(num_threads);
    azulejo_mesh *mesh = make_cube(), *masked = NULL, *missing = NULL;
    azulejo_kdrt_options plane = kdrt_options(0.1);
    azulejo_psp_options surface = psp_options(0.3);
    azulejo_dcr_options relax = dcr_options(3);
    const uint8_t mask[12] = {1, 1, 0, 1};
    azulejo_points *points[5] = {NULL};
    azulejo_psp *set = NULL;
    size_t i;
    surface.engine = engine;
    ACCEPTED(azulejo_mesh_with_mask(mesh, mask, 12, &masked));
    ACCEPTED(azulejo_kdrt_sample(context, &plane, &points[0], NULL));
    ACCEPTED(azulejo_psp_sample(context, mesh, &surface, &points[1], NULL));
    ACCEPTED(azulejo_dcr_relax(context, &relax, random_xy, COUNT_OF(random_xy) / 2, &points[2], NULL));
    ACCEPTED(azulejo_psp_create(context, masked, &surface, &set));
    ACCEPTED(azulejo_psp_advance(set, 1, NULL));
    ACCEPTED(azulejo_psp_points(set, &points[3]));
    CHECK(azulejo_mesh_load("/no/such/file", &missing) == AZULEJO_ERROR_IO);
    plane.radius = -1;
    CHECK(azulejo_kdrt_sample(context, &plane, &points[4], NULL) == AZULEJO_ERROR_INVALID_ARGUMENT);
    /* In any order. */
    azulejo_context_free(context);
    azulejo_mesh_free(masked);
    azulejo_psp_free(set);
    for (i = 0; i < COUNT_OF(points); i++) azulejo_points_free(points[i]);
    azulejo_mesh_free(mesh);
}

static void rounds(int count) {
    int i;
    for (i = 0; i < count; i++) {
        const int embree = azulejo_has_embree() && i % 2;
        one_round(1 + (uint32_t)(i % 3), embree ? AZULEJO_ENGINE_EMBREE : AZULEJO_ENGINE_RASTERISER);
    }
}

static int entries(const char *folder) {
    DIR *open = opendir(folder);
    int count = 0;
    if (open == NULL) return -1;
    while (readdir(open) != NULL) count++;
    closedir(open);
    return count;
}

/* How many threads there are when no more of them end: contexts do not wait for theirs. */
static int threads_left(void) {
    int before, now = entries("/proc/self/task"), quiet = 0;
    while (quiet < 20) {
        usleep(10000);
        before = now;
        now = entries("/proc/self/task");
        quiet = now < before ? 0 : quiet + 1;
    }
    return now;
}

static size_t bytes_in_use(void) {
    const struct mallinfo2 info = mallinfo2();
    return info.uordblks + info.hblkhd;
}

int main(int argc, char **argv) {
    const char *fewer = getenv("AZULEJO_ROUNDS");
    const int count = fewer != NULL ? atoi(fewer) : 1000;
    int threads, files;
    size_t bytes;
    (void)argc;
    /* Chunks that the C library keeps at hand for a thread count as used: it starts again without. */
    if (fewer == NULL && getenv("GLIBC_TUNABLES") == NULL) {
        setenv("GLIBC_TUNABLES", "glibc.malloc.tcache_count=0", 1);
        execv("/proc/self/exe", argv);
    }
    random_points(random_xy, COUNT_OF(random_xy) / 2);
    rounds(12); /* what Embree, TBB and the C library keep for the process */
    threads = threads_left(), files = entries("/proc/self/fd"), bytes = bytes_in_use();
    rounds(count);
    CHECK(threads_left() <= threads);
    CHECK(entries("/proc/self/fd") == files);
    if (fewer == NULL && !CHECK(bytes_in_use() <= bytes + 65536))
        printf("    %zu bytes before, %zu after\n", bytes, bytes_in_use());
    return finish();
}
