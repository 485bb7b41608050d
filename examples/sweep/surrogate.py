"""A surrogate of lift and drag, trained on a sweep with numpy alone.

    remodel sweep examples/sweep/turbulent.json -o sweep
    python3 examples/sweep/surrogate.py sweep/table.h5

A quadratic polynomial of the main modes of the outlines (principal components) and the angle of attack, by ridge
regression; its errors are those of sections that it was not trained on.
"""

import sys

import h5py
import numpy as np

MODES = 8  # of the outlines
RIDGE = 1e-6
TESTED = 0.2  # part of the sections


def quadratic(features):
    """1, each feature, and all their products of two."""
    count = features.shape[1]
    products = [features[:, i] * features[:, j] for i in range(count) for j in range(i, count)]
    return np.column_stack([np.ones(len(features)), features, *products])


def main(file):
    with h5py.File(file) as table:
        good = table["flows/converged"][:] == 1
        section = table["flows/section"][:][good]
        alpha = table["flows/alpha_deg"][:][good]
        values = {name: table[f"flows/{name}"][:][good] for name in ("cl", "cd", "cm")}
        outlines = np.hstack([table["sections/upper"][:], table["sections/lower"][:]])

    there = np.unique(section)
    tested = np.random.default_rng(1).permutation(there)[: max(1, int(TESTED * len(there)))]
    test = np.isin(section, tested)
    mean = outlines[np.setdiff1d(there, tested)].mean(axis=0)
    modes = np.linalg.svd(outlines[np.setdiff1d(there, tested)] - mean, full_matrices=False)[2][:MODES]
    shapes = (outlines - mean) @ modes.T
    features = np.column_stack([shapes[section], alpha])
    features = (features - features[~test].mean(axis=0)) / features[~test].std(axis=0)
    basis = quadratic(features)

    print(f"{len(there)} sections, {len(section)} flows; {len(tested)} sections of them to test with")
    for name, value in values.items():
        train = basis[~test]
        weights = np.linalg.solve(train.T @ train + RIDGE * np.eye(train.shape[1]), train.T @ value[~test])
        error = basis[test] @ weights - value[test]
        print(f"{name}: rms error {np.sqrt(np.mean(error**2)):.3g}, largest {np.abs(error).max():.3g}, "
              f"spread of the values {value[test].std():.3g}")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(sys.argv[1])
