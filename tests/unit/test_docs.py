"""The pages of docs/ say what the program does: links lead on, decks read, messages exist."""

import ast
import re
import subprocess
import sys
from html.parser import HTMLParser
from pathlib import Path

import pytest
import yaml

import cramp_cli
from cramp_cli.deck.deck import DeckError, read_deck
from cramp_cli.deck.reference import deck_reference

PACKAGE = Path(cramp_cli.__file__).parent
ROOT = Path(__file__).resolve().parents[2]
DOCS = ROOT / "docs"
PAGES = [ROOT / "README.md", *sorted(DOCS.rglob("*.md"))]
NAMES = [page.relative_to(ROOT).as_posix() for page in PAGES]
ALL_PAGES = pytest.mark.parametrize("page", PAGES, ids=NAMES)

BLOCK = re.compile(r"^```(\w*)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
LINK = re.compile(r"\]\(([^)\s]+)\)")
HEADING = re.compile(r"^#+ (.+)$", re.MULTILINE)
OUR_FILE = re.compile(r"\b(?:cramp_cli|inputs|tests|docs)/[\w./-]*\.(?:py|yaml|md|csv)\b")


def read(page):
    return page.read_text(encoding="utf-8")


def prose(page):
    """Return a page without its blocks of code."""
    return BLOCK.sub("", read(page))


def headings(page):
    return HEADING.findall(prose(page))


def anchor(heading):
    """Return the anchor that GitHub and MyST make of a heading."""
    return re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-")


def decks(page):
    """Return the blocks of a page that are whole decks: they begin with the format."""
    blocks = (text for kind, text in BLOCK.findall(read(page)) if kind == "yaml")
    return [text for text in blocks if text.startswith("cramp: 1\n")]


def texts_of_the_program():
    """Return all texts that the package holds, pieces of one text joined."""
    trees = (ast.parse(read(path)) for path in PACKAGE.rglob("*.py"))
    nodes = (node for tree in trees for node in ast.walk(tree))
    return [n.value for n in nodes if isinstance(n, ast.Constant) and isinstance(n.value, str)]


def test_the_reference_of_decks_is_what_the_program_says():
    told = "regenerate docs/decks.md: make docs"
    assert read(DOCS / "decks.md") == deck_reference(), told


def test_the_way_of_a_step_has_the_titles_of_the_step():
    titles = re.findall(r'watch\("([^"]+)"\)', read(PACKAGE / "step.py"))
    told = [heading for heading in headings(DOCS / "theory" / "step.md") if heading[0].isdigit()]
    assert told == titles


@ALL_PAGES
def test_links_lead_somewhere(page):
    for link in LINK.findall(prose(page)):
        if re.match(r"[a-z]+:", link):
            continue
        name, _, part = link.partition("#")
        target = page.parent / name if name else page
        assert target.exists(), link
        if part:
            assert part in {anchor(heading) for heading in headings(target)}, link


@ALL_PAGES
def test_files_that_are_named_exist(page):
    for name in OUR_FILE.findall(prose(page)):
        assert (ROOT / name).exists(), name


@ALL_PAGES
def test_decks_have_no_mistakes(page, tmp_path):
    for text in decks(page):
        deck = tmp_path / "deck.yaml"
        deck.write_text(text, encoding="utf-8")
        assert read_deck(deck).warnings == []


def test_every_deck_has_a_line_and_a_picture_in_the_gallery():
    page = read(DOCS / "gallery.md")
    decks = {path.name.removesuffix(".yaml") for path in (ROOT / "inputs").glob("*.yaml")}
    decks = {name for name in decks if not name.endswith(".expect")}
    assert set(re.findall(r"^\| `([\w.]+)` \|", page, re.MULTILINE)) == decks
    drawn = set(re.findall(r"\]\(gallery/(\w+)\.png\)", page))
    assert drawn == {name for name in decks if not name.endswith(".sweep")}


def test_all_pages_can_be_reached_from_the_index():
    seen, left = set(), [DOCS / "index.md"]
    while left:
        page = left.pop().resolve()
        if page.suffix == ".md" and page not in seen:
            seen.add(page)
            names = (link.partition("#")[0] for link in LINK.findall(prose(page)))
            left += [page.parent / name for name in names if name and ":" not in name]
    assert {page.resolve() for page in PAGES[1:]} <= seen


def test_messages_are_those_of_the_program():
    page = prose(DOCS / "errors.md")
    told = re.findall(r"^### (.+)$", page, re.MULTILINE)
    for more in re.findall(r"^Also: ([^.]*(?:\.\.\.[^.]*)?)", page, re.MULTILINE):
        told += [text.replace("\n", " ") for text in re.findall(r"`([^`]+)`", more)]
    assert untold_by_the_program(told) == []


def test_words_of_status_are_those_of_the_program():
    page = prose(DOCS / "theory" / "fracture.md")
    table = page.split("## The words of `status`")[1].split("\n## ")[0]
    words = re.findall(r"^\| `([^`]+)` \|", table, re.MULTILINE)
    pieces = [part.strip(" .") for word in words for part in re.split(r"\.\.\.|(?<=:) ", word)]
    assert len(words) > 20
    assert untold_by_the_program(part for part in pieces if part != "within 5 cells") == []


def untold_by_the_program(texts):
    program = texts_of_the_program()
    return [text for text in texts if not any(text in said for said in program)]


def test_the_first_mistakes_of_a_user_are_told_as_shown(tmp_path):
    """Section 5 of docs/start.md: three slips in the deck of section 3."""
    text = decks(DOCS / "start.md")[0]
    slips = {"2500 kg/m^3": "2500 lb", "nu: 0.2": "un: 0.2", "y: -20 mm": "y: -21 mm"}
    for right, wrong in slips.items():
        assert text.count(right) == 1
        text = text.replace(right, wrong)
    deck = tmp_path / "bad.yaml"
    deck.write_text(text, encoding="utf-8")
    with pytest.raises(DeckError) as caught:
        read_deck(deck)
    told = str(caught.value).replace(f"{tmp_path}/", "")
    assert told in read(DOCS / "start.md")


@pytest.fixture(scope="module")
def site(tmp_path_factory):
    """The built pages, made without a warning."""
    folder = tmp_path_factory.mktemp("site")
    words = ["-E", "-W", "--keep-going", "-q", str(DOCS), str(folder)]
    done = subprocess.run([sys.executable, "-m", "sphinx", *words], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return folder


class Reader(HTMLParser):
    """What a browser shows of a page, without code, and what it would fetch for it."""

    def __init__(self, page):
        super().__init__()
        self.shown, self.fetched, self.formulas, self.open = "", [], 0, []
        self.feed(page.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attributes):
        said = dict(attributes)
        self.formulas += tag == "math"
        if tag in ("script", "link", "img"):
            self.fetched += [said[key] for key in ("src", "href") if key in said]
        if tag in ("script", "style", "pre", "code"):
            self.open.append(tag)

    def handle_endtag(self, tag):
        if self.open and tag == self.open[-1]:
            self.open.pop()

    def handle_data(self, data):
        self.shown += "" if self.open else data


FORMULA = re.compile(r"\$\$.+?\$\$|\$[^$\n]+?(?:\n[^$\n]+?)?\$", re.DOTALL)


@pytest.mark.parametrize("page", sorted(DOCS.glob("theory/*.md")), ids=lambda page: page.stem)
def test_formulas_are_drawn_by_the_browser_alone(site, page):
    """As MathML: no LaTeX is left over, and nothing comes from another place."""
    built = Reader(site / "theory" / f"{page.stem}.html")
    code = re.compile(r"```.*?```|`[^`]*`", re.DOTALL)
    assert built.formulas == len(FORMULA.findall(code.sub("", read(page)))) > 0
    assert re.findall(r"\\\w+|\\\W|\$", built.shown) == []
    assert [name for name in built.fetched if "//" in name] == []


def test_the_citation_names_this_version():
    told = yaml.safe_load(read(ROOT / "CITATION.cff"))
    assert told["version"] == cramp_cli.__version__
