"""Safe YAML with the words of version 1.2."""

import math
import re
import time

import pytest
import yaml
from hypothesis import example, given, settings
from hypothesis import strategies as st

from cramp_cli.schema import loader
from cramp_cli.schema.depth import too_deep
from cramp_cli.schema.loader import decode, load, plain_scalar, read_source
from cramp_cli.schema.mistake import DeckError


def mistake(text):
    return str(DeckError(all_mistakes(lambda: load(text, "d.yaml"))))


def all_mistakes(reading):
    """Those that stop the reading, or those that were noted on the way."""
    try:
        return reading().mistakes
    except DeckError as error:
        return error.mistakes or ["none"]


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("1e-3", 1e-3),
        ("2e11", 2e11),
        ("1.", 1.0),
        (".5", 0.5),
        ("+3", 3),
        ("010", 10),
        ("0o10", 8),
        ("0x1F", 31),
        ("true", True),
        ("FALSE", False),
        ("~", None),
        ("", None),
        ("-.inf", -math.inf),
        ("NO", "NO"),
        ("yes", "yes"),
        ("on", "on"),
        ("1_000", "1_000"),
        ("12:30", "12:30"),
        ("2001-01-01", "2001-01-01"),
        ("1e", "1e"),
        ("2 mm", "2 mm"),
        ("٣", "٣"),
    ],
)
def test_words_of_yaml_1_2(text, value):
    """YAML 1.2.2, section 10.3.2 (core schema)."""
    found = load(f"a: {text}\n").data["a"]
    assert found == value
    assert type(found) is type(value)


def test_not_a_number_and_huge_integers():
    assert math.isnan(plain_scalar(".nan"))
    assert plain_scalar("9" * 5000) == math.inf


def test_quotes_make_text():
    assert load("""a: ['1', "true", ~]""").data == {"a": ["1", "true", None]}


def test_marks_point_at_key_and_value():
    marks = load("a:\n  b:   [x, {c: 3}]\nü: é\n").marks
    assert marks[("a",)][:4] == (2, 3, 1, 1)
    assert marks[("a", "b")][:4] == (2, 8, 2, 3)
    assert marks[("a", "b", 1)][:4] == (2, 12, 2, 12)
    assert marks[("a", "b", 1, "c")][:4] == (2, 16, 2, 13)
    assert marks[("ü",)][:4] == (3, 4, 3, 1)


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("a: 1\nb: 2\na: 3\n", "d.yaml:3:1: a: duplicate key; 'a' stands already in line 1"),
        (
            "s: {a: 1,\n a: {b: 1, b: 2}}",
            "d.yaml:2:2: s.a: duplicate key; 'a' stands already in line 1\n"
            "d.yaml:2:12: s.a.(second).b: duplicate key; 'b' stands already in line 2",
        ),
        ("a: &x 1", "d.yaml:1:4: anchors (&) and aliases (*) are not allowed; repeat the value"),
        ("a: *x", "d.yaml:1:4: anchors (&) and aliases (*) are not allowed; repeat the value"),
        ("a: !!python/name:os.system x", None),
        ("a: !x 1", "d.yaml:1:4: tags such as !x are not allowed"),
        ("a: 1\n--- \nb: 2", "d.yaml:2:1: a deck is one document; remove this '---'"),
        ("a: 1\n[1]: 2", None),
        ("? [1]\n: 2", "d.yaml:1:3: a key must be a plain word"),
        ("?\n: 1", "d.yaml:1:2: a key is missing before ':'"),
        ("a:\n  : 1", None),
        ("a: 1\n\tb: 2", "d.yaml:2:1: tab used for indentation; use spaces"),
        ("a:\n  - 1\n\t- 2", "d.yaml:3:1: tab used for indentation; use spaces"),
        ("a: 1\nb: x\0y", "d.yaml:2:5: character U+0000 is not allowed in a deck"),
        ("a: \ud800", "d.yaml:1:4: character U+D800 is not allowed in a deck"),
        ("{" * 65, f"d.yaml:1:65: {loader.TOO_DEEP}"),
        ("[" * 100000, f"d.yaml:1:65: {loader.TOO_DEEP}"),
        ("a: 1\nb:\n  - {c: " + "[\n" * 1000, f"d.yaml:66:1: {loader.TOO_DEEP}"),
        ("- " * 100000, f"d.yaml:1:129: {loader.TOO_DEEP}"),
    ],
)
def test_what_is_refused(text, found):
    message = mistake(text)
    if found:
        assert message == found
    assert message.startswith("d.yaml:")


