//! Affine fields and interfaces in two and three dimensions.

use dmm_runtime::pws;

use super::{Family, Scales, problem, start};
use crate::formula::{Formulas, Writer};
use crate::reference::Problem;
use dmm_problems::random::Random;

/// An affine system in formulas: the rows of A and b of each side, and those of g.
fn affine<const N: usize>(
    scales: Scales,
    initial: [f64; N],
    sides: [([[f64; N]; N], [f64; N]); 2],
    (n, offset): ([f64; N], f64),
) -> Problem {
    let Scales { l, s } = scales;
    let fields = sides.map(|(a, b)| {
        Formulas::of(|w: &Writer| {
            let x = w.state::<N>();
            let row = |i: usize| {
                let terms = x.iter().zip(a[i]).map(|(x, a)| *x * a);
                terms.fold(w.number(l * b[i]), |sum, term| sum + term) * s
            };
            (0..N).map(row).collect()
        })
    });
    let g = Formulas::of(|w: &Writer| {
        let x = w.state::<N>();
        let terms = x.iter().zip(n).map(|(x, n)| *x * n);
        vec![terms.fold(w.number(-l * offset), |sum, term| sum + term)]
    });
    problem(scales, initial, fields.to_vec(), g)
}

/// A matrix whose flow turns and hardly grows.
fn turning<const N: usize>(random: &mut Random) -> [[f64; N]; N] {
    let mut a = [[0.0; N]; N];
    let below = |i: usize| (0..i).map(move |j| (i, j));
    for (i, j) in (0..N).flat_map(below) {
        let size = random.between(0.3, 2.0);
        let turn = random.signed(size);
        a[i][j] = turn + random.between(-0.2, 0.2);
        a[j][i] = -turn + random.between(-0.2, 0.2);
    }
    for (i, row) in a.iter_mut().enumerate() {
        row[i] = random.between(-0.2, 0.05);
    }
    a
}

pws! {
    /// Affine fields in the plane and a line.
    pub system Plane {
        state x, y;
        param l = 1, s = 1, a[4] = 0, b[2] = 0, c[4] = 0, d[2] = 0, n[2] = 1, r = 0;
        interface line = n[0]*x + n[1]*y - l*r;
        region low where line < 0 {
            der(x) = s * (a[0]*x + a[1]*y + l*b[0]);
            der(y) = s * (a[2]*x + a[3]*y + l*b[1]);
        }
        region high where line > 0 {
            der(x) = s * (c[0]*x + c[1]*y + l*d[0]);
            der(y) = s * (c[2]*x + c[3]*y + l*d[1]);
        }
    }
}

impl Family<2> for Plane {
    const TITLE: &'static str = "affine, plane";

    fn draw(random: &mut Random, Scales { l, s }: Scales) -> (Self, [f64; 2]) {
        let [[a0, a1], [a2, a3]] = turning(random);
        let [[c0, c1], [c2, c3]] = turning(random);
        let system = Self {
            l,
            s,
            a: [a0, a1, a2, a3],
            b: random.array(0.5),
            c: [c0, c1, c2, c3],
            d: random.array(0.5),
            n: random.array(1.0),
            r: random.between(-0.5, 0.5),
        };
        (system, start(random, l))
    }

    fn problem(&self, initial: [f64; 2]) -> Problem {
        let Self {
            l,
            s,
            a,
            b,
            c,
            d,
            n,
            r,
        } = *self;
        let rows = |a: [f64; 4]| [[a[0], a[1]], [a[2], a[3]]];
        let sides = [(rows(a), b), (rows(c), d)];
        affine(Scales { l, s }, initial, sides, (n, r))
    }
}

pws! {
    /// Affine fields in space and a plane.
    pub system Space {
        state x, y, z;
        param l = 1, s = 1, a[9] = 0, b[3] = 0, c[9] = 0, d[3] = 0, n[3] = 1, r = 0;
        interface plane = n[0]*x + n[1]*y + n[2]*z - l*r;
        region low where plane < 0 {
            der(x) = s * (a[0]*x + a[1]*y + a[2]*z + l*b[0]);
            der(y) = s * (a[3]*x + a[4]*y + a[5]*z + l*b[1]);
            der(z) = s * (a[6]*x + a[7]*y + a[8]*z + l*b[2]);
        }
        region high where plane > 0 {
            der(x) = s * (c[0]*x + c[1]*y + c[2]*z + l*d[0]);
            der(y) = s * (c[3]*x + c[4]*y + c[5]*z + l*d[1]);
            der(z) = s * (c[6]*x + c[7]*y + c[8]*z + l*d[2]);
        }
    }
}

impl Family<3> for Space {
    const TITLE: &'static str = "affine, space";

    fn draw(random: &mut Random, Scales { l, s }: Scales) -> (Self, [f64; 3]) {
        let flat = |rows: [[f64; 3]; 3]| std::array::from_fn(|k| rows[k / 3][k % 3]);
        let system = Self {
            l,
            s,
            a: flat(turning(random)),
            b: random.array(0.5),
            c: flat(turning(random)),
            d: random.array(0.5),
            n: random.array(1.0),
            r: random.between(-0.5, 0.5),
        };
        (system, random.array::<3>(1.5).map(|x| l * x))
    }

    fn problem(&self, initial: [f64; 3]) -> Problem {
        let Self {
            l,
            s,
            a,
            b,
            c,
            d,
            n,
            r,
        } = *self;
        let rows = |a: [f64; 9]| std::array::from_fn(|i| std::array::from_fn(|j| a[3 * i + j]));
        let sides = [(rows(a), b), (rows(c), d)];
        affine(Scales { l, s }, initial, sides, (n, r))
    }
}
