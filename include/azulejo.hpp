// azulejo for C++17: the C interface of azulejo.h with owners instead of handles, exceptions instead of status codes,
// and options that start with their defaults. Header only. What the calls do, their units, ranges and thread rules
// stand in azulejo.h, under the names of the C functions.

#ifndef AZULEJO_HPP
#define AZULEJO_HPP

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <limits>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "azulejo.h"

namespace azulejo {

/// A call that failed: what() is the library's message, which names the argument, its value and its range.
class Error : public std::runtime_error {
public:
    Error(azulejo_status status, const std::string &message) : std::runtime_error(message), status_(status) {}

    /// One of the AZULEJO_ERROR_ codes.
    azulejo_status status() const noexcept { return status_; }

private:
    azulejo_status status_;
};

/// Throws the last error of this thread, unless the status is AZULEJO_OK.
inline void check(azulejo_status status) {
    if (status == AZULEJO_OK) {
        return;
    }
    std::string message(azulejo_last_error_message(nullptr, 0), '\0');
    azulejo_last_error_message(message.data(), message.size());
    message.resize(message.empty() ? 0 : message.size() - 1); // the NUL
    throw Error(status, message);
}

/// The version of the library that the program runs with; see AZULEJO_VERSION.
inline std::uint32_t version() noexcept { return azulejo_version(); }

/// An array that belongs to someone else: a pointer and a size. What the accessors below return lives as long as the
/// object that they were called on.
template <class T>
class Span {
public:
    constexpr Span() noexcept = default;
    constexpr Span(T *data, std::size_t size) noexcept : data_(data), size_(size) {}
    /// Any container with data() and size(), such as std::vector and std::array.
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

/// Called on the calling thread with the finished share, from 0 to 1; returns whether to go on. A call that is stopped
/// throws an Error with AZULEJO_ERROR_CANCELLED. What the function itself throws stops the call too and leaves it.
using Progress = std::function<bool(double done)>;

/// Called on the calling thread with a part of the samples, x y each, which live until it returns; returns whether to go
/// on. A call that is stopped throws an Error with AZULEJO_ERROR_CANCELLED, or what the function threw.
using WindowVisitor = std::function<bool(Span<const float> xy)>;

/// The options of a call: the fields of the C struct, filled with their defaults, and a progress function.
template <class C, azulejo_status (*init)(C *, std::size_t)>
struct Options : C {
    Options() { check(init(this, sizeof(C))); }

