// A forest of three classes: trees, shrubs and grass on a terrain, each well spread, none in another's way. Trees stand
// where it is not steep, shrubs keep off the rock, grass grows everywhere but on the path. Rendered by Embree.
//
//   forest OUT.ppm [TREES [PIXELS]]

#include <cstdio>
#include <cstdlib>
#include <iostream>

#include "embree_scene.hpp"

namespace {

constexpr int rays_per_pixel = 16;
// Quads along a side of the terrain, which is 1 long.
constexpr std::uint32_t side = 160;
// Own radii of trees, shrubs and grass, as shares of the first.
constexpr double shares[3] = {1, 0.4, 0.11};
// Smaller than 1: grass grows also below trees.
constexpr double factor = 0.8;
// How tall a plant of each class is, in its own radii, and how many different ones there are.
constexpr float heights[3] = {1.3f, 0.55f, 1.5f};
constexpr std::size_t kinds = 6;
// N * radius^2 / area of a maximal set.
constexpr double density = 0.69656;

float height(float x, float z) {
    const float hills = 0.06f * std::sin(7 * x + 1) * std::sin(5 * z + 0.5f) + 0.02f * std::sin(19 * x - 4 * z);
    const float hill = 0.22f * std::exp(-30 * ((x - 0.68f) * (x - 0.68f) + (z - 0.3f) * (z - 0.3f)));
    return hills + hill;
}

// How far a place is from the middle of the path.
float from_path(float x, float z) { return std::abs(x - 0.32f - 0.1f * std::sin(6 * z)); }

// The terrain; for each triangle a bit for each class that may stand there.
azulejo::Mesh make_terrain(std::vector<std::uint32_t> &masks) {
    std::vector<float> positions;
    std::vector<std::uint32_t> indices;
    const auto place = [](std::uint32_t i) { return static_cast<float>(i) / side; };
    for (std::uint32_t j = 0; j <= side; j++) {
        for (std::uint32_t i = 0; i <= side; i++) {
            const float x = place(i), z = place(j);
            positions.insert(positions.end(), {x, height(x, z), z});
        }
    }
    for (std::uint32_t j = 0; j < side; j++) {
        for (std::uint32_t i = 0; i < side; i++) {
            const std::uint32_t a = j * (side + 1) + i, b = a + side + 1;
            indices.insert(indices.end(), {a, b, a + 1, a + 1, b, b + 1});
            const float x = place(i), z = place(j), step = 1.0f / side;
            const float east = (height(x + step, z) - height(x, z)) / step;
            const float north = (height(x, z + step) - height(x, z)) / step;
            const float steep = std::sqrt(east * east + north * north), path = from_path(x, z);
            const std::uint32_t mask = (steep < 0.6f && path > 0.05f ? 1u : 0u) |
                                       (steep < 0.9f && path > 0.03f ? 2u : 0u) | (path > 0.02f ? 4u : 0u);
            masks.insert(masks.end(), {mask, mask});
        }
    }
    return azulejo::Mesh(positions, indices);
}

// A curve from one place to another that sags or rises in between.
Curve bent(Vec from, Vec to, float rise, float thick, float thin) {
    const Vec lift{0, 0, rise};
    return {{from, mixed(from, to, 0.33f) + lift, mixed(from, to, 0.67f) + lift, to},
            {thick, mixed({thick, 0, 0}, {thin, 0, 0}, 0.33f).x, mixed({thick, 0, 0}, {thin, 0, 0}, 0.67f).x, thin}};
}

Vec around(float angle, float far, float tall) { return {far * std::cos(angle), far * std::sin(angle), tall}; }

// Plants of height 1 that grow from the origin along z: a fir, a bush of twigs, blades of grass.
std::vector<Curve> make_plant(std::size_t kind, Random &random) {
    std::vector<Curve> plant;
    const auto turn = [&] { return 6.2832f * uniform(random); };
    if (kind == 0) {
        plant.push_back(bent({0, 0, 0}, {0, 0, 1}, 0, 0.03f, 0.004f));
        for (int branch = 0; branch < 110; branch++) {
            const float tall = 0.15f + 0.83f * uniform(random), angle = turn();
            const float far = 0.32f * (1.04f - tall) * (0.8f + 0.4f * uniform(random));
            plant.push_back(bent({0, 0, tall}, around(angle, far, tall - 0.35f * far), 0.02f, 0.013f, 0.004f));
        }
    } else if (kind == 1) {
        for (int twig = 0; twig < 60; twig++) {
            const float angle = turn(), rise = uniform(random), far = 0.55f * std::sqrt(1 - rise * rise);
            plant.push_back(bent({0, 0, 0}, around(angle, far, 0.15f + 0.75f * rise), 0.1f, 0.02f, 0.035f));
        }
    } else {
        for (int blade = 0; blade < 9; blade++) {
            const float angle = turn(), far = 0.5f * uniform(random);
            const Vec root = around(turn(), 0.2f * uniform(random), 0);
            plant.push_back(bent(root, root + around(angle, far, 0.6f + 0.4f * uniform(random)), 0.1f, 0.05f, 0.01f));
        }
    }
    return plant;
}

// A plant on each sample.
void grow(EmbreeScene &scene, const azulejo::Points &samples, const azulejo::Classes &classes) {
    Random random(1);
    for (std::size_t part = 0; part < 3 * kinds; part++) scene.add_part(make_plant(part / kinds, random));
    for (std::size_t i = 0; i < samples.size(); i++) {
        const float *p = &samples.positions()[3 * i], *n = &samples.normals()[3 * i];
        const std::uint32_t plant = samples.classes()[i];
        // Trees stand upright, grass grows along the normal.
        const Vec up = normalized(mixed({0, 1, 0}, {n[0], n[1], n[2]}, 0.5f * static_cast<float>(plant)));
        const float size = heights[plant] * static_cast<float>(classes.radius(plant, plant));
        scene.place(plant * kinds + random() % kinds, Frame(up), {p[0], p[1], p[2]},
                    size * (0.75f + 0.5f * uniform(random)));
    }
}

// The argument at this index, if there is one.
long number(int argc, char **argv, int index, long otherwise) {
    return index < argc ? std::strtol(argv[index], nullptr, 10) : otherwise;
}

} // namespace

