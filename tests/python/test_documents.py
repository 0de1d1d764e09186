"""Examples of docstrings and of docs/python.md run, and stubs have the signatures of the module."""

import ast
import contextlib
import doctest
import importlib
import inspect
import io
import os
import pkgutil
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import warnings
from pathlib import Path

import kds
from data import DCD, PDB

ROOT = Path(__file__).resolve().parents[2]


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
            if name == "KineticAnalysis":
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


def parameters(node):
    arguments = node.args
    return [argument.arg for argument in arguments.args + arguments.kwonlyargs]


class Stubs(unittest.TestCase):
    def test_they_have_the_signatures(self):
        stub = ast.parse((Path(kds.__file__).parent / "__init__.pyi").read_text())
        functions = {node.name: node for node in stub.body if isinstance(node, ast.FunctionDef)}
        classes = {node.name: node for node in stub.body if isinstance(node, ast.ClassDef)}
        self.assertEqual(set(kds.__all__) - set(functions) - set(classes), set())
        for name, node in functions.items():
            self.assertEqual(parameters(node), [p.name for p in inspect.signature(getattr(kds, name)).parameters.values()
                                                if p.kind != p.VAR_KEYWORD], name)
        for name in ("Run", "KineticRun", "Structure", "Contacts"):
            for node in classes[name].body:
                if isinstance(node, ast.FunctionDef) and not node.name.startswith("__"):
                    member = inspect.getattr_static(getattr(kds, name), node.name)
                    function = getattr(member, "fget", None) or getattr(member, "__func__", member)
                    self.assertEqual(parameters(node), [p.name for p in inspect.signature(function).parameters.values()
                                                        if p.kind != p.VAR_KEYWORD], f"{name}.{node.name}")


class WithoutOtherPackages(unittest.TestCase):
    def test_numpy_is_enough(self):
        code = """
import sys
for name in ("pandas", "matplotlib", "matplotlib.pyplot", "tqdm", "tqdm.auto", "MDAnalysis", "mdtraj"):
    sys.modules[name] = None
import kds
spiral = kds.generate("spiral", beads=30, frames=5)
run = kds.run(spiral, radius=1, structures=["contacts"], cutoff=3, verbose=True)
rows = run.contacts.lifetimes(by="bead")
assert rows.dtype.names[:2] == ("i", "j") and len(rows) > 0
assert len(run.results.events) == len(run.events)
try:
    run.plot()
except ImportError as error:
    print(error)
"""
        found = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
        self.assertEqual(found.returncode, 0, found.stderr)
        self.assertIn("plots need matplotlib", found.stdout)


class Manual(unittest.TestCase):
    def test_its_examples_run(self):
        try:
            import MDAnalysis  # noqa: F401
            import mdtraj  # noqa: F401
        except Exception as error:
            self.skipTest(f"the examples need MDAnalysis and mdtraj ({error})")
        blocks = re.findall(r"```python\n(.*?)```", (ROOT / "docs" / "python.md").read_text(), re.S)
        self.assertGreater(len(blocks), 8)
        before = os.getcwd()
        with tempfile.TemporaryDirectory() as folder, warnings.catch_warnings():
            warnings.simplefilter("ignore")
            shutil.copy(PDB, os.path.join(folder, "md.pdb"))
            shutil.copy(DCD, os.path.join(folder, "md.dcd"))
            os.chdir(folder)
            names = {}
            try:
                for number, block in enumerate(blocks):
                    with self.subTest(block=number), contextlib.redirect_stdout(io.StringIO()):
                        exec(compile(block, f"docs/python.md, block {number}", "exec"), names)  # noqa: S102
            finally:
                os.chdir(before)


if __name__ == "__main__":
    unittest.main()
