//! Sets of points, in the plane or in space.

use azulejo::{Centred, Domain};

use super::columns::CLASS;

/// The columns of a file that are kept as floats.
pub const NAMES: [&str; 11] = ["x", "y", "z", "nx", "ny", "nz", "u", "v", "clearance", "radius", CLASS.name];

/// The number of columns, the first ones, that are coordinates, which are finite.
const COORDINATES: usize = 8;

/// The places in a file of the columns that are kept.
pub struct Columns<T> {
    /// The places of the columns of [`NAMES`].
    pub floats: [Option<T>; NAMES.len()],
    /// The place of the triangle's number.
    pub triangle: Option<T>,
}

impl<T> Columns<T> {
    /// Looks for the columns by name. The error is the name of one that is missing: x or y.
    pub fn find(mut find: impl FnMut(&str) -> Option<T>) -> Result<Self, &'static str> {
        let columns = Self { floats: NAMES.map(&mut find), triangle: find("triangle") };
        match columns.floats[..2].iter().position(Option::is_none) {
            Some(missing) => Err(NAMES[missing]),
            None => Ok(columns),
        }
    }

    fn has(&self, range: std::ops::Range<usize>) -> bool {
        self.floats[range].iter().all(Option::is_some)
    }

    /// The place of the triangle, if there are barycentrics as well.
    pub fn on_mesh(&self) -> Option<&T> {
        self.triangle.as_ref().filter(|_| self.has(6..8))
    }

    /// A set without points.
    pub fn empty_set(&self) -> PointSet {
        PointSet {
            has_z: self.has(2..3),
            positions: Vec::new(),
            normals: self.has(3..6).then(Vec::new),
            on_mesh: self.on_mesh().map(|_| (Vec::new(), Vec::new())),
            clearances: (8..10).find(|&column| self.has(column..column + 1)).map(|column| (column, Vec::new())),
            classes: self.has(10..11).then(Vec::new),
            domain: None,
        }
    }
}

/// The points of a file, of two or three dimensions.
#[derive(Debug)]
pub struct PointSet {
    has_z: bool,
    /// z is 0 where the file has none.
    positions: Vec<[f64; 3]>,
    normals: Option<Vec<[f32; 3]>>,
    on_mesh: Option<OnMesh>,
    /// The numbers of the column of clearances or, without one, of radii; and the number of this column.
    clearances: Option<(usize, Vec<f64>)>,
    /// The numbers of the column of classes.
    classes: Option<Vec<f32>>,
    /// The domain that the file names.
    pub domain: Option<Domain>,
}

/// Triangles and barycentrics.
pub type OnMesh = (Vec<u32>, Vec<[f32; 2]>);

/// A set of the plane.
#[derive(Debug, Default)]
pub struct PlaneSet {
    pub points: Vec<[f32; 2]>,
    /// For each point its clearance or, where the file names none, its radius, if it has one.
    pub clearances: Option<Vec<f64>>,
    /// The class of each point.
    pub classes: ClassColumn,
    /// The domain that the file names.
    pub domain: Option<Domain>,
}

/// The class of each point, if a file has them; the reason where its column of this name has other than whole numbers.
pub type ClassColumn = Option<Result<Vec<u32>, String>>;

/// Samples in space, such as those of a mesh.
#[derive(Debug)]
pub struct SampleSet {
    pub positions: Vec<[f32; 3]>,
    /// Normals, one for each position; empty if the file has none.
    pub normals: Vec<[f32; 3]>,
    /// For each sample its triangle and barycentrics, if the file has them.
    pub on_mesh: Option<OnMesh>,
    /// For each sample its clearance or, where the file names none, its radius, if it has one.
    pub clearances: Option<Vec<f64>>,
    /// The class of each sample.
    pub classes: ClassColumn,
}

