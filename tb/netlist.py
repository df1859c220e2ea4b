# SPDX-License-Identifier: Apache-2.0
"""Text of a module for Icarus Verilog: the netlist that yosys wrote, and a shell with its ports around it."""

import re

# For bench.start: each test begins as if the simulation did.
FORGET = """\
  integer place;
  reg forget = 1'b0;
  always @(posedge forget) begin
    was_reset = 1'b0;
{registers}
  end
"""
# A register or a memory: name, and first and last place of a memory.
REGISTER = re.compile(r"^  reg (?:\[\d+:\d+\] )?(\S+) *(?:\[(\d+):(\d+)\])?;$", re.M)
# A write: a statement that begins with a name and an index.
WRITE = re.compile(r"^ +(\\\S+ |\w+) *\[")
CONSTANT = re.compile(r"\d+'[dh][\da-f]+$")

# Outputs that are never unknown while the reset is off. limit_valid_o is no control: a part of the answer to a look,
# and unknown before the first one.
CONTROL = re.compile(r"(?:(?<!limit_)valid|ready|idle|enter|phase|filled)_o")
WATCH = """\
  // X or Z at an output of control after a clock of reset
  always @(posedge clk_i) begin
    was_reset <= was_reset || rst_ni === 1'b0;
    if (was_reset && rst_ni === 1'b1 && ^{{{outputs}}} === 1'bx) begin
      $display("unknown output of control: {formats}", {outputs});
      $finish_and_return(1);
    end
  end
"""


def registers(netlist):
    """Registers and memories: name, and the places of a memory from the lowest to the highest, None for a register.

    Raises RuntimeError where a declaration is not understood.
    """
    found = REGISTER.findall(netlist)
    if len(found) != len(re.findall(r"^ *reg\b", netlist, re.M)):
        raise RuntimeError("the netlist has declarations of registers of another form")
    return [(name, (min(int(a), int(b)), max(int(a), int(b))) if a else None) for name, a, b in found]


def forgotten(netlist):
    """Statements that make every register and memory of the netlist X again."""
    for name, places in registers(netlist):
        reg = f"netlist.{name} "
        if places:
            yield f"for (place = {places[0]}; place <= {places[1]}; place = place + 1) {reg}[place] = 'bx;"
        else:
            yield f"{reg}= 'bx;"


def address(text):
    """What stands within the first brackets of a text, and what follows them."""
    depth, begin = 0, text.index("[")
    for i, letter in enumerate(text):
        depth += (letter == "[") - (letter == "]")
        if letter == "]" and not depth:
            return text[begin + 1 : i].strip(), text[i + 1 :]
    raise RuntimeError(f"no end of an address: {text}")


def unknown_writes(netlist):
    """The netlist, in which a write that may happen, or happens anywhere, leaves X wherever it may have gone.

    Verilog takes an unknown enable for no, and drops a write to an unknown address: a memory would know too much.
    """
    memories = {name: places for name, places in registers(netlist) if places}
    lines, condition = [], None
    for line in netlist.split("\n"):
        lines.append(line)
        found, before = WRITE.match(line), condition
        condition = line.strip()[3:] if line.strip().startswith("if (") else None
        if not (found and "<=" in line and (name := found[1].strip()) in memories):
            if "<=" in line and re.split(r"[ \[]", line.strip().removeprefix("else "))[0] in memories:
                raise RuntimeError(f"the netlist has a write of another form: {line.strip()}")
            continue
        (at, rest), (low, high) = address(line[found.end() - 1 :]), memories[name]
        part, when = rest.split("<=")[0].strip(), before or "1'b1"
        if not CONSTANT.match(at):
            each = f"for (spot = {low}; spot <= {high}; spot = spot + 1)"
            lines.append(f"    if ({when} !== 1'b0 && ^({at} ) === 1'bx) {each} {name} [spot]{part} <= 'bx;")
        lines.append(f"    if (^({when}) === 1'bx) {name} [{at} ]{part} <= 'bx;")
    text = "\n".join(lines)
    return re.sub(r"^(module [^;]*;)", r"\1\n  integer spot;", text, count=1, flags=re.M)


def shell(toplevel, ports, values, netlist):
    """Verilog text of a module ``toplevel`` without ports, around ``<toplevel>_netlist``.

    What were ports are registers, so an input is X until a test sets it, and wires; unpacked arrays have one dimension,
    their elements in the order of the source.
    """
    lines = ["`timescale 1ns / 1ns", f"module {toplevel};", "  reg was_reset = 1'b0;"]
    lines += [f"  localparam {name} = {value};" for name, value in values]
    flat = []
    for name, given, width, count, scalar in ports:
        kind, bits = "reg" if given else "wire", "" if scalar else f"[{width - 1}:0] "
        if count is None:
            lines.append(f"  {kind} {bits}{name};")
            flat.append(f".{name}({name})")
            continue
        elements = [f"{name}[{i}]" for i in range(count)]
        lines += [f"  {kind} {bits}{name} [0:{count - 1}];", f"  wire [{width * count - 1}:0] flat_{name};"]
        if given:
            lines.append(f"  assign flat_{name} = {{{', '.join(elements)}}};")
        else:  # the first element is the most significant
            at = [(count - 1 - i) * width for i in range(count)]
            lines += [f"  assign {e} = flat_{name}[{a}+:{width}];" for e, a in zip(elements, at, strict=True)]
        flat.append(f".{name}(flat_{name})")
    lines.append(f"  {toplevel}_netlist netlist ({', '.join(flat)});")
    lines.append(FORGET.format(registers="\n".join(f"    {line}" for line in forgotten(netlist))))
    names = [name for name, *_ in ports]
    watched = [name for name, given, *_ in ports if not given and CONTROL.search(name)]
    if watched and "rst_ni" in names:
        formats = ", ".join(f"{name} = %b" for name in watched)
        lines.append(WATCH.format(outputs=", ".join(watched), formats=formats))
    return "\n".join([*lines, "endmodule", ""])
