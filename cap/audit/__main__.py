"""``python -m cap.audit``."""

import sys

from cap.audit.command import main

if __name__ == "__main__":
    sys.exit(main())
