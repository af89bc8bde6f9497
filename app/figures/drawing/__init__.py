"""Drawing of figures with matplotlib.

`style` and the style sheets hold colours and fonts, `panels` draws the contents of axes, and `image` lays out a figure
and writes the image.
"""

import os
from importlib.util import find_spec
from pathlib import Path
from tempfile import gettempdir

try:
    gettempdir()
except FileNotFoundError:  # no folder is writable, so let matplotlib use the folder of its own data
    specification = find_spec("matplotlib")
    assert specification is not None
    os.environ["MATPLOTLIBRC"] = str(Path(specification.origin or "").with_name("mpl-data"))
    import matplotlib as mpl

    mpl.get_configdir = mpl.get_cachedir = mpl.get_data_path
