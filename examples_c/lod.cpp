// A forest that thins out with distance, without popping: levels of detail are prefixes of one set in progressive order.
//
//   lod OUT.ppm [TREES [WIDTH]]
//
// All trees stand on the samples of one set. A tree is drawn where its rank is at least so many times its distance from the
// eye: whatever the distance, those that are drawn there are well spread, and as far apart in the picture. It grows to its
// size while the camera comes nearer, so that none appears at once. A renderer keeps the trees sorted as they come, and
// asks for the first few of each region.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstdint>
#include <fstream>
#include <iostream>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <azulejo.hpp>

namespace {

using Vec = std::array<float, 3>;

// The land: a square of this side with hills, the eye above its edge.
constexpr float side = 400, eye_height = 22;
constexpr std::uint32_t cells = 300;
// A tree is left out where its rank is below this share of its distance, and has its size at twice that.
constexpr float finest = 0.012f;
constexpr float tree_height = 5.5f;

float height(float x, float y) {
    return 9 * std::sin(0.021f * x + 1) * std::cos(0.017f * y) + 4 * std::sin(0.05f * x) * std::sin(0.043f * y + 2);
}

// The place of a vertex of the land.
Vec place(std::uint32_t column, std::uint32_t row) {
    const float x = side * (static_cast<float>(column) / cells - 0.5f), y = side * static_cast<float>(row) / cells;
    return {x, y, height(x, y)};
}

azulejo::Mesh land() {
    std::vector<float> positions;
    std::vector<std::uint32_t> indices;
    for (std::uint32_t row = 0; row <= cells; row++) {
        for (std::uint32_t column = 0; column <= cells; column++) {
            const Vec vertex = place(column, row);
            positions.insert(positions.end(), vertex.begin(), vertex.end());
            if (row == cells || column == cells) continue;
            const std::uint32_t a = row * (cells + 1) + column, c = a + cells + 1;
            indices.insert(indices.end(), {a, a + 1, c, a + 1, c + 1, c});
        }
    }
    return azulejo::Mesh(positions, indices);
}

class Picture {
public:
    explicit Picture(int width)
        : width_(width), height_(width * 9 / 16), depth_(pixels(), std::numeric_limits<float>::infinity()),
          colour_(pixels(), Vec{0.74f, 0.83f, 0.92f}) {}

    // Where a point of the land is seen, and how far away; the camera looks along y, a little down.
    Vec seen(const Vec &point) const {
        const float eye = height(0, 0) + eye_height, tilt = 0.13f;
        const float up = point[2] - eye, along = point[1] + 12, focus = 0.9f * static_cast<float>(width_);
        const float depth = along * std::cos(tilt) - up * std::sin(tilt);
        const float above = along * std::sin(tilt) + up * std::cos(tilt);
        return {0.5f * static_cast<float>(width_) + focus * point[0] / depth,
                0.45f * static_cast<float>(height_) - focus * above / depth, depth};
    }

    // A triangle of one colour, which fades into the haze.
    void draw(const Vec &a, const Vec &b, const Vec &c, const Vec &colour) {
        if (std::min({a[2], b[2], c[2]}) < 1) return;
        const auto edge = [](const Vec &p, const Vec &q, float x, float y) {
            return (q[0] - p[0]) * (y - p[1]) - (q[1] - p[1]) * (x - p[0]);
        };
        const float area = edge(a, b, c[0], c[1]);
        if (area == 0) return;
        const auto pixel = [](float x, int end) { return std::clamp(static_cast<int>(std::floor(x)), 0, end - 1); };
        const int left = pixel(std::min({a[0], b[0], c[0]}), width_), right = pixel(std::max({a[0], b[0], c[0]}), width_);
        const int top = pixel(std::min({a[1], b[1], c[1]}), height_), bottom = pixel(std::max({a[1], b[1], c[1]}), height_);
        for (int y = top; y <= bottom; y++) {
            for (int x = left; x <= right; x++) {
                const float px = static_cast<float>(x) + 0.5f, py = static_cast<float>(y) + 0.5f;
                const float u = edge(b, c, px, py) / area, v = edge(c, a, px, py) / area, w = edge(a, b, px, py) / area;
                const float depth = u * a[2] + v * b[2] + w * c[2];
                const auto at = static_cast<std::size_t>(y * width_ + x);
                if (u < 0 || v < 0 || w < 0 || depth >= depth_[at]) continue;
                depth_[at] = depth;
                const float haze = 1 - std::exp(-depth / 450);
                for (std::size_t i = 0; i < 3; i++) colour_[at][i] = (1 - haze) * colour[i] + haze * Vec{0.74f, 0.83f, 0.92f}[i];
            }
        }
    }

