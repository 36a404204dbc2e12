#!/usr/bin/env python3
"""Makes the table of commands from the registry and from the entry points that exist.

usage: registry.py VK_XML OUTPUT_CPP SOURCE...

An entry point is a function defined as `VKAPI_ATTR type VKAPI_CALL vkName(` at the beginning of a line of a SOURCE; there is
no other list of what is implemented. What a command belongs to, and which level it has, is the registry's to say.
"""
import pathlib
import re
import sys
import xml.etree.ElementTree as ElementTree

ENTRY_POINT = re.compile(r"^VKAPI_ATTR\s+[\w*\s]+?\s*VKAPI_CALL\s+(vk\w+)\(", re.MULTILINE)
GLOBAL = {"vkCreateInstance", "vkEnumerateInstanceExtensionProperties", "vkEnumerateInstanceLayerProperties",
          "vkEnumerateInstanceVersion", "vkGetInstanceProcAddr"}
LEVEL_OF_HANDLE = {"VkInstance": "instance", "VkPhysicalDevice": "physical_device", "VkDevice": "device",
                   "VkQueue": "device", "VkCommandBuffer": "device"}


def for_vulkan(element):
    """Whether it is of Vulkan itself, not of another API described in the same file."""
    return "vulkan" in element.get("api", "vulkan").split(",")


def read_commands(registry):
    """Name -> type of the first parameter, aliases included."""
    first, aliases = {}, {}
    for command in registry.iterfind("commands/command"):
        if not for_vulkan(command):
            continue
        if command.get("alias"):
            aliases[command.get("name")] = command.get("alias")
        else:
            first[command.findtext("proto/name")] = command.findtext("param/type")
    first.update({name: first[target] for name, target in aliases.items() if target in first})
    return first


def read_requirements(registry):
    """Name -> (core version or None, extension or None). A command has one home; the first found is kept."""
    homes = {}
    for feature in registry.iterfind("feature"):
        if for_vulkan(feature):
            for command in feature.iterfind("require/command"):
                homes.setdefault(command.get("name"), (feature.get("number"), None))
    for extension in registry.iterfind("extensions/extension"):
        if "vulkan" in extension.get("supported", "").split(","):
            for command in extension.iterfind("require/command"):
                homes.setdefault(command.get("name"), (None, extension.get("name")))
    return homes


def entry_points(paths):
    names = []
    for path in paths:
        names += ENTRY_POINT.findall(pathlib.Path(path).read_text(encoding="utf-8"))
    twice = {name for name in names if names.count(name) > 1}
    if twice:
        sys.exit(f"defined twice: {', '.join(sorted(twice))}")
    return sorted(names)


def level(name, first_parameter):
    if name in GLOBAL:
        return "global"
    return LEVEL_OF_HANDLE.get(first_parameter, "device")


def main():
    vk_xml, output, *sources = sys.argv[1:]
    registry = ElementTree.parse(vk_xml).getroot()
    first_parameters, homes = read_commands(registry), read_requirements(registry)
    names = entry_points(sources)
    unknown = [name for name in names if name not in first_parameters or name not in homes]
    if unknown or not names:
        sys.exit(f"not commands of the registry: {', '.join(unknown)}")
    declarations, rows = [], []
    for name in names:
        version, extension = homes[name]
        needs = f'"{extension}"' if extension else "nullptr"
        minor = version.split(".")[1] if version else "0"
        declarations.append(f"extern std::remove_pointer_t<PFN_{name}> {name};")
        rows.append(f'    {{"{name}", reinterpret_cast<PFN_vkVoidFunction>(guarded<&entry::{name}>), '
                    f"CommandLevel::{level(name, first_parameters[name])}, {minor}, {needs}}},")
    text = "\n".join([
        "// Made from vk.xml by registry.py at build time.",
        '#include "api/command_table.h"',
        '#include "api/guard.h"',
        "",
        "namespace lapilli {",
        "namespace entry {",
        *declarations,
        "}  // namespace entry",
        "",
        "namespace {",
        "// By name.",
        "const CommandEntry kTable[] = {",
        *rows,
        "};",
        "}  // namespace",
        "",
        "std::span<const CommandEntry> command_table() { return kTable; }",
        "",
        "}  // namespace lapilli",
        ""])
    pathlib.Path(output).write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
