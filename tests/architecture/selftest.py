#!/usr/bin/env python3
"""Shows of each check that it passes a sound tree and fails on one that breaks its rule."""

import os
import sys
import tempfile
import unittest
from unittest import mock

sys.dont_write_bytecode = True
import check  # noqa: E402
import layers  # noqa: E402
import sizes  # noqa: E402
import sources  # noqa: E402

HEADER = "#pragma once\n\n/// \\file {0}\n/// A header.\n"
BODY = "int {0}()\n{{\n{1}}}\n"

PROJECT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")

SOUND = {
    ".clang-format": sources.text_of(PROJECT, ".clang-format"),
    "CMakeLists.txt": "add_subdirectory(filters)\n",
    "filters/CMakeLists.txt": "add_library(all core/math/A.cpp core/view/B.cpp io/C.cpp)\n",
    "filters/core/Error.h": HEADER.format("Error.h"),
    "filters/core/Solver.h": HEADER.format("Solver.h") + '#include "core/view/B.h"\n',
    "filters/core/math/A.h": HEADER.format("A.h") + "// vtkObject and rtcCommit in words\n",
    "filters/core/math/A.cpp": '#include "core/math/A.h"\n\n' + BODY.format("A", "  return 1;\n"),
    "filters/core/math/CMakeLists.txt": "vantage_layer(math USES glm::glm)\n",
    "filters/core/view/B.h": HEADER.format("B.h") + '#include "core/visibility/V.h"\n',
    "filters/core/view/B.cpp": '#include "core/view/B.h"\n#include <vector>\n',
    "filters/core/view/CMakeLists.txt": "vantage_layer(view USES vantage-visibility)\n",
    "filters/core/visibility/V.h": HEADER.format("V.h") + "#include <embree3/rtcore.h>\n",
    "filters/io/C.cpp": '#include "core/math/Image.h"\n#include "core/scene/Scene.h"\n',
    "apps/CMakeLists.txt": "add_executable(vantage main.cpp)\n",
    "apps/main.cpp": '#include "io/C.h"\n#include <vtkNew.h>\n',
    "tests/run.sh": '#!/bin/bash\necho "fine"\n',
    "out/build/huge.cpp": "int x;\n" * 900,
}

LONG = "".join(f"  Step({i});\n" for i in range(59))

# Check -> trees that break it: files added to, or put in place of, those of the sound tree. Each
# must be reported under the name of a file that it adds.
BROKEN = {
    "arrows": [
        {"filters/core/math/Up.h": '#include "core/scene/Scene.h"\n'},
        {"filters/core/formfactor/Up.h": '#include "core/mesh/ElementTree.h"\n'},
        {"filters/core/reference/Up.cpp": '#include "core/transport/Method.h"\n'},
        {"filters/core/reference/Up.cpp": '#include "core/view/B.h"\n'},
        {"filters/core/transport/Up.cpp": '#include "core/view/B.h"\n'},
        {"filters/core/transport/Up.cpp": '#include "core/view/ToneMapping.h"\n'},
        {"filters/core/view/Up.cpp": '#include "core/Solver.h"\n'},
        {"filters/core/Solver.cpp": '#include "core/reference/PathTracer.h"\n'},
        {"filters/core/Error.h": '#include "core/math/A.h"\n'},
        {"filters/core/math/Out.cpp": '#include "io/C.h"\n'},
        {"filters/core/math/Out.cpp": '#include "vtk/Adapter.h"\n'},
        {"filters/core/math/Out.cpp": '#include "../scene/Scene.h"\n'},
        {"filters/core/newlayer/Out.cpp": '#include "core/math/A.h"\n'},
        {"filters/io/Deep.cpp": '#include "core/mesh/ElementTree.h"\n'},
        {"filters/io/Deep.cpp": '#include "vtk/Adapter.h"\n'},
        {"filters/vtk/Deep.cxx": '#include "core/transport/Transport.h"\n'},
        {"apps/vantage/Deep.cpp": '  #  include "core/visibility/V.h" // why not\n'},
    ],
    "exceptions-are-used": [
        {"filters/vtk/Excepted.cxx": "// needs nothing of it\n"},
    ],
    "libraries": [
        {"filters/core/math/V.cpp": "#include <vtkNew.h>\n"},
        {"filters/core/math/V.cpp": "class vtkObject;\n"},
        {"filters/io/V.cpp": '#include "vtkPolyData.h"\n'},
        {"filters/core/view/E.cpp": "#include <embree3/rtcore.h>\n"},
        {"filters/core/view/E.cpp": "void F(RTCScene s) { rtcCommitScene(s); }\n"},
        {"filters/core/scene/O.cpp": "#include <OpenMesh/Core/Mesh/Handles.hh>\n"},
        {"filters/core/transport/D.cpp": "#include <Eigen/Dense>\n"},
        {"filters/io/L.cpp": "#include <CLI/CLI.hpp>\n"},
        {"tests/core/V.cpp": "#include <vtkNew.h>\n"},
    ],
    "linkage": [
        {"filters/core/transport/CMakeLists.txt": "vantage_layer(transport USES vantage-view)\n"},
        {"filters/core/math/CMakeLists.txt": "vantage_layer(math USES vantage::io)\n"},
    ],
    "file-sizes": [
        {"filters/core/math/Long.cpp": "int x;\n" * 801},
        {"tests/long.py": "x = 1\n" * 801},
    ],
    "function-sizes": [
        {"filters/core/math/Long.cpp": BODY.format("Long", LONG)},
        {"filters/core/math/Long.h": "namespace a\n{\nclass B : public C\n{\npublic:\n"
            + BODY.format("Long", LONG) + "};\n}\n"},
        {"filters/vtk/Long.cxx": "A::A(int b)\n  : B{ b }\n  , C(b)\n{\n" + LONG + "}\n"},
        {"tests/Long.cpp": "TEST(A, '\"') // \"{\n{\n" + LONG + "}\n"},
        {"tests/long.py": "def long():\n" + "    x = 1\n" * 60},
    ],
    "unwanted-words": [
        {"tests/Bad.cpp": "TEST(A, DISABLED" + "_B)\n{\n}\n"},
        {"tests/Bad.cpp": "  GTEST" + "_SKIP();\n"},
        {"filters/io/Bad.cpp": "#if" + " 0\nint x;\n#endif\n"},
        {"filters/io/Bad.cpp": "// TO" + "DO: later\n"},
        {"filters/CMakeLists.txt": "add_compile_options(-ffast" + "-math)\n"},
    ],
    "absolute-paths": [
        {"tests/Bad.cpp": 'Read("/home' + '/someone/scene.obj");\n'},
        {"apps/bad.sh": "cd /tmp" + "/build\n"},
        {"README.md": "run C:" + "\\vantage\n"},
    ],
    "file-comments": [
        {"filters/core/view/Bare.h": "#pragma once\n"},
        {"filters/core/view/Copied.h": HEADER.format("Other.h")},
    ],
    "include-guards": [
        {"filters/io/Bare.h": "int x;\n"},
    ],
    "built-sources": [
        {"filters/io/Forgotten.cpp": "int x;\n"},
        {"tests/core/math/ForgottenTest.cpp": "int x;\n"},
    ],
    "top-level": [
        {"notes.txt": "\n"},
        {"docs/page.md": "\n"},
    ],
    "formatting": [
        {"filters/io/Untidy.cpp": "int F( ){return 1;}\n"},
    ],
    "shell": [
        {"tests/bad.sh": "#!/bin/bash\nif true; then\n"},
        {".ci/run": "#!/bin/bash\ncd $1\n"},
    ],
    "executables": [
        {"build/test-dead": "#!/bin/sh\nexit 1\n"},
        {"build/test-empty": "#!/bin/sh\necho Suite.\n"},
        {"build/vantage": "#!/bin/sh\n"},
    ],
}

