"""Writes a result for print: its plots as PDF, its tables as LaTeX.

    python3 -m kds.paper RESULT.json [DIR] [--replace]

RESULT.json is what a command of kds writes with --json, or into --out. The current directory, or DIR, gets RESULT-figure-NAME.pdf
and RESULT-table-NAME.tex, a ``tabular`` with the rules of the LaTeX package booktabs. Files that exist are replaced only with
--replace. A table of more than 40 rows is cut to the first 40, and says so in a comment; RESULT-table-NAME.csv has all. Plots
need matplotlib. A line on standard error names what is left out: a plot without values, and inputs of compare after the first 8.
"""

import argparse
import csv
import io
import json
import math
import os
import pathlib
import re
import sys
import tempfile

ROWS_ON_A_PAGE = 40
COLUMNS_ON_A_PAGE = 8
MOST_INPUTS = 8  # that compare's plots show
SPECIAL = {"\\": r"\textbackslash{}", "~": r"\textasciitilde{}", "^": r"\textasciicircum{}",
           **{character: "\\" + character for character in "&%$#_{}"}}

# The columns of the rows of each command. Other tables show their first columns that hold numbers or words.
COLUMNS = {
    "contacts": ["first", "second", "contacts", "occupancy", "residence", "total"],
    "compare": ["input", "structure", "motion", "stride", "events", "events_per_step", "net_changes", "events_per_net_change"],
    "missed": ["cutoff", "factor", "stride", "contacts", "missed", "missed_fraction"],
    "collide": ["method", "pairs", "colliding_frames", "family", "seconds"],
    "update": ["stride", "technique", "events", "efficiency", "seconds", "ratio"],
    "trade": ["want", "setting", "cost_seconds", "cost_ratio", "pareto"],
}

NUMBER = (int, float)
KINDS = {dict: "an object", list: "a list", str: "a text", NUMBER: "a number", bool: "true or false"}


def measured(name):
    return {f"{name}{end}?": NUMBER for end in ("", "_lower", "_upper")}


# The members that a result must have to be drawn (see check).
WANTED = {
    "contacts": {"by": str, "unit": str, "rows": [{"i": NUMBER, "j": NUMBER, "occupancy?": NUMBER, "total": NUMBER}],
                 "frames": [{f"{name}?": NUMBER for name in ("spacing", "plain_length", "bridged_length", "dual_length")}],
                 "survival": [{"length": NUMBER, "survival": NUMBER, "lower?": NUMBER, "upper?": NUMBER}],
                 "course": [{"frame": NUMBER, "contacts": NUMBER}]},
    "compare": {"rows": [{"input": str, "motion": str, "structure": str, "stride": NUMBER, **measured("events_per_step")}]},
    "missed": {"rows": [{"stride": NUMBER, **measured("missed_fraction")}]},
    "update": {"rows": [{"technique": str, "stride": NUMBER, **measured("ratio")}]},
    "collide": {"rows": [{}], "course?": [{"frame": NUMBER, "closest?": {"distance": NUMBER}}]},
    "trade": {"rows": [{"want": str, "setting": {"structures": str}, "cost": {"ratio?": NUMBER}, "error?": {"*?": NUMBER},
                        "pareto": bool}]},
    "run": {"structures": {"*": {"events": {"total": NUMBER, "*": NUMBER}, "certificates": {"created": NUMBER, "peak": NUMBER},
                                 "audits": {"run": NUMBER, "failed": NUMBER}, "internal": [str],
                                 "over_time?": {"steps": NUMBER, "events": [NUMBER]}}}},
}


def one_line(text):
    return re.sub(r"[\s\x00-\x1f\x7f]+", " ", str(text))


def plot_text(text):
    """Returns a text that matplotlib prints as it is: a $ begins no formula."""
    return one_line(text).replace("$", r"\$")


def latex_text(text):
    escaped = "".join(SPECIAL.get(character, character) for character in one_line(text))
    return re.sub("-(?=-)", "-{}", escaped)  # no ligature, which is a dash


def latex_row(cells):
    """Joins cells. An empty group keeps a first [ or * from being an argument of the command before it."""
    row = " & ".join(cells) + r" \\"
    return "{}" + row if row.lstrip().startswith(("[", "*")) else row


def number_text(value):
    """Writes four significant digits, and whole numbers with all of theirs."""
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, int):
        return f"{value:,}".replace(",", r"\,")
    text = f"{value:.4g}"
    found = re.fullmatch(r"(.*)e([+-])0*(\d+)", text)
    return rf"${found[1]} \cdot 10^{{{found[2].strip('+')}{found[3]}}}$" if found else text


