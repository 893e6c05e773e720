/* What all calls share: status codes, contexts, points, orders, classes and meshes.
 * Generated from ffi/azulejo-c by cbindgen; do not edit. The conventions are in azulejo.h. */

#ifndef AZULEJO_BASE_H
#define AZULEJO_BASE_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define AZULEJO_OK 0 ///< The call succeeded.

/// An argument or option is outside its documented range.
#define AZULEJO_ERROR_INVALID_ARGUMENT -1

/// More than can be indexed or held in memory. The message has the estimate.
#define AZULEJO_ERROR_TOO_LARGE -2

#define AZULEJO_ERROR_IO -3 ///< A file could not be read.

#define AZULEJO_ERROR_FORMAT -4 ///< A file was read, but its content is not valid.

#define AZULEJO_ERROR_CANCELLED -5 ///< A callback of the caller cancelled the call.

#define AZULEJO_ERROR_OUT_OF_MEMORY -6 ///< There is no memory for a copy of the caller's arrays.

/// Embree failed: it is not there, has no memory, or cannot build a scene.
#define AZULEJO_ERROR_EMBREE -7

/// Threads could not be started, or the context's are left in the parent of a forked process.
#define AZULEJO_ERROR_THREADS -8

/// The handle is in use by another call, or by the one whose callback makes this one: try later.
#define AZULEJO_ERROR_BUSY -9

/// The library was built without Embree: see azulejo_has_embree.
#define AZULEJO_ERROR_UNSUPPORTED -10

/// A bug in the library; please report it. Handles that took part in the call can only be freed.
#define AZULEJO_ERROR_INTERNAL -100

/// The result of a call: AZULEJO_OK or a negative AZULEJO_ERROR_ code. Later versions may add some.
typedef int32_t azulejo_status;

/// Copies the message of this thread's last failed call, which calls that succeed leave as it is:
/// one line of UTF-8, terminated by a NUL; empty if no call has failed. Returns the size of the
/// whole message in bytes, including the NUL.
/// - buffer: receives at most `capacity` bytes including the NUL; a longer message is cut between
///   two characters. May be NULL if `capacity` is 0.
size_t azulejo_last_error_message(char *buffer, size_t capacity);

/// The name of a status, such as "AZULEJO_ERROR_BUSY"; NULL for any other number. Never freed.
const char *azulejo_status_name(azulejo_status status);

#define AZULEJO_VERSION_MAJOR 0 ///< Changes when programs must be changed.

/// Changes when something is added; before 1.0 also when programs must be changed.
#define AZULEJO_VERSION_MINOR 3

#define AZULEJO_VERSION_PATCH 0 ///< Changes with corrections.

#define AZULEJO_VERSION 300 ///< The version of this header: major * 10000 + minor * 100 + patch.

/// The version of the library that the program runs with, to be compared with AZULEJO_VERSION.
uint32_t azulejo_version(void);

/// 1 if the library was built with Embree, which is loaded by the first call that uses it; else 0.
/// Without it AZULEJO_ENGINE_EMBREE and azulejo_mesh_create_from_embree are refused with
/// AZULEJO_ERROR_UNSUPPORTED; if the machine has none, with AZULEJO_ERROR_EMBREE.
uint32_t azulejo_has_embree(void);

/// Called repeatedly during a call: see "Progress" in azulejo.h. Returns 0 to go on, else cancels.
/// - user: the progress_user of the options or of azulejo_context_watch.
/// - done: the fraction of the call that is done, from 0 to 1.
typedef uint32_t (*azulejo_progress_fn)(void *user, double done);

/// A pool of threads, passed to every call that does long work. One context for a whole program is
/// usual; several threads may use it at once.
typedef struct azulejo_context azulejo_context;

/// Makes a context and starts its threads.
/// - num_threads: 1 to 4096, or 0 for one per core. With 1 all work happens on the calling thread.
///
/// Embree's scenes are built by as many threads, at most one per core. While a mesh exists that
/// Embree has traced, the bound on threads of a device of the program's own is suspended.
azulejo_status azulejo_context_create(uint32_t num_threads, azulejo_context **out);

/// Makes a context that shares the threads of another one and adds a progress callback, for all
/// calls with it, or with a handle made with it, whose options have none: so calls without options,
/// such as the analysis, can report progress and be cancelled.
/// - context: it may be freed before this one. Its callback is not inherited.
/// - progress: the callback, or NULL for none. Each thread that calls with the context calls it.
azulejo_status azulejo_context_watch(const azulejo_context *context,
                                     azulejo_progress_fn progress,
                                     void *progress_user,
                                     azulejo_context **out);

