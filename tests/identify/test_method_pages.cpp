// The examples of docs/methods/*.md give the numbers printed there.

#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>

#include "core/units.hpp"
#include "identify/csv_reader.hpp"
#include "identify/methods.hpp"

using namespace dualdamp;

namespace {

std::string read_text(const std::string& path) {
  std::ifstream file(path);
  REQUIRE(file.good());
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// The text between the first line "```csv" and the next "```".
std::string csv_block(const std::string& page) {
  const std::string open = "```csv\n";
  const std::size_t begin = page.find(open);
  REQUIRE(begin != std::string::npos);
  return page.substr(begin + open.size(), page.find("```", begin + open.size()) - begin - open.size());
}

/// The value of `--option "1 kg"` in the page's command, SI.
double option(const std::string& page, const std::string& name, const std::string& unit) {
  std::smatch match;
  if (!std::regex_search(page, match, std::regex("--" + name + " \"([^\"]+)\""))) return 0.0;
  return core::parse_quantity(match[1].str(), unit).value.value();
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
    const std::string page = read_text(std::string(DUALDAMP_SOURCE_DIR) + "/docs/methods/" + name + ".md");
    CHECK(page.find("--method " + name) != std::string::npos);
    const identify::Record record = identify::parse_csv(csv_block(page), name).record;
    const identify::KnownConstants constants{option(page, "mass", "kg"), option(page, "stiffness", "N/m"),
                                             option(page, "frequency", "rad/s")};
    const identify::Estimate estimate = method.run(record, constants, {});
    REQUIRE(estimate.outcome.ok());
    std::smatch row;
    REQUIRE(std::regex_search(
        page, row, std::regex(R"(\| zeta \| c \| F0 \|\n[-| ]+\n\| ([\d.]+) \| ([\d.]+) \| ([\d.]+) \|)")));
    const double values[] = {estimate.value.zeta, estimate.value.c, estimate.value.F0};
    for (std::size_t i = 0; i < 3; ++i) {
      const Printed number = printed(row[i + 1].str());
      CHECK(std::abs(values[i] - number.value) <= number.rounding);
    }
    // The page says so when its example is not to be used.
    CHECK(estimate.usable == (page.find("marked as not usable") == std::string::npos));
  }
}
