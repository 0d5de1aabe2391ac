//! What the normal form must prove, refute, and leave open.

use super::formula::formula;
use crate::algebra::{
    Dag, Id, Name, Verdict, at_end, at_start, decide_zero, differentiate, divide_exactly,
    divided_difference, normalise, to_text,
};

fn decide(text: &str) -> Verdict {
    let mut dag = Dag::new();
    let root = formula(&mut dag, text);
    decide_zero(&mut dag, root)
}

/// ∂ₜψ + ∇ψ·f, with x′ = f given as (x, f).
fn rate(dag: &mut Dag, psi: &str, field: &[(&str, &str)]) -> Id {
    let psi = formula(dag, psi);
    let mut rate = differentiate(dag, psi, &Name::new("t"));
    for (state, component) in field {
        let slope = differentiate(dag, psi, &Name::new(state));
        let component = formula(dag, component);
        let term = dag.mul(slope, component);
        rate = dag.add(rate, term);
    }
    rate
}

/// ψ(end) − ψ(start) − Σ c_v (v₁ − v₀)
fn defect(dag: &mut Dag, psi: &str, variables: &[&str]) -> Id {
    let psi = formula(dag, psi);
    let variables: Vec<Name> = variables.iter().map(|name| Name::new(name)).collect();
    let coefficients = divided_difference(dag, psi, &variables);
    let end = at_end(dag, psi, &variables);
    let start = at_start(dag, psi, &variables);
    let mut defect = dag.sub(end, start);
    for (name, coefficient) in variables.iter().zip(coefficients) {
        let end = dag.variable(&name.at_end());
        let start = dag.variable(&name.at_start());
        let difference = dag.sub(end, start);
        let term = dag.mul(coefficient, difference);
        defect = dag.sub(defect, term);
    }
    defect
}

macro_rules! proves {
    ($($name:ident: $text:literal,)*) => { $(
        #[test]
        fn $name() {
            assert_eq!(decide($text), Verdict::Proved, "{}", $text);
        }
    )* };
}

macro_rules! conserves {
    ($($name:ident: $psi:literal, $($state:literal = $field:literal),*;)*) => { $(
        #[test]
        fn $name() {
            let mut dag = Dag::new();
            let rate = rate(&mut dag, $psi, &[$(($state, $field)),*]);
            assert_eq!(decide_zero(&mut dag, rate), Verdict::Proved, "{}", to_text(&dag, rate));
        }
    )* };
}

macro_rules! telescopes {
    ($($name:ident: $psi:literal, $($state:literal),*;)*) => { $(
        #[test]
        fn $name() {
            let mut dag = Dag::new();
            let defect = defect(&mut dag, $psi, &[$($state),*]);
            assert_eq!(decide_zero(&mut dag, defect), Verdict::Proved, "{}", to_text(&dag, defect));
        }
    )* };
}

macro_rules! refutes {
    ($($name:ident: $text:literal,)*) => { $(
        #[test]
        fn $name() {
            assert!(matches!(decide($text), Verdict::Refuted(_)), "{}", $text);
        }
    )* };
}

