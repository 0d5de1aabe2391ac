//! Arithmetic modulo a prime, and the values of normal forms at points with coordinates there.
//!
//! An identity between expressions that are rational in their atoms holds modulo a prime at
//! every point at which the relations between the atoms hold: variables, exponentials, phases
//! and logarithms take any values, a root takes a value whose power is its base. Both primes
//! are 5 modulo 8, so that i = √−1 is there and square roots are easy, and p − 1 has no factor
//! 3, 5, 7, 11 or 13, so that the other roots are unique.

use num_bigint::BigInt;
use num_traits::{One, Signed, ToPrimitive, Zero};

use crate::algebra::Rational;
use crate::algebra::normal_form::terms::{Atom, Exponent, Ratio, Term, Terms};

/// The prime of the eliminations: products of two residues leave four bits.
pub(super) const NARROW: Field = Field { p: 0x3fff_ff95 };

/// The prime of the coefficients, from which fractions of 30 bits can be told.
pub(super) const WIDE: Field = Field {
    p: 0x3fff_ffff_ffff_f9c5,
};

/// The integers modulo a prime.
#[derive(Clone, Copy, Debug)]
pub(super) struct Field {
    pub(super) p: u64,
}

/// Reproducible pseudo-random numbers (Steele, Lea & Flood 2014: SplitMix).
#[derive(Clone, Debug)]
pub(super) struct Random(pub(super) u64);

impl Random {
    pub(super) fn below(&mut self, bound: u64) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        (z ^ (z >> 31)) % bound
    }
}

impl Field {
    pub(super) fn add(self, a: u64, b: u64) -> u64 {
        (a + b) % self.p
    }

    pub(super) fn neg(self, a: u64) -> u64 {
        if a == 0 { 0 } else { self.p - a }
    }

    pub(super) fn mul(self, a: u64, b: u64) -> u64 {
        (u128::from(a) * u128::from(b) % u128::from(self.p)) as u64
    }

    pub(super) fn pow(self, base: u64, mut exponent: u64) -> u64 {
        let (mut result, mut square) = (1, base);
        while exponent > 0 {
            if exponent % 2 == 1 {
                result = self.mul(result, square);
            }
            square = self.mul(square, square);
            exponent /= 2;
        }
        result
    }

    /// 1/a; `None` for 0.
    pub(super) fn inverse(self, a: u64) -> Option<u64> {
        (a != 0).then(|| self.pow(a, self.p - 2))
    }

    fn signed_power(self, base: u64, exponent: i64) -> Option<u64> {
        let power = self.pow(base, exponent.unsigned_abs());
        if exponent < 0 {
            self.inverse(power)
        } else {
            Some(power)
        }
    }

    /// √−1: 2 is no square modulo a prime that is 5 modulo 8.
    fn imaginary_unit(self) -> u64 {
        self.pow(2, (self.p - 1) / 4)
    }

    /// A square root (Atkin); `None` of what is no square.
    fn square_root(self, a: u64) -> Option<u64> {
        let v = self.pow(self.add(a, a), (self.p - 5) / 8);
        let i = self.mul(self.mul(self.add(a, a), v), v);
        let root = self.mul(self.mul(a, v), self.add(i, self.p - 1));
        (self.mul(root, root) == a).then_some(root)
    }

    /// A root of this degree; `None` if there is none.
    fn root(self, a: u64, mut degree: u64) -> Option<u64> {
        let mut root = a;
        while degree.is_multiple_of(2) {
            root = self.square_root(root)?;
            degree /= 2;
        }
        // 1/degree modulo p − 1: the (p − 1)·k + 1 that `degree` divides
        let order = self.p - 1;
        let k = (0..degree).find(|k| {
            let value = u128::from(order) * u128::from(*k) + 1;
            value.is_multiple_of(u128::from(degree))
        })?;
        let exponent = (u128::from(order) * u128::from(k) + 1) / u128::from(degree);
        Some(self.pow(root, (exponent % u128::from(order)) as u64))
    }

    pub(super) fn rational(self, value: &Rational) -> Option<u64> {
        let residue = |value: &BigInt| {
            let p = BigInt::from(self.p);
            (((value % &p) + &p) % &p).to_u64()
        };
        let below = self.inverse(residue(value.denom())?)?;
        Some(self.mul(residue(value.numer())?, below))
    }

    /// The fraction of the smallest numbers with this residue; `None` if none has numbers of
    /// half the digits of p (Wang, Guy & Davenport 1982).
    pub(super) fn fraction(self, residue: u64) -> Option<Rational> {
        let bound = (self.p / 2).isqrt();
        let (mut r, mut t) = ((i128::from(self.p), i128::from(residue)), (0_i128, 1_i128));
        while r.1 > i128::from(bound) {
            let quotient = r.0 / r.1;
            r = (r.1, r.0 - quotient * r.1);
            t = (t.1, t.0 - quotient * t.1);
        }
        if t.1 == 0 || t.1.unsigned_abs() > u128::from(bound) {
            return None;
        }
        Some(Rational::new(r.1.into(), t.1.into()))
    }
}

/// The values of forms at a point.
pub(super) struct Point<'t> {
    field: Field,
    terms: &'t Terms,
    /// The root of each atom from which its powers are made, and of which degree it is.
    values: Vec<(u64, i64)>,
}

