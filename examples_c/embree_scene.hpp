// What the renderers among the examples share: vectors, a scene of Embree's with instances on a mesh, and pictures.

#ifndef AZULEJO_EXAMPLES_EMBREE_SCENE_HPP
#define AZULEJO_EXAMPLES_EMBREE_SCENE_HPP

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <azulejo.hpp>

struct Vec {
    float x, y, z;
};
inline Vec operator+(Vec a, Vec b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec operator-(Vec a, Vec b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec operator*(float s, Vec a) { return {s * a.x, s * a.y, s * a.z}; }
inline Vec operator*(Vec a, Vec b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
inline float dot(Vec a, Vec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec cross(Vec a, Vec b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
inline Vec normalized(Vec a) { return (1 / std::sqrt(dot(a, a))) * a; }
inline Vec mixed(Vec a, Vec b, float share) { return (1 - share) * a + share * b; }

using Random = std::minstd_rand;
inline float uniform(Random &random) { return static_cast<float>(random() >> 6) / static_cast<float>(1 << 25); }

// Three directions that are orthogonal; z is given.
struct Frame {
    Vec x, y, z;

    explicit Frame(Vec normal) : z(normal) {
        x = normalized(cross(std::abs(z.x) < 0.5f ? Vec{1, 0, 0} : Vec{0, 1, 0}, z));
        y = cross(z, x);
    }
    Vec to_world(Vec v) const { return v.x * x + v.y * y + v.z * z; }
};

// A round Bezier curve: four places, and the radius at each of them.
struct Curve {
    std::array<Vec, 4> places;
    std::array<float, 4> radii;
};

// The program's own device and scene: a mesh, and instances of scenes of curves. Instances come first: their ids are
// their numbers.
class EmbreeScene {
public:
    EmbreeScene() : device_(rtcNewDevice(nullptr)), scene_(rtcNewScene(device_)) {}
    EmbreeScene(const EmbreeScene &) = delete;
    EmbreeScene &operator=(const EmbreeScene &) = delete;
    ~EmbreeScene() {
        for (RTCScene part : parts_) rtcReleaseScene(part);
        rtcReleaseScene(scene_);
        rtcReleaseDevice(device_);
    }

    // Makes something to be instanced; returns its number.
    std::size_t add_part(const std::vector<Curve> &curves) {
        RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_ROUND_BEZIER_CURVE);
        auto *points = static_cast<float *>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                                                    RTC_FORMAT_FLOAT4, 16, 4 * curves.size()));
        auto *first = static_cast<unsigned *>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0,
                                                                      RTC_FORMAT_UINT, 4, curves.size()));
        for (std::size_t curve = 0; curve < curves.size(); curve++) {
            for (std::size_t i = 0; i < 4; i++) {
                const Vec place = curves[curve].places[i];
                const float point[4] = {place.x, place.y, place.z, curves[curve].radii[i]};
                std::memcpy(points + 4 * (4 * curve + i), point, sizeof point);
            }
            first[curve] = static_cast<unsigned>(4 * curve);
        }
        rtcCommitGeometry(geometry);
        RTCScene part = rtcNewScene(device_);
        rtcAttachGeometry(part, geometry);
        rtcReleaseGeometry(geometry);
        rtcCommitScene(part);
        parts_.push_back(part);
        return parts_.size() - 1;
    }

    // Places an instance of a part, `size` times as large, with its z axis along the frame's.
    void place(std::size_t part, const Frame &frame, Vec position, float size) {
        const float transform[12] = {size * frame.x.x, size * frame.x.y, size * frame.x.z,
                                     size * frame.y.x, size * frame.y.y, size * frame.y.z,
                                     size * frame.z.x, size * frame.z.y, size * frame.z.z,
                                     position.x,       position.y,       position.z};
        RTCGeometry instance = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_INSTANCE);
        rtcSetGeometryInstancedScene(instance, parts_[part]);
        rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, transform);
        rtcCommitGeometry(instance);
        rtcAttachGeometryByID(scene_, instance, static_cast<unsigned>(frames_.size()));
        rtcReleaseGeometry(instance);
        frames_.push_back(frame);
    }

    // Adds the mesh, after all instances; rays may follow.
    void finish(const azulejo::Mesh &mesh) {
        RTCGeometry triangles = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
        const auto positions = mesh.positions();
        const auto indices = mesh.indices();
        std::memcpy(rtcSetNewGeometryBuffer(triangles, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12,
                                            positions.size() / 3),
                    positions.data(), positions.size() * sizeof(float));
        std::memcpy(rtcSetNewGeometryBuffer(triangles, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12,
                                            indices.size() / 3),
                    indices.data(), indices.size() * sizeof(std::uint32_t));
        rtcCommitGeometry(triangles);
        rtcAttachGeometry(scene_, triangles);
        rtcReleaseGeometry(triangles);
        rtcCommitScene(scene_);
        if (rtcGetDeviceError(device_) != RTC_ERROR_NONE) throw std::runtime_error("Embree cannot make the scene");
    }

    RTCRayHit trace(Vec from, Vec direction) const {
        RTCRayHit hit{};
        hit.ray = ray(from, direction);
        hit.hit.geomID = hit.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
#if RTC_VERSION_MAJOR >= 4
        rtcIntersect1(scene_, &hit);
#else
        RTCIntersectContext query;
        rtcInitIntersectContext(&query);
        rtcIntersect1(scene_, &query, &hit);
#endif
        return hit;
    }

    // Whether nothing is in the way, up to `far` times the direction.
    bool is_lit(Vec from, Vec direction, float far = std::numeric_limits<float>::infinity()) const {
        RTCRay shadow = ray(from, direction);
        shadow.tfar = far;
#if RTC_VERSION_MAJOR >= 4
        rtcOccluded1(scene_, &shadow);
#else
        RTCIntersectContext query;
        rtcInitIntersectContext(&query);
        rtcOccluded1(scene_, &query, &shadow);
#endif
        return shadow.tfar > 0;
    }

    // The normal of a hit, in the space of the world.
    Vec normal(const RTCHit &hit) const {
        const Vec local{hit.Ng_x, hit.Ng_y, hit.Ng_z};
        return normalized(hit.instID[0] < frames_.size() ? frames_[hit.instID[0]].to_world(local) : local);
    }

