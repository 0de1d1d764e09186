"""Correlation functions of contacts, and figures whose intervals come from stretches of a run or from replicas."""

from functools import cache

import numpy as np

from ._options import InputError, numbers
from ._tables import table

STRETCHES, WAVES = 16, 4
LEAST_REPLICAS = 3  # as least_pooled of experiments/program/mean_interval.h


@cache
def student_95(freedom):
    """Returns the 97.5% quantile of Student's t. The density of arctan(t / sqrt(freedom)) is a power of its cosine."""
    angle = np.linspace(0, np.pi / 2, 20001)
    density = np.cos(angle)**(freedom - 1)
    mass = np.cumsum(density[1:] + density[:-1])
    return np.sqrt(freedom) * np.tan(np.interp(0.95 * mass[-1], mass, angle[1:]))


def ratio(above, below, in_order):
    """Returns sum(above) / sum(below) over the first axis, and the ends of its 95% interval, symmetric for the logarithm.

    Rows are replicas or, `in_order`, stretches of a run. Stretches depend on each other, but the slowest cosine waves over the
    run hardly do. So the variance comes from four of them: the equal-weighted cosine test of Lazarus, Lewis, Stock and Watson
    (2018). (The program's mean_over_time needs 50 values, and these are 16.) An end that does not follow from the data is NaN.
    """
    count = len(above)
    with np.errstate(divide="ignore", invalid="ignore"):
        value = above.sum(0) / below.sum(0)
        off = count * (above / above.sum(0) - below / below.sum(0))
        if in_order:
            waves = np.cos(np.pi * np.outer(np.arange(1, WAVES + 1), (np.arange(count) + 0.5) / count))
            freedom, variance = WAVES, 2 / count * (np.tensordot(waves, off, 1)**2).mean(0)
        else:
            freedom, variance = max(count - 1, 1), (off**2).sum(0) / max(count - 1, 1)
        has_interval = (variance > 1e-18) & (count >= LEAST_REPLICAS)  # less is rounding of equal rows
        factor = np.where(has_interval, np.exp(student_95(freedom) * np.sqrt(variance / count)), np.nan)
        return value, value / factor, value * factor


class Timeline:
    """The contacts of a run in times from 0 to ``length``. Each pair has a place on one line, so one look-up serves all."""

    def __init__(self, found):
        rows, clock = found.intervals, "time" if found.unit == "ps" else "frame"
        start, self.length, self.pairs_asked = found._start, found._length, found.all["pairs_asked"]
        first, second = np.asarray(rows["i"], np.int64), np.asarray(rows["j"], np.int64)
        order = np.lexsort((rows[f"begin_{clock}"], second, first))
        self.begin, self.end = (np.asarray(rows[f"{side}_{clock}"])[order] - start for side in ("begin", "end"))
        self.begun, self.ended = (~np.asarray(rows[f"open_at_{side}"])[order] for side in ("start", "end"))
        self.place = 2.0 * self.length * found._pairs()[1][order]
        self.knots = np.stack([self.place + self.begin, self.place + self.end], axis=1).ravel()
        until = np.cumsum(self.end - self.begin)  # time in contact up to each end
        self.until = np.stack([np.append(0, until[:-1]), until], axis=1).ravel() if len(until) else np.empty(0)

    def counts(self, first, last):
        """Returns the time in contact and apart, the beginnings and the ends between two times."""
        on = np.maximum(np.minimum(self.end, last) - np.maximum(self.begin, first), 0).sum()
        begins, ends = (((first <= time) & (time < last) & counts).sum()
                        for time, counts in ((self.begin, self.begun), (self.end, self.ended)))
        return on, self.pairs_asked * (last - first) - on, begins, ends

    def correlated(self, lag, first, last):
        """Returns three times between two times: in contact, in contact now and a lag later, and in contact all the while."""
        begin, end = np.maximum(self.begin, first), np.minimum(self.end, last)
        some = begin < end
        later = self.place + lag + [begin, end]
        in_both = np.diff(np.interp(later[:, some], self.knots, self.until), axis=0) if some.any() else np.zeros(1)
        return (end - begin)[some].sum(), in_both.sum(), np.maximum(np.minimum(end, self.end - lag) - begin, 0).sum()


