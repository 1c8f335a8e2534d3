#pragma once
/// The metrics of a method's answers to many cases, and their weighted means.

#include <array>
#include <cmath>
#include <cstddef>
#include <string_view>

#include "bench/score/case_answer.hpp"

namespace dualdamp::bench {

/// In the order of their columns; `metric_list` says what they are.
enum class Metric : std::size_t {
  coverage_zeta,
  coverage_F0,
  interval_score_zeta,
  interval_score_F0,
  power,
  attainable_power,
  false_alarm,
  prediction_error,  ///< prediction.hpp
  selective_risk_area,
};

struct MetricText {
  std::string_view name;  ///< of its columns and fields
  std::string_view meaning;
};

inline constexpr auto metric_list = std::to_array<MetricText>(
    {{"coverage_zeta", "share of 95 % intervals that hold the true zeta"},
     {"coverage_F0", "share of 95 % intervals that hold the true F0"},
     {"interval_score_zeta", "mean interval score of zeta over the truth; smaller is better"},
     {"interval_score_F0", "mean interval score of F0 over the truth; smaller is better"},
     {"power", "share of cases with a departure that the method rejects"},
     {"attainable_power", "power of the best test that knows the departure"},
     {"false_alarm", "share of cases without a departure that the method rejects"},
     {"prediction_error",
      "mean relative error of the amplitudes that the estimate predicts for tests that were not made"},
     {"selective_risk_area",
      "mean loss of the cases of highest confidence, averaged over their share from 0 to 1"}});
inline constexpr std::size_t metric_count = metric_list.size();
static_assert(metric_count == static_cast<std::size_t>(Metric::selective_risk_area) + 1);

[[nodiscard]] constexpr std::string_view name_of(Metric metric) {
  return metric_list.at(static_cast<std::size_t>(metric)).name;
}

/// The values of all metrics; NaN: does not exist.
struct Metrics {
  std::array<double, metric_count> values = filled();

  [[nodiscard]] double& operator[](Metric metric) { return values[static_cast<std::size_t>(metric)]; }
  [[nodiscard]] double operator[](Metric metric) const { return values[static_cast<std::size_t>(metric)]; }

  /// The score of the ranking: the mean of the interval scores of zeta and F0.
  [[nodiscard]] double interval_score() const {
    return 0.5 * ((*this)[Metric::interval_score_zeta] + (*this)[Metric::interval_score_F0]);
  }

 private:
  static constexpr std::array<double, metric_count> filled() {
    std::array<double, metric_count> list{};
    list.fill(not_stated);
    return list;
  }
};

/// Area under the curve of selective risk over coverage: items come in the order of falling confidence; those of
/// equal confidence are taken together.
///
///   area = sum over groups g of (share of g) (mean loss of all up to and with g)
class RiskArea {
 public:
  void add(double weight, double loss) {
    group_weight_ += weight;
    group_loss_ += weight * loss;
  }
  void end_group() {
    if (!(group_weight_ > 0.0)) return;
    weight_ += group_weight_;
    loss_ += group_loss_;
    area_ += group_weight_ * loss_ / weight_;
    group_weight_ = group_loss_ = 0.0;
  }
  /// After the last group; NaN without items.
  [[nodiscard]] double area() const { return weight_ > 0.0 ? area_ / weight_ : not_stated; }

 private:
  double weight_ = 0.0, loss_ = 0.0, area_ = 0.0, group_weight_ = 0.0, group_loss_ = 0.0;
};

/// A weighted mean of the values that exist.
class Mean {
 public:
  void add(double weight, double value) {
    if (std::isnan(value)) return;
    weight_ += weight;
    sum_ += weight * value;
  }
  void add(const Mean& other) {
    weight_ += other.weight_;
    sum_ += other.sum_;
  }
  [[nodiscard]] double value() const { return weight_ > 0.0 ? sum_ / weight_ : not_stated; }

 private:
  double weight_ = 0.0, sum_ = 0.0;
};

/// Weighted means of all metrics: over cases, which have no area of risk of their own, or over groups of cases.
class MetricMeans {
 public:
  /// A case of the truth counts for the false alarms, a case of a departure for the power.
  void add(const Mark& mark, double weight, bool is_truth, double attainable_power) {
    add_parameter(mark.zeta, weight, Metric::coverage_zeta, Metric::interval_score_zeta);
    add_parameter(mark.F0, weight, Metric::coverage_F0, Metric::interval_score_F0);
    mean(is_truth ? Metric::false_alarm : Metric::power).add(weight, mark.rejected ? 1.0 : 0.0);
    mean(Metric::prediction_error).add(weight, static_cast<double>(mark.prediction_error));
    if (!is_truth) mean(Metric::attainable_power).add(weight, attainable_power);
  }
  void add(double weight, const Metrics& metrics) {
    for (std::size_t i = 0; i < metric_count; ++i) means_[i].add(weight, metrics.values[i]);
  }
  void add(const MetricMeans& other) {
    for (std::size_t i = 0; i < metric_count; ++i) means_[i].add(other.means_[i]);
  }
  [[nodiscard]] Metrics value() const {
    Metrics metrics;
    for (std::size_t i = 0; i < metric_count; ++i) metrics.values[i] = means_[i].value();
    return metrics;
  }

 private:
  Mean& mean(Metric metric) { return means_[static_cast<std::size_t>(metric)]; }
  void add_parameter(const ParameterMark& mark, double weight, Metric coverage, Metric score) {
    if (mark.has_interval) mean(coverage).add(weight, mark.covers ? 1.0 : 0.0);
    mean(score).add(weight, static_cast<double>(mark.score));
  }

  std::array<Mean, metric_count> means_;
};

}  // namespace dualdamp::bench
