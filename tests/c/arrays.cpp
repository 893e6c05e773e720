// azulejo.hpp: arrays, places and domains of many types, and sets that know their dimension.

#include <array>
#include <cstring>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "check.h"
#include "throws.hpp"

namespace {

struct Float3 {
    float x, y, z;
};

// As glm's: numbers under several names.
struct Union3 {
    union {
        float x, r;
    };
    union {
        float y, g;
    };
    union {
        float z, b;
    };
};

// As Eigen's: no names, a constructor, a copy that is not trivial.
class Class3 {
public:
    Class3(float x, float y, float z) : data_{x, y, z} {}
    Class3(const Class3 &other) : data_{other.data_[0], other.data_[1], other.data_[2]} {}
    const float &operator[](int axis) const { return data_[axis]; }

private:
    float data_[3];
};

struct Vertex {
    float u, v;
    Float3 position;
    std::array<float, 3> normal;
    unsigned char colour[4];
};

struct Triangle {
    std::uint32_t a, b, c;
};

const float corners[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
const Triangle triangles[] = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};

template <class T>
std::vector<T> vertices() {
    std::vector<T> result;
    for (const auto &p : corners) result.push_back(T{p[0], p[1], p[2]});
    return result;
}

std::vector<Vertex> interleaved() {
    std::vector<Vertex> result;
    for (const auto &p : corners) result.push_back({9, 9, {p[0], p[1], p[2]}, {0, 0, 1}, {}});
    return result;
}

bool is_ours(const azulejo::Mesh &mesh) {
    return mesh.vertex_count() == 4 && mesh.triangle_count() == 4 &&
           std::memcmp(mesh.positions().data(), corners, sizeof corners) == 0 &&
           std::memcmp(mesh.indices().data(), triangles, sizeof triangles) == 0;
}

void meshes() {
    CHECK(is_ours(azulejo::Mesh(corners, triangles)));
    CHECK(is_ours(azulejo::Mesh(vertices<Float3>(), triangles)));
    CHECK(is_ours(azulejo::Mesh(vertices<std::array<float, 3>>(), std::vector<Triangle>(triangles, triangles + 4))));
    CHECK(is_ours(azulejo::Mesh(vertices<Class3>(), triangles)));
    std::vector<Union3> unions(4);
    std::memcpy(static_cast<void *>(unions.data()), corners, sizeof corners);
    CHECK(is_ours(azulejo::Mesh(unions, triangles)));
    const std::vector<float> flat(&corners[0][0], &corners[0][0] + 12);
    const std::array<std::uint32_t, 12> indices = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
    CHECK(is_ours(azulejo::Mesh(flat, indices)));
    CHECK(is_ours(azulejo::Mesh(azulejo::Span<const float>(flat), azulejo::Span<const std::uint32_t>(indices))));
    CHECK(is_ours(azulejo::Mesh(flat.data(), 4, 3 * sizeof(float), indices.data(), 4)));
    const azulejo::Mesh mesh(flat, indices);
    CHECK(is_ours(azulejo::Mesh(mesh.positions(), mesh.indices())));

    const auto whole = interleaved();
    const azulejo::Mesh strided({whole, &Vertex::position}, triangles);
    CHECK(is_ours(strided) && is_ours(azulejo::Mesh({&whole[0].position.x, 4, sizeof(Vertex)}, triangles)));
    CHECK(strided.with_normals({whole, &Vertex::normal}).has_normals());
    CHECK(is_ours(strided.with_normals(vertices<Float3>(), triangles)));

    CHECK(refused("positions: 11", [&] { azulejo::Mesh(azulejo::Span(flat.data(), 11), indices); }));
    CHECK(refused("indices: 10", [&] { azulejo::Mesh(flat, azulejo::Span(indices.data(), 10)); }));
    CHECK(refused("normals: 2", [&] { mesh.with_normals(azulejo::Span(flat.data(), 2)); }));
    CHECK(refused("normal_indices: 1", [&] { mesh.with_normals(flat, azulejo::Span(indices.data(), 1)); }));
    CHECK(refused("indices: 0", [] { azulejo::Mesh({std::vector<Vertex>(), &Vertex::position}, {}); }));
}

// What is no vertex is none by mistake.
static_assert(azulejo::detail::is_tuple<float[3], float, 3> && azulejo::detail::is_tuple<Union3, float, 3>);
static_assert(!azulejo::detail::is_tuple<Triangle, float, 3> && !azulejo::detail::is_tuple<Float3, std::uint32_t, 3>);
static_assert(!azulejo::detail::is_tuple<Float3, float, 2>);
static_assert(!azulejo::detail::is_tuple<std::array<double, 3>, float, 3>);
static_assert(!azulejo::detail::is_tuple<std::array<int, 3>, std::uint32_t, 3>);
static_assert(!std::is_convertible_v<azulejo::Points, azulejo::Span<const float>>);
static_assert(!std::is_convertible_v<azulejo::Points, azulejo::Triangles>);

struct Vec2 {
    float x, y;
};

// What options and structs keep is made of arrays with a name and of views, not of temporaries with elements.
using KeptPoints = azulejo::Borrowed<azulejo::PlanePoints>;
using KeptNumbers = azulejo::Borrowed<azulejo::Span<const double>>;
template <class Kept, class Owner>
constexpr bool needs_name = std::is_convertible_v<Owner &, Kept> && std::is_convertible_v<const Owner &, Kept> &&
                            !std::is_convertible_v<Owner, Kept> && !std::is_convertible_v<const Owner, Kept>;
static_assert(needs_name<KeptPoints, azulejo::Points> && needs_name<KeptPoints, std::vector<Vec2>>);
static_assert(needs_name<KeptPoints, std::vector<float>> && needs_name<KeptPoints, std::array<float, 4>>);
static_assert(needs_name<KeptNumbers, std::vector<double>> && needs_name<KeptNumbers, std::array<double, 2>>);
static_assert(std::is_convertible_v<azulejo::Positions, KeptPoints> && std::is_convertible_v<float (&)[4], KeptPoints>);
static_assert(std::is_convertible_v<azulejo::PlanePoints, KeptPoints>);
static_assert(std::is_convertible_v<azulejo::Span<const double>, KeptNumbers>);
static_assert(std::is_convertible_v<azulejo::Span<double>, KeptNumbers>);

// Options with arrays that the call must be able to name, and the accessors of temporaries.
template <class Options, class Array, class = void>
constexpr bool takes = false;
template <class Options, class Array>
constexpr bool takes<Options, Array, std::void_t<decltype(std::declval<Options &>().set_given(std::declval<Array>()))>> =
    true;
static_assert(takes<azulejo::KdrtOptions, azulejo::Points &> && !takes<azulejo::KdrtOptions, azulejo::Points>);
static_assert(takes<azulejo::PspOptions, std::vector<float> &> && !takes<azulejo::PspOptions, std::vector<float>>);

template <class Owner, class = void>
constexpr bool shows_positions = false;
template <class Owner>
constexpr bool shows_positions<Owner, std::void_t<decltype(std::declval<Owner>().positions())>> = true;
static_assert(shows_positions<azulejo::Points &> && shows_positions<const azulejo::Points &>);
static_assert(!shows_positions<azulejo::Points> && !shows_positions<azulejo::Mesh>);

// As glm's, which has both.
struct Both2 {
    double x, y;
    const double &operator[](int axis) const { return axis ? y : x; }
};

bool is_pair(const azulejo::Pair &pair) { return pair[0] == 0.25 && pair[1] == 0.5; }

void places() {
    const double array[] = {0.25, 0.5};
    const float floats[] = {0.25f, 0.5f, 7};
    CHECK(is_pair({0.25, 0.5}) && is_pair({0.25f, 0.5}) && is_pair(array) && is_pair(&array[0]));
    CHECK(is_pair(static_cast<const float *>(floats)) && is_pair(std::array<double, 2>{0.25, 0.5}));
    CHECK(is_pair(std::array<float, 2>{0.25f, 0.5f}) && is_pair(std::pair(0.25, 0.5)));
    CHECK(is_pair(std::tuple(0.25f, 0.5)) && is_pair(std::vector<double>(array, array + 2)));
    CHECK(is_pair(Vec2{0.25f, 0.5f}) && is_pair(Both2{0.25, 0.5}));
    const azulejo::Triple triple(Float3{1, 2, 3});
    CHECK(triple[0] == 1 && triple[1] == 2 && triple[2] == 3 && azulejo::Triple(1, 2, 3)[2] == 3);
    static_assert(!std::is_convertible_v<Vec2, azulejo::Triple> && !std::is_convertible_v<double, azulejo::Pair>);
    static_assert(!std::is_default_constructible_v<azulejo::Pair>);
}

void domains() {
    const azulejo::Context context(2);
    azulejo::KdrtOptions options;
    options.radius = 0.05;
    options.set_domain({std::array<double, 2>{-1, 0}, std::pair(2, 1), AZULEJO_BOUNDARY_BOUNDED});
    CHECK(options.domain_min[0] == -1 && options.domain_max[0] == 2 && options.boundary == AZULEJO_BOUNDARY_BOUNDED);
    const auto whole = azulejo::kdrt_sample(context, options);
    const auto window = azulejo::kdrt_sample_window(context, options, {-1, 0}, options.domain_max);
    CHECK(whole.size() > 500 && window.size() == whole.size());
    const Vec2 high = {0.5f, 1};
    const double low[] = {0, 0};
    CHECK(azulejo::kdrt_sample_window(context, options, low, high).size() < whole.size() / 4);

    azulejo::DcrOptions relaxing;
    relaxing.set_domain(options);
    CHECK(relaxing.domain_min[0] == -1 && relaxing.boundary == AZULEJO_BOUNDARY_BOUNDED);
    const azulejo::PlaneSet set{whole, relaxing};
    CHECK(azulejo::plane_measure(context, set).count == whole.size());
    CHECK(azulejo::plane_covering_radius(context, {whole, {{-1, 0}, {2, 1}, AZULEJO_BOUNDARY_BOUNDED}}) < 0.051);
    CHECK(refused("positions", [&] { azulejo::plane_measure(context, {whole}); })); // not of the unit torus
}

// Samples of a mesh are no points of the plane, nor the other way round.
void dimensions() {
    const azulejo::Context context(2);
    azulejo::PspOptions options;
    options.radius = 0.2;
    const azulejo::Mesh mesh(corners, triangles);
    const auto solid = azulejo::psp_sample(context, mesh, options);
    azulejo::KdrtOptions plane;
    plane.radius = 0.1;
    const auto flat = azulejo::kdrt_sample(context, plane);
    CHECK(solid.positions().dimension() == 3 && flat.positions().dimension() == 2);
    CHECK(solid.positions().size() % 6 == 0 || solid.size() % 2 == 1);

    azulejo::Points out;
    const azulejo::Density density{{}, 0, [](const std::array<double, 2> &) { return 1.0; }};
    CHECK(refused("positions: the set has 3 coordinates", [&] { azulejo::dcr_relax(context, {}, solid); }));
    CHECK(refused("positions: the set has 3", [&] { azulejo::dcr_relax(context, {}, solid.positions()); }));
    CHECK(refused("positions: the set has 3", [&] { azulejo::dcr_relax_density(context, {}, density, solid); }));
    CHECK(refused("positions: the set has 3", [&] { azulejo::plane_measure(context, {solid, plane}); }));
    CHECK(refused("positions: the set has 3", [&] { azulejo::plane_smallest_distance(context, {solid}); }));
    CHECK(refused("positions: the set has 3", [&] { azulejo::plane_covering_radius(context, {solid.positions()}); }));
    CHECK(refused("positions: the set has 3", [&] { azulejo::plane_coverage(context, {solid}, 1); }));
    CHECK(refused("positions: the set has 3", [&] { azulejo::plane_nearest_histogram(context, {solid}, 1, 2); }));
    CHECK(refused("positions: the set has 3", [&] { azulejo::plane_radial_distribution(context, {solid}, 1, 2); }));
    CHECK(refused("positions: the set has 3", [&] { azulejo::Spectrum(context, {solid}, 8); }));
    azulejo::KdrtMergeOptions merging;
    merging.radius = 0.1;
    const std::array<azulejo::KdrtMergePiece, 1> pieces = {{{solid, {0, 0}, {1, 1}}}};
    CHECK(refused("positions: the set has 3", [&] { azulejo::kdrt_merge(context, merging, pieces); }));
    CHECK(refused("fixed: the set has 3", [&] { azulejo::kdrt_merge(context, merging, {}, solid); }));

    CHECK(refused("positions: the set has 2", [&] { azulejo::space_smallest_distance(context, flat); }));
    CHECK(refused("positions: the set has 2", [&] { azulejo::mesh_coverage(context, mesh, flat, 1); }));
    CHECK(refused("positions: the set has 2", [&] { azulejo::mesh_uncovered_fraction(context, mesh, flat, 1, 9); }));
    CHECK(refused("positions: the set has 2", [&] { azulejo::Differences(context, mesh, flat, flat, {0, 0, 1}); }));
    CHECK(refused("positions: the set has 2", [&] { azulejo::Mesh(flat, triangles); }));
    CHECK(refused("samples: the set has 2", [&] { azulejo::dcr_surface_relax(context, mesh, {}, flat); }));
    const azulejo::Points none;
    CHECK(refused("positions: the set has 0", [&] { azulejo::plane_measure(context, {none}); }));

    const std::vector<Vec2> pairs = {{0, 0}, {0.5f, 0}, {0, 0.25f}};
    CHECK(azulejo::plane_smallest_distance(context, {pairs}) == 0.25);
    CHECK(azulejo::space_smallest_distance(context, corners) == 1);
}

} // namespace

int main() {
    meshes();
    places();
    domains();
    dimensions();
    return finish();
}
