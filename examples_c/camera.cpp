// A camera flies over a plane of 10^10 samples and takes in each frame what it sees of it.
//
//   camera [--check] [FRAMES]
//
// The samples of such a plane would fill 80 GB. What is kept of it is its pattern, and each frame makes the samples of a
// window: a few hundred where the camera is low, some ten thousand where it is high. Prints how long frames took, on one
// thread. With --check one of the windows is also made without the kept plane, and must be the same to the bit.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <iostream>
#include <string>
#include <vector>

#include <azulejo.hpp>

namespace {

constexpr double samples = 1e10;
constexpr double density = 0.69656; // samples of a maximal set on an area of radius^2
constexpr double lowest = 300, highest = 30'000; // samples in view
constexpr double aspect = 16.0 / 9;

struct Window {
    azulejo::Pair min, max;
};

// What the camera sees at a time from 0 to 1: it goes round over the unit square and up and down meanwhile.
Window view(double time) {
    const double turn = 2 * 3.141592653589793 * time;
    const double in_view = lowest * std::pow(highest / lowest, 0.5 - 0.5 * std::cos(5 * turn));
    const double width = std::sqrt(aspect * in_view / samples), height = width / aspect;
    const double x = 0.5 + 0.45 * std::cos(3 * turn), y = 0.5 + 0.45 * std::sin(2 * turn);
    return {{x - width / 2, y - height / 2}, {x + width / 2, y + height / 2}};
}

double milliseconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

struct Frame {
    std::size_t count;
    double milliseconds;
};

// The frames with up to so many samples, and from the previous limit on, in a line.
void print(std::vector<Frame> frames, std::size_t from, std::size_t limit) {
    const auto is_other = [&](const Frame &frame) { return frame.count < from || frame.count >= limit; };
    frames.erase(std::remove_if(frames.begin(), frames.end(), is_other), frames.end());
    if (frames.empty()) return;
    std::sort(frames.begin(), frames.end(),
              [](const Frame &a, const Frame &b) { return a.milliseconds < b.milliseconds; });
    std::printf("%8zu %8zu %8zu", from, limit, frames.size());
    for (const double share : {0.5, 0.9, 0.99, 1.0}) {
        const auto place = static_cast<std::size_t>(share * static_cast<double>(frames.size() - 1));
        std::printf(" %8.3f", frames[place].milliseconds);
    }
    std::printf("\n");
}

bool same(const azulejo::Points &a, const azulejo::Points &b) {
    const auto p = a.positions(), q = b.positions();
    return p.size() == q.size() && std::memcmp(p.data(), q.data(), p.size() * sizeof(float)) == 0;
}

int fly(int count, bool checking) {
    const azulejo::Context context(1);
    azulejo::KdrtOptions options;
    options.radius = std::sqrt(density / samples);
    options.seed = 10;
    const auto start = std::chrono::steady_clock::now();
    const azulejo::Kdrt plane(context, options);
    std::printf("%.0f samples, kept after %.1f ms\n", samples, milliseconds_since(start));

    std::vector<Frame> frames;
    for (int i = 0; i < count; i++) {
        const Window window = view(static_cast<double>(i) / count);
        const auto begin = std::chrono::steady_clock::now();
        const azulejo::Points seen = plane.window(window.min, window.max);
        frames.push_back({seen.size(), milliseconds_since(begin)});
        if (checking && i == count / 3 && !same(seen, kdrt_sample_window(context, options, window.min, window.max))) {
            std::cerr << "camera: frame " << i << " is not the window of the plane\n";
            return EXIT_FAILURE;
        }
    }
    std::printf("%8s %8s %8s %8s %8s %8s %8s\n", "samples", "to", "frames", "50 % ms", "90 %", "99 %", "longest");
    for (const std::size_t from : {100, 1'000, 10'000}) print(frames, from, 10 * from);
    return EXIT_SUCCESS;
}

} // namespace

int main(int argc, char **argv) {
    const bool checking = argc > 1 && std::strcmp(argv[1], "--check") == 0;
    const int frames = argc > 1 + checking ? std::atoi(argv[1 + checking]) : 2'000;
    if (frames < 1) {
        std::cerr << "usage: camera [--check] [FRAMES]\n";
        return EXIT_FAILURE;
    }
    try {
        return fly(frames, checking);
    } catch (const std::exception &error) {
        std::cerr << "camera: " << error.what() << '\n';
        return EXIT_FAILURE;
    }
}