impl<'t> Point<'t> {
    /// A random point; `fixed` gives the variables that have a value already. `None` if the
    /// roots do not exist there, or a denominator vanishes.
    pub(super) fn random(
        field: Field,
        terms: &'t Terms,
        granularity: &[i64],
        random: &mut Random,
        fixed: impl Fn(&Atom) -> Option<u64>,
    ) -> Option<Self> {
        let mut point = Self {
            field,
            terms,
            values: Vec::with_capacity(terms.atoms.len()),
        };
        for (atom, &degree) in terms.atoms.iter().zip(granularity) {
            let value = match (atom, fixed(atom)) {
                (Atom::Root(base), _) => {
                    let base = point.ratio(base)?;
                    field.root(base, degree.unsigned_abs())?
                }
                (_, Some(value)) => field.root(value, degree.unsigned_abs())?,
                (_, None) => 1 + random.below(field.p - 1),
            };
            point.values.push((value, degree));
        }
        Some(point)
    }

    pub(super) fn ratio(&self, ratio: &Ratio) -> Option<u64> {
        let mut value = self.sum(&ratio.numerator)?;
        for (factor, multiplicity) in &ratio.denominator {
            let factor = self.sum(factor)?;
            let power = self.field.pow(factor, u64::from(*multiplicity));
            value = self.field.mul(value, self.field.inverse(power)?);
        }
        Some(value)
    }

    fn sum(&self, terms: &[Term]) -> Option<u64> {
        let mut sum = 0;
        for term in terms {
            sum = self.field.add(sum, self.term(term)?);
        }
        Some(sum)
    }

    fn term(&self, term: &Term) -> Option<u64> {
        let field = self.field;
        let imaginary = field.rational(&term.imaginary)?;
        let mut value = field.add(
            field.rational(&term.real)?,
            field.mul(imaginary, field.imaginary_unit()),
        );
        for &(atom, (numerator, denominator)) in &term.powers {
            let &(root, degree) = self.values.get(atom)?;
            let exponent = numerator.checked_mul(degree / denominator)?;
            value = field.mul(value, field.signed_power(root, exponent)?);
        }
        Some(value)
    }

    /// The values of all forms.
    pub(super) fn forms(&self) -> Option<Vec<u64>> {
        let forms = self.terms.forms.iter().map(|form| self.ratio(form));
        forms.collect()
    }
}

/// The common denominator of the exponents of each atom; `None` if one is too large.
pub(super) fn granularity(terms: &Terms) -> Option<Vec<i64>> {
    let mut degrees = vec![1_i64; terms.atoms.len()];
    let bases = terms.atoms.iter().filter_map(|atom| match atom {
        Atom::Root(base) => Some(base),
        _ => None,
    });
    for ratio in terms.forms.iter().chain(bases) {
        let factors = ratio.denominator.iter().map(|(factor, _)| factor);
        for sum in factors.chain([&ratio.numerator]) {
            for &(atom, (_, denominator)) in sum.iter().flat_map(|term| &term.powers) {
                if let Some(degree) = degrees.get_mut(atom) {
                    let common = num_integer::gcd(*degree, denominator);
                    *degree = (*degree / common).checked_mul(denominator)?;
                }
            }
        }
    }
    Some(degrees)
}

/// Whether a term has an atom to this power.
pub(super) fn exponent_of(term: &Term, atom: usize) -> Exponent {
    let power = term.powers.iter().find(|(index, _)| *index == atom);
    power.map_or((0, 1), |&(_, exponent)| exponent)
}

/// lcm of the denominators over gcd of the numerators: what makes the numbers coprime integers.
pub(super) fn to_coprime_integers<'n>(numbers: impl Iterator<Item = &'n Rational>) -> Rational {
    let mut above = BigInt::one();
    let mut below = BigInt::zero();
    for number in numbers {
        above = num_integer::lcm(above, number.denom().clone());
        below = num_integer::gcd(below, number.numer().abs());
    }
    if below.is_zero() {
        return Rational::one();
    }
    Rational::new(above, below)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn roots_are_roots() {
        for field in [NARROW, WIDE] {
            assert_eq!(field.pow(3, field.p - 1), 1);
            let i = field.imaginary_unit();
            assert_eq!(field.mul(i, i), field.p - 1);
            for (base, degree) in [(4, 2), (16, 4), (81, 4), (7, 3), (2, 5), (9, 6)] {
                let root = field.root(base, degree).expect("a root");
                assert_eq!(field.pow(root, degree), base, "{base} {degree}");
            }
            // 2 is not a square
            assert_eq!(field.root(2, 2), None);
        }
    }

    #[test]
    fn fractions_are_told_from_their_residues() {
        for (n, d) in [(0, 1), (1, 3), (-22, 7), (1_000_000, 999_983)] {
            let fraction = Rational::new(n.into(), d.into());
            let residue = WIDE.rational(&fraction).expect("a residue");
            assert_eq!(WIDE.fraction(residue), Some(fraction));
        }
    }

    #[test]
    fn numbers_become_coprime() {
        let numbers = [(2, 3), (4, 5)].map(|(n, d): (i64, i64)| Rational::new(n.into(), d.into()));
        let factor = to_coprime_integers(numbers.iter());
        assert_eq!(factor, Rational::new(15.into(), 2.into()));
    }
}
