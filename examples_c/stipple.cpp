// Stippling (thesis sections 3.4.4 and 4.2.3): draws a grey image with dots, as dense as the image is dark.
//
//   stipple IMAGE.pgm OUT.svg [DOTS]
//
// The image becomes a flat mesh with a vertex for each pixel, whose radius follows from its darkness: a maximal set has
// 0.69656 / radius^2 samples on an area of 1. Where all is white there is no mesh, and so no dot. Then the samples are
// relaxed until they are as dense as the image is dark, and evenly spread. The dots' size is that with which they have as
// much ink as the image.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

#include <azulejo.hpp>

namespace {

constexpr double density = 0.69656;
// What is lighter than this, but not white, is drawn as if it were so dark.
constexpr double lightest = 0.01;

struct Image {
    std::uint32_t width, height;
    std::vector<float> darkness; // row by row, 0 for white to 1 for black

    double ink() const { return std::accumulate(darkness.begin(), darkness.end(), 0.0); }
};

// The next number of a PGM header; comments run from # to the end of a line.
unsigned header_number(std::istream &file) {
    unsigned number;
    while (file >> std::ws && file.peek() == '#') file.ignore(1 << 20, '\n');
    if (!(file >> number)) throw std::runtime_error("a PGM header that ends too early");
    return number;
}

// A PGM file, text (P2) or binary (P5).
Image load(const char *path) {
    std::ifstream file(path, std::ios::binary);
    char magic[2] = {};
    if (!file.read(magic, 2)) throw std::runtime_error(std::string(path) + " cannot be read");
    if (magic[0] != 'P' || (magic[1] != '2' && magic[1] != '5')) throw std::runtime_error("not a PGM file, P2 or P5");
    Image image;
    image.width = header_number(file);
    image.height = header_number(file);
    const unsigned white = header_number(file);
    const std::uint64_t pixels = std::uint64_t(image.width) * image.height;
    if (image.width < 2 || image.height < 2 || pixels > 100'000'000) throw std::runtime_error("a size that cannot be drawn");
    if (white < 1 || white > 65535) throw std::runtime_error("a white that is not in 1 to 65535");
    file.get(); // one white space ends the header
    for (std::uint64_t i = 0; i < pixels; i++) {
        unsigned grey;
        if (magic[1] == '2') {
            file >> grey;
        } else {
            grey = static_cast<unsigned char>(file.get());
            if (white > 255) grey = 256 * grey + static_cast<unsigned char>(file.get());
        }
        if (!file) throw std::runtime_error("fewer pixels than the header says");
        image.darkness.push_back(float(1 - std::min(1.0, double(grey) / white)));
    }
    return image;
}

struct Canvas {
    std::vector<float> positions, radii;
    std::vector<std::uint32_t> indices;
};

// The mesh of an image, in pixels, with the radii that make about so many dots.
Canvas prepare(const Image &image, double dots) {
    const auto [width, height, darkness] = image;
    Canvas canvas;
    const double ink = image.ink();
    if (ink == 0) throw std::runtime_error("a white image has no dots");
    const auto radius = [&](double d) { return std::sqrt(density * ink / (dots * std::max(d, lightest))); };
    for (std::uint32_t y = 0; y < height; y++)
        for (std::uint32_t x = 0; x < width; x++) {
            canvas.positions.insert(canvas.positions.end(), {float(x), float(y), 0.0f});
            canvas.radii.push_back(float(radius(darkness[std::size_t(width) * y + x])));
        }
    const auto triangle = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        if (darkness[a] + darkness[b] + darkness[c] > 0) canvas.indices.insert(canvas.indices.end(), {a, b, c});
    };
    for (std::uint32_t y = 0; y + 1 < height; y++)
        for (std::uint32_t x = 0; x + 1 < width; x++) {
            const std::uint32_t a = width * y + x, b = a + 1, c = a + width, d = c + 1;
            triangle(a, b, d);
            triangle(a, d, c);
        }
    return canvas;
}

// The samples, relaxed: x y each, on a domain that begins where the image does, half a pixel before its first vertex.
azulejo::Points relax(const azulejo::Context &context, const Image &image, const azulejo::Points &samples) {
    std::vector<float> xy;
    const auto xyz = samples.positions();
    for (std::size_t i = 0; i < samples.size(); i++)
        xy.insert(xy.end(), {xyz[3 * i] + 0.5f, xyz[3 * i + 1] + 0.5f});
    azulejo::DcrOptions options;
    options.set_domain({{0, 0}, {image.width, image.height}, AZULEJO_BOUNDARY_BOUNDED});
    azulejo::Density density;
    density.values = image.darkness;
    density.width = image.width;
    return azulejo::dcr_relax_density(context, options, density, xy);
}

// One path of strokes without length, whose round caps are the dots.
void write(const char *path, const Image &image, const azulejo::Points &points) {
    const double diameter = 2 * std::sqrt(image.ink() / (3.14159265 * double(points.size())));
    std::ofstream file(path);
    file << "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " << image.width << ' ' << image.height << "\">\n"
         << "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n<path stroke=\"black\" stroke-linecap=\"round\" "
         << "stroke-width=\"" << diameter << "\" d=\"\n";
    const auto xy = points.positions();
    for (std::size_t i = 0; i < points.size(); i++) {
        char text[64];
        std::snprintf(text, sizeof text, "M%.3f %.3fh0\n", xy[2 * i], xy[2 * i + 1]);
        file << text;
    }
    file << "\"/>\n</svg>\n";
    file.close();
    if (!file) throw std::runtime_error(std::string(path) + " cannot be written");
}

} // namespace

int main(int argc, char **argv) {
    char *end = nullptr;
    const double dots = argc == 4 ? std::strtod(argv[3], &end) : 20000;
    if (argc < 3 || argc > 4 || (end && *end) || !(dots >= 1 && dots <= 1e8)) {
        std::cerr << "usage: stipple IMAGE.pgm OUT.svg [DOTS]\n";
        return 2;
    }
    try {
        const Image image = load(argv[1]);
        const Canvas canvas = prepare(image, dots);
        const azulejo::Context context;
        const azulejo::Mesh mesh(canvas.positions, canvas.indices);
        azulejo::PspAdaptiveOptions options;
        options.set_vertex_radii(canvas.radii);
        const auto points = relax(context, image, azulejo::psp_adaptive_sample(context, mesh, options));
        write(argv[2], image, points);
        std::printf("%zu dots\n", points.size());
        return EXIT_SUCCESS;
    } catch (const std::exception &error) {
        std::cerr << "stipple: " << error.what() << '\n';
        return EXIT_FAILURE;
    }
}
