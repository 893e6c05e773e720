//! Whose threads build a scene, and that a build can be watched and cancelled. All in one test of a process of its own, where
//! nothing else uses Embree: its tasks run in one pool for all of the process.

#[path = "all/common/meshes.rs"]
#[allow(dead_code)]
mod meshes;

use std::cell::Cell;
use std::collections::HashMap;
use std::fs;
use std::ops::ControlFlow;
use std::path::Path;
use std::sync::Arc;

use azulejo::mesh::Mesh;
use azulejo::psp::{ProjectionOptions, Projectors, Psp};
use azulejo::trace::Scene;
use azulejo::{Context, Error};
use embree4_sys::*;
use meshes::Soup;

/// The nanoseconds that each thread of this process has worked. The main thread counts only where it runs the test: the
/// harness otherwise begins there, and prints and waits, beside it.
fn work() -> HashMap<String, u64> {
    let name = |path: &Path| path.file_name().map(|name| name.to_string_lossy().into_owned());
    let (main, own) = (std::process::id().to_string(), name(&fs::read_link("/proc/thread-self").unwrap()).unwrap());
    let tasks = fs::read_dir("/proc/self/task").unwrap().map(|task| task.unwrap().path());
    let work = tasks.filter_map(|task| {
        let times = fs::read_to_string(task.join("schedstat")).ok()?;
        Some((name(&task)?, times.split(' ').next()?.parse().ok()?))
    });
    work.filter(|(task, _)| *task != main || main == own).collect()
}

/// The number of threads that work on a call: for 2 ms at least.
fn threads_of(call: impl FnOnce()) -> usize {
    let before = work();
    call();
    work().iter().filter(|(task, time)| **time > before.get(*task).unwrap_or(&0) + 2_000_000).count()
}

fn build((positions, triangles): &Soup, num_threads: usize) -> Scene {
    Scene::new(positions, triangles, num_threads).unwrap()
}

fn embree() -> &'static Embree {
    Embree::load().unwrap()
}

/// A device of another part of the program.
struct Host(RTCDevice);

impl Host {
    fn new(threads: usize) -> Self {
        let config = std::ffi::CString::new(format!("threads={threads}")).unwrap();
        // SAFETY: the string ends with a NUL.
        Self(unsafe { embree().rtcNewDevice(config.as_ptr()) })
    }

    /// Builds a scene of its own.
    fn build(&self, (positions, triangles): &Soup) {
        let embree = embree();
        // SAFETY: all objects are alive; the buffers are of the sizes that are filled.
        unsafe {
            let scene = embree.rtcNewScene(self.0);
            let geometry = embree.rtcNewGeometry(self.0, RTC_GEOMETRY_TYPE_TRIANGLE);
            let buffer = |kind, format, count| embree.rtcSetNewGeometryBuffer(geometry, kind, 0, format, 12, count);
            let vertices = buffer(RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, positions.len());
            vertices.cast::<[f32; 3]>().copy_from_nonoverlapping(positions.as_ptr(), positions.len());
            let indices = buffer(RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, triangles.len());
            indices.cast::<[u32; 3]>().copy_from_nonoverlapping(triangles.as_ptr(), triangles.len());
            embree.rtcCommitGeometry(geometry);
            embree.rtcAttachGeometry(scene, geometry);
            embree.rtcCommitScene(scene);
            embree.rtcReleaseGeometry(geometry);
            embree.rtcReleaseScene(scene);
        }
    }
}

impl Drop for Host {
    fn drop(&mut self) {
        // SAFETY: it is this struct's.
        unsafe { embree().rtcReleaseDevice(self.0) };
    }
}

#[test]
fn builds_keep_to_their_threads_and_can_be_watched() {
    let soup = meshes::fine_torus(1200, 600);
    for threads in [1, 2, 3] {
        let worked = threads_of(|| drop(build(&soup, threads)));
        assert!(worked <= threads, "{worked} threads for a build with {threads}");
    }

    // Embree has one bound for the process, the largest of its devices. That of the host is back after the scene.
    let host = Host::new(2);
    let scene = build(&soup, 1);
    let worked = threads_of(|| drop(build(&soup, 1)));
    assert_eq!(worked, 1, "{worked} threads for a build with 1 beside a host with 2");
    drop(scene);
    let worked = threads_of(|| host.build(&soup));
    assert!(worked <= 2, "{worked} threads for a host with 2, after the scene");
    drop(host);
    assert_eq!(threads_of(|| drop(build(&soup, 1))), 1, "after the host");

    watched(soup);
}

/// The scene is the first half of what an iteration begins with. It is kept with the mesh.
fn watched((positions, triangles): Soup) {
    let mesh = || Arc::new(Mesh::new(positions.clone(), triangles.clone()).unwrap());
    let context = Context::new(1).unwrap();
    let options = ProjectionOptions::new(0.05).projectors(Projectors::Global);
    let told = Cell::new(0);
    let watch = |share: f64| {
        told.set(told.get() + usize::from(share > 0.0 && share < 0.1));
        ControlFlow::Continue(())
    };
    let built = mesh();
    Psp::new(&built, &options).unwrap().advance(&context, 1, Some(&watch)).unwrap();
    assert!(told.get() > 10, "told {} times", told.get());
    told.set(0);
    Psp::new(&built, &options).unwrap().advance(&context, 1, Some(&watch)).unwrap();
    assert_eq!(told.get(), 0, "the second set on a mesh builds no scene");

    let last = Cell::new(0.0);
    let stop = |share: f64| {
        last.set(share);
        if share > 0.0 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    };
    let other = mesh();
    let mut psp = Psp::new(&other, &options).unwrap();
    assert!(matches!(psp.advance(&context, 1, Some(&stop)), Err(Error::Cancelled)));
    assert!(last.get() < 0.1, "the build went on to {}", last.get());
    assert!(psp.is_empty());
    // The next call builds it, all of it.
    told.set(0);
    psp.advance(&context, 1, Some(&watch)).unwrap();
    assert!(told.get() > 10 && !psp.is_empty(), "told {} times", told.get());
}
