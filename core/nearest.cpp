#include "core/nearest.hpp"

#include <algorithm>
#include <cctype>
#include <numeric>
#include <utility>

namespace dualdamp::core {

namespace {

/// Edit distance that counts a swap of neighbours as one edit (Damerau, restricted).
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before_last;
  std::vector<std::size_t> last(b.size() + 1);
  std::iota(last.begin(), last.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::vector<std::size_t> row(b.size() + 1);
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] == b[j - 1] ? 0U : 1U)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], before_last[j - 2] + 1);
    }
    before_last = std::move(last);
    last = std::move(row);
  }
  return last.back();
}

/// Ignores case, '-', '_' and blanks.
std::string folded(std::string_view word) {
  std::string result;
  for (const char c : word)
    if (c != '_' && c != '-' && c != ' ') result += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

/// The shortest of the names that begin with the word, or with which the word begins; three letters at least.
std::string with_same_beginning(const std::string& wanted, const std::vector<std::string>& names) {
  constexpr std::size_t telling = 3;
  std::string best;
  for (const std::string& name : names) {
    const std::string other = folded(name);
    if (std::min(wanted.size(), other.size()) < telling) continue;
    if (!wanted.starts_with(other) && !other.starts_with(wanted)) continue;
    if (best.empty() || name.size() < best.size()) best = name;
  }
  return best;
}

}  // namespace

std::string nearest(std::string_view word, const std::vector<std::string>& names) {
  constexpr std::size_t longest = 40;
  if (word.empty() || word.size() > longest) return {};
  const std::string wanted = folded(word);
  std::string best;
  // One edit for three letters: `mas` is mass, but `foo` is not force.
  std::size_t best_distance = std::max<std::size_t>(1, wanted.size() / 3) + 1;
  for (const std::string& name : names) {
    const std::size_t distance = edit_distance(wanted, folded(name));
    if (distance < best_distance) {
      best = name;
      best_distance = distance;
    }
  }
  return best.empty() ? with_same_beginning(wanted, names) : best;
}

}  // namespace dualdamp::core
