//! Recurrences against the identities that define their functions.

use super::*;

const P: usize = 23;

impl Order for usize {
    const IS_FIXED: bool = false;

    fn get(self) -> usize {
        self
    }
}

/// A series with coefficients like those of a function with the radius of convergence 2.
fn sample(seed: u64) -> [f64; P] {
    let mut state = seed;
    std::array::from_fn(|k| {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        let unit = (state >> 11) as f64 / (1u64 << 53) as f64;
        (0.5 + unit) * 0.5f64.powi(k as i32)
    })
}

/// The series that `coefficient` gives from the coefficients below.
fn series(start: f64, mut coefficient: impl FnMut(usize, &[f64; P]) -> f64) -> [f64; P] {
    let mut w = [0.0; P];
    w[0] = start;
    for k in 1..P {
        w[k] = coefficient(k, &w);
    }
    w
}

/// h du/dh
fn derived(u: &[f64; P]) -> [f64; P] {
    std::array::from_fn(|k| derivative(k, u[k]))
}

fn assert_close(a: &[f64; P], b: &[f64; P]) {
    for k in 0..P {
        // sums of 23 products, of series that fall off like 2⁻ᵏ
        let tolerance = 1e-12 * 0.5f64.powi(k as i32);
        assert!((a[k] - b[k]).abs() <= tolerance, "{k}: {} {}", a[k], b[k]);
    }
}

fn times(u: &[f64; P], v: &[f64; P]) -> [f64; P] {
    std::array::from_fn(|k| product(k, u, v))
}

#[test]
fn a_product_is_the_sum_of_all_products() {
    let (u, v) = (sample(1), sample(2));
    let plain = |u: &[f64; P], v: &[f64; P]| {
        std::array::from_fn(|k| (0..=k).map(|j| u[j] * v[k - j]).sum::<f64>())
    };
    assert_close(&times(&u, &v), &plain(&u, &v));
    assert_close(&std::array::from_fn(|k| square(k, &u)), &plain(&u, &u));
}

#[test]
fn sums_in_lanes_are_those_of_each() {
    // blocks of 16, 8 and 4 lanes
    const W: usize = 28;
    let [a, b]: [[[f64; P]; W]; 2] =
        [0, W].map(|first| std::array::from_fn(|lane| sample((9 + first + lane) as u64)));
    let mut tables = [[0.0; P]; 2 * W];
    for k in 0..P {
        let sums: [f64; W] = inner_sums(k, &tables);
        let halves: [f64; W] = half_sums(k, &tables[..W]);
        for lane in 0..W {
            let plain = |u: &[f64; P], v: &[f64; P]| (1..k).map(|j| u[j] * v[k - j]).sum::<f64>();
            // sums of at most 22 products, of series that fall off like 2⁻ᵏ
            let close = |a: f64, b: f64| (a - b).abs() <= 1e-14 * 0.5f64.powi(k as i32) * 22.0;
            let (a, b) = (&a[lane], &b[lane]);
            assert!(close(sums[lane], plain(a, b)));
            let middle = if k % 2 == 0 && k > 0 { a[k / 2] } else { 0.0 };
            assert!(close(2.0 * halves[lane] + middle * middle, plain(a, a)));
        }
        let [rows_a, rows_b] = [&a, &b].map(|of| std::array::from_fn(|lane| of[lane][k]));
        let (first, second) = tables.split_at_mut(W);
        for lane in (0..W).step_by(4) {
            set_pack(first, k, lane, Pack::<_, 4>::of_lanes(&rows_a, lane));
            set_pack(second, k, lane, Pack::<_, 4>::of_lanes(&rows_b, lane));
        }
        assert_eq!(row::<_, P, W>(first, k), &rows_a);
        let four = pack::<_, P, W, 4>(second, k, 4).0;
        assert_eq!(four[..], rows_b[4..8]);
    }
}

