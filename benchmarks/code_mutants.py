"""Faults planted in source code, one each: what a test should notice.

Glossary
--------
mutant
    A file with one place changed: where, which text stood there, and which stands there now.
function
    The outermost function or method around it, by its qualified name; empty outside of all of them.
"""

import ast
from dataclasses import dataclass

COMPARED: dict[type[ast.cmpop], tuple[type[ast.cmpop], ...]] = {
    ast.Lt: (ast.LtE, ast.Gt),
    ast.LtE: (ast.Lt, ast.Gt),
    ast.Gt: (ast.GtE, ast.Lt),
    ast.GtE: (ast.Gt, ast.Lt),
    ast.Eq: (ast.NotEq,),
    ast.NotEq: (ast.Eq,),
    ast.In: (ast.NotIn,),
    ast.NotIn: (ast.In,),
    ast.Is: (ast.IsNot,),
    ast.IsNot: (ast.Is,),
}
CALCULATED: dict[type[ast.operator], type[ast.operator]] = {
    ast.Add: ast.Sub,
    ast.Sub: ast.Add,
    ast.Mult: ast.Div,
    ast.Div: ast.Mult,
    ast.FloorDiv: ast.Mult,
    ast.Mod: ast.FloorDiv,
    ast.Pow: ast.Mult,
    ast.BitAnd: ast.BitOr,
    ast.BitOr: ast.BitAnd,
}
OPERATORS = ("comparison", "arithmetic", "sign", "constant", "boolean", "return", "dropped")


@dataclass(frozen=True)
class Mutant:
    """A change of a file: lines from 1, columns in bytes from 0."""

    path: str
    function: str
    operator: str
    line: int
    column: int
    end: tuple[int, int]
    old: str
    new: str

    @property
    def key(self) -> str:
        """One line that says which it is."""
        return f"{self.path}:{self.line}:{self.column} {self.operator}: {self.old!r} -> {self.new!r}"

    def applied(self, text: str) -> str:
        """The file with the change."""
        lines = [line.encode() for line in text.splitlines(keepends=True)]
        (last, stop), first = self.end, self.line - 1
        before, after = lines[first][: self.column], lines[last - 1][stop:]
        lines[first:last] = [before + self.new.encode() + after]
        return b"".join(lines).decode()


def mutants(path: str, text: str) -> list[Mutant]:
    """All of a file, in the order of their places.

    Left alone are texts (messages among them), annotations, decorators, docstrings, what a type checker alone
    sees, and assertions.
    """
    found = _Places(path, text)
    found.visit(ast.parse(text))
    return found.known


