// azulejo for C++17: azulejo.h with owners instead of handles, arrays and points as C++ programs
// have them, and options that start with their defaults. Header only; copy it beside azulejo.h and
// azulejo/.
//
// The units, ranges, errors and thread rules of a call are documented under the name of the C
// function, which each comment here gives, in a header of azulejo/; what holds for all calls, and a
// table of them, in azulejo.h.
//
// Errors. Every call that can fail has two forms. try_kdrt_sample(.., out) returns a Status and
//   writes `out` on success only; kdrt_sample(..) returns the result and throws an Error. Programs
//   that are compiled without exceptions, or with AZULEJO_NO_EXCEPTIONS defined, have the first
//   form only.
//
// Callbacks are std::functions. An exception that leaves one stops the call, and leaves the call in
//   both of its forms; a call of azulejo.h that has the callback fails instead. Where there are no
//   exceptions, a callback that throws ends the process.
//
// Sections: status, arrays, owners, points, places and domains, instances, options, reports,
//   context, kept planes, mesh, psp, samplers, relaxation, analysis, the throwing forms.

#ifndef AZULEJO_HPP
#define AZULEJO_HPP

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <iterator>
#include <limits>
#include <memory>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "azulejo.h"

#if !defined(__cpp_exceptions) && !defined(AZULEJO_NO_EXCEPTIONS)
#define AZULEJO_NO_EXCEPTIONS
#endif

#ifndef AZULEJO_NO_EXCEPTIONS
#include <exception>
#include <mutex>
#include <stdexcept>
#endif

