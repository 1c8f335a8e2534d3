// dualdamp-accuracy [SEEDS [METHOD...]]: writes docs/methods/accuracy.md to stdout, of all methods or of those
// named. Progress with processor time, and coverages outside, go to stderr.

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <span>

#include "bench/accuracy/accuracy.hpp"
#include "identify/methods.hpp"

int main(int argc, char** argv) {
  using namespace dualdamp;
  constexpr int usual_seeds = 1000;
  const int seeds = argc > 1 ? std::atoi(argv[1]) : usual_seeds;
  if (seeds < 1) {
    std::fputs("usage: dualdamp-accuracy [SEEDS [METHOD...]]\n", stderr);
    return 2;
  }
  std::vector<bench::Cell> cells;
  const std::span<char*> words(argv, static_cast<std::size_t>(argc));
  const std::span<char*> named = words.subspan(std::min<std::size_t>(words.size(), 2));
  for (const identify::MethodEntry& method : identify::methods()) {
    const auto is_it = [&](const char* name) { return method.name == name; };
    if (!named.empty() && std::ranges::none_of(named, is_it)) continue;
    std::fprintf(stderr, "%5.0f s %s\n", static_cast<double>(std::clock()) / CLOCKS_PER_SEC,
                 std::string(method.name).c_str());
    for (bench::Cell& cell : bench::accuracy({&method}, {20e-6, 50e-6, 100e-6}, seeds))
      cells.push_back(std::move(cell));
  }
  std::fputs(bench::accuracy_page(cells).c_str(), stdout);
  for (const std::string& line : bench::coverage(cells).outside)
    std::fprintf(stderr, "outside: %s\n", line.c_str());
  return 0;
}