class _Places(ast.NodeVisitor):
    def __init__(self, path: str, text: str) -> None:
        self.path = path
        self.lines = [line.encode() for line in text.splitlines(keepends=True)]
        self.known: list[Mutant] = []
        self.scopes: list[tuple[str, bool]] = []

    def _function(self) -> str:
        names = []
        for name, call in self.scopes:
            names.append(name)
            if call:
                return ".".join(names)
        return ""

    def _add(self, operator: str, node: ast.expr | ast.stmt, new: ast.AST | str) -> None:
        said = new if isinstance(new, str) else f"({ast.unparse(new)})"
        assert node.end_lineno is not None
        assert node.end_col_offset is not None
        end = (node.end_lineno, node.end_col_offset)
        stood = list(self.lines[node.lineno - 1 : end[0]])
        stood[-1] = stood[-1][: end[1]]
        stood[0] = stood[0][node.col_offset :]
        old = b"".join(stood).decode()
        self.known.append(
            Mutant(self.path, self._function(), operator, node.lineno, node.col_offset, end, old, said)
        )

    def _scoped(self, node: ast.ClassDef | ast.FunctionDef | ast.AsyncFunctionDef) -> None:
        self.scopes.append((node.name, not isinstance(node, ast.ClassDef)))
        if not isinstance(node, ast.ClassDef):
            for default in [*node.args.defaults, *filter(None, node.args.kw_defaults)]:
                self.visit(default)
        for statement in node.body:
            self.visit(statement)
        self.scopes.pop()

    visit_ClassDef = visit_FunctionDef = visit_AsyncFunctionDef = _scoped  # noqa: N815 - names of a protocol

    def visit_AnnAssign(self, node: ast.AnnAssign) -> None:
        if node.value is not None:
            self.visit(node.value)

    def _left(self, _: ast.AST) -> None:
        """Leave alone."""

    visit_JoinedStr = visit_Assert = visit_Import = visit_ImportFrom = visit_Delete = _left  # noqa: N815

    def visit_Raise(self, node: ast.Raise) -> None:
        self._add("dropped", node, "pass")

    def visit_If(self, node: ast.If) -> None:
        if isinstance(node.test, ast.Name) and node.test.id == "TYPE_CHECKING":
            return
        self.generic_visit(node)

    def visit_Compare(self, node: ast.Compare) -> None:
        for place, one in enumerate(node.ops):
            for other in COMPARED[type(one)]:
                changed = ast.Compare(node.left, list(node.ops), node.comparators)
                changed.ops[place] = other()
                self._add("comparison", node, changed)
        self.generic_visit(node)

    def visit_BinOp(self, node: ast.BinOp) -> None:
        texts = (ast.JoinedStr, ast.List, ast.Tuple)
        parts = (node.left, node.right)
        worded = any(isinstance(part, texts) or _text(part) for part in parts)
        if type(node.op) in CALCULATED and not worded and not _types(node):
            changed = ast.BinOp(node.left, CALCULATED[type(node.op)](), node.right)
            self._add("arithmetic", node, changed)
        self.generic_visit(node)

    def visit_AugAssign(self, node: ast.AugAssign) -> None:
        if type(node.op) in CALCULATED:
            changed = ast.AugAssign(node.target, CALCULATED[type(node.op)](), node.value)
            self._add("arithmetic", node, ast.unparse(changed))
        self._add("dropped", node, "pass")
        self.visit(node.value)

    def visit_UnaryOp(self, node: ast.UnaryOp) -> None:
        if isinstance(node.op, ast.USub):
            self._add("sign", node, node.operand)
        elif isinstance(node.op, ast.Not):
            self._add("boolean", node, node.operand)
        if not isinstance(node.operand, ast.Constant):
            self.generic_visit(node)

    def visit_BoolOp(self, node: ast.BoolOp) -> None:
        other = ast.Or() if isinstance(node.op, ast.And) else ast.And()
        self._add("boolean", node, ast.BoolOp(other, node.values))
        self.generic_visit(node)

    def visit_Constant(self, node: ast.Constant) -> None:
        value = node.value
        if isinstance(value, bool):
            self._add("constant", node, str(not value))
        elif isinstance(value, int):
            self._add("constant", node, str(value + 1))
        elif isinstance(value, float):
            self._add("constant", node, repr(2 * value if value else 1.0))

    def visit_Return(self, node: ast.Return) -> None:
        if node.value is None:
            return
        if not (isinstance(node.value, ast.Constant) and node.value.value in {None, True, False}):
            self._add("return", node, "return None")
        self.visit(node.value)

    def visit_Expr(self, node: ast.Expr) -> None:
        if isinstance(node.value, ast.Constant):
            return
        if isinstance(node.value, ast.Call):
            self._add("dropped", node, "pass")
        self.visit(node.value)

    def visit_Continue(self, node: ast.Continue) -> None:
        self._add("dropped", node, "pass")

    def visit_Break(self, node: ast.Break) -> None:
        self._add("dropped", node, "pass")


def _text(node: ast.expr) -> bool:
    return isinstance(node, ast.Constant) and isinstance(node.value, str | bytes)


def _types(node: ast.BinOp) -> bool:
    """Whether it may be a union of types."""
    return isinstance(node.op, ast.BitOr) and all(
        isinstance(one, ast.Name | ast.Attribute | ast.Constant | ast.BinOp | ast.Subscript)
        for one in (node.left, node.right)
    )


def executed_names(qualified: str) -> str:
    """The outermost function of a name as code objects have it: without what stands inside of it."""
    return qualified.partition(".<")[0]
