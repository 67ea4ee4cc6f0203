"""The outcome of ``verify`` as text and as JSON."""

from dataclasses import asdict

from leaderboard.files import canonical_json
from leaderboard.report.problems import escape_line
from leaderboard.verifying import Verification


def render_verification(verification: Verification) -> str:
    """Say what was proven and name each difference.

    A file beside the submissions that belongs to none is named too.
    """
    lines = []
    if verification.manifest is None:
        lines.append(f"reference: {verification.reference_problem}")
    else:
        manifest = verification.manifest
        lines.append(f"reference: {manifest.kind}, as sealed, digest {manifest.digest}")
    for verdict in verification.verdicts:
        lines.append(f"submissions/{verdict.slug}: " + ("proven" if verdict.is_proven else "NOT proven"))
        lines += [f"    {difference}" for difference in verdict.differences]
    lines += [f"submissions/{name}: does not belong here" for name in verification.strays]
    n_proven = sum(verdict.is_proven for verdict in verification.verdicts)
    lines.append(f"{n_proven} of {len(verification.verdicts)} results proven")
    if not verification.is_proven:
        lines.append(
            "what is committed differs from what grading gives; see `leaderboard grade` and `reference check`"
        )
    return "".join(f"{escape_line(line)}\n" for line in lines)


def render_verification_json(verification: Verification) -> str:
    """Render the outcome for programs."""
    manifest = verification.manifest
    return canonical_json(
        {
            "proven": verification.is_proven,
            "reference": {
                "digest": manifest.digest if manifest else None,
                "problem": verification.reference_problem or None,
            },
            "submissions": [
                asdict(verdict) | {"proven": verdict.is_proven} for verdict in verification.verdicts
            ],
            "strays": list(verification.strays),
        }
    )
