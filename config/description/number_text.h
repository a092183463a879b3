// Numbers in messages. RT: set-up only.
#pragma once

#include <charconv>
#include <string>

namespace reed {

/// Shortest decimal that reads back as the same double.
inline std::string ToText(double value) {
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value);
  return {buffer, end.ptr};
}

/// Six significant digits: for computed values, which nobody typed.
inline std::string ToShortText(double value) {
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::general, 6);
  return {buffer, end.ptr};
}

}  // namespace reed
