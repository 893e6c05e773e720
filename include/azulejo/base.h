/*
 * What all calls share: status codes, contexts, points, orders, classes and meshes.
 *
 * Generated from ffi/azulejo-c by cbindgen; do not edit. The conventions are in azulejo.h.
 */

#ifndef AZULEJO_BASE_H
#define AZULEJO_BASE_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/// The call succeeded.
#define AZULEJO_OK 0

/// An argument or an option is outside its documented range.
#define AZULEJO_ERROR_INVALID_ARGUMENT -1

/// The call asks for more than can be indexed or held in memory. It is refused before memory is
/// taken; the message has the estimate.
#define AZULEJO_ERROR_TOO_LARGE -2

/// A file could not be read.
#define AZULEJO_ERROR_IO -3

/// A file was read, but its content is not valid.
#define AZULEJO_ERROR_FORMAT -4

/// A callback of the caller cancelled the call.
#define AZULEJO_ERROR_CANCELLED -5

/// There is no memory for a copy of the caller's arrays.
#define AZULEJO_ERROR_OUT_OF_MEMORY -6

/// Embree failed: it is not there, has no memory, or cannot build a scene.
#define AZULEJO_ERROR_EMBREE -7

/// Threads could not be started, or the context's threads are in the process from which this one
/// was forked.
#define AZULEJO_ERROR_THREADS -8

/// A handle is in use by another call, from another thread or around the callback that makes this
/// one. The same call succeeds later.
#define AZULEJO_ERROR_BUSY -9

/// The library was built without what the call needs: Embree. azulejo_has_embree tells before.
#define AZULEJO_ERROR_UNSUPPORTED -10

/// A bug in the library; please report it. Handles that took part in the call can only be freed.
#define AZULEJO_ERROR_INTERNAL -100

/// The result of a call: AZULEJO_OK or a negative AZULEJO_ERROR_ code. Codes are never reused;
/// later versions may add some.
typedef int32_t azulejo_status;

/// Copies the message of this thread's last failed call: one line of UTF-8, terminated by a NUL;
/// empty if no call has failed.
///
/// Calls that succeed leave the message as it is, so ask right after the call that failed. O(length
/// of the message).
///
/// buffer: receives at most `capacity` bytes including the NUL; a longer message is cut between two
/// characters. May be NULL if `capacity` is 0.
///
/// Returns the size of the whole message in bytes, including the NUL.
size_t azulejo_last_error_message(char *buffer, size_t capacity);

/// The name of a status: "AZULEJO_ERROR_BUSY" for AZULEJO_ERROR_BUSY. NULL for a number that is
/// none of this library's. The text is never freed.
const char *azulejo_status_name(azulejo_status status);

/// The major version of this header. It changes when programs must be changed.
#define AZULEJO_VERSION_MAJOR 0

/// The minor version of this header. It changes when something is added; before 1.0 also when
/// programs must be changed.
#define AZULEJO_VERSION_MINOR 3

/// The patch version of this header.
#define AZULEJO_VERSION_PATCH 0

/// The version of this header as one number: major * 10000 + minor * 100 + patch.
#define AZULEJO_VERSION 300

/// The version of the library that the program runs with, to be compared with AZULEJO_VERSION.
uint32_t azulejo_version(void);

/// 1 if the library was built with Embree, 0 otherwise. Without it AZULEJO_ENGINE_EMBREE and
/// azulejo_mesh_create_from_embree are refused with AZULEJO_ERROR_UNSUPPORTED, and everything else
/// is there: sets on meshes are filled, as by default, or projected by the rasteriser.
///
/// Embree is loaded by the first call that uses it. If the machine has none, such calls are refused
/// with AZULEJO_ERROR_EMBREE, and the message names the file that was not found.
uint32_t azulejo_has_embree(void);

/// Called repeatedly during a call, on the thread that made it. See "Progress" at the top.
///
/// user: the progress_user of the options or of azulejo_context_watch.
///
/// done: the fraction of the call that is done, from 0 to 1; it never decreases.
///
/// Returns 0 to continue, any other value to cancel the call.
typedef uint32_t (*azulejo_progress_fn)(void *user, double done);

/// A pool of threads, passed to every call that does long work. One context for a whole program is
/// usual; several threads may use it at once.
typedef struct azulejo_context azulejo_context;

