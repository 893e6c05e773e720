use std::sync::atomic::{AtomicU64, Ordering};
use azulejo::volume::adaptive::{self, Radius};
use azulejo::{Context, Domain, Boundary};
fn cpu() -> f64 {
    let s = std::fs::read_to_string("/proc/thread-self/schedstat").unwrap();
    s.split(' ').next().unwrap().parse::<f64>().unwrap() * 1e-9
}
fn main() {
    let n: f64 = std::env::args().nth(1).map_or(1e6, |x| x.parse().unwrap());
    let context = Context::new(1).unwrap();
    let u0 = cpu();
    let r = f64::cbrt(0.73364 / n);
    let uni = azulejo::volume::sample(&context, &azulejo::volume::Options::new(r), None).unwrap().0.len();
    println!("uniform {uni} N r3/phi {:.4} us {:.3}", uni as f64 / n, (cpu() - u0) * 1e6 / uni as f64);
    for boundary in [Boundary::Periodic, Boundary::Bounded] {
    for ratio in [1.0f64, 4.0, 16.0, 64.0] {
        let mean = 0.5 * (1.0 + 1.0 / ratio) / ratio;
        let least = f64::cbrt(0.73364 * mean / n);
        let slope = (ratio - 1.0) * least;
        let calls = AtomicU64::new(0);
        let counted = |[x, _, _]: [f64; 3]| { calls.fetch_add(1, Ordering::Relaxed); least + slope * x };
        let plain = |[x, _, _]: [f64; 3]| least + slope * x;
        let domain = Domain::unit(boundary);
        let of = |at: &(dyn Fn([f64; 3]) -> f64 + Sync)| {
            let radius = Radius::Function { at, smallest: least, largest: ratio * least, slope };
            let from = cpu();
            let found = adaptive::sample(&context, &adaptive::Options::new(radius).domain(domain), None).unwrap().0.len();
            (found, (cpu() - from) * 1e6 / found as f64)
        };
        let (found, us) = of(&plain);
        let (_, us2) = of(&plain);
        of(&counted);
        println!("{boundary:?} 1:{ratio} {found} / integral {:.4}  us {us:.3} {us2:.3} calls {:.1}", found as f64 / n, calls.load(Ordering::Relaxed) as f64 / found as f64);
    }
    }
}
