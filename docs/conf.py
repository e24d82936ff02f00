"""How Sphinx makes the pages: `make html`; a warning is an error."""

from cramp_cli import __version__

project = "cramp"
author = "the cramp developers"
copyright = author
version = release = __version__

extensions = ["myst_parser"]
exclude_patterns = ["_build"]
myst_heading_anchors = 4  # pages link to headings as GitHub names them

html_theme = "furo"
html_title = f"cramp {version}"
html_copy_source = False
html_show_sphinx = False