proves! {
    pythagoras:              "sin(x)^2 + cos(x)^2 - 1",
    double_angle_of_sine:    "sin(2*x) - 2*sin(x)*cos(x)",
    double_angle_of_cosine:  "cos(2*x) - 1 + 2*sin(x)^2",
    half_angle:              "2*sin(x/2)^2 - 1 + cos(x)",
    addition_of_sine:        "sin(x + y) - sin(x)*cos(y) - cos(x)*sin(y)",
    addition_of_tangent:     "tan(x + y) - (tan(x) + tan(y))/(1 - tan(x)*tan(y))",
    tangent_is_a_quotient:   "tan(x) - sin(x)/cos(x)",
    triple_angle:            "sin(3*x) - 3*sin(x) + 4*sin(x)^3",
    angle_of_a_sum_of_terms: "cos(k*x*(x + 1)) - cos(k*x^2)*cos(k*x) + sin(k*x^2)*sin(k*x)",
    shift_by_right_angle:    "sin(x + pi/2) - cos(x)",
    cosine_of_sixty_degrees: "cos(pi/3) - 1/2",
    sine_of_45_degrees:      "sin(pi/4) - sqrt(2)/2",
    hyperbolic_pythagoras:   "cosh(x)^2 - sinh(x)^2 - 1",
    hyperbolic_double:       "sinh(2*x) - 2*sinh(x)*cosh(x)",
    hyperbolic_tangent:      "tanh(x) - (exp(2*x) - 1)/(exp(2*x) + 1)",
    exponential_of_a_sum:    "exp(x + 2*y) - exp(x)*exp(y)^2",
    logarithm_of_exp:        "ln(exp(x^2 + y)) - x^2 - y",
    exp_of_logarithm:        "exp(2*ln(x^2 + 1)) - (x^2 + 1)^2",
    logarithm_of_constants:  "ln(6*x) - ln(2) - ln(3*x)",
    square_of_root:          "sqrt(x)^2 - x",
    square_of_root_of_sum:   "sqrt(x^2 + y^2)^2 - x^2 - y^2",
    cube_of_root_of_sum:     "(x^2 + y^2)^(3/2) - (x^2 + y^2)*sqrt(x^2 + y^2)",
    rationalised_root:       "1/(sqrt(x + 1) + sqrt(x)) - sqrt(x + 1) + sqrt(x)",
    nested_root:             "sqrt(sqrt(x^2 + 1)) - (x^2 + 1)^(1/4)",
    roots_of_numbers:        "sqrt(6) - sqrt(2)*sqrt(3)",
    root_of_eight:           "sqrt(8*x) - 2*sqrt(2)*sqrt(x)",
    root_of_a_quotient:      "sqrt((1 - x)/(1 + x))^2*(1 + x) - 1 + x",
    root_of_an_inverse:      "sqrt(k/m)*sqrt(m/k) - 1",
    size_squared:            "abs(x - y)^2 - (x - y)^2",
    size_of_opposite:        "abs(x - y) - abs(y - x)",
    sum_of_arcs:             "asin(x*y) + acos(x*y) - pi/2",
    sine_of_arc_cosine:      "sin(acos(x)) - sqrt(1 - x^2)",
    tangent_of_arc_tangent:  "tan(atan(x/y)) - x/y",
    double_arc_tangent:      "cos(2*atan(x)) - (1 - x^2)/(1 + x^2)",
    odd_arc_tangent:         "atan(x - y) + atan(y - x)",
    symbolic_power:          "x^(r + 1) - x*x^r",
    power_of_two:            "2^(x + 1) - 2*2^x",
    sinc_is_a_quotient:      "x*sinc(x) - sin(x)",
    sinc_prime:              "x*sinc_prime(x) - cos(x) + sinc(x)",
    sinhc_prime:             "x*sinhc_prime(x) - cosh(x) + sinhc(x)",
    ln_dd_at_one_point:      "ln_dd(x, x) - 1/x",
    cancelling_fractions:    "(x^2 - y^2)/(x - y) - x - y",
    partial_fractions:       "1/(x*(x + 1)) - 1/x + 1/(x + 1)",
    equal_arguments:         "exp((x^2 - 1)/(x + 1)) - exp(x)/exp(1)",
    nested_trigonometry:     "sin(cos(x) + y) - sin(y)*cos(cos(x)) - cos(y)*sin(cos(x))",
    root_of_square_of_sine:  "sqrt(sin(x)^2)^2 + cos(x)^2 - 1",
    root_of_a_product:       "sqrt(x*y) - sqrt(x)*sqrt(y)",
    root_of_three_factors:   "sqrt(x*y*z^2) - sqrt(x)*sqrt(y)*abs(z)",
    root_of_a_square:        "sqrt((x + y)^2) - abs(x + y)",
    root_of_a_long_square:   "sqrt(x^2 + 2*x*y + y^2)*sqrt(x + y) - sqrt(x + y)^3",
    root_of_a_sum_of_squares: "sqrt(x^4 + 2*x^2*y^2 + y^4) - x^2 - y^2",
    root_with_known_factor:  "sqrt((x + y)*z) - sqrt(x + y)*sqrt(z)",
    root_of_hyperbolic:      "sqrt(1 + sinh(x)^2) - cosh(x)",
    fourth_root:             "sqrt(sqrt(x*y)) - sqrt(sqrt(x))*y^(1/4)",
    logarithm_of_a_product:  "ln(x*y) - ln(x) - ln(y)",
    logarithm_of_a_power:    "ln(x^2*y^3) - 2*ln(x) - 3*ln(y)",
    logarithm_of_a_quotient: "ln((1 + x)/(1 - x)) - ln(1 + x) + ln(1 - x)",
    logarithm_of_known_factor: "ln((x + y)^2*z) - 2*ln(x + y) - ln(z)",
    logarithm_of_a_root:     "ln(sqrt(x^2 + 1)) - ln(x^2 + 1)/2",
    power_of_a_product:      "(x*y)^r - x^r*y^r",
    root_of_a_difference:    "sqrt((1 - x)*(1 + x)) - sqrt(1 - x)*sqrt(1 + x)",
}

