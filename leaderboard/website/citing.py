"""How to cite a submission: BibTeX that LaTeX prints as it was written."""

from leaderboard.ranking import Entry
from leaderboard.report.latex import escape_latex
from leaderboard.website.material import Material


def cite_submission(entry: Entry, material: Material) -> str:
    """Write a BibTeX entry for a submission; the benchmark itself is cited beside it."""
    about, title = entry.metadata.submission, material.reference.benchmark.title
    kind = " (synthetic reference)" if material.reference.is_synthetic else ""
    fields = {
        "title": f"{{{escape_latex(about.name)}}}",
        "author": f"{{{escape_latex(about.team)}}}",
        "year": str(about.date.year),
        "howpublished": escape_latex(f"Submission {entry.slug} to the {title} leaderboard{kind}"),
        "note": escape_latex(
            f"Reference {entry.result.inputs.reference_digest[:12]}, grader {entry.result.grader}"
        ),
    }
    if entry.metadata.links.paper:
        fields["url"] = entry.metadata.links.paper
    lines = (f"  {name:<12} = {{{value}}},\n" for name, value in fields.items())
    return f"@misc{{{entry.slug},\n{''.join(lines)}}}"
