"""Rows of the journal hold events exactly, and refuse what they cannot hold."""

import json

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from sgim import events as e
from sgim.errors import JournalError
from sgim.records import Demonstration, Goal, Plan, Request, Trajectory, Trial
from sgim.runs.codec import Codec
from sgim.runs.rows import COLUMNS
from sgim.spaces import Box
from sgim.task import Task

numbers = st.integers(0, 2**62)
names = st.text(max_size=8)
seconds = st.none() | st.floats(0, 1e9)
measures = st.none() | st.floats(allow_nan=False)


def vectors(d):
    return st.lists(st.floats(), min_size=d, max_size=d).map(np.array)


policies, contexts = vectors(3), st.none() | vectors(1)
outcomes = st.fixed_dictionaries(
    {}, optional={"throw": vectors(2), "word": st.sampled_from(["ba", "da", "ä"])}
)
goals = st.builds(Goal, st.just("throw"), vectors(2)) | st.builds(
    Goal, st.just("sort"), st.sampled_from(["near", "far"])
)


@st.composite
def trajectories(draw):
    finite = st.floats(allow_nan=False, allow_infinity=False)
    times = sorted(draw(st.sets(finite, min_size=2, max_size=4)))
    joints = draw(st.lists(names, max_size=2))
    row = st.lists(finite, min_size=len(joints), max_size=len(joints))
    positions = draw(st.lists(row, min_size=len(times), max_size=len(times)))
    return Trajectory(times, np.reshape(positions, (len(times), len(joints))), joints, draw(names))


demonstrations = st.builds(
    Demonstration, outcomes, st.none() | policies, st.none() | trajectories(), names, contexts
)
plans = st.builds(
    Plan, numbers, numbers, names, st.none(), policies, st.none(), contexts
) | st.builds(
    Plan,
    numbers,
    numbers,
    names,
    st.none(),
    st.none(),
    st.builds(Request, names, st.none(), numbers),
    contexts,
)
json_values = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats(allow_nan=False) | st.text(max_size=5),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(names, inner, max_size=3),
    max_leaves=5,
)
EVENTS = {
    e.Opened: st.builds(
        e.Opened,
        numbers,
        names,
        st.none() | goals,
        contexts,
        st.sampled_from(["strategy", "suggestion", "demonstration"]),
    ),
    e.Planned: st.builds(e.Planned, plans),
    e.Answered: st.builds(e.Answered, numbers, st.none() | demonstrations, seconds),
    e.Told: st.builds(e.Told, numbers, outcomes, seconds),
    e.Ended: st.builds(e.Ended, numbers, st.sampled_from(["failed", "lost"]), st.text()),
    e.Observed: st.builds(e.Observed, st.builds(Trial, policies, outcomes, contexts)),
    e.Demonstrated: st.builds(e.Demonstrated, demonstrations),
    e.Suggested: st.builds(e.Suggested, goals),
    e.Available: st.builds(e.Available, names, st.booleans()),
    e.Closed: st.builds(e.Closed, numbers, names, st.none() | goals, measures, measures, numbers),
    e.Evaluated: st.builds(
        e.Evaluated, numbers, st.dictionaries(names, st.floats(allow_nan=False), max_size=3)
    ),
    e.Session: st.builds(e.Session, st.dictionaries(names, json_values, max_size=3)),
}


def numbered(rows):
    return [(seq, *row) for seq, row in enumerate(rows, 1)]


@pytest.mark.parametrize("kind", EVENTS, ids=lambda kind: kind.__name__)
def test_every_type_of_event_comes_back_bit_for_bit(task, same, kind):
    codec = Codec(task)

    @given(event=EVENTS[kind])
    def check(event):
        rows = codec.encode(event)
        ((last, decoded),) = codec.decode(numbered(rows))
        assert last == len(rows)
        assert all(len(row) == len(COLUMNS) for row in rows)
        assert same(event, decoded)

    check()


@given(events=st.lists(st.one_of(*EVENTS.values()), max_size=8))
def test_a_sequence_comes_back_in_order(task, same, events):
    codec = Codec(task)
    rows = [row for event in events for row in codec.encode(event)]
    decoded = [event for _, event in codec.decode(numbered(rows))]
    assert len(decoded) == len(events)
    assert all(map(same, events, decoded))


