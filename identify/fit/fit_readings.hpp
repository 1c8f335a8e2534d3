#pragma once
/// The readings of a fit: those of all signals of all experiments, one below the other.

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "identify/experiments/experiment.hpp"

namespace dualdamp::identify {

/// Rows [begin, end) of one signal of one experiment.
struct SignalRows {
  std::size_t experiment = 0;
  std::size_t signal = 0;
  Eigen::Index begin = 0;
  Eigen::Index end = 0;

  [[nodiscard]] Eigen::Index size() const { return end - begin; }
};

class FitReadings {
 public:
  /// `holds_mass`: a law can make the mass stick; readings at which it was stuck then do not count. The experiments
  /// must outlive this.
  FitReadings(std::vector<const Experiment*> experiments, bool holds_mass);

  /// Number of rows.
  [[nodiscard]] Eigen::Index size() const { return measured_.size(); }
  [[nodiscard]] const std::vector<const Experiment*>& experiments() const { return experiments_; }
  [[nodiscard]] const std::vector<SignalRows>& signals() const { return signals_; }
  [[nodiscard]] const Experiment& experiment(const SignalRows& rows) const {
    return *experiments_[rows.experiment];
  }
  [[nodiscard]] const Signal& signal(const SignalRows& rows) const { return experiment(rows).signals[rows.signal]; }
  /// First row of an experiment.
  [[nodiscard]] Eigen::Index begin_of(std::size_t experiment) const { return begins_[experiment]; }

  [[nodiscard]] const Eigen::VectorXd& measured() const { return measured_; }
  /// 1 for each reading that counts, 0 for one that does not.
  [[nodiscard]] const Eigen::VectorXd& counted() const { return counted_; }
  /// Number of readings that count, of all signals or of one.
  [[nodiscard]] double count() const { return counted_.sum(); }
  [[nodiscard]] double count(const SignalRows& rows) const {
    return counted_.segment(rows.begin, rows.size()).sum();
  }
  /// Outputs minus readings; 0 for a reading that does not count.
  [[nodiscard]] Eigen::VectorXd misses(const Eigen::VectorXd& outputs) const {
    return (outputs - measured_).cwiseProduct(counted_);
  }
  /// The misses of a signal at the readings that count.
  [[nodiscard]] Eigen::VectorXd counted(const Eigen::VectorXd& misses, const SignalRows& rows) const;
  /// Root mean square of the misses of a signal, over the readings that count.
  [[nodiscard]] double rms(const Eigen::VectorXd& misses, const SignalRows& rows) const;

 private:
  std::vector<const Experiment*> experiments_;
  std::vector<SignalRows> signals_;
  std::vector<Eigen::Index> begins_;  ///< of each experiment
  Eigen::VectorXd measured_;
  Eigen::VectorXd counted_;
};

}  // namespace dualdamp::identify
