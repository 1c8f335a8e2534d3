#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <iterator>
#include <string>

#include "bench/accuracy/accuracy.hpp"
#include "identify/methods.hpp"
#include "tests/support/source_tree.hpp"

using namespace dualdamp;

namespace {

std::vector<bench::Cell> cells_of(std::string_view method, double noise, int seeds) {
  return bench::accuracy({identify::find_method(method)}, {noise}, seeds);
}

std::string committed_page() {
  std::ifstream file(dualdamp::testing::in_tree("docs/methods/accuracy.md"));
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace

TEST_CASE("every method finds an experiment, and noise spreads its estimates in proportion") {
  for (const identify::MethodEntry& method : identify::methods()) {
    INFO(method.name);
    const std::vector<bench::Cell> cells = bench::accuracy({&method}, {1e-6, 4e-6}, 2);
    REQUIRE(cells.size() == (cells.at(0).experiment == "histories" ? 4 : 2));
    for (std::size_t i = 0; i < cells.size(); i += 2) {
      CHECK(cells[i].estimates == 2);
      CHECK(cells[i].zeta.spread > 0.0);
      // To first order. In the random experiment the random motion scatters the estimates far more than the noise
      // does.
      const bool random = cells[i].experiment == "random response";
      const double growth = cells[i + 1].zeta.spread / cells[i].zeta.spread;
      CHECK(growth == (random ? Approx(1.0).epsilon(0.2) : Approx(4.0).epsilon(0.6)));
    }
  }
}

TEST_CASE("intervals hold the truth in 95 % of 1,000 readings") {
  // 95 % +- 2 % are 2.9 standard deviations of 1,000 draws.
  for (const char* method : {"den_hartog_fit", "free_decay", "resonance_deming", "resonance_least_squares"}) {
    INFO(method);
    const std::vector<bench::Cell> cells = cells_of(method, 50e-6, 1000);
    REQUIRE(cells.size() == 1);
    CHECK(cells[0].zeta.intervals == 1000);
    CHECK(bench::coverage(cells).claimed == 2);
    CHECK(bench::coverage(cells).outside.empty());
    // The mean of 1,000 is known to a thirtieth of the spread.
    CHECK(std::abs(cells[0].zeta.bias) < 0.15 * cells[0].zeta.spread);
    CHECK(std::abs(cells[0].F0.bias) < 0.15 * cells[0].F0.spread);
  }
}

TEST_CASE("the page of accuracies is that of the present methods") {
  const std::string page = committed_page();
  for (const char* method : {"den_hartog_fit", "free_decay", "resonance_least_squares"})
    CHECK(page.find(bench::accuracy_row(cells_of(method, 100e-6, 1000).at(0))) != std::string::npos);
}
