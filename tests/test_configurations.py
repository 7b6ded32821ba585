"""Configurations by name, and with settings that differ."""

from dataclasses import asdict
from typing import Any

import pytest

from sgim.configurations import MODERN, THESIS, configuration_of
from sgim.errors import SettingError, UnknownNameError


@pytest.mark.parametrize(
    ("text", "setting", "value"),
    [
        ("modern,social_cost=20", "social_cost", 20.0),
        ("modern, prior = 0.1", "prior", 0.1),
        ("thesis,credit=chosen", "credit", "chosen"),
        ("modern,news=false", "news", False),
        ("thesis,split_candidates=5", "split_candidates", 5),
    ],
)
def test_settings_that_differ_are_added_to_the_name(text: str, setting: str, value: Any) -> None:
    made = configuration_of(text)
    base = {"modern": MODERN, "thesis": THESIS}[text.partition(",")[0]]
    assert getattr(made, setting) == value
    assert type(getattr(made, setting)) is type(value)
    assert {**asdict(made), setting: 0, "name": ""} == {**asdict(base), setting: 0, "name": ""}
    assert configuration_of(made.name).describe() == made.describe()
    assert configuration_of(made.describe()) == made


def test_several_settings_may_differ() -> None:
    made = configuration_of("modern,prior=0.2,goals=1")
    assert (made.prior, made.goals, made.name) == (0.2, 1, "modern,prior=0.2,goals=1")


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("modern,prior", "'prior', expected prior= and a value such as 0.5"),
        ("modern,prior=high", "expected prior= and a value such as 0.5"),
        ("modern,news=1", "expected news= and a value such as true"),
        ("modern,goals=1.5", "expected goals= and a value such as 3"),
        ("thesis,credit=both", "expected credit= and chosen or pursued"),
        ("modern,goals=0", "goals is 0, expected 1 or more"),
        ("modern,social_cost=0", "social_cost is 0.0, expected a positive number"),
        ("modern,social_cost=NaN", "social_cost is nan, expected a positive number"),
    ],
)
def test_a_setting_of_another_form_is_refused(text: str, message: str) -> None:
    with pytest.raises(SettingError, match=message):
        configuration_of(text)


def test_an_unknown_setting_is_answered_with_the_nearest() -> None:
    with pytest.raises(UnknownNameError, match="Did you mean 'social_cost'"):
        configuration_of("modern,social_costs=3")
