// A brush: samples on a mesh are erased and filled again stroke by stroke, without a look at the rest of the set.
//
//   paint MESH.obj|MESH.ply [SAMPLES] [STROKES]
//
// Covers the mesh, then strokes it with a brush of 20 radii, undoes every second stroke, and writes the time of a stroke
// beside that of the whole set. At the end the set must be maximal, conflict-free, and the same wherever no stroke was.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <map>
#include <random>
#include <vector>

#include <azulejo.hpp>

namespace {

// N * radius^2 / area of a maximal set: the jamming limit of random sequential placement.
constexpr double density = 0.69656;
constexpr double brush_radii = 20;

using Clock = std::chrono::steady_clock;

double milliseconds_since(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

// The samples as the host keeps them: by id, as instances of an object would be.
class Scene {
public:
    void add(const azulejo::Points &points) {
        for (std::size_t i = 0; i < points.size(); i++) {
            const float *at = points.positions().data() + 3 * i;
            positions_[points.ids()[i]] = {at[0], at[1], at[2]};
        }
    }

    void remove(const azulejo::Points &points) {
        for (const std::uint64_t id : points.ids()) positions_.erase(id);
    }

    bool is(const azulejo::Points &points) const {
        if (points.size() != positions_.size()) return false;
        for (std::size_t i = 0; i < points.size(); i++) {
            const auto own = positions_.find(points.ids()[i]);
            if (own == positions_.end() || !std::equal(own->second.begin(), own->second.end(), &points.positions()[3 * i]))
                return false;
        }
        return true;
    }

private:
    std::map<std::uint64_t, std::array<float, 3>> positions_;
};

int paint(const char *path, std::size_t samples, int strokes) {
    const azulejo::Context context(1);
    const auto mesh = azulejo::Mesh::load(path);
    azulejo::PspOptions options;
    options.radius = std::sqrt(density * mesh.area() / static_cast<double>(samples));

    auto start = Clock::now();
    azulejo::Psp set(context, mesh, options);
    set.fill();
    const double whole = milliseconds_since(start);
    const auto places = set.points();

    // The first edit prepares the set, and the first refill the mesh: before the user strokes.
    start = Clock::now();
    Scene scene;
    set.erase(azulejo::Region::box({1, 1, 1}, {1, 1, 1}));
    set.refill(0);
    const double prepared = milliseconds_since(start);
    scene.add(set.points());

    std::mt19937 random(1);
    std::vector<double> times;
    std::size_t erased_count = 0;
    for (int stroke = 0; stroke < strokes; stroke++) {
        const float *at = &places.positions()[3 * (random() % places.size())];
        const auto brush = azulejo::Region::ball({at[0], at[1], at[2]}, brush_radii * options.radius);
        start = Clock::now();
        const auto erased = set.erase(brush);
        const auto added = set.refill(1 + static_cast<std::uint64_t>(stroke));
        times.push_back(milliseconds_since(start));
        erased_count += erased.size();
        if (stroke % 2 == 0) {
            scene.remove(erased);
            scene.add(added);
        } else {
            set.erase(added.ids());
            set.restore(erased);
        }
    }
    std::sort(times.begin(), times.end());
    std::printf("%zu triangles, %zu samples in %.1f ms; prepared in %.1f ms\n", mesh.triangle_count(), places.size(), whole,
                prepared);
    std::printf("%d strokes of %zu samples each: %.2f ms in the median, %.2f ms at most\n", strokes,
                erased_count / static_cast<std::size_t>(strokes), times[times.size() / 2], times.back());

    const auto painted = set.points();
    const bool is_same = scene.is(painted);
    const double smallest = azulejo::space_smallest_distance(context, painted);
    const auto coverage = azulejo::mesh_coverage(context, mesh, painted, options.radius);
    std::printf("the scene is the set: %s; smallest distance %.6f radii; gaps %llu\n", is_same ? "yes" : "no",
                smallest / options.radius, static_cast<unsigned long long>(coverage.gaps));
    return is_same && smallest >= options.radius && coverage.gaps == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

} // namespace

int main(int argc, char **argv) {
    const long samples = argc > 2 ? std::atol(argv[2]) : 100'000, strokes = argc > 3 ? std::atol(argv[3]) : 100;
    if (argc < 2 || argc > 4 || samples < 1 || strokes < 1 || strokes > 100'000) {
        std::fprintf(stderr, "usage: paint MESH.obj|MESH.ply [SAMPLES] [STROKES]\n");
        return 2;
    }
    try {
        return paint(argv[1], static_cast<std::size_t>(samples), static_cast<int>(strokes));
    } catch (const std::exception &error) {
        std::fprintf(stderr, "paint: %s\n", error.what());
        return EXIT_FAILURE;
    }
}
