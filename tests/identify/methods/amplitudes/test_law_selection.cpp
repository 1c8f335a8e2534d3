#include "identify/methods/amplitudes/law_selection.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "friction_models/laws/coulomb.hpp"
#include "friction_models/laws/stribeck.hpp"
#include "friction_models/laws/viscous_power.hpp"
#include "friction_models/laws/viscous_saturating.hpp"
#include "sim/analytic/den_hartog.hpp"
#include "sim/curves/curves.hpp"
#include "tests/identify/methods/histories/bearing.hpp"
#include "tests/identify/records.hpp"

using namespace dualdamp;
using namespace dualdamp::identify;
using namespace dualdamp::identify::testing;
namespace analytic = dualdamp::sim::analytic;

namespace {

Record exact_pairs_at_resonance(double zeta, double x_f, const std::vector<double>& levels, double sigma,
                                Normal& normal) {
  std::vector<std::pair<double, double>> list;
  for (const double Y : levels)
    list.emplace_back(Y, analytic::amplitude(analytic::den_hartog(zeta, 1.0), Y, x_f).value() + sigma * normal());
  return pairs(list);
}

/// Pairs of the motion itself, at resonance or beside it.
std::vector<std::pair<double, double>> simulate(sim::Model model, const std::vector<double>& inputs,
                                                double r = 1.0) {
  model.oscillator.mass = mass;
  model.oscillator.stiffness = stiffness;
  model.excitation.type = sim::ExcitationType::base_harmonic;
  model.excitation.frequency = r * natural;
  std::vector<std::pair<double, double>> list;
  for (const sim::CurvePoint& point : sim::xy_curve(model, inputs).points) {
    REQUIRE(point.ok());
    list.emplace_back(point.Y, point.x);
  }
  return list;
}

const LawCandidate& candidate_named(const Estimate& estimate, const std::string& law) {
  const auto found = std::ranges::find(estimate.candidates, law, &LawCandidate::law);
  REQUIRE(found != estimate.candidates.end());
  return *found;
}

double parameter(const LawCandidate& candidate, const std::string& name) {
  const auto found = std::ranges::find(candidate.parameters, name, &FurtherParameter::name);
  REQUIRE(found != candidate.parameters.end());
  return found->value;
}

bool any_mentions(const std::vector<std::string>& list, const std::string& words) {
  return std::ranges::any_of(list, [&](const std::string& text) { return text.find(words) != std::string::npos; });
}

}  // namespace

TEST_CASE("The five reconstructed pairs: Coulomb + viscous is rejected at 1 %, saturating viscous ranks first") {
  const Estimate e = law_selection(pairs(subset_trend), soft_spring, {});
  REQUIRE(e.outcome.ok());
  CHECK_FALSE(e.usable);
  REQUIRE(e.lack_of_fit.has_value());
  CHECK(e.lack_of_fit->p_value < 0.01);
  CHECK(e.lack_of_fit->freedom == 2);
  REQUIRE(e.candidates.size() == 5);  // three parameters at most from five levels: no Stribeck law
  CHECK(e.candidates.front().law == "viscous_saturating");
  CHECK(e.candidates.back().law == "coulomb_viscous");
  CHECK(std::isinf(e.candidates.front().AICc));  // 5 pairs, 3 parameters and the variance
  CHECK(e.reason.find("viscous_saturating ranks first") != std::string::npos);
  CHECK(any_mentions(e.warnings, "cannot show which mechanism"));
  // At one frequency a law of position is a law of velocity.
  CHECK(candidate_named(e, "position_quadratic").BIC ==
        Approx(candidate_named(e, "quadratic_drag").BIC).epsilon(1e-9));
  double sum = 0.0;
  for (const LawCandidate& candidate : e.candidates) sum += candidate.weight;
  CHECK(sum == Approx(1.0));

  // The motion under the law that ranks first goes through the pairs within 0.6 %, its line through all of them by
  // 10 %.
  sim::Model model;
  const LawCandidate& best = e.candidates.front();
  model.friction.emplace_back(friction::Coulomb(parameter(best, "F0"), parameter(best, "F0")));
  model.friction.emplace_back(friction::ViscousSaturating(parameter(best, "c"), parameter(best, "v0")));
  std::vector<double> inputs;
  for (const auto& [Y, x] : subset_trend) inputs.push_back(Y);
  const auto motion = simulate(model, inputs);
  for (std::size_t i = 0; i < motion.size(); ++i)
    CHECK(motion[i].second == Approx(subset_trend[i].second).epsilon(0.01));
}

TEST_CASE("Exact Coulomb + viscous pairs are Coulomb + viscous") {
  Normal none(1);
  const Estimate e =
      law_selection(exact_pairs_at_resonance(0.12, 2.36e-3, spaced(4.4e-3, 7e-3, 8), 0.0, none), at_resonance, {});
  REQUIRE(e.outcome.ok());
  CHECK(e.usable);
  CHECK(e.candidates.front().law == "coulomb_viscous");
  CHECK(e.candidates.size() == 6);
  CHECK_FALSE(any_mentions(e.warnings, "mechanism"));
  CHECK(e.value.zeta == Approx(0.12).epsilon(1e-9));
  CHECK(e.value.x_f == Approx(2.36e-3).epsilon(1e-9));
  CHECK(parameter(e.candidates.front(), "F0") == Approx(stiffness * 2.36e-3).epsilon(1e-8));
  CHECK(e.reason.find("ranked by AICc") != std::string::npos);
}

