#pragma once
/// Standard errors over resamples.

#include <array>
#include <cmath>
#include <cstddef>

#include "bench/score/metrics.hpp"
#include "bench/score/resample.hpp"

namespace dualdamp::bench {

/// Standard deviation over the resamples in which the value exists; NaN if these are fewer than half of all.
class Spread {
 public:
  void add(double value) {
    if (std::isnan(value)) return;
    ++count_;
    const double step = value - mean_;
    mean_ += step / static_cast<double>(count_);
    squares_ += step * (value - mean_);
  }
  [[nodiscard]] double se() const {
    return 2 * count_ >= resamples ? std::sqrt(squares_ / static_cast<double>(count_ - 1)) : not_stated;
  }

 private:
  std::size_t count_ = 0;
  double mean_ = 0.0, squares_ = 0.0;
};

/// Standard errors of several metrics.
class Spreads {
 public:
  void add(const Metrics& metrics) {
    for (std::size_t i = 0; i < metric_count; ++i) spreads_[i].add(metrics.values[i]);
    interval_score_.add(metrics.interval_score());
  }
  [[nodiscard]] Metrics se() const {
    Metrics result;
    for (std::size_t i = 0; i < metric_count; ++i) result.values[i] = spreads_[i].se();
    return result;
  }
  [[nodiscard]] double interval_score_se() const { return interval_score_.se(); }

 private:
  std::array<Spread, metric_count> spreads_;
  Spread interval_score_;
};

}  // namespace dualdamp::bench