def cell(row, column):
    """Writes a value, with its interval if the row has one."""
    value = row.get(column)
    if value is None:
        return "--"
    if isinstance(value, str):
        return latex_text(value)
    text = number_text(value)
    ends = [row.get(column + end) for end in ("_lower", "_upper")]
    if None in ends:
        ends = [row.get(column + end) for end in ("_least", "_most")]
    return text if None in ends else f"{text} ({number_text(ends[0])} to {number_text(ends[1])})"


def flat(row):
    """Makes columns of the members of objects, such as cost_seconds."""
    columns = {}
    for name, value in row.items():
        if isinstance(value, dict):
            columns.update({f"{name}_{inner}": one for inner, one in value.items()})
        else:
            columns[name] = value
    return {name: value for name, value in columns.items() if not isinstance(value, (list, dict))}


def columns_of(rows, listed=None):
    """Returns the names of the columns to print: those of `listed` that the rows have, or the first ones."""
    known = dict.fromkeys(name for row in rows for name in row)
    names = [name for name in listed or known if name in known]
    ends = re.compile("_(lower|upper|least|most)$")
    return [name for name in names if not ends.search(name) and any(row.get(name) is not None for row in rows)
            ][:COLUMNS_ON_A_PAGE]


def tabular(rows, columns):
    right = [all(not isinstance(row.get(name), str) for row in rows) for name in columns]
    lines = [rf"\begin{{tabular}}{{{''.join('r' if is_right else 'l' for is_right in right)}}}", r"\toprule",
             latex_row(latex_text(name.replace("_", " ")) for name in columns), r"\midrule"]
    lines += [latex_row(cell(row, name) for name in columns) for row in rows[:ROWS_ON_A_PAGE]]
    if len(rows) > ROWS_ON_A_PAGE:
        lines.append(f"% the first {ROWS_ON_A_PAGE} of {len(rows)} rows")
    return "\n".join([*lines, r"\bottomrule", r"\end{tabular}", ""])


def setting_text(setting):
    """Writes a setting as options of kds run: the structures, then the others."""
    options = dict(setting)
    return " ".join([options.pop("structures"), *(f"--{name} {value}" for name, value in options.items())])


def tables_of(result, command):
    """Returns the tables of a result, lists of flat rows by name."""
    tables = {name: result[name] for name in ("rows", "pooled") if result.get(name)}
    if command == "run":
        structures = result["structures"].items()
        tables["structures"] = [{"structure": name, "events": one["events"]["total"], "created": one["certificates"]["created"],
                                 "peak": one["certificates"]["peak"], "seconds": one.get("seconds"),
                                 "static_seconds": one.get("static_seconds"), "audits": one["audits"]["run"],
                                 "failed": one["audits"]["failed"]} for name, one in structures]
        tables["kinds"] = [{"structure": name, "kind": kind, "events": count, "internal": kind in one["internal"]}
                           for name, one in structures for kind, count in one["events"].items() if kind != "total"]
    if command == "contacts":
        tables["rows"] = sorted(tables.get("rows", []), key=lambda row: (-(row.get("occupancy") or 0), -row["total"]))
        tables["spacings"] = result["frames"]
    if command == "trade":
        tables["rows"] = [{**row, "setting": setting_text(row["setting"])} for row in tables["rows"]]
    flat_tables = {name: [flat(row) for row in rows] for name, rows in tables.items()}
    return {name: rows for name, rows in flat_tables.items() if columns_of(rows)}


def error_bars(axes, rows, x, y, label, scale=1):
    rows = [row for row in rows if row.get(y) is not None]
    if not rows:
        return
    values = [scale * row[y] for row in rows]
    low = [value if row.get(y + "_lower") is None else scale * row[y + "_lower"] for value, row in zip(values, rows)]
    high = [value if row.get(y + "_upper") is None else scale * row[y + "_upper"] for value, row in zip(values, rows)]
    axes.errorbar([row[x] for row in rows], values, marker="o", capsize=2, label=plot_text(label),
                  yerr=[[max(0, v - l) for v, l in zip(values, low)], [max(0, h - v) for v, h in zip(values, high)]])


def say(text):
    print(f"kds.paper: {text}", file=sys.stderr)


def by(rows, *names):
    groups = {}
    for row in rows:
        groups.setdefault(tuple(row.get(name) for name in names), []).append(row)
    return groups.items()


