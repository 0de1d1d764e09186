"""Tables: a DataFrame if pandas is installed, otherwise a structured array."""

import numpy as np


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


def indented(text):
    return f"<pre>{text.replace('&', '&amp;').replace('<', '&lt;')}</pre>"


class Result:
    """What an analysis found.

    ``table`` is the program's table, which ``print`` and notebooks show. ``rows`` holds the same numbers with all
    digits, as a DataFrame if pandas is installed, otherwise as a structured array. ``json`` is the dictionary of
    everything that the program's ``--json`` has, without provenance.
    """

    def __init__(self, found):
        import json

        self.json = json.loads(found["json"])
        self.table = found["table"]
        self.rows = table_of_rows(self.json["rows"], found.get("columns", "").strip().split(","))

    def __str__(self):
        return self.table.rstrip("\n")

    def __repr__(self):
        return f"<kds.{type(self).__name__}: {len(self.rows)} rows>"

    def _repr_html_(self):
        return indented(self.table)
