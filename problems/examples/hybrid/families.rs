//! The families of systems: each draws structures, and a structure has coefficients to draw.

use crate::parts::{
    add_border, add_event, add_interface, add_region, add_switch, affine_field, curve, everywhere,
    of_states, plane, quadratic_field, relay_strength, wave,
};
use crate::plant::Factor::{Discrete, State, Weakening};
use crate::plant::{Jump, Plant, Role, Sum};
use dmm_problems::random::Random;

/// A family.
pub(crate) struct Family {
    pub(crate) name: &'static str,
    pub(crate) draw: fn(&mut Random) -> Plant,
}

/// All of them.
pub(crate) const FAMILIES: [Family; 9] = [
    family("relays", relays),
    family("curved relays", curved_relays),
    family("two regions", two_regions),
    family("curved regions", curved_regions),
    family("four regions", four_regions),
    family("three regions", three_regions),
    family("friction", friction),
    family("impacts", impacts),
    family("all at once", all_at_once),
];

const fn family(name: &'static str, draw: fn(&mut Random) -> Plant) -> Family {
    Family { name, draw }
}

/// Relays: an affine field with terms that change their signs at affine functions.
fn relays(random: &mut Random) -> Plant {
    let mut plant = of_states(2 + random.up_to(5));
    let switches = 1 + random.up_to(plant.states.min(4));
    let field = affine_field(&mut plant, random, 1.2);
    everywhere(&mut plant, field);
    for k in 0..switches {
        let g = vec![
            plant.term(0.7, 1.3, &[State(k)]),
            plant.term(-0.5, 0.5, &[]),
        ];
        let mut switched = vec![Sum::new(); plant.states];
        switched[k].push(relay_strength(&mut plant, random, &[]));
        let mut g = g;
        if switches <= 3 {
            // what one relay switches is seen by another one
            let other = random.up_to(switches);
            if other != k {
                switched[other].push(plant.term(-1.0, 1.0, &[]));
            }
            let seen = random.up_to(plant.states);
            if seen != k {
                g.push(plant.term(-0.6, 0.6, &[State(seen)]));
            }
        } else if plant.states > switches {
            let free = switches + random.up_to(plant.states - switches);
            g.push(plant.term(-0.6, 0.6, &[State(free)]));
        }
        let slides = !random.once_in(10);
        add_switch(&mut plant, g, slides, switched);
    }
    plant
}

/// Quadratic fields and switching functions.
fn curved_relays(random: &mut Random) -> Plant {
    let mut plant = of_states(2 + random.up_to(3));
    let switches = 1 + random.up_to(2);
    let field = quadratic_field(&mut plant, random);
    everywhere(&mut plant, field);
    for k in 0..switches {
        let g = curve(&mut plant, random, k);
        let mut switched = vec![Sum::new(); plant.states];
        for (i, own) in switched.iter_mut().enumerate() {
            if i == k || random.once_in(2) {
                own.push(plant.term(-1.5, 1.5, &[]));
            }
            if random.once_in(2) {
                // towards or away from the middle of the curve
                own.push(plant.term(-1.5, 0.5, &[State(i)]));
            }
        }
        let slides = !random.once_in(10);
        add_switch(&mut plant, g, slides, switched);
    }
    plant
}

/// Two affine fields on the sides of a plane, which may move.
fn two_regions(random: &mut Random) -> Plant {
    let mut plant = of_states(2 + random.up_to(5));
    let g = plane(&mut plant, random, 0);
    let slides = !random.once_in(10);
    add_border(&mut plant, g, slides);
    for above in [true, false] {
        let mut field = affine_field(&mut plant, random, 1.0);
        let towards = if above { [-1.5, 0.3] } else { [-0.3, 1.5] };
        field[0].push(plant.term(towards[0], towards[1], &[]));
        add_region(&mut plant, &[Some(above)], field);
    }
    plant
}

/// Two quadratic fields inside and outside of a curve.
fn curved_regions(random: &mut Random) -> Plant {
    let mut plant = of_states(2 + random.up_to(3));
    let g = curve(&mut plant, random, 0);
    let slides = !random.once_in(10);
    add_border(&mut plant, g, slides);
    for above in [true, false] {
        let mut field = quadratic_field(&mut plant, random);
        let towards = if above { [-1.5, 0.0] } else { [0.0, 1.5] };
        for (i, own) in field.iter_mut().enumerate().take(2) {
            own.push(plant.term(towards[0], towards[1], &[State(i)]));
        }
        add_region(&mut plant, &[Some(above)], field);
    }
    plant
}

