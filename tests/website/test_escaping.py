"""What templates print is escaped as Jinja escapes it, whatever it is."""

import pytest
from hypothesis import given
from hypothesis import strategies as st
from jinja2 import Environment, StrictUndefined, UndefinedError
from markupsafe import Markup, escape

from leaderboard.website.escaping import EscapingEnvironment, escape_text

TEMPLATE = """\
{% macro bold(text) %}<b title="{{ text }}">{{ text }}</b>{% endmacro %}
{% set kept %}<i>{{ value }}</i>{% endset %}
{{ value }}{{ bold(value) }}{{ kept }}{{ value ~ "<" }}{{ value | upper }}{{ [value] }}
{% for letter in value %}{{ letter }}{{ loop.index }}{{ loop.index / 4 }}{% endfor %}
"""
OURS, PLAIN = (
    kind(autoescape=True, undefined=StrictUndefined).from_string(TEMPLATE)
    for kind in (EscapingEnvironment, Environment)
)


@given(st.one_of(st.text(), st.text("&<>'\"a"), st.integers(), st.floats(), st.none(), st.booleans()))
def test_values_are_escaped_as_ever(value: object) -> None:
    """Texts and numbers of every kind."""
    assert escape_text(value) == str(escape(value))


@given(st.one_of(st.text(), st.text("&<>'\"a")))
def test_templates_print_what_jinja_prints(value: str) -> None:
    """Macros, blocks that are set, joined texts, filters, lists and loops."""
    assert OURS.render(value=value) == PLAIN.render(value=value)


def test_what_is_escaped_stays() -> None:
    """Neither a text of its kind nor one that says itself what it is in HTML is escaped again."""

    class Own:
        def __html__(self) -> str:
            return "<hr>"

    class Loud(str):
        __slots__ = ()

    assert escape_text(Markup("<b>")) == "<b>"
    assert escape_text(Own()) == "<hr>"
    assert escape_text(Loud("<b>")) == "&lt;b&gt;"


def test_a_name_that_is_not_there_is_still_an_error() -> None:
    """Printed or only looked at."""
    with pytest.raises(UndefinedError, match="'value' is undefined"):
        OURS.render()


def test_without_escaping_nothing_is() -> None:
    """Who asks for an environment without it gets what Jinja gives, in blocks of either kind too."""
    plain = EscapingEnvironment(autoescape=False)
    text = "{{ value }}{% autoescape true %}{{ value }}{% endautoescape %}{% autoescape is_on %}{{ value }}"
    template = plain.from_string(f"{text}{{% endautoescape %}}")
    assert template.render(value="<", is_on=True) == "<&lt;&lt;"
    assert template.render(value="<", is_on=False) == "<&lt;<"
