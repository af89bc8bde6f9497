"""The templates and the variables that they share: calculations and examples, with the addresses of their pages."""

from functools import cache, lru_cache
from hashlib import sha256
from importlib.resources import files
from typing import Any

from jinja2 import Environment, PackageLoader, StrictUndefined

from app.calculations import CALCULATIONS, Calculation
from app.examples import Example, examples
from app.figures import MEDIA_TYPES
from app.manual.results import place_of
from app.pages.charts import in_columns
from app.pages.form import anchor, link_to, title_of
from app.pages.query import link, pairs_of
from app.pages.typesetting import cited, lasting, shown, symbol, typeset, words
from app.schema.answers import MODEL_VERSION

ASSETS = {file.name: file.read_bytes() for file in files("app.pages").joinpath("static").iterdir()}
"""The contents of the files to which pages refer. The keys are the names of the files."""


def rendered(template: str, root: str, **context: Any) -> str:
    """Return the page made from a template; `root` is the prefix that a proxy puts before the service's addresses."""
    return _environment(root).get_template(template).render(**context)


def page_path(calculation: Calculation) -> str:
    """Return the address of the page of a calculation."""
    return calculation.path.removeprefix("/v1")


def model_of(calculation: Calculation) -> str:
    """Return the name of the machine model to which a calculation belongs, such as "drive-train"."""
    return page_path(calculation).split("/")[1]


def examples_of(calculation: Calculation) -> list[Example]:
    """Return the examples of a calculation. Examples that suit as a starting point come first."""
    return [example for example in examples().values() if example.endpoint == calculation.path]


def example_link(calculation: Calculation, example: Example) -> str:
    """Return the address of the page of an example."""
    return link(page_path(calculation), pairs_of(example.request))


@cache
def by_model() -> dict[str, list[Calculation]]:
    """Return the calculations by the name of their machine model.

    The drive train comes first, because it combines the other machine models.
    """
    models: dict[str, list[Calculation]] = {"drive-train": []}
    for calculation in CALCULATIONS:
        models.setdefault(model_of(calculation), []).append(calculation)
    return models


@lru_cache(maxsize=4)
def _environment(root: str) -> Environment:
    """Environment of the templates. The filter `url` puts the prefix of the proxy before an address of the service."""

    def url(address: str) -> str:
        return root + address if address.startswith("/") else address

    def asset_address(name: str) -> str:
        """Return the address of a file; the address changes with the content of the file."""
        return url(f"/static/{name}?{sha256(ASSETS[name]).hexdigest()[:12]}")

    environment = Environment(
        loader=PackageLoader("app.pages"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.globals |= {
        "menu": [
            [(page_path(calculation), calculation.title) for calculation in calculations]
            for calculations in by_model().values()
        ],
        "version": MODEL_VERSION,
        "asset": asset_address,
        "anchor": anchor,
        "field_link": link_to,
        "field_title": title_of,
        "formats": MEDIA_TYPES,
        "place_of": place_of,
    }
    environment.filters |= {
        "cited": cited,
        "lasting": lasting,
        "shown": shown,
        "symbol": symbol,
        "typeset": typeset,
        "words": words,
    }
    environment.filters |= {"columns": in_columns, "url": url}
    return environment