/// Makes a context and starts its threads.
///
/// num_threads: the number of threads, 1 to 4096, or 0 for one per core. With 1 no thread is
/// started: all work happens on the calling thread.
///
/// out: the context, to be freed with azulejo_context_free.
///
/// Embree's scenes are built by as many threads, but not more than there are cores, and by none of
/// TBB's. Bounds that the program sets for TBB stay as they are. Embree, however, has one bound for
/// the whole process, the largest of its devices, and a scene of the library has none: where a
/// device of the program has one (threads=), it is suspended while a mesh exists on which a set has
/// made iterations with AZULEJO_ENGINE_EMBREE (or a handle of such a set).
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT; AZULEJO_ERROR_THREADS if the threads cannot be started.
azulejo_status azulejo_context_create(uint32_t num_threads, azulejo_context **out);

/// Makes a context that shares the threads of another one and adds a progress callback. The
/// callback is used by every call that is made with this context, or with a psp handle made with
/// it, and whose options have no callback of their own. So calls without options, such as the
/// analysis, can report progress and be cancelled.
///
/// context: the other context. It may be freed before this one. Its own callback, if any, is not
/// inherited.
///
/// progress: the callback, or NULL for none. Each thread that makes a call with the context calls
/// it.
///
/// progress_user: passed to the callback.
///
/// out: the context, to be freed with azulejo_context_free. No thread is started. O(1).
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT.
azulejo_status azulejo_context_watch(const azulejo_context *context,
                                     azulejo_progress_fn progress,
                                     void *progress_user,
                                     azulejo_context **out);

/// The number of threads that work on a call; 0 for NULL.
uint32_t azulejo_context_num_threads(const azulejo_context *context);

/// Frees a context. Its threads end when no call and no handle uses them any more. NULL is allowed.
void azulejo_context_free(azulejo_context *context);

/// The domain is a torus: distances wrap with the period domain_max - domain_min.
#define AZULEJO_BOUNDARY_PERIODIC 0

/// The domain ends at its edges: samples beyond them neither exist nor cover anything.
#define AZULEJO_BOUNDARY_BOUNDED 1

/// Points of the plane and their domain: the input of the calls that measure them.
typedef struct azulejo_plane_set {
    /// The size of the struct in bytes; set by the _init function.
    uint32_t struct_size;
    /// An AZULEJO_BOUNDARY_ constant; default periodic.
    uint32_t boundary;
    /// The points, x y each, with domain_min <= x < domain_max on both axes. Default NULL: none.
    const float *positions;
    /// The number of points; default 0.
    size_t count;
    /// The lower corner of the domain, x y; finite; default 0 0.
    double domain_min[2];
    /// The upper corner of the domain, x y; finite and above the lower corner on both axes; default
    /// 1 1. Neither side may be longer than 2^100 times the other.
    double domain_max[2];
} azulejo_plane_set;

/// Writes the defaults: no points on the unit torus. `struct_size` is sizeof *set.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT.
azulejo_status azulejo_plane_set_init(azulejo_plane_set *set, size_t struct_size);

/// In no particular order.
#define AZULEJO_ORDER_ANY 0

/// Coarse to fine: the first points are a sparser set of the same kind, whatever their number.
#define AZULEJO_ORDER_PROGRESSIVE 1

/// The samples that a call made. Immutable: several threads may read it at once. All its arrays
/// have one entry per sample, in the same order, and are valid until azulejo_points_free.
typedef struct azulejo_points azulejo_points;

/// The number of samples; 0 for NULL.
size_t azulejo_points_count(const azulejo_points *points);

/// The number of coordinates of a position: 2 for samples of the plane, 3 for samples on a mesh; 0
/// for NULL.
uint32_t azulejo_points_dimension(const azulejo_points *points);

/// The positions, x y or x y z of each sample, interleaved; NULL for NULL and for an empty set.
///
/// Samples of the plane lie in domain_min <= x < domain_max. Samples on a mesh lie on their
/// triangle, up to the rounding of the floats: they are computed from the barycentrics in double
/// arithmetic and rounded once.
const float *azulejo_points_positions(const azulejo_points *points);

/// The unit normals of the samples' triangles, x y z each, on the side from which their vertices
/// appear counter-clockwise, whether or not the mesh carries normals of its own. NULL for NULL, an
/// empty set and samples of the plane.
const float *azulejo_points_normals(const azulejo_points *points);

/// The normals that the mesh carries, from azulejo_mesh_with_normals or from its file, interpolated
/// with the samples' barycentrics and normalised, x y z each; the normal of the triangle where the
/// sum is zero. NULL for a mesh without normals, NULL, an empty set and samples of the plane.
const float *azulejo_points_interpolated_normals(const azulejo_points *points);

