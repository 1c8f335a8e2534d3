// A law has the abilities that it states, and no other; a question about an ability that it lacks has a fixed
// answer.

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "friction_models/formulas/stribeck_curve.hpp"
#include "friction_models/laws/bristle.hpp"
#include "friction_models/laws/contact_compliance.hpp"
#include "friction_models/laws/coulomb.hpp"
#include "friction_models/laws/friction_lag.hpp"
#include "friction_models/laws/lugre.hpp"
#include "friction_models/modifiers/modified.hpp"

namespace {

using namespace dualdamp;
using friction::Direction;
using friction::Instant;
using friction::Law;
using friction::Memory;

/// The names of the abilities, in the order of `Abilities`.
std::vector<std::string> names_of(const Law& law) {
  const friction::Abilities& a = law.abilities();
  std::vector<std::string> names;
  if (a.memory != nullptr) names.emplace_back("memory");
  if (a.sticking != nullptr) names.emplace_back("sticking");
  if (a.affine != nullptr) names.emplace_back("affine");
  if (a.states != nullptr) names.emplace_back("states");
  if (a.advance != nullptr) names.emplace_back("advance");
  if (a.dissipation != nullptr) names.emplace_back("dissipation");
  if (a.delay != nullptr) names.emplace_back("delay");
  if (a.schedule != nullptr) names.emplace_back("schedule");
  if (a.aperiodic != nullptr) names.emplace_back("aperiodic");
  return names;
}

using Names = std::vector<std::string>;

/// A force and nothing else.
class Dashpot final : public friction::LawModel {
 public:
  double force(const Memory&, const Instant& now, Direction) const override { return 3.0 * now.v; }
};

}  // namespace

TEST_CASE("a law has the abilities that its class states", "[friction][law]") {
  const friction::StribeckCurve curve(2.0, 3.0, 0.05);
  CHECK(names_of(Law(friction::Coulomb(2.0, 3.0))) == Names{"sticking", "affine"});
  CHECK(names_of(Law(friction::ContactCompliance(2.0, 3.0, 1e4, 10.0))) ==
        Names{"memory", "affine", "states", "advance", "dissipation"});
  CHECK(names_of(Law(friction::Lugre(curve, {1e4, 20.0, 0.0}))) == Names{"memory", "states", "dissipation"});
  CHECK(names_of(Law(friction::DelayedFriction(curve, 0.02))) == Names{"sticking", "delay"});
  CHECK(names_of(Law(friction::Bristle(500.0, 2e-3, 3, 1))) == Names{"memory", "affine", "aperiodic"});
}

TEST_CASE("a modified law keeps the abilities of its law that the modifiers leave it", "[friction][law]") {
  const Law coulomb(friction::Coulomb(2.0, 3.0));
  CHECK(names_of(friction::modified(coulomb, {{"drift", 0.1}})) ==
        Names{"memory", "sticking", "affine", "dissipation", "schedule", "aperiodic"});
  const friction::ParameterValues warming{{"power", 3.0}, {"time_constant", 1.0}};
  CHECK(names_of(friction::modified(coulomb, {{"warming", std::vector{warming}}})) ==
        Names{"memory", "sticking", "states", "dissipation", "schedule", "aperiodic"});
  const Law delayed(friction::DelayedFriction(friction::StribeckCurve(2.0, 3.0, 0.05), 0.02));
  CHECK(friction::modified(delayed, {{"drift", 0.1}}).delay() == 0.02);
}

TEST_CASE("a law that is a force alone has fixed answers to all other questions", "[friction][law]") {
  const Law law(std::make_shared<const Dashpot>());
  const Instant now{.v = -2.0};
  CHECK(names_of(law).empty());
  CHECK(law.start(now) == Memory{});
  CHECK(law.static_limit({}, now) == 0.0);
  CHECK(law.dissipation({}, now, Direction::backward) == 12.0);
  CHECK(law.delay() == 0.0);
  CHECK(law.next_change({}) == std::numeric_limits<double>::infinity());
  CHECK(law.aperiodic().empty());
  std::vector<double> rates = {1.0};
  CHECK(law.respond({}, now, Direction::backward, rates) == -6.0);
  CHECK(rates == std::vector{0.0});
}

TEST_CASE("the course of the modifiers is no part of what the law inside remembers", "[friction][law]") {
  const friction::ParameterValues noise{{"ratio", 0.4}, {"correlation_time", 1.0}, {"seed", 1.0}};
  const Law law = friction::modified(Law(friction::Coulomb(2.0, 3.0)), {{"fluctuation", std::vector{noise}}});
  Memory memory = law.start({});
  CHECK(memory.indices.empty());
  CHECK(memory.state.empty());
  CHECK(law.force(memory, {}, Direction::forward) == Approx(2.0 * std::fmax(0.0, 1.0 + 0.4 * memory.course.level)));
  const friction::ModifierCourse before = memory.course;
  law.jump(memory, {friction::Trigger::scheduled}, {.t = law.next_change(memory)}, Direction::forward);
  CHECK(memory.course.cell == before.cell + 1);
  CHECK(memory.course.level != before.level);
}
