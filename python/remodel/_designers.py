"""CMA-ES in the words of pycma."""

from collections import namedtuple
from collections.abc import Iterable

import numpy as np

from . import _calls
from ._core import _Cmaes
from ._errors import ArgumentError, ArgumentTypeError

_MOST_SAMPLES = 1_000_000  # at once
Result = namedtuple("Result", "xbest fbest evaluations iterations xfavorite sigma")


class CMAES:
    """CMA-ES, asked and told (N. Hansen, arXiv:1604.00772). The same seed gives the same samples everywhere.

        es = remodel.CMAES(x0, 0.05, seed=1)
        while not es.stop():
            X = es.ask()
            es.tell(X, [f(x) for x in X])
        es.result.xbest

    x0: 1 to 1000 numbers. sigma0: the initial standard deviation of every coordinate. popsize: samples per
    generation, at least 4; 0 is 4 + floor(3 ln n). maxfevals, tolx: see stop(). Raises ArgumentError. Pickles go on
    to the same samples.
    """

    @_calls.python_call(x0="array", sigma0="float", seed="int", popsize="int", maxfevals="float", tolx="float")
    def __init__(self, x0, sigma0, *, seed=1, popsize=0, maxfevals=None, tolx=1e-11):
        if not 0 <= seed < 2**64:
            raise ArgumentError(f"seed: found {seed}, expected 0 to 2**64 - 1")
        if not 0 <= popsize < 2**31:
            raise ArgumentError(f"popsize: found {popsize}, expected 0, or 4 or more")
        self._state = _Cmaes(np.asarray(x0, dtype=float), sigma0, seed, popsize)
        self.maxfevals, self.tolx = maxfevals, tolx
        self.countevals = 0
        self._best = None, np.inf

    @property
    def mean(self):
        """The centre of the distribution."""
        return self._state.mean

    @property
    def sigma(self):
        """The step size."""
        return self._state.sigma

    @property
    def popsize(self):
        """Samples per generation."""
        return self._state.population

    @property
    def countiter(self):
        """Generations so far."""
        return self._state.generation

    def ask(self, number=None):
        """A list of samples, popsize of them unless told otherwise. Infeasible ones may be replaced by ask(1)."""
        count = self.popsize if number is None else number
        if not isinstance(count, (int, np.integer)) or not 1 <= count <= _MOST_SAMPLES:
            raise ArgumentError(f"number: found {_calls.shown(count)}, expected 1 to {_MOST_SAMPLES}")
        return [self._state.ask() for _ in range(count)]

    def tell(self, solutions, function_values):
        """The values of samples, the smaller the better; NaN and infinity rank last. popsize of them make a
        generation."""
        for name, given in (("solutions", solutions), ("function_values", function_values)):
            if not isinstance(given, Iterable):
                raise ArgumentTypeError(f"{name}: found {_calls.shown(given)}, expected one for each sample")
        solutions = [_calls.reals(f"solutions[{number}]", solution) for number, solution in enumerate(solutions)]
        values = [_value(number, value) for number, value in enumerate(function_values)]
        if len(solutions) != len(values):
            raise ArgumentError(f"tell: found {len(solutions)} solutions and {len(values)} values, expected as many of both")
        for solution, value in zip(solutions, values):
            solution = solution.copy()
            self._state.tell(solution, value)
            self.countevals += 1
            if value < self._best[1]:
                self._best = solution, value

    def stop(self):
        """Why the search should end: an empty dict as long as it should not."""
        reasons = {}
        if self.maxfevals is not None and self.countevals >= self.maxfevals:
            reasons["maxfevals"] = self.maxfevals
        if self._state.largest_deviation < self.tolx:
            reasons["tolx"] = self.tolx
        return reasons

    @property
    def result(self):
        """xbest, fbest, evaluations, iterations, xfavorite (the mean) and sigma."""
        return Result(*self._best, self.countevals, self.countiter, self.mean, self.sigma)


def _value(number, value):
    """A function's value, which may be NaN or infinite, and not complex."""
    if np.iscomplexobj(value) or isinstance(value, (str, bytes)):
        raise ArgumentError(f"function_values[{number}]: found {_calls.shown(value)}, expected a real number")
    try:
        return float(value)
    except (TypeError, ValueError):
        raise ArgumentError(f"function_values[{number}]: found {_calls.shown(value)}, expected a real number") from None
