# lapilli_library: one CMake library for one folder of icd/, with its tests and benchmarks.

# Generated headers go under here as <folder>/<file>, so that they are included like the written ones.
set(LAPILLI_GENERATED_DIR "${PROJECT_BINARY_DIR}/generated")
file(MAKE_DIRECTORY "${LAPILLI_GENERATED_DIR}")

# lapilli_library(<folder>
#   SOURCES file.cpp…      none: the folder is headers only and becomes an INTERFACE library
#   DEPENDS folder…        other folders of icd/, against the arrows of the design
#   TESTS   x_test.cpp…    make one GoogleTest program, <folder>_test, run by ctest as one test
#   BENCHES y_bench.cpp…   make one Google Benchmark program each, y_bench
#   TEST_LINK library…     what only the tests need)
# Paths may name subfolders (spirv/reader.cpp).
function(lapilli_library folder)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "SOURCES;DEPENDS;TESTS;BENCHES;TEST_LINK")
  if(arg_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "lapilli_library(${folder}): unknown arguments: ${arg_UNPARSED_ARGUMENTS}")
  endif()
  set(library "lapilli_${folder}")
  if(arg_SOURCES)
    add_library(${library} STATIC ${arg_SOURCES})
    set(scope PUBLIC)
  else()
    add_library(${library} INTERFACE)
    set(scope INTERFACE)
  endif()
  target_include_directories(${library} ${scope} "${PROJECT_SOURCE_DIR}/icd" "${LAPILLI_GENERATED_DIR}")
  target_include_directories(${library} SYSTEM ${scope} ${Vulkan_INCLUDE_DIRS} ${LAPILLI_SPIRV_INCLUDE_DIR})
  list(TRANSFORM arg_DEPENDS PREPEND "lapilli_" OUTPUT_VARIABLE depends)
  target_link_libraries(${library} ${scope} lapilli_hwy Threads::Threads ${depends})

  if(BUILD_TESTING AND arg_TESTS)
    add_executable(${folder}_test ${arg_TESTS})
    target_link_libraries(${folder}_test PRIVATE ${library} ${arg_TEST_LINK} GTest::gtest GTest::gtest_main)
    add_test(NAME ${folder}_test COMMAND ${folder}_test)
    set_tests_properties(${folder}_test PROPERTIES LABELS unit TIMEOUT 900)
  endif()

  if(LAPILLI_BENCHMARKS)
    foreach(source IN LISTS arg_BENCHES)
      get_filename_component(name "${source}" NAME_WE)
      add_executable(${name} ${source})
      target_link_libraries(${name} PRIVATE ${library} benchmark::benchmark)
    endforeach()
  endif()
endfunction()