    /// Takes the place of the C struct's two fields.
    Progress progress;
};

/// See azulejo_kdrt_options; `radius` or `count` is to be set.
using KdrtOptions = Options<azulejo_kdrt_options, azulejo_kdrt_options_init>;
/// See azulejo_maximal_options; `radius` has no default.
using MaximalOptions = Options<azulejo_maximal_options, azulejo_maximal_options_init>;
/// See azulejo_merge_options; `radius` has no default.
using MergeOptions = Options<azulejo_merge_options, azulejo_merge_options_init>;
/// See azulejo_psp_options; `radius` has no default.
using PspOptions = Options<azulejo_psp_options, azulejo_psp_options_init>;
/// Gives the radius at a place of a mesh. Called from several threads at once, the library's own; see azulejo_radius_fn.
/// What it throws fails the call and leaves it.
using RadiusFunction = std::function<double(const std::array<double, 3> &position)>;

/// See azulejo_adaptive_options; `vertex_radii` or `radius` is to be set.
struct AdaptiveOptions : Options<azulejo_adaptive_options, azulejo_adaptive_options_init> {
    /// Takes the place of the C struct's pointer and count; the radii stay the caller's.
    Span<const float> vertex_radii;
    /// Takes the place of the C struct's two fields.
    RadiusFunction radius;
};
/// See azulejo_dcr_options.
using DcrOptions = Options<azulejo_dcr_options, azulejo_dcr_options_init>;
/// See azulejo_dcr_surface_options.
using DcrSurfaceOptions = Options<azulejo_dcr_surface_options, azulejo_dcr_surface_options_init>;

/// Gives the density at a place of the plane. Called from several threads at once, the library's own; see
/// azulejo_density_fn. What it throws fails the call and leaves it.
using DensityFunction = std::function<double(const std::array<double, 2> &position)>;

/// How dense points shall be; see azulejo_density. An image of `width` pixels a row, which stays the caller's, or a
/// function.
struct Density {
    Span<const float> values;
    std::size_t width = 0;
    DensityFunction function;
};

using KdrtReport = azulejo_kdrt_report;
using MergeReport = azulejo_merge_report;
using PspReport = azulejo_psp_report;
using DcrReport = azulejo_dcr_report;
using DcrSurfaceReport = azulejo_dcr_surface_report;
using PlaneReport = azulejo_plane_report;
using SpectrumReport = azulejo_spectrum_report;
using Coverage = azulejo_coverage;
using Annulus = azulejo_annulus;

namespace detail {

/// How many groups of `width` numbers an array holds; a rest is refused.
inline std::size_t groups(std::size_t size, std::size_t width, const char *argument) {
    if (width == 0 || size % width != 0) {
        throw Error(AZULEJO_ERROR_INVALID_ARGUMENT, std::string(argument) + ": " + std::to_string(size) +
                                                        " numbers are not a multiple of " + std::to_string(width));
    }
    return size / width;
}

template <class T, void (*free)(T *)>
struct Free {
    void operator()(T *handle) const noexcept { free(handle); }
};

template <class T, void (*free)(T *)>
using Handle = std::unique_ptr<T, Free<T, free>>;

/// The C handles of several owners.
template <class C, class Owner>
std::vector<const C *> handles(Span<const Owner> owners) {
    std::vector<const C *> handles;
    for (const Owner &owner : owners) {
        handles.push_back(owner.get());
    }
    return handles;
}

/// Runs a function of the caller's where C called it: 0 to go on, 1 to stop. An exception waits in `thrown`.
template <class Function>
std::int32_t guarded(std::exception_ptr &thrown, Function function) noexcept {
    try {
        return function() ? 0 : 1;
    } catch (...) {
        thrown = std::current_exception();
        return 1;
    }
}

/// A progress function where C can call it: exceptions wait here until the call is over.
class Watch {
public:
    explicit Watch(Progress progress) : progress_(std::move(progress)) {}
    Watch(const Watch &) = delete;
    Watch &operator=(const Watch &) = delete;

    /// Makes the options tell this object.
    template <class C>
    void attach(C &options) {
        options.progress = progress_ ? &Watch::call : nullptr;
        options.progress_user = this;
    }

    /// A context with the same threads that tells this object.
    Handle<azulejo_context, azulejo_context_free> attached(const azulejo_context *context) {
        azulejo_context *handle = nullptr;
        check(azulejo_context_watch(context, progress_ ? &Watch::call : nullptr, this, &handle));
        return Handle<azulejo_context, azulejo_context_free>(handle);
    }

    /// To be called with what the call returned.
    void finish(azulejo_status status) {
        if (thrown_) {
            std::rethrow_exception(std::exchange(thrown_, nullptr));
        }
        check(status);
    }

private:
    static std::int32_t call(void *user, double done) noexcept {
        auto *watch = static_cast<Watch *>(user);
        return guarded(watch->thrown_, [&] { return watch->progress_(done); });
    }

    Progress progress_;
    std::exception_ptr thrown_;
};

/// Runs a C call with the C struct of these options, whose progress is told to the caller's function.
template <class C, azulejo_status (*init)(C *, std::size_t), class Call>
void watched(const Options<C, init> &options, Call call) {
    Watch watch(options.progress);
    C c_options = options;
    watch.attach(c_options);
    watch.finish(call(&c_options));
}

} // namespace detail

/// The threads that calls run on; see azulejo_context. Like all owners here it can be moved, not copied; an object that
/// was moved from holds NULL.
class Context {
public:
    /// 0 takes one thread per core.
    explicit Context(std::uint32_t num_threads = 0) {
        azulejo_context *handle = nullptr;
        check(azulejo_context_create(num_threads, &handle));
        handle_.reset(handle);
    }

    std::uint32_t num_threads() const noexcept { return azulejo_context_num_threads(get()); }
    /// The C handle, which stays this object's.
    const azulejo_context *get() const noexcept { return handle_.get(); }

private:
    detail::Handle<azulejo_context, azulejo_context_free> handle_;
};

namespace detail {

/// Runs a C call without options, of which the caller's function is told.
template <class Call>
void measured(const Context &context, const Progress &progress, Call call) {
    Watch watch(progress);
    watch.finish(call(watch.attached(context.get()).get()));
}

} // namespace detail

/// Samples of the plane or of a mesh; see azulejo_points.
class Points {
public:
    /// Takes a C handle over.
    explicit Points(azulejo_points *handle) noexcept : handle_(handle) {}

