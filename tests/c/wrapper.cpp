// azulejo.hpp: owners, moves, exceptions, options.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <type_traits>
#include <utility>
#include <vector>

#include "check.h"
#include "throws.hpp"

namespace {

const std::array<float, 12> positions = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
const std::vector<std::uint32_t> indices = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};

template <class T>
constexpr bool move_only = std::is_nothrow_move_constructible_v<T> && std::is_nothrow_move_assignable_v<T> &&
                           !std::is_copy_constructible_v<T> && !std::is_copy_assignable_v<T>;
static_assert(move_only<azulejo::Context> && move_only<azulejo::Points>);
static_assert(move_only<azulejo::Mesh> && move_only<azulejo::Psp>);
static_assert(move_only<azulejo::Spectrum> && move_only<azulejo::Differences>);

void spans() {
    std::vector<float> values = {1, 2, 3};
    const azulejo::Span<float> span(values);
    const azulejo::Span<const float> constant(values), none;
    span[1] = 5;
    CHECK(constant.size() == 3 && constant[1] == 5 && !constant.empty());
    CHECK(none.empty() && none.begin() == none.end());
    float sum = 0;
    for (float x : constant) sum += x;
    CHECK(sum == 9);
}

void errors() {
    const azulejo::Context context(1);
    CHECK(throws(AZULEJO_ERROR_INVALID_ARGUMENT, "num_threads", [] { azulejo::Context too_many(5000); }));
    CHECK(throws(AZULEJO_ERROR_INVALID_ARGUMENT, "num_threads", [] {
        azulejo_context *handle = nullptr;
        azulejo::check(azulejo_context_create(5000, &handle));
    }));
    CHECK(throws(AZULEJO_ERROR_IO, "missing.ply", [] { azulejo::Mesh::load("missing.ply"); }));
    const std::vector<float> seven(7);
    CHECK(throws(AZULEJO_ERROR_INVALID_ARGUMENT, "positions: 7", [&] { azulejo::Mesh mesh(seven, {}); }));
    CHECK(throws(AZULEJO_ERROR_INVALID_ARGUMENT, "positions: 7",
                 [&] { azulejo::dcr_relax(azulejo::Context(1), azulejo::DcrOptions(), seven); }));
    CHECK(throws(AZULEJO_ERROR_INVALID_ARGUMENT, "indices", [] { azulejo::Mesh mesh(positions, {}); }));
    CHECK(throws(AZULEJO_ERROR_INVALID_ARGUMENT, "radius",
                 [&] { azulejo::kdrt_sample(context, azulejo::KdrtOptions()); }));
    try {
        azulejo::maximal_sample(context, {});
        CHECK(!"reached");
    } catch (const std::runtime_error &error) {
        CHECK(std::strstr(error.what(), "radius") != nullptr);
    }
    CHECK(azulejo::version() == AZULEJO_VERSION);
}

void owners() {
    azulejo::Context first(2);
    CHECK(first.num_threads() == 2);
    azulejo::Context second = std::move(first);
    CHECK(first.get() == nullptr && first.num_threads() == 0 && second.num_threads() == 2);

    azulejo::KdrtOptions options;
    options.radius = 0.1;
    CHECK(throws(AZULEJO_ERROR_INVALID_ARGUMENT, "context", [&] { azulejo::kdrt_sample(first, options); }));
    azulejo::Points points = azulejo::kdrt_sample(second, options);
    CHECK(points.size() > 50 && points.dimension() == 2 && points.positions().size() == 2 * points.size());
    CHECK(points.normals().empty() && points.triangles().empty() && points.barycentrics().empty());
    const float *data = points.positions().data();
    azulejo::Points moved(std::move(points));
    CHECK(moved.positions().data() == data && points.size() == 0 && points.positions().empty());
    points = std::move(moved);
    CHECK(points.positions().data() == data && moved.get() == nullptr);
    points = azulejo::maximal_sample(second, [] {
        azulejo::MaximalOptions o;
        o.radius = 0.1;
        return o;
    }());
    CHECK(azulejo::plane_smallest_distance(second, {points, options}) >= 0.1);
}

// Objects without a handle, handles that are adopted, and handles that are given up.
void handles() {
    const azulejo::Points points;
    const azulejo::Mesh no_mesh;
    azulejo::Psp psp;
    const azulejo::Spectrum spectrum;
    const azulejo::Differences differences;
    const azulejo::Context none(nullptr), one(1), all, counted(0);
    CHECK(!points && !no_mesh && !psp && !spectrum && !differences && !none && one);
    CHECK(all.num_threads() >= 1 && counted.num_threads() == all.num_threads());
    CHECK(points.size() == 0 && points.positions().empty() && points.radii().empty() && points.ranks().empty() &&
          points.classes().empty());
    CHECK(spectrum.power().empty());
    CHECK(no_mesh.area() == 0 && differences.density().empty() && none.num_threads() == 0);
    CHECK(refused("psp", [&] { psp.advance(1); }));
    CHECK(refused("mesh", [&] { azulejo::psp_sample(one, no_mesh, {}); }));
    CHECK(refused("coordinates", [&] { azulejo::dcr_relax(one, {}, points); }));

    azulejo::Mesh mesh(positions, indices);
    azulejo_mesh *const handle = mesh.release();
    CHECK(handle != nullptr && !mesh && mesh.get() == nullptr && azulejo_mesh_vertex_count(handle) == 4);
    mesh = azulejo::Mesh(handle);
    CHECK(mesh.get() == handle && mesh.vertex_count() == 4);
    azulejo::Context first(2);
    const azulejo::Context second(first.release());
    CHECK(!first && second.num_threads() == 2);

    azulejo::PspOptions options;
    options.radius = 0.1;
    azulejo_psp *growing = nullptr;
    azulejo::check(azulejo_psp_create(second.get(), mesh.get(), &options, &growing));
    psp = azulejo::Psp(growing);
    CHECK(psp.fill().samples == psp.points().size());
    CHECK(azulejo_psp_advance(psp.get(), 1, nullptr) == AZULEJO_OK);
}

