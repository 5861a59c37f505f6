# %% [markdown]
# # A damper from a measurement
#
# A quarter of a car rolls over a bump. The height of its body was measured with noise. Which stiffness and damping of the strut explain it
# best? SciPy's `least_squares` asks for runs with other values; `replace` makes the mechanisms.

# %%
from pathlib import Path

import multibody as mbs
import numpy as np
from scipy.optimize import least_squares

ROOT = next(folder for folder in (Path.cwd(), *Path.cwd().parents) if (folder / "scenes").is_dir())
car = mbs.Mechanism(ROOT / "scenes" / "quarter-car.toml")
PATHS = ["effect.strut.stiffness", "effect.strut.damping"]
TRUE = np.array([car.get(path) for path in PATHS])  # [N/m, N s/m]
NOISE = 1e-3  # of the measurement [m]

# %%
exact = car.run().check()["body.y"]
measured = exact + np.random.default_rng(20).normal(0.0, NOISE, exact.size)


def residuals(factors: np.ndarray) -> np.ndarray:
    """Distance from the measurement, in units of its noise."""
    values = dict(zip(PATHS, (TRUE * factors).tolist(), strict=True))
    return (car.replace(values).run().check()["body.y"] - measured) / NOISE


# %%
found = least_squares(residuals, x0=[1.5, 0.6], diff_step=1e-4)
stiffness, damping = TRUE * found.x
deviation = np.sqrt(np.diag(np.linalg.inv(found.jac.T @ found.jac)))
print(f"stiffness {stiffness:7.1f} N/m   (true {TRUE[0]:7.1f}, standard deviation {TRUE[0] * deviation[0]:.1f})")
print(f"damping   {damping:7.1f} N s/m (true {TRUE[1]:7.1f}, standard deviation {TRUE[1] * deviation[1]:.1f})")
print(f"{found.nfev} steps of the search")
assert (np.abs(found.x - 1.0) < 4.0 * deviation).all()
assert (deviation < 0.01).all()