    /// The number of samples.
    std::size_t size() const noexcept { return azulejo_points_count(get()); }
    /// 2 for samples of the plane, 3 for samples of a mesh.
    std::uint32_t dimension() const noexcept { return azulejo_points_dimension(get()); }
    /// dimension() coordinates for each sample.
    Span<const float> positions() const noexcept { return {azulejo_points_positions(get()), size() * dimension()}; }
    /// Three coordinates for each sample of a mesh; empty for the plane, as are the next three.
    Span<const float> normals() const noexcept { return surface(azulejo_points_normals(get()), 3); }
    /// The normals that the mesh carries, interpolated; empty if it carries none. See azulejo_points_interpolated_normals.
    Span<const float> interpolated_normals() const noexcept {
        return surface(azulejo_points_interpolated_normals(get()), 3);
    }
    /// The triangle of each sample.
    Span<const std::uint32_t> triangles() const noexcept { return surface(azulejo_points_triangles(get()), 1); }
    /// u v of each sample: its position is (1 - u - v) * a + u * b + v * c.
    Span<const float> barycentrics() const noexcept { return surface(azulejo_points_barycentrics(get()), 2); }
    /// The radius of each sample of psp_sample_adaptive; empty for all other sets.
    Span<const double> radii() const noexcept {
        const double *data = azulejo_points_radii(get());
        return {data, data ? size() : 0};
    }
    /// The C handle, which stays this object's.
    const azulejo_points *get() const noexcept { return handle_.get(); }

private:
    template <class T>
    Span<const T> surface(const T *data, std::size_t width) const noexcept {
        return {data, data ? width * size() : 0};
    }

    detail::Handle<azulejo_points, azulejo_points_free> handle_;
};

/// A checked triangle mesh; see azulejo_mesh.
class Mesh {
public:
    /// Packed arrays: x y z of each vertex, three indices for each triangle.
    Mesh(Span<const float> positions, Span<const std::uint32_t> indices)
        : Mesh(positions.data(), detail::groups(positions.size(), 3, "positions"), 3 * sizeof(float), indices.data(),
               detail::groups(indices.size(), 3, "indices")) {}

    /// See azulejo_mesh_create.
    Mesh(const float *positions, std::size_t vertex_count, std::size_t stride_bytes, const std::uint32_t *indices,
         std::size_t triangle_count) {
        azulejo_mesh *handle = nullptr;
        check(azulejo_mesh_create(positions, vertex_count, stride_bytes, indices, triangle_count, &handle));
        handle_.reset(handle);
    }

    /// An OBJ, PLY or STL file; see azulejo_mesh_load.
    static Mesh load(const std::string &path) {
        azulejo_mesh *handle = nullptr;
        check(azulejo_mesh_load(path.c_str(), &handle));
        return Mesh(handle);
    }

    /// Triangles of an RTCScene of the caller's; see azulejo_mesh_create_from_embree.
    static Mesh from_embree(void *scene, Span<const azulejo_embree_geometry> geometries) {
        azulejo_mesh *handle = nullptr;
        check(azulejo_mesh_create_from_embree(scene, geometries.data(), geometries.size(), &handle));
        return Mesh(handle);
    }

    /// This mesh with normals: packed, one for each vertex, or named by three indices for each triangle; see
    /// azulejo_mesh_with_normals.
    Mesh with_normals(Span<const float> normals, Span<const std::uint32_t> normal_indices = {}) const {
        return with_normals(normals.data(), detail::groups(normals.size(), 3, "normals"), 3 * sizeof(float), normal_indices);
    }

    /// See azulejo_mesh_with_normals.
    Mesh with_normals(const float *normals, std::size_t normal_count, std::size_t stride_bytes,
                      Span<const std::uint32_t> normal_indices = {}) const {
        azulejo_mesh *handle = nullptr;
        check(azulejo_mesh_with_normals(get(), normals, normal_count, stride_bytes, normal_indices.data(),
                                        detail::groups(normal_indices.size(), 3, "normal_indices"), &handle));
        return Mesh(handle);
    }

