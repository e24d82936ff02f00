"""The page about a run: whole in itself, with the numbers of the run, and alive in a browser."""

import base64
import json
import re
import shutil
import subprocess
from html.parser import HTMLParser

import numpy as np
import pytest
from written import TIMES, write_run

from cramp_cli.deck.run import EnergySection
from cramp_cli.output.exits import FolderError
from cramp_cli.output.fields import read_frames
from cramp_cli.study import page_data
from cramp_cli.study.report import report
from cramp_cli.study.verdicts import _of_rest, judge

BROWSER = shutil.which("chromium") or shutil.which("chromium-browser")
FLAGS = ("--headless", "--no-sandbox", "--disable-gpu", "--disable-background-networking")


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    return write_run(tmp_path_factory.mktemp("report") / "plate.run")


@pytest.fixture(scope="module")
def page(run):
    return report(run, run.parent / "report.html").read_text(encoding="utf-8")


def data_of(page):
    return json.loads(
        re.search(r'<script type="application/json" id="data">(.*?)</script>', page)[1]
    )


def test_the_page_asks_for_nothing_else(page):
    """No address and no file: links lead within the page; the namespace of SVG is only a name."""
    links = re.findall(r"(?:src|href|url|action)\s*[=(]\s*[\"']?([^\"')\s>]+)", page)
    assert set(links) == {"#main"}
    assert set(re.findall(r"https?://[^\s\"']+", page)) == {"http://www.w3.org/2000/svg"}
    assert "@import" not in page


def test_every_element_is_closed(page):
    class Checker(HTMLParser):
        def __init__(self):
            super().__init__()
            self.open = []

        def handle_starttag(self, tag, attributes):
            if tag not in ("meta", "input", "br", "link"):
                self.open.append(tag)

        def handle_endtag(self, tag):
            assert self.open.pop() == tag

    checker = Checker()
    checker.feed(page)
    assert checker.open == []


def test_charts_hold_the_numbers_of_the_run(page):
    charts = {chart["title"]: chart for chart in data_of(page)["charts"]}
    assert list(charts) == ["K_I", "K_II", "J", "Energy", "Imbalance"]
    line, contour = charts["K_I"]["lines"]
    assert charts["K_I"]["unit"] == "MPa√m"
    assert line["time"] == list(TIMES)
    assert line["values"] == [0.0, 0.15, 0.3]
    assert line["remarks"] == ["", "closed", ""]
    assert (contour["dashed"], contour["values"]) == (True, [0.0, 0.165, 0.33])
    assert [one["name"] for one in charts["Energy"]["lines"]] == [
        *("external work", "kinetic", "strain")
    ]
    assert charts["Imbalance"]["lines"][0]["values"] == [0.0, 1e-3, 2e-3]  # percent


def test_frames_come_back_within_a_level(page, run):
    film, frames = data_of(page)["film"], list(read_frames(run / "particles.h5"))
    low, high = np.array(film["box"][:2]), np.array(film["box"][2:])
    for packed, frame in zip(film["frames"], frames, strict=True):
        levels = np.frombuffer(base64.b64decode(packed["points"]), dtype="<u2").reshape(-1, 2)
        points = low + levels / 65535 * (high - low)
        np.testing.assert_allclose(
            points, frame.points[:, :2], atol=2.0 * (high - low).max() / 65535
        )
    stress = film["quantities"][0]
    last = np.frombuffer(base64.b64decode(stress["values"][-1]), dtype="u1")
    assert stress["name"] == "von Mises stress (kPa)"
    assert set(last) == {255}
    upper, lower = film["cracks"][-1][0]
    assert upper[:2] == [0.0, 0.0005]
    assert lower[-2:] == [0.0, -0.0005]  # the way around: there above, back below


def test_a_large_run_is_thinned_evenly(run, monkeypatch):
    monkeypatch.setattr(page_data, "MOST_SQUARES", 300)  # the run has 3 frames of 320
    film = page_data.film(run)
    assert film["size"] == pytest.approx(2e-3)  # 2 of 1 mm
    assert len(base64.b64decode(film["frames"][0]["points"])) == 320 / 4 * 2 * 2


def test_frames_are_spread_over_time(monkeypatch):
    monkeypatch.setattr(page_data, "MOST_FRAMES", 4)
    assert page_data._spread(list(range(10))) == [0, 3, 6, 9]


