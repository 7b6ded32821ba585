"""The command line: ``sgim COMMAND …``, one file a command in `commands`.

Exit codes: 0, all is well; 1, a run or a journal failed; 2, the command cannot be understood or
names something unknown; 130, interrupted.
"""

from __future__ import annotations

import os
import shutil
import sys
import warnings
from collections.abc import Sequence
from importlib import import_module
from importlib.metadata import version
from inspect import cleandoc
from textwrap import fill
from typing import Any, TextIO

from sgim.errors import JournalError, SgimError, unknown

COMMANDS = {
    "list": "What there is: experiments, learners, configurations, teachers.",
    "run": "Run a learner in an experiment.",
    "resume": "Go on with a run that was stopped, or extend one.",
    "show": "What a run did: errors and choices, also while it goes on.",
    "answer": "Ask what was learned: the policy for a goal.",
    "watch": "A page that shows what runs do, also while they go on.",
    "teach": "A page where you teach a learner yourself.",
    "sweep": "Run many learners with many seeds side by side.",
    "compare": "Which learner is better over its seeds, and whether that could be chance.",
    "claims": "What is claimed of learners, and whether runs bear it out.",
    "reproduce": "Make a chapter of the thesis again: runs, figures, claims, a report.",
    "export": "Runs as tables of trials, episodes and evaluations.",
    "plot": "Draw errors, choices and explored outcomes.",
}

HELP = """\
usage: sgim COMMAND …

Learners that choose what to aim at, how to learn it, when to ask, and from whom.

{commands}

A first tour, of a few seconds:
  sgim run throwing
  sgim plot runs/throwing-sgim-acts-0.sgim --out figures
  sgim answer runs/throwing-sgim-acts-0.sgim --goal throw=6.5,2.0

More on a command: sgim COMMAND --help. The version: sgim --version.
"""


def main(arguments: Sequence[str] | None = None) -> int:
    """Carry out one command.

    Args:
        arguments: What follows ``sgim`` on the command line; None for those of this process.

    Returns:
        The exit code.
    """
    given = list(sys.argv[1:] if arguments is None else arguments)
    with warnings.catch_warnings():
        warnings.showwarning = _warn
        try:
            code = _dispatch(given)
            sys.stdout.flush()
            return code
        except KeyboardInterrupt:
            print("sgim: interrupted", file=sys.stderr)
            return 130
        except BrokenPipeError:
            # Whoever read our output has gone; Python would complain again when it ends.
            os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
            return 1
        except SgimError as error:
            print(f"sgim: {error}", file=sys.stderr)
            return _exit_code(error)


def _dispatch(given: list[str]) -> int:
    if not given or given[0] in ("-h", "--help"):
        width = max(map(len, COMMANDS))
        lines = [f"  {name:{width}}  {line}" for name, line in COMMANDS.items()]
        print(HELP.format(commands="\n".join(lines)), end="")
        return 0
    name, *rest = given
    if name == "--version":
        print(f"sgim {version('sgim')}")
        return 0
    if name not in COMMANDS:
        raise unknown("command", name, COMMANDS)
    import tyro

    command = import_module(f"sgim.cli.commands.{name}").command
    try:
        code: int | None = tyro.cli(
            command,
            prog=f"sgim {name}",
            description=_description(command.__doc__ or ""),
            args=rest,
            config=(tyro.conf.FlagCreatePairsOff,),
        )
    except SystemExit as stop:  # after help, or a mistake that the parser has explained
        return stop.code if isinstance(stop.code, int) else 0
    return code or 0


def _description(docstring: str) -> str:
    """What a command's docstring says before its arguments, wrapped for the terminal."""
    width = min(100, shutil.get_terminal_size().columns)
    parts = cleandoc(docstring).partition("\n\nArgs:")[0].split("\n\n")
    # The parser joins lines that are not indented.
    return "\n\n".join(
        part if "\n  " in part else fill(part, width, subsequent_indent="  ") for part in parts
    )


def _exit_code(error: SgimError) -> int:
    from sgim.policy.competence import NoAnswerError
    from sgim.runs import RunError

    return 1 if isinstance(error, JournalError | RunError | NoAnswerError) else 2


def _warn(
    message: Warning | str,
    category: type[Warning],
    filename: str,
    lineno: int,
    file: TextIO | None = None,
    line: str | None = None,
) -> Any:
    print(f"sgim: warning: {message}", file=file or sys.stderr)
