#include "identify/fit/fit_readings.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dualdamp::identify {

FitReadings::FitReadings(std::vector<const Experiment*> experiments, bool holds_mass)
    : experiments_(std::move(experiments)) {
  Eigen::Index size = 0;
  for (std::size_t e = 0; e < experiments_.size(); ++e) {
    begins_.push_back(size);
    for (std::size_t s = 0; s < experiments_[e]->signals.size(); ++s) {
      const auto count = static_cast<Eigen::Index>(experiments_[e]->signals[s].measured.size());
      signals_.push_back({e, s, size, size + count});
      size += count;
    }
  }
  measured_.resize(size);
  counted_ = Eigen::VectorXd::Ones(size);
  for (const SignalRows& rows : signals_) {
    const Signal& of = signal(rows);
    measured_.segment(rows.begin, rows.size()) = Eigen::Map<const Eigen::VectorXd>(of.measured.data(), rows.size());
    for (const std::size_t i : of.unsure) counted_[rows.begin + static_cast<Eigen::Index>(i)] = 0.0;
    if (!holds_mass) continue;
    for (const std::size_t i : of.stuck) counted_[rows.begin + static_cast<Eigen::Index>(i)] = 0.0;
  }
}

Eigen::VectorXd FitReadings::counted(const Eigen::VectorXd& misses, const SignalRows& rows) const {
  std::vector<Eigen::Index> those;
  for (Eigen::Index r = rows.begin; r < rows.end; ++r)
    if (counted_[r] > 0.0) those.push_back(r);
  return misses(those);
}

double FitReadings::rms(const Eigen::VectorXd& misses, const SignalRows& rows) const {
  return misses.segment(rows.begin, rows.size()).norm() / std::sqrt(std::max(1.0, count(rows)));
}

}  // namespace dualdamp::identify
