/* A program with an Embree of its own hands its scene over; nothing of it changes. */
#if EMBREE_MAJOR == 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif
#include <math.h>

#include "check.h"
#include "samples.h"

#define GEOMETRY sizeof(azulejo_embree_geometry)
#define INVALID AZULEJO_ERROR_INVALID_ARGUMENT
#define RAYS 200

static azulejo_context *context;
static int complaints;

static void complain(void *user, enum RTCError code, const char *text) {
    (void)user, (void)code, (void)text;
    complaints++;
}

/* The cube's first half: buffers of Embree's, packed. */
static unsigned attach_packed(RTCDevice device, RTCScene scene) {
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    void *vertices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, 8);
    void *indices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, 6);
    unsigned id;
    memcpy(vertices, cube_positions, sizeof cube_positions);
    memcpy(indices, cube_indices, 6 * 12);
    rtcCommitGeometry(geometry);
    id = rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
    return id;
}

/* Its second half: buffers of the program's, with gaps between vertices and between triangles, behind an offset. */
static unsigned attach_shared(RTCDevice device, RTCScene scene) {
    static float vertices[10][4];
    static uint32_t indices[6][5];
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    unsigned id;
    size_t i;
    for (i = 0; i < 8; i++) memcpy(vertices[i + 1], cube_positions[i], 12);
    for (i = 0; i < 6; i++) memcpy(indices[i], cube_indices[i + 6], 12);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, vertices, 16, 16, 8);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, indices, 0, 20, 6);
    rtcCommitGeometry(geometry);
    id = rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
    return id;
}

typedef struct {
    unsigned geometry, primitive;
    float t, u, v;
} hit;

static void trace(RTCScene scene, hit *hits) {
    struct RTCRayHit ray;
    size_t i;
    for (i = 0; i < RAYS; i++) {
        memset(&ray, 0, sizeof ray);
        ray.ray.org_x = 0.5f, ray.ray.org_y = 0.4f, ray.ray.org_z = 0.3f;
        ray.ray.dir_x = sinf((float)i), ray.ray.dir_y = cosf(3 * (float)i), ray.ray.dir_z = sinf(7 * (float)i);
        ray.ray.tfar = INFINITY;
        ray.ray.mask = ~0u;
        ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
#if EMBREE_MAJOR == 4
        rtcIntersect1(scene, &ray, NULL);
#else
        {
            struct RTCIntersectContext query;
            rtcInitIntersectContext(&query);
            rtcIntersect1(scene, &query, &ray);
        }
#endif
        memset(&hits[i], 0, sizeof hits[i]);
        hits[i].geometry = ray.hit.geomID, hits[i].primitive = ray.hit.primID;
        hits[i].t = ray.ray.tfar, hits[i].u = ray.hit.u, hits[i].v = ray.hit.v;
    }
}

static void hands_over(RTCDevice device, RTCScene scene, const azulejo_embree_geometry *geometries) {
    azulejo_psp_options options = psp_options(0.1);
    azulejo_mesh *mesh = NULL, *cube = make_cube();
    azulejo_points *points = NULL, *same = NULL;
    const enum RTCSceneFlags flags = rtcGetSceneFlags(scene);
    hit before[RAYS], after[RAYS];
    size_t i;
    options.iterations = 1;
    trace(scene, before);

    ACCEPTED(azulejo_mesh_create_from_embree(scene, geometries, 2, GEOMETRY, &mesh));
    CHECK(azulejo_mesh_vertex_count(mesh) == 16 && azulejo_mesh_triangle_count(mesh) == 12);
    CHECK(memcmp(azulejo_mesh_positions(mesh), cube_positions, sizeof cube_positions) == 0);
    CHECK(memcmp(azulejo_mesh_positions(mesh) + 24, cube_positions, sizeof cube_positions) == 0);
    CHECK(memcmp(azulejo_mesh_indices(mesh), cube_indices, 6 * 12) == 0);
    for (i = 0; i < 18; i++) CHECK(azulejo_mesh_indices(mesh)[18 + i] == 8 + cube_indices[6 + i / 3][i % 3]);
    ACCEPTED(azulejo_psp_sample(context, cube, &options, &same, NULL));
    ACCEPTED(azulejo_psp_sample(context, mesh, &options, &points, NULL));
    CHECK(same_points(points, same));

    trace(scene, after);
    CHECK(memcmp(before, after, sizeof before) == 0);
    CHECK(rtcGetSceneFlags(scene) == flags && complaints == 0 && rtcGetDeviceError(device) == RTC_ERROR_NONE);
    azulejo_points_free(points);
    azulejo_points_free(same);
    azulejo_mesh_free(mesh);
    azulejo_mesh_free(cube);
}

