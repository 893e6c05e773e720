//! Sets that are edited: of the plane, and on meshes, where they can grow before.

use azulejo::psp::{self, ProjectionOptions};
use azulejo::{Error, Points, Region, Result, kdrt};

use crate::answer::{Answer, call};
use crate::memory::rows;
use crate::mesh::Handle;
use crate::plane::PlaneOptions;
use crate::surface::projection;
use crate::{given, given_of};

/// The object behind JavaScript's `Plane` and `Psp`.
pub enum Set {
    /// A set of the plane.
    Plane(kdrt::EditableSet),
    /// A set on a mesh until its first edit.
    Growing(psp::Psp),
    /// The same from then on.
    Mesh(psp::EditableSet),
    /// While one becomes the other.
    Between,
}

/// Does the same with a set of either kind, which from now on is edited.
macro_rules! edit {
    ($set:expr, $editable:ident => $body:expr) => {
        match $set.editable() {
            Set::Plane($editable) => $body,
            Set::Mesh($editable) => $body,
            Set::Growing(_) | Set::Between => unreachable!("the set is edited"),
        }
    };
}

impl Set {
    /// The set, to be edited.
    fn editable(&mut self) -> &mut Self {
        *self = match std::mem::replace(self, Self::Between) {
            Self::Growing(set) => Self::Mesh(set.into_editable()),
            other => other,
        };
        self
    }
}

/// The arrays of samples of an edited set.
fn edited<const AXES: usize>(samples: Points<AXES>) -> Answer {
    let Points { positions, normals, triangles, barycentrics, ids, interpolated_normals, .. } = samples;
    // Whole numbers up to 2^53, more than any set gets to.
    let ids = ids.into_iter().map(|id| id as f64).collect::<Vec<f64>>();
    let answer = Answer::default().and(positions.into_flattened()).and(normals).and(triangles).and(barycentrics);
    answer.and(ids).and(interpolated_normals)
}

/// Ids that JavaScript gives as numbers.
fn whole(ids: &[f64]) -> Result<Vec<u64>> {
    let id = |&id: &f64| {
        let number = id as u64;
        if number as f64 == id {
            return Ok(number);
        }
        Err(Error::InvalidArgument { argument: "ids", reason: format!("{id:?} is no id") })
    };
    ids.iter().map(id).collect()
}

/// A set of the plane, made or, if there are positions, that of these; the handle is in `out`.
///
/// # Safety
/// The pointers are to arguments of these sizes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_plane_create(
    options: &PlaneOptions,
    seed: u64,
    given_positions: *const [f32; 2],
    given_count: usize,
    clearances: *const f64,
    clearance_count: usize,
    has_positions: i32,
    positions: *const [f32; 2],
    count: usize,
    out: &mut Option<Box<Set>>,
) -> i32 {
    // SAFETY: guaranteed by the caller.
    let (given, positions) =
        unsafe { (given(given_positions, given_count, clearances, clearance_count), rows(positions, count)) };
    call(|context, progress| {
        let options = options.by_radius(seed, given);
        let set = match has_positions {
            0 => kdrt::EditableSet::sample(context, &options, progress)?,
            _ => kdrt::EditableSet::of(&options, positions)?,
        };
        *out = Some(Box::new(Set::Plane(set)));
        Ok(Answer::default())
    })
}

/// An empty set on a mesh; the handle is in `out`.
///
/// # Safety
/// The pointers are to arguments of these sizes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_psp_create(
    mesh: &Handle,
    radius: f64,
    cosine: f64,
    global: i32,
    by_projector: i32,
    seed: u64,
    positions: *const [f32; 3],
    count: usize,
    clearances: *const f64,
    clearance_count: usize,
    out: &mut Option<Box<Set>>,
) -> i32 {
    // SAFETY: guaranteed by the caller.
    let given = unsafe { given(positions, count, clearances, clearance_count) };
    call(|_, _| {
        let (projectors, priority) = projection(global != 0, by_projector != 0);
        let options = ProjectionOptions::new(radius).cosine(cosine).seed(seed).given(given);
        let options = options.projectors(projectors).priority(priority);
        *out = Some(Box::new(Set::Growing(psp::Psp::new(&mesh.0, &options)?)));
        Ok(Answer::default())
    })
}

/// Frees a set.
#[unsafe(no_mangle)]
pub extern "C" fn azulejo_set_free(set: Option<Box<Set>>) {
    drop(set);
}

/// Makes iterations on a mesh; the answer has the number of samples that they added.
#[unsafe(no_mangle)]
pub extern "C" fn azulejo_set_advance(set: &mut Set, iterations: u32) -> i32 {
    call(|context, progress| match set {
        Set::Growing(set) => {
            Ok(Answer::default().and(vec![set.advance(context, iterations, progress)?.accepted as f64]))
        }
        _ => {
            let reason = "of a set that has been edited, which makes no more".to_owned();
            Err(Error::InvalidArgument { argument: "iterations", reason })
        }
    })
}