/// The number of threads that work on a call; 0 for NULL.
uint32_t azulejo_context_num_threads(const azulejo_context *context);

/// Frees a context. Its threads end when no call and no handle uses them any more.
void azulejo_context_free(azulejo_context *context);

/// The domain is a torus: distances wrap with the period domain_max - domain_min.
#define AZULEJO_BOUNDARY_PERIODIC 0

/// Samples beyond the edges of the domain neither exist nor cover anything.
#define AZULEJO_BOUNDARY_BOUNDED 1

/// Points of the plane and their domain: the input of the calls that measure them.
typedef struct azulejo_plane_set {
    uint32_t struct_size; ///< The size of the struct in bytes; set by the _init function.
    uint32_t boundary; ///< An AZULEJO_BOUNDARY_ constant; default periodic.
    const float *positions; ///< The points, x y each. Default NULL: none.
    size_t count; ///< The number of points; default 0.
    double domain_min[2]; ///< The lower corner of the domain, x y; default 0 0.
    /// The upper one, above it; default 1 1. Sides are within 2^100 of each other.
    double domain_max[2];
} azulejo_plane_set;

/// Points of a cuboid and their domain: the input of the calls that measure them.
typedef struct azulejo_space_set {
    uint32_t struct_size; ///< The size of the struct in bytes; set by the _init function.
    uint32_t boundary; ///< An AZULEJO_BOUNDARY_ constant; default periodic.
    const float *positions; ///< The points, x y z each. Default NULL: none.
    size_t count; ///< The number of points; default 0.
    double domain_min[3]; ///< The lower corner of the domain, x y z; default 0 0 0.
    double domain_max[3]; ///< The upper one, above it; default 1 1 1. As in azulejo_plane_set.
} azulejo_space_set;

azulejo_status azulejo_plane_set_init(azulejo_plane_set *set, size_t struct_size);

azulejo_status azulejo_space_set_init(azulejo_space_set *set, size_t struct_size);

#define AZULEJO_ORDER_ANY 0 ///< In no particular order.

/// Coarse to fine: the first points, any number, are a sparser set of the same kind.
#define AZULEJO_ORDER_PROGRESSIVE 1

/// The samples that a call made. Each array has an entry per sample, in the same order, and is NULL
/// for an empty set and where a set has no such array.
typedef struct azulejo_points azulejo_points;

/// The number of samples; 0 for NULL.
size_t azulejo_points_count(const azulejo_points *points);

/// The number of coordinates of a position: 2 in the plane, 3 in space; 0 for NULL.
uint32_t azulejo_points_dimension(const azulejo_points *points);

/// The positions, x y or x y z of each sample, interleaved. Samples on a mesh lie on their
/// triangle: they are computed from the barycentrics in double arithmetic and rounded once.
const float *azulejo_points_positions(const azulejo_points *points);

/// On a mesh, the unit normals of the samples' triangles, x y z each, on the side from which their
/// vertices appear counter-clockwise.
const float *azulejo_points_normals(const azulejo_points *points);

/// On a mesh that carries normals, these, interpolated with the barycentrics and normalised, x y z
/// each; the normal of the triangle where the sum is zero.
const float *azulejo_points_interpolated_normals(const azulejo_points *points);

/// On a mesh, the index of each sample's triangle.
const uint32_t *azulejo_points_triangles(const azulejo_points *points);

/// On a mesh, the barycentric coordinates u v of each sample in its triangle (a, b, c), as in
/// Embree: the position is (1-u-v)*a + u*b + v*c, and so are other attributes of the vertices.
const float *azulejo_points_barycentrics(const azulejo_points *points);

/// The radius of each sample of the calls that have `adaptive` in their names, and the local radius
/// of each of azulejo_psp_classes_with_density.
const double *azulejo_points_radii(const azulejo_points *points);

/// The ranks of the samples of a set in progressive order: for each sample the distance to the
/// nearest one before it, or on meshes a little less, rounded down to a float. They never rise. The
/// first i samples are at least as far apart as the i-th rank, and no place is farther from all of
/// them than the `quotient` of the options times that rank, and 6 float spacings; if i is below
/// 100, than twice the rank or, if that is more, the square of the quotient times it.
///
/// In the plane this holds from the samples of the coarsest level on, those with the rank of the
/// first: one sample only, unless the options have a `coarsest`. On meshes it holds for every i;
/// the first rank is infinite. Where radii vary, distances are divided by the mean of two radii:
/// see azulejo_psp_adaptive_sample, and for a density azulejo_psp_adaptive_with_density.
const float *azulejo_points_ranks(const azulejo_points *points);

