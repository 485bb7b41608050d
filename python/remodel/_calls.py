"""Arguments looked at by name before the compiled part sees them.

extend() puts a Python function before every public call of the compiled part. It has the call's signature, for
inspect.signature() and help(); it refuses complex numbers, which the compiled part would lose half of, and what is not
finite; and it says which argument has a wrong type, where pybind11 would list all of them. Errors are ArgumentError.
"""

import ast
import functools
import inspect
import math
import numbers
import os
import re
from collections.abc import Mapping

import numpy as np

from ._errors import ArgumentError, ArgumentTypeError, Error

_LARGEST = 100  # characters of a value in a message


def shown(value):
    """The type of a value, with the value itself where that is short and says more."""
    kind = type(value).__name__
    if isinstance(value, np.ndarray):
        return f"an array of shape {value.shape} and type {value.dtype}"
    if isinstance(value, (str, bytes, numbers.Number)):
        text = repr(value)
        return f"{text if len(text) <= _LARGEST else text[:_LARGEST] + '...'} of type {kind}"
    if isinstance(value, (list, tuple)):
        return f"a {kind} of {len(value)}"
    return "None" if value is None else f"an object of type {kind}"


def finite(name, value):
    """Throws ArgumentError where the value has a part that is complex, NaN or infinite, naming it."""
    if _is_sound_row(value):
        return
    try:
        _finite(name, value)
    except RecursionError:
        raise ArgumentError(f"{name}: contains itself, expected parts with an end") from None


def _is_sound_row(value):
    """The usual case, soon: finite doubles in a row. A sum of squares past the largest double is looked at again."""
    return type(value) is np.ndarray and value.dtype.char == "d" and value.ndim == 1 and math.isfinite(value.dot(value))


def _finite(name, value):
    if value is None or isinstance(value, (str, bytes, bool, int)):
        return
    if isinstance(value, (complex, np.complexfloating)):
        raise ArgumentError(f"{name}: found the complex number {value}, expected a real one (complex steps do not pass through meshes; their derivatives are jvp() and vjp())")
    if isinstance(value, (float, np.floating)):
        if not np.isfinite(value):
            raise ArgumentError(f"{name}: found {value}, expected a finite number")
    elif isinstance(value, Mapping):
        for key, item in value.items():
            _finite(f"{name}[{key!r}]", item)
    elif isinstance(value, (list, tuple)) and not all(isinstance(item, numbers.Number) for item in value):
        for index, item in enumerate(value):
            _finite(f"{name}[{index}]", item)
    elif isinstance(value, (list, tuple, np.ndarray)) or hasattr(value, "__array__"):
        _finite_array(name, _as_array(name, value))


def _as_array(name, value):
    """numpy.asarray(), whose refusals (a tensor on another device or with gradients) name the argument."""
    try:
        return np.asarray(value)
    except Exception as error:
        raise ArgumentTypeError(f"{name}: found {shown(value)} ({error}), expected what numpy.asarray() takes") from error


def _finite_array(name, values):
    if values.dtype.kind == "c":
        raise ArgumentError(f"{name}: found complex numbers, expected real ones (complex steps do not pass through meshes; their derivatives are jvp() and vjp())")
    if values.dtype.kind == "O":
        for index in np.ndindex(values.shape):
            _finite(f"{name}[{', '.join(map(str, index))}]", values[index])
    elif values.dtype.kind == "f" and not np.isfinite(values).all():
        index = tuple(np.argwhere(~np.isfinite(values))[0])
        place = f"{name}[{', '.join(map(str, index))}]" if index else name
        raise ArgumentError(f"{place}: found {values[index]}, expected a finite number")


def reals(name, value, shape=None):
    """The value as an array of doubles. Throws ArgumentError unless it is one of finite real numbers of that shape."""
    finite(name, value)
    if not _is_array(value):
        raise ArgumentTypeError(f"{name}: found {shown(value)}, expected an array of numbers")
    values = np.asarray(value, dtype=float)
    if shape is not None and values.shape != shape:
        raise ArgumentError(f"{name}: found an array of shape {values.shape}, expected {shape}")
    return values


def _is_array(value):
    if isinstance(value, (str, bytes, Mapping)) or value is None or callable(value):
        return False
    try:
        values = np.asarray(value)
        return values.dtype.kind in "biuf" or values.dtype.kind == "O" and np.asarray(values, dtype=float) is not None
    except (TypeError, ValueError):
        return False


def _is_real(value):
    if isinstance(value, (str, bytes, complex, np.complexfloating)):
        return False
    return isinstance(value, numbers.Real) or isinstance(value, np.ndarray) and value.size == 1 and value.dtype.kind in "biuf"