// Each call has a form that returns a status, also where there are exceptions.
void statuses() {
    azulejo::Context context(nullptr);
    CHECK(azulejo::Context::try_create(2, context).ok() && context.num_threads() == 2);
    const azulejo::Status failed = azulejo::Context::try_create(5000, context);
    CHECK(failed.code() == AZULEJO_ERROR_INVALID_ARGUMENT && failed.message().find("5000") != std::string::npos);
    CHECK(failed.name() == std::string("AZULEJO_ERROR_INVALID_ARGUMENT"));
    CHECK(context.num_threads() == 2);

    azulejo::KdrtOptions options;
    options.radius = 0.1;
    azulejo::Points points;
    CHECK(azulejo::try_kdrt_sample(context, options, points).ok() && points.size() > 50);
    const azulejo_points *const handle = points.get();
    options.radius = -1;
    const azulejo::Status refusal = azulejo::try_kdrt_sample(context, options, points);
    CHECK(refusal.message().find("radius: -1") != std::string::npos && points.get() == handle);
    CHECK(azulejo::Status().ok() && azulejo::Status().message().empty());
    std::vector<std::uint64_t> histogram = {7};
    const auto bins = azulejo::try_plane_nearest_histogram(context, {points, options}, 2, std::size_t(-1), histogram);
    CHECK(bins.message().find("bins") != std::string::npos && histogram.size() == 1);
}

void several_classes() {
    const azulejo::Context context(2);
    const azulejo::Mesh mesh(positions, indices);
    azulejo::Classes classes = azulejo::classes_radii(std::array<double, 2>{0.2, 0.1});
    CHECK(classes.count == 2 && classes.radius(0, 0) == 0.2 && classes.radius(0, 1) == classes.radius(1, 0));
    const std::vector<std::uint32_t> masks = {1, 3, 3, 2};
    classes.masks = masks;
    azulejo::PspOptions of_classes;
    const auto both = azulejo::psp_sample_classes(context, mesh, of_classes, classes);
    CHECK(both.size() > 0 && both.classes().size() == both.size());
    for (std::size_t i = 0; i < both.size(); i++) CHECK(masks[both.triangles()[i]] >> both.classes()[i] & 1);
    const std::array<float, 3> one = {0, 0, 0};
    const std::array<double, 2> clearances = {5, 0.1};
    of_classes.set_given(one, clearances, 2);
    const auto second = azulejo::psp_sample_classes(context, mesh, of_classes, classes);
    CHECK(second.size() > 0 && second.classes()[0] == 1);
    CHECK(throws(AZULEJO_ERROR_INVALID_ARGUMENT, "given_clearances: there are 2, and 3 are needed",
                 [&] { of_classes.set_given(one, clearances, 3); }));
    CHECK(throws(AZULEJO_ERROR_INVALID_ARGUMENT, "classes: 0",
                 [&] { of_classes.set_given(one, {clearances.data(), 0}, 0); }));
    of_classes.set_given(one, {clearances.data(), 1});
    CHECK(throws(AZULEJO_ERROR_INVALID_ARGUMENT, "given_clearances: there are 1 for each sample, and 2 classes",
                 [&] { azulejo::psp_sample_classes(context, mesh, of_classes, classes); }));
    azulejo::MeshDensity density;
    density.function = [](const std::array<double, 3> &) { return 1.0; };
    density.at_vertices = true;
    density.radius = 1;
    const auto even = azulejo::psp_classes_with_density(context, mesh, {}, classes, density);
    CHECK(even.size() > 0 && even.classes().size() == even.size() && even.radii()[0] == 1);
    density.function = [](const std::array<double, 3> &) -> double { throw std::runtime_error("no density"); };
    try {
        azulejo::psp_classes_with_density(context, mesh, {}, classes, density);
        CHECK(false);
    } catch (const std::runtime_error &error) {
        CHECK(std::string(error.what()) == "no density");
    }
    classes.radii.pop_back();
    CHECK(throws(AZULEJO_ERROR_INVALID_ARGUMENT, "radii: 3 for 2",
                 [&] { azulejo::psp_sample_classes(context, mesh, {}, classes); }));
    CHECK(throws(AZULEJO_ERROR_INVALID_ARGUMENT, "own", [] { azulejo::classes_radii({}); }));
}

