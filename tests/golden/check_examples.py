"""Runs the examples of a document and compares what they print. Times are not compared.

    check_examples.py PROGRAM ROOT DOCUMENT

An example is a code block whose first line is `$ build/release/bin/kds ...`. `...` in a line of its own stands for any lines.
"""

import difflib
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile

SHELL = "$ build/release/bin/kds "
# Lines of times, and times at the end of a line. Columns move with the width of times.
TIMES = re.compile(r"^(seconds|first build|static build|kinetic / static|engine|threads)\b.*|( [\d.]+ \([\d.]+ to [\d.]+\)| -)+$", re.M)


def examples_of(text):
    for block in re.findall(r"^```\w*\n(.*?)^```$", text, re.M | re.S):
        if block.startswith(SHELL):
            command, _, output = re.sub(r"\\\n\s*", "", block).partition("\n")
            yield shlex.split(command[len(SHELL):]), output


def compared(text):
    lines = [re.sub(r"\s+", " ", line).strip() for line in text.strip().splitlines()]
    return [TIMES.sub("TIME", line) for line in lines]


def matches(expected, found):
    pattern = "".join(r"(.*\n)*" if line == "..." else re.escape(line) + "\n" for line in expected)
    return re.fullmatch(pattern, "".join(line + "\n" for line in found)) is not None


def main(program, root, document):
    failed = count = 0
    for arguments, output in examples_of(pathlib.Path(root, document).read_text(encoding="utf-8")):
        with tempfile.TemporaryDirectory() as folder:
            written = [str(pathlib.Path(folder, name)) if before == "-o" else name
                       for before, name in zip(["", *arguments], arguments)]
            run = subprocess.run([program, *written], cwd=root, capture_output=True, text=True, check=False)
            printed = run.stdout.replace(folder + "/", "")
        count += 1
        if run.returncode == 0 and matches(compared(output), compared(printed)):
            continue
        failed += 1
        print(f"{document}, kds {shlex.join(arguments)}: prints other lines", run.stderr,
              *difflib.unified_diff(compared(output), compared(printed), "document", "program", "", "", 0, ""), sep="\n")
    print(f"{document}: {count} examples, {failed} differ")
    return 0 if count > 0 and failed == 0 else 1


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
