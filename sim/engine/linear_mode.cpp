#include "sim/engine/linear_mode.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace dualdamp::sim {

using core::Complex;
using core::ExponentialBasis;
using core::ModeFunction;

namespace {

/// Relative distance of exponents below which divided differences are used. Plain forms lose at most the digits of
/// this factor.
constexpr double closeness = 1e-2;
/// A stiffness counts as vanishing if it does not affect the mass within the relevant time. Under a drive: own
/// exponents below this part of the drive's frequency. Without a drive: the smaller own exponent below
/// `slow_beside_decay` of the larger one; a power s^n loses the power n + 1 of that part.
constexpr double slow_beside_drive = 1e-2;
constexpr double slow_beside_decay = 1e-8;
constexpr std::array<double, 4> power_slow_beside_decay = {1e-8, 1e-4, 2e-3, 1e-2};

std::size_t at(int k) { return static_cast<std::size_t>(k); }

double modulus(Complex z) { return core::modulus_bound(z.real(), z.imag()); }

void add(ModeFunction& f, int k, Complex coefficient) {
  f.re[at(k)] += coefficient.real();
  f.im[at(k)] += coefficient.imag();
}

}  // namespace

LinearMode::LinearMode(double mass, double damping, double stiffness, std::span<const double> frequencies,
                       Layout layout)
    : mass_(mass), damping_(damping), stiffness_(stiffness), layout_(std::move(layout)) {
  for (const double frequency : frequencies) fastest_drive_ = std::max(fastest_drive_, frequency);
  build_own_motion();
  build_powers();
  for (const double frequency : frequencies) {
    const Complex z(0.0, frequency);
    harmonics_.push_back(drive(z, basis_.add(z), slow_beside_decay));
  }
  for (const double decay : layout_.decays)
    transients_.push_back(drive(-decay, basis_.add(-decay), slow_beside_decay));
  basis_.finish(expected_reversal(frequencies));
}

void LinearMode::build_powers() {
  for (int n = 0; n <= layout_.degree; ++n) {
    const int source = n == 0 ? basis_.add(0.0) : basis_.add(0.0, powers_.back().source);
    if (layout_.is_brief) {
      const int target = basis_.add(0.0, n == 0 ? own_second_ : powers_.back().target);
      powers_.push_back({source, target, 1.0 / mass_, Near::both});
    } else {
      powers_.push_back(drive(0.0, source, power_slow_beside_decay[at(n)]));
    }
  }
}

/// A periodic motion usually reverses twice in a forcing period, a free motion twice in its own period.
double LinearMode::expected_reversal(std::span<const double> frequencies) const {
  if (!frequencies.empty()) return std::numbers::pi / frequencies.front();
  return own_form_ == OwnForm::oscillating ? std::numbers::pi * inverse_gap_ : 0.0;
}

/// Exponents of m z^2 + C z + K. The smaller root of a real pair comes from the product K/m, without cancellation.
void LinearMode::build_own_motion() {
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
  own_first_ = basis_.add(first_);
  const bool slow = discriminant <= 0.0 && beat <= slow_beside_drive * fastest_drive_;
  if (layout_.is_brief || slow || !(beat > closeness * std::abs(half))) {
    own_form_ = OwnForm::chain;
    own_second_ = basis_.add(second_, own_first_);
  } else if (discriminant > 0.0) {
    own_form_ = OwnForm::oscillating;
    inverse_gap_ = 1.0 / beat;
  } else {
    own_form_ = OwnForm::decaying;
    own_second_ = basis_.add(second_);
    inverse_gap_ = 1.0 / (first_.real() - second_.real());
  }
}

bool LinearMode::close(Complex z, Complex own, double slow) const {
  const double distance = modulus(z - own);
  return distance <= closeness * std::max(modulus(z), modulus(own)) ||
         distance <= slow_beside_drive * fastest_drive_ || distance <= slow * modulus(second_);
}

LinearMode::Near LinearMode::near_own(Complex z, double slow) const {
  const bool first = close(z, first_, slow);
  const bool second = close(z, second_, slow);
  if ((first && second) || ((first || second) && own_form_ == OwnForm::chain)) return Near::both;
  return first ? Near::first : second ? Near::second : Near::none;
}

/// Particular solution of m x'' + C x' + K x = E_source, a function with exponent z. If one own exponent w is close
/// to z and the other one, u, is not, it is the divided difference over z and w, divided by m (z - u).
LinearMode::Driven LinearMode::drive(Complex z, int source, double slow) {
  const Near near = near_own(z, slow);
  switch (near) {
    case Near::none:
      return {source, source, 1.0 / (mass_ * (z - first_) * (z - second_)), near};
    case Near::first:
      return {source, basis_.add(first_, source), 1.0 / (mass_ * (z - second_)), near};
    case Near::second:
      return {source, basis_.add(second_, source), 1.0 / (mass_ * (z - first_)), near};
    default:
      return {source, basis_.add(second_, basis_.add(first_, source)), 1.0 / mass_, near};
  }
}