def _is_integer(value):
    return isinstance(value, (numbers.Integral, np.integer))


# What an annotation of pybind11's stands for: whether a value fits, and how to say so; of lists and dicts, also the kind
# of what they hold.
_KINDS = {
    "float": (_is_real, "a number"),
    "int": (_is_integer, "an integer"),
    "bool": (lambda value: isinstance(value, (bool, np.bool_)), "True or False"),
    "str": (lambda value: isinstance(value, str), "a string"),
    "dict": (lambda value: isinstance(value, dict), "a dict"),
    "path": (lambda value: isinstance(value, (str, bytes, os.PathLike)), "the name of a file"),
    "array": (_is_array, "an array of numbers"),
}


def _kind(annotation, classes):
    """Whether a value fits, and what is expected, of an annotation as text; None where anything may."""
    text = annotation.replace("remodel._core.", "")
    if text.startswith("Optional["):
        inner = _kind(text[len("Optional[") : -1], classes)
        return inner and ((lambda value: value is None or inner[0](value)), f"{inner[1]} or None", *inner[2:])
    if "PathLike" in text:
        text = "path"
    elif text.startswith("numpy.ndarray"):
        text = "array"
    if text in classes:
        return (lambda value: isinstance(value, classes[text])), f"a {text}" if text[0] not in "AI" else f"an {text}"
    if text in _KINDS:
        return _KINDS[text]
    if text == "object":
        return None
    if sized := re.fullmatch(r"List\[(\w+)\[(\d+)\]\]", text):
        inner, count = _KINDS[sized[1]], int(sized[2])
        return (lambda value: _is_sequence(value) and len(value) == count and all(map(inner[0], value))), f"{count} numbers"
    if held := re.fullmatch(r"(List|Dict)\[(?:str, )?(.*)\]", text):
        inner = _kind(held[2], classes)
        if held[1] == "List":
            return (lambda value: _is_sequence(value) and all(map(inner[0], value))), f"a list, each part {inner[1]}", inner
        return (lambda value: isinstance(value, Mapping) and all(map(inner[0], value.values()))), f"a dict with, by name, {inner[1]}", inner
    return (lambda value: False), {"Iterable": "a list"}.get(text, text)


def _is_sequence(value):
    return isinstance(value, (list, tuple, np.ndarray))


def _misfit(argument, value, kind):
    """The error of a value that does not fit: of the first part that does not, where a list or a dict has one."""
    if len(kind) > 2 and (_is_sequence(value) or isinstance(value, Mapping)):
        for key, part in value.items() if isinstance(value, Mapping) else enumerate(value):
            if not kind[2][0](part):
                return _misfit(f"{argument}[{key!r}]", part, kind[2])
    return ArgumentTypeError(f"{argument}: found {shown(value)}, expected {kind[1]}")


def _parsed(call, classes):
    """The signature of one of pybind11's functions, and the kinds of its arguments. None where it has several."""
    first, _, text = (call.__doc__ or "").partition("\n")
    try:
        arguments = ast.parse(f"def {first}: ...").body[0].args
    except SyntaxError:
        return None
    positional, kinds, parameters = arguments.posonlyargs + arguments.args, {}, []
    defaults = [None] * (len(positional) - len(arguments.defaults)) + arguments.defaults
    rows = [(each, default, inspect.Parameter.POSITIONAL_OR_KEYWORD) for each, default in zip(positional, defaults)]
    rows += [(each, default, inspect.Parameter.KEYWORD_ONLY) for each, default in zip(arguments.kwonlyargs, arguments.kw_defaults)]
    for each, default, kind in rows:
        value = inspect.Parameter.empty if default is None else ast.literal_eval(default)
        parameters.append(inspect.Parameter(each.arg, kind, default=value))
        kinds[each.arg] = _kind(ast.unparse(each.annotation), classes) if each.annotation else None
    if arguments.vararg or arguments.kwarg or any(name.startswith("arg") and name[3:].isdigit() for name in kinds):
        return None
    return inspect.Signature(parameters), kinds, text.strip()


def _explained(error, name, signature, kinds, args, options):
    """The error of a call whose arguments the compiled part did not take."""
    text = str(error)
    if "incompatible function arguments" not in text and "incompatible constructor arguments" not in text:
        return ArgumentTypeError(text)
    try:
        given = signature.bind(*args, **options).arguments
    except TypeError as wrong:
        return ArgumentTypeError(f"{name}: {wrong}, expected {name}{signature}")
    for argument, value in given.items():
        if kinds.get(argument) and not kinds[argument][0](value):
            return _misfit(argument, value, kinds[argument])
    for argument, value in given.items():
        if kinds.get(argument) is not None and _is_integer(value) and not 0 <= value < 2**31:
            return ArgumentTypeError(f"{argument}: found {shown(value)}, expected an integer of 31 bits")
    return ArgumentTypeError(f"{name}: found an argument of another type, expected {name}{signature}")