def test_a_title_cannot_break_the_page(tmp_path):
    run = write_run(tmp_path / "x.run")
    for name in ("resolved.yaml", "input.yaml"):
        text = (run / name).read_text(encoding="utf-8")
        (run / name).write_text(text.replace("Plate with a notch", "'</script><b>{{data}}'"))
    page = report(run, tmp_path / "r.html").read_text(encoding="utf-8")
    assert "</script><b>" not in page
    assert page.count("</script>") == 2
    assert "&lt;/script&gt;&lt;b&gt;{{data}}" in page


def test_verdicts(tmp_path, run):
    marks = [verdict.mark for verdict in judge(run, EnergySection())]
    assert marks == ["good", "good", "good"]  # end, energy, status; the contour's J is not there
    bad = write_run(tmp_path / "bad.run", statuses=("ok", "ok", "closed"))
    history = (bad / "history.csv").read_text().splitlines()
    cells = history[-1].split(",")
    cells[0], cells[history[0].split(",").index("energy_error")] = "60", "0.02"
    (bad / "history.csv").write_text("\n".join([*history[:-1], ",".join(cells)]) + "\n")
    (bad / "run.log").write_text("10:00:00 warning step 60: the energy balance is off\n")
    found = judge(bad, EnergySection())
    assert [verdict.mark for verdict in found] == ["good", "bad", "look", "look"]
    assert found[1].answer == "within 2 % after 50 steps; the limit is 1 %"
    assert found[3].answer == "step 60: the energy balance is off"


def test_what_is_no_run_has_no_report(tmp_path):
    with pytest.raises(FolderError, match="not the folder of a run"):
        report(tmp_path, tmp_path / "r.html")


DRIVE = """
<script>
const CHART = "figure svg[role=img]", told = { errors: [] };
const one = (query) => document.querySelector(query);
const all = (query) => document.querySelectorAll(query);
told.svg = all(CHART).length;
window.addEventListener("error", (event) => told.errors.push(event.message));
const press = (node, key) => node.dispatchEvent(new KeyboardEvent("keydown", { key }));
const clock = one("#clock"), slider = one("#slider"), reading = one("figcaption output");
const look = () => [clock.textContent, slider.value, reading.textContent];
told.end = look();
press(one(CHART), "ArrowLeft");
told.left = look();
slider.value = 0;
slider.dispatchEvent(new Event("input"));
told.slid = look();
one("figcaption button").click();
told.hidden = one("figcaption button").getAttribute("aria-pressed");
const ground = () => getComputedStyle(document.body).backgroundColor;
told.light = ground();
one("#theme").click();
told.dark = ground();
const { width, height } = one("#canvas");
told.pixels = new Set(one("#canvas").getContext("2d").getImageData(0, 0, width, height).data).size;
told.focusable = all("button, select, input, [tabindex='0'], summary").length;
document.title = JSON.stringify(told);
</script>
"""


@pytest.mark.skipif(BROWSER is None, reason="needs Chromium")
def test_the_page_lives_in_a_browser(page, tmp_path):
    """Arrow keys and slider move the time of all charts, names hide curves, dark is dark."""
    path = tmp_path / "driven.html"
    path.write_text(page.replace("</body>", f"{DRIVE}</body>"), encoding="utf-8")
    words = [
        BROWSER,
        *FLAGS,
        f"--user-data-dir={tmp_path / 'profile'}",
        "--dump-dom",
        path.as_uri(),
    ]
    done = subprocess.run(words, capture_output=True, text=True, timeout=120)
    told = json.loads(re.search(r"<title>(.*?)</title>", done.stdout)[1].replace("&quot;", '"'))
    assert told["errors"] == []
    assert told["svg"] == 5
    assert told["end"] == ["2 µs", "2", "0.3"]
    assert told["left"] == ["1 µs", "1", "0.15"]
    assert told["slid"] == ["0 µs", "0", "0"]
    assert told["hidden"] == "false"
    assert (told["light"], told["dark"]) == ("rgb(255, 255, 255)", "rgb(20, 23, 26)")
    assert told["pixels"] > 10
    assert told["focusable"] >= 5 + 8 + 5


@pytest.mark.parametrize(
    ("rest", "mark"),
    [
        ("at rest at 0.001 s", "good"),
        ("not at rest: K still changes by 20 %", "look"),
        ("not at rest: K still changes by 20 %; solver.end_time is the limit", "bad"),
    ],
)
def test_the_verdict_on_coming_to_rest(rest, mark):
    """A deck with damping need not come to rest; one that says at_rest must."""
    (verdict,) = _of_rest({"summary": {"rest": rest}})
    assert (verdict.mark, verdict.answer) == (mark, rest)
    assert not list(_of_rest({"summary": {}}))
