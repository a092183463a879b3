#include "reed/config/schema/allowed.h"

#include <algorithm>
#include <numeric>

namespace reed {
namespace {

constexpr std::size_t kLongestWord = 64;  // a longer one is no slip

/// Letters to insert, remove, replace or swap with their neighbour, to get from one word to the other.
std::size_t Slips(const std::string& a, const std::string& b) {
  std::vector<std::size_t> before, last(b.size() + 1), row(b.size() + 1);
  std::iota(last.begin(), last.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], before[j - 2] + 1);
    }
    before = last;
    last = row;
  }
  return last[b.size()];
}

}  // namespace

std::string Allowed(const std::string& word, const std::vector<std::string>& allowed) {
  std::string list, nearest;
  std::size_t fewest = word.size() / 3 + 1;  // a third of the letters
  for (const std::string& name : allowed) {
    list += (list.empty() ? "" : ", ") + name;
    if (word.empty() || word.size() > kLongestWord) continue;
    if (const std::size_t slips = Slips(word, name); slips < fewest) {
      fewest = slips;
      nearest = name;
    }
  }
  return (nearest.empty() ? "" : "did you mean '" + nearest + "'? ") + "allowed: " + list;
}

}  // namespace reed
