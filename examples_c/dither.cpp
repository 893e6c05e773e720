// Dithering: a halftone of a grey image by a blue-noise mask, which is made once and repeated like a tile.
//
//   dither IMAGE.pgm|- OUT.pgm [LEVELS]
//
// For - instead of an image a gradient is drawn, black at the left, white at the right. Greys of a PGM file are sRGB;
// light adds up where numbers are linear, so they are made linear before, and the levels, which are equal steps of light,
// are written as sRGB again. The program says how much light the image and its halftone have.

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <azulejo.hpp>

namespace {

struct Image {
    std::size_t width, height;
    std::vector<std::uint8_t> greys;
};

float linear(std::uint8_t grey) {
    const double c = grey / 255.0;
    return float(c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4));
}

std::uint8_t srgb(double light) {
    const double c = light <= 0.0031308 ? light * 12.92 : 1.055 * std::pow(light, 1 / 2.4) - 0.055;
    return std::uint8_t(std::lround(255 * c));
}

Image gradient() {
    Image image{512, 128, {}};
    for (std::size_t i = 0; i < image.width * image.height; i++) {
        image.greys.push_back(srgb(double(i % image.width) / double(image.width - 1)));
    }
    return image;
}

// A binary PGM file of one byte per pixel.
Image load(const char *path) {
    std::ifstream file(path, std::ios::binary);
    std::string magic;
    std::size_t width = 0, height = 0, white = 0;
    if (!(file >> magic >> width >> height >> white) || magic != "P5" || white != 255) {
        throw std::runtime_error(std::string(path) + " is no PGM file P5 with a white of 255");
    }
    if (width < 1 || height < 1 || width > 100'000'000 / height) throw std::runtime_error("a size that cannot be drawn");
    file.get(); // one white space ends the header
    Image image{width, height, std::vector<std::uint8_t>(width * height)};
    file.read(reinterpret_cast<char *>(image.greys.data()), std::streamsize(image.greys.size()));
    if (!file) throw std::runtime_error("fewer pixels than the header says");
    return image;
}

void dither(const char *source, const char *target, unsigned levels) {
    const Image image = source == std::string("-") ? gradient() : load(source);
    std::vector<float> light;
    for (const std::uint8_t grey : image.greys) light.push_back(linear(grey));

    azulejo::MaskOptions options;
    options.width = options.height = 128;
    const azulejo::Mask mask = azulejo::mask_create(azulejo::Context(), options);
    std::vector<std::uint8_t> halftone(light.size());
    azulejo::check(mask.try_dither(azulejo::Span<const float>(light), image.width, 1, levels, halftone));

    double before = 0, after = 0;
    for (std::size_t i = 0; i < light.size(); i++) {
        const double level = double(halftone[i]) / (levels - 1);
        before += double(light[i]);
        after += level;
        halftone[i] = srgb(level);
    }
    std::ofstream file(target, std::ios::binary);
    file << "P5\n" << image.width << ' ' << image.height << "\n255\n";
    file.write(reinterpret_cast<const char *>(halftone.data()), std::streamsize(halftone.size()));
    file.close();
    if (!file) throw std::runtime_error(std::string(target) + " cannot be written");
    const double pixels = double(light.size());
    std::printf("light %.4f in the image, %.4f in the halftone of %u levels\n", before / pixels, after / pixels, levels);
}

} // namespace

int main(int argc, char **argv) {
    const long levels = argc > 3 ? std::atol(argv[3]) : 2;
    if (argc < 3 || argc > 4 || levels < 2 || levels > 256) {
        std::fprintf(stderr, "usage: dither IMAGE.pgm|- OUT.pgm [LEVELS, 2 to 256]\n");
        return 2;
    }
    try {
        dither(argv[1], argv[2], unsigned(levels));
    } catch (const std::exception &error) {
        std::fprintf(stderr, "dither: %s\n", error.what());
        return 1;
    }
}
