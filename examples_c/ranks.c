/* One plane made by many processes: each MPI rank makes a window of its own without communication.

       mpirun -n 4 ranks [--check] [radius [file]]

   Writes the samples of all ranks, x y as floats, one rank after the other, into the file, if there is one. With
   --check rank 0 also makes the whole plane alone and compares: each rank's window must be, bit for bit, what the whole
   has there. */

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <azulejo.h>
#include <mpi.h>

static void check(azulejo_status status) {
    char message[256];
    if (status == AZULEJO_OK) return;
    azulejo_last_error_message(message, sizeof message);
    fprintf(stderr, "ranks: %s\n", message);
    MPI_Abort(MPI_COMM_WORLD, EXIT_FAILURE);
}

static void *allocate(size_t bytes) {
    void *memory = malloc(bytes + 1);
    if (memory == NULL) {
        fprintf(stderr, "ranks: no memory for %zu bytes\n", bytes);
        MPI_Abort(MPI_COMM_WORLD, EXIT_FAILURE);
    }
    return memory;
}

/* The windows cut the domain into columns and rows, as nearly square as the number of ranks allows. Neighbours compute
   the same boundary from the same numbers. */
static void window_of(int rank, int ranks, const azulejo_kdrt_options *options, double min[2], double max[2]) {
    int cells[2] = {0, 0}, at[2], axis;
    MPI_Dims_create(ranks, 2, cells);
    at[0] = rank % cells[0];
    at[1] = rank / cells[0];
    for (axis = 0; axis < 2; axis++) {
        const double low = options->domain_min[axis], high = options->domain_max[axis];
        min[axis] = at[axis] == 0 ? low : low + (high - low) * at[axis] / cells[axis];
        max[axis] = at[axis] + 1 == cells[axis] ? high : low + (high - low) * (at[axis] + 1) / cells[axis];
    }
}

/* All ranks at once, each into its own part of the file. `sample` is the type of a sample. */
static void write_file(const char *name, const azulejo_points *points, unsigned long long before, MPI_Datatype sample) {
    MPI_File file;
    if (MPI_File_open(MPI_COMM_WORLD, name, MPI_MODE_CREATE | MPI_MODE_WRONLY, MPI_INFO_NULL, &file) ||
        MPI_File_set_size(file, 0) ||
        MPI_File_write_at_all(file, (MPI_Offset)(before * 2 * sizeof(float)), azulejo_points_positions(points),
                              (int)azulejo_points_count(points), sample, MPI_STATUS_IGNORE) ||
        MPI_File_close(&file)) {
        fprintf(stderr, "ranks: cannot write %s\n", name);
        MPI_Abort(MPI_COMM_WORLD, EXIT_FAILURE);
    }
}

/* Whether `xy` is what the whole plane has in a window: the same samples, bits and order. */
static int is_window_of(const azulejo_points *whole, const float *xy, size_t count, const double min[2],
                        const double max[2]) {
    const float *p = azulejo_points_positions(whole);
    size_t i, found = 0;
    for (i = 0; i < azulejo_points_count(whole); i++, p += 2) {
        if (p[0] < min[0] || p[0] >= max[0] || p[1] < min[1] || p[1] >= max[1]) continue;
        if (found == count || memcmp(p, xy + 2 * found, 2 * sizeof *p) != 0) return 0;
        found++;
    }
    return found == count;
}

/* On rank 0: gets the windows of all ranks, and returns how many differ from the whole. */
static int compare(const azulejo_context *context, const azulejo_kdrt_options *options, const azulejo_points *own,
                   int ranks, unsigned long long total, MPI_Datatype sample) {
    azulejo_points *whole;
    int rank, differing = 0;
    check(azulejo_kdrt_sample(context, options, &whole, NULL));
    if (azulejo_points_count(whole) != total) {
        fprintf(stderr, "ranks: the whole has %zu samples, the windows %llu\n", azulejo_points_count(whole), total);
        differing++;
    }
    for (rank = 0; rank < ranks; rank++) {
        double min[2], max[2];
        float *received = NULL;
        const float *xy = azulejo_points_positions(own);
        int count = (int)azulejo_points_count(own);
        if (rank > 0) {
            MPI_Status status;
            MPI_Probe(rank, 0, MPI_COMM_WORLD, &status);
            MPI_Get_count(&status, sample, &count);
            xy = received = allocate((size_t)count * 2 * sizeof *received);
            MPI_Recv(received, count, sample, rank, 0, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
        }
        window_of(rank, ranks, options, min, max);
        if (!is_window_of(whole, xy, (size_t)count, min, max)) {
            fprintf(stderr, "ranks: the window of rank %d is not that of the whole\n", rank);
            differing++;
        }
        free(received);
    }
    azulejo_points_free(whole);
    return differing;
}

int main(int argc, char **argv) {
    int rank, ranks, checking, differing = 0;
    unsigned long long count, before = 0, total;
    double min[2], max[2];
    azulejo_context *context;
    azulejo_kdrt_options options;
    azulejo_kdrt *plane;
    azulejo_points *points;
    MPI_Datatype sample;

    MPI_Init(&argc, &argv);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &ranks);
    MPI_Type_contiguous(2, MPI_FLOAT, &sample);
    MPI_Type_commit(&sample);
    checking = argc > 1 && strcmp(argv[1], "--check") == 0;
    argc -= checking;
    argv += checking;

    /* A thread per rank: mpirun starts one rank per core. The same options everywhere make it one plane. */
    check(azulejo_context_create(1, &context));
    check(azulejo_kdrt_options_init(&options, sizeof options));
    options.radius = argc > 1 ? atof(argv[1]) : 0.001;
    options.seed = 7;
    check(azulejo_kdrt_create(context, &options, &plane));
    window_of(rank, ranks, &options, min, max);
    check(azulejo_kdrt_window(plane, min, max, &points));

    count = azulejo_points_count(points);
    MPI_Exscan(&count, &before, 1, MPI_UNSIGNED_LONG_LONG, MPI_SUM, MPI_COMM_WORLD);
    if (rank == 0) before = 0; /* MPI leaves it undefined there */
    MPI_Allreduce(&count, &total, 1, MPI_UNSIGNED_LONG_LONG, MPI_SUM, MPI_COMM_WORLD);
    if (argc > 2) write_file(argv[2], points, before, sample);
    if (checking && rank > 0)
        MPI_Send(azulejo_points_positions(points), (int)count, sample, 0, 0, MPI_COMM_WORLD);
    if (checking && rank == 0) differing = compare(context, &options, points, ranks, total, sample);
    if (rank == 0)
        printf("%llu samples by %d ranks%s\n", total, ranks, !checking ? "" : differing ? ", wrong" : ", as made alone");

    azulejo_points_free(points);
    azulejo_kdrt_free(plane);
    azulejo_context_free(context);
    MPI_Type_free(&sample);
    MPI_Bcast(&differing, 1, MPI_INT, 0, MPI_COMM_WORLD);
    MPI_Finalize();
    return differing == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
