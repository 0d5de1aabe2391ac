//! Token trees as data: what mutations work on, and the minimiser.

use std::fmt::{self, Display, Formatter};

use proc_macro2::{Delimiter, Spacing, TokenStream, TokenTree};

/// A token, or a group of them.
#[derive(Clone, Debug)]
pub(crate) enum Tree {
    /// One token. It is written without a space behind it if it is `joint`.
    Leaf {
        /// The token.
        text: String,
        /// Whether it makes one sign with the next, as in `..`.
        joint: bool,
    },
    /// Trees between `(`, `[` or `{` and its counterpart.
    Group(char, Vec<Tree>),
}

impl Tree {
    /// The token `text`.
    pub(crate) fn leaf(text: &str) -> Self {
        Self::Leaf {
            text: text.to_owned(),
            joint: false,
        }
    }

    /// Whether it is the token `expected`.
    pub(crate) fn is(&self, expected: &str) -> bool {
        matches!(self, Self::Leaf { text, .. } if text == expected)
    }
}

/// The trees of `text`, if it is made of tokens.
pub(crate) fn read(text: &str) -> Option<Vec<Tree>> {
    text.parse().ok().map(trees)
}

fn trees(tokens: TokenStream) -> Vec<Tree> {
    tokens
        .into_iter()
        .filter_map(|token| match token {
            TokenTree::Group(group) => {
                let open = match group.delimiter() {
                    Delimiter::Parenthesis => '(',
                    Delimiter::Bracket => '[',
                    Delimiter::Brace => '{',
                    Delimiter::None => return None,
                };
                Some(Tree::Group(open, trees(group.stream())))
            }
            TokenTree::Punct(punct) => Some(Tree::Leaf {
                text: punct.to_string(),
                joint: punct.spacing() == Spacing::Joint,
            }),
            other => Some(Tree::leaf(&other.to_string())),
        })
        .collect()
}

/// Trees as text.
pub(crate) fn text(trees: &[Tree]) -> String {
    trees.iter().map(Tree::to_string).collect()
}

impl Display for Tree {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Leaf { text, joint } => {
                f.write_str(text)?;
                match (*joint, text.as_str()) {
                    (true, _) => Ok(()),
                    (false, ";") => f.write_str("\n"),
                    (false, _) => f.write_str(" "),
                }
            }
            Self::Group(open, trees) => {
                let (before, close) = match open {
                    '(' => ("", ") "),
                    '[' => ("", "] "),
                    _ => ("\n", "}\n"),
                };
                write!(f, "{open}{before}")?;
                trees.iter().try_for_each(|tree| tree.fmt(f))?;
                f.write_str(close)
            }
        }
    }
}

/// Every sequence of trees in `trees`, by the indices of the groups that lead to it.
pub(crate) fn sequences(trees: &[Tree]) -> Vec<Vec<usize>> {
    let mut found = vec![Vec::new()];
    let mut next = 0;
    while let Some(path) = found.get(next).cloned() {
        for (index, tree) in at(trees, &path).iter().enumerate() {
            if matches!(tree, Tree::Group(..)) {
                let mut deeper = path.clone();
                deeper.push(index);
                found.push(deeper);
            }
        }
        next += 1;
    }
    found
}

/// The sequence that `path` leads to.
pub(crate) fn at<'a>(trees: &'a [Tree], path: &[usize]) -> &'a [Tree] {
    let mut here = trees;
    for &index in path {
        match here.get(index) {
            Some(Tree::Group(_, inner)) => here = inner,
            _ => return &[],
        }
    }
    here
}

/// The sequence that `path` leads to, to be changed; `trees` itself if it leads nowhere.
pub(crate) fn at_mut<'a>(trees: &'a mut Vec<Tree>, path: &[usize]) -> &'a mut Vec<Tree> {
    match path.split_first() {
        Some((&index, rest)) if matches!(trees.get(index), Some(Tree::Group(..))) => {
            let Some(Tree::Group(_, inner)) = trees.get_mut(index) else {
                unreachable!("matched above");
            };
            at_mut(inner, rest)
        }
        _ => trees,
    }
}

/// The items of a body: up to a `;`, or up to a block.
pub(crate) fn items(body: &[Tree]) -> Vec<Vec<Tree>> {
    let mut items = vec![Vec::new()];
    for tree in body {
        let ends = tree.is(";") || matches!(tree, Tree::Group('{', _));
        if let Some(last) = items.last_mut() {
            last.push(tree.clone());
        }
        if ends {
            items.push(Vec::new());
        }
    }
    items.retain(|item| !item.is_empty());
    items
}
