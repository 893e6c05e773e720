//! The long calls that make sets of volumes.

use std::sync::LazyLock;

use azulejo::volume::adaptive::Radius as Varying;
use azulejo::{Classes, Domain, Interior, volume};

use super::{CUBE, Call, SHEET, SOLID, said, samples};

static EQUAL: LazyLock<Classes> = LazyLock::new(|| Classes::of_radii(&[0.08, 0.08], 1.0).unwrap());
/// Radii that grow from the lower to the upper face.
const WIDENING: Varying = Varying::Grid { values: &[0.03, 0.05], size: [1, 1, 2] };

pub const VOLUME: &[Call] = &[
    Call {
        name: "volume::sample",
        reports: 15,
        run: |c, p| samples(volume::sample(c, &volume::Options::new(0.04).domain(CUBE), p)),
        refused: &[
            ("radius: ", |c, p| said(volume::sample(c, &volume::Options::new(-0.1), p))),
            ("radius: ", |c, p| said(volume::sample(c, &volume::Options::new(1e-4), p))),
            ("radius: ", |c, p| said(volume::sample(c, &volume::Options::new(1e-7), p))),
            ("leaf_size: ", |c, p| said(volume::sample(c, &volume::Options::new(0.1).leaf_size(2.0), p))),
            ("domain_max: ", |c, p| {
                said(volume::sample(c, &volume::Options::new(0.1).domain(Domain { max: [1.0, 0.0, 1.0], ..CUBE }), p))
            }),
        ],
    },
    Call {
        name: "volume::sample_classes",
        reports: 10,
        run: |c, p| said(volume::sample_classes(c, &volume::ClassesOptions::default().domain(CUBE), &EQUAL, p)),
        refused: &[
            ("radii: ", |c, p| {
                said(volume::sample_classes(c, &Default::default(), &Classes::new(1, &[1e-9]).unwrap(), p))
            }),
            ("domain_max: ", |c, p| {
                let domain = Domain { max: [1.0, 0.0, 1.0], ..CUBE };
                said(volume::sample_classes(c, &volume::ClassesOptions::default().domain(domain), &EQUAL, p))
            }),
        ],
    },
    Call {
        name: "volume::adaptive::sample",
        reports: 15,
        run: |c, p| samples(volume::adaptive::sample(c, &volume::adaptive::Options::new(WIDENING).domain(CUBE), p)),
        refused: &[
            ("radius_function: ", |c, p| {
                let radius = Varying::Function { at: &|_| 1e-5, smallest: 1e-5, largest: 1e-4, slope: 0.0 };
                said(volume::adaptive::sample(c, &volume::adaptive::Options::new(radius).domain(CUBE), p))
            }),
            ("smallest: ", |c, p| {
                let radius = Varying::Function { at: &|_| 0.1, smallest: 0.0, largest: 0.1, slope: 0.0 };
                said(volume::adaptive::sample(c, &volume::adaptive::Options::new(radius), p))
            }),
            ("grid_size: ", |c, p| {
                let radius = Varying::Grid { values: &[0.1], size: [2, 1, 1] };
                said(volume::adaptive::sample(c, &volume::adaptive::Options::new(radius), p))
            }),
        ],
    },
    Call {
        name: "volume::adaptive::sample_inside",
        reports: 15,
        run: |c, p| {
            let options = volume::adaptive::InsideOptions::new(WIDENING);
            samples(volume::adaptive::sample_inside(c, &SOLID, &options, p))
        },
        refused: &[
            ("mesh: ", |c, p| {
                let options = volume::adaptive::InsideOptions::new(WIDENING);
                said(volume::adaptive::sample_inside(c, &SHEET, &options, p))
            }),
            ("tolerance: ", |c, p| {
                let options = volume::adaptive::InsideOptions::new(WIDENING).tolerance(0.0);
                said(volume::adaptive::sample_inside(c, &SOLID, &options, p))
            }),
        ],
    },
    Call {
        name: "volume::sample_inside",
        reports: 5,
        run: |c, p| {
            samples(volume::sample_inside(
                c,
                &SOLID,
                &volume::InsideOptions::new(0.03).surface(volume::Surface::First),
                p,
            ))
        },
        refused: &[
            ("mesh: ", |c, p| said(volume::sample_inside(c, &SHEET, &volume::InsideOptions::new(0.1), p))),
            ("radius: ", |c, p| said(volume::sample_inside(c, &SOLID, &volume::InsideOptions::new(-0.1), p))),
            ("tolerance: ", |c, p| {
                said(volume::sample_inside(c, &SOLID, &volume::InsideOptions::new(0.1).tolerance(2.0), p))
            }),
            ("thickness: ", |c, p| {
                said(volume::sample_inside(c, &SOLID, &volume::InsideOptions::new(0.1).thickness(-1.0), p))
            }),
        ],
    },
    Call {
        name: "interior::Interior::contains_each",
        reports: 3,
        run: |c, p| said(Interior::of(&SOLID).contains_each(c, &[[0.1; 3]; 10_000], p)),
        refused: &[("positions: ", |c, p| said(Interior::of(&SOLID).contains_each(c, &[[f32::NAN; 3]], p)))],
    },
];
