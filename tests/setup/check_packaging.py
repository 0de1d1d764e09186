"""Checks that all packages agree: versions, dependencies, options and tests, with CMakeLists.txt and scripts/packages.

    check_packaging.py ROOT
"""

import ast
import json
import re
import sys
import tomllib
from pathlib import Path

import yaml

ROOT = Path(sys.argv[1])
failures = []


def read(path):
    return (ROOT / path).read_text()


def expect(what, found, expected):
    if found != expected:
        failures.append(f"{what}: expected {expected}, found {found}")


cmake = read("CMakeLists.txt")
version = re.search(r"project\(kds VERSION ([0-9.]+)", cmake).group(1)
at_least = dict(re.findall(r"kds_find_package\((\w+) ([0-9.]+)\)", cmake))
at_least["cmake"] = re.search(r"cmake_minimum_required\(VERSION ([0-9.]+)", cmake).group(1)
rows = [line.split() for line in read("scripts/packages").splitlines() if re.match("program|tests", line)]
program = [row for row in rows if row[0] == "program" and row[2] != "g++"]  # all packages name the compiler in their own way
program.append(next(row for row in rows if row[1] == "pybind11"))
by_cmake = [row[1] for row in program if row[1] not in ("-", "pybind11")]

recipe = yaml.safe_load(read("packaging/conda/recipe.yaml"))
environment = yaml.safe_load(read("packaging/environment.yml"))
control = [dict(re.findall(r"^([\w-]+):((?:.*\n)(?: .*\n?)*)", paragraph, re.M))
           for paragraph in read("packaging/debian/control").split("\n\n")]
ports = {name: json.loads(read(f"packaging/vcpkg/{name}/vcpkg.json")) for name in ("kds", "gemmi")}
spack = "packaging/spack/spack_repo/kds/packages/kds/package.py"
calls = [[argument.value for argument in call.args] for call in ast.walk(ast.parse(read(spack)))
         if isinstance(call, ast.Call) and getattr(call.func, "id", "") in ("version", "depends_on")]
ast.parse(read(spack.replace("/kds/package.py", "/gemmi/package.py")))
python = tomllib.loads(read("pyproject.toml"))
wheels = python["tool"]["cibuildwheel"]
kit = yaml.safe_load(read("packaging/mdakits/metadata.yaml"))
workflows = {path.stem: yaml.safe_load(path.read_text()) for path in (ROOT / ".github" / "workflows").glob("*.yml")}

for what, found in {
        "recipe.yaml": recipe["context"]["version"], "vcpkg.json": ports["kds"]["version"], "package.py": calls[0][0],
        "debian/changelog": re.match(r"kds \(([0-9.]+)-", read("packaging/debian/changelog")).group(1),
        "CITATION.cff": yaml.safe_load(read("CITATION.cff"))["version"]}.items():
    expect(f"version of {what}", found, version)

# Dependencies. The dictionaries map the name of a package to the lowest version that is accepted.
conda = recipe["requirements"]["build"] + recipe["requirements"]["host"]
conda = dict((f"{entry} >=".split(" >=")[:2]) for entry in conda if not entry.startswith("${{"))
alternatives = [entry.split("|")[-1] for entry in control[0]["Build-Depends"].split(",")]  # the last is that of older releases
debian = dict(re.fullmatch(r"\s*([\w.+-]+)(?: \([>=]+ ([0-9.]+)\))?\s*", entry).groups("") for entry in alternatives)
expect("environment.yml", sorted(environment["dependencies"]), sorted(row[6] for row in rows if row[6] != "-"))
for row in program:
    lowest = at_least.get("cmake" if row[2] == "cmake" else row[1], "")
    expect(f"Build-Depends of Debian: {row[2]}", debian.get(row[2]), lowest)
    if row[6] != "-":
        expect(f"requirements of conda-forge: {row[6]}", conda.get(row[6]), lowest)
expect("conda-forge's other requirements", sorted(set(conda) - {row[6] for row in program}), ["pip", "python"])
names = {"Eigen3": "eigen3", "CGAL": "cgal", "Boost": "boost-math", "ZLIB": "zlib", "KdsNetcdf": "netcdf-c", "CLI11": "cli11",
         "nlohmann_json": "nlohmann-json", "KdsPegtl": "gemmi"}  # gemmi brings PEGTL along
