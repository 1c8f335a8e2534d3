#include "identify/verdict.hpp"

#include <catch2/catch.hpp>
#include "tests/identify/methods/histories/bearing.hpp"

using namespace dualdamp::identify;
using namespace dualdamp::identify::testing;

namespace {

Estimate estimate(const std::string& method, double zeta, double F0, double spread, bool usable = true) {
  Estimate e;
  e.method = method;
  e.usable = usable;
  e.value = {zeta, 100.0 * zeta, F0 / 1000.0, F0};
  const auto around = [spread](double value) {
    return std::array<double, 2>{value * (1.0 - spread), value * (1.0 + spread)};
  };
  e.interval95 = {around(zeta), around(100.0 * zeta), around(F0 / 1000.0), around(F0)};
  return e;
}

LackOfFit test(double p, bool fired) {
  LackOfFit result;
  result.test = "quadratic friction F-test";
  result.p_value = p;
  result.fired = fired;
  return result;
}

}  // namespace

TEST_CASE("A verdict that nothing contradicts names the numbers and their method") {
  Estimate e = estimate("resonance_least_squares", 0.1, 4.0, 0.01);
  CHECK(mentions(verdict({e}), "cannot tell whether friction is Coulomb + viscous"));
  e.lack_of_fit = test(0.4, false);
  const std::string text = verdict({e});
  CHECK(mentions(text, "do not contradict Coulomb + viscous"));
  CAPTURE(text);
  CHECK(mentions(text, "zeta = 0.1 (95 %: 0.099 to 0.101), F0 = 4 N (95 %: 3.96 to 4.04 N)"));
  CHECK(mentions(text, "by resonance_least_squares"));
}

TEST_CASE("The method that assumes least is preferred, and who disagrees is named") {
  const std::string text =
      verdict({estimate("resonance_least_squares", 0.1, 4.0, 0.01), estimate("den_hartog_fit", 0.12, 4.0, 0.01),
               estimate("jacobsen_ayre", 0.1205, 4.0, 0.01)});
  CHECK(mentions(text, "by den_hartog_fit"));
  CHECK(mentions(text, "resonance_least_squares disagrees"));
  CHECK_FALSE(mentions(text, "jacobsen_ayre disagrees"));
}

TEST_CASE("A rejected law is said first, with the trend and the law that describes the data better") {
  Estimate fit = estimate("resonance_least_squares", 0.1, 4.0, 0.01, false);
  fit.lack_of_fit = test(0.0004, true);
  fit.subsets = {{"5/5", 5, {0.0987, 0.0, 0.0, 4.39}, {}}, {"2/5", 2, {0.142, 0.0, 0.0, 3.69}, {}}};
  Estimate selection = estimate("law_selection", 0.2, 3.0, 0.1);
  selection.candidates = {{"saturating_viscous", {}, 0.0, 1.0, 1.0, 0.97}};
  const std::string text = verdict({estimate("resonance_two_point", 0.1, 4.0, 0.01), fit, selection});
  CHECK(mentions(text, "rejected by these data: resonance_least_squares (quadratic friction F-test, p = 0.0004)"));
  CHECK(mentions(text, "From 5/5 to 2/5 of the data zeta goes from 0.0987 to 0.142 and F0 from 4.39 to 3.69 N"));
  CHECK(mentions(text, "saturating_viscous describes them best (weight 0.97)"));
}

TEST_CASE("Where no method stands by its number, the verdict says why; without estimates it is silent") {
  Estimate e = estimate("free_decay", 0.1, 4.0, 0.01, false);
  e.reason = "the half swings do not last as long as the mass and stiffness say";
  CHECK(mentions(verdict({e}), "No estimate is to be used: free_decay: the half swings"));
  e.outcome = {dualdamp::core::OutcomeKind::not_identifiable, "no data"};
  CHECK(verdict({e}).empty());
  CHECK(verdict({}).empty());
}
