"""What a design costs in Python over the same step in C++.

    PYTHONPATH=build/release/python python3 python/bench/overhead.py [EVALUATIONS [POINTS]]

The library's own loop runs a shape interpolation on one living mesh and notes the processor time of each step, making
the domain included. The same designs are then made in Python, airfoil and all, on a mesh of the same start: the same
triangle counts prove that it is the same chain. Means and medians in microseconds.
"""

import sys
import time

import numpy as np
import remodel


def main(evaluations=3000, points=200):
    start = remodel.Airfoil("naca:0012")
    run = remodel.optimise(start, remodel.Airfoil("rae2822"), points=points, evaluations=evaluations, strategy="chain", threads=1)
    designs = [np.array(row["coefficients"]) for row in run.rows]

    mesh = remodel.generate(start, points=points)
    seconds, same = [], 0
    for design, row in zip(designs, run.rows):
        began = time.thread_time()
        step = mesh.update(start.with_design(design), strategy="chain")
        seconds.append(time.thread_time() - began)
        same += step.triangles == row["triangles"]
    seconds, native = 1e6 * np.array(seconds), 1e6 * run.column("remodel_seconds")
    full = run.column("full_adjustment") > 0
    print(f"{evaluations} designs, I = {points}: {same} of {len(designs)} steps with the same triangle count")
    for name, kind in (("full adjustment", full), ("replacement", ~full)):
        if kind.any():
            ours, theirs = seconds[kind], native[kind]
            print(f"{name:16} {kind.sum():6}  C++ {theirs.mean():8.1f} (median {np.median(theirs):8.1f})  Python {ours.mean():8.1f} "
                  f"(median {np.median(ours):8.1f})  ratio {ours.mean() / theirs.mean():.2f} ({np.median(ours) / np.median(theirs):.2f})")  # fmt: skip
    began = time.perf_counter()
    for _ in range(10000):
        mesh.points
    print(f"mesh.points: {1e2 * (time.perf_counter() - began):.2f} microseconds, a view of {mesh.points.nbytes} bytes")


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