/// The index of each sample's triangle; NULL for NULL, an empty set and samples of the plane.
const uint32_t *azulejo_points_triangles(const azulejo_points *points);

/// The barycentric coordinates u v of each sample in its triangle (a, b, c), as in Embree: the
/// position is (1-u-v)*a + u*b + v*c, and other attributes of the vertices are interpolated in the
/// same manner. NULL for NULL, an empty set and samples of the plane.
const float *azulejo_points_barycentrics(const azulejo_points *points);

/// The radius of each sample of azulejo_psp_adaptive_sample and azulejo_psp_adaptive_with_density,
/// in the units of the mesh; NULL for NULL, an empty set and all other sets.
const double *azulejo_points_radii(const azulejo_points *points);

/// The ranks of the samples of a set in progressive order, in the units of the domain or the mesh:
/// for each sample the distance to the nearest one that was there when it was accepted, or on
/// meshes a little less, rounded down to a float. They never rise. The first i samples are at least
/// as far apart as the i-th rank. NULL for NULL, an empty set and sets in any order.
///
/// No place is farther from the first i samples than the quotient of the options times the i-th
/// rank, and 6 float spacings at the largest coordinate; if i is below 100, than twice the rank, or
/// the square of the quotient times it if that is more. In the plane this holds from the samples
/// of the coarsest level on, those with the rank of the first: one sample only, unless the options
/// have a shorter `coarsest` radius. On meshes it holds for every i; the first rank is infinite.
///
/// Where radii vary, distances are divided by the mean of two radii: see
/// azulejo_psp_adaptive_sample, and for a density azulejo_psp_adaptive_with_density.
const float *azulejo_points_ranks(const azulejo_points *points);

/// The class of each sample of a set of several classes, its row in the matrix of azulejo_classes;
/// NULL for NULL, an empty set and sets made without classes.
const uint32_t *azulejo_points_classes(const azulejo_points *points);

/// The ids of the samples of a set that is edited (azulejo_plane_erase, azulejo_psp_erase): a
/// sample keeps its id as long as it stands, and no other one ever gets it. NULL for NULL, an empty
/// set and all other sets.
const uint64_t *azulejo_points_ids(const azulejo_points *points);

/// Frees the set with all its arrays. NULL is allowed.
void azulejo_points_free(azulejo_points *points);

/// A part of space: the points that lie in a box and within a distance of a centre, the boundary
/// included. Both are without end by default: set `centre` and `radius` for a ball, `min` and `max`
/// for a box, or all four for what they have in common. The plane lies at the height 0: there a
/// ball is a disk, and `min` and `max` need x and y alone.
typedef struct azulejo_region {
    /// The size of the struct in bytes; set by the _init function.
    uint32_t struct_size;
    /// Must be 0.
    uint32_t reserved;
    /// The lowest coordinates of the box; default minus infinity.
    double min[3];
    /// The highest coordinates of the box, not below `min`; default infinity.
    double max[3];
    /// The centre of the ball, finite; default 0.
    double centre[3];
    /// The radius of the ball, 0 or more; default infinity.
    double radius;
} azulejo_region;

/// Writes the defaults: all of space. `struct_size` is sizeof *region.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT.
azulejo_status azulejo_region_init(azulejo_region *region, size_t struct_size);

/// No set has more classes.
#define AZULEJO_MAX_CLASSES 16

/// Classes of samples that stand in each other's way: the matrix of their distances. Samples of
/// classes i and j are at least r_ij apart, and no class can take another sample: for each class i
/// every place is within r_ij of some sample of some class j.
///
/// Classes of larger own radii r_ii come first, those of smaller ones fill what these leave them;
/// classes of equal radii are treated alike. So two radii that are nearly equal give other shares
/// than two equal ones: of own radii 1 and 0.9 the first class has its full density.
typedef struct azulejo_classes {
    /// The size of the struct in bytes; set by the _init function.
    uint32_t struct_size;
    /// The number of classes, 1 to AZULEJO_MAX_CLASSES. Required.
    uint32_t count;
    /// count * count radii, row by row, in the units of the domain or mesh; symmetric, finite, 0 or
    /// more, and above 0 on the diagonal. Two classes whose radius is 0 ignore each other.
    /// azulejo_classes_radii makes such a matrix. Required; read during the call only.
    const double *radii;
    /// On meshes, where each class may stand: for each triangle a number with a bit for each
    /// class, the lowest for class 0. A class has no samples, and needs no cover, where its bit is
    /// 0; other bits are ignored. If the mesh has a mask, both must allow a sample. NULL, the
    /// default: all classes may stand everywhere. Read during the call only.
    const uint32_t *masks;
    /// The number of masks: that of the mesh's triangles, or 0 if there are none. Default 0.
    size_t mask_count;
} azulejo_classes;