#[test]
fn four_values_in_one_vector_stay_what_they_are() {
    for four in [
        [1.5, -0.0, f64::MIN_POSITIVE, -f64::MAX],
        [0.0, f64::INFINITY, f64::NEG_INFINITY, -5e-324],
    ] {
        let joined = Pack::joined(four).0;
        assert_eq!(joined.map(f64::to_bits), four.map(f64::to_bits));
    }
}

#[test]
fn recurrences_side_by_side_are_those_of_each() {
    let numbers = |seed: u64| -> [f64; 4] { std::array::from_fn(|i| sample(seed)[2 + i] + 1.0) };
    let [u, u0, v, v0, sum, middle] = [11, 12, 13, 14, 15, 16].map(numbers);
    let [f, f0, g, g0, s, m] = [u, u0, v, v0, sum, middle].map(Pack);
    let each = |of: &dyn Fn(usize) -> f64| -> [f64; 4] { std::array::from_fn(of) };
    for k in 1..6 {
        let product = |i: usize| product_from(k, [u0[i], u[i]], [v0[i], v[i]], sum[i]);
        assert_eq!(product_from(k, [f0, f], [g0, g], s).0, each(&product));
        let square = |i: usize| square_from(k, [u0[i], u[i]], middle[i], sum[i]);
        assert_eq!(square_from(k, [f0, f], m, s).0, each(&square));
        let half = |i: usize| half_square_from(k, [u0[i], u[i]], middle[i], sum[i]);
        assert_eq!(half_square_from(k, [f0, f], m, s).0, each(&half));
        let quotient = |i: usize| quotient_from(k, u[i], v[i], u0[i], v0[i], sum[i]);
        assert_eq!(quotient_from(k, f, g, f0, g0, s).0, each(&quotient));
        let late = |i: usize| late_quotient_from(k, u[i], v[i], u0[i], v0[i], sum[i]);
        assert_eq!(late_quotient_from(k, f, g, f0, g0, s).0, each(&late));
        let root = |i: usize| square_root_from(k, u[i], middle[i], v0[i], sum[i]);
        assert_eq!(square_root_from(k, f, m, g0, s).0, each(&root));
        let integral = |i: usize| integral_from(k, u[i], v0[i], sum[i]);
        assert_eq!(integral_from(k, f, g0, s).0, each(&integral));
        let power = |i: usize| power_from(k, u[i], v[i], u0[i], v0[i], [sum[i], middle[i]]);
        assert_eq!(power_from(k, f, g, f0, g0, [s, m]).0, each(&power));
        assert_eq!(plus(k, f, -g).0, each(&|i| plus(k, u[i], -v[i])));
        assert_eq!(derivative(k, f).0, each(&|i| derivative(k, u[i])));
        assert_eq!(((f - g) * s).0, each(&|i| (u[i] - v[i]) * sum[i]));
    }
}

#[test]
fn quotients_roots_and_powers_are_inverse_to_products() {
    let (u, v) = (sample(3), sample(4));
    let w = series(u[0] / v[0], |k, w| quotient(k, u[k], &v, w, 1.0 / v[0]));
    assert_close(&times(&w, &v), &u);
    let late = series(u[0] / v[0], |k, w| {
        late_quotient_from(k, u[k], v[k], w[0], 1.0 / v[0], inner(k, &v, w))
    });
    assert_close(&late, &w);
    let w = series(u[0].sqrt(), |k, w| {
        square_root(k, u[k], w, 0.5 / u[0].sqrt())
    });
    assert_close(&times(&w, &w), &u);
    let power_of = |a: f64| {
        series(u[0].powf(a), |k, w| {
            power(k, &u, a, [w, &derived(w)], 1.0 / u[0])
        })
    };
    assert_close(&times(&power_of(0.3), &power_of(0.7)), &u);
    for a in [0.3, -1.0, -1.5, 2.5] {
        let (w, inverse) = (power_of(a), 1.0 / u[0]);
        let by_pairs = series(w[0], |k, w| {
            power_by_pairs(k, &u, a, &table([w, &derived(w)]), inverse)
        });
        // sums of at most 22 terms, of series that fall off like 0.75ᵏ
        let is_close = |k: usize| (by_pairs[k] - w[k]).abs() <= 2e-14 * 0.75f64.powi(k as i32);
        assert!((0..P).all(is_close), "{a}: {by_pairs:?} {w:?}");
    }
}

