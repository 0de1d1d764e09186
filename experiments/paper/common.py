"""Tools of the scripts of this folder: options, numbers of the paper in CSV files, printed tables, claims, and figures."""

import argparse
import csv
import json
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent


def read_csv(name):
    """Returns the rows of a CSV file of this folder. Numbers become numbers; an empty field is None."""

    def value(text):
        try:
            return int(text) if text.isdigit() else float(text)
        except ValueError:
            return text or None

    with open(HERE / name, newline="", encoding="utf-8") as file:
        return [{name: value(text) for name, text in row.items()} for row in csv.DictReader(file)]


def shown(value):
    """Returns large numbers in full and others with three figures."""
    if value is None or isinstance(value, str):
        return value or ""
    return f"{value:,.0f}" if value >= 1000 or (value == int(value) and value >= 2) else f"{value:.3g}"


def span(values):
    """Returns the least and the largest value in words."""
    return f"{shown(min(values))} to {shown(max(values))}"


def subplots(*shape, **options):
    """Returns a figure of matplotlib and its axes. Text stays text in its SVG, and files do not vary."""
    import matplotlib

    matplotlib.use("svg")
    from matplotlib import pyplot

    pyplot.rcParams.update({"svg.fonttype": "none", "svg.hashsalt": "kds"})
    return pyplot.subplots(*shape, **options)


def save(figure, path):
    """Writes a figure of subplots() and closes it."""
    from matplotlib import pyplot

    figure.savefig(path, metadata={"Date": None})
    pyplot.close(figure)


class Report:
    """The options of a script and its results, which finish() prints and --json writes. `text` says what it measures. `options`
    are further options of the script, each with its keywords for argparse; `given` has their values."""

    def __init__(self, text, **options):
        self.title = text.strip().splitlines()[0].rstrip(".")
        parser = argparse.ArgumentParser(description=text, formatter_class=argparse.RawDescriptionHelpFormatter)
        parser.add_argument("--short", action="store_true", help="leave out large inputs and measure each time once")
        parser.add_argument("--json", metavar="FILE", help="write rows and verdicts to FILE; - is standard output")
        parser.add_argument("--data", metavar="DIR", type=Path, default=HERE.parents[1] / "data",
                            help="the project's data folder (default: that beside this script)")
        for name, keywords in options.items():
            parser.add_argument(f"--{name}", **keywords)
        given = parser.parse_args()
        if not given.data.is_dir():
            parser.error(f"--data: {given.data} is no folder; expected the project's data folder")
        if not (given.data / "trajectories").is_dir():
            parser.error(f"--data: {given.data} has no folder trajectories; expected the project's data folder")
        for name, path in vars(given).items():
            if name in ("json", "csv") and path not in (None, "-") and (Path(path).is_dir() or not Path(path).parent.is_dir()):
                parser.error(f"--{name}: cannot write {path}; expected a file in a folder that exists")
        self.short, self.data, self.json, self.given = given.short, given.data, given.json, given
        self.rounds = 1 if self.short else 5
        self.out = sys.stderr if self.json == "-" else sys.stdout
        self.results = {"title": self.title, "rows": [], "claims": []}
        print(self.title, file=self.out)

    def say(self, text=""):
        print(text, file=self.out)

    def show(self, heads, rows):
        """Prints a table. `rows` are lists of numbers or texts; the first column is ruled left, the others right."""
        cells = [heads, *([shown(value) for value in row] for row in rows)]
        widths = [max(len(row[k]) for row in cells) for k in range(len(heads))]
        for row in cells:
            self.say("  " + "  ".join(f"{cell:{'>' if k else '<'}{widths[k]}}" for k, cell in enumerate(row)).rstrip())
        self.say()

    def claim(self, name, words, holds, figures):
        """Adds the verdict on a claim: its name, a sentence without its full stop, whether it holds, and the figures."""
        self.results["claims"].append({"claim": name, "words": words, "holds": bool(holds), "figures": figures})
        self.say(f"  {words}: {'yes' if holds else 'no'} ({figures}).")

    def finish(self):
        """Writes the JSON if it is asked for."""
        text = json.dumps(self.results, indent=1, default=lambda number: number.item()) + "\n"
        if self.json == "-":
            sys.stdout.write(text)
        elif self.json:
            Path(self.json).write_text(text, encoding="utf-8")
