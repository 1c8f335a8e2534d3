#include "identify/uncertainty/parametric_bootstrap.hpp"

#include <cmath>
#include <utility>

#include "core/cancellation.hpp"
#include "core/numbers.hpp"
#include "identify/statistics/distributions.hpp"
#include "identify/statistics/statistics.hpp"
#include "identify/uncertainty/synthetic_record.hpp"

namespace dualdamp::identify {

namespace {

/// Standard errors on the synthetic records, and the ratio to them of errors that are larger than chance allows.
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

std::optional<BootstrapSpread> bootstrap_spread(
    const ParameterReading& own, const Eigen::VectorXd& truth, const std::function<Record(int)>& draw,
    const std::function<std::optional<ParameterReading>(const Record&)>& read, int records) {
  const Eigen::Index size = truth.size();
  Eigen::VectorXd mean = Eigen::VectorXd::Zero(size);
  Errors errors(size);
  Eigen::MatrixXd squares = Eigen::MatrixXd::Zero(size, size);
  int count = 0;
  for (int b = 0; b < records; ++b) {
    core::stop_if_cancelled();
    const std::optional<ParameterReading> reading = read(draw(b));
    if (!reading) continue;
    ++count;
    const Eigen::VectorXd beside = reading->parameters - mean;
    mean += beside / count;
    squares += beside * (reading->parameters - mean).transpose();
    errors.add(reading->errors);
  }
  if (10 * count < 9 * records) return std::nullopt;
  const Eigen::VectorXd ratio = errors.widening(own.errors);
  BootstrapSpread spread;
  spread.bias = mean - truth;
  spread.covariance = ratio.asDiagonal() * (squares / (count - 1)) * ratio.asDiagonal();
  // If the record is not like the synthetic records, its bias need not be theirs.
  if (ratio.maxCoeff() > 1.0) spread.covariance += spread.bias * spread.bias.transpose();
  spread.half_width = quantile95(count - 1) * std::sqrt(1.0 + 1.0 / count);
  // A mass or a stiffness less a bias as large as itself would not be positive.
  for (const Eigen::Index positive : {0, 2})
    if (truth[positive] > 0.0 && !(spread.bias[positive] < truth[positive])) return std::nullopt;
  return spread;
}

int synthetic_records_for(std::size_t samples) {
  constexpr double all_up_to = 60'000.0;
  constexpr int fewest = 12;
  const double share = all_up_to / std::max(all_up_to, static_cast<double>(samples));
  return std::max(fewest, static_cast<int>(share * synthetic_count));
}

namespace {

/// Whether a bias of this size is worth knowing at other parameters than those it was found at.
bool matters(const Eigen::VectorXd& bias, const BootstrapSpread& spread) {
  constexpr double of_deviation = 0.3;
  return (bias.cwiseAbs2().array() > of_deviation * of_deviation * spread.covariance.diagonal().array()).any();
}

}  // namespace

std::optional<BootstrapSpread> parametric_bootstrap(
    const std::vector<NumberedHistory>& histories, const ParameterReading& own, double offset,
    const std::function<std::optional<ParameterReading>(const Record&)>& read) {
  std::size_t samples = 0;
  for (const NumberedHistory& item : histories) samples += item.history->x.size();
  // The spread of records that are made with these parameters, and what the parameters are there.
  const auto spread_at = [&](Eigen::VectorXd truth) -> std::optional<BootstrapSpread> {
    ForceParameters law{truth[0], truth[1], truth[2], truth[3]};
    const std::optional<SyntheticRecords> synthetic = synthetic_records(histories, law, offset);
    if (!synthetic) return std::nullopt;
    truth.head<4>() << law.m, law.c, law.k, law.F0;
    return bootstrap_spread(
        own, truth, [&](int number) { return synthetic->record(number); }, read, synthetic_records_for(samples));
  };
  std::optional<BootstrapSpread> spread = spread_at(own.parameters);
  if (!spread || !matters(spread->bias, *spread)) return spread;
  constexpr int most_passes = 4;
  for (int pass = 1; pass < most_passes; ++pass) {
    const std::optional<BootstrapSpread> next = spread_at(own.parameters - spread->bias);
    if (!next) break;
    const Eigen::VectorXd change = next->bias - spread->bias;
    spread = next;
    if (!matters(change, *spread)) break;
  }
  return spread;
}

void set_estimate(Estimate& estimate, const ForceParameters& force, const std::optional<BootstrapSpread>& spread) {
  if (!spread) {
    estimate.value = parameters(force);
    estimate.findings.emplace_back(
        "no interval is claimed: in synthetic records with the estimated friction the mass moves otherwise than "
        "measured, or the method finds no estimate in them, or a different mass or stiffness");
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
    shifts += (shifts.empty() ? "" : " and ") + std::string(name) + " by " + core::signed_percent(shift / value, 3);
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
                         const std::optional<BootstrapSpread>& spread, Eigen::Index index) {
  if (!spread) return {std::move(name), std::move(unit), value, std::nullopt, std::nullopt};
  FurtherParameter parameter =
      further(std::move(name), std::move(unit), value, spread->covariance(index, index), spread->half_width);
  for (double& end : *parameter.interval95) end -= spread->bias[index];
  return parameter;
}

}  // namespace dualdamp::identify