/// A table of two lanes of two series.
fn table(pair: [&[f64; P]; 2]) -> [[f64; P]; 2] {
    let mut table = [[0.0; P]; 2];
    for k in 0..P {
        set_pack(&mut table, k, 0, Pack(pair.map(|series| series[k])));
    }
    table
}

#[test]
fn pairs_are_two_products_two_squares_and_two_integrals() {
    let [a, b, c, d] = [21, 22, 23, 24].map(sample);
    let (u, v) = (table([&a, &b]), table([&c, &d]));
    let below = |of: [&[f64; P]; 2], k: usize| {
        // what is not known at order k must not count
        let known =
            of.map(|series| std::array::from_fn(|j| if j < k { series[j] } else { f64::NAN }));
        table([&known[0], &known[1]])
    };
    for k in 0..P {
        let newest = |of: [&[f64; P]; 2]| Pack(of.map(|series| series[k]));
        let first = below([&a, &b], k.max(1));
        let first = if k == 0 { u } else { first };
        let factors = (Rows(&first), newest([&a, &b]));
        let same = (Common(&c), Pack::all(c[k]));
        // sums of at most 23 products, of series that fall off like 2⁻ᵏ
        let close = |pair: Pack<f64, 2>, other: [f64; 2]| {
            let error = 1e-13 * 0.5f64.powi(k as i32);
            pair.0
                .iter()
                .zip(other)
                .all(|(a, b)| (a - b).abs() <= error)
        };
        let both = products(k, factors, (Rows(&v), newest([&c, &d])));
        assert!(close(both, [product(k, &a, &c), product(k, &b, &d)]));
        let both = products(k, factors, same);
        assert!(close(both, [product(k, &a, &c), product(k, &b, &c)]));
        assert!(close(squares(k, factors), [square(k, &a), square(k, &b)]));
        if k > 0 {
            let slopes = derived(&d);
            let both = integrals(k, d[k], &slopes, &first);
            let each = [&a, &b].map(|v| integral(k, d[k], &slopes, v));
            assert!(close(both, each));
        }
    }
}

#[test]
fn the_logarithm_is_inverse_to_the_exponential() {
    let u = sample(5);
    let d = derived(&u);
    let w = series(u[0].exp(), |k, w| integral(k, u[k], &d, w));
    let mut slopes = [0.0; P];
    let ln = series(w[0].ln(), |k, _| {
        let ln = primitive(k, w[k], &w, &slopes, 1.0 / w[0]);
        slopes[k] = derivative(k, ln);
        ln
    });
    assert_close(&ln, &u);
}

#[test]
fn sine_and_cosine_lie_on_the_circle() {
    let u = sample(6);
    let d = derived(&u);
    let (mut s, mut c) = ([0.0; P], [0.0; P]);
    (s[0], c[0]) = u[0].sin_cos();
    for k in 1..P {
        (s[k], c[k]) = (integral(k, u[k], &d, &c), -integral(k, u[k], &d, &s));
    }
    let one = std::array::from_fn(|k| square(k, &s) + square(k, &c));
    assert_close(&one, &std::array::from_fn(|k| constant(k, 1.0)));
}

#[test]
fn an_order_may_be_a_constant_or_a_number() {
    let (u, v) = (sample(7), sample(8));
    // sums of 10 products in another order
    let close = |a: f64, b: f64| (a - b).abs() <= 1e-14 * a.abs();
    assert!(close(product(Fixed::<9>, &u, &v), product(9, &u, &v)));
    assert!(close(half_square(Fixed::<8>, &u), half_square(8, &u)));
    assert_eq!([time(0, 3.0), time(1, 3.0), time(2, 3.0)], [3.0, 1.0, 0.0]);
    assert_eq!([plus(0, 2.0, 5.0), plus(3, 2.0, 5.0)], [7.0, 2.0]);
}
