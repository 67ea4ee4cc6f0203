"""The page about the benchmark: what is simulated, licence, contact, and how to cite it."""

from collections.abc import Iterator
from dataclasses import dataclass

from leaderboard.website.material import Material
from leaderboard.website.pages import Fact, Page

CONTACT = (
    "The team of a submission answers for it: its page names an account on GitHub. For the site and its "
    "grading write to the maintainers, where its source is kept."
)
SIMULATED = (
    "Labels and people. Submissions are graded as they will be against the official reference, but no figure "
    "says anything about a real system or real people."
)


@dataclass(frozen=True)
class AboutPage(Page):
    """What maintainers say, facts, and BibTeX, which is empty where nobody wrote any."""

    paragraphs: tuple[str, ...]
    facts: tuple[Fact, ...]
    citation: str


def compose_about(material: Material) -> AboutPage:
    """Gather what the page about the benchmark shows."""
    benchmark = material.reference.benchmark
    return AboutPage(
        path="about.html",
        title="About",
        summary=f"{benchmark.title} {benchmark.version}: “{benchmark.question}”",
        paragraphs=material.texts.about,
        facts=tuple(_list_facts(material)),
        citation=material.texts.citation,
    )


def _list_facts(material: Material) -> Iterator[Fact]:
    reference = material.reference
    if reference.is_synthetic:
        yield Fact("Simulated", SIMULATED)
    licence = reference.benchmark.licence
    if licence:
        yield Fact("Licence", f"The official files of the benchmark are under the licence {licence}.")
    yield Fact("Contact", CONTACT)