    /// This mesh without the triangles whose entry is 0; see azulejo_mesh_with_mask.
    Mesh with_mask(Span<const std::uint8_t> mask) const {
        azulejo_mesh *handle = nullptr;
        check(azulejo_mesh_with_mask(get(), mask.data(), mask.size(), &handle));
        return Mesh(handle);
    }

    /// Whether the mesh carries normals besides those of its triangles.
    bool has_normals() const noexcept { return azulejo_mesh_has_normals(get()) != 0; }

    std::size_t vertex_count() const noexcept { return azulejo_mesh_vertex_count(get()); }
    std::size_t triangle_count() const noexcept { return azulejo_mesh_triangle_count(get()); }
    /// x y z of each vertex.
    Span<const float> positions() const noexcept { return {azulejo_mesh_positions(get()), 3 * vertex_count()}; }
    /// Three vertices for each triangle.
    Span<const std::uint32_t> indices() const noexcept { return {azulejo_mesh_indices(get()), 3 * triangle_count()}; }
    /// The area of all triangles that no mask leaves out.
    double area() const noexcept { return azulejo_mesh_area(get()); }
    /// The C handle, which stays this object's.
    const azulejo_mesh *get() const noexcept { return handle_.get(); }

private:
    explicit Mesh(azulejo_mesh *handle) noexcept : handle_(handle) {}

    detail::Handle<azulejo_mesh, azulejo_mesh_free> handle_;
};

/// A set of samples on a mesh that grows; see azulejo_psp. It keeps what it needs of the context and the mesh.
class Psp {
public:
    Psp(const Context &context, const Mesh &mesh, const PspOptions &options)
        : watch_(std::make_unique<detail::Watch>(options.progress)) {
        azulejo_psp_options c_options = options;
        watch_->attach(c_options);
        azulejo_psp *handle = nullptr;
        watch_->finish(azulejo_psp_create(context.get(), mesh.get(), &c_options, &handle));
        handle_.reset(handle);
    }

    /// Adds samples by projection.
    PspReport advance(std::uint32_t iterations) {
        PspReport report;
        finish(azulejo_psp_advance(handle_.get(), iterations, &report));
        return report;
    }

    /// Makes the set maximal.
    PspReport fill() {
        PspReport report;
        finish(azulejo_psp_fill(handle_.get(), &report));
        return report;
    }

    /// A copy of the set as it is now.
    Points points() const {
        azulejo_points *points = nullptr;
        check(azulejo_psp_points(handle_.get(), &points));
        return Points(points);
    }

private:
    // An object that was moved from has no watch.
    void finish(azulejo_status status) { watch_ ? watch_->finish(status) : check(status); }

