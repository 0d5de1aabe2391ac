//! What random systems are made of: fields, switching functions, interfaces, events.

use crate::plant::Factor::{State, Wave};
use crate::plant::{Event, Factor, Interface, Jump, Plant, Region, Role, Sum};
use dmm_problems::random::Random;

pub(crate) fn of_states(states: usize) -> Plant {
    Plant {
        states,
        ..Plant::default()
    }
}

/// A x + b, and forces that swing.
pub(crate) fn affine_field(plant: &mut Plant, random: &mut Random, size: f64) -> Vec<Sum> {
    let states = plant.states;
    let mut field = vec![Sum::new(); states];
    for (i, own) in field.iter_mut().enumerate() {
        own.push(plant.term(-0.8, 0.2, &[State(i)]));
        own.push(plant.term(-size, size, &[]));
        for j in 0..states {
            let is_near = j + 1 == i || i + 1 == j || i + j + 1 == states;
            if j != i && (states < 4 || is_near) {
                own.push(plant.term(-1.2, 1.2, &[State(j)]));
            }
        }
    }
    if random.once_in(2) {
        let swings = wave(plant, random, 2.0 * size);
        field[random.up_to(states)].push(swings);
    }
    field
}

/// The same with products of states.
pub(crate) fn quadratic_field(plant: &mut Plant, random: &mut Random) -> Vec<Sum> {
    let states = plant.states;
    let mut field = affine_field(plant, random, 0.6);
    for own in &mut field {
        let [i, j] = [0; 2].map(|_| random.up_to(states));
        own.push(plant.term(-0.5, 0.5, &[State(i), State(j)]));
    }
    field
}

/// a xₖ + b xⱼ + c, which may swing
pub(crate) fn plane(plant: &mut Plant, random: &mut Random, k: usize) -> Sum {
    let mut g = vec![
        plant.term(0.7, 1.3, &[State(k)]),
        plant.term(-0.4, 0.4, &[]),
    ];
    let other = random.up_to(plant.states);
    if other != k {
        g.push(plant.term(-0.8, 0.8, &[State(other)]));
    }
    if random.once_in(4) {
        let swings = wave(plant, random, 0.4);
        g.push(swings);
    }
    g
}

/// An ellipse, a hyperbola or a parabola.
pub(crate) fn curve(plant: &mut Plant, random: &mut Random, k: usize) -> Sum {
    let other = (k + 1) % plant.states;
    let mut g = vec![
        plant.term(0.6, 1.4, &[State(k), State(k)]),
        plant.term(-1.5, -0.3, &[]),
    ];
    match random.up_to(3) {
        0 => g.push(plant.term(0.6, 1.4, &[State(other), State(other)])),
        1 => {
            g.push(plant.term(-1.0, 1.0, &[State(k), State(other)]));
            g.push(plant.term(-0.8, 0.8, &[State(other), State(other)]));
        }
        _ => g.push(plant.term(-1.0, 1.0, &[State(other)])),
    }
    g
}

/// c sin(w t)
pub(crate) fn wave(plant: &mut Plant, random: &mut Random, size: f64) -> crate::plant::Term {
    let fastest = random.between(1.0, 4.0);
    let rate = plant.coefficient(0.5, fastest);
    plant.term(-size, size, &[Wave(rate)])
}

/// The strength of a relay: towards its interface, or either way.
pub(crate) fn relay_strength(
    plant: &mut Plant,
    random: &mut Random,
    factors: &[Factor],
) -> crate::plant::Term {
    if random.once_in(4) {
        plant.term(-2.0, 2.0, factors)
    } else {
        plant.term(-2.5, -0.3, factors)
    }
}

pub(crate) fn everywhere(plant: &mut Plant, field: Vec<Sum>) {
    plant.regions.push(Region {
        pattern: Vec::new(),
        field,
    });
}

pub(crate) fn add_region(plant: &mut Plant, sides: &[Option<bool>], field: Vec<Sum>) {
    plant.regions.push(Region {
        pattern: sides.to_vec(),
        field,
    });
}

pub(crate) fn add_interface(plant: &mut Plant, g: Sum, role: Role) -> usize {
    plant.interfaces.push(Interface {
        g,
        slides: false,
        role,
        switched: Vec::new(),
    });
    plant.interfaces.len() - 1
}

pub(crate) fn add_border(plant: &mut Plant, g: Sum, slides: bool) {
    let border = add_interface(plant, g, Role::Border);
    plant.interfaces[border].slides = slides;
}

pub(crate) fn add_switch(plant: &mut Plant, g: Sum, slides: bool, switched: Vec<Sum>) {
    plant.interfaces.push(Interface {
        g,
        slides,
        role: Role::Switch,
        switched,
    });
}

/// An event where g falls, or rises, or both.
pub(crate) fn add_event(
    plant: &mut Plant,
    interface: usize,
    jump: Jump,
    random: &mut Random,
    may_depend: bool,
) {
    let (falls, rises) = match random.up_to(5) {
        0 => (true, true),
        1 if may_depend => (false, true),
        _ => (true, false),
    };
    let only_if = match random.up_to(4) {
        0 if may_depend => Some(true),
        1 if may_depend => Some(false),
        _ => None,
    };
    plant.events.push(Event {
        interface,
        falls,
        rises,
        only_if,
        jump,
    });
}
