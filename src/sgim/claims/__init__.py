"""What is claimed of learners, as declarations, and how runs decide it."""

from sgim.claims.claim import Chapter, Claim, Verdict, Verdicts, decide
from sgim.claims.registry import CHAPTERS, chapter
from sgim.claims.report import Report, report

__all__ = [
    "CHAPTERS",
    "Chapter",
    "Claim",
    "Report",
    "Verdict",
    "Verdicts",
    "chapter",
    "decide",
    "report",
]
