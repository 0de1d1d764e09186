"""Examples of docstrings and of docs/python.md run, and stubs have the signatures of the module."""

import ast
import contextlib
import doctest
import importlib
import inspect
import io
import os
import pkgutil
import pydoc
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import warnings
from pathlib import Path

import numpy as np

import kds
from data import DCD, PDB, PROGRAM

ROOT = Path(__file__).resolve().parents[2]


class Module(unittest.TestCase):
    def test_exports_only_its_entry_point(self):
        nm = ["nm", "-D", "--defined-only", kds._kds.__file__]
        symbols = subprocess.run(nm, capture_output=True, text=True, check=True).stdout
        self.assertEqual([line.split()[-1] for line in symbols.splitlines()], ["PyInit__kds"])


class Docstrings(unittest.TestCase):
    def test_examples_run(self):
        tried = 0
        for module in pkgutil.iter_modules(kds.__path__, "kds."):
            if module.name in ("kds._kds", "kds._analysis"):
                continue
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                result = doctest.testmod(importlib.import_module(module.name))
            self.assertEqual(result.failed, 0, module.name)
            tried += result.attempted
        self.assertGreater(tried, 40)

    def test_everything_public_has_one(self):
        for name in kds.__all__:
            if name in ("ContactAnalysis", "KineticAnalysis"):
                continue
            thing = getattr(kds, name)
            self.assertTrue(inspect.getdoc(thing), name)
            for member, value in vars(thing).items() if inspect.isclass(thing) else ():
                if not member.startswith("_") and (callable(value) or isinstance(value, property)):
                    self.assertTrue(inspect.getdoc(getattr(thing, member)), f"{name}.{member}")

    def test_help_names_shapes_and_units(self):
        text = inspect.getdoc(kds.run)
        for word in ("(frames, beads, 3)", "angstrom", "picoseconds", "float32"):
            self.assertIn(word, text)


class Stubs(unittest.TestCase):
    stub = ast.parse((Path(kds.__file__).parent / "__init__.pyi").read_text())
    functions = {node.name: node for node in stub.body if isinstance(node, ast.FunctionDef)}
    classes = {node.name: node for node in stub.body if isinstance(node, ast.ClassDef)}

    def options(self, name):
        """Returns the members of a TypedDict, with their annotations."""
        node, found = self.classes[name], {}
        for base in node.bases:
            found.update(self.options(base.id) if base.id != "TypedDict" else {})
        found.update({member.target.id: ast.unparse(member.annotation) for member in node.body
                      if isinstance(member, ast.AnnAssign)})
        return found

    def assert_same(self, node, function, name):
        """Compares a function of the stub, with its options, with the signature of the module."""
        found = list(inspect.signature(function).parameters.values())
        self.assertNotIn(inspect.Parameter.VAR_KEYWORD, [one.kind for one in found], name)
        several = [node.args.vararg] if node.args.vararg else []
        declared = [argument.arg for argument in [*node.args.args, *several, *node.args.kwonlyargs]]
        options = self.options(node.args.kwarg.annotation.slice.id) if node.args.kwarg else {}
        self.assertEqual([one.name for one in found][:len(node.args.args)], declared[:len(node.args.args)], name)
        self.assertEqual(sorted(one.name for one in found), sorted([*declared, *options]), name)
        for one in found:
            if one.name in options:
                self.assertEqual(one.default, False if options[one.name] == "bool" else None, f"{name}: {one.name}")

    def test_they_have_the_signatures(self):
        self.assertEqual(set(kds.__all__) - set(self.functions) - set(self.classes), set())
        for name, node in self.functions.items():
            self.assert_same(node, getattr(kds, name), name)
        for name in ("Run", "KineticRun", "Structure", "Contacts", "Intervals", "Surface", "Voids", "ContactAnalysis",
                     "KineticAnalysis"):
            for node in self.classes[name].body if hasattr(kds, name) else ():
                if isinstance(node, ast.FunctionDef) and (node.name == "__init__" or not node.name.startswith("__")):
                    member = inspect.getattr_static(getattr(kds, name), node.name)
                    function = getattr(member, "fget", None) or getattr(member, "__func__", member)
                    self.assert_same(node, function, f"{name}.{node.name}")

    def test_options_are_those_of_the_program(self):
        """Compares signatures and help with the text of the program's help, not with the lists that made them."""
        missing = {"frames", "format", "out", "replace", "paper", "json", "quiet", "help", "view", "dump", "events", "log", "times",
                   "every", "continue"}
        for name, command, but in (("run", "run", {"rounds"}), ("contacts", "contacts", set()), ("compare", "compare", set()),
                                   ("update", "update", set()), ("collide", "collide", set()), ("trade", "trade", set()),
                                   ("surface", "surface", set()), ("voids", "voids", set()),
                                   ("conditions", "info", {"beads"}), ("stream", "run", {"rounds"}), ("KineticRun", "run", {"rounds"})):
            help = "".join(subprocess.run([PROGRAM, *words], capture_output=True, text=True, check=True).stdout
                           for words in ([command, "--help"], ["help", "inputs"]))
            expected = {line.split()[0][2:].replace("-", "_") for line in help.splitlines() if line.startswith("  --")}
            self.assertGreater(len(expected), 15)
            function = getattr(kds, name)
            self.assertEqual(expected - missing - but - set(inspect.signature(function).parameters), set(), name)
            text = inspect.getdoc(getattr(function, "__init__", function) if inspect.isclass(function) else function)
            for option in expected - missing - but - {"radius", "units", "velocities", "groups", "cutoff"}:
                self.assertRegex(text, rf"(?m)^{option}$", name)
        self.assertIn("kernel=None", pydoc.render_doc(kds.run))


