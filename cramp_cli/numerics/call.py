"""Calls of compiled loops that do not look at what they have seen before."""

from contextlib import contextmanager
from functools import cached_property, update_wrapper

import numba
import numpy as np
from numba.extending import typeof_impl

from cramp_cli.numerics.start import leave_out_blas

REMEMBERED = 16  # sets of arguments for each kernel
WORTH = 8  # calls that must be quicker for one look at new arguments

_KERNELS = []


class Kernel:
    """A compiled loop that recognizes the records it was called with before.

    Numba looks at every array of every record at each call, to choose the machine code for its
    type: 7 us for the records of a step, and a step has thirty calls. A record can not change, so
    who it is says what its arrays are, and the machine code is called at once.
    """

    def __init__(self, function, **options):
        self._function, self._options = function, options
        self._same = {}  # what was handed, at a look: machine code, and what stays for its sake
        self._known = {}  # the same at a second look, into tuples
        self._spent = 0  # on looking at new arguments, in calls that were quicker since
        update_wrapper(self, function)
        _KERNELS.append(self)

    @cached_property
    def compiled(self):
        """Numba's function; a run wants one kernel in six, and each takes a quarter of a ms."""
        return numba.njit(**self._options)(self._function)

    def __call__(self, *args):
        """Call the machine code for the types of the arguments."""
        seen = tuple(
            [
                (a.dtype, a.ndim, a.flags.num)
                if (c := type(a)) is np.ndarray
                else (c if c in _NUMBERS else id(a))
                for a in args
            ]
        )
        same = self._same.get(seen)
        if same is not None:
            return same[0](*args)
        return self._call_with_others(seen, args)

    def _call_with_others(self, seen, args):
        """Call it for arguments that are not those of a call before; their types may be."""
        if self._spent > REMEMBERED * WORTH:  # its records are made anew all the time
            return self.compiled(*args)
        handed = tuple([_recognize(a) for a in args])
        known = self._known.get(handed)
        if known is None:
            leave_out_blas()
            result = self.compiled(*args)
            self._remember(handed, args)
            return result
        self._spent = max(self._spent - 1, 0)
        _keep(self._same, seen, (known[0], _told_by_id(args)))
        return known[0](*args)

    def _remember(self, handed, args) -> None:
        self._spent += WORTH
        exact = self.compiled.overloads.get(tuple(map(self.compiled.typeof_pyval, args)))
        if exact is None:  # numba converted an argument, which the machine code itself does not
            return
        _keep(self._known, handed, (exact.entry_point, _told_by_id(args)))

    def forget(self) -> None:
        """Let go of all records."""
        self._same.clear()
        self._known.clear()
        self._spent = 0


def _keep(table, key, entry) -> None:
    """Add an entry to a table of few; a full one begins anew."""
    if len(table) == REMEMBERED:
        table.clear()
    table[key] = entry


def _told_by_id(args) -> list:
    """Return what must stay as long as it is told by its id; arrays are told by their type."""
    return [a for a in args if type(a) is not np.ndarray]


def _recognize(value):
    """Return what is equal for two values only if numba gives them the same type."""
    kind = type(value)
    if kind in _RECORDS:
        return id(value)
    if kind is np.ndarray:
        return value.dtype, value.ndim, value.flags.num
    if kind in _NUMBERS:
        return kind
    if not issubclass(kind, tuple):  # as memory maps and kernels: their class does not say enough
        return numba.typeof(value)
    kinds = tuple(map(type, value))
    if _NUMBERS.issuperset(kinds):
        return kind, kinds
    if kind is tuple:
        return tuple([_recognize(v) for v in value])
    _RECORDS.add(kind)
    return id(value)


_NUMBERS = {float, int, bool, np.float64, np.int64, np.bool_}
_RECORDS = set()  # classes of records that hold more than numbers


@contextmanager
def records_of_one_run():
    """Let all kernels forget at the end what they were handed: the memory of a run is freed."""
    try:
        yield
    finally:
        for one in _KERNELS:
            one.forget()


@typeof_impl.register(Kernel)
def _type_in_kernels(kernel, context):
    """Kernels call each other's machine code directly."""
    return typeof_impl(kernel.compiled, context)
