"""Tables: a DataFrame if pandas is installed, otherwise a structured array. Results, and files of them."""

import csv
import importlib
import io
import json
import os
import tempfile

import numpy as np

from ._options import InputError


def _column(values):
    kinds = {type(value) for value in values if value is not None}
    if kinds <= {bool} and kinds:
        return np.array([bool(value) for value in values])
    if kinds <= {int} and None not in values:
        return np.array(values, dtype=np.int64)
    if kinds <= {int, float}:
        return np.array([np.nan if value is None else value for value in values], dtype=float)
    if kinds <= {str}:
        return np.array(["" if value is None else value for value in values])
    column = np.empty(len(values), dtype=object)
    column[:] = values
    return column


def table(columns):
    """Returns a table of columns, arrays or lists of one length by name."""
    columns = {name: column if isinstance(column, np.ndarray) else _column(column) for name, column in columns.items()}
    try:
        import pandas
    except ImportError:
        length = len(next(iter(columns.values()))) if columns else 0
        rows = np.empty(length, dtype=[(name, column.dtype) for name, column in columns.items()])
        for name, column in columns.items():
            rows[name] = column
        return rows
    return pandas.DataFrame(columns)


def events_table(events):
    """Returns a table of events. Each id has a column, as far as any event has so many."""
    beads = events["beads"]
    widest = max(np.flatnonzero((beads != -1).any(axis=0)), default=0) + 1
    columns = {name: events[name] for name in events.dtype.names if name != "beads"}
    return table({**columns, **{f"bead_{k}": beads[:, k] for k in range(widest)}})


def _flat(row, prefix=""):
    for name, value in row.items():
        if isinstance(value, dict):
            yield from _flat(value, prefix + name + ".")
        else:
            yield prefix + name, value


def table_of_rows(rows, columns=()):
    """Returns a table of rows, dictionaries as in the program's JSON. A nested member a.b is a column.

    ``columns`` are those of a table without rows.
    """
    flat = [dict(_flat(row)) for row in rows]
    names = list(dict.fromkeys(name for row in flat for name in row)) or columns
    return table({name: [row.get(name) for row in flat] for name in names})


def needed(module, purpose):
    """Returns a module that is not always installed."""
    try:
        return importlib.import_module(module)
    except ImportError as error:
        raise ImportError(f"{purpose} need {module.partition('.')[0]}, which is not installed") from error


def columns_of(of):
    """Returns the columns of a table by name, as arrays of numbers or text."""
    names = of.dtype.names if isinstance(of, np.ndarray) else list(of)
    columns = {name: np.asarray(of[name]) for name in names}
    return {name: np.array([str(value) for value in column]) if column.dtype == object else column
            for name, column in columns.items()}


def records(of):
    """Returns the rows of a table, dictionaries. NaN becomes None."""
    columns = columns_of(of)
    return [dict(zip(columns, (None if value != value else value for value in row)))
            for row in zip(*(column.tolist() for column in columns.values()))]


class Saved:
    """A result with ``rows`` that can be written to a file."""

    def __repr__(self):
        return f"<kds.{type(self).__name__}: {len(self.rows)} rows>"

    def save(self, path, what="rows"):
        """Writes the result to a file, whose ending gives the format. A file of that name is replaced, whole or not at all.

        ``.csv`` and ``.npz`` have the columns of a table: ``what`` names the attribute, such as "intervals". ``.json`` has the
        attribute ``json``, which is without the intervals for :func:`kds.contacts`: save these with ``save(path, "intervals")``.
        ``.graphml`` has the graph of contacts; it needs networkx.
        """
        path = os.fspath(path)
        writers = {".csv": _csv_of, ".npz": _npz_of}
        ending = os.path.splitext(path)[1].lower()
        endings = [*writers, ".json", *([".graphml"] if hasattr(self, "to_networkx") else [])]
        if ending not in endings:
            raise InputError(f"{path}: cannot tell the format from the ending; expected {', '.join(endings)}")
        if ending in (".json", ".graphml") and what != "rows":
            raise InputError(f"what: is {what!r}; {ending} has no single table, expected .csv or .npz for one")
        if ending == ".json":
            content = json.dumps(self.json, indent=1, allow_nan=False).encode()
        elif ending == ".graphml":
            content = "\n".join(needed("networkx", "graphs").generate_graphml(self.to_networkx())).encode()
        else:
            tables = [name for name, value in vars(self).items() if hasattr(value, "dtypes")  # of pandas
                      or isinstance(value, np.ndarray) and value.dtype.names]
            if what not in tables:
                raise InputError(f"what: is {what!r}; expected {', '.join(tables)}")
            content = writers[ending](columns_of(getattr(self, what)))
        _replace_file(path, content)


def _replace_file(path, content):
    """Writes a new file beside the old one and takes its place, so the old one stays whole if anything fails."""
    part = None
    try:
        handle, part = tempfile.mkstemp(prefix=f".{os.path.basename(path)}.", dir=os.path.dirname(path) or ".")
        with open(handle, "wb") as file:
            file.write(content)
        umask = os.umask(0)
        os.umask(umask)
        os.chmod(part, os.stat(path).st_mode & 0o777 if os.path.exists(path) else 0o666 & ~umask)
        os.replace(part, path)
        part = None
    except OSError as error:
        raise InputError(f"{path}: cannot be written: {error.strerror}") from None
    finally:
        if part is not None:
            os.remove(part)


def _csv_of(columns):
    text = io.StringIO(newline="")
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(columns)
    writer.writerows(["" if value != value else str(value).lower() if isinstance(value, bool) else value for value in row]
                     for row in zip(*(column.tolist() for column in columns.values())))
    return text.getvalue().encode()


def _npz_of(columns):
    file = io.BytesIO()
    np.savez_compressed(file, **columns)
    return file.getvalue()


def indented(text):
    return f"<pre>{text.replace('&', '&amp;').replace('<', '&lt;')}</pre>"


class Result(Saved):
    """What an analysis found.

    ``table`` is the program's table, which ``print`` and notebooks show. ``rows`` holds the same numbers with all
    digits, as a DataFrame if pandas is installed, otherwise as a structured array. ``json`` is the dictionary of
    everything that the program's ``--json`` has, without provenance.
    """

    def __init__(self, found):
        self.json = json.loads(found["json"])
        self.table = found["table"]
        self.rows = table_of_rows(self.json["rows"], found.get("columns", "").strip().split(","))

    def __str__(self):
        return self.table.rstrip("\n")

    def _repr_html_(self):
        return indented(self.table)
