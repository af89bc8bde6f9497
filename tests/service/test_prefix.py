"""Below a prefix every address in a page works, whether the proxy strips the prefix or passes it on."""

import json
import re
import shutil
from collections.abc import Iterator
from contextlib import ExitStack
from html import unescape
from pathlib import Path
from urllib.parse import urlsplit

import httpx
import pytest
from playwright.sync_api import Browser, expect

from app.calculations import CALCULATIONS
from app.pages.study_links import study_links
from app.pages.templating import example_link, examples_of, page_path
from tests.rexs.units import turbo_unit
from tests.support.proxy import running_proxy
from tests.support.server import PATIENCE_S, ROOT, running_server

PREFIX = "/tribodrive"
FILES = {f"{PREFIX}/rexs", f"{PREFIX}/case"}
ADDRESSES = re.compile(r'\b(?:href|src|srcset|action|formaction|data-values)="([^"#][^"]*)"')
STUDY = "x=operation.misalignment_deg&x.count=3"
# Fast enough to be asked for at every proxy.
CASES = {"/v1/coupling", "/v1/coupling/recommendation"}

pytestmark = [
    pytest.mark.service,
    pytest.mark.skipif(shutil.which("nginx") is None, reason="nginx is not installed"),
]


@pytest.fixture(scope="module")
def service() -> Iterator[str]:
    with running_server(workers=2, log_level="error", root_path=PREFIX, hosts="tribology.example, b.example") as found:
        yield found[1]


@pytest.fixture(scope="module")
def proxies(service: str, tmp_path_factory: pytest.TempPathFactory) -> Iterator[dict[str, str]]:
    """Yield the addresses of two nginx proxies: `passed` passes the prefix on, and `stripped` strips it."""
    below = {"location / {": f"location {PREFIX}/ {{", "rate=20r/s": "rate=2000r/s", "burst=60": "burst=9000"}
    stripping = below | {"proxy_pass http://tribodrive;": "proxy_pass http://tribodrive/;"}
    with ExitStack() as stack:
        yield {
            name: stack.enter_context(running_proxy(tmp_path_factory.mktemp(name), service, **conf))
            for name, conf in (("passed", below), ("stripped", stripping))
        }


def addresses_in(html: str) -> set[str]:
    """Return the addresses of all links, forms, images, styles, scripts and studies in a page."""
    found = {unescape(each) for each in ADDRESSES.findall(html)}
    studies = re.findall(r'data-study="([^"]+)"', html)
    found |= {json.loads(unescape(each))["address"] for each in studies}
    return {each for each in found if not each.startswith("data:")}


def pages() -> list[str]:
    """Return the addresses of pages of every kind, and of the pages of a case for every quick calculation."""
    found = ["/", "/docs", "/manual", "/manual/coupling", "/manual/functions"]
    for each in CALCULATIONS:
        found.append(page_path(each))
        if each.path in CASES:
            case = example_link(each, examples_of(each)[0])
            found += [case, case.replace("?", "/report?"), case.replace("?", "/vary?")]
            found += [case.replace("?", f"/{study.name}?") for study in study_links(each)]
    coupling = next(each for each in CALCULATIONS if each.path == "/v1/coupling")
    found.append(f"{example_link(coupling, examples_of(coupling)[0]).replace('?', '/vary?')}&{STUDY}")
    return found


@pytest.mark.parametrize("name", ["passed", "stripped"])
def test_every_address_of_every_page_leads_somewhere(proxies: dict[str, str], name: str) -> None:
    with httpx.Client(base_url=proxies[name], timeout=60, follow_redirects=False) as client:
        seen: dict[str, str] = {}
        for page in pages():
            answer = client.get(PREFIX + page)
            if answer.status_code == 303:
                assert answer.headers["location"].startswith(f"{PREFIX}/")
                answer = client.get(answer.headers["location"])
            assert answer.status_code == 200, page
            for address in addresses_in(answer.text):
                assert address.removeprefix(proxies[name]).startswith(f"{PREFIX}/"), (page, address)
                seen.setdefault(urlsplit(address).path, address)
        assert len(seen) > 60
        slow = {f"{PREFIX}{page_path(each)}" for each in CALCULATIONS if each.path not in CASES}
        for path, address in seen.items():
            if path in FILES or ("?" in address and path.removesuffix("/vary") in slow):
                continue  # takes files only; takes a minute
            if name == "stripped" and "?" in address:
                continue  # what a query asks for is the same behind both proxies, and was asked for behind the first
            status = client.get(address).status_code
            # An address of a form may stand alone, without the fields that it sends.
            assert status in ({200, 303} if "?" in address else {200, 303, 400, 422}), address


