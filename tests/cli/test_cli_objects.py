"""Recognising objects from the command line."""


def test_a_run_with_a_caregiver_is_named_after_him_and_drawn(sgim, tmp_path) -> None:
    said = sgim(
        "run", "objects", "--caregiver", "biased", "--learner", "random", "--movements", "8"
    )
    assert said.code == 0
    assert (tmp_path / "runs" / "objects-random-biased-0.sgim").exists()
    head = next(line for line in said.out.splitlines() if line.startswith("  movements"))
    assert head.split() == ["movements", "cubes", "car", "dog", "ball", "bear", "total"]
    assert "mode ask biased" in said.out
    assert "answers" not in said.out
    drawn = sgim("plot", "runs", "--out", "figures")
    assert drawn.code == 0
    for name in ("recognised", "f-measures", "toys", "pictures"):
        drawing = tmp_path / "figures" / f"objects-random-biased-0-{name}.png"
        assert drawing.stat().st_size > 10_000
    assert drawn.err == ""


def test_an_unknown_caregiver_or_learner_is_answered_with_the_nearest(sgim) -> None:
    said = sgim("run", "objects", "--caregiver", "unbaised")
    assert said.code != 0
    assert "Did you mean 'unbiased'" in said.err
    said = sgim("run", "objects", "--learner", "sagg-riac")
    assert "unknown learner 'sagg-riac'" in said.err
    assert "sgim-acts" in said.err


def test_the_list_has_the_toys_caregivers_and_the_oracle(sgim) -> None:
    said = sgim("list")
    assert "Recognise toys" in said.out
    assert "teacher biased" in said.out
    assert "oracle" in said.out
