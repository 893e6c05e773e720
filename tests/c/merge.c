/* Merging: progress, and bad input, each refused with a message that names it, leaving the outputs alone. */

#include <math.h>

#include "samples.h"

#define INVALID AZULEJO_ERROR_INVALID_ARGUMENT
#define RADIUS 0.01
#define PIECE sizeof(azulejo_kdrt_merge_piece)

static azulejo_context *one, *four;

static void nothing_given(void) {
    azulejo_kdrt_merge_options options = merge_options(RADIUS);
    azulejo_kdrt_merge_piece empty = {NULL, 0, {0.25, 0.25}, {0.5, 0.5}};
    azulejo_points *points = NULL, *same = NULL;
    azulejo_kdrt_merge_report report = merge_report();
    ACCEPTED(azulejo_kdrt_merge(one, &options, NULL, 0, PIECE, NULL, 0, &points, &report));
    CHECK(report.inserted == azulejo_points_count(points) && report.kept == 0);
    ACCEPTED(azulejo_kdrt_merge(four, &options, &empty, 1, PIECE, NULL, 0, &same, NULL));
    CHECK(same_points(points, same));
    azulejo_points_free(points);
    azulejo_points_free(same);
}

/* Pieces of a later version, with a field that is not known here. */
typedef struct {
    azulejo_kdrt_merge_piece known;
    uint64_t later;
} later_piece;

static void pieces_of_other_sizes(void) {
    const float xy[4] = {0.1f, 0.1f, 0.6f, 0.6f};
    const azulejo_kdrt_merge_options options = merge_options(RADIUS);
    const azulejo_kdrt_merge_piece pieces[2] = {{xy, 1, {0, 0}, {0.5, 0.5}}, {xy + 2, 1, {0.5, 0.5}, {1, 1}}};
    later_piece later[2] = {{pieces[0], 0}, {pieces[1], 0}};
    azulejo_points *points = NULL, *same = NULL;
    ACCEPTED(azulejo_kdrt_merge(one, &options, pieces, 2, PIECE, NULL, 0, &points, NULL));
    ACCEPTED(azulejo_kdrt_merge(one, &options, &later->known, 2, sizeof *later, NULL, 0, &same, NULL));
    CHECK(same_points(points, same));
    azulejo_points_free(same);
    same = UNTOUCHED;
    later[1].later = 1;
    REFUSED(INVALID, "pieces: [1]", azulejo_kdrt_merge(one, &options, &later->known, 2, sizeof *later, NULL, 0, &same, NULL));
    REFUSED(INVALID, "piece_size: 40", azulejo_kdrt_merge(one, &options, pieces, 1, PIECE - 8, NULL, 0, &same, NULL));
    REFUSED(INVALID, "piece_size: 52", azulejo_kdrt_merge(one, &options, pieces, 1, PIECE + 4, NULL, 0, &same, NULL));
    REFUSED(INVALID, "piece_size: 0", azulejo_kdrt_merge(one, &options, NULL, 0, 0, NULL, 0, &same, NULL));
    CHECK(same == UNTOUCHED);
    azulejo_points_free(points);
}

static void pointers(void) {
    const float xy[4] = {0.1f, 0.1f, 0.2f, 0.2f}, *misaligned = (const float *)((const char *)xy + 2);
    azulejo_kdrt_merge_options good = merge_options(0.1);
    azulejo_kdrt_merge_piece piece = {NULL, 2, {0, 0}, {1, 1}};
    azulejo_points *out = UNTOUCHED;
    azulejo_kdrt_merge_report report, before;
    UNWRITTEN(report);
    before = report;
    REFUSED(INVALID, "context", azulejo_kdrt_merge(NULL, &good, NULL, 0, PIECE, xy, 2, &out, &report));
    REFUSED(INVALID, "options", azulejo_kdrt_merge(one, NULL, NULL, 0, PIECE, xy, 2, &out, &report));
    REFUSED(INVALID, "pieces: is NULL", azulejo_kdrt_merge(one, &good, NULL, 1, PIECE, xy, 2, &out, &report));
    REFUSED(INVALID, "pieces: ", azulejo_kdrt_merge(one, &good, (void *)misaligned, 1, PIECE, xy, 2, &out, &report));
    REFUSED(INVALID, "fixed: is NULL", azulejo_kdrt_merge(one, &good, NULL, 0, PIECE, NULL, 1, &out, &report));
    REFUSED(INVALID, "fixed: ", azulejo_kdrt_merge(one, &good, NULL, 0, PIECE, misaligned, 1, &out, &report));
    REFUSED(INVALID, "out", azulejo_kdrt_merge(one, &good, NULL, 0, PIECE, xy, 2, NULL, &report));
    REFUSED(INVALID, "pieces: [0].positions: is NULL", azulejo_kdrt_merge(one, &good, &piece, 1, PIECE, xy, 2, &out, &report));
    piece.positions = misaligned;
    REFUSED(INVALID, "pieces: [0].positions: ", azulejo_kdrt_merge(one, &good, &piece, 1, PIECE, xy, 2, &out, &report));
    piece.positions = xy;
    piece.count = SIZE_MAX / 8 + 2;
    REFUSED(AZULEJO_ERROR_TOO_LARGE, "pieces: [0].count", azulejo_kdrt_merge(one, &good, &piece, 1, PIECE, xy, 2, &out, &report));
    REFUSED(AZULEJO_ERROR_TOO_LARGE, "piece_count", azulejo_kdrt_merge(one, &good, &piece, SIZE_MAX, PIECE, xy, 2, &out, &report));
    REFUSED(AZULEJO_ERROR_TOO_LARGE, "fixed_count", azulejo_kdrt_merge(one, &good, NULL, 0, PIECE, xy, SIZE_MAX, &out, &report));
    CHECK(out == UNTOUCHED && memcmp(&report, &before, sizeof report) == 0);
}

