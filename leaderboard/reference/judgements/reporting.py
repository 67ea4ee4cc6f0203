"""Saying what became of the answers or counts in a file, and what about them is doubtful."""

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Protocol

from leaderboard.problems import Problems
from leaderboard.reference.judgements.matching import TrialMatcher
from leaderboard.reference.judgements.participants import Discretion
from leaderboard.reference.judgements.sifting import Answer
from leaderboard.trial_names import Ambiguous, Unknown

MAX_EXAMPLES = 3
MAX_TRIALS = 10
# Beyond this share, contradictions are no slips: a column means something else than it seems to.
_MAX_DOUBTFUL = Fraction(1, 4)
_WAY_OUT = "--allow-unmatched leaves them out"


class Named(Protocol):
    """An answer or a count: where it is, and what it is about."""

    @property
    def line(self) -> int:
        """Its line in the file."""

    @property
    def name(self) -> str:
        """What its trial is called there."""


@dataclass(frozen=True)
class FileReport:
    """Reports on one file.

    Attributes
    ----------
    file
        How messages name it.
    noun
        What it holds: answers or rows.
    matcher
        Knows the trials.
    discretion
        Knows what must not be quoted.
    is_lenient
        Whether what cannot be used is left out instead of refused.
    problems
        Receives the findings.
    """

    file: str
    noun: str
    matcher: TrialMatcher
    discretion: Discretion
    is_lenient: bool
    problems: Problems

    def report_matches(self, n_named: int, unmatched: Sequence[Named], ambiguous: Sequence[Named]) -> None:
        """Say how many answers name a trial, and refuse or leave out those that do not."""
        n_matched = n_named - len(unmatched) - len(ambiguous)
        self.problems.add("import-match", f"{n_matched:,} of {n_named:,} {self.noun} name a trial", self.file)
        if unmatched:
            examples, hint = self._describe_unmatched(unmatched)
            message = f"{len(unmatched):,} of {n_named:,} {self.noun} name no trial{examples}"
            self._report_useless("import-unmatched", "import-match-rate", message, unmatched[0].line, hint)
        if ambiguous:
            message = f"{len(ambiguous):,} of {n_named:,} {self.noun} fit several trials"
            message += self._describe_ambiguous(ambiguous[0].name)
            hint = "--columns trial=... names a column with longer names"
            self._report_useless("import-ambiguous", "import-match-rate", message, ambiguous[0].line, hint)

    def _report_useless(self, mild: str, strict: str, message: str, line: int, hint: str) -> None:
        """Refuse what cannot be used, or say that it is left out."""
        if self.is_lenient:
            self.problems.add(mild, f"{message}; left out", self.file, line=line)
        else:
            hint = "; ".join(filter(None, [hint, _WAY_OUT]))
            self.problems.add(strict, message, self.file, line=line, hint=hint)

    def _describe_unmatched(self, unmatched: Sequence[Named]) -> tuple[str, str]:
        """Quote some names, and give the trials nearest to them.

        Names that resemble no trial might be anything, and are not shown.
        """
        examples, nearest = [], []
        for name in list(dict.fromkeys(each.name for each in unmatched))[:MAX_EXAMPLES]:
            found = self.matcher.resolve(name)
            quoted = self.discretion.quote_name(name)
            if isinstance(found, Unknown) and found.nearest and quoted:
                examples.append(quoted)
                nearest.append(found.nearest)
        if not examples:
            return "", ""
        noun = "trial is" if len(set(nearest)) == 1 else "trials are"
        hint = f"the nearest {noun} {', '.join(dict.fromkeys(nearest))}"
        return f", such as {', '.join(examples)}", hint

    def _describe_ambiguous(self, name: str) -> str:
        found, quoted = self.matcher.resolve(name), self.discretion.quote_name(name)
        if not isinstance(found, Ambiguous) or quoted is None:
            return ""
        return f", such as {quoted}, which fits {' and '.join(found.trial_ids[:MAX_EXAMPLES])}"

    def report_unclear(self, found: Sequence[Named], words: Sequence[str]) -> None:
        """Refuse or leave out answers that are neither YES nor NO; ``words`` are what they are."""
        if found:
            quoted = [text for text in map(self.discretion.quote_word, dict.fromkeys(words)) if text]
            examples = f", such as {', '.join(quoted[:MAX_EXAMPLES])}" if quoted else ""
            message = f"answers that are neither YES nor NO: {len(found):,}{examples}"
            hint = "--columns response=... names another column"
            self._report_useless("import-answer-left-out", "import-answer", message, found[0].line, hint)

    def report_left_out(self, code: str, found: Sequence[Named], what: str) -> None:
        """Count what is left out for another reason, from its first line."""
        if found:
            message = f"{self.noun} {what}, left out: {len(found):,}"
            self.problems.add(code, message, self.file, line=found[0].line)

    def report_labels(self, labels: Sequence[tuple[str, int, bool]], *, matters: bool) -> None:
        """Hold the file's labels against the reference's.

        Parameters
        ----------
        labels
            Trial, line, and label that the file gives.
        matters
            Whether answers were worked out from these labels.
        """
        lines: dict[str, int] = {}
        for trial_id, line, label in labels:
            if label != self.matcher.labels[trial_id]:
                lines.setdefault(trial_id, line)
        if not lines:
            return
        n_trials = len({trial_id for trial_id, _, _ in labels})
        count = f"{len(lines):,} of {n_trials:,} trials"
        self.problems.add(
            "import-people-label",
            f"gives another label than the list, whose labels count, for {count}: {list_trials([*lines])}",
            self.file,
            line=min(lines.values()),
        )
        if matters and len(lines) > _MAX_DOUBTFUL * n_trials:
            message = (
                f"answers follow from correctness and label here, and the label of {count} is another one"
            )
            hint = "--columns label=... names another column with labels"
            self.problems.add("import-answer-meaning", message, self.file, hint=hint)

    def report_contradictions(self, answers: Sequence[Answer]) -> None:
        """Hold responses against their correctness."""
        checked = [a for a in answers if a.is_right is not None and not a.is_derived]
        found = [a for a in checked if (a.is_yes == a.label) != a.is_right]
        if not found:
            return
        count = f"{len(found):,} of {len(checked):,} responses contradict their correctness"
        if len(found) > _MAX_DOUBTFUL * len(checked):
            message = f"{count}, so one of the two does not mean what it seems to"
            hint = "--columns response=... or correct=... names the column that counts, and then alone"
            self.problems.add("import-answer-meaning", message, self.file, line=found[0].line, hint=hint)
        else:
            message = f"{count}; the responses are taken, since correctness was worked out from them"
            self.problems.add("import-answer-contradiction", message, self.file, line=found[0].line)


def list_trials(trial_ids: Sequence[str]) -> str:
    """List trials, at most ten of them."""
    more = f" and {len(trial_ids) - MAX_TRIALS:,} more" if len(trial_ids) > MAX_TRIALS else ""
    return ", ".join(trial_ids[:MAX_TRIALS]) + more
