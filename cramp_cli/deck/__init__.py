"""Reading a deck: every mistake at once, with its line."""