conserves! {
    harmonic: "(y^2 + k*x^2)/2", "x" = "y", "y" = "-k*x";
    elliptic: "y^2 - x^3 - a*x", "x" = "2*y", "y" = "3*x^2 + a";
    pendulum: "y^2/2 - g/l*cos(x)", "x" = "y", "y" = "-g/l*sin(x)";
    duffing: "y^2/2 + a*x^2/2 + b*x^4/4", "x" = "y", "y" = "-a*x - b*x^3";
    henon_heiles: "(p^2 + q^2 + x^2 + y^2)/2 + x^2*y - y^3/3",
        "x" = "p", "y" = "q", "p" = "-x - 2*x*y", "q" = "-y - x^2 + y^2";
    lotka_volterra: "d*x - c*ln(x) + b*y - a*ln(y)", "x" = "x*(a - b*y)", "y" = "y*(d*x - c)";
    lotka_volterra_as_product: "x^c*y^a*exp(-d*x - b*y)",
        "x" = "x*(a - b*y)", "y" = "y*(d*x - c)";
    damped_oscillator: "(m*v^2 + g*x*v + k*x^2)/2*exp(g*t/m)",
        "x" = "v", "v" = "-(g*v + k*x)/m";
    spiral: "(x^2 + y^2)*exp(-2*a*t)", "x" = "a*x - b*y", "y" = "b*x + a*y";
    spiral_phase: "atan(y/x) - b*t", "x" = "a*x - b*y", "y" = "b*x + a*y";
    rigid_body_energy: "(x^2/a + y^2/b + z^2/c)/2",
        "x" = "(1/c - 1/b)*y*z", "y" = "(1/a - 1/c)*z*x", "z" = "(1/b - 1/a)*x*y";
    rigid_body_momentum: "x^2 + y^2 + z^2",
        "x" = "(1/c - 1/b)*y*z", "y" = "(1/a - 1/c)*z*x", "z" = "(1/b - 1/a)*x*y";
    kepler_energy: "(p^2 + q^2)/2 - m/sqrt(x^2 + y^2)",
        "x" = "p", "y" = "q", "p" = "-m*x/(x^2 + y^2)^(3/2)", "q" = "-m*y/(x^2 + y^2)^(3/2)";
    kepler_angular_momentum: "x*q - y*p",
        "x" = "p", "y" = "q", "p" = "-m*x/(x^2 + y^2)^(3/2)", "q" = "-m*y/(x^2 + y^2)^(3/2)";
    kepler_laplace_runge_lenz_x: "q*(x*q - y*p) - m*x/sqrt(x^2 + y^2)",
        "x" = "p", "y" = "q", "p" = "-m*x/(x^2 + y^2)^(3/2)", "q" = "-m*y/(x^2 + y^2)^(3/2)";
    kepler_laplace_runge_lenz_y: "-p*(x*q - y*p) - m*y/sqrt(x^2 + y^2)",
        "x" = "p", "y" = "q", "p" = "-m*x/(x^2 + y^2)^(3/2)", "q" = "-m*y/(x^2 + y^2)^(3/2)";
    toda: "(p^2 + q^2 + r^2)/2 + exp(x - y) + exp(y - z) + exp(z - x)",
        "x" = "p", "y" = "q", "z" = "r",
        "p" = "exp(z - x) - exp(x - y)", "q" = "exp(x - y) - exp(y - z)",
        "r" = "exp(y - z) - exp(z - x)";
    toda_third_invariant: "(p^3 + q^3 + r^3)/3 + (p + q)*exp(x - y) + (q + r)*exp(y - z) + (r + p)*exp(z - x)",
        "x" = "p", "y" = "q", "z" = "r",
        "p" = "exp(z - x) - exp(x - y)", "q" = "exp(x - y) - exp(y - z)",
        "r" = "exp(y - z) - exp(z - x)";
    double_well_with_tanh: "v^2/2 + ln(cosh(x))", "x" = "v", "v" = "-tanh(x)";
    arc_potential: "v^2/2 + x*asin(x) + sqrt(1 - x^2)", "x" = "v", "v" = "-asin(x)";
    point_vortices: "ln((x - u)^2 + (y - v)^2)",
        "x" = "-(y - v)/((x - u)^2 + (y - v)^2)", "y" = "(x - u)/((x - u)^2 + (y - v)^2)",
        "u" = "(y - v)/((x - u)^2 + (y - v)^2)", "v" = "-(x - u)/((x - u)^2 + (y - v)^2)";
}

