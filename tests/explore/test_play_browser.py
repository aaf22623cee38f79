"""The page to play with as a person uses it, in Chromium: clicks, sliders, proofs, two tabs."""

import base64
import json
import re
import signal
import subprocess
import sys
import time
from http.client import HTTPConnection
from pathlib import Path
from shutil import which
from urllib.parse import urlsplit

import pytest
from selenium import webdriver
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.keys import Keys

from cap.checker.verdict import check

pytestmark = pytest.mark.browser

OPTIONS = (
    *("--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run"),
    *("--disable-background-networking", "--disable-component-update", "--disable-sync"),
    "--window-size=1700,1300",
)
PATIENCE = 90  # seconds: other tests may run beside
ALL = """
    const found = [];
    const look = (root) => { for (const each of root.querySelectorAll("*")) {
        if (each.matches(arguments[0])) found.push(each);
        if (each.shadowRoot) look(each.shadowRoot);
    } };
    look(document);
    return found;
"""
MODEL = "const m = Bokeh.documents[0].get_model_by_name(arguments[0]); return "


def serving(*more):
    """Begin to serve the page; return the process and its address."""
    words = [sys.executable, "-m", "cap.explore", "play", "--no-browser", *more]
    process = subprocess.Popen(words, stdout=subprocess.PIPE, text=True)
    return process, process.stdout.readline().split()[3]


def ended(process):
    """Interrupt a server, and return its exit status."""
    process.send_signal(signal.SIGINT)
    process.stdout.close()
    return process.wait(PATIENCE)


@pytest.fixture(scope="module")
def server():
    """Serve the page; give the process and its address."""
    process, address = serving()
    yield process, address
    assert ended(process) == 130


@pytest.fixture(scope="module")
def browser(tmp_path_factory):
    """Return a browser."""
    options = webdriver.ChromeOptions()
    for word in (*OPTIONS, f"--user-data-dir={tmp_path_factory.mktemp('browser')}"):
        options.add_argument(word)
    options.binary_location = next(filter(None, map(which, ("chromium", "google-chrome"))))
    driver = webdriver.Chrome(options=options, service=Service(which("chromedriver")))
    yield driver
    driver.quit()


@pytest.fixture
def tab(server, browser):
    """Return the page, as it begins; what its console says is read at the end."""
    opened(browser, server[1])
    browser.get_log("browser")
    yield browser
    severe = [line for line in browser.get_log("browser") if line["level"] == "SEVERE"]
    assert [line for line in severe if "favicon" not in line["message"]] == []


def opened(browser, address):
    """Open the page."""
    browser.get(address)
    until(lambda: browser.execute_script("return !!window.Bokeh && Bokeh.documents.length"))
    until(lambda: found(browser, ".bk-events"))


def until(what):
    """Wait until something is so, and return it."""
    end = time.monotonic() + PATIENCE
    while time.monotonic() < end:
        if seen := what():
            return seen
        time.sleep(0.1)
    raise TimeoutError


def found(driver, selector):
    """Return the elements, those of Bokeh's shadows too."""
    return driver.execute_script(ALL, selector)


def model(driver, name, attribute):
    """Return what a part of the page, by its name, shows."""
    return driver.execute_script(MODEL + f"m.{attribute}", name)


def button(driver, label):
    """Return the button with this label."""
    return next(each for each in found(driver, "button") if each.text == label)


def typed(driver, place, text):
    """Type a text into the field at a place, and leave it."""
    field = found(driver, "input[type=text]")[place]
    field.send_keys(Keys.END, Keys.BACKSPACE * 40, text, Keys.ENTER)


def painted(driver):
    """Return how many pixels of the portrait are not empty."""
    code = """
        const figure = Bokeh.documents[0].get_model_by_name("portrait");
        const image = figure.renderers[0].data_source.data.image[0];
        return image ? [...image].filter((k) => k > 0).length : 0;
    """
    return driver.execute_script(code)


def clicked_on_the_portrait(driver, dx, dy):
    """Click so far from the middle of the portrait."""
    place = found(driver, ".bk-events")[0]
    ActionChains(driver).move_to_element_with_offset(place, dx, dy).click().perform()


