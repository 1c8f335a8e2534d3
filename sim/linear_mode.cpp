#include "sim/linear_mode.hpp"

#include <algorithm>
#include <cmath>

namespace dualdamp::sim {

using core::Complex;
using core::ExponentialBasis;
using core::ModeFunction;

namespace {

/// Relative distance of exponents below which divided differences take over; naive forms lose at most this factor.
constexpr double closeness = 1e-2;
/// The same for a ramp, whose naive form loses the square.
constexpr double ramp_closeness = 1e-1;
/// Own exponents below this part of the drive's frequency hardly move within a period: a vanishing stiffness.
constexpr double vanishing = 1e-3;

std::size_t at(int k) { return static_cast<std::size_t>(k); }

void add(ModeFunction& f, int k, Complex coefficient) {
  f.re[at(k)] += coefficient.real();
  f.im[at(k)] += coefficient.imag();
}

}  // namespace

LinearMode::LinearMode(double mass, double damping, double stiffness, std::span<const double> frequencies,
                       bool ramped, std::span<const double> decays)
    : mass_(mass),
      damping_(damping),
      stiffness_(stiffness),
      decays_(decays.begin(), decays.end()),
      ramped_(ramped) {
  for (const double frequency : frequencies) fastest_drive_ = std::max(fastest_drive_, frequency);
  lay_own_motion();
  constant_ = drive(0.0, basis_.add(0.0), closeness);
  if (ramped) ramp_ = drive(0.0, basis_.add(0.0, constant_.source), ramp_closeness);
  for (const double frequency : frequencies) {
    const Complex z(0.0, frequency);
    harmonics_.push_back(drive(z, basis_.add(z), closeness));
  }
  for (const double decay : decays) transients_.push_back(drive(-decay, basis_.add(-decay), closeness));
  basis_.finish();
}

/// Exponents of m z^2 + C z + K. The small root of a real pair comes from the product K/m, free of cancellation.
void LinearMode::lay_own_motion() {
  const double half = damping_ / (2.0 * mass_);
  const double discriminant = stiffness_ / mass_ - half * half;
  const double beat = std::sqrt(std::abs(discriminant));
  if (discriminant > 0.0) {
    first_ = {-half, beat};
    second_ = {-half, -beat};
  } else {
    const double large = half >= 0.0 ? -half - beat : -half + beat;
    second_ = large;
    first_ = large != 0.0 ? stiffness_ / mass_ / large : 0.0;
  }
  inverse_beat_ = 1.0 / beat;
  own_first_ = basis_.add(first_);
  const bool pair = discriminant > 0.0 && beat > closeness * std::abs(half);
  if (!pair) own_second_ = basis_.add(second_, own_first_);
}

bool LinearMode::close_to_own(Complex z, double part) const {
  const double scale = std::max({std::abs(z), std::abs(first_), std::abs(second_)});
  const double distance = std::min(std::abs(z - first_), std::abs(z - second_));
  return distance <= part * scale || distance <= vanishing * fastest_drive_;
}

/// Particular solution of m x'' + C x' + K x = E_source, a function with exponent z.
LinearMode::Driven LinearMode::drive(Complex z, int source, double part) {
  if (!close_to_own(z, part)) return {source, source, 1.0 / (mass_ * (z - first_) * (z - second_))};
  const int target = basis_.add(second_, basis_.add(first_, source));
  return {source, target, 1.0 / mass_};
}

void LinearMode::represent(const ModeForcing& forcing, ModeFunction& f) const {
  core::clear(basis_, f);
  add(f, constant_.source, forcing.constant);
  if (ramped_) add(f, ramp_.source, forcing.ramp);
  for (std::size_t j = 0; j < forcing.phasors.size(); ++j) add(f, harmonics_[j].source, forcing.phasors[j]);
  for (std::size_t j = 0; j < forcing.transients.size(); ++j) add(f, transients_[j].source, forcing.transients[j]);
}

void LinearMode::solve(const ModeForcing& forcing, double x0, double v0, ModeFunction& x) const {
  core::clear(basis_, x);
  // Value and slope at s = 0 of the particular solution: elements on a chain start from zero, and the slope of
  // the top of a chain of three starts from zero too.
  double start = 0.0;
  double slope = 0.0;
  const auto apply = [&](const Driven& driven, Complex amplitude) {
    const Complex coefficient = amplitude * driven.gain;
    add(x, driven.target, coefficient);
    if (driven.target != driven.source) return;
    start += coefficient.real();
    slope += (coefficient * basis_.exponent(driven.source)).real();
  };
  apply(constant_, forcing.constant);
  if (ramped_) {
    const double coefficient = forcing.ramp * ramp_.gain.real();
    add(x, ramp_.target, coefficient);
    if (ramp_.target == ramp_.source) {
      // s/K lags behind by C/K^2: K (s/K - C/K^2) + C/K = s.
      const double lag = coefficient * damping_ * ramp_.gain.real();
      add(x, constant_.source, -lag);
      start -= lag;
      slope += coefficient;
    }
  }
  for (std::size_t j = 0; j < forcing.phasors.size(); ++j) apply(harmonics_[j], forcing.phasors[j]);
  for (std::size_t j = 0; j < forcing.transients.size(); ++j) apply(transients_[j], forcing.transients[j]);

  const double own = x0 - start;
  const double own_slope = v0 - slope - first_.real() * own;
  if (own_second_ < 0) {
    add(x, own_first_, Complex(own, -own_slope * inverse_beat_));
    return;
  }
  add(x, own_first_, own);
  add(x, own_second_, own_slope);
}

Eigen::Matrix2d LinearMode::propagator(const ExponentialBasis::Values& values) const {
  const Complex e1(values.re[at(own_first_)], values.im[at(own_first_)]);
  Eigen::Matrix2d result;
  for (int column = 0; column < 2; ++column) {
    const double own = column == 0 ? 1.0 : 0.0;
    const double own_slope = (column == 0 ? 0.0 : 1.0) - first_.real() * own;
    if (own_second_ < 0) {
      const Complex x = Complex(own, -own_slope * inverse_beat_) * e1;
      result(0, column) = x.real();
      result(1, column) = (x * first_).real();
    } else {
      const Complex e2(values.re[at(own_second_)], values.im[at(own_second_)]);
      result(0, column) = (own * e1 + own_slope * e2).real();
      result(1, column) = (own * first_ * e1 + own_slope * (second_ * e2 + e1)).real();
    }
  }
  return result;
}

}  // namespace dualdamp::sim