def draw_contacts(result, figure):
    survival = figure("survival", f"length of a contact ({result['unit']})", "share of contacts that last longer")
    points = [{"length": 0, "survival": 1, "lower": 1, "upper": 1}, *result["survival"]] if result["survival"] else []
    length = [point["length"] for point in points]
    survival.step(length, [point["survival"] for point in points], where="post")
    ends = [[float("nan") if point.get(end) is None else point[end] for point in points] for end in ("lower", "upper")]
    survival.fill_between(length, *ends, step="post", alpha=0.3, label="95% band")
    course = figure("course", "frame", "contacts at once")
    course.plot([point["frame"] for point in result["course"]], [point["contacts"] for point in result["course"]])
    share = figure("map", result["by"], result["by"])
    known = [row for row in result["rows"] if row.get("occupancy") is not None]
    pairs = share.scatter([row["i"] for row in known], [row["j"] for row in known], s=4, vmin=0, vmax=1,
                          c=[row["occupancy"] for row in known])
    share.figure.colorbar(pairs, label="share of time in contact")
    draw_spacings(result["frames"], figure)


def draw_spacings(rows, figure):
    """Draws the relative error of the mean length by the spacing of samples. The axes have no zero."""
    exact = next((row.get("plain_length") for row in rows if row.get("spacing") is None), None)
    axes = figure("spacings", "spacing of samples (frames)", "relative error of the mean length", log="xy")
    for kind in ("plain", "bridged", "dual"):
        known = [(row["spacing"], row.get(f"{kind}_length")) for row in rows if row.get("spacing") is not None]
        errors = [(spacing, abs(length / exact - 1)) for spacing, length in known if exact and length and length != exact]
        if errors:
            axes.plot(*zip(*errors), marker="o", label=kind)


def draw_compare(result, figure):
    inputs = list(dict.fromkeys(row["input"] for row in result["rows"]))
    if len(inputs) > MOST_INPUTS:
        say(f"plots of the first {MOST_INPUTS} inputs are drawn, and {len(inputs) - MOST_INPUTS} inputs are left out")
    drawn = [row for row in result["rows"] if row["input"] in inputs[:MOST_INPUTS]]
    for number, ((name, motion), rows) in enumerate(by(drawn, "input", "motion")):
        axes = figure(f"strides-{number + 1}", "stride", "events in a step", log="xy")
        axes.set_title(plot_text(f"{pathlib.Path(name).name}, {motion}"))
        for (structure,), some in by(rows, "structure"):
            error_bars(axes, some, "stride", "events_per_step", structure)


def draw_missed(result, figure):
    axes = figure("missed", "stride", "contacts that frames miss (%)", log="x")
    rule = "cutoff" if any("cutoff" in row for row in result["rows"]) else "factor"
    for (length,), rows in by(result["rows"], rule):
        error_bars(axes, rows, "stride", "missed_fraction", f"{rule} {length}", 100)


def draw_update(result, figure):
    axes = figure("update", "stride", "time / time to rebuild")
    for (technique,), rows in by(result["rows"], "technique"):
        error_bars(axes, rows, "stride", "ratio", technique)


def draw_collide(result, figure):
    if not result.get("course"):
        return
    axes = figure("closest", "frame", "distance of the closest pair")
    near = [point for point in result["course"] if point.get("closest")]
    axes.plot([point["frame"] for point in near], [point["closest"]["distance"] for point in near])


def draw_trade(result, figure):
    for (want,), rows in by(result["rows"], "want"):
        rows = [row for row in rows if row.get("error") and row["cost"].get("ratio") is not None]
        errors = dict.fromkeys(name for row in rows for name, value in row["error"].items() if value)
        if not errors:
            say(f"no plot of {want}: its rows have no errors")
        for error in errors:
            axes = figure(f"{want}-{error}", "processor time / exact run", error.replace("_", " "))
            for front in (True, False):
                some = [row for row in rows if row["pareto"] == front and row["error"].get(error) is not None]
                axes.scatter([row["cost"]["ratio"] for row in some], [row["error"][error] for row in some],
                             label="quickest of its error" if front else "others", marker="o" if front else "x")


def draw_run(result, figure):
    for name, structure in result["structures"].items():
        course = structure.get("over_time")
        if not course or not course["events"]:
            continue
        axes = figure(f"events-{name}", "step", f"events of {name} in {course['steps']} step(s)")
        axes.stairs(course["events"], [course["steps"] * k for k in range(len(course["events"]) + 1)])


def check(value, wanted, name):
    """Raises ValueError unless the value is what is wanted: a type, [type of elements], or an object {member: type}.

    A member "name?" may be missing or null; a member "*" stands for all.
    """
    kind = type(wanted) if isinstance(wanted, (dict, list)) else wanted
    if not isinstance(value, kind):
        raise ValueError(f"{name} must be {KINDS[kind]}")
    if kind is list:
        for number, element in enumerate(value):
            check(element, wanted[0], f"{name}[{number}]")
    elif kind is dict:
        for member, inner in wanted.items():
            for one in value if member.startswith("*") else [member.rstrip("?")]:
                if value.get(one) is not None or not member.endswith("?"):
                    check(value.get(one), inner, f"{name}.{one}")