void surfaces() {
    const azulejo::Context context(2);
    azulejo::PspOptions options;
    options.radius = 0.1;
    auto mesh = std::make_unique<azulejo::Mesh>(positions, indices);
    CHECK(mesh->vertex_count() == 4 && mesh->triangle_count() == 4);
    CHECK(mesh->positions()[3] == 1 && mesh->indices()[1] == 2);
    CHECK(std::abs(mesh->area() - (1.5 + std::sqrt(3.0) / 2)) < 1e-6);

    CHECK(throws(AZULEJO_ERROR_INVALID_ARGUMENT, "scene", [] { azulejo::Mesh::from_embree(nullptr, {}); }));

    azulejo::PspReport report;
    const auto whole = azulejo::psp_sample(context, *mesh, options, &report);
    CHECK(report.samples == whole.size() && whole.dimension() == 3);
    CHECK(whole.normals().size() == 3 * whole.size() && whole.triangles().size() == whole.size());
    CHECK(whole.barycentrics().size() == 2 * whole.size());
    CHECK(azulejo::space_smallest_distance(context, whole.positions()) >= 0.1);
    CHECK(azulejo::mesh_uncovered_fraction(context, *mesh, whole.positions(), 0.1, 10000) == 0);

    azulejo::PspOptions ordered;
    ordered.count = 100;
    ordered.order = AZULEJO_ORDER_PROGRESSIVE;
    const auto hundred = azulejo::psp_sample(context, *mesh, ordered, &report);
    CHECK(hundred.size() == 100 && hundred.ranks().size() == 100 && whole.ranks().empty());
    CHECK(report.radius == hundred.ranks()[99] && report.covering_radius <= 1.0906 * report.radius);

    CHECK(!mesh->has_normals() && whole.interpolated_normals().empty());
    const std::array<float, 3> up = {0, 0, 2};
    const std::vector<std::uint32_t> first_normal(indices.size());
    const std::vector<std::uint8_t> only_the_first = {1, 0, 0, 0};
    auto carrying = mesh->with_normals(positions).with_normals(up, first_normal).with_mask(only_the_first);
    CHECK(carrying.has_normals() && carrying.triangle_count() == 4 && carrying.area() == 0.5);
    std::vector<azulejo::Mesh> prototypes;
    prototypes.emplace_back(positions, indices);
    const std::vector<azulejo_instance> instances = {{0, 0, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}}};
    const auto placed = azulejo::psp_sample_instances(context, prototypes, instances, options);
    CHECK(placed.size() > 0 && placed.instances().size() == placed.size() && placed.instances()[0] == 0);
    CHECK(whole.instances().empty());
    const auto part = azulejo::psp_sample(context, carrying, options);
    CHECK(part.interpolated_normals().size() == 3 * part.size() && part.interpolated_normals()[2] == 1);
    CHECK(part.normals()[2] == -1 && part.triangles()[part.size() - 1] == 0);
    CHECK(mesh->with_normals({positions.data(), 1, 48}, first_normal).has_normals());
    CHECK(refused("normals: 4", [&] { mesh->with_normals(azulejo::Span(positions.data(), 4)); }));
    CHECK(refused("triangle_count", [&] { mesh->with_normals(up, azulejo::Span(indices.data(), 3)); }));
    CHECK(throws(AZULEJO_ERROR_INVALID_ARGUMENT, "triangle_count", [&] { mesh->with_mask({}); }));

    azulejo::Psp psp(context, *mesh, options);
    mesh.reset();
    const auto first = psp.advance(1);
    azulejo::Psp moved = std::move(psp);
    const auto second = moved.fill();
    CHECK(first.samples > 0 && second.samples == first.samples + second.accepted);
    CHECK(moved.points().size() == second.samples);
    CHECK(throws(AZULEJO_ERROR_INVALID_ARGUMENT, "psp", [&] { psp.fill(); }));
    CHECK(throws(AZULEJO_ERROR_INVALID_ARGUMENT, "psp", [&] { psp.points(); }));
}

void counts() {
    const azulejo::Context context(2);
    azulejo::KdrtOptions options;
    options.count = 777;
    azulejo::KdrtReport report;
    const auto points = azulejo::kdrt_sample(context, options, &report);
    CHECK(points.size() == 777 && report.samples == 777 && report.is_maximal == 1);
    CHECK(azulejo::plane_smallest_distance(context, {points, options}) >= report.radius && report.covering_radius == -1);
    options.measure_covering_radius = 1;
    const auto measured = azulejo::kdrt_sample(context, options, &report);
    CHECK(report.covering_radius == azulejo::plane_covering_radius(context, {measured, options}) && report.covering_radius > 0);
    CHECK(refused("measure_covering_radius", [&] { azulejo::kdrt_sample(context, options); }));
    options.measure_covering_radius = 0;
    options.order = AZULEJO_ORDER_PROGRESSIVE;
    const auto ordered = azulejo::kdrt_sample(context, options, &report);
    CHECK(measured.ranks().empty() && ordered.ranks().size() == 777 && ordered.ranks()[776] == report.radius);
    options.order = AZULEJO_ORDER_ANY;
    options.count = 0;
    options.radius = report.radius;
    options.set_given(ordered.positions());
    CHECK(azulejo::kdrt_sample(context, options).size() < 200);
    const std::vector<double> clearances(777, 0.0);
    options.set_given(ordered.positions(), clearances);
    CHECK(azulejo::kdrt_sample(context, options).size() > 700);
    CHECK(refused("given_clearances: there are 776, and 777 are needed",
                  [&] { options.set_given(ordered.positions(), {clearances.data(), 776}); }));
    const std::vector<float> odd = {0.1F, 0.1F, 0.5F, 0.5F, 0.9F};
    CHECK(refused("given_positions: 5 numbers are not a multiple of 2", [&] { options.set_given(odd); }));
    CHECK(options.given_count == 777 && options.given_clearances == clearances.data());
    options.set_given({});
    options.count = 777;
    options.radius = 0.1;
    CHECK(throws(AZULEJO_ERROR_INVALID_ARGUMENT, "count: 777", [&] { azulejo::kdrt_sample(context, options); }));
}

