"""`python -m multibody` is the command `mbs`."""

import sys

from multibody import main

sys.exit(main())
