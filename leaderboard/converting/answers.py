r"""The one reader of YES and NO in a model's text.

It never takes the first match, since a chain of thought weighs YES and NO before it answers. In this order:

1. what stands in ``<answer>`` tags, else in ``\boxed{}``, else in an ``"answer"`` of JSON;
2. else the final line;
3. else the last line before it that says YES or NO.

What says both, or neither, is not read: a wrong reading is worse than none. Paraphrases (*it will hit*) and
other languages than English are left unread on purpose. `READER_VERSION` goes up whenever a text could be
read differently.
"""

import re
import unicodedata
from collections.abc import Iterable
from enum import StrEnum

from leaderboard.submission import Status

READER_VERSION = 1


class Reading(StrEnum):
    """What a text says."""

    YES = "yes"
    NO = "no"
    REFUSED = "refused"
    UNPARSABLE = "unparsable"
    ERROR = "error"

    @property
    def status(self) -> Status:
        """The status of a prediction that is read so."""
        return Status.ANSWERED if self in _SIDES else Status(self.value)

    @property
    def probability(self) -> str:
        """P(YES) as text: 1, 0, or empty where there is no answer."""
        return {Reading.YES: "1", Reading.NO: "0"}.get(self, "")

    @property
    def outcome(self) -> bool | None:
        """Whether it says YES; None if it says neither."""
        return self is Reading.YES if self in _SIDES else None


_SIDES = frozenset({Reading.YES, Reading.NO})

# Texts that tools write in place of an answer.
_FAILURE = re.compile(
    r"[\s*`~#]*(?:failed to obtain answer via api|\[failed_infer\]|\[?error(?:\]|:| code)"
    r"|traceback \(most recent call)"
)

_CURLY = {0x2018: "'", 0x2019: "'", 0x201C: '"', 0x201D: '"'}
_THOUGHTS = ("think", "thinking", "thought", "reasoning")
_SPECIAL = re.compile(r"<\|[^|<>\n]{0,40}\|>")  # a model's own marks, such as <|channel|>
_STYLE_CHARACTERS = "*`~#"
_STYLE_TAG = re.compile(r"</?(?:b|strong|em|i|u|p|br|span|div|center)\s*/?>")
_STYLE_COMMAND = re.compile(r"\\(?:text|textbf|mathrm|mathbf)\b")
_UNDERSCORES = re.compile(r"(?<![a-z0-9])_+|_+(?![a-z0-9])")
_BOXED = re.compile(r"\\boxed\s*\{+([^{}]{0,200})\}")
_JSON_KEY = re.compile(r'"(?:final[ _]?)?answer"\s*:\s*(?:"([^"\n]{0,200})"|(true|false))\s*(?=[,}\n]|$)')

_WORD_YES, _WORD_NO = r"(?:yes+|yeah|yep|yup)", r"(?:no|nope|nah)"
_EITHER = rf"(?:{_WORD_YES}|{_WORD_NO})"
_QUOTES = r"[\"'()\[\]]{0,2}"
# "yes or no", "no/yes": names both, so it says neither.
_PAIR = re.compile(
    rf"\b{_EITHER}{_QUOTES}\s{{0,3}}(?:/|\||\bor\b|\band\b|\bvs\b\.?)\s{{0,3}}{_QUOTES}{_EITHER}\b"
)
_NEGATED = re.compile(
    r"(?:\b(?:not|never|neither|nor|than|instead of)|n't)\s+(?:(?:a|an|be|say|answer|simply)\s+){0,2}"
    rf"{_QUOTES}{_EITHER}\b"
)
_MARKER = re.compile(
    r"\b(?:answer|conclusion|verdict|prediction|response|decision|result)\b[\"')]{0,2}\s*"
    r"(?:is|would be|must be|should be|will be|:|=|->|→|-)"
)
_WORD = re.compile(r"\w")
_YES = re.compile(rf"\b{_WORD_YES}\b(?!-\w)")
# NO as an answer, not as in "no obstacle": nothing follows it but punctuation, or a new clause begins.
_NO = re.compile(
    rf"\b{_WORD_NO}\b(?!-\w)(?!\.\s?\d)(?=\s*(?:$|[^\w\s])"
    r"|\s+(?:the|it|its|it's|they|this|that's|because|as|since|i|i'm|but|he|she|we|given|due|for|if|so|from|rather|otherwise|or|and|not|yes|no|wait)\b)"
)
_NO_NOUN = re.compile(r"(?:^|[.;:!?]\s+)no\s+\w")  # "No contact.": the word, but as part of a statement
_LETTER = re.compile(r"\W*([yn])\W*")
_OPTION = re.compile(rf"\W*(?:[a-d]|[1-4])\s*[).:\]]\s*{_EITHER}\W*")

