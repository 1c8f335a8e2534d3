#include <string>

#include "bench/speed/contender.hpp"
#include "sim/batch/batch.hpp"

namespace dualdamp::bench::speed {
namespace {

constexpr int oscillators = 64;

sim::OscillatorBatch batch_of(const StandardCase& work) {
  sim::OscillatorBatch batch;
  for (int i = 0; i < oscillators; ++i) {
    const double friction = work.friction * (1.0 - 0.1 * i / oscillators);
    batch.mass.push_back(work.mass);
    batch.damping.push_back(work.damping);
    batch.stiffness.push_back(work.stiffness);
    batch.kinetic.push_back(friction);
    batch.static_level.push_back(friction);
    batch.amplitude.push_back(work.base_amplitude);
    batch.frequency.push_back(work.frequency);
  }
  return batch;
}

}  // namespace

std::vector<Contender> batch_contenders(const StandardCase& work) {
  std::vector<Contender> contenders;
  for (const int width : sim::batch_widths()) {
    const auto integrate = [batch = batch_of(work), x = work.start_position, v = work.start_velocity,
                            width](int periods) {
      sim::BatchMotions motions{.position = std::vector<double>(batch.size(), x),
                                .velocity = std::vector<double>(batch.size(), v)};
      sim::pass_periods(batch, periods, motions, {.width = width, .threads = 1});
      return IntegratedMotion{motions.amplitude[0], motions.reversals[0]};
    };
    contenders.push_back({"dualdamp, batches of " + std::to_string(width), 0.0, oscillators, integrate});
  }
  return contenders;
}

}  // namespace dualdamp::bench::speed
