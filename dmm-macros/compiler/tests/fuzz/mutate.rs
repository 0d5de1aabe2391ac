//! Mutations of real declarations.

use super::random::Random;
use super::tree::{self, Tree};
use super::vocabulary::{FORMULAS, LITERALS, SIGNS, WORDS};

/// The kinds of mutations.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Mutation {
    Delete,
    Duplicate,
    Swap,
    Replace,
    Insert,
    Number,
    Rename,
    Nest,
    Formula,
    DeleteItem,
    DuplicateItem,
    MoveItem,
    SpliceItem,
    SpliceHalves,
}

impl Mutation {
    /// Every kind, with its name in the table.
    pub(crate) const ALL: [(Self, &'static str); 14] = [
        (Self::Delete, "delete tokens"),
        (Self::Duplicate, "duplicate tokens"),
        (Self::Swap, "swap tokens"),
        (Self::Replace, "replace a token"),
        (Self::Insert, "insert a token"),
        (Self::Number, "change a number"),
        (Self::Rename, "rename"),
        (Self::Nest, "nest"),
        (Self::Formula, "put a hard formula in"),
        (Self::DeleteItem, "delete an item"),
        (Self::DuplicateItem, "duplicate an item"),
        (Self::MoveItem, "move or copy an item"),
        (Self::SpliceItem, "splice an item in"),
        (Self::SpliceHalves, "splice two declarations"),
    ];
}

/// `declaration` after one mutation; `other` gives what is spliced in.
pub(crate) fn mutate(
    mutation: Mutation,
    declaration: &mut Vec<Tree>,
    other: &[Tree],
    random: &mut Random,
) {
    match mutation {
        Mutation::Delete
        | Mutation::Duplicate
        | Mutation::Swap
        | Mutation::Replace
        | Mutation::Insert => tokens(mutation, declaration, other, random),
        Mutation::Number => change_leaf(declaration, random, is_number, &|random| {
            random.pick(LITERALS).to_owned()
        }),
        Mutation::Rename => rename(declaration, random),
        Mutation::Nest => nest(declaration, random),
        Mutation::Formula => put_formula(declaration, random),
        Mutation::DeleteItem
        | Mutation::DuplicateItem
        | Mutation::MoveItem
        | Mutation::SpliceItem
        | Mutation::SpliceHalves => items(mutation, declaration, other, random),
    }
}

/// A place in a sequence, the longer ones more often.
fn place(trees: &[Tree], random: &mut Random) -> (Vec<usize>, usize) {
    let sequences = tree::sequences(trees);
    let total: usize = sequences
        .iter()
        .map(|path| tree::at(trees, path).len())
        .sum();
    let mut number = random.below(total);
    for path in sequences {
        let length = tree::at(trees, &path).len();
        if number < length {
            return (path, number);
        }
        number -= length;
    }
    (Vec::new(), 0)
}

fn tokens(mutation: Mutation, trees: &mut Vec<Tree>, other: &[Tree], random: &mut Random) {
    let (path, index) = place(trees, random);
    let replacement = match random.below(4) {
        0 => Tree::leaf(random.pick(WORDS)),
        1 => Tree::leaf(random.pick(SIGNS)),
        2 => Tree::leaf(random.pick(LITERALS)),
        _ => {
            let (path, index) = place(other, random);
            match tree::at(other, &path).get(index) {
                Some(tree) => tree.clone(),
                None => return,
            }
        }
    };
    let sequence = tree::at_mut(trees, &path);
    let end = (index + 1 + random.below(3)).min(sequence.len());
    match mutation {
        _ if index >= sequence.len() => {}
        Mutation::Delete => drop(sequence.drain(index..end)),
        Mutation::Duplicate => {
            let copy = sequence[index..end].to_vec();
            sequence.splice(end..end, copy);
        }
        Mutation::Swap => {
            let with = random.below(sequence.len());
            sequence.swap(index, with);
        }
        Mutation::Replace => sequence[index] = replacement,
        _ => sequence.insert(index, replacement),
    }
}

fn is_number(text: &str) -> bool {
    text.starts_with(|first: char| first.is_ascii_digit())
}

fn is_word(text: &str) -> bool {
    text.starts_with(|first: char| first.is_alphabetic() || first == '_')
}

/// Replaces one of the leaves that `fits`.
fn change_leaf(
    trees: &mut Vec<Tree>,
    random: &mut Random,
    fits: fn(&str) -> bool,
    with: &dyn Fn(&mut Random) -> String,
) {
    let mut found = Vec::new();
    for path in tree::sequences(trees) {
        for (index, tree) in tree::at(trees, &path).iter().enumerate() {
            if matches!(tree, Tree::Leaf { text, .. } if fits(text)) {
                found.push((path.clone(), index));
            }
        }
    }
    if found.is_empty() {
        return;
    }
    let (path, index) = found.swap_remove(random.below(found.len()));
    let new = Tree::leaf(&with(random));
    if let Some(leaf) = tree::at_mut(trees, &path).get_mut(index) {
        *leaf = new;
    }
}

/// Another name, at one place or everywhere.
fn rename(trees: &mut Vec<Tree>, random: &mut Random) {
    let mut names: Vec<String> = Vec::new();
    for path in tree::sequences(trees) {
        for tree in tree::at(trees, &path) {
            if let Tree::Leaf { text, .. } = tree
                && is_word(text)
                && !names.contains(text)
            {
                names.push(text.clone());
            }
        }
    }
    let new = if random.once_in(2) && !names.is_empty() {
        names[random.below(names.len())].clone()
    } else {
        random.pick(WORDS).to_owned()
    };
    if random.once_in(2) || names.is_empty() {
        change_leaf(trees, random, is_word, &|_| new.clone());
        return;
    }
    let old = names.swap_remove(random.below(names.len()));
    everywhere(trees, &old, &new);
}

fn everywhere(trees: &mut [Tree], old: &str, new: &str) {
    for tree in trees {
        match tree {
            Tree::Group(_, inner) => everywhere(inner, old, new),
            Tree::Leaf { text, .. } if text == old => *text = new.to_owned(),
            Tree::Leaf { .. } => {}
        }
    }
}

/// Some tokens in delimiters, or a group without its own.
fn nest(trees: &mut Vec<Tree>, random: &mut Random) {
    let (path, index) = place(trees, random);
    let sequence = tree::at_mut(trees, &path);
    if index >= sequence.len() {
        return;
    }
    if let Tree::Group(_, inner) = &sequence[index]
        && random.once_in(2)
    {
        let inner = inner.clone();
        sequence.splice(index..=index, inner);
        return;
    }
    let end = (index + 1 + random.below(3)).min(sequence.len());
    let mut inner: Vec<Tree> = sequence[index..end].to_vec();
    let open = ['(', '[', '{'][random.below(3)];
    for _ in 0..1 << random.below(8) {
        inner = vec![Tree::Group(open, inner)];
    }
    sequence.splice(index..end, inner);
}

/// A hard formula for a name in a formula.
fn put_formula(trees: &mut Vec<Tree>, random: &mut Random) {
    let Some(formula) = tree::read(random.pick(FORMULAS)) else {
        return;
    };
    for _ in 0..20 {
        let (path, index) = place(trees, random);
        let sequence = tree::at_mut(trees, &path);
        let is_operand = index > 0
            && ["=", "+", "-", "*", "/"]
                .iter()
                .any(|sign| sequence[index - 1].is(sign))
            && matches!(&sequence[index], Tree::Leaf { text, .. } if is_word(text));
        if is_operand {
            sequence[index] = Tree::Group('(', formula);
            return;
        }
    }
}

/// The bodies `{ … }` of a declaration.
fn bodies(trees: &[Tree]) -> Vec<Vec<usize>> {
    let is_body = |path: &Vec<usize>| {
        path.split_last().is_some_and(|(&last, above)| {
            matches!(tree::at(trees, above).get(last), Some(Tree::Group('{', _)))
        })
    };
    tree::sequences(trees).into_iter().filter(is_body).collect()
}

fn items(mutation: Mutation, trees: &mut Vec<Tree>, other: &[Tree], random: &mut Random) {
    let here = bodies(trees);
    let there = bodies(other);
    if here.is_empty() || there.is_empty() {
        return;
    }
    let path = &here[random.below(here.len())];
    let mut own = tree::items(tree::at(trees, path));
    let foreign = tree::items(tree::at(other, &there[random.below(there.len())]));
    if own.is_empty() || foreign.is_empty() {
        return;
    }
    let index = random.below(own.len());
    match mutation {
        Mutation::DeleteItem => drop(own.remove(index)),
        Mutation::DuplicateItem => own.insert(random.below(own.len()), own[index].clone()),
        Mutation::MoveItem => {
            let item = own.remove(index);
            let to = &here[random.below(here.len())];
            if to == path {
                own.insert(random.below(own.len() + 1), item);
            } else {
                let target = tree::at_mut(trees, to);
                let at = random.below(target.len() + 1);
                target.splice(at..at, item);
                return;
            }
        }
        Mutation::SpliceItem => own.insert(index, foreign[random.below(foreign.len())].clone()),
        _ => {
            own.truncate(index);
            own.extend(foreign.into_iter().skip(index));
        }
    }
    *tree::at_mut(trees, path) = own.concat();
}
