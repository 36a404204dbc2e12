#!/usr/bin/env python3
"""Which test runs which SPIR-V instruction: opcodes.py SOURCE BUILD GRAMMARS [-o TABLE].

What the driver's reader accepts is what its sources name; what the conformance tests run is what their compiled shaders
hold and what the module writers in this folder name. Fails if an accepted instruction has no test."""
import argparse
import json
import pathlib
import re
import struct
import sys

# Of the binary form, not of what a shader computes; the reader's own tests have them.
STRUCTURE = {"OpNop", "OpSourceContinued", "OpSourceExtension", "OpString", "OpLine", "OpNoLine", "OpModuleProcessed",
             "OpDecorationGroup", "OpGroupDecorate", "OpGroupMemberDecorate", "OpDecorateId", "OpExtension",
             "OpTypeForwardPointer", "OpExecutionModeId"}


def grammar(file):
    return {i["opcode"]: i["opname"] for i in json.loads(file.read_text())["instructions"]}


def names_in(text):
    text = re.sub(r"//[^\n]*", "", text)  # who only talks of an instruction neither accepts nor tests it
    return set(re.findall(r"\b(Op[A-Z]\w+)\b", text)) | {"Glsl" + n for n in re.findall(r"GLSLstd450(\w+)", text)}


def instructions_of(module, core, extended):
    words = struct.unpack(f"<{len(module) // 4}I", module)
    at = 5
    while at < len(words):
        count, opcode = words[at] >> 16, words[at] & 0xFFFF
        name = core.get(opcode, str(opcode))
        yield name
        if name == "OpExtInst":
            yield "Glsl" + extended.get(words[at + 4], str(words[at + 4]))
        at += max(count, 1)


def accepted_by(source):
    names = set()
    for file in (source / "icd/shader/spirv").glob("*.cpp"):
        if not file.name.endswith("_test.cpp"):
            names |= names_in(file.read_text())
    return names


def tests_of(source, build, core, extended):
    tests = {}
    for module in sorted((build / "conformance").glob("*_shaders/*.spv")):
        for name in set(instructions_of(module.read_bytes(), core, extended)):
            tests.setdefault(name, []).append(module.parent.name.removesuffix("_shaders") + ": " + module.stem)
    for file in sorted((source / "conformance/spirv").glob("*.cpp")):
        text = file.read_text()
        tables = {"Op" + n for n in re.findall(r"\{OP\((\w+)\)", text)} | {
            "Glsl" + n for n in re.findall(r"\{EXT\((\w+)\)", text)}
        for name in names_in(text) | tables:
            tests.setdefault(name, []).insert(0, "conformance_spirv_test: " + file.stem)
    return tests


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("source", type=pathlib.Path)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("grammars", type=pathlib.Path, help="the folder of spirv.core.grammar.json")
    parser.add_argument("-o", "--output", type=pathlib.Path)
    arguments = parser.parse_args()
    core = grammar(arguments.grammars / "spirv.core.grammar.json")
    extended = grammar(arguments.grammars / "extinst.glsl.std.450.grammar.json")
    known = set(core.values()) | {"Glsl" + name for name in extended.values()}

    accepted = sorted((accepted_by(arguments.source) & known) - STRUCTURE)
    tests = tests_of(arguments.source, arguments.build, core, extended)
    missing = [name for name in accepted if name not in tests]
    if arguments.output:
        arguments.output.write_text("".join(f"{n}: {', '.join(tests.get(n, ['NONE'])[:4])}\n" for n in accepted))
    print(f"{len(accepted)} instructions are accepted; without a test: {', '.join(missing) or 'none'}")
    return 1 if missing or not accepted else 0


if __name__ == "__main__":
    sys.exit(main())