static void refuses(RTCScene scene, const azulejo_embree_geometry *good) {
    azulejo_mesh *out = UNTOUCHED;
    azulejo_embree_geometry bad;
    REFUSED(INVALID, "scene", azulejo_mesh_create_from_embree(NULL, good, 2, GEOMETRY, &out));
    REFUSED(INVALID, "geometry_size: 0", azulejo_mesh_create_from_embree(scene, good, 2, 0, &out));
    REFUSED(INVALID, "geometries", azulejo_mesh_create_from_embree(scene, NULL, 2, GEOMETRY, &out));
    REFUSED(INVALID, "geometries", azulejo_mesh_create_from_embree(scene, (const void *)((const char *)good + 1), 2, GEOMETRY, &out));
    REFUSED(INVALID, "indices", azulejo_mesh_create_from_embree(scene, NULL, 0, GEOMETRY, &out));
    REFUSED(INVALID, "out", azulejo_mesh_create_from_embree(scene, good, 2, GEOMETRY, NULL));
    REFUSED(AZULEJO_ERROR_TOO_LARGE, "geometry_count", azulejo_mesh_create_from_embree(scene, good, SIZE_MAX, GEOMETRY, &out));
#define BAD(status, part, change)                                                          \
    do {                                                                                   \
        bad = good[0];                                                                     \
        change;                                                                            \
        REFUSED(status, part, azulejo_mesh_create_from_embree(scene, &bad, 1, GEOMETRY, &out)); \
    } while (0)
    BAD(INVALID, "[0]: vertex_stride", bad.vertex_stride = 0);
    BAD(INVALID, "[0]: vertex_stride", bad.vertex_stride = 8);
    BAD(INVALID, "[0]: vertex_stride", bad.vertex_stride = 14);
    BAD(INVALID, "[0]: index_stride", bad.index_stride = 8);
    BAD(INVALID, "[0]: index_stride", bad.index_stride = 13);
    BAD(INVALID, "[0]: reserved", bad.reserved = 1);
    BAD(INVALID, "names vertex", bad.vertex_count = 3);
    BAD(INVALID, "indices", bad.triangle_count = 0);
    BAD(AZULEJO_ERROR_TOO_LARGE, "vertex_count", bad.vertex_count = SIZE_MAX);
    BAD(AZULEJO_ERROR_TOO_LARGE, "triangle_count", bad.triangle_count = SIZE_MAX / 12);
#undef BAD
    CHECK(out == UNTOUCHED);
}

int main(void) {
    RTCDevice device = rtcNewDevice("threads=2");
    RTCScene scene = rtcNewScene(device);
    azulejo_embree_geometry geometries[2];
    memset(geometries, 0, sizeof geometries);
    context = make_context(1);
    rtcSetDeviceErrorFunction(device, complain, NULL);
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    geometries[0].geometry_id = attach_packed(device, scene);
    geometries[1].geometry_id = attach_shared(device, scene);
    rtcCommitScene(scene);
    geometries[0].vertex_stride = geometries[0].index_stride = 12;
    geometries[1].vertex_stride = 16, geometries[1].index_stride = 20;
    geometries[0].vertex_count = geometries[1].vertex_count = 8;
    geometries[0].triangle_count = geometries[1].triangle_count = 6;

    hands_over(device, scene, geometries);
    refuses(scene, geometries);
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
    azulejo_context_free(context);
    return finish();
}
