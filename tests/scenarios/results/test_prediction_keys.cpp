#include "scenarios/results/prediction_keys.hpp"

#include <catch2/catch.hpp>

using dualdamp::scenarios::Json;
using dualdamp::scenarios::prediction_keys;

namespace {

Json fit_of(const std::vector<std::string>& names, const Json& covariance, const Json& undetermined) {
  Json parameters = Json::array();
  for (const std::string& name : names) parameters.push_back({{"name", name}});
  return {{"parameters", parameters}, {"covariance", covariance}, {"undetermined", undetermined}};
}

}  // namespace

TEST_CASE("A prediction takes the parameters that records share, with their rows of the covariance",
          "[scenarios]") {
  const Json fit = fit_of({"mass", "offset[2]", "kinetic"}, {{1.0, 2.0, 3.0}, {2.0, 4.0, 5.0}, {3.0, 5.0, 6.0}},
                          {{0.5, 0.25, -1.0}});
  const Json keys = prediction_keys(fit);
  CHECK(keys == Json({{"type", "predict"},
                      {"zeros", Json::array({"offset"})},
                      {"free", {"mass", "kinetic"}},
                      {"covariance", {1.0, 3.0, 3.0, 6.0}},
                      {"undetermined", {0.5, -1.0}}}));
}

TEST_CASE("A prediction by a fit of single records alone states their zeros and nothing else", "[scenarios]") {
  CHECK(prediction_keys(fit_of({"velocity", "offset_v[1]"}, {{1.0, 0.0}, {0.0, 1.0}}, Json::array())) ==
        Json({{"type", "predict"}, {"zeros", Json::array({"offset_v"})}}));
}

TEST_CASE("A prediction takes the marks of the fitted readings", "[scenarios]") {
  Json fit = fit_of({"velocity"}, {{1.0}}, Json::array());
  fit["fitted_readings"] = {3.0, 0.1, 0.2, 0.3};
  CHECK(prediction_keys(fit) == Json({{"type", "predict"}, {"fitted_readings", {3.0, 0.1, 0.2, 0.3}}}));
}

TEST_CASE("A damaged fit gives no keys of a prediction", "[scenarios]") {
  CHECK_THROWS_AS(prediction_keys(fit_of({"mass"}, {{nullptr}}, Json::array())), Json::exception);
  CHECK_THROWS_AS(prediction_keys(fit_of({"mass", "kinetic"}, {{1.0}}, Json::array())), Json::exception);
  CHECK_THROWS_AS(prediction_keys(Json::object()), Json::exception);
}