/// The class of each sample of a set of several classes: its row in the matrix of azulejo_classes.
const uint32_t *azulejo_points_classes(const azulejo_points *points);

/// The ids of the samples of a set that has been edited (azulejo_plane_erase, azulejo_psp_erase): a
/// sample keeps its id as long as it stands, and no other one ever gets it.
const uint64_t *azulejo_points_ids(const azulejo_points *points);

/// The index of each sample's instance, from azulejo_psp_sample_instances: they never fall.
const uint32_t *azulejo_points_instances(const azulejo_points *points);

/// Frees the set with all its arrays.
void azulejo_points_free(azulejo_points *points);

/// A part of space: the points, boundary included, that lie in a box and within a distance of a
/// centre. Both are without end by default: set `centre` and `radius` for a ball, `min` and `max`
/// for a box, or all four for what they have in common. The plane lies at the height 0.
typedef struct azulejo_region {
    uint32_t struct_size; ///< The size of the struct in bytes; set by the _init function.
    uint32_t reserved; ///< Must be 0.
    double min[3]; ///< The lowest coordinates of the box; default minus infinity.
    double max[3]; ///< The highest coordinates, not below `min`; default infinity.
    double centre[3]; ///< The centre of the ball, finite; default 0.
    double radius; ///< The radius of the ball, 0 or more; default infinity.
} azulejo_region;

azulejo_status azulejo_region_init(azulejo_region *region, size_t struct_size);

#define AZULEJO_MAX_CLASSES 16 ///< No set has more classes.

/// Classes of samples that stand in each other's way: the matrix of their distances. Samples of
/// classes i and j are at least r_ij apart, and no class can take another sample: for each class i
/// every place is within r_ij of some sample of some class j, up to the rounding of maximal sets.
///
/// Classes of larger own radii r_ii come first, smaller ones fill what these leave; classes of
/// equal radii are filled together. So shares jump where two radii become equal.
typedef struct azulejo_classes {
    uint32_t struct_size; ///< The size of the struct in bytes; set by the _init function.
    uint32_t count; ///< The number of classes, 1 to AZULEJO_MAX_CLASSES. Required.
    /// count * count radii, row by row; symmetric, 0 or more, above 0 on the diagonal; required.
    /// Two classes whose radius is 0 ignore each other. azulejo_classes_radii makes such a matrix.
    const double *radii;
    /// On meshes, where each class may stand: for each triangle a number with a bit for each class,
    /// the lowest for class 0. Where its bit is 0 a class has no samples and needs no cover. If the
    /// mesh has a mask, both must allow a sample. NULL, the default: everywhere.
    const uint32_t *masks;
    size_t mask_count; ///< That of the mesh's triangles, or 0, the default, for none.
} azulejo_classes;

/// The report of calls that make samples of several classes.
typedef struct azulejo_classes_report {
    uint32_t struct_size; ///< The size of the struct in bytes; set by the _init function.
    uint32_t classes; ///< The number of classes.
    uint64_t samples; ///< The number of samples.
    /// The number of samples of each class, 0 for those that there are not.
    uint64_t counts[AZULEJO_MAX_CLASSES];
    double seconds; ///< Wall time in seconds.
} azulejo_classes_report;

azulejo_status azulejo_classes_init(azulejo_classes *classes, size_t struct_size);

azulejo_status azulejo_classes_report_init(azulejo_classes_report *report,
                                           size_t struct_size);

/// Makes a matrix of radii from those of each class alone: two classes keep the distance that a set
/// of all samples of both, and of all classes of larger radii, would have (Wei, 2010).
/// - own: for each class the distance of its samples, above 0.
/// - count: the number of classes, 1 to AZULEJO_MAX_CLASSES.
/// - factor: multiplies the radii of two different classes, 0 or more; 1 for Wei's. With smaller
///   ones each class has nearer to the density that it has alone.
/// - out: count * count numbers, row by row.
azulejo_status azulejo_classes_radii(const double *own, uint32_t count, double factor, double *out);

