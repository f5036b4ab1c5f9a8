"""The table of an appearance's parameters, as the documentation shows it."""

from __future__ import annotations

from emogen_core.face.appearance import parameters


def appearance_table() -> list[str]:
    """Return the lines of a Markdown table, one row a field of `Appearance`."""
    rows = [
        f"| `{field['name']}` | {_range(field)} | {_shown(field['default'])} | {field['meaning']} |"
        for field in parameters()
    ]
    return ["| parameter | from, to | default | what |", "| --- | --- | --- | --- |", *rows]


def _range(field: dict[str, object]) -> str:
    return f"{field['low']:g}, {field['high']:g}" if "low" in field else "sRGB"


def _shown(default: object) -> str:
    return f"{default:g}" if isinstance(default, float) else str(default)


if __name__ == "__main__":
    print("\n".join(appearance_table()))
