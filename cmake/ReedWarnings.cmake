# The warnings of a control project, all of them errors: a silent narrowing or a shadowed gain moves an arm.
add_library(reed_warnings INTERFACE)
target_compile_options(reed_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Werror
  -Wconversion -Wsign-conversion -Wdouble-promotion -Wfloat-conversion
  -Wshadow -Wold-style-cast -Wcast-align -Wcast-qual -Wuseless-cast
  -Wnon-virtual-dtor -Woverloaded-virtual -Wextra-semi
  -Wnull-dereference -Wduplicated-cond -Wduplicated-branches -Wlogical-op
  -Wformat=2 -Wimplicit-fallthrough -Wundef -Wvla)

# Every first-party library or program: C++20, warnings, generated headers as system headers.
function(reed_target name)
  target_link_libraries(${name} PRIVATE $<BUILD_INTERFACE:reed_warnings>)
endfunction()

# Sources that run once, at start, or only in tests: an optimised build compiles them at -O1, half as long for the large header
# libraries. What runs in the loop, or is measured, is never among them. At -O1 GCC 12 sees null pointers in std::string.
set(REED_SET_UP_FLAGS "$<$<NOT:$<CONFIG:Debug>>:-O1;-Wno-null-dereference>")
function(reed_set_up_only)
  set_property(SOURCE ${ARGN} APPEND PROPERTY COMPILE_OPTIONS "${REED_SET_UP_FLAGS}")
endfunction()
