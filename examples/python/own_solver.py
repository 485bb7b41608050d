"""A solver of one's own that carries its state: temperatures around a section, by linear elements and Jacobi's method.

    python3 own_solver.py

The section is at 1, the far field at 0. The state of each design is carried to the next one's mesh (Transfer), so that
the solver has little left to do there.
"""

import numpy as np
from scipy import sparse
from scipy.sparse.linalg import cg

import remodel


def stiffness(mesh):
    """Of linear elements: the integrals of products of gradients."""
    corners = mesh.points[mesh.triangles]  # (m, 3, 2)
    edges = np.roll(corners, -1, axis=1) - np.roll(corners, 1, axis=1)  # opposite each corner
    area = 0.5 * (edges[:, 0, 0] * edges[:, 1, 1] - edges[:, 0, 1] * edges[:, 1, 0])
    local = np.einsum("mid,mjd->mij", edges, edges) / (4 * area[:, None, None])
    rows, columns = np.repeat(mesh.triangles, 3, axis=1), np.tile(mesh.triangles, 3)
    return sparse.csr_matrix((local.reshape(-1), (rows.reshape(-1), columns.reshape(-1))), shape=(len(mesh.points),) * 2)


def solve(mesh, temperature, tolerance=1e-8):
    """The temperatures, from a guess, and how many iterations they took."""
    matrix = stiffness(mesh)
    fixed = np.unique(np.concatenate([edges.reshape(-1) for edges in mesh.boundaries.values()]))
    values = np.zeros(len(mesh.points))
    values[np.unique(mesh.boundaries["airfoil"])] = 1.0
    free = np.setdiff1d(np.arange(len(mesh.points)), fixed)
    right = -(matrix @ values)[free]
    steps = []
    inner, failed = cg(matrix[free][:, free], right, x0=temperature[free], tol=tolerance, atol=0.0,
                       M=sparse.diags(1 / matrix.diagonal()[free]), callback=lambda _: steps.append(1))  # fmt: skip
    assert not failed
    values[free] = inner
    return values, len(steps)


def main(designs=5, points=100):
    airfoil = remodel.Airfoil("naca:0012")
    mesh = remodel.generate(airfoil, points=points)
    temperature, cold = solve(mesh, np.zeros(len(mesh.points)))
    print(f"from nothing: {cold} iterations")
    carried = []
    for _ in range(designs):
        airfoil = airfoil.with_design(airfoil.design * 1.01)
        step = mesh.update(airfoil, record=True)
        temperature, iterations = solve(mesh, step.transfer.ride(temperature))
        carried.append(iterations)
        print(f"carried over: {iterations} iterations, {step.preserved_percent:.0f} % of the triangles kept")
    return cold, carried, temperature, mesh


if __name__ == "__main__":
    main()
