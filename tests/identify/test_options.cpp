#include "identify/options.hpp"

#include <catch2/catch.hpp>
#include <limits>
#include <map>
#include <numbers>

#include "identify/methods.hpp"
#include "identify/methods/amplitudes/resonance_two_point.hpp"
#include "identify/methods/histories/acceleration_velocity_displacement.hpp"
#include "tests/identify/records.hpp"

using namespace dualdamp;
using namespace dualdamp::identify;
using namespace dualdamp::identify::testing;

TEST_CASE("An option of several methods is one declaration") {
  std::map<std::string_view, const Option*> by_name;
  for (const MethodEntry& method : methods())
    for (const Option* option : method.options()) {
      CAPTURE(method.name, option->name);
      CHECK(by_name.try_emplace(option->name, option).first->second == option);
      CHECK_FALSE(option->meaning.empty());
      CHECK((option->kind == OptionKind::flag) == option->otherwise.empty());
    }
  CHECK(by_name.size() == options().size());
}

TEST_CASE("A method takes its own options, in its own units, and no other") {
  const OptionValues values = {{"pairs", std::vector<int>{1, 4}}, {"approximate_G", true}, {"sigma_x", 2e-4}};
  const auto taken = taken_from<TwoPointOptions>(values);
  CHECK(taken.pairs == std::vector<int>{1, 4});
  CHECK(taken.approximate_G);
  CHECK(taken.sigma_x == 2e-4);
  CHECK(taken.sigma_Y == 0.0);
  const OptionValues cutoffs = {{"cutoffs", std::vector<double>{2.0 * std::numbers::pi * 50.0}}};
  CHECK(taken_from<RegressionOptions>(cutoffs).cutoffs == std::vector<double>{50.0});

  const MethodEntry& deming = *find_method("resonance_deming");
  CHECK(deming.own(values) == OptionValues{{"approximate_G", true}, {"sigma_x", 2e-4}});
  CHECK_THROWS_AS(static_cast<void>(deming.run(pairs(table_1), table_1_constants, values)), core::InputError);
}

TEST_CASE("Values of options are checked against their declaration") {
  const auto faults = [](const std::string& name, OptionValue value) {
    return faults_of({{name, std::move(value)}}, options()).size();
  };
  CHECK(faults("sigma_x", 1e-4) == 0);
  CHECK(faults("sigma_x", -1e-4) == 1);
  CHECK(faults("sigma_x", std::numeric_limits<double>::quiet_NaN()) == 1);
  CHECK(faults("sigma_x", true) == 1);
  CHECK(faults("forgetting", 0.0) == 1);
  CHECK(faults("forgetting", 1.0) == 0);
  CHECK(faults("pairs", std::vector<int>{1}) == 1);
  CHECK(faults("cutoffs", std::vector<double>(16, 1.0)) == 0);  // as many as it may hold
  CHECK(faults("cutoffs", std::vector<double>(17, 1.0)) == 1);
  CHECK(faults("bootstrap", 2'000'000) == 1);
  CHECK(faults("sigma_z", 1.0) == 1);
  CHECK(faults("without", std::vector<std::string>{"lugre", "dahl"}) == 0);
  CHECK(faults("without", std::vector<std::string>{"base_gain"}) == 1);  // no law
  CHECK(faults("without", std::vector<std::string>{}) == 1);
  CHECK(faults("without", std::vector<std::string>(64, "dahl")) == 0);
  CHECK(faults("without", std::vector<std::string>(65, "dahl")) == 1);
  CHECK(faults("without", 1.0) == 1);
}