    std::unique_ptr<detail::Watch> watch_; // where the handle's callback finds it, wherever this object moves
    detail::Handle<azulejo_psp, azulejo_psp_free> handle_;
};

/// A maximal set of samples of a rectangle; see azulejo_kdrt_sample_with_report. `report` may be null.
inline Points kdrt_sample(const Context &context, const KdrtOptions &options, KdrtReport *report = nullptr) {
    azulejo_points *points = nullptr;
    detail::watched(options,
                    [&](auto *o) { return azulejo_kdrt_sample_with_report(context.get(), o, &points, report); });
    return Points(points);
}

/// The part of kdrt_sample's set that lies in a window of the domain; see azulejo_kdrt_sample_window.
inline Points kdrt_sample_window(const Context &context, const KdrtOptions &options, const double (&window_min)[2],
                                 const double (&window_max)[2]) {
    azulejo_points *points = nullptr;
    detail::watched(options, [&](auto *o) {
        return azulejo_kdrt_sample_window(context.get(), o, window_min, window_max, &points);
    });
    return Points(points);
}

/// Hands the samples of kdrt_sample out part by part instead of keeping them; see azulejo_kdrt_stream.
inline void kdrt_stream(const Context &context, const KdrtOptions &options, const WindowVisitor &visit) {
    struct Guest {
        const WindowVisitor &visit;
        std::exception_ptr thrown;

        static std::int32_t call(void *user, const float *xy, std::size_t count) noexcept {
            auto *guest = static_cast<Guest *>(user);
            return detail::guarded(guest->thrown, [&] { return guest->visit({xy, 2 * count}); });
        }
    } guest{visit, nullptr};
    detail::watched(options, [&](auto *o) {
        const auto status = azulejo_kdrt_stream(context.get(), o, visit ? &Guest::call : nullptr, &guest);
        if (guest.thrown) {
            std::rethrow_exception(guest.thrown);
        }
        return status;
    });
}

/// A set of samples, x y each, with its rectangle; see azulejo_merge_piece. The samples stay the caller's.
struct MergePiece {
    Span<const float> xy;
    double min[2];
    double max[2];
};

/// Glues sets on rectangles that do not overlap, and points that must stay, into one maximal set; see azulejo_kdrt_merge.
/// `report` may be null.
inline Points kdrt_merge(const Context &context, const MergeOptions &options, Span<const MergePiece> pieces,
                         Span<const float> fixed = {}, MergeReport *report = nullptr) {
    std::vector<azulejo_merge_piece> c_pieces;
    for (const auto &[xy, min, max] : pieces) {
        c_pieces.push_back({xy.data(), detail::groups(xy.size(), 2, "xy"), {min[0], min[1]}, {max[0], max[1]}});
    }
    azulejo_points *points = nullptr;
    const std::size_t count = detail::groups(fixed.size(), 2, "fixed");
    detail::watched(options, [&](auto *o) {
        return azulejo_kdrt_merge(context.get(), o, c_pieces.data(), c_pieces.size(), fixed.data(), count, &points,
                                  report);
    });
    return Points(points);
}

/// The unbiased reference, slowly; see azulejo_maximal_sample.
inline Points maximal_sample(const Context &context, const MaximalOptions &options) {
    azulejo_points *points = nullptr;
    detail::watched(options, [&](auto *o) { return azulejo_maximal_sample(context.get(), o, &points); });
    return Points(points);
}

/// Samples of a mesh in one call; see azulejo_psp_sample. `report` may be null.
inline Points psp_sample(const Context &context, const Mesh &mesh, const PspOptions &options,
                         PspReport *report = nullptr) {
    azulejo_points *points = nullptr;
    detail::watched(options,
                    [&](auto *o) { return azulejo_psp_sample(context.get(), mesh.get(), o, &points, report); });
    return Points(points);
}

namespace detail {

/// A function of the caller's that the library calls on several threads; it keeps what the function throws.
template <std::size_t dimension>
struct Guest {
    const std::function<double(const std::array<double, dimension> &)> &function;
    std::mutex lock;
    std::exception_ptr thrown;

    static double call(void *user, const double *position) noexcept {
        auto *guest = static_cast<Guest *>(user);
        try {
            std::array<double, dimension> place;
            std::copy_n(position, dimension, place.begin());
            return guest->function(place);
        } catch (...) {
            const std::lock_guard<std::mutex> guard(guest->lock);
            guest->thrown = std::current_exception();
            return std::numeric_limits<double>::quiet_NaN(); // which fails the call
        }
    }

