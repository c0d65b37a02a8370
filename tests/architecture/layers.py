"""Who may include what. The tables below are the architecture; the rest reads them."""

import os
import re

from sources import code_of, cpp_files, files, includes, line_of, text_of

# Layer of core -> the layers it may include beside itself. Error.h is open to all.
CORE_LAYERS = {
    "math": (),
    "scene": ("math",),
    "mesh": ("scene", "math"),
    "visibility": ("mesh", "scene", "math"),
    "formfactor": ("math",),
    "reference": ("visibility", "formfactor", "mesh", "scene", "math"),
    "transport": ("visibility", "formfactor", "mesh", "scene", "math"),
    "goal": ("transport", "visibility", "formfactor", "mesh", "scene", "math"),
    "view": ("transport", "visibility", "formfactor", "mesh", "scene", "math"),
}
# Solver composes all but the reference, which must stay independent of what it judges.
SOLVER_LAYERS = ("view", "goal", "transport", "formfactor", "visibility", "mesh", "scene", "math")

# What everything outside core may know of it ...
FACE_OF_CORE = (
    "core/Error.h",
    "core/Solver.h",
    "core/scene/",
    "core/math/Types.h",
    "core/math/Image.h",
)
# ... and what else is known to whom: header -> files or folders. A method that is no method of the
# solver, or a service that needs no solver, is reached where it stands.
EXCEPTIONS = {
    "core/mesh/DarkSides.h": ("apps/vantage/SceneSummary.cpp", "apps/benchmarks"),
    "core/mesh/ElementTree.h": ("apps/benchmarks",),
    "core/mesh/Facets.h": ("apps/vantage/SceneSummary.h", "apps/benchmarks"),
    "core/mesh/LongestEdge.h": ("filters/vtk/module/vtkPatchSubdivision.cxx",),
    "core/mesh/PatchMesh.h": ("filters/vtk/module/vtkPatchSubdivision.cxx",),
    "core/reference/DenseSolve.h": ("apps/vantage/FormFactorsCommand.cpp",),
    "core/reference/PathTracer.h": ("apps/vantage", "apps/benchmarks"),
    "core/reference/ReferenceImage.h": ("filters/io",),
    "core/view/ToneMapping.h": ("filters/vtk/module/vtkRadianceToneMapping.cxx", "apps/vantage"),
    "core/visibility/OccluderScene.h": ("apps/benchmarks",),
}

# Which folders a folder of filters/ or apps/ may include beside itself and core.
NEIGHBOURS = {
    "filters/io": (),
    "filters/vtk": ("io",),
    "apps": ("io", "vtk"),
}

# Library -> (its headers, the names it puts into code, the only folders that may name it).
LIBRARIES = {
    "VTK": (
        r"vtk\w*\.h$",
        r"\bvtk[A-Z]\w*",
        ("filters/vtk", "apps", "tests/vtk", "tests/apps", "tests/fuzz"),
    ),
    "Embree": (r"embree\d?/", r"\b(?:rtc[A-Z]|RTC)\w*", ("filters/core/visibility",)),
    "OpenMesh": (r"OpenMesh/", r"\bOpenMesh\b", ("filters/core/mesh",)),
    "Eigen": (r"Eigen/", r"\bEigen::", ("filters/core/reference", "tests")),
    "CLI11": (r"CLI/", r"\bCLI::", ("apps",)),
}


def is_below(path, folders):
    return any(path == folder or path.startswith(folder + "/") for folder in folders)


def core_include_error(path, target):
    """Why a file of core may not include the header `target`, or None."""
    parts = path.split("/")[2:]
    layer = parts[0] if len(parts) > 1 else None
    if not target.startswith("core/"):
        return "core includes headers of core by their full name (core/...), and of no other folder"
    if target == "core/Error.h":
        return None
    target_parts = target.split("/")[1:]
    if len(target_parts) == 1:
        solver = layer is None and target_parts[0] != "Error.h" and parts != ["Error.h"]
        return None if solver else f"{target} stands above this layer"
    if layer is None:
        allowed = () if parts == ["Error.h"] else SOLVER_LAYERS
    elif layer in CORE_LAYERS:
        allowed = (layer,) + CORE_LAYERS[layer]
    else:
        return f"core/{layer} is a layer that the table CORE_LAYERS does not know"
    if target_parts[0] in allowed:
        return None
    return f"{layer or parts[0]} may include only {', '.join(allowed) or 'nothing'}"


def outer_include_error(path, target):
    """Why a file of filters/io, filters/vtk or apps may not include `target`, or None."""
    if target.startswith("core/"):
        known = any(
            target == face or (face.endswith("/") and target.startswith(face))
            for face in FACE_OF_CORE
        )
        if known or is_below(path, EXCEPTIONS.get(target, ())):
            return None
        return "not part of the face of core (see FACE_OF_CORE and EXCEPTIONS)"
    for folder, neighbours in NEIGHBOURS.items():
        if is_below(path, (folder,)):
            own = folder.split("/")[-1]
            others = {name.split("/")[-1] for name in NEIGHBOURS} - {own, *neighbours}
            head = target.split("/")[0]
            if "/" in target and head in others:
                return f"{folder} may not include {head}/"
    return None


def arrows(root):
    """Inside core the arrows run one way; everything else knows core by its face."""
    for path in cpp_files(root, "filters") + cpp_files(root, "apps"):
        for line, angle, target in includes(text_of(root, path)):
            error = None
            if ".." in target.split("/"):
                error = "includes climb no folders"
            elif not angle and is_below(path, ("filters/core",)):
                error = core_include_error(path, target)
            elif not angle:
                error = outer_include_error(path, target)
            if error:
                yield f'{path}:{line}: #include "{target}": {error}'


def exceptions_are_used(root):
    """An exception that is not needed any more is struck from the table."""
    for target, places in EXCEPTIONS.items():
        for place in places:
            full = os.path.join(root, place)
            sources = cpp_files(root, place) if os.path.isdir(full) else [place]
            if not any(
                target == name
                for path in sources
                if os.path.isfile(os.path.join(root, path))
                for _, _, name in includes(text_of(root, path))
            ):
                yield f"{place} does not include {target}: strike it from EXCEPTIONS"


def libraries(root):
    """A library that one folder hides is named in that folder only."""
    for path in cpp_files(root):
        text = text_of(root, path)
        for name, (headers, words, homes) in LIBRARIES.items():
            if is_below(path, homes):
                continue
            for line, _, target in includes(text):
                if re.match(headers, target):
                    yield f"{path}:{line}: {name} may be named only in {', '.join(homes)}"
            code = code_of(text)
            for match in re.finditer(words, code):
                line = line_of(code, match.start())
                yield f"{path}:{line}: '{match.group(0)}': {name} may be named only in {', '.join(homes)}"


def linkage(root):
    """A layer's library links no library of a layer it may not include."""
    for layer, below in CORE_LAYERS.items():
        for path in files(root, f"filters/core/{layer}", ("CMakeLists.txt",)):
            for used in re.findall(r"\bvantage[-:]+(\w+)", text_of(root, path)):
                if used in CORE_LAYERS and used not in below + (layer,):
                    yield f"{path}: {layer} links vantage-{used}, which is not below it"
                elif used in ("core", "io", "vtk"):
                    yield f"{path}: {layer} links vantage-{used}, which stands above it"
