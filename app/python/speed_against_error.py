"""Plots the speed of methods against their error, for a box that tumbles freely and strikes a wall.

    python3 speed_against_error.py OUT.svg

Each method runs with ever smaller steps; the truth is the run of method exact. Needs gnuplot.
"""
import subprocess
import sys
import time

import numpy

import careen

SCENE = {
    "careen": 1, "duration": 2, "gravity": [0, 0, -9.81],
    "walls": [{"point": [2, 0, 0], "normal": [-1, 0, 0], "restitution": 0.8}],
    "boxes": [{"half_extents": [0.4, 0.3, 0.2], "mass": 1, "position": [0, 0, 0], "velocity": [2, 0, 3],
               "angular_velocity": [3, 1, 2], "restitution": 0.8}],
}
TIMES = numpy.linspace(0, SCENE["duration"], 201)


def measured(**changes):
    """A run of the scene with these keys changed, and the least time of three runs [s]."""
    seconds = []
    for _ in range(3):
        begun = time.perf_counter()
        run = careen.simulate({**SCENE, **changes})
        seconds.append(time.perf_counter() - begun)
    return run, min(seconds)


def error(run, truth):
    """The largest distance of the box from its place in the truth [m]."""
    return numpy.abs(run.states(TIMES)["position"] - truth).max()


exact, exact_seconds = measured()
truth = exact.states(TIMES)["position"]
blocks = [f"# exact\n{exact_seconds} 1e-16"]
for method in ("listing1", "strang", "runge-kutta-4", "taylor-8"):
    rows = []
    for steps in (2, 4, 8, 16, 32, 64, 128):
        run, seconds = measured(method=method, dt=1 / (10 * steps))
        rows.append(f"{seconds} {max(error(run, truth), 1e-16)}")
        print(f"{method:15} dt {1 / (10 * steps):.5f} s  {rows[-1]}")
    blocks.append(f"# {method}\n" + "\n".join(rows))

names = ["exact", "listing1", "strang", "runge-kutta-4", "taylor-8"]
curves = ", ".join(f"$data index {i} with linespoints title '{name}'" for i, name in enumerate(names))
script = ("$data << END\n" + "\n\n\n".join(blocks) + "\nEND\n"
          f"set terminal svg size 800,500; set output '{sys.argv[1]}'; set logscale xy; set format '10^{{%L}}'\n"
          "set xlabel 'time of a run [s]'; set ylabel 'largest error of place [m]'\n"
          f"plot {curves}\n")
subprocess.run(["gnuplot"], input=script, text=True, check=True)