_CANNOT = (
    r"\b(?:can't|cannot|can not|could not|couldn't|unable to|not able to|won't|will not|decline to)\s+"
    r"(?:be able to\s+)?"
)
# A refusal even beside a NO, as in "No, I can't help with that".
_DECLINES = re.compile(
    rf"{_CANNOT}(?:help(?! but)|assist|comply|fulfil|fulfill|engage|participate|continue)\b"
)
_MEDIA = (
    r"(?:videos?|images?|clips?|frames?|files?|pictures?|media|content|links?|attachments?|scene|footage)"
)
_REFUSES = re.compile(
    rf"{_CANNOT}(?:\w+\s+){{0,2}}?(?:answer|determine|tell|judge|say|predict|identify|provide|give)\b"
    rf"|{_CANNOT}(?:\w+\s+){{0,2}}?(?:see|view|watch|access|open|play|process|analy[sz]e|load)\b"
    rf"[^.\n]{{0,40}}\b{_MEDIA}\b"
    rf"|\b(?:no|don't see any|don't see an|without the)\s+{_MEDIA}\s+"
    r"(?:(?:was|were|is|has been|have been)\s+)?"
    r"(?:provided|attached|given|uploaded|shared|included|available)\b"
    r"|\bas an ai\b|\bdon't have (?:access|the ability)\b"
    r"|\bi (?:must|have to) (?:decline|refuse)\b|\bi refuse\b"
)


def parse_answer(text: str) -> Reading:
    r"""Tell what a model's text answers to a question of YES or NO.

    Examples
    --------
    >>> [
    ...     parse_answer(text).value
    ...     for text in ("Yes.", "**NO**", "Yes or no?", "Sorry, I can't help with that.")
    ... ]
    ['yes', 'no', 'unparsable', 'refused']
    >>> parse_answer("Yes, at first sight. But it slows down.\nSo the final answer is no.").value
    'no'
    >>> parse_answer("At first: yes. <answer>No</answer> There is no obstacle, yes.").value
    'no'
    """
    folded = _fold(text)
    if _FAILURE.match(folded):
        return Reading.ERROR
    spoken = _strip_style(_drop_thoughts(folded))
    explicit = _find_explicit(spoken)
    reading = _agree(explicit) if explicit else _read_lines(spoken)
    if reading is Reading.UNPARSABLE and _REFUSES.search(spoken):
        return Reading.REFUSED
    return reading


def _fold(text: str) -> str:
    """Bring letters, quotes and blanks to one form."""
    if not text.isascii():
        text = unicodedata.normalize("NFKC", text).translate(_CURLY)
        text = "".join(c for c in text if unicodedata.category(c) != "Cf")
    return text.lower()


def _strip_style(text: str) -> str:
    """Take off what only changes the look of a text; where there is none of it, at no cost."""
    for character in _STYLE_CHARACTERS:
        text = text.replace(character, "")
    if "<" in text:
        text = _STYLE_TAG.sub("", _SPECIAL.sub("\n", text))
    if "\\" in text:
        text = _STYLE_COMMAND.sub("", text)
    return _UNDERSCORES.sub(" ", text) if "_" in text else text


def _drop_thoughts(text: str) -> str:
    """Take off what a model thinks before it speaks; of a thought that does not end nothing is left."""
    for name in _THOUGHTS:
        text = text.rpartition(f"</{name}>")[2].partition(f"<{name}>")[0]
    return text


def _find_explicit(text: str) -> list[str]:
    """List what stands where answers are marked as such."""
    parts = text.split("<answer>")[1:]
    if parts:
        return [part.partition("</answer>")[0] for part in parts]
    boxed = _BOXED.findall(text)
    return boxed or [{"true": "yes", "false": "no"}.get(flag, said) for said, flag in _JSON_KEY.findall(text)]


def _agree(texts: Iterable[str]) -> Reading:
    """Read marked answers: the last must say YES or NO, and no other the contrary."""
    readings = [_read_lines(text) for text in texts]
    last = readings[-1]
    if last in _SIDES and len(_SIDES & {*readings}) > 1:
        return Reading.UNPARSABLE
    return last


def _read_lines(text: str) -> Reading:
    lines = [line for line in map(str.strip, text.split("\n")) if _WORD.search(line)]
    lines = _drop_options(lines)
    if lines and _DECLINES.search(lines[-1]):
        return Reading.REFUSED
    for line in reversed(lines):
        reading = _read_line(line)
        if reading is not None:
            return reading
    return Reading.UNPARSABLE


def _drop_options(lines: list[str]) -> list[str]:
    """Leave out a list of both options that repeats the question, such as ``A) Yes`` above ``B) No``."""
    for index in range(len(lines) - 1):
        if all(_OPTION.fullmatch(line) for line in lines[index : index + 2]):
            return lines[:index] + lines[index + 2 :]
    return lines


def _read_line(line: str) -> Reading | None:
    """Read one line: unparsable if it says both, or names one without saying it; None if it names neither."""
    letter = _LETTER.fullmatch(line)
    if letter:
        return Reading.YES if letter[1] == "y" else Reading.NO
    conclusion = line[_end_of_marker(line) :]
    for part in (conclusion, line) if conclusion != line else (line,):
        reading = _read_part(part)
        if reading is not None:
            return reading
    return None


def _end_of_marker(line: str) -> int:
    """Where the last of phrases such as "the answer is" ends; 0 if there is none."""
    return max((found.end() for found in _MARKER.finditer(line)), default=0)


def _read_part(part: str) -> Reading | None:
    plain = _NEGATED.sub(" ", _PAIR.sub(" ", part))
    says_yes, says_no = _YES.search(plain) is not None, _NO.search(plain) is not None
    if says_yes != says_no:
        return Reading.YES if says_yes else Reading.NO
    if says_yes or plain != part or _NO_NOUN.search(plain):
        return Reading.UNPARSABLE
    return None
