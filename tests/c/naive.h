/* What a set of samples owes, checked in the plainest way, without the library: distances of all pairs, and coverage by
   the crossings of circles. All loops are over all samples; sets of some thousand are checked in less than a second. */

#ifndef AZULEJO_TESTS_NAIVE_H
#define AZULEJO_TESTS_NAIVE_H

#include <math.h>

#include "check.h"

/* The smallest distance of two of the points of `dimension` coordinates; of a domain that wraps with these periods. */
static inline double naive_smallest(const float *points, size_t count, size_t dimension, const double *periods) {
    double smallest = INFINITY;
    size_t i, j, axis;
    for (i = 0; i < count; i++)
        for (j = 0; j < i; j++) {
            double squares = 0;
            for (axis = 0; axis < dimension; axis++) {
                double d = fabs((double)points[dimension * i + axis] - points[dimension * j + axis]);
                if (periods != NULL && d > periods[axis] / 2) d = periods[axis] - d;
                squares += d * d;
            }
            smallest = fmin(smallest, squares);
        }
    return sqrt(smallest);
}

typedef struct {
    double x, y, radius;
} naive_disk;

/* Whether a place of the rectangle is outside the interiors of all disks but two, on whose boundaries it lies. */
static inline int naive_is_open(const naive_disk *disks, const size_t *near, size_t count, const naive_disk *one,
                                const naive_disk *other, double x, double y, const double *low, const double *high) {
    size_t k;
    if (!(low[0] <= x && x <= high[0] && low[1] <= y && y <= high[1])) return 0;
    for (k = 0; k < count; k++) {
        const naive_disk *disk = &disks[near[k]];
        if (disk != one && disk != other && hypot(x - disk->x, y - disk->y) < disk->radius) return 0;
    }
    return 1;
}

/* How many places prove that closed disks leave a gap in a rectangle: what is left open has a corner where two circles
   cross, or a circle and the boundary, or at a corner of the rectangle; or there is a circle with nothing at it. */
static inline size_t naive_gaps(const naive_disk *disks, size_t count, const double *low, const double *high) {
    size_t *near = malloc((count + 1) * sizeof *near), gaps = 0, found, i, k;
    int side, corner, sign;
    for (corner = 0; corner < 4; corner++) {
        const double x = corner % 2 ? high[0] : low[0], y = corner / 2 ? high[1] : low[1];
        for (i = 0; i < count && hypot(x - disks[i].x, y - disks[i].y) > disks[i].radius; i++) continue;
        gaps += i == count;
    }
    for (i = 0; i < count; i++) {
        const naive_disk *disk = &disks[i];
        for (found = 0, k = 0; k < count; k++) {
            const double reach = disk->radius + disks[k].radius, x = disks[k].x - disk->x, y = disks[k].y - disk->y;
            if (x * x + y * y < reach * reach) near[found++] = k;
        }
        for (k = 0; k < found; k++) {
            const naive_disk *other = &disks[near[k]];
            const double x = other->x - disk->x, y = other->y - disk->y, distance = hypot(x, y);
            const double power = (disk->radius - other->radius) * (disk->radius + other->radius);
            const double along = (distance + power / distance) / 2;
            const double across = sqrt(disk->radius * disk->radius - along * along);
            if (other <= disk || !(across >= 0)) continue;
            for (sign = -1; sign <= 1; sign += 2)
                gaps += naive_is_open(disks, near, found, disk, other,
                                      disk->x + (along * x - sign * across * y) / distance,
                                      disk->y + (along * y + sign * across * x) / distance, low, high);
        }
        for (side = 0; side < 4; side++) {
            const double at = side % 2 ? high[side / 2] : low[side / 2];
            const double off = at - (side / 2 ? disk->y : disk->x);
            const double half = sqrt(disk->radius * disk->radius - off * off);
            for (sign = -1; sign <= 1 && half >= 0; sign += 2) {
                const double x = side / 2 ? disk->x + sign * half : at, y = side / 2 ? at : disk->y + sign * half;
                gaps += naive_is_open(disks, near, found, disk, disk, x, y, low, high);
            }
        }
        for (side = 0; side < 4; side++) {
            const double by = side % 2 ? disk->radius : -disk->radius;
            gaps += naive_is_open(disks, near, found, disk, disk, disk->x + (side / 2 ? 0 : by),
                                  disk->y + (side / 2 ? by : 0), low, high);
        }
    }
    free(near);
    return gaps;
}

/* The gaps of disks of one radius around points of a domain, and if it is periodic around their copies next to it. */
static inline size_t naive_gaps_of_plane(const float *xy, size_t count, double radius, const double *low,
                                         const double *high, int is_periodic) {
    naive_disk *disks = malloc((9 * count + 1) * sizeof *disks);
    const double width = high[0] - low[0], height = high[1] - low[1];
    size_t found = 0, gaps, i;
    int copy;
    for (i = 0; i < count; i++)
        for (copy = 0; copy < 9; copy++) {
            const double x = xy[2 * i] + (copy % 3 - 1) * width, y = xy[2 * i + 1] + (copy / 3 - 1) * height;
            const naive_disk disk = {x, y, radius};
            if (copy != 4 && (!is_periodic || disk.x < low[0] - radius || disk.x > high[0] + radius ||
                              disk.y < low[1] - radius || disk.y > high[1] + radius))
                continue;
            disks[found++] = disk;
        }
    gaps = naive_gaps(disks, found, low, high);
    free(disks);
    return gaps;
}

/* The gaps of balls of one radius around points on a face of the unit cube, of which they cut disks: face 2 * axis is at 0
   along the axis, the next one at 1. */
static inline size_t naive_gaps_of_face(const float *xyz, size_t count, double radius, size_t face) {
    const double low[2] = {0, 0}, high[2] = {1, 1};
    naive_disk *disks = malloc((count + 1) * sizeof *disks);
    const size_t axis = face / 2;
    size_t gaps, found = 0, i;
    for (i = 0; i < count; i++) {
        const float *p = &xyz[3 * i];
        const double off = p[axis] - (double)(face % 2), square = radius * radius - off * off;
        const naive_disk disk = {p[(axis + 1) % 3], p[(axis + 2) % 3], sqrt(fmax(square, 0))};
        if (square > 0) disks[found++] = disk;
    }
    gaps = naive_gaps(disks, found, low, high);
    free(disks);
    return gaps;
}

/* The gaps on all six faces. */
static inline size_t naive_gaps_of_cube(const float *xyz, size_t count, double radius) {
    size_t gaps = 0, face;
    for (face = 0; face < 6; face++) gaps += naive_gaps_of_face(xyz, count, radius, face);
    return gaps;
}

#endif
