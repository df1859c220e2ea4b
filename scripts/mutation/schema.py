# SPDX-License-Identifier: Apache-2.0
"""One source that holds all mutants of a module: the environment variable RDX_MUTANT chooses at the start of a run."""

import random
import re
from collections import Counter, namedtuple

from .sites import OPERATORS

# number   from 1, in order of place, among all that the module has in any of its tests' sets of parameters
# line     of the file;  code: its text;  old, new: what is replaced;  nth: among mutants equal in code, old and new
Mutant = namedtuple("Mutant", "number site line code old new nth")

READ = '$c32("(std::getenv(\\"RDX_MUTANT\\") ? std::atoi(std::getenv(\\"RDX_MUTANT\\")) : 0)")'
LINTS = "WIDTHEXPAND WIDTHTRUNC CMPCONST UNSIGNED UNOPTFLAT SELRANGE LATCH CASEINCOMPLETE UNOPTTHREADS"


def number(text, sites):
    """Mutants of all ``sites`` (sorted), numbered."""
    mutants, seen = [], Counter()
    lines = text.splitlines()
    for i, site in enumerate(sites):
        line = text.count("\n", 0, site.start) + 1
        old = " ".join(text[site.start : site.end].split())
        key = (lines[line - 1].strip(), old, site.new)
        seen[key] += 1
        mutants.append(Mutant(i + 1, site, line, key[0], old, shown(site, old), seen[key]))
    return mutants


def shown(site, old):
    """What a site puts in place of ``old``, in few words."""
    if site.operator == "stuck":
        return "all ones" if site.new[0] == "~" else "zero"
    if site.operator == "index" and not site.new.isdigit():
        return f"{old} + 1, where that exists"
    return site.new or "(left out)"


def choose(mutants, count, seed):
    """``count`` mutants, spread over operators and lines; always the same for a seed."""
    mixed = list(mutants)
    random.Random(f"{seed} {len(mixed)}").shuffle(mixed)
    groups = {o: [m for m in mixed if m.site.operator == o] for o in OPERATORS}
    chosen, lines = [], Counter()
    while len(chosen) < min(count, len(mixed)):
        for group in groups.values():
            if group and len(chosen) < count:
                mutant = min(group, key=lambda m: lines[m.line])
                group.remove(mutant)
                chosen.append(mutant)
                lines[mutant.line] += 1
    return sorted(chosen, key=lambda m: m.number)


def rewrite(text, mutants):
    """``text`` with all ``mutants`` in it. Replacements hold no other mutants, so that it does not explode."""
    ranges = {}
    for mutant in sorted(mutants, key=lambda m: (m.site.start, -m.site.end, m.site.hold)):
        ranges.setdefault((mutant.site.start, mutant.site.end, mutant.site.hold), []).append(mutant)
    order = sorted(ranges, key=lambda r: (r[0], -r[1], not r[2]))

    def part(start, end, inner):
        """Text from start to end with the ranges ``inner``, which lie in it, rewritten."""
        out, at = [], start
        while inner:
            first, *inner = inner
            below = [r for r in inner if r[1] <= first[1]]
            inner = inner[len(below) :]
            assert at <= first[0] and first[1] <= end and all(r[0] >= first[1] for r in inner), "ranges cross"
            middle = part(first[0], first[1], below)
            if first[2]:
                numbers = " && ".join(f"rdx_mutant != {m.number}" for m in ranges[first])
                middle = f"begin if ({numbers}) {middle} end"
            else:
                for mutant in ranges[first]:
                    middle = f"(rdx_mutant == {mutant.number} ? ({mutant.site.new}) : ({middle}))"
            out += [text[at : first[0]], middle]
            at = first[1]
        return "".join([*out, text[at:end]])

    body = part(0, len(text), order)
    # behind the header of the module (its ports end with the first ");" at the start of a line) or of the package
    head = re.search(r"^package \w+;|^\);", body, re.M)
    lints = "".join(f" /* verilator lint_off {lint} */" for lint in LINTS.split())
    variable = f"{lints} int rdx_mutant = {READ};"
    return body[: head.end()] + variable + body[head.end() :]