telescopes! {
    ends_of_a_polynomial: "y^2*x - x^3 + x^6*y^5/7", "x", "y";
    ends_of_an_odd_power: "x^13", "x";
    ends_of_a_negative_power: "1/x^3 + y/x", "x", "y";
    ends_of_a_quotient: "x*y/(1 + x^2 + y^2)", "x", "y";
    ends_of_sine: "sin(k*x + y)", "x", "y";
    ends_of_cosine: "cos(x)*y^2", "x", "y";
    ends_of_a_product_angle: "sin(x*y)", "x", "y";
    ends_of_exp: "exp(a*x - y)*x", "x", "y";
    ends_of_logarithm: "x*ln(x + y)", "x", "y";
    ends_of_tangent: "tan(2*x)", "x";
    ends_of_hyperbolic_tangent: "tanh(x)", "x";
    ends_of_hyperbolic: "sinh(x)*cosh(y)", "x", "y";
    ends_of_root: "sqrt(1 + x^2)", "x";
    ends_of_kepler: "(p^2 + q^2)/2 - m/sqrt(x^2 + y^2)", "x", "y", "p", "q";
    ends_of_rational_power: "(x^2 + y)^(3/2)", "x", "y";
    ends_of_cube_root: "x^(2/3) + x^(-1/3)", "x";
    ends_of_symbolic_power: "x^r", "x";
    ends_of_varying_exponent: "x^y", "x", "y";
    ends_of_an_exponential: "a^x", "x";
    ends_of_arc_tangent: "atan(x*y)", "x", "y";
    ends_of_arc_sine: "asin(x) - 2*acos(y)", "x", "y";
    ends_of_double_angle: "sin(x)*cos(x) - sin(2*x)/2", "x";
    ends_of_size: "abs(x)", "x";
    ends_of_sinc: "sinc(x)", "x";
    ends_of_time: "(m*v^2 + g*x*v + k*x^2)/2*exp(g*t/m)", "x", "v", "t";
}