void LinearMode::represent(const ModeForcing& forcing, ModeFunction& f) const {
  core::clear(basis_, f);
  for (std::size_t n = 0; n < powers_.size(); ++n) add(f, powers_[n].source, forcing.polynomial[n]);
  for (std::size_t j = 0; j < forcing.phasors.size(); ++j) add(f, harmonics_[j].source, forcing.phasors[j]);
  for (std::size_t j = 0; j < forcing.transients.size(); ++j) add(f, transients_[j].source, forcing.transients[j]);
}

void LinearMode::solve(const ModeForcing& forcing, double x0, double v0, ModeFunction& x) const {
  core::clear(basis_, x);
  // Value and slope at s = 0 of the particular solution. Elements on a chain start from zero: a chain of two nodes
  // with slope 1, a longer one with slope 0.
  double start = 0.0;
  double slope = 0.0;
  const auto apply = [&](const Driven& driven, Complex amplitude) {
    const Complex coefficient = amplitude * driven.gain;
    add(x, driven.target, coefficient);
    if (driven.near == Near::none) {
      start += coefficient.real();
      slope += (coefficient * basis_.exponent(driven.source)).real();
    } else if (driven.near != Near::both) {
      slope += coefficient.real();
    }
  };
  // From the highest power down: the force that an element does not balance is added to the lower powers.
  std::array<double, 4> left = forcing.polynomial;
  for (std::size_t n = powers_.size(); n-- > 0;) {
    const Driven& power = powers_[n];
    const double gain = power.gain.real();
    const double coefficient = left[n] * gain;
    add(x, power.target, coefficient);
    if (power.near == Near::none) {
      // m x'' + C x' + K x of s^n/(K n!) is s^n/n! + C/K s^(n-1)/(n-1)! + m/K s^(n-2)/(n-2)!.
      if (n == 0) start += coefficient;
      if (n == 1) slope += coefficient;
      if (n >= 1) left[n - 1] -= coefficient * damping_;
      if (n >= 2) left[n - 2] -= coefficient * mass_;
    } else if (power.near != Near::both) {
      // The element does not contain the other own exponent u, which leaves the force -1/u.
      const Complex other = power.near == Near::first ? second_ : first_;
      if (n == 0) slope += coefficient;
      if (n >= 1) left[n - 1] += left[n] / other.real();
    }
  }
  for (std::size_t j = 0; j < forcing.phasors.size(); ++j) apply(harmonics_[j], forcing.phasors[j]);
  for (std::size_t j = 0; j < forcing.transients.size(); ++j) apply(transients_[j], forcing.transients[j]);

  const double own = x0 - start;
  const double own_slope = v0 - slope - first_.real() * own;
  switch (own_form_) {
    case OwnForm::oscillating:
      add(x, own_first_, Complex(own, -own_slope * inverse_gap_));
      break;
    case OwnForm::decaying:
      add(x, own_first_, own + own_slope * inverse_gap_);
      add(x, own_second_, -own_slope * inverse_gap_);
      break;
    case OwnForm::chain:
      add(x, own_first_, own);
      add(x, own_second_, own_slope);
      break;
  }
}

Eigen::Matrix2d LinearMode::propagator(const ExponentialBasis::Values& values) const {
  // x = own E1 + own_slope D, where D is the divided difference of exp(first s) and exp(second s); x' accordingly.
  const Complex e1(values.re[at(own_first_)], values.im[at(own_first_)]);
  double difference = 0.0;
  if (own_form_ == OwnForm::oscillating) {
    difference = e1.imag() * inverse_gap_;
  } else {
    const double e2 = values.re[at(own_second_)];
    difference = own_form_ == OwnForm::chain ? e2 : (e1.real() - e2) * inverse_gap_;
  }
  Eigen::Matrix2d result;
  for (int column = 0; column < 2; ++column) {
    const double own = column == 0 ? 1.0 : 0.0;
    const double own_slope = (column == 0 ? 0.0 : 1.0) - first_.real() * own;
    result(0, column) = own * e1.real() + own_slope * difference;
    // E1' = first E1 and D' = second D + E1; the real part if they are complex.
    result(1, column) = own * (first_ * e1).real() + own_slope * (second_.real() * difference + e1.real());
  }
  return result;
}

Eigen::Vector2d LinearMode::response(std::size_t source, const ExponentialBasis::Values& values) const {
  ModeForcing forcing;
  if (source == 0) {
    forcing.polynomial[0] = 1.0;
  } else {
    forcing.transients.assign(layout_.decays.size(), 0.0);
    forcing.transients[source - 1] = 1.0;
  }
  ModeFunction x;
  ModeFunction v;
  solve(forcing, 0.0, 0.0, x);
  core::differentiate(basis_, x, v);
  return {core::evaluate(basis_, x, values), core::evaluate(basis_, v, values)};
}

}  // namespace dualdamp::sim
