# SPDX-License-Identifier: Apache-2.0
"""Places of a module that can be mutated, found by slang: expressions that are evaluated at run time.

Left alone are parameters, types, generate conditions, loop headers, widths, case labels, assertions, functions that
nothing calls at run time, and the nets named ``unused``, which have no effect.
"""

import re
from collections import namedtuple
from pathlib import Path

import pyslang

A = pyslang.ast
K, S, X = A.ExpressionKind, A.StatementKind, A.SymbolKind
NEXT, SKIP = A.VisitAction.Advance, A.VisitAction.Skip

# start, end   offsets in the file (bytes are characters: the sources are ASCII)
# operator     one of OPERATORS
# new          text in place of the range
# hold         the range is a statement that is left out
Site = namedtuple("Site", "start end operator new hold", defaults=[False])

SWAPS = {
    "add": {"+": "-", "-": "+"},
    "bits": {"&": "|", "|": "&", "^": "~^", "~^": "^"},
    "logic": {"&&": "||", "||": "&&"},
    "equal": {"==": "!=", "!=": "=="},
    "order": {"<": "<=", "<=": "<", ">": ">=", ">=": ">"},
    "shift": {"<<": ">>", ">>": "<<", ">>>": ">>", "<<<": ">>>"},
}
OPERATORS = [*SWAPS, "not", "condition", "if", "literal", "hold", "index", "stuck"]


class Unreadable(RuntimeError):
    """slang refuses a source."""


def elaborate(top, parameters, files, include):
    """Compilation by slang and the instance of ``top``. Raises :class:`Unreadable`."""
    driver = pyslang.driver.Driver()
    driver.addStandardArgs()
    options = " ".join(f"-G {name}={value}" for name, value in parameters.items())
    names = " ".join(f'"{p}"' for p in files)
    if not driver.parseCommandLine(f'slang --top {top} {options} -I "{include}" {names}'):
        raise Unreadable(f"{top} {parameters}")
    if not (driver.processOptions() and driver.parseAllSources()):
        raise Unreadable(f"{top} {parameters}")
    compilation = driver.createCompilation()
    found = list(compilation.getRoot().topInstances)
    if len(found) != 1 or any(d.isError() for d in compilation.getAllDiagnostics()):
        raise Unreadable(f"{top} {parameters}: slang has errors")
    return driver, compilation, found[0]


def plain(expression):
    """The expression below implicit conversions."""
    while expression.kind == K.Conversion and expression.isImplicit:
        expression = expression.operand
    return expression


def constant(expression):
    """Whether no signal, variable or argument occurs in the expression."""
    seen = []

    def look(node):
        symbol = getattr(node, "symbol", None)
        if symbol is not None and symbol.kind in (X.Net, X.Variable, X.FormalArgument):
            seen.append(symbol)
        return NEXT

    expression.visit(look)
    return not seen