/// The report of azulejo_kdrt_sample_classes and azulejo_psp_sample_classes.
typedef struct azulejo_classes_report {
    /// The size of the struct in bytes; set by the _init function.
    uint32_t struct_size;
    /// The number of classes.
    uint32_t classes;
    /// The number of samples.
    uint64_t samples;
    /// The number of samples of each class, 0 for those that there are not.
    uint64_t counts[AZULEJO_MAX_CLASSES];
    /// Wall time in seconds.
    double seconds;
} azulejo_classes_report;

/// Writes the defaults. `struct_size` is sizeof *classes.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT.
azulejo_status azulejo_classes_init(azulejo_classes *classes, size_t struct_size);

/// Writes zeros and the size. `struct_size` is sizeof *report.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT.
azulejo_status azulejo_classes_report_init(azulejo_classes_report *report,
                                           size_t struct_size);

/// Makes a matrix of radii from those of each class alone, as in Wei, "Multi-class blue noise
/// sampling", 2010: two classes keep the distance that a set of all samples of both, and of all
/// classes of larger radii, would have.
///
/// own: for each class the distance of its samples, positive and finite; `count` numbers.
///
/// count: the number of classes, 1 to AZULEJO_MAX_CLASSES.
///
/// factor: what the radii of two different classes are multiplied by, finite and 0 or more; 1 for
/// Wei's. Smaller factors leave each class nearer to the density that it has alone, and let samples
/// of two classes come nearer to each other.
///
/// out: count * count numbers, row by row.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT; then out is not written.
azulejo_status azulejo_classes_radii(const double *own, uint32_t count, double factor, double *out);

/// A checked triangle mesh. Immutable: several threads may use it at once. Any triangle soup is
/// accepted: open, non-manifold, of many parts and mixed winding. A mesh may carry normals and a
/// mask. Meshes made from one another share what they have in common.
typedef struct azulejo_mesh azulejo_mesh;

/// Makes a mesh from a copy of the caller's arrays.
///
/// positions: the vertices, x y z each, `stride_bytes` from one to the next; `vertex_count` of
/// them. What lies between is not read.
///
/// stride_bytes: a multiple of 4, at least 12.
///
/// indices: three per triangle, below `vertex_count`; triangles keep their order. Triangles without
/// area are allowed and get no samples.
///
/// out: the mesh, to be freed with azulejo_mesh_free.
///
/// O(vertices + triangles).
///
/// Memory: 12 bytes per vertex, 12 per triangle. What later calls make of the mesh whatever the
/// radius and the seed is kept with it, so that the next call does not pay for it again, on any
/// thread, and is freed with it: for any set, a summary of areas and edges, half a byte per
/// triangle, and one byte more from the second set of few samples or the first of many on (with a
/// mask, 4 bytes more for each that it keeps); for relaxation and triangulation, which edges are
/// shared, 12 bytes per triangle and 4 per vertex; for iterations of AZULEJO_ENGINE_EMBREE,
/// Embree's scene, about 100 bytes per triangle, and its device (see azulejo_context_create). A
/// mesh with other normals made from this one shares all that; one with another mask does not.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT for positions that are not finite, indices out of range,
/// no triangles, and triangles without any area; AZULEJO_ERROR_TOO_LARGE for 2^32 - 1 vertices or
/// triangles or more, and for sizes that overflow; AZULEJO_ERROR_OUT_OF_MEMORY.
azulejo_status azulejo_mesh_create(const float *positions,
                                   size_t vertex_count,
                                   size_t stride_bytes,
                                   const uint32_t *indices,
                                   size_t triangle_count,
                                   azulejo_mesh **out);

