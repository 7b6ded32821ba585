"""The messages between page and server: JSON objects over one websocket, one class a message.

The field ``what`` of each object names its class, in lower case. ``web/src/protocol.ts`` is made
from this file (``python -m sgim.web.typescript``), and a test keeps the two the same. Whatever the
page sends is checked against these types and limits before anything looks at it; a number that
is not finite, a field that is unknown or missing, or a list that is too long is refused.
"""

from __future__ import annotations

from sgim.web.protocol.lessons import (
    Asked,
    Assessed,
    Curves,
    Desk,
    Exported,
    Imported,
    ImportedTake,
    Joint,
    Pose,
    Refused,
    Role,
    Said,
    Welcome,
)
from sgim.web.protocol.page import (
    Accept,
    Arrange,
    Assess,
    Control,
    Decline,
    Export,
    Extend,
    FromPage,
    Hello,
    Import,
    Lead,
    Recall,
    Reset,
    Skip,
    Suggest,
)
from sgim.web.protocol.runs import GoalMark, Kind, ModeFacts, Outcomes, Recalled, Region, RunFacts
from sgim.web.protocol.values import GoalPoint, Most

VERSION = 1
"""Of this protocol; a page of another version asks to be loaded again."""

LARGEST_MESSAGE = 1 << 20
"""Bytes of the largest message that the server reads."""

FromServer = (
    Welcome
    | Role
    | RunFacts
    | Outcomes
    | Desk
    | Pose
    | Assessed
    | Said
    | Recalled
    | Exported
    | Imported
    | Refused
)
"""Everything that the server may send."""

__all__ = [
    "Accept",
    "Arrange",
    "Asked",
    "Assess",
    "Assessed",
    "Control",
    "Curves",
    "Decline",
    "Desk",
    "Export",
    "Exported",
    "Extend",
    "FromPage",
    "FromServer",
    "GoalMark",
    "GoalPoint",
    "Hello",
    "Import",
    "Imported",
    "ImportedTake",
    "Joint",
    "Kind",
    "LARGEST_MESSAGE",
    "Lead",
    "ModeFacts",
    "Most",
    "Outcomes",
    "Pose",
    "Recall",
    "Recalled",
    "Refused",
    "Region",
    "Reset",
    "Role",
    "RunFacts",
    "Said",
    "Skip",
    "Suggest",
    "VERSION",
    "Welcome",
]
