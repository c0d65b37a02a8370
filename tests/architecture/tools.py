"""Checks that other programs make: the formatter, the shell, the built tests themselves."""

import os
import shutil
import subprocess

from sources import cpp_files, shell_scripts

# Another version breaks lines elsewhere; this one is Debian 12's.
CLANG_FORMAT = "clang-format-14"


def run(command, root):
    """(succeeded, lines that the command wrote)."""
    done = subprocess.run(
        command, cwd=root, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False
    )
    return done.returncode == 0, done.stdout.splitlines()


def missing(program):
    return f"{program} is not installed: apt-get install {program}"


def formatting(root):
    """C++ stands as clang-format puts it."""
    if not shutil.which(CLANG_FORMAT):
        yield missing(CLANG_FORMAT)
        return
    sources = cpp_files(root)
    if not sources:
        return
    fine, lines = run([CLANG_FORMAT, "--dry-run", "--Werror", *sources], root)
    if not fine:
        badly = sorted({line.split(":")[0] for line in lines if ": error: " in line})
        yield from (f"{path}: mend with {CLANG_FORMAT} -i {path}" for path in badly or lines)


def shell(root):
    """Scripts parse, and shellcheck finds nothing in them."""
    for path in shell_scripts(root):
        fine, lines = run(["bash", "-n", path], root)
        if not fine:
            yield from lines
    if not shutil.which("shellcheck"):
        yield missing("shellcheck")
    elif shell_scripts(root):
        fine, lines = run(
            ["shellcheck", "--shell=bash", "--external-sources", "--format=gcc", *shell_scripts(root)],
            root,
        )
        if not fine:
            yield from lines


def tests_of(executable, root):
    """Names that a GoogleTest executable lists; it indents them below their suite's."""
    fine, lines = run([executable, "--gtest_list_tests"], root)
    return [line for line in lines if line.startswith("  ")] if fine else []


def executables(root):
    """Every test executable built below `root`, a build folder, holds a test."""
    found = []
    for folder, _, names in os.walk(root):
        for name in names:
            path = os.path.join(folder, name)
            if name.startswith("test-") and os.path.isfile(path) and os.access(path, os.X_OK):
                found.append(path)
    if not found:
        yield f"{root}: no test executable was built"
    for path in sorted(found):
        if not tests_of(os.path.abspath(path), root):
            yield f"{os.path.relpath(path, root)}: lists no test"