/// Loads a mesh from a file: Wavefront OBJ, PLY or STL (text and binary), distinguished by the
/// extension .obj, .ply or .stl, otherwise by the first bytes. Polygons become fans of triangles,
/// in the order of the faces. Vertices keep the order of the file; STL facets have three each,
/// which are not merged.
///
/// Normals of OBJ corners (vn) and of PLY vertices (nx ny nz) are read. In a file that has some, a
/// corner without a normal, or with one that is not finite, gets a zero normal: see
/// azulejo_mesh_with_normals. Points, lines, materials, texture coordinates, colours and normals of
/// STL facets are ignored.
///
/// path: the file name, terminated by a NUL: in the encoding of the operating system, on Windows in
/// UTF-8, whatever the code page.
///
/// out: the mesh, to be freed with azulejo_mesh_free.
///
/// O(size of the file), on the calling thread. The file is read block by block and is never in
/// memory as a whole; only an OBJ file with lines that go on in the next one, or with an error, is.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT; AZULEJO_ERROR_IO if the file cannot be read;
/// AZULEJO_ERROR_FORMAT if it is invalid, or has a mesh that azulejo_mesh_create would refuse.
azulejo_status azulejo_mesh_load(const char *path, azulejo_mesh **out);

/// Makes a mesh with the caller's normals in place of any that it has, such as the smooth ones of a
/// shaded surface. Samples are the same with and without; azulejo_points_interpolated_normals has
/// the normals at them.
///
/// mesh: the mesh, which is not changed.
///
/// normals: of any length, x y z each, `stride_bytes` from one to the next; `normal_count` of them.
/// Where the three normals of a triangle add up to zero at a sample, as zeros do, the sample gets
/// the normal of the triangle.
///
/// normal_count: the number of vertices, if there are no indices.
///
/// stride_bytes: a multiple of 4, at least 12.
///
/// normal_indices: three per triangle, below `normal_count`, for corners that share a vertex but
/// not its normal; NULL for one normal per vertex.
///
/// triangle_count: the number of triangles of the mesh; 0 if `normal_indices` is NULL.
///
/// out: the new mesh, to be freed with azulejo_mesh_free. It shares vertices, triangles and mask
/// with `mesh`; the two may be freed in any order.
///
/// O(normals + triangles).
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT for normals that are not finite or not as many as there
/// are vertices, and for indices out of range; AZULEJO_ERROR_TOO_LARGE for 2^32 - 1 normals or
/// more, and for sizes that overflow; AZULEJO_ERROR_OUT_OF_MEMORY.
azulejo_status azulejo_mesh_with_normals(const azulejo_mesh *mesh,
                                         const float *normals,
                                         size_t normal_count,
                                         size_t stride_bytes,
                                         const uint32_t *normal_indices,
                                         size_t triangle_count,
                                         azulejo_mesh **out);

/// Makes a mesh with a mask, in place of any that it has: triangles whose entry is 0 are left out
/// but keep their numbers. The rest is sampled, bit for bit, as if they did not exist: they get no
/// samples, have no area, and need not be covered. They do not separate anything either: samples on
/// both sides of them keep their distance through space. A mask may leave out everything; then a
/// maximal set is empty.
///
/// mesh: the mesh, which is not changed.
///
/// mask: one byte per triangle: 0 leaves it out, any other value keeps it.
///
/// triangle_count: the number of triangles of the mesh.
///
/// out: the new mesh, to be freed with azulejo_mesh_free. It shares vertices, triangles and normals
/// with `mesh`; the two may be freed in any order.
///
/// O(triangles).
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT for another count than that of the triangles;
/// AZULEJO_ERROR_OUT_OF_MEMORY.
azulejo_status azulejo_mesh_with_mask(const azulejo_mesh *mesh,
                                      const uint8_t *mask,
                                      size_t triangle_count,
                                      azulejo_mesh **out);

/// Makes a mesh with its vertices moved, such as for the next frame of an animation. Triangles and
/// mask stay; normals of azulejo_mesh_with_normals or of a file go. With azulejo_mesh_points the
/// samples of one mesh follow to the other.
///
/// mesh: the mesh, which is not changed.
///
/// positions: the vertices, x y z each, `stride_bytes` from one to the next; `vertex_count` of
/// them.
///
/// vertex_count: the number of vertices of the mesh.
///
/// stride_bytes: a multiple of 4, at least 12.
///
/// out: the new mesh, to be freed with azulejo_mesh_free. It shares triangles and mask with `mesh`;
/// the two may be freed in any order.
///
/// O(vertices + triangles).
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT for positions that are not finite or leave no area, and
/// for another count; AZULEJO_ERROR_OUT_OF_MEMORY.
azulejo_status azulejo_mesh_deform(const azulejo_mesh *mesh,
                                   const float *positions,
                                   size_t vertex_count,
                                   size_t stride_bytes,
                                   azulejo_mesh **out);

