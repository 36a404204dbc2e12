#!/usr/bin/env python3
"""Checks the built driver as a file that is loaded into other people's processes: what it needs, shows and weighs.

usage: shared_library.py LIBRARY [--max-bytes N]     N: limit of the stripped size
"""
import argparse
import os
import re
import subprocess
import sys
import tempfile

ALLOWED_NEEDED = re.compile(r"^(libc\.so\.6|libm\.so\.6|libstdc\+\+\.so\.6|libgcc_s\.so\.1|ld-linux-[\w-]+\.so\.\d+)$")
# What the loader looks up by name (loader interface, version 5 and later).
REQUIRED_SYMBOLS = {
    "vk_icdNegotiateLoaderICDInterfaceVersion",
    "vk_icdGetInstanceProcAddr",
    "vk_icdGetPhysicalDeviceProcAddr",
}


def output_of(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True, env={**os.environ, "LC_ALL": "C"}).stdout


def stripped_bytes(library):
    with tempfile.NamedTemporaryFile() as stripped:
        subprocess.run(["strip", "-o", stripped.name, library], check=True)
        return os.path.getsize(stripped.name)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("library")
    parser.add_argument("--max-bytes", type=int)
    options = parser.parse_args()
    complaints = []

    dynamic = output_of("readelf", "-dW", options.library)
    needed = re.findall(r"\(NEEDED\).*\[(.*)\]", dynamic)
    if "libc.so.6" not in needed:
        complaints.append(f"readelf named no libc: {needed}")
    complaints += [f"needs {name}" for name in needed if not ALLOWED_NEEDED.match(name)]
    # What those need in turn is on ldd's list, too.
    for line in output_of("ldd", options.library).splitlines():
        name = os.path.basename(line.split()[0])
        if name != "linux-vdso.so.1" and not ALLOWED_NEEDED.match(name):
            complaints.append(f"ldd lists {line.strip()}")
    if "TEXTREL" in dynamic:
        complaints.append("has text relocations, which need writable code")
    for line in output_of("readelf", "-lW", options.library).splitlines():
        flags = line.split()[6:-1]
        if line.lstrip().startswith(("GNU_STACK", "LOAD")) and "W" in "".join(flags) and "E" in "".join(flags):
            complaints.append(f"has a segment that is writable and executable: {line.strip()}")

    symbols = {line.split()[-1] for line in output_of("nm", "-D", "--defined-only", options.library).splitlines()}
    complaints += [f"exports {name}" for name in sorted(symbols) if not name.startswith("vk_icd")]
    complaints += [f"does not export {name}" for name in sorted(REQUIRED_SYMBOLS - symbols)]

    size = stripped_bytes(options.library)
    if options.max_bytes is not None and size >= options.max_bytes:
        complaints.append(f"weighs {size} bytes stripped; the limit is {options.max_bytes}")

    for text in complaints:
        print(f"{options.library} {text}")
    print(f"needs {', '.join(needed)}; exports {len(symbols)} symbols; {size} bytes stripped")
    return 1 if complaints else 0


if __name__ == "__main__":
    sys.exit(main())