# What a check needs to find in the sound tree to have something to pass.
SOUND_BUILD = {"test-some": "#!/bin/sh\necho Suite.\necho '  Case'\n"}


def plant(root, tree):
    for path, text in tree.items():
        full = os.path.join(root, path)
        os.makedirs(os.path.dirname(full), exist_ok=True)
        with open(full, "w", encoding="utf-8") as file:
            file.write(text)
        os.chmod(full, 0o755)


def violations_of(name, tree):
    every = {**check.CHECKS, **check.BUILD_CHECKS}
    with tempfile.TemporaryDirectory() as root:
        plant(root, tree)
        return [line.replace(root, "") for line in every[name](root)]


class Checks(unittest.TestCase):
    def setUp(self):
        excepted = {"core/mesh/ElementTree.h": ("filters/vtk/Excepted.cxx",)}
        patch = mock.patch.object(layers, "EXCEPTIONS", excepted)
        self.addCleanup(patch.stop)
        patch.start()

    def test_every_check_has_a_broken_tree(self):
        self.assertEqual(set(BROKEN), {*check.CHECKS, *check.BUILD_CHECKS})

    def test_sound_tree_passes(self):
        excepted = {"filters/vtk/Excepted.cxx": '#include "core/mesh/ElementTree.h"\n'}
        built = {"filters/vtk/CMakeLists.txt": "vtk_module_add_module(V CLASSES Excepted)\n"}
        for name in check.CHECKS:
            with self.subTest(check=name):
                self.assertEqual(violations_of(name, {**SOUND, **excepted, **built}), [])
        for name in check.BUILD_CHECKS:
            with self.subTest(check=name):
                self.assertEqual(violations_of(name, SOUND_BUILD), [])

    def test_broken_trees_fail(self):
        for name, trees in BROKEN.items():
            for tree in trees:
                with self.subTest(check=name, tree=tree):
                    base = {} if name in check.BUILD_CHECKS else SOUND
                    found = violations_of(name, {**base, **tree})
                    self.assertTrue(found, "the check passes what it must not")
                    if name not in check.BUILD_CHECKS:
                        culprits = {part for path in tree for part in (path, path.split("/")[0])}
                        self.assertTrue(any(c in line for c in culprits for line in found), found)


class FunctionParser(unittest.TestCase):
    def names(self, text):
        return [(name, lines) for name, _, lines in sizes.functions(text)]

    def test_constructor_with_braced_members(self):
        text = "A::A(int b)\n  : B{ b }\n  , C(b)\n{\n  D();\n}\n"
        self.assertEqual(self.names(text), [("A::A", 3)])

    def test_lambda_counts_to_its_function(self):
        text = "void F()\n{\n  Run([&](int i)\n  {\n    G(i);\n  });\n}\n"
        self.assertEqual(self.names(text), [("F", 6)])

    def test_table_is_no_function(self):
        text = "const std::array<int, f(2)> T = {\n  1,\n  2,\n};\nstruct S\n{\n  int a{ 0 };\n};\n"
        self.assertEqual(self.names(text), [])

    def test_method_in_class_and_braces_in_literals(self):
        text = "namespace n\n{\nclass A\n{\npublic:\n  char F()\n  {\n    return '{'; // {\n  }\n};\n}\n"
        self.assertEqual(self.names(text), [("F", 3)])

    def test_function_after_macro_and_template(self):
        text = "#define X(a) \\\n  {\ntemplate <class T>\nT F(T t)\n{\n  return t;\n}\n"
        self.assertEqual(self.names(text), [("F", 3)])


if __name__ == "__main__":
    unittest.main()
