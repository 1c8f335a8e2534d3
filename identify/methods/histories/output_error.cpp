#include "identify/methods/histories/output_error.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "core/numbers.hpp"
#include "identify/methods/histories/acceleration_velocity_displacement.hpp"
#include "identify/models/force_parameters.hpp"
#include "identify/models/sampled_oscillator.hpp"
#include "identify/statistics/correlated_regression.hpp"
#include "identify/statistics/lasting_part.hpp"
#include "identify/statistics/least_squares.hpp"
#include "identify/statistics/noise_level.hpp"
#include "identify/statistics/statistics.hpp"
#include "identify/uncertainty/parametric_bootstrap.hpp"
#include "identify/uncertainty/synthetic_record.hpp"

namespace dualdamp::identify {

namespace {

using By = SampledOscillator::By;

double range_of(const std::vector<double>& signal) {
  const auto [low, high] = std::ranges::minmax_element(signal);
  return *high - *low;
}

/// One history with its forward model.
struct Test {
  int number = 0;
  const History* history = nullptr;
  SampledOscillator model;
  double x0 = 0.0;
  double v0 = 0.0;
  bool starts_at_rest = false;  ///< its initial velocity is zero and not fitted

  explicit Test(const NumberedHistory& item) : number(item.number), history(item.history), model(*item.history) {
    constexpr std::size_t samples = 8;
    const std::vector<double> begin(history->x.begin(), history->x.begin() + samples);
    x0 = begin[0];
    // Noise moves the extremes of eight samples three deviations apart, hardly ever six.
    starts_at_rest = range_of(begin) <= 6.0 * noise_level(begin) + 1e-12 * range_of(history->x);
    if (!history->v.empty())
      v0 = history->v[0];
    else if (!starts_at_rest)
      v0 = central_difference(five_point_average(history->x), history->sample_rate)[2];
  }
};

/// The parameters of the fit, each divided by a scale: c, F0, then mass and stiffness where unknown, then the
/// initial states of each test.
class Layout {
 public:
  Layout(const std::vector<Test>& tests, const KnownConstants& constants, const ForceParameters& start) {
    shared_ = {{By::damping, std::sqrt(start.m * start.k)}, {By::friction, start.k * length(tests)}};
    if (std::isnan(constants.mass)) shared_.push_back({By::mass, start.m});
    if (std::isnan(constants.stiffness)) shared_.push_back({By::stiffness, start.k});
    count_ = static_cast<Eigen::Index>(shared_.size());
    for (const Test& test : tests) {
      first_.push_back(count_);
      count_ += test.starts_at_rest ? 1 : 2;
    }
    length_ = length(tests);
    speed_ = length_ * std::sqrt(start.k / start.m);
    known_ = start;
  }

  struct Entry {
    By by;
    double scale;
  };

  [[nodiscard]] static double length(const std::vector<Test>& tests) {
    double longest = 0.0;
    for (const Test& test : tests) longest = std::max(longest, 0.5 * range_of(test.history->x));
    return longest;
  }

  [[nodiscard]] Eigen::Index count() const { return count_; }
  [[nodiscard]] double length() const { return length_; }
  [[nodiscard]] const std::vector<Entry>& shared() const { return shared_; }

  [[nodiscard]] Eigen::VectorXd pack(const ForceParameters& force, const std::vector<Test>& tests) const {
    Eigen::VectorXd p(count_);
    for (std::size_t i = 0; i < shared_.size(); ++i)
      p[static_cast<Eigen::Index>(i)] = value(force, shared_[i].by) / shared_[i].scale;
    for (std::size_t t = 0; t < tests.size(); ++t) {
      p[first_[t]] = tests[t].x0 / length_;
      if (!tests[t].starts_at_rest) p[first_[t] + 1] = tests[t].v0 / speed_;
    }
    return p;
  }

  [[nodiscard]] ForceParameters force(const Eigen::VectorXd& p) const {
    ForceParameters force = known_;
    for (std::size_t i = 0; i < shared_.size(); ++i)
      value(force, shared_[i].by) = p[static_cast<Eigen::Index>(i)] * shared_[i].scale;
    return force;
  }

  [[nodiscard]] SampledOscillator::Parameters parameters(const Eigen::VectorXd& p, std::size_t t,
                                                         const Test& test) const {
    const ForceParameters f = force(p);
    return {f.m, f.c, f.k, f.F0, p[first_[t]] * length_, test.starts_at_rest ? 0.0 : p[first_[t] + 1] * speed_};
  }