refutes! {
    wrong_sign_in_pythagoras: "sin(x)^2 - cos(x)^2 - 1",
    wrong_double_angle: "sin(2*x) - 2*sin(x)",
    wrong_power: "x^3 - x^2",
    wrong_branch_of_root: "sqrt(x^2) - x",
    wrong_logarithm: "ln(x + y) - ln(x) - ln(y)",
    wrong_exponential: "exp(x*y) - exp(x)*exp(y)",
    wrong_arc: "asin(x) - acos(x)",
    wrong_tanh: "tanh(x) - sinh(x)/(1 + cosh(x))",
    wrong_small_difference: "x*1000000/1000001 - x",
    wrong_constant: "pi - 22/7",
    wrong_rational_power: "(x^2 + y^2)^(3/2) - (x^2 + y^2)^(5/3)",
    wrong_sum_of_arcs: "atan(x) + atan(1/x) - pi/2",
    wrong_kepler: "q*(x*q - y*p) - x*sqrt(x^2 + y^2)",
    wrong_sign_of_a_root: "sqrt((x + y)^2) - x - y",
    wrong_sign_of_a_square_root: "sqrt(x^2*y) - x*sqrt(y)",
    wrong_root_of_products: "sqrt(x*y)*sqrt(y*z)*sqrt(z*x) - x*y*z",
    wrong_roots_of_squares: "sqrt(x*y*(1 + x*y)^2)*sqrt(y*z*(1 + y*z)^2)*sqrt(z*x*(1 + z*x)^2) - x*y*z*(1 + x*y)*(1 + y*z)*(1 + z*x)",
    wrong_root_of_an_unknown_square: "sqrt(1 - sin(x)^2) - cos(x)",
    wrong_power_of_a_square: "(x^2)^(3/2) - x^3",
    wrong_by_a_tiny_coefficient: "x^3*y - x^3*y*(1 + 1/10^20)",
    wrong_by_a_tiny_constant: "(x + y)^2 - x^2 - 2*x*y - y^2 + 1/10^30",
    wrong_by_a_tiny_fraction: "(x + 1/10^25)/(x + 1) - x/(x + 1)",
    wrong_by_a_tiny_sine: "sin(x)^2 + cos(x)^2*(1 + 1/10^18) - 1",
    wrong_by_a_tiny_logarithm: "ln(x*y) - (1 + 1/10^22)*ln(x) - ln(y)",
    wrong_in_a_large_sum: "(x + y)^12 - (x^2 + 2*x*y + y^2)^6 + x^4/10^24",
}

#[test]
fn constants_are_related() {
    for text in [
        "sqrt(3 + 2*sqrt(2)) - 1 - sqrt(2)",
        "(20 + 14*sqrt(2))^(1/3) + (20 - 14*sqrt(2))^(1/3) - 4",
        "sqrt(2 + sqrt(2))*sqrt(2 - sqrt(2)) - sqrt(2)",
        "1/(sqrt(2) + sqrt(3) + sqrt(5)) - (sqrt(12) + sqrt(18) - sqrt(30))/12",
        "1/(2^(1/3) - 1) - 1 - 2^(1/3) - 4^(1/3)",
        "sin(pi/5) - sqrt(10 - 2*sqrt(5))/4",
        "cos(pi/7) - cos(2*pi/7) + cos(3*pi/7) - 1/2",
        "1/cos(pi/9) - 8*cos(2*pi/9)*cos(4*pi/9)",
        "atan(1/2) + atan(1/3) - pi/4",
        "4*atan(1/5) - atan(1/239) - pi/4",
        "atan(1) + atan(2) + atan(3) - pi",
        "atan(2 - sqrt(3)) - pi/12",
        "acos(1/3) - 2*atan(1/sqrt(2))",
        "ln(3 + 2*sqrt(2)) - 2*ln(1 + sqrt(2))",
        "asin(x) - atan(x/sqrt(1 - x^2))",
        "atan(x) - 2*atan(x/(1 + sqrt(1 + x^2)))",
        "((x^3 - x)^3)^(1/3) - x^3 + x",
        "ln((1 + x)^3) - 3*ln(1 + x)",
    ] {
        assert_eq!(decide(text), Verdict::Proved, "{text}");
    }
}

