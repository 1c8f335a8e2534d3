#include "friction_models/laws/coulomb.hpp"

#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "friction_models/registry.hpp"
#include "sim/conformance/law_conformance.hpp"

using namespace dualdamp;
using friction::Coulomb;
using friction::Direction;

TEST_CASE("coulomb conforms to the law contract", "[friction][coulomb]") {
  const std::vector<std::string> none;
  CHECK(sim::nonconformities(sim::law_case("coulomb", {{"kinetic", 2.0}})) == none);
  CHECK(sim::nonconformities(sim::law_case("coulomb", {{"kinetic", 2.0}, {"static", 3.5}})) == none);
  CHECK(sim::nonconformities(sim::law_case("coulomb", {{"kinetic", 0.0}})) == none);
}

TEST_CASE("coulomb is kinetic sgn v while slipping and holds up to static", "[friction][coulomb]") {
  const friction::Law law(Coulomb(2.0, 3.5));
  for (const friction::Instant& now : {friction::Instant{0.0, 0.0, 0.0}, {10.0, -3.0, 1e-9}, {0.1, 5.0, -100.0}}) {
    CHECK(law.force({}, now, Direction::forward) == 2.0);
    CHECK(law.force({}, now, Direction::backward) == -2.0);
    CHECK(law.static_limit({}, now) == 3.5);
  }
}

TEST_CASE("coulomb has the abilities it claims and no others", "[friction][coulomb]") {
  const friction::Law law(Coulomb(2.0, 2.0));
  CHECK(law.is_affine());
  CHECK(law.holds_mass());
  CHECK_FALSE(law.has_memory());
  CHECK_FALSE(law.has_rates());
}

TEST_CASE("coulomb's static level defaults to the kinetic one and may not lie below it", "[friction][coulomb]") {
  friction::ParameterValues values = {{"kinetic", 2.0}};
  REQUIRE(friction::complete(Coulomb::parameters(), values).empty());
  CHECK(values.number("static") == 2.0);
  friction::ParameterValues below = {{"kinetic", 2.0}, {"static", 1.999}};
  const auto faults = friction::complete(Coulomb::parameters(), below);
  REQUIRE(faults.size() == 1);
  CHECK(faults[0].name == "static");
  CHECK(faults[0].allowed == ">= 2 N");
  CHECK(faults[0].found == "1.999 N");
  friction::ParameterValues equal = {{"kinetic", 2.0}, {"static", 2.0}};
  CHECK(friction::complete(Coulomb::parameters(), equal).empty());
  friction::ParameterValues none = {{"kinetic", 0.0}};
  CHECK(friction::complete(Coulomb::parameters(), none).empty());
}

TEST_CASE("coulomb from the registry is the law with the values given", "[friction][coulomb]") {
  const sim::LawCase c = sim::law_case("coulomb", {{"kinetic", 2.0}, {"static", 3.0}});
  CHECK(c.law.force({}, {}, Direction::forward) == 2.0);
  CHECK(c.law.static_limit({}, {}) == 3.0);
}
