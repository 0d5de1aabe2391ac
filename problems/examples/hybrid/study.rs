//! The campaign: run after run, the families side by side.

use std::collections::HashMap;

use dmm_runtime::Model;

use crate::families::FAMILIES;
use crate::judge::Case;
use crate::motion::Systems;
use crate::plant::{MOST, Plant, State};
use crate::run::Scheme;
use crate::tally::Tally;
use crate::text::declaration;
use dmm_problems::random::Random;
use dmm_problems::threads::side_by_side;

/// So many structures of a family.
const STRUCTURES: usize = 16;

/// A campaign.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Campaign {
    pub(crate) runs: usize,
    pub(crate) seed: u64,
    /// The number of the only run.
    pub(crate) only: Option<usize>,
}

impl Default for Campaign {
    fn default() -> Self {
        Self {
            runs: 100_000,
            seed: 1,
            only: None,
        }
    }
}

/// A structure with its model.
struct Structure {
    plant: Plant,
    text: String,
    model: Model,
}

impl Campaign {
    /// Makes it, and prints the table.
    pub(crate) fn make(&self) -> Tally {
        println!("{}", Tally::head());
        let mut total = Tally::default();
        let run = |family| (family, self.family(family));
        side_by_side(0..FAMILIES.len(), run, |(family, tallies)| {
            for (scheme, tally) in Scheme::ALL.iter().zip(&tallies) {
                println!("{}", tally.row(FAMILIES[family].name, scheme.name()));
                total.add(tally);
            }
        });
        println!("{}\n{}", total.row("all", "all"), total.kinds());
        total
    }

    /// The runs of a family, by scheme.
    fn family(&self, family: usize) -> Vec<Tally> {
        let mut tallies = vec![Tally::default(); Scheme::ALL.len()];
        let mut known: HashMap<usize, Option<Structure>> = HashMap::new();
        let all = self.only.map_or(0..self.runs, |only| only..only + 1);
        for index in all.filter(|index| index % FAMILIES.len() == family) {
            let number = index / FAMILIES.len();
            let place = number % STRUCTURES;
            let structure = known.entry(place);
            let structure = structure.or_insert_with(|| self.structure((family, place)));
            let Some(structure) = structure else { continue };
            self.run(index, structure, &mut tallies, number);
        }
        tallies
    }

    /// A structure of a family; nothing if it does not compile.
    fn structure(&self, (family, number): (usize, usize)) -> Option<Structure> {
        let family = &FAMILIES[family];
        let plant = (family.draw)(&mut Random::new(family.name, self.seed, number));
        let text = declaration(&plant);
        match Model::compile(&text) {
            Ok(model) => Some(Structure { plant, text, model }),
            Err(error) => {
                println!("{} {number} does not compile: {error}\n{text}", family.name);
                None
            }
        }
    }

    /// A run of a structure by the schemes whose turn it is.
    fn run(&self, index: usize, structure: &Structure, tallies: &mut [Tally], number: usize) {
        let mut random = Random::new("run", self.seed, index);
        let plant = &structure.plant;
        let c = plant.draw(&mut random);
        let mut model = structure.model.clone();
        for (k, &value) in c.iter().enumerate() {
            if let Err(error) = model.set(&format!("c{k}"), value) {
                println!("{error}");
            }
        }
        let systems = Systems { plant, c: &c };
        let mut case = Case {
            x0: initial(&systems, &mut random),
            t_end: random.between(1.0, 6.0),
            systems,
            model: &model,
        };
        let solution = case.solution();
        for (scheme, tally) in Scheme::ALL.into_iter().zip(tallies) {
            if self.only.is_none() && !(number + number / STRUCTURES).is_multiple_of(scheme.every())
            {
                continue;
            }
            let outcome = case.judge(&solution, scheme);
            tally.count(outcome, &solution, || {
                format!(
                    "  run {index} of seed {} by {} from {:?} to {}, c = {c:?}\n{}",
                    self.seed,
                    scheme.name(),
                    &case.x0[..plant.states],
                    case.t_end,
                    structure.text
                )
            });
        }
    }
}

/// An initial state, now and then on an interface.
fn initial(systems: &Systems<'_>, random: &mut Random) -> State {
    let mut x = [0.0; MOST];
    for entry in x.iter_mut().take(systems.plant.states) {
        *entry = random.between(-1.2, 1.2);
    }
    if !random.once_in(6) {
        return x;
    }
    let interface = random.up_to(systems.plant.interfaces.len());
    let start = x;
    for _ in 0..30 {
        let (gradient, _) = systems.slopes(interface, 0.0, &x);
        let size: f64 = gradient.iter().map(|entry| entry * entry).sum();
        let factor = systems.g(interface, 0.0, &x) / size;
        for (entry, slope) in x.iter_mut().zip(gradient) {
            *entry -= factor * slope;
        }
    }
    let is_on = systems.g(interface, 0.0, &x).abs() < 1e-15 && x.iter().all(|one| one.abs() < 3.0);
    if is_on { x } else { start }
}
