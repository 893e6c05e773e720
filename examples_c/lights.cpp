// Virtual point lights (Keller 1997; thesis fig. 3.22): the light that a room's surfaces reflect, by lights on them.
//
//   lights PICTURE.ppm [LIGHTS [SIZE]]
//
// A lamp under the ceiling lights the surfaces of a room. Points spread over them shine on with what they get, and Embree
// finds which places see them. The points are blue noise, an exact number of them, or as many random ones. Prints how far
// the reflected light is from a reference of many random lights: the error of sets of both kinds, root mean square over
// places of the picture, relative to the mean. The left half of the picture has blue-noise lights, the right half random
// ones, and each shows the pattern of its errors.

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <memory>

#include "embree_scene.hpp"

namespace {

constexpr int sets = 40;
constexpr int places_per_side = 16;
constexpr std::size_t reference_factor = 1'000;
constexpr Vec lamp{0.5f, 0.97f, 0.5f};
constexpr float pi = 3.1415927f;
// Lights nearer than this shine as from there, or places beside one would be white.
constexpr float nearest = 0.15f;
// How far rays start from the surface that they leave.
constexpr float lift = 1e-4f;

// The room, open to the camera, with two blocks in it; triangles face what they light.
struct Room {
    std::vector<float> positions;
    std::vector<std::uint32_t> indices;

    void add(Vec corner, Vec u, Vec v) {
        const auto first = static_cast<std::uint32_t>(positions.size() / 3);
        for (const Vec place : {corner, corner + u, corner + u + v, corner + v}) {
            positions.insert(positions.end(), {place.x, place.y, place.z});
        }
        for (const std::uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) indices.push_back(first + i);
    }

    void add_block(Vec low, Vec size) {
        const Vec x{size.x, 0, 0}, y{0, size.y, 0}, z{0, 0, size.z};
        add(low + y, z, x);
        add(low, z, y);
        add(low + x, y, z);
        add(low + z, x, y);
        add(low, y, x);
    }

