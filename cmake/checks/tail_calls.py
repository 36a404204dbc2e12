#!/usr/bin/env python3
"""Checks in the built driver that the interpreter's handlers end in jumps, so that the accumulator stays in registers.

A handler that is left by `ret`, or that calls through a pointer, has turned the jump to the next op into a call.

usage: tail_calls.py LIBRARY TARGET...     TARGET: a SIMD target with tail calls, as in the namespace N_AVX2
       tail_calls.py --self-test
"""
import re
import subprocess
import sys

FUNCTION = re.compile(r"^[0-9a-f]+ <(.+)>:$")
HANDLER = re.compile(r"\blapilli::N_(\w+)::(Lane|Control|Fat)<.*>::handler\(")
INSTRUCTION = re.compile(r"^\s*[0-9a-f]+:\s+(?:notrack |bnd |repz )?(\w+)\s*([^<#]*)")
# The interpreter has some hundreds for each target; far fewer means that they were not found.
FEWEST_HANDLERS = 100


def check(disassembly, targets):
    """Returns the complaints about the targets' handlers, and how many handlers each has."""
    complaints, counts = [], dict.fromkeys(targets, 0)
    name, jumps = None, False

    def finish():
        if name is not None and not jumps:
            complaints.append(f"{name}: no jump through a pointer")

    for line in disassembly:
        started = FUNCTION.match(line)
        if started:
            finish()
            handler = HANDLER.search(started.group(1))
            name, jumps = None, False
            if handler and handler.group(1) in counts:
                name = started.group(1)
                counts[handler.group(1)] += 1
            continue
        instruction = INSTRUCTION.match(line) if name else None
        if not instruction:
            continue
        mnemonic, operands = instruction.group(1), instruction.group(2)
        if mnemonic.startswith("jmp") and operands.startswith("*"):
            jumps = True
        if mnemonic.startswith("ret"):
            complaints.append(f"{name}: returns")
        if mnemonic.startswith("call") and operands.startswith("*"):
            complaints.append(f"{name}: calls through a pointer")
    finish()
    return complaints, counts


SELF_TEST = """
0000000000001000 <lapilli::N_AVX3::Lane<lapilli::N_AVX3::op_fadd, float (float, float), 3>::handler(lapilli::Op const*)>:
    1000:\tvaddps (%rax),%zmm0,%zmm0
    1006:\tjmp    *(%rdi)
0000000000001010 <lapilli::N_AVX2::Fat<lapilli::N_AVX2::op_load, true>::handler(lapilli::Op const*, lapilli::Frame*)>:
    1010:\tcall   3000 <lapilli::N_AVX2::op_load::run(lapilli::Op const*, lapilli::Frame*)>
    1015:\tnotrack jmp *%rax
0000000000001020 <lapilli::N_AVX2::Lane<lapilli::N_AVX2::op_fmul, float (float, float), 1>::handler(lapilli::Op const*)>:
    1020:\tcall   *(%rdi)
    1022:\tret
0000000000001030 <lapilli::N_AVX2::Control<lapilli::N_AVX2::op_jump>::handler(lapilli::Op const*)>:
    1030:\tjmp    1000 <elsewhere>
0000000000001038 <lapilli::N_SCALAR::Control<lapilli::N_SCALAR::op_jump>::handler(lapilli::Op const*)>:
    1038:\tret
0000000000001040 <lapilli::N_AVX2::run_ops(lapilli::Op const*, lapilli::Frame*)>:
    1040:\tcall   *(%rdi)
    1042:\tret
"""


def self_test():
    complaints, counts = check(SELF_TEST.splitlines(), ["AVX2", "AVX3"])
    endings = [complaint.rsplit(": ", 1)[1] for complaint in complaints]
    expected = ["calls through a pointer", "returns", "no jump through a pointer", "no jump through a pointer"]
    assert endings == expected and "op_fmul" in complaints[0] and "op_jump" in complaints[3], complaints
    assert counts == {"AVX3": 1, "AVX2": 3}, counts


def main():
    if sys.argv[1] == "--self-test":
        self_test()
        return 0
    library, targets = sys.argv[1], sys.argv[2:]
    command = ["objdump", "-d", "-C", "--no-show-raw-insn", library]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as objdump:
        complaints, counts = check(objdump.stdout, targets)
    assert objdump.returncode == 0, f"objdump ended with {objdump.returncode}"
    for target, count in counts.items():
        if count < FEWEST_HANDLERS:
            complaints.insert(0, f"{count} handlers for {target}, which should have at least {FEWEST_HANDLERS}")
    for text in complaints[:20]:
        print(text)
    print(f"handlers: {counts}; {len(complaints)} complaints")
    return 1 if complaints or not targets else 0


if __name__ == "__main__":
    sys.exit(main())