TEST_CASE("Noise alone rejects Coulomb + viscous friction no more often than the level") {
  // 400 samples know a rate of 5 % to 1.1 %; the p value times the number of laws is an upper bound.
  Normal normal(81);
  int fired = 0, first = 0;
  constexpr int samples = 400;
  for (int i = 0; i < samples; ++i) {
    const Estimate e = law_selection(
        exact_pairs_at_resonance(0.12, 2.36e-3, spaced(4.4e-3, 7e-3, 10), 0.05e-3, normal), at_resonance, {});
    REQUIRE(e.outcome.ok());
    fired += e.lack_of_fit->fired;
    first += e.candidates.front().law == "coulomb_viscous";
  }
  CHECK(fired / double(samples) < 0.08);
  CHECK(first / double(samples) > 0.8);
}

TEST_CASE("Laws are recovered from the motion they make") {
  const std::vector<double> inputs = spaced(4.0e-3, 7.0e-3, 10);
  sim::Model saturating;
  saturating.friction.emplace_back(friction::Coulomb(3.16, 3.16));
  saturating.friction.emplace_back(friction::ViscousSaturating(18.7, 0.69));
  const Estimate e = law_selection(pairs(simulate(saturating, inputs)), at_resonance, {});
  REQUIRE(e.outcome.ok());
  CHECK_FALSE(e.usable);
  const LawCandidate& best = e.candidates.front();
  CHECK(best.law == "viscous_saturating");
  // What harmonic balance leaves is taken out at the fit of another law: some percent remain.
  CHECK(parameter(best, "F0") == Approx(3.16).epsilon(0.05));
  CHECK(parameter(best, "c") == Approx(18.7).epsilon(0.08));
  CHECK(parameter(best, "v0") == Approx(0.69).epsilon(0.15));
  const auto curve = std::ranges::find(e.curves, "friction_velocity", &EstimateCurve::name);
  REQUIRE(curve != e.curves.end());
  REQUIRE(curve->columns.size() == 3);
  for (std::size_t i = 10; i < 50; ++i) {
    const double v = curve->columns[0].values[i];
    CHECK(curve->columns[2].values[i] == Approx(3.16 + 18.7 * v / (1.0 + v / 0.69)).epsilon(0.03));
  }

  sim::Model stribeck;
  stribeck.oscillator.damping = 11.0;
  stribeck.friction.emplace_back(friction::Stribeck(friction::StribeckCurve(3.0, 5.0, 0.2)));
  const Estimate s = law_selection(pairs(simulate(stribeck, inputs)), at_resonance, {});
  REQUIRE(s.outcome.ok());
  CHECK(s.candidates.front().law == "stribeck");
  CHECK(parameter(s.candidates.front(), "c") == Approx(11.0).epsilon(0.1));
}

TEST_CASE("A second frequency tells position from velocity") {
  // Drag 10 N.s^2/m^2 beside Coulomb + viscous friction, at resonance and 15 % below it: the same law of position
  // would have to change by 1 - 0.85^2 = 28 % between them.
  sim::Model model;
  model.oscillator.damping = 6.0;
  model.friction.emplace_back(friction::Coulomb(2.0, 2.0));
  model.friction.emplace_back(friction::ViscousPower(10.0, 1.0, 2.0));
  PairRecord record;
  for (const double r : {0.85, 1.0})
    for (const auto& [Y, x] : simulate(model, spaced(4e-3, 9e-3, 6), r))
      record.pairs.push_back(
          {.Y = Y, .x = x, .sweep = {}, .number = static_cast<int>(record.pairs.size()) + 1, .omega = r * natural});
  const Estimate e = law_selection({record, std::nullopt}, at_resonance, {});
  REQUIRE(e.outcome.ok());
  CHECK(e.candidates.front().law == "quadratic_drag");
  CHECK(candidate_named(e, "position_quadratic").BIC > e.candidates.front().BIC + 2.0);
  CHECK_NOTHROW(candidate_named(e, "position_linear"));
}

TEST_CASE("Sweeps whose residuals go together count for fewer pairs") {
  // Ten sweeps of five levels; each has a friction of its own, so a sweep's residuals have one sign.
  Normal normal(83);
  PairRecord record;
  for (int j = 0; j < 10; ++j) {
    const double x_f = 2.3e-3 + 0.1e-3 * normal();
    for (const double Y : spaced(4.5e-3, 7e-3, 5))
      record.pairs.push_back({.Y = Y,
                              .x = analytic::amplitude(analytic::den_hartog(0.12, 1.0), Y, x_f).value(),
                              .sweep = std::to_string(j),
                              .number = static_cast<int>(record.pairs.size()) + 1});
  }
  const Estimate swept = law_selection({record, std::nullopt}, at_resonance, {});
  for (Pair& pair : record.pairs) pair.sweep.clear();
  const Estimate single = law_selection({record, std::nullopt}, at_resonance, {});
  REQUIRE(swept.outcome.ok());
  // The penalty of one parameter, 2 K + 2 K (K + 1)/(N - K - 1), grows as N falls to about ten.
  const auto penalty = [](const Estimate& e) {
    return candidate_named(e, "quadratic_drag").AICc - candidate_named(e, "coulomb_viscous").AICc;
  };
  CHECK(penalty(swept) > penalty(single) + 1.0);
}

TEST_CASE("Records that allow no comparison of laws are refused with the reason") {
  CHECK(law_selection(Record{}, at_resonance, {}).reason == "the record holds no x-Y pairs");
  Normal none(1);
  CHECK(law_selection(exact_pairs_at_resonance(0.12, 2.36e-3, spaced(4.4e-3, 7e-3, 3), 0.0, none), at_resonance, {})
            .reason == "four levels are needed to compare laws, and the record has 3");
}