int main(int argc, char **argv) {
    const long trees = number(argc, argv, 2, 300), size = number(argc, argv, 3, 1000);
    if (argc < 2 || argc > 4 || trees < 1 || trees > 100'000 || size < 1 || size > 10'000) {
        std::cerr << "usage: forest OUT.ppm [TREES [PIXELS]]\n";
        return 2;
    }
    try {
        const azulejo::Context context;
        std::vector<std::uint32_t> masks;
        const auto terrain = make_terrain(masks);
        const double radius = std::sqrt(density * terrain.area() / static_cast<double>(trees));
        const std::vector<double> own = {shares[0] * radius, shares[1] * radius, shares[2] * radius};
        auto classes = azulejo::classes_radii(own, factor);
        classes.masks = masks;
        azulejo::PspOptions options;
        const auto samples = azulejo::psp_sample_classes(context, terrain, options, classes);

        std::array<std::size_t, 3> counts{};
        for (std::uint32_t plant : samples.classes()) counts[plant]++;
        std::printf("%zu trees, %zu shrubs, %zu tufts of grass\n", counts[0], counts[1], counts[2]);

        EmbreeScene scene;
        grow(scene, samples, classes);
        scene.finish(terrain);
        const auto colour = [&](const RTCHit &hit, Vec place) -> Vec {
            if (hit.instID[0] == RTC_INVALID_GEOMETRY_ID) {
                return from_path(place.x, place.z) < 0.02f ? Vec{0.55f, 0.45f, 0.32f} : Vec{0.24f, 0.21f, 0.13f};
            }
            const Vec dark[3] = {{0.10f, 0.13f, 0.06f}, {0.20f, 0.20f, 0.07f}, {0.20f, 0.26f, 0.08f}};
            const Vec light[3] = {{0.12f, 0.30f, 0.12f}, {0.45f, 0.40f, 0.12f}, {0.42f, 0.55f, 0.18f}};
            const std::uint32_t plant = samples.classes()[hit.instID[0]];
            return mixed(dark[plant], light[plant], hit.u);
        };
        const Camera camera(terrain.positions(), {0.1f, 0.62f, 0.7f}, 0.88f);
        const int pixels = static_cast<int>(size);
        write_picture(argv[1], pixels, render(scene, camera, pixels, rays_per_pixel, colour));
        return EXIT_SUCCESS;
    } catch (const std::exception &error) {
        std::cerr << "forest: " << error.what() << '\n';
        return EXIT_FAILURE;
    }
}
