"""From the data of a figure to the bytes of an image: sheet, layout and formats. Equal figures give equal bytes."""

from io import BytesIO
from itertools import pairwise
from textwrap import fill
from typing import Any, NamedTuple

from matplotlib import rcParams
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.backends.backend_pdf import FigureCanvasPdf
from matplotlib.backends.backend_svg import FigureCanvasSVG
from matplotlib.figure import Figure as Sheet
from matplotlib.layout_engine import ConstrainedLayoutEngine
from matplotlib.text import Text

from app.figures.data import Figure, Panel, ThemeName
from app.figures.drawing.panels import draw_panel, place_texts
from app.figures.drawing.style import DPI, TEXT, TITLE, WIDTH, themed
from app.figures.wording import subscripts

EDGE = 0.1  # inches around everything
TITLE_LINE, FINDING_LINE = 1.3 * TITLE / 72.0, 1.3 * TEXT / 72.0  # inches: 1.3 of the size of the letters
TITLE_LENGTH, FINDING_LENGTH = 58, 84  # characters of a line
HEIGHTS = {1: 2.6, 2: 1.65, 3: 1.3}  # inches, of panels above each other
PLANE_HEIGHT = 3.3  # inches, of a field over two axes
ROW_HEIGHT = 0.3  # inches, of a row of bars with a name of up to two lines
ABSCISSA_LENGTH = 30  # characters of a line below axes that stand beside others
ABSCISSA = 0.45  # inches, ticks and name
CANVASES = {"svg": FigureCanvasSVG, "png": FigureCanvasAgg, "pdf": FigureCanvasPdf}
# Neither date nor version, so that equal figures give equal bytes.
METADATA: dict[str, dict[str, str | None]] = {
    "svg": {"Date": None, "Creator": None},
    "png": {"Software": None},
    "pdf": {"CreationDate": None, "Creator": None, "Producer": None},
}


def draw(figure: Figure, image_format: str, theme: ThemeName = "light") -> bytes:
    """The image as svg, png or pdf."""
    with themed(theme):
        sheet, _ = laid_out(figure)
        sheet.set_dpi(DPI[image_format])
        image, metadata = BytesIO(), METADATA[image_format] | {"Title": figure.title}
        canvas: Any = CANVASES[image_format](sheet)
        getattr(canvas, f"print_{image_format}")(image, metadata=metadata)  # `savefig` draws everything twice
        return image.getvalue()


class Place(NamedTuple):
    """Where the axes of a panel lie in the image.

    `box` is left, top, width and height as fractions of the image; `x` and `y` are the two ends of an axis and whether
    it is logarithmic.
    """

    panel: Panel
    box: tuple[float, float, float, float]
    x: tuple[float, float, bool]
    y: tuple[float, float, bool]


def places(figure: Figure) -> list[Place]:
    """Where the axes of each panel lie in the image."""
    with themed("light"):
        _, axes = laid_out(figure)
    found = []
    for panel, each in zip(figure.panels, axes, strict=True):
        box = each.get_position()
        x, y = (*each.get_xlim(), panel.x.log), (*each.get_ylim(), panel.y.log)
        found.append(Place(panel, (box.x0, 1.0 - box.y1, box.width, box.height), x, y))
    return found


def size(figure: Figure) -> tuple[float, float]:
    """Width and height of the image in inches."""
    heights = [_height(panel, figure) for panel in figure.panels]
    named = sum(bool(panel.rows) or panel.x != below.x for panel, below in pairwise(figure.panels))
    body = max(heights) + ABSCISSA if figure.beside else sum(heights) + ABSCISSA * (1 + named)
    return WIDTH, body + EDGE + _head(figure)[-1]


def _head(figure: Figure) -> tuple[str, str, float, float]:
    """Title and finding in lines, and how far below the top of the image the finding begins and the panels."""
    title, finding = fill(figure.title, TITLE_LENGTH), fill(figure.subtitle, FINDING_LENGTH)
    below = EDGE + TITLE_LINE * (1 + title.count("\n"))
    return title, finding, below, below + FINDING_LINE * (1 + finding.count("\n"))


def _height(panel: Panel, figure: Figure) -> float:
    """Height of a panel without what stands below it, in inches."""
    if panel.rows:
        return ROW_HEIGHT * (len({row.name for row in panel.rows}) + (1 if panel.levels or panel.title else 0.3))
    if panel.equal or panel.areas:
        return PLANE_HEIGHT / 1.5 if figure.beside else PLANE_HEIGHT
    return HEIGHTS[1 if figure.beside else min(len(figure.panels), max(HEIGHTS))]


def laid_out(figure: Figure) -> tuple[Sheet, list[Axes]]:
    """The sheet with everything on it at its place, and the axes of the panels; inside the theme's settings."""
    (title, finding, below, above), (width, height) = _head(figure), size(figure)
    engine = ConstrainedLayoutEngine(rect=(0, 0, 1, 1.0 - (above + EDGE) / height), w_pad=EDGE, h_pad=EDGE / 2)
    sheet = Sheet(figsize=(width, height), dpi=DPI["svg"], layout=engine)
    FigureCanvasAgg(sheet)  # measures texts
    style: dict[str, Any] = {"va": "top", "linespacing": 1.2}
    sheet.text(EDGE / width, 1.0 - EDGE / height, title, fontsize=TITLE, fontweight="bold", **style)
    sheet.text(EDGE / width, 1.0 - below / height, finding, fontsize=TEXT, color=rcParams["axes.labelcolor"], **style)
    axes = _axes(sheet, figure) if figure.panels else []
    for each, panel in zip(axes, figure.panels, strict=True):
        draw_panel(each, panel, _height(panel, figure))
        if figure.beside:
            each.set_xlabel(fill(panel.x.label, ABSCISSA_LENGTH))
    sheet.align_ylabels([each for each, panel in zip(axes, figure.panels, strict=True) if not panel.rows])
    for text in sheet.findobj(Text):
        typeset = subscripts(text.get_text(), _symbol)
        if typeset != text.get_text():
            text.set(text=typeset, parse_math=True)
    if axes:
        engine.execute(sheet)
    sheet.set_layout_engine("none")
    for each, panel in zip(axes, figure.panels, strict=True):
        place_texts(each, panel)
    return sheet, axes


def _symbol(letter: str, subscript: str) -> str:
    """A symbol for matplotlib to typeset."""
    return rf"${letter}_\mathrm{{{subscript.replace(',', '{,}')}}}$"


def _axes(sheet: Sheet, figure: Figure) -> list[Axes]:
    """Axes above or beside each other; an axis that two share is named once."""
    panels, heights = figure.panels, [_height(each, figure) for each in figure.panels]
    count, ratios = ((1, len(panels)), None) if figure.beside else ((len(panels), 1), heights)
    axes = list(sheet.subplots(*count, squeeze=False, height_ratios=ratios).flat)
    for (before, above), (panel, each) in pairwise(zip(panels, axes, strict=True)):
        if figure.beside:
            each.yaxis.label.set_visible(panel.y.label != before.y.label)
        elif before.x == panel.x:
            each.sharex(above)
            if not panel.rows:
                above.tick_params(labelbottom=False)
                above.xaxis.label.set_visible(False)
    return axes
