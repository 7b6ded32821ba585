"""Makes ``python -m sgim.cli`` the same as ``sgim``."""

import sys

from sgim.cli import main

sys.exit(main())
