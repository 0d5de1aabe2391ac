use super::*;

#[test]
fn parentheses_only_where_they_matter() {
    let mut source = crate::algebra::Dag::new();
    let [a, b, c] = ["a", "b", "c"].map(|name| source.variable(&crate::algebra::Name::new(name)));
    let sum = source.add(a, b);
    let product = source.mul(sum, c);
    let difference = source.sub(a, sum);
    let difference = source.sub(difference, product);
    let mut lowered = Lowered::new(Vec::new());
    let root = lowered.lower(&source, difference);
    let known: BTreeMap<Id, TokenStream> = [("a", a), ("b", b), ("c", c)]
        .map(|(name, id)| {
            let ident = quote::format_ident!("{name}");
            (lowered.lower(&source, id), quote!(#ident))
        })
        .into();
    let order = lowered.order(&[root], |id| known.contains_key(&id));
    let names = Names::default();
    let mut block = Block::new(&lowered, quote!(S), names, &known, &order, &[root]);
    block.require(root);
    let value = block.value(root);
    let statements = block.statements();
    assert_eq!(
        quote!(#statements #value).to_string(),
        "let u1 = a + b ; a - u1 - c * u1"
    );
}

/// The code of `formula` in a, b, c and d where sums of products are fused.
fn fused(formula: impl FnOnce(&mut crate::algebra::Dag, [Id; 4]) -> Id) -> String {
    let mut source = crate::algebra::Dag::new();
    let variables =
        ["a", "b", "c", "d"].map(|name| source.variable(&crate::algebra::Name::new(name)));
    let root = formula(&mut source, variables);
    let mut lowered = Lowered::new(Vec::new());
    let root = lowered.lower(&source, root);
    let known: BTreeMap<Id, TokenStream> = ["a", "b", "c", "d"]
        .into_iter()
        .zip(variables)
        .map(|(name, id)| {
            let ident = quote::format_ident!("{name}");
            (lowered.lower(&source, id), quote!(#ident))
        })
        .collect();
    let order = lowered.order(&[root], |id| known.contains_key(&id));
    let names = Names::default();
    let block = Block::new(&lowered, quote!(S), names, &known, &order, &[root]);
    let mut block = block.fusing(true);
    block.require(root);
    let value = block.value(root);
    let statements = block.statements();
    quote!(#statements #value).to_string()
}

#[test]
fn sums_of_products_are_fused() {
    let sum = fused(|dag, [a, b, c, _]| {
        let product = dag.mul(a, b);
        dag.add(product, c)
    });
    assert_eq!(sum, "S :: fused (a , b , c)");
    let difference = fused(|dag, [a, b, c, _]| {
        let product = dag.mul(a, b);
        dag.sub(c, product)
    });
    assert_eq!(difference, "S :: fused (- a , b , c)");
}

#[test]
fn a_difference_of_products_and_a_product_with_a_name_are_not_fused() {
    let difference = fused(|dag, [a, b, c, d]| {
        let (first, second) = (dag.mul(a, b), dag.mul(c, d));
        dag.sub(first, second)
    });
    assert_eq!(difference, "a * b - c * d");
    let shared = fused(|dag, [a, b, c, _]| {
        let product = dag.mul(a, b);
        let sum = dag.add(product, c);
        dag.div(sum, product)
    });
    assert_eq!(shared, "let u1 = a * b ; (u1 + c) / u1");
}

#[test]
fn functions_are_called_by_the_name_of_the_scalar() {
    assert_eq!(
        method(crate::algebra::Function::Sinc.name()).to_string(),
        "sinc"
    );
}
