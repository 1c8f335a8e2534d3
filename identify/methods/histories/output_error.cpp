#include "identify/methods/histories/output_error.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/numbers.hpp"
#include "identify/conclusion.hpp"
#include "identify/methods/histories/forward_fit.hpp"
#include "identify/models/force_parameters.hpp"
#include "identify/models/sampled_oscillator.hpp"
#include "identify/records/usable_histories.hpp"
#include "identify/statistics/correlated_regression.hpp"
#include "identify/statistics/lasting_part.hpp"
#include "identify/statistics/least_squares.hpp"
#include "identify/statistics/statistics.hpp"
#include "identify/uncertainty/parametric_bootstrap.hpp"
#include "identify/uncertainty/synthetic_record.hpp"

namespace dualdamp::identify {

namespace {

using By = SampledOscillator::By;

void judge_residuals(const Eigen::VectorXd& residuals, Estimate& estimate) {
  LastingPart lasting;
  lasting.add({residuals.data(), static_cast<std::size_t>(residuals.size())});
  const double deviation = std::sqrt(std::max(0.0, lasting.mean_product()));
  const double chance = 3.0 / std::sqrt(static_cast<double>(residuals.size()));
  constexpr double of_weight = 1e-3;
  if (lasting.correlation() < chance || deviation < of_weight) return;
  estimate.findings.push_back(
      "what the fit leaves is not noise alone: " + core::percent(deviation, 3) +
      " of the amplitude lasts from sample to sample, so the law, a constant or the drive is wrong");
}

/// Covariance of (m, c, k, F0) from that of the fit.
Eigen::Matrix4d force_covariance(const ForwardLayout& layout, const Eigen::MatrixXd& covariance) {
  const auto place = [](By by) { return by == By::mass ? 0 : by == By::damping ? 1 : by == By::stiffness ? 2 : 3; };
  Eigen::Matrix4d of_force = Eigen::Matrix4d::Zero();
  const std::vector<ForwardLayout::Entry>& shared = layout.shared();
  for (std::size_t i = 0; i < shared.size(); ++i)
    for (std::size_t j = 0; j < shared.size(); ++j)
      of_force(place(shared[i].by), place(shared[j].by)) =
          covariance(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) * shared[i].scale *
          shared[j].scale;
  return of_force;
}

/// Estimate from other residuals by one step of Gauss and Newton, which suffices because noise moves the fit only a
/// little.
std::optional<ParameterReading> reading_of(const ForwardLayout& layout, const LeastSquaresFit& found,
                                           const Eigen::VectorXd& residuals,
                                           const std::vector<Eigen::Index>& blocks) {
  const std::optional<CorrelatedFit> step = fit_correlated(found.jacobian, residuals, blocks);
  if (!step) return std::nullopt;
  const ForceParameters force = layout.force(found.parameters - step->coefficients);
  return ParameterReading{Eigen::Vector4d(force.m, force.c, force.k, force.F0),
                          force_covariance(layout, step->covariance).diagonal().cwiseSqrt()};
}

std::optional<BootstrapSpread> spread_of(const std::vector<ForwardTest>& tests, const ForwardLayout& layout,
                                         const ForwardResiduals& residuals, const LeastSquaresFit& found,
                                         const ParameterReading& own) {
  std::vector<NumberedHistory> histories;
  std::vector<MotionStart> starts;
  for (std::size_t t = 0; t < tests.size(); ++t) {
    histories.push_back({tests[t].number, tests[t].history});
    const SampledOscillator::Parameters begin = layout.parameters(found.parameters, t, tests[t]);
    starts.push_back({begin.x0, begin.v0, begin.places});
  }
  ForceParameters truth = layout.force(found.parameters);
  const std::optional<SyntheticRecords> synthetic = synthetic_records(histories, truth, 0.0, starts);
  if (!synthetic) return std::nullopt;
  const auto read = [&](const Record& drawn) -> std::optional<ParameterReading> {
    Eigen::VectorXd misses(residuals.count());
    for (std::size_t t = 0; t < tests.size(); ++t) {
      const History& history = drawn.histories[t];
      Eigen::VectorXd x;
      if (!SampledOscillator(history, tests[t].model.steps())
               .run(layout.parameters(found.parameters, t, tests[t]), {}, x, nullptr))
        return std::nullopt;
      misses.segment(residuals.blocks()[t], x.size()) =
          (x - Eigen::Map<const Eigen::VectorXd>(history.x.data(), x.size())) / layout.length();
    }
    return reading_of(layout, found, misses, residuals.blocks());
  };
  return bootstrap_spread(
      own, Eigen::Vector4d(truth.m, truth.c, truth.k, truth.F0),
      [&](int number) { return synthetic->record(number); }, read,
      synthetic_records_for(static_cast<std::size_t>(residuals.count())));
}

/// Change of the residuals by a force v|v|; empty if the motion with it cannot be computed.
Eigen::VectorXd drag_term(std::vector<ForwardTest>& tests, const ForwardLayout& layout,
                          const ForwardResiduals& residuals, const Eigen::VectorXd& p) {
  const std::vector<SampledOscillator::Force> drag = {
      [](const SampledOscillator::Instant& at) { return at.v * at.v * at.direction; }};
  Eigen::VectorXd term(residuals.count());
  Eigen::VectorXd x;
  SampledOscillator::Derivatives derivatives;
  for (std::size_t t = 0; t < tests.size(); ++t) {
    if (!tests[t].model.run(layout.parameters(p, t, tests[t]), {}, x, &derivatives, nullptr, drag)) return {};
    term.segment(residuals.blocks()[t], x.size()) = derivatives.x.col(0);
  }
  return term;
}

void report(std::vector<ForwardTest>& tests, const ForwardLayout& layout, const ForwardResiduals& residuals,
            const LeastSquaresFit& found, Estimate& estimate, std::vector<std::string>& faults) {
  const ForceParameters force = layout.force(found.parameters);
  estimate.value = parameters(force);
  const std::optional<ParameterReading> own = reading_of(layout, found, found.residuals, residuals.blocks());
  if (!own) {
    faults.emplace_back("this motion does not distinguish the parameters");
    return;
  }
  const std::optional<BootstrapSpread> spread = spread_of(tests, layout, residuals, found, *own);
  set_estimate(estimate, force, spread);
  for (const ForwardLayout::Entry& entry : layout.shared()) {
    if (entry.by == By::mass) estimate.others.push_back(further("mass", "kg", force.m, spread, 0));
    if (entry.by == By::stiffness) estimate.others.push_back(further("stiffness", "N/m", force.k, spread, 2));
  }
  const double left = std::sqrt(found.sum_of_squares / static_cast<double>(found.residuals.size()));
  estimate.others.push_back({"residual_deviation", "m", left * layout.length(), std::nullopt, std::nullopt});
  judge_residuals(found.residuals, estimate);
  const Eigen::VectorXd drag = drag_term(tests, layout, residuals, found.parameters);
  if (drag.size() == 0) return;
  estimate.lack_of_fit =
      correlated_term_test(found.jacobian, found.residuals, drag, residuals.blocks(), 1.0, "v|v| term t-test");
  if (estimate.lack_of_fit && estimate.lack_of_fit->fired)
    estimate.findings.emplace_back("friction over speed is not a straight line");
}

}  // namespace

Estimate output_error(const Record& record, const KnownConstants& constants, const RegressionOptions& options) {
  Estimate estimate;
  estimate.method = output_error_method.name;
  ForwardFit forward(record, constants, options, estimate);
  if (!forward.problem().empty()) {
    refuse(estimate, forward.problem());
    return estimate;
  }
  std::vector<ForwardTest>& tests = forward.tests();
  const ForwardLayout& layout = forward.layout();
  const ForwardResiduals& residuals = forward.residuals();
  std::vector<std::string> faults;
  report(tests, layout, residuals, forward.found(), estimate, faults);
  for (const ForwardTest& test : tests) estimate.used.push_back(test.number);
  const ForceParameters force = layout.force(forward.found().parameters);
  const double scale = force.k * layout.length();
  judge_force_signs(estimate, std::sqrt(force.m * force.k), scale, faults);
  conclude(estimate, faults,
           "rests on " + std::to_string(residuals.count()) + " samples of " + std::to_string(tests.size()) +
               (tests.size() == 1 ? " history" : " histories"));
  return estimate;
}

constinit const MethodEntry output_error_method{
    .name = "output_error",
    .summary = "friction with which a simulated motion comes closest to the measured displacement",
    .assumes =
        "linear spring, Coulomb and viscous friction, white noise; checked: v|v| term "
        "t-test, residuals that are alike from sample to sample",
    .equation = "min sum [x_i - x(t_i; c, F0, x(0), v(0))]^2, m x'' + c x' + k x + F0 sgn x' = k y + f",
    .sources = "ljung1999, leine2004",
    .needs = RecordKind::history,
    .lacks = lacks_histories,
    .call = call_of<output_error>,
    .rests_on = AssumptionSet::all_but(Assumption::drive),
};

}  // namespace dualdamp::identify
