"""How Sphinx makes the pages: `make html`; a warning is an error."""

from html import escape

from latex2mathml.converter import convert

from cramp_cli import __version__

project = "cramp"
author = "the cramp developers"
copyright = author
version = release = __version__

extensions = ["myst_parser"]
myst_enable_extensions = ["dollarmath"]
html_math_renderer = "mathml"
exclude_patterns = ["_build"]
myst_heading_anchors = 4  # pages link to headings as GitHub names them

html_theme = "furo"
html_title = f"cramp {version}"
html_copy_source = False
html_show_sphinx = False


# What the converter leaves as it is, and what browsers leave out, before and behind the conversion.
BEFORE = ((r"\{", r"\lbrace "), (r"\}", r"\rbrace "), (r"\_", "_"))
BEHIND = (
    (">\\lbrace<", ">{<"),
    (">\\rbrace<", ">}<"),
    ('mathvariant="bold-italic"', 'style="font-weight: bold"'),
)


def setup(app):
    """Write formulas as MathML, which browsers draw by themselves: no script, no network."""
    app.add_html_math_renderer("mathml", (_inline, None), (_block, None))


def _inline(page, node):
    from docutils.nodes import SkipNode

    page.body.append(_mathml(node.astext(), "inline"))
    raise SkipNode


def _block(page, node):
    from docutils.nodes import SkipNode

    page.body.append(f'<div class="formula">{_mathml(node.astext(), "block")}</div>')
    raise SkipNode


def _mathml(latex, display):
    """Return a formula; what it was made from stands beside it for whoever copies it."""
    made = convert(_replaced(latex, BEFORE), display=display)
    return _replaced(made, BEHIND).replace("<math ", f'<math alttext="{escape(latex)}" ', 1)


def _replaced(text, pairs):
    for old, new in pairs:
        text = text.replace(old, new)
    return text
