// azulejo.hpp: relaxation to a density, and what a density throws.

#include <array>
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

} // namespace

int main() {
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
    const auto points = azulejo::dcr_relax_density(context, options, density, start.positions(), &report);
    CHECK(start.size() == 500 && points.size() == 500 && report.rho > 0.6);
    for (std::size_t i = 0; i < points.size(); i++) CHECK(points.positions()[2 * i] > 0.1f);

    density.values = {};
    density.function = [](const std::array<double, 2> &position) { return position[1]; };
    const auto raised = azulejo::dcr_relax_density(context, options, density, start.positions(), &report);
    CHECK(raised.size() == 500 && report.iterations > 0);
    density.function = [](const std::array<double, 2> &position) -> double {
        if (position[0] > 0.5) throw Mishap();
        return 1;
    };
    for (std::uint32_t threads : {1, 3}) {
        const azulejo::Context some(threads);
        CHECK(leaves_the_mishap([&] { azulejo::dcr_relax_density(some, options, density, start.positions()); }));
        CHECK(leaves_the_mishap([&] { azulejo::dcr_scatter(some, options, density, 9); }));
    }
    return finish();
}
