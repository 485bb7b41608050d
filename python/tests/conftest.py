"""Small meshes that many tests begin with."""

import os
import signal
import threading

import numpy as np
import pytest
import remodel


@pytest.fixture
def airfoil():
    return remodel.Airfoil("naca:0012")


@pytest.fixture
def mesh(airfoil):
    return remodel.generate(airfoil, points=60)


def same(a, b):
    """Whether two meshes have the same arrays, to the last bit."""
    return all(np.array_equal(getattr(a, name), getattr(b, name)) for name in ("points", "triangles", "vertex_keys", "triangle_ids", "birth"))


def interrupt_inside(call):
    """Presses Ctrl-C in a call, later each time, until it was where the computation cannot end at once."""
    for attempt in range(1, 40):
        timer = threading.Timer(0.07 * attempt, os.kill, (os.getpid(), signal.SIGINT))
        timer.start()
        with pytest.raises(KeyboardInterrupt):
            call()
        if remodel._core._left_behind() > 0:  # it goes on, and the exception is here all the same
            return
    pytest.fail("the call always ended in order")


@pytest.fixture
def designs(airfoil):
    """A row of feasible designs around the airfoil. The seed is printed."""
    seed = 20240713
    print("seed", seed)
    random = np.random.default_rng(seed)

    def make(count, sigma=0.003):
        return [airfoil.with_design(airfoil.design + sigma * random.standard_normal(12)) for _ in range(count)]

    return make
