# SPDX-License-Identifier: Apache-2.0
"""Options of every command that takes a scene: the size of the picture and the processor that makes it."""

import argparse
from pathlib import Path

from .command import INTEGER, image_size
from .config import RULES, Config, ConfigError
from .fit import families, frame_parameters
from .scene import Scene, load_scene

REFERENCE_DIGITS = 24


def add_scene_options(parser: argparse.ArgumentParser) -> list[argparse.Action]:
    """Add them; returns them."""
    add = parser.add_argument
    return [
        add("--rule", choices=RULES, default="certified", help="how a cell is chosen (default: certified)"),
        add("--n1", type=INTEGER, default=3, metavar="N", help="digits fixed per step, 1 to 4 (default: 3)"),
        add("--steps", type=INTEGER, metavar="K", help="steps to a hit (default: as many as make 24 digits)"),
        add("--k-stop", type=INTEGER, metavar="K", help="steps to a hit in this frame (default: all)"),
        add("--width", type=INTEGER, default=36, metavar="W", help="bits of a control point (default: 36)"),
        add("--units", type=INTEGER, metavar="U", help="step units of an RTL ring (default: 8, at most K)"),
        add("--rings", type=INTEGER, default=1, metavar="N", help="rings side by side (default: 1)"),
        add(
            "--halve-stages", type=INTEGER, metavar="N", help="clocks of a halving (default: two rows of averages each)"
        ),
        add("--lanes", type=INTEGER, metavar="N", help="evaluators of a vector-sum step unit (default: J - 1)"),
        add(
            "--vector-units", type=INTEGER, default=1, metavar="U", help="step units in a vector-sum ring (default: 1)"
        ),
        add(
            "--vector-drop",
            type=INTEGER,
            default=0,
            metavar="N",
            help="digits that its evaluators leave away (default: 0)",
        ),
        add("--vector-rings", type=INTEGER, default=1, metavar="N", help="vector-sum rings (default: 1)"),
        add("--beat", type=INTEGER, default=1, metavar="P", help="pixels in a beat of the RTL (default: 1)"),
        add("--size", type=image_size, metavar="WxH", help="image size instead of the scene's"),
    ]


def scene_of(args: argparse.Namespace, path: Path) -> Scene:
    """The scene in the size asked for. Raises SceneError."""
    return load_scene(path, *(args.size or (None, None)))


def config_of(args: argparse.Namespace, scene: Scene) -> Config:
    """The configuration asked for; only the rule that is used and the families that the scene needs are built.

    Raises ConfigError.
    """
    if not 1 <= args.n1 <= 4:
        raise ConfigError(f"n1: found {args.n1}; allowed: 1 to 4")
    steps = REFERENCE_DIGITS // args.n1 if args.steps is None else args.steps
    units = max(1, min(8, steps)) if args.units is None else args.units
    return Config(
        n1=args.n1,
        steps=steps,
        k_stop=args.k_stop,
        width=args.width,
        units=units,
        rules=args.rule,
        rule=args.rule,
        lanes=args.lanes,
        vector_units=args.vector_units,
        vector_drop=args.vector_drop,
        rings=args.rings,
        halve_stages=args.halve_stages,
        vector_rings=args.vector_rings,
        **families(scene),
        **frame_parameters(scene, args.beat),
    )


def given(args: argparse.Namespace) -> list[str]:
    """The words of a command line that choose the same: those of ``args`` that are not the default."""
    words = []
    for action in add_scene_options(argparse.ArgumentParser()):
        value = getattr(args, action.dest)
        if value != action.default:
            text = f"{value[0]}x{value[1]}" if action.dest == "size" else str(value)
            words += [action.option_strings[0], text]
    return words