static void values(void) {
    azulejo_points *out = UNTOUCHED;
    azulejo_kdrt_merge_report report, before;
    UNWRITTEN(report);
    before = report;
#define MERGE(status, part, change)                                                         \
    do {                                                                                    \
        azulejo_kdrt_merge_options o = merge_options(0.1);                                       \
        float xy[3][2] = {{0.1f, 0.1f}, {0.3f, 0.3f}, {0.1f, 0.9f}};                        \
        float fixed[2][2] = {{0.5f, 0.5f}, {0.75f, 0.5f}};                                  \
        azulejo_kdrt_merge_piece pieces[2] = {{xy[0], 3, {0, 0}, {0.5, 1}}, {NULL, 0, {0.5, 0}, {1, 1}}}; \
        (void)(change);                                                                     \
        REFUSED(status, part, azulejo_kdrt_merge(one, &o, pieces, 2, PIECE, fixed[0], 2, &out, &report)); \
    } while (0)
    MERGE(INVALID, "radius", o.radius = 0);
    MERGE(INVALID, "radius", o.radius = NAN);
    MERGE(INVALID, "radius", (o.domain_min[0] = -1e6, o.domain_max[0] = 1e6)); /* floats are too coarse there */
    MERGE(INVALID, "domain_min", o.domain_min[1] = NAN);
    MERGE(INVALID, "domain_max", o.domain_max[0] = 0);
    MERGE(INVALID, "boundary", o.boundary = 2);
    MERGE(INVALID, "maximal_pieces", o.maximal_pieces = 2);
    MERGE(INVALID, "reserved", o.reserved = 1);
    MERGE(AZULEJO_ERROR_TOO_LARGE, "radius", o.radius = 8.3461e-7);
    MERGE(INVALID, "fixed: point 1 is (NaN", fixed[1][0] = NAN);
    MERGE(INVALID, "fixed: point 0 is (", fixed[0][1] = 1);
    MERGE(INVALID, "fixed: point 1 is (", fixed[1][1] = -INFINITY);
    MERGE(INVALID, "fixed: points 0 and 1 are 0.0", fixed[1][0] = 0.5f);
    MERGE(INVALID, "fixed: points 0 and 1 are 0.0625 apart", fixed[1][0] = 0.5625f);
    MERGE(INVALID, "fixed: points 0 and 1 are 0.0", (fixed[0][0] = 0.01f, fixed[1][0] = 0.95f)); /* over the seam */
    MERGE(INVALID, "pieces: [0]: sample 2 is (", xy[2][1] = NAN);
    MERGE(INVALID, "pieces: [0]: sample 1 is (", xy[1][0] = 0.5f);
    MERGE(INVALID, "pieces: [0]: samples 0 and 2 are ", xy[2][1] = 0.15f);
    MERGE(INVALID, "pieces: [1] reaches on axis 0 from 0.5 to 1.5", pieces[1].max[0] = 1.5);
    MERGE(INVALID, "pieces: [1] reaches on axis 1", pieces[1].min[1] = NAN);
    MERGE(INVALID, "pieces: [1] reaches on axis 1", pieces[1].max[1] = 0);
    MERGE(INVALID, "pieces: [0] reaches on axis 1 from 0 to 1, which", o.domain_max[1] = 0.95);
    MERGE(INVALID, "pieces: the rectangles of [0] and [1] overlap", pieces[1].min[0] = 0.4999999);
#undef MERGE
    CHECK(out == UNTOUCHED && memcmp(&report, &before, sizeof report) == 0);
}

static uint32_t stop_at(void *user, double done) { return done >= *(const double *)user; }

static void cancelled(const azulejo_context *context) {
    double limits[] = {0, 0.2, 0.5, 1};
    azulejo_points *out = UNTOUCHED;
    size_t i;
    for (i = 0; i < COUNT_OF(limits); i++) {
        azulejo_kdrt_merge_options options = merge_options(0.002);
        options.progress = stop_at;
        options.progress_user = &limits[i];
        REFUSED(AZULEJO_ERROR_CANCELLED, "cancelled", azulejo_kdrt_merge(context, &options, NULL, 0, PIECE, NULL, 0, &out, NULL));
    }
    CHECK(out == UNTOUCHED);
}

int main(void) {
    one = make_context(1);
    four = make_context(4);
    nothing_given();
    pieces_of_other_sizes();
    pointers();
    values();
    cancelled(one);
    cancelled(four);
    azulejo_context_free(one);
    azulejo_context_free(four);
    return finish();
}
