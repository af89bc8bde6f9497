"""What the pages of all studies share; each kind has its own part in `app.studies.kinds`.

controls        the controls of a form and the parts of the body that they set, in one list
page            the page before, during and after the calculation; made in workers
stream          the page while its lines arrive
"""

from typing import Any

from app.pages.study_kinds import study_pages


def __getattr__(name: str) -> Any:
    """The pages of studies by their links, as the HTTP layer still asks for them."""
    if name == "PAGES":
        return {page.link: page for page in study_pages()}
    raise AttributeError(name)