    Room() {
        const Vec x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
        add({0, 0, 0}, z, x);
        add(y, x, z);
        add({0, 0, 0}, y, z);
        add(x, z, y);
        add({0, 0, 0}, x, y);
        add_block({0.15f, 0, 0.2f}, {0.3f, 0.6f, 0.25f});
        add_block({0.55f, 0, 0.5f}, {0.3f, 0.3f, 0.3f});
    }
};

Vec colour(Vec place) {
    if (place.x < 1e-3f) return {0.75f, 0.25f, 0.2f};
    if (place.x > 1 - 1e-3f) return {0.2f, 0.45f, 0.75f};
    return {0.75f, 0.75f, 0.72f};
}

// A place of the surface with its normal; the light that it has.
struct Place {
    Vec position, normal, light;
};

bool sees(const EmbreeScene &scene, Vec from, Vec normal, Vec to) {
    const Vec start = from + lift * normal, way = to - start;
    return scene.is_lit(start, way, 1 - 2 * lift / std::sqrt(dot(way, way)));
}

// What the lamp gives a place.
Vec direct(const EmbreeScene &scene, Vec position, Vec normal) {
    const Vec way = lamp - position;
    const float squared = dot(way, way), facing = dot(normal, way), below = way.y;
    if (facing <= 0 || below <= 0 || !sees(scene, position, normal, lamp)) return {0, 0, 0};
    const float light = facing * below / (squared * squared);
    return {light, light, light};
}

// Lights at places of the surface, each for the same part of its area. Those in shadow are left out.
std::vector<Place> lights(const EmbreeScene &scene, const std::vector<Place> &places, double area) {
    const float part = static_cast<float>(area / static_cast<double>(places.size()));
    std::vector<Place> lit;
    for (Place place : places) {
        place.light = (part / (pi * pi)) * (colour(place.position) * direct(scene, place.position, place.normal));
        if (place.light.x > 0) lit.push_back(place);
    }
    return lit;
}

// What the lights give a place.
Vec gathered(const EmbreeScene &scene, const std::vector<Place> &lights, Vec position, Vec normal) {
    Vec sum{0, 0, 0};
    for (const Place &light : lights) {
        const Vec way = light.position - position;
        const float here = dot(normal, way), there = -dot(light.normal, way);
        if (here <= 0 || there <= 0) continue;
        const Vec end = light.position + lift * light.normal;
        if (!sees(scene, position, normal, end)) continue;
        const float squared = dot(way, way), bounded = std::max(squared, nearest * nearest);
        sum = sum + (here * there / (squared * bounded)) * light.light;
    }
    return sum;
}

std::vector<Place> blue_noise(const azulejo::Context &context, const azulejo::Mesh &mesh, std::size_t count,
                              std::uint64_t seed) {
    azulejo::PspOptions options;
    options.count = count;
    options.seed = seed;
    const auto points = azulejo::psp_sample(context, mesh, options);
    const auto p = points.positions();
    const auto n = points.normals();
    std::vector<Place> places;
    for (std::size_t i = 0; i < 3 * points.size(); i += 3) {
        places.push_back({{p[i], p[i + 1], p[i + 2]}, {n[i], n[i + 1], n[i + 2]}, {0, 0, 0}});
    }
    return places;
}

std::vector<Place> random_places(const Room &room, std::size_t count, unsigned seed) {
    std::mt19937 random(seed);
    const auto unit = [&] { return static_cast<float>(random() >> 8) / (1 << 24); };
    const auto corner = [&](std::size_t i) {
        const float *at = &room.positions[3 * room.indices[i]];
        return Vec{at[0], at[1], at[2]};
    };
    std::vector<float> areas;
    float all = 0;
    for (std::size_t i = 0; i < room.indices.size(); i += 3) {
        const Vec doubled = cross(corner(i + 1) - corner(i), corner(i + 2) - corner(i));
        areas.push_back(all += std::sqrt(dot(doubled, doubled)));
    }
    std::vector<Place> places;
    while (places.size() < count) {
        const auto found = std::upper_bound(areas.begin(), areas.end() - 1, all * unit());
        const auto i = 3 * static_cast<std::size_t>(found - areas.begin());
        const Vec u = corner(i + 1) - corner(i), v = corner(i + 2) - corner(i);
        float a = unit(), b = unit();
        if (a + b > 1) a = 1 - a, b = 1 - b;
        places.push_back({corner(i) + a * u + b * v, normalized(cross(u, v)), {0, 0, 0}});
    }
    return places;
}

// The light of all places, one channel after the other.
std::vector<double> measure(const EmbreeScene &scene, const std::vector<Place> &places,
                            const std::vector<Place> &lights) {
    std::vector<double> values(3 * places.size());
    in_parallel(static_cast<int>(places.size()), [&](int i) {
        const auto k = static_cast<std::size_t>(i);
        const Vec light = gathered(scene, lights, places[k].position, places[k].normal);
        values[3 * k] = light.x, values[3 * k + 1] = light.y, values[3 * k + 2] = light.z;
    });
    return values;
}

double relative_error(const std::vector<double> &values, const std::vector<double> &reference) {
    double squares = 0, sum = 0;
    for (std::size_t i = 0; i < values.size(); i++) {
        squares += (values[i] - reference[i]) * (values[i] - reference[i]);
        sum += reference[i];
    }
    const auto count = static_cast<double>(values.size());
    return std::sqrt(squares / count) / (sum / count);
}

// The mean of errors, and its standard error.
struct Mean {
    double mean = 0, error = 0;

