"""The commands of cramp: each reads its words, calls one function and prints the answer.

Results go to stdout, everything meant for a person to stderr. What a command needs is imported
inside it, so that `cramp --help` answers at once.
"""
