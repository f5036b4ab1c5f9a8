"""What a study is: one schema for the form, the file, the command line and the documentation (docs/study.md)."""

from .blocks import (
    Attention,
    Block,
    Categorise,
    Evolve,
    Faces,
    Item,
    Questionnaire,
    Rate,
    Scale,
    ScreenOut,
    Source,
)
from .conditions import Condition
from .demo import DEMO
from .language import Spoken, in_language, offered_languages, preferred
from .parse import Problem, mended, parse_config, problems_of
from .parts import Completion, Devices, Emotion, Outcome, Portrait, Question, Texts, Translation
from .search import Search
from .study import StudyConfig

__all__ = [
    "DEMO",
    "Attention",
    "Block",
    "Categorise",
    "Completion",
    "Condition",
    "Devices",
    "Emotion",
    "Evolve",
    "Faces",
    "Item",
    "Outcome",
    "Portrait",
    "Problem",
    "Question",
    "Questionnaire",
    "Rate",
    "Scale",
    "ScreenOut",
    "Search",
    "Source",
    "Spoken",
    "StudyConfig",
    "Texts",
    "Translation",
    "in_language",
    "mended",
    "offered_languages",
    "parse_config",
    "preferred",
    "problems_of",
]
