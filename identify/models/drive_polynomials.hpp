#pragma once
/// A sampled y or force as polynomials of the time in each sample interval, through the eight nearest samples;
/// through the twelve nearest, if those of eight miss a smooth signal, as with fewer than 12 samples in its period.
/// No polynomial passes a step: of an interval in which the drive steps there are two, from the three samples
/// before and the three after it.

#include <array>
#include <cstddef>
#include <map>
#include <vector>

namespace dualdamp::identify {

class DrivePolynomials {
 public:
  static constexpr int nodes = 8;
  using Polynomial = std::array<double, nodes>;  ///< coefficients of powers of time, in sample intervals

  /// `steps`: the intervals with a step, in order. An empty signal is zero.
  DrivePolynomials(const std::vector<double>& samples, const std::vector<std::size_t>& steps, std::size_t count);

  /// Of an interval; where the signal steps, up to the step.
  [[nodiscard]] const Polynomial& operator[](std::size_t interval) const { return all_[interval]; }
  /// Of an interval in which the signal steps, from the step on.
  [[nodiscard]] const Polynomial& after_step(std::size_t interval) const { return after_.at(interval); }

 private:
  std::vector<Polynomial> all_;
  std::map<std::size_t, Polynomial> after_;
};

}  // namespace dualdamp::identify