def proofs_of(process):
    """Return the processes that a server has begun, and that still run."""
    told = Path(f"/proc/{process.pid}/task/{process.pid}/children").read_text("utf-8")
    names = {int(n): Path(f"/proc/{n}/cmdline") for n in told.split()}
    return [n for n, path in names.items() if b"spawn_main" in path.read_bytes()]


def theorem(driver):
    """Return what is shown of a proof that has ended."""
    return until(lambda: model(driver, "theorem", "text"))


def test_the_portrait_fills(tab):
    """While one looks; nothing on the way says an error."""
    before = until(lambda: painted(tab))
    until(lambda: painted(tab) > before)
    assert "never turns" in model(tab, "ends", "text")


def test_a_slider_and_a_text(tab):
    """A slider writes the exact number; a number typed moves it; the portrait begins again."""
    until(lambda: painted(tab) > 100)
    handle = found(tab, ".noUi-handle")[2]
    ActionChains(tab).drag_and_drop_by_offset(handle, 4, 0).perform()
    until(lambda: model(tab, "f-text", "value") != "2/5")
    shown = model(tab, "f-text", "value")
    assert float(shown) == pytest.approx(model(tab, "f-slider", "value"), abs=1e-9)
    typed(tab, 2, "9/20")
    until(lambda: model(tab, "f-slider", "value") == pytest.approx(0.45))
    typed(tab, 5, "4/5")
    until(lambda: "period" in model(tab, "ends", "text"))
    typed(tab, 2, "<b>9</b>")
    until(lambda: "not a number: &#x27;&lt;b&gt;9&lt;/b&gt;&#x27;" in model(tab, "wrong", "text"))
    typed(tab, 2, "7/5")
    until(lambda: "below the forcing" in model(tab, "wrong", "text"))


def test_a_click(tab):
    """The orbit of the state that was clicked on, with its events; the mass moves."""
    first = until(lambda: model(tab, "events", "text"))
    clicked_on_the_portrait(tab, 40, 60)
    told = until(lambda: model(tab, "events", "text") != first and model(tab, "events", "text"))
    assert told.startswith("orbit of (x, v) = (")
    assert "hit" in told
    where = "return Bokeh.documents[0].get_model_by_name('in-time').renderers.at(-1)"
    at = [tab.execute_script(f"{where}.data_source.data.t[0]")]
    until(lambda: tab.execute_script(f"{where}.data_source.data.t[0]") not in at)


def test_a_proof(tab):
    """The theorem is typeset; its certificate is saved, and the checker accepts it."""
    button(tab, "prove this").click()
    until(lambda: model(tab, "progress", "text"))
    text = theorem(tab)
    assert "VERIFIED" in text
    until(lambda: found(tab, "mjx-container"))
    link = next(a for a in found(tab, "a[download]"))
    assert link.get_attribute("download") == "elliptic.json"
    head, _, data = link.get_attribute("href").partition(",")
    assert head == "data:application/json;base64"
    checked = check(base64.b64decode(data), [].append)
    assert str(checked.claims["x"]).replace("[", "").split(", ")[0][:12] in text
    assert json.loads(base64.b64decode(data))["theorem"] == "elliptic"


def test_a_refusal(tab):
    """What cannot be proved says why, and nothing that was typed becomes a part of the page."""
    typed(tab, 5, "9/10")
    button(tab, "prove this").click()
    assert "elastic walls" in theorem(tab)
    typed(tab, 7, "journal=/tmp/x")
    button(tab, "prove this").click()
    until(lambda: "journal" in model(tab, "theorem", "text"))
    typed(tab, 7, "<i>=1")
    button(tab, "prove this").click()
    until(lambda: "&lt;i&gt;" in model(tab, "theorem", "text"))
    assert found(tab, "i") == []


def test_two_tabs(server, tab):
    """Each has its own parameters, and its own orbit."""
    first = tab.current_window_handle
    tab.switch_to.new_window("tab")
    opened(tab, server[1])
    typed(tab, 0, "3")
    until(lambda: model(tab, "F-slider", "value") == 3)
    tab.close()
    tab.switch_to.window(first)
    assert model(tab, "F-text", "value") == "1"


