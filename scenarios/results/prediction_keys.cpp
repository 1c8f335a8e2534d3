#include "scenarios/results/prediction_keys.hpp"

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "identify/experiments/rig.hpp"

namespace dualdamp::scenarios {

namespace {

/// Whether a name, such as `offset[2]`, is that of a parameter of one record.
bool is_of_one_record(const std::string& name) {
  return identify::find_record_parameter(name.substr(0, name.find('['))).has_value();
}

/// The zeros of sensors among the parameters, each once.
Json zeros_among(const Json& parameters) {
  Json zeros = Json::array();
  for (const Json& parameter : parameters) {
    const auto name = parameter.at("name").get<std::string>();
    const std::string zero = name.substr(0, name.find('['));
    if (zero.starts_with("offset") && is_of_one_record(name) && std::ranges::find(zeros, Json(zero)) == zeros.end())
      zeros.push_back(zero);
  }
  return zeros;
}

}  // namespace

Json prediction_keys(const Json& result) {
  Json names = Json::array();
  std::vector<std::size_t> shared;
  const Json& parameters = result.at("parameters");
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const auto name = parameters.at(i).at("name").get<std::string>();
    if (is_of_one_record(name)) continue;
    names.push_back(name);
    shared.push_back(i);
  }
  Json keys = {{"type", "predict"}};
  const Json marks = result.value("fitted_readings", Json::array());
  if (!marks.empty()) keys["fitted_readings"] = marks;
  if (Json zeros = zeros_among(parameters); !zeros.empty()) keys["zeros"] = std::move(zeros);
  if (shared.empty()) return keys;
  const auto add_shared = [&shared](const Json& row, Json& list) {
    for (const std::size_t j : shared) list.push_back(row.at(j).get<double>());
  };
  keys["free"] = std::move(names);
  keys["covariance"] = Json::array();
  for (const std::size_t i : shared) add_shared(result.at("covariance").at(i), keys["covariance"]);
  Json undetermined = Json::array();
  for (const Json& row : result.value("undetermined", Json::array())) add_shared(row, undetermined);
  if (!undetermined.empty()) keys["undetermined"] = std::move(undetermined);
  return keys;
}

}  // namespace dualdamp::scenarios
