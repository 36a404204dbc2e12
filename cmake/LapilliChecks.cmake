# Tests of the tree and of the built library: layering, what the driver needs and exports, installation.
set(checks "${PROJECT_SOURCE_DIR}/cmake/checks")
set(vulkan_core "${Vulkan_INCLUDE_DIR}/vulkan/vulkan_core.h")

add_test(NAME layering COMMAND ${LAPILLI_PYTHON} "${checks}/layering.py" "${PROJECT_SOURCE_DIR}" "${vulkan_core}")
add_test(NAME layering_self_test COMMAND ${LAPILLI_PYTHON} "${checks}/layering.py" --self-test "${vulkan_core}")
set_tests_properties(layering layering_self_test PROPERTIES LABELS check)

# A sanitizer's run time is needed by the library, and by whatever loads it.
if(NOT LAPILLI_SANITIZE)
  set(limit)
  if(CMAKE_BUILD_TYPE STREQUAL "Release")
    set(limit --max-bytes 3000000)
  endif()
  add_test(NAME shared_library
           COMMAND ${LAPILLI_PYTHON} "${checks}/shared_library.py" "$<TARGET_FILE:vulkan_lapilli>" ${limit})
  find_program(LAPILLI_VULKANINFO vulkaninfo REQUIRED)
  add_test(NAME install
           COMMAND ${LAPILLI_PYTHON} "${checks}/install.py" "${CMAKE_COMMAND}" "${PROJECT_BINARY_DIR}" "${LAPILLI_VULKANINFO}")
  set_tests_properties(shared_library install PROPERTIES LABELS check)

  # Where the interpreter jumps from op to op: by g++ (machine-inl.h says why), optimized, for the targets whose vectors hold
  # 64 lanes in eight registers.
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_SYSTEM_PROCESSOR STREQUAL "x86_64" AND CMAKE_BUILD_TYPE MATCHES "Rel")
    add_test(NAME tail_calls
             COMMAND ${LAPILLI_PYTHON} "${checks}/tail_calls.py" "$<TARGET_FILE:vulkan_lapilli>" AVX2 AVX3)
    set_tests_properties(tail_calls PROPERTIES LABELS check)
  endif()
endif()
add_test(NAME tail_calls_self_test COMMAND ${LAPILLI_PYTHON} "${checks}/tail_calls.py" --self-test)
set_tests_properties(tail_calls_self_test PROPERTIES LABELS check)
