//! azulejo: blue-noise sampling of planes and triangle meshes, and the relaxation of point sets.
//!
//! This header is generated from ffi/azulejo-c by cbindgen; do not edit it. It is C99; C++ programs may prefer
//! azulejo.hpp, which wraps it.
//!
//! Conventions, which hold for every function unless its own text says otherwise:
//!
//! Status. A call that can fail returns an azulejo_status: AZULEJO_OK (0) or one of the negative AZULEJO_ERROR_ codes.
//!   azulejo_last_error_message then says which argument is wrong, its value and its range. Arguments are checked before
//!   any work starts. Outputs are written on success only. Nothing is thrown or unwound into C, and nothing is printed
//!   to stdout; a panic inside the library, which is a bug, prints to stderr and becomes AZULEJO_ERROR_INTERNAL.
//!
//! Handles. azulejo_context, azulejo_mesh, azulejo_psp, azulejo_points, azulejo_spectrum and azulejo_differences are made
//!   by the library and given back with their own _free, which allows NULL. They may be freed in any order: what a handle
//!   needs of another one, it keeps. Accessors allow NULL too and answer 0 or NULL. Pointers into a handle live until it is
//!   freed.
//!
//! Pointers. An argument may be NULL only where that is said. Arrays are packed and read during the call only; the
//!   pointer of an empty array may be NULL, with the count 0. Arrays and options that are not aligned for their type are
//!   refused.
//!   Beyond that no library can tell a wrong pointer or a wrong count from a right one.
//!
//! Options. Every options struct begins with struct_size and is filled with defaults by its _options_init, which must
//!   be called first: azulejo_kdrt_options o; azulejo_kdrt_options_init(&o, sizeof o); o.radius = 0.01; ...
//!   A field exists for the library iff struct_size reaches its end, so that structs can grow: a program built against
//!   an older header goes on working, and one built against a newer header works as long as what the library does not
//!   know is zero. A struct with a non-zero tail, an unknown constant or a flag other than 0 and 1 is refused. Reports
//!   are written by the library and need no preparation; they never grow, their reserved fields are zero.
//!
//! Progress. The callback in the options, or without one that of the context (azulejo_context_watch), is called on the thread
//!   that makes the call, with the finished share, which never falls, from 0 to 1 (the 1 comes if the call succeeds). Any
//!   return value but 0 cancels the call, which then returns AZULEJO_ERROR_CANCELLED; only azulejo_dcr_relax,
//!   azulejo_dcr_relax_density and azulejo_dcr_relax_surface return what they have, as their reports say. Only
//!   azulejo_dcr_scatter, calls that take no context, and the making of a psp handle tell nobody. The callback may call the library, also with the same context. It must return:
//!   an exception that leaves it ends the process, a longjmp is undefined. The same holds for the callback of
//!   azulejo_kdrt_stream. Only an azulejo_radius_fn and an azulejo_density_fn are called on other threads, and several at
//!   once.
//!
//! Threads. Every function may be called from any thread at any time. A context can be used by several threads at
//!   once; a psp handle serves one changing call at a time and refuses a second one. The last error belongs to the
//!   thread that made the call. In a process that is forked, contexts with more than one thread and what was made with
//!   them refuse to work, with AZULEJO_ERROR_THREADS, since their threads are in the other process; everything can be
//!   freed. Contexts of one thread, and those made after the fork, work; but Embree's own threads are gone as well, so
//!   that a process that used it before it forked should use AZULEJO_ENGINE_RASTERISER after.
//!
//! Results. The same options and seed give the same bytes, for every number of threads and whatever was called before.
//!   A radius is always the smallest distance allowed between the centres of two samples; where it varies, the mean of
//!   their two radii is. Conflict-free: no two samples are closer than the radius, in double arithmetic on the returned
//!   floats, without tolerance. Maximal: no place of the domain or surface is farther than the radius from every sample,
//!   up to the rounding of the returned floats: 3 times the spacing of floats at the largest coordinate in the plane, 6
//!   times where sets are merged and on a mesh.
//!
//! Memory. Sizes that cannot be held are refused with AZULEJO_ERROR_TOO_LARGE before memory is taken: what the machine has
//!   left counts, and the limits of the process (ulimit -v) and of its control groups. When there is no memory left in the
//!   middle of a call nevertheless, the process is aborted, as by every Rust library.
//!
//! The algorithms are those of T. Wang, Techniques on Mining Effective Parallelism For High-Performance Blue-Noise
//! Sampling, University of Tokyo, 2019 ("thesis" below).

#![allow(non_camel_case_types)]
// What a caller owes to make a call safe stands once, in the conventions above, and is not repeated per function.
#![allow(clippy::missing_safety_doc)]

mod boundary;
mod growing;

// In the order of the header.
pub mod status;
pub mod version;

pub mod progress;

pub mod context;
pub mod domain;
pub mod points;

pub mod kdrt;
pub mod maximal;
pub mod merge;

pub mod embree;
pub mod mesh;
pub mod psp;

pub mod adaptive;

pub mod dcr;
pub mod density;

pub mod surface;

pub mod analysis;
pub mod statistics;

pub mod spectrum;

pub mod differences;

// What the conventions let several threads use at once.
const _: () = {
    const fn shared<T: Send + Sync>() {}
    shared::<context::azulejo_context>();
    shared::<mesh::azulejo_mesh>();
    shared::<points::azulejo_points>();
    shared::<spectrum::azulejo_spectrum>();
    shared::<differences::azulejo_differences>();
    shared::<std::sync::RwLock<azulejo_core::psp::Psp>>();
};
