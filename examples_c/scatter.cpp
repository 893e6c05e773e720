// The main job: covers a mesh with Poisson-disk samples, fills a plane, relaxes a set, checks all three with the
// library's own analysis, and writes them as PLY files. A row of the table is for the projection alone.
//
//   scatter MESH.obj|MESH.ply [--samples 200000] [--out DIR] [--threads N]

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include <unistd.h>

#include <azulejo.hpp>

namespace {

using azulejo::Span;

constexpr std::size_t plane_samples = 1'000'000;
constexpr std::size_t relaxed_samples = 4'096;
constexpr std::uint64_t probes = 1'000'000;
// N * radius^2 / area of a maximal set: the jamming limit of random sequential placement.
constexpr double density = 0.69656;

struct Arguments {
    std::string mesh;
    std::filesystem::path out = ".";
    std::size_t samples = 200'000;
    std::uint32_t threads = 0;
};

struct Usage : std::runtime_error {
    using std::runtime_error::runtime_error;
};

std::size_t number(const std::string &option, const std::string &text, std::size_t limit) {
    std::size_t value = 0;
    for (char c : text) {
        if (c < '0' || c > '9' || (value = 10 * value + static_cast<std::size_t>(c - '0')) > limit) {
            throw Usage(option + ": " + text + " is not a number from 0 to " + std::to_string(limit));
        }
    }
    return value;
}

Arguments parse(int argc, char **argv) {
    Arguments arguments;
    for (int i = 1; i < argc; i++) {
        const std::string word = argv[i];
        if (word.compare(0, 2, "--") != 0) {
            if (!arguments.mesh.empty()) throw Usage("more than one mesh: " + word);
            arguments.mesh = word;
        } else if (word != "--samples" && word != "--out" && word != "--threads") {
            throw Usage("unknown option " + word);
        } else if (i + 1 == argc || !*argv[i + 1]) {
            throw Usage(word + " needs a value");
        } else if (word == "--samples") {
            arguments.samples = number(word, argv[++i], 1'000'000'000);
            if (arguments.samples == 0) throw Usage("--samples: 0 is too few");
        } else if (word == "--out") {
            arguments.out = argv[++i];
        } else {
            arguments.threads = static_cast<std::uint32_t>(number(word, argv[++i], 4096));
        }
    }
    if (arguments.mesh.empty()) throw Usage("no mesh");
    return arguments;
}

// A progress bar on a terminal; in a pipe there is none.
azulejo::Progress bar(const char *title) {
    if (!isatty(STDERR_FILENO)) return {};
    return [title, shown = -1](double done) mutable {
        const int percent = static_cast<int>(100 * done);
        if (percent != shown) {
            shown = percent;
            const std::string filled(static_cast<std::size_t>(percent / 4), '#');
            std::fprintf(stderr, "\r%-9s [%-25s] %3d %%", title, filled.c_str(), percent);
            if (done >= 1) std::fprintf(stderr, "\r%60s\r", "");
        }
        return true;
    };
}

template <class Call>
auto timed(double &seconds, Call call) {
    const auto start = std::chrono::steady_clock::now();
    auto result = call();
    seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return result;
}

void print_head() {
    std::printf("%-9s %9s %9s %11s  %-17s  %s\n", "set", "count", "seconds", "samples/s", "smallest distance",
                "uncovered");
}

// Distances are told in a unit: r, the radius asked for, or d_max, the spacing of a hexagonal arrangement.
void print_row(const char *set, std::size_t count, double seconds, double smallest, const char *unit,
               const std::string &uncovered) {
    std::printf("%-9s %9zu %9.3f %11.0f  %9.6f %-7s  %s\n", set, count, seconds, static_cast<double>(count) / seconds,
                smallest, unit, uncovered.c_str());
    std::fflush(stdout);
}

// The share of random places that no sample covers.
std::string probed(double uncovered) {
    const auto count = static_cast<double>(probes);
    char text[64];
    std::snprintf(text, sizeof text, "%.0f of %.0f places", uncovered * count, count);
    return text;
}

// The place that is farthest from all samples, where it can be found exactly.
std::string farthest(double distance, const char *unit) {
    char text[64];
    std::snprintf(text, sizeof text, "farthest place %.4f %s", distance, unit);
    return text;
}

// A binary PLY file of vertices, which takes its name when it is whole.
class PlyFile {
public:
    PlyFile(std::filesystem::path path, const std::string &comment, std::size_t count,
            const std::vector<const char *> &properties)
        : path_(std::move(path)), partial_(path_.string() + ".partial"), stream_(partial_, std::ios::binary) {
        stream_ << "ply\nformat binary_little_endian 1.0\ncomment " << comment << "\nelement vertex " << count << '\n';
        for (const char *property : properties) stream_ << "property " << property << '\n';
        stream_ << "end_header\n";
    }

    PlyFile(const PlyFile &) = delete;
    PlyFile &operator=(const PlyFile &) = delete;

    ~PlyFile() {
        std::error_code ignored;
        if (stream_.is_open()) std::filesystem::remove(partial_, ignored);
    }

    template <class T>
    void put(Span<const T> values, std::size_t width, std::size_t row) {
        static_assert(sizeof(T) == 4);
        for (std::size_t i = width * row; i < width * (row + 1); i++) {
            std::uint32_t bits;
            std::memcpy(&bits, &values[i], 4);
            const char bytes[4] = {static_cast<char>(bits), static_cast<char>(bits >> 8), static_cast<char>(bits >> 16),
                                   static_cast<char>(bits >> 24)};
            stream_.write(bytes, 4);
        }
    }

    void finish() {
        stream_.flush();
        if (!stream_) throw std::runtime_error(partial_.string() + ": " + std::strerror(errno));
        stream_.close();
        std::filesystem::rename(partial_, path_);
    }

private:
    std::filesystem::path path_, partial_;
    std::ofstream stream_;
};

void write_plane(const std::filesystem::path &path, const azulejo::Points &points) {
    PlyFile file(path, "domain 0 0 1 1 periodic", points.size(), {"float x", "float y"});
    for (std::size_t i = 0; i < points.size(); i++) file.put(points.positions(), 2, i);
    file.finish();
}

void write_surface(const std::filesystem::path &path, const azulejo::Points &points) {
    PlyFile file(path, "samples of a surface, made by azulejo", points.size(),
                 {"float x", "float y", "float z", "float nx", "float ny", "float nz", "uint triangle", "float u",
                  "float v"});
    for (std::size_t i = 0; i < points.size(); i++) {
        file.put(points.positions(), 3, i);
        file.put(points.normals(), 3, i);
        file.put(points.triangles(), 1, i);
        file.put(points.barycentrics(), 2, i);
    }
    file.finish();
}

void surface(const azulejo::Context &context, const azulejo::Mesh &mesh, const Arguments &arguments) {
    azulejo::PspOptions options;
    options.radius = std::sqrt(density * mesh.area() / static_cast<double>(arguments.samples));
    options.set_progress(bar("surface"));
    double seconds;
    const auto points = timed(seconds, [&] { return azulejo::psp_sample(context, mesh, options); });

    const double smallest = azulejo::space_smallest_distance(context, points);
    const double uncovered = azulejo::mesh_uncovered_fraction(context, mesh, points, options.radius, probes);
    print_row("surface", points.size(), seconds, smallest / options.radius, "r", probed(uncovered));
    write_surface(arguments.out / "surface.ply", points);
}

// What one iteration of projection finds: larger maximal sets begin with it. By default triangles are rasterised over the
// patterns; rays are the points of patterns that are compared with a triangle.
void projected(const azulejo::Context &context, const azulejo::Mesh &mesh, const Arguments &arguments) {
    azulejo::PspOptions options;
    options.radius = std::sqrt(density * mesh.area() / static_cast<double>(arguments.samples));
    options.iterations = 1;
    options.maximal = 0;
    options.engine = AZULEJO_ENGINE_RASTERISER;
    options.set_progress(bar("projected"));
    azulejo::PspReport report;
    double seconds;
    const auto points = timed(seconds, [&] { return azulejo::psp_sample(context, mesh, options, &report); });

    const double smallest = azulejo::space_smallest_distance(context, points);
    const double uncovered = azulejo::mesh_uncovered_fraction(context, mesh, points, options.radius, probes);
    const auto rays = static_cast<double>(report.rays);
    char text[96];
    std::snprintf(text, sizeof text, ", %.0f rays, %.0f/s, rasteriser", rays, rays / report.project_seconds);
    print_row("projected", points.size(), seconds, smallest / options.radius, "r", probed(uncovered) + text);
}

void plane(const azulejo::Context &context, const Arguments &arguments) {
    azulejo::KdrtOptions options;
    options.radius = std::sqrt(density / static_cast<double>(plane_samples));
    options.set_progress(bar("plane"));
    double seconds;
    const auto points = timed(seconds, [&] { return azulejo::kdrt_sample(context, options); });

    const azulejo::PlaneSet set{points, options};
    const double smallest = azulejo::plane_smallest_distance(context, set);
    const double covering = azulejo::plane_covering_radius(context, set);
    print_row("plane", points.size(), seconds, smallest / options.radius, "r", farthest(covering / options.radius, "r"));
    write_plane(arguments.out / "plane.ply", points);
}

void relax(const azulejo::Context &context, const Arguments &arguments) {
    std::mt19937 random(1);
    std::vector<float> start(2 * relaxed_samples);
    for (float &x : start) x = static_cast<float>(random() >> 8) / (1 << 24);

    azulejo::DcrOptions options;
    options.set_progress(bar("relaxed"));
    azulejo::DcrReport report;
    double seconds;
    const auto points = timed(seconds, [&] { return azulejo::dcr_relax(context, options, start, &report); });
    const double covering = azulejo::plane_covering_radius(context, {points, options});
    const double d_max = report.smallest_distance / report.rho;
    print_row("relaxed", points.size(), seconds, report.rho, "d_max", farthest(covering / d_max, "d_max"));
    write_plane(arguments.out / "relaxed.ply", points);
}

} // namespace

int main(int argc, char **argv) {
    try {
        const Arguments arguments = parse(argc, argv);
        const auto mesh = azulejo::Mesh::load(arguments.mesh);
        std::filesystem::create_directories(arguments.out);
        const azulejo::Context context(arguments.threads);
        print_head();
        surface(context, mesh, arguments);
        projected(context, mesh, arguments);
        plane(context, arguments);
        relax(context, arguments);
        return EXIT_SUCCESS;
    } catch (const Usage &error) {
        std::cerr << "scatter: " << error.what()
                  << "\nusage: scatter MESH.obj|MESH.ply [--samples 200000] [--out DIR] [--threads N]\n";
        return 2;
    } catch (const std::exception &error) {
        std::cerr << "scatter: " << error.what() << '\n';
        return EXIT_FAILURE;
    }
}