@pytest.mark.parametrize(
    ("text", "line", "hint"),
    [
        ("a: b: c", 1, "a value that holds ': ' must stand in quotes"),
        ("a:\n  b: [1, 2\nc: 3", 3, "what begins with [ in line 2 is not closed rightly"),
        ("a: 'x", 1, "what begins with ' in line 1 is not closed rightly"),
        ("a: {b: 1]", 1, "what begins with { in line 1 is not closed rightly"),
    ],
)
def test_what_is_no_yaml_is_told_in_our_words(text, line, hint):
    """The library's own words, which change from release to release, come behind in brackets."""
    assert re.match(rf"d\.yaml:{line}:\d+: not valid YAML: {re.escape(hint)} \(", mistake(text))


def test_the_library_is_not_asked_about_what_is_too_deep(monkeypatch):
    """Its own bound on depth, and its words for it, are another one in every release."""
    monkeypatch.setattr(loader, "SCANNER", None)
    assert mistake("a: " + "[" * 65).endswith(loader.TOO_DEEP)


def nested(leaf):
    lists = st.lists(leaf, min_size=1, max_size=2).map(lambda some: f"[{', '.join(some)}]")
    pairs = leaf.map(lambda one: f"{{a b: {one}}}") | leaf.map(lambda one: f'{{"]": {one}}}')
    return lists | pairs | leaf.map(lambda one: f"[ # [[\n {one},]")


words = st.sampled_from(["1 mm", "it's", "'[ it''s'", '"{\\"["', "a:b", "a#b", "~"])
lines = st.sampled_from(
    [
        "a: {}",
        "- {}",
        "- a: {}",
        "? {}",
        "{}",
        "a: |\n  [[\n  [\nb: {}",
        "# [\na:\n  {}",
        "- >\n [\n- {}",
    ]
)


@settings(max_examples=300)
@given(st.recursive(words, nested, max_leaves=30), lines, st.integers(1, 6))
def test_depth_is_that_of_the_brackets(value, line, deepest):
    """As the events of the library tell, which come too late for what is far too deep."""
    text, depth, most = line.replace("{}", value), 0, 0
    for event in yaml.parse(text):
        flow = getattr(event, "flow_style", None)
        if flow:
            depth, most = depth + 1, max(most, depth + 1)
        elif isinstance(event, yaml.SequenceEndEvent | yaml.MappingEndEvent):
            depth = max(depth - 1, 0)
    assert (too_deep(text, deepest) is not None) == (most > deepest)


def test_a_billion_laughs():
    text = "a: &a [x]\n" + "".join(f"{c}: &{c} [*{b}, *{b}]\n" for b, c in ("ab", "bc", "cd"))
    assert "anchors" in mistake(text)


@pytest.mark.parametrize(
    ("raw", "found"),
    [
        (b"\xef\xbb\xbfa: 1", "d:1:1: starts with a byte order mark; save it as UTF-8 without BOM"),
        ("a: 1".encode("utf-16"), "d:1:1: is UTF-16; save it as UTF-8"),
        (b"a: 1\nb: \xe4\n", "d:2:4: byte 0xe4 is not UTF-8; save as UTF-8"),
    ],
)
def test_bytes_that_are_no_utf_8(raw, found):
    with pytest.raises(DeckError) as caught:
        decode(raw, "d")
    assert str(caught.value) == found


def test_size_is_bounded(tmp_path, monkeypatch):
    monkeypatch.setattr(loader, "LARGEST", 1 << 20)
    path = tmp_path / "big.yaml"
    path.write_bytes(b"a" * ((1 << 20) + 1))
    with pytest.raises(DeckError, match="is larger than 1 MiB"):
        read_source(str(path))


def test_number_of_entries_is_bounded(monkeypatch):
    monkeypatch.setattr(loader, "MOST_ENTRIES", 1000)
    with pytest.raises(DeckError, match="csv file"):
        load("[" + "1," * (loader.MOST_ENTRIES + 1))


def test_a_missing_file_is_an_os_error(tmp_path):
    with pytest.raises(FileNotFoundError):
        read_source(str(tmp_path / "none.yaml"))
    with pytest.raises(IsADirectoryError):
        read_source(str(tmp_path))


@pytest.mark.parametrize("text", ["", "# nothing\n", "---\n", "~"])
def test_nothing_in_it(text):
    assert load(text).data is None


yamlish = st.text(alphabet="ab:{}[],-?&*!|>'\"#%@ \n\t01.e~é\0", max_size=60)


@settings(max_examples=400)
@given(st.text(max_size=60) | yamlish)
@example("a: |\n \tb")
@example("%YAML 9.9\n--- a")
def test_random_text_gives_data_or_a_deck_error(text):
    assert "none" not in all_mistakes(lambda: load(text))


@settings(max_examples=200)
@given(st.binary(max_size=60))
def test_random_bytes_give_data_or_a_deck_error(raw):
    assert "none" not in all_mistakes(lambda: load(decode(raw, "d")))


def test_deep_nesting_is_refused_quickly():
    begin = time.perf_counter()
    mistake("[" * 2_000_000)
    mistake("a: " * 300_000)
    mistake("- " * 300_000)
    assert time.perf_counter() - begin < 5.0
