//! Coefficients times their scales: those of a whole pack side by side.

use std::array;

use proc_macro2::TokenStream;
use quote::quote;

use super::writer::{Writer, minus, product};
use crate::algebra::Id;
use crate::emit::rust::paths;
use crate::program::series::{Factor, LANES, PAIR, Scaled};

impl Writer<'_, '_> {
    /// Coefficients times their scales; those of a whole pack, where they follow on each other, side by side.
    pub(super) fn scaled_together(
        &mut self,
        scaled: &[(&Scaled, TokenStream)],
    ) -> Vec<TokenStream> {
        let mut values = Vec::new();
        while let [(first, scale), ..] = &scaled[values.len()..] {
            let rest = &scaled[values.len()..];
            let mut counts = [LANES, LANES - 1, PAIR].into_iter();
            let pack = counts.find_map(|count| match (count, rest.get(..count)?) {
                (PAIR, pair) => self.scaled_pack::<PAIR>(pair),
                (_, pack) => self.scaled_pack::<LANES>(pack),
            });
            match pack {
                Some(pack) => values.extend(pack),
                None => values.push(self.scaled(first, scale.clone())),
            }
        }
        values
    }

    /// The same of a pack, if it is one.
    fn scaled_pack<const L: usize>(
        &mut self,
        scaled: &[(&Scaled, TokenStream)],
    ) -> Option<Vec<TokenStream>> {
        let (_, scale) = scaled.first()?;
        let text = scale.to_string();
        if scaled.iter().any(|(_, other)| other.to_string() != text) {
            return None;
        }
        let lanes: [&Scaled; L] = array::from_fn(|lane| scaled[lane % scaled.len()].0);
        let width = paths::count(L);
        let scale = quote!(dmm::series::Pack::<_, #width>::all(#scale));
        let (u, scale) = self.of_vector(lanes, scale)?;
        let value = product(&u, &scale);
        Some(self.elements(&value, scaled.len()))
    }

    /// The vector that some coefficients are multiples of, and the scale with their factors.
    fn of_vector<const L: usize>(
        &mut self,
        scaled: [&Scaled; L],
        scale: TokenStream,
    ) -> Option<(TokenStream, TokenStream)> {
        let each = |of: &dyn Fn(&Scaled) -> Option<Id>| -> Option<[Id; L]> {
            let ids: Option<Vec<Id>> = scaled.iter().map(|one| of(one)).collect();
            ids?.try_into().ok()
        };
        let nodes = each(&|one| match one {
            Scaled::Node(id) => Some(*id),
            _ => None,
        });
        if let Some(nodes) = nodes {
            if !nodes.iter().all(|&id| self.block.has_value(id)) {
                return None;
            }
            let values = nodes.map(|id| self.block.value(id).to_string());
            let name = self.vectors.get(values.as_slice())?;
            return Some((quote!(#name), scale));
        }
        let mut inner = Vec::new();
        for one in scaled {
            match one {
                Scaled::Multiple(_, of) => inner.push(&**of),
                _ => return None,
            }
        }
        let inner: [&Scaled; L] = inner.try_into().ok()?;
        let factors = each(&|one| match one {
            Scaled::Multiple(Factor::Node(c), _) => Some(*c),
            _ => None,
        });
        let all_minus = scaled
            .iter()
            .all(|one| matches!(one, Scaled::Multiple(Factor::Minus, _)));
        let scale = match factors {
            Some(factors) => {
                let c = self.fixed_values(factors);
                quote!(#c * #scale)
            }
            None if all_minus => minus(true, &scale),
            None => return None,
        };
        self.of_vector(inner, scale)
    }
}
