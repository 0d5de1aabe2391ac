//! What a declaration claims.

super::codes! {
    NOT_CONSERVED = 300, "a quantity is not conserved",
        "∂ₜψ + ∇ψ·f is not zero: it is shown with a point at which it is not.",
        "Correct the sign or the factor in ψ or in f, or leave the quantity out.";
    NOT_PROVED = 301, "a quantity could not be proved to be conserved",
        "∂ₜψ + ∇ψ·f was found neither to be zero nor clearly not to be: the normal form does not know every relation between roots, logarithms and inverse functions. Or the work that the proofs of a declaration may take ran out, as the message then says.",
        "Write ψ or f in another way, or accept the quantity with `assume conserved`, which checks it numerically at many points.";
    ASSUMED_UNCHECKED = 302, "an assumed quantity could not be checked",
        "`assume conserved` compares ∂ₜψ + ∇ψ·f with its terms at many points. At too few of them the formulas have a value, or the terms are more than the rounding errors of what cancels within them.",
        "Write ψ and f such that they are defined for states and parameters of size one, and leave out what cancels within a term; or leave the quantity out.";
    ASSUMED_NOT_SMALL = 303, "an assumed quantity is not conserved numerically",
        "∂ₜψ + ∇ψ·f is not small against its terms at a point at which `assume conserved` evaluated it.",
        "Correct ψ or f, or leave the quantity out.";
    CONSTANT_QUANTITY = 304, "a conserved quantity is a constant",
        "All derivatives of ψ are zero, so that it says nothing about the motion.",
        "Remove it, or write the quantity that was meant.";
    TOO_MANY_QUANTITIES = 305, "there are more conserved quantities than states",
        "More gradients than states are linearly dependent.",
        "Keep the quantities that do not follow from the others.";
    DEPENDENT_QUANTITIES = 306, "conserved quantities depend on one another",
        "The gradient of a quantity was proved to be a linear combination of others everywhere, so that it follows from them.",
        "Remove the quantity: it is conserved whenever the others are.";
    NOTHING_MOVES = 307, "conserved quantities leave nothing to move",
        "As many independent quantities as states fix every state, so that f has to be zero.",
        "Declare one quantity less, or none where the vector field is zero.";
    CONSTANT_INTERFACE = 308, "an interface is constant",
        "All derivatives of the switching function are zero, so that its sign never changes.",
        "Write a switching function that depends on the states or on `t`.";
    NEVER_CROSSED = 309, "an interface is never crossed",
        "The switching function is constant along the flow of every region: each is a system of its own.",
        "Declare two systems, or correct the switching function.";
    ALWAYS_SLIDING = 310, "both sides of an interface push towards it",
        "The rate of the switching function is nowhere positive above the interface and nowhere negative below it: no trajectory can cross, and one that arrives has nowhere to go.",
        "Correct the signs of f or of the switching function.";
    ALWAYS_LEAVING = 311, "both sides of an interface lead away from it",
        "The rate of the switching function is nowhere negative above the interface and nowhere positive below it: no trajectory ever arrives.",
        "Declare two systems, or correct the signs of f or of the switching function.";
    EMPTY_DOMAIN = 312, "a conserved quantity has no value anywhere",
        "What its formulas and f need excludes itself, or holds nowhere in the region: ln(x) and ln(-x) are nowhere both defined, and ln(x) is not in a region where x < 0.",
        "Correct a sign, or the region; leave the quantity out where it has no value.";
    NOT_CONSERVED_BY_EVENT = 313, "an event does not conserve what it claims to",
        "Behind the event, at points of the interface, ψ is not what it is in front of it.",
        "Correct what the event changes, or leave the quantity out of `conserves`: its level is taken anew behind every event.";
}
