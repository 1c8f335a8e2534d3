#include "identify/uncertainty/replicas.hpp"

#include <cmath>
#include <utility>

#include "identify/statistics/statistics.hpp"
#include "identify/uncertainty/starred_record.hpp"

namespace dualdamp::identify {

namespace {

/// Standard errors that the replicas show, and by how much the record's own are beyond chance.
class Errors {
 public:
  explicit Errors(Eigen::Index size) : squares_(Eigen::VectorXd::Zero(size)), largest_(squares_) {}

  void add(const Eigen::VectorXd& errors) {
    squares_ += errors.cwiseAbs2();
    largest_ = largest_.cwiseMax(errors);
    count_ += 1.0;
  }

  [[nodiscard]] Eigen::VectorXd widening(const Eigen::VectorXd& own) const {
    Eigen::VectorXd ratio = Eigen::VectorXd::Ones(own.size());
    for (Eigen::Index i = 0; i < own.size(); ++i)
      if (own[i] > largest_[i] && squares_[i] > 0.0) ratio[i] = own[i] / std::sqrt(squares_[i] / count_);
    return ratio;
  }

 private:
  Eigen::VectorXd squares_, largest_;
  double count_ = 0.0;
};

}  // namespace

std::optional<ReplicaSpread> spread_over_replicas(const Reading& own, const Eigen::VectorXd& truth,
                                                  const std::function<Record(int)>& replica,
                                                  const std::function<std::optional<Reading>(const Record&)>& read,
                                                  int replicas) {
  const Eigen::Index size = truth.size();
  Eigen::VectorXd mean = Eigen::VectorXd::Zero(size);
  Errors errors(size);
  Eigen::MatrixXd squares = Eigen::MatrixXd::Zero(size, size);
  int count = 0;
  for (int b = 0; b < replicas; ++b) {
    const std::optional<Reading> reading = read(replica(b));
    if (!reading) continue;
    ++count;
    const Eigen::VectorXd beside = reading->parameters - mean;
    mean += beside / count;
    squares += beside * (reading->parameters - mean).transpose();
    errors.add(reading->errors);
  }
  if (10 * count < 9 * replicas) return std::nullopt;
  const Eigen::VectorXd ratio = errors.widening(own.errors);
  ReplicaSpread spread;
  spread.bias = mean - truth;
  spread.covariance = ratio.asDiagonal() * (squares / (count - 1)) * ratio.asDiagonal();
  // Where the record is not like the replicas its bias need not be theirs.
  if (ratio.maxCoeff() > 1.0) spread.covariance += spread.bias * spread.bias.transpose();
  spread.half_width = quantile95(count - 1) * std::sqrt(1.0 + 1.0 / count);
  return spread;
}

std::optional<ReplicaSpread> replica_spread(const std::vector<NumberedHistory>& histories, const Reading& own,
                                            double offset,
                                            const std::function<std::optional<Reading>(const Record&)>& read) {
  const Eigen::VectorXd& p = own.parameters;
  ForceParameters law{p[0], p[1], p[2], p[3]};
  const std::optional<StarredRecord> starred = starred_record(histories, law, offset);
  if (!starred) return std::nullopt;
  Eigen::VectorXd truth = p;
  truth.head<4>() << law.m, law.c, law.k, law.F0;
  return spread_over_replicas(own, truth, [&](int number) { return starred->replica(number); }, read);
}

void set_estimate(Estimate& estimate, const ForceParameters& force, const std::optional<ReplicaSpread>& spread) {
  if (!spread) {
    estimate.value = parameters(force);
    estimate.warnings.emplace_back(
        "no interval is claimed: a mass with the estimated friction does not move as the measured one, or the "
        "method "
        "makes nothing of its motion");
    return;
  }
  const Eigen::VectorXd& b = spread->bias;
  const ForceParameters bias{b[0], b[1], b[2], b[3]};
  set_estimate(estimate, force, spread->covariance.topLeftCorner<4, 4>(), spread->half_width, bias);
  const auto unbiased = parameters({force.m - bias.m, force.c - bias.c, force.k - bias.k, force.F0 - bias.F0});
  std::string shifts;
  const auto note = [&](const char* name, double ParameterSet::* number) {
    const double value = estimate.value.*number;
    const double shift = value - unbiased.*number;
    constexpr double of_weight = 1e-3;
    if (std::abs(shift) < std::max(0.5 * (*estimate.std).*number, of_weight * std::abs(value))) return;
    shifts += (shifts.empty() ? "" : " and ") + std::string(name) + " by " + percent(shift / value);
  };
  if (force.k > 0.0)
    note("zeta", &ParameterSet::zeta);
  else
    note("c", &ParameterSet::c);
  note("F0", &ParameterSet::F0);
  if (!shifts.empty())
    estimate.warnings.push_back("noise and what the method neglects shift its " + shifts +
                                ": the intervals allow for it");
}

FurtherParameter further(std::string name, std::string unit, double value,
                         const std::optional<ReplicaSpread>& spread, Eigen::Index index) {
  if (!spread) return {std::move(name), std::move(unit), value, std::nullopt, std::nullopt};
  FurtherParameter parameter =
      further(std::move(name), std::move(unit), value, spread->covariance(index, index), spread->half_width);
  for (double& end : *parameter.interval95) end -= spread->bias[index];
  return parameter;
}

}  // namespace dualdamp::identify
