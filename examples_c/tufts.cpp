// Fur by a renderer that uses Embree itself: scatters tufts over a mesh, one instance on each of azulejo's samples, and
// renders them (thesis Fig. 3.23: three iterations of PSP suffice for that). Its device, its scene and its rays are the
// program's own; azulejo makes the samples and knows nothing of them.
//
//   tufts MESH.obj|MESH.ply OUT.ppm [TUFTS [PIXELS]]

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iostream>
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

namespace {

constexpr int rays_per_pixel = 24;
// Hairs of a tuft, and how many different tufts there are.
constexpr int hairs = 14, kinds = 8;
// The length of hair in radii of the samples.
constexpr float hair_length = 5;
// N * radius^2 / area of a maximal set.
constexpr double density = 0.69656;

struct Vec {
    float x, y, z;
};
Vec operator+(Vec a, Vec b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Vec operator-(Vec a, Vec b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Vec operator*(float s, Vec a) { return {s * a.x, s * a.y, s * a.z}; }
Vec operator*(Vec a, Vec b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
float dot(Vec a, Vec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Vec cross(Vec a, Vec b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
Vec normalized(Vec a) { return (1 / std::sqrt(dot(a, a))) * a; }
Vec mixed(Vec a, Vec b, float share) { return (1 - share) * a + share * b; }

using Random = std::minstd_rand;
float uniform(Random &random) { return static_cast<float>(random() >> 6) / static_cast<float>(1 << 25); }

// Three directions that are orthogonal; z is given.
struct Frame {
    Vec x, y, z;

    explicit Frame(Vec normal) : z(normal) {
        x = normalized(cross(std::abs(z.x) < 0.5f ? Vec{1, 0, 0} : Vec{0, 1, 0}, z));
        y = cross(z, x);
    }
    Vec to_world(Vec v) const { return v.x * x + v.y * y + v.z * z; }
};

// A tuft of height 1 that grows from the origin along z: Bezier curves that part, bend and taper.
RTCScene make_tuft(RTCDevice device, Random &random) {
    RTCGeometry curves = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_ROUND_BEZIER_CURVE);
    auto *points = static_cast<float *>(rtcSetNewGeometryBuffer(curves, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4,
                                                                16, 4 * hairs));
    auto *first = static_cast<unsigned *>(rtcSetNewGeometryBuffer(curves, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT, 4,
                                                                  hairs));
    for (int hair = 0; hair < hairs; hair++) {
        const float angle = 6.2832f * uniform(random), spread = 0.35f * std::sqrt(uniform(random));
        const float tall = 0.7f + 0.3f * uniform(random), root = 0.1f * uniform(random);
        const Vec outwards{std::cos(angle), std::sin(angle), 0};
        for (int i = 0; i < 4; i++) {
            const float t = static_cast<float>(i) / 3;
            const Vec place = (root + spread * t * t) * outwards + Vec{0.45f * t * t, 0, tall * t * (1 - 0.2f * t)};
            const float point[4] = {place.x, place.y, place.z, 0.018f * (1 - 0.8f * t)};
            std::memcpy(points + 4 * (4 * hair + i), point, sizeof point);
        }
        first[hair] = static_cast<unsigned>(4 * hair);
    }
    rtcCommitGeometry(curves);
    RTCScene scene = rtcNewScene(device);
    rtcAttachGeometry(scene, curves);
    rtcReleaseGeometry(curves);
    rtcCommitScene(scene);
    return scene;
}

// The mesh, and an instance of a tuft for each sample. Instances come first: their ids are the samples' indices.
class Fur {
public:
    Fur(const azulejo::Mesh &mesh, const azulejo::Points &samples, float length)
        : device_(rtcNewDevice(nullptr)), scene_(rtcNewScene(device_)) {
        Random random(1);
        std::array<RTCScene, kinds> tufts;
        for (RTCScene &tuft : tufts) tuft = make_tuft(device_, random);
        for (std::size_t i = 0; i < samples.size(); i++) {
            const float *p = &samples.positions()[3 * i], *n = &samples.normals()[3 * i];
            place(tufts[random() % kinds], {p[0], p[1], p[2]}, {n[0], n[1], n[2]},
                  length * (0.8f + 0.4f * uniform(random)), uniform(random));
        }
        for (RTCScene tuft : tufts) rtcReleaseScene(tuft);
        attach(mesh);
        rtcCommitScene(scene_);
        if (rtcGetDeviceError(device_) != RTC_ERROR_NONE) throw std::runtime_error("Embree cannot make the scene");
    }
    Fur(const Fur &) = delete;
    Fur &operator=(const Fur &) = delete;
    ~Fur() {
        rtcReleaseScene(scene_);
        rtcReleaseDevice(device_);
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

    bool is_lit(Vec from, Vec direction) const {
        RTCRay shadow = ray(from, direction);
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

    void place(RTCScene tuft, Vec position, Vec normal, float length, float turn) {
        // Hair hangs: its direction is the normal, drawn down; it bends down, too.
        Frame frame(normalized(normal + Vec{0, -0.35f, 0}));
        const Vec down = Vec{0, -1, 0} + frame.z.y * frame.z;
        if (dot(down, down) > 0.01f) {
            const Vec aside = (turn - 0.5f) * cross(frame.z, down);
            frame.x = normalized(down + aside);
            frame.y = cross(frame.z, frame.x);
        }
        const float transform[12] = {length * frame.x.x, length * frame.x.y, length * frame.x.z,
                                     length * frame.y.x, length * frame.y.y, length * frame.y.z,
                                     length * frame.z.x, length * frame.z.y, length * frame.z.z,
                                     position.x,         position.y,         position.z};
        RTCGeometry instance = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_INSTANCE);
        rtcSetGeometryInstancedScene(instance, tuft);
        rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, transform);
        rtcCommitGeometry(instance);
        rtcAttachGeometryByID(scene_, instance, static_cast<unsigned>(frames_.size()));
        rtcReleaseGeometry(instance);
        frames_.push_back(frame);
    }

    void attach(const azulejo::Mesh &mesh) {
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
    }

    RTCDevice device_;
    RTCScene scene_;
    std::vector<Frame> frames_;
};

// Looks at the box of the mesh, a little from above, y up.
struct Camera {
    Vec eye, forwards, right, up;

    explicit Camera(azulejo::Span<const float> positions) {
        Vec low{positions[0], positions[1], positions[2]}, high = low;
        for (std::size_t i = 0; i < positions.size(); i += 3) {
            low = {std::min(low.x, positions[i]), std::min(low.y, positions[i + 1]), std::min(low.z, positions[i + 2])};
            high = {std::max(high.x, positions[i]), std::max(high.y, positions[i + 1]),
                    std::max(high.z, positions[i + 2])};
        }
        const Vec centre = 0.5f * (low + high), size = high - low;
        const float reach = std::sqrt(dot(size, size));
        eye = centre + reach * Vec{0.35f, 0.45f, 1.6f};
        forwards = normalized(centre - eye);
        right = normalized(cross(forwards, {0, 1, 0}));
        up = cross(right, forwards);
    }

    // x to the right and y down, from 0 to 1.
    Vec through(float x, float y) const {
        return normalized(forwards + (0.48f * (x - 0.5f)) * right + (0.48f * (0.5f - y)) * up);
    }
};

// One sun, a sky that is blocked or not, and hair that is dark at its root.
Vec shade(const Fur &fur, const Camera &camera, float x, float y, Random &random) {
    const Vec direction = camera.through(x, y), sun = normalized({-0.6f, 1.0f, 0.7f});
    const RTCRayHit hit = fur.trace(camera.eye, direction);
    if (hit.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {0.93f, 0.94f, 0.95f};

    Vec normal = fur.normal(hit.hit);
    if (dot(normal, direction) > 0) normal = -1 * normal;
    const float far = hit.ray.tfar;
    const Vec place = camera.eye + far * direction + (1e-4f * far) * normal;
    const float height_on_hair = hit.hit.instID[0] == RTC_INVALID_GEOMETRY_ID ? 0 : hit.hit.u;
    const Vec colour = mixed({0.16f, 0.09f, 0.05f}, {0.86f, 0.66f, 0.44f}, height_on_hair);

    const float turn = 6.2832f * uniform(random), rise = uniform(random), flat = std::sqrt(1 - rise);
    const Vec sky = Frame(normal).to_world({flat * std::cos(turn), flat * std::sin(turn), std::sqrt(rise)});
    Vec light{0.04f, 0.04f, 0.05f};
    if (fur.is_lit(place, sky)) light = light + Vec{0.50f, 0.54f, 0.60f};
    const float facing = std::max(0.0f, 0.3f + 0.7f * dot(normal, sun));
    if (fur.is_lit(place, sun)) light = light + (1.5f * facing) * Vec{1.0f, 0.95f, 0.85f};
    return colour * light;
}

// One row of pixels; its random numbers are its own, so that any number of threads makes the same picture.
void render_row(const Fur &fur, const Camera &camera, int size, int y, unsigned char *row) {
    Random random(static_cast<unsigned>(y + 1));
    const float step = 1 / static_cast<float>(size);
    for (int x = 0; x < size; x++) {
        Vec sum{0, 0, 0};
        for (int i = 0; i < rays_per_pixel; i++) {
            const float right = step * (static_cast<float>(x) + uniform(random));
            const float down = step * (static_cast<float>(y) + uniform(random));
            sum = sum + shade(fur, camera, right, down, random);
        }
        for (float channel : {sum.x, sum.y, sum.z}) {
            const float linear = std::min(1.0f, channel / rays_per_pixel);
            *row++ = static_cast<unsigned char>(255 * std::pow(linear, 1 / 2.2f) + 0.5f);
        }
    }
}

std::vector<unsigned char> render(const Fur &fur, const Camera &camera, int size) {
    const auto row_bytes = 3 * static_cast<std::size_t>(size);
    std::vector<unsigned char> picture(row_bytes * static_cast<std::size_t>(size));
    std::atomic<int> next{0};
    auto rows = [&] {
        for (int y; (y = next++) < size;) {
            render_row(fur, camera, size, y, picture.data() + row_bytes * static_cast<std::size_t>(y));
        }
    };
    std::vector<std::thread> threads;
    for (unsigned i = 0; i < std::max(1u, std::thread::hardware_concurrency()); i++) threads.emplace_back(rows);
    for (std::thread &thread : threads) thread.join();
    return picture;
}

// The argument at this index, if there is one.
long number(int argc, char **argv, int index, long otherwise) {
    return index < argc ? std::strtol(argv[index], nullptr, 10) : otherwise;
}

} // namespace

int main(int argc, char **argv) {
    const long tufts = number(argc, argv, 3, 60'000), size = number(argc, argv, 4, 1000);
    if (argc < 3 || argc > 5 || tufts < 1 || tufts > 10'000'000 || size < 1 || size > 10'000) {
        std::cerr << "usage: tufts MESH.obj|MESH.ply OUT.ppm [TUFTS [PIXELS]]\n";
        return 2;
    }
    try {
        const azulejo::Context context;
        const auto mesh = azulejo::Mesh::load(argv[1]);
        azulejo::PspOptions options;
        options.radius = std::sqrt(density * mesh.area() / static_cast<double>(tufts));
        options.iterations = 3;
        options.maximal = 0;
        azulejo::PspReport report;
        const auto samples = azulejo::psp_sample(context, mesh, options, &report);
        std::printf("%zu tufts, placed in %.3f s\n", samples.size(), report.seconds);

        const Fur fur(mesh, samples, hair_length * static_cast<float>(options.radius));
        const auto picture = render(fur, Camera(mesh.positions()), static_cast<int>(size));
        std::ofstream file(argv[2], std::ios::binary);
        file << "P6 " << size << ' ' << size << " 255\n";
        file.write(reinterpret_cast<const char *>(picture.data()), static_cast<std::streamsize>(picture.size()));
        file.close();
        if (!file) throw std::runtime_error(std::string(argv[2]) + ": " + std::strerror(errno));
        return EXIT_SUCCESS;
    } catch (const std::exception &error) {
        std::cerr << "tufts: " << error.what() << '\n';
        return EXIT_FAILURE;
    }
}
