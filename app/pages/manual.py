"""The pages of the manual.

Markdown becomes HTML, equations become MathML, and pictures are replaced by the figures of the running service.
"""

import re
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache, lru_cache
from itertools import pairwise
from typing import Any

from latex2mathml.converter import convert
from markdown_it import MarkdownIt
from markdown_it.renderer import RendererHTML
from markdown_it.token import Token
from markdown_it.utils import OptionsDict
from markupsafe import Markup
from mdit_py_plugins.anchors import anchors_plugin
from mdit_py_plugins.dollarmath import dollarmath_plugin

from app.calculations import BY_PATH, CALCULATIONS, Calculation
from app.examples import examples, studies
from app.manual import FIELDS, NAMES, Chapter, chapters
from app.manual.equations import anchor, equations, functions
from app.manual.fields import COLUMNS, SECTIONS, Models, table
from app.manual.results import place_of
from app.manual.search import Section, search
from app.pages.query import Pairs, link, pairs_of
from app.pages.templating import example_link, model_of, page_path, rendered
from app.pages.typesetting import symbol
from app.schema.fields import Leaf, leaves
from solvers.quantity import Quantity

_FUNCTION = re.compile(r"\\(?:arc)?(?:sin|cos|tan|ln|exp|sinh|cosh|tanh|operatorname\{\w+\})(?![a-z])(?:\^\{?\w+\}?)?")
_TAG = re.compile(r"\\tag\{([^}]+)\}")
_SOURCE = re.compile(r"(?:\.\./)+solvers/.*\.py")
FIXED = {
    "table_open": '<div class="scroll" tabindex="0"><table class="results">\n',
    "table_close": "</table></div>\n",
    "html_block": "",  # comments that mark generated parts in the file
    "html_inline": "",  # anchors for links between the files; the pages have anchors of their own
}
"""HTML for the elements of Markdown that always become the same HTML. The keys are the types of the elements."""


@lru_cache(maxsize=4)
def contents_page(root: str) -> str:
    """Return the page with the table of contents."""
    listed = [(chapter, headings(chapter)) for chapter in chapters().values()]
    return rendered("manual_contents.html", root, listed=listed)


def search_page(root: str, words: str) -> str:
    """Return the page with the sections that have all words."""
    found = [(chapters()[each.section.chapter], _anchor(each.section), each) for each in search(words)]
    return rendered("manual_search.html", root, words=words, found=found)


def _anchor(section: Section) -> str:
    """Anchor of a section with its number sign; empty before the first heading and on pages with other headings."""
    if section.place < 0 or section.chapter == FIELDS:
        return ""
    return f"#{list(headings(chapters()[section.chapter]))[section.place]}"


@lru_cache(maxsize=32)
def chapter_page(root: str, name: str) -> str:
    """Return the page of a chapter."""
    chapter, following = chapters()[name], chapters().get(dict(pairwise(NAMES)).get(name, ""))
    body = _html(chapter.text, root, name)
    lists: dict[str, Any] = {"headings": headings(chapter), "symbols": symbols_of(chapter)}
    listed = chapters().values()
    return rendered("manual.html", root, chapter=chapter, body=body, following=following, listed=listed, **lists)


@lru_cache(maxsize=4)
def fields_page(root: str, others: Models) -> str:
    """Return the page with the table of all fields; `others`: see `app.manual.fields.table`."""
    chapter = chapters()[FIELDS]
    content = {"sections": SECTIONS, "columns": COLUMNS, "entries": table(others)}
    return rendered("manual_fields.html", root, chapter=chapter, body=_html(chapter.text, root), **content)


@lru_cache(maxsize=4)
def functions_page(root: str) -> str:
    """Return the page that lists the functions that implement the equations of the manual."""
    return rendered("manual_functions.html", root, functions=functions())


def chapter_of(calculation: Calculation) -> Chapter:
    """Return the chapter about a calculation."""
    own = calculation.path.rpartition("/")[2]
    return chapters()[own if own in chapters() else model_of(calculation)]


@cache
def method_of(chapter: Chapter) -> dict[str, Any]:
    """Return the summary of a chapter for reports. The summary has no links, because reports are printed."""
    numbered = [equation for equation in equations().values() if equation.chapter == chapter.name]
    return {
        "title": chapter.title,
        "lead": _plain(chapter.lead),
        "equations": {
            equation.number: Markup(_mathml(equation.text, "inline"))  # noqa: S704  the text is ours
            for equation in numbered
        },
        "misprints": _plain(chapter.section("Misprints and how they were decided")),
        "limits": _plain(chapter.section("Limits of validity").partition("\n\n![")[0]),
    }