    void write(const std::string &path) const {
        std::string bytes = "P6 " + std::to_string(width_) + " " + std::to_string(height_) + " 255\n";
        for (const Vec &colour : colour_) {
            for (float x : colour) bytes += static_cast<char>(std::lround(255 * std::clamp(x, 0.0f, 1.0f)));
        }
        std::ofstream file(path, std::ios::binary);
        if (!(file << bytes && file.flush())) throw std::runtime_error("cannot write " + path);
    }

private:
    std::size_t pixels() const { return static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_); }

    int width_, height_;
    std::vector<float> depth_;
    std::vector<Vec> colour_;
};

void draw_land(Picture &picture) {
    for (std::uint32_t row = 0; row < cells; row++) {
        for (std::uint32_t column = 0; column < cells; column++) {
            const Vec a = place(column, row), b = place(column + 1, row), c = place(column, row + 1);
            const float light = 0.8f - 0.5f * (b[2] - a[2]) + 0.2f * (c[2] - a[2]);
            const Vec colour{0.46f * light, 0.5f * light, 0.3f * light}, d = place(column + 1, row + 1);
            picture.draw(picture.seen(a), picture.seen(b), picture.seen(c), colour);
            picture.draw(picture.seen(b), picture.seen(d), picture.seen(c), colour);
        }
    }
}

// A light half and a dark one; `size` is 0 to 1.
void draw_tree(Picture &picture, const Vec &foot, float size, std::size_t number) {
    const float tall = tree_height * size * (0.8f + 0.4f * static_cast<float>(number * 2654435761u % 97) / 97);
    const Vec top{foot[0], foot[1], foot[2] + tall};
    const float wide = 0.22f * tall, shade = 0.75f + 0.25f * static_cast<float>(number * 40503u % 31) / 31;
    const Vec left{foot[0] - wide, foot[1], foot[2]}, right{foot[0] + wide, foot[1], foot[2]};
    const Vec &middle = foot;
    picture.draw(picture.seen(left), picture.seen(middle), picture.seen(top), {0.2f * shade, 0.42f * shade, 0.16f * shade});
    picture.draw(picture.seen(middle), picture.seen(right), picture.seen(top), {0.1f * shade, 0.27f * shade, 0.12f * shade});
}

} // namespace

int main(int argc, char **argv) {
    char *end = nullptr;
    const double trees = argc > 2 ? std::strtod(argv[2], &end) : 60000;
    const long width = argc > 3 && !(end && *end) ? std::strtol(argv[3], &end, 10) : 1280;
    if (argc < 2 || argc > 4 || (end && *end) || !(trees >= 1 && trees <= 1e7) || width < 16 || width > 10000) {
        std::cerr << "usage: lod OUT.ppm [TREES [WIDTH]]\n";
        return 2;
    }
    try {
        const azulejo::Context context;
        const azulejo::Mesh mesh = land();
        azulejo::PspOptions options;
        options.count = static_cast<std::size_t>(trees);
        options.order = AZULEJO_ORDER_PROGRESSIVE;
        const auto points = azulejo::psp_sample(context, mesh, options);

        Picture picture(static_cast<int>(width));
        draw_land(picture);
        const auto positions = points.positions();
        const auto ranks = points.ranks();
        std::size_t drawn = 0;
        for (std::size_t i = 0; i < points.size(); i++) {
            const Vec foot{positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]};
            const float size = std::clamp(ranks[i] / (finest * picture.seen(foot)[2]) - 1, 0.0f, 1.0f);
            if (size == 0) continue;
            draw_tree(picture, foot, size, i);
            drawn++;
        }
        picture.write(argv[1]);
        std::printf("%zu of %zu trees\n", drawn, points.size());
        return EXIT_SUCCESS;
    } catch (const std::exception &error) {
        std::cerr << "lod: " << error.what() << '\n';
        return EXIT_FAILURE;
    }
}
