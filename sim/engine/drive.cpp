#include "sim/engine/drive.hpp"

#include <cmath>
#include <limits>
#include <numbers>

namespace dualdamp::sim {

using core::Complex;

double natural_frequency(const Oscillator& oscillator) { return std::sqrt(oscillator.stiffness / oscillator.mass); }

double damping_ratio(const Oscillator& oscillator) {
  return oscillator.damping / (2.0 * std::sqrt(oscillator.mass * oscillator.stiffness));
}

Drive::Drive(const Oscillator& oscillator, const Excitation& excitation)
    : period_(std::numeric_limits<double>::infinity()), base_(excitation.moves_base()) {
  if (base_) {
    through_spring_ = oscillator.stiffness;
    through_damper_ = oscillator.damper_to == DamperTo::base ? oscillator.damping : 0.0;
  }
  if (excitation.is_harmonic()) {
    const auto add = [&](int order, double amplitude, double phase) {
      const double frequency = order * excitation.frequency;
      frequencies_.push_back(frequency);
      amplitudes_.push_back(std::polar(amplitude, phase));
      force_.push_back(Complex(through_spring_, through_damper_ * frequency) * amplitudes_.back());
      phasor_scale_ += std::abs(force_.back());
    };
    add(1, excitation.amplitude, excitation.phase);
    for (const Harmonic& harmonic : excitation.harmonics) add(harmonic.order, harmonic.amplitude, harmonic.phase);
    period_ = 2.0 * std::numbers::pi / excitation.frequency;
    if (!base_) offset_ = excitation.offset;
  } else if (excitation.is_noise()) {
    period_ = excitation.noise.spacing();
    deviation_ = std::sqrt(excitation.noise.intensity / period_);
    draws_ = {.seed = excitation.noise.seed, .stream = noise_stream};
  } else if (excitation.type != ExcitationType::none) {
    ramp_ = excitation.slope;
  }
  turns_.assign(frequencies_.size(), 1.0);
  reset(0.0);
}

void Drive::set_force() {
  force_offset_ = through_spring_ * offset_ + through_damper_ * ramp_;
  force_ramp_ = through_spring_ * ramp_;
}

void Drive::reset(double t) {
  for (std::size_t j = 0; j < turns_.size(); ++j) turns_[j] = std::polar(1.0, frequencies_[j] * t);
  ramp_time_ = t;
  if (is_noise()) {
    enter(0);
  } else {
    set_force();
  }
}

void Drive::end_period(double t) {
  if (is_noise()) {
    ramp_time_ = period_;
  } else {
    reset(t);
  }
}

void Drive::enter(long cell) {
  cell_ = cell;
  ramp_time_ = 0.0;
  offset_ = node(cell);
  ramp_ = (node(cell + 1) - offset_) / period_;
  set_force();
}

double Drive::force_constant() const { return force_offset_ + force_ramp_ * ramp_time_; }

double Drive::force_scale() const {
  return phasor_scale_ + std::abs(through_spring_ * offset_) + std::abs(through_damper_ * ramp_) +
         std::abs(force_ramp_ * ramp_time_);
}

Drive::Value Drive::at(double s) const {
  double level = offset_ + ramp_ * (ramp_time_ + s);
  double rate = ramp_;
  for (std::size_t j = 0; j < frequencies_.size(); ++j) {
    const Complex value = amplitudes_[j] * turns_[j] * std::polar(1.0, frequencies_[j] * s);
    level += value.real();
    rate -= frequencies_[j] * value.imag();
  }
  return base_ ? Value{level, rate, 0.0} : Value{0.0, 0.0, level};
}

}  // namespace dualdamp::sim