    /// The status of a call, unless the function threw in it.
    azulejo_status checked(azulejo_status status) const {
        if (thrown) {
            std::rethrow_exception(thrown);
        }
        return status;
    }
};

/// The C struct of a density, whose function is the guest's.
inline azulejo_density density(const Density &density, Guest<2> &guest) {
    azulejo_density result;
    check(azulejo_density_init(&result, sizeof result));
    result.values = density.values.data();
    result.width = density.width;
    result.height = density.values.empty() ? 0 : groups(density.values.size(), density.width, "values");
    result.function = density.function ? &Guest<2>::call : nullptr;
    result.user = &guest;
    return result;
}

} // namespace detail

/// Samples of a mesh, each with a radius of its own; see azulejo_psp_sample_adaptive. `report` may be null.
inline Points psp_sample_adaptive(const Context &context, const Mesh &mesh, const AdaptiveOptions &options,
                                  PspReport *report = nullptr) {
    detail::Guest<3> guest{options.radius, {}, nullptr};
    azulejo_points *points = nullptr;
    detail::watched(options, [&](auto *o) {
        o->vertex_radii = options.vertex_radii.data();
        o->vertex_count = options.vertex_radii.size();
        o->radius = options.radius ? &detail::Guest<3>::call : nullptr;
        o->radius_user = &guest;
        return guest.checked(azulejo_psp_sample_adaptive(context.get(), mesh.get(), o, &points, report));
    });
    return Points(points);
}

namespace detail {

/// The points of a call that succeeds when it is cancelled: they need an owner before the callback's exception goes on.
template <class O, class F> Points relaxed(const O &options, F call) {
    Points points(nullptr);
    watched(options, [&](auto *o) {
        azulejo_points *relaxed = nullptr;
        const auto status = call(o, &relaxed);
        points = Points(relaxed);
        return status;
    });
    return points;
}

} // namespace detail

/// Relaxes points of the plane, x y each; see azulejo_dcr_relax. `report` may be null.
inline Points dcr_relax(const Context &context, const DcrOptions &options, Span<const float> xy,
                        DcrReport *report = nullptr) {
    const std::size_t count = detail::groups(xy.size(), 2, "xy");
    return detail::relaxed(options, [&](auto *o, azulejo_points **out) {
        return azulejo_dcr_relax(context.get(), o, xy.data(), count, out, report);
    });
}

/// Random points of the plane, as dense as asked for; see azulejo_dcr_scatter.
inline Points dcr_scatter(const Context &context, const DcrOptions &options, const Density &density, std::size_t count) {
    detail::Guest<2> guest{density.function, {}, nullptr};
    const azulejo_density wanted = detail::density(density, guest);
    azulejo_points *points = nullptr;
    check(guest.checked(azulejo_dcr_scatter(context.get(), &options, &wanted, count, &points)));
    return Points(points);
}

/// Relaxes points of the plane, x y each, to a density; see azulejo_dcr_relax_density. `report` may be null.
inline Points dcr_relax_density(const Context &context, const DcrOptions &options, const Density &density,
                                Span<const float> xy, DcrReport *report = nullptr) {
    detail::Guest<2> guest{density.function, {}, nullptr};
    const azulejo_density wanted = detail::density(density, guest);
    const std::size_t count = detail::groups(xy.size(), 2, "xy");
    return detail::relaxed(options, [&](auto *o, azulejo_points **out) {
        return guest.checked(azulejo_dcr_relax_density(context.get(), o, &wanted, xy.data(), count, out, report));
    });
}

/// Relaxes samples of a mesh, a triangle and the barycentrics u v for each; see azulejo_dcr_relax_surface. `report` may be
/// null.
inline Points dcr_relax_surface(const Context &context, const Mesh &mesh, const DcrSurfaceOptions &options,
                                Span<const std::uint32_t> triangles, Span<const float> barycentrics,
                                DcrSurfaceReport *report = nullptr) {
    const std::size_t count = detail::groups(barycentrics.size(), 2, "barycentrics");
    if (count != triangles.size()) {
        throw Error(AZULEJO_ERROR_INVALID_ARGUMENT, "triangles: there are " + std::to_string(triangles.size()) +
                                                        ", and barycentrics of " + std::to_string(count) + " samples");
    }
    return detail::relaxed(options, [&](auto *o, azulejo_points **out) {
        return azulejo_dcr_relax_surface(context.get(), mesh.get(), o, triangles.data(), barycentrics.data(), count,
                                         out, report);
    });
}

/// See azulejo_plane_smallest_distance; the domain as in the options.
inline double plane_smallest_distance(const Context &context, Span<const float> xy, const double (&domain_min)[2],
                                      const double (&domain_max)[2], std::int32_t boundary,
                                      const Progress &progress = nullptr) {
    double distance = 0;
    detail::measured(context, progress, [&](const azulejo_context *c) {
        return azulejo_plane_smallest_distance(c, xy.data(), detail::groups(xy.size(), 2, "xy"), domain_min,
                                               domain_max, boundary, &distance);
    });
    return distance;
}

/// See azulejo_plane_covering_radius; the domain as in the options.
inline double plane_covering_radius(const Context &context, Span<const float> xy, const double (&domain_min)[2],
                                    const double (&domain_max)[2], std::int32_t boundary,
                                    const Progress &progress = nullptr) {
    double radius = 0;
    detail::measured(context, progress, [&](const azulejo_context *c) {
        return azulejo_plane_covering_radius(c, xy.data(), detail::groups(xy.size(), 2, "xy"), domain_min, domain_max,
                                             boundary, &radius);
    });
    return radius;
}

/// See azulejo_space_smallest_distance.
inline double space_smallest_distance(const Context &context, Span<const float> positions,
                                      const Progress &progress = nullptr) {
    double distance = 0;
    detail::measured(context, progress, [&](const azulejo_context *c) {
        return azulejo_space_smallest_distance(c, positions.data(), detail::groups(positions.size(), 3, "positions"),
                                               &distance);
    });
    return distance;
}

/// See azulejo_mesh_uncovered_fraction.
inline double mesh_uncovered_fraction(const Context &context, const Mesh &mesh, Span<const float> positions, double radius,
                                      std::uint64_t probes, std::uint64_t seed = 0,
                                      const Progress &progress = nullptr) {
    double fraction = 0;
    detail::measured(context, progress, [&](const azulejo_context *c) {
        return azulejo_mesh_uncovered_fraction(c, mesh.get(), positions.data(),
                                               detail::groups(positions.size(), 3, "positions"), radius, probes, seed,
                                               &fraction);
    });
    return fraction;
}

/// See azulejo_mesh_coverage.
inline Coverage mesh_coverage(const Context &context, const Mesh &mesh, Span<const float> positions, double radius,
                              const Progress &progress = nullptr) {
    Coverage coverage;
    detail::measured(context, progress, [&](const azulejo_context *c) {
        return azulejo_mesh_coverage(c, mesh.get(), positions.data(),
                                     detail::groups(positions.size(), 3, "positions"), radius, &coverage);
    });
    return coverage;
}

/// See azulejo_plane_coverage; the domain as in the options.
inline Coverage plane_coverage(const Context &context, Span<const float> xy, const double (&domain_min)[2],
                               const double (&domain_max)[2], std::int32_t boundary, double radius,
                               const Progress &progress = nullptr) {
    Coverage coverage;
    detail::measured(context, progress, [&](const azulejo_context *c) {
        return azulejo_plane_coverage(c, xy.data(), detail::groups(xy.size(), 2, "xy"), domain_min, domain_max,
                                      boundary, radius, &coverage);
    });
    return coverage;
}

/// See azulejo_plane_measure; the domain as in the options.
inline PlaneReport plane_measure(const Context &context, Span<const float> xy, const double (&domain_min)[2],
                                 const double (&domain_max)[2], std::int32_t boundary,
                                 const Progress &progress = nullptr) {
    PlaneReport report;
    detail::measured(context, progress, [&](const azulejo_context *c) {
        return azulejo_plane_measure(c, xy.data(), detail::groups(xy.size(), 2, "xy"), domain_min, domain_max,
                                     boundary, &report);
    });
    return report;
}

/// See azulejo_plane_nearest_histogram; the domain as in the options.
inline std::vector<std::uint64_t> plane_nearest_histogram(const Context &context, Span<const float> xy,
                                                          const double (&domain_min)[2], const double (&domain_max)[2],
                                                          std::int32_t boundary, double reach, std::size_t bins,
                                                          const Progress &progress = nullptr) {
    std::vector<std::uint64_t> histogram(bins);
    detail::measured(context, progress, [&](const azulejo_context *c) {
        return azulejo_plane_nearest_histogram(c, xy.data(), detail::groups(xy.size(), 2, "xy"), domain_min,
                                               domain_max, boundary, reach, bins, histogram.data());
    });
    return histogram;
}

/// See azulejo_plane_radial_distribution; the domain as in the options.
inline std::vector<double> plane_radial_distribution(const Context &context, Span<const float> xy,
                                                     const double (&domain_min)[2], const double (&domain_max)[2],
                                                     std::int32_t boundary, double reach, std::size_t bins,
                                                     const Progress &progress = nullptr) {
    std::vector<double> density(bins);
    detail::measured(context, progress, [&](const azulejo_context *c) {
        return azulejo_plane_radial_distribution(c, xy.data(), detail::groups(xy.size(), 2, "xy"), domain_min,
                                                 domain_max, boundary, reach, bins, density.data());
    });
    return density;
}

/// The power spectrum of a set of the plane, or the mean of several; see azulejo_spectrum.
class Spectrum {
public:
    /// See azulejo_spectrum_create; the domain as in the options.
    Spectrum(const Context &context, Span<const float> xy, const double (&domain_min)[2],
             const double (&domain_max)[2], std::int32_t boundary, std::uint32_t size, std::uint32_t stride = 1,
             const Progress &progress = nullptr) {
        azulejo_spectrum *handle = nullptr;
        detail::measured(context, progress, [&](const azulejo_context *c) {
            return azulejo_spectrum_create(c, xy.data(), detail::groups(xy.size(), 2, "xy"), domain_min, domain_max,
                                           boundary, size, stride, &handle);
        });
        handle_.reset(handle);
    }