/// Fills a set on a mesh; the answer has the number of samples that it added.
#[unsafe(no_mangle)]
pub extern "C" fn azulejo_set_fill(set: &mut Set) -> i32 {
    call(|context, progress| {
        let added = match set {
            Set::Growing(set) => set.fill(context, progress)?.accepted as f64,
            _ => edit!(set, set => set.refill(context, set.seed(), progress)?.count() as f64),
        };
        Ok(Answer::default().and(vec![added]))
    })
}

/// The samples, with their ids once the set has been edited.
#[unsafe(no_mangle)]
pub extern "C" fn azulejo_set_points(set: &Set) -> i32 {
    call(|_, _| {
        Ok(match set {
            Set::Plane(set) => edited(set.samples()),
            Set::Growing(set) => edited(set.samples()),
            Set::Mesh(set) => edited(set.samples()),
            Set::Between => unreachable!("a set is between two calls only in one"),
        })
    })
}

/// A region, as JavaScript lays it out.
#[repr(C)]
pub struct Bounds {
    min: [f64; 3],
    max: [f64; 3],
    centre: [f64; 3],
    radius: f64,
}

/// Erases the samples in a region, and returns them.
#[unsafe(no_mangle)]
pub extern "C" fn azulejo_set_erase(set: &mut Set, bounds: &Bounds) -> i32 {
    let &Bounds { min, max, centre, radius } = bounds;
    call(|_, _| edit!(set, set => Ok(edited(set.erase(&Region { min, max, centre, radius })?))))
}

/// Erases samples by their ids, and returns them.
///
/// # Safety
/// `ids` is valid for reads of `count` numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_set_erase_ids(set: &mut Set, ids: *const f64, count: usize) -> i32 {
    // SAFETY: guaranteed by the caller.
    let ids = unsafe { rows(ids, count) };
    call(|_, _| {
        let ids = whole(ids)?;
        edit!(set, set => Ok(edited(set.erase_ids(&ids)?)))
    })
}

/// Puts erased samples back; the answer is empty. In the plane there are no triangles and barycentrics.
///
/// # Safety
/// The pointers are to arguments of these sizes, in numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_set_restore(
    set: &mut Set,
    positions: *const f32,
    count: usize,
    triangles: *const u32,
    triangle_count: usize,
    barycentrics: *const [f32; 2],
    barycentric_count: usize,
    ids: *const f64,
    id_count: usize,
) -> i32 {
    // SAFETY: guaranteed by the caller.
    let (positions, triangles) = unsafe { (rows(positions, count), rows(triangles, triangle_count)) };
    // SAFETY: likewise.
    let (barycentrics, ids) = unsafe { (rows(barycentrics, barycentric_count), rows(ids, id_count)) };
    call(|_, _| {
        let ids = whole(ids)?;
        edit!(set, set => {
            let mut points = Points::from(positions.as_chunks().0.to_vec());
            points.ids = ids;
            points.triangles = triangles.to_vec();
            points.barycentrics = barycentrics.to_vec();
            set.restore(&points)?;
        });
        Ok(Answer::default())
    })
}

/// Adds given samples; the answer has the erased samples, and the id of the first given one.
///
/// # Safety
/// The pointers are to arguments of these sizes, in numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_set_add_given(
    set: &mut Set,
    positions: *const f32,
    count: usize,
    clearances: *const f64,
    clearance_count: usize,
) -> i32 {
    // SAFETY: guaranteed by the caller.
    let (positions, clearances) = unsafe { (rows(positions, count), rows(clearances, clearance_count)) };
    call(|_, _| {
        edit!(set, set => {
            let (first, erased) = set.add_given(given_of(positions.as_chunks().0, clearances))?;
            Ok(edited(erased).and(vec![first as f64]))
        })
    })
}

/// Removes given samples by their ids; the answer is empty.
///
/// # Safety
/// `ids` is valid for reads of `count` numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_set_remove_given(set: &mut Set, ids: *const f64, count: usize) -> i32 {
    // SAFETY: guaranteed by the caller.
    let ids = unsafe { rows(ids, count) };
    call(|_, _| {
        let ids = whole(ids)?;
        edit!(set, set => set.remove_given(&ids)?);
        Ok(Answer::default())
    })
}

/// Makes the set maximal again; the answer has the samples that were added.
#[unsafe(no_mangle)]
pub extern "C" fn azulejo_set_refill(set: &mut Set, seed: u64) -> i32 {
    call(|context, progress| edit!(set, set => Ok(set.refill(context, seed, progress)?.answer())))
}

/// The result of a refill.
trait Refilled {
    fn answer(self) -> Answer;
    fn count(&self) -> usize;
}

impl Refilled for Points<2> {
    fn answer(self) -> Answer {
        edited(self)
    }

    fn count(&self) -> usize {
        self.len()
    }
}

impl Refilled for (Points<3>, psp::Report) {
    fn answer(self) -> Answer {
        edited(self.0)
    }

    fn count(&self) -> usize {
        self.0.len()
    }
}
