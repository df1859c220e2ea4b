# SPDX-License-Identifier: Apache-2.0
"""The constants of a spiral, loaded word by word: each goes to its field, nothing else changes."""

import cocotb
from cocotb.triggers import FallingEdge

import bench
from raydix.formats import FORM, FORM_WORDS


def kept(index, word):
    """What the field of word ``index`` keeps of it."""
    field = [field for field in FORM for _ in range(field.count)][index]
    return bench.signed(word, field.width) if field.token[0] == "s" else word & ((1 << field.width) - 1)


@cocotb.test
async def loads(dut):
    """All words in random order; then any, some without load_i, some beyond the last: form_o has those loaded."""
    random = bench.rng()
    form_o = bench.Port(dut, "form_o", bench.FORM)
    expected = [0] * FORM_WORDS
    await bench.start(dut)
    order = [(index, 1) for index in random.sample(range(FORM_WORDS), FORM_WORDS)]
    order += [(random.randrange(64), random.getrandbits(1)) for _ in range(4000)]
    for number, (index, load) in enumerate(order):
        word = random.choice((random.getrandbits(64), random.getrandbits(64), (1 << 64) - 1, 0))
        dut.load_i.value, dut.index_i.value, dut.word_i.value = load, index, word
        await FallingEdge(dut.clk_i)
        if load and index < FORM_WORDS:
            expected[index] = kept(index, word)
        words = form_o.words(bench.form_fields(expected))
        if number >= FORM_WORDS - 1 and words != form_o.read():
            inputs = {"load_i": load, "index_i": index, "word_i": word}
            raise bench.mismatch(number, inputs, form_o.differences(words, form_o.read()))


def test_form():
    """Every word of the form."""
    bench.run(__name__, "rdx_form")
