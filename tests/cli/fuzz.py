"""Decks that nobody would write: made from the schema, or from good decks by small accidents."""

import random
import re

import yaml

from cramp_cli.deck.json_schema import deck_schema

HOSTILE = (
    "", "nan", "-inf", "1e999", "1e-320", "-1", "0", "1 kg", "5 GPa", "[1, 2]", "{a: 1}",
    "!!python/object/apply:os.system ['true']", "&a [*a]", "*a", "\u00e9", "'", "[" * 80, "9" * 400,
    "1e300 m", "0x10", "2026-01-01", "- a", "~", "true", "? b", "%TAG", "\t", "a: b: c", "\x00",
)  # fmt: skip
WORDS = ("glass", "plate", "notch", "x", "y", "", "ü", "a b")
NUMBERS = (0, 1, -1, 2, 3, 0.5, 1e-3, 1e-9, 1e9, 1e-300, 1e300, 7, 64, 1e6)
UNITS = ("m", "mm", "GPa", "kg/m^3", "us", "N", "m/s", "parsec", "")
DEEPEST = 6


def mutated(text: str, seed: int) -> bytes:
    """Return a deck after one to three accidents: lines lost, doubled or moved, values replaced."""
    dice = random.Random(seed)
    lines = text.splitlines()
    for _ in range(dice.choice((1, 1, 1, 2, 3))):
        n = dice.randrange(len(lines))
        accident = dice.randrange(12)
        if accident == 0 and len(lines) > 1:
            del lines[n]
        elif accident == 1:
            lines.insert(n, lines[dice.randrange(len(lines))])
        elif accident == 2:
            lines[n] = " " * dice.randrange(5) + lines[n].strip()
        elif accident == 3:
            place = dice.randrange(len(lines[n]) + 1)
            lines[n] = lines[n][:place] + chr(dice.randrange(1, 300)) + lines[n][place:]
        elif accident < 8:
            lines[n] = _replaced(lines[n], dice)
        else:
            lines[n] = _scaled(lines[n], dice)
    data = "\n".join(lines).encode("utf-8")
    if dice.random() < 0.05:
        place = dice.randrange(len(data))
        data = data[:place] + bytes([dice.randrange(256)]) + data[place:]
    return data


def _replaced(line: str, dice) -> str:
    """Return a line with one of its numbers or words replaced."""
    found = list(re.finditer(r"[-+.\w]+", line))
    if not found:
        return line + dice.choice(HOSTILE)
    spot = dice.choice(found)
    new = dice.choice(HOSTILE) if dice.random() < 0.5 else str(dice.choice(NUMBERS))
    return line[: spot.start()] + new + line[spot.end() :]


def _scaled(line: str, dice) -> str:
    """Return a line with one of its numbers of another order or sign."""
    found = list(re.finditer(r"(?<![\w.])-?\d+\.?\d*(?:e-?\d+)?", line))
    if not found:
        return line
    spot = dice.choice(found)
    power = dice.choice((1, 1, 2, 3, 6, 12, 30, 300))
    new = float(spot[0]) * 10.0 ** (power * dice.choice((-1, 1))) * dice.choice((1, 1, -1))
    return line[: spot.start()] + repr(new) + line[spot.end() :]


def generated(good: str, seed: int) -> bytes:
    """Return a deck of which some sections are good ones and some made from the JSON Schema."""
    dice, schema = random.Random(seed), deck_schema()
    made = _section(schema, schema, dice, 0)
    mine = dice.choice((0.1, 0.3, 0.9))
    data = {key: value for key, value in made.items() if dice.random() < mine}
    for key, value in yaml.safe_load(good).items():
        data.setdefault(key, value)
    return yaml.safe_dump(data, allow_unicode=True).encode("utf-8")


def _value(rule, schema, dice, depth):
    """Return something that a rule of the schema allows, or now and then something it does not."""
    if dice.random() < 0.02:
        return dice.choice((None, True, "x", -1, [], {}, dice.choice(HOSTILE)))
    if "$ref" in rule:
        return _value(schema["$defs"][rule["$ref"].split("/")[-1]], schema, dice, depth)
    for choice in ("anyOf", "oneOf"):
        if choice in rule:
            return _value(dice.choice(rule[choice]), schema, dice, depth)
    if "const" in rule or "enum" in rule:
        return dice.choice(rule.get("enum", [rule.get("const")]))
    kind = rule.get("type")
    if kind == "object" and depth < DEEPEST:
        return _section(rule, schema, dice, depth)
    if kind == "array" and depth < DEEPEST:
        least, most = rule.get("minItems", 0), rule.get("maxItems", 3)
        rules = rule.get("prefixItems") or [rule.get("items", {})]
        count = dice.randint(least, max(most, least))
        return [_value(rules[n % len(rules)], schema, dice, depth + 1) for n in range(count)]
    return _scalar(kind, dice)


def _section(rule, schema, dice, depth):
    keys, needed = rule.get("properties", {}), rule.get("required", [])
    found = {
        key: _value(part, schema, dice, depth + 1)
        for key, part in keys.items()
        if dice.random() < (0.97 if key in needed else 0.4)
    }
    if isinstance(rule.get("additionalProperties"), dict):
        part = rule["additionalProperties"]
        found |= {dice.choice(WORDS): _value(part, schema, dice, depth + 1) for _ in range(2)}
    return found


def _scalar(kind, dice):
    number = dice.choice(NUMBERS) * dice.choice((1, 1, dice.random()))
    if kind == "integer":
        return int(min(abs(number), 1e9))
    if kind == "boolean":
        return dice.random() < 0.5
    if kind == "string":
        return f"{number} {dice.choice(UNITS)}" if dice.random() < 0.5 else dice.choice(WORDS)
    return number
