#!/usr/bin/env python3
"""Draw what jointcal says about a recording over time, or joint angles: tools/plot.py --help.

The figures are in tools/python/jointcal_tools/plot/, one file per kind. Needs numpy and matplotlib.
"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent / "python"))

try:
    import matplotlib
except ImportError:
    sys.exit("matplotlib is not installed: pip install matplotlib")
matplotlib.use("Agg")

from jointcal_tools.plot.command import main  # noqa: E402

if __name__ == "__main__":
    sys.exit(main())
