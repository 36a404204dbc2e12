#!/usr/bin/env python3
"""The shaders of a test as other compilers and optimizers make them: variants.py GLSLC OPT OUTPUT SOURCE=SPV...

OUTPUT/original holds the modules that the test embeds, OUTPUT/<variant> the same under the same names. GLSLC may be empty."""
import pathlib
import shutil
import subprocess
import sys


def optimized(opt, level, source, target):
    subprocess.run([opt, level, "--target-env=vulkan1.0", source, "-o", target], check=True)


def main():
    glslc, opt, output = sys.argv[1], sys.argv[2], pathlib.Path(sys.argv[3])
    shutil.rmtree(output, ignore_errors=True)
    levels = ["-O0", "-O", "-Os"] if glslc else []
    names = ["original", "glslang-opt", "glslang-small"] + [f"glslc{level}{opt}" for level in levels for opt in ("", "-opt")]
    for name in names:
        (output / name).mkdir(parents=True)
    for pair in sys.argv[4:]:
        source, module = map(pathlib.Path, pair.split("="))
        shutil.copy(module, output / "original" / module.name)
        optimized(opt, "-O", module, output / "glslang-opt" / module.name)
        optimized(opt, "-Os", module, output / "glslang-small" / module.name)
        if source.suffix == ".spvasm":
            continue
        for level in levels:
            compiled = output / f"glslc{level}" / module.name
            subprocess.run([glslc, "--target-env=vulkan1.0", level, source, "-o", compiled], check=True)
            optimized(opt, "-O", compiled, output / f"glslc{level}-opt" / module.name)


if __name__ == "__main__":
    main()
