//! Fuzzing of everything that the macro does with what it is given.
//!
//! A case is a text of tokens, made from a seed and a number: a soup of tokens, deep nesting, a
//! system with random formulas, or a declaration of the corpus after a few mutations. [`check`]
//! takes it through the whole of [`dmm_compiler::compile`].

pub(crate) mod generate;
pub(crate) mod mutate;
pub(crate) mod random;
pub(crate) mod tree;
pub(crate) mod vocabulary;
pub(crate) mod watch;

use crate::corpus;
use mutate::Mutation;
use random::Random;
use tree::Tree;

pub(crate) use watch::check;

/// Macros run on a thread of rustc with 8 MiB of stack, of which rustc uses some itself; cases
/// have a quarter of that.
pub(crate) const STACK_SIZE: usize = 2 << 20;

/// A case to be compiled.
#[derive(Clone, Debug)]
pub(crate) struct Case {
    /// How it was made: an index in [`kinds`].
    pub(crate) kind: usize,
    /// The text between the braces of `pws!`.
    pub(crate) text: String,
}

/// How cases are made: the three generators, the declarations as they are, and the mutations.
pub(crate) fn kinds() -> Vec<&'static str> {
    let mut kinds = vec![
        "soup of tokens",
        "deep nesting",
        "random formulas",
        "the corpus as it is",
    ];
    kinds.extend(Mutation::ALL.map(|(_, name)| name));
    kinds
}

/// The declarations that are mutated.
pub(crate) struct Seeds(Vec<Vec<Tree>>);

impl Seeds {
    /// The corpus.
    pub(crate) fn load() -> Self {
        let mut samples = corpus::all_sound();
        samples.extend(corpus::wrong());
        samples.extend(corpus::open());
        let trees = samples
            .iter()
            .filter_map(|sample| tree::read(&sample.source));
        Self(trees.collect())
    }

    /// Case `index` of the run `seed`.
    pub(crate) fn case(&self, seed: u64, index: u64) -> Case {
        let random = &mut Random::of_case(seed, index);
        let (kind, text) = match random.below(20) {
            0..=3 => (0, generate::soup(random)),
            4 => (1, generate::nested(random)),
            5..=7 => (2, generate::system(random)),
            // one in many: these are the slowest, and known to compile
            8 if random.once_in(20) => (3, tree::text(self.seed(random))),
            _ => self.mutated(random),
        };
        Case { kind, text }
    }

    /// One of the declarations; a large one, which takes seconds, only once in a while.
    fn seed(&self, random: &mut Random) -> &[Tree] {
        let seed = &self.0[random.below(self.0.len())];
        if tree::text(seed).contains("n = 32") && !random.once_in(8) {
            return self.seed(random);
        }
        seed
    }

    /// A declaration after one to four mutations, named after the first.
    fn mutated(&self, random: &mut Random) -> (usize, String) {
        let mut trees = self.seed(random).to_vec();
        let count = 1 + random.below(2) * random.below(4);
        let mut first = None;
        for _ in 0..count {
            let kind = random.below(Mutation::ALL.len());
            let other = self.seed(random).to_vec();
            mutate::mutate(Mutation::ALL[kind].0, &mut trees, &other, random);
            first.get_or_insert(kind);
        }
        (4 + first.unwrap_or(0), tree::text(&trees))
    }
}
