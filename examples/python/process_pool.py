"""Designs in a pool of processes: each keeps its own living mesh and flow, and sends whole results back.

    python3 process_pool.py [fork|spawn]
"""

import multiprocessing
import sys

import numpy as np

import remodel

START, POINTS = "naca:0012", 60
_living = {}


def evaluate(design):
    """The flow around a design, a FlowResult with its mesh; None where there is none."""
    if not _living:  # the first one of this process
        _living["mesh"] = remodel.generate(START, points=POINTS)
        _living["flow"] = remodel.LivingFlow(tolerance=1e-8)
    try:
        _living["mesh"].update(remodel.Airfoil(START).with_design(design))
    except remodel.GeometryError:
        return None
    result = _living["flow"].solve(_living["mesh"], mach=0.5, alpha=1.0)
    return result if result.converged else None


def main(method="spawn", count=200, processes=2):
    start = remodel.Airfoil(START).design
    designs = start + 0.005 * np.random.default_rng(1).standard_normal((count, len(start)))
    with multiprocessing.get_context(method).Pool(processes) as pool:
        results = pool.map(evaluate, designs, chunksize=10)
    lifts = np.array([np.nan if result is None else result.cl for result in results])
    print(f"{np.isfinite(lifts).sum()} of {count} flows, CL {np.nanmean(lifts):.4f} +- {np.nanstd(lifts):.4f}")
    return designs, results


if __name__ == "__main__":
    main(*sys.argv[1:2])
