# lapilli_shader: compiles GLSL and SPIR-V assembly at build time into headers.

set(LAPILLI_CMAKE_DIR "${CMAKE_CURRENT_LIST_DIR}")

# lapilli_shader(<target> [NO_VALIDATE] file…)
# file.vert, .frag, .comp … (GLSL) and file.<stage>.spvasm (assembly), relative to the calling folder. The target can then
# `#include "shaders/file.vert.h"`, which holds `inline constexpr std::uint32_t shaders::kFileVert[]`.
# NO_VALIDATE keeps modules that spirv-val refuses (tests of bad input).
function(lapilli_shader target)
  cmake_parse_arguments(PARSE_ARGV 1 arg "NO_VALIDATE" "" "")
  set(include_dir "${CMAKE_CURRENT_BINARY_DIR}/${target}_shaders")
  set(headers)
  foreach(source IN LISTS arg_UNPARSED_ARGUMENTS)
    cmake_path(ABSOLUTE_PATH source BASE_DIRECTORY "${CMAKE_CURRENT_SOURCE_DIR}" NORMALIZE)
    cmake_path(GET source FILENAME name)
    if(name MATCHES "\\.spvasm$")
      string(REGEX REPLACE "\\.spvasm$" "" name "${name}")
      set(compile ${LAPILLI_SPIRV_AS} --target-env spv1.0 -o "${include_dir}/${name}.spv" "${source}")
    else()
      set(compile ${LAPILLI_GLSLANG} --quiet -V --target-env vulkan1.0 -o "${include_dir}/${name}.spv" "${source}")
    endif()
    set(validate)
    if(NOT arg_NO_VALIDATE)
      set(validate COMMAND ${LAPILLI_SPIRV_VAL} --target-env vulkan1.0 "${include_dir}/${name}.spv")
    endif()
    set(header "${include_dir}/shaders/${name}.h")
    add_custom_command(
      OUTPUT "${header}"
      BYPRODUCTS "${include_dir}/${name}.spv"
      COMMAND ${CMAKE_COMMAND} -E make_directory "${include_dir}/shaders"
      COMMAND ${compile}
      ${validate}
      COMMAND ${CMAKE_COMMAND} -DINPUT=${include_dir}/${name}.spv -DOUTPUT=${header} -DNAME=${name}
              -P "${LAPILLI_CMAKE_DIR}/EmbedSpirv.cmake"
      DEPENDS "${source}" "${LAPILLI_CMAKE_DIR}/EmbedSpirv.cmake"
      COMMENT "Shader ${name}"
      VERBATIM)
    list(APPEND headers "${header}")
  endforeach()
  target_sources(${target} PRIVATE ${headers})
  target_include_directories(${target} PUBLIC "${include_dir}")
endfunction()
