//! Signs that Rust's tokens do not have, and what is written instead.

/// What is wrong with the text that begins with `rest`, of which Rust's tokens cannot be made.
pub(super) fn reason(rest: &str) -> String {
    let line = rest.lines().next().unwrap_or_default();
    match line.chars().next() {
        Some(')' | ']' | '}') => {
            return "a bracket is closed here that is not open, or was opened as another one"
                .into();
        }
        Some('(' | '[' | '{') => return "this bracket is not closed".into(),
        Some('"') => return "this text is not closed".into(),
        Some('/') => return "this comment is not closed".into(),
        _ => {}
    }
    let is_strange = |sign: &char| !sign.is_ascii() && !sign.is_alphanumeric();
    let mut signs = line.chars();
    let Some(sign) = signs.find(|sign| instead(*sign).is_some() || is_strange(sign)) else {
        return "this is not made of Rust's tokens".into();
    };
    match instead(sign) {
        Some(instead) => format!("`{sign}` is no sign of declarations: {instead}"),
        None => format!("`{sign}` is no sign of declarations"),
    }
}

fn instead(sign: char) -> Option<&'static str> {
    Some(match sign {
        '\'' | '′' | '″' => "a derivative is written `der(x) = …;`",
        '−' | '–' | '—' => "the minus sign is `-`",
        '·' | '×' | '⋅' | '∙' => "a product is written `a*b`",
        '÷' | '∕' | '⁄' => "a quotient is written `a/b`",
        '⁰' | '¹' | '²' | '³' | '⁴' | '⁵' | '⁶' | '⁷' | '⁸' | '⁹' | '⁻' => {
            "a power is written `x^2`"
        }
        '₀' | '₁' | '₂' | '₃' | '₄' | '₅' | '₆' | '₇' | '₈' | '₉' => {
            "a digit stands in a name, `x_0`, or is an index, `x[0]`"
        }
        '√' => "a root is written `sqrt(x)`",
        '∑' | 'Σ' => "a sum is written `sum(i in 0..n, term)`",
        '∂' | '∇' => "derivatives are derived: write `der(x) = …;`, or a `hamiltonian`",
        '≥' | '≤' => "a region is where an interface is `> 0` or `< 0`",
        '≠' | '≈' => "a definition has `=`",
        '∞' => "every quantity is a finite number",
        '°' => "angles are in radians: write `30*pi/180`",
        '“' | '”' | '„' | '‘' | '’' => "names stand without quotation marks",
        '\\' => "names are made of letters, digits and `_`",
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use crate::text::declarations;

    #[test]
    fn what_are_no_tokens_says_what_to_write() {
        for (items, place, message) in [
            (
                "x' = y; y' = -x;",
                "2:2",
                "a derivative is written `der(x) = …;`",
            ),
            ("x'' = -x;", "2:2", "`der(x) = …;`"),
            ("der(x) = x²;", "2:11", "`x^2`"),
            ("der(x) = −x;", "2:10", "the minus sign is `-`"),
            ("der(x) = 2·x;", "2:10", "`a*b`"),
            ("state x₀;", "2:8", "`x_0`"),
            ("der(x) = √x;", "2:10", "`sqrt(x)`"),
            ("region a where w ≥ 0 { }", "2:18", "`> 0` or `< 0`"),
            ("der(x) = sin(30°);", "2:16", "radians"),
            ("der(x) = (x;", "3:1", "closed"),
            ("param n = “a”;", "2:11", "quotation marks"),
            ("der(x) = ♠;", "2:10", "`♠` is no sign of declarations"),
        ] {
            let error = declarations(&format!("system S {{\n{items}\n}}")).expect_err(items);
            let text = error.to_string();
            assert!(text.starts_with(&format!("{place}: ")), "{items}: {text}");
            assert!(text.contains(message), "{items}: {text}");
        }
        let unclosed = declarations("system S { state x;").expect_err("a bracket");
        assert_eq!(unclosed.to_string(), "1:10: this bracket is not closed");
    }
}