/// Four affine fields around two planes.
fn four_regions(random: &mut Random) -> Plant {
    let mut plant = of_states(2 + random.up_to(3));
    for k in 0..2 {
        let g = plane(&mut plant, random, k);
        let slides = !random.once_in(10);
        add_border(&mut plant, g, slides);
    }
    for sides in [[true, true], [true, false], [false, true], [false, false]] {
        let field = affine_field(&mut plant, random, 1.5);
        add_region(&mut plant, &sides.map(Some), field);
    }
    plant
}

/// Three fields, two of which meet behind a plane.
fn three_regions(random: &mut Random) -> Plant {
    let mut plant = of_states(2 + random.up_to(4));
    for k in 0..2 {
        let g = plane(&mut plant, random, k);
        add_border(&mut plant, g, true);
    }
    let first = random.up_to(2);
    let whole = random.once_in(2);
    for (side, other) in [(whole, None), (!whole, Some(true)), (!whole, Some(false))] {
        let mut field = affine_field(&mut plant, random, 1.0);
        let mut sides = [None; 2];
        (sides[first], sides[1 - first]) = (Some(side), other);
        for (k, side) in sides.iter().enumerate() {
            if let Some(above) = side {
                let towards = if *above { [-1.5, 0.5] } else { [-0.5, 1.5] };
                field[k].push(plant.term(towards[0], towards[1], &[]));
            }
        }
        add_region(&mut plant, &sides, field);
    }
    plant
}

/// One to three masses in a row on a belt, with friction that may become weaker with the speed, springs
/// and a force that swings.
fn friction(random: &mut Random) -> Plant {
    let masses = 1 + random.up_to(3);
    let mut plant = of_states(2 * masses);
    let mut field = vec![Sum::new(); plant.states];
    let (weakens, damped) = (random.once_in(2), random.once_in(2));
    let spring = plant.coefficient(0.4, 2.0);
    for k in 0..masses {
        let (x, v) = (2 * k, 2 * k + 1);
        field[x].push(plant.term(1.0, 1.0, &[State(v)]));
        field[v].push(plant.term(-2.0, -0.5, &[State(x)]));
        if damped {
            field[v].push(plant.term(-0.2, 0.1, &[State(v)]));
        }
        if k == 0 || random.once_in(2) {
            let swings = wave(&mut plant, random, 1.5);
            field[v].push(swings);
        }
        if k > 0 {
            // a spring to the one before: k (x₋ − x) on this one and the opposite on that one
            let minus = plant.coefficient(-1.0, -0.4);
            for (on, to, sign) in [(v, x - 2, spring), (v, x, minus)] {
                field[on].push(crate::plant::Term {
                    coefficient: sign,
                    factors: vec![State(to)],
                });
            }
            field[v - 2].push(plant.term(0.3, 1.0, &[State(x)]));
        }
    }
    everywhere(&mut plant, field);
    for k in 0..masses {
        let v = 2 * k + 1;
        let speed = plant.coefficient(-0.4, 0.4);
        let one = plant.coefficient(1.0, 1.0);
        let mut g = vec![crate::plant::Term {
            coefficient: one,
            factors: vec![State(v)],
        }];
        g.push(crate::plant::Term {
            coefficient: speed,
            factors: Vec::new(),
        });
        if random.once_in(4) {
            // a belt whose speed changes
            let swings = wave(&mut plant, random, 0.3);
            g.push(swings);
        }
        let mut switched = vec![Sum::new(); plant.states];
        switched[v].push(plant.term(-0.8, -0.2, &[]));
        if weakens {
            let (strength, center) = (plant.coefficient(0.5, 4.0), plant.coefficient(-0.3, 0.3));
            let weakening = [Weakening(v, strength, center)];
            switched[v].push(plant.term(-0.6, -0.1, &weakening));
        }
        add_switch(&mut plant, g, true, switched);
    }
    plant
}

