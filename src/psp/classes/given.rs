//! Given samples as several classes see them.

use crate::classes::Classes;
use crate::error::Result;
use crate::given::Given;
use crate::mesh::Mesh;
use crate::psp::given::obstacles_of;
use crate::psp::obstacles::Obstacles;

/// For each class the given samples with their clearances from it, of which each sample has a row; without clearances
/// they are the class's own radius.
pub(super) fn obstacles(mesh: &Mesh, given: Given<3>, classes: &Classes) -> Result<Vec<Obstacles>> {
    given.check_classes(classes.count())?;
    let of_class = |class: usize| {
        let clearances = given.clearances_of_class(class, classes.count());
        let clearances = clearances.unwrap_or_else(|| vec![classes.own(class); given.positions.len()]);
        obstacles_of(mesh, Given::with_clearances(given.positions, &clearances))
    };
    (0..classes.count()).map(of_class).collect()
}
