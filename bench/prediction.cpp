#include "bench/prediction.hpp"

#include <algorithm>
#include <cmath>

#include "identify/statistics/median.hpp"
#include "sim/analytic/den_hartog.hpp"
#include "sim/orbits/steady_state.hpp"

namespace dualdamp::bench {

namespace {

/// x of Coulomb + viscous friction [m], by the closed form where it holds; NaN without a steady state.
double amplitude_of(Truth estimate, const UnmeasuredTest& test) {
  const sim::Oscillator& oscillator = estimate.model.oscillator;
  const bool has_closed_form = oscillator.damping > 0.0 && oscillator.damper_to == sim::DamperTo::ground &&
                               sim::is_linear(oscillator) && estimate.model.excitation.harmonics.empty();
  if (has_closed_form) {
    const sim::analytic::DenHartog functions = sim::analytic::den_hartog(
        sim::damping_ratio(oscillator), test.frequency / sim::natural_frequency(oscillator));
    if (const auto state = sim::analytic::non_sticking_state(functions, test.Y, estimate.F0 / oscillator.stiffness))
      return state->amplitude;
  }
  estimate.model.excitation.amplitude = test.Y;
  estimate.model.excitation.frequency = test.frequency;
  const sim::SteadyState state = sim::steady_state(undisturbed(estimate), {.detail = sim::OrbitDetail::extremes});
  return state.outcome.ok() ? state.amplitude : not_stated;
}

}  // namespace

UnmeasuredTests unmeasured_tests(const ExcitationRange& range, const TrueRig& rig) {
  constexpr double further = 1.5;
  constexpr double below = 0.9;
  const std::vector<double> frequencies = range.frequencies_or(rig.frequency);
  return {{{further * std::ranges::max(range.amplitudes), identify::upper_median(frequencies)},
           {identify::upper_median(range.amplitudes), below * std::ranges::min(frequencies)}}};
}

double prediction_error(const CaseAnswer& answer, const Truth& believed, const UnmeasuredTests& tests,
                        const UnmeasuredAmplitudes& truth) {
  // A motion at resonance with less would not settle in any time, and its prediction is wrong at any rate.
  constexpr double least_zeta = 1e-6;
  Truth estimate = believed;
  sim::Oscillator& oscillator = estimate.model.oscillator;
  oscillator.damping =
      identify::critical_damping(oscillator.mass, oscillator.stiffness) * std::max(answer.zeta, least_zeta);
  estimate.F0 = std::max(answer.F0, 0.0);
  double sum = 0.0;
  for (std::size_t i = 0; i < tests.size(); ++i) {
    if (std::isnan(truth[i])) return not_stated;
    double error = 1.0;
    if (answer.is_given()) {
      const double x = amplitude_of(estimate, tests[i]);
      if (!std::isnan(x)) error = std::min(std::abs(x / truth[i] - 1.0), 1.0);
    }
    sum += error;
  }
  return sum / static_cast<double>(tests.size());
}

}  // namespace dualdamp::bench
