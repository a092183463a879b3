# The laws of the tree: every file of firmware/core/laws is one, and its name is the law's. pd_tuned.h holds PdTuned and is
# LawId::kPdTuned. Written here: reed/law_names/law_names.h, for configuration files too, and reed/laws/laws.h, for the controller.
file(GLOB law_files CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR}/firmware/core/laws ${PROJECT_SOURCE_DIR}/firmware/core/laws/*.h)
list(SORT law_files)
set(REED_LAWS_DIR ${CMAKE_BINARY_DIR}/generated)
foreach(file ${law_files})
  string(REPLACE ".h" "" law ${file})
  string(REPLACE "_" ";" words ${law})
  set(camel "")
  foreach(word ${words})
    string(SUBSTRING ${word} 0 1 first)
    string(SUBSTRING ${word} 1 -1 rest)
    string(TOUPPER ${first} first)
    string(APPEND camel ${first}${rest})
  endforeach()
  string(APPEND ids "  k${camel},\n")
  string(APPEND quoted "    \"${law}\",\n")
  string(APPEND includes "#include \"reed/core/laws/${law}.h\"\n")
  string(APPEND rows "    LawOf<laws::${camel}<N, P>, N, P>(),\n")
endforeach()
string(REPLACE ".h" "" choices "${law_files}")
string(REPLACE ";" " | " choices "${choices}")
list(LENGTH law_files count)
file(CONFIGURE OUTPUT ${REED_LAWS_DIR}/law_names/law_names.h @ONLY CONTENT [[// Written by cmake/ReedLaws.cmake from firmware/core/laws: the laws of the tree by name. RT: safe.
#pragma once

#include <array>
#include <cstdint>

namespace reed::strategy {

enum class LawId : std::uint8_t {
@ids@  kExternal,  // from outside, through reed/law.h
};
inline constexpr std::array<const char*, @count@> kLawNames{
@quoted@};
inline constexpr const char* kLawChoices = "@choices@";

}  // namespace reed::strategy
]])
file(CONFIGURE OUTPUT ${REED_LAWS_DIR}/laws/laws.h @ONLY CONTENT [[// Written by cmake/ReedLaws.cmake from firmware/core/laws: the laws of the tree in the order of LawId. RT: safe.
#pragma once

#include "reed/core/law/law.h"
@includes@#include "reed/law_names/law_names.h"

namespace reed::strategy {

template <int N, int P>
inline constexpr std::array<Law<N, P>, @count@> kBuiltInLaws{
@rows@};

}  // namespace reed::strategy
]])
add_library(reed_law_names INTERFACE)
reed_room(reed_law_names reed/law_names FOLDER ${REED_LAWS_DIR}/law_names)
