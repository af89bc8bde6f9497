"""Chapters as pages: Markdown to HTML, equations to MathML, pictures to the figures of the running service."""

import json
import re
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache, lru_cache
from importlib.resources import files
from itertools import pairwise
from typing import Any, NamedTuple

from latex2mathml.converter import convert
from markdown_it import MarkdownIt
from markdown_it.renderer import RendererHTML
from markdown_it.token import Token
from markdown_it.utils import OptionsDict
from markupsafe import Markup
from mdit_py_plugins.anchors import anchors_plugin
from mdit_py_plugins.dollarmath import dollarmath_plugin

from app.calculations import BY_PATH, CALCULATIONS, Calculation
from app.examples import examples
from app.manual import FIELDS, NAMES, Chapter, chapters
from app.manual.equations import anchor, equations, functions
from app.manual.fields import COLUMNS, SECTIONS, entries
from app.manual.results import place_of
from app.pages.query import Pairs, link, pairs_of
from app.pages.templating import example_link, model_of, page_path, rendered
from app.schema.fields import Leaf, leaves

_FUNCTION = re.compile(r"\\(?:arc)?(?:sin|cos|tan|ln|exp|sinh|cosh|tanh|operatorname\{\w+\})(?![a-z])(?:\^\{?\w+\}?)?")
_TAG = re.compile(r"\\tag\{([^}]+)\}")
_SOURCE = re.compile(r"(?:\.\./)+solvers/.*\.py")
FIXED = {
    "table_open": '<div class="scroll" tabindex="0"><table class="results">\n',
    "table_close": "</table></div>\n",
    "html_block": "",  # comments are for those who renew generated parts
    "html_inline": "",  # anchors are for readers of the repository
}
"""The HTML of parts that are the same everywhere."""


@lru_cache(maxsize=4)
def contents_page(root: str) -> str:
    """What the manual holds."""
    listed = [(chapter, headings(chapter)) for chapter in chapters().values()]
    return rendered("manual_contents.html", root, listed=listed)


@lru_cache(maxsize=32)
def chapter_page(root: str, name: str) -> str:
    """One chapter."""
    chapter, following = chapters()[name], chapters().get(dict(pairwise(NAMES)).get(name, ""))
    if name == FIELDS:
        head = _html(chapter.text.partition("\n## ")[0], root)
        table = {"sections": SECTIONS, "columns": COLUMNS, "entries": entries()}
        return rendered("manual_fields.html", root, chapter=chapter, body=head, **table)
    body = _html(chapter.text, root)
    known: dict[str, Any] = {"headings": headings(chapter), "symbols": symbols_of(chapter)}
    return rendered("manual.html", root, chapter=chapter, body=body, following=following, **known)


@lru_cache(maxsize=4)
def functions_page(root: str) -> str:
    """The functions that implement the equations."""
    return rendered("manual_functions.html", root, functions=functions())


def chapter_of(calculation: Calculation) -> Chapter:
    """The chapter about a calculation."""
    own = calculation.path.rpartition("/")[2]
    return chapters()[own if own in chapters() else model_of(calculation)]


@cache
def method_of(chapter: Chapter) -> dict[str, Any]:
    """The method of a chapter in brief, without links: a report is printed."""
    numbered = [each for each in equations().values() if each.chapter == chapter.name]
    return {
        "title": chapter.title,
        "lead": _plain(chapter.lead),
        "equations": {each.number: Markup(_mathml(each.text, "inline")) for each in numbered},  # noqa: S704  our own
        "misprints": _plain(chapter.section("Misprints and how they were decided")),
        "limits": _plain(chapter.section("Limits of validity").partition("\n\n![")[0]),
    }


class Symbol(NamedTuple):
    """A symbol, what it stands for, and the unit in which the service shows it."""

    symbol: str
    title: str
    unit: str


@cache
def symbols_of(chapter: Chapter) -> list[Symbol]:
    """The symbols of the results that a chapter says how to compute, and of the inputs of its calculations."""
    found = dict[tuple[str, str], Symbol]()
    for calculation in CALCULATIONS:
        own = leaves(calculation.request) if chapter_of(calculation) == chapter else ()
        results = (leaf for leaf in leaves(calculation.response) if _is_of(leaf, chapter))
        for leaf in (*own, *results):
            if symbol := leaf.declared.symbol:
                found.setdefault((symbol, leaf.declared.title), Symbol(symbol, leaf.declared.title, leaf.unit or ""))
    return sorted(found.values(), key=lambda each: (each.symbol.casefold(), each.title))


def _is_of(leaf: Leaf, chapter: Chapter) -> bool:
    """Whether a chapter says how a result is computed."""
    place = place_of(leaf.declared)
    return place is not None and place.chapter == chapter.name


@dataclass(frozen=True, slots=True)
class ShownStudy:
    """A study of an example that a chapter shows: its case, its page with the controls, and one of its figures."""

    title: str
    path: str
    pairs: Pairs
    page: str
    controls: dict[str, str]
    figure: str

    def address(self, file: str = "", **views: str) -> str:
        """The page, or a file below it."""
        return link(f"{self.path}/{self.page}{file}", self.pairs, **self.controls, **views)


@cache
def shown_studies() -> dict[str, ShownStudy]:
    """By the name of the picture."""
    found = {}
    for name, each in json.loads(files("app.manual").joinpath("studies.json").read_text("utf-8")).items():
        example = examples()[each["example"]]
        pairs = [*(dict(pairs_of(example.request)) | each["set"]).items()]
        path = page_path(BY_PATH[example.endpoint])
        found[name] = ShownStudy(each["title"], path, pairs, each["page"], each["controls"], each["figure"])
    return found