    /// See azulejo_spectrum_mean.
    static Spectrum mean(Span<const Spectrum> spectra) {
        const std::vector<const azulejo_spectrum *> handles = detail::handles<azulejo_spectrum>(spectra);
        azulejo_spectrum *handle = nullptr;
        check(azulejo_spectrum_mean(handles.data(), handles.size(), &handle));
        return Spectrum(handle);
    }

    /// The frequencies per side.
    std::uint32_t size() const noexcept { return azulejo_spectrum_size(get()); }
    /// size() * size() numbers, row by row.
    Span<const float> power() const noexcept {
        return {azulejo_spectrum_power(get()), std::size_t(size()) * size()};
    }
    /// See azulejo_spectrum_radial.
    std::vector<Annulus> radial(double width) const {
        std::size_t count = 0;
        check(azulejo_spectrum_radial(get(), width, nullptr, 0, &count));
        std::vector<Annulus> annuli(count);
        check(azulejo_spectrum_radial(get(), width, annuli.data(), count, &count));
        return annuli;
    }
    /// See azulejo_spectrum_measure.
    SpectrumReport measure(double width, double low, double high) const {
        SpectrumReport report;
        check(azulejo_spectrum_measure(get(), width, low, high, &report));
        return report;
    }
    /// The C handle, which stays this object's.
    const azulejo_spectrum *get() const noexcept { return handle_.get(); }

private:
    explicit Spectrum(azulejo_spectrum *handle) noexcept : handle_(handle) {}