class Finder:
    """Collects the sites of one file. ``text``: its content; ``sites``: the result, none twice."""

    def __init__(self, path, manager, context):
        self.path, self.manager, self.context = Path(path).resolve(), manager, context
        self.text = self.path.read_text()
        self.sites = {}
        self.called = {}

    def range(self, node):
        """Start and end of a node in the file; None where a macro or another file has it."""
        where = node.sourceRange
        if self.manager.isMacroLoc(where.start) or self.manager.isMacroLoc(where.end):
            return None
        if Path(self.manager.getFullPath(where.start.buffer)).resolve() != self.path:
            return None
        return where.start.offset, where.end.offset

    def source(self, node):
        """Text of a node."""
        start, end = self.range(node)
        return " ".join(re.sub(r"//.*", "", self.text[start:end]).split())

    def add(self, node, operator, new, hold=False):
        """A site, unless a macro or another file has it."""
        place = self.range(node)
        if place:
            self.sites[Site(*place, operator, new, hold)] = None

    # ---------------------------------------------------------------- declarations

    def scope(self, scope):
        """Everything in a module, package or generate block."""
        for member in scope:
            kind = member.kind
            if kind == X.GenerateBlock and not member.isUninstantiated or kind == X.GenerateBlockArray:
                self.scope(member)
            elif kind == X.ContinuousAssign:
                self.walk(member.assignment)
            elif kind == X.Net and member.initializer is not None and not member.name.startswith("unused"):
                self.walk(member.initializer)
                self.right(member.initializer)
            elif kind == X.ProceduralBlock and str(member.procedureKind).split(".")[-1].startswith("Always"):
                self.walk(member.body)
            elif kind == X.Instance:
                for port in member.portConnections:
                    if port.port.direction == A.ArgumentDirection.In and port.expression is not None:
                        self.walk(port.expression)

    def functions(self):
        """Bodies of the functions that the rest calls, and those that they call."""
        done = set()
        while self.called.keys() - done:
            name = sorted(self.called.keys() - done)[0]
            done.add(name)
            self.walk(self.called[name].body)

    # ---------------------------------------------------------------- statements and expressions

    def walk(self, node):
        """Sites in a statement or an expression."""
        node.visit(self.visit)

    def visit(self, node):
        """One node; says whether to go on below it."""
        kind = node.kind
        if kind in (S.ImmediateAssertion, S.ConcurrentAssertion, S.VariableDeclaration):
            return SKIP
        if kind == S.ForLoop:
            self.walk(node.body)
            return SKIP
        if kind == S.Timed:
            self.walk(node.stmt)
            return SKIP
        if kind == S.Case:
            self.walk(node.expr)
            for item in node.items:
                self.walk(item.stmt)
            if node.defaultCase is not None:
                self.walk(node.defaultCase)
            return SKIP
        if kind == S.Conditional and len(node.conditions) == 1:
            self.decision(node.conditions[0].expr)
        elif kind == S.Return and node.expr is not None:
            self.right(node.expr)
        elif kind == S.ExpressionStatement and node.expr.kind == K.Assignment and node.expr.isNonBlocking:
            self.add(node, "hold", "", True)
        elif kind == K.Assignment:
            self.right(node.right)
            if node.isNonBlocking and plain(node.left).kind == K.ElementSelect:
                self.index(node.left)
            self.walk(node.right)
            return SKIP
        elif kind == K.Call:
            return self.call(node)
        elif kind == K.RangeSelect:
            self.walk(node.value)
            if node.selectionKind != A.RangeSelectionKind.Simple:
                self.walk(node.left)
            return SKIP
        elif kind == K.Replication:
            self.walk(node.concat)
            return SKIP
        elif kind == K.ElementSelect:
            self.index(node)
            self.walk(node.value)
            if plain(node.selector).kind != K.IntegerLiteral:
                self.walk(node.selector)
            return SKIP
        elif kind in (K.BinaryOp, K.UnaryOp, K.ConditionalOp, K.IntegerLiteral, K.UnbasedUnsizedIntegerLiteral):
            self.operator(node)
        elif kind == K.DataType or "Type" in str(kind):
            return SKIP
        return NEXT

    def call(self, node):
        """Remember a function called; of system functions only arguments of $signed and $unsigned."""
        if node.isSystemCall:
            return NEXT if node.subroutineName in ("$signed", "$unsigned") else SKIP
        if node.subroutine.syntax is not None and self.range_of_symbol(node.subroutine):
            self.called[node.subroutine.name] = node.subroutine
        return NEXT

    def range_of_symbol(self, symbol):
        """Whether a symbol is declared in the file."""
        return Path(self.manager.getFullPath(symbol.location.buffer)).resolve() == self.path

    def decision(self, condition):
        """The condition of an if."""
        if constant(condition) or not self.range(condition):
            return
        for new in (f"!({self.source(condition)})", "1'b1", "1'b0"):
            self.add(condition, "if", new)

    def right(self, expression):
        """The right-hand side of an assignment stuck at zero and at all ones."""
        inner = plain(expression)
        kind = inner.type.canonicalType
        if not kind.isIntegral or kind.isEnum or constant(inner) or "Pattern" in str(inner.kind):
            return
        if self.range(inner):
            text = self.source(inner)
            self.add(inner, "stuck", f"({text}) - ({text})")
            self.add(inner, "stuck", f"~(({text}) - ({text}))")

    def index(self, node):
        """An index one higher where that exists."""
        node = plain(node)
        selector, limit = plain(node.selector), node.value.type.canonicalType.fixedRange.width
        if limit < 2 or not self.range(selector) or not self.range(node.value):
            return
        text, base = self.source(selector), self.source(node.value)
        known = selector.eval(self.context)
        if known and int(known.value) + 1 >= limit:  # of a parameter or genvar
            return
        if selector.kind == K.IntegerLiteral:
            self.add(selector, "index", str(int(selector.value) + 1))
        else:
            self.add(selector, "index", f"({text}) < $high({base}) ? ({text}) + 1 : ({text})")

    def operator(self, node):
        """Swapped operator, condition negated, literal plus one."""
        where = self.range(node)
        if not where:
            return
        start, end = where
        if node.kind == K.BinaryOp:
            left, right = self.range(plain(node.left)), self.range(plain(node.right))
            between = left and right and re.sub(r"//.*", "", self.text[left[1] : right[0]]).strip(" \n()")
            for name, swaps in SWAPS.items():
                if between in swaps:
                    at = self.text.index(between, left[1])
                    new = self.joined(start, at) + f" {swaps[between]} " + self.joined(at + len(between), end)
                    self.add(node, name, new)
        elif node.kind == K.UnaryOp and self.range(node.operand):
            text, inner = self.text[start], self.source(node.operand)
            new = {"!": f"!(!({inner}))", "~": f"({inner})", "-": f"({inner})", "|": f"&({inner})", "&": f"|({inner})"}
            if text in new:
                self.add(node, "bits" if text in "|&" else "not", new[text])
        elif node.kind == K.ConditionalOp and len(node.conditions) == 1:
            condition = node.conditions[0].expr
            if self.range(condition):
                self.add(condition, "condition", f"!({self.source(condition)})")
        elif node.kind == K.UnbasedUnsizedIntegerLiteral:
            self.add(node, "literal", "'1" if self.text[start:end] == "'0" else "'0")
        elif node.kind == K.IntegerLiteral:
            sized = re.fullmatch(r"(\d+)'(s?)[bodh][0-9a-fA-F_]+", self.text[start:end])
            if sized:
                width, sign = int(sized[1]), sized[2]
                self.add(node, "literal", f"{width}'{sign}d{(int(node.value) + 1) % (1 << width)}")
            elif self.text[start:end].isdigit():
                self.add(node, "literal", str(int(node.value) + 1))

    def joined(self, start, end):
        """Text from start to end on one line."""
        return " ".join(re.sub(r"//.*", "", self.text[start:end]).split())


def find(top, parameters, path, files, include):
    """Sites of the file ``path`` when ``top`` is elaborated with ``parameters``, in order of their place."""
    driver, compilation, instance = elaborate(top, parameters, files, include)
    finder = Finder(path, driver.sourceManager, A.EvalContext(A.ASTContext(instance.body, A.LookupLocation.max)))
    finder.scope(instance.body)
    finder.functions()
    return sorted(finder.sites, key=lambda s: (s.start, -s.end, OPERATORS.index(s.operator), s.new))
