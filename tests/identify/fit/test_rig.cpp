#include "identify/fit/rig.hpp"

#include <algorithm>
#include <catch2/catch.hpp>

#include "friction_models/registry.hpp"
#include "tests/identify/fit/synthetic.hpp"

using namespace dualdamp;

TEST_CASE("rig: a number that is neither stated nor sought goes on following the number of its default",
          "[identify][fit]") {
  // Left at 1 N, the static level would refuse every kinetic level above it.
  for (const auto& [law, leader, follower] : {std::tuple{"coulomb", "kinetic", "static"},
                                              {"asymmetric_coulomb", "kinetic_forward", "static_forward"},
                                              {"asymmetric_coulomb", "viscous_forward", "viscous_backward"}}) {
    CAPTURE(law, follower);
    identify::Rig rig = test::rig_with({.law = law, .truth = {}, .sought = {}});
    if (law == std::string("asymmetric_coulomb"))
      rig.laws.front().values = {{"kinetic_forward", 1.0}, {"kinetic_backward", 1.0}};
    std::string fault;
    const std::vector<identify::FitParameter> sought = identify::named(identify::parameters_of(rig), leader, fault);
    REQUIRE(sought.size() == 1);
    std::optional<identify::Rig> fitted = rig;
    for (const double value : {1.0, 1.3}) {
      fitted = identify::with_values(*fitted, sought, Eigen::VectorXd::Constant(1, value));
      REQUIRE(fitted);
      CHECK(identify::model_of(*fitted));
      CHECK_FALSE(fitted->laws.front().values.has(follower));
    }
  }
}

TEST_CASE("rig: a law's number with the name of a record's is told from it", "[identify][fit]") {
  friction::LawEntry entry = *friction::find_law("coulomb");
  entry.parameters.push_back({.name = "offset", .unit = "N", .fallback = 0.0});
  identify::Rig rig = test::rig_with(test::law_case_of("coulomb"));
  rig.laws.front().entry = &entry;
  std::string fault;
  std::vector<identify::FitParameter> sought = identify::named(identify::parameters_of(rig), "offset", fault);
  identify::arrange(rig, sought);
  REQUIRE(sought.size() == 1);
  CHECK(sought.front().name == "friction.offset");
  CHECK(identify::named(identify::parameters_of(rig), sought.front().name, fault).size() == 1);
}