/// Evaluates places of a mesh, given by triangle and barycentrics, with the rounding of every
/// sampler: places of samples of this mesh give the samples, bit for bit, and on a mesh of
/// azulejo_mesh_deform each sample goes with its triangle.
///
/// triangles: the triangle of each place, below azulejo_mesh_triangle_count; `count` of them.
/// Triangles without area and masked triangles are allowed.
///
/// barycentrics: u v of each place, finite; `count` of them.
///
/// out: the positions with normals, triangles and barycentrics, in the same order, to be freed with
/// azulejo_points_free.
///
/// O(count).
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT; AZULEJO_ERROR_TOO_LARGE for sizes that overflow.
azulejo_status azulejo_mesh_points(const azulejo_mesh *mesh,
                                   const uint32_t *triangles,
                                   const float *barycentrics,
                                   size_t count,
                                   azulejo_points **out);

/// 1 if the mesh carries normals besides those of its triangles, else 0; 0 for NULL.
uint32_t azulejo_mesh_has_normals(const azulejo_mesh *mesh);

/// The number of vertices; 0 for NULL.
size_t azulejo_mesh_vertex_count(const azulejo_mesh *mesh);

/// The number of triangles, including masked ones; 0 for NULL.
size_t azulejo_mesh_triangle_count(const azulejo_mesh *mesh);

/// The vertices, x y z each, packed; valid until azulejo_mesh_free. NULL for NULL.
const float *azulejo_mesh_positions(const azulejo_mesh *mesh);

/// The three vertices of each triangle, counter-clockwise seen from the front; valid until
/// azulejo_mesh_free. NULL for NULL.
const uint32_t *azulejo_mesh_indices(const azulejo_mesh *mesh);

/// The area of all triangles that no mask leaves out, in squared units of the positions; 0 for
/// NULL. A maximal set of n samples has a radius of about sqrt(0.69656 * area / n), if that is
/// small compared with the features of the surface.
double azulejo_mesh_area(const azulejo_mesh *mesh);

/// Frees the mesh once no psp handle uses it any more. NULL is allowed.
void azulejo_mesh_free(azulejo_mesh *mesh);

/// A geometry of triangles in a scene that the program has made with Embree. Embree does not report
/// the sizes of its buffers, so the caller gives them.
typedef struct azulejo_embree_geometry {
    /// Its number in the scene.
    uint32_t geometry_id;
    /// Bytes from one vertex to the next: a multiple of 4, at least 12.
    uint32_t vertex_stride;
    /// Bytes from one triangle to the next: a multiple of 4, at least 12.
    uint32_t index_stride;
    /// Must be 0.
    uint32_t reserved;
    /// The vertices in its buffer of type RTC_BUFFER_TYPE_VERTEX, slot 0, of format
    /// RTC_FORMAT_FLOAT3.
    size_t vertex_count;
    /// The triangles in its buffer of type RTC_BUFFER_TYPE_INDEX, of format RTC_FORMAT_UINT3.
    size_t triangle_count;
} azulejo_embree_geometry;

/// Makes a mesh from a copy of the triangles of a scene that the program has made with Embree. The
/// scene and its device are not changed: neither flags nor error function nor thread count (but see
/// azulejo_context_create). The mesh does not need them after the call; its samples are traced in a
/// scene and on a device of the library's.
///
/// Triangles are numbered in the order of `geometries`: triangle i of the mesh is primitive i of
/// the first geometry, those of the second follow, and so on. The same holds for vertices.
///
/// scene: a committed RTCScene that no thread changes during the call. It must come from the
/// libembree that the program has linked or, where it has linked none that all its libraries see,
/// from the one that libazulejo loads by its SONAME: otherwise, as for an Embree that is linked
/// statically, the behaviour is undefined. Another version of a linked one is refused. Instances in
/// it are not followed.
///
/// geometries: `geometry_count` of them, at least one, each attached to the scene as
/// RTC_GEOMETRY_TYPE_TRIANGLE. If an id, a size or a type is not that of the scene, the behaviour
/// is undefined.
///
/// geometry_size: sizeof(azulejo_embree_geometry).
///
/// out: the mesh, to be freed with azulejo_mesh_free.
///
/// O(vertices + triangles).
///
/// Errors: those of azulejo_mesh_create; AZULEJO_ERROR_EMBREE for a scene of another version of
/// Embree, and where no Embree is found.
azulejo_status azulejo_mesh_create_from_embree(void *scene,
                                               const azulejo_embree_geometry *geometries,
                                               size_t geometry_count,
                                               size_t geometry_size,
                                               azulejo_mesh **out);

#ifdef __cplusplus
}
#endif

#endif