    detail::Handle<azulejo_spectrum, azulejo_spectrum_free> handle_;
};

/// The differences of samples on a mesh, or of several sets; see azulejo_differences.
class Differences {
public:
    /// See azulejo_differences_create.
    Differences(const Context &context, const Mesh &mesh, Span<const float> positions, Span<const float> normals,
                const double (&direction)[3], std::uint64_t seed = 0, const Progress &progress = nullptr) {
        if (normals.size() != positions.size()) {
            throw Error(AZULEJO_ERROR_INVALID_ARGUMENT, "normals: " + std::to_string(normals.size()) +
                                                            " numbers, not as many as positions");
        }
        azulejo_differences *handle = nullptr;
        detail::measured(context, progress, [&](const azulejo_context *c) {
            return azulejo_differences_create(c, mesh.get(), positions.data(), normals.data(),
                                              detail::groups(positions.size(), 3, "positions"), direction, seed,
                                              &handle);
        });
        handle_.reset(handle);
    }

    /// See azulejo_differences_mean.
    static Differences mean(Span<const Differences> differences) {
        const std::vector<const azulejo_differences *> handles = detail::handles<azulejo_differences>(differences);
        azulejo_differences *handle = nullptr;
        check(azulejo_differences_mean(handles.data(), handles.size(), &handle));
        return Differences(handle);
    }

    /// See azulejo_differences_density.
    Span<const double> density() const noexcept {
        const double *data = azulejo_differences_density(get());
        return {data, data ? std::size_t(AZULEJO_DIFFERENCES_SIZE) * AZULEJO_DIFFERENCES_SIZE : 0};
    }
    /// See azulejo_differences_radial.
    Span<const double> radial() const noexcept {
        const double *data = azulejo_differences_radial(get());
        return {data, data ? std::size_t(AZULEJO_DIFFERENCES_SHELLS) : 0};
    }
    /// See azulejo_differences_power.
    std::vector<double> power(Span<const double> frequencies) const {
        std::vector<double> power(frequencies.size());
        check(azulejo_differences_power(get(), frequencies.data(), frequencies.size(), power.data()));
        return power;
    }
    /// The C handle, which stays this object's.
    const azulejo_differences *get() const noexcept { return handle_.get(); }

private:
    explicit Differences(azulejo_differences *handle) noexcept : handle_(handle) {}

    detail::Handle<azulejo_differences, azulejo_differences_free> handle_;
};

} // namespace azulejo

#endif // AZULEJO_HPP