def figures(counts, in_order):
    """Returns the figures of rows of ``Timeline.counts`` with their intervals, a dictionary."""
    on, apart, begins, ends = np.array(counts, float).T
    found = {}
    for name, above, below, most in (("occupancy", on, on + apart, 1), ("residence", on, ends, np.inf),
                                     ("begin_rate", begins, apart, np.inf), ("end_rate", ends, on, np.inf)):
        value, lower, upper = ratio(above, below, in_order)
        found.update({name: float(value), f"{name}_lower": float(lower), f"{name}_upper": float(np.minimum(upper, most))})
    return found


def stretches(length):
    """Returns the ends of the stretches of a run."""
    cuts = np.linspace(0, length, STRETCHES + 1)
    return list(zip(cuts, cuts[1:]))


def lags_of(name, lags, length):
    """Returns times as an array. Refuses an empty list, and times that are not shorter than the run."""
    found = np.atleast_1d(numbers(name, lags)).astype(float)
    if found.ndim > 1 or len(found) == 0 or not ((found >= 0) & (found < length)).all():
        raise InputError(f"{name}: expected times from 0 to less than the length of the run, which is {length:.6g}")
    return found


def correlation(lags, runs, in_order):
    """Returns the table of ``Contacts.correlation`` of one run, `in_order`, or of replicas."""
    lags = lags_of("lags", lags, min(run.length for run in runs))
    rows = [[run.correlated(lag, first, last) for run in runs for first, last in
             (stretches(run.length - lag) if in_order else [(0, run.length - lag)])] for lag in lags]
    on, both, throughout = np.array(rows, float).reshape(len(lags), -1, 3).transpose(2, 1, 0)
    columns = {"lag": lags}
    for name, above in (("intermittent", both), ("continuous", throughout)):
        value, lower, upper = ratio(above, on, in_order)
        if in_order:  # random times of a longer lag lie too close together to show a spread
            lower, upper = (np.where(lags <= runs[0].length / 2, end, np.nan) for end in (lower, upper))
        columns.update({name: value, f"{name}_lower": lower, f"{name}_upper": np.minimum(upper, 1)})
    return table(columns)


def survival_at(times, runs):
    """Returns the share of the contacts that begin in these runs which last longer than each time (Kaplan and Meier). It is NaN
    if no contact begins."""
    life = np.concatenate([(run.end - run.begin)[run.begun] for run in runs])
    if len(life) == 0:
        return np.full(len(times), np.nan)
    ended = np.concatenate([run.ended[run.begun] for run in runs])
    order = np.lexsort((~ended, life))
    steps = np.cumprod(np.append(1, 1 - ended[order] / np.arange(len(life), 0, -1)))
    return steps[np.searchsorted(life[order], times, side="right")]


def pooled_survival(times, runs):
    """Returns a table of ``survival_at`` with intervals from the jackknife over replicas, for the logarithm."""
    longest = sorted(run.length for run in runs)[-2:][0]  # all but one reach it, also if the longest run is left out
    times, count = lags_of("times", times, longest), len(runs)
    share = survival_at(times, runs)
    with np.errstate(divide="ignore", invalid="ignore"):
        without = np.log([survival_at(times, runs[:k] + runs[k + 1:]) for k in range(count)]) if count > 1 else np.zeros((1, 1))
        error = np.sqrt((count - 1) * without.var(axis=0))
    factor = np.where((error > 0) & (count >= LEAST_REPLICAS), np.exp(student_95(max(count - 1, 1)) * error), np.nan)
    return table({"time": times, "survival": share, "lower": share / factor, "upper": np.minimum(share * factor, 1)})
