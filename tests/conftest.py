"""Makes the repository's root importable, so that tests can share `tests.helpers`."""

import os

# Tests run side by side, a process for each core: threads for small matrices would only be in each
# other's way. It must be said before NumPy is imported.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

from hypothesis import settings

# A busy machine makes nothing wrong, so nothing has a deadline. New counterexamples are welcome
# where somebody is there to look at them.
settings.register_profile("whatever the machine does", deadline=None)
settings.register_profile("everywhere the same", deadline=None, derandomize=True)
settings.load_profile(
    "everywhere the same" if os.environ.get("CI") else "whatever the machine does"
)
