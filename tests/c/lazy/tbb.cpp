/* A program with TBB of its own: its bounds of threads stay what they are while the library iterates and keeps scenes. */
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <chrono>
#include <mutex>
#include <set>
#include <thread>

#include "../samples.h"

static size_t bound() { return tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism); }

/* How many threads TBB works with, where there is enough to do for all. */
static size_t workers() {
    std::mutex mutex;
    std::set<std::thread::id> seen;
    tbb::parallel_for(0, 2000, [&](int) {
        std::this_thread::sleep_for(std::chrono::microseconds(100));
        const std::lock_guard<std::mutex> lock(mutex);
        seen.insert(std::this_thread::get_id());
    });
    return seen.size();
}

/* One iteration: the mesh then keeps a scene. */
static void iterate(azulejo_mesh *mesh, uint32_t threads) {
    azulejo_context *context = make_context(threads);
    azulejo_psp_options options = psp_options(0.1);
    azulejo_points *points = nullptr;
    options.iterations = 1;
    if (ACCEPTED(azulejo_psp_sample(context, mesh, &options, &points, nullptr))) azulejo_points_free(points);
    azulejo_context_free(context);
}

int main() {
    const size_t before = bound(), parallel = workers();
    CHECK(before > 1 ? parallel > 1 : parallel == 1);
    azulejo_mesh *mesh = make_cube();
    iterate(mesh, 1);
    CHECK(bound() == before);
    CHECK(before > 1 ? workers() > 1 : workers() == 1);
    azulejo_mesh *other = make_cube();
    iterate(other, 3);
    CHECK(bound() == before);
    azulejo_mesh_free(other);
    CHECK(bound() == before);
    azulejo_mesh_free(mesh);
    CHECK(bound() == before);

    /* A bound of the program's is neither raised nor lifted. */
    mesh = make_cube();
    {
        const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
        CHECK(bound() == 1);
        iterate(mesh, 4);
        CHECK(bound() == 1 && workers() == 1);
    }
    CHECK(bound() == before);
    azulejo_mesh_free(mesh);
    return finish();
}
