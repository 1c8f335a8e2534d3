#include "bench/speed/sampled_drive.hpp"

#include <cmath>
#include <ctime>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

#include "core/constants.hpp"
#include "friction_models/laws/coulomb.hpp"
#include "sim/motion/simulate.hpp"

namespace dualdamp::bench::speed {

double seconds_for_sampled_drive(const StandardCase& work, int count, sim::Interpolation interpolation) {
  const double step = core::two_pi / (628.0 * work.frequency);
  std::vector<double> times;
  std::vector<double> values;
  for (int i = 0; i < count; ++i) {
    times.push_back(i * step);
    values.push_back(work.base_amplitude * std::cos(work.frequency * times.back()));
  }
  const double duration = times.back();
  const std::clock_t start = std::clock();
  sim::Model model;
  model.oscillator = {.mass = work.mass, .stiffness = work.stiffness, .damping = work.damping};
  model.excitation = {
      .type = sim::ExcitationType::base_samples,
      .samples = std::make_shared<sim::SampledSignal>(std::move(times), std::move(values), interpolation)};
  model.friction.emplace_back(friction::Coulomb(work.friction, work.friction));
  const sim::History history = sim::simulate(model, {.duration = duration});
  const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  // Two reversals a period, except in the first period, which starts from rest.
  const auto reversals = static_cast<double>(history.events.size());
  if (!history.outcome.ok() || history.certificate.searches < count - 1 ||
      std::abs(reversals - 2.0 * count / 628.0) > 2.0)
    throw std::runtime_error("the motion under a sampled drive is not what it should be");
  return seconds;
}

}  // namespace dualdamp::bench::speed