/// A checked triangle mesh: any soup, open, non-manifold, of many parts and mixed winding. It may
/// carry normals and a mask. Meshes made from one another share what they have in common.
typedef struct azulejo_mesh azulejo_mesh;

/// Makes a mesh from a copy of the caller's arrays.
/// - positions: the vertices, x y z each, `stride_bytes` from one to the next.
/// - indices: three per triangle, below `vertex_count`; triangles keep their order. Triangles
///   without area are allowed and get no samples, but at least one must have area.
/// - O(vertices + triangles) time, and 12 bytes per vertex and per triangle. Later calls keep with
///   it, for all threads, about a byte per triangle for sets, 12 bytes per triangle and 4 per
///   vertex for relaxation and remeshing, 100 per triangle for iterations of AZULEJO_ENGINE_EMBREE.
/// - Errors: AZULEJO_ERROR_TOO_LARGE for 2^32 - 1 vertices or triangles or more;
///   AZULEJO_ERROR_OUT_OF_MEMORY.
azulejo_status azulejo_mesh_create(const float *positions,
                                   size_t vertex_count,
                                   size_t stride_bytes,
                                   const uint32_t *indices,
                                   size_t triangle_count,
                                   azulejo_mesh **out);

/// Loads a mesh from a file: Wavefront OBJ, PLY, STL, OFF (text) or binary glTF, by the extension
/// .obj, .ply, .stl, .off or .glb, otherwise by the first bytes. Polygons become fans of triangles,
/// in the order of the faces. Vertices keep the order of the file; STL facets have three each. Of
/// glTF the meshes of all nodes of the scene are read, placed as the nodes say. Normals of corners
/// (OBJ vn) and vertices (PLY nx ny nz, NOFF, glTF) are read, zero where there is none.
///
/// Coordinates in text or doubles, so far from the origin that floats would displace them by more
/// than a millionth of the mesh's size, are relative to azulejo_mesh_origin.
/// - path: terminated by a NUL, in the encoding of the system, on Windows in UTF-8.
/// - O(size of the file), on the calling thread.
/// - Errors: AZULEJO_ERROR_IO if the file cannot be read; AZULEJO_ERROR_FORMAT if it is invalid, or
///   has a mesh that azulejo_mesh_create would refuse.
azulejo_status azulejo_mesh_load(const char *path, azulejo_mesh **out);

/// Makes a mesh with the caller's normals in place of any that it has, such as those of a shaded
/// surface, for azulejo_points_interpolated_normals. They do not affect samples.
/// - normals: of any length, x y z each, `stride_bytes` from one to the next. Where the three
///   normals of a triangle add up to zero at a sample, the sample gets the normal of the triangle.
/// - normal_count: the number of vertices, if there are no indices.
/// - normal_indices: three per triangle, below `normal_count`, for corners that share a vertex but
///   not its normal; NULL for one normal per vertex.
/// - triangle_count: the number of triangles of the mesh; 0 if `normal_indices` is NULL.
/// - O(normals + triangles).
/// - Errors: AZULEJO_ERROR_OUT_OF_MEMORY.
azulejo_status azulejo_mesh_with_normals(const azulejo_mesh *mesh,
                                         const float *normals,
                                         size_t normal_count,
                                         size_t stride_bytes,
                                         const uint32_t *normal_indices,
                                         size_t triangle_count,
                                         azulejo_mesh **out);

/// Makes a mesh with a mask, in place of any that it has: triangles whose entry is 0 are left out
/// but keep their numbers. The rest is sampled, bit for bit, as if they did not exist. A mask may
/// leave out everything; then a maximal set is empty.
/// - mask: one byte per triangle: 0 leaves it out, any other value keeps it.
/// - triangle_count: the number of triangles of the mesh.
/// - O(triangles).
/// - Errors: AZULEJO_ERROR_OUT_OF_MEMORY.
azulejo_status azulejo_mesh_with_mask(const azulejo_mesh *mesh,
                                      const uint8_t *mask,
                                      size_t triangle_count,
                                      azulejo_mesh **out);

/// Makes a mesh with its vertices moved, such as for the next frame of an animation. Triangles and
/// mask stay; normals go. With azulejo_mesh_points samples follow from one mesh to the other.
/// - positions: the vertices, x y z each, `stride_bytes` from one to the next.
/// - vertex_count: that of the mesh.
/// - O(vertices + triangles).
/// - Errors: AZULEJO_ERROR_INVALID_ARGUMENT also if no area is left; AZULEJO_ERROR_OUT_OF_MEMORY.
azulejo_status azulejo_mesh_deform(const azulejo_mesh *mesh,
                                   const float *positions,
                                   size_t vertex_count,
                                   size_t stride_bytes,
                                   azulejo_mesh **out);