#[test]
fn constants_that_are_almost_related_are_refuted() {
    for text in [
        "sqrt(3 - 2*sqrt(2)) - 1 + sqrt(2)",
        "sqrt(5 + 2*sqrt(6)) - sqrt(2) - sqrt(3) - 1/10^9",
        "(7 - 5*sqrt(2))^2 - 99 + 70*sqrt(2) + 1/10^6",
        "atan(1/2) + atan(1/3) - 5*pi/4",
        "atan(3) + atan(2) + pi/4",
        "asin(4/5) + asin(12/13) - asin(56/65)",
        "cos(pi/7) + cos(2*pi/7) + cos(3*pi/7) - 1/2",
        "ln(2 + sqrt(3)) - ln(2 - sqrt(3))",
        "atan(x) - 2*atan(x/(1 - sqrt(1 + x^2)))",
        "((x^2 - x)^2)^(1/2) - x^2 + x",
    ] {
        let verdict = decide(text);
        assert!(
            matches!(verdict, Verdict::Refuted(_)),
            "{text}: {verdict:?}"
        );
    }
}

macro_rules! leaves_open {
    ($($name:ident: $text:literal,)*) => { $(
        #[test]
        fn $name() {
            assert_eq!(decide($text), Verdict::Undecided, "{}", $text);
        }
    )* };
}

leaves_open! {
    nested_third_root_of_numbers: "(9*2^(1/3) - 9)^(1/3) - 1 + 2^(1/3) - 4^(1/3)",
    nested_root_of_a_sum: "sqrt(x + 2*sqrt(x - 1)) - 1 - sqrt(x - 1)",
    odd_logarithm: "ln(x + sqrt(1 + x^2)) + ln(sqrt(1 + x^2) - x)",
    addition_of_arcs: "atan(x) + atan(1/x) - pi/2*x/sqrt(x^2)",
}

#[test]
fn nowhere_defined_is_undecided() {
    assert_eq!(decide("1/(x - x) + ln(-1)"), Verdict::Undecided);
    assert_eq!(decide("1/(sin(x)^2 + cos(x)^2 - 1)"), Verdict::Undecided);
}

#[test]
fn too_large_is_undecided_and_does_not_hang() {
    let text = "(a + b + c + d + x + y + z)^40 - (z + y + x + d + c + b + a)^40";
    assert_eq!(decide(text), Verdict::Proved);
    let square = "(a + b + c)^2 + 2*(a + b + c)*(d + x + y + z) + (d + x + y + z)^2";
    let text = format!("(a + b + c + d + x + y + z)^40 - ({square})^20");
    assert_eq!(decide(&text), Verdict::Exhausted);
}

#[test]
fn counterexample_is_readable() {
    let mut dag = Dag::new();
    let rate = rate(&mut dag, "(y^2 + k*x^2)/2", &[("x", "y"), ("y", "-x")]);
    let Verdict::Refuted(counterexample) = decide_zero(&mut dag, rate) else {
        panic!("not refuted");
    };
    assert_eq!(to_text(&dag, counterexample.residual), "y*x*(k - 1)");
    assert_eq!(counterexample.point.len(), 3);
}

