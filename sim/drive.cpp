#include "sim/drive.hpp"

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
    : period_(std::numeric_limits<double>::infinity()),
      base_(excitation.type == ExcitationType::base_harmonic || excitation.type == ExcitationType::base_ramp) {
  const double through_damper = oscillator.damper_to == DamperTo::base ? oscillator.damping : 0.0;
  if (excitation.is_harmonic()) {
    const auto add = [&](int order, double amplitude, double phase) {
      const double frequency = order * excitation.frequency;
      frequencies_.push_back(frequency);
      amplitudes_.push_back(std::polar(amplitude, phase));
      const Complex gain = base_ ? Complex(oscillator.stiffness, through_damper * frequency) : Complex(1.0);
      force_.push_back(gain * amplitudes_.back());
    };
    add(1, excitation.amplitude, excitation.phase);
    for (const Harmonic& harmonic : excitation.harmonics) add(harmonic.order, harmonic.amplitude, harmonic.phase);
    period_ = 2.0 * std::numbers::pi / excitation.frequency;
    if (!base_) offset_ = excitation.offset;
  } else if (excitation.type != ExcitationType::none) {
    ramp_ = excitation.slope;
    force_ramp_ = base_ ? oscillator.stiffness * ramp_ : ramp_;
    force_from_rate_ = base_ ? through_damper * ramp_ : 0.0;
  }
  turns_.assign(frequencies_.size(), 1.0);
  steady_scale_ = std::abs(offset_) + std::abs(force_from_rate_);
  for (const Complex& phasor : force_) steady_scale_ += std::abs(phasor);
}

void Drive::reset(double t) {
  for (std::size_t j = 0; j < turns_.size(); ++j) turns_[j] = std::polar(1.0, frequencies_[j] * t);
  ramp_time_ = t;
}

double Drive::force_constant() const { return offset_ + force_ramp_ * ramp_time_ + force_from_rate_; }

double Drive::force_scale() const { return steady_scale_ + std::abs(force_ramp_ * ramp_time_); }

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
