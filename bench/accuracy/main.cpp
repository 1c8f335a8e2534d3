// dualdamp-accuracy [SEEDS]: writes docs/methods/accuracy.md to stdout. Progress and coverages outside go to
// stderr.

#include <cstdio>
#include <cstdlib>

#include "bench/accuracy/accuracy.hpp"
#include "identify/methods.hpp"

int main(int argc, char** argv) {
  using namespace dualdamp;
  constexpr int usual_seeds = 1000;
  const int seeds = argc > 1 ? std::atoi(argv[1]) : usual_seeds;
  if (seeds < 1) {
    std::fputs("usage: dualdamp-accuracy [SEEDS]\n", stderr);
    return 2;
  }
  std::vector<bench::Cell> cells;
  for (const identify::MethodEntry& method : identify::methods()) {
    std::fprintf(stderr, "%s\n", std::string(method.name).c_str());
    for (bench::Cell& cell : bench::accuracy({&method}, {20e-6, 50e-6, 100e-6}, seeds))
      cells.push_back(std::move(cell));
  }
  std::fputs(bench::accuracy_page(cells).c_str(), stdout);
  for (const std::string& line : bench::coverage(cells).outside)
    std::fprintf(stderr, "outside: %s\n", line.c_str());
  return 0;
}
