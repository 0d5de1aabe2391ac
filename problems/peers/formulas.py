"""Formulas of a declaration as heyoka expressions.

Both regions become one expression where they differ in constants only: those constants are
runtime parameters, which an event sets. That is the fastest way to tell heyoka of two regions.
"""

import ast
import keyword
import math
import re

import heyoka as hy

FUNCTIONS = {
    "sqrt": (math.sqrt, hy.sqrt),
    "exp": (math.exp, hy.exp),
    "ln": (math.log, hy.log),
    "sin": (math.sin, hy.sin),
    "cos": (math.cos, hy.cos),
    "tan": (math.tan, hy.tan),
    "sinh": (math.sinh, hy.sinh),
    "cosh": (math.cosh, hy.cosh),
    "tanh": (math.tanh, hy.tanh),
    "asin": (math.asin, hy.asin),
    "acos": (math.acos, hy.acos),
    "atan": (math.atan, hy.atan),
}
OPERATORS = {
    ast.Add: lambda a, b: a + b,
    ast.Sub: lambda a, b: a - b,
    ast.Mult: lambda a, b: a * b,
    ast.Div: lambda a, b: a / b,
}


class Different(Exception):
    """The formulas of the two regions differ in more than constants."""


class Formulas:
    """Translates pairs of formulas, for g > 0 and g < 0; `switched` are the values of the
    parameters on the two sides."""

    def __init__(self, description):
        self.constants = {"pi": math.pi} | dict(map(tuple, description["parameters"]))
        names = description["states"]
        self.states = hy.make_vars(*names)
        self.variables = dict(zip(names, self.states)) | {"t": hy.time}
        self.switched = []

    def one(self, text):
        """A formula that both sides share."""
        return self.both(text, text)

    def field(self, regions):
        """The vector field, of one region or of both."""
        above = max(regions, key=lambda region: region["sides"])
        below = min(regions, key=lambda region: region["sides"])
        return [self.both(*pair) for pair in zip(above["field"], below["field"])]

    def both(self, above, below):
        """A formula on the two sides."""
        return self.merge(parse(above), parse(below))

    def merge(self, above, below):
        values = self.value(above), self.value(below)
        if None not in values:
            return self.constant(values)
        if None not in (self.name(above), self.name(below)):
            if self.name(above) != self.name(below):
                raise Different
            return self.variables[self.name(above)]
        match above, below:
            case ast.UnaryOp(), ast.UnaryOp():
                return -self.merge(above.operand, below.operand)
            case ast.Call(), ast.Call() if above.func.id == below.func.id:
                return FUNCTIONS[above.func.id][1](self.merge(above.args[0], below.args[0]))
            case ast.BinOp(op=ast.Pow()), ast.BinOp(op=ast.Pow()):
                return self.power(above, below)
            case ast.BinOp(op=ast.Add() | ast.Sub()), ast.BinOp(op=ast.Add() | ast.Sub()):
                return self.sum(terms(above), terms(below))
            case ast.BinOp(), ast.BinOp() if type(above.op) is type(below.op):
                left = self.merge(above.left, below.left)
                return OPERATORS[type(above.op)](left, self.merge(above.right, below.right))
        raise Different

    def sum(self, above, below):
        """A sum, whose terms may be in another order and of another sign on the two sides."""
        if len(above) != len(below):
            raise Different
        total = None
        for sign, term in above:
            other_sign, factor = self.counterpart(term, below)
            if sign == other_sign:
                total = signed(total, sign, factor)
            else:
                total = signed(total, 1.0, self.constant((sign, other_sign)) * factor)
        return total

    def counterpart(self, term, others):
        """The term that belongs to `term`, taken from `others`, as its sign and as both."""
        text = ast.unparse(term)
        for other in sorted(others, key=lambda other: ast.unparse(other[1]) != text):
            before = list(self.switched)
            try:
                both = self.merge(term, other[1])
            except Different:
                self.switched = before
                continue
            others.remove(other)
            return other[0], both
        raise Different

    def power(self, above, below):
        """A power; that of a root is one power, which heyoka does not see by itself."""
        exponents = self.value(above.right), self.value(below.right)
        if None in exponents or exponents[0] != exponents[1]:
            raise Different
        exponent, (above, below) = exponents[0], (above.left, below.left)
        if all(isinstance(base, ast.Call) and base.func.id == "sqrt" for base in (above, below)):
            exponent, (above, below) = exponent / 2, (above.args[0], below.args[0])
        return self.merge(above, below) ** exponent

    def constant(self, values):
        """A number, or the runtime parameter with these values on the two sides."""
        if values[0] == values[1]:
            return hy.expression(values[0])
        if values not in self.switched:
            self.switched.append(values)
        return hy.par[self.switched.index(values)]

    def name(self, node):
        """The state or the time that is meant."""
        text = ast.unparse(node) if isinstance(node, (ast.Name, ast.Subscript)) else None
        return text if text in self.variables else None

    def value(self, node):
        """The number that an expression without variables is."""
        match node:
            case ast.Constant(value=value):
                return float(value)
            case ast.Name() | ast.Subscript():
                return self.constants.get(ast.unparse(node))
            case ast.UnaryOp():
                value = self.value(node.operand)
                return None if value is None else -value
            case ast.Call():
                value = self.value(node.args[0])
                return None if value is None else FUNCTIONS[node.func.id][0](value)
            case ast.BinOp():
                values = self.value(node.left), self.value(node.right)
                if None in values:
                    return None
                operator = OPERATORS.get(type(node.op), lambda a, b: a**b)
                return operator(*values)
        raise ValueError(ast.unparse(node))


def parse(text):
    """The tree of a formula: Python's, but for the sign of powers, and Python's words may be names."""
    mark = "__name"
    name = lambda word: word[0] + mark * keyword.iskeyword(word[0])
    tree = ast.parse(re.sub(r"\w+", name, text.replace("^", "**")), mode="eval").body
    for node in ast.walk(tree):
        if isinstance(node, ast.Name):
            node.id = node.id.removesuffix(mark)
    return tree


def terms(node, sign=1.0):
    """The terms of a sum, with their signs."""
    match node:
        case ast.BinOp(op=ast.Add()):
            return terms(node.left, sign) + terms(node.right, sign)
        case ast.BinOp(op=ast.Sub()):
            return terms(node.left, sign) + terms(node.right, -sign)
        case ast.UnaryOp():
            return terms(node.operand, -sign)
    return [(sign, node)]


def signed(total, sign, term):
    """A sum with one term more."""
    if total is None:
        return term if sign > 0 else -term
    return total + term if sign > 0 else total - term