void windows() {
    const azulejo::Context context(2);
    azulejo::KdrtOptions options;
    options.radius = 0.005;
    const auto whole = azulejo::kdrt_sample(context, options);
    const double middle[] = {0.3, 0.5};
    std::vector<float> expected;
    for (std::size_t i = 0; i < whole.size(); i++) {
        const float *xy = whole.positions().data() + 2 * i;
        if (xy[0] >= middle[0] && xy[1] >= middle[1]) expected.insert(expected.end(), xy, xy + 2);
    }
    const auto window = azulejo::kdrt_sample_window(context, options, middle, options.domain_max);
    CHECK(window.positions().size() == expected.size());
    CHECK(std::equal(expected.begin(), expected.end(), window.positions().begin()));
    CHECK(throws(AZULEJO_ERROR_INVALID_ARGUMENT, "window_max",
                 [&] { azulejo::kdrt_sample_window(context, options, middle, middle); }));
    auto plane = azulejo::Kdrt(context, options);
    const azulejo::Kdrt moved = std::move(plane);
    const auto same = moved.window(middle, options.domain_max);
    CHECK(!plane && same.positions().size() == expected.size());
    CHECK(std::equal(expected.begin(), expected.end(), same.positions().begin()));
    CHECK(throws(AZULEJO_ERROR_INVALID_ARGUMENT, "window_max", [&] { moved.window(middle, middle); }));
    CHECK(throws(AZULEJO_ERROR_INVALID_ARGUMENT, "plane", [&] { plane.window(middle, options.domain_max); }));
    {
        // The same samples seen from the corner, wherever the window lies, in arrays of the host.
        const double extent[] = {1 - middle[0], 1 - middle[1]}, far[] = {middle[0], middle[1] - 1};
        std::vector<float> positions(2 * moved.window_capacity(extent), -1.0f), ranks(1);
        CHECK(moved.window_into(far, {1, 0}, positions) == same.size());
        const auto least = [](const auto &all, std::size_t count, double from) {
            double sum = 0;
            for (std::size_t i = 0; i < count; i++) sum += all[2 * i] - from;
            return sum;
        };
        CHECK(std::abs(least(positions, same.size(), 0) - least(same.positions(), same.size(), middle[0])) < 0.01);
        CHECK(positions[2 * same.size()] == -1.0f && moved.unit() == 0x1p-24);
        std::size_t count = 0;
        CHECK(!moved.try_window_into(far, {1, 0}, {positions.data(), 8}, count).ok() && count == same.size());
        CHECK(throws(AZULEJO_ERROR_INVALID_ARGUMENT, "ranks: fewer than",
                     [&] { moved.window_into(far, {1, 0}, positions, ranks); }));
        CHECK(throws(AZULEJO_ERROR_INVALID_ARGUMENT, "capacity: 4 is below",
                     [&] { moved.window_into(far, {1, 0}, {positions.data(), 8}); }));
        CHECK(throws(AZULEJO_ERROR_INVALID_ARGUMENT, "extent", [&] { moved.window_capacity({0, 1}); }));
    }
    CHECK(throws(AZULEJO_ERROR_INVALID_ARGUMENT, "radius", [&] { azulejo::Kdrt(context, {}); }));
    options.set_progress([](double done) -> bool { throw done; });
    try {
        azulejo::Kdrt(context, options);
        CHECK(!"reached");
    } catch (double thrown) {
        CHECK(thrown == 0);
    }
    try {
        azulejo::kdrt_sample_window(context, options, middle, options.domain_max);
        CHECK(!"reached");
    } catch (double thrown) {
        CHECK(thrown == 0);
    }
}

void streams() {
    const azulejo::Context context(2);
    azulejo::KdrtOptions options;
    options.radius = 0.003;
    const auto whole = azulejo::kdrt_sample(context, options);
    std::vector<float> streamed;
    int parts = 0;
    azulejo::kdrt_stream(context, options, [&](azulejo::Span<const float> xy) {
        streamed.insert(streamed.end(), xy.begin(), xy.end());
        parts++;
        return true;
    });
    CHECK(parts > 2 && streamed.size() == whole.positions().size());
    CHECK(std::equal(streamed.begin(), streamed.end(), whole.positions().begin()));

    int visits = 0;
    CHECK(throws(AZULEJO_ERROR_CANCELLED, "cancelled",
                 [&] { azulejo::kdrt_stream(context, options, [&](auto) { return ++visits < 2; }); }));
    CHECK(visits == 2);
    CHECK(throws(AZULEJO_ERROR_INVALID_ARGUMENT, "visit", [&] { azulejo::kdrt_stream(context, options, nullptr); }));
    for (int last : {1, parts}) {
        visits = 0;
        try {
            azulejo::kdrt_stream(context, options, [&](auto) {
                if (++visits == last) throw std::logic_error("enough");
                return true;
            });
            CHECK(!"reached");
        } catch (const std::logic_error &error) {
            CHECK(std::strcmp(error.what(), "enough") == 0 && visits == last);
        }
    }
    options.set_progress([](double done) {
        if (done > 0.5) throw std::logic_error("progress");
        return true;
    });
    try {
        azulejo::kdrt_stream(context, options, [](auto) { return true; });
        CHECK(!"reached");
    } catch (const std::logic_error &error) {
        CHECK(std::strcmp(error.what(), "progress") == 0);
    }
}

