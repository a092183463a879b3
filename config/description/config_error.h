// The one error of everything a user writes: a line that says where, what, and what is allowed.
#pragma once

#include <stdexcept>
#include <string>

namespace reed {

/// "file:line: key: problem; allowed: ...". Programs print it and exit with 2. RT: set-up only.
class ConfigError : public std::runtime_error {
 public:
  explicit ConfigError(const std::string& text) : std::runtime_error(OneLine(text)) {}

 private:
  /// A file's text may hold anything: no second line, no terminal codes, no page of it.
  static std::string OneLine(std::string text) {
    constexpr std::size_t kLongest = 1000;
    if (text.size() > kLongest) {
      std::size_t end = kLongest;
      while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U)
        --end;  // not inside a letter
      text = text.substr(0, end) + " ...";
    }
    for (char& c : text)
      if (static_cast<unsigned char>(c) < 0x20U || c == 0x7F) c = ' ';
    return text;
  }
};

}  // namespace reed
