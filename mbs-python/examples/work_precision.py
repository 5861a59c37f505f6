# %% [markdown]
# # What accuracy costs
#
# `compare` runs the methods that can run a scene over a range of steps, against a reference of 32 digits. For each required error it ranks
# them by the CPU time that they need. A method of order p loses p digits of error for each digit of its step.

# %%
import multibody as mbs

b = mbs.Mechanism.build("two rods", dimension=2)
b.gravity([0.0, -9.81])
b.duration(0.5)
upper = b.body("upper", mass=1.0, rod={"from": [0, 0], "to": [1, 0]})
lower = b.body("lower", mass=0.5, rod={"from": [1, 0], "to": [1.5, 0]})
b.joint("pivot", "revolute", [b.ground, upper], at=[0, 0])
b.joint("elbow", "revolute", [upper, lower], at=[1, 0])
b.output("tip", body=lower, at=[1.5, 0])
rods = b.done()

# %%
report = rods.compare(["index-3", "recursive"], errors=[1e-3, 1e-6])
assert report["reference"]["is_verified"]
for goal in report["ranking"]:
    print(f"error {goal['error']:g}:")
    for rank in goal["ranks"]:
        print(f"  {rank['rank']}. {rank['name']:40} {1e3 * rank['seconds']:8.3f} ms")

# %% [markdown]
# The orders that the runs show, beside those of the rules.

# %%
orders = {method["name"]: method["fit"]["order"] for method in report["methods"] if (method["fit"] or {}).get("order")}
for name, order in orders.items():
    print(f"{name:40} order {order:.2f}")
assert abs(orders["index-3, f64"] - 2.0) < 0.1  # trapezoidal rule
assert abs(orders["recursive rk4, f64"] - 4.0) < 0.3  # the classical Runge-Kutta method