void merging() {
    const azulejo::Context context(2);
    azulejo::KdrtOptions left, right;
    left.radius = right.radius = 0.02;
    left.set_domain({{0, 0}, {0.6, 1}, AZULEJO_BOUNDARY_BOUNDED});
    right.set_domain({{0.6, 0}, {1, 1}, AZULEJO_BOUNDARY_BOUNDED});
    right.seed = 1;
    const auto first = azulejo::kdrt_sample(context, left), second = azulejo::kdrt_sample(context, right);
    const std::vector<azulejo::KdrtMergePiece> pieces = {{first, {0, 0}, {0.6, 1}},
                                                         {second.positions(), {0.6, 0}, {1, 1}}};
    const std::array<float, 4> fixed = {0.25f, 0.5f, 0.75f, 0.5f};
    azulejo::KdrtMergeOptions options;
    options.radius = 0.02;
    azulejo::KdrtMergeReport report;
    const auto merged = azulejo::kdrt_merge(context, options, pieces, fixed, &report);
    CHECK(merged.size() == 2 + report.kept + report.inserted);
    CHECK(report.kept + report.eliminated == first.size() + second.size() && report.eliminated > 0);
    CHECK(std::equal(fixed.begin(), fixed.end(), merged.positions().begin()));
    CHECK(azulejo::plane_smallest_distance(context, {merged, options}) >= 0.02);
    CHECK(azulejo::kdrt_merge(context, options, {}).size() > 1500);

    const std::vector<float> seven(7);
    CHECK(throws(AZULEJO_ERROR_INVALID_ARGUMENT, "fixed: 7",
                 [&] { azulejo::kdrt_merge(context, options, {}, seven); }));
    const std::array<azulejo::KdrtMergePiece, 1> odd = {{{seven, {0, 0}, {1, 1}}}};
    CHECK(throws(AZULEJO_ERROR_INVALID_ARGUMENT, "positions: 7", [&] { azulejo::kdrt_merge(context, options, odd); }));
    const std::array<azulejo::KdrtMergePiece, 2> twice = {pieces[0], pieces[0]};
    CHECK(throws(AZULEJO_ERROR_INVALID_ARGUMENT, "overlap", [&] { azulejo::kdrt_merge(context, options, twice); }));
    options.set_progress([](double) { return false; });
    CHECK(throws(AZULEJO_ERROR_CANCELLED, "cancelled", [&] { azulejo::kdrt_merge(context, options, pieces); }));
}

void thinning() {
    const azulejo::Context context(2);
    const std::vector<std::array<float, 2>> line = {{0, 0}, {0.25f, 0}, {1, 0}, {0.5f, 0}};
    azulejo::ThinOptions options;
    options.radius = 0.5;
    const auto apart = azulejo::plane_thin(context, options, line);
    const std::array<std::uint32_t, 3> expected = {0, 2, 3};
    CHECK(std::equal(expected.begin(), expected.end(), apart.indices().begin(), apart.indices().end()));
    CHECK(apart.size() == 3 && apart.ranks().empty());
    options.radius = 0;
    options.order = AZULEJO_ORDER_PROGRESSIVE;
    const auto ordered = azulejo::space_thin(context, options, positions);
    CHECK(ordered.size() == positions.size() / 3 && ordered.ranks().size() == ordered.size());
    CHECK(ordered.ranks()[0] > 1e30f && ordered.ranks()[1] < 1e30f);
    const std::vector<float> seven(7);
    CHECK(throws(AZULEJO_ERROR_INVALID_ARGUMENT, "positions: 7", [&] { azulejo::space_thin(context, options, seven); }));
    const azulejo::Selection none;
    CHECK(none.size() == 0 && none.indices().empty() && none.ranks().empty());
    options.set_progress([](double) { return false; });
    CHECK(throws(AZULEJO_ERROR_CANCELLED, "cancelled", [&] { azulejo::plane_thin(context, options, line); }));
}

void masks() {
    const azulejo::Context context(2);
    azulejo::MaskOptions options;
    options.width = 16;
    options.height = 8;
    options.channels = 2;
    azulejo::MaskReport report;
    const auto mask = azulejo::mask_create(context, options, &report);
    CHECK(mask.width() == 16 && mask.height() == 8 && mask.depth() == 1 && mask.channels() == 2);
    CHECK(mask.ranks().size() == 256 && report.pixels == 128);
    std::vector<float> values(256);
    azulejo::check(mask.try_values(values));
    for (std::size_t i = 0; i < 256; i++) CHECK(values[i] == (float(mask.ranks()[i]) + 0.5f) / 128);
    CHECK(!mask.try_values(azulejo::Span<float>(values.data(), 255)).ok());
    const std::vector<float> image(32 * 16 * 2, 0.25f);
    const std::vector<std::uint8_t> bytes(32 * 16 * 2, 255);
    std::vector<std::uint8_t> out(image.size());
    azulejo::check(mask.try_dither(azulejo::Span<const float>(image), 32, 2, 2, out));
    CHECK(std::count(out.begin(), out.end(), 1) == 256);
    azulejo::check(mask.try_dither(azulejo::Span<const std::uint8_t>(bytes), 32, 2, 7, out));
    CHECK(std::count(out.begin(), out.end(), 6) == 1024);
    CHECK(!mask.try_dither(azulejo::Span<const float>(image), 31, 2, 2, out).ok());
    options.set_progress([](double) { return false; });
    CHECK(throws(AZULEJO_ERROR_CANCELLED, "cancelled", [&] { azulejo::mask_create(context, options); }));
}

