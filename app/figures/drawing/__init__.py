"""Drawing of figures with matplotlib.

`style` and its sheets have colours and fonts, `panels` fills axes, `image` lays out and writes the image.
"""

import os
from importlib.util import find_spec
from pathlib import Path
from tempfile import gettempdir

try:
    gettempdir()
except FileNotFoundError:  # no folder can be written, but matplotlib needs one: it gets that of its data
    specification = find_spec("matplotlib")
    assert specification is not None
    os.environ["MATPLOTLIBRC"] = str(Path(specification.origin or "").with_name("mpl-data"))
    import matplotlib as mpl

    mpl.get_configdir = mpl.get_cachedir = mpl.get_data_path
