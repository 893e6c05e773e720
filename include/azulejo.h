/*
 * azulejo: blue-noise sampling of planes and triangle meshes, and relaxation of point sets.
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
 *   a plane without end, part by part             azulejo_kdrt_create, azulejo_kdrt_window
 *   more samples than memory holds                azulejo_kdrt_stream
 *   a plane under a brush: erase, refill, undo    azulejo_plane_create, _erase, _refill
 *   a rectangle with a density, such as an image  azulejo_dcr_scatter, azulejo_dcr_relax_density
 *   samples of a mesh                             azulejo_psp_sample
 *   a mesh whose radius or density varies         azulejo_psp_adaptive_sample, _with_density
 *   a mesh under a brush: erase, refill, undo     azulejo_psp_create, azulejo_psp_erase, _refill
 *   several kinds of things, such as plants       azulejo_kdrt_sample_classes, azulejo_psp_...
 *   levels of detail, which are prefixes          the same calls, with `order` progressive
 *   sets that exist, joined without seams         azulejo_kdrt_merge
 *   fewer points of a cloud that exists           azulejo_thin
 *   points that exist, more evenly spread         azulejo_dcr_relax, azulejo_dcr_surface_relax
 *   a mesh whose vertices are the samples         azulejo_dcr_remesh
 *   proof: distances, gaps, spectra               azulejo_plane_measure, azulejo_mesh_coverage,
 *                                                 azulejo_spectrum_create
 *   the slow unbiased reference                   azulejo_maximal_sample
 *
 * azulejo/base.h has what all calls share, azulejo/kdrt.h, psp.h, dcr.h, thin.h and analysis.h have
 * the calls, each with its options before it. Each can be included alone.
 *
 * The following holds for every function unless its own text says otherwise.
 *
 * Terms. A radius is the smallest distance allowed between the centres of two samples; where it
 *   varies from sample to sample, the mean of the two radii is. A set is conflict-free if no two
 *   samples are closer than the radius, in double arithmetic on the returned floats, without
 *   tolerance. It is maximal if no place of the domain or surface is farther than the radius from
 *   every sample, up to the rounding of the returned floats: 3 times the spacing of floats at the
 *   largest coordinate in the plane, 6 times for merged sets and on meshes. The covering radius of
 *   a set is the distance from its samples of the place that is farthest from all of them. d_max
 *   is sqrt(2 * area / (sqrt(3) * count)), the distance of neighbours if as many samples stood in
 *   hexagonal arrangement; rho is the smallest distance in units of d_max.
 *
 * Status. A call that can fail returns an azulejo_status: AZULEJO_OK (0) or a negative
 *   AZULEJO_ERROR_ code. azulejo_last_error_message then names the argument, its value and its
 *   range. Arguments are checked before any work starts. Outputs are written on success only. Each
 *   function lists its codes except two, which are possible in most: AZULEJO_ERROR_THREADS in
 *   calls with a context (see "Threads"), and AZULEJO_ERROR_INTERNAL for a panic inside the
 *   library, which is a bug. AZULEJO_ERROR_INVALID_ARGUMENT is returned for a pointer that is NULL
 *   or not aligned and for a value outside its documented range. azulejo_status_name gives the name
 *   of a code. No exception leaves the library.
 *   Nothing is printed to stdout; a panic prints to stderr.
 *
 * Handles. azulejo_context, azulejo_kdrt, azulejo_plane, azulejo_mesh, azulejo_psp,
 *   azulejo_points, azulejo_selection, azulejo_spectrum and azulejo_differences are made by
 *   the library. The caller owns them and frees each with its own _free function, which
 *   allows NULL. They may be freed in any order: a handle keeps what it needs of another
 *   one. Accessors return 0 or NULL for NULL. Pointers into a handle are valid until the
 *   handle is freed. A handle begins with a tag, which is overwritten when it is freed. A
 *   handle of another type is always refused. A freed one is refused as long as its memory
 *   has not been used again; that is no promise, as the allocator may have given the memory
 *   away or back to the system. Accessors return 0 or NULL for what is refused, _free
 *   functions leave it as it is, and both set the last error.
 *
 * Pointers. An argument may be NULL only where its text says so. Arrays are packed, and are read
 *   during the call only. The pointer of an empty array may be NULL, with the count 0. Pointers
 *   that are not aligned for their type, handles and outputs included, are refused. Other invalid
 *   pointers, and counts that exceed an array, cannot be detected.
 *
 * Structs that can grow. Options, reports, azulejo_plane_set, azulejo_density and
 *   azulejo_mesh_density begin with struct_size and must be filled by their _init function before
 *   use: it writes the defaults to options and zeros to reports. A field exists for the library if
 *   struct_size reaches its end: options that lack a field get its default, and a field that a
 *   report lacks is not written. So a program built against an older header of the same SONAME
 *   keeps working. One built against a newer header works as long as the option fields that this
 *   library does not know are zero; report fields that it does not know stay as _init left them. A
 *   struct_size out of range, a non-zero field beyond the known ones, an unknown constant, a flag
 *   other than 0 and 1, and an option that its text excludes from the call are refused. A reserved
 *   field must be 0 in options and is 0 in reports. The options of azulejo_X and azulejo_X_verb
 *   are azulejo_X_options, the report azulejo_X_report. Structs that a call takes an array of have
 *   no struct_size; the call takes their size, and the same holds.
 *
 * Types. Attributes that the host has for each vertex, pixel or sample are float: positions,
 *   normals, barycentrics, radii of vertices, densities, ranks. Distances by which conflicts are
 *   judged are double: radius, clearances, radii of samples and classes, corners of the domain, and
 *   all figures of reports. Constants, flags and what callbacks return are uint32_t, sizes and
 *   counts of arrays size_t. Results come last: `out`, then `report`.
 *
 * Progress. A call with a context calls a progress callback on the thread that made the call: the
 *   one in its options or, if that is NULL, the one of the context (azulejo_context_watch). It
 *   gets the fraction of the call that is done, which never decreases, from 0 to 1; the 1 comes
 *   last, and only if the call succeeds. A return value other than 0 cancels the call, which
 *   returns AZULEJO_ERROR_CANCELLED and writes no output. The exceptions are azulejo_dcr_relax,
 *   azulejo_dcr_relax_density and azulejo_dcr_surface_relax: they succeed with the state after the
 *   last whole step, and say so in their report. azulejo_psp_create and calls without a context or
 *   a psp or plane handle do not report progress.
 *
 * Callbacks. A callback may call the library, also with the context that is calling it, unless its
 *   type says otherwise. It must return: an exception that leaves it ends the process, a longjmp
 *   out of it is undefined. Progress and azulejo_kdrt_visit_fn callbacks are called on the thread
 *   that made the call. azulejo_radius_fn and azulejo_density_fn callbacks are called on other
 *   threads as well, by several at once, so they must be thread-safe.
 *
 * Threads. Every function may be called from any thread at any time. Several threads may use one
 *   context at once, make windows of one plane, and read one mesh, set of points, selection,
 *   spectrum or differences. A psp or plane handle serves one changing call at a time and
 *   refuses a second one with AZULEJO_ERROR_BUSY. A handle must not be freed while another
 *   thread uses it. The last error belongs to the thread that made the call. After fork, in the
 *   child, contexts with more than one thread, and psp and plane handles made with them, return
 *   AZULEJO_ERROR_THREADS, since their threads exist in the parent only; they can still be
 *   freed. Windows of planes, contexts of one thread, and contexts made after the fork work.
 *   Embree's own threads are lost as well: a process that used Embree before it forked should
 *   use AZULEJO_ENGINE_RASTERISER in the child.
 *
 * Determinism. The same options and seed give the same bytes, for every number of threads and
 *   whatever was called before, on every processor and system: elementary functions are the
 *   library's own, and vector instructions change nothing. Only AZULEJO_ENGINE_EMBREE depends on
 *   the version of Embree and on the instruction set. Callbacks must return the same as well.
 *
 * Memory. Requests that memory cannot hold are refused with AZULEJO_ERROR_TOO_LARGE before memory
 *   is taken; the free memory of the machine counts, and the limits of the process (ulimit -v) and
 *   of its control groups. Only Linux is asked for these. What the estimates do not foresee, such
 *   as memory that other threads and processes take during a call, or the 64 MB of address space
 *   that glibc gives to a thread, aborts the process if memory runs out.
 *
 * Complexity is that of the whole call on one thread; all threads of the context share the work,
 *   except where a text says otherwise. "Evenly spread" points are as dense, up to a small factor,
 *   everywhere in their domain or on their surface, as samples of this library are. For points in
 *   clusters, searches for neighbours take longer, at worst O(count^2).
 *
 * The algorithms are those of T. Wang, Techniques on Mining Effective Parallelism For
 * High-Performance Blue-Noise Sampling, University of Tokyo, 2019 ("thesis" below).
 */

#ifndef AZULEJO_H
#define AZULEJO_H

#include "azulejo/base.h"
#include "azulejo/kdrt.h"
#include "azulejo/psp.h"
#include "azulejo/dcr.h"
#include "azulejo/thin.h"
#include "azulejo/analysis.h"

#endif
