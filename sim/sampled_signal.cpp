#include "sim/sampled_signal.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "core/diagnostics.hpp"
#include "core/numbers.hpp"
#include "sim/validate.hpp"

namespace dualdamp::sim {

PolynomialPiece hermite_piece(double duration, double value, double slope, double end_value, double end_slope) {
  const double chord = (end_value - value) / duration;
  const double bend = (3.0 * chord - 2.0 * slope - end_slope) / duration;
  const double twist = (slope + end_slope - 2.0 * chord) / (duration * duration);
  return {duration, {value, slope, 2.0 * bend, 6.0 * twist}};
}

SampledSignal::SampledSignal(std::vector<double> times, std::vector<double> values, Interpolation interpolation,
                             bool repeats)
    : times_(std::move(times)), values_(std::move(values)), interpolation_(interpolation), repeats_(repeats) {
  require(times_.size() == values_.size(), "a sampled signal has as many times as values", "equal numbers");
  if (times_.size() < 2)
    refuse("a sampled signal has too few nodes: " + std::to_string(times_.size()), "two or more");
  require(times_.front() == 0.0, "the first time of a sampled signal is not 0", "0");
  for (std::size_t i = 0; i < times_.size(); ++i) {
    const auto which = [i] { return "node " + std::to_string(i + 1) + " of a sampled signal"; };
    if (!std::isfinite(times_[i]) || !std::isfinite(values_[i])) refuse(which() + " is not finite", "numbers");
    if (i > 0 && !(times_[i] > times_[i - 1]))
      refuse(which() + " is no later than the one before", "times that increase");
    size_ = std::max(size_, std::abs(values_[i]));
  }
  if (interpolation_ == Interpolation::cubic) build_spline();
}

/// Slopes at the nodes, from the tridiagonal equations of a continuous second derivative. At the second node and at
/// the last but one the third derivative is continuous too (deboor1978, IV).
void SampledSignal::build_spline() {
  const std::size_t last = pieces();
  slopes_.resize(times_.size());
  if (last == 1) {
    slopes_[0] = slopes_[1] = chord(0);
    return;
  }
  if (last == 2) {
    const double bend = (chord(1) - chord(0)) / (width(0) + width(1));
    slopes_[0] = chord(0) - bend * width(0);
    slopes_[1] = chord(0) + bend * width(0);
    slopes_[2] = chord(1) + bend * width(1);
    return;
  }
  // Row i: left s_(i-1) + own s_i + right s_(i+1) = sum; `upper` is right/own after elimination.
  std::vector<double> upper(times_.size());
  const auto eliminate = [&](std::size_t i, double left, double own, double right, double sum) {
    const double pivot = i == 0 ? own : own - left * upper[i - 1];
    upper[i] = right / pivot;
    slopes_[i] = (i == 0 ? sum : sum - left * slopes_[i - 1]) / pivot;
  };
  const auto end_sum = [](double near, double far, double near_chord, double far_chord) {
    return ((near + 2.0 * (near + far)) * far * near_chord + near * near * far_chord) / (near + far);
  };
  eliminate(0, 0.0, width(1), width(0) + width(1), end_sum(width(0), width(1), chord(0), chord(1)));
  for (std::size_t i = 1; i < last; ++i) {
    const double before = width(i - 1);
    const double after = width(i);
    eliminate(i, after, 2.0 * (before + after), before, 3.0 * (after * chord(i - 1) + before * chord(i)));
  }
  eliminate(last, width(last - 1) + width(last - 2), width(last - 2), 0.0,
            end_sum(width(last - 1), width(last - 2), chord(last - 1), chord(last - 2)));
  for (std::size_t i = last; i-- > 0;) slopes_[i] -= upper[i] * slopes_[i + 1];
}

double SampledSignal::begin(long n) const {
  const auto number = static_cast<std::size_t>(n);
  if (!repeats_) return times_[std::min(number, pieces())];
  const std::size_t round = number / pieces();
  return static_cast<double>(round) * length() + times_[number % pieces()];
}

PolynomialPiece SampledSignal::piece(long n) const {
  const auto number = static_cast<std::size_t>(n);
  if (!repeats_ && number >= pieces()) return {std::numeric_limits<double>::infinity(), {values_.back()}};
  const std::size_t i = number % pieces();
  switch (interpolation_) {
    case Interpolation::step:
      return {width(i), {values_[i]}};
    case Interpolation::linear:
      return {width(i), {values_[i], chord(i)}};
    case Interpolation::cubic:
      break;
  }
  return hermite_piece(width(i), values_[i], slopes_[i], values_[i + 1], slopes_[i + 1]);
}

Overshoot SampledSignal::largest_overshoot() const {
  Overshoot largest;
  if (interpolation_ != Interpolation::cubic) return largest;
  const auto [least, most] = std::ranges::minmax(values_);
  for (std::size_t i = 0; i < pieces(); ++i) {
    const PolynomialPiece cubic = piece(static_cast<long>(i));
    const auto& [y, slope, second, third] = cubic.derivatives;
    // Where the slope is zero: the roots of a parabola, in the form in which no digits cancel.
    const double root = std::sqrt(std::max(0.0, second * second - 2.0 * third * slope));
    const double sum = -(second + std::copysign(root, second));
    for (const double s : {2.0 * slope / sum, sum / third}) {
      if (!(s > 0.0 && s < cubic.duration)) continue;
      const double value = y + s * (slope + s * (second / 2.0 + s * third / 6.0));
      const double size = std::max(value - most, least - value);
      if (size > largest.size) largest = {times_[i] + s, size};
    }
  }
  return largest;
}

SampledSignal SampledSignal::scaled(double factor) const {
  SampledSignal result = *this;
  for (std::vector<double>* column : {&result.values_, &result.slopes_}) {
    for (double& value : *column) value *= factor;
  }
  result.size_ *= std::abs(factor);
  return result;
}

}  // namespace dualdamp::sim
