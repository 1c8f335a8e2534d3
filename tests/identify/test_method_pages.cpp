// The examples of docs/methods/*.md that hold their data give the numbers printed there.

#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <sstream>
#include <string>

#include "core/units.hpp"
#include "identify/methods.hpp"
#include "identify/readers/record_reader.hpp"
#include "tests/support/source_tree.hpp"

using namespace dualdamp;

namespace {

std::string read_text(const std::string& path) {
  std::ifstream file(path);
  REQUIRE(file.good());
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// What stands between the first `open` and the next `close`; empty when `open` is not there.
std::string between(const std::string& page, const std::string& open, const std::string& close) {
  const std::size_t at = page.find(open);
  if (at == std::string::npos) return {};
  const std::size_t begin = at + open.size();
  return page.substr(begin, page.find(close, begin) - begin);
}

/// The value of `--name "1 kg"` in the page's command, SI; unknown when it is not there.
double option(const std::string& page, const std::string& name, const std::string& unit) {
  const std::string text = between(page, "--" + name + " \"", "\"");
  return text.empty() ? identify::unknown : core::parse_quantity(text, unit).value.value();
}

/// A printed number and half a unit of its last digit.
struct Printed {
  double value = 0.0;
  double rounding = 0.0;
};

Printed printed(const std::string& text) {
  const std::size_t point = text.find('.');
  const auto decimals = point == std::string::npos ? 0.0 : static_cast<double>(text.size() - point - 1);
  return {std::stod(text), 0.5000001 * std::pow(10.0, -decimals)};
}

}  // namespace

TEST_CASE("The examples of the method pages give the printed numbers") {
  for (const identify::MethodEntry& method : identify::methods()) {
    const std::string name(method.name);
    CAPTURE(name);
    const std::string page = read_text(dualdamp::testing::in_tree("docs/methods/" + name + ".md"));
    const std::string csv = between(page, "```csv\n", "```");
    if (csv.empty()) {
      // Histories are too long for a page: there a scenario measures, and expects the printed numbers.
      CHECK(page.find("scenarios/examples/") != std::string::npos);
      continue;
    }
    CHECK(page.find("--method " + name) != std::string::npos);
    const identify::Record record = identify::parse_record(csv, name).record;
    const identify::KnownConstants constants{option(page, "mass", "kg"), option(page, "stiffness", "N/m"),
                                             option(page, "frequency", "rad/s")};
    const identify::Estimate estimate = method.run(record, constants, {});
    REQUIRE(estimate.outcome.ok());
    std::istringstream row(between(page, "| zeta | c | F0 |\n|---|---|---|\n|", "\n"));
    for (const double value : {estimate.value.zeta, estimate.value.c, estimate.value.F0}) {
      std::string text;
      std::string bar;
      REQUIRE(row >> text >> bar);
      const Printed number = printed(text);
      CHECK(std::abs(value - number.value) <= number.rounding);
    }
    // The page says so when its example is not to be used.
    CHECK(estimate.usable == (page.find("marked as not usable") == std::string::npos));
  }
}
