"""Keyword arguments become the options of the program, which checks them and knows their defaults."""

import operator
import os

import numpy as np

from . import _kds

InputError = _kds.InputError

# Options of the program that say where its results go. In Python results are attributes.
_OUTPUTS = {*_kds.run_outputs(), "data", "o"}
_RENAMED = {"frames": "start, stop, step", "format": "a path with the ending of its format"}


_FOLDER = os.path.dirname(__file__)


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


def whole(name, value, least=None):
    """Returns a whole number, at least `least`. Refuses 1.5, which int() would round."""
    expected = "a whole number" if least is None else f"a whole number from {least}"
    try:
        found = operator.index(value)
    except TypeError:
        raise InputError(f"{name}: is {value!r}; expected {expected}") from None
    if least is not None and found < least:
        raise InputError(f"{name}: is {found}; expected {expected}")
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


def arguments(options, own=()):
    """Returns the arguments of the program for a dictionary of options. None and False are left out. `own` are options
    that only the calling function takes."""
    found = []
    for name, value in options.items():
        if isinstance(value, np.bool_):
            value = bool(value)
        if name == "help":
            raise TypeError("help: is no argument here; expected help(kds.run) or kds.run_options()")
        if name in _OUTPUTS:
            raise TypeError(f"{name}: is no argument here; results are attributes of what is returned")
        if name in _RENAMED and name not in own:
            raise TypeError(f"{name}: is no argument here; expected {_RENAMED[name]}")
        if not name.isidentifier():
            raise TypeError(f"{name!r}: is no argument; expected a name without dashes and spaces")
        if value is None or value is False:
            continue
        option = "--" + name.replace("_", "-")
        if value is True:
            found.append(option)
        elif name == "groups":
            found.extend([option, *(_text(group) for group in value)])
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
        bar.total = total
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
