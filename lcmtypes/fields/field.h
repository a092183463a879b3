// The types of a telemetry message's fields, and how a field gets its value from the program and gives it to the message.
// The lists of fields come from the .lcm files (lcmtypes/README.md). RT: SetField is safe; CopyField allocates when a
// message's vector grows.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "reed/config/sizes/sizes.h"

namespace reed::field {

template <typename T>
using PerJoint = std::array<T, kMaxJoints>;
template <typename T>
using PerParameter = std::array<T, kMaxParameters>;
template <typename T>
using PerAxis = std::array<T, 3>;

/// A number, or a vector of the program's own kind entry by entry.
template <typename T, typename U>
constexpr void SetField(T& to, const U& from) noexcept {
  if constexpr (requires { from.size(); }) {
    const auto count = std::min(static_cast<std::size_t>(from.size()), to.size());
    for (std::size_t i = 0; i < count; ++i) SetField(to[i], from[static_cast<decltype(from.size())>(i)]);
  } else if constexpr (std::is_same_v<T, U>) {
    to = from;
  } else {
    to = static_cast<T>(from);
  }
}

/// A message's number; `count` is the length of its arrays.
template <typename T, typename U>
constexpr void CopyField(const T& in, std::int32_t, U& out) noexcept {
  out = static_cast<U>(in);
}
template <typename T, std::size_t N, typename U>
void CopyField(const std::array<T, N>& in, std::int32_t count, std::vector<U>& out) {
  out.assign(in.begin(), in.begin() + count);
}
template <typename T, std::size_t N, typename U>
constexpr void CopyField(const std::array<T, N>& in, std::int32_t, U (&out)[N]) noexcept {
  std::copy(in.begin(), in.end(), out);
}

}  // namespace reed::field

// What to make of an entry of a list: a member, the line that sets it, the line that copies it from `in` to `out`.
#define REED_MEMBER(Type, name, ...) Type name{};
#define REED_SET(Type, name, ...) __VA_OPT__(::reed::field::SetField(out.name, __VA_ARGS__);)
#define REED_COPY(Type, name, ...) ::reed::field::CopyField(in.name, count, out.name);
