"""Kernels recognize what they are handed, and never mistake it for something else."""

import gc
import subprocess
import sys
import weakref
from typing import NamedTuple

import numba
import numpy as np
import pytest

from cramp_cli.numerics.call import REMEMBERED, records_of_one_run
from cramp_cli.numerics.kernel import kernel

compiled = pytest.mark.skipif(bool(numba.config.DISABLE_JIT), reason="nothing is compiled")


class Pair(NamedTuple):
    a: np.ndarray
    b: np.ndarray


@kernel
def _add(pair, factor, shift):
    return pair.a[0] + factor * pair.b[-1] + shift[0]


@kernel
def _call(pair):
    return _add(pair, 1.0, (0.0, 0.0))


def _pair(a=1.0, b=2.0, dtype=float):
    return Pair(np.full(3, a, dtype), np.full(3, b, dtype))


def test_what_is_new_each_time_is_read_right():
    for i in range(3 * REMEMBERED):
        assert _add(_pair(a=i), 2.0, (0.5, 0.0)) == i + 4.5


def test_what_changes_its_type_between_calls_is_read_right():
    one = _pair()
    for _ in range(3):
        assert _add(one, 2.0, (0.5, 0.0)) == 5.5
        assert _add(one, 2, (1, 0)) == 6
        assert _add(_pair(dtype=np.int64), 0.5, (0.5, 0.0)) == 2.5
        assert _add(_pair(dtype=np.float32), 0.5, (0.5, 0.0)) == 2.5


def test_arrays_that_are_not_contiguous_are_read_right():
    wide = np.arange(12.0).reshape(3, 4)
    for _ in range(3):
        assert _add(Pair(wide[:, 1], wide[:, 2]), 1.0, (0.0, 0.0)) == 11.0
        assert _add(Pair(wide[1], wide[2]), 1.0, (0.0, 0.0)) == 15.0


def test_a_known_record_shows_what_its_arrays_hold_now():
    one = _pair()
    for i in range(4):
        one.a[0] = i
        assert _add(one, 1.0, (0.0, 0.0)) == i + 2.0


@kernel
def _first(array):
    return array[0]


@kernel
def _apply(one, number):
    return one(number)


@kernel
def _double(number):
    return 2.0 * number


@kernel
def _halve(number):
    return 0.5 * number


def test_memory_maps_of_two_types_are_read_right(tmp_path):
    for dtype in (np.float64, np.int64, np.float32):
        mapped = np.memmap(tmp_path / np.dtype(dtype).name, dtype=dtype, mode="w+", shape=3)
        mapped[:] = 7
        assert [_first(mapped), _first(mapped)] == [7, 7]


def test_two_kernels_as_arguments_are_not_one():
    assert [_apply(_double, 3.0), _apply(_halve, 3.0)] == [6.0, 1.5]
    assert [_apply(_double, 3.0), _apply(_halve, 3.0)] == [6.0, 1.5]


def test_kernels_call_kernels():
    assert _call(_pair()) == 3.0


@compiled
def test_a_first_kernel_does_not_load_scipy_and_leaves_it_whole():
    code = (
        "import sys; from cramp_cli.numerics.yardstick import chain; import numpy as np\n"
        "chain(np.ones(3), 0.5); assert 'scipy.linalg' not in sys.modules\n"
        "import numba; import scipy.linalg.cython_blas\n"
        "print(numba.njit(lambda a: a @ a)(np.eye(2)).sum())"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert (done.stdout.strip(), done.stderr) == ("2.0", "")


@compiled
def test_arrays_made_anew_are_not_kept():
    """Weights of 2.5 million particles are 40 MB, made at each step."""
    made = [np.full(3, 7.0) for _ in range(2 * REMEMBERED)]
    assert [_first(one) for one in made] == [7.0] * len(made)
    alive = [weakref.ref(one) for one in made]
    del made
    gc.collect()
    assert not any(one() is not None for one in alive)


@compiled
def test_an_array_that_can_not_be_written_now_is_told_apart():
    one, before = np.full(3, 7.0), set(_first.compiled.overloads)
    for writeable in (True, True, True, False, False):
        one.setflags(write=writeable)
        assert _first(one) == 7.0
    new = set(_first.compiled.overloads) - before
    assert any(not array.mutable for (array,) in new)


@compiled
def test_records_are_kept_while_they_are_few_and_until_the_run_ends():
    with records_of_one_run():
        one = _pair()
        for _ in range(2 * REMEMBERED):
            _add(_pair(), 1.0, (0.0, 0.0))
        _call(one)
        assert len(_add._known) <= REMEMBERED
        assert len(_call._known) > 0
    assert not _add._known
    assert not _call._known
