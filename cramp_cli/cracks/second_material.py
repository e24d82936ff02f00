"""K of a tip whose domain holds a second material.

The auxiliary field of the interaction integral is that of the material at the tip everywhere. Where
the compliance S differs from that at the tip, S_tip, strain and stress of this field do not belong
together, and the integral has one more term (Yu, Wu, Guo, Du, He 2009; with it no interface inside
the domain, of any shape, needs an integral of its own):

I += sum V { tau_ij (S_tip - S)_ijkl (s_kl q_,1 + s_kl,1 q) },  s the auxiliary stress,

the first part because the strain of a particle is S tau and not S_tip tau.
"""

from cramp_cli.cracks.curved import stress_slope_along
from cramp_cli.cracks.domain_integral import local_stress, seen_from_tip
from cramp_cli.cracks.williams import unit_stress
from cramp_cli.numerics.kernel import kernel


@kernel
def compliance(hooke, tau, s):
    """Return tau_ij S_ijkl s_kl in the plane (Pa); tau, s: xx, yy, xy (Pa)."""
    trace = hooke.plane_nu * (tau[0] + tau[1]) * (s[0] + s[1])
    return (tau[0] * s[0] + tau[1] * s[1] + 2.0 * tau[2] * s[2] - trace) / (2.0 * hooke.shear)


@kernel
def add_difference(particles, frame, tip, other, R0, R1, lo, hi):
    """Return what a second material adds to K_I and K_II (Pa sqrt(m)) times the thickness.

    tip, other: Hooke at the tip and of particles lo..hi
    """
    X, stress, volume = particles.origin, particles.stress, particles.volume
    I1, I2 = 0.0, 0.0
    for p in range(lo, hi):
        r, angle, q, qx, _, y, axes = seen_from_tip(X, frame, p, R0, R1)
        if q == 0.0:
            continue
        tau = local_stress(axes[1], stress, p)
        for mode in (1, 2):
            s = unit_stress(mode, r, angle)
            ds = stress_slope_along(mode, r, angle, frame.bend, y)
            falling = (compliance(tip, tau, s) - compliance(other, tau, s)) * qx
            within = (compliance(tip, tau, ds) - compliance(other, tau, ds)) * q
            if mode == 1:
                I1 += volume[p] * (falling + within)
            else:
                I2 += volume[p] * (falling + within)
    return 0.5 * tip.stiffness * I1, 0.5 * tip.stiffness * I2
