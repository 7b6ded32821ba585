"""Makes the repository's root importable, so that tests can share `tests.helpers`."""

import os

from hypothesis import settings

# A busy machine makes nothing wrong, so nothing has a deadline. New counterexamples are welcome
# where somebody is there to look at them.
settings.register_profile("whatever the machine does", deadline=None)
settings.register_profile("everywhere the same", deadline=None, derandomize=True)
settings.load_profile(
    "everywhere the same" if os.environ.get("CI") else "whatever the machine does"
)
