"""What a code of a problem is: how much it matters and what it means."""

from dataclasses import dataclass
from enum import StrEnum


class Severity(StrEnum):
    """How much a problem matters: errors refuse, warnings and notes inform."""

    ERROR = "error"
    WARNING = "warning"
    NOTE = "note"


@dataclass(frozen=True)
class Code:
    """One kind of problem: its severity and what it means, in one sentence for the docs."""

    severity: Severity
    meaning: str
