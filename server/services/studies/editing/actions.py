"""What the buttons inside the form do: rows come, go and change places; everything that is typed stays as it is."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ...errors import InvalidError
from .compounds import VARIANT, Group, Keyed, OneOf, Rows, Switch
from .given import MOST_ROWS, Fields, Given, gathered
from .head import DOCUMENT, HEAD, PRESET, Head

if TYPE_CHECKING:
    from collections.abc import Callable

    from .form import StudyForm
    from .shape import Shape


def act(form: StudyForm, fields: Fields, command: str) -> tuple[Fields, str]:
    """Return the form after a button was pressed, and the name of what the eye should be on.

    Args:
        form: what the fields mean.
        fields: what is typed.
        command: an action, a colon and the name of a list or row: `add:emotions`, `add:blocks:rate`, `up:blocks.3`.

    Raises:
        InvalidError: there is no such button.
    """
    action, _, target = command.partition(":")
    work = _ACTIONS.get(action)
    if work is None:
        raise InvalidError("There is no such button.", field="do", got=command)
    return work(form, {name: list(values) for name, values in fields.items()}, target)


def _add(form: StudyForm, fields: Fields, target: str) -> tuple[Fields, str]:
    name, _, kind = target.partition(":")
    shape = _list(form, fields, name)
    keys = Given(fields).rows(name)
    if len(keys) >= MOST_ROWS:
        raise InvalidError("The list is full.", field=name, expected=f"at most {MOST_ROWS}", got=len(keys))
    key = str(max((int(key) for key in keys), default=-1) + 1)
    added = gathered(shape.row(name, key, shape.new(kind)))
    fields[name] = [*keys, *added.pop(name)]
    made = {**fields, **added}
    return {**made, **(_own_words(form, made, f"{name}.{key}") if name == "translations" else {})}, f"{name}.{key}"


def _own_words(form: StudyForm, fields: Fields, translation: str) -> Fields:
    """Return empty rows for everything that the study says in its own words; what stays empty is not translated."""
    plain = form.read(fields).plain
    emotions = [*plain["emotions"], *filter(None, [plain["practice"]])]
    found: Fields = {}
    for part, words in (
        ("emotions", [one["adjective"] for one in emotions]),
        ("words", [word for block in plain["blocks"] for word in _said(block)]),
    ):
        shape = _list(form, fields, f"{translation}.{part}")
        for row, word in enumerate(filter(None, dict.fromkeys(words))):
            if isinstance(shape, Keyed):
                pairs = shape.row(f"{translation}.{part}", str(row), shape.new(""), word)
                for name, value in pairs:
                    found.setdefault(name, []).append(value)
    return found


def _said(part: Any) -> list[str]:
    """Return what participants read of a block, in order."""
    if isinstance(part, list):
        return [word for one in part for word in _said(one)]
    if not isinstance(part, dict):
        return []
    words: list[str] = []
    for name, value in part.items():
        if name in _READ:
            words.extend(value if isinstance(value, list) else [value])
        else:
            words.extend(_said(value))
    return words


_READ = {"title", "text", "options", "labels", "low", "high"}
"""Fields of a block that hold words for participants."""


def _remove(form: StudyForm, fields: Fields, target: str) -> tuple[Fields, str]:
    name, keys, place = _row(form, fields, target)
    fields[name] = [*keys[:place], *keys[place + 1 :]]
    left = {one: values for one, values in fields.items() if not one.startswith(f"{target}.") and one != target}
    near = fields[name][min(place, len(fields[name]) - 1)] if fields[name] else ""
    return left, f"{name}.{near}" if near else name


def _up(form: StudyForm, fields: Fields, target: str, step: int = -1) -> tuple[Fields, str]:
    name, keys, place = _row(form, fields, target)
    other = place + step
    if 0 <= other < len(keys):
        keys[place], keys[other] = keys[other], keys[place]
    fields[name] = keys
    return fields, target


def _down(form: StudyForm, fields: Fields, target: str) -> tuple[Fields, str]:
    return _up(form, fields, target, 1)


def _custom(form: StudyForm, fields: Fields, target: str) -> tuple[Fields, str]:
    """Make a face of one's own of a preset."""
    return _worn(form, fields, target, lambda head: head.document(Given(fields).line(f"{target}.{PRESET}")))


def _preset(form: StudyForm, fields: Fields, target: str) -> tuple[Fields, str]:
    return _worn(form, fields, target, lambda head: head.empty())


def _average(form: StudyForm, fields: Fields, target: str) -> tuple[Fields, str]:
    return _worn(form, fields, target, lambda head: head.documents(fields, target).average())


def _random(form: StudyForm, fields: Fields, target: str) -> tuple[Fields, str]:
    return _worn(form, fields, target, lambda head: head.documents(fields, target).random())


def _paste(form: StudyForm, fields: Fields, target: str) -> tuple[Fields, str]:
    """Take the document that was pasted or uploaded in the place of the face; refused with the reader's own words."""
    pasted = Given(fields).one(f"{target}.pasted").encode()
    return _worn(form, fields, target, lambda head: head.heads.signed_file(pasted))


_ACTIONS: dict[str, Callable[[StudyForm, Fields, str], tuple[Fields, str]]] = {
    "add": _add, "remove": _remove, "up": _up, "down": _down, "custom": _custom, "preset": _preset,
    "average": _average, "random": _random, "paste": _paste,
}  # fmt: skip


def _worn(form: StudyForm, fields: Fields, target: str, make: Callable[[Head], Any]) -> tuple[Fields, str]:
    name, _, _ = _row(form, fields, target)
    head = _list(form, fields, name).item
    if not isinstance(head, Head):
        raise InvalidError("There is no such head.", field="do", got=target)
    made = gathered(head.write(target, make(head)))
    dropped = (f"{target}.{HEAD}.", f"{target}.{DOCUMENT}", f"{target}.{PRESET}", f"{target}.pasted")
    return {**{one: values for one, values in fields.items() if not one.startswith(dropped)}, **made}, target


def _row(form: StudyForm, fields: Fields, target: str) -> tuple[str, list[str], int]:
    name, _, key = target.rpartition(".")
    _list(form, fields, name)
    keys = Given(fields).rows(name)
    if key not in keys:
        raise InvalidError("There is no such row.", field="do", got=target)
    return name, keys, keys.index(key)


def _list(form: StudyForm, fields: Fields, name: str) -> Rows | Keyed:
    shape: Shape | None = form.shape
    here = ""
    for part in name.split("."):
        if shape is not None:
            shape = _inner(shape, part)
        here = f"{here}.{part}" if here else part
        if isinstance(shape, OneOf):
            shape = shape.kinds.get(Given(fields).one(f"{here}.{VARIANT}"))
    if not isinstance(shape, (Rows, Keyed)):
        raise InvalidError("There is no such list.", field="do", got=name)
    return shape


def _inner(shape: Shape, part: str) -> Shape | None:
    if isinstance(shape, Switch):
        shape = shape.inner
    if isinstance(shape, Group):
        return shape.members.get(part)
    return shape.item if isinstance(shape, (Rows, Keyed)) and part.isdigit() else None
