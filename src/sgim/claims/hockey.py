"""The claims about air hockey (section 4.2.2.3), and the controls they need."""

from __future__ import annotations

from sgim.claims.claim import Chapter, Claim
from sgim.claims.components import equal, lower
from sgim.claims.controls import controls
from sgim.claims.measures import ANY, Episodes, Error, Share

SGIM_IM = "sgim-im"
SGIM_D = "sgim-d"
UNTAUGHT = ("sagg-riac", "random")

ASKING = Episodes(teacher=ANY)

CLAIMS = (
    Claim(
        "H1",
        "SGIM-IM's final error is at most a tenth of SAGG-RIAC's and of random's.",
        tuple(lower(Error(SGIM_IM), Error(other), times=0.1) for other in UNTAUGHT),
    ),
    Claim(
        "H2",
        "It is lower than both from the first evaluation.",
        tuple(lower(Error(SGIM_IM, at=1000), Error(other, at=1000)) for other in UNTAUGHT),
    ),
    Claim(
        "H3",
        "It is close to SGIM-D with its best M.",
        (equal(Error(SGIM_IM), Error(SGIM_D)),),
        reading="Close: within 20 % of the larger, in either direction. M is that of the "
        "configuration: sweep both learners for each M, as in modern,demonstration_every=10.",
    ),
    Claim(
        "H4",
        "It asks less at the end than in its first half.",
        (lower(Share(SGIM_IM, ASKING, quarter=4), Share(SGIM_IM, ASKING, half=1)),),
        reading="The end is the last quarter.",
    ),
    *controls(),
)
"""H1 to H4 are the thesis's; S1 to S3b are controls that its central idea needs."""

HOCKEY = Chapter("hockey", "Air hockey (section 4.2.2.3)", "hockey", CLAIMS)
