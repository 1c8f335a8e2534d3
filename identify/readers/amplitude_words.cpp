#include "identify/readers/amplitude_words.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <vector>

#include "core/units.hpp"
#include "identify/readers/text.hpp"

namespace dualdamp::identify {

namespace {

enum class Kind { peak, rms, peak_to_peak };

struct Spelling {
  std::string_view text;  ///< lower case, its words joined
  Kind kind;
};

/// Longer ones first, since each is sought at the end of a text.
constexpr std::array<Spelling, 21> spellings = {{{"doubleamplitude", Kind::peak_to_peak},
                                                 {"doppelamplitude", Kind::peak_to_peak},
                                                 {"spitzespitze", Kind::peak_to_peak},
                                                 {"peaktotrough", Kind::peak_to_peak},
                                                 {"peaktopeak", Kind::peak_to_peak},
                                                 {"effektivwert", Kind::rms},
                                                 {"zerotopeak", Kind::peak},
                                                 {"peak2peak", Kind::peak_to_peak},
                                                 {"peakpeak", Kind::peak_to_peak},
                                                 {"pktopk", Kind::peak_to_peak},
                                                 {"pk2pk", Kind::peak_to_peak},
                                                 {"pkpk", Kind::peak_to_peak},
                                                 {"peak", Kind::peak},
                                                 {"trms", Kind::rms},
                                                 {"0pk", Kind::peak},
                                                 {"p2p", Kind::peak_to_peak},
                                                 {"ptp", Kind::peak_to_peak},
                                                 {"rms", Kind::rms},
                                                 {"0p", Kind::peak},
                                                 {"pp", Kind::peak_to_peak},
                                                 {"pk", Kind::peak}}};

constexpr std::string_view separators = " _/,:;-.()[]{}<>";

/// A word of the text, in lower case, and where it begins.
struct Word {
  std::string text;
  std::size_t begin = 0;
};

std::vector<Word> words_of(std::string_view text) {
  std::vector<Word> words;
  bool is_new = true;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (separators.find(text[i]) != std::string_view::npos) {
      is_new = true;
      continue;
    }
    if (is_new) words.push_back({{}, i});
    is_new = false;
    words.back().text += static_cast<char>(std::tolower(static_cast<unsigned char>(text[i])));
  }
  return words;
}

/// A spelling that some words from `first` on make together, or the end of one word behind a unit: `mmpp`, `Vrms`.
struct Match {
  Kind kind = Kind::peak;
  std::size_t begin = 0;  ///< in the text
};

bool is_unit(std::string_view text) {
  return std::ranges::any_of(std::array{"m", "V", "m/s", "m/s^2", "rad"}, [text](const char* unit) {
    return core::unit_factor(std::string(text), unit).value.has_value();
  });
}

std::optional<Match> match_at(std::string_view text, const std::vector<Word>& words, std::size_t first) {
  std::string joined;
  std::optional<Match> longest;
  constexpr std::size_t most_words = 3;
  for (std::size_t i = first; i < std::min(first + most_words, words.size()); ++i) {
    joined += words[i].text;
    const auto* const found = std::ranges::find(spellings, joined, &Spelling::text);
    if (found != spellings.end()) longest = Match{found->kind, words[first].begin};
  }
  if (longest) return longest;
  const Word& word = words[first];
  for (const Spelling& spelling : spellings) {
    if (word.text.size() <= spelling.text.size() || !word.text.ends_with(spelling.text)) continue;
    const std::size_t before = word.text.size() - spelling.text.size();
    if (is_unit(text.substr(word.begin, before))) return Match{spelling.kind, word.begin + before};
  }
  return std::nullopt;
}

std::vector<Match> matches_in(std::string_view text) {
  const std::vector<Word> words = words_of(text);
  std::vector<Match> matches;
  for (std::size_t i = 0; i < words.size(); ++i)
    if (const auto match = match_at(text, words, i)) matches.push_back(*match);
  return matches;
}

}  // namespace

std::optional<AmplitudeWords> amplitude_words(std::string_view text) {
  for (const Match& match : matches_in(text)) {
    if (match.kind == Kind::rms) return AmplitudeWords{"rms values", "1.41421"};
    if (match.kind == Kind::peak_to_peak) return AmplitudeWords{"peak to peak", "0.5"};
  }
  return std::nullopt;
}

std::string without_amplitude_words(std::string_view unit) {
  const std::vector<Match> matches = matches_in(unit);
  if (matches.empty() || matches.front().begin == 0) return std::string(unit);
  std::string_view rest = unit.substr(0, matches.front().begin);
  while (!rest.empty() && separators.find(rest.back()) != std::string_view::npos) rest.remove_suffix(1);
  return is_unit(rest) ? std::string(rest) : std::string(unit);
}

}  // namespace dualdamp::identify
