#!/usr/bin/env python3
"""Holds the project to its architecture.

    check.py [--root FOLDER] [CHECK...]     all checks when none is named
    check.py --list

A check is a generator over a folder that yields one line for each violation.
"""

import argparse
import os
import sys

sys.dont_write_bytecode = True  # the source tree stays as it is
import conventions
import layers
import sizes
import tools

CHECKS = {
    "arrows": layers.arrows,
    "exceptions-are-used": layers.exceptions_are_used,
    "libraries": layers.libraries,
    "linkage": layers.linkage,
    "file-sizes": sizes.file_sizes,
    "function-sizes": sizes.function_sizes,
    "unwanted-words": conventions.unwanted_words,
    "absolute-paths": conventions.absolute_paths,
    "file-comments": conventions.file_comments,
    "include-guards": conventions.include_guards,
    "built-sources": conventions.built_sources,
    "top-level": conventions.top_level,
    "formatting": tools.formatting,
    "shell": tools.shell,
}
# These look at a build folder instead of the sources.
BUILD_CHECKS = {"executables": tools.executables}


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    sources = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
    parser.add_argument("--root", default=os.path.normpath(sources), help="folder to check")
    parser.add_argument("--list", action="store_true", help="print the names of the checks")
    parser.add_argument("checks", nargs="*", metavar="CHECK", default=list(CHECKS))
    arguments = parser.parse_args()
    if arguments.list:
        print("\n".join([*CHECKS, *BUILD_CHECKS]))
        return 0
    every = {**CHECKS, **BUILD_CHECKS}
    unknown = [name for name in arguments.checks if name not in every]
    if unknown:
        parser.error(f"no such check: {', '.join(unknown)}; see --list")
    violations = 0
    for name in arguments.checks:
        for violation in every[name](arguments.root):
            violations += 1
            print(f"[{name}] {violation}")
    return 1 if violations else 0


if __name__ == "__main__":
    sys.exit(main())