def _wrapped(call, name, signature, kinds, text, plain):
    names = list(signature.parameters)
    is_method = names[:1] == ["self"]
    arrays = frozenset(argument for argument, kind in kinds.items() if kind and kind[1].startswith("an array"))

    def look(argument, value):
        if _is_sound_row(value):
            return
        finite(argument, value)
        if argument in arrays and not (type(value) is np.ndarray and value.dtype.kind in "biuf") and not kinds[argument][0](value):
            raise ArgumentTypeError(f"{argument}: found {shown(value)}, expected {kinds[argument][1]}")

    def looked_at(*args, **options):
        if is_method and args and args[0] is None:  # which pybind11 would hand on as no object
            raise ArgumentTypeError(f"self: found None, expected what {name} is a method of")
        for argument, value in zip(names, args):
            if type(value) not in plain or argument in arrays:
                look(argument, value)
        for argument, value in options.items():
            if type(value) not in plain or argument in arrays:
                look(argument, value)
        try:
            return call(*args, **options)
        except Error:
            raise
        except TypeError as error:
            raise _explained(error, name, signature, kinds, args, options) from None

    looked_at.__name__ = looked_at.__qualname__ = name
    looked_at.__doc__, looked_at.__signature__, looked_at.__module__ = text, signature, "remodel"
    return looked_at


def python_call(**kinds):
    """For functions of Python: the arguments named have to be of a kind ('int', 'float', ...), or None if that is the
    default, and all of them finite."""

    def decorate(function):
        signature = inspect.signature(function)

        @functools.wraps(function)
        def looked_at(*args, **options):
            try:
                given = signature.bind(*args, **options).arguments
            except TypeError as wrong:
                raise ArgumentTypeError(f"{function.__name__}: {wrong}") from None
            for argument, value in given.items():
                finite(argument, value)
                fits, expected = _KINDS[kinds[argument]] if argument in kinds else (None, None)
                if fits and not fits(value) and not (value is None and signature.parameters[argument].default is None):
                    raise ArgumentTypeError(f"{argument}: found {shown(value)}, expected {expected}")
            return function(*args, **options)

        return looked_at

    return decorate


def name_of_function(place, function, given, resume):
    """What a run knows a function by: a name that was given, or its own. Throws ArgumentError where a run is gone on with
    by a function without one, since nobody could say whether it is another."""
    name = getattr(function, "__name__", "own") if given is None else given
    if resume and given is None and (name == "<lambda>" or not hasattr(function, "__name__")):
        raise ArgumentError(f"{place}: found {'a lambda' if name == '<lambda>' else shown(function)} with resume, expected a function with a name, which is all that a run knows it by")
    return name


def _no_constructor(name):
    def __init__(self, *args, **options):
        raise ArgumentTypeError(f"{name}: has no constructor, expected one that a call returns (help(remodel) names them)")

    return __init__


def extend(core):
    """Puts such functions before the public calls of the compiled part."""
    classes = {name: thing for name, thing in vars(core).items() if inspect.isclass(thing) and not name.startswith("_")}
    plain = frozenset({str, bool, int, type(None), *classes.values()})  # types that are never complex, nor infinite
    for name, thing in list(vars(core).items()):
        if name.startswith("_") or name in classes or not callable(thing):
            continue
        if (found := _parsed(thing, classes)) is not None:
            setattr(core, name, _wrapped(thing, name, *found, plain))
    for name, kind in classes.items():
        if isinstance(vars(kind).get("__init__"), type(object.__init__)):  # pybind11's, which refuses too
            kind.__init__ = _no_constructor(name)
        for member, thing in list(vars(kind).items()):
            if member.startswith("_") and member != "__init__" or isinstance(thing, property):
                continue
            call = thing.__func__ if isinstance(thing, staticmethod) else thing
            if not callable(call) or (found := _parsed(call, classes)) is None:
                continue
            wrapped = _wrapped(call, name if member == "__init__" else member, *found, plain)
            wrapped.__name__, wrapped.__qualname__ = member, f"{name}.{member}"
            setattr(kind, member, staticmethod(wrapped) if isinstance(thing, staticmethod) else wrapped)