@pytest.mark.parametrize("name", ["passed", "stripped"])
def test_redirects_files_and_documents(proxies: dict[str, str], name: str) -> None:
    with httpx.Client(base_url=proxies[name] + PREFIX, timeout=60) as client:
        sent = client.get("/coupling?example=pahl-axial-displacement")
        assert sent.status_code == 303
        assert sent.headers["location"].startswith(f"{PREFIX}/coupling?")
        assert client.get("/openapi.json").json()["servers"] == [{"url": PREFIX}]
        sent = client.post("/rexs", files={"file": ("unit.rexs", turbo_unit().xml())})
        assert sent.headers["location"].startswith(f"{PREFIX}/rexs/")
        unit = client.get(sent.headers["location"].removeprefix(PREFIX))
        assert unit.status_code == 200
        found = addresses_in(unit.text)
        assert all(each.startswith(f"{PREFIX}/") for each in found)
        assert any("/scuffing?" in each for each in found)
        saved = client.get("/v1/examples/pahl-axial-displacement").content
        opened = client.post("/case", files={"file": ("case.json", saved)})
        assert opened.status_code == 303
        assert opened.headers["location"].startswith(f"{PREFIX}/coupling?")
        problem = client.get("/coupling?operation=1&operation.x=2")
        assert problem.status_code == 400
        assert all(each.startswith(f"{PREFIX}/") for each in addresses_in(problem.text))
        assert client.get("/v1/examples/fzg-type-a").status_code == 200


def test_the_prefix_itself_is_the_start(service: str) -> None:
    for path in (PREFIX, f"{PREFIX}/", "/"):
        answer = httpx.get(service + path, timeout=PATIENCE_S)
        assert answer.status_code == 200
        assert f'href="{PREFIX}/docs"' in answer.text


def test_only_known_hosts_are_printed(service: str) -> None:
    coupling = CALCULATIONS[0]
    report = f"{service}{PREFIX}{example_link(coupling, examples_of(coupling)[0])}".replace("?", "/report?")
    printed = {
        host: httpx.get(report, headers={"Host": host}, timeout=60).text
        for host in ("evil.example", "tribology.example", "localhost:8123")
    }
    assert "evil.example" not in printed["evil.example"]
    assert f"curl -s http://localhost:8000{PREFIX}/v1/coupling" in printed["evil.example"]
    assert f'<a href="{PREFIX}/coupling?' in printed["evil.example"]
    assert f"curl -s http://tribology.example{PREFIX}/v1/coupling" in printed["tribology.example"]
    assert f'<a href="http://localhost:8123{PREFIX}/coupling?' in printed["localhost:8123"]
    assert (
        httpx.get(f"{service}{PREFIX}/coupling/", headers={"Host": "evil.example"}, timeout=PATIENCE_S).status_code
        == 404
    )


@pytest.mark.parametrize("name", ["passed", "stripped"])
def test_a_case_in_the_browser(proxies: dict[str, str], name: str, browser: Browser) -> None:
    context = browser.new_context(base_url=proxies[name])
    context.set_default_timeout(60_000)
    page = context.new_page()
    strange: list[str] = []
    page.on("request", lambda sent: strange.append(sent.url) if not own(sent.url, proxies[name]) else None)
    page.on("response", lambda got: strange.append(got.url) if got.status >= 400 else None)
    page.goto(f"{PREFIX}/")
    page.get_by_role("link", name="Gear coupling").first.click()
    page.get_by_label("Example").select_option("pahl-axial-displacement")
    page.locator(".card").first.wait_for()
    assert urlsplit(page.url).path == f"{PREFIX}/coupling"
    field = page.locator('[id="f.operation.misalignment_deg"]')
    field.fill("0.07")
    page.wait_for_url("**misalignment_deg=0.07**")
    image = page.locator(".plot img").first
    image.scroll_into_view_if_needed()
    expect(image).to_have_js_property("complete", value=True)
    assert image.evaluate("each => each.naturalWidth") > 0
    page.get_by_role("link", name="Vary").click()
    page.locator("#f\\.x, [name=x]").first.select_option("operation.misalignment_deg")
    page.locator(".charts img").first.wait_for()
    page.goto(f"{PREFIX}/docs")
    page.get_by_text("/v1/coupling", exact=True).first.wait_for()
    context.close()
    assert strange == []


def own(url: str, proxy: str) -> bool:
    return url.startswith(("data:", f"{proxy}{PREFIX}/"))


def test_the_configuration_names_the_setting() -> None:
    assert "TRIBODRIVE_ROOT_PATH" in Path(ROOT / "deploy" / "nginx.conf").read_text("utf-8")
