//! Names, regions and formulas.

super::codes! {
    UNDECLARED = 200, "a name is not declared",
        "A formula uses a name that is neither a state, a parameter, a constant, a `let` nor `t`.",
        "Declare it in front of its use, or correct its spelling.";
    USED_TOO_EARLY = 201, "a name is used before it is declared",
        "Declarations are read from top to bottom, so that nothing can be defined by itself.",
        "Move the declaration in front of its first use.";
    RESERVED = 202, "a name has a meaning of its own",
        "`t`, `pi` and the built-in functions mean the same in every declaration.",
        "Choose another name.";
    DECLARED_TWICE = 203, "a name is declared twice",
        "A name stands for one thing in the whole declaration. Only an argument of a `fn` may have the name of something outside, which its formula then does not see.",
        "Rename one of the two, or remove it.";
    SHADOWED = 204, "a loop variable has the name of something else",
        "Within the loop the name would mean something else than around it.",
        "Rename the loop variable.";
    UNUSED = 205, "something is declared and never used",
        "A warning: it would have no effect, so that a formula is probably missing it.",
        "Use it, remove it, or begin its name with `_`.";
    NOT_A_QUANTITY = 206, "a name stands for something without a value",
        "Interfaces, regions, conserved quantities and functions cannot be parts of formulas.",
        "Name the formula with `let` and use that name in both places; call functions with their arguments.";
    NOT_CONSTANT = 207, "a constant depends on something that varies",
        "Constants, defaults, numbers of elements, indices and the bounds of loops are known when the system is compiled: they cannot depend on states, parameters or the time.",
        "Use numbers, constants and loop variables alone, or declare the name with `let`.";

    UNKNOWN_FUNCTION = 210, "there is no such function",
        "A function is called that is neither built in nor declared with `fn`.",
        "Correct its spelling, or declare it: `fn name(x) = …;`.";
    NOT_A_FUNCTION = 211, "something is called that is not a function",
        "A name in front of parentheses is called; states, parameters and constants have no arguments.",
        "Write `a*(b + c)` for a product, and states without the argument `t`.";
    NUMBER_OF_ARGUMENTS = 212, "a function is called with the wrong number of arguments",
        "Built-in functions take one argument, those declared with `fn` as many as they declare.",
        "Add or remove arguments.";
    NOT_SMOOTH = 213, "a function jumps without end",
        "An interface is where one function is zero. What jumps again and again is no formula.",
        "Declare an `interface` and a `region` on each side of it, or a discrete state with an event.";

    DIVISION_BY_ZERO = 220, "a division by zero",
        "The divisor is zero whatever the states and parameters are.",
        "Correct the divisor.";
    OUTSIDE_DOMAIN = 221, "a function or power of a constant has no real value",
        "For instance the logarithm or the root of a negative number.",
        "Correct the argument.";
    OUT_OF_RANGE = 222, "a constant is beyond the range of floating-point numbers",
        "A constant part of a formula is larger than 1.8e308, smaller than 5e-324 without being zero, or has too many digits to be kept exactly.",
        "Choose other units, or write the constant as a decimal number.";
    LARGE_EXPONENT = 223, "an exponent is too large",
        "The divided difference of uⁿ is a sum of n terms, so that n has a limit.",
        "Write the power with `exp` and `ln`, or as a power of a smaller power.";
    REMAINDER = 224, "`%` is applied to something else than integers",
        "The remainder is meant for indices such as `q[(i + 1) % n]`; it is not smooth elsewhere.",
        "Use integer constants and loop variables alone on both sides.";

    INDEX_BEYOND = 230, "an element does not exist",
        "A group declared with n elements has the indices 0 to n − 1.",
        "Change the index or the range of the loop; a ring is written `q[(i + 1) % n]`.";
    INDEX_NOT_INTEGER = 231, "an index is not an integer",
        "Elements are counted by integers.",
        "Correct the index.";
    INDEX_MISSING = 232, "a group is used without an index",
        "A formula is made of numbers, not of groups of them.",
        "Write an element, `q[0]`, or `sum(i in 0..n, q[i])`.";
    INDEX_ON_SCALAR = 233, "something has an index that is not a group",
        "The name was declared without a number of elements.",
        "Leave out the index, or declare the name with the number of its elements: `state q[3];`.";
    GROUP_LENGTH = 234, "a group has no valid number of elements",
        "The number of elements is an integer constant, at least one.",
        "Write a positive integer or a constant.";
    DEFAULTS = 235, "the number of defaults is not that of the elements",
        "A list of defaults gives one to each element.",
        "Write one formula for all elements, or as many as there are elements.";
    LOOP_BOUND = 236, "the bound of a loop is not an integer",
        "A loop variable runs through integers.",
        "Correct the bound.";
    LOOP_BACKWARDS = 237, "a range runs backwards",
        "`a..b` holds the integers from a up to and without b, so that it is empty unless a < b.",
        "Exchange the bounds.";
    INDEX_ARGUMENT = 238, "an argument that is part of an index varies",
        "A function uses this argument in an index, in the bound of a sum, or with `%`: there it has to be a constant.",
        "Call the function with a constant or a loop variable.";
    TOO_LONG = 239, "loops and functions make the declaration too long",
        "Loops, sums and functions are written out when the system is compiled.",
        "Use fewer turns, or fewer functions within functions.";

    NO_STATE = 240, "a system has no state",
        "There is nothing to integrate.",
        "Declare `state x;`.";
    TOO_MANY_STATES = 241, "a system has too many states or parameters",
        "What is derived grows with the square of their number.",
        "Divide the system, or use fewer elements.";
    NOT_A_STATE = 242, "`der` or a canonical pair names something that is not a state",
        "Only states change with the time.",
        "Correct the name, or declare it as a state.";
    DERIVATIVE_TWICE = 243, "a state has two derivatives",
        "Every state has one `der` in every region.",
        "Remove one of them.";
    DERIVATIVE_MISSING = 244, "a state has no derivative",
        "In every region, every state has a `der` or is in a pair of a `hamiltonian`.",
        "Add `der(x) = …;`, with `0` for a state that does not change.";
    CONSERVED_TWICE = 245, "a conserved quantity is declared twice",
        "The conserved quantities of a region have different names.",
        "Rename or remove one of them.";
    ALREADY_SHARED = 246, "a region declares again what holds in every region",
        "What stands outside of the regions belongs to each of them.",
        "Remove one of the two, or move the shared one into the other regions.";
    PAIR_LENGTHS = 247, "the two parts of a canonical pair do not fit together",
        "Each coordinate has one momentum, so that two groups in a pair have the same number of elements.",
        "Pair a state with a state, and a group with a group of the same number of elements.";
    PAIRED_TWICE = 248, "a state is in two canonical pairs",
        "Each state is one coordinate or one momentum.",
        "Remove one of the pairs.";
    PAIRED_AND_DERIVATIVE = 249, "a state has a `der` and is in a canonical pair",
        "The Hamiltonian gives the derivatives of both states of a pair.",
        "Remove the `der`, or the pair.";

    INTERFACE_CONSTANT = 260, "an interface cannot be crossed",
        "Its switching function depends neither on a state nor on the time.",
        "Correct the switching function, or remove the interface.";
    NO_REGION = 262, "an interface bounds no region",
        "A warning: an interface separates two regions, each with its own field. Without them nothing changes where it is crossed, and the system is the same without it.",
        "Write a region on each side of it.";
    REGION_WITHOUT_INTERFACE = 263, "a region has no interface that bounds it",
        "A region is one side of an interface.",
        "Declare an interface, or write the items of the region at the top level.";
    REGION_WITHOUT_SIDE = 264, "a region does not say where it is",
        "With an interface, each region is on one side of it.",
        "Write `region name where interface > 0` or `< 0`.";
    SIDE_TWICE = 265, "an interface stands twice in the pattern of a region",
        "A region is on one side of each interface.",
        "Remove one of the conditions.";
    NOT_AN_INTERFACE = 266, "a region is bounded by something that is not an interface",
        "Regions are bounded by declared interfaces.",
        "Declare `interface name = …;`, or correct the name.";
    REGION_TWICE = 267, "two regions have the same name",
        "Each region becomes a variant of the same enumeration in Rust.",
        "Rename one of them.";
    REGIONS_OVERLAP = 268, "two regions overlap",
        "Each point belongs to one region.",
        "Change the conditions of one of them, or add one.";
    REGION_MISSING = 269, "a region is missing",
        "Together, the regions cover the whole space.",
        "Declare the region with the signs that the message names, or leave a condition out of another one.";

    EVENT_TARGET = 270, "an event changes something that is no state",
        "Between events states follow their `der`, and discrete states are constant; nothing else changes.",
        "Declare `discrete name = …;` with its initial value, or correct the name.";
    EVENT_TWICE = 271, "an event gives something two values",
        "All new values are computed from the values before, at once, so that their order means nothing.",
        "Write one formula for each state that changes.";
    EVENT_TIME = 272, "the time of an event cannot be known beforehand",
        "`every` and `at` take times that parameters and constants tell; what depends on states is an interface.",
        "Write a formula of parameters, or declare an interface and `on` it.";

    NO_SLIDING = 280, "there is no sliding motion on an interface",
        "A solution slides where the fields on both sides lead to the interface, along a mean of them that stays on it (Filippov). The fields have to differ in what they do to its switching function.",
        "Remove `sliding`, or correct the formulas that switch there.";
    NOT_A_MEAN = 281, "the motion on two sliding interfaces at once is not determined",
        "Where several switches slide, each of them has a mean of its own, if the field is a sum of what they switch: a product of two of them has many means. At most 16 can depend on one another.",
        "Write the branches beside each other instead of in each other, or declare interfaces and regions.";
}
