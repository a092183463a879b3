// How large an arm may be, wherever room is set aside for one. Plain data.
#pragma once

namespace reed {

inline constexpr int kMaxJoints = 8;
inline constexpr int kMaxParameters = 12;
inline constexpr int kMaxLawValues = 8;  // that a law from outside may show

}  // namespace reed
