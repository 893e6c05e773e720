//! What a cube has to fill, and where darts fall on it.

use std::ops::Range;

use crate::index::Weights;
use crate::mesh::Mesh;
use crate::psp::fill::balls::Ball;
use crate::psp::fill::darts::random_point;
use crate::psp::fill::ground::Point;
use crate::psp::fill::triangles::{GROUP, Triangles};
use crate::psp::fragment::Fragment;
use crate::rng::Rng;

/// Triangles, and fragments of others that are too long, whose numbers follow.
#[derive(Default)]
pub(in crate::psp) struct Items {
    pub triangles: Vec<u32>,
    /// The groups among the triangles, in order.
    pub groups: Vec<Group>,
    pub pieces: Vec<Fragment>,
}

/// Triangles that follow each other and lie together.
pub(in crate::psp) struct Group {
    /// Where they stand.
    pub indices: Range<u32>,
    pub area: f64,
    pub ball: Ball,
}

impl Items {
    /// The indices of the triangles, but for those of groups whose ball is covered.
    pub fn indices_but(&self, is_covered: impl Fn(&Ball) -> bool) -> impl Iterator<Item = usize> {
        let (mut next, end) = (0, self.triangles.len() as u32);
        let covered =
            self.groups.iter().filter(move |group| is_covered(&group.ball)).map(|group| group.indices.clone());
        let between = move |covered: Range<u32>| std::mem::replace(&mut next, covered.end)..covered.start;
        covered.chain(std::iter::once(end..end)).flat_map(between).map(|index| index as usize)
    }

    /// The areas of all.
    pub fn row<'a>(&'a self, mesh: &'a Mesh) -> ItemRow<'a> {
        let (mut areas, mut entries, mut next) = (Vec::new(), Vec::new(), 0);
        let mut add = |single: Range<u32>, group: Option<(u32, &Group)>| {
            for some in self.triangles[single.start as usize..single.end as usize].chunks(GROUP) {
                areas.extend_from_slice(&Triangles::Listed(some).measure(mesh, 0).0[..some.len()]);
            }
            entries.extend(single.map(Entry::Item));
            areas.extend(group.map(|(_, group)| group.area));
            entries.extend(group.map(|(number, _)| Entry::Group(number)));
        };
        for (number, group) in (0..).zip(&self.groups) {
            add(next..group.indices.start, Some((number, group)));
            next = group.indices.end;
        }
        let end = self.triangles.len() as u32;
        add(next..end, None);
        areas.extend(self.pieces.iter().map(|piece| piece.area(mesh)));
        entries.extend((end..).take(self.pieces.len()).map(Entry::Item));
        ItemRow { items: self, mesh, row: Weights::new(areas), entries, ends: vec![[0.0; GROUP]; self.groups.len()] }
    }

    fn fragment(&self, number: usize) -> Fragment {
        match number.checked_sub(self.triangles.len()) {
            None => Fragment::whole(self.triangles[number]),
            Some(piece) => self.pieces[piece],
        }
    }
}

/// The areas of items in a row. A group has one area until a dart falls on it: many stay dry where triangles are small.
pub(in crate::psp) struct ItemRow<'a> {
    items: &'a Items,
    mesh: &'a Mesh,
    row: Weights,
    entries: Vec<Entry>,
    /// For each group on which a dart fell, the sums of its areas up to each of them.
    ends: Vec<[f64; GROUP]>,
}

/// What an area of the row belongs to, by its number.
#[derive(Clone, Copy)]
enum Entry {
    Item(u32),
    Group(u32),
}

impl ItemRow<'_> {
    pub fn total(&self) -> f64 {
        self.row.total()
    }

    /// A random point of any of it.
    pub fn point(&mut self, rng: &mut Rng) -> Point {
        let (number, place) = self.row.pick_within(rng);
        let item = match self.entries[number as usize] {
            Entry::Item(item) => item as usize,
            Entry::Group(group) => self.in_group(group as usize, place),
        };
        let fragment = self.items.fragment(item);
        Point { triangle: fragment.triangle, barycentrics: fragment.at(random_point(rng)), local: () }
    }

    /// The triangle at a place in the row of a group's areas.
    fn in_group(&mut self, group: usize, place: f64) -> usize {
        let (ends, indices) = (&mut self.ends[group], &self.items.groups[group].indices);
        let [first, end] = [indices.start, indices.end].map(|index| index as usize);
        if ends[GROUP - 1] == 0.0 {
            let mut total = 0.0;
            *ends = Triangles::Listed(&self.items.triangles[first..end]).measure(self.mesh, 0).0.map(|area| {
                total += area;
                total
            });
        }
        // The place may be rounded beyond the last area.
        let place = place.min(ends[GROUP - 1].next_down());
        first + ends.iter().take_while(|&&end| end <= place).count()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::Draw;

    /// Forty triangles in two groups, one of them short, and single ones before, between and behind them; some have no area.
    fn items() -> (Mesh, Items) {
        let size = |i: u32| [1.0, 0.0, 7.0, 1e-3][i as usize % 4];
        let corners = |i: u32| [[0.0, 0.0, i as f32], [size(i), 0.0, i as f32], [0.0, size(i), i as f32]];
        let mesh =
            Mesh::new((0..40).flat_map(corners).collect(), (0..40).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect());
        let (mesh, triangles): (_, Vec<u32>) = (mesh.unwrap(), (0..40).rev().collect());
        let area = |range: &Range<u32>| range.clone().map(|i| mesh.triangle_area(triangles[i as usize])).sum();
        let ball = |radius: f32| Ball { centre: [0.0; 3], radius };
        let groups =
            [3..19, 25..32].map(|indices| Group { area: area(&indices), ball: ball(indices.end as f32), indices });
        let pieces = vec![Fragment::whole(5), Fragment::whole(2)];
        (mesh, Items { triangles, groups: groups.into(), pieces })
    }

    #[test]
    fn a_dart_falls_where_it_would_in_a_row_of_single_areas() {
        let (mesh, items) = items();
        let areas = items.triangles.iter().map(|&triangle| mesh.triangle_area(triangle));
        let single = Weights::new(areas.chain(items.pieces.iter().map(|piece| piece.area(&mesh))).collect());
        let (mut row, mut rng) = (items.row(&mesh), Rng::at(1, Draw::Probe, &[]));
        assert!((row.total() / single.total() - 1.0).abs() < 1e-15);
        for _ in 0..10_000 {
            let mut same = rng.clone();
            let number = single.pick(&mut same) as usize;
            let expected = items.triangles.get(number).copied().unwrap_or_else(|| items.pieces[number - 40].triangle);
            assert_eq!(row.point(&mut rng).triangle, expected);
        }
    }

    #[test]
    fn the_triangles_of_covered_groups_are_left_out() {
        let (_, items) = items();
        let left = |covered: &[f32]| items.indices_but(|ball| covered.contains(&ball.radius)).collect::<Vec<_>>();
        assert_eq!(left(&[]), (0..40).collect::<Vec<_>>());
        assert_eq!(left(&[19.0]), (0..3).chain(19..40).collect::<Vec<_>>());
        assert_eq!(left(&[32.0]), (0..25).chain(32..40).collect::<Vec<_>>());
        assert_eq!(left(&[19.0, 32.0]), (0..3).chain(19..25).chain(32..40).collect::<Vec<_>>());
    }
}
