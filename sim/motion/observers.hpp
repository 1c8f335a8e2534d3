#pragma once
/// Observers of a stream of intervals, for both engines.

#include <complex>
#include <span>
#include <vector>

#include "sim/engine/interval.hpp"
#include "sim/motion/energy.hpp"
#include "sim/oscillator.hpp"

namespace dualdamp::sim {

/// Samples at 0, 1/rate, 2/rate, ... [s], or at given times.
class Sampler {
 public:
  /// rate in Hz; 0 takes none.
  explicit Sampler(double rate) : rate_(rate) {}
  /// Ascending times >= 0 [s]; the span must outlive this object.
  explicit Sampler(std::span<const double> times) : times_(times) {}

  void observe(const Interval& interval);
  /// Takes the sample at the end of the last interval, if one is due there.
  void finish(const Sample& final);
  [[nodiscard]] std::vector<Sample>& samples() { return samples_; }

 private:
  /// Time of the next sample [s]; infinite if there is none.
  [[nodiscard]] double next() const;

  double rate_ = 0.0;
  std::span<const double> times_;
  std::vector<Sample> samples_;
};

/// Largest and smallest x [m], and the largest speed [m/s].
class PeakAndTrough {
 public:
  void observe(const Interval& interval);

  [[nodiscard]] double peak() const { return peak_; }
  [[nodiscard]] double trough() const { return trough_; }
  [[nodiscard]] double max_speed() const { return max_speed_; }

 private:
  bool seen_ = false;
  double peak_ = 0.0;
  double trough_ = 0.0;
  double max_speed_ = 0.0;
};

/// A sum with compensation of its rounding error (Neumaier): over equal periods the error would otherwise be
/// systematic.
class CompensatedSum {
 public:
  void add(double term) {
    const double sum = sum_ + term;
    const bool larger = (sum_ < 0.0 ? -sum_ : sum_) >= (term < 0.0 ? -term : term);
    lost_ += larger ? (sum_ - sum) + term : (term - sum) + sum_;
    sum_ = sum;
  }
  [[nodiscard]] double value() const { return sum_ + lost_; }

 private:
  double sum_ = 0.0;
  double lost_ = 0.0;
};

/// Energy account, from the interval's closed form or by Gauss-Legendre quadrature. The integrands are analytic
/// within an interval, so both are exact to rounding. Forces come from the laws, not from the equation of motion,
/// so the defect is a check of the motion.
class EnergyAudit {
 public:
  explicit EnergyAudit(const Oscillator& oscillator) : oscillator_(oscillator) {}

  void observe(const Interval& interval);
  /// Account of all intervals so far.
  [[nodiscard]] Energy account() const;
  /// int v^2 dt [m^2/s].
  [[nodiscard]] double square_speed() const { return square_speed_.value(); }

 private:
  [[nodiscard]] double stored(const Sample& sample) const;
  void add_by_quadrature(const Interval& interval);
  void add_in_closed_form(const ClosedForm& form);

  Oscillator oscillator_;
  bool started_ = false;
  CompensatedSum input_;
  CompensatedSum friction_;
  CompensatedSum viscous_;
  CompensatedSum square_speed_;
  double base_ = 0.0;   ///< y at the end of the last interval [m]
  double reach_ = 0.0;  ///< largest |y| so far [m]
  double first_ = 0.0;
  double last_ = 0.0;
};

/// Fourier coefficient (2/T) int x exp(-i w t) dt over the intervals of one period [m].
class Fundamental {
 public:
  explicit Fundamental(double omega) : omega_(omega) {}

  void observe(const Interval& interval);
  [[nodiscard]] std::complex<double> coefficient() const;

 private:
  double omega_;
  std::complex<double> sum_ = 0.0;
};

}  // namespace dualdamp::sim
