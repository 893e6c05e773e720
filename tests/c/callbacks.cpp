// azulejo.hpp: callbacks, how long they live, and what they throw. The options of C++ keep their functions when they
// are handed to C; a watched context reports the calls whose options have no function.

#include <array>
#include <cstring>
#include <memory>
#include <optional>
#include <stdexcept>
#include <thread>
#include <vector>

#include "check.h"
#include "throws.hpp"

namespace {

const std::array<std::array<float, 3>, 4> positions = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
const std::array<std::array<std::uint32_t, 3>, 4> indices = {{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};

/// True for a call that throws this.
template <class Thrown, class Call>
bool leaves(const Thrown &expected, Call call) {
    try {
        call();
        return false;
    } catch (const Thrown &thrown) {
        return thrown == expected;
    }
}

void progress() {
    const azulejo::Context context(2);
    azulejo::KdrtOptions options;
    options.radius = 0.02;
    double last = -1;
    options.set_progress([&](double done) {
        CHECK(done >= last);
        last = done;
        return true;
    });
    CHECK(azulejo::kdrt_sample(context, options).size() > 1000);
    CHECK(last == 1);

    options.set_progress([](double done) { return done < 0.5; });
    CHECK(throws(AZULEJO_ERROR_CANCELLED, "cancelled", [&] { azulejo::kdrt_sample(context, options); }));

    for (double limit : {0.0, 0.5, 1.0}) {
        int calls_after = -1;
        options.set_progress([&](double done) {
            if (calls_after >= 0 || done >= limit) calls_after++;
            if (done >= limit) throw limit;
            return true;
        });
        CHECK(leaves(limit, [&] { azulejo::kdrt_sample(context, options); }) && calls_after == 0);
        calls_after = -1;
        azulejo::Points points;
        CHECK(leaves(limit, [&] { (void)azulejo::try_kdrt_sample(context, options, points); }) && !points);
    }
    options.set_progress(nullptr);
    CHECK(options.progress == nullptr && azulejo::kdrt_sample(context, options).size() > 1000);
}

// A handle keeps its progress function through moves and through exceptions, and longer than the options.
void progress_of_a_handle() {
    const azulejo::Context context(1);
    const azulejo::Mesh mesh(positions, indices);
    bool throwing = true;
    int calls = 0;
    std::optional<azulejo::PspOptions> options(std::in_place);
    options->radius = 0.1;
    options->set_progress([&](double) {
        calls++;
        if (throwing) throw std::logic_error("no");
        return true;
    });
    azulejo::Psp psp(context, mesh, *options);
    options.reset();
    azulejo::Psp moved = std::move(psp);
    try {
        moved.advance(1);
        CHECK(!"reached");
    } catch (const std::logic_error &error) {
        CHECK(std::strcmp(error.what(), "no") == 0);
    }
    throwing = false;
    CHECK(moved.fill().samples > 0);
    CHECK(calls > 2);
}

// The options are the C struct: a C call has their progress, their radii and their domain.
void options_in_c() {
    const azulejo::Context context(2);
    azulejo_points *points = nullptr;
    azulejo::KdrtOptions options;
    options.radius = 0.02;
    double last = -1;
    options.set_progress([&](double done) {
        last = done;
        return done < 0.5;
    });
    const azulejo::KdrtOptions copy = options;
    options.set_progress(nullptr);
    CHECK(azulejo_kdrt_sample(context.get(), &copy, &points, nullptr) == AZULEJO_ERROR_CANCELLED && last >= 0.5);

    // A C callback that was set by hand works in a C++ call.
    int told = 0;
    options.progress_user = &told;
    options.progress = [](void *user, double) -> std::uint32_t { return ++*static_cast<int *>(user), 0; };
    CHECK(azulejo::kdrt_sample(context, options).size() > 1000 && told > 1);

    // An exception cannot pass C: it ends the call, and is not found by the next one.
    options.set_progress([](double) -> bool { throw 7; });
    CHECK(azulejo_kdrt_sample(context.get(), &options, &points, nullptr) == AZULEJO_ERROR_CANCELLED);
    options.set_progress(nullptr);
    CHECK(azulejo::kdrt_sample(context, options).size() > 1000);

    const azulejo::Mesh mesh(positions, indices);
    azulejo::PspAdaptiveOptions adaptive;
    adaptive.smallest = adaptive.largest = 0.1;
    adaptive.set_radius([](const std::array<double, 3> &) { return 0.1; });
    CHECK(azulejo_psp_adaptive_sample(context.get(), mesh.get(), &adaptive, &points, nullptr) == AZULEJO_OK);
    CHECK(azulejo::Points(points).size() > 100);
    adaptive.set_radius([](const std::array<double, 3> &) -> double { throw 7; });
    CHECK(azulejo_psp_adaptive_sample(context.get(), mesh.get(), &adaptive, &points, nullptr) != AZULEJO_OK);
    adaptive.radius_function = [](void *user, const double *) { return *static_cast<double *>(user); };
    double radius = 0.1;
    adaptive.radius_function_user = &radius;
    CHECK(azulejo::psp_adaptive_sample(context, mesh, adaptive).size() > 100);
}

// A watched context reports calls without options, and those whose options have no function.
void watching() {
    azulejo::Context watched(nullptr);
    std::vector<double> told;
    {
        const azulejo::Context context(2);
        watched = context.watch([&](double done) { return told.push_back(done), true; });
    }
    azulejo::KdrtOptions options;
    options.radius = 0.02;
    const auto points = azulejo::kdrt_sample(watched, options);
    CHECK(watched.num_threads() == 2 && told.front() == 0 && told.back() == 1);
    told.clear();
    azulejo::plane_measure(watched, {points, options});
    CHECK(told.front() == 0 && told.back() == 1);
    told.clear();
    options.set_progress([](double) { return true; });
    azulejo::kdrt_sample(watched, options);
    CHECK(told.empty());
    CHECK(azulejo::plane_measure(watched.watch(nullptr), {points, options}).count == points.size() && told.empty());
    CHECK(refused("context", [] { azulejo::Context(nullptr).watch(nullptr); }));

    const auto stopped = watched.watch([](double done) { return done < 0.5; });
    CHECK(throws(AZULEJO_ERROR_CANCELLED, "cancelled", [&] { azulejo::plane_measure(stopped, {points, options}); }));
    const auto throwing = watched.watch([](double) -> bool { throw 7; });
    CHECK(leaves(7, [&] { azulejo::plane_measure(throwing, {points, options}); }) && told.empty());

    // A handle that is given up calls the function, which is the object's.
    azulejo_context *released = watched.release();
    double distance = 0;
    CHECK(azulejo_space_smallest_distance(released, &positions[0][0], 4, &distance) == AZULEJO_OK && distance == 1);
    CHECK(told.back() == 1);
    azulejo_context_free(released);
}

// A psp handle keeps the function of a context that is gone.
void watching_a_handle() {
    int calls = 0;
    bool throwing = false;
    azulejo::PspOptions options;
    options.radius = 0.1;
    const azulejo::Mesh mesh(positions, indices);
    azulejo::Psp psp(azulejo::Context(1).watch([&](double) {
        calls++;
        if (throwing) throw 7;
        return true;
    }), mesh, options);
    psp.advance(1);
    CHECK(calls > 1);
    throwing = true;
    CHECK(leaves(7, [&] { psp.fill(); }));
    throwing = false;
    CHECK(psp.fill().samples > 100);
}

// What a callback throws belongs to the call that it stopped: calls within callbacks and on other threads have their
// own.
void apart() {
    const azulejo::Context context(2);
    azulejo::KdrtOptions inner, outer;
    inner.radius = outer.radius = 0.05;
    inner.set_progress([](double) -> bool { throw 1; });
    bool inside = false;
    outer.set_progress([&](double done) {
        inside = leaves(1, [&] { azulejo::kdrt_sample(context, inner); });
        if (done > 0.5) throw 2;
        return true;
    });
    CHECK(leaves(2, [&] { azulejo::kdrt_sample(context, outer); }) && inside);

    const auto watched = context.watch([main = std::this_thread::get_id()](double) {
        if (std::this_thread::get_id() == main) throw 3;
        return true;
    });
    inner.set_progress(nullptr);
    bool other = false;
    std::thread thread([&] {
        for (int i = 0; i < 20; i++) other = azulejo::kdrt_sample(watched, inner).size() > 100;
    });
    bool here = true;
    for (int i = 0; i < 20; i++) here = here && leaves(3, [&] { azulejo::kdrt_sample(watched, inner); });
    thread.join();
    CHECK(here && other);

    // One object of options, whose radius throws on one context only.
    const azulejo::Mesh mesh(positions, indices);
    azulejo::PspAdaptiveOptions options;
    options.smallest = options.largest = 0.1;
    const auto radius = std::make_shared<double>(0.1);
    options.set_radius([radius](const std::array<double, 3> &) { return *radius > 0 ? *radius : throw 4; });
    const azulejo::PspAdaptiveOptions copy = options;
    CHECK(azulejo::psp_adaptive_sample(context, mesh, copy).size() > 100);
    *radius = -1;
    CHECK(leaves(4, [&] { azulejo::psp_adaptive_sample(context, mesh, options); }));
    *radius = 0.1;
    CHECK(azulejo::psp_adaptive_sample(context, mesh, options).size() > 100);
}

} // namespace

int main() {
    progress();
    progress_of_a_handle();
    options_in_c();
    watching();
    watching_a_handle();
    apart();
    return finish();
}