@cache
def _results_at() -> dict[str, str]:
    """Return a list of results, as HTML, for each place of the manual that describes how results are computed."""
    named = dict[str, dict[str, None]]()
    for calculation in CALCULATIONS:
        for leaf in leaves(calculation.response):
            if place := place_of(leaf.declared):
                named.setdefault(place.address, {})[_named(leaf.declared)] = None
    return {
        address: f'<div class="landed">Results computed here:<ul><li>{"</li><li>".join(results)}</li></ul></div>\n'
        for address, results in named.items()
    }


def _named(declared: Quantity) -> str:
    """Return the title of a result, its symbol and, in brackets, its description."""
    text = f"({declared.text})" if declared.text and declared.text != declared.title else ""
    return Markup(" ").join(part for part in (declared.title, symbol(declared.symbol), text) if part)


@cache
def symbols_of(chapter: Chapter) -> list[Leaf]:
    """Return a field for each symbol that a chapter needs, sorted by the symbols."""
    symbols = dict[tuple[str, str], Leaf]()
    for calculation in CALCULATIONS:
        own = leaves(calculation.request) if chapter_of(calculation) == chapter else ()
        placed = ((leaf, place_of(leaf.declared)) for leaf in leaves(calculation.response))
        results = (leaf for leaf, place in placed if place and place.chapter == chapter.name)
        for leaf in (*own, *results):
            if symbol := leaf.declared.symbol:
                symbols.setdefault((symbol, leaf.declared.title), leaf)
    return [symbols[key] for key in sorted(symbols, key=lambda key: (key[0].casefold(), key[1]))]


@dataclass(frozen=True, slots=True)
class ShownStudy:
    """A study of an example case. A chapter of the manual shows one figure of this study.

    `path` and `pairs` form the link to the case. `page` is the name of the kind of study in the addresses of the study.
    `controls` are the settings of the study.
    """

    title: str
    path: str
    pairs: Pairs
    page: str
    controls: dict[str, str]
    figure: str

    def address(self, file: str = "", **views: str) -> str:
        """Return the address of the study's page."""
        return link(f"{self.path}/{self.page}{file}", self.pairs, **self.controls, **views)


@cache
def shown_studies() -> dict[str, ShownStudy]:
    """Return the studies that chapters show. The keys are the names of the pictures."""
    shown = {}
    for name, entry in ((name, entry) for model in studies() for name, entry in model.pictures.items()):
        example = examples()[entry["example"]]
        pairs = [*(dict(pairs_of(example.request)) | entry["set"]).items()]
        path = page_path(BY_PATH[example.endpoint])
        shown[name] = ShownStudy(entry["title"], path, pairs, entry["page"], entry["controls"], entry["figure"])
    return shown


def _html(text: str, root: str, chapter: str | None = None) -> Markup:
    """Convert Markdown of the manual to HTML, and put the prefix `root` before addresses of the service."""
    html = _markdown().render(text, {"chapter": chapter})
    return Markup(re.sub(r'\b(href|src|srcset)="/', rf'\1="{root}/', html))  # noqa: S704


def _plain(text: str) -> Markup:
    """Convert Markdown of the manual to HTML without links."""
    return Markup(re.sub(r"</?a\b[^>]*>", "", _html(text, "")))  # noqa: S704


def headings(chapter: Chapter) -> dict[str, str]:
    """Return the titles of a chapter's sections. The keys are the anchors of the sections."""
    if chapter.name == FIELDS:
        return {section.lower(): section for section in SECTIONS}
    return {
        str(token.attrs["id"]): content.content
        for token, content in pairwise(_markdown().parse(chapter.text))
        if token.type == "heading_open" and token.tag == "h2"
    }


@cache
def _markdown() -> MarkdownIt:
    """Return the converter for Markdown with tables, equations and anchors."""
    markdown = MarkdownIt("commonmark", {"html": True}).enable("table")
    markdown.use(anchors_plugin, max_level=3)
    markdown.use(dollarmath_plugin, allow_labels=False, renderer=lambda text, _: _mathml(text, "inline"))
    markdown.core.ruler.push("figures", _figures_stand_alone)
    for rule in (_math_block, _heading_close, _image, _link_open, _fence):
        markdown.add_render_rule(rule.__name__.removeprefix("_"), rule)
    for name, html in FIXED.items():
        markdown.add_render_rule(name, lambda *_, html=html: html)
    return markdown


