# The warnings of a control project, all of them errors: a silent narrowing or a shadowed gain moves an arm.
add_library(reed_warnings INTERFACE)
target_compile_options(reed_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Werror
  -Wconversion -Wsign-conversion -Wdouble-promotion -Wfloat-conversion
  -Wshadow -Wold-style-cast -Wcast-align -Wcast-qual
  -Wnon-virtual-dtor -Woverloaded-virtual -Wextra-semi
  -Wnull-dereference -Wformat=2 -Wimplicit-fallthrough -Wundef -Wvla
  $<$<CXX_COMPILER_ID:GNU>:-Wuseless-cast;-Wduplicated-cond;-Wduplicated-branches;-Wlogical-op>)

# Every first-party library or program: C++20, warnings, generated headers as system headers.
function(reed_target name)
  target_link_libraries(${name} PRIVATE $<BUILD_INTERFACE:reed_warnings>)
endfunction()

# What --version of a program says. The commit is not compiled in: every commit would make another program of the same code.
function(reed_version source)
  set_property(SOURCE ${source} APPEND PROPERTY COMPILE_DEFINITIONS
    "REED_VERSION=\"reed ${PROJECT_VERSION} (tools/reed --version names the commit)\"")
endfunction()

# Sources that run once, at start, or only in tests: an optimised build compiles them at -O1, half as long for the large header
# libraries. What runs in the loop, or is measured, is never among them. At -O1 GCC 12 sees null pointers in std::string.
set(REED_SET_UP_FLAGS "$<$<NOT:$<CONFIG:Debug>>:-O1;-Wno-null-dereference>")
function(reed_set_up_only)
  set_property(SOURCE ${ARGN} APPEND PROPERTY COMPILE_OPTIONS "${REED_SET_UP_FLAGS}")
endfunction()

# Headers that most of a target's files read, read once per build. Not in Debug, where a header that a file forgot to include is
# to be missed.
function(reed_precompiled target)
  if(NOT CMAKE_BUILD_TYPE STREQUAL Debug)
    target_precompile_headers(${target} PRIVATE ${ARGN})
  endif()
endfunction()
