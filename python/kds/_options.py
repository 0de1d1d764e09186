"""Keyword arguments become the options of the program, which checks them and knows their defaults."""

import inspect
import operator
import os
import textwrap

import numpy as np

from . import _kds

InputError = _kds.InputError

# Arguments of every input. They are in front of the options of the program in every signature.
INPUT = ("start", "stop", "step", "radius", "units", "necklaces", "times", "velocities", "groups")
# Options of the program that say how files are read.
OF_FILES = ("topology", "select", "chain", "obstacle", "dt", "until_damage", "unwrap", "no_periodic")
OF_LIVE = ("until", "patience", "cell", "rate")  # of running simulations
OF_THE_INPUT = (*INPUT, *OF_FILES, *OF_LIVE)
# Options of the program that are no arguments, and why.
_NO_ARGUMENTS = {
    **dict.fromkeys(("out", "replace", "every", "continue", "paper", "json", "quiet", "view", "dump", "events", "log", "data", "o",
                     "beads"), "results are attributes of what is returned"),
    "frames": "expected start, stop, step", "format": "expected a path with the ending of its format",
    "rounds": "a run is made once; kds.compare takes it", "help": "help(kds.run) explains all arguments"}

_FLAGS, _VALUED = set(), set()  # arguments that are True or False for some function, and those that are not
_FOLDER = os.path.dirname(__file__)
LARGEST = 2**62  # whole numbers of the extension module have 64 bits


class InputWarning(UserWarning):
    """A doubt about the input: a chain break, a doubtful unit, an unused cell."""


def warn(lines):
    """Issues each line as an InputWarning."""
    import sys
    import warnings

    level = 1  # that of the caller outside the package
    frame = sys._getframe()
    while frame is not None and os.path.dirname(frame.f_code.co_filename) == _FOLDER:
        level, frame = level + 1, frame.f_back
    for line in lines:
        warnings.warn(line, InputWarning, stacklevel=level)


def flag(name, value):
    """Returns a truth value. Refuses others, because the text "no" would be true."""
    if not isinstance(value, (bool, np.bool_)):
        raise InputError(f"{name}: is {value!r}; expected True or False")
    return bool(value)


def number(name, value, expected="a number"):
    """Returns a finite float. Refuses text, arrays and truth values."""
    if isinstance(value, (str, bytes, bool, np.bool_)) or np.ndim(value) > 0 or not np.isreal(value):
        raise InputError(f"{name}: is {value!r}; expected {expected}")
    try:
        found = float(value)
    except (TypeError, ValueError):
        found = np.nan
    if not np.isfinite(found):
        raise InputError(f"{name}: is {value}; expected {expected}")
    return found


def numbers(name, values):
    """Returns an array of numbers, which is not copied. Refuses text, dates, complex numbers and masked arrays."""
    if isinstance(values, np.ma.MaskedArray):
        raise InputError(f"{name}: is masked; expected an array with all numbers, such as its data if none is "
                         "missing")
    try:
        found = np.asarray(values)
    except ValueError:
        raise InputError(f"{name}: has rows of different lengths; expected an array of numbers") from None
    if found.size and found.dtype.kind not in "iuf":
        raise InputError(f"{name}: has the dtype {found.dtype}; expected an array of numbers")
    return found


def plain(name, values):
    """Returns an array of float32 or float64 in C order, as the extension module reads it. The array is copied if it is of
    another kind. Refuses numbers that float64 would round."""
    found = numbers(name, values)
    if found.dtype.kind in "iu" and found.size and max(int(found.max()), -int(found.min())) > 2**53:
        raise InputError(f"{name}: has whole numbers above 2^53, which float64 would round; expected float64")
    if found.dtype.itemsize > 8:
        raise InputError(f"{name}: has the dtype {found.dtype}, which float64 would round; expected float32 or float64")
    dtype = np.float32 if found.dtype.newbyteorder("=") == np.float32 else np.float64
    return np.require(found, dtype, ["C_CONTIGUOUS", "ALIGNED"])


def whole(name, value, least=None):
    """Returns a whole number, at least `least`. Refuses 1.5, which int() would round."""
    expected = "a whole number" if least is None else f"a whole number from {least}"
    try:
        found = operator.index(value)
    except TypeError:
        raise InputError(f"{name}: is {value!r}; expected {expected}") from None
    if least is not None and found < least:
        raise InputError(f"{name}: is {found}; expected {expected}")
    if abs(found) > LARGEST:
        raise InputError(f"{name}: is {found}; expected at most {LARGEST}")
    return found


def wholes(name, values, least=0):
    """Returns a list of whole numbers."""
    if isinstance(values, (str, bytes)) or not hasattr(values, "__iter__"):
        raise InputError(f"{name}: is {values!r}; expected a list of whole numbers")
    return [whole(name, value, least) for value in values]


