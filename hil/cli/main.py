"""The `hil` command: how it begins, and how it ends."""

import os
import signal
import sys
from collections.abc import Sequence

from hil.cli.errors import INTERRUPTED, said, status
from hil.cli.interrupts import heard


def call(arguments: Sequence[str], signals: Sequence[int] = ()) -> int:
    """Run one command line; its exit status. Known errors become one line on stderr.

    signals: those that asked the command to end, as they come.
    """
    try:
        from hil.cli.commands import build  # noqa: PLC0415  so that a Ctrl-C meets `heard` first

        code = build()(list(arguments), prog_name="hil", standalone_mode=False) or 0
    except BaseException as error:
        known = INTERRUPTED if signals else status(error)
        if known is None:
            raise
        if known != INTERRUPTED:
            print(said(error), file=sys.stderr)
        code = known
    return _interrupted(signals) if code == INTERRUPTED else code


def _interrupted(signals: Sequence[int]) -> int:
    """Say what ended the command; the exit status as a shell reports it."""
    terminated = signal.SIGTERM in signals
    print(f"hil: {'terminated' if terminated else 'interrupted'}", file=sys.stderr)
    return 128 + signal.SIGTERM if terminated else INTERRUPTED


def main() -> None:
    # MuJoCo fails to import where the OpenGL named here is missing; a cell needs none, and
    # hil.view.scene draws in a process that chooses its own.
    os.environ["MUJOCO_GL"] = "off"
    with heard() as signals:
        code = call(sys.argv[1:], signals)
    sys.exit(code)
