"""A wing section on springs in compressible air: the program that computes matrices in docs/sampled-families.md.

Freedoms are plunge and pitch. The lift is quasi-steady, with the factor 1 / sqrt(1 - Mach^2) of Prandtl and Glauert, so
that the matrices are no polynomials of the speed.
"""
import numpy as np

SOUND = 340.0  # m/s


def state_matrix(V):
    """A of x' = A x at the speed V; x: plunge, pitch, and their velocities."""
    q = 0.5 * V**2 / np.sqrt(1 - (V / SOUND)**2)
    M = np.array([[1, 0.2], [0.2, 0.25]])
    K = np.array([[900, 0.03 * q], [0, 900 - 0.006 * q]])
    C = np.array([[1 + 0.03 * q / V, 0], [-0.006 * q / V, 0.3]])
    return np.block([[np.zeros((2, 2)), np.eye(2)], [-np.linalg.solve(M, K), -np.linalg.solve(M, C)]])
