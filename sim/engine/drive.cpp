#include "sim/engine/drive.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/constants.hpp"

namespace dualdamp::sim {

using core::Complex;

namespace {

/// Derivatives of the polynomial at s, from those at 0.
std::array<double, 4> shifted(const std::array<double, 4>& d, double s) {
  return {d[0] + s * (d[1] + s * (d[2] / 2.0 + s * d[3] / 6.0)), d[1] + s * (d[2] + s * d[3] / 2.0),
          d[2] + s * d[3], d[3]};
}

}  // namespace

Drive::Drive(const Oscillator& oscillator, const Excitation& excitation)
    : pieces_(make_pieces(excitation)),
      period_(std::numeric_limits<double>::infinity()),
      base_(excitation.moves_base()) {
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
    period_ = core::two_pi / excitation.frequency;
    if (!base_) polynomial_[0] = excitation.offset;
  }
  turns_.assign(frequencies_.size(), 1.0);
  reset(0.0);
}

double Drive::begin_of(long n) const {
  if (n == 0) return 0.0;
  return has_pieces() ? pieces_->begin(n) : static_cast<double>(n) * period_;
}

void Drive::set_force() {
  const std::array<double, 4> now = shifted(polynomial_, piece_time_);
  for (std::size_t n = 0; n < 3; ++n)
    force_polynomial_[n] = through_spring_ * now[n] + through_damper_ * now[n + 1];
  force_polynomial_[3] = through_spring_ * now[3];
  polynomial_scale_ = std::abs(through_damper_ * now[1]);
  double power = std::abs(through_spring_);
  for (std::size_t n = 0; n < 4; ++n) {
    polynomial_scale_ += std::abs(polynomial_[n]) * power;
    power *= piece_time_ / static_cast<double>(n + 1);
  }
}

void Drive::reset(double t) {
  if (has_pieces()) return enter(0);
  for (std::size_t j = 0; j < turns_.size(); ++j) turns_[j] = std::polar(1.0, frequencies_[j] * t);
  set_force();
}

void Drive::end_period(double t) {
  if (!has_pieces()) return reset(t);
  piece_time_ = period_;
  set_force();
}

void Drive::enter(long piece) {
  piece_ = piece;
  piece_time_ = 0.0;
  const PolynomialPiece entered = pieces_->piece(piece);
  period_ = entered.duration;
  polynomial_ = entered.derivatives;
  set_force();
}

void Drive::pass(double s) {
  if (!has_pieces()) return;
  piece_time_ += s;
  set_force();
}

double Drive::force_size(double time) const {
  const double later = has_pieces() ? pieces_->size() * through_spring_ : 0.0;
  return std::max(force_scale() + std::abs(force_polynomial_[1]) * time, later);
}

Drive::Value Drive::at(double s) const {
  double level = polynomial_[0];
  double rate = 0.0;
  if (has_pieces()) {
    const std::array<double, 4> then = shifted(polynomial_, piece_time_ + s);
    level = then[0];
    rate = then[1];
  }
  for (std::size_t j = 0; j < frequencies_.size(); ++j) {
    // Complex products would check every part for infinity.
    const Complex a = amplitudes_[j];
    const Complex turn = turns_[j];
    const double real = a.real() * turn.real() - a.imag() * turn.imag();
    const double imaginary = a.real() * turn.imag() + a.imag() * turn.real();
    const double angle = frequencies_[j] * s;
    const double cosine = std::cos(angle);
    const double sine = std::sin(angle);
    level += real * cosine - imaginary * sine;
    rate -= frequencies_[j] * (real * sine + imaginary * cosine);
  }
  return base_ ? Value{level, rate, 0.0} : Value{0.0, 0.0, level};
}

double driven_displacement(const Oscillator& oscillator, const Excitation& excitation) {
  const double w = excitation.frequency;
  return Drive(oscillator, excitation).force_scale() / std::max(oscillator.stiffness, oscillator.mass * w * w);
}

}  // namespace dualdamp::sim