def test_stop_and_close(server, tab):
    """A proof that is stopped ends, and one whose tab is closed."""
    process, _ = server
    for ends in ("stop", "close"):
        tab.execute_script(
            "const look = (m) => m.type === 'Select' ? [m] : (m.children ?? []).flatMap(look);"
            "look(Bokeh.documents[0].roots()[0])[0].value = 'conservative';"
        )
        button(tab, "prove this").click()
        until(lambda: proofs_of(process))
        until(lambda: "begins" not in model(tab, "progress", "text"))
        if ends == "stop":
            button(tab, "stop").click()
            until(lambda: model(tab, "progress", "text") == "stopped")
        else:
            last = tab.current_window_handle
            tab.switch_to.new_window("tab")
            other = tab.current_window_handle
            tab.switch_to.window(last)
            tab.close()
            tab.switch_to.window(other)
        until(lambda: not proofs_of(process))


def test_it_ends_with_the_server(browser):
    """Which says by its status that it was interrupted."""
    process, address = serving()
    opened(browser, address)
    button(browser, "prove this").click()
    (number,) = until(lambda: proofs_of(process))
    assert ended(process) == 130
    until(lambda: not Path(f"/proc/{number}/cmdline").exists())


def test_a_model(browser):
    """The page of a system of one's own: its portrait, a slider, a click, a proof, a refusal."""
    process, address = serving("--model", str(Path(__file__).parents[2] / "examples/ball.py"))
    opened(browser, address)
    until(lambda: painted(browser))
    assert "1 table per T" in model(browser, "ends", "text")
    typed(browser, 0, "13/10")
    until(lambda: model(browser, "A-slider", "value") == pytest.approx(1.3))
    until(lambda: "A = 13/10" in model(browser, "events", "text"))
    first = model(browser, "events", "text")
    clicked_on_the_portrait(browser, 60, -40)
    until(lambda: model(browser, "events", "text") != first)
    button(browser, "prove this").click()
    assert "VERIFIED" in theorem(browser)
    link = next(a for a in found(browser, "a[download]"))
    data = base64.b64decode(link.get_attribute("href").partition(",")[2])
    checked = check(data, [].append)
    assert checked.theorem == "contacts"
    assert "13/10" in data.decode()
    typed(browser, 1, "3/2")
    until(lambda: "restitution" in model(browser, "wrong", "text"))
    assert ended(process) == 130


@pytest.mark.parametrize(
    ("origin", "status"), [("http://elsewhere.example", 403), ("http://127.0.0.1:1", 403)]
)
def test_other_pages_may_not_connect(server, origin, status):
    """A websocket is for pages that this server has served."""
    code = session(server[1], origin)
    assert code == status


def test_its_own_page_may_connect(server):
    """The test above can fail."""
    assert session(server[1], server[1].rstrip("/")) == 101


def session(address, origin):
    """Return the status of a websocket that a page of this origin asks for."""
    place = urlsplit(address)
    connection = HTTPConnection(place.hostname, place.port, timeout=PATIENCE)
    connection.request("GET", "/")
    page = connection.getresponse().read().decode()
    token = re.search(r'"token":"([^"]+)"', page)[1]
    headers = {
        "Origin": origin,
        "Upgrade": "websocket",
        "Connection": "Upgrade",
        "Sec-WebSocket-Version": "13",
        "Sec-WebSocket-Key": base64.b64encode(bytes(16)).decode(),
        "Sec-WebSocket-Protocol": f"bokeh, {token}",
    }
    connection.request("GET", "/ws", headers=headers)
    status = connection.getresponse().status
    connection.close()
    return status


def test_it_listens_to_this_machine_alone(server):
    """On 127.0.0.1, and on no other address."""
    port = urlsplit(server[1]).port
    rows = [line.split() for line in Path("/proc/net/tcp").read_text("utf-8").splitlines()[1:]]
    listening = [row[1] for row in rows if row[3] == "0A" and row[1].endswith(f":{port:04X}")]
    assert listening == [f"0100007F:{port:04X}"]
    six = Path("/proc/net/tcp6")
    assert not six.exists() or f":{port:04X} 0000" not in six.read_text("utf-8")