  /// What test t is differentiated by, with the column and the scale of each.
  struct Column {
    By by;
    Eigen::Index column;
    double scale;
  };
  [[nodiscard]] std::vector<Column> columns(std::size_t t, const Test& test) const {
    std::vector<Column> list;
    for (std::size_t i = 0; i < shared_.size(); ++i)
      list.push_back({shared_[i].by, static_cast<Eigen::Index>(i), shared_[i].scale});
    list.push_back({By::position, first_[t], length_});
    if (!test.starts_at_rest) list.push_back({By::velocity, first_[t] + 1, speed_});
    return list;
  }

  static double& value(ForceParameters& force, By by) {
    return by == By::damping ? force.c : by == By::friction ? force.F0 : by == By::mass ? force.m : force.k;
  }
  static double value(const ForceParameters& force, By by) {
    ForceParameters copy = force;
    return value(copy, by);
  }

 private:
  std::vector<Entry> shared_;
  std::vector<Eigen::Index> first_;
  Eigen::Index count_ = 0;
  double length_ = 1.0;
  double speed_ = 1.0;
  ForceParameters known_;
};

/// Residuals of all tests [in units of the layout's length], and their derivatives.
class Residuals {
 public:
  Residuals(std::vector<Test>& tests, const Layout& layout) : tests_(tests), layout_(layout) {
    for (const Test& test : tests_) {
      blocks_.push_back(count_);
      count_ += static_cast<Eigen::Index>(test.history->x.size());
    }
  }

  [[nodiscard]] Eigen::Index count() const { return count_; }
  [[nodiscard]] const std::vector<Eigen::Index>& blocks() const { return blocks_; }

  bool evaluate(const Eigen::VectorXd& p, Eigen::VectorXd& residuals, Eigen::MatrixXd* jacobian) const {
    residuals.resize(count_);
    if (jacobian != nullptr) jacobian->setZero(count_, layout_.count());
    Eigen::VectorXd x;
    Eigen::MatrixXd derivatives;
    for (std::size_t t = 0; t < tests_.size(); ++t) {
      const std::vector<Layout::Column> columns = layout_.columns(t, tests_[t]);
      std::vector<By> by;
      for (const Layout::Column& column : columns) by.push_back(column.by);
      if (!tests_[t].model.run(layout_.parameters(p, t, tests_[t]), by, x,
                               jacobian != nullptr ? &derivatives : nullptr))
        return false;
      const std::vector<double>& measured = tests_[t].history->x;
      residuals.segment(blocks_[t], x.size()) =
          (x - Eigen::Map<const Eigen::VectorXd>(measured.data(), x.size())) / layout_.length();
      if (jacobian == nullptr) continue;
      for (std::size_t j = 0; j < columns.size(); ++j)
        jacobian->col(columns[j].column).segment(blocks_[t], x.size()) =
            derivatives.col(static_cast<Eigen::Index>(j)) * (columns[j].scale / layout_.length());
    }
    return true;
  }

  /// What a force v|v| would add.
  [[nodiscard]] Eigen::VectorXd drag_term(const Eigen::VectorXd& p) const {
    Eigen::VectorXd term(count_);
    Eigen::VectorXd x;
    Eigen::MatrixXd derivative;
    for (std::size_t t = 0; t < tests_.size(); ++t) {
      if (!tests_[t].model.run(layout_.parameters(p, t, tests_[t]), {By::drag}, x, &derivative)) return {};
      term.segment(blocks_[t], x.size()) = derivative.col(0);
    }
    return term;
  }

