"""Makes the repository's root importable, so that tests can share `tests.helpers`."""

import os

from hypothesis import settings

# New counterexamples are welcome where somebody is there to look at them.
settings.register_profile("everywhere the same", derandomize=True)
if os.environ.get("CI"):
    settings.load_profile("everywhere the same")
