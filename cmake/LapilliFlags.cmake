# Compiler and linker flags for all of our own code. Everything that decides a result bit is here, in one place.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_CXX_SCAN_FOR_MODULES OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_CXX_VISIBILITY_PRESET hidden)
set(CMAKE_VISIBILITY_INLINES_HIDDEN ON)

add_compile_options(
  -Wall -Wextra -Wshadow -Wconversion -Wsign-conversion
  # The same bits from both compilers on every target: a multiply and an add stay two operations.
  -ffp-contract=off
  # sqrt() is one instruction; nothing here reads errno after a math call.
  -fno-math-errno
  -ffunction-sections -fdata-sections)
add_link_options(-Wl,--gc-sections)
if(LAPILLI_WERROR)
  add_compile_options(-Werror)
endif()

# The hot loops are written in vectors already, so the compiler's own (-O3) would mostly make the library larger.
set(CMAKE_CXX_FLAGS_RELEASE "-O2 -DNDEBUG")
set(CMAKE_CXX_FLAGS_RELWITHDEBINFO "-O2 -g -DNDEBUG")

if(LAPILLI_SANITIZE)
  add_compile_options(-fsanitize=${LAPILLI_SANITIZE} -fno-omit-frame-pointer)
  add_link_options(-fsanitize=${LAPILLI_SANITIZE})
  if(LAPILLI_SANITIZE MATCHES "undefined")
    add_compile_options(-fno-sanitize-recover=undefined)
  endif()
  # For code that must know: the interpreter runs its plain loop, tests leave lavapipe out.
  add_compile_definitions(LAPILLI_SANITIZED=1)
  if(LAPILLI_SANITIZE MATCHES "thread")
    add_compile_definitions(LAPILLI_SANITIZED_THREAD=1)
  endif()
  # -O1 keeps stacks readable and the tests a few times faster than -O0.
  set(CMAKE_CXX_FLAGS_DEBUG "-O1 -g1")
endif()