class WithoutOtherPackages(unittest.TestCase):
    def test_numpy_is_enough(self):
        code = """
import sys
for name in ("pandas", "matplotlib", "matplotlib.pyplot", "tqdm", "tqdm.auto", "MDAnalysis", "mdtraj", "scipy", "networkx"):
    sys.modules[name] = None
import kds
spiral = kds.generate("spiral", beads=30, frames=5)
run = kds.run(spiral, radius=1, structures=["contacts"], cutoff=3, verbose=True)
rows = run.contacts.lifetimes(by="bead")
assert rows.dtype.names[:2] == ("i", "j") and len(rows) > 0
assert len(run.results.events) == len(run.events)
found = run.contacts.analysis(by="bead")
for needs in (run.plot, found.at_frames, found.to_networkx):
    try:
        needs()
    except ImportError as error:
        print(error)
"""
        found = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
        self.assertEqual(found.returncode, 0, found.stderr)
        for words in ("plots need matplotlib", "sparse matrices need scipy", "graphs need networkx"):
            self.assertIn(words, found.stdout)


class Manual(unittest.TestCase):
    def test_its_examples_run(self):
        try:
            import MDAnalysis  # noqa: F401
            import mdtraj  # noqa: F401
        except Exception as error:
            self.skipTest(f"the examples need MDAnalysis and mdtraj ({error})")
        self.run_blocks("python.md", 8, (PDB, "md.pdb"), (DCD, "md.dcd"), (ROOT / "data" / "proteins" / "1l2y.pdb", "1l2y.pdb"))

    def test_those_of_residence_run(self):
        try:
            import matplotlib
        except Exception as error:
            self.skipTest(f"the examples need matplotlib ({error})")
        matplotlib.use("svg")
        files = [ROOT / "data" / "trajectories" / f"{name}{end}" for name in ("enkephalin_water", "ions_chain", "lipids_rod")
                 for end in (".xtc", ".gro")]
        names = self.run_blocks("residence.md", 8, *((file, file.name) for file in files))
        times, number = names["coordination"](names["once"].intervals)
        self.assertTrue(np.all(np.diff(times) >= 0))
        self.assertEqual(number[times <= 0].tolist()[-1], names["once"].all["open_at_start"])
        self.assertAlmostEqual(np.sum(number[:-1] * np.diff(times)), names["once"].all["total"], places=6)
        self.assertEqual([round(float(names["curves"][name][2]), 2) for name in ("continuous", "intermittent")], [0.38, 0.61])

    def test_examples_of_the_dual_complex(self):
        try:
            import matplotlib
            import pandas  # noqa: F401
        except Exception as error:
            self.skipTest(f"the examples need matplotlib and pandas ({error})")
        matplotlib.use("svg")
        files = [ROOT / "data" / "trajectories" / name for name in ("villin_hp36_300K.dcd", "villin_hp36_300K.pdb",
                                                                    "dhodh363_1000K_first20.dcd", "dhodh363_1000K.pdb")]
        names = self.run_blocks("dual_complex.md", 6, *((file, file.name) for file in files))
        run, lines = names["run"], list(names["zigzag"](names["run"]))
        now = {}  # simplices, each with the number of those of one bead more that contain it
        for line in lines:
            beads = tuple(map(int, line.split()[1:]))
            faces = [beads[:k] + beads[k + 1:] for k in range(len(beads))] if len(beads) > 1 else []
            if line.startswith("i "):
                self.assertNotIn(beads, now)
                now[beads] = 0
            else:
                self.assertEqual(now.pop(beads), 0, line)
            for face in faces:
                now[face] += 1 if line.startswith("i ") else -1
        last = {tuple(bead for bead in row if bead >= 0) for row in run.dual.elements(39).tolist()}
        self.assertEqual(set(now), last)
        self.assertEqual(names["euler"].iloc[-1], sum((-1) ** (len(beads) - 1) for beads in last))

    def run_blocks(self, document, least, *copies):
        """Runs the blocks of Python in a document, in a folder with copies of files. Returns the names they define."""
        blocks = re.findall(r"```python\n(.*?)```", (ROOT / "docs" / document).read_text(), re.S)
        self.assertGreaterEqual(len(blocks), least)
        before = os.getcwd()
        names = {}
        with tempfile.TemporaryDirectory() as folder, warnings.catch_warnings():
            warnings.simplefilter("ignore")
            for source, name in copies:
                shutil.copy(source, os.path.join(folder, name))
            os.chdir(folder)
            try:
                for number, block in enumerate(blocks):
                    with self.subTest(block=number), contextlib.redirect_stdout(io.StringIO()):
                        exec(compile(block, f"docs/{document}, block {number}", "exec"), names)  # noqa: S102
            finally:
                os.chdir(before)
        return names


if __name__ == "__main__":
    unittest.main()
