"""Both closing kernels against the slow reference on random cases; every disagreement is run again, finer and aside.

    python3 dev.py validate closing [CASES [SEED]]

The cases are those of tests/reference/closing_cases.py. Compared are the word (caught, escaped, missed, invalid),
structural against frictional where both decide, and the end pose.
"""

from __future__ import annotations

import itertools
import sys
import time
from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from multiprocessing import Pool
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))

from reference.closing_cases import Answer, Question, apart, by_events, by_reference, by_steps, questions
from reference.slow_closing import COARSE, FINE

TOLERANCE = 0.01
"""End poses agree within this share of the object's size (and this angle in rad)."""
ASIDE = 1e-3
"""How far, in sizes of the object, a start is moved to see whether it lies at a boundary."""
QUICK, LONG = replace(COARSE, most_steps=120_000), replace(FINE, most_steps=500_000)
STIFF, WEAK = replace(QUICK, stiffness=1e9, smallest_step=1e-12), replace(QUICK, stall=1e2)
DECIDED = ("structural", "frictional")
KERNELS: dict[str, Callable[[Question], Answer]] = {"events": by_events, "steps": by_steps}


@dataclass(frozen=True)
class Row:
    """One question, what the reference says and what the kernels say."""

    number: int
    question: Question
    reference: Answer
    kernels: dict[str, Answer]


@dataclass(frozen=True)
class Difference:
    """A kernel and the reference differ: in what, and why."""

    row: Row
    kernel: str
    what: str
    cause: str


def ask(numbered: tuple[int, Question]) -> Row:
    """The answers of all that take the question."""
    number, question = numbered
    kernels = {name: answer(question) for name, answer in KERNELS.items() if name == "steps" or question.by_events}
    return Row(number, question, by_reference(question, QUICK), kernels)


def differs(one: Answer, other: Answer, size: float) -> str:
    """In what two answers differ; empty if in nothing."""
    if "undecided" in (one.outcome, other.outcome):
        return ""
    if one.word != other.word:
        return f"{one.outcome} / {other.outcome}"
    if one.outcome != other.outcome and one.outcome in DECIDED and other.outcome in DECIDED:
        return f"{one.outcome} / {other.outcome}"
    far = apart(one, other, size)
    return f"end pose by {far:.3f}, both {one.outcome}" if far > TOLERANCE else ""


def explain(task: tuple[Row, str, str]) -> Difference:
    """Why a kernel and the reference differ: from finer runs of both and from starts a little aside."""
    row, name, what = task
    question, kernel = row.question, row.kernels[name]
    size = question.size
    if {kernel.outcome, row.reference.outcome} == {"caged", "escaped"} and apart(kernel, row.reference, size) < 0.1:
        return Difference(row, name, what, "definition of caged")
    fine, finer = by_reference(question, LONG), by_steps(question, 1e-9)
    if not differs(fine, kernel, size):
        return Difference(row, name, what, "reference: too coarse")
    if fine.word == kernel.word and apart(fine, kernel, size) < 0.5 * apart(row.reference, kernel, size):
        return Difference(row, name, what, f"reference: rounded corners, {apart(fine, kernel, size):.3f} when finer")
    if not differs(fine, finer, size):
        return Difference(row, name, what, "kernel: its tolerance")
    moved = [question.moved(*each) for each in steps_aside(size)]
    beside = [by_steps(each) for each in moved]
    words = {(each.word, each.outcome if each.outcome in DECIDED else "") for each in beside}
    if len(words) > 1:
        return Difference(row, name, what, "near a boundary: both outcomes within a thousandth of the size")
    far = apart(row.reference, kernel, size)
    spread = max(apart(each, kernel, size) for each in beside)
    other = [apart(by_reference(each, QUICK), row.reference, size) for each in moved[:4]]
    if max(spread, *other) > 0.5 * far:
        return Difference(row, name, what, f"sensitive: a thousandth of the size aside the end moves by {spread:.3f}")
    stiff, weak = by_reference(question, STIFF), by_reference(question, WEAK)
    if not differs(stiff, kernel, size) or not differs(weak, kernel, size):
        return Difference(row, name, what, "reference: its contacts give way under the load at which it stalls")
    if max(apart(stiff, row.reference, size), apart(weak, row.reference, size)) > 0.2 * far:
        return Difference(row, name, what, "reference: depends on the load at which it stalls")
    if kernel.flags & 1:
        return Difference(row, name, what, "several motions admissible")
    return Difference(row, name, what, f"unexplained; finer reference {fine.outcome} {apart(fine, kernel, size):.3f}")