/// Bodies that fall, are thrown back by floors, and by what they count.
fn impacts(random: &mut Random) -> Plant {
    let bodies = 1 + random.up_to(3);
    let mut plant = of_states(2 * bodies);
    let mut field = vec![Sum::new(); plant.states];
    let counts = random.once_in(2);
    for k in 0..bodies {
        let (x, v) = (2 * k, 2 * k + 1);
        field[x].push(plant.term(1.0, 1.0, &[State(v)]));
        field[v].push(plant.term(-3.0, -1.0, &[]));
        field[v].push(plant.term(-1.0, 0.2, &[State(x)]));
        if random.once_in(2) {
            field[v].push(plant.term(-0.2, 0.2, &[State(v)]));
        }
        if k > 0 {
            field[v].push(plant.term(-0.4, 0.4, &[State(x - 2)]));
        }
        if random.once_in(3) {
            field[v].push(plant.term(-0.05, 0.05, &[State(x), State(v)]));
        }
        if counts {
            field[v].push(plant.term(-0.8, 0.8, &[Discrete]));
        }
    }
    everywhere(&mut plant, field);
    for k in 0..bodies {
        let (x, v) = (2 * k, 2 * k + 1);
        let mut g = vec![plant.term(1.0, 1.0, &[State(x)]), plant.term(0.2, 1.0, &[])];
        if random.once_in(3) {
            let swings = wave(&mut plant, random, 0.2);
            g.push(swings);
        }
        let interface = add_interface(&mut plant, g, Role::Events);
        let mut back = vec![plant.term(-0.95, -0.5, &[State(v)])];
        if random.once_in(2) {
            back.push(plant.term(0.05, 0.4, &[]));
        }
        let mut sets = vec![(v, back)];
        if k > 0 && random.once_in(2) {
            let other = v - 2;
            let push = vec![
                plant.term(0.8, 1.0, &[State(other)]),
                plant.term(-0.3, 0.3, &[State(v)]),
            ];
            sets.push((other, push));
        }
        let jump = Jump {
            sets,
            flips: counts && random.once_in(2),
        };
        add_event(&mut plant, interface, jump, random, counts);
    }
    if bodies < 3 && random.once_in(2) {
        let jump = Jump {
            sets: vec![(
                1,
                vec![plant.term(0.6, 1.0, &[State(1)]), plant.term(0.0, 1.0, &[])],
            )],
            flips: counts,
        };
        let period = plant.coefficient(0.7, 2.5);
        plant.clock = Some((period, jump));
    }
    plant
}

/// A border, a relay and a jump, and a discrete state that some of the field is multiplied by.
fn all_at_once(random: &mut Random) -> Plant {
    let mut plant = of_states(3 + random.up_to(3));
    let g = plane(&mut plant, random, 0);
    add_border(&mut plant, g, true);
    for above in [true, false] {
        let mut field = affine_field(&mut plant, random, 1.0);
        let towards = if above { [-1.5, 0.5] } else { [-0.5, 1.5] };
        field[0].push(plant.term(towards[0], towards[1], &[]));
        field[2].push(plant.term(-1.0, 1.0, &[Discrete]));
        add_region(&mut plant, &[Some(above)], field);
    }
    let g = vec![
        plant.term(0.7, 1.3, &[State(1)]),
        plant.term(-0.5, 0.5, &[]),
        plant.term(-0.4, 0.4, &[State(2)]),
    ];
    let mut switched = vec![Sum::new(); plant.states];
    switched[1].push(relay_strength(&mut plant, random, &[]));
    if random.once_in(2) {
        switched[0].push(plant.term(-0.6, 0.6, &[]));
    }
    add_switch(&mut plant, g, true, switched);
    let g = vec![
        plant.term(0.7, 1.3, &[State(2)]),
        plant.term(-0.8, 0.8, &[]),
    ];
    let interface = add_interface(&mut plant, g, Role::Events);
    let target = if random.once_in(2) {
        vec![
            plant.term(-0.9, 0.9, &[State(2)]),
            plant.term(-0.3, 0.3, &[]),
        ]
    } else {
        vec![plant.term(-1.0, 1.0, &[])]
    };
    let mut sets = vec![(2, target)];
    let onto = random.up_to(3);
    if onto == 0 {
        // onto the switch: x₁ from g₁ = a x₁ + b + c x₂ = 0 is not a sum; a push along it instead
        sets.push((0, vec![plant.term(-1.0, 1.0, &[State(0)])]));
    } else if onto == 1 {
        sets.push((
            1,
            vec![
                plant.term(-1.0, 1.0, &[]),
                plant.term(0.2, 0.8, &[State(1)]),
            ],
        ));
    }
    let jump = Jump { sets, flips: true };
    add_event(&mut plant, interface, jump, random, true);
    if random.once_in(2) {
        let period = plant.coefficient(0.9, 3.0);
        let sets = vec![(0, vec![plant.term(-1.0, 1.0, &[State(0)])])];
        plant.clock = Some((period, Jump { sets, flips: false }));
    }
    plant
}
