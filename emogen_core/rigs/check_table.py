"""What `check_rig` found, as text: a table of the heads and a verdict on every bar. Markdown, as docs hold it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Sequence

_HEADER = (
    "identity", "collided: lips / teeth / any, %", "mm before: mean, median, p90, p99, max",
    "mm after: mean, median, p90, p99, max", "over 0.5 mm before / after, %", "ms: mean / p99", "wall ms", "neutral mm",
)  # fmt: skip

_HEAD_HEADER = (
    "identity", "mm2 of eyeball at full blink: alone / worst with a gene", "mm through half-shut lids",
    "iris under lids: upper / lower", "brow mm", "teeth mm2: at rest / shut genes / closed emotions", "lip gap mm",
    "corners mm",
)  # fmt: skip


def check_text(report: dict[str, Any]) -> str:
    """Return the report of `check_rig` for reading."""
    told = ", ".join(f"{count} {name.replace('_', ' ')}" for name, count in report["counts"].items())
    head = f"{report['name']}: {told}.\n{report['faces']} random faces a head, seed {report['seed']}."
    return "\n\n".join(
        [head, *filter(None, [_collisions(report), _combinations(report), _heads(report), _bars(report)])]
    )


def _collisions(report: dict[str, Any]) -> str:
    rows = [_collision_row(name, r["collisions"]) for name, r in report["identities"].items() if "collisions" in r]
    return table(_HEADER, rows) if rows else ""


def _collision_row(identity: str, found: dict[str, Any]) -> tuple[str, ...]:
    before, after = found["depth_before_mm"], found["depth_after_mm"]
    times = found["milliseconds"]
    return (
        f"`{identity}`",
        " / ".join(f"{100 * share:.1f}" for share in found["collided"].values()),
        ", ".join(f"{value:.2f}" for value in before.values()),
        ", ".join(f"{value:.2f}" for value in after.values()),
        f"{100 * found['over_half_mm_before']:.1f} / {100 * found['over_half_mm_after']:.1f}",
        f"{times['processor']['mean']:.1f} / {times['processor']['p99']:.1f}",
        f"{times['wall']['mean']:.1f} / {times['wall']['p99']:.1f}",
        f"{found['neutral_mm']:.2f}",
    )


def _combinations(report: dict[str, Any]) -> str:
    rows = [_combination_row(name, r["combinations"]) for name, r in report["identities"].items()]
    rows.append(_combination_row("all heads", report["all heads"]["combinations"]))
    return table(("identity", "flipped", "folded", "overstretched", "faces better / worse"), rows)


def _combination_row(identity: str, found: dict[str, Any]) -> tuple[str, ...]:
    means = (f"{found['without'][k]:.2f} -> {found['with'][k]:.2f}" for k in ("flips", "folds", "stretched"))
    return f"`{identity}`", *means, f"{found['faces_better']} / {found['faces_worse']}"


def _heads(report: dict[str, Any]) -> str:
    rows = [_head_row(name, r["head"]) for name, r in report["identities"].items() if "head" in r]
    return table(_HEAD_HEADER, rows) if rows else ""


def _head_row(identity: str, found: dict[str, Any]) -> tuple[str, ...]:
    blink = f"{found['visible_at_blink_mm2']:.2f} / {found['visible_worst_mm2']:.2f}"
    covers = f"{found['upper_lid_cover']:.2f} / {found['lower_lid_cover']:.2f}"
    teeth = " / ".join(f"{found[k]:.2f}" for k in ("teeth_mm2", "shut_teeth_mm2", "closed_emotion_teeth_mm2"))
    lips = (teeth, f"{found['lip_gap_mm']:.2f}", f"{found['corner_height_mm']:.1f}")
    return f"`{identity}`", blink, f"{found['poke_mm']:.2f}", covers, f"{found['brow_height_mm']:.1f}", *lips


def _bars(report: dict[str, Any]) -> str:
    rows = [
        (bar["bar"], f"{bar['rule']} {bar['limit']}", f"{bar['worst']} ({bar['identity']})", _verdict(bar))
        for bar in report["bars"]
    ]
    return table(("bar", "wanted", "worst", "verdict"), rows)


def _verdict(bar: dict[str, Any]) -> str:
    return "met" if bar["met"] else "MISSED"


def table(header: tuple[str, ...], rows: Sequence[tuple[str, ...]]) -> str:
    """Return a Markdown table whose columns line up."""
    lines = [header, *rows]
    widths = [max(len(line[column]) for line in lines) for column in range(len(header))]
    lines.insert(1, tuple("-" * width for width in widths))
    shown = (" | ".join(cell.ljust(width) for cell, width in zip(line, widths, strict=True)) for line in lines)
    return "\n".join(f"| {line} |" for line in shown)
