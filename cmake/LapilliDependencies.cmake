# What the build takes from the distribution. Nothing is downloaded here; ./lapilli setup installs the packages.
find_package(Threads REQUIRED)
find_package(Vulkan REQUIRED)

# The registry the entry-point tables are made from comes with the headers.
find_file(LAPILLI_VK_REGISTRY vk.xml REQUIRED
          HINTS "${Vulkan_INCLUDE_DIR}/../share/vulkan/registry"
          PATHS /usr/share/vulkan/registry
          NO_CMAKE_FIND_ROOT_PATH)

find_path(LAPILLI_SPIRV_INCLUDE_DIR spirv/unified1/spirv.hpp11 REQUIRED)
find_path(LAPILLI_HWY_INCLUDE_DIR hwy/highway.h REQUIRED)

# Highway is used header-only: the driver may not need libhwy.so, and dispatch is our own (base/). Its debug checks would
# call hwy::Abort from that library, hence off.
add_library(lapilli_hwy INTERFACE)
target_include_directories(lapilli_hwy SYSTEM INTERFACE ${LAPILLI_HWY_INCLUDE_DIR})
target_compile_definitions(lapilli_hwy INTERFACE HWY_IS_DEBUG_BUILD=0)

# Build scripts use the distribution's Python: another one first in PATH may lack its modules.
find_program(LAPILLI_PYTHON python3 PATHS /usr/bin /bin NO_DEFAULT_PATH)
if(NOT LAPILLI_PYTHON)
  find_program(LAPILLI_PYTHON python3 REQUIRED)
endif()

find_program(LAPILLI_GLSLANG NAMES glslangValidator glslang REQUIRED)
find_program(LAPILLI_SPIRV_AS spirv-as REQUIRED)
find_program(LAPILLI_SPIRV_VAL spirv-val REQUIRED)

if(BUILD_TESTING)
  find_package(GTest REQUIRED)
  find_package(glm REQUIRED)
  find_package(nlohmann_json REQUIRED)
  # stb is header-only here: the user defines STB_IMAGE_WRITE_IMPLEMENTATION in one file.
  find_path(LAPILLI_STB_INCLUDE_DIR NAMES stb/stb_image_write.h stb_image_write.h REQUIRED)
  add_library(lapilli_stb INTERFACE)
  target_include_directories(lapilli_stb SYSTEM INTERFACE ${LAPILLI_STB_INCLUDE_DIR})
endif()
if(LAPILLI_BENCHMARKS)
  find_package(benchmark REQUIRED)
endif()
