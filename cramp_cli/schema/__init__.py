"""The grammar of a deck: units, sections, curves in time."""