def _html(text: str, root: str) -> Markup:
    """Markdown of ours as HTML, its addresses below the prefix."""
    return Markup(re.sub(r'\b(href|src|srcset)="/', rf'\1="{root}/', _markdown().render(text)))  # noqa: S704


def _plain(text: str) -> Markup:
    """Markdown of ours as HTML without links."""
    return Markup(re.sub(r"</?a\b[^>]*>", "", _html(text, "")))  # noqa: S704


def headings(chapter: Chapter) -> dict[str, str]:
    """The titles of a chapter's sections by their anchors."""
    if chapter.name == FIELDS:
        return {section.lower(): section for section in SECTIONS}
    return {
        str(token.attrs["id"]): content.content
        for token, content in pairwise(_markdown().parse(chapter.text))
        if token.type == "heading_open" and token.tag == "h2"
    }


@cache
def _markdown() -> MarkdownIt:
    """CommonMark with tables, equations in dollars and headings that links can name."""
    markdown = MarkdownIt("commonmark", {"html": True}).enable("table")
    markdown.use(anchors_plugin, max_level=3)
    markdown.use(dollarmath_plugin, allow_labels=False, renderer=lambda text, _: _mathml(text, "inline"))
    markdown.core.ruler.push("figures", _figures_stand_alone)
    for rule in (_math_block, _image, _link_open, _fence):
        markdown.add_render_rule(rule.__name__.removeprefix("_"), rule)
    for name, html in FIXED.items():
        markdown.add_render_rule(name, lambda *_, html=html: html)
    return markdown


def _mathml(text: str, display: str) -> str:
    """MathML of an equation; the names of functions get the thin spaces that LaTeX sets and the converter does not."""
    spaced = _FUNCTION.sub(lambda name: rf"\,{name[0]}\,", text)
    spaced = re.sub(r"(^|[(\[{=+/|&-]|\\left.|\\\\)\s*\\,", r"\1", spaced)
    spaced = re.sub(r"\\,\s*(?=[(\[)\]])|\\,\s*(?=\\left)", "", spaced)
    return convert(spaced, display=display)


def _figures_stand_alone(state: Any) -> None:
    """A paragraph that is one picture is no paragraph, nor is the anchor of an equation."""
    for before, inline, after in zip(state.tokens, state.tokens[1:], state.tokens[2:], strict=False):
        if inline.type == "inline" and {child.type for child in inline.children} in ({"image"}, {"html_inline"}):
            before.hidden = after.hidden = True


def _math_block(_self: RendererHTML, tokens: Sequence[Token], place: int, *_: Any) -> str:
    """An equation, with its number beside it and as its anchor if it has one."""
    text = tokens[place].content
    tag = _TAG.search(text)
    math = _mathml(_TAG.sub("", text).strip(), "block")
    if tag is None:
        return f'<div class="equation scroll" tabindex="0">{math}</div>\n'
    number = tag[1]
    return (
        f'<div class="equation scroll" id="{anchor(number)}" tabindex="0" role="region" aria-label="Equation {number}">'
        f'{math}<span class="number">({number})</span></div>\n'
    )


def _image(
    renderer: RendererHTML, tokens: Sequence[Token], place: int, options: OptionsDict, environment: dict[str, Any]
) -> str:
    """The figure of an example or of a study, drawn by the service, with a link to the case or the study."""
    token = tokens[place]
    folder, _, file = str(token.attrs["src"]).removesuffix(".png").partition("/")
    if folder == "studies":
        study = shown_studies()[file]
        title, page, lead = study.title, study.address(), "The study"
        drawn = {theme: study.address(f"/figures/{study.figure}.svg", theme=theme) for theme in ("light", "dark")}
    else:
        name, _, figure = file.partition(".")
        example = examples()[name]
        calculation = BY_PATH[example.endpoint]
        title = next(each.title for each in calculation.figures if each.name == figure)
        page, lead, image = example_link(calculation, example), "The case", f"/figures/{figure}.svg"
        drawn = {
            theme: link(page_path(calculation) + image, [("example", name)], theme=theme) for theme in ("light", "dark")
        }
    caption = renderer.renderInline(token.children or [], options, environment)
    to_page = Markup('<a href="{}">{}</a>').format(page, lead)
    source = Markup('<source srcset="{}" media="(prefers-color-scheme: dark)">').format(drawn["dark"])
    shown = Markup('<img src="{}" alt="{}" loading="lazy">').format(drawn["light"], title)
    return f"<figure><picture>{source}{shown}</picture><figcaption>{caption} {to_page}.</figcaption></figure>\n"


def _link_open(
    renderer: RendererHTML, tokens: Sequence[Token], place: int, options: OptionsDict, environment: dict[str, Any]
) -> str:
    """A link to a chapter's file is one to its page, a link to a source one to the function that it names."""
    token = tokens[place]
    address = str(token.attrs["href"])
    if _SOURCE.fullmatch(address):
        token.attrs["href"] = f"/manual/functions#{tokens[place + 1].content}"
    else:
        token.attrs["href"] = re.sub(r"^([\w-]+)\.md(?=#|$)", r"/manual/\1", address)
    return renderer.renderToken(tokens, place, options, environment)


def _fence(_self: RendererHTML, tokens: Sequence[Token], place: int, *_: Any) -> str:
    return str(Markup('<pre class="scroll" tabindex="0"><code>{}</code></pre>\n').format(tokens[place].content))
