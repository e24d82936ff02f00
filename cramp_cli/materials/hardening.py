"""How the yield stress of a metal rises with plastic strain, rate and heat."""

from math import exp, log
from typing import NamedTuple

from cramp_cli.numerics.dispatch import generic


class LinearHardening(NamedTuple):
    """Y + H eps."""

    yield_stress: float  # Y, Pa
    modulus: float  # H, Pa


class PowerHardening(NamedTuple):
    """Y (1 + eps/eps0)^n (Swift 1952)."""

    yield_stress: float  # Y, Pa
    strain: float  # eps0
    exponent: float  # n


class VoceHardening(NamedTuple):
    """Y + (S - Y) (1 - exp(-eps/eps0)) (Voce 1948)."""

    yield_stress: float  # Y, Pa
    saturation: float  # S, Pa
    strain: float  # eps0


class JohnsonCook(NamedTuple):
    """(A + B eps^n) (1 + C ln(rate/rate0)) (1 - T*^m) (Johnson and Cook 1983).

    T* = (T - T_room)/(T_melt - T_room) is `start` plus `heating` times the energy dissipated: the
    particle keeps its heat. Below rate0 the rate does nothing.
    """

    A: float  # Pa
    B: float  # Pa
    n: float
    C: float
    rate: float  # rate0, 1/s
    m: float
    start: float  # T* at the start
    heating: float  # change of T* by energy dissipated per initial volume, m^3/J


@generic
def yield_stress(hardening, strain, rate, dissipated):
    """Return the yield stress (Pa).

    strain: equivalent plastic strain; rate: of it (1/s); dissipated: energy per volume (J/m^3)
    """


@yield_stress.implement(LinearHardening)
def _(hardening, strain, rate, dissipated):
    return hardening.yield_stress + hardening.modulus * strain


@yield_stress.implement(PowerHardening)
def _(hardening, strain, rate, dissipated):
    return hardening.yield_stress * (1.0 + strain / hardening.strain) ** hardening.exponent


@yield_stress.implement(VoceHardening)
def _(hardening, strain, rate, dissipated):
    room = hardening.saturation - hardening.yield_stress
    return hardening.saturation - room * exp(-strain / hardening.strain)


@yield_stress.implement(JohnsonCook)
def _(hardening, strain, rate, dissipated):
    cold = hardening.A + hardening.B * strain**hardening.n
    fast = 1.0 + hardening.C * log(max(rate / hardening.rate, 1.0))
    heat = min(max(hardening.start + hardening.heating * dissipated, 0.0), 1.0)
    return cold * fast * (1.0 - heat**hardening.m)
