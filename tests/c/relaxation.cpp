// azulejo.hpp: relaxation, also on a mesh and to a density, and what a density throws.

#include <array>
#include <cmath>
#include <vector>

#include "check.h"
#include "throws.hpp"

namespace {

struct Mishap {};

template <class Call>
bool leaves_the_mishap(Call call) {
    try {
        call();
        return false;
    } catch (const Mishap &) {
        return true;
    }
}

void relaxing() {
    const azulejo::Context context(1);
    azulejo::DcrOptions options;
    azulejo::DcrReport report;
    options.max_iterations = 30;
    std::vector<float> xy;
    for (int i = 0; i < 64; i++) {
        xy.push_back(static_cast<float>(i % 8) / 8 + 0.01f * static_cast<float>(i % 3));
        xy.push_back(static_cast<float>(i / 8) / 8 + 0.01f * static_cast<float>(i % 5));
    }
    const auto points = azulejo::dcr_relax(context, options, xy, &report);
    CHECK(points.size() == 64 && report.iterations <= 30 && report.rho > 0);
    const double smallest = azulejo::plane_smallest_distance(context, {points, options});
    CHECK(std::abs(smallest - report.smallest_distance) < 1e-12);

    options.set_progress([](double done) { return done < 0.5; });
    const auto half = azulejo::dcr_relax(context, options, xy, &report);
    CHECK(half.size() == 64 && report.stopped == AZULEJO_STOPPED_CANCELLED && report.iterations < 30);
    options.set_progress([](double) -> bool { throw 7; });
    int thrown = 0;
    try {
        azulejo::dcr_relax(context, options, xy);
    } catch (int number) {
        thrown = number;
    }
    CHECK(thrown == 7);
}

void relaxing_classes() {
    const azulejo::Context context(1);
    azulejo::Classes classes;
    CHECK(azulejo::try_classes_radii(std::vector<double>{0.1, 0.05}, 1, classes).ok());
    azulejo::KdrtOptions options;
    const auto set = azulejo::kdrt_sample_classes(context, options, classes);
    azulejo::DcrOptions relax;
    azulejo::DcrReport report;
    std::vector<std::array<double, 2>> figures;
    const auto points = azulejo::dcr_relax_classes(context, relax, set, set.classes(), 2, &report, &figures);
    CHECK(points.size() == set.size() && report.rho > 0.6 && figures.size() == 2);
    for (const auto &figure : figures) CHECK(figure[0] > 0.5 && figure[1] < 0.9);
    azulejo::Points none;
    CHECK(azulejo::try_dcr_relax_classes(context, relax, set, {}, 2, none).code() == AZULEJO_ERROR_INVALID_ARGUMENT);
    CHECK(azulejo::try_dcr_relax_classes(context, relax, set, set.classes(), 17, none).code() ==
          AZULEJO_ERROR_INVALID_ARGUMENT);
    CHECK(none.size() == 0);
}

void relaxing_on_a_mesh() {
    const float corners[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
    const std::uint32_t triangles[] = {0, 1, 2, 0, 2, 3};
    const azulejo::Context context(1);
    const azulejo::Mesh mesh(corners, triangles);
    azulejo::PspOptions options;
    options.radius = 0.05;
    const auto darts = azulejo::psp_sample(context, mesh, options);
    azulejo::DcrSurfaceReport report;
    const auto points = azulejo::dcr_surface_relax(context, mesh, azulejo::DcrSurfaceOptions(), darts.triangles(),
                                                   darts.barycentrics(), &report);
    const auto same = azulejo::dcr_surface_relax(context, mesh, azulejo::DcrSurfaceOptions(), darts);
    CHECK(points.size() == darts.size() && report.smallest_distance > 0.05);
    CHECK(same.size() == points.size() && same.positions()[7] == points.positions()[7]);
    int status = AZULEJO_OK;
    try {
        azulejo::dcr_surface_relax(context, mesh, azulejo::DcrSurfaceOptions(), {}, darts.barycentrics());
    } catch (const azulejo::Error &error) {
        status = error.status();
    }
    CHECK(status == AZULEJO_ERROR_INVALID_ARGUMENT);

    azulejo::DcrRemeshReport remeshing;
    const auto made = azulejo::dcr_remesh(context, mesh, points, &remeshing);
    const auto again = azulejo::dcr_remesh(context, mesh, points.triangles(), points.barycentrics());
    CHECK(made.positions().size() == 3 * points.size() && made.indices().size() == 3 * remeshing.triangles);
    CHECK(again.indices().size() == made.indices().size() && remeshing.euler == 1);
    CHECK(remeshing.non_manifold_vertices == 0 && remeshing.boundary_edges > 0 && remeshing.smallest_angle > 10);
    azulejo::Mesh none;
    CHECK(azulejo::try_dcr_remesh(context, mesh, {}, points.barycentrics(), none).code() ==
          AZULEJO_ERROR_INVALID_ARGUMENT);
}

void relaxing_to_a_density() {
    const azulejo::Context context(3);
    azulejo::DcrOptions options;
    options.boundary = AZULEJO_BOUNDARY_BOUNDED;
    azulejo::Density density;
    CHECK(refused("function", [&] { azulejo::dcr_scatter(context, options, density, 9); }));
    const std::vector<float> image = {0, 1, 1, 0, 1, 1};
    density.values = image;
    CHECK(refused("values", [&] { azulejo::dcr_scatter(context, options, density, 9); }));
    density.width = 3;
    const auto start = azulejo::dcr_scatter(context, options, density, 500);
    azulejo::DcrReport report;
    const auto points = azulejo::dcr_relax_density(context, options, density, start, &report);
    CHECK(start.size() == 500 && points.size() == 500 && report.rho > 0.6);
    for (std::size_t i = 0; i < points.size(); i++) CHECK(points.positions()[2 * i] > 0.1f);

    density.values = {};
    density.function = [](const std::array<double, 2> &position) { return position[1]; };
    CHECK(refused("width", [&] { azulejo::dcr_scatter(context, options, density, 9); }));
    density.width = 0;
    const auto raised = azulejo::dcr_relax_density(context, options, density, start, &report);
    CHECK(raised.size() == 500 && report.iterations > 0);
    density.function = [](const std::array<double, 2> &position) -> double {
        if (position[0] > 0.5) throw Mishap();
        return 1;
    };
    for (std::uint32_t threads : {1, 3}) {
        const azulejo::Context some(threads);
        CHECK(leaves_the_mishap([&] { azulejo::dcr_relax_density(some, options, density, start); }));
        CHECK(leaves_the_mishap([&] { azulejo::dcr_scatter(some, options, density, 9); }));
    }
}

} // namespace

int main() {
    relaxing();
    relaxing_classes();
    relaxing_on_a_mesh();
    relaxing_to_a_density();
    return finish();
}
