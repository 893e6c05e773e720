/* Runs tph_poisson, which is in no registry of packages: tph NAME COUNT RADIUS OUT
 *
 *     cc -O3 -march=native -DNDEBUG -I <folder of thinks/tph_poisson.h> studies/peers/tph.c -o tph -lm
 *
 * NAME is tph_30 or tph_300, by the attempts. Writes samples of the unit cube to OUT, raw doubles, and prints seconds, seconds
 * of processor time and 0 megabytes: memory is not measured.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#define TPH_POISSON_IMPLEMENTATION
#include "thinks/tph_poisson.h"

static double seconds(clockid_t clock)
{
    struct timespec time;
    clock_gettime(clock, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

int main(int count, char *arguments[])
{
    const tph_poisson_real low[3] = { 0, 0, 0 }, high[3] = { 1, 1, 1 };
    tph_poisson_args args;
    tph_poisson_sampling sampling;
    const tph_poisson_real *samples;
    double start, busy;
    FILE *out;
    ptrdiff_t i;

    if (count != 5)
        return 1;
    memset(&args, 0, sizeof args);
    memset(&sampling, 0, sizeof sampling);
    args.bounds_min = low;
    args.bounds_max = high;
    args.radius = (tph_poisson_real)atof(arguments[3]);
    args.ndims = 3;
    args.max_sample_attempts = strcmp(arguments[1], "tph_300") == 0 ? 300 : 30;
    args.seed = 1;
    start = seconds(CLOCK_MONOTONIC);
    busy = seconds(CLOCK_PROCESS_CPUTIME_ID);
    if (tph_poisson_create(&args, NULL, &sampling) != TPH_POISSON_SUCCESS)
        return 1;
    busy = seconds(CLOCK_PROCESS_CPUTIME_ID) - busy;
    start = seconds(CLOCK_MONOTONIC) - start;
    samples = tph_poisson_get_samples(&sampling);
    out = fopen(arguments[4], "wb");
    if (out == NULL || samples == NULL)
        return 1;
    for (i = 0; i < 3 * sampling.nsamples; i++) {
        const double value = (double)samples[i];
        if (fwrite(&value, sizeof value, 1, out) != 1)
            return 1;
    }
    tph_poisson_destroy(&sampling);
    if (fclose(out) != 0)
        return 1;
    printf("%.9f %.9f 0\n", start, busy);
    return 0;
}