#[test]
fn division_cancels_what_it_can() {
    for (above, below, value, denominator) in [
        ("x^2 - y^2", "x - y", "x + y", &[] as &[&str]),
        ("x^2 - y^2", "(x - y)^2", "(x + y)/(x - y)", &["x - y"]),
        (
            "(x^2 + 1)*(a*y + z)*(x - y)",
            "(z^2 + 1)*(a*y + z)",
            "(x^3 - x^2*y + x - y)/(z^2 + 1)",
            &["z^2 + 1"],
        ),
        (
            "x^2 - 3*x + 2",
            "x^2 - 2*x + 1",
            "(x - 2)/(x - 1)",
            &["x - 1"],
        ),
        (
            "x - y",
            "sqrt(x)*z - sqrt(y)*z",
            "(sqrt(x) + sqrt(y))/z",
            &["z"],
        ),
        ("x*(a - b*y)", "a/y - b", "x*y", &[]),
        ("-m*x/(x^2 + y^2)^(3/2)", "m*x/(x^2 + y^2)^(3/2)", "-1", &[]),
        ("sin(x)*y", "g*sin(x)", "y/g", &["g"]),
        ("2*y", "3*x^2 + a", "2*y/(3*x^2 + a)", &["3*x^2 + a"]),
        ("sin(2*x)", "cos(x)", "2*sin(x)", &[]),
    ] {
        let mut dag = Dag::new();
        let [above, below] = [above, below].map(|text| formula(&mut dag, text));
        let quotient = divide_exactly(&mut dag, above, below).expect("a quotient");
        assert_eq!(to_text(&dag, quotient.value), value);
        let factors: Vec<String> = quotient
            .denominator
            .iter()
            .map(|&factor| to_text(&dag, factor))
            .collect();
        assert_eq!(factors, denominator);
    }
}

#[test]
fn division_by_zero_is_refused() {
    let mut dag = Dag::new();
    let [above, below] = ["x", "sin(x)^2 + cos(x)^2 - 1"].map(|text| formula(&mut dag, text));
    assert_eq!(divide_exactly(&mut dag, above, below), None);
}

#[test]
fn normal_forms_are_readable() {
    for (text, expected) in [
        ("(x + y)^2 - x^2", "y*(2*x + y)"),
        ("cos(x)*sin(x)", "sin(2*x)/2"),
        ("exp(x) + exp(-x)", "2*cosh(x)"),
        ("1/(1 + tan(x)^2)", "(cos(2*x) + 1)/2"),
        ("(x^2 + y^2)^(3/2)/sqrt(x^2 + y^2)", "x^2 + y^2"),
        ("ln(2*x*exp(y))", "y + ln(2) + ln(x)"),
    ] {
        let mut dag = Dag::new();
        let root = formula(&mut dag, text);
        let normal = normalise(&mut dag, root).expect("a normal form");
        assert_eq!(to_text(&dag, normal), expected, "{text}");
    }
}

#[test]
fn the_largest_numbers_overflow_nothing() {
    let largest = i64::MIN.to_string();
    for number in [
        largest.as_str(),
        "9223372036854775807",
        "2147483648",
        "-2147483648",
    ] {
        for of in [
            format!("sin({number}*asin(q)) - sin({number}*asin(q)*(1 + q))"),
            format!("cos({number}*atan(q))"),
            format!("exp({number}*q) - exp({number}*ln(q))"),
            format!("q^({number})"),
            format!("(2*q)^({number}/3) - (3*q)^({number}/7)"),
            format!("q^(1/{number}) + q^(1/2147483647) + q^(1/2147483629) - 1"),
            format!("1/(q^(1/{number}) + q^(1/2147483647) + q^(1/2147483629) - q)"),
            format!("tan(pi*{number}/5) + ln({number}^2*q)"),
        ] {
            let mut dag = Dag::new();
            let root = formula(&mut dag, &of);
            let _ = decide_zero(&mut dag, root);
            let _ = normalise(&mut dag, root);
            let _ = divide_exactly(&mut dag, root, root);
        }
    }
}
