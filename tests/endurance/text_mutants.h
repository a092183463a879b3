// Configuration files that nobody meant to write: the same text for the same text, seed and number.
#pragma once

#include <array>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace reed::test {

class TextMutant {
 public:
  TextMutant(std::uint64_t seed, std::uint64_t number) : random_(seed * 1'000'003 + number) {}

  std::string Of(std::string text) {
    for (std::uint64_t changes = 1 + Below(4); changes > 0 && !text.empty(); --changes) Change(text);
    return text;
  }

 private:
  static constexpr std::array kTokens = {"nan",
                                         "inf",
                                         "-inf",
                                         "0",
                                         "-0.0",
                                         "-1",
                                         "1e308",
                                         "-1e308",
                                         "1e-308",
                                         "5e-324",
                                         "9223372036854775807",
                                         "-9223372036854775808",
                                         "99999999999999999999",
                                         "2147483648",
                                         "1_000",
                                         "0x7fffffff",
                                         "1e",
                                         "true",
                                         "\"\"",
                                         "''",
                                         "\"\\u0000\"",
                                         "[]",
                                         "[[]]",
                                         "{}",
                                         "[nan, nan, nan]",
                                         "[1e9, 1e9, 1e9]",
                                         "[0, 0, 0]",
                                         "1979-05-27",
                                         "=",
                                         "[",
                                         "]",
                                         "[[reference.legs]]",
                                         "[arm]",
                                         "[scenario",
                                         "#",
                                         "\"\"\"",
                                         "\n",
                                         "\r",
                                         "\t",
                                         "\xff\xfe",
                                         "\xc3",
                                         "\xef\xbb\xbf",
                                         "a.b.c = 1",
                                         "duration_s = 3600",
                                         "rate_hz = 8000",
                                         "kind = 'sine'",
                                         "frequency_hz = 50",
                                         "flexible_links = false",
                                         "elements_per_link = 8",
                                         "source = 'unknown'",
                                         "law = 'pd'"};

  std::uint64_t Below(std::uint64_t end) { return random_() % end; }
  std::string Token() { return kTokens[Below(kTokens.size())]; }

  void Change(std::string& text) {
    const std::size_t at = Below(text.size());
    switch (Below(9)) {
      case 0:
        text[at] = static_cast<char>(Below(256));
        break;
      case 1:
        text.erase(at, 1 + Below(20));
        break;
      case 2:
        text.insert(at, Token());
        break;
      case 3:
        text.insert(at, text.substr(Below(text.size()), 1 + Below(200)));
        break;
      case 4:
        text.resize(at);
        break;
      case 5:
        ChangeLines(text);
        break;
      default:
        ReplaceANumber(text, at);
    }
  }

  /// One of the next numbers by another one, or by what is none: most of such files are read to their end.
  void ReplaceANumber(std::string& text, std::size_t at) {
    constexpr const char* kDigits = "0123456789";
    at = text.find_first_of(kDigits, at);
    if (at == std::string::npos) return;
    const std::size_t end = text.find_first_not_of("0123456789.eE+-_", at);
    const std::string old = text.substr(at, end - at);
    std::string by = Token();
    if (Below(3) > 0) {
      constexpr std::array kFactors = {-1.0, 0.0, 0.5, 0.9, 1.1, 2.0, 10.0, 100.0, 1e3, 1e-3, 1e6, 1e-9};
      const double value = std::strtod(old.c_str(), nullptr) * kFactors[Below(kFactors.size())];
      by = std::to_string(value);
    }
    text.replace(at, old.size(), by);
  }

  void ChangeLines(std::string& text) {
    std::vector<std::string> lines;
    for (std::size_t from = 0; from < text.size();) {
      const std::size_t end = std::min(text.find('\n', from), text.size() - 1) + 1;
      lines.push_back(text.substr(from, end - from));
      from = end;
    }
    const std::size_t one = Below(lines.size()), two = Below(lines.size());
    switch (Below(3)) {
      case 0:
        lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(one));
        break;
      case 1:
        lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(one), lines[two]);
        break;
      default:
        std::swap(lines[one], lines[two]);
    }
    text.clear();
    for (const std::string& line : lines) text += line;
  }

  std::mt19937_64 random_;
};

}  // namespace reed::test