impl PointSet {
    /// Adds a point: the numbers of [`NAMES`], 0 where there is no column, and the triangle.
    pub fn push(&mut self, exact: [f64; NAMES.len()], triangle: u32) -> Result<(), String> {
        let numbers = exact.map(|x| x as f32);
        if let Some(i) = numbers[..COORDINATES].iter().position(|x| !x.is_finite()) {
            return Err(format!("{} is {}, not finite", NAMES[i], numbers[i]));
        }
        let [_, _, _, nx, ny, nz, u, v, ..] = numbers;
        self.positions.push([exact[0], exact[1], exact[2]]);
        if let Some(normals) = &mut self.normals {
            normals.push([nx, ny, nz]);
        }
        if let Some((triangles, barycentrics)) = &mut self.on_mesh {
            triangles.push(triangle);
            barycentrics.push([u, v]);
        }
        if let Some((column, clearances)) = &mut self.clearances {
            clearances.push(numbers[*column].into());
        }
        if let Some(classes) = &mut self.classes {
            classes.push(numbers[10]);
        }
        Ok(())
    }

    /// The positions in space, in the plane z = 0 where there is no z.
    pub fn into_positions(self) -> Vec<[f64; 3]> {
        self.positions
    }

    pub fn is_empty(&self) -> bool {
        self.positions.is_empty()
    }

    /// True if the points are in the plane: without z, or with a z that is 0 everywhere, as in XYZ files. Points with
    /// normals or on triangles are not.
    fn is_plane(&self) -> bool {
        let is_flat = || self.positions.iter().all(|position| position[2] == 0.0);
        !self.has_z || self.normals.is_none() && self.on_mesh.is_none() && is_flat()
    }

    /// True if each point can be taken for one of this many coordinates.
    pub fn has_dimensions(&self, dimensions: u8) -> bool {
        if dimensions == 2 { self.is_plane() } else { self.has_z }
    }

    /// The set as one of the plane; otherwise the reason and what can be done `instead`.
    pub fn into_plane(self, instead: &str) -> Result<PlaneSet, String> {
        if !self.is_plane() {
            return Err(format!("holds points in three dimensions, not in the plane: {instead}"));
        }
        let exact: Vec<_> = self.positions.iter().map(|&[x, y, _]| [x, y]).collect();
        let Centred { positions: points, origin, .. } = Centred::of(&exact);
        if origin != [0.0; 2] {
            let [x, y] = origin;
            return Err(format!(
                "holds coordinates that floats would displace: subtract {x} from x and {y} from y first"
            ));
        }
        let clearances = self.clearances.map(|(_, clearances)| clearances);
        Ok(PlaneSet { points, clearances, classes: whole(self.classes), domain: self.domain })
    }

    /// The set as one of samples in space, relative to an origin: that of the mesh.
    pub fn into_samples(self, origin: [f64; 3]) -> Result<SampleSet, String> {
        // Sets of the plane have a z in PLY files, and name their domain there.
        if !self.has_z || self.domain.is_some() {
            return Err("holds points in the plane, without z, and not samples of a mesh".to_owned());
        }
        let Self { positions, normals, on_mesh, clearances, classes, .. } = self;
        let clearances = clearances.map(|(_, clearances)| clearances);
        let positions = Centred::around(&positions, origin).positions;
        Ok(SampleSet { positions, normals: normals.unwrap_or_default(), on_mesh, clearances, classes: whole(classes) })
    }
}

/// Classes by the numbers of their column.
fn whole(numbers: Option<Vec<f32>>) -> ClassColumn {
    let class = |(point, number): (usize, f32)| {
        let class = number as u32;
        if f64::from(class) == f64::from(number) {
            Ok(class)
        } else {
            Err(format!("point {point}: its class is no whole number"))
        }
    };
    numbers.map(|numbers| numbers.into_iter().enumerate().map(class).collect())
}

/// The number of a triangle that a file has among floats.
pub fn triangle(number: f64) -> Result<u32, String> {
    let triangle = number as u32;
    if f64::from(triangle) == number { Ok(triangle) } else { Err(format!("{number} is not the number of a triangle")) }
}