private:
    static RTCRay ray(Vec from, Vec direction) {
        RTCRay ray{};
        ray.org_x = from.x, ray.org_y = from.y, ray.org_z = from.z;
        ray.dir_x = direction.x, ray.dir_y = direction.y, ray.dir_z = direction.z;
        ray.tfar = std::numeric_limits<float>::infinity();
        ray.mask = ~0u;
        return ray;
    }

    RTCDevice device_;
    RTCScene scene_;
    std::vector<RTCScene> parts_;
    std::vector<Frame> frames_;
};

// Looks at the box of the mesh, y up, from a direction and a distance in diagonals of it.
struct Camera {
    Vec eye, forwards, right, up;
    // The width of the picture at a distance of 1.
    float width;

    Camera(azulejo::Span<const float> positions, Vec from, float width) : width(width) {
        Vec low{positions[0], positions[1], positions[2]}, high = low;
        for (std::size_t i = 0; i < positions.size(); i += 3) {
            low = {std::min(low.x, positions[i]), std::min(low.y, positions[i + 1]), std::min(low.z, positions[i + 2])};
            high = {std::max(high.x, positions[i]), std::max(high.y, positions[i + 1]),
                    std::max(high.z, positions[i + 2])};
        }
        const Vec centre = 0.5f * (low + high), size = high - low;
        eye = centre + std::sqrt(dot(size, size)) * from;
        forwards = normalized(centre - eye);
        right = normalized(cross(forwards, {0, 1, 0}));
        up = cross(right, forwards);
    }

    // x to the right and y down, from 0 to 1.
    Vec through(float x, float y) const {
        return normalized(forwards + (width * (x - 0.5f)) * right + (width * (0.5f - y)) * up);
    }
};

