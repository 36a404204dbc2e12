#!/usr/bin/env python3
"""Checks that the handlers of the interpreter jump to one another: a call would use up the stack.

usage: tail_calls.py LIBRARY      (the object code of the interpreter; needs objdump)
"""
import re
import shutil
import subprocess
import sys

if shutil.which("objdump") is None:
    print("objdump is not here; nothing checked")
    sys.exit(77)

text = subprocess.run(["objdump", "-d", "--no-show-raw-insn", sys.argv[1]], capture_output=True, text=True, check=True).stdout
handlers = {}  # name: (ends in an indirect jump, makes indirect calls)
name = None
for line in text.splitlines():
    start = re.match(r"^[0-9a-f]+ <(\S+)>:", line)
    if start:
        # The targets with vectors of 256 and 512 bits; the others return to a loop.
        is_handler = re.search(r"N_AVX[23]", start[1]) and re.search(r"7handlerE|7handlerI|from_(register|accumulator)", start[1])
        name = start[1] if is_handler else None
        if name:
            handlers[name] = [False, False]
        continue
    fields = line.split("\t")
    if name is None or len(fields) < 2:
        continue
    if re.match(r"(notrack )?jmp\s+\*", fields[1]):
        handlers[name][0] = True
    if re.match(r"call\s+\*", fields[1]):
        handlers[name][1] = True

bad = [name for name, (jumps, calls) in handlers.items() if calls or not jumps]
for name in bad:
    print(f"does not jump to the next op: {name}")
print(f"{len(handlers)} handlers, {len(bad)} do not jump")
sys.exit(1 if bad or len(handlers) < 200 else 0)
