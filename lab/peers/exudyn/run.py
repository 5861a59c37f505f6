"""Whole runs in Exudyn, index-3 generalised-alpha: run.py (double-pendulum | n-four-bars) N STEP

The lines have a method, CPU seconds of the solver alone, what is compared, and how: the largest error of the energy [J]
for the double pendulum, the end of the first crank [m] for the four-bars.
"""
import math
import sys
import time

sys.exudynFast = True  # the package's own build without checks of ranges
import numpy as np
import exudyn as exu
from mechanisms import GRAVITY, double_pendulum, four_bars

DURATION = 10.0


def settings(step, is_large, sensors):
    s = exu.SimulationSettings()
    t = s.timeIntegration
    t.endTime, t.numberOfSteps = DURATION, round(DURATION / step)
    t.automaticStepSize = t.adaptiveStep = False
    t.verboseMode = 0
    t.newton.useModifiedNewton = True
    t.generalizedAlpha.spectralRadius = 0.9
    s.solution.file.write = False
    s.solution.sensors.active = sensors
    s.solution.sensors.writePeriod = step
    s.parallel.numberOfThreads = 1
    s.linearSolver.solverType = exu.LinearSolverType.EigenSparse if is_large else exu.LinearSolverType.EXUdense
    s.linearSolver.reuseAnalyzedPattern = is_large
    return s


def solve(m, step, sensors):
    """Assembles and integrates; CPU seconds of the integration."""
    m.mbs.Assemble()
    s = settings(step, len(m.nodes) > 20, sensors)
    solver = exu.DynamicSolverType.GeneralizedAlpha
    start = time.process_time()
    if not m.mbs.SolveDynamic(s, solverType=solver, showHints=False, showCausingItems=False):
        raise RuntimeError("the solver stopped")
    return time.process_time() - start


def energy_error(m):
    """The largest change of the energy over all steps [J]."""
    total = 0
    for sensors, (_, y, _) in zip(m.sensors, m.starts):
        q, v = (m.mbs.GetSensorStoredData(sensor) for sensor in sensors)
        total = total + 0.5 * (v[:, 1] ** 2 + v[:, 2] ** 2) + v[:, 3] ** 2 / 24 + GRAVITY * (q[:, 2] + y)
    return np.max(np.abs(total - total[0]))


def crank_end(m):
    """Where the first crank's end is at last, in x [m]."""
    turn = m.mbs.GetNodeOutput(m.nodes[0], exu.OutputVariableType.Coordinates)[2]
    return math.cos(math.pi / 2 + turn)


def main():
    if sys.argv[1] == "version":
        print(exu.config.Version())
        return
    problem, n, step = sys.argv[1], int(sys.argv[2]), float(sys.argv[3])
    exu.config.printToConsole = False
    exu.config.suppressWarnings = True
    if problem == "double-pendulum":
        seconds = solve(double_pendulum(False), step, False)
        m = double_pendulum(True)
        solve(m, step, True)
        print(f"generalised-alpha,{seconds:.6e},{energy_error(m):.17g},zero")
    else:
        m = four_bars(n, False)
        seconds = solve(m, step, False)
        print(f"generalised-alpha,{seconds:.6e},{crank_end(m):.17g},exact")


main()