 private:
  std::vector<Test>& tests_;
  const Layout& layout_;
  std::vector<Eigen::Index> blocks_;
  Eigen::Index count_ = 0;
};

/// Where to start: the regression of forces when it gives something, else a guess; `all`: what the fit may begin
/// with.
std::vector<ForceParameters> starts(const Record& record, const std::vector<Test>& tests,
                                    const KnownConstants& constants, const RegressionOptions& options) {
  Record used;
  for (const Test& test : tests) used.histories.push_back(*test.history);
  const Estimate regression = acceleration_velocity_displacement(
      record.histories.size() == tests.size() ? record : used, constants, options);
  ForceParameters force{constants.mass, 0.0, constants.stiffness, 0.0};
  if (regression.outcome.ok()) {
    force.c = regression.value.c;
    force.F0 = std::max(0.0, regression.value.F0);
    for (const FurtherParameter& parameter : regression.others) {
      if (parameter.name == "mass") force.m = parameter.value;
      if (parameter.name == "stiffness") force.k = parameter.value;
    }
  }
  if (!(force.m > 0.0) || !(force.k > 0.0)) return {};
  std::vector<ForceParameters> list{force};
  const double length = Layout::length(tests);
  const double critical = 2.0 * std::sqrt(force.m * force.k);
  for (const double zeta : {0.02, 0.1, 0.25})
    for (const double share : {0.02, 0.1, 0.25})
      list.push_back({force.m, zeta * critical, force.k, share * force.k * length});
  return list;
}

/// The best start of all, by the squares it leaves.
Eigen::VectorXd best_start(const std::vector<ForceParameters>& list, const std::vector<Test>& tests,
                           const Layout& layout, const Residuals& residuals) {
  Eigen::VectorXd best = layout.pack(list.front(), tests);
  double least = std::numeric_limits<double>::infinity();
  Eigen::VectorXd r;
  for (const ForceParameters& force : list) {
    const Eigen::VectorXd p = layout.pack(force, tests);
    if (!residuals.evaluate(p, r, nullptr) || !(r.squaredNorm() < least)) continue;
    least = r.squaredNorm();
    best = p;
  }
  return best;
}

void judge_residuals(const Eigen::VectorXd& residuals, std::vector<std::string>& faults) {
  LastingPart lasting;
  lasting.add({residuals.data(), static_cast<std::size_t>(residuals.size())});
  const double deviation = std::sqrt(std::max(0.0, lasting.mean_product()));
  const double chance = 3.0 / std::sqrt(static_cast<double>(residuals.size()));
  constexpr double of_weight = 1e-3;
  if (lasting.correlation() < chance || deviation < of_weight) return;
  faults.push_back("what the fit leaves is not noise alone: " + percent(deviation).substr(1) +
                   " of the amplitude lasts from sample to sample, so the law, a constant or the drive is wrong");
}

/// Covariance of (m, c, k, F0) out of that of the fit.
Eigen::Matrix4d force_covariance(const Layout& layout, const Eigen::MatrixXd& covariance) {
  const auto place = [](By by) { return by == By::mass ? 0 : by == By::damping ? 1 : by == By::stiffness ? 2 : 3; };
  Eigen::Matrix4d of_force = Eigen::Matrix4d::Zero();
  const std::vector<Layout::Entry>& shared = layout.shared();
  for (std::size_t i = 0; i < shared.size(); ++i)
    for (std::size_t j = 0; j < shared.size(); ++j)
      of_force(place(shared[i].by), place(shared[j].by)) =
          covariance(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) * shared[i].scale *
          shared[j].scale;
  return of_force;
}

/// What one step of Gauss and Newton makes of other residuals at the estimate: so little does noise move the fit.
std::optional<Reading> reading_of(const Layout& layout, const LeastSquaresFit& found,
                                  const Eigen::VectorXd& residuals, const std::vector<Eigen::Index>& blocks) {
  const std::optional<CorrelatedFit> step = fit_correlated(found.jacobian, residuals, blocks);
  if (!step) return std::nullopt;
  const ForceParameters force = layout.force(found.parameters - step->coefficients);
  return Reading{Eigen::Vector4d(force.m, force.c, force.k, force.F0),
                 force_covariance(layout, step->covariance).diagonal().cwiseSqrt()};
}

std::optional<BootstrapSpread> spread_of(const std::vector<Test>& tests, const Layout& layout,
                                         const Residuals& residuals, const LeastSquaresFit& found,
                                         const Reading& own) {
  std::vector<NumberedHistory> histories;
  for (const Test& test : tests) histories.push_back({test.number, test.history});
  ForceParameters truth = layout.force(found.parameters);
  const std::optional<SyntheticRecords> synthetic = synthetic_records(histories, truth, 0.0);
  if (!synthetic) return std::nullopt;
  const auto read = [&](const Record& drawn) -> std::optional<Reading> {
    Eigen::VectorXd misses(residuals.count());
    for (std::size_t t = 0; t < tests.size(); ++t) {
      const History& history = drawn.histories[t];
      Eigen::VectorXd x;
      if (!SampledOscillator(history).run(layout.parameters(found.parameters, t, tests[t]), {}, x, nullptr))
        return std::nullopt;
      misses.segment(residuals.blocks()[t], x.size()) =
          (x - Eigen::Map<const Eigen::VectorXd>(history.x.data(), x.size())) / layout.length();
    }
    return reading_of(layout, found, misses, residuals.blocks());
  };
  return bootstrap_spread(
      own, Eigen::Vector4d(truth.m, truth.c, truth.k, truth.F0),
      [&](int number) { return synthetic->record(number); }, read);
}

void report(const std::vector<Test>& tests, const Layout& layout, const Residuals& residuals,
            const LeastSquaresFit& found, Estimate& estimate, std::vector<std::string>& faults) {
  const ForceParameters force = layout.force(found.parameters);
  estimate.value = parameters(force);
  const std::optional<Reading> own = reading_of(layout, found, found.residuals, residuals.blocks());
  if (!own) {
    faults.emplace_back("the motion does not tell the parameters apart");
    return;
  }
  const std::optional<BootstrapSpread> spread = spread_of(tests, layout, residuals, found, *own);
  set_estimate(estimate, force, spread);
  for (const Layout::Entry& entry : layout.shared()) {
    if (entry.by == By::mass) estimate.others.push_back(further("mass", "kg", force.m, spread, 0));
    if (entry.by == By::stiffness) estimate.others.push_back(further("stiffness", "N/m", force.k, spread, 2));
  }
  const double left = std::sqrt(found.sum_of_squares / static_cast<double>(found.residuals.size()));
  estimate.others.push_back({"residual_deviation", "m", left * layout.length(), std::nullopt, std::nullopt});
  judge_residuals(found.residuals, faults);
  const Eigen::VectorXd drag = residuals.drag_term(found.parameters);
  if (drag.size() == 0) return;
  estimate.lack_of_fit =
      correlated_term_test(found.jacobian, found.residuals, drag, residuals.blocks(), 1.0, "v|v| term t-test");
  if (estimate.lack_of_fit && estimate.lack_of_fit->fired)
    faults.emplace_back("friction over speed is not a straight line");
}

/// Why there is nothing to fit; empty when there is.
std::string fault_of_tests(const std::vector<Test>& tests, const KnownConstants& constants) {
  constexpr std::size_t most_samples = 300'000;  // each step of the fit goes through all of them
  std::size_t samples = 0;
  for (const Test& test : tests) samples += test.history->x.size();
  if (samples > most_samples)
    return "the method takes at most " + std::to_string(most_samples) + " samples, and the record has " +
           std::to_string(samples) + ": give it a part, or every n-th sample";
  if (tests.empty()) return "the mass moves in no history";
  const auto is_usable = [](double value) { return std::isnan(value) || (value > 0.0 && std::isfinite(value)); };
  if (!is_usable(constants.stiffness)) return "the method needs a spring: without one the position drifts";
  if (!is_usable(constants.mass)) return "the mass must be positive and finite";
  return {};
}

}  // namespace

Estimate output_error(const Record& record, const KnownConstants& constants, const RegressionOptions& options) {
  Estimate estimate;
  estimate.method = "output_error";
  std::vector<Test> tests;
  for (const NumberedHistory& item : usable_histories(record, options, estimate)) {
    if (range_of(item.history->x) > 0.0)
      tests.emplace_back(item);
    else
      estimate.excluded.push_back({item.number, "the mass does not move"});
  }
  if (!estimate.outcome.ok()) return estimate;
  if (std::string fault = fault_of_tests(tests, constants); !fault.empty()) {
    refuse(estimate, std::move(fault));
    return estimate;
  }
  const std::vector<ForceParameters> list = starts(record, tests, constants, options);
  if (list.empty()) {
    refuse(estimate, "the method needs the mass and the stiffness: the record does not tell them");
    return estimate;
  }
  const Layout layout(tests, constants, list.front());
  const Residuals residuals(tests, layout);
  LeastSquaresProblem problem;
  problem.residuals = residuals.count();
  problem.start = best_start(list, tests, layout, residuals);
  constexpr double far = 1e3;  // in units of the scales
  problem.low = Eigen::VectorXd::Constant(layout.count(), -far);
  problem.high = Eigen::VectorXd::Constant(layout.count(), far);
  problem.low[1] = 0.0;  // friction that drives is none
  problem.evaluate = [&residuals](const Eigen::VectorXd& p, Eigen::VectorXd& r, Eigen::MatrixXd* jacobian) {
    return residuals.evaluate(p, r, jacobian);
  };
  const LeastSquaresFit found = fit(problem);
  if (!found.outcome.ok()) {
    refuse(estimate, found.outcome.reason);
    return estimate;
  }
  std::vector<std::string> faults;
  report(tests, layout, residuals, found, estimate, faults);
  for (const Test& test : tests) estimate.used.push_back(test.number);
  const ForceParameters force = layout.force(found.parameters);
  const double scale = force.k * layout.length();
  judge_force_signs(estimate, 1e-9 * std::sqrt(force.m * force.k), 1e-9 * scale, faults);
  conclude(estimate, faults,
           "rests on " + std::to_string(residuals.count()) + " samples of " + std::to_string(tests.size()) +
               (tests.size() == 1 ? " history" : " histories"));
  return estimate;
}

constinit const MethodEntry output_error_method{
    "output_error",
    "friction with which a simulated motion comes closest to the measured displacement",
    "linear spring, Coulomb and viscous friction, white noise; checked: v|v| term "
    "t-test, residuals that are alike from sample to sample",
    "min sum [x_i - x(t_i; c, F0, x(0), v(0))]^2, m x'' + c x' + k x + F0 sgn x' = k y + f",
    "ljung1999, leine2004",
    RecordKind::history,
    lacks_histories,
    call_of<output_error>};

}  // namespace dualdamp::identify
