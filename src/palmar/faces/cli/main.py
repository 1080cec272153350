"""The command ``palmar``: parse, call, print. Exit status 0 done, 1 the answer is no (with --check), 2 bad input."""

from __future__ import annotations

import os
import sys

from cyclopts import App, CycloptsError

from palmar.errors import PalmarError
from palmar.faces.cli.printing import AnswerIsNo, one_line

app = App(
    name="palmar",
    help="Robot hands that close on things they cannot see well: what they can hold, and from where they catch it.",
    version_flags=["--version"],
)
for name, summary in {
    "closure": "Can this hand hold it, which radii can it hold, and what would have to change.",
    "region": "From where the closing motion catches the object.",
    "simulate": "What becomes of an object that starts here.",
    "validate": "A region put to the test: random starts inside and outside of it, in a world.",
    "testbed": "The planar test bed of the source: pre-images found by trial and error.",
    "cell": "The 3-D cell: a Puma with the Salisbury hand picks up or catches a cylinder.",
    "plan": "Approaches by touch that certainly end in a grasp.",
    "tips": "Three fingertips from above: from where they catch a cylinder, plans by touch, toppling.",
    "touch": "What the hand's sensors buy, and how few would do.",
    "behaviours": "What the hand can be told to do, and a run of it under feedback.",
    "preshape": "The distal angle with which a disk rides on the finger.",
    "strategies": "Which way of closing two joints a finger catches from most.",
    "impact": "How hard a finger strikes the object, and what softens that.",
    "push": "Where a round pusher leaves the object.",
    "identify": "Friction and pressure from recorded pushes.",
    "sweep": "One case made millions: a table of answers in Parquet files, and questions to it.",
    "design": "The smallest hand for what it is to hold and to tolerate, or why there is none.",
    "report": "One self-contained page with pictures and tables: closure and region of a case.",
    "studio": "See the hand, drag it, and know what it catches: a web page.",
    "cases": "The shipped cases, or one of them printed.",
    "figures": "Every figure of the source's chapters, drawn anew.",
}.items():
    app.command(f"palmar.faces.cli.{name}:app", name=name, help=summary)


def run(words: list[str] | None = None) -> None:
    """Run the command line and leave with its exit status; every error is one plain line on stderr."""
    try:
        app(words, exit_on_error=False, print_error=False, result_action="return_value")
    except AnswerIsNo:
        sys.exit(1)
    except (CycloptsError, PalmarError) as error:
        print(f"palmar: {one_line(str(error))}", file=sys.stderr)
        sys.exit(2)
    except KeyboardInterrupt:
        print("palmar: interrupted", file=sys.stderr)
        sys.exit(130)
    except BrokenPipeError:
        # The reader of our output has gone; a second failure while Python flushes stdout must stay silent.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        sys.exit(141)


if __name__ == "__main__":
    run()
