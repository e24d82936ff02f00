"""Functions chosen by the type of their first argument, inside and outside compiled code.

A law or a shape function is a NamedTuple of numbers; `generic` picks the body that was written for
its type. A vector is a tuple of as many numbers as there are dimensions; `by_length` picks the body
for its length. Numba decides while it compiles, so no branch is left in a loop, and the result can
be cached on disk (closures and functions passed as arguments can not).
"""

from functools import wraps

from numba.extending import overload


def generic(declaration):
    """Turn a documented, empty declaration into a function with one body per record type.

    Bodies are added with ``@name.implement(RecordType)``. They take their arguments by position, so
    every body keeps the declared order.
    """
    return _dispatched(declaration, lambda value: (type(value),), lambda t: (_record(t),))


def by_length(declaration):
    """Turn a declaration into a function with one body per length of its first tuple.

    Bodies are added with ``@name.implement(length)``; the declaration itself serves all other
    lengths. A record may have a body of its own, ``@name.implement(RecordType)``.
    """
    return _dispatched(
        declaration,
        lambda value: (type(value), len(value)),
        lambda t: (_record(t), len(t)),
        default=declaration,
    )


def _record(numba_type):
    """Return the class of a record that numba has told the type of, None for a plain tuple."""
    return getattr(numba_type, "instance_class", None)


def _dispatched(declaration, keys_of_value, keys_of_type, default=None):
    bodies = {}

    def body(keys):
        return next((bodies[key] for key in keys if key in bodies), default)

    @wraps(declaration)
    def call(first, *args):
        return body(keys_of_value(first))(first, *args)

    @overload(call, strict=False, jit_options={"forceinline": True})
    def resolve(first, *args):
        return body(keys_of_type(first))

    def implement(key):
        def add(body):
            bodies[key] = body
            return body

        return add

    call.implement = implement
    return call