void volumes() {
    const azulejo::Context context(2);
    azulejo::VolumeOptions options;
    options.radius = 0.2;
    options.boundary = AZULEJO_BOUNDARY_BOUNDED;
    azulejo::VolumeReport report;
    const auto points = azulejo::volume_sample(context, options, &report);
    CHECK(points.dimension() == 3 && points.size() == report.samples && points.size() > 100);
    CHECK(points.positions().size() == 3 * points.size() && points.triangles().empty() && report.radius == 0.2);
    options.set_progress([](double) { return false; });
    CHECK(throws(AZULEJO_ERROR_CANCELLED, "cancelled", [&] { azulejo::volume_sample(context, options); }));
    options.radius = -1;
    CHECK(throws(AZULEJO_ERROR_INVALID_ARGUMENT, "radius: -1", [&] { azulejo::volume_sample(context, options); }));
    options.leaf_size = 5;
    CHECK(throws(AZULEJO_ERROR_INVALID_ARGUMENT, "leaf_size: 5", [&] { azulejo::volume_sample(context, options); }));
    const azulejo::Classes two = azulejo::classes_radii(std::vector<double>{0.2, 0.3});
    azulejo::ClassesReport counts;
    const auto set = azulejo::volume_sample_classes(context, azulejo::VolumeOptions(), two, &counts);
    CHECK(set.classes().size() == set.size() && counts.counts[0] > counts.counts[1] && counts.counts[1] > 10);
    CHECK(throws(AZULEJO_ERROR_INVALID_ARGUMENT, "radius: -1.0 has no effect with classes",
                 [&] { azulejo::volume_sample_classes(context, options, two); }));
}

void insides() {
    const azulejo::Context context(2);
    const std::vector<float> corners = {0, 0, 0, 2, 0, 0, 0, 2, 0, 0, 0, 2};
    const std::vector<std::uint32_t> faces = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
    const azulejo::Mesh mesh(corners, faces);
    CHECK(mesh.is_closed());
    azulejo::VolumeInsideOptions options;
    azulejo::VolumeInsideReport report;
    options.radius = 0.2;
    options.surface = AZULEJO_SURFACE_FIRST;
    const auto points = azulejo::volume_sample_inside(context, mesh, options, &report);
    CHECK(points.dimension() == 3 && points.size() == report.samples && points.triangles().empty());
    CHECK(report.surface_samples > 50 && report.surface_samples < report.samples && report.depth < 0.03);
    options.thickness = 0.05;
    const auto shell = azulejo::volume_sample_inside(context, mesh, options, &report);
    CHECK(shell.size() < points.size() && report.depth < 0.022);
    options.thickness = -1;
    CHECK(throws(AZULEJO_ERROR_INVALID_ARGUMENT, "thickness: -1",
                 [&] { azulejo::volume_sample_inside(context, mesh, options); }));
    options.thickness = 0;
    const std::vector<float> places = {0.5f, 0.5f, 0.5f, 1.0f, 1.0f, 1.0f};
    const auto inside = azulejo::mesh_contains(context, mesh, places);
    CHECK(inside == (std::vector<std::uint8_t>{1, 0}));
    const azulejo::Mesh open(corners, std::vector<std::uint32_t>(faces.begin(), faces.end() - 3));
    CHECK(!open.is_closed());
    CHECK(azulejo::volume_sample_inside(context, open, options).size() > 50);
    const azulejo::Mesh loose(corners, std::vector<std::uint32_t>(faces.begin(), faces.begin() + 3));
    CHECK(throws(AZULEJO_ERROR_INVALID_ARGUMENT, "mesh: encloses nothing",
                 [&] { azulejo::volume_sample_inside(context, loose, options); }));
}

void varying_volumes() {
    const azulejo::Context context(2);
    azulejo::VolumeAdaptiveOptions options;
    azulejo::VolumeReport report;
    options.smallest = 0.06;
    options.largest = 0.12;
    options.slope = 0.06;
    options.set_radius([](const std::array<double, 3> &position) { return 0.06 + 0.06 * position[0]; });
    const auto points = azulejo::volume_adaptive_sample(context, options, &report);
    CHECK(points.size() == report.samples && points.size() > 1000 && points.radii().size() == points.size());
    CHECK(points.radii()[7] == 0.06 + 0.06 * static_cast<double>(points.positions()[21]));
    azulejo::VolumeAdaptiveOptions on_grid;
    const std::vector<float> values = {0.05f, 0.1f, 0.05f, 0.1f};
    on_grid.set_grid(values, {2, 1, 2});
    CHECK(throws(AZULEJO_ERROR_INVALID_ARGUMENT, "grid_size", [&] { on_grid.set_grid(values, {2, 1, 3}); }));
    CHECK(azulejo::volume_adaptive_sample(context, on_grid).size() > 1000);
    const std::vector<float> corners = {0, 0, 0, 2, 0, 0, 0, 2, 0, 0, 0, 2};
    const azulejo::Mesh mesh(corners, std::vector<std::uint32_t>{0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3});
    const auto inside = azulejo::volume_adaptive_sample(context, mesh, on_grid);
    CHECK(inside.size() > 1000 && inside.triangles().empty());
    struct Mishap {};
    options.set_radius([](const std::array<double, 3> &) -> double { throw Mishap(); });
    bool caught = false;
    try {
        azulejo::volume_adaptive_sample(context, options);
    } catch (const Mishap &) {
        caught = true;
    }
    CHECK(caught);
}

