# A room is a folder of headers that others include as "NAME/file.h". Each target has include roots of its own, with
# its rooms and nothing else in them: a header of a room that a target does not link cannot be included.
# The roots are links in the build tree, so the source tree stays flat.
function(reed_room target name)
  cmake_parse_arguments(arg "" "FOLDER" "" ${ARGN})
  if(NOT arg_FOLDER)
    set(arg_FOLDER ${CMAKE_CURRENT_SOURCE_DIR})
  endif()
  get_target_property(kind ${target} TYPE)
  set(root ${CMAKE_BINARY_DIR}/rooms/${target})
  cmake_path(GET name PARENT_PATH parent)
  file(MAKE_DIRECTORY ${root}/${parent})
  file(CREATE_LINK ${arg_FOLDER} ${root}/${name} SYMBOLIC)
  if(kind STREQUAL INTERFACE_LIBRARY)
    target_include_directories(${target} INTERFACE $<BUILD_INTERFACE:${root}>)
  else()
    target_include_directories(${target} PUBLIC $<BUILD_INTERFACE:${root}>)
  endif()
endfunction()