def read(path):
    """Returns a result and its command, or raises ValueError that names the file and says what is wrong."""
    expected = "expected the file that --json or --out of a single command writes"
    try:
        result = json.loads(path.read_text(encoding="utf-8"))
    except (ValueError, RecursionError) as error:
        raise ValueError(f"{path}: is not JSON ({error}); {expected}") from error
    found = isinstance(result, dict) and re.match(r"kds (\w+)", str(result.get("command")))
    if not found:
        raise ValueError(f"{path}: is not the result of a single command; {expected}")
    command = "run" if "structures" in result else found[1]
    try:
        check(result, {"rows?": [{}], "pooled?": [{}], **WANTED.get(command, {})}, "result")
    except ValueError as error:
        raise ValueError(f"{path}: {error}; {expected}") from error
    return result, command


def draw(result, command, plots):
    """Returns the plots of a result, files in the format `plots` by name."""
    try:
        import matplotlib
        from matplotlib.figure import Figure
    except ImportError as error:
        raise ImportError("plots need matplotlib, which is not installed; the tables are written") from error
    figures = {}

    def figure(name, x, y, log=""):
        axes = Figure(figsize=(3.4, 2.6), layout="constrained").subplots()
        axes.set_xlabel(plot_text(x))
        axes.set_ylabel(plot_text(y))
        figures[name] = axes, log
        return axes

    files = {}
    with matplotlib.rc_context({"font.size": 8, "pdf.fonttype": 42, "svg.fonttype": "none", "svg.hashsalt": "kds"}):
        globals()[f"draw_{command}"](result, figure)
        for name, (axes, log) in figures.items():
            drawn = axes.dataLim
            if drawn.x0 > drawn.x1 or any(getattr(drawn, f"minpos{axis}") == math.inf for axis in log):
                say(f"plot {name} is left out: there is no value that its axes can show")
                continue
            for axis in log:
                getattr(axes, f"set_{axis}scale")("log", base=2 if axis == "x" else 10)
            if axes.get_legend_handles_labels()[1]:
                axes.legend()
            file = io.BytesIO()
            axes.figure.savefig(file, format=plots, metadata={"CreationDate" if plots == "pdf" else "Date": None})
            files[f"figure-{name}.{plots}"] = file.getvalue()
    return files


def print_tables(result, command):
    """Returns the tables of a result, LaTeX and CSV by the name of the file."""
    files = {}
    for name, rows in tables_of(result, command).items():
        files[f"table-{name}.tex"] = tabular(rows, columns_of(rows, COLUMNS.get(command) if name == "rows" else None))
        if len(rows) > ROWS_ON_A_PAGE:
            file = io.StringIO(newline="")
            table = csv.DictWriter(file, list(dict.fromkeys(column for row in rows for column in row)))
            table.writeheader()
            table.writerows(rows)
            files[f"table-{name}.csv"] = file.getvalue()
    return {name: text.encode("utf-8", "replace") for name, text in files.items()}


def write(path, folder=".", plots="pdf", replace=False):
    """Writes the files of a result, plots in the format `plots`, and returns their paths.

    All files are made before the first is written. A file that exists is refused unless `replace`.
    """
    path, folder = pathlib.Path(path), pathlib.Path(folder)
    result, command = read(path)
    files, missing = print_tables(result, command), None
    if not files:
        raise ValueError(f"{path}: has nothing to print; expected a result with rows or structures")
    if command in WANTED:
        try:
            files.update(draw(result, command, plots))
        except ImportError as error:
            missing = error
    folder.mkdir(parents=True, exist_ok=True)
    places = {folder / f"{path.stem}-{name}": content for name, content in files.items()}
    for place in places:
        if place.is_dir() or os.path.lexists(place) and not replace:
            raise FileExistsError(f"{place} exists; expected another folder, or --replace to replace files")
    with tempfile.TemporaryDirectory(prefix=".kds-paper-", dir=folder) as part:
        for place, content in places.items():
            (pathlib.Path(part) / place.name).write_bytes(content)
        for place in places:
            os.replace(pathlib.Path(part) / place.name, place)
    if missing:
        raise missing
    return list(places)


def main(arguments):
    parser = argparse.ArgumentParser(prog="kds.paper", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("result", metavar="RESULT.json")
    parser.add_argument("folder", metavar="DIR", nargs="?", default=".", help="where the files go (default: the current directory)")
    parser.add_argument("--replace", action="store_true", help="replaces files that exist")
    options = parser.parse_args(arguments)
    try:
        for written in write(options.result, options.folder, replace=options.replace):
            print(written)
    except (OSError, ValueError, ImportError) as error:
        say(error)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