void adaptive() {
    const azulejo::Context context(3);
    const azulejo::Mesh mesh(positions, indices);
    azulejo::PspAdaptiveOptions options;
    CHECK(throws(AZULEJO_ERROR_INVALID_ARGUMENT, "radius",
                 [&] { azulejo::psp_adaptive_sample(context, mesh, options); }));
    const std::vector<float> radii = {0.05f, 0.1f, 0.2f, 0.1f};
    options.set_vertex_radii(radii);
    azulejo::PspReport report;
    const auto points = azulejo::psp_adaptive_sample(context, mesh, options, &report);
    CHECK(points.size() > 100 && points.size() == report.samples && points.radii().size() == points.size());
    for (double radius : points.radii()) CHECK(radius >= 0.05f && radius <= 0.2f);
    CHECK(points.ranks().empty());
    options.order = AZULEJO_ORDER_PROGRESSIVE;
    const auto ordered = azulejo::psp_adaptive_sample(context, mesh, options);
    CHECK(ordered.ranks().size() == ordered.size() && ordered.radii().size() == ordered.size());
    CHECK(ordered.ranks()[ordered.size() - 1] >= 1);
    options.order = AZULEJO_ORDER_ANY;
    const azulejo::Points no_points(nullptr);
    CHECK(no_points.radii().empty());

    options.set_vertex_radii({});
    options.smallest = 0.05;
    options.largest = 0.15;
    options.slope = 0.1;
    options.set_radius([](const std::array<double, 3> &position) { return 0.05 + 0.1 * position[0]; });
    const auto faded = azulejo::psp_adaptive_sample(context, mesh, options);
    CHECK(faded.size() > 100 && faded.radii()[0] == 0.05 + 0.1 * static_cast<double>(faded.positions()[0]));

    struct Mishap {};
    options.set_radius([](const std::array<double, 3> &position) -> double {
        if (position[0] > 0.5) throw Mishap();
        return 0.05 + 0.1 * position[0];
    });
    for (std::uint32_t threads : {1, 3}) {
        bool caught = false;
        try {
            azulejo::psp_adaptive_sample(azulejo::Context(threads), mesh, options);
        } catch (const Mishap &) {
            caught = true;
        }
        CHECK(caught);
    }
    options.set_radius([](const std::array<double, 3> &position) { return 0.05 + 0.1 * position[0]; });
    options.set_progress([](double) { return false; });
    CHECK(throws(AZULEJO_ERROR_CANCELLED, "cancelled", [&] { azulejo::psp_adaptive_sample(context, mesh, options); }));
}

// Frames are orthonormal and right-handed for every direction.
void frames() {
    const auto dot = [](const auto &a, const auto &b) {
        return double{a[0]} * b[0] + double{a[1]} * b[1] + double{a[2]} * b[2];
    };
    for (int x = -3; x <= 3; x++) {
        for (int y = -3; y <= 3; y++) {
            for (int z = -3; z <= 3; z++) {
                if (x == 0 && y == 0 && z == 0) continue;
                const auto [t, b, n] = azulejo::frame({x, y, z});
                CHECK(std::abs(dot(t, t) - 1) < 1e-6 && std::abs(dot(b, b) - 1) < 1e-6);
                CHECK(std::abs(dot(t, b)) < 1e-6 && std::abs(dot(t, n)) < 1e-6 && std::abs(dot(b, n)) < 1e-6);
                const std::array<float, 3> up = {t[1] * b[2] - t[2] * b[1], t[2] * b[0] - t[0] * b[2],
                                                 t[0] * b[1] - t[1] * b[0]};
                CHECK(std::abs(dot(up, n) - 1) < 1e-6);
                CHECK(std::abs(dot(n, std::array{x, y, z}) - std::hypot(x, y, z)) < 1e-6);
            }
        }
    }
    const auto below = azulejo::frame(std::array<float, 3>{0, 0, -1});
    CHECK(below.normal[2] == -1 && below.tangent[0] == 1);
}

// Random numbers are evenly distributed, independent for different seeds, and the same in windows.
void random_numbers() {
    const azulejo::Context context(1);
    azulejo::KdrtOptions options;
    options.radius = 0.005;
    const auto whole = azulejo::kdrt_sample(context, options);
    const auto window = azulejo::kdrt_sample_window(context, options, {0.2, 0.3}, {0.4, 0.6});
    double mean = 0, both = 0;
    std::array<std::size_t, 16> bins{};
    std::map<std::pair<float, float>, float> of_place;
    for (std::size_t i = 0; i < whole.size(); i++) {
        const float first = azulejo::random_number(whole.positions(), i, 1);
        const float second = azulejo::random_number(whole.positions(), i, 2);
        CHECK(first >= 0 && first < 1 && second >= 0 && second < 1);
        mean += first;
        both += (first - 0.5) * (second - 0.5);
        bins[static_cast<std::size_t>(16 * first)]++;
        of_place[{whole.positions()[2 * i], whole.positions()[2 * i + 1]}] = first;
    }
    const double count = static_cast<double>(whole.size());
    // Five standard deviations.
    CHECK(count > 20'000 && std::abs(mean / count - 0.5) < 5 * 0.289 / std::sqrt(count));
    CHECK(std::abs(both / count) < 5 / 12.0 / std::sqrt(count));
    for (std::size_t bin : bins) CHECK(std::abs(bin - count / 16) < 5 * std::sqrt(count / 16));
    CHECK(window.size() > 1000);
    for (std::size_t i = 0; i < window.size(); i++) {
        const std::pair place(window.positions()[2 * i], window.positions()[2 * i + 1]);
        CHECK(of_place.at(place) == azulejo::random_number(window.positions(), i, 1));
    }
    const float zeros[] = {0.0f, -0.0f};
    CHECK(azulejo::random_number({zeros, 2, 1}, 0, 7) == azulejo::random_number({zeros, 2, 1}, 1, 7));
    CHECK(azulejo::random_number({zeros, 1, 2}, 0, 7) != azulejo::random_number({zeros, 1, 2}, 0, 8));
}

// Samples that are given: as a set of the library's, as numbers and as arrays.
void given() {
    const azulejo::Context context(2);
    const azulejo::Mesh mesh(positions, indices);
    azulejo::PspOptions options;
    options.radius = 0.1;
    const auto whole = azulejo::psp_sample(context, mesh, options);
    options.set_given(whole);
    CHECK(azulejo::psp_sample(context, mesh, options).size() == 0);
    const std::vector<std::array<float, 3>> centre = {{0.2f, 0.2f, 0.f}};
    const std::vector<double> clearances = {0.35};
    options.set_given(centre, clearances);
    const auto around = azulejo::psp_sample(context, mesh, options);
    CHECK(around.size() > 0 && around.size() < whole.size());
    for (std::size_t i = 0; i < around.size(); i++) {
        const auto xyz = around.positions();
        CHECK(std::hypot(xyz[3 * i] - 0.2, xyz[3 * i + 1] - 0.2, double{xyz[3 * i + 2]}) > 0.349);
    }
    const std::vector<double> two(2);
    CHECK(throws(AZULEJO_ERROR_INVALID_ARGUMENT, "given_clearances: there are 2, and 1 are needed",
                 [&] { options.set_given(centre, two); }));
    const azulejo::Points none;
    CHECK(throws(AZULEJO_ERROR_INVALID_ARGUMENT, "given_positions: the set has 0 coordinates",
                 [&] { options.set_given(none); }));

    azulejo::PspAdaptiveOptions varying;
    const std::vector<float> radii(mesh.vertex_count(), 0.1f);
    varying.set_vertex_radii(radii);
    varying.set_given(centre, clearances);
    CHECK(azulejo::psp_adaptive_sample(context, mesh, varying).size() < whole.size());
}

} // namespace

