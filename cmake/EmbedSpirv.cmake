# Script: writes the SPIR-V module INPUT as a C++ header OUTPUT. NAME, such as "solid_object.vert", becomes kSolidObjectVert.
file(READ "${INPUT}" hex HEX)
string(REGEX REPLACE "(..)(..)(..)(..)" "0x\\4\\3\\2\\1,\n" words "${hex}")

string(REGEX MATCHALL "[A-Za-z0-9]+" parts "${NAME}")
set(constant "k")
foreach(part IN LISTS parts)
  string(SUBSTRING "${part}" 0 1 first)
  string(SUBSTRING "${part}" 1 -1 rest)
  string(TOUPPER "${first}" first)
  string(APPEND constant "${first}${rest}")
endforeach()

file(WRITE "${OUTPUT}" "// Made from ${NAME} at build time.
#pragma once
#include <cstdint>

namespace shaders {
inline constexpr std::uint32_t ${constant}[] = {
${words}};
}  // namespace shaders
")