/// Evaluates places of a mesh with the rounding of every sampler: places of samples of this mesh
/// give the samples, bit for bit, and on a mesh of azulejo_mesh_deform each sample goes with its
/// triangle. The result has normals, triangles and barycentrics, in the same order. O(count).
/// - triangles, barycentrics: of each place; masked triangles, and those without area, too.
azulejo_status azulejo_mesh_points(const azulejo_mesh *mesh,
                                   const uint32_t *triangles,
                                   const float *barycentrics,
                                   size_t count,
                                   azulejo_points **out);

/// 1 if the mesh carries normals besides those of its triangles, else 0.
uint32_t azulejo_mesh_has_normals(const azulejo_mesh *mesh);

/// The number of vertices.
size_t azulejo_mesh_vertex_count(const azulejo_mesh *mesh);

/// The number of triangles, including masked ones.
size_t azulejo_mesh_triangle_count(const azulejo_mesh *mesh);

/// The vertices, x y z each.
const float *azulejo_mesh_positions(const azulejo_mesh *mesh);

/// The three vertices of each triangle, counter-clockwise seen from the front.
const uint32_t *azulejo_mesh_indices(const azulejo_mesh *mesh);

/// The area of all triangles that no mask leaves out. A maximal set of n samples has a radius of
/// about sqrt(0.69656 * area / n) where that is small beside the features of the surface.
double azulejo_mesh_area(const azulejo_mesh *mesh);

/// Writes to `origin`, x y z, what positions of the mesh and of its samples are relative to in the
/// frame of its file: see azulejo_mesh_load. Zero for others, and NULL.
void azulejo_mesh_origin(const azulejo_mesh *mesh, double *origin);

/// Frees the mesh; its memory is released once no psp handle uses it any more.
void azulejo_mesh_free(azulejo_mesh *mesh);

/// Gives the radius at a position, from `smallest` to `largest`. See "Callbacks" in azulejo.h.
/// - user: the radius_function_user of the options.
/// - position: x y z of a place; for a sample, the floats that are returned.
typedef double (*azulejo_radius_fn)(void *user, const double *position);

/// A geometry of triangles in a scene that the program has made with Embree, which keeps no sizes.
typedef struct azulejo_embree_geometry {
    uint32_t geometry_id; ///< Its number in the scene.
    uint32_t vertex_stride; ///< Bytes from one vertex to the next: a multiple of 4, at least 12.
    uint32_t index_stride; ///< Bytes from one triangle to the next, likewise.
    uint32_t reserved; ///< Must be 0.
    /// Those in its buffer RTC_BUFFER_TYPE_VERTEX, slot 0, of format RTC_FORMAT_FLOAT3.
    size_t vertex_count;
    /// Those in its buffer RTC_BUFFER_TYPE_INDEX, of format RTC_FORMAT_UINT3.
    size_t triangle_count;
} azulejo_embree_geometry;

/// Makes a mesh from a copy of the triangles of a scene that the program has made with Embree,
/// which is not needed after the call: samples are traced in a scene and on a device of the
/// library's. Triangle i of the mesh is primitive i of the first geometry, those of the second
/// follow, and so on; vertices likewise.
/// - scene: a committed RTCScene that no thread changes during the call, of the libembree that the
///   program has linked or, where it has linked none that all its libraries see, of the one that
///   libazulejo loads by its SONAME: otherwise, as for an Embree that is linked statically, the
///   behaviour is undefined. Instances are not followed: azulejo_psp_sample_instances takes them.
/// - geometries: at least one, each attached to the scene as RTC_GEOMETRY_TYPE_TRIANGLE. If an id,
///   a size or a type is not that of the scene, the behaviour is undefined.
/// - geometry_size: sizeof(azulejo_embree_geometry).
/// - O(vertices + triangles).
/// - Errors: those of azulejo_mesh_create; AZULEJO_ERROR_EMBREE if it is another version or
///   missing.
azulejo_status azulejo_mesh_create_from_embree(void *scene,
                                               const azulejo_embree_geometry *geometries,
                                               size_t geometry_count,
                                               size_t geometry_size,
                                               azulejo_mesh **out);

#ifdef __cplusplus
}
#endif

#endif