def _mathml(text: str, display: str) -> str:
    """Convert an equation to MathML.

    Thin spaces are added around the names of functions, because LaTeX sets these spaces and the converter does not.
    """
    spaced = _FUNCTION.sub(lambda name: rf"\,{name[0]}\,", text)
    spaced = re.sub(r"(^|[(\[{=+/|&-]|\\left.|\\\\)\s*\\,", r"\1", spaced)
    spaced = re.sub(r"\\,\s*(?=[(\[)\]])|\\,\s*(?=\\left)", "", spaced)
    return convert(spaced, display=display)


def _figures_stand_alone(state: Any) -> None:
    """Remove the tags of a paragraph that contains only a picture, or only the anchor of an equation."""
    for before, inline, after in zip(state.tokens, state.tokens[1:], state.tokens[2:], strict=False):
        if inline.type == "inline" and {child.type for child in inline.children} in ({"image"}, {"html_inline"}):
            before.hidden = after.hidden = True


def _math_block(
    _self: RendererHTML, tokens: Sequence[Token], place: int, _options: OptionsDict, environment: dict[str, Any]
) -> str:
    """Return the HTML of an equation."""
    text = tokens[place].content
    tag = _TAG.search(text)
    math = _mathml(_TAG.sub("", text).strip(), "block")
    if tag is None:
        return f'<div class="equation scroll" tabindex="0">{math}</div>\n'
    number = tag[1]
    return (
        f'<div class="equation scroll" id="{anchor(number)}" tabindex="0" role="region" aria-label="Equation {number}">'
        f'{math}<span class="number">({number})</span></div>\n{_results(environment, anchor(number))}'
    )


def _heading_close(
    renderer: RendererHTML, tokens: Sequence[Token], place: int, options: OptionsDict, environment: dict[str, Any]
) -> str:
    """Return the HTML at the end of a heading, and the list of the results that the section computes."""
    section = str(tokens[place - 2].attrs.get("id", ""))
    return renderer.renderToken(tokens, place, options, environment) + _results(environment, section)


def _results(environment: dict[str, Any], section: str) -> str:
    """Return a list, as HTML, of the results that a section or an equation computes; empty if there are no results."""
    return _results_at().get(f"/manual/{environment.get('chapter')}#{section}", "")


def _image(
    renderer: RendererHTML, tokens: Sequence[Token], place: int, options: OptionsDict, environment: dict[str, Any]
) -> str:
    """Return the HTML of a picture."""
    token = tokens[place]
    folder, file = str(token.attrs["src"]).removesuffix(".png").split("/")[-2:]
    if folder == "studies":
        study = shown_studies()[file]
        title, page, lead = study.title, study.address(), "The study"
        images = {theme: study.address(f"/figures/{study.figure}.svg", theme=theme) for theme in ("light", "dark")}
    else:
        name, _, figure = file.partition(".")
        example = examples()[name]
        calculation = BY_PATH[example.endpoint]
        title = next(shown.title for shown in calculation.figures if shown.name == figure)
        page, lead, image = example_link(calculation, example), "The case", f"/figures/{figure}.svg"
        images = {
            theme: link(page_path(calculation) + image, [("example", name)], theme=theme) for theme in ("light", "dark")
        }
    caption = renderer.renderInline(token.children or [], options, environment)
    to_page = Markup('<a href="{}">{}</a>').format(page, lead)
    source = Markup('<source srcset="{}" media="(prefers-color-scheme: dark)">').format(images["dark"])
    shown = Markup('<img src="{}" alt="{}" loading="lazy">').format(images["light"], title)
    return f"<figure><picture>{source}{shown}</picture><figcaption>{caption} {to_page}.</figcaption></figure>\n"


def _link_open(
    renderer: RendererHTML, tokens: Sequence[Token], place: int, options: OptionsDict, environment: dict[str, Any]
) -> str:
    """Return the HTML at the start of a link."""
    token = tokens[place]
    address = str(token.attrs["href"])
    if _SOURCE.fullmatch(address):
        token.attrs["href"] = f"/manual/functions#{tokens[place + 1].content}"
    else:
        name, dot, section = address.partition(".md")
        if dot:
            folder, chapter = f"/{name}".split("/")[-2:]
            token.attrs["href"] = f"/manual/{folder.replace('_', '-') if chapter == 'chapter' else chapter}{section}"
    return renderer.renderToken(tokens, place, options, environment)


def _fence(_self: RendererHTML, tokens: Sequence[Token], place: int, *_: Any) -> str:
    return str(Markup('<pre class="scroll" tabindex="0"><code>{}</code></pre>\n').format(tokens[place].content))
