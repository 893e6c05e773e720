/*
 * azulejo: blue-noise sampling of planes, triangle meshes and volumes; relaxation of point sets.
 *
 * This header is generated from ffi/azulejo-c by cbindgen; do not edit it. It is C99. C++ programs
 * may prefer azulejo.hpp, which wraps it.
 *
 * The shortest program (link with -lazulejo):
 *
 *   azulejo_context *context;
 *   azulejo_kdrt_options options;
 *   azulejo_points *points;
 *   azulejo_context_create(0, &context);
 *   azulejo_kdrt_options_init(&options, sizeof options);
 *   options.radius = 0.01;
 *   if (azulejo_kdrt_sample(context, &options, &points, NULL) == AZULEJO_OK) {
 *       const float *positions = azulejo_points_positions(points);
 *       size_t count = azulejo_points_count(points);
 *       ... positions[2 * i] and positions[2 * i + 1] for i from 0 to count - 1 ...
 *       azulejo_points_free(points);
 *   }
 *   azulejo_context_free(context);
 *
 * Which call do I want?
 *
 *   samples of a rectangle                        azulejo_kdrt_sample
 *   a plane, part by part                         azulejo_kdrt_create, azulejo_kdrt_window
 *   a plane without end, into the host's arrays   azulejo_kdrt_create or azulejo_kdrt_create_wide,
 *                                                 azulejo_kdrt_window_into
 *   more samples than memory holds                azulejo_kdrt_stream
 *   a plane under a brush: erase, refill, undo    azulejo_plane_create, _erase, _refill
 *   a rectangle with a density, such as an image  azulejo_dcr_scatter, azulejo_dcr_relax_density
 *   samples of a mesh                             azulejo_psp_sample
 *   many instances of some meshes                 azulejo_psp_sample_instances
 *   a mesh whose radius or density varies         azulejo_psp_adaptive_sample, _with_density
 *   a mesh under a brush: erase, refill, undo     azulejo_psp_create, azulejo_psp_erase, _refill
 *   several kinds of things, such as plants       azulejo_kdrt_..., psp_..., volume_sample_classes
 *   the same on a mesh, with a density            azulejo_psp_classes_with_density
 *   levels of detail, which are prefixes          the same calls, with `order` progressive
 *   sets that exist, joined without seams         azulejo_kdrt_merge
 *   fewer points of a cloud that exists           azulejo_thin
 *   points that exist, more evenly spread         azulejo_dcr_relax, azulejo_dcr_surface_relax,
 *                                                 azulejo_volume_relax, azulejo_volume_relax_inside
 *   a mesh whose vertices are the samples         azulejo_dcr_remesh
 *   samples of a cuboid                           azulejo_volume_sample
 *   samples inside a mesh                         azulejo_volume_sample_inside
 *   a volume whose radius varies                  azulejo_volume_adaptive_sample
 *   which points are inside a mesh                azulejo_mesh_contains
 *   proof: distances, gaps, spectra               azulejo_plane_measure, azulejo_space_measure,
 *                                                 azulejo_mesh_coverage, azulejo_spectrum_create
 *   a blue-noise mask, to dither or per pixel     azulejo_mask_create
 *   the slow unbiased reference                   azulejo_maximal_sample
 *
 * azulejo/base.h has what all calls share; azulejo/kdrt.h, psp.h, volume.h, dcr.h, thin.h, mask.h
 * and analysis.h have the calls, each with its options before it. Each can be included alone. The
 * guide is docs/integrating.md, a table of all options docs/options.md.
 *
 * The following holds for every function; their texts state exceptions only.
 *
 * Terms. A radius is the smallest distance allowed between the centres of two samples; where it
 *   varies from sample to sample, the mean of the two radii is. A set is conflict-free if no two
 *   samples are closer than the radius, in double arithmetic on the returned floats, without
 *   tolerance. It is maximal if no place of the domain or surface is farther than the radius from
 *   every sample, up to the rounding of the returned floats: 3 float spacings in the plane, 6 for
 *   merged sets, around given samples and on meshes. A float spacing is the distance between
 *   neighbouring floats at the largest coordinate of the domain or mesh. The covering radius of a
 *   set is the distance from its samples of the place that is farthest from all of them. d_max is
 *   sqrt(2 * area / (sqrt(3) * count)), the distance of neighbours if as many samples stood in
 *   hexagonal arrangement; rho is the smallest distance in units of d_max.
 *
 * Values. Lengths are in the units of the domain or the mesh; distances on meshes are straight.
 *   Points of the plane lie in domain_min <= x < domain_max on both axes, those that the library
 *   makes and those that it takes. Numbers must be finite. A seed may be any number; another seed
 *   gives another set.
 *
 * Status. A call that can fail returns an azulejo_status: AZULEJO_OK (0) or a negative
 *   AZULEJO_ERROR_ code. azulejo_last_error_message then names the argument, its value and its
 *   range. Arguments are checked before any work starts. A call that fails writes no output and
 *   changes no handle. No exception leaves the library. Nothing is printed to stdout; a panic
 *   prints to stderr.
 *
 * Errors. A function lists the codes and reasons of its own. The following are possible in most:
 *   - AZULEJO_ERROR_INVALID_ARGUMENT for a pointer that is NULL or not aligned for its type, a
 *     value outside its documented range, an unknown constant, a flag other than 0 and 1, and an
 *     option that its text excludes from the call;
 *   - AZULEJO_ERROR_TOO_LARGE for 2^32 samples or more, and for more than memory holds;
 *   - AZULEJO_ERROR_CANCELLED in calls that report progress, AZULEJO_ERROR_BUSY in those of a psp
 *     or plane handle, AZULEJO_ERROR_THREADS in those with a context (see "Threads");
 *   - AZULEJO_ERROR_INTERNAL for a panic inside the library, which is a bug.
 *
 * Arguments. Results come last: `out` receives what the call makes, `report`, which may be NULL,
 *   what it did. Any other argument may be NULL only where its text says so. Arrays are packed, or
 *   have a `stride_bytes` from one entry to the next, a multiple of 4, at least 12; they have
 *   `count` entries, positions x y or x y z each. They and structs are read during the call only,
 *   arrays in structs as well. The pointer of an empty array may be NULL, with the count 0.
 *   Invalid pointers that are aligned, and counts that exceed an array, cannot be detected.
 *
 * Order. With AZULEJO_ORDER_ANY, the default, samples are in no particular order. In
 *   AZULEJO_ORDER_PROGRESSIVE every prefix of a set is well spread, as azulejo_points_ranks says.
 *   The `quotient` of the options is how many times longer the radius of each level of such a set
 *   is than that of the next: 1.02 to 1.5, or 0, the default, for 2^(1/8).
 *
 * Given samples stand already, anywhere, on a mesh or not; on a torus they wrap. They are not
 *   moved, dropped, compared with each other or returned: new samples are at least the clearance
 *   from each of them, and every place is within the radius of a new sample or the clearance of a
 *   given one, in progressive order from the first level on. `given_clearances` has the clearance
 *   of each, 0 or more, 0 having no effect; with classes a row for each, with a clearance for each
 *   class. NULL, the default, stands for the radius of the set or the own radius of the class; a
 *   `count` and radii that vary refuse it.
 *
 * Handles. azulejo_context, azulejo_kdrt, azulejo_plane, azulejo_mesh, azulejo_psp,
 *   azulejo_points, azulejo_selection, azulejo_mask, azulejo_spectrum and azulejo_differences are
 *   made by the library. The caller owns them and frees each with its own _free function, which
 *   allows NULL. They may be freed in any order: a handle keeps what it needs of another one.
 *   Pointers into a handle are valid until it is freed. Accessors return 0 or NULL for NULL. A
 *   handle of another type is always refused, a freed one as long as its memory has not been used
 *   again; accessors then return 0 or NULL, _free functions do nothing, and both set the last
 *   error.
 *
 * Structs with a struct_size can grow. Their _init function must fill them before use; it takes
 *   sizeof the struct as struct_size, and writes the defaults to options and zeros to reports. An
 *   option beyond the end of a shorter struct has its default, and a field beyond the end of a
 *   shorter report is not written: so a program built against an older header of the same SONAME
 *   keeps working. One built against a newer header works as long as the option fields that this
 *   library does not know are zero; report fields that it does not know stay as _init left them. A
 *   reserved field must be 0 in options and is 0 in reports. Structs that a call takes an array of
 *   have no struct_size; the call takes their size, and the same holds. The options of azulejo_X
 *   and azulejo_X_verb are azulejo_X_options, the report azulejo_X_report.
 *
 * Progress. A call with a context calls a progress callback on the thread that made the call: the
 *   one in its options or, if that is NULL, the one of the context (azulejo_context_watch). It gets
 *   the fraction of the call that is done, which never decreases, from 0 to 1; the 1 comes last,
 *   and only if the call succeeds. A return value other than 0 cancels the call, which returns
 *   AZULEJO_ERROR_CANCELLED. The exceptions are azulejo_dcr_relax, azulejo_dcr_relax_classes,
 *   azulejo_dcr_relax_density, azulejo_dcr_relax_to_correlation, azulejo_dcr_surface_relax and
 *   azulejo_volume_relax, _inside: they succeed with the state after the last whole step, and
 *   AZULEJO_STOPPED_CANCELLED in their report. Calls without a context, a psp or a plane handle do
 *   not report progress.
 *
 * Callbacks may call the library, also with the context that is calling them. They must return: an
 *   exception that leaves one ends the process, a longjmp out of it is undefined. Progress and
 *   azulejo_kdrt_visit_fn callbacks are called on the thread that made the call. Those for radii
 *   and densities are called on other threads as well, by several at once, unless the context has
 *   one thread: they must be thread-safe, give the same value for the same place, and must not call
 *   the library with the same context.
 *
 * Threads. Every function may be called from any thread at any time. Several threads may use one
 *   context at once, make windows of one plane, and read one mesh, set of points, selection, mask,
 *   spectrum or differences: these do not change. A psp or plane handle serves one changing call
 *   at a time. A handle must not be freed while another thread uses it. The last error belongs to
 *   the thread that made the call. After fork, in the child, contexts with more than one thread
 *   and psp and plane handles made with them return AZULEJO_ERROR_THREADS; they can still be
 *   freed. Windows of planes, contexts of one thread, and contexts made after the fork work. If
 *   the process used Embree before it forked, the child should use AZULEJO_ENGINE_RASTERISER.
 *
 * Determinism. The same options and seed give the same bytes, for every number of threads and
 *   whatever was called before, on every processor and system. Only sets by
 *   AZULEJO_PROJECTORS_GLOBAL depend on the version of Embree and on the instruction set, unless
 *   the engine is AZULEJO_ENGINE_RASTERISER.
 *
 * Memory. Requests that memory cannot hold are refused before memory is taken; the free memory of
 *   the machine counts, and the limits of the process (ulimit -v) and of its control groups, on
 *   Linux only. What the estimates do not foresee, such as memory that other threads and processes
 *   take during a call, or the 64 MB of address space that glibc gives to a thread, aborts the
 *   process if memory runs out.
 *
 * Complexity is that of the whole call on one thread, for evenly spread points: as dense, up to a
 *   small factor, everywhere in their domain or on their surface, as samples of this library are.
 *   For points in clusters, searches for neighbours take longer, at worst O(count^2). All threads
 *   of the context share the work.
 *
 * The algorithms are those of T. Wang, Techniques on Mining Effective Parallelism For
 * High-Performance Blue-Noise Sampling, University of Tokyo, 2019 ("thesis" below).
 */

#ifndef AZULEJO_H
#define AZULEJO_H

#include "azulejo/base.h"
#include "azulejo/kdrt.h"
#include "azulejo/psp.h"
#include "azulejo/volume.h"
#include "azulejo/dcr.h"
#include "azulejo/thin.h"
#include "azulejo/mask.h"
#include "azulejo/analysis.h"

#endif
