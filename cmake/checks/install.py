#!/usr/bin/env python3
"""Installs the build under a new prefix and lets the stock loader find the driver there by itself.

usage: install.py CMAKE BUILD_DIR VULKANINFO
"""
import json
import os
import pathlib
import subprocess
import sys
import tempfile


def main():
    cmake, build, vulkaninfo = sys.argv[1:4]
    with tempfile.TemporaryDirectory() as directory:
        prefix = pathlib.Path(directory) / "prefix"
        subprocess.run([cmake, "--install", build, "--prefix", str(prefix)], check=True)
        manifests = list(prefix.glob("share/vulkan/icd.d/*.json"))
        assert len(manifests) == 1, f"manifests: {manifests}"
        named = json.loads(manifests[0].read_text(encoding="utf-8"))["ICD"]["library_path"]
        library = manifests[0].parent / named
        assert not os.path.isabs(named) and library.is_file(), f"{manifests[0]} names {named}"

        # XDG_DATA_DIRS is where the loader searches for share/vulkan/icd.d; the variables that name drivers would win.
        environment = {k: v for k, v in os.environ.items() if not k.startswith("VK_")}
        environment |= {"XDG_DATA_DIRS": str(prefix / "share"), "XDG_RUNTIME_DIR": directory, "HOME": directory}
        run = subprocess.run([vulkaninfo, "--summary"], env=environment, capture_output=True, text=True)
        print(run.stdout, run.stderr)
        assert run.returncode == 0, f"vulkaninfo ended with {run.returncode}"
        names = [line for line in run.stdout.splitlines() if "deviceName" in line]
        assert any("lapilli" in name.lower() for name in names), f"devices: {names}"
    return 0


if __name__ == "__main__":
    sys.exit(main())