void classes_of_planes() {
    const azulejo::Context context(1);
    const std::vector<double> own = {0.04, 0.02};
    const azulejo::Classes two = azulejo::classes_radii(own);
    CHECK(two.count == 2 && two.radius(0, 0) == 0.04 && two.radius(0, 1) == two.radius(1, 0));
    azulejo::KdrtOptions options;
    const azulejo::Points points = azulejo::kdrt_sample_classes(context, options, two);
    CHECK(points.classes().size() == points.size() && points.classes()[points.size() - 1] == 1);
    const azulejo::Kdrt plane(context, options, two);
    const azulejo::Points all = plane.window({0, 0}, {1, 1});
    CHECK(std::equal(all.classes().begin(), all.classes().end(), points.classes().begin(), points.classes().end()));

    const std::vector<float> given = {0.5F, 0.5F};
    const std::vector<double> clearances = {0.3, 0.1};
    options.set_given(given, clearances, 2);
    CHECK(azulejo::kdrt_sample_classes(context, options, two).size() < points.size());
    CHECK(throws(AZULEJO_ERROR_INVALID_ARGUMENT, "given_clearances: there are 2, and 1 are needed",
                 [&] { options.set_given(given, clearances); }));
    options.set_given(given, {clearances.data(), 1});
    CHECK(throws(AZULEJO_ERROR_INVALID_ARGUMENT, "given_clearances: there are 1 for each sample, and 2 classes",
                 [&] { azulejo::kdrt_sample_classes(context, options, two); }));
    CHECK(throws(AZULEJO_ERROR_INVALID_ARGUMENT, "given_clearances: there are 1 for each sample, and 2 classes",
                 [&] { azulejo::Kdrt(context, options, two); }));
    azulejo::Classes torn = two;
    torn.radii.pop_back();
    CHECK(throws(AZULEJO_ERROR_INVALID_ARGUMENT, "radii: 3 for 2",
                 [&] { azulejo::kdrt_sample_classes(context, azulejo::KdrtOptions(), torn); }));
    CHECK(throws(AZULEJO_ERROR_INVALID_ARGUMENT, "radii: 3 for 2",
                 [&] { azulejo::Kdrt kept(context, azulejo::KdrtOptions(), torn); }));
}

void edited_planes() {
    const azulejo::Context context(1);
    azulejo::KdrtOptions options;
    options.radius = 0.02;
    azulejo::Plane plane(context, options);
    const azulejo::Points before = plane.points();
    const azulejo::Points erased = plane.erase(azulejo::Region::ball({0, 0.5, 0}, 0.1));
    azulejo::KdrtReport report;
    const azulejo::Points added = plane.refill(3, &report);
    CHECK(erased.size() > 20 && added.size() > 20 && report.samples == plane.points().size());
    CHECK(plane.erase(added.ids()).size() == added.size());
    plane.restore(erased);
    const azulejo::Points after = plane.points();
    CHECK(std::equal(after.ids().begin(), after.ids().end(), before.ids().begin(), before.ids().end()));
    CHECK(std::equal(after.positions().begin(), after.positions().end(), before.positions().begin()));

    const std::vector<float> house = {0.5F, 0.5F};
    const std::vector<double> clearances = {0.2};
    azulejo::Points gone;
    const std::uint64_t id = plane.add_given(house, clearances, &gone);
    CHECK(id == 0 && gone.size() > 100);
    const std::vector<std::uint64_t> ids = {id};
    plane.remove_given(ids);
    const std::vector<double> torn = {0.2, 0.3};
    CHECK(throws(AZULEJO_ERROR_INVALID_ARGUMENT, "clearances: there are 2, and 1 positions",
                 [&] { plane.add_given(house, torn); }));
    const azulejo::Plane placed(context, options, house);
    CHECK(placed.points().size() == 1);
}

int main() {
    spans();
    errors();
    owners();
    handles();
    statuses();
    surfaces();
    several_classes();
    counts();
    windows();
    streams();
    merging();
    thinning();
    masks();
    volumes();
    insides();
    varying_volumes();
    adaptive();
    frames();
    random_numbers();
    given();
    classes_of_planes();
    edited_planes();
    return finish();
}
