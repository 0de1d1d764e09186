#!/usr/bin/env python3
"""Compares what the program prints with a golden file, or rewrites the file.

    run_golden.py PROGRAM DATA PLACE FILE...

With KDS_WRITE_GOLDEN=1 in the environment the files are rewritten, otherwise they are compared.

A golden file is a list of entries and of comments, which are lines that start with '#'. An entry is a shell command, then
what it wrote and how kds ended:

    $ kds run data/kinetic/d1_n20_linear.txt --fly
    ! kds: unknown option '--fly'
    exit 2

'|' is a line of standard output, '!' a line of standard error, and 'exit' gives the exit code of each run of kds in the
command, or one number if all codes are equal. Code 0 is not shown. A command of several lines has '>' before its later
lines. The entries of a file run one after the other in an empty folder PLACE/NAME, in which `data` is the data folder.

If an entry that begins with `kds` or `for` is refused (only code 2), it must leave all files as they were. No command
pipes the output of kds to `head`, which may end before kds has written all.
"""
import difflib
import os
import re
import shutil
import subprocess
import sys
import tempfile

# Replaced in the output of all entries, because it differs between machines, builds and runs. Nothing else is changed.
NORMALISED = [
    (re.compile(r"\bkds \d+\.\d+\.\d+\S*"), "kds VERSION"),
    (re.compile(r"^engine .* s$", re.M), "engine TIME s"),
    (re.compile(r"^( *(?:seconds|first build|static build at every frame|kinetic / static)) .*$", re.M), r"\1 TIME"),
]

# Runs the program and notes its exit code in descriptor 9.
SHELL = """kds() {
  "$KDS_PROGRAM" "$@" 9>&-
  set -- $?
  echo $1 >&9
  return $1
}
"""


def entries_of(text):
    """Returns (comments before it, command, expected lines) of each entry, and the comments after the last one."""
    entries, comments = [], []
    for line in text.splitlines():
        if line.startswith("$ "):
            entries.append((comments, [line], []))
            comments = []
        elif line.startswith("> ") and entries and not entries[-1][2]:
            entries[-1][1].append(line)
        elif line.startswith("#") or not line:
            comments.append(line)
        elif entries and not comments:
            entries[-1][2].append(line)
        else:
            sys.exit(f"expected an entry that begins with '$ ' before this line: {line}")
    return entries, comments


def files_below(folder):
    """Returns kind, size and time of the last change of all files."""
    files = {}
    for where, folders, names in os.walk(folder):
        for name in folders + names:
            status = os.lstat(os.path.join(where, name))
            is_folder = os.path.isdir(os.path.join(where, name))
            files[os.path.relpath(os.path.join(where, name), folder)] = (
                status.st_mode, 0 if is_folder else status.st_size, 0 if is_folder else status.st_mtime_ns)
    return files


class Runner:
    def __init__(self, program, data, folder):
        self.folder = folder
        shutil.rmtree(folder, ignore_errors=True)
        os.makedirs(folder)
        os.symlink(os.path.abspath(data), os.path.join(folder, "data"))
        self.environment = dict(os.environ, KDS_PROGRAM=os.path.abspath(program), LC_ALL="C.UTF-8")

    def lines_of(self, mark, output):
        text = output.decode(errors="backslashreplace").replace(self.folder, "FOLDER")
        for pattern, replacement in NORMALISED:
            text = pattern.sub(replacement, text)
        lines = text.split("\n")
        if lines[-1]:
            lines[-1] += "\\"  # the last line does not end
        else:
            lines.pop()
        return [f"{mark} {line}".rstrip() for line in lines]

    def run(self, command):
        """Returns the lines that the command gives, and the files that it changed although kds refused its usage."""
        before = files_below(self.folder)
        shell = SHELL + "\n".join(line[2:] for line in command)
        with tempfile.TemporaryFile() as codes, open(os.devnull, "rb") as nothing:
            ran = subprocess.run(["/bin/sh", "-c", "exec 9>&\"$0\"; " + shell, str(codes.fileno())], cwd=self.folder,
                                 env=self.environment, pass_fds=[codes.fileno()], stdin=nothing,
                                 capture_output=True, check=False)
            codes.seek(0)
            found = codes.read().decode().split()
        lines = self.lines_of("|", ran.stdout) + self.lines_of("!", ran.stderr)
        if any(code != "0" for code in found):
            lines.append("exit " + " ".join(sorted(set(found)) if len(set(found)) == 1 else found))
        after = files_below(self.folder)
        refused = command[0].startswith(("$ kds ", "$ for ")) and found and all(code == "2" for code in found)
        return lines, sorted(name for name in before.keys() | after.keys()
                             if refused and before.get(name) != after.get(name))


def check(program, data, folder, path, write):
    """Returns the number of entries that differ."""
    with open(path, encoding="utf-8") as file:
        entries, comments_at_end = entries_of(file.read())
    runner = Runner(program, data, os.path.join(os.path.abspath(folder), os.path.splitext(os.path.basename(path))[0]))
    differ, text = 0, []
    for comments, command, expected in entries:
        found, changed = runner.run(command)
        if changed:
            found.append("changed " + " ".join(changed))
        text += comments + command + found
        if found == expected and not changed:
            continue
        differ += 1
        if not write or changed:
            print(f"{path}: this entry differs ('-' expected, '+' found):")
            print("\n".join("  " + line for line in command))
            print("\n".join("  " + line for line in list(difflib.unified_diff(expected, found, lineterm="", n=9))[3:]))
    if write:
        with open(path, "w", encoding="utf-8") as file:
            file.write("\n".join(text + comments_at_end) + "\n")
        differ = sum(line.startswith("changed ") for line in text)
    shutil.rmtree(runner.folder, ignore_errors=True)
    return differ, len(entries)


def main():
    program, data, folder, *paths = sys.argv[1:]
    write = os.environ.get("KDS_WRITE_GOLDEN") == "1"
    failed = 0
    for path in paths:
        differ, count = check(program, data, folder, path, write)
        failed += differ
        print(f"{path}: {count} entries, {differ} differ")
    if failed and not write:
        print("If this is how it should be: KDS_WRITE_GOLDEN=1 ctest --preset ci -R golden")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
