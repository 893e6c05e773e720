// Exceptions that leave a C callback end the process, at once and by a signal: nothing goes on with half of a call.

#include <cstdio>
#include <stdexcept>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "samples.h"

namespace {

azulejo_mesh *cube;

uint32_t throws(void *, double done) {
    if (done >= 0.3) throw std::runtime_error("from a progress callback");
    return 0;
}

double throws_radius(void *, const double *) { throw std::runtime_error("from a radius"); }

uint32_t throws_visit(void *, const float *, size_t) { throw std::runtime_error("from a visitor"); }

void progress(const azulejo_context *context) {
    auto options = kdrt_options(0.02);
    azulejo_points *points = nullptr;
    options.progress = throws;
    azulejo_kdrt_sample(context, &options, &points, nullptr);
}

void radius(const azulejo_context *context) {
    azulejo_psp_adaptive_options options;
    azulejo_points *points = nullptr;
    azulejo_psp_adaptive_options_init(&options, sizeof options);
    options.radius_function = throws_radius;
    options.smallest = 0.1;
    options.largest = 0.2;
    azulejo_psp_adaptive_sample(context, cube, &options, &points, nullptr);
}

void visit(const azulejo_context *context) {
    const auto options = kdrt_options(0.02);
    azulejo_kdrt_stream(context, &options, throws_visit, nullptr, NULL);
}

// The signal that ends a process which makes this call, or 0 if it goes on.
int ended_by(void (*call)(const azulejo_context *), uint32_t threads) {
    std::fflush(nullptr);
    const pid_t child = fork();
    if (child == 0) {
        const rlimit none = {0, 0};
        setrlimit(RLIMIT_CORE, &none);
        alarm(60);
        azulejo_context *context = nullptr;
        if (azulejo_context_create(threads, &context) != AZULEJO_OK) _exit(2);
        // Whoever catches here has an exception that went through the library.
        try {
            call(context);
        } catch (...) {
        }
        _exit(3);
    }
    int status = 0;
    return waitpid(child, &status, 0) == child && WIFSIGNALED(status) ? WTERMSIG(status) : 0;
}

} // namespace

int main() {
    cube = make_cube();
    for (const uint32_t threads : {1, 2}) {
        for (const auto call : {progress, radius, visit}) CHECK(ended_by(call, threads) == SIGABRT);
    }
    azulejo_mesh_free(cube);
    return finish();
}
