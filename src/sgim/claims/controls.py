"""The controls that the thesis's central idea needs, alike for several worlds: S1 to S3b."""

from __future__ import annotations

from sgim.claims.claim import Claim
from sgim.claims.components import lower
from sgim.claims.measures import Error


def controls(teacher: str = "", ratio: str = "sgim-im") -> tuple[Claim, ...]:
    """SGIM-ACTS, SGIM-D and SGIM-IM against learners with the same parts that choose nothing.

    Args:
        teacher: Whom all of them ask, as in ``:D3``; empty where there is one only.
        ratio: SGIM-IM, with its teacher and whatever constants it has in that world.
    """
    acts, fixed = f"sgim-acts{teacher}", f"sgim-d{teacher}"
    return (
        Claim(
            "S1",
            "Choosing pays: SGIM-ACTS beats uniformly random choice of mode and goal, and "
            "round-robin over modes, at equal movements.",
            tuple(
                lower(Error(acts), Error(f"{other}{teacher}"))
                for other in ("uniform-choice", "round-robin")
            ),
        ),
        *(
            Claim(
                f"{name}{letter}",
                f"{sentence} all demonstrations first, then {then}.",
                tuple(lower(Error(learner), Error(f"{control}{teacher}")) for learner in learners),
                reading="At equal movements; all learners may ask the same teacher.",
            )
            for name, sentence, learners in (
                ("S2", "SGIM-ACTS beats", (acts,)),
                ("S3", "SGIM-D and SGIM-IM beat", (fixed, ratio)),
            )
            for letter, then, control in (
                ("", "goal babbling over uniform goals", "demonstrations-first"),
                ("b", "SAGG-RIAC", "demonstrations-first-sagg-riac"),
            )
        ),
    )
