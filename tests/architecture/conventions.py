"""What a file must say and must not say, and where it may stand."""

import os
import re

from sources import BUILD_FOLDERS, CPP, SCRIPTS, cpp_files, files, line_of, text_of

TOP_LEVEL = {"CMakeLists.txt", "README.md", "filters", "apps", "tests", "data"}
CODE = CPP + SCRIPTS + ("CMakeLists.txt", "vtk.module", ".ci/run")

# Pattern -> why it is not wanted. Written so that no pattern matches itself.
UNWANTED = {
    r"\bDISABLE[D]_": "a test that does not run tests nothing",
    r"\bGTEST_SKI[P]\b": "a test that does not run tests nothing",
    r"^\s*#\s*if\s+[0]\b": "dead code; the history remembers it",
    r"\b(?:TO[D]O|FIX[M]E|XX[X])\b": "finish it, or say what is missing where its users read it",
    r"(?<!No )-ffast-mat[h]\b|-Ofas[t]\b": "results must not depend on liberties of the compiler",
}
ABSOLUTE_PATH = re.compile(
    r"(?<![\w.:~$})/-])/(?:home|root|Users|work|tmp|mnt|media|srv|opt)/\w|\b[A-Z]:\\\w"
)


def unwanted_words(root):
    for path in files(root, endings=CODE):
        text = text_of(root, path)
        for pattern, reason in UNWANTED.items():
            for match in re.finditer(pattern, text, re.MULTILINE):
                yield f"{path}:{line_of(text, match.start())}: '{match.group(0).strip()}': {reason}"


def absolute_paths(root):
    """No file knows the machine it was written on."""
    for path in files(root, endings=CODE + (".md", ".json", ".xml", ".obj", ".mtl", ".clang-tidy")):
        text = text_of(root, path)
        for match in ABSOLUTE_PATH.finditer(text):
            yield f"{path}:{line_of(text, match.start())}: a path of one machine: {match.group(0)}..."


def file_comments(root):
    """A header of core opens with what it is for."""
    for path in files(root, "filters/core", (".h",)):
        name = os.path.basename(path)
        if not re.search(rf"/// \\file {re.escape(name)}\n/// \S", text_of(root, path)):
            yield f"{path}: wants '/// \\file {name}' and a line below it that says what it is for"


def include_guards(root):
    """A header can be included twice."""
    for path in cpp_files(root):
        text = text_of(root, path)
        guarded = text.startswith("#pragma once\n") or re.search(
            r"^#ifndef (\w+)\n#define \1\n", text, re.MULTILINE
        )
        if path.endswith((".h", ".hpp")) and not guarded:
            yield f"{path}: wants #pragma once as its first line (VTK's classes: an include guard)"


def built_sources(root):
    """Each C++ source is named in a CMakeLists.txt beside or above it, or it is never compiled."""
    lists = {}
    for path in files(root, endings=("CMakeLists.txt",)):
        lists[os.path.dirname(path)] = set(re.findall(r"[\w./-]+", text_of(root, path)))
    for path in files(root, endings=(".cpp", ".cxx")):
        folder = os.path.dirname(path)
        while True:
            name = os.path.relpath(path, folder or ".")
            if {name, os.path.splitext(name)[0]} & lists.get(folder, set()):
                break
            if not folder:
                yield f"{path}: named in no CMakeLists.txt"
                break
            folder = os.path.dirname(folder)


def top_level(root):
    """The top holds what a newcomer looks for, and nothing else."""
    for name in sorted(os.listdir(root)):
        if name not in TOP_LEVEL and not name.startswith(".") and not BUILD_FOLDERS.match(name):
            yield f"{name}: stands at the top, where only {', '.join(sorted(TOP_LEVEL))} may"
