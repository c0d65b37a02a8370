"""No file and no function grows beyond what is read in one go."""

import ast
import re

from sources import CPP, SCRIPTS, code_of, cpp_files, files, line_of, text_of, without_directives

FILE_LINES = 800
FUNCTION_LINES = 60

TYPE = re.compile(r"^(?:template\s*<.*>\s*)?(?:typedef\s+)?(?:class|struct|union|enum)\b", re.DOTALL)
SCOPE = re.compile(r"^(?:inline\s+)?(?:namespace\b|extern\s*\"\")")
ACCESS = re.compile(r"^(?:(?:public|protected|private)(?:\s+\w+)?\s*:\s*)+")


def kind_of(head, starts_line):
    """What the brace after `head` opens: "scope" (namespace or type), "function" or "other".
    The layout tells: the brace of a definition stands first on its line, that of an initializer
    does not."""
    head = ACCESS.sub("", head.strip())
    if SCOPE.match(head) or (TYPE.match(head) and "(" not in head.split("{")[0].split(":")[0]):
        return "scope"
    if starts_line and "(" in head:
        return "function"
    return "other"


def functions(text):
    """(name, first line, lines from brace to brace) of the functions of a C++ file. Lambdas
    count to the function they stand in."""
    code = without_directives(code_of(text))
    found = []
    scopes = []
    head_start = 0
    for match in re.finditer(r"[{};]", code):
        position, mark = match.start(), match.group(0)
        inside_statements = any(kind != "scope" for kind, _, _ in scopes)
        if mark == "{":
            head = code[head_start:position]
            line_start = code.rfind("\n", 0, position) + 1
            starts_line = not code[line_start:position].strip()
            kind = "other" if inside_statements else kind_of(head, starts_line)
            scopes.append((kind, position, head))
        elif mark == "}" and scopes:
            kind, start, head = scopes.pop()
            if kind == "function":
                first, last = line_of(code, start), line_of(code, position)
                found.append((name_of(head), first, last - first + 1))
            if kind == "other" and not any(k != "scope" for k, _, _ in scopes):
                continue  # the initializer of a member: the head of its constructor goes on
        if not any(kind != "scope" for kind, _, _ in scopes):
            head_start = position + 1
    return found


def name_of(head):
    match = re.search(r"([\w:~]+|operator\s*\S+)\s*\(", ACCESS.sub("", head.strip()))
    return match.group(1) if match else "function"


def file_sizes(root):
    for path in files(root, endings=CPP + SCRIPTS + ("CMakeLists.txt",)):
        lines = text_of(root, path).count("\n")
        if lines > FILE_LINES:
            yield f"{path}: {lines} lines, more than {FILE_LINES}; give its second idea a file"


def function_sizes(root):
    for path in cpp_files(root):
        for name, line, lines in functions(text_of(root, path)):
            if lines > FUNCTION_LINES:
                yield f"{path}:{line}: {name} has {lines} lines, more than {FUNCTION_LINES}"
    for path in files(root, endings=(".py",)):
        for node in ast.walk(ast.parse(text_of(root, path))):
            if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef)):
                lines = node.end_lineno - node.lineno + 1
                if lines > FUNCTION_LINES:
                    yield f"{path}:{node.lineno}: {node.name} has {lines} lines, more than {FUNCTION_LINES}"
