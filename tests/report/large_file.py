"""A loci file of many points and modes, made from a small one: as large as anything that is traced, in a second."""

import h5py
import numpy as np

ORDER = 3


def series(p, modes):
    """Power series of s_k = -0.02 k + i (10 k + 3 sin(4 p + k)) at every p: point x mode x order."""
    phase = 4.0 * p[:, None] + modes[None, :]
    waves = [np.sin(phase), np.cos(phase), -np.sin(phase), -np.cos(phase)]
    factorial = [1.0, 1.0, 2.0, 6.0]
    coefficients = [1j * 3.0 * 4.0**k * waves[k] / factorial[k] for k in range(ORDER + 1)]
    coefficients[0] = coefficients[0] - 0.02 * modes + 10j * modes
    return np.stack(coefficients, axis=-1)


def replace(file, name, data, dtype=None):
    attributes = dict(file[name].attrs)
    del file[name]
    file.create_dataset(name, data=data, dtype=dtype)
    for key in ("units", "long_name"):
        file[name].attrs[key] = attributes[key]


def enlarge(path, n_points=2000, n_modes=100):
    """Rewrites a loci file of a system with a parameter `p` as one of many points and modes."""
    p = np.linspace(0.0, 1.0, n_points)
    modes = np.arange(1.0, n_modes + 1)
    s = series(p, modes)
    steps = n_points - 1
    text = h5py.string_dtype()
    with h5py.File(path, "r+") as file:
        coordinates = len(file["coordinate"])
        replace(file, "p", p)
        replace(file, "mode", [f"mode {i + 1}" for i in range(n_modes)], text)
        if "mode_name" in file:
            replace(file, "mode_name", [f"wave {i + 1}" for i in range(n_modes)], text)
        replace(file, "eigenvalue", s[:, :, 0])
        replace(file, "residual", np.zeros((n_points, n_modes)))
        replace(file, "condition", np.ones((n_points, n_modes)))
        replace(file, "rounding", np.full((n_points, n_modes), 1e-14))
        replace(file, "growing_unfollowed", np.zeros(n_points, dtype=np.int64))
        shapes = np.cos(np.arange(n_points * n_modes * coordinates)).reshape(n_points, n_modes, coordinates)
        replace(file, "mode_shape", shapes + 0j)
        replace(file, "equilibrium", np.zeros((n_points, coordinates)))
        replace(file, "step_length", np.diff(p))
        ends = np.zeros((steps, 2, ORDER + 1))
        ends[:, 0, 0], ends[:, 1, 0], ends[:, :, 1] = p[:-1], p[1:], 1.0
        replace(file, "step_parameter", ends)
        replace(file, "dense_output", np.stack([s[:-1], s[1:]], axis=2))
        own = np.broadcast_to(np.arange(n_modes), (steps, n_modes))
        for name, data in (("dense_block", own), ("mode_block", own), ("dense_chart", 0 * own), ("certified", 0 * own + 1)):
            replace(file, name, data.astype(np.int64))
