#include <algorithm>
#include <string>
#include <vector>

#include "core/numbers.hpp"
#include "scenarios/checks_of_analyses.hpp"
#include "scenarios/formulas.hpp"
#include "scenarios/mechanism_study.hpp"

namespace dualdamp::scenarios {

namespace {

/// Parts that differ, each of two levels at least.
void check_shares(CheckedFile& file, std::size_t levels) {
  std::vector<std::size_t> parts;
  const Json& estimates = file.values().at("analysis").at("estimates");
  for (std::size_t i = 0; i < estimates.size(); ++i) {
    if (!estimates.at(i).contains("share")) continue;
    const std::size_t part = part_of(levels, number(estimates.at(i).at("share")));
    const std::string path = "analysis.estimates[" + std::to_string(i) + "].share";
    if (part < 2) {
      const double least = 2.0 / static_cast<double>(levels);
      file.complain(path, "a line needs two levels", "at least " + core::format_number(least, 3));
    } else if (std::ranges::find(parts, part) != parts.end()) {
      file.complain(path, "there are two estimates from " + std::to_string(part) + " levels", "distinct parts");
    }
    parts.push_back(part);
  }
}

void check_parts(CheckedFile& file) {
  const Json& analysis = file.values().at("analysis");
  const bool known = analysis.contains("amplitudes");
  if (!known && !analysis.contains("levels")) return;
  const std::size_t levels =
      known ? grid_size(analysis.at("amplitudes")) : analysis.at("levels").get<std::size_t>();
  check_shares(file, levels);
  const std::size_t sought = levels + (known ? 0 : 2);
  const std::size_t count = analysis.at("estimates").size();
  if (2 * count < sought)
    file.complain("analysis.estimates", "the estimates are too few to tell the levels behind them",
                  "zeta and F0 of " + std::to_string((sought + 1) / 2) + " parts", std::to_string(count));
}

/// What is known of the mechanisms that the file says nothing about.
void complete_plausible(Json& analysis) {
  Json list = analysis.value("plausible", Json::array());
  const std::size_t given = list.size();
  for (const Json& name : analysis.at("mechanisms")) {
    const auto is_it = [&](const Json& item) { return item.at("mechanism") == name; };
    if (std::any_of(list.begin(), list.begin() + static_cast<std::ptrdiff_t>(given), is_it)) continue;
    const sim::Mechanism* mechanism = sim::find_mechanism(name.get<std::string>());
    for (const sim::PlausibleValues& plausible : mechanism->plausible) {
      Json item = {{"mechanism", name}, {"case", plausible.name}, {"because", plausible.because}};
      for (std::size_t i = 0; i < plausible.values.size(); ++i)
        item[std::string(mechanism->parameters[i].name)] = plausible.values[i];
      list.push_back(std::move(item));
    }
  }
  analysis["plausible"] = std::move(list);
}

}  // namespace

void check_mechanisms(CheckedFile& file) {
  check_truth(file);
  Json& analysis = file.values()["analysis"];
  if (analysis.contains("estimates")) check_parts(file);
  if (!file.stands_in_file("analysis", "mechanisms")) {
    Json all = Json::array();
    for (const sim::Mechanism& mechanism : sim::mechanisms()) all.push_back(mechanism.name);
    analysis["mechanisms"] = std::move(all);
  }
  if (!analysis.contains("mechanisms")) return;
  complete_plausible(analysis);
  put_in_order(analysis, analyses().find(file.analysis())->section);
}

}  // namespace dualdamp::scenarios
