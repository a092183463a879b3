#include "reed/config/schema/text_limits.h"

namespace reed {
namespace {

/// Walks over TOML without its values: strings and comments hide what is in them.
class Walk {
 public:
  explicit Walk(const std::string& text) : text_(text) {}

  /// The next character that is neither in a string nor in a comment, '\0' at the end.
  char Next() {
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (c == '"' || c == '\'') {
        SkipString(c);
      } else if (c == '#') {
        while (at_ < text_.size() && text_[at_] != '\n') ++at_;
      } else {
        ++at_;
        if (c == '\n') ++line_;
        return c;
      }
    }
    return '\0';
  }
  std::size_t line() const { return line_; }

 private:
  void SkipString(char quote) {
    const std::string three(3, quote);
    const bool long_string = text_.compare(at_, 3, three) == 0;
    at_ += long_string ? 3 : 1;
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (c == '\n') ++line_;
      if (c == '\n' && !long_string) return;  // not closed: the parser says so
      if (c == '\\' && quote == '"') {
        at_ += 2;
      } else if (long_string ? text_.compare(at_, 3, three) == 0 : c == quote) {
        at_ += long_string ? 3 : 1;
        return;
      } else {
        ++at_;
      }
    }
  }

  const std::string& text_;
  std::size_t at_ = 0, line_ = 1;
};

}  // namespace

std::size_t LineOfDeepKey(const std::string& toml) {
  Walk walk(toml);
  int parts = 1;
  for (char c = walk.Next(); c != '\0'; c = walk.Next()) {
    if (c == '.') {
      if (++parts > kDeepestNesting) return walk.line();
    } else if (c == '\n' || c == '=' || c == ',' || c == '[' || c == ']' || c == '{' || c == '}') {
      parts = 1;
    }
  }
  return 0;
}

}  // namespace reed