of_vcpkg = {names.get(name, name.removeprefix("Kds").lower()) for name in by_cmake}
found = {entry if isinstance(entry, str) else entry["name"] for entry in ports["kds"]["dependencies"]}
expect("dependencies of vcpkg", sorted(found - {"vcpkg-cmake", "vcpkg-cmake-config"}), sorted(of_vcpkg))
of_spack = {{"eigen3": "eigen", "boost-math": "boost", "zlib": "zlib-api"}.get(name, name) for name in of_vcpkg}
specs = dict(re.fullmatch(r"([\w-]+)(?:[+]\w+)?(?:@([0-9.]+):)?", call[0]).groups() for call in calls[1:])
expect("dependencies of Spack", sorted(set(specs) - {"cxx", "cmake"}), sorted(of_spack))
for name, lowest in {"cmake": "cmake", "cgal": "CGAL", "flint": "KdsFlint"}.items():
    numbers = [[int(part) for part in text.split(".")] for text in (specs[name], at_least[lowest])]
    expect(f"Spack takes an older {name} than {at_least[lowest]}", numbers[0] < numbers[1], False)
expect("Python dependencies of conda-forge", recipe["requirements"]["run"], ["python", *python["project"]["dependencies"]])
expect("Python dependencies of Debian", re.findall(r"python3-(\w+)", control[3]["Depends"]), python["project"]["dependencies"])
extras = {name for names in python["project"]["optional-dependencies"].values() for name in names}
needed = {name for file in (ROOT / "python" / "kds").glob("*.py") for name in re.findall(r'needed\("(\w+)', file.read_text())}
expect("packages that Python imports on demand and pyproject.toml does not name", needed - extras, set())

# Options and tests.
files = [path for folder in ("packaging", ".github") for path in (ROOT / folder).rglob("*") if path.is_file()]
texts = {path: path.read_text() for path in [*files, ROOT / "pyproject.toml"]}
options = re.findall(r"option\((KDS_\w+)", cmake + read("cmake/KdsTargets.cmake"))
for path, text in texts.items():
    expect(f"{path}: unknown options", set(re.findall(r"-D(KDS_\w+)=", text)) - set(options), set())
for path in ("pyproject.toml", "packaging/conda/recipe.yaml", "packaging/debian/rules", "packaging/vcpkg/kds/portfile.cmake"):
    expect(f"{path} sets KDS_ANY_PROCESSOR", "-DKDS_ANY_PROCESSOR=ON" in texts[ROOT / path], True)
tests = [*recipe["tests"][1]["script"], wheels["test-command"],
         *re.findall(r"Test-Command: (.*)", read("packaging/debian/tests/control"))]
for test in tests:
    known = re.fullmatch(r"(\{project\}/|bash )?packaging/check( program| module| library)+", test)
    expect(f"test command '{test}' calls packaging/check", known is not None, True)
expect("number of test commands", len(tests), 5)
expect("last step of test.yml", workflows["test"]["jobs"]["test"]["steps"][-1], {"run": "scripts/test"})
steps = workflows["wheels"]["jobs"]["wheels"]["steps"]
expect("wheels.yml builds wheels", any("cibuildwheel" in step.get("run", "") for step in steps), True)

# The registry MDAKits requires these fields, and clones project_home.git.
for name, kind in {**dict.fromkeys(("project_name", "description", "license", "project_home", "python_requires",
                                    "documentation_home", "documentation_type"), str),
                   **dict.fromkeys(("authors", "maintainers", "keywords", "install", "run_tests"), list)}.items():
    expect(f"metadata.yaml: type of {name}", type(kit.get(name)), kind)
for name, value in {"project_name": "name", "description": "description", "license": "license",
                    "python_requires": "requires-python"}.items():
    expect(f"metadata.yaml: {name}", kit[name], python["project"][value])
expect("metadata.yaml: project_home", kit["project_home"], python["project"]["urls"]["Repository"])
test = f"{kit['run_tests'][-1].split()[-1]}.py"
expect(f"tests/python has {test}", (ROOT / "tests" / "python" / test).exists(), True)

# packaging/README.md lists what a maintainer fills in.
listed = set(re.findall(r"^\| `(FILL_\w+)`", read("packaging/README.md"), re.M))
used = {word for path, text in texts.items() if path.name != "README.md" for word in re.findall(r"FILL_\w+", text)}
expect("placeholders that packaging/README.md lists", sorted(listed), sorted(used))

if failures:
    sys.exit("\n".join(failures))
print(f"kds {version}: {len(texts)} files of packages agree")
