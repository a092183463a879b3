// How large and how deep a configuration may be: what is beyond would end the reader by its stack. RT: set-up only.
#pragma once

#include <cstddef>
#include <string>

namespace reed {

inline constexpr std::size_t kLargestFile_bytes = 4U << 20U;
inline constexpr int kDeepestNesting = 64;
inline constexpr std::size_t kLongestText = 1000;  // of a value; a name of a run or an arm: kLongestName
inline constexpr std::size_t kLongestName = 100;

/// Line (from 1) of the first dotted key of a TOML text with more parts than kDeepestNesting, 0 if there is none.
std::size_t LineOfDeepKey(const std::string& toml);

}  // namespace reed
