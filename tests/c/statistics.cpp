// azulejo.hpp: the analysis of sets, of the plane and of a mesh.

#include <array>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "samples.h"
#include "throws.hpp"

namespace {

azulejo::Points blue_noise(const azulejo::Context &context, std::uint64_t seed) {
    azulejo::MaximalOptions options;
    options.radius = 0.02;
    options.seed = seed;
    return azulejo::maximal_sample(context, options);
}

void planes() {
    const azulejo::Context context(2);
    const azulejo::Points points = blue_noise(context, 1);
    const azulejo::PlaneSet set{points};
    const auto report = azulejo::plane_measure(context, set);
    CHECK(report.count == points.size() && report.smallest_distance >= 0.02 && report.covering_radius <= 0.02 + 1e-6);
    CHECK(report.rho > 0.74 && report.rho < 0.8 && report.triangles == 2 * report.count);

    const auto covered = azulejo::plane_coverage(context, set, 0.02 + 1e-6);
    const auto open = azulejo::plane_coverage(context, set, 0.018);
    CHECK(covered.gaps == 0 && open.gaps > 10 && covered.covering_radius == report.covering_radius);

    const auto histogram = azulejo::plane_nearest_histogram(context, set, 2, 40);
    CHECK(std::accumulate(histogram.begin(), histogram.end(), std::uint64_t(0)) == points.size());
    CHECK(histogram[14] == 0 && histogram[15] > histogram[25]);
    const auto density = azulejo::plane_radial_distribution(context, set, 4, 80);
    CHECK(density.size() == 80 && density[14] == 0 && density[16] > 1.5 && std::abs(density[79] - 1) < 0.1);
    const std::vector<float> odd(7);
    CHECK(refused("positions: 7", [&] { azulejo::plane_measure(context, {odd}); }));
    std::vector<double> told;
    const auto tell = [&](double done) { return told.push_back(done), true; };
    const auto watched = azulejo::plane_measure(context.watch(tell), set);
    CHECK(watched.covering_radius == report.covering_radius && told.front() == 0 && told.back() == 1);
    const auto stop = [](double) { return false; };
    const auto stopped = [&] { azulejo::Spectrum(context.watch(stop), set, 100); };
    CHECK(throws(AZULEJO_ERROR_CANCELLED, "cancelled", stopped));
    bool thrown = false;
    try {
        azulejo::plane_coverage(context.watch([](double) -> bool { throw 7; }), set, 0.02);
    } catch (int) {
        thrown = true;
    }
    CHECK(thrown);
    CHECK(refused("bins", [&] { azulejo::plane_radial_distribution(context, set, 4, 0); }));
}

void spaces() {
    const azulejo::Context context(2);
    azulejo::VolumeOptions options;
    options.radius = 0.1;
    options.domain_max[0] = 1.5;
    const azulejo::Points points = azulejo::volume_sample(context, options);
    const azulejo::SpaceSet set{points, options};
    const auto report = azulejo::space_measure(context, set, 0.1);
    CHECK(report.count == points.size() && report.smallest_distance >= 0.1 && report.conflicts == 0);
    CHECK(report.covering_radius <= 0.1 + 1e-6 && report.rho > 0.7 && report.rho < 0.85);
    CHECK(azulejo::space_measure(context, set, 0.11).conflicts > 10 && azulejo::space_measure(context, set).conflicts == 0);
    const auto open = azulejo::space_coverage(context, set, 0.09);
    CHECK(open.gaps > 10 && open.covering_radius == report.covering_radius);
    CHECK(azulejo::space_coverage(context, set, 0.1).gaps == 0);
    const azulejo::Cuboid cuboid({0, 0, 0}, {1.5, 1, 1}, AZULEJO_BOUNDARY_BOUNDED);
    CHECK(azulejo::space_coverage(context, {points, cuboid}, 0.1).covering_radius > report.covering_radius);
    const auto annuli = azulejo::space_spectrum(context, set, 1.2);
    CHECK(annuli.size() > 15 && annuli.size() <= 25 && annuli.front().power < 0.3 && annuli.back().power > 0.5);
    CHECK(azulejo::space_spectrum(context, set, 1.2, 2, 0.2).size() < annuli.size());
    const auto power = azulejo::space_axis_power(context, set, 2, 12);
    CHECK(power.size() == 12 && power[0] < 0.5 && power[11] > 0);
    const auto density = azulejo::space_radial_distribution(context, set, 2, 20);
    CHECK(density.size() == 20 && density[5] == 0 && density[8] > 1);
    CHECK(refused("width", [&] { azulejo::space_spectrum(context, set, 1.2, 1, 0); }));
    CHECK(refused("count", [&] { azulejo::space_axis_power(context, set, 0, 0); }));
    CHECK(refused("reach", [&] { azulejo::space_radial_distribution(context, set, 1e9, 20); }));
    const std::vector<float> odd(7);
    CHECK(refused("positions: 7", [&] { azulejo::space_measure(context, {odd}); }));
}

void spectra() {
    const azulejo::Context context(2);
    std::vector<azulejo::Spectrum> spectra;
    for (std::uint64_t seed = 0; seed < 4; seed++) {
        const auto points = blue_noise(context, seed);
        spectra.emplace_back(context, azulejo::PlaneSet{points}, 280, 2);
    }
    const auto mean = azulejo::Spectrum::mean(spectra);
    CHECK(mean.size() == 280 && mean.power().size() == 280 * 280 && mean.power()[140 * 280 + 140] == 0);
    const auto report = mean.measure(0.05, 0.5, 3);
    CHECK(std::abs(report.effective_nyquist - 0.341) < 0.015 && std::abs(report.oscillation - 1.57) < 0.15);
    CHECK(std::abs(4 * report.contrast - 1) < 0.15 && report.peak < 10);
    const auto annuli = mean.radial(0.05);
    CHECK(annuli.size() > 100 && annuli[5].power < 0.2 && annuli[21].power > 1);
    CHECK(refused("width", [&] { mean.radial(-1); }));
    CHECK(refused("periodograms", [&] { azulejo::Spectrum::mean({}); }));
    const auto moved = std::move(spectra[0]);
    CHECK(moved.size() == 280 && spectra[0].size() == 0 && spectra[0].power().empty());
    CHECK(refused("spectra: [0]", [&] { azulejo::Spectrum::mean(spectra); }));
}

void surfaces() {
    const azulejo::Context context(2);
    const azulejo::Mesh cube(cube_positions, cube_indices);
    azulejo::PspOptions options;
    options.radius = 0.05;
    const auto points = azulejo::psp_sample(context, cube, options);
    const auto coverage = azulejo::mesh_coverage(context, cube, points, 0.05 + 1e-6);
    CHECK(coverage.gaps == 0 && coverage.covering_radius < 0.05 + 1e-6);
    CHECK(azulejo::mesh_coverage(context, cube, azulejo::Span(points.positions().data(), 3), 0.05).gaps == 1);

    std::vector<azulejo::Differences> differences;
    const double up[] = {0, 0, 1};
    differences.emplace_back(context, cube, points, points.normals(), up);
    differences.emplace_back(context, cube, points, points.normals(), up, 5);
    const auto both = azulejo::Differences::mean(differences);
    CHECK(both.density().size() == 128 * 128 && both.radial().size() == 512 && both.radial()[20] == 0);
    const auto power = both.power(std::array<double, 2>{0.3, 1});
    CHECK(power.size() == 2 && power[0] < 0.3 && power[1] > 0.7);
    CHECK(refused("normals", [&] { azulejo::Differences(context, cube, points, {}, up); }));
}

} // namespace

int main() {
    planes();
    spaces();
    spectra();
    surfaces();
    return finish();
}
