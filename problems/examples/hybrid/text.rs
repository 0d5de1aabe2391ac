//! The declaration of a system.

use crate::plant::{Factor, Jump, Plant, Role, Sum};

/// The declaration; coefficient number k is the parameter `ck`.
pub(crate) fn declaration(plant: &Plant) -> String {
    let mut text = format!("system Plant {{\n    state x[{}];\n", plant.states);
    let names = (0..plant.ranges.len()).map(|k| format!("c{k} = 1"));
    text += &format!("    param {};\n", names.collect::<Vec<String>>().join(", "));
    if plant.has_discrete() {
        text += "    discrete u = 1;\n";
    }
    for (k, interface) in plant.interfaces.iter().enumerate() {
        let g = sum(&interface.g);
        let slides = interface.slides;
        text += &match interface.role {
            Role::Switch => {
                let slides = if slides { " sliding" } else { "" };
                format!("    let w{k} = if {g} > 0{slides} {{ 1 }} else {{ -1 }};\n")
            }
            _ => {
                let slides = if slides { ", sliding" } else { "" };
                format!("    interface g{k} = {g}{slides};\n")
            }
        };
    }
    for (number, region) in plant.regions.iter().enumerate() {
        let sides = region.pattern.iter().enumerate();
        let sides: Vec<String> = sides
            .filter_map(|(k, side)| Some(format!("g{k} {} 0", if (*side)? { ">" } else { "<" })))
            .collect();
        if !sides.is_empty() {
            text += &format!("    region r{number} where {} {{\n", sides.join(" and "));
        }
        for (i, own) in region.field.iter().enumerate() {
            text += &format!("    der(x[{i}]) = {}", sum(own));
            for (k, interface) in plant.interfaces.iter().enumerate() {
                let switched = interface.switched.get(i).filter(|sum| !sum.is_empty());
                if let Some(switched) = switched {
                    text += &format!(" + w{k}*({})", sum(switched));
                }
            }
            text += ";\n";
        }
        if !sides.is_empty() {
            text += "    }\n";
        }
    }
    for event in &plant.events {
        let direction = match (event.rises, event.falls) {
            (true, false) => " rising",
            (false, true) => " falling",
            _ => "",
        };
        let condition = match event.only_if {
            Some(true) => " where u > 0",
            Some(false) => " where u < 0",
            None => "",
        };
        let jump = jump(&event.jump);
        text += &format!("    on g{}{direction}{condition} {jump}", event.interface);
    }
    if let Some((period, own)) = &plant.clock {
        text += &format!("    every c{period} {}", jump(own));
    }
    text + "}\n"
}

fn jump(jump: &Jump) -> String {
    let sets = jump.sets.iter();
    let sets = sets.map(|(i, value)| format!("x[{i}] = {}; ", sum(value)));
    let flips = if jump.flips { "u = -u; " } else { "" };
    format!("{{ {}{flips}}}\n", sets.collect::<String>())
}

fn sum(sum: &Sum) -> String {
    if sum.is_empty() {
        return "0".to_owned();
    }
    let terms = sum.iter().map(|term| {
        let mut text = format!("c{}", term.coefficient);
        for factor in &term.factors {
            text += &match factor {
                Factor::State(i) => format!("*x[{i}]"),
                Factor::Wave(rate) => format!("*sin(c{rate}*t)"),
                Factor::Discrete => "*u".to_owned(),
                Factor::Weakening(i, strength, center) => {
                    format!("*(1/(1 + c{strength}*(x[{i}] - c{center})^2))")
                }
            };
        }
        text
    });
    terms.collect::<Vec<String>>().join(" + ")
}