def test_each_type_has_its_own_columns(task, every_event):
    codec = Codec(task)
    rows = {}
    for event in every_event:
        row = dict(zip(COLUMNS, codec.encode(event)[0], strict=True))
        rows.setdefault(row["event"], {k: v for k, v in row.items() if v is not None})
    vector = np.array([0.3, 0.7]).tobytes()
    assert rows["opened"] == {
        "event": "opened",
        "episode": 0,
        "name": "autonomous",
        "kind": "throw",
        "point": vector,
        "context": np.array([2.5]).tobytes(),
        "detail": "strategy",
    }
    assert set(rows["planned"]) == {"event", "plan", "episode", "policy", "context"}
    assert set(rows["told"]) == {"event", "plan", "kind", "point", "seconds"}
    assert rows["answered"] == {
        "event": "answered",
        "plan": 1,
        "seconds": 2.0,
        "detail": "declined",
    }
    assert rows["available"] == {"event": "available", "name": "expert", "detail": "yes"}
    assert rows["closed"]["detail"] == '{"before": -0.1, "after": -0.0, "movements": 20}'


def test_a_request_is_recorded_by_teacher_and_number(task):
    plan = Plan(7, 3, "mimic", None, None, Request("expert", None, 4), None)
    (row,) = Codec(task).encode(e.Planned(plan))
    assert row == ("planned", 3, 7, "expert", None, None, None, None, None, "4")


def test_further_kinds_of_an_event_left_out_are_passed_over(task):
    codec = Codec(task)
    both = {"throw": np.zeros(2), "word": "ba"}
    events = [e.Told(0, {"word": "da"}), e.Observed(Trial(np.zeros(3), both)), e.Told(1, both)]
    rows = numbered([row for event in events for row in codec.encode(event)])
    decoded = [event for _, event in codec.decode(row for row in rows if row[1] != "observed")]
    assert [(event.plan, set(event.outcome)) for event in decoded] == [
        (0, {"word"}),
        (1, {"throw", "word"}),
    ]


def test_measures_may_be_numpy_scalars(task):
    event = e.Closed(0, "random", None, np.float64(-0.25), np.float32(0.5), np.int64(3))
    ((_, decoded),) = Codec(task).decode(numbered(Codec(task).encode(event)))
    assert (decoded.before, decoded.after, decoded.movements) == (-0.25, 0.5, 3)


@given(
    st.none() | st.floats() | st.floats().map(np.float64),
    st.integers() | st.integers(0, 2**31).map(np.int64),
)
def test_measures_are_written_as_json_has_them(before, movements):
    task = Task(Box(0, 1), {"throw": Box(0, 1)})
    (row,) = Codec(task).encode(e.Closed(0, "random", None, before, -0.5, movements))
    plain = {"before": before, "after": -0.5, "movements": int(movements)}
    assert row[-1] == json.dumps(plain)


def test_a_reason_that_utf8_cannot_hold_is_recorded_readably(task):
    (row,) = Codec(task).encode(e.Ended(0, "failed", "no file \udcff.csv"))
    assert row[-1] == "no file \\udcff.csv"


@pytest.mark.parametrize(
    ("event", "message"),
    [
        (e.Told(0, {"thrown": np.zeros(2)}), r"Told.*unknown outcome kind 'thrown'.*'throw'"),
        (e.Told(0, {"throw": [0.1, 0.2]}), r"Told.*check_outcome"),
        (e.Suggested(Goal("nearness", "far")), "unknown goal kind 'nearness'"),
        (e.Planned(Plan(0, 0, "random", None, None, None, None)), "Planned"),
        (e.Session({"task": object()}), "object, which JSON cannot hold"),
        ("told", "'told' is not an event; expected one of Opened, Planned"),
    ],
)
def test_what_does_not_fit_is_refused(task, event, message):
    with pytest.raises(JournalError, match=message):
        Codec(task).encode(event)


def test_a_context_is_refused_where_the_task_has_none():
    codec = Codec(Task(Box(0, 1), {"throw": Box(0, 1)}))
    with pytest.raises(JournalError, match="no context space"):
        codec.encode(e.Opened(0, "random", None, np.zeros(1), "strategy"))


@pytest.mark.parametrize(
    ("row", "message"),
    [
        (("thought", None, None, None, None, None, None, None, None, None), "row 1 .*'thought'"),
        (("told", None, 0, None, "hop", b"", None, None, None, None), "unknown outcome kind 'hop'"),
        (("told", None, 0, None, "throw", b"abc", None, None, None, None), "ValueError"),
        (("closed", 0, None, "random", None, None, None, None, None, "{"), "JSONDecodeError"),
    ],
)
def test_a_row_that_is_no_event_is_refused(task, row, message):
    with pytest.raises(JournalError, match=message):
        list(Codec(task).decode(numbered([row])))


def test_a_further_kind_behind_an_event_without_outcome_is_refused(task):
    codec = Codec(task)
    rows = codec.encode(e.Available("expert", True))
    rows.append(("also", None, None, None, "word", b"ba", None, None, None, None))
    with pytest.raises(JournalError, match="follows Available, which has no outcome"):
        list(codec.decode(numbered(rows)))
