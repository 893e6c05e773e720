// azulejo.hpp without exceptions: owners, options, reports and the calls that return statuses. The macro stands for
// -fno-exceptions, with which the header compiles, too.

#define AZULEJO_NO_EXCEPTIONS

#include <array>
#include <cstring>
#include <vector>

#include "samples.h"

#include <azulejo.hpp>

namespace {

/// True for a call that was refused with this in its message.
bool refused(const char *part, const azulejo::Status &status) {
    return status.code() == AZULEJO_ERROR_INVALID_ARGUMENT && status.message().find(part) != std::string::npos;
}

void planes(const azulejo::Context &context) {
    azulejo::KdrtOptions options;
    azulejo::Points points, window, merged, relaxed;
    CHECK(refused("radius", azulejo::try_kdrt_sample(context, options, points)) && !points);
    options.radius = 0.05;
    azulejo::KdrtReport report;
    CHECK(azulejo::try_kdrt_sample(context, options, points, &report).ok() && report.samples == points.size());
    CHECK(azulejo::try_kdrt_sample_window(context, options, {0, 0}, {0.5, 1}, window).ok() && window.size() > 50);
    azulejo::Kdrt plane;
    azulejo::Points kept;
    CHECK(refused("plane", plane.try_window({0, 0}, {0.5, 1}, kept)) && !kept);
    CHECK(azulejo::Kdrt::try_create(context, options, plane).ok());
    CHECK(plane.try_window({0, 0}, {0.5, 1}, kept).ok() && same_points(kept.get(), window.get()));
    std::size_t streamed = 0;
    const auto count = [&](azulejo::Positions xy) { return streamed += xy.size() / xy.dimension(), true; };
    CHECK(azulejo::try_kdrt_stream(context, options, count).ok() && streamed == points.size());

    azulejo::KdrtMergeOptions merging;
    merging.radius = 0.05;
    const azulejo::KdrtMergePiece piece[] = {{points, {0, 0}, {1, 1}}};
    azulejo::KdrtMergeReport merged_report;
    CHECK(azulejo::try_kdrt_merge(context, merging, piece, {}, merged, &merged_report).ok());
    CHECK(merged_report.kept + merged_report.inserted == merged.size());

    azulejo::MaximalOptions slow;
    slow.radius = 0.05;
    azulejo::DcrReport relaxation;
    CHECK(azulejo::try_maximal_sample(context, slow, window).ok() && window.size() > 200);
    CHECK(azulejo::try_dcr_relax(context, {}, points, relaxed, &relaxation).ok() && relaxation.rho > 0.8);
    const azulejo::Density density{{}, 0, [](const std::array<double, 2> &p) { return p[0]; }};
    CHECK(azulejo::try_dcr_scatter(context, {}, density, 99, window).ok() && window.size() == 99);
    CHECK(azulejo::try_dcr_relax_density(context, {}, density, window, relaxed).ok() && relaxed.size() == 99);
    const azulejo::Density odd{azulejo::Span(points.positions().data(), 7), 2, {}};
    CHECK(refused("values: 7", azulejo::try_dcr_scatter(context, {}, odd, 99, window)) && window.size() == 99);
}

void analysis(const azulejo::Context &context) {
    azulejo::MaximalOptions options;
    options.radius = 0.05;
    azulejo::Points points;
    CHECK(azulejo::try_maximal_sample(context, options, points).ok());
    const azulejo::PlaneSet set{points, options};
    double distance = 0, radius = 0;
    azulejo::PlaneReport report;
    azulejo::CoverageReport coverage;
    std::vector<std::uint64_t> histogram;
    std::vector<double> density;
    CHECK(azulejo::try_plane_smallest_distance(context, set, distance).ok() && distance >= 0.05);
    CHECK(azulejo::try_plane_covering_radius(context, set, radius).ok() && radius <= 0.05 + 1e-6);
    CHECK(azulejo::try_plane_measure(context, set, report).ok() && report.smallest_distance == distance);
    CHECK(azulejo::try_plane_coverage(context, set, 0.05 + 1e-6, coverage).ok() && coverage.gaps == 0);
    CHECK(azulejo::try_plane_nearest_histogram(context, set, 2, 9, histogram).ok() && histogram.size() == 9);
    CHECK(azulejo::try_plane_radial_distribution(context, set, 4, 9, density).ok() && density.size() == 9);

    azulejo::Spectrum spectrum, mean;
    azulejo::SpectrumReport figures;
    std::vector<azulejo::Annulus> annuli;
    CHECK(azulejo::Spectrum::try_create(context, set, 64, 1, spectrum).ok() && spectrum.size() == 64);
    const std::vector<azulejo::Spectrum> none;
    CHECK(refused("periodograms", azulejo::Spectrum::try_mean(none, mean)) && !mean);
    CHECK(spectrum.try_radial(0.1, annuli).ok() && annuli.size() > 5);
    CHECK(spectrum.try_measure(0.1, 0, 1, figures).ok() && figures.frequency_step[0] > 0);
}

void surfaces(const azulejo::Context &context) {
    azulejo::Mesh cube, part;
    CHECK(refused("positions: 2", azulejo::Mesh::try_create(std::vector<float>(2), {}, cube)) && !cube);
    CHECK(azulejo::Mesh::try_create(cube_positions, cube_indices, cube).ok() && cube.vertex_count() == 8);
    CHECK(azulejo::Mesh::try_load("missing.ply", part).code() == AZULEJO_ERROR_IO);
    CHECK(refused("scene", azulejo::Mesh::try_from_embree(nullptr, {}, part)) && !part);
    CHECK(cube.try_with_normals(cube_positions, {}, part).ok() && part.has_normals());
    const std::vector<std::uint8_t> mask(12, 1);
    CHECK(part.try_with_mask(mask, part).ok() && part.has_normals() && part.area() == cube.area());

    azulejo::PspOptions options;
    options.radius = 0.1;
    azulejo::PspReport report;
    azulejo::Points points, adapted, relaxed;
    CHECK(azulejo::try_psp_sample(context, cube, options, points, &report).ok() && report.samples == points.size());
    azulejo::Psp psp;
    CHECK(azulejo::Psp::try_create(context, cube, options, psp).ok() && psp.try_advance(1, &report).ok());
    CHECK(psp.try_fill().ok() && psp.try_points(adapted).ok() && adapted.size() > report.samples);

    azulejo::PspAdaptiveOptions adaptive;
    adaptive.smallest = adaptive.largest = 0.1;
    adaptive.set_radius([](const std::array<double, 3> &) { return 0.1; });
    CHECK(azulejo::try_psp_adaptive_sample(context, cube, adaptive, adapted).ok() && !adapted.radii().empty());
    azulejo::DcrSurfaceReport relaxation;
    CHECK(azulejo::try_dcr_surface_relax(context, cube, {}, points, relaxed, &relaxation).ok());
    CHECK(relaxed.size() == points.size() && relaxation.smallest_distance >= 0.1);
    azulejo::DcrRemeshReport remeshing;
    azulejo::Mesh made;
    CHECK(azulejo::try_dcr_remesh(context, cube, relaxed, made, &remeshing).ok());
    CHECK(made.positions().size() == relaxed.positions().size() && made.indices().size() == 3 * remeshing.triangles);

    double distance = 0, uncovered = 1;
    azulejo::CoverageReport coverage;
    azulejo::Differences differences;
    std::vector<double> power;
    CHECK(azulejo::try_space_smallest_distance(context, points, distance).ok() && distance >= 0.1);
    CHECK(azulejo::try_mesh_uncovered_fraction(context, cube, points, 0.1, 999, 0, uncovered).ok() && uncovered == 0);
    CHECK(azulejo::try_mesh_coverage(context, cube, points, 0.1 + 1e-6, coverage).ok() && coverage.gaps == 0);
    CHECK(azulejo::Differences::try_create(context, cube, points, points.normals(), {0, 0, 1}, 0, differences).ok());
    CHECK(differences.try_power(std::array<double, 2>{0.3, 1}, power).ok() && power.size() == 2);
}

void callbacks(const azulejo::Context &context) {
    azulejo::KdrtOptions options;
    options.radius = 0.02;
    azulejo::Points points;
    options.set_progress([](double done) { return done < 0.5; });
    CHECK(azulejo::try_kdrt_sample(context, options, points).code() == AZULEJO_ERROR_CANCELLED && !points);
    options.set_progress(nullptr);
    double last = 0;
    azulejo::Context watched;
    CHECK(context.try_watch([&](double done) { return last = done, true; }, watched).ok());
    CHECK(azulejo::try_kdrt_sample(watched, options, points).ok() && last == 1);
}

} // namespace

int main() {
    azulejo::Context context;
    azulejo::Points points;
    CHECK(!context && refused("context", azulejo::try_kdrt_sample(context, {}, points)));
    CHECK(azulejo::Context::try_create(2, context).ok() && context.num_threads() == 2);
    planes(context);
    analysis(context);
    surfaces(context);
    callbacks(context);
    return finish();
}
