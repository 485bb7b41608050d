"""What a design costs in Python over the same step in C++, and whether ten thousand of them take memory.

    PYTHONPATH=build/release/python python3 python/bench/overhead.py [EVALUATIONS [POINTS [FLOWS]]]

Time: the library's own loop runs a shape interpolation on one living mesh and notes the processor time of each step,
making the domain included. The same designs are then made in Python, airfoil and all, on a mesh of the same start: the
same triangle counts prove that it is the same chain. Flows follow the same designs on a small living mesh, with all
gradients; a flow has the seconds that its search took in C++. Means and medians in microseconds.

Memory: the resident set after each tenth of the designs, and by how much the second half grew.
"""

import gc
import os
import sys
import time

import numpy as np
import remodel


def resident():
    """Bytes in memory."""
    gc.collect()
    with open("/proc/self/statm") as statm:
        return int(statm.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


def print_memory(name, sizes):
    row = " ".join(f"{size / 2**20:.1f}" for size in sizes)
    print(f"{name}: resident MB after each tenth {row}; the second half grew by {(sizes[-1] - sizes[len(sizes) // 2 - 1]) / 1024:.0f} kB")


def meshes(evaluations, points):
    """Steps of one mesh; the designs."""
    start = remodel.Airfoil("naca:0012")
    run = remodel.optimise(start, remodel.Airfoil("rae2822"), points=points, evaluations=evaluations, strategy="chain", threads=1)
    designs = [np.array(row["coefficients"]) for row in run.rows]

    mesh = remodel.generate(start, points=points)
    seconds, same, sizes = [], 0, []
    for number, (design, row) in enumerate(zip(designs, run.rows)):
        began = time.thread_time()
        step = mesh.update(start.with_design(design), strategy="chain")
        seconds.append(time.thread_time() - began)
        same += step.triangles == row["triangles"]
        if (number + 1) % (evaluations // 10) == 0:
            sizes.append(resident())
    seconds, native = 1e6 * np.array(seconds), 1e6 * run.column("remodel_seconds")
    full = run.column("full_adjustment") > 0
    print(f"{evaluations} designs, I = {points}: {same} of {len(designs)} steps with the same triangle count")
    for name, kind in (("full adjustment", full), ("replacement", ~full), ("all", full | ~full)):
        if kind.any():
            ours, theirs = seconds[kind], native[kind]
            print(f"{name:16} {kind.sum():6}  C++ {theirs.mean():8.1f} (median {np.median(theirs):8.1f})  Python {ours.mean():8.1f} "
                  f"(median {np.median(ours):8.1f})  ratio {ours.mean() / theirs.mean():.2f} ({np.median(ours) / np.median(theirs):.2f})")  # fmt: skip
    print_memory("meshes", sizes)
    began = time.perf_counter()
    for _ in range(10000):
        mesh.points
    print(f"mesh.points: {1e2 * (time.perf_counter() - began):.2f} microseconds, a view of {mesh.points.nbytes} bytes")
    return designs


def flows(designs, points=40):
    """Designs on one small mesh, each with its flow, gradients by its coefficients, and the mesh's arrays."""
    start = remodel.Airfoil("naca:0012")
    mesh, flow = remodel.generate(start, points=points), remodel.LivingFlow()
    parts, sizes, found = [], [], 0
    for number, design in enumerate(designs):
        began = time.perf_counter()
        mesh.update(start.with_design(design))
        updated = time.perf_counter()
        result = flow.solve(mesh, mach=0.4, alpha=1.0)
        solved = time.perf_counter()
        mesh.vjp(flow.gradients()["cd"]["points"])
        parts.append((updated - began, solved - updated, result.seconds, time.perf_counter() - solved))
        found += result.converged
        if (number + 1) % (len(designs) // 10) == 0:
            sizes.append(resident())
    update, solve, native, gradients = 1e6 * np.array(parts).T
    print(f"{len(designs)} flows on {len(mesh)} triangles, {found} found: C++ {native.mean():.1f} (median {np.median(native):.1f})  Python {solve.mean():.1f} "
          f"(median {np.median(solve):.1f})  ratio {solve.mean() / native.mean():.3f} ({np.median(solve) / np.median(native):.3f}); "
          f"update {update.mean():.1f}, gradients and vjp {gradients.mean():.1f}")  # fmt: skip
    print_memory("flows", sizes)


def main(evaluations=10000, points=200, count=1000):
    designs = meshes(evaluations, points)
    flows(designs[:count])


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
