# reed_layout: C code that packs and unpacks every frame of a DBC, generated at build time, so that the DBC stays the
# only source of layout. Two generators, one run: cantools (signals) and bus/codec/generate_layout.py (identifiers, sizes,
# E2E data ids, bounds, hash). Touching the DBC or the script regenerates both.
set(REED_PYTHON ${PROJECT_SOURCE_DIR}/build/venv/bin/python3 CACHE FILEPATH "Python that has cantools (tools/requirements)")

if(NOT EXISTS ${REED_PYTHON})
  message(FATAL_ERROR "REED_PYTHON=${REED_PYTHON} does not exist; tools/reed makes it, or give a Python 3.11 that has cantools")
endif()

function(reed_add_codec target dbc)
  set(out ${CMAKE_CURRENT_BINARY_DIR}/generated)
  set(layout_script ${PROJECT_SOURCE_DIR}/bus/codec/generate_layout.py)
  file(MAKE_DIRECTORY ${out})
  add_custom_command(
    OUTPUT ${out}/reed.c ${out}/reed.h ${out}/reed_layout.h
    COMMAND ${REED_PYTHON} -I -X utf8 -m cantools generate_c_source --database-name reed --use-round ${dbc}
    COMMAND ${REED_PYTHON} -I -X utf8 ${layout_script} ${dbc} ${out}/reed_layout.h
    DEPENDS ${dbc} ${layout_script}
    WORKING_DIRECTORY ${out}
    COMMENT "Generating the codec from ${dbc}"
    VERBATIM)
  add_library(${target} STATIC ${out}/reed.c ${out}/reed.h ${out}/reed_layout.h)
  target_include_directories(${target} SYSTEM PUBLIC ${out})
endfunction()