    explicit Mean(const std::vector<double> &values) {
        const auto count = static_cast<double>(values.size());
        for (const double value : values) mean += value / count;
        for (const double value : values) error += (value - mean) * (value - mean);
        error = std::sqrt(error / (count * (count - 1)));
    }
};

// The first place that is seen, if there is one.
bool look(const EmbreeScene &scene, Vec eye, Vec direction, Place &place) {
    const RTCRayHit hit = scene.trace(eye, direction);
    if (hit.hit.geomID == RTC_INVALID_GEOMETRY_ID) return false;
    place.normal = normalized({hit.hit.Ng_x, hit.hit.Ng_y, hit.hit.Ng_z});
    place.position = eye + hit.ray.tfar * direction;
    return dot(place.normal, direction) < 0;
}

void draw(const char *path, int size, const EmbreeScene &scene, const Camera &camera, const std::vector<Place> &left,
          const std::vector<Place> &right) {
    const auto width = static_cast<std::size_t>(size);
    std::vector<unsigned char> picture(3 * width * width, 255);
    in_parallel(size, [&](int y) {
        for (int x = 0; x < size; x++) {
            const float step = 1 / static_cast<float>(size);
            Place place;
            const Vec direction =
                camera.through(step * (static_cast<float>(x) + 0.5f), step * (static_cast<float>(y) + 0.5f));
            if (!look(scene, camera.eye, direction, place)) continue;
            const auto &lights = 2 * x < size ? left : right;
            // Reflected light alone, and brighter than it is, as lamplight would outshine it.
            const Vec seen = 6 * (colour(place.position) * gathered(scene, lights, place.position, place.normal));
            unsigned char *byte = &picture[3 * (width * static_cast<std::size_t>(y) + static_cast<std::size_t>(x))];
            for (const float channel : {seen.x, seen.y, seen.z}) {
                *byte++ = static_cast<unsigned char>(255 * std::pow(std::min(1.0f, channel), 1 / 2.2f) + 0.5f);
            }
        }
    });
    write_picture(path, size, picture);
}

void run(const char *path, std::size_t count, int size) {
    const azulejo::Context context;
    const Room room;
    const azulejo::Mesh mesh(room.positions, room.indices);
    EmbreeScene scene;
    scene.finish(mesh);
    const Camera camera(mesh.positions(), {0, 0, 0.8f}, 1.13f);

    std::vector<Place> places;
    for (int i = 0; i < places_per_side * places_per_side; i++) {
        const auto at = [](int k) { return (static_cast<float>(k) + 0.5f) / places_per_side; };
        Place place{};
        if (look(scene, camera.eye, camera.through(at(i % places_per_side), at(i / places_per_side)), place)) {
            places.push_back(place);
        }
    }
    const auto many = random_places(room, reference_factor * count, 1'000'000);
    const auto reference = measure(scene, places, lights(scene, many, mesh.area()));

    std::vector<double> blue, random;
    std::vector<Place> first_blue, first_random;
    for (unsigned seed = 1; seed <= sets; seed++) {
        const auto spread = lights(scene, blue_noise(context, mesh, count, seed), mesh.area());
        const auto thrown = lights(scene, random_places(room, count, seed), mesh.area());
        blue.push_back(relative_error(measure(scene, places, spread), reference));
        random.push_back(relative_error(measure(scene, places, thrown), reference));
        if (seed == 1) first_blue = spread, first_random = thrown;
    }
    const Mean of_blue(blue), of_random(random);
    std::printf("%zu lights, %zu places, %d sets each, reference of %zu lights\n", count, places.size(), sets,
                many.size());
    std::printf("blue noise: error %.4f +- %.4f\nrandom:     error %.4f +- %.4f\n", of_blue.mean, of_blue.error,
                of_random.mean, of_random.error);
    const double ratio = of_random.mean / of_blue.mean;
    const double margin = 3 * std::hypot(of_blue.error, of_random.error), gain = of_random.mean - of_blue.mean;
    if (gain > margin) {
        std::printf("Blue-noise lights are better: random ones have %.2f times their error.\n", ratio);
    } else if (gain < -margin) {
        std::printf("Random lights are better: they have %.2f times the error of blue-noise ones.\n", ratio);
    } else {
        std::printf("Neither is better: the errors differ by less than three standard errors.\n");
    }
    draw(path, size, scene, camera, first_blue, first_random);
}

} // namespace

int main(int argc, char **argv) {
    const int count = argc > 2 ? std::atoi(argv[2]) : 500;
    const int size = argc > 3 ? std::atoi(argv[3]) : 384;
    if (argc < 2 || argc > 4 || count < 10 || size < 16) {
        std::cerr << "usage: lights PICTURE.ppm [LIGHTS [SIZE]]\n";
        return EXIT_FAILURE;
    }
    try {
        run(argv[1], static_cast<std::size_t>(count), size);
        return EXIT_SUCCESS;
    } catch (const std::exception &error) {
        std::cerr << "lights: " << error.what() << '\n';
        return EXIT_FAILURE;
    }
}
