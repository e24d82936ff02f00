"""The words of commands about a deck: init, check, show, schema, preview."""

import json
from pathlib import Path
from typing import Annotated

import typer

from cramp_cli.cli.words import Deck, Json, Sets, Strict


def init(
    template: Annotated[str, typer.Argument(help="Which one; see --list.")] = "center_crack",
    output: Annotated[
        Path | None, typer.Option("-o", "--output", help="The new file [<template>.yaml].")
    ] = None,
    listed: Annotated[bool, typer.Option("--list", help="Tell all templates.")] = False,
):
    """Write a commented deck that runs within a minute."""
    from cramp_cli.study.templates import list_text, write_template

    if listed:
        print(list_text())
        return
    for written in write_template(template, output):
        print(written)


def check(
    decks: Annotated[list[Path], typer.Argument(help="Decks to look at.")],
    sets: Sets = None,
    as_json: Json = False,
    report: Annotated[
        bool,
        typer.Option(
            "--report", help="Wave speeds, time step, steps, particles, memory, disk, K from J."
        ),
    ] = False,
    strict: Strict = False,
):
    """Name every mistake of a deck; run nothing."""
    from cramp_cli.commands import check_deck, say_check
    from cramp_cli.output.atomic import plain
    from cramp_cli.output.exits import DECK

    answers = [check_deck(deck, sets or [], strict, report) for deck in decks]
    if as_json:
        print(json.dumps(plain(answers), indent=2))
    else:
        for answer in answers:
            say_check(answer)
    if not all(answer["valid"] for answer in answers):
        raise typer.Exit(DECK)


def show(deck: Deck, sets: Sets = None):
    """Print a deck with all defaults, in SI units."""
    from cramp_cli.commands import load_deck
    from cramp_cli.deck.deck import to_yaml

    print(to_yaml(load_deck(deck, sets or []).resolved()), end="")


def schema():
    """Print the JSON Schema of a deck, for editors."""
    from cramp_cli.deck.json_schema import deck_schema

    print(json.dumps(deck_schema(), indent=2))


def preview(
    deck: Deck,
    output: Annotated[
        Path | None,
        typer.Option("-o", "--output", help="The picture: .png, .pdf, .svg [<deck>.png]."),
    ] = None,
    sets: Sets = None,
):
    """Draw a deck: bodies, cracks, loads, boundary, grid."""
    from cramp_cli.commands import load_deck
    from cramp_cli.study.preview import preview as draw

    print(draw(load_deck(deck, sets or []), output or Path(f"{deck.stem}.png")))
