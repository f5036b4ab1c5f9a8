"""The text for a paper: what was measured, on what, how, with which versions and seeds."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Literal

from emogen_core.search import preference

from ..services.trials.evolve import may_end_early
from .telling import counted, listed

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from emogen_core.simulation.evaluation.specs import ResultName

    from ..services.config import StudyConfig
    from .context import Context
    from .section import Section

REFERENCES = {
    "Anderson, 2006": "Anderson, M. J. (2006). Distance-based tests for homogeneity of multivariate dispersions."
    " Biometrics, 62, 245-253. https://doi.org/10.1111/j.1541-0420.2005.00440.x",
    "Benjamini & Hochberg, 1995": "Benjamini, Y., & Hochberg, Y. (1995). Controlling the false discovery rate: A"
    " practical and powerful approach to multiple testing. Journal of the Royal Statistical Society B, 57, 289-300."
    " https://doi.org/10.1111/j.2517-6161.1995.tb02031.x",
    "Bridgeford et al., 2021": "Bridgeford, E. W., et al. (2021). Eliminating accidental deviations to minimize"
    " generalization error and maximize replicability. PLOS Computational Biology, 17, e1009279."
    " https://doi.org/10.1371/journal.pcbi.1009279",
    "Brochu et al., 2007": "Brochu, E., de Freitas, N., & Ghosh, A. (2007). Active preference learning with discrete"
    " choice data. Advances in Neural Information Processing Systems, 20, 409-416.",
    "Finn et al., 2015": "Finn, E. S., et al. (2015). Functional connectome fingerprinting: Identifying individuals"
    " using patterns of brain connectivity. Nature Neuroscience, 18, 1664-1671. https://doi.org/10.1038/nn.4135",
    "Kass & Raftery, 1995": "Kass, R. E., & Raftery, A. E. (1995). Bayes factors. Journal of the American Statistical"
    " Association, 90, 773-795. https://doi.org/10.1080/01621459.1995.10476572",
    "Mancl & DeRouen, 2001": "Mancl, L. A., & DeRouen, T. A. (2001). A covariance estimator for GEE with improved"
    " small-sample properties. Biometrics, 57, 126-134. https://doi.org/10.1111/j.0006-341X.2001.00126.x",
    "McGraw & Wong, 1996": "McGraw, K. O., & Wong, S. P. (1996). Forming inferences about some intraclass correlation"
    " coefficients. Psychological Methods, 1, 30-46. https://doi.org/10.1037/1082-989X.1.1.30",
    "Phipson & Smyth, 2010": "Phipson, B., & Smyth, G. K. (2010). Permutation p-values should never be zero."
    " Statistical Applications in Genetics and Molecular Biology, 9, 39. https://doi.org/10.2202/1544-6115.1585",
    "Roubtsova et al., 2021": "Roubtsova, N., Parsons, M., Binetti, N., Mareschal, I., Viding, E., & Cosker, D. (2021)."
    " EmoGen: Quantifiable Emotion Generation and Analysis for Experimental Psychology."
    " https://doi.org/10.48550/arXiv.2107.00480",
}
"""What may be cited, by the words that cite it."""
ANALYSED = {
    "elite": "The faces analysed are those last chosen as best.",
    "estimate": "The faces analysed are the estimates of that search, one a trial: the mean of the posterior after the"
    " last choice, which nobody was shown; the simulated distances are of such estimates as well.",
}
"""Which face of a trial is analysed."""


@dataclass(frozen=True, slots=True)
class Facts:
    """Where the numbers come from: what a paper has to cite.

    Attributes:
        command: what makes the same report again.
        version: of Emogen.
        recorded_with: the version that wrote the export.
        exported_at: when it was written, ISO 8601.
        title, study: of the study.
        rig, rig_hash: name and SHA-256 of the face model.
        configurations: SHA-256 of the versions of the study that faces were made under.
        algorithms: name and version of the searches.
        counted: who counts, in words.
        simulated: whether all of them are simulated, some or none.
        seed: of the random numbers.
        searches: simulated, for each kind of participant and each search of the study; the fewest of any.
        filters: what the export was restricted by, as its manifest has it.
        restricted: that in words; empty where it is of the whole study.
        unchecked: whether it leaves out attention checks that the study has.
        heads: what people call those heads of the study's own that are in the tables under other names.
        result: which face of every trial is analysed.
    """

    command: str
    version: str
    recorded_with: str
    exported_at: str
    title: str
    study: str
    rig: str
    rig_hash: str
    configurations: tuple[str, ...]
    algorithms: tuple[str, ...]
    counted: str
    simulated: Literal["all", "some", "none"]
    seed: int
    searches: int
    filters: Mapping[str, str] = field(default_factory=dict)
    restricted: str = ""
    unchecked: bool = False
    heads: Mapping[str, str] = field(default_factory=dict)
    result: ResultName = "elite"


def methods(context: Context, sections: Sequence[Section], facts: Facts) -> list[str]:
    """Return the paragraphs of the text, and after them what they cite."""
    told = [" ".join(section.methods) for section in sections if section.methods]
    text = [_sample(context, facts), _search(context, facts), *told, _versions(facts)]
    return [*text, *(work for words, work in REFERENCES.items() if any(words in one for one in text))]


def _sample(context: Context, facts: Facts) -> str:
    faces, recording = context.faces, context.recording
    left = ", ".join(f"{count} {why}" for why, count in recording.left_out.items())
    again = len(recording.faces) - len(faces)
    part = f", in an export restricted to {facts.restricted}," if facts.restricted else ""
    emotions, heads = ", ".join(context.emotions), ", ".join(map(context.head, context.identities))
    return (
        f"{faces.person_count} of {facts.counted} who completed the study “{facts.title}”{part} made"
        f" {counted(len(faces), 'face')}"
        + (f" for {counted(len(context.emotions), 'emotion')} ({emotions}) on"
           f" {counted(len(context.identities), 'head')} ({heads})" if emotions else "")
        + (f" in {len(context.conditions)} conditions" if context.conditions[1:] else "")
        + (f", and {counted(again, 'face')} once more as a retest" if again else "")
        + (f". Left out: {left}." if left else ".")
        + (" Attention checks are not in this export, so those who failed one are not left out."
           if facts.unchecked else "")
    )  # fmt: skip


def _search(context: Context, facts: Facts) -> str:
    told = [
        f"{_settings(context, key)}, simulated searches of people who never err ended {one.faithful.error} from the"
        f" face in mind (mean and standard deviation of the cosine distance, {one.searches} searches) and two searches"
        f" for one face {one.faithful.apart} apart; of people whose judged distances had a standard deviation of .1"
        f" (“with noise” below) it was {one.noisy.error} and {one.noisy.apart}."
        for key, one in context.simulated.thresholds.items()
    ]
    return (
        f"Faces were found with EmoGen (Roubtsova et al., 2021; search {', '.join(facts.algorithms)}) on the face model"
        f" {facts.rig} ({len(context.rig.gene_names)} genes, {len(context.rig.shape_names)} blendshapes)."
        f"{_learning(facts)} {' '.join(told)}"
    )


def _learning(facts: Facts) -> str:
    """Return what is not the search of the paper, if anything is."""
    learning = [name for name in facts.algorithms if name.startswith(preference.NAME)]
    if not learning:
        return ""
    return (
        f" The search {', '.join(learning)} makes the next faces not by the genetic algorithm of that paper but by"
        " Bayesian preference learning (Brochu et al., 2007): a posterior over sparse faces, given all choices of a"
        f" trial (Plackett-Luce). {ANALYSED[facts.result]}"
    )


def _settings(context: Context, key: str) -> str:
    config, recording = context.recording.configs[key], context.recording
    most = f"{'at most ' if may_end_early(config) else ''}{config.generations} generations"
    settings = f"{most} and {config.minimum} to {config.maximum} selections in each{_early(config)}"
    mine = sorted(set(recording.faces.conditions[recording.searches == key].tolist()))
    if len(recording.configs) == 1 or mine == [""]:
        return f"With {settings}"
    return f"In the condition{'s' if mine[1:] else ''} {listed(mine)}, with {settings}"


def _early(config: StudyConfig) -> str:
    """Return when trials end before the most, where they may."""
    if not may_end_early(config):
        return ""
    return (
        f" (a trial ends with the first generation, from {config.search.least_generations} on, before which the search"
        f" expects its own estimate to be within a cosine distance of {config.search.stop_at:g} of the face in mind)"
    )


def _versions(facts: Facts) -> str:
    configurations = ", ".join(facts.configurations)
    heads = "".join(
        f" In the tables the head {name} is {head}, by the SHA-256 of its identity document."
        for head, name in facts.heads.items()
    )
    return (
        f"Analysed with Emogen {facts.version} (command “{facts.command}”, seed {facts.seed}) from an export of"
        f" {facts.exported_at} by Emogen {facts.recorded_with}; face model SHA-256 {facts.rig_hash}; configuration"
        f" SHA-256 {configurations}. The seed of every trial is in faces.csv.{heads}"
    )
