"""Read the form of a page as a browser reads and sends it."""

from html.parser import HTMLParser

Pairs = list[tuple[str, str]]


class _Form(HTMLParser):
    """This parser reads the form with the id `form`.

    `pairs` holds the names and texts of the controls, and `offers` holds the values that each of the selects offers.
    """

    def __init__(self) -> None:
        super().__init__()
        self.pairs: Pairs = []
        self.offers: dict[str, list[str]] = {}
        self._inside = False
        self._select = ""
        self._area: str | None = None

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        given = {name: value or "" for name, value in attrs}
        if tag == "form":
            self._inside = given.get("id") == "form"
        if not self._inside:
            return
        if tag == "input" and (given.get("type") != "radio" or "checked" in given):
            self.pairs.append((given["name"], given.get("value", "")))
        elif tag == "textarea":
            self._area = ""
            self.pairs.append((given["name"], ""))
        elif tag == "select":
            self._select = given["name"]
            self.offers[self._select] = []
        elif tag == "option":
            if not self.offers[self._select]:
                self.pairs.append((self._select, given["value"]))
            elif "selected" in given:
                self.pairs[-1] = (self._select, given["value"])
            self.offers[self._select].append(given["value"])

    def handle_data(self, data: str) -> None:
        if self._area is not None:
            self._area += data

    def handle_endtag(self, tag: str) -> None:
        if tag == "textarea" and self._area is not None:
            self.pairs[-1] = (self.pairs[-1][0], self._area)
            self._area = None
        elif tag == "form":
            self._inside = False


def read_form(html: str) -> tuple[Pairs, dict[str, list[str]]]:
    """Return the fields that the form of a page sends if nobody edits it, and the values that each select offers."""
    form = _Form()
    form.feed(html)
    return form.pairs, form.offers
