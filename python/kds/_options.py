"""Keyword arguments become the options of the program, which checks them and knows their defaults."""

import os

from . import _kds

# Options of the program that say where its results go. In Python results are attributes.
_OUTPUTS = {*_kds.run_outputs(), "data"}
_RENAMED = {"frames": "start, stop, step", "format": "a path with the ending of its format"}


class InputWarning(UserWarning):
    """Something about the input that the user should know: chain breaks, doubtful units, unused cells."""


def warn(lines):
    """Issues each line as an InputWarning."""
    import warnings

    for line in lines:
        warnings.warn(line, InputWarning, stacklevel=4)


def _text(value):
    if isinstance(value, slice):
        return ":".join("" if part is None else str(part) for part in (value.start, value.stop))
    if isinstance(value, (list, tuple)):
        return ",".join(_text(item) for item in value)
    if isinstance(value, float) or (hasattr(value, "dtype") and getattr(value, "ndim", 1) == 0):
        return repr(float(value)) if not float(value).is_integer() else str(int(value))
    return os.fspath(value) if isinstance(value, os.PathLike) else str(value)


def arguments(options, own=()):
    """Returns the arguments of the program for a dictionary of options. None and False are left out. `own` are options
    that the function takes although others do not."""
    found = []
    for name, value in options.items():
        if name == "help":
            raise TypeError("help: is no argument here; expected help(kds.run) or kds.run_options()")
        if name in _OUTPUTS:
            raise TypeError(f"{name}: is no argument here; results are attributes of what is returned")
        if name in _RENAMED and name not in own:
            raise TypeError(f"{name}: is no argument here; expected {_RENAMED[name]}")
        if value is None or value is False:
            continue
        found.append("--" + name.replace("_", "-"))
        if value is True:
            continue
        if name == "groups":
            found.extend(_text(group) for group in value)
        else:
            found.append(_text(value))
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


InputError = _kds.InputError
