"""Results for print: python3 -m kds.paper."""

import csv
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest
import unittest.mock

import kds.paper
from data import DCD, PDB, program

try:
    import matplotlib  # noqa: F401
    HAS_PLOTS = True
except ImportError:
    HAS_PLOTS = False


def print_in(folder, name, result):
    path = pathlib.Path(folder) / f"{name}.json"
    path.write_text(json.dumps(result), encoding="utf-8")
    run = subprocess.run([sys.executable, "-m", "kds.paper", path, folder], capture_output=True, text=True, check=False)
    return run, {file.name for file in path.parent.iterdir()}


class Paper(unittest.TestCase):
    def test_tables_have_the_numbers_and_are_cut_to_a_page(self):
        result = program("contacts", DCD, "--topology", PDB, "--cutoff", "7", "--frames", "0:60")
        with tempfile.TemporaryDirectory() as folder:
            run, files = print_in(folder, "contacts", result)
            self.assertEqual(run.returncode, 0 if HAS_PLOTS else 2, run.stderr)
            text = (pathlib.Path(folder) / "contacts-table-rows.tex").read_text(encoding="utf-8")
            with open(pathlib.Path(folder) / "contacts-table-rows.csv", newline="", encoding="utf-8") as file:
                everything = list(csv.DictReader(file))
        rows = [line.removesuffix(r" \\").split(" & ") for line in text.splitlines() if " & " in line]
        self.assertEqual(len(rows), 1 + kds.paper.ROWS_ON_A_PAGE)
        self.assertEqual({len(row) for row in rows}, {len(rows[0])})
        self.assertIn(f"% the first 40 of {len(result['rows'])} rows", text)
        self.assertEqual(len(everything), len(result["rows"]))
        most = max(result["rows"], key=lambda row: (row["occupancy"], row["total"]))
        self.assertEqual(float(everything[0]["total"]), most["total"])
        if HAS_PLOTS:
            self.assertLessEqual({f"contacts-figure-{name}.pdf" for name in ("survival", "course", "map", "spacings")}, files)

    def test_each_command_has_its_plot(self):
        if not HAS_PLOTS:
            self.skipTest("matplotlib is missing")
        short = [DCD, "--topology", PDB, "--frames", "0:12"]
        for name, arguments in {"events-wrapped": ["run", *short], "strides-1": ["compare", *short, "--strides", "1,2"],
                                "missed": ["missed", *short, "--cutoff", "6"], "closest": ["collide", *short],
                                "update": ["update", *short]}.items():
            with self.subTest(name), tempfile.TemporaryDirectory() as folder:
                run, files = print_in(folder, "result", program(*arguments))
                self.assertEqual(run.returncode, 0, run.stderr)
                self.assertIn(f"result-figure-{name}.pdf", files)

    def test_what_cannot_be_drawn_is_left_out_in_a_line(self):
        if not HAS_PLOTS:
            self.skipTest("matplotlib is missing")
        step = {"motion": "linear", "structure": "wrapped", "stride": 1}
        setting = {"setting": {"structures": "power"}, "cost": {"ratio": 1}, "pareto": True, "error": None}
        for command, rows, line, plots in (
                ("missed", [{"stride": 1, "cutoff": 8, "missed_fraction": None}], "plot missed is left out: ", 0),
                ("compare", [{"input": "a", "events_per_step": 0, **step}], "plot strides-1 is left out: ", 0),
                ("compare", [{"input": f"{k}$\\frac$", "events_per_step": 1, **step} for k in range(10)], ".* 2 inputs are left out", 8),
                ("update", [{"technique": "$\\frac$", "stride": 1, "ratio": 1}], "", 1),
                ("trade", [{"want": "scenes", **setting}], "no plot of scenes: ", 0)):
            with self.subTest(command, line=line), tempfile.TemporaryDirectory() as folder:
                run, files = print_in(folder, "x", {"command": f"kds {command} x", "rows": rows})
                self.assertEqual(run.returncode, 0, run.stderr)
                self.assertRegex(run.stderr, f"^kds.paper: {line}.*\n$" if line else "^$")
                self.assertEqual(len([name for name in files if name.endswith(".pdf")]), plots)

    def test_files_that_exist_stay_without_replace(self):
        with tempfile.TemporaryDirectory() as folder:
            path, table = pathlib.Path(folder) / "x.json", pathlib.Path(folder) / "x-table-rows.tex"
            path.write_text('{"command": "kds info x", "rows": [{"a": "\u00e9"}]}', encoding="utf-8")
            table.write_text("mine", encoding="utf-8")
            with self.assertRaisesRegex(FileExistsError, "x-table-rows.tex exists; .* --replace"):
                kds.paper.write(path, folder)
            self.assertEqual(table.read_text(encoding="utf-8"), "mine")
            self.assertEqual(kds.paper.write(path, folder, replace=True), [table])
            self.assertIn("\u00e9", table.read_text(encoding="utf-8"))
            self.assertEqual(sorted(os.listdir(folder)), ["x-table-rows.tex", "x.json"])

    @unittest.mock.patch("kds.paper.draw", side_effect=RuntimeError)
    def test_nothing_is_written_if_drawing_fails(self, _):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "x.json"
            path.write_text('{"command": "kds missed x", "rows": [{"stride": 1}]}', encoding="utf-8")
            self.assertRaises(RuntimeError, kds.paper.write, path, folder)
            self.assertEqual(os.listdir(folder), ["x.json"])

    def test_files_go_to_the_current_directory(self):
        with tempfile.TemporaryDirectory() as folder, tempfile.TemporaryDirectory() as current:
            path = pathlib.Path(folder) / "x.json"
            path.write_text('{"command": "kds info x", "rows": [{"a": 1}]}', encoding="utf-8")
            run = subprocess.run([sys.executable, "-m", "kds.paper", path], capture_output=True, text=True, check=False, cwd=current)
            self.assertEqual((run.returncode, run.stdout), (0, "x-table-rows.tex\n"), run.stderr)
            self.assertEqual((os.listdir(folder), os.listdir(current)), (["x.json"], ["x-table-rows.tex"]))

    def test_each_table_has_its_columns(self):
        contacts = program("contacts", DCD, "--topology", PDB, "--select", "ca", "--cutoff", "8", "--frames", "0:12")
        spacings = kds.paper.tables_of(contacts, "contacts")["spacings"]
        self.assertEqual(kds.paper.columns_of(spacings)[:3], ["spacing", "samples", "found"])
        setting = {"structures": "wrapped", "between": "chord"}
        [row] = kds.paper.tables_of({"rows": [{"setting": setting, "cost": {"seconds": 1}}]}, "trade")["rows"]
        self.assertEqual(row, {"setting": "wrapped --between chord", "cost_seconds": 1})
        self.assertEqual(kds.paper.columns_of([row], kds.paper.COLUMNS["trade"]), ["setting", "cost_seconds"])

    def test_the_distance_of_the_closest_pair_is_that_of_its_frame(self):
        course = [{"frame": 0, "closest": {"i": 1, "j": 5, "distance": 0.7}}, {"frame": 1, "closest": None}]
        axes = unittest.mock.MagicMock()
        kds.paper.draw_collide({"course": course}, lambda *_: axes)
        axes.plot.assert_called_once_with([0], [0.7])

    def test_words_and_numbers_of_latex(self):
        self.assertEqual(kds.paper.latex_text("50% of a_b & \\c"), r"50\% of a\_b \& \textbackslash{}c")
        self.assertEqual(kds.paper.cell({"x": 1234567}, "x"), r"1\,234\,567")
        self.assertEqual(kds.paper.cell({"x": 0.123456, "x_lower": 0.1, "x_upper": 0.2}, "x"), "0.1235 (0.1 to 0.2)")
        self.assertEqual(kds.paper.cell({"x": 1.5e-7}, "x"), r"$1.5 \cdot 10^{-7}$")
        self.assertEqual(kds.paper.cell({"x": None}, "x"), "--")
        self.assertEqual(kds.paper.latex_text("a\r\nb --c"), "a b -{}-c")
        rows = kds.paper.tabular([{"x": "[1]"}, {"x": "*"}, {"x": "a"}], ["x"]).splitlines()[4:7]
        self.assertEqual(rows, [r"{}[1] \\", r"{}* \\", r"a \\"])

    def test_what_is_no_result_is_refused_in_a_line(self):
        for content, fault in {
                '{"rows": []}': "is not the result of a single command",
                '{"command": "kds "}': "is not the result of a single command",
                "[1, 2]": "is not the result of a single command",
                "": "is not JSON",
                "{": "is not JSON",
                "\udcff": "is not JSON",
                '{"command": "kds contacts"}': "result.by must be a text",
                '{"command": "kds missed x"}': "result.rows must be a list",
                '{"command": "kds info", "rows": 5}': "result.rows must be a list",
                '{"command": "kds info", "rows": [1]}': "result.rows[0] must be an object",
                '{"command": "kds run", "structures": []}': "result.structures must be an object"}.items():
            with self.subTest(content), tempfile.TemporaryDirectory() as folder:
                path = pathlib.Path(folder) / "other.json"
                path.write_text(content, encoding="utf-8", errors="surrogateescape")
                with self.assertRaises(ValueError) as refused:
                    kds.paper.write(path, folder)
                self.assertTrue(str(refused.exception).startswith(f"{path}: {fault}"), refused.exception)
                self.assertTrue(str(refused.exception).endswith("expected the file that --json or --out of a single command writes"))
                self.assertEqual(os.listdir(folder), ["other.json"])

    def test_an_error_is_one_line(self):
        run = subprocess.run([sys.executable, "-m", "kds.paper", "none.json"], capture_output=True, text=True, check=False)
        self.assertEqual((run.returncode, run.stderr.count("\n")), (2, 1), run.stderr)


if __name__ == "__main__":
    unittest.main()
