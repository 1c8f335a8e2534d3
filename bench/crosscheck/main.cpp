// dualdamp-crosscheck N SEED [--jobs J] [--first I] [--out DIR]
//   runs N random cases and prints the table; each disagreement goes to stderr when it is found, and its scenario
//   to DIR
// dualdamp-crosscheck --case SEED:INDEX
//   runs one case and prints its scenario
//
// Exit status: 0 everything agrees, is refused with a message or is a named exception; 1 a disagreement, a crash or
// a hang; 2 wrong usage.

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bench/crosscheck/campaign.hpp"
#include "bench/crosscheck/children.hpp"
#include "bench/crosscheck/random_scenario.hpp"
#include "bench/crosscheck/summary.hpp"

namespace {

using namespace dualdamp;

struct Call {
  std::vector<std::uint64_t> numbers;
  crosscheck::Limits limits;
  std::uint32_t first = 0;
  bool single = false;
  std::string out;
};

std::optional<std::uint64_t> number(std::string_view text) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::optional<Call> call_of(int argc, char** argv) {
  Call call;
  for (int i = 1; i < argc; ++i) {
    const std::string_view word = argv[i];
    if (word == "--case" && i + 1 < argc) {
      const std::string_view text = argv[++i];
      const std::size_t colon = std::min(text.find(':'), text.size());
      const auto seed = number(text.substr(0, colon));
      const auto index = number(colon < text.size() ? text.substr(colon + 1) : "");
      if (!seed || !index) return std::nullopt;
      call.single = true;
      call.numbers = {1, *seed};
      call.first = static_cast<std::uint32_t>(*index);
    } else if ((word == "--jobs" || word == "--first") && i + 1 < argc) {
      const auto value = number(argv[++i]);
      if (!value) return std::nullopt;
      if (word == "--jobs")
        call.limits.jobs = static_cast<int>(*value);
      else
        call.first = static_cast<std::uint32_t>(*value);
    } else if (word == "--out" && i + 1 < argc) {
      call.out = argv[++i];
    } else if (const auto value = number(word)) {
      call.numbers.push_back(*value);
    } else {
      return std::nullopt;
    }
  }
  if (call.numbers.size() != 2 || call.limits.jobs < 1) return std::nullopt;
  return call;
}

/// Writes a file for each disagreement, crash or hang.
void write_faults(const crosscheck::Summary& summary, std::uint64_t seed, const std::filesystem::path& directory) {
  std::filesystem::create_directories(directory);
  for (const auto& [index, fault] : summary.faults()) {
    std::string comment = "# " + fault + "\n";
    for (std::size_t i = comment.find('\n'); i + 1 < comment.size(); i = comment.find('\n', i + 1))
      comment.insert(i + 1, "#");
    const std::string name = std::to_string(seed) + "-" + std::to_string(index) + ".yaml";
    std::ofstream(directory / name) << comment << crosscheck::yaml(crosscheck::random_scenario(seed, index));
  }
}

}  // namespace

int main(int argc, char** argv) {
  const std::optional<Call> call = call_of(argc, argv);
  if (!call) {
    std::fputs(
        "usage: dualdamp-crosscheck N SEED [--jobs J] [--first I] [--out DIR]\n"
        "       dualdamp-crosscheck --case SEED:INDEX\n",
        stderr);
    return 2;
  }
  const std::uint64_t seed = call->numbers[1];
  if (call->single) std::fputs(crosscheck::yaml(crosscheck::random_scenario(seed, call->first)).c_str(), stdout);
  crosscheck::Summary summary;
  crosscheck::run_campaign(seed, call->first, static_cast<std::uint32_t>(call->numbers[0]), call->limits, summary);
  if (!call->out.empty()) write_faults(summary, seed, call->out);
  std::fputs(summary.text(seed).c_str(), call->single ? stderr : stdout);
  return summary.holds() ? 0 : 1;
}
