"""The files of the project, and C++ text without what the compiler does not see."""

import os
import re

CPP = (".h", ".hpp", ".cpp", ".cxx")
SCRIPTS = (".py", ".sh", ".cmake")
BUILD_FOLDERS = re.compile(r"^(out|build.*|\.git|\.cache|__pycache__)$")

COMMENT_OR_LITERAL = re.compile(
    r'R"(?P<mark>[^()\\\s]{0,16})\(.*?\)(?P=mark)"'
    r'|"(?:\\.|[^"\\\n])*"'
    r"|(?<!\w)'(?:\\.|[^'\\\n])*'"
    r"|//[^\n]*"
    r"|/\*.*?\*/",
    re.DOTALL,
)
DIRECTIVE = re.compile(r"^[ \t]*#(?:[^\n\\]|\\\n|\\.)*", re.MULTILINE)
INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*([<"])([^>"]+)[>"]', re.MULTILINE)


def text_of(root, path):
    with open(os.path.join(root, path), encoding="utf-8") as file:
        return file.read()


def files(root, under="", endings=None):
    """Paths relative to root, sorted, of all files below `under` but those that were built.
    A name that is wholly an ending counts too ("CMakeLists.txt")."""
    found = []
    for folder, subfolders, names in os.walk(os.path.join(root, under)):
        subfolders[:] = sorted(f for f in subfolders if not BUILD_FOLDERS.match(f))
        for name in sorted(names):
            if endings is None or name.endswith(endings):
                found.append(os.path.relpath(os.path.join(folder, name), root))
    return found


def cpp_files(root, under=""):
    return files(root, under, CPP)


def shell_scripts(root):
    """Files that bash is to read: by their ending or by their first line."""
    found = []
    for path in files(root):
        if path.endswith(".sh"):
            found.append(path)
        elif "." not in os.path.basename(path):
            with open(os.path.join(root, path), "rb") as file:
                first = file.readline()
            if first.startswith(b"#!") and b"sh" in first:
                found.append(path)
    return found


def blank(match):
    """As many lines as before, nothing on them; a string literal stays a literal."""
    quote = '""' if match.group(0)[0] in 'R"' else " "
    return quote + "\n" * match.group(0).count("\n")


def code_of(text):
    """C++ text without comments and without what stands in literals; line numbers stay."""
    return COMMENT_OR_LITERAL.sub(blank, text)


def without_directives(code):
    return DIRECTIVE.sub(blank, code)


def includes(text):
    """(line, angle brackets?, name) of every #include."""
    without_comments = re.sub(r"/\*.*?\*/", blank, text, flags=re.DOTALL)
    return [
        (without_comments.count("\n", 0, match.start(2)) + 1, match.group(1) == "<", match.group(2))
        for match in INCLUDE.finditer(without_comments)
    ]


def line_of(text, position):
    return text.count("\n", 0, position) + 1
