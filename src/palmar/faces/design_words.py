"""The answer of `palmar design` in words; lengths in mm."""

from __future__ import annotations

from math import degrees

from palmar.faces.cli.texts import notes, table
from palmar.faces.words import Row
from palmar.models.behaviour import Behaviour, BehaviourName
from palmar.models.design_brief import DesignBrief
from palmar.studies.design.bounds import Bound
from palmar.studies.design.design import Design, Option


def design_text(name: str, found: Design, *, by_links: bool) -> str:
    """The hand and what it does, or why there is none; ``by_links``: a row for each number of links, too."""
    parts = [f"{name}: {brief_words(found.brief)}"]
    parts.append(table(design_rows(found)) if found.chosen is not None else impossible_words(found))
    if by_links:
        heads: Row = ("links a finger", "smallest hand", "")
        parts.append(table([heads, *map(link_row, found.options)]))
        parts.append(fewest_words(found))
    if found.front:
        heads = ("hand, mm", "tolerated error, mm")
        parts.append(table([heads, *((f"{1e3 * size:.1f}", f"{1e3 * error:.1f}") for size, error in found.front)]))
    return "\n".join(["\n\n".join(parts), *notes(found.notes)])


def impossible_words(found: Design | Bound) -> str:
    """The sentence for a brief that no hand meets, and what it rests on."""
    proof = "proven by closed forms" if found.proven else "found by a search, not proven"
    return f"Impossible, because {found.because} ({proof})."


def fewest_words(found: Design) -> str:
    """The answer to how many links a finger it takes."""
    fewest = found.fewest_links
    return "No number of links will do." if fewest is None else f"Fewest links that will do: {fewest}."


def brief_words(brief: DesignBrief) -> str:
    """One line: what is asked for."""
    targets = brief.targets
    if targets.radii is not None:
        low, high = (f"{1e3 * end:.4g}" for end in targets.radii)
        what = f"disks of radius {low} mm" if low == high else f"disks of radius {low} to {high} mm"
    else:
        what = f"a polygon of {len(targets.vertices or ())} corners"
    low, high = (f"{end:.4g}" for end in targets.friction)
    rough = f"friction {low}" if low == high else f"friction {low} to {high}"
    where = "on a table" if targets.support.value == "table" else "floating"
    if targets.error == 0.0:
        return f"hold {what}, {rough}"
    found = f"catch {what} {where}, {rough}, up to {1e3 * targets.error:.4g} mm off"
    return found if targets.sensors is None else f"{found}, in at most {targets.approaches_max} approaches by touch"


def design_rows(found: Design) -> list[Row]:
    """What the chosen hand is, does and was put to; empty where there is none."""
    chosen = found.chosen
    if chosen is None or chosen.hand is None:
        return []
    hand = chosen.hand
    links = " + ".join(f"{1e3 * each:.2f}" for each in hand.finger_links)
    rows: list[Row] = [
        ("palm", f"{1e3 * hand.palm_width:.2f} mm"),
        ("fingers", f"{links} mm"),
        ("palm and both fingers", f"{1e3 * (chosen.size or 0.0):.2f} mm"),
    ]
    if chosen.does.name is not BehaviourName.CLOSE:
        rows.insert(2, ("how they close", closing_words(chosen.does)))
    if found.least is not None:
        rows.append(("no hand is shorter than", f"{1e3 * found.least:.2f} mm, by closed forms"))
    if found.error is not None and chosen.place is not None:
        x, y = (1e3 * each for each in chosen.place)
        rows.append(("tolerated error", f"{1e3 * found.error:.2f} mm about ({x:.1f}, {y:.1f}) mm"))
    rows.append(("what binds", ", ".join(found.binds) or "nothing stated"))
    if found.guarantee is not None:
        rows.append(("guarantee", f"{found.guarantee.value}: {found.guarantee.meaning}"))
    if found.verification is not None:
        rows.append(("tried", f"{found.verification.cases} random cases, {found.verification.violations} lost"))
    return rows


def closing_words(does: Behaviour) -> str:
    """How a designed hand closes."""
    if does.name is BehaviourName.CLOSE:
        return "straight"
    return f"curl the distal joints to {degrees(does.preshape):.1f} deg, then close"


def link_row(option: Option) -> Row:
    """The smallest hand with so many links a finger, or why there is none."""
    if option.size is None:
        return str(option.links), "none", option.because or ""
    assert option.hand is not None
    lengths = " + ".join(f"{1e3 * each:.2f}" for each in option.hand.finger_links)
    return (
        str(option.links),
        f"{1e3 * option.size:.2f} mm",
        f"palm {1e3 * option.hand.palm_width:.2f}, fingers {lengths}, {closing_words(option.does)}",
    )
