#include "identify/experiments/drive_values.hpp"

#include <cmath>
#include <memory>

#include "sim/engine/drive.hpp"
#include "sim/sampled_signal.hpp"

namespace dualdamp::identify {

namespace {

/// Angle from t = 0 to `t` [rad].
double turned(const sim::Chirp& chirp, double t) {
  if (chirp.law == sim::ChirpLaw::linear)
    return t * (chirp.from + 0.5 * (chirp.to - chirp.from) * t / chirp.duration);
  const double growth = std::log(chirp.to / chirp.from) / chirp.duration;
  return growth == 0.0 ? chirp.from * t : chirp.from * std::expm1(growth * t) / growth;
}

double frequency_at(const sim::Chirp& chirp, double t) {
  const double share = t / chirp.duration;
  if (chirp.law == sim::ChirpLaw::linear) return chirp.from + (chirp.to - chirp.from) * share;
  return chirp.from * std::pow(chirp.to / chirp.from, share);
}

}  // namespace

sim::Excitation drive_from(const sim::Excitation& drive, double start, double duration) {
  sim::Excitation there = drive;
  if (start == 0.0) return there;
  if (drive.is_harmonic()) {
    there.phase += drive.frequency * start;
    for (sim::Harmonic& harmonic : there.harmonics) harmonic.phase += harmonic.order * drive.frequency * start;
  } else if (drive.is_chirp()) {
    there.phase += turned(drive.chirp, start);
    there.chirp.from = frequency_at(drive.chirp, start);
    there.chirp.duration -= start;
  } else if (drive.is_ramp()) {
    // A ramp begins at zero; this one does not.
    there = {.type = drive.moves_base() ? sim::ExcitationType::base_samples : sim::ExcitationType::force_samples,
             .samples = std::make_shared<sim::SampledSignal>(
                 std::vector{0.0, duration}, std::vector{drive.slope * start, drive.slope * (start + duration)},
                 sim::Interpolation::linear)};
  }
  return there;
}

DriveValues drive_values(const sim::Model& model, const std::vector<double>& times) {
  sim::Drive drive(model.oscillator, model.excitation);
  DriveValues values;
  for (const double t : times) {
    if (drive.has_pieces())
      while (drive.begin_of(drive.piece()) + drive.period() <= t) drive.enter(drive.piece() + 1);
    const sim::Drive::Value value = drive.at(drive.has_pieces() ? t - drive.begin_of(drive.piece()) : t);
    values.y.push_back(value.y);
    values.y_rate.push_back(value.y_rate);
    values.force.push_back(value.external);
  }
  return values;
}

}  // namespace dualdamp::identify
