"""Draws figures with matplotlib: colours and fonts from `style` and its sheets, `panels` fills axes, `image` writes."""

import os
from importlib.util import find_spec
from pathlib import Path
from tempfile import gettempdir

try:
    gettempdir()
except FileNotFoundError:  # nothing can be written, and matplotlib wants a folder of its own: it gets that of its data
    specification = find_spec("matplotlib")
    assert specification is not None
    os.environ["MATPLOTLIBRC"] = str(Path(specification.origin or "").with_name("mpl-data"))
    import matplotlib as mpl

    mpl.get_configdir = mpl.get_cachedir = mpl.get_data_path
