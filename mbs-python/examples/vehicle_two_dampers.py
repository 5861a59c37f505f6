# %% [markdown]
# # A vehicle over a bump, with two dampers
#
# The Bombardier Iltis rolls over a bump of 0.2 m at 5 m/s. The force of its dampers is a polynomial of the rate, in three branches. Half of
# it and twice of it are compared: the largest vertical acceleration of the chassis, and how much of the bounce is left at the end.

# %%
from pathlib import Path

import multibody as mbs
import numpy as np

ROOT = next(folder for folder in (Path.cwd(), *Path.cwd().parents) if (folder / "scenes").is_dir())
iltis = mbs.Mechanism(ROOT / "scenes" / "iltis-bump-5.toml")

# %% [markdown]
# `replace` takes paths as sweeps write them. A row of `coefficients` is a branch: its two ends, then the coefficients.

# %%
places = [(0, 2), (0, 3), (1, 3), (1, 4), (1, 5), (1, 6), (2, 2), (2, 3)]
dampers = [f"damper-{end}-{side}" for end in ("front", "rear") for side in ("left", "right")]
paths = [f'effect."{damper}".coefficients[{row}][{column}]' for damper in dampers for row, column in places]
published = {path: iltis.get(path) for path in paths}
peaks: dict[float, float] = {}
swings: dict[float, float] = {}
for factor in (0.5, 1.0, 2.0):
    result = iltis.replace({path: factor * value for path, value in published.items()}).run().check()
    late = result.t > 2.0
    peaks[factor] = float(np.abs(result["acceleration.z"]).max())
    swings[factor] = float(np.ptp(result["chassis.z"][late]))
    print(f"{factor} of the damper: at most {peaks[factor]:.3f} m/s^2, {1e3 * swings[factor]:5.2f} mm of bounce after 2 s")

# %% [markdown]
# Harder dampers calm the vehicle sooner.

# %%
assert swings[2.0] < swings[1.0] < swings[0.5]
assert abs(peaks[1.0] - 2.282) < 0.01  # of the published vehicle
