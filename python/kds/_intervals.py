"""Intervals of pairs in contact: at frames, joined by labels, as graphs, and the fraction of native contacts."""

import numpy as np

from ._options import InputError
from ._tables import Saved, needed, records, table


def union(key, begin, end):
    """Returns, for each run of intervals of one key that meet, ordered by key, the indices of one that begins first and of one
    that ends last."""
    runs = []
    for k in np.lexsort((begin, key)).tolist():
        if runs and key[k] == key[runs[-1][0]] and begin[k] <= end[runs[-1][1]]:
            runs[-1][1] = k if end[k] > end[runs[-1][1]] else runs[-1][1]
        else:
            runs.append([k, k])
    return np.array(runs, np.int64).reshape(-1, 2).T


class Intervals(Saved):
    """Closed intervals of time in which pairs of named elements are in contact. Base of results of contacts.

    ``frame_numbers``
        the number in the file of each frame that was read, or None for results that were read from a folder.
    """

    def _set_intervals(self, found, names, unit, start, length):
        """Takes arrays with a value for each interval. `start` is the first reading of the clock, and `length` that of the
        run. Further arrays become columns of the table."""
        self.names, self.unit = list(names), unit
        self._start, self._length = start, length
        found = dict(found)
        self.frame_numbers = found.pop("frame_numbers", None)
        self._arrays = found
        label = np.array(self.names)
        columns = {"i": found["first"], "j": found["second"], "first": label[found["first"]], "second": label[found["second"]]}
        for name in found:
            if name not in ("first", "second", "begin_step", "end_step"):
                columns[name] = found[name]
        self.intervals = table(columns)

    def at_frames(self):
        """Returns which pairs are in contact at each frame: a sparse matrix of SciPy and the pairs of its columns.

        The matrix (frames, pairs) is a ``csr_matrix`` of truth values. Its rows belong to ``frame_numbers``. Its columns are
        all pairs that are ever in contact, an array (pairs, 2) of elements. Contacts of :func:`kds.contacts` are decided exactly;
        those of hydrogen bonds are as accurate as their ends. A pair at the very cutoff is in contact, unless it comes to the
        cutoff exactly at the last frame. A pair counts as in contact during an absence that ``gap`` bridges.
        """
        sparse = needed("scipy.sparse", "sparse matrices")
        if self.frame_numbers is None:
            raise InputError("at_frames: results that are read from a folder have no frames; expected those of kds.contacts")
        pairs, column = self._pairs()
        first, last = np.ceil(self._arrays["begin_step"]).astype(int), np.floor(self._arrays["end_step"]).astype(int)
        count = np.maximum(last - first + 1, 0)
        row = np.repeat(first - np.cumsum(count) + count, count) + np.arange(count.sum())
        shape = len(self.frame_numbers), len(pairs)
        return sparse.csr_matrix((np.ones(len(row), bool), (row, np.repeat(column, count))), shape=shape), pairs

    def _pairs(self):
        """Returns the pairs that are ever in contact, ascending, and the index of each interval's pair among them."""
        size = len(self.names)
        keys, index = np.unique(self._arrays["first"].astype(np.int64) * size + self._arrays["second"], return_inverse=True)
        return np.stack([keys // size, keys % size], axis=1), index

    def native(self, reference=None, at_frames=False):
        """Returns the fraction of native contacts Q(t), a table over time.

        Native pairs are those in contact at the frame ``reference`` (default: the first one), or an array (pairs, 2) of
        elements, among those that were asked for (``apart``, ``groups``), because others are never in contact here. Each pair
        counts 1 in contact and 0 otherwise. Rows are the first frame, all times at which a native
        contact begins or ends, and the last frame. ``fraction`` holds from a row to the next. With ``at_frames``, rows are
        the frames, and ``fraction`` is that at the frame.
        """
        pairs, of = self._pairs()
        if isinstance(reference, (bool, np.bool_)):
            raise InputError(f"reference: is {reference}; expected the number of a frame, or pairs")
        if reference is None or np.ndim(reference) == 0:
            if self.frame_numbers is None:
                raise InputError("reference: results that are read from a folder have no frames; expected pairs")
            frame = self.frame_numbers[0] if reference is None else reference
            at = np.flatnonzero(self.frame_numbers == frame)
            if len(at) == 0:
                raise InputError(f"reference: {reference} is no frame that was read; expected one from {self.frame_numbers[0]} "
                                 f"to {self.frame_numbers[-1]}")
            there = (self._arrays["begin_step"] <= at[0]) & (self._arrays["end_step"] >= at[0])
            wanted = np.isin(np.arange(len(pairs)), of[there])
            count = wanted.sum()
        else:
            given = np.asarray(reference)
            if given.ndim != 2 or given.shape[1] != 2 or given.dtype.kind not in "iu":
                raise InputError("reference: expected the number of a frame, or pairs of elements, an array (pairs, 2)")
            if given.size and (given.min() < 0 or given.max() >= len(self.names) or (given[:, 0] == given[:, 1]).any()):
                raise InputError(f"reference: expected pairs of two different elements from 0 to {len(self.names) - 1}")
            native = {tuple(sorted(pair)) for pair in given.tolist()}
            count, wanted = len(native), np.array([tuple(sorted(pair)) in native for pair in pairs.tolist()], bool)
        if count == 0:
            raise InputError("reference: has no pair in contact; expected another frame, or pairs")
        if at_frames:
            inside = self.at_frames()[0][:, np.flatnonzero(wanted)]
            return table({"frame": self.frame_numbers, "fraction": np.asarray(inside.sum(axis=1)).ravel() / count})
        clock, own = "time" if self.unit == "ps" else "frame", wanted[of]
        begin, end = (self._arrays[f"{side}_{clock}"][own] for side in ("begin", "end"))
        ended = end[~self._arrays["open_at_end"][own].astype(bool)]
        times = np.unique(np.concatenate([[self._start, self._start + self._length], begin, ended]))
        number = np.searchsorted(np.sort(begin), times, "right") - np.searchsorted(np.sort(ended), times, "right")
        return table({clock: times, "fraction": number / count})

    def joined(self, labels="residue"):
        """Returns the contacts of labels, :class:`kds.JoinedContacts`. Labels are in contact while any two of their beads are.

        ``labels`` gives each bead (or residue) a label: a function of its name, or a list, such as the chemical elements
        ``group.elements`` of an AtomGroup. The default takes the residue in names of beads.
        """
        if isinstance(labels, str) and labels == "residue":
            labels = [name.partition(" of ")[2] or name for name in self.names]
        if isinstance(labels, str) or not (callable(labels) or hasattr(labels, "__len__")):
            raise InputError(f"labels: is {labels!r}; expected 'residue', a function or a list")
        labels = [labels(name) for name in self.names] if callable(labels) else list(labels)
        if len(labels) != len(self.names):
            raise InputError(f"labels: are {len(labels)}; expected {len(self.names)}, one for each name")
        return JoinedContacts(self, [str(label) for label in labels])

    def to_networkx(self):
        """Returns a Graph of networkx. Nodes are elements with their ``name``. Edges are the rows: ``occupancy``, the number of
        ``contacts``, and ``residence``, the mean life; edges whose contacts do not end have no ``residence``."""
        graph = needed("networkx", "graphs").Graph(unit=self.unit)
        graph.add_nodes_from((k, {"name": name}) for k, name in enumerate(self.names))
        for row in records(self.rows):
            graph.add_edge(row["i"], row["j"], **{name: row[name] for name in ("occupancy", "contacts", "residence")
                                                  if row[name] is not None})
        return graph

    def _set_rows(self, **more):
        """Makes a row for each pair that is ever in contact, without confidence intervals, and the JSON."""
        pairs, of = self._pairs()
        label, length, is_open = np.array(self.names), self._arrays["length"], self._arrays["open_at_end"].astype(bool)
        count, total = np.bincount(of, minlength=len(pairs)), np.bincount(of, length, len(pairs))
        ends = np.bincount(of, ~is_open, len(pairs))
        longest = np.zeros(len(pairs))
        np.maximum.at(longest, of, length)
        self.rows = table({"i": pairs[:, 0], "j": pairs[:, 1], "first": label[pairs[:, 0]], "second": label[pairs[:, 1]],
                           "contacts": count, "occupancy": total / self._length,
                           "residence": np.divide(total, ends, out=np.full(len(pairs), np.nan), where=ends > 0),
                           "total": total, "longest": longest, **more})
        self.json = {"unit": self.unit, "names": self.names, "rows": records(self.rows), "intervals": records(self.intervals)}


class JoinedContacts(Intervals):
    """Contacts of labels. Made by ``joined`` of results of contacts.

    ``rows``
        one row for each pair of labels that is ever in contact, also of a label with itself: ``contacts``, ``occupancy``,
        ``residence``, ``total`` and ``longest`` as in :class:`kds.Contacts`; ``pairs``, how many pairs of beads are ever in
        contact; and ``mean_pairs``, the mean number of these pairs in contact at one time.
    ``intervals``
        the union of the intervals of these pairs. Two intervals become one if the end of the first and the beginning of the
        second round to the same double (to the same 12 digits, if read from a folder).
    """

    def __init__(self, found, labels):
        names = list(dict.fromkeys(labels))
        number = {name: k for k, name in enumerate(names)}
        of = np.array([number[label] for label in labels], np.int64)
        arrays = found._arrays
        low, high = np.sort([of[arrays["first"]], of[arrays["second"]]], axis=0)
        begin, end = (arrays.get(f"{side}_step", arrays[f"{side}_frame"]) for side in ("begin", "end"))
        from_, to = union(low * len(names) + high, begin, end)
        clock = "time" if found.unit == "ps" else "frame"
        joined = {"first": low[from_], "second": high[from_]}
        joined.update({name: column[from_ if name.startswith("begin") or name == "open_at_start" else to]
                       for name, column in arrays.items() if name not in ("first", "second", "length")})
        joined.update(length=joined[f"end_{clock}"] - joined[f"begin_{clock}"], frame_numbers=found.frame_numbers)
        self._set_intervals(joined, names, found.unit, found._start, found._length)
        pairs, _ = self._pairs()
        at = np.searchsorted(pairs[:, 0] * len(names) + pairs[:, 1], low * len(names) + high)  # of each interval of `found`
        one_of = np.unique(found._pairs()[1], return_index=True)[1]  # an interval of each pair of elements
        self._set_rows(pairs=np.bincount(at[one_of], minlength=len(pairs)),
                       mean_pairs=np.bincount(at, arrays["length"], len(pairs)) / self._length)