namespace azulejo {

#ifdef AZULEJO_NO_EXCEPTIONS
// A program may have files with exceptions and files without: their functions differ, and so must
// their symbols.
inline namespace no_exceptions {
#endif

// ---- Status ------------------------------------------------------------------------------------

/// The message of this thread's last failed C call; see azulejo_last_error_message.
inline std::string last_error() {
    std::string message(azulejo_last_error_message(nullptr, 0), '\0');
    azulejo_last_error_message(message.data(), message.size());
    message.resize(message.empty() ? 0 : message.size() - 1); // the NUL
    return message;
}

/// The outcome of a call: a code and, unless that is AZULEJO_OK, a message.
class [[nodiscard]] Status {
public:
    /// AZULEJO_OK.
    Status() noexcept = default;
    /// Of a C call that has just returned this code on this thread, whose message it copies.
    explicit Status(azulejo_status code) : code_(code) {
        if (!ok()) message_ = last_error();
    }
    Status(azulejo_status code, std::string message) : code_(code), message_(std::move(message)) {}

    bool ok() const noexcept { return code_ == AZULEJO_OK; }
    /// AZULEJO_OK or one of the AZULEJO_ERROR_ codes.
    azulejo_status code() const noexcept { return code_; }
    /// The name of the code, such as "AZULEJO_ERROR_BUSY".
    const char *name() const noexcept { return azulejo_status_name(code_); }
    /// The argument that is wrong, its value and its range; empty for AZULEJO_OK.
    const std::string &message() const noexcept { return message_; }

private:
    azulejo_status code_ = AZULEJO_OK;
    std::string message_;
};

#ifndef AZULEJO_NO_EXCEPTIONS
/// A call that failed; what() is the message of its Status.
class Error : public std::runtime_error {
public:
    Error(azulejo_status status, const std::string &message)
        : std::runtime_error(message), status_(status) {}

    /// One of the AZULEJO_ERROR_ codes.
    azulejo_status status() const noexcept { return status_; }

private:
    azulejo_status status_;
};

/// Throws an Error unless the status is AZULEJO_OK.
inline void check(const Status &status) {
    if (!status.ok()) throw Error(status.code(), status.message());
}

/// The same for a C call that has just returned this code on this thread.
inline void check(azulejo_status code) { check(Status(code)); }
#endif

/// The version of the library that the program runs with, to compare with AZULEJO_VERSION; see
/// azulejo_version.
inline std::uint32_t version() noexcept { return azulejo_version(); }

/// azulejo_has_embree.
inline bool has_embree() noexcept { return azulejo_has_embree() != 0; }

// ---- Arrays ------------------------------------------------------------------------------------

/// An array that belongs to another object: a pointer and a size. What accessors return is valid as
/// long as the object that they were called on, which therefore must have a name.
template <class T>
class Span {
public:
    constexpr Span() noexcept = default;
    constexpr Span(T *data, std::size_t size) noexcept : data_(data), size_(size) {}
    template <std::size_t count>
    constexpr Span(T (&array)[count]) noexcept : data_(array), size_(count) {}
    /// Any container with data() and size(), such as std::vector, std::array and std::span.
    template <class C, class = decltype(static_cast<T *>(std::declval<C &>().data()))>
    constexpr Span(C &&container) noexcept : data_(container.data()), size_(container.size()) {}

    constexpr T *data() const noexcept { return data_; }
    constexpr std::size_t size() const noexcept { return size_; }
    constexpr bool empty() const noexcept { return size_ == 0; }
    constexpr T *begin() const noexcept { return data_; }
    constexpr T *end() const noexcept { return data_ + size_; }
    constexpr T &operator[](std::size_t index) const { return data_[index]; }

private:
    T *data_ = nullptr;
    std::size_t size_ = 0;
};

/// The coordinates of samples, which know how many belong to one sample: calls for points of the
/// plane refuse those of a mesh.
class Positions : public Span<const float> {
public:
    constexpr Positions() noexcept = default;
    constexpr Positions(const float *data, std::size_t samples, std::uint32_t dimension) noexcept
        : Span(data, samples * dimension), dimension_(dimension) {}

    /// Coordinates of each sample: 2 or 3, or 0 where there is no set.
    constexpr std::uint32_t dimension() const noexcept { return dimension_; }

private:
    std::uint32_t dimension_ = 0;
};

namespace detail {

/// True if C is a view of elements that belong to another object, such as std::span: its own
/// constness says nothing of theirs.
template <class C, class = void>
inline constexpr bool is_view = false;
template <class C>
inline constexpr bool is_view<C, std::void_t<decltype(std::declval<C &>().data())>> =
    std::is_same_v<decltype(std::declval<C &>().data()),
                   decltype(std::declval<const C &>().data())>;

} // namespace detail

/// A Span or Tuples that is kept beyond a call, in options and structs: it cannot be made of a
/// temporary that owns its elements.
template <class View>
class Borrowed : public View {
public:
    using View::View;
    constexpr Borrowed() noexcept = default;
    constexpr Borrowed(const View &view) noexcept : View(view) {}
    template <class C, std::enable_if_t<!std::is_lvalue_reference_v<C> &&
                                            !detail::is_view<std::remove_cv_t<C>>,
                                        int> = 0>
    Borrowed(C &&temporary) = delete;
};

// ---- Owners ------------------------------------------------------------------------------------

/// Owns a C handle, or none. Owners can be moved, not copied; one that was moved from or made
/// without arguments holds NULL (but see Context), with which accessors return 0 or nothing and
/// calls fail.
template <class C, void (*free)(C *)>
class Owner {
public:
    using Handle = C;

    Owner() noexcept = default;
    /// Adopts a handle, which this object frees.
    explicit Owner(C *handle) noexcept : handle_(handle) {}

    /// The handle, which stays this object's, for calls of azulejo.h.
    C *get() noexcept { return handle_.get(); }
    const C *get() const noexcept { return handle_.get(); }
    /// Gives the handle up to the caller, who frees it. Callbacks that it has (of a Context made by
    /// watch(), of a Psp) stay this object's, which must outlive the handle then.
    [[nodiscard]] C *release() noexcept { return handle_.release(); }
    /// True if there is a handle.
    explicit operator bool() const noexcept { return handle_ != nullptr; }

private:
    struct Free {
        void operator()(C *handle) const noexcept { free(handle); }
    };

    std::unique_ptr<C, Free> handle_;
};

// ---- Points ------------------------------------------------------------------------------------

/// Samples of the plane, of a mesh or of a cuboid; see azulejo_points.
class Points : public Owner<azulejo_points, azulejo_points_free> {
public:
    using Owner::Owner;

    /// The number of samples; see azulejo_points_count.
    std::size_t size() const noexcept { return azulejo_points_count(get()); }
    /// 2 for samples of the plane, 3 for samples of space; see azulejo_points_dimension.
    std::uint32_t dimension() const noexcept { return azulejo_points_dimension(get()); }
    /// dimension() coordinates for each sample; see azulejo_points_positions.
    Positions positions() const & noexcept {
        return {azulejo_points_positions(get()), size(), dimension()};
    }
    Positions positions() const && = delete;
    /// x y z for each sample of a mesh; empty for the plane, as are the next three. See
    /// azulejo_points_normals.
    Span<const float> normals() const & noexcept { return array(azulejo_points_normals(get()), 3); }
    Span<const float> normals() const && = delete;
    /// The mesh's own normals, x y z each; empty if it has none. See
    /// azulejo_points_interpolated_normals.
    Span<const float> interpolated_normals() const & noexcept {
        return array(azulejo_points_interpolated_normals(get()), 3);
    }
    Span<const float> interpolated_normals() const && = delete;
    /// The triangle of each sample; see azulejo_points_triangles.
    Span<const std::uint32_t> triangles() const & noexcept {
        return array(azulejo_points_triangles(get()), 1);
    }
    Span<const std::uint32_t> triangles() const && = delete;
    /// u v for each sample; see azulejo_points_barycentrics.
    Span<const float> barycentrics() const & noexcept {
        return array(azulejo_points_barycentrics(get()), 2);
    }
    Span<const float> barycentrics() const && = delete;
    /// The radius of each sample of psp_adaptive_sample; empty for other sets. See
    /// azulejo_points_radii.
    Span<const double> radii() const & noexcept { return array(azulejo_points_radii(get()), 1); }
    Span<const double> radii() const && = delete;
    /// The rank of each sample of a set in progressive order; empty for other sets. See
    /// azulejo_points_ranks.
    Span<const float> ranks() const & noexcept { return array(azulejo_points_ranks(get()), 1); }
    Span<const float> ranks() const && = delete;
    /// The class of each sample of a set of several; empty for other sets. See
    /// azulejo_points_classes.
    Span<const std::uint32_t> classes() const & noexcept {
        return array(azulejo_points_classes(get()), 1);
    }
    Span<const std::uint32_t> classes() const && = delete;
    /// The id of each sample of a set that is edited; empty for other sets. See
    /// azulejo_points_ids.
    Span<const std::uint64_t> ids() const & noexcept { return array(azulejo_points_ids(get()), 1); }
    Span<const std::uint64_t> ids() const && = delete;

    /// The index of the instance of each sample of psp_sample_instances; see
    /// azulejo_points_instances.
    Span<const std::uint32_t> instances() const & noexcept {
        return array(azulejo_points_instances(get()), 1);
    }
    Span<const std::uint32_t> instances() const && = delete;

private:
    template <class T>
    Span<const T> array(const T *data, std::size_t width) const noexcept {
        return {data, data ? width * size() : 0};
    }
};

namespace detail {

template <class V, class T, class = void>
inline constexpr bool indexes_to = false;
template <class V, class T>
inline constexpr bool indexes_to<V, T, std::void_t<decltype(std::declval<const V &>()[0])>> =
    std::is_same_v<std::decay_t<decltype(std::declval<const V &>()[0])>, T>;

template <class V, class T, class = void>
inline constexpr bool has_x = false;
template <class V, class T>
inline constexpr bool has_x<V, T, std::void_t<decltype(std::declval<const V &>().x)>> =
    std::is_same_v<std::decay_t<decltype(std::declval<const V &>().x)>, T>;

template <class V, class T, class Indices, class = void>
inline constexpr bool made_of = false;
template <class V, class T, std::size_t... i>
inline constexpr bool made_of<V, T, std::index_sequence<i...>,
                              std::void_t<decltype(V{((void)i, std::declval<T>())...})>> = true;

/// True if V is `width` numbers T and nothing else: an array of them, or a struct or class such as
/// { T x, y, z; } that is laid out as one.
template <class V, class T, std::size_t width>
inline constexpr bool is_tuple =
    sizeof(V) == width * sizeof(T) && std::is_standard_layout_v<V> &&
    (indexes_to<V, T> || has_x<V, T> || made_of<V, T, std::make_index_sequence<width>>);

/// The element type of a container or a C array.
template <class Container>
using Element = std::remove_cv_t<
    std::remove_pointer_t<decltype(std::data(std::declval<const Container &>()))>>;

} // namespace detail

/// An array of points, triangles and the like, `width` numbers T each, that belongs to the caller:
/// made of a container or C array of such numbers, or of any type that consists of `width` of them
/// (std::array, { T x, y, z; }, glm::vec3 ..). Where T is float, it can be made of Points, whose
/// dimension is checked by the call.
template <class T, std::size_t width>
class Tuples {
public:
    constexpr Tuples() noexcept = default;

    /// `size` tuples of packed numbers.
    constexpr Tuples(const T *data, std::size_t size) noexcept : data_(data), size_(size) {}

    template <class Container, class Element = detail::Element<Container>,
              class = decltype(std::size(std::declval<const Container &>()))>
    Tuples(const Container &container) noexcept {
        constexpr bool is_tuple = detail::is_tuple<Element, T, width>;
        static_assert(is_tuple || std::is_same_v<Element, T>,
                      "an element must be a number of the right type, or a standard-layout type "
                      "that consists of as many of them as are needed");
        data_ = reinterpret_cast<const T *>(std::data(container));
        size_ = is_tuple ? std::size(container) : std::size(container) / width;
        rest_ = is_tuple ? 0 : std::size(container) % width;
    }

    template <class U = T, class = std::enable_if_t<std::is_same_v<U, float>>>
    Tuples(const Positions &positions) noexcept
        : data_(positions.data()), size_(positions.size() / width),
          dimension_(positions.dimension()) {}

    template <class U = T, class = std::enable_if_t<std::is_same_v<U, float>>>
    Tuples(const Points &points) noexcept : Tuples(points.positions()) {}

    constexpr const T *data() const noexcept { return data_; }
    /// The number of tuples.
    constexpr std::size_t size() const noexcept { return size_; }

    /// Refuses samples of another dimension and numbers that do not add up to tuples, by the name
    /// of the argument.
    Status check(const char *argument) const {
        if (dimension_ != width) {
            return refusal(argument, "the set has " + std::to_string(dimension_) +
                                         " coordinates for each sample, and " +
                                         std::to_string(width) + " are needed");
        }
        if (rest_ != 0) {
            return refusal(argument, std::to_string(width * size_ + rest_) +
                                         " numbers are not a multiple of " + std::to_string(width));
        }
        return Status();
    }

private:
    static Status refusal(const char *argument, const std::string &reason) {
        return Status(AZULEJO_ERROR_INVALID_ARGUMENT, argument + (": " + reason));
    }

    const T *data_ = nullptr;
    std::size_t size_ = 0;
    std::size_t rest_ = 0;
    std::size_t dimension_ = width;
};

/// Points of the plane, x y each: numbers, pairs, or a set of the plane.
using PlanePoints = Tuples<float, 2>;
/// Points of space, x y z each: numbers, triples, or a set on a mesh.
using SpacePoints = Tuples<float, 3>;
/// Triangles, three indices each: numbers or triples.
using Triangles = Tuples<std::uint32_t, 3>;

/// The vertices or normals of a mesh, which belong to the caller: what SpacePoints can be made of,
/// or a member of larger vertices.
class Vertices {
public:
    template <class Source,
              class = std::enable_if_t<std::is_convertible_v<const Source &, SpacePoints>>>
    Vertices(const Source &source) noexcept : points_(source) {}

    /// `count` times x y z, one `stride_bytes` after the other.
    Vertices(const float *first, std::size_t count, std::size_t stride_bytes) noexcept
        : points_(first, count), stride_(stride_bytes) {}

    /// A member of each vertex in a container or C array: Vertices(vertices, &Vertex::position).
    template <class Container, class Vertex, class Member>
    Vertices(const Container &vertices, Member Vertex::*member) noexcept
        : stride_(sizeof(detail::Element<Container>)) {
        static_assert(detail::is_tuple<Member, float, 3>,
                      "the member must consist of three floats");
        static_assert(std::is_base_of_v<Vertex, detail::Element<Container>>,
                      "the member must be one of the container's elements");
        if (std::size(vertices) != 0) {
            const auto *first = &(std::data(vertices)->*member);
            points_ = {reinterpret_cast<const float *>(first), std::size(vertices)};
        }
    }

    const float *data() const noexcept { return points_.data(); }
    std::size_t size() const noexcept { return points_.size(); }
    std::size_t stride() const noexcept { return stride_; }
    /// As Tuples::check.
    Status check(const char *argument) const { return points_.check(argument); }

private:
    SpacePoints points_;
    std::size_t stride_ = 3 * sizeof(float);
};

// ---- Places and domains ------------------------------------------------------------------------

namespace detail {

template <class P, class = void>
inline constexpr std::size_t tuple_size = 0;
template <class P>
inline constexpr std::size_t tuple_size<P, std::void_t<decltype(std::tuple_size<P>::value)>> =
    std::tuple_size<P>::value;

template <class P, class = void>
inline constexpr bool is_indexed = false;
template <class P>
inline constexpr bool
    is_indexed<P, std::void_t<decltype(static_cast<double>(std::declval<const P &>()[0]))>> = true;

template <class P, class = void>
inline constexpr bool has_y = false;
template <class P>
inline constexpr bool
    has_y<P, std::void_t<decltype(static_cast<double>(std::declval<const P &>().x +
                                                      std::declval<const P &>().y))>> = true;

template <class P, class = void>
inline constexpr bool has_z = false;
template <class P>
inline constexpr bool
    has_z<P, std::void_t<decltype(static_cast<double>(std::declval<const P &>().z))>> = true;

/// True if P has x and y, and z just where there are three coordinates.
template <class P, std::size_t width>
inline constexpr bool is_named = has_y<P> && has_z<P> == (width == 3);

} // namespace detail

/// A place, a corner or a direction of `width` numbers. Made of {0, 1}, std::array, std::pair, C
/// arrays, pointers, and what has [] or x, y (z).
template <std::size_t width>
class Coordinates {
public:
    template <class... Numbers, class = std::enable_if_t<sizeof...(Numbers) == width &&
                                                         (std::is_arithmetic_v<Numbers> && ...)>>
    constexpr Coordinates(Numbers... numbers) noexcept : values_{static_cast<double>(numbers)...} {}

    template <class P,
              class = std::enable_if_t<detail::tuple_size<P> != 0 || detail::is_indexed<P> ||
                                       detail::is_named<P, width>>>
    constexpr Coordinates(const P &place) {
        constexpr std::size_t known = std::is_array_v<P> ? std::extent_v<P> : detail::tuple_size<P>;
        static_assert(known == 0 || known == width, "a place with another number of coordinates");
        read(place, std::make_index_sequence<width>());
    }

    constexpr const double *data() const noexcept { return values_; }
    constexpr double operator[](std::size_t axis) const { return values_[axis]; }

private:
    template <class P, std::size_t... i>
    constexpr void read(const P &place, std::index_sequence<i...>) {
        if constexpr (detail::tuple_size<P> != 0) {
            ((values_[i] = static_cast<double>(std::get<i>(place))), ...);
        } else if constexpr (detail::is_indexed<P>) {
            ((values_[i] = static_cast<double>(place[i])), ...);
        } else {
            values_[0] = static_cast<double>(place.x);
            values_[1] = static_cast<double>(place.y);
            if constexpr (width == 3) values_[2] = static_cast<double>(place.z);
        }
    }

    double values_[width] = {};
};

using Pair = Coordinates<2>;
using Triple = Coordinates<3>;

/// A rectangle and its AZULEJO_BOUNDARY_: the unit torus unless told otherwise.
struct Domain {
    Pair min{0, 0};
    Pair max{1, 1};
    std::uint32_t boundary = AZULEJO_BOUNDARY_PERIODIC;

    Domain() = default;
    Domain(Pair low, Pair high, std::uint32_t boundary_kind = AZULEJO_BOUNDARY_PERIODIC)
        : min(low), max(high), boundary(boundary_kind) {}
    /// That of the options that a set was made with.
    template <class Options, class = decltype(std::declval<const Options &>().domain_min)>
    Domain(const Options &options)
        : min(options.domain_min), max(options.domain_max), boundary(options.boundary) {}
};

/// A cuboid and its AZULEJO_BOUNDARY_: the unit torus unless told otherwise.
struct Cuboid {
    Triple min{0, 0, 0};
    Triple max{1, 1, 1};
    std::uint32_t boundary = AZULEJO_BOUNDARY_PERIODIC;

    Cuboid() = default;
    Cuboid(Triple low, Triple high, std::uint32_t boundary_kind = AZULEJO_BOUNDARY_PERIODIC)
        : min(low), max(high), boundary(boundary_kind) {}
    /// That of the options that a set was made with.
    template <class Options, class = decltype(std::declval<const Options &>().domain_min)>
    Cuboid(const Options &options)
        : min(options.domain_min), max(options.domain_max), boundary(options.boundary) {}
};

/// Points of the plane and where they lie, such as {points, options}; see azulejo_plane_set. The
/// points stay the caller's.
struct PlaneSet {
    Borrowed<PlanePoints> positions;
    Domain domain{};
};

/// Points of a cuboid and where they lie, such as {points, options}; see azulejo_space_set. The
/// points stay the caller's.
struct SpaceSet {
    Borrowed<SpacePoints> positions;
    Cuboid domain{};
};

// ---- Instances ---------------------------------------------------------------------------------

/// Three directions of unit length, at right angles, of which the third is tangent x bitangent.
struct Frame {
    std::array<float, 3> tangent;
    std::array<float, 3> bitangent;
    std::array<float, 3> normal;
};

/// A frame for an instance that stands along a normal, such as `&points.normals()[3 * i]`, of any
/// length but 0. It is continuous in the normal, except where z changes its sign. As by T. Duff et
/// al., Building an Orthonormal Basis, Revisited, JCGT 6(1), 2017.
inline Frame frame(const Triple &direction) noexcept {
    const double *n = direction.data();
    const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    const double x = n[0] / length, y = n[1] / length, z = n[2] / length;
    const double sign = std::copysign(1.0, z), a = -1 / (sign + z), b = x * y * a;
    const auto floats = [](double u, double v, double w) {
        return std::array<float, 3>{static_cast<float>(u), static_cast<float>(v),
                                    static_cast<float>(w)};
    };
    return {floats(1 + sign * x * x * a, sign * b, -sign * x), floats(b, sign + y * y * a, -y),
            floats(x, y, z)};
}

/// A number of [0, 1) for sample `index`, such as the turn, size or kind of an instance. It depends
/// on the seed and on the sample's position alone: it is the same in every window, and stays when
/// other samples are erased. Seeds give independent numbers.
inline float random_number(const Positions &positions, std::size_t index,
                           std::uint64_t seed) noexcept {
    // SplitMix64: G. L. Steele et al., Fast Splittable Pseudorandom Number Generators, OOPSLA 2014.
    std::uint64_t state = seed;
    const auto mix = [&state](std::uint64_t value) {
        state = (state ^ value) + 0x9e3779b97f4a7c15;
        state = (state ^ (state >> 30)) * 0xbf58476d1ce4e5b9;
        state = (state ^ (state >> 27)) * 0x94d049bb133111eb;
        state ^= state >> 31;
    };
    for (std::size_t axis = 0; axis < positions.dimension(); axis++) {
        const float coordinate = positions[index * positions.dimension() + axis] + 0.0f; // not -0
        std::uint32_t bits = 0;
        std::memcpy(&bits, &coordinate, sizeof bits);
        mix(bits);
    }
    return static_cast<float>(state >> 40) * 0x1p-24f;
}

// ---- Callbacks ---------------------------------------------------------------------------------

/// Called on the calling thread with the completed share of the call, from 0 to 1; returns whether
/// to go on. See azulejo_progress_fn.
using Progress = std::function<bool(double done)>;

/// Called on the calling thread with some of the samples, which are valid until it returns; returns
/// whether to go on. See azulejo_kdrt_visit_fn.
using KdrtVisitor = std::function<bool(Positions positions)>;

/// Gives the radius at a place of a mesh. Called on the library's threads, several at once; see
/// azulejo_radius_fn.
using RadiusFunction = std::function<double(const std::array<double, 3> &position)>;

/// Gives the density at a place of the plane. Called on the library's threads, several at once; see
/// azulejo_density_fn.
using DensityFunction = std::function<double(const std::array<double, 2> &position)>;

namespace detail {

#ifndef AZULEJO_NO_EXCEPTIONS

/// The exception that left a callback during a call on this thread, until the call returns. A
/// callback may make calls, too: each keeps its own.
class Caught {
public:
    Caught() : outer_(std::exchange(slot(), nullptr)) {}
    Caught(const Caught &) = delete;
    Caught &operator=(const Caught &) = delete;
    ~Caught() { slot() = outer_; }

    static void keep(std::exception_ptr exception) noexcept { slot() = std::move(exception); }

    void rethrow() {
        if (slot()) std::rethrow_exception(std::exchange(slot(), nullptr));
    }

private:
    static std::exception_ptr &slot() noexcept {
        static thread_local std::exception_ptr exception;
        return exception;
    }

    std::exception_ptr outer_;
};

/// Runs a callback where C called it: 0 to go on, 1 to stop.
template <class Function>
std::uint32_t guarded(Function function) noexcept {
    try {
        return function() ? 0 : 1;
    } catch (...) {
        Caught::keep(std::current_exception());
        return 1;
    }
}

/// Keeps the first exception of a function that several threads call.
class Thrown {
public:
    /// NaN, which fails the call, where the function throws.
    template <class Function>
    double guarded(Function function) noexcept {
        try {
            return function();
        } catch (...) {
            const std::lock_guard<std::mutex> guard(lock_);
            if (!exception_) exception_ = std::current_exception();
            return std::numeric_limits<double>::quiet_NaN();
        }
    }

    /// On the thread that made the call, once that has returned.
    void hand_over() noexcept {
        if (exception_) Caught::keep(exception_);
    }

private:
    std::mutex lock_;
    std::exception_ptr exception_;
};

#else

struct Caught {
    void rethrow() noexcept {}
};

template <class Function>
std::uint32_t guarded(Function function) noexcept {
    return function() ? 0 : 1;
}

struct Thrown {
    template <class Function>
    double guarded(Function function) noexcept {
        return function();
    }

    void hand_over() noexcept {}
};

#endif

/// An azulejo_progress_fn whose user is a Progress.
inline std::uint32_t tell(void *user, double done) noexcept {
    return guarded([&] { return (*static_cast<const Progress *>(user))(done); });
}

/// A function of a place as C calls it, and what it has thrown.
template <std::size_t dimension>
class Field {
public:
    using Function = std::function<double(const std::array<double, dimension> &)>;

    explicit Field(const Function &function) noexcept : function_(&function) {}
    /// The same function for one call, so that calls at the same time keep their exceptions apart.
    explicit Field(const Field &field) noexcept : function_(field.function_) {}
    Field &operator=(const Field &) = delete;

    static double call(void *user, const double *position) noexcept {
        auto *field = static_cast<Field *>(user);
        return field->thrown_.guarded([&] {
            std::array<double, dimension> place;
            std::copy_n(position, dimension, place.begin());
            return (*field->function_)(place);
        });
    }

    /// Passes a status on, and an exception to the call's Caught.
    azulejo_status after(azulejo_status status) noexcept {
        thrown_.hand_over();
        return status;
    }

private:
    const Function *function_;
    Thrown thrown_;
};

/// Makes a C call; exceptions of its callbacks go on from here.
template <class Call>
Status run(Call call) {
    Caught caught;
    Status status(call());
    caught.rethrow();
    return status;
}

/// Makes a C call that writes a handle, for an owner. A relaxation that its callback stopped has a
/// handle all the same: it is owned before the exception goes on.
template <class Owner, class Call>
Status make(Owner &out, Call call) {
    Caught caught;
    typename Owner::Handle *handle = nullptr;
    Status status(call(&handle));
    Owner made(handle);
    caught.rethrow();
    if (status.ok()) out = std::move(made);
    return status;
}

} // namespace detail

// ---- Options -----------------------------------------------------------------------------------

/// The options of a call: the C struct, filled with its defaults. They can be handed to calls of
/// azulejo.h; functions and arrays are set by the functions below, into fields of the C struct.
template <class C, azulejo_status (*init)(C *, std::size_t)>
class Options : public C {
public:
    // Cannot fail: the struct has the size that this header gives it.
    Options() noexcept : C() { (void)init(this, sizeof(C)); }

    /// Sets `progress` and `progress_user`; an empty function unsets them. Copies share the
    /// function, which must be safe to call from all threads that use them. It lives as long as one
    /// of them.
    void set_progress(Progress function) {
        progress_ = function ? std::make_shared<Progress>(std::move(function)) : nullptr;
        this->progress = progress_ ? &detail::tell : nullptr;
        this->progress_user = progress_.get();
    }

private:
    friend class Plane;
    friend class Psp;

    std::shared_ptr<Progress> progress_;
};

/// Options with a domain.
template <class C, azulejo_status (*init)(C *, std::size_t)>
class PlaneOptions : public Options<C, init> {
public:
    /// Sets `domain_min`, `domain_max` and `boundary`.
    void set_domain(const Domain &domain) noexcept {
        std::copy_n(domain.min.data(), 2, this->domain_min);
        std::copy_n(domain.max.data(), 2, this->domain_max);
        this->boundary = domain.boundary;
    }
};

namespace detail {

/// Sets the given samples of options, on success only. `clearances` may be null: all samples have
/// the radius of the set.
template <class C, std::size_t width>
Status try_set_given(C &options, const Tuples<float, width> &positions,
                     const Span<const double> *clearances, std::size_t classes) {
    if (Status s = positions.check("given_positions"); !s.ok()) return s;
    if (classes == 0) return Status(AZULEJO_ERROR_INVALID_ARGUMENT, "classes: 0 is not at least 1");
    const std::size_t count = positions.size() * classes;
    if (clearances != nullptr && clearances->size() != count) {
        return Status(AZULEJO_ERROR_INVALID_ARGUMENT,
                      "given_clearances: there are " + std::to_string(clearances->size()) +
                          ", and " + std::to_string(count) + " are needed");
    }
    options.given_positions = positions.data();
    options.given_clearances = clearances != nullptr ? clearances->data() : nullptr;
    options.given_count = positions.size();
    return Status();
}

} // namespace detail

/// Options with given samples, which stay the caller's.
template <class Options, std::size_t width>
class GivenOptions : public Options {
public:
    /// Sets samples that have the radius of the set, or of each class, as their clearance.
    Status try_set_given(const Borrowed<Tuples<float, width>> &positions) {
        Status status = detail::try_set_given(*this, positions, nullptr, 1);
        if (status.ok()) classes_ = 0;
        return status;
    }

    /// Sets samples with clearances: one for each or, for a set of several classes, a row of one
    /// for each class.
    Status try_set_given(const Borrowed<Tuples<float, width>> &positions,
                         const Borrowed<Span<const double>> &clearances,
                         std::uint32_t classes = 1) {
        Status status = detail::try_set_given(*this, positions, &clearances, classes);
        if (status.ok()) classes_ = classes;
        return status;
    }

    /// Refuses clearances that were set for another number of classes.
    Status check_given(std::uint32_t classes) const {
        if (this->given_clearances == nullptr || classes_ == 0 || classes_ == classes) {
            return Status();
        }
        return Status(AZULEJO_ERROR_INVALID_ARGUMENT,
                      "given_clearances: there are " + std::to_string(classes_) +
                          " for each sample, and " + std::to_string(classes) + " classes");
    }

#ifndef AZULEJO_NO_EXCEPTIONS
    void set_given(const Borrowed<Tuples<float, width>> &positions) {
        check(try_set_given(positions));
    }

    void set_given(const Borrowed<Tuples<float, width>> &positions,
                   const Borrowed<Span<const double>> &clearances, std::uint32_t classes = 1) {
        check(try_set_given(positions, clearances, classes));
    }
#endif

private:
    /// Clearances of each sample; 0 if they were not set here, but as fields of the C struct.
    std::uint32_t classes_ = 0;
};

/// See azulejo_kdrt_options; `radius` or `count` is to be set.
using KdrtOptions =
    GivenOptions<PlaneOptions<azulejo_kdrt_options, azulejo_kdrt_options_init>, 2>;
/// See azulejo_kdrt_merge_options; `radius` has no default.
using KdrtMergeOptions = PlaneOptions<azulejo_kdrt_merge_options, azulejo_kdrt_merge_options_init>;
/// See azulejo_maximal_options; `radius` has no default.
using MaximalOptions = PlaneOptions<azulejo_maximal_options, azulejo_maximal_options_init>;
/// See azulejo_psp_options; `radius` or `count` is to be set.
using PspOptions = GivenOptions<Options<azulejo_psp_options, azulejo_psp_options_init>, 3>;
/// See azulejo_dcr_options.
using DcrOptions = PlaneOptions<azulejo_dcr_options, azulejo_dcr_options_init>;
/// See azulejo_dcr_surface_options.
using DcrSurfaceOptions = Options<azulejo_dcr_surface_options, azulejo_dcr_surface_options_init>;
/// See azulejo_volume_options; `radius` or `count` is to be set.
using VolumeOptions =
    GivenOptions<Options<azulejo_volume_options, azulejo_volume_options_init>, 3>;
/// See azulejo_volume_inside_options; `radius` or `count` is to be set.
using VolumeInsideOptions =
    GivenOptions<Options<azulejo_volume_inside_options, azulejo_volume_inside_options_init>, 3>;
/// See azulejo_volume_relax_options.
using VolumeRelaxOptions =
    Options<azulejo_volume_relax_options, azulejo_volume_relax_options_init>;
/// See azulejo_relax_inside_options; `fixed` and `sliding` must stay valid until the call
/// returns.
using VolumeRelaxInsideOptions =
    Options<azulejo_relax_inside_options, azulejo_relax_inside_options_init>;
/// See azulejo_mask_options; `width` and `height` have no defaults.
using MaskOptions = Options<azulejo_mask_options, azulejo_mask_options_init>;
/// See azulejo_thin_options; `radius`, `count` or `order` is to be set.
using ThinOptions = Options<azulejo_thin_options, azulejo_thin_options_init>;

namespace detail {
/// A function of the radius that options own; copies of them share it.
class OwnRadius {
public:
    template <typename Options> void set(Options &options, RadiusFunction function) {
        function_ = function ? std::make_shared<Function>(std::move(function)) : nullptr;
        options.radius_function = function_ ? &Field<3>::call : nullptr;
        options.radius_function_user = function_ ? &function_->field : nullptr;
    }

private:
    struct Function {
        explicit Function(RadiusFunction f) : function(std::move(f)) {}

        RadiusFunction function;
        Field<3> field{function};
    };

    std::shared_ptr<Function> function_;
};
} // namespace detail

/// See azulejo_psp_adaptive_options; the radii of the vertices or a function is to be set.
class PspAdaptiveOptions
    : public Options<azulejo_psp_adaptive_options, azulejo_psp_adaptive_options_init> {
public:
    /// Sets `vertex_radii` and `vertex_count`; the radii stay the caller's.
    void set_vertex_radii(const Borrowed<Span<const float>> &radii) noexcept {
        vertex_radii = radii.data();
        vertex_count = radii.size();
    }

    /// Sets the samples that are given, which stay the caller's, with one clearance each.
    Status try_set_given(const Borrowed<SpacePoints> &positions,
                         const Borrowed<Span<const double>> &clearances) {
        return detail::try_set_given(*this, positions, &clearances, 1);
    }

#ifndef AZULEJO_NO_EXCEPTIONS
    void set_given(const Borrowed<SpacePoints> &positions,
                   const Borrowed<Span<const double>> &clearances) {
        check(try_set_given(positions, clearances));
    }
#endif

    /// Sets `radius_function` and its user pointer; an empty function unsets them. Copies share it
    /// as set_progress says.
    void set_radius(RadiusFunction function) { function_.set(*this, std::move(function)); }

private:
    detail::OwnRadius function_;
};

/// See azulejo_volume_adaptive_options; the radii on a grid or a function is to be set.
class VolumeAdaptiveOptions
    : public Options<azulejo_volume_adaptive_options, azulejo_volume_adaptive_options_init> {
public:
    /// Sets `grid_values`, which stay the caller's, and `grid_size`, whose product is their number.
    Status try_set_grid(const Borrowed<Span<const float>> &values,
                        const std::array<std::size_t, 3> &size) {
        if (size[0] == 0 || size[1] == 0 || values.size() % size[0] != 0 ||
            values.size() / size[0] % size[1] != 0 ||
            values.size() / size[0] / size[1] != size[2]) {
            return Status(AZULEJO_ERROR_INVALID_ARGUMENT,
                          "grid_size: not that of " + std::to_string(values.size()) + " values");
        }
        grid_values = values.data();
        std::copy(size.begin(), size.end(), grid_size);
        return {};
    }

#ifndef AZULEJO_NO_EXCEPTIONS
    void set_grid(const Borrowed<Span<const float>> &values,
                  const std::array<std::size_t, 3> &size) {
        check(try_set_grid(values, size));
    }
#endif

    /// As PspAdaptiveOptions::set_radius.
    void set_radius(RadiusFunction function) { function_.set(*this, std::move(function)); }

private:
    detail::OwnRadius function_;
};

/// The density of points; see azulejo_density. Either an image of `width` pixels a row, which
/// stays the caller's, or a function.
struct Density {
    Borrowed<Span<const float>> values{};
    std::size_t width = 0;
    DensityFunction function{};
};

/// The density of samples of a mesh; see azulejo_mesh_density. One of `vertex_values`,
/// `function` and `image` is to be set, and one of `radius` and `count`. Arrays stay the caller's.
struct MeshDensity {
    Borrowed<Span<const float>> vertex_values{};
    RadiusFunction function{};
    bool at_vertices = false;
    double largest = 0;
    double slope = 0;
    Borrowed<Span<const float>> image{};
    std::size_t width = 0;
    Borrowed<PlanePoints> texture{};
    bool by_corners = false;
    double radius = 0;
    double count = 0;
};

/// Classes of samples, and how far apart they are; see azulejo_classes. classes_radii makes those
/// of own radii.
struct Classes {
    std::uint32_t count = 0;
    /// count * count radii, row by row.
    std::vector<double> radii{};
    /// The triangles on which each class may stand; empty for everywhere. They stay the caller's.
    Borrowed<Span<const std::uint32_t>> masks{};

    /// The smallest distance between samples of two classes.
    double radius(std::uint32_t i, std::uint32_t j) const {
        return radii[std::size_t{i} * count + j];
    }
};

/// Makes classes of own radii, with Wei's cross radii times a factor; see azulejo_classes_radii.
inline Status try_classes_radii(Span<const double> own, double factor, Classes &out) {
    if (own.empty() || own.size() > AZULEJO_MAX_CLASSES) {
        return Status(AZULEJO_ERROR_INVALID_ARGUMENT,
                      "own: " + std::to_string(own.size()) + " radii; there are 1 to " +
                          std::to_string(AZULEJO_MAX_CLASSES));
    }
    std::vector<double> radii(own.size() * own.size());
    const auto count = static_cast<std::uint32_t>(own.size());
    const Status status(azulejo_classes_radii(own.data(), count, factor, radii.data()));
    if (status.ok()) out = {count, std::move(radii), {}};
    return status;
}

namespace detail {

/// Calls with the C struct of classes; refuses options whose clearances are for another number.
template <class Options, class Call>
Status with_classes(const Options &options, const Classes &classes, Call call) {
    if (Status s = options.check_given(classes.count); !s.ok()) return s;
    azulejo_classes wanted = {};
    if (Status s{azulejo_classes_init(&wanted, sizeof wanted)}; !s.ok()) return s;
    if (classes.radii.size() != std::size_t{classes.count} * classes.count) {
        return Status(AZULEJO_ERROR_INVALID_ARGUMENT,
                      "radii: " + std::to_string(classes.radii.size()) + " for " +
                          std::to_string(classes.count) + " classes");
    }
    wanted.count = classes.count;
    wanted.radii = classes.radii.data();
    wanted.masks = classes.masks.data();
    wanted.mask_count = classes.masks.size();
    return call(wanted);
}

} // namespace detail

// ---- Reports -----------------------------------------------------------------------------------

/// The report of a call: the C struct, initialised.
template <class C, azulejo_status (*init)(C *, std::size_t)>
struct Report : C {
    // Cannot fail: the struct has the size that this header gives it.
    Report() noexcept : C() { (void)init(this, sizeof(C)); }
};

using KdrtReport = Report<azulejo_kdrt_report, azulejo_kdrt_report_init>;
using ClassesReport = Report<azulejo_classes_report, azulejo_classes_report_init>;
using VolumeReport = Report<azulejo_volume_report, azulejo_volume_report_init>;
using VolumeInsideReport =
    Report<azulejo_volume_inside_report, azulejo_volume_inside_report_init>;
using VolumeRelaxReport = Report<azulejo_volume_relax_report, azulejo_volume_relax_report_init>;
using MaskReport = Report<azulejo_mask_report, azulejo_mask_report_init>;
using ThinReport = Report<azulejo_thin_report, azulejo_thin_report_init>;
using KdrtMergeReport = Report<azulejo_kdrt_merge_report, azulejo_kdrt_merge_report_init>;
using PspReport = Report<azulejo_psp_report, azulejo_psp_report_init>;
using DcrReport = Report<azulejo_dcr_report, azulejo_dcr_report_init>;
using DcrSurfaceReport = Report<azulejo_dcr_surface_report, azulejo_dcr_surface_report_init>;
using DcrRemeshReport = Report<azulejo_dcr_remesh_report, azulejo_dcr_remesh_report_init>;
using PlaneReport = Report<azulejo_plane_report, azulejo_plane_report_init>;
using SpaceReport = Report<azulejo_space_report, azulejo_space_report_init>;
using SpectrumReport = Report<azulejo_spectrum_report, azulejo_spectrum_report_init>;
using CoverageReport = Report<azulejo_coverage_report, azulejo_coverage_report_init>;
using Annulus = azulejo_annulus;

// ---- Context -----------------------------------------------------------------------------------

/// The threads that calls run on; see azulejo_context.
class Context : public Owner<azulejo_context, azulejo_context_free> {
public:
#ifndef AZULEJO_NO_EXCEPTIONS
    /// One thread per core, or as many as given; see azulejo_context_create. Context(nullptr) holds
    /// NULL.
    explicit Context(std::uint32_t num_threads = 0) { check(try_create(num_threads, *this)); }
#else
    /// Holds NULL.
    Context() noexcept = default;
#endif

    /// Adopts a handle. A template, so that Context(0) is a number of threads.
    template <class Pointer,
              class = std::enable_if_t<std::is_convertible_v<Pointer, azulejo_context *>>>
    explicit Context(Pointer handle) noexcept : Owner(handle) {}

    /// See azulejo_context_create.
    static Status try_create(std::uint32_t num_threads, Context &out) {
        return detail::make(out, [&](auto **c) { return azulejo_context_create(num_threads, c); });
    }

    /// A context with the same threads whose calls report to this function, unless their options
    /// have one: plane_measure(context.watch(..), ..). See azulejo_context_watch. An empty function
    /// watches nothing.
    Status try_watch(Progress function, Context &out) const {
        auto progress = function ? std::make_shared<Progress>(std::move(function)) : nullptr;
        Status status = detail::make(out, [&](auto **c) {
            return azulejo_context_watch(get(), progress ? &detail::tell : nullptr, progress.get(),
                                         c);
        });
        if (status.ok()) out.progress_ = std::move(progress);
        return status;
    }

#ifndef AZULEJO_NO_EXCEPTIONS
    Context watch(Progress function) const {
        Context watched(nullptr);
        check(try_watch(std::move(function), watched));
        return watched;
    }
#endif

    /// See azulejo_context_num_threads.
    std::uint32_t num_threads() const noexcept { return azulejo_context_num_threads(get()); }

private:
    friend class Plane;
    friend class Psp;

    std::shared_ptr<Progress> progress_;
};

// ---- Kept planes -------------------------------------------------------------------------------

/// A plane of which any window can be made at any time; see azulejo_kdrt. Threads may share it.
class Kdrt : public Owner<azulejo_kdrt, azulejo_kdrt_free> {
public:
    using Owner::Owner;
    Kdrt() noexcept = default;

    /// See azulejo_kdrt_create.
    static Status try_create(const Context &context, const KdrtOptions &options, Kdrt &out) {
        return detail::make(out, [&](auto **plane) {
            return azulejo_kdrt_create(context.get(), &options, plane);
        });
    }

    /// A plane of a million radii a side and more; see azulejo_kdrt_create_wide.
    static Status try_create_wide(const Context &context, const KdrtOptions &options, Kdrt &out) {
        return detail::make(out, [&](auto **plane) {
            return azulejo_kdrt_create_wide(context.get(), &options, plane);
        });
    }

    /// A plane of several classes; see azulejo_kdrt_create_classes.
    static Status try_create(const Context &context, const KdrtOptions &options,
                             const Classes &classes, Kdrt &out) {
        return detail::with_classes(options, classes, [&](const azulejo_classes &wanted) {
            return detail::make(out, [&](auto **plane) {
                return azulejo_kdrt_create_classes(context.get(), &options, &wanted, plane);
            });
        });
    }

    /// The samples in a window, made on the calling thread; see azulejo_kdrt_window.
    Status try_window(const Pair &window_min, const Pair &window_max, Points &out) const {
        return detail::make(out, [&](auto **points) {
            return azulejo_kdrt_window(get(), window_min.data(), window_max.data(), points);
        });
    }

    /// Writes the samples of a window, relative to window_min, into arrays of the caller: x y each,
    /// and ranks and classes for as many samples, if they are wanted. `count` is the number of
    /// samples, also where the arrays are too small; see azulejo_kdrt_window_into.
    Status try_window_into(const Pair &window_min, const Pair &window_max, Span<float> positions,
                           std::size_t &count, Span<float> ranks = {},
                           Span<std::uint32_t> classes = {}) const {
        const std::size_t capacity = positions.size() / 2;
        const auto is_short = [&](const auto &array) {
            return !array.empty() && array.size() < capacity;
        };
        if (is_short(ranks) || is_short(classes)) {
            return Status(AZULEJO_ERROR_INVALID_ARGUMENT,
                          std::string(is_short(ranks) ? "ranks" : "classes") +
                              ": fewer than positions has room for, " + std::to_string(capacity));
        }
        return Status(azulejo_kdrt_window_into(
            get(), window_min.data(), window_max.data(), positions.data(),
            ranks.empty() ? nullptr : ranks.data(), classes.empty() ? nullptr : classes.data(),
            capacity, &count));
    }

    /// The most samples of a window of an extent; see azulejo_kdrt_window_capacity.
    Status try_window_capacity(const Pair &extent, std::size_t &out) const {
        return Status(azulejo_kdrt_window_capacity(get(), extent.data(), &out));
    }

    /// The spacing of the lattice of the samples; see azulejo_kdrt_unit.
    double unit() const noexcept { return azulejo_kdrt_unit(get()); }

#ifndef AZULEJO_NO_EXCEPTIONS
    Kdrt(const Context &context, const KdrtOptions &options) {
        check(try_create(context, options, *this));
    }

    Kdrt(const Context &context, const KdrtOptions &options, const Classes &classes) {
        check(try_create(context, options, classes, *this));
    }

    static Kdrt wide(const Context &context, const KdrtOptions &options) {
        Kdrt plane;
        check(try_create_wide(context, options, plane));
        return plane;
    }

    Points window(const Pair &window_min, const Pair &window_max) const {
        Points points;
        check(try_window(window_min, window_max, points));
        return points;
    }

    std::size_t window_into(const Pair &window_min, const Pair &window_max, Span<float> positions,
                            Span<float> ranks = {}, Span<std::uint32_t> classes = {}) const {
        std::size_t count = 0;
        check(try_window_into(window_min, window_max, positions, count, ranks, classes));
        return count;
    }

    std::size_t window_capacity(const Pair &extent) const {
        std::size_t capacity = 0;
        check(try_window_capacity(extent, capacity));
        return capacity;
    }
#endif
};

// ---- Mesh --------------------------------------------------------------------------------------

/// A checked triangle mesh; see azulejo_mesh.
class Mesh : public Owner<azulejo_mesh, azulejo_mesh_free> {
public:
    using Owner::Owner;
    Mesh() noexcept = default;

    /// See azulejo_mesh_create.
    static Status try_create(const Vertices &positions, const Triangles &indices, Mesh &out) {
        if (Status s = positions.check("positions"); !s.ok()) return s;
        if (Status s = indices.check("indices"); !s.ok()) return s;
        return detail::make(out, [&](auto **mesh) {
            return azulejo_mesh_create(positions.data(), positions.size(), positions.stride(),
                                       indices.data(), indices.size(), mesh);
        });
    }

    /// An OBJ, PLY, STL, OFF or GLB file; see azulejo_mesh_load.
    static Status try_load(const std::string &path, Mesh &out) {
        return detail::make(out, [&](auto **m) { return azulejo_mesh_load(path.c_str(), m); });
    }

    /// Triangles of an RTCScene of the caller's; see azulejo_mesh_create_from_embree.
    static Status try_from_embree(void *scene, Span<const azulejo_embree_geometry> geometries,
                                  Mesh &out) {
        return detail::make(out, [&](auto **mesh) {
            return azulejo_mesh_create_from_embree(scene, geometries.data(), geometries.size(),
                                                   sizeof(azulejo_embree_geometry),
                                                   mesh);
        });
    }

    /// This mesh with normals: one for each vertex, or named by three indices for each triangle;
    /// see azulejo_mesh_with_normals.
    Status try_with_normals(const Vertices &normals, const Triangles &normal_indices,
                            Mesh &out) const {
        if (Status s = normals.check("normals"); !s.ok()) return s;
        if (Status s = normal_indices.check("normal_indices"); !s.ok()) return s;
        return detail::make(out, [&](auto **mesh) {
            return azulejo_mesh_with_normals(get(), normals.data(), normals.size(),
                                             normals.stride(), normal_indices.data(),
                                             normal_indices.size(), mesh);
        });
    }

    /// This mesh without the triangles whose entry is 0; see azulejo_mesh_with_mask.
    Status try_with_mask(Span<const std::uint8_t> mask, Mesh &out) const {
        return detail::make(out, [&](auto **mesh) {
            return azulejo_mesh_with_mask(get(), mask.data(), mask.size(), mesh);
        });
    }

    /// This mesh with its vertices moved; see azulejo_mesh_deform.
    Status try_deform(const Vertices &positions, Mesh &out) const {
        if (Status s = positions.check("positions"); !s.ok()) return s;
        return detail::make(out, [&](auto **mesh) {
            return azulejo_mesh_deform(get(), positions.data(), positions.size(),
                                       positions.stride(), mesh);
        });
    }

    /// The places of triangles and barycentrics u v, as samples; see azulejo_mesh_points.
    Status try_points(Span<const std::uint32_t> triangles, const PlanePoints &barycentrics,
                      Points &out) const {
        if (Status s = barycentrics.check("barycentrics"); !s.ok()) return s;
        if (barycentrics.size() != triangles.size()) {
            return Status(AZULEJO_ERROR_INVALID_ARGUMENT,
                          "barycentrics: there are " + std::to_string(barycentrics.size()) +
                              ", and " + std::to_string(triangles.size()) + " triangles");
        }
        return detail::make(out, [&](auto **points) {
            return azulejo_mesh_points(get(), triangles.data(), barycentrics.data(),
                                       triangles.size(), points);
        });
    }

#ifndef AZULEJO_NO_EXCEPTIONS
    Mesh(const Vertices &positions, const Triangles &indices) {
        check(try_create(positions, indices, *this));
    }

    Mesh(const float *positions, std::size_t vertex_count, std::size_t stride_bytes,
         const std::uint32_t *indices, std::size_t triangle_count)
        : Mesh({positions, vertex_count, stride_bytes}, {indices, triangle_count}) {}

    static Mesh load(const std::string &path) {
        Mesh mesh;
        check(try_load(path, mesh));
        return mesh;
    }

    static Mesh from_embree(void *scene, Span<const azulejo_embree_geometry> geometries) {
        Mesh mesh;
        check(try_from_embree(scene, geometries, mesh));
        return mesh;
    }

    Mesh with_normals(const Vertices &normals, const Triangles &normal_indices = {}) const {
        Mesh mesh;
        check(try_with_normals(normals, normal_indices, mesh));
        return mesh;
    }

    Mesh with_mask(Span<const std::uint8_t> mask) const {
        Mesh mesh;
        check(try_with_mask(mask, mesh));
        return mesh;
    }

    Mesh deform(const Vertices &positions) const {
        Mesh mesh;
        check(try_deform(positions, mesh));
        return mesh;
    }

    Points points(Span<const std::uint32_t> triangles, const PlanePoints &barycentrics) const {
        Points points;
        check(try_points(triangles, barycentrics, points));
        return points;
    }
#endif

    /// True if the mesh has normals besides those of its triangles; see azulejo_mesh_has_normals.
    bool has_normals() const noexcept { return azulejo_mesh_has_normals(get()) != 0; }
    /// See azulejo_mesh_vertex_count.
    std::size_t vertex_count() const noexcept { return azulejo_mesh_vertex_count(get()); }
    /// See azulejo_mesh_triangle_count.
    std::size_t triangle_count() const noexcept { return azulejo_mesh_triangle_count(get()); }
    /// x y z of each vertex; see azulejo_mesh_positions.
    Positions positions() const & noexcept {
        return {azulejo_mesh_positions(get()), vertex_count(), 3};
    }
    Positions positions() const && = delete;
    /// Three vertices for each triangle; see azulejo_mesh_indices.
    Span<const std::uint32_t> indices() const & noexcept {
        return {azulejo_mesh_indices(get()), 3 * triangle_count()};
    }
    Span<const std::uint32_t> indices() const && = delete;
    /// The origin to which positions are relative, x y z; see azulejo_mesh_origin.
    std::array<double, 3> origin() const noexcept {
        std::array<double, 3> found{};
        azulejo_mesh_origin(get(), found.data());
        return found;
    }

    /// The area of all triangles that no mask leaves out; see azulejo_mesh_area.
    double area() const noexcept { return azulejo_mesh_area(get()); }
    /// See azulejo_mesh_is_closed.
    bool is_closed() const noexcept { return azulejo_mesh_is_closed(get()) != 0; }
};

// ---- Regions -----------------------------------------------------------------------------------

/// A part of space, at first all of it; see azulejo_region.
struct Region : azulejo_region {
    // Cannot fail: the struct has the size that this header gives it.
    Region() noexcept : azulejo_region() { (void)azulejo_region_init(this, sizeof *this); }

    static Region ball(const std::array<double, 3> &centre, double radius) noexcept {
        Region region;
        std::copy_n(centre.data(), 3, region.centre);
        region.radius = radius;
        return region;
    }

    static Region box(const std::array<double, 3> &min, const std::array<double, 3> &max) noexcept {
        Region region;
        std::copy_n(min.data(), 3, region.min);
        std::copy_n(max.data(), 3, region.max);
        return region;
    }
};

namespace detail {

/// Refuses given samples that are not whole points, and clearances that are not one for each.
template <class Positions>
Status check_given(const Positions &positions, Span<const double> clearances) {
    if (Status s = positions.check("positions"); !s.ok()) return s;
    if (clearances.size() == 0 || clearances.size() == positions.size()) return Status();
    return Status(AZULEJO_ERROR_INVALID_ARGUMENT,
                  "clearances: there are " + std::to_string(clearances.size()) + ", and " +
                      std::to_string(positions.size()) + " positions");
}

/// The C handles of several owners.
template <class Owner>
std::vector<const typename Owner::Handle *> handles(Span<const Owner> owners) {
    std::vector<const typename Owner::Handle *> handles;
    for (const Owner &owner : owners) handles.push_back(owner.get());
    return handles;
}

} // namespace detail

// ---- Plane -------------------------------------------------------------------------------------

/// A set of the plane that is edited; see azulejo_plane. It keeps what it needs of the context and
/// the options, with their progress functions.
class Plane : public Owner<azulejo_plane, azulejo_plane_free> {
public:
    using Owner::Owner;
    Plane() noexcept = default;

    /// The set of kdrt_sample or, if there are positions, of these; see azulejo_plane_create.
    static Status try_create(const Context &context, const KdrtOptions &options,
                             const PlanePoints &positions, Plane &out) {
        if (Status s = positions.check("positions"); !s.ok()) return s;
        Status status = detail::make(out, [&](auto **plane) {
            return azulejo_plane_create(context.get(), &options, positions.data(),
                                        positions.size(), plane);
        });
        if (status.ok()) {
            out.context_progress_ = context.progress_;
            out.progress_ = options.progress_;
        }
        return status;
    }

    /// Erases the samples in a region; see azulejo_plane_erase.
    Status try_erase(const Region &region, Points &erased) {
        return detail::make(erased,
                            [&](auto **p) { return azulejo_plane_erase(get(), &region, p); });
    }

    /// Erases samples by their ids; see azulejo_plane_erase_ids.
    Status try_erase(Span<const std::uint64_t> ids, Points &erased) {
        return detail::make(erased, [&](auto **points) {
            return azulejo_plane_erase_ids(get(), ids.data(), ids.size(), points);
        });
    }

    /// Puts erased samples back; see azulejo_plane_restore.
    Status try_restore(const Points &points) {
        return detail::run([&] { return azulejo_plane_restore(get(), points.get()); });
    }

    /// Adds given samples; see azulejo_plane_add_given. `clearances`, one for each, may be empty:
    /// all have the radius of the set.
    Status try_add_given(const PlanePoints &positions, Span<const double> clearances,
                         std::uint64_t &first_id, Points &erased) {
        if (Status s = detail::check_given(positions, clearances); !s.ok()) return s;
        return detail::make(erased, [&](auto **points) {
            return azulejo_plane_add_given(get(), positions.data(),
                                           clearances.size() == 0 ? nullptr : clearances.data(),
                                           positions.size(), &first_id, points);
        });
    }

    /// Removes given samples by their ids; see azulejo_plane_remove_given.
    Status try_remove_given(Span<const std::uint64_t> ids) {
        return detail::run(
            [&] { return azulejo_plane_remove_given(get(), ids.data(), ids.size()); });
    }

    /// Fills the gaps that edits have left; see azulejo_plane_refill. `report` may be null.
    Status try_refill(std::uint64_t seed, Points &added, KdrtReport *report = nullptr) {
        return detail::make(added, [&](auto **points) {
            return azulejo_plane_refill(get(), seed, points, report);
        });
    }

    /// A copy of the set as it is now; see azulejo_plane_points.
    Status try_points(Points &out) const {
        return detail::make(out,
                            [&](auto **points) { return azulejo_plane_points(get(), points); });
    }

#ifndef AZULEJO_NO_EXCEPTIONS
    Plane(const Context &context, const KdrtOptions &options, const PlanePoints &positions = {}) {
        check(try_create(context, options, positions, *this));
    }

    Points erase(const Region &region) {
        Points erased;
        check(try_erase(region, erased));
        return erased;
    }

    Points erase(Span<const std::uint64_t> ids) {
        Points erased;
        check(try_erase(ids, erased));
        return erased;
    }

    void restore(const Points &points) { check(try_restore(points)); }

    /// As Psp::add_given.
    std::uint64_t add_given(const PlanePoints &positions, Span<const double> clearances = {},
                            Points *erased = nullptr) {
        Points points;
        std::uint64_t first_id = 0;
        check(try_add_given(positions, clearances, first_id, points));
        if (erased != nullptr) *erased = std::move(points);
        return first_id;
    }

    void remove_given(Span<const std::uint64_t> ids) { check(try_remove_given(ids)); }

    Points refill(std::uint64_t seed, KdrtReport *report = nullptr) {
        Points added;
        check(try_refill(seed, added, report));
        return added;
    }

    Points points() const {
        Points points;
        check(try_points(points));
        return points;
    }
#endif

private:
    std::shared_ptr<Progress> context_progress_;
    std::shared_ptr<Progress> progress_;
};

// ---- Psp ---------------------------------------------------------------------------------------

/// A set of samples on a mesh that grows and can be edited; see azulejo_psp. It keeps what it needs
/// of the context, the mesh and the options, with their progress functions.
class Psp : public Owner<azulejo_psp, azulejo_psp_free> {
public:
    using Owner::Owner;
    Psp() noexcept = default;

    /// See azulejo_psp_create.
    static Status try_create(const Context &context, const Mesh &mesh, const PspOptions &options,
                             Psp &out) {
        Status status = detail::make(out, [&](auto **psp) {
            return azulejo_psp_create(context.get(), mesh.get(), &options, psp);
        });
        if (status.ok()) {
            out.context_progress_ = context.progress_;
            out.progress_ = options.progress_;
        }
        return status;
    }

    /// Adds samples by projection; see azulejo_psp_advance. `report` may be null.
    Status try_advance(std::uint32_t iterations, PspReport *report = nullptr) {
        return detail::run([&] { return azulejo_psp_advance(get(), iterations, report); });
    }

    /// Makes the set maximal; see azulejo_psp_fill. `report` may be null.
    Status try_fill(PspReport *report = nullptr) {
        return detail::run([&] { return azulejo_psp_fill(get(), report); });
    }

    /// Erases the samples in a region; see azulejo_psp_erase.
    Status try_erase(const Region &region, Points &erased) {
        return detail::make(erased, [&](auto **p) { return azulejo_psp_erase(get(), &region, p); });
    }

    /// Erases samples by their ids; see azulejo_psp_erase_ids.
    Status try_erase(Span<const std::uint64_t> ids, Points &erased) {
        return detail::make(erased, [&](auto **points) {
            return azulejo_psp_erase_ids(get(), ids.data(), ids.size(), points);
        });
    }

    /// Puts erased samples back; see azulejo_psp_restore.
    Status try_restore(const Points &points) {
        return detail::run([&] { return azulejo_psp_restore(get(), points.get()); });
    }

    /// Adds given samples; see azulejo_psp_add_given. `clearances`, one for each, may be empty: all
    /// have the radius of the set.
    Status try_add_given(const SpacePoints &positions, Span<const double> clearances,
                         std::uint64_t &first_id, Points &erased) {
        if (Status s = detail::check_given(positions, clearances); !s.ok()) return s;
        return detail::make(erased, [&](auto **points) {
            return azulejo_psp_add_given(get(), positions.data(),
                                         clearances.size() == 0 ? nullptr : clearances.data(),
                                         positions.size(), &first_id, points);
        });
    }

    /// Removes given samples by their ids; see azulejo_psp_remove_given.
    Status try_remove_given(Span<const std::uint64_t> ids) {
        return detail::run(
            [&] { return azulejo_psp_remove_given(get(), ids.data(), ids.size()); });
    }

    /// Fills the gaps that edits have left; see azulejo_psp_refill. `report` may be null.
    Status try_refill(std::uint64_t seed, Points &added, PspReport *report = nullptr) {
        return detail::make(added, [&](auto **points) {
            return azulejo_psp_refill(get(), seed, points, report);
        });
    }

    /// A copy of the set as it is now; see azulejo_psp_points.
    Status try_points(Points &out) const {
        return detail::make(out, [&](auto **points) { return azulejo_psp_points(get(), points); });
    }

#ifndef AZULEJO_NO_EXCEPTIONS
    Psp(const Context &context, const Mesh &mesh, const PspOptions &options) {
        check(try_create(context, mesh, options, *this));
    }

    PspReport advance(std::uint32_t iterations) {
        PspReport report;
        check(try_advance(iterations, &report));
        return report;
    }

    PspReport fill() {
        PspReport report;
        check(try_fill(&report));
        return report;
    }

    Points erase(const Region &region) {
        Points erased;
        check(try_erase(region, erased));
        return erased;
    }

    Points erase(Span<const std::uint64_t> ids) {
        Points erased;
        check(try_erase(ids, erased));
        return erased;
    }

    void restore(const Points &points) { check(try_restore(points)); }

    /// The id of the first given sample, which the others follow. The samples that gave way are
    /// put into `erased`, if it is not null.
    std::uint64_t add_given(const SpacePoints &positions, Span<const double> clearances = {},
                            Points *erased = nullptr) {
        Points points;
        std::uint64_t first_id = 0;
        check(try_add_given(positions, clearances, first_id, points));
        if (erased != nullptr) *erased = std::move(points);
        return first_id;
    }

    void remove_given(Span<const std::uint64_t> ids) { check(try_remove_given(ids)); }

    Points refill(std::uint64_t seed, PspReport *report = nullptr) {
        Points added;
        check(try_refill(seed, added, report));
        return added;
    }

    Points points() const {
        Points points;
        check(try_points(points));
        return points;
    }
#endif

private:
    std::shared_ptr<Progress> context_progress_;
    std::shared_ptr<Progress> progress_;
};

// ---- Samplers: `report` may be null ------------------------------------------------------------

/// The samples that the surface of a mesh in a region needs; see azulejo_psp_sample_region.
inline Status try_psp_sample_region(const Context &context, const Mesh &mesh,
                                    const PspOptions &options, const Region &region, Points &out,
                                    PspReport *report = nullptr) {
    return detail::make(out, [&](auto **points) {
        return azulejo_psp_sample_region(context.get(), mesh.get(), &options, &region, points,
                                         report);
    });
}

/// Samples of many instances of some meshes; see azulejo_psp_sample_instances.
inline Status try_psp_sample_instances(const Context &context, Span<const Mesh> prototypes,
                                       Span<const azulejo_instance> instances,
                                       const PspOptions &options, Points &out,
                                       PspReport *report = nullptr) {
    const auto handles = detail::handles(prototypes);
    return detail::make(out, [&](auto **points) {
        return azulejo_psp_sample_instances(context.get(), handles.data(), handles.size(),
                                            instances.data(), instances.size(),
                                            sizeof(azulejo_instance), &options, points, report);
    });
}

/// A maximal set of samples of a rectangle; see azulejo_kdrt_sample.
inline Status try_kdrt_sample(const Context &context, const KdrtOptions &options, Points &out,
                              KdrtReport *report = nullptr) {
    return detail::make(out, [&](auto **points) {
        return azulejo_kdrt_sample(context.get(), &options, points, report);
    });
}

/// Samples of several classes in a rectangle; see azulejo_kdrt_sample_classes.
inline Status try_kdrt_sample_classes(const Context &context, const KdrtOptions &options,
                                      const Classes &classes, Points &out,
                                      ClassesReport *report = nullptr) {
    return detail::with_classes(options, classes, [&](const azulejo_classes &wanted) {
        return detail::make(out, [&](auto **points) {
            return azulejo_kdrt_sample_classes(context.get(), &options, &wanted, points, report);
        });
    });
}

/// The part of kdrt_sample's set that lies in a window; see azulejo_kdrt_sample_window.
inline Status try_kdrt_sample_window(const Context &context, const KdrtOptions &options,
                                     const Pair &window_min, const Pair &window_max, Points &out,
                                     KdrtReport *report = nullptr) {
    return detail::make(out, [&](auto **points) {
        return azulejo_kdrt_sample_window(context.get(), &options, window_min.data(),
                                          window_max.data(), points, report);
    });
}

/// Hands out the samples of kdrt_sample part by part; see azulejo_kdrt_stream.
inline Status try_kdrt_stream(const Context &context, const KdrtOptions &options,
                              const KdrtVisitor &visit, KdrtReport *report = nullptr) {
    const azulejo_kdrt_visit_fn call = [](void *user, const float *positions, std::size_t count) {
        return detail::guarded([&] {
            return (*static_cast<const KdrtVisitor *>(user))(Positions(positions, count, 2));
        });
    };
    return detail::run([&] {
        return azulejo_kdrt_stream(context.get(), &options, visit ? call : nullptr,
                                   const_cast<KdrtVisitor *>(&visit), report);
    });
}

/// A set of samples with its rectangle, such as {points, {0, 0}, {1, 1}}; see
/// azulejo_kdrt_merge_piece. The samples stay the caller's.
struct KdrtMergePiece {
    Borrowed<PlanePoints> positions;
    Pair min;
    Pair max;
};

/// Merges sets on rectangles that do not overlap, and points that must stay, into one maximal set;
/// see azulejo_kdrt_merge.
inline Status try_kdrt_merge(const Context &context, const KdrtMergeOptions &options,
                             Span<const KdrtMergePiece> pieces, const PlanePoints &fixed,
                             Points &out, KdrtMergeReport *report = nullptr) {
    std::vector<azulejo_kdrt_merge_piece> c_pieces;
    for (const auto &[positions, min, max] : pieces) {
        if (Status s = positions.check("positions"); !s.ok()) return s;
        c_pieces.push_back(
            {positions.data(), positions.size(), {min[0], min[1]}, {max[0], max[1]}});
    }
    if (Status s = fixed.check("fixed"); !s.ok()) return s;
    return detail::make(out, [&](auto **points) {
        return azulejo_kdrt_merge(context.get(), &options, c_pieces.data(), c_pieces.size(),
                                  sizeof c_pieces[0], fixed.data(), fixed.size(), points, report);
    });
}

/// A blue-noise mask; see azulejo_mask.
class Mask : public Owner<azulejo_mask, azulejo_mask_free> {
public:
    using Owner::Owner;

    /// The pixels along x, y and z; see azulejo_mask_size.
    std::size_t width() const noexcept { return azulejo_mask_size(get(), 0); }
    std::size_t height() const noexcept { return azulejo_mask_size(get(), 1); }
    std::size_t depth() const noexcept { return azulejo_mask_size(get(), 2); }
    /// The number of channels; see azulejo_mask_channels.
    std::size_t channels() const noexcept { return azulejo_mask_channels(get()); }
    /// The ranks, channel by channel; see azulejo_mask_ranks.
    Span<const std::uint32_t> ranks() const & noexcept {
        return {azulejo_mask_ranks(get()), channels() * width() * height() * depth()};
    }
    Span<const std::uint32_t> ranks() const && = delete;
    /// The ranks as numbers in (0, 1), into an array of as many; see azulejo_mask_values.
    Status try_values(Span<float> out) const {
        if (out.size() != ranks().size()) return refusal("out: has another size");
        return Status(azulejo_mask_values(get(), out.data()));
    }
    /// An image of the plane in few levels; `out` has as many numbers as `image`. See
    /// azulejo_mask_dither.
    Status try_dither(Span<const float> image, std::size_t image_width, std::size_t image_channels,
                      std::uint32_t levels, Span<std::uint8_t> out) const {
        return dithered(azulejo_mask_dither, image, image_width, image_channels, levels, out);
    }
    /// The same for numbers from 0 to 255; see azulejo_mask_dither_bytes.
    Status try_dither(Span<const std::uint8_t> image, std::size_t image_width,
                      std::size_t image_channels, std::uint32_t levels,
                      Span<std::uint8_t> out) const {
        return dithered(azulejo_mask_dither_bytes, image, image_width, image_channels, levels, out);
    }

private:
    static Status refusal(const char *message) {
        return Status(AZULEJO_ERROR_INVALID_ARGUMENT, message);
    }
    template <class T, class Call>
    Status dithered(Call call, Span<const T> image, std::size_t image_width,
                    std::size_t image_channels, std::uint32_t levels,
                    Span<std::uint8_t> out) const {
        if (out.size() != image.size()) return refusal("out: has another size");
        const std::size_t row = image_width * image_channels;
        if (row == 0 || image.size() % row != 0) {
            return refusal("image: is no whole number of rows");
        }
        return Status(call(get(), image.data(), image_width, image.size() / row, 1, image_channels,
                           levels, out.data()));
    }
};

/// A blue-noise mask by void and cluster; see azulejo_mask_create.
inline Status try_mask_create(const Context &context, const MaskOptions &options, Mask &out,
                              MaskReport *report = nullptr) {
    return detail::make(out, [&](auto **mask) {
        return azulejo_mask_create(context.get(), &options, mask, report);
    });
}

/// Points of a cloud that were selected; see azulejo_selection.
class Selection : public Owner<azulejo_selection, azulejo_selection_free> {
public:
    using Owner::Owner;

    /// The number of points; see azulejo_selection_count.
    std::size_t size() const noexcept { return azulejo_selection_count(get()); }
    /// Their indices in the cloud; see azulejo_selection_indices.
    Span<const std::uint32_t> indices() const & noexcept {
        return {azulejo_selection_indices(get()), size()};
    }
    Span<const std::uint32_t> indices() const && = delete;
    /// The ranks of a progressive selection, empty in any order; see azulejo_selection_ranks.
    Span<const float> ranks() const & noexcept {
        const float *ranks = azulejo_selection_ranks(get());
        return {ranks, ranks ? size() : 0};
    }
    Span<const float> ranks() const && = delete;
};

/// Selects points of a cloud of the plane; see azulejo_thin.
inline Status try_plane_thin(const Context &context, const ThinOptions &options,
                             const PlanePoints &positions, Selection &out,
                             ThinReport *report = nullptr) {
    if (Status s = positions.check("positions"); !s.ok()) return s;
    return detail::make(out, [&](auto **selection) {
        return azulejo_thin(context.get(), &options, positions.data(), positions.size(), 2,
                            selection, report);
    });
}

/// Selects points of a cloud in space; see azulejo_thin.
inline Status try_space_thin(const Context &context, const ThinOptions &options,
                             const SpacePoints &positions, Selection &out,
                             ThinReport *report = nullptr) {
    if (Status s = positions.check("positions"); !s.ok()) return s;
    return detail::make(out, [&](auto **selection) {
        return azulejo_thin(context.get(), &options, positions.data(), positions.size(), 3,
                            selection, report);
    });
}

/// The unbiased reference, which is slow; see azulejo_maximal_sample.
inline Status try_maximal_sample(const Context &context, const MaximalOptions &options,
                                 Points &out, KdrtReport *report = nullptr) {
    return detail::make(out, [&](auto **points) {
        return azulejo_maximal_sample(context.get(), &options, points, report);
    });
}

/// A maximal set of samples of a cuboid; see azulejo_volume_sample.
inline Status try_volume_sample(const Context &context, const VolumeOptions &options, Points &out,
                                VolumeReport *report = nullptr) {
    return detail::make(out, [&](auto **points) {
        return azulejo_volume_sample(context.get(), &options, points, report);
    });
}

/// Samples of several classes in a cuboid; see azulejo_volume_sample_classes.
inline Status try_volume_sample_classes(const Context &context, const VolumeOptions &options,
                                        const Classes &classes, Points &out,
                                        ClassesReport *report = nullptr) {
    return detail::with_classes(options, classes, [&](const azulejo_classes &wanted) {
        return detail::make(out, [&](auto **points) {
            return azulejo_volume_sample_classes(context.get(), &options, &wanted, points, report);
        });
    });
}

/// A maximal set of samples inside a mesh; see azulejo_volume_sample_inside.
inline Status try_volume_sample_inside(const Context &context, const Mesh &mesh,
                                       const VolumeInsideOptions &options, Points &out,
                                       VolumeInsideReport *report = nullptr) {
    return detail::make(out, [&](auto **points) {
        return azulejo_volume_sample_inside(context.get(), mesh.get(), &options, points, report);
    });
}

/// Relaxes points of a cuboid; see azulejo_volume_relax.
inline Status try_volume_relax(const Context &context, const VolumeRelaxOptions &options,
                               const SpacePoints &positions, Points &out,
                               VolumeRelaxReport *report = nullptr) {
    return detail::make(out, [&](auto **points) {
        return azulejo_volume_relax(context.get(), &options, positions.data(), positions.size(),
                                    points, report);
    });
}

/// Relaxes points inside a mesh; see azulejo_volume_relax_inside.
inline Status try_volume_relax_inside(const Context &context, const Mesh &mesh,
                                      const VolumeRelaxInsideOptions &options,
                                      const SpacePoints &positions, Points &out,
                                      VolumeRelaxReport *report = nullptr) {
    return detail::make(out, [&](auto **points) {
        return azulejo_volume_relax_inside(context.get(), mesh.get(), &options, positions.data(),
                                           positions.size(), points, report);
    });
}

/// Samples of a mesh in one call; see azulejo_psp_sample.
inline Status try_psp_sample(const Context &context, const Mesh &mesh, const PspOptions &options,
                             Points &out, PspReport *report = nullptr) {
    return detail::make(out, [&](auto **points) {
        return azulejo_psp_sample(context.get(), mesh.get(), &options, points, report);
    });
}

/// Samples of a mesh of several classes at once; see azulejo_psp_sample_classes.
inline Status try_psp_sample_classes(const Context &context, const Mesh &mesh,
                                     const PspOptions &options, const Classes &classes,
                                     Points &out, ClassesReport *report = nullptr) {
    return detail::with_classes(options, classes, [&](const azulejo_classes &wanted) {
        return detail::make(out, [&](auto **points) {
            return azulejo_psp_sample_classes(context.get(), mesh.get(), &options, &wanted, points,
                                              report);
        });
    });
}

namespace detail {
/// Calls with options that may have a function of the radius, and tells what it has thrown.
template <typename Options, typename Call>
Status with_radius(const Options &options, Points &out, const Call &call) {
    if (options.radius_function != &Field<3>::call) {
        return make(out, [&](auto **points) { return call(options, points); });
    }
    Field<3> field(*static_cast<const Field<3> *>(options.radius_function_user));
    Options c_options = options;
    c_options.radius_function_user = &field;
    return make(out, [&](auto **points) { return field.after(call(c_options, points)); });
}
} // namespace detail

/// Samples of a mesh, each with a radius of its own; see azulejo_psp_adaptive_sample.
inline Status try_psp_adaptive_sample(const Context &context, const Mesh &mesh,
                                      const PspAdaptiveOptions &options, Points &out,
                                      PspReport *report = nullptr) {
    const azulejo_psp_adaptive_options &c_options = options;
    return detail::with_radius(c_options, out, [&](const auto &o, auto **points) {
        return azulejo_psp_adaptive_sample(context.get(), mesh.get(), &o, points, report);
    });
}

/// Samples of a cuboid, each with a radius of its own; see azulejo_volume_adaptive_sample.
inline Status try_volume_adaptive_sample(const Context &context,
                                         const VolumeAdaptiveOptions &options, Points &out,
                                         VolumeReport *report = nullptr) {
    const azulejo_volume_adaptive_options &c_options = options;
    return detail::with_radius(c_options, out, [&](const auto &o, auto **points) {
        return azulejo_volume_adaptive_sample(context.get(), nullptr, &o, points, report);
    });
}

/// The same inside a mesh.
inline Status try_volume_adaptive_sample(const Context &context, const Mesh &mesh,
                                         const VolumeAdaptiveOptions &options, Points &out,
                                         VolumeReport *report = nullptr) {
    const azulejo_volume_adaptive_options &c_options = options;
    return detail::with_radius(c_options, out, [&](const auto &o, auto **points) {
        return azulejo_volume_adaptive_sample(context.get(), mesh.get(), &o, points, report);
    });
}

namespace detail {
/// Hands a density of the C interface to a call, and tells what its function has thrown.
template <typename Call>
Status with_mesh_density(const MeshDensity &density, Points &out, const Call &call) {
    if (Status s = density.texture.check("texture"); !s.ok()) return s;
    if (!density.image.empty() &&
        (density.width == 0 || density.image.size() % density.width != 0)) {
        return Status(AZULEJO_ERROR_INVALID_ARGUMENT,
                      "image: " + std::to_string(density.image.size()) +
                          " numbers are not a multiple of " + std::to_string(density.width));
    }
    Field<3> field(density.function);
    azulejo_mesh_density wanted = {};
    if (Status s{azulejo_mesh_density_init(&wanted, sizeof wanted)}; !s.ok()) return s;
    wanted.vertex_values = density.vertex_values.data();
    wanted.vertex_count = density.vertex_values.size();
    wanted.function = density.function ? &Field<3>::call : nullptr;
    wanted.function_user = &field;
    wanted.at_vertices = density.at_vertices;
    wanted.largest = density.largest;
    wanted.slope = density.slope;
    wanted.image = density.image.data();
    wanted.width = density.width;
    wanted.height = density.image.empty() ? 0 : density.image.size() / density.width;
    wanted.texture = density.texture.data();
    wanted.texture_count = density.texture.size();
    wanted.by_corners = density.by_corners;
    wanted.radius = density.radius;
    wanted.count = density.count;
    return make(out, [&](auto **points) { return field.after(call(wanted, points)); });
}
} // namespace detail

/// Samples of a mesh with a density; see azulejo_psp_adaptive_with_density.
inline Status try_psp_adaptive_with_density(const Context &context, const Mesh &mesh,
                                              const PspAdaptiveOptions &options,
                                              const MeshDensity &density, Points &out,
                                              PspReport *report = nullptr) {
    return detail::with_mesh_density(density, out, [&](const auto &wanted, auto **points) {
        return azulejo_psp_adaptive_with_density(context.get(), mesh.get(), &options, &wanted,
                                                 points, report);
    });
}

/// Samples of a mesh of several classes with a density; see azulejo_psp_classes_with_density.
inline Status try_psp_classes_with_density(const Context &context, const Mesh &mesh,
                                           const PspOptions &options, const Classes &classes,
                                           const MeshDensity &density, Points &out,
                                           ClassesReport *report = nullptr) {
    return detail::with_classes(options, classes, [&](const azulejo_classes &of) {
        return detail::with_mesh_density(density, out, [&](const auto &wanted, auto **points) {
            return azulejo_psp_classes_with_density(context.get(), mesh.get(), &options, &of,
                                                    &wanted, points, report);
        });
    });
}

// ---- Relaxation: `report` may be null; a cancelled call succeeds, as the report says -----------

namespace detail {

/// The most bins that a call allows; a larger number is refused by it and has no array here.
inline constexpr std::size_t most_bins = 65536;

/// Calls with the C struct of a density.
template <class Call>
Status with_density(const Density &density, Points &out, Call call) {
    const auto values = density.values;
    if (!values.empty() && (density.width == 0 || values.size() % density.width != 0)) {
        return Status(AZULEJO_ERROR_INVALID_ARGUMENT,
                      "values: " + std::to_string(values.size()) +
                          " numbers are not a multiple of " + std::to_string(density.width));
    }
    Field<2> field(density.function);
    azulejo_density wanted = {};
    if (Status s{azulejo_density_init(&wanted, sizeof wanted)}; !s.ok()) return s;
    wanted.values = values.data();
    wanted.width = density.width;
    wanted.height = values.empty() ? 0 : values.size() / density.width;
    wanted.function = density.function ? &Field<2>::call : nullptr;
    wanted.function_user = &field;
    return make(out, [&](auto **points) { return field.after(call(&wanted, points)); });
}

} // namespace detail

/// Relaxes points of the plane; see azulejo_dcr_relax.
inline Status try_dcr_relax(const Context &context, const DcrOptions &options,
                            const PlanePoints &positions, Points &out,
                            DcrReport *report = nullptr) {
    if (Status s = positions.check("positions"); !s.ok()) return s;
    return detail::make(out, [&](auto **points) {
        return azulejo_dcr_relax(context.get(), &options, positions.data(), positions.size(),
                                 points, report);
    });
}

/// Makes the pair correlation of a radial power in `bins` bins; see azulejo_dcr_correlation_of_power.
inline Status try_dcr_correlation_of_power(double highest, Span<const double> power, double reach,
                                           std::size_t bins, std::vector<double> &out) {
    // One at least, so that it is `bins` that is refused.
    std::vector<double> values(std::max<std::size_t>(std::min(bins, detail::most_bins), 1));
    Status s = detail::run([&] {
        return azulejo_dcr_correlation_of_power(highest, power.data(), power.size(), reach, bins,
                                                values.data());
    });
    if (s.ok()) out = std::move(values);
    return s;
}

/// Moves points of a torus until they have the pair correlation `correlation`, in bins up to
/// `reach` d_max; see azulejo_dcr_relax_to_correlation.
inline Status try_dcr_relax_to_correlation(const Context &context, const DcrOptions &options,
                                           const PlanePoints &positions, double reach,
                                           Span<const double> correlation, Points &out,
                                           DcrReport *report = nullptr,
                                           double *residual = nullptr) {
    if (Status s = positions.check("positions"); !s.ok()) return s;
    return detail::make(out, [&](auto **points) {
        return azulejo_dcr_relax_to_correlation(context.get(), &options, positions.data(),
                                                positions.size(), reach, correlation.data(),
                                                correlation.size(), residual, points, report);
    });
}

/// Relaxes points of the plane of `count` classes; see azulejo_dcr_relax_classes. `figures` gets
/// the rho and the relative covering radius of each class.
inline Status try_dcr_relax_classes(const Context &context, const DcrOptions &options,
                                    const PlanePoints &positions, Span<const std::uint32_t> classes,
                                    std::uint32_t count, Points &out, DcrReport *report = nullptr,
                                    std::vector<std::array<double, 2>> *figures = nullptr) {
    if (Status s = positions.check("positions"); !s.ok()) return s;
    if (classes.size() != positions.size()) {
        return Status(AZULEJO_ERROR_INVALID_ARGUMENT,
                      "classes: there are " + std::to_string(classes.size()) + ", and " +
                          std::to_string(positions.size()) + " points");
    }
    // The call refuses more classes before it writes.
    std::array<double, AZULEJO_MAX_CLASSES> rho{}, covering_radius{};
    Status s = detail::make(out, [&](auto **points) {
        return azulejo_dcr_relax_classes(context.get(), &options, positions.data(), classes.data(),
                                         positions.size(), count, rho.data(),
                                         covering_radius.data(), points, report);
    });
    if (s.ok() && figures != nullptr) {
        figures->clear();
        for (std::uint32_t i = 0; i < count; i++) {
            figures->push_back({rho[i], covering_radius[i]});
        }
    }
    return s;
}

/// Random points of the plane, as dense as asked for; see azulejo_dcr_scatter.
inline Status try_dcr_scatter(const Context &context, const DcrOptions &options,
                              const Density &density, std::size_t count, Points &out) {
    return detail::with_density(density, out, [&](const azulejo_density *wanted, auto **points) {
        return azulejo_dcr_scatter(context.get(), &options, wanted, count, points);
    });
}

/// Relaxes points of the plane to a density; see azulejo_dcr_relax_density.
inline Status try_dcr_relax_density(const Context &context, const DcrOptions &options,
                                    const Density &density, const PlanePoints &positions,
                                    Points &out, DcrReport *report = nullptr) {
    if (Status s = positions.check("positions"); !s.ok()) return s;
    return detail::with_density(density, out, [&](const azulejo_density *wanted, auto **points) {
        return azulejo_dcr_relax_density(context.get(), &options, wanted, positions.data(),
                                         positions.size(), points, report);
    });
}

namespace detail {

/// Refuses samples of a mesh that have not a triangle and barycentrics each.
inline Status check_places(Span<const std::uint32_t> triangles,
                           const Tuples<float, 2> &barycentrics) {
    if (Status s = barycentrics.check("barycentrics"); !s.ok()) return s;
    if (barycentrics.size() != triangles.size()) {
        return Status(AZULEJO_ERROR_INVALID_ARGUMENT,
                      "triangles: there are " + std::to_string(triangles.size()) +
                          ", and barycentrics of " + std::to_string(barycentrics.size()) +
                          " samples");
    }
    return Status();
}

} // namespace detail

/// Relaxes samples of a mesh, a triangle and the barycentrics u v for each; see
/// azulejo_dcr_surface_relax.
inline Status try_dcr_surface_relax(const Context &context, const Mesh &mesh,
                                    const DcrSurfaceOptions &options,
                                    Span<const std::uint32_t> triangles,
                                    const Tuples<float, 2> &barycentrics, Points &out,
                                    DcrSurfaceReport *report = nullptr) {
    if (Status s = detail::check_places(triangles, barycentrics); !s.ok()) return s;
    return detail::make(out, [&](auto **points) {
        return azulejo_dcr_surface_relax(context.get(), mesh.get(), &options, triangles.data(),
                                         barycentrics.data(), triangles.size(), points, report);
    });
}

/// The same for a set that was sampled on the mesh.
inline Status try_dcr_surface_relax(const Context &context, const Mesh &mesh,
                                    const DcrSurfaceOptions &options, const Points &samples,
                                    Points &out, DcrSurfaceReport *report = nullptr) {
    if (Status s = SpacePoints(samples).check("samples"); !s.ok()) return s;
    return try_dcr_surface_relax(context, mesh, options, samples.triangles(),
                                 samples.barycentrics(), out, report);
}

/// Makes a mesh whose vertices are the samples; see azulejo_dcr_remesh.
inline Status try_dcr_remesh(const Context &context, const Mesh &mesh,
                             Span<const std::uint32_t> triangles,
                             const Tuples<float, 2> &barycentrics, Mesh &out,
                             DcrRemeshReport *report = nullptr) {
    if (Status s = detail::check_places(triangles, barycentrics); !s.ok()) return s;
    return detail::make(out, [&](auto **made) {
        return azulejo_dcr_remesh(context.get(), mesh.get(), triangles.data(), barycentrics.data(),
                                  triangles.size(), made, report);
    });
}

/// The same for a set that was sampled or relaxed on the mesh.
inline Status try_dcr_remesh(const Context &context, const Mesh &mesh, const Points &samples,
                             Mesh &out, DcrRemeshReport *report = nullptr) {
    if (Status s = SpacePoints(samples).check("samples"); !s.ok()) return s;
    return try_dcr_remesh(context, mesh, samples.triangles(), samples.barycentrics(), out, report);
}

// ---- Analysis ----------------------------------------------------------------------------------

namespace detail {

/// The C struct of a set.
template <class Set, class CSet>
Status c_set(const Set &set, azulejo_status (*init)(CSet *, std::size_t), CSet &out) {
    if (Status s = set.positions.check("positions"); !s.ok()) return s;
    if (Status s{init(&out, sizeof out)}; !s.ok()) return s;
    out.boundary = set.domain.boundary;
    out.positions = set.positions.data();
    out.count = set.positions.size();
    std::copy_n(set.domain.min.data(), std::size(out.domain_min), out.domain_min);
    std::copy_n(set.domain.max.data(), std::size(out.domain_max), out.domain_max);
    return Status();
}

inline Status c_set(const PlaneSet &set, azulejo_plane_set &out) {
    return c_set(set, azulejo_plane_set_init, out);
}

inline Status c_set(const SpaceSet &set, azulejo_space_set &out) {
    return c_set(set, azulejo_space_set_init, out);
}

/// Makes a C call with the C struct of a set.
template <class CSet, class Set, class Call>
Status measured_as(const Set &set, Call call) {
    CSet c = {};
    if (Status s = c_set(set, c); !s.ok()) return s;
    return run([&] { return call(&c); });
}

template <class Call>
Status measured(const PlaneSet &set, Call call) {
    return measured_as<azulejo_plane_set>(set, call);
}

template <class Call>
Status measured(const SpaceSet &set, Call call) {
    return measured_as<azulejo_space_set>(set, call);
}

} // namespace detail

/// See azulejo_plane_smallest_distance.
inline Status try_plane_smallest_distance(const Context &context, const PlaneSet &set,
                                          double &out) {
    return detail::measured(set, [&](const auto *s) {
        return azulejo_plane_smallest_distance(context.get(), s, &out);
    });
}

/// See azulejo_plane_covering_radius.
inline Status try_plane_covering_radius(const Context &context, const PlaneSet &set, double &out) {
    return detail::measured(
        set, [&](const auto *s) { return azulejo_plane_covering_radius(context.get(), s, &out); });
}

/// See azulejo_plane_coverage.
inline Status try_plane_coverage(const Context &context, const PlaneSet &set, double radius,
                                 CoverageReport &out) {
    return detail::measured(
        set, [&](const auto *s) { return azulejo_plane_coverage(context.get(), s, radius, &out); });
}

/// See azulejo_plane_measure.
inline Status try_plane_measure(const Context &context, const PlaneSet &set, PlaneReport &out) {
    return detail::measured(
        set, [&](const auto *s) { return azulejo_plane_measure(context.get(), s, &out); });
}

/// See azulejo_plane_nearest_histogram.
inline Status try_plane_nearest_histogram(const Context &context, const PlaneSet &set, double reach,
                                          std::size_t bins, std::vector<std::uint64_t> &out) {
    std::vector<std::uint64_t> histogram(std::min(bins, detail::most_bins));
    Status status = detail::measured(set, [&](const auto *s) {
        return azulejo_plane_nearest_histogram(context.get(), s, reach, bins, histogram.data());
    });
    if (status.ok()) out = std::move(histogram);
    return status;
}

/// See azulejo_plane_radial_distribution.
inline Status try_plane_radial_distribution(const Context &context, const PlaneSet &set,
                                            double reach, std::size_t bins,
                                            std::vector<double> &out) {
    std::vector<double> density(std::min(bins, detail::most_bins));
    Status status = detail::measured(set, [&](const auto *s) {
        return azulejo_plane_radial_distribution(context.get(), s, reach, bins, density.data());
    });
    if (status.ok()) out = std::move(density);
    return status;
}

/// See azulejo_space_smallest_distance.
inline Status try_space_smallest_distance(const Context &context, const SpacePoints &positions,
                                          double &out) {
    if (Status s = positions.check("positions"); !s.ok()) return s;
    return detail::run([&] {
        return azulejo_space_smallest_distance(context.get(), positions.data(), positions.size(),
                                               &out);
    });
}

/// See azulejo_space_coverage.
inline Status try_space_coverage(const Context &context, const SpaceSet &set, double radius,
                                 CoverageReport &out) {
    return detail::measured(
        set, [&](const auto *s) { return azulejo_space_coverage(context.get(), s, radius, &out); });
}

/// See azulejo_space_measure.
inline Status try_space_measure(const Context &context, const SpaceSet &set, double radius,
                                SpaceReport &out) {
    return detail::measured(
        set, [&](const auto *s) { return azulejo_space_measure(context.get(), s, radius, &out); });
}

/// See azulejo_space_radial_distribution.
inline Status try_space_radial_distribution(const Context &context, const SpaceSet &set,
                                            double reach, std::size_t bins,
                                            std::vector<double> &out) {
    std::vector<double> density(std::min(bins, detail::most_bins));
    Status status = detail::measured(set, [&](const auto *s) {
        return azulejo_space_radial_distribution(context.get(), s, reach, bins, density.data());
    });
    if (status.ok()) out = std::move(density);
    return status;
}

/// See azulejo_space_spectrum.
inline Status try_space_spectrum(const Context &context, const SpaceSet &set,
                                 double frequency_reach, std::uint32_t frequency_stride,
                                 double width, std::vector<Annulus> &out) {
    // No spectrum has more annuli, and other numbers are refused.
    const double most = width > 0 ? frequency_reach / width : 0;
    std::vector<Annulus> annuli(most > 0 ? std::size_t(std::min(most, 1e6)) + 1 : 0);
    std::size_t count = 0;
    Status status = detail::measured(set, [&](const auto *s) {
        return azulejo_space_spectrum(context.get(), s, frequency_reach, frequency_stride, width,
                                      annuli.data(), annuli.size(), sizeof(Annulus), &count);
    });
    if (!status.ok()) return status;
    annuli.resize(std::min(count, annuli.size()));
    out = std::move(annuli);
    return status;
}

/// See azulejo_space_axis_power.
inline Status try_space_axis_power(const Context &context, const SpaceSet &set, std::uint32_t axis,
                                   std::size_t count, std::vector<double> &out) {
    std::vector<double> power(std::min(count, detail::most_bins));
    Status status = detail::measured(set, [&](const auto *s) {
        return azulejo_space_axis_power(context.get(), s, axis, count, power.data());
    });
    if (status.ok()) out = std::move(power);
    return status;
}

/// See azulejo_mesh_uncovered_fraction.
inline Status try_mesh_uncovered_fraction(const Context &context, const Mesh &mesh,
                                          const SpacePoints &positions, double radius,
                                          std::uint64_t probes, std::uint64_t seed, double &out) {
    if (Status s = positions.check("positions"); !s.ok()) return s;
    return detail::run([&] {
        return azulejo_mesh_uncovered_fraction(context.get(), mesh.get(), positions.data(),
                                               positions.size(), radius, probes, seed, &out);
    });
}

/// See azulejo_mesh_coverage.
inline Status try_mesh_coverage(const Context &context, const Mesh &mesh,
                                const SpacePoints &positions, double radius, CoverageReport &out) {
    if (Status s = positions.check("positions"); !s.ok()) return s;
    return detail::run([&] {
        return azulejo_mesh_coverage(context.get(), mesh.get(), positions.data(), positions.size(),
                                     radius, &out);
    });
}

/// Tests each point for lying inside a mesh, 1 or 0; see azulejo_mesh_contains.
inline Status try_mesh_contains(const Context &context, const Mesh &mesh,
                                const SpacePoints &positions, std::vector<std::uint8_t> &out) {
    if (Status s = positions.check("positions"); !s.ok()) return s;
    std::vector<std::uint8_t> inside(positions.size());
    Status status(azulejo_mesh_contains(context.get(), mesh.get(), positions.data(), inside.size(),
                                        inside.data()));
    if (status.ok()) out = std::move(inside);
    return status;
}

/// The power spectrum of a set of the plane, or the mean of several; see azulejo_spectrum.
class Spectrum : public Owner<azulejo_spectrum, azulejo_spectrum_free> {
public:
    using Owner::Owner;
    Spectrum() noexcept = default;

    /// See azulejo_spectrum_create.
    static Status try_create(const Context &context, const PlaneSet &set, std::uint32_t size,
                             std::uint32_t frequency_stride, Spectrum &out) {
        azulejo_plane_set c_set = {};
        if (Status s = detail::c_set(set, c_set); !s.ok()) return s;
        return detail::make(out, [&](auto **spectrum) {
            return azulejo_spectrum_create(context.get(), &c_set, size, frequency_stride, spectrum);
        });
    }

    /// See azulejo_spectrum_mean.
    static Status try_mean(Span<const Spectrum> spectra, Spectrum &out) {
        const auto handles = detail::handles(spectra);
        return detail::make(out, [&](auto **spectrum) {
            return azulejo_spectrum_mean(handles.data(), handles.size(), spectrum);
        });
    }

    /// See azulejo_spectrum_radial.
    Status try_radial(double width, std::vector<Annulus> &out) const {
        std::size_t count = 0;
        const auto radial = [&](Annulus *annuli) {
            return azulejo_spectrum_radial(get(), width, annuli, count, sizeof *annuli, &count);
        };
        if (Status s{radial(nullptr)}; !s.ok()) return s;
        std::vector<Annulus> annuli(count);
        Status status(radial(annuli.data()));
        if (status.ok()) out = std::move(annuli);
        return status;
    }

    /// See azulejo_spectrum_measure.
    Status try_measure(double width, double low, double high, SpectrumReport &out) const {
        return Status(azulejo_spectrum_measure(get(), width, low, high, &out));
    }

#ifndef AZULEJO_NO_EXCEPTIONS
    Spectrum(const Context &context, const PlaneSet &set, std::uint32_t size,
             std::uint32_t stride = 1) {
        check(try_create(context, set, size, stride, *this));
    }

    static Spectrum mean(Span<const Spectrum> spectra) {
        Spectrum mean;
        check(try_mean(spectra, mean));
        return mean;
    }

    std::vector<Annulus> radial(double width) const {
        std::vector<Annulus> annuli;
        check(try_radial(width, annuli));
        return annuli;
    }

    SpectrumReport measure(double width, double low, double high) const {
        SpectrumReport report;
        check(try_measure(width, low, high, report));
        return report;
    }
#endif

    /// The frequencies per side; see azulejo_spectrum_size.
    std::uint32_t size() const noexcept { return azulejo_spectrum_size(get()); }
    /// size() * size() numbers, row by row; see azulejo_spectrum_power.
    Span<const float> power() const & noexcept {
        return {azulejo_spectrum_power(get()), std::size_t(size()) * size()};
    }
    Span<const float> power() const && = delete;
};

/// The differences of samples on a mesh, or of several sets; see azulejo_differences.
class Differences : public Owner<azulejo_differences, azulejo_differences_free> {
public:
    using Owner::Owner;
    Differences() noexcept = default;

    /// See azulejo_differences_create.
    static Status try_create(const Context &context, const Mesh &mesh, const SpacePoints &positions,
                             const SpacePoints &normals, const Triple &direction,
                             std::uint64_t seed, Differences &out) {
        if (Status s = positions.check("positions"); !s.ok()) return s;
        if (Status s = normals.check("normals"); !s.ok()) return s;
        if (normals.size() != positions.size()) {
            return Status(AZULEJO_ERROR_INVALID_ARGUMENT,
                          "normals: there are " + std::to_string(normals.size()) + ", and " +
                              std::to_string(positions.size()) + " positions");
        }
        return detail::make(out, [&](auto **differences) {
            return azulejo_differences_create(context.get(), mesh.get(), positions.data(),
                                              normals.data(), positions.size(), direction.data(),
                                              seed, differences);
        });
    }

    /// See azulejo_differences_mean.
    static Status try_mean(Span<const Differences> differences, Differences &out) {
        const auto handles = detail::handles(differences);
        return detail::make(out, [&](auto **mean) {
            return azulejo_differences_mean(handles.data(), handles.size(), mean);
        });
    }

    /// See azulejo_differences_power.
    Status try_power(Span<const double> frequencies, std::vector<double> &out) const {
        std::vector<double> power(frequencies.size());
        Status status(
            azulejo_differences_power(get(), frequencies.data(), power.size(), power.data()));
        if (status.ok()) out = std::move(power);
        return status;
    }

#ifndef AZULEJO_NO_EXCEPTIONS
    Differences(const Context &context, const Mesh &mesh, const SpacePoints &positions,
                const SpacePoints &normals, const Triple &direction, std::uint64_t seed = 0) {
        check(try_create(context, mesh, positions, normals, direction, seed, *this));
    }

    static Differences mean(Span<const Differences> differences) {
        Differences mean;
        check(try_mean(differences, mean));
        return mean;
    }

    std::vector<double> power(Span<const double> frequencies) const {
        std::vector<double> power;
        check(try_power(frequencies, power));
        return power;
    }
#endif

    /// See azulejo_differences_density.
    Span<const double> density() const & noexcept {
        const double *data = azulejo_differences_density(get());
        constexpr std::size_t size = AZULEJO_DIFFERENCES_SIZE;
        return {data, data ? size * size : 0};
    }
    Span<const double> density() const && = delete;
    /// See azulejo_differences_radial.
    Span<const double> radial() const & noexcept {
        const double *data = azulejo_differences_radial(get());
        return {data, data ? std::size_t(AZULEJO_DIFFERENCES_SHELLS) : 0};
    }
    Span<const double> radial() const && = delete;
};

// ---- The throwing forms: each does what its try_ function says ---------------------------------

#ifndef AZULEJO_NO_EXCEPTIONS

inline Points kdrt_sample(const Context &context, const KdrtOptions &options,
                          KdrtReport *report = nullptr) {
    Points points;
    check(try_kdrt_sample(context, options, points, report));
    return points;
}

inline Classes classes_radii(Span<const double> own, double factor = 1) {
    Classes classes;
    check(try_classes_radii(own, factor, classes));
    return classes;
}

inline Points kdrt_sample_classes(const Context &context, const KdrtOptions &options,
                                  const Classes &classes, ClassesReport *report = nullptr) {
    Points points;
    check(try_kdrt_sample_classes(context, options, classes, points, report));
    return points;
}

inline Points kdrt_sample_window(const Context &context, const KdrtOptions &options,
                                 const Pair &window_min, const Pair &window_max,
                                 KdrtReport *report = nullptr) {
    Points points;
    check(try_kdrt_sample_window(context, options, window_min, window_max, points, report));
    return points;
}

inline void kdrt_stream(const Context &context, const KdrtOptions &options,
                        const KdrtVisitor &visit, KdrtReport *report = nullptr) {
    check(try_kdrt_stream(context, options, visit, report));
}

inline Points kdrt_merge(const Context &context, const KdrtMergeOptions &options,
                         Span<const KdrtMergePiece> pieces, const PlanePoints &fixed = {},
                         KdrtMergeReport *report = nullptr) {
    Points points;
    check(try_kdrt_merge(context, options, pieces, fixed, points, report));
    return points;
}

inline Mask mask_create(const Context &context, const MaskOptions &options,
                        MaskReport *report = nullptr) {
    Mask mask;
    check(try_mask_create(context, options, mask, report));
    return mask;
}

inline Selection plane_thin(const Context &context, const ThinOptions &options,
                            const PlanePoints &positions, ThinReport *report = nullptr) {
    Selection selection;
    check(try_plane_thin(context, options, positions, selection, report));
    return selection;
}

inline Selection space_thin(const Context &context, const ThinOptions &options,
                            const SpacePoints &positions, ThinReport *report = nullptr) {
    Selection selection;
    check(try_space_thin(context, options, positions, selection, report));
    return selection;
}

inline Points maximal_sample(const Context &context, const MaximalOptions &options,
                             KdrtReport *report = nullptr) {
    Points points;
    check(try_maximal_sample(context, options, points, report));
    return points;
}

inline Points volume_sample(const Context &context, const VolumeOptions &options,
                            VolumeReport *report = nullptr) {
    Points points;
    check(try_volume_sample(context, options, points, report));
    return points;
}

inline Points volume_sample_classes(const Context &context, const VolumeOptions &options,
                                    const Classes &classes, ClassesReport *report = nullptr) {
    Points points;
    check(try_volume_sample_classes(context, options, classes, points, report));
    return points;
}

inline Points volume_sample_inside(const Context &context, const Mesh &mesh,
                                   const VolumeInsideOptions &options,
                                   VolumeInsideReport *report = nullptr) {
    Points points;
    check(try_volume_sample_inside(context, mesh, options, points, report));
    return points;
}

inline Points volume_adaptive_sample(const Context &context, const VolumeAdaptiveOptions &options,
                                     VolumeReport *report = nullptr) {
    Points points;
    check(try_volume_adaptive_sample(context, options, points, report));
    return points;
}

inline Points volume_adaptive_sample(const Context &context, const Mesh &mesh,
                                     const VolumeAdaptiveOptions &options,
                                     VolumeReport *report = nullptr) {
    Points points;
    check(try_volume_adaptive_sample(context, mesh, options, points, report));
    return points;
}

inline Points volume_relax(const Context &context, const VolumeRelaxOptions &options,
                           const SpacePoints &positions, VolumeRelaxReport *report = nullptr) {
    Points points;
    check(try_volume_relax(context, options, positions, points, report));
    return points;
}

inline Points volume_relax_inside(const Context &context, const Mesh &mesh,
                                  const VolumeRelaxInsideOptions &options,
                                  const SpacePoints &positions,
                                  VolumeRelaxReport *report = nullptr) {
    Points points;
    check(try_volume_relax_inside(context, mesh, options, positions, points, report));
    return points;
}

inline Points psp_sample_region(const Context &context, const Mesh &mesh,
                                const PspOptions &options, const Region &region,
                                PspReport *report = nullptr) {
    Points points;
    check(try_psp_sample_region(context, mesh, options, region, points, report));
    return points;
}

inline Points psp_sample_instances(const Context &context, Span<const Mesh> prototypes,
                                   Span<const azulejo_instance> instances,
                                   const PspOptions &options, PspReport *report = nullptr) {
    Points points;
    check(try_psp_sample_instances(context, prototypes, instances, options, points, report));
    return points;
}

inline Points psp_sample(const Context &context, const Mesh &mesh, const PspOptions &options,
                         PspReport *report = nullptr) {
    Points points;
    check(try_psp_sample(context, mesh, options, points, report));
    return points;
}

inline Points psp_sample_classes(const Context &context, const Mesh &mesh,
                                 const PspOptions &options, const Classes &classes,
                                 ClassesReport *report = nullptr) {
    Points points;
    check(try_psp_sample_classes(context, mesh, options, classes, points, report));
    return points;
}

inline Points psp_adaptive_sample(const Context &context, const Mesh &mesh,
                                  const PspAdaptiveOptions &options, PspReport *report = nullptr) {
    Points points;
    check(try_psp_adaptive_sample(context, mesh, options, points, report));
    return points;
}

inline Points dcr_relax(const Context &context, const DcrOptions &options,
                        const PlanePoints &positions, DcrReport *report = nullptr) {
    Points points;
    check(try_dcr_relax(context, options, positions, points, report));
    return points;
}

inline std::vector<double> dcr_correlation_of_power(double highest, Span<const double> power,
                                                    double reach, std::size_t bins) {
    std::vector<double> correlation;
    check(try_dcr_correlation_of_power(highest, power, reach, bins, correlation));
    return correlation;
}

inline Points dcr_relax_to_correlation(const Context &context, const DcrOptions &options,
                                       const PlanePoints &positions, double reach,
                                       Span<const double> correlation, DcrReport *report = nullptr,
                                       double *residual = nullptr) {
    Points points;
    check(try_dcr_relax_to_correlation(context, options, positions, reach, correlation, points,
                                       report, residual));
    return points;
}

inline Points dcr_relax_classes(const Context &context, const DcrOptions &options,
                                const PlanePoints &positions, Span<const std::uint32_t> classes,
                                std::uint32_t count, DcrReport *report = nullptr,
                                std::vector<std::array<double, 2>> *figures = nullptr) {
    Points points;
    check(try_dcr_relax_classes(context, options, positions, classes, count, points, report,
                                figures));
    return points;
}

inline Points dcr_scatter(const Context &context, const DcrOptions &options, const Density &density,
                          std::size_t count) {
    Points points;
    check(try_dcr_scatter(context, options, density, count, points));
    return points;
}

inline Points dcr_relax_density(const Context &context, const DcrOptions &options,
                                const Density &density, const PlanePoints &positions,
                                DcrReport *report = nullptr) {
    Points points;
    check(try_dcr_relax_density(context, options, density, positions, points, report));
    return points;
}

inline Points psp_adaptive_with_density(const Context &context, const Mesh &mesh,
                                          const PspAdaptiveOptions &options,
                                          const MeshDensity &density,
                                          PspReport *report = nullptr) {
    Points points;
    check(try_psp_adaptive_with_density(context, mesh, options, density, points, report));
    return points;
}

inline Points psp_classes_with_density(const Context &context, const Mesh &mesh,
                                       const PspOptions &options, const Classes &classes,
                                       const MeshDensity &density,
                                       ClassesReport *report = nullptr) {
    Points points;
    check(try_psp_classes_with_density(context, mesh, options, classes, density, points, report));
    return points;
}

inline Points dcr_surface_relax(const Context &context, const Mesh &mesh,
                                const DcrSurfaceOptions &options,
                                Span<const std::uint32_t> triangles,
                                const Tuples<float, 2> &barycentrics,
                                DcrSurfaceReport *report = nullptr) {
    Points points;
    check(try_dcr_surface_relax(context, mesh, options, triangles, barycentrics, points, report));
    return points;
}

inline Points dcr_surface_relax(const Context &context, const Mesh &mesh,
                                const DcrSurfaceOptions &options, const Points &samples,
                                DcrSurfaceReport *report = nullptr) {
    Points points;
    check(try_dcr_surface_relax(context, mesh, options, samples, points, report));
    return points;
}

inline Mesh dcr_remesh(const Context &context, const Mesh &mesh,
                       Span<const std::uint32_t> triangles,
                       const Tuples<float, 2> &barycentrics, DcrRemeshReport *report = nullptr) {
    Mesh made;
    check(try_dcr_remesh(context, mesh, triangles, barycentrics, made, report));
    return made;
}

inline Mesh dcr_remesh(const Context &context, const Mesh &mesh, const Points &samples,
                       DcrRemeshReport *report = nullptr) {
    Mesh made;
    check(try_dcr_remesh(context, mesh, samples, made, report));
    return made;
}

inline double plane_smallest_distance(const Context &context, const PlaneSet &set) {
    double distance = 0;
    check(try_plane_smallest_distance(context, set, distance));
    return distance;
}

inline double plane_covering_radius(const Context &context, const PlaneSet &set) {
    double radius = 0;
    check(try_plane_covering_radius(context, set, radius));
    return radius;
}

inline CoverageReport plane_coverage(const Context &context, const PlaneSet &set, double radius) {
    CoverageReport coverage;
    check(try_plane_coverage(context, set, radius, coverage));
    return coverage;
}

inline PlaneReport plane_measure(const Context &context, const PlaneSet &set) {
    PlaneReport report;
    check(try_plane_measure(context, set, report));
    return report;
}

inline std::vector<std::uint64_t> plane_nearest_histogram(const Context &context,
                                                          const PlaneSet &set, double reach,
                                                          std::size_t bins) {
    std::vector<std::uint64_t> histogram;
    check(try_plane_nearest_histogram(context, set, reach, bins, histogram));
    return histogram;
}

inline std::vector<double> plane_radial_distribution(const Context &context, const PlaneSet &set,
                                                     double reach, std::size_t bins) {
    std::vector<double> density;
    check(try_plane_radial_distribution(context, set, reach, bins, density));
    return density;
}

inline double space_smallest_distance(const Context &context, const SpacePoints &positions) {
    double distance = 0;
    check(try_space_smallest_distance(context, positions, distance));
    return distance;
}

inline CoverageReport space_coverage(const Context &context, const SpaceSet &set, double radius) {
    CoverageReport coverage;
    check(try_space_coverage(context, set, radius, coverage));
    return coverage;
}

/// Pairs nearer than `radius` are counted as conflicts.
inline SpaceReport space_measure(const Context &context, const SpaceSet &set, double radius = 0) {
    SpaceReport report;
    check(try_space_measure(context, set, radius, report));
    return report;
}

inline std::vector<double> space_radial_distribution(const Context &context, const SpaceSet &set,
                                                     double reach, std::size_t bins) {
    std::vector<double> density;
    check(try_space_radial_distribution(context, set, reach, bins, density));
    return density;
}

inline std::vector<Annulus> space_spectrum(const Context &context, const SpaceSet &set,
                                           double frequency_reach,
                                           std::uint32_t frequency_stride = 1,
                                           double width = 0.05) {
    std::vector<Annulus> annuli;
    check(try_space_spectrum(context, set, frequency_reach, frequency_stride, width, annuli));
    return annuli;
}

inline std::vector<double> space_axis_power(const Context &context, const SpaceSet &set,
                                            std::uint32_t axis, std::size_t count) {
    std::vector<double> power;
    check(try_space_axis_power(context, set, axis, count, power));
    return power;
}

inline double mesh_uncovered_fraction(const Context &context, const Mesh &mesh,
                                      const SpacePoints &positions, double radius,
                                      std::uint64_t probes, std::uint64_t seed = 0) {
    double fraction = 0;
    check(try_mesh_uncovered_fraction(context, mesh, positions, radius, probes, seed, fraction));
    return fraction;
}

inline CoverageReport mesh_coverage(const Context &context, const Mesh &mesh,
                                    const SpacePoints &positions, double radius) {
    CoverageReport coverage;
    check(try_mesh_coverage(context, mesh, positions, radius, coverage));
    return coverage;
}

inline std::vector<std::uint8_t> mesh_contains(const Context &context, const Mesh &mesh,
                                               const SpacePoints &positions) {
    std::vector<std::uint8_t> inside;
    check(try_mesh_contains(context, mesh, positions, inside));
    return inside;
}

#endif // AZULEJO_NO_EXCEPTIONS

#ifdef AZULEJO_NO_EXCEPTIONS
} // namespace no_exceptions
#endif

} // namespace azulejo

#endif // AZULEJO_HPP
