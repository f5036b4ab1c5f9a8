"""Plural forms as Unicode CLDR 46 has them for whole numbers, for the languages of the house."""

from collections.abc import Callable

Rule = Callable[[int], str]
MILLION = 1_000_000


def plural(language: str, count: int) -> str:
    """Return the name of the form that a count takes: zero, one, two, few, many or other."""
    return _RULES.get(language.partition("-")[0], _germanic)(count)


def forms(language: str) -> set[str]:
    """Return the forms that counts below a million take: those that a catalogue has to hold."""
    return {plural(language, count) for count in range(200)}


def _germanic(count: int) -> str:
    return "one" if count == 1 else "other"


def _spanish(count: int) -> str:
    return "one" if count == 1 else _millions(count)


def _french(count: int) -> str:
    return "one" if count < 2 else _millions(count)


def _millions(count: int) -> str:
    return "many" if count and count % MILLION == 0 else "other"


def _chinese(_: int) -> str:
    return "other"


def _arabic(count: int) -> str:
    if count <= 2:
        return ("zero", "one", "two")[count]
    rest = count % 100
    if 3 <= rest <= 10:
        return "few"
    return "many" if rest >= 11 else "other"


_RULES: dict[str, Rule] = {
    "en": _germanic, "de": _germanic, "es": _spanish, "fr": _french, "zh": _chinese, "ar": _arabic,
}  # fmt: skip
