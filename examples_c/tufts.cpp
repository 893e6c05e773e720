// Fur by a renderer that uses Embree itself: scatters tufts over a mesh, one instance on each of azulejo's samples, and
// renders them (thesis Fig. 3.23: three iterations of PSP suffice for that). Its device, its scene and its rays are the
// program's own; azulejo makes the samples and knows nothing of them.
//
//   tufts MESH.obj|MESH.ply OUT.ppm [TUFTS [PIXELS]]

#include <cstdio>
#include <cstdlib>
#include <iostream>

#include "embree_scene.hpp"

namespace {

constexpr int rays_per_pixel = 24;
// Hairs of a tuft, and how many different tufts there are.
constexpr int hairs = 14, kinds = 8;
// The length of hair in radii of the samples.
constexpr float hair_length = 5;
// N * radius^2 / area of a maximal set.
constexpr double density = 0.69656;

// A tuft of height 1 that grows from the origin along z: curves that part, bend and taper.
std::vector<Curve> make_tuft(Random &random) {
    std::vector<Curve> tuft(hairs);
    for (Curve &hair : tuft) {
        const float angle = 6.2832f * uniform(random), spread = 0.35f * std::sqrt(uniform(random));
        const float tall = 0.7f + 0.3f * uniform(random), root = 0.1f * uniform(random);
        const Vec outwards{std::cos(angle), std::sin(angle), 0};
        for (std::size_t i = 0; i < 4; i++) {
            const float t = static_cast<float>(i) / 3;
            hair.places[i] = (root + spread * t * t) * outwards + Vec{0.45f * t * t, 0, tall * t * (1 - 0.2f * t)};
            hair.radii[i] = 0.018f * (1 - 0.8f * t);
        }
    }
    return tuft;
}

// Hair hangs: its direction is the normal, drawn down; it bends down, too.
Frame hanging(Vec normal, float turn) {
    Frame frame(normalized(normal + Vec{0, -0.35f, 0}));
    const Vec down = Vec{0, -1, 0} + frame.z.y * frame.z;
    if (dot(down, down) > 0.01f) {
        const Vec aside = (turn - 0.5f) * cross(frame.z, down);
        frame.x = normalized(down + aside);
        frame.y = cross(frame.z, frame.x);
    }
    return frame;
}

// A tuft on each sample.
void grow(EmbreeScene &scene, const azulejo::Points &samples, float length) {
    Random random(1);
    for (int kind = 0; kind < kinds; kind++) scene.add_part(make_tuft(random));
    for (std::size_t i = 0; i < samples.size(); i++) {
        const float *p = &samples.positions()[3 * i], *n = &samples.normals()[3 * i];
        const std::size_t kind = random() % kinds;
        const float size = length * (0.8f + 0.4f * uniform(random));
        scene.place(kind, hanging({n[0], n[1], n[2]}, uniform(random)), {p[0], p[1], p[2]}, size);
    }
}

// Hair is dark at its root, and so is the skin.
Vec colour(const RTCHit &hit, Vec) {
    const float height_on_hair = hit.instID[0] == RTC_INVALID_GEOMETRY_ID ? 0 : hit.u;
    return mixed({0.16f, 0.09f, 0.05f}, {0.86f, 0.66f, 0.44f}, height_on_hair);
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

        EmbreeScene scene;
        grow(scene, samples, hair_length * static_cast<float>(options.radius));
        scene.finish(mesh);
        const Camera camera(mesh.positions(), {0.35f, 0.45f, 1.6f}, 0.48f);
        const int pixels = static_cast<int>(size);
        write_picture(argv[2], pixels, render(scene, camera, pixels, rays_per_pixel, colour));
        return EXIT_SUCCESS;
    } catch (const std::exception &error) {
        std::cerr << "tufts: " << error.what() << '\n';
        return EXIT_FAILURE;
    }
}
