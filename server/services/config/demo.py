"""The demonstration study: the four emotions of the paper, on its two heads."""

from .parts import Emotion, Texts
from .study import StudyConfig

DEMO = StudyConfig(
    title="Picturing four emotions",
    texts=Texts(minutes=15, about="The faces you made show how you picture these four emotions."),
    emotions=(
        Emotion(adjective="happy", noun="happiness"),
        Emotion(adjective="sad", noun="sadness"),
        Emotion(adjective="angry", noun="anger"),
        Emotion(adjective="fearful", noun="fear"),
    ),
    identities=("female", "male"),
    recruiter_parameters=("PROLIFIC_PID", "STUDY_ID", "SESSION_ID"),
)
