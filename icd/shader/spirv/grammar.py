#!/usr/bin/python3
"""Writes the operand grammar of SPIR-V as a table of X-macros: grammar.py CORE_JSON GLSL_STD_450_JSON OUTPUT.

SPIRV_INST(opcode, name, signature) by opcode, and SPIRV_NAME(kind, value, name) by kind and value.
A signature has one letter for each operand, with ? (optional) or * (any number) behind it; see grammar.h.
"""
import json
import sys

LETTERS = {
    'IdResultType': 't', 'IdResult': 'r', 'IdRef': 'i', 'IdScope': 'i', 'IdMemorySemantics': 'i',
    'LiteralString': 's', 'LiteralContextDependentNumber': 'n', 'LiteralSpecConstantOpInteger': 'o',
    'ImageOperands': 'x', 'MemoryAccess': 'm', 'Decoration': 'e', 'ExecutionMode': 'e', 'LoopControl': 'e',
    'PairIdRefIdRef': 'p', 'PairLiteralIntegerIdRef': 'P', 'PairIdRefLiteralInteger': 'q',
}  # every other kind is one literal word
NAMED = ['Capability', 'BuiltIn', 'StorageClass', 'Dim', 'ExecutionMode', 'Decoration', 'ExecutionModel',
         'ImageOperands']


def signature(instruction):
    return ''.join(LETTERS.get(operand['kind'], 'l') + operand.get('quantifier', '')
                   for operand in instruction.get('operands', []))


def main():
    core_path, glsl_path, output_path = sys.argv[1:]
    with open(core_path, encoding='utf-8') as file:
        core = json.load(file)
    with open(glsl_path, encoding='utf-8') as file:
        glsl = json.load(file)
    lines = ['// Made by grammar.py from the SPIR-V grammar.']
    instructions = {}
    for instruction in core['instructions']:
        instructions.setdefault(instruction['opcode'], instruction)
    for opcode, instruction in sorted(instructions.items()):
        lines.append(f'SPIRV_INST({opcode}, "{instruction["opname"]}", "{signature(instruction)}")')
    names = {('ExtInst', i['opcode']): i['opname'] for i in reversed(glsl['instructions'])}
    for kind in core['operand_kinds']:
        if kind['kind'] in NAMED:
            for value in reversed(kind['enumerants']):
                names[(kind['kind'], int(str(value['value']), 0))] = value['enumerant']
    for (kind, value), name in sorted(names.items()):
        lines.append(f'SPIRV_NAME({kind}, {value}, "{name}")')
    with open(output_path, 'w', encoding='utf-8') as file:
        file.write('\n'.join(lines) + '\n')


main()
