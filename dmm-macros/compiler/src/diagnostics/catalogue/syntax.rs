//! How a declaration is written.

super::codes! {
    SYNTAX = 100, "the declaration cannot be read",
        "A token stands where the grammar of declarations does not allow it.",
        "Compare the item with the table of items in the documentation of `pws!`.";
    HEAD = 101, "the declaration does not begin with a system",
        "A declaration is one `system` with a name and a block; documentation comments and a visibility such as `pub` may precede it.",
        "Write `system Name { … }` or `pub system Name { … }`.";
    ONE_SYSTEM = 102, "there is more than one system",
        "One `pws!` declares one system, and a system contains no other.",
        "Write another `pws!` for the next system.";
    ATTRIBUTE = 103, "an attribute stands where only documentation may",
        "Documentation comments carry over to what is emitted. Other attributes would have no meaning there, and a loop leaves nothing behind that could be documented.",
        "Write `/// …` in front of the system, an item or a name of a list, and `// …` elsewhere.";
    COMMENT = 104, "a comment is written as in another language",
        "A declaration is made of Rust's tokens, so comments are Rust's.",
        "Write `// …`, or `/// …` to document the item that follows.";
    UNKNOWN_ITEM = 105, "this is no item of a declaration",
        "Every item begins with a word that says what it declares.",
        "Begin the item with its word: `state`, `param`, `const`, `let`, `fn`, `interface`, `region`, `der`, `hamiltonian`, `conserved`, `assume conserved`, `sliding` or `for`.";
    MISPLACED_ITEM = 106, "the item does not belong in this block",
        "States, parameters, constants, functions, interfaces and regions belong to the whole system. A loop repeats `der`, `conserved`, `assume conserved` and `for` items alone.",
        "Move the item to the top level of the system, or in front of the loop.";
    SEMICOLON = 108, "a `;` or `,` is missing",
        "An item ends with `;`, and the definitions of a list are separated by `,`. The end of a line means nothing.",
        "Write the `;` behind the item.";
    ONE_DEFINITION = 109, "the item takes one definition",
        "Only `state`, `param`, `const` and `let` have lists.",
        "End the item with `;` and begin another one with its word.";
    NAME = 110, "a name is missing",
        "Something is declared or referred to, and no name follows.",
        "Write a name: letters, digits and `_`, and no digit in front.";
    RESERVED_WORD = 111, "this word cannot be a name",
        "The words of the declaration language and the keywords of Rust have a meaning of their own; a system becomes a Rust type, which must not hide one of Rust's own such as `f64`.",
        "Choose another name, such as the word with a suffix: `sum_of_squares`, `region_1`.";
    EQUALS = 112, "`=` and a formula are expected",
        "A definition is a name, one `=` and a formula. It holds at all times: there is neither assignment nor comparison.",
        "Write `name = formula;`. To add to a rate, write the whole of it in one `der` item.";
    TYPE = 113, "a type stands in a declaration",
        "Every quantity is real, and the compiler chooses how it is computed.",
        "Leave out the type; a group of states or parameters has its length behind the name, `q[3]`.";
    INITIAL_VALUE = 114, "a state has a value",
        "A declaration says how a state changes. Where it starts is said when it is integrated.",
        "Write `state x;` and give the initial state to the integrator.";
    DEFAULT = 115, "a parameter has no default",
        "Parameters become the fields of a struct with `Default`.",
        "Write `param k = 1;`.";
    DERIVATIVE = 116, "a derivative is not written `der(x) = …`",
        "A system is of first order: `der(x) = …;` gives the rate of one state, and that is all that is said about derivatives.",
        "Write `der(x) = …;`. For an equation of second order declare the velocity as a state: `der(x) = v; der(v) = …;`.";
    REGION = 117, "the region lacks its conditions or its block",
        "A region says where it holds and, in its block, what holds there.",
        "Write `region name where interface > 0 { … }`; without an interface no region is needed.";
    CONDITION = 118, "this is no side of an interface",
        "Regions are open sets, bounded by named interfaces: each condition says on which side of one of them the region lies. The interface itself belongs to no region.",
        "Declare `interface wall = x - 1;` and write `where wall > 0` or `where wall < 0`; join several with `and`.";
    ALTERNATIVES = 119, "a region is not an alternative of conditions",
        "A region is one sign pattern of the interfaces.",
        "Write a region for each alternative; what they share can stand in `let` and `fn` items, or at the top level.";
    OPERAND = 120, "a number, a name or a function is expected",
        "An operator has no operand, or a formula is missing.",
        "Complete the formula. There is no unary plus, and a number has a digit in front of its point: `0.5`.";
    OPERATOR = 121, "an operator is missing",
        "Two operands follow each other. A product needs its `*`: `2x` and `a b` would be ambiguous with names.",
        "Write `a*b`; the argument of a function stands in parentheses, `sin(x)`.";
    UNEXPECTED = 122, "a token does not belong in a formula",
        "A formula is made of numbers, names, `+ - * / % ^`, parentheses, functions, elements `q[i]` and sums.",
        "Remove the token, or look up what is meant in the table of formulas in the documentation of `pws!`.";
    POWER = 123, "a power is not written `^`",
        "`**`, `pow` and `powi` belong to other languages.",
        "Write `x^2`. The power binds tighter than the unary minus, `-x^2 = -(x^2)`, and from the right.";
    METHOD = 124, "a method or a field stands in a formula",
        "Formulas are mathematics: quantities have neither methods nor fields.",
        "Write `sqrt(x)` for `x.sqrt()`, `k` for `self.k` and `q[0]` for `q.0`.";
    BRANCH = 125, "a branch or a comparison is not written as one",
        "Where a formula switches, the integrator locates the crossing: one comparison decides, and there is a value on both sides.",
        "Write `if a > b { u } else { v }`, or declare an `interface` and a `region` on each side.";
    PATH = 126, "a formula has a path",
        "Formulas know the names of the declaration and nothing of Rust's modules.",
        "Write `pi` for `std::f64::consts::PI` and `sqrt(x)` for `f64::sqrt(x)`; declare other constants with `const` or `param`.";
    NUMBER = 127, "a number cannot be read",
        "Numbers are exact decimal fractions without a type, within the range of floating-point numbers.",
        "Write `2`, `0.1` or `1e-3`, and a product with its `*`.";
    DEPTH = 128, "this is nested too deeply or too long",
        "Parentheses, signs, exponents and indices may be nested 64 deep, operations 400 in a row, and loops 8 deep.",
        "Name parts of the formula with `let`.";
    GROUP = 129, "a group is not declared as one",
        "States and parameters may be groups `q[3]` with one index; its length is a formula of constants. Everything else is a single quantity.",
        "Write `state q[3];`, `param m[3] = 1;` or `param m[3] = [1, 2, 3];`; declare a group for each row of a matrix.";
    INDEX = 130, "an element is not written `q[i]`",
        "An element of a group is the group's name with one index in brackets, counted from 0.",
        "Write `q[0]`, `q[i + 1]` or `q[(i + 1) % n]`.";
    RANGE = 131, "a range is not written `start..end`",
        "A range counts up by one from its start and ends in front of its end: `0..3` is 0, 1, 2.",
        "Write `0..n` for all elements of a group of n, `1..n - 1` for the inner ones.";
    SUM = 132, "a sum is not written `sum(i in start..end, term)`",
        "A sum counts one name through a range and adds the terms.",
        "Write `sum(i in 0..n, q[i]^2)`; put sums into each other for several indices.";
    LOOP = 133, "a loop is not written `for i in start..end { … }`",
        "A loop repeats its items with one name that counts through a range of constants.",
        "Write `for i in 0..n { der(q[i]) = p[i]; }`; put loops into each other for several indices.";
    FUNCTION = 134, "a function is not written `fn name(arguments) = formula;`",
        "A function is a formula with arguments, which are names.",
        "Write `fn V(q) = q^2/2;`; name a formula without arguments with `let`.";
    HAMILTONIAN = 135, "the canonical pairs of a Hamiltonian are not written `in (q, p)`",
        "The fields q' = ∂H/∂p and p' = -∂H/∂q need to know which momentum belongs to which coordinate.",
        "Write `hamiltonian H = formula in (q, p), (x, y);` with states, elements `q[0]` or whole groups of the same length.";
    ASSUME = 136, "`assume` is not followed by `conserved`",
        "Only a conserved quantity can be assumed.",
        "Write `assume conserved energy = …;`.";
    EVENT = 137, "an event is not written as one",
        "An event says when it happens, what has to hold then, and what changes, all of it from the values before.",
        "Write `on interface falling { x = …; }`, with `rising` or `falling` or neither, and `where a > b` behind it if it has a condition; or `every 2 { … }`, `at 3 { … }`.";
    SLIDING = 138, "what holds of a sliding motion is not written in a block of its interface",
        "While a solution slides on an interface, more may be conserved than on either side.",
        "Write `sliding interface { conserved energy = …; }`.";
}
