"""A table of the paper, measured again."""

import numpy as np
from common import Report, read_csv

EXPLAINED_FROM = 0.25  # a deviation above this needs a reason
LARGEST_SHORT = 2000  # beads of a row with --short


class PaperTable(Report):
    """A table of the paper, measured again. Its rows and the paper's figures are in table1.csv, table2.csv, ...

    `times` are columns in milliseconds or microseconds, as their names end; `ratios` are {name: (time, time)}; `counts` are
    counts and ratios of lengths or counts. reasons.csv says how inputs differ from the paper's, and why figures deviate.
    """

    def __init__(self, number, text, times, ratios, counts):
        super().__init__(text)
        self.times, self.ratios, self.counts = times, ratios, counts
        self.rows = [row for row in read_csv(f"table{number}.csv") if not self.short or row["beads"] <= LARGEST_SHORT]
        self.reasons = [reason for reason in read_csv("reasons.csv") if str(number) in str(reason["tables"] or number)]
        for row in self.rows:
            row["row"] = ", ".join(str(part) for part in (row["model"], f"{row['beads']:,} beads", row["at"]) if part)
            for ratio, (a, b) in ratios.items():
                row[ratio] = row[a] / row[b] if row.get(a) and row.get(b) else None

    def measured(self, row, note=None, **values):
        """Adds the figures of a row: seconds by round for times, and numbers. `note` is about this measurement."""
        found = {name: np.asarray(values[name]) * (1e3 if name.endswith("_ms") else 1e6) for name in self.times}
        found.update({name: found[a] / found[b] for name, (a, b) in self.ratios.items()})
        row["kds"] = {name: np.median(rounds) for name, rounds in found.items()}
        row["kds"].update({name: values[name] for name in self.counts})
        of_row = [reason["reason"] for reason in self.reasons if not reason["column"] and row["row"].startswith(reason["rows"])]
        row["note"] = "; ".join(part for part in (*of_row, note) if part)
        result = {name: row[name] for name in ("model", "beads", "at", "row", "note")}
        for name, value in row["kds"].items():
            result[name] = value
            if name in found:
                result.update({f"{name}_least": found[name].min(), f"{name}_most": found[name].max()})
            result.update({f"{name}_paper": row.get(name), f"{name}_deviation": self.deviation(row, name)})
        result["reasons"] = {name: self.reason(row, name) for name in row["kds"] if self.is_large(row, name)}
        self.results["rows"].append(result)

    def __getitem__(self, name):
        """Returns the measured column as an array."""
        return np.array([row["kds"][name] for row in self.rows], float)

    def where(self, condition):
        """Returns for each row whether it meets a condition, as an array."""
        return np.array([bool(condition(row)) for row in self.rows])

    def deviation(self, row, name):
        """Returns ours / paper - 1, or None. Times have none, because machines differ."""
        paper = row.get(name)
        return row["kds"][name] / paper - 1 if paper and name not in self.times else None

    def is_large(self, row, name):
        """Whether the deviation needs a reason. Any number deviates from 0."""
        off = self.deviation(row, name)
        if name in self.times or off is not None:
            return name not in self.times and abs(off) > EXPLAINED_FROM
        return row.get(name) == 0 and row["kds"][name] != 0

    def reason(self, row, name):
        """Returns why a figure deviates: the reason that names the row most closely, else that of the column."""
        fits = [(part, reason["reason"]) for reason in self.reasons if reason["column"] == name
                for part in (reason["rows"] or "").split("; ") if row["row"].startswith(part)]
        return max(fits, key=lambda fit: len(fit[0]))[1] if fits else "no reason is known"

    def print_rows(self):
        """Prints times, ratios and counts beside the paper's, then notes on inputs and reasons of deviations."""

        def off(row, name):
            deviation = self.deviation(row, name)
            return "" if deviation is None else f"{round(100 * deviation):+,}%".replace("+0%", "0%")

        def remark(text, rows):
            self.say(f"  - {text}. Rows: {'; '.join(rows)}.")

        for names in (self.times, list(self.ratios), self.counts):
            in_paper = {name: any(row.get(name) is not None for row in self.rows) for name in names}
            heads, columns = ["model"], [lambda row: row["row"]]
            for name in names:
                parts = [(name, lambda row, name=name: row["kds"][name]), ("paper", lambda row, name=name: row.get(name)),
                         ("off", lambda row, name=name: off(row, name))]
                for head, column in parts[:1 if not in_paper[name] else 2 if name in self.times else 3]:
                    heads, columns = heads + [head], columns + [column]
            self.show(heads, [[column(row) for column in columns] for row in self.rows])
        for note in dict.fromkeys(row["note"] for row in self.rows if row["note"]):
            remark(note, [row["row"] for row in self.rows if row["note"] == note])
        large = [(f"{name}: {self.reason(row, name)}", f"{row['row']} ({off(row, name) or 'the paper has 0'})")
                 for name in (*self.ratios, *self.counts) for row in self.rows if self.is_large(row, name)]
        for reason in dict.fromkeys(text for text, _ in large):
            remark(reason, [row for text, row in large if text == reason])
        self.say()


def is_in_dynamics(row):
    """Whether the row is a chain of a simulation."""
    return row["model"].startswith(("villin", "random"))


def is_protein(row):
    return is_in_dynamics(row) or row["model"].startswith(("1a4y", "1cem"))
