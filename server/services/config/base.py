"""What every part of a configuration shares: strictness, the words of its fields, fields that came later."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any

from pydantic import AfterValidator, BaseModel, ConfigDict, Field, StringConstraints, ValidationError
from pydantic_core import InitErrorDetails, PydanticCustomError

if TYPE_CHECKING:
    from collections.abc import Iterable

    from pydantic.config import JsonDict
    from pydantic.fields import FieldInfo
    from pydantic_core import ErrorDetails


def _storable(text: str) -> str:
    """Refuse the one character that PostgreSQL cannot keep in a text."""
    if "\0" in text:
        raise ValueError("expected a text without NUL characters")
    return text


Line = Annotated[str, StringConstraints(min_length=1, max_length=200), AfterValidator(_storable)]
OptionalLine = Annotated[str, StringConstraints(max_length=200), AfterValidator(_storable)]
Prose = Annotated[str, StringConstraints(max_length=20_000), AfterValidator(_storable)]
Name = Annotated[str, StringConstraints(pattern=r"^[a-z][a-z0-9_-]{0,39}$")]
Language = Annotated[str, StringConstraints(pattern=r"^[a-z]{2,3}(-[A-Za-z0-9]{2,8})*$")]


class Part(BaseModel):
    """One part of a study: frozen, and nothing in it that has no meaning."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    def canonical(self) -> dict[str, Any]:
        """Return plain data; the same content gives the same data.

        A field that came later than the first studies is left out while it has its default, so older studies keep
        their hash.
        """
        data = self.model_dump(mode="json")
        for name, field in type(self).model_fields.items():
            value = getattr(self, name)
            if _is_later(field) and value == field.get_default(call_default_factory=True):
                del data[name]
            else:
                data[name] = _plain(value, data[name])
        return data


def option(default: Any, title: str, help_: str, *, later: bool = False, paper: str = "", **limits: Any) -> Any:
    """Return a field with the words that the form and the documentation have for it.

    Args:
        default: its default; ``...`` for none.
        title: its label.
        help_: what it does, one sentence.
        later: whether it came later than the first studies, see `Part.canonical`.
        paper: what EmoGen 2021 used, where that is known.
        **limits: passed to pydantic.
    """
    start: dict[str, Any] = {"default_factory": default} if callable(default) else {"default": default}
    extra: JsonDict = {**({"later": True} if later else {}), **({"paper": paper} if paper else {})}
    made: Any = Field(**start, title=title, description=help_, json_schema_extra=extra or None, **limits)
    return made


def misfit(*where: str | int, expected: str, got: object) -> ValidationError:
    """Return the error of fields that do not fit together, at the one that has to change."""
    kind = PydanticCustomError("misfit", "{expected}", {"expected": f"expected {expected}"})
    return ValidationError.from_exception_data("study", [InitErrorDetails(type=kind, loc=where, input=got)])


def moved(error: ValidationError, *where: str | int) -> ValidationError:
    """Return the errors of something that stands further down."""
    return ValidationError.from_exception_data("study", [_moved(one, where) for one in error.errors(include_url=False)])


def together(errors: Iterable[ValidationError]) -> ValidationError:
    """Return several errors as one."""
    found = [_moved(one, ()) for error in errors for one in error.errors(include_url=False)]
    return ValidationError.from_exception_data("study", found)


def _moved(one: ErrorDetails, where: tuple[str | int, ...]) -> InitErrorDetails:
    kind: Any = one["type"]
    if kind == "misfit":
        kind = PydanticCustomError("misfit", "{expected}", one["ctx"])
    return InitErrorDetails(type=kind, loc=(*where, *one["loc"]), input=one["input"], ctx=one.get("ctx", {}))


def _is_later(field: FieldInfo) -> bool:
    return isinstance(field.json_schema_extra, dict) and bool(field.json_schema_extra.get("later"))


def _plain(value: Any, dumped: Any) -> Any:
    if isinstance(value, Part):
        return value.canonical()
    if isinstance(value, tuple):
        return [_plain(one, plain) for one, plain in zip(value, dumped, strict=True)]
    if isinstance(value, dict) and isinstance(dumped, dict):
        return {name: _plain(one, dumped[name]) for name, one in value.items()}
    return dumped
