// Adds plants to a painted set: trees stand where an artist put them, a road runs between them, shrubs and then grass
// fill the rest of the ground. Prints a line for each kind and checks that nothing stands too close to anything.
//
//   plants [seed]

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <tuple>
#include <vector>

#include <azulejo.hpp>

namespace {

// Gentle hills over a square of 100 m.
azulejo::Mesh hills() {
    constexpr std::uint32_t side = 100;
    std::vector<float> positions;
    std::vector<std::uint32_t> indices;
    for (std::uint32_t y = 0; y <= side; y++) {
        for (std::uint32_t x = 0; x <= side; x++) {
            const float u = static_cast<float>(x), v = static_cast<float>(y);
            positions.insert(positions.end(), {u, v, 4 * std::sin(u / 15) * std::cos(v / 20)});
            if (x == side || y == side) continue;
            const std::uint32_t a = y * (side + 1) + x, b = a + 1, c = a + side + 1, d = c + 1;
            indices.insert(indices.end(), {a, b, d, a, d, c});
        }
    }
    return azulejo::Mesh(positions, indices);
}

// All that stands on the ground, and how much room each needs: what a new plant keeps clear of.
struct Standing {
    std::vector<float> positions;
    std::vector<double> clearances;

    void add(float x, float y, double clearance) {
        positions.insert(positions.end(), {x, y, 4 * std::sin(x / 15) * std::cos(y / 20)});
        clearances.push_back(clearance);
    }

    void add(const azulejo::Points &plants, double clearance) {
        positions.insert(positions.end(), plants.positions().begin(), plants.positions().end());
        clearances.insert(clearances.end(), plants.size(), clearance);
    }
};

// Plants of a kind, this far from each other, around what stands already.
azulejo::Points grow(const azulejo::Context &context, const azulejo::Mesh &ground, const Standing &standing,
                     double distance, std::uint64_t seed) {
    azulejo::PspOptions options;
    options.radius = distance;
    options.seed = seed;
    options.set_given(standing.positions, standing.clearances);
    return azulejo::psp_sample(context, ground, options);
}

// How many of the plants are too close to something that stood before.
std::size_t too_close(const Standing &standing, const azulejo::Points &plants) {
    std::size_t count = 0;
    const auto places = plants.positions();
    for (std::size_t i = 0; i < plants.size(); i++) {
        for (std::size_t j = 0; j < standing.clearances.size(); j++) {
            double squared = 0;
            for (std::size_t axis = 0; axis < 3; axis++) {
                const double apart = double{places[3 * i + axis]} - double{standing.positions[3 * j + axis]};
                squared += apart * apart;
            }
            count += std::sqrt(squared) < standing.clearances[j];
        }
    }
    return count;
}

} // namespace

int main(int argc, char **argv) {
    try {
        const std::uint64_t seed = argc > 1 ? std::stoull(argv[1]) : 0;
        const azulejo::Context context;
        const azulejo::Mesh ground = hills();
        Standing standing;
        // Painted by hand: given samples may be closer to each other than their clearance.
        for (const auto &[x, y, crown] : {std::array{20.f, 30.f, 6.f}, {24.f, 33.f, 5.f}, {70.f, 75.f, 8.f}}) {
            standing.add(x, y, crown);
        }
        // The road, as points along its middle: half of its width and a bit more, for what lies between them.
        for (int i = 0; i <= 200; i++) {
            const float along = static_cast<float>(i) / 2;
            standing.add(along, 50 + 20 * std::sin(along / 20), 2.02);
        }
        std::size_t bad = 0;
        for (const auto &[kind, distance, room] :
             {std::tuple{"shrubs", 4.0, 1.5}, std::tuple{"grass", 0.5, 0.5}}) {
            const auto plants = grow(context, ground, standing, distance, seed);
            bad += too_close(standing, plants);
            std::printf("%-8s %7zu\n", kind, plants.size());
            standing.add(plants, room);
        }
        std::printf("%zu too close\n", bad);
        return bad == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
    } catch (const std::exception &error) {
        std::fprintf(stderr, "plants: %s\n", error.what());
        return EXIT_FAILURE;
    }
}