def _text(value):
    if isinstance(value, slice):
        if value.step not in (None, 1):
            raise InputError(f"{value}: has a step; expected slice(first, end)")
        return ":".join("" if part is None else str(part) for part in (value.start, value.stop))
    if isinstance(value, np.ndarray) and value.ndim > 0:
        value = value.tolist()
    if isinstance(value, (list, tuple, range)):
        return ",".join(_text(item) for item in value)
    if isinstance(value, float) or (hasattr(value, "dtype") and getattr(value, "ndim", 1) == 0):
        return str(int(value)) if float(value).is_integer() and abs(value) < 1e16 else repr(float(value))
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    if hasattr(value, "__iter__") and not isinstance(value, (str, bytes)):
        raise InputError(f"{value!r}: has no order or is read only once; expected a list")
    return str(value)


def cutoff_text(cutoff, most=1):
    """Returns the text of one length, or of `most`, as the program takes them."""
    lengths = list(cutoff) if np.ndim(cutoff) > 0 else [cutoff]
    if most == 1 and np.ndim(cutoff) > 0:
        raise InputError(f"cutoff: is {cutoff}; expected one length; kds.contacts takes two")
    expected = "a length from 0" if most == 1 else "a length in angstrom, or a pair of lengths"
    return ":".join(_text(number("cutoff", length, expected)) for length in lengths)


def takes(command, without=(), only=None):
    """Decorates a function that takes ``**options``: gives it the arguments and the help of a command of the program,
    which is the only list of its options. The function itself refuses the arguments `without`. `only`: takes no others."""

    def decorate(function):
        helps, defaults = {}, {}
        for name, help, is_flag in _kds.options_of(command):
            helps[name], defaults[name] = help, False if is_flag else None
            (_FLAGS if is_flag else _VALUED).add(name)
        inputs = [name for name in INPUT if name not in ("velocities", "groups") or name in helps] if "topology" in helps else []
        if command == "run":
            inputs.append("only")
        own = [one for one in inspect.signature(function).parameters.values() if one.kind is not one.VAR_KEYWORD]
        hidden = {*without, *(one.name for one in own), *_NO_ARGUMENTS} - ({"rounds"} if command != "run" else set())
        names = [name for name in dict.fromkeys([*inputs, *helps]) if name not in hidden and name.isidentifier()
                 and (only is None or name in only)]
        function.__signature__ = inspect.Signature(own + [
            inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, default=defaults.get(name)) for name in names])
        lines = [line for name in names if name not in inputs
                 for line in (name, textwrap.fill(helps[name], 110, initial_indent="    ", subsequent_indent="    "))]
        function.__doc__ = "\n".join([inspect.cleandoc(function.__doc__ or ""), "", "Options", "-------", *lines])
        function.without = without
        return function

    return decorate


def check_names(function, options):
    """Refuses options that are not in the signature of a decorated function, as Python refuses unknown arguments."""
    known = inspect.signature(function).parameters
    place = f"kds.{function.__qualname__}".removesuffix(".__init__")
    for name in options:
        if name in known or name in function.without:
            continue
        why = (f"; {_NO_ARGUMENTS[name]}" if name in _NO_ARGUMENTS
               else f"{_kds.suggestion(name, list(known))} (see help({place}))")
        raise TypeError(f"{name}: is no argument of {place}{why}")


def arguments(options):
    """Returns the arguments of the program for a dictionary of options. None and False are left out."""
    found = []
    for name, value in options.items():
        if value is None:
            continue
        option = "--" + name.replace("_", "-")
        if name in _FLAGS - _VALUED:
            found.extend([option] if flag(name, value) else [])
        elif isinstance(value, (bool, np.bool_)):
            if value and name not in _FLAGS:
                raise InputError(f"{name}: is {value}; expected another value than True or False")
            found.extend([option] if value else [])
        elif name in ("levels", "nodes") and isinstance(value, (tuple, list)) and any(not isinstance(one, (str, slice))
                                                                                    for one in value):
            raise InputError(f"{name}: is {value!r}; expected slice(first, end), or a text such as '0:2'")
        elif text := _text(value):
            found.append(f"{option}={text}")  # one argument, so the text cannot be taken for an input
        else:
            found.extend([option, text])
    return found


def progress_bar(verbose, unit):
    """Returns a function that shows progress, or None, and a function that closes the bar."""
    if not verbose:
        return None, lambda: None
    try:
        from tqdm.auto import tqdm
    except ImportError:
        return None, lambda: None
    bar = tqdm(total=0, unit=unit)

    def show(done, within, total):
        bar.total = total or None
        bar.n = round(done + within, 2)
        bar.refresh()

    return show, bar.close


def call(function, *given, verbose=False, unit="step"):
    """Calls a function of the extension module whose last argument is a progress function."""
    show, close = progress_bar(verbose, unit)
    try:
        return function(*given, show)
    finally:
        close()