// What a hit looks like under one sun and a sky that is blocked or not.
inline Vec lit(const EmbreeScene &scene, Vec place, Vec normal, Vec colour, Random &random) {
    const Vec sun = normalized({-0.6f, 1.0f, 0.7f});
    const float turn = 6.2832f * uniform(random), rise = uniform(random), flat = std::sqrt(1 - rise);
    const Vec sky = Frame(normal).to_world({flat * std::cos(turn), flat * std::sin(turn), std::sqrt(rise)});
    Vec light{0.04f, 0.04f, 0.05f};
    if (scene.is_lit(place, sky)) light = light + Vec{0.50f, 0.54f, 0.60f};
    const float facing = std::max(0.0f, 0.3f + 0.7f * dot(normal, sun));
    if (scene.is_lit(place, sun)) light = light + (1.5f * facing) * Vec{1.0f, 0.95f, 0.85f};
    return colour * light;
}

// Looks through a place of the picture. `colour` says that of a hit.
template <class Colour>
Vec seen(const EmbreeScene &scene, const Camera &camera, float x, float y, Random &random, const Colour &colour) {
    const Vec direction = camera.through(x, y);
    const RTCRayHit hit = scene.trace(camera.eye, direction);
    if (hit.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {0.93f, 0.94f, 0.95f};
    Vec normal = scene.normal(hit.hit);
    if (dot(normal, direction) > 0) normal = -1 * normal;
    const float far = hit.ray.tfar;
    const Vec place = camera.eye + far * direction + (1e-4f * far) * normal;
    return lit(scene, place, normal, colour(hit.hit, place), random);
}

// Does work 0 to count - 1, by all threads.
template <class Work>
void in_parallel(int count, const Work &work) {
    std::atomic<int> next{0};
    const auto share = [&] {
        for (int i; (i = next++) < count;) work(i);
    };
    std::vector<std::thread> threads;
    for (unsigned i = 0; i < std::max(1u, std::thread::hardware_concurrency()); i++) threads.emplace_back(share);
    for (std::thread &thread : threads) thread.join();
}

// A square picture, by all threads. Each row has random numbers of its own, so that any number of threads makes the
// same picture.
template <class Colour>
std::vector<unsigned char> render(const EmbreeScene &scene, const Camera &camera, int size, int rays_per_pixel,
                                  const Colour &colour) {
    const auto row_bytes = 3 * static_cast<std::size_t>(size);
    const float step = 1 / static_cast<float>(size);
    std::vector<unsigned char> picture(row_bytes * static_cast<std::size_t>(size));
    const auto render_row = [&](int y) {
        Random random(static_cast<unsigned>(y + 1));
        unsigned char *byte = picture.data() + row_bytes * static_cast<std::size_t>(y);
        for (int x = 0; x < size; x++) {
            Vec sum{0, 0, 0};
            for (int i = 0; i < rays_per_pixel; i++) {
                const float right = step * (static_cast<float>(x) + uniform(random));
                const float down = step * (static_cast<float>(y) + uniform(random));
                sum = sum + seen(scene, camera, right, down, random, colour);
            }
            for (float channel : {sum.x, sum.y, sum.z}) {
                const float linear = std::min(1.0f, channel / static_cast<float>(rays_per_pixel));
                *byte++ = static_cast<unsigned char>(255 * std::pow(linear, 1 / 2.2f) + 0.5f);
            }
        }
    };
    in_parallel(size, render_row);
    return picture;
}

// Writes a square picture as PPM.
inline void write_picture(const char *path, int size, const std::vector<unsigned char> &picture) {
    std::ofstream file(path, std::ios::binary);
    file << "P6 " << size << ' ' << size << " 255\n";
    file.write(reinterpret_cast<const char *>(picture.data()), static_cast<std::streamsize>(picture.size()));
    file.close();
    if (!file) throw std::runtime_error(std::string(path) + ": " + std::strerror(errno));
}

#endif
