#!/usr/bin/env python3
"""Checks what may include what: the arrows of the design, where SIMD lives, and who may name Vulkan handles.

usage: layering.py SOURCE_ROOT VULKAN_CORE_H     checks the tree
       layering.py --self-test VULKAN_CORE_H     checks this checker on a tree with known mistakes
"""
import pathlib
import re
import sys
import tempfile

# Each folder of icd/ with those straight before it; an include may name these and, transitively, theirs.
ARROWS = {
    "base": [],
    "image": ["base"],
    "shader": ["image"],
    "geometry": ["shader"],
    "raster": ["geometry"],
    "object": ["shader"],
    "command": ["object"],
    "queue": ["command", "raster"],
    "wsi": ["queue"],
    "api": ["wsi", "queue"],
}
# These never see Vulkan handles: queue/ flattens the bound state for them.
WITHOUT_HANDLES = ["base", "image", "shader", "geometry", "raster"]
# The folders around the driver, which know it only through the loader.
OUTSIDE = ["samples", "conformance", "bench"]

INTRINSICS = re.compile(r"^(\w*mmintrin\.h|x86intrin\.h|arm_(neon|sve)\.h)$")
HIGHWAY = re.compile(r"^hwy/")
# Files compiled once per SIMD target, relative to icd/.
PER_TARGET = re.compile(
    r"^(base/.*|image/[^/]*-inl\.h|shader/interpreter/.*|shader/block_depth\.cpp|geometry/[^/]*_lanes\.cpp|"
    r"raster/(hierarchical_depth|lane_triangles|small_triangle|visibility)\.cpp)$")

INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*([<"])([^>"]+)[>"]', re.MULTILINE)
COMMENT_OR_STRING = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"', re.DOTALL)
HANDLE_DEFINITION = re.compile(r"^VK_DEFINE_(?:NON_DISPATCHABLE_)?HANDLE\((\w+)\)", re.MULTILINE)
SUFFIXES = {".cpp", ".h", ".def", ".inc"}


def reachable(folder):
    found = {folder}
    for before in ARROWS[folder]:
        found |= reachable(before)
    return found


def sources(folder):
    return sorted(path for path in folder.rglob("*") if path.suffix in SUFFIXES) if folder.is_dir() else []


def is_per_target(path, name):
    """Whether a file is compiled per SIMD target: those above, and an image/x.cpp or x_test.cpp that compiles x-inl.h."""
    if PER_TARGET.match(name):
        return True
    inline = path.with_name(re.sub(r"(_test)?\.cpp$", "-inl.h", path.name))
    return name.startswith("image/") and path.suffix == ".cpp" and inline.is_file()


def check_driver_file(path, icd, handle, complain):
    name = path.relative_to(icd).as_posix()
    folder = name.split("/")[0]
    if folder not in ARROWS:
        complain(path, 1, f"icd/{folder} is not a folder of the design")
        return
    text = path.read_text(encoding="utf-8")
    allowed = reachable(folder)
    for match in INCLUDE.finditer(text):
        line = text.count("\n", 0, match.start()) + 1
        included = match.group(2)
        first = included.split("/")[0]
        if first in ARROWS and first not in allowed:
            complain(path, line, f"{folder} includes {included}, but may only include {', '.join(sorted(allowed))}")
        if ".." in included.split("/") or first in OUTSIDE:
            complain(path, line, f"includes {included}: not a file of icd/ named from its root")
        if INTRINSICS.match(included) and folder != "base":
            complain(path, line, f"includes {included}: intrinsics live in base/ only")
        if HIGHWAY.match(included) and not is_per_target(path, name):
            complain(path, line, f"includes {included}: not a file that is compiled per SIMD target")
    if folder in WITHOUT_HANDLES:
        blank = COMMENT_OR_STRING.sub(lambda m: re.sub(r"[^\n]", " ", m.group()), text)
        for match in handle.finditer(blank):
            complain(path, blank.count("\n", 0, match.start()) + 1, f"names {match.group()}: no Vulkan handles here")


def check(root, vulkan_core):
    """Returns the complaints about the tree as 'file:line: text' and the number of files read."""
    complaints = []

    def complain(path, line, text):
        complaints.append(f"{path.relative_to(root)}:{line}: {text}")

    handles = HANDLE_DEFINITION.findall(vulkan_core.read_text(encoding="utf-8"))
    assert "VkDevice" in handles and "VkImage" in handles, f"no handles found in {vulkan_core}"
    handle = re.compile(r"\b(" + "|".join(handles) + r")\b")
    files = sources(root / "icd")
    for path in files:
        check_driver_file(path, root / "icd", handle, complain)
    for outside in OUTSIDE:
        for path in sources(root / outside):
            text = path.read_text(encoding="utf-8")
            for match in INCLUDE.finditer(text):
                if (root / "icd" / match.group(2)).is_file():
                    complain(path, text.count("\n", 0, match.start()) + 1,
                             f"includes {match.group(2)} of the driver, which {outside}/ knows only through the loader")
    return complaints, len(files)


def self_test(vulkan_core):
    # Each file with what has to be said about it; None: nothing.
    cases = {
        "icd/base/lanes-inl.h": ("#include <hwy/highway.h>\n#include <immintrin.h>\n", None),
        "icd/image/texel-inl.h": ('#include "base/lanes-inl.h"\n#include "hwy/highway.h"\n', None),
        "icd/image/texel.cpp": ('#include "hwy/foreach_target.h"\n#include "image/texel-inl.h"\n', None),
        "icd/image/copy.cpp": ('#include "hwy/highway.h"\n', "not a file that is compiled per SIMD target"),
        "icd/queue/draw.cpp": ('#include "raster/tile.h"\n#include "base/log.h"\nVkDevice device;\n', None),
        "icd/raster/handle_comment.cpp": ("// VkDevice is not seen here\nVkFormat format; /* VkImage */\n", None),
        "icd/base/up.h": ('#include "image/format.h"\n', "base includes image/format.h"),
        "icd/raster/side.cpp": ('\n#  include "object/buffer.h"\n', "raster includes object/buffer.h"),
        "icd/object/side.h": ('#include "geometry/bins.h"\n', "object includes geometry/bins.h"),
        "icd/queue/up.cpp": ('#include "api/entry.h"\n', "queue includes api/entry.h"),
        "icd/raster/simd.cpp": ("#include <emmintrin.h>\n", "intrinsics live in base/ only"),
        "icd/shader/reader.cpp": ("#include <hwy/highway.h>\n", "not a file that is compiled per SIMD target"),
        "icd/geometry/handle.h": ("int x;\nVkBuffer buffer;\n", "names VkBuffer"),
        "icd/extra/a.h": ("int x;\n", "is not a folder of the design"),
        "icd/api/dots.cpp": ('#include "../queue/device.h"\n', "not a file of icd/ named from its root"),
        "conformance/peek.cpp": ('#include "base/up.h"\n', "only through the loader"),
    }
    with tempfile.TemporaryDirectory() as directory:
        root = pathlib.Path(directory)
        for name, (text, _) in cases.items():
            (root / name).parent.mkdir(parents=True, exist_ok=True)
            (root / name).write_text(text, encoding="utf-8")
        complaints, _ = check(root, vulkan_core)
    wrong = []
    for name, (_, expected) in cases.items():
        about = [text for text in complaints if text.startswith(name + ":")]
        if expected is None and about:
            wrong.append(f"{name}: unexpected: {about}")
        if expected is not None and not (len(about) == 1 and expected in about[0]):
            wrong.append(f"{name}: expected '{expected}', got {about}")
    return wrong, len(cases)


def main():
    vulkan_core = pathlib.Path(sys.argv[2])
    if sys.argv[1] == "--self-test":
        complaints, count = self_test(vulkan_core)
    else:
        complaints, count = check(pathlib.Path(sys.argv[1]).resolve(), vulkan_core)
    for text in complaints:
        print(text)
    print(f"{count} files, {len(complaints)} complaints")
    return 1 if complaints or count == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