def steps_aside(size: float) -> Iterator[tuple[float, float, float]]:
    """Small displacements in every direction; first those that lift a touching start off the hand."""
    for x, y, turn in itertools.product((0.0, 1.0, -1.0), (1.0, 0.0), (0.0, 1.0, -1.0)):
        if (x, y, turn) != (0.0, 0.0, 0.0):
            yield ASIDE * size * x, ASIDE * size * y, ASIDE * turn


def confusion(rows: list[Row], name: str) -> None:
    """How often which outcome met which."""
    counts = Counter((row.reference.outcome, row.kernels[name].outcome) for row in rows if name in row.kernels)
    across = sorted({kernel for _, kernel in counts})
    print(f"\n{name} kernel, {sum(counts.values())} cases\n\n| reference | " + " | ".join(across) + " |")
    print("|---" * (len(across) + 1) + "|")
    for outcome in sorted({reference for reference, _ in counts}):
        print(f"| {outcome} | " + " | ".join(str(counts[outcome, each] or "") for each in across) + " |")


def distances(rows: list[Row], name: str) -> None:
    """How far the end poses are apart."""
    print("\n| | cases | median | 90 % | 98 % | largest |\n|---|---|---|---|---|---|")
    for polygon, group in itertools.product((False, True), (("held", DECIDED), ("lost", ("escaped", "jammed")))):
        far = [
            apart(row.reference, row.kernels[name], row.question.size)
            for row in rows
            if name in row.kernels and bool(row.question.vertices) == polygon
            and row.kernels[name].outcome in group[1] and row.reference.outcome in group[1]
        ]  # fmt: skip
        if far:
            cells = " | ".join(f"{each:.1e}" for each in np.quantile(far, [0.5, 0.9, 0.98, 1.0]))
            print(f"| {'polygons' if polygon else 'disks'}, {group[0]} | {len(far)} | {cells} |")


def main(number: int, seed: int) -> int:
    """Print the comparison; returns the number of differences without an explanation."""
    asked = list(enumerate(questions(number, seed)))
    warm = [next(each for each in asked if bool(each[1].vertices) == kind) for kind in (True, False)]
    for each in [*warm, next(each for each in asked if each[1].by_events)]:
        ask(each)
    begin = time.perf_counter()
    with Pool(2) as pool:
        rows = list(pool.imap(ask, asked))
        print(f"{number} cases, seed {seed}: {time.perf_counter() - begin:.0f} s", flush=True)
        tasks = [
            (row, name, what)
            for row in rows
            for name, answer in row.kernels.items()
            if (what := differs(row.reference, answer, row.question.size))
        ]
        found = list(pool.imap(explain, tasks))
    for name in KERNELS:
        confusion(rows, name)
        distances(rows, name)
    print(
        f"\n{len(found)} differences\n\n| case | object | kernel | reference / kernel | cause |\n|---|---|---|---|---|"
    )
    for each in found:
        corners = len(each.row.question.vertices)
        thing = f"{corners} corners" if corners else "disk"
        print(f"| {each.row.number} | {thing} | {each.kernel} | {each.what} | {each.cause} |")
    print("\n| cause | differences |\n|---|---|")
    for cause, count in Counter(each.cause.split(",")[0].split(":")[0] for each in found).most_common():
        print(f"| {cause} | {count} |")
    print(f"\n{time.perf_counter() - begin:.0f} s in all")
    return sum(each.cause.startswith("unexplained") for each in found)


if __name__ == "__main__":
    given = [int(word) for word in sys.argv[1:]]
    sys.exit(min(main(*(given + [400, 20261126][len(given) :])), 1))
