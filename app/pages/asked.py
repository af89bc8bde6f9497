"""The case that a query or a form asks for."""

from collections.abc import Mapping
from dataclasses import replace

from app.calculations import BY_PATH, Calculation
from app.errors import Unreadable
from app.examples import examples
from app.pages.cases import Asked, key_of
from app.pages.query import WRITTEN, from_form, normalised, pairs_of_query, split_views
from app.pages.templating import example_link, page_path


def asked_in(calculation: Calculation, text: str, root: str, answers: Mapping[str, bytes]) -> tuple[Asked, bool]:
    """Return the case that `text` asks for, and whether `text` is already the shortest link to this case.

    `text` is a query string or the content of a form. The shortest link has no empty fields. `root` is the prefix that
    a proxy puts before the addresses of the service. `answers` holds recently calculated answers under the keys that
    `key_of` makes.
    """
    fields = pairs_of_query(text)
    pressed = WRITTEN in dict(fields)
    sent, looks = split_views(from_form(calculation.request, fields))
    given = {name: value for name, value in looks.items() if value}
    if (example := examples().get(dict(sent).get("example", ""))) is not None:
        if example.endpoint != calculation.path:
            raise Unreadable(
                f"The example {example.name} belongs to the page {page_path(BY_PATH[example.endpoint])}; open the "
                "example there"
            )
        sent = pairs_of_query(example_link(calculation, example).partition("?")[2])
        return Asked(page_path(calculation), sent, given, root=root), False
    pairs = normalised(calculation.request, sent)
    asked = Asked(page_path(calculation), pairs, given, root=root)
    kept, kept_ref = (answers.get(key_of(asked.path, variant)) for variant in (pairs, asked.ref_pairs))
    asked = replace(asked, kept=kept, kept_ref=kept_ref, pressed=pressed)
    return asked, not pressed and pairs == sent and given == looks
