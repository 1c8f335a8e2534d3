#include "identify/methods/histories/forward_fit.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <optional>
#include <utility>

#include "core/constants.hpp"
#include "identify/methods/decays/free_decay.hpp"
#include "identify/methods/histories/acceleration_velocity_displacement.hpp"
#include "identify/models/force_parameters.hpp"
#include "identify/records/derived_records.hpp"
#include "identify/records/turning_points.hpp"
#include "identify/statistics/noise_level.hpp"

namespace dualdamp::identify {

using By = SampledOscillator::By;

ForwardTest::ForwardTest(const NumberedHistory& item)
    : number(item.number), history(item.history), model(*item.history), places(model.steps().size(), 0.5) {
  constexpr std::size_t samples = 8;
  const std::vector<double> begin(history->x.begin(), history->x.begin() + samples);
  x0 = begin[0];
  // Noise alone separates the extremes of eight samples by about three deviations, and very rarely by six.
  const bool hardly_moves = range_of(begin) <= 6.0 * noise_level(begin) + 1e-12 * range_of(history->x);
  // Near a turn a mass hardly moves either, and a record of a free vibration often begins there.
  starts_at_rest = hardly_moves && history->has_drive();
  if (!history->v.empty())
    v0 = history->v[0];
  else if (!hardly_moves)
    v0 = central_difference(five_point_average(history->x), history->sample_rate)[2];
}

double ForwardLayout::length(const std::vector<ForwardTest>& tests) {
  double longest = 0.0;
  for (const ForwardTest& test : tests) longest = std::max(longest, 0.5 * range_of(test.history->x));
  return longest;
}

namespace {

/// The record of which each test is a part, from 0.
std::vector<Eigen::Index> records_of(const std::vector<ForwardTest>& tests) {
  std::vector<Eigen::Index> records(tests.size(), 0);
  for (std::size_t t = 1; t < tests.size(); ++t) {
    const int own = tests[t].history->part_of;
    const bool goes_on = own > 0 && own == tests[t - 1].history->part_of;
    records[t] = records[t - 1] + (goes_on ? 0 : 1);
  }
  return records;
}

}  // namespace

ForwardLayout::ForwardLayout(const std::vector<ForwardTest>& tests, const KnownConstants& constants,
                             const ForceParameters& start) {
  shared_ = {{By::damping, std::sqrt(start.m * start.k)}, {By::friction, start.k * length(tests)}};
  if (std::isnan(constants.mass)) shared_.push_back({By::mass, start.m});
  if (std::isnan(constants.stiffness)) shared_.push_back({By::stiffness, start.k});
  count_ = static_cast<Eigen::Index>(shared_.size());
  for (const ForwardTest& test : tests) {
    first_.push_back(count_);
    count_ += (test.starts_at_rest ? 1 : 2) + static_cast<Eigen::Index>(test.places.size());
  }
  records_ = records_of(tests);
  count_ += count_of_zeros();
  constexpr double far = 1e3;  // in units of the scales
  low_ = Eigen::VectorXd::Constant(count_, -far);
  high_ = Eigen::VectorXd::Constant(count_, far);
  low_[1] = 0.0;  // friction must not be negative
  for (std::size_t t = 0; t < tests.size(); ++t) {
    const auto places = static_cast<Eigen::Index>(tests[t].places.size());
    low_.segment(first_place(t, tests[t]), places).setZero();
    high_.segment(first_place(t, tests[t]), places).setOnes();
  }
  length_ = length(tests);
  speed_ = length_ * start.natural_frequency();
  known_ = start;
}

Eigen::VectorXd ForwardLayout::pack(const ForceParameters& force, const std::vector<ForwardTest>& tests) const {
  Eigen::VectorXd p(count_);
  for (std::size_t i = 0; i < shared_.size(); ++i)
    p[static_cast<Eigen::Index>(i)] = value(force, shared_[i].by) / shared_[i].scale;
  for (std::size_t t = 0; t < tests.size(); ++t) {
    p[first_[t]] = tests[t].x0 / length_;
    if (!tests[t].starts_at_rest) p[first_[t] + 1] = tests[t].v0 / speed_;
    std::ranges::copy(tests[t].places, p.data() + first_place(t, tests[t]));
    if (records_[t] > 0) p[count_ - count_of_zeros() + records_[t] - 1] = tests[t].zero / length_;
  }
  return p;
}

bool ForwardResiduals::evaluate(const Eigen::VectorXd& p, Eigen::VectorXd& residuals,
                                Eigen::MatrixXd* jacobian) const {
  residuals.resize(count_);
  if (jacobian != nullptr) jacobian->setZero(count_, layout_.count());
  Eigen::VectorXd x;
  SampledOscillator::Derivatives derivatives;
  for (std::size_t t = 0; t < tests_.size(); ++t) {
    const std::vector<ForwardLayout::Column> columns = layout_.columns(t, tests_[t]);
    std::vector<By> by;
    for (const ForwardLayout::Column& column : columns) by.push_back(column.by);
    if (!tests_[t].model.run(layout_.parameters(p, t, tests_[t]), by, x,
                             jacobian != nullptr ? &derivatives : nullptr))
      return false;
    const std::vector<double>& measured = tests_[t].history->x;
    residuals.segment(blocks_[t], x.size()) =
        (x - Eigen::Map<const Eigen::VectorXd>(measured.data(), x.size())) / layout_.length();
    residuals.segment(blocks_[t], x.size()).array() += layout_.zero(p, t) / layout_.length();
    if (jacobian == nullptr) continue;
    Eigen::MatrixXd zeros = Eigen::MatrixXd::Zero(x.size(), layout_.count());
    layout_.put_zeros(t, zeros);
    jacobian->middleRows(blocks_[t], x.size()) = zeros / layout_.length();
    for (std::size_t j = 0; j < columns.size(); ++j)
      jacobian->col(columns[j].column).segment(blocks_[t], x.size()) =
          derivatives.x.col(static_cast<Eigen::Index>(j)) * (columns[j].scale / layout_.length());
  }
  return true;
}

namespace {

/// Starting point from the extremes of a free vibration. The fit of a long decay has many local minima; this point
/// is near the lowest.
std::optional<ForceParameters> from_extremes(const ForwardTest& test, ForceParameters known,
                                             const KnownConstants& constants) {
  Record record;
  record.decay = decay_of(*test.history).record;
  if (const std::vector<double>& times = record.decay->times; times.size() > 1) {
    const double half_period = (times.back() - times.front()) / static_cast<double>(times.size() - 1);
    const double natural = std::numbers::pi / half_period;
    if (std::isnan(constants.stiffness))
      known.k = known.m * natural * natural;
    else if (std::isnan(constants.mass))
      known.m = known.k / (natural * natural);
  }
  const Estimate estimate = free_decay(record, {known.m, known.k, unknown}, {});
  if (!estimate.outcome.ok()) return std::nullopt;
  return ForceParameters{known.m, std::max(0.0, estimate.value.c), known.k, std::max(0.0, estimate.value.F0)};
}

/// Starting points: the regression of forces if it gives an estimate, otherwise a guess. `all`: all points at which
/// the fit may begin.
std::vector<ForceParameters> starts(const Record& record, const std::vector<ForwardTest>& tests,
                                    const KnownConstants& constants, const RegressionOptions& options) {
  Record used;
  for (const ForwardTest& test : tests) used.histories.push_back(*test.history);
  ForceParameters force{constants.mass, 0.0, constants.stiffness, 0.0};
  if (const std::optional<ForceParameters> regression =
          regressed_forces(record.histories.size() == tests.size() ? record : used, constants, options))
    force = {regression->m, regression->c, regression->k, std::max(0.0, regression->F0)};
  if (!(force.m > 0.0) || !(force.k > 0.0)) return {};
  std::vector<ForceParameters> list{force};
  for (const ForwardTest& test : tests)
    if (const auto start = test.history->has_drive() ? std::nullopt : from_extremes(test, force, constants))
      list.push_back(*start);
  const double length = ForwardLayout::length(tests);
  const double critical = critical_damping(force.m, force.k);
  for (const double zeta : {0.02, 0.1, 0.25, 0.5, 0.8, 1.2})
    for (const double share : {0.02, 0.1, 0.25})
      list.push_back({force.m, zeta * critical, force.k, share * force.k * length});
  return list;
}

/// The starting points in the order of their sums of squares. The first of the list comes last if none has one.
std::vector<Eigen::VectorXd> sorted_starts(const std::vector<ForceParameters>& list,
                                           const std::vector<ForwardTest>& tests, const ForwardLayout& layout,
                                           const ForwardResiduals& residuals) {
  std::vector<std::pair<double, Eigen::VectorXd>> rated;
  Eigen::VectorXd r;
  for (const ForceParameters& force : list) {
    Eigen::VectorXd p = layout.pack(force, tests);
    if (residuals.evaluate(p, r, nullptr) && std::isfinite(r.squaredNorm()))
      rated.emplace_back(r.squaredNorm(), std::move(p));
  }
  std::ranges::stable_sort(rated, {}, [](const auto& start) { return start.first; });
  std::vector<Eigen::VectorXd> sorted;
  for (auto& start : rated) sorted.push_back(std::move(start.second));
  if (sorted.empty()) sorted.push_back(layout.pack(list.front(), tests));
  return sorted;
}

/// Free vibrations, cut off where they stay below `share` of their largest deflection; nothing if that cuts off
/// little. After that the mass comes to rest, at a place that jumps with the parameters.
std::optional<Record> large_motion(const std::vector<ForwardTest>& tests, double share) {
  Record record;
  bool shorter = false;
  for (const ForwardTest& test : tests) {
    History history = *test.history;
    const auto [low, high] = std::ranges::minmax_element(history.x);
    const double least = share * std::max(std::abs(*low), std::abs(*high));
    std::size_t last = history.x.size();
    while (last > 0 && std::abs(history.x[last - 1]) < least) --last;
    constexpr double little = 0.9;
    if (!history.has_drive() && static_cast<double>(last) < little * static_cast<double>(history.x.size())) {
      for (std::vector<double>* signal : {&history.x, &history.v, &history.a})
        if (!signal->empty()) signal->resize(last);
      shorter = true;
    }
    record.histories.push_back(std::move(history));
  }
  return shorter ? std::optional(std::move(record)) : std::nullopt;
}

/// Whether a free vibration comes to rest within a few half swings. `share`: of the first swing, that friction
/// holds.
bool stops_soon(double zeta, double share) {
  constexpr int few = 10;
  if (zeta >= 1.0) return true;
  const double decay = std::exp(-std::numbers::pi * zeta / std::sqrt(1.0 - zeta * zeta));
  double swing = 1.0;
  for (int i = 0; i < few; ++i) {
    swing = decay * swing - share * (1.0 + decay);
    if (swing < share) return true;
  }
  return false;
}

/// Why there is nothing to fit; empty otherwise.
std::string fault_of_tests(const std::vector<ForwardTest>& tests, const KnownConstants& constants) {
  constexpr std::size_t most_samples = 300'000;  // each step of the fit goes through all of them
  std::size_t samples = 0;
  for (const ForwardTest& test : tests) samples += test.history->x.size();
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

ForwardFit::ForwardFit(const Record& record, const KnownConstants& constants, const RegressionOptions& options,
                       Estimate& estimate) {
  // The motion is compared as it is: no filter limits how short a history may be.
  for (const NumberedHistory& item : usable_histories(record, {.cutoffs = {0.0}}, estimate)) {
    if (range_of(item.history->x) > 0.0)
      tests_.emplace_back(item);
    else
      estimate.excluded.push_back({item.number, "the mass does not move"});
  }
  problem_ = estimate.outcome.ok() ? fault_of_tests(tests_, constants) : estimate.outcome.reason;
  if (problem_.empty()) search(record, constants, options);
}

void ForwardFit::search(const Record& record, const KnownConstants& constants, const RegressionOptions& options) {
  const std::vector<ForceParameters> list = starts(record, tests_, constants, options);
  if (list.empty()) {
    problem_ = "the method needs the mass and the stiffness: the record does not determine them";
    return;
  }
  LeastSquaresProblem problem = set_up(constants, list.front());
  const std::vector<Eigen::VectorXd> sorted = sorted_starts(list, tests_, *layout_, *residuals_);
  problem.start = sorted.front();
  constexpr double large = 0.3;
  if (const std::optional<Record> part = large_motion(tests_, large)) {
    Estimate taken;
    ForwardFit first(*part, constants, options, taken);
    if (first.problem().empty() && first.tests().size() == tests_.size()) {
      found_ = fit(problem);
      problem.start = first.as_start(*layout_, tests_);
    }
  }
  LeastSquaresFit last = fit(problem);
  const bool is_first = found_.parameters.size() == 0;
  if (is_first || (last.outcome.ok() && last.sum_of_squares < found_.sum_of_squares)) found_ = std::move(last);
  search_further(std::move(problem), sorted);
  if (!found_.outcome.ok())
    problem_ = found_.outcome.reason;
  else
    free_speeds(constants);
}

void ForwardFit::search_further(LeastSquaresProblem problem, const std::vector<Eigen::VectorXd>& starts) {
  if (!found_.outcome.ok()) return;
  const ForceParameters force = layout_->force(found_.parameters);
  // A motion of few half swings: the place where it stops tells F0, and each number of half swings has a minimum,
  // with more damping and less friction or the other way round.
  constexpr double heavy = 0.25;
  const double zeta = force.c / critical_damping(force.m, force.k);
  const double share = force.F0 / (force.k * layout_->length());
  const bool all_free =
      std::ranges::none_of(tests_, [](const ForwardTest& test) { return test.history->has_drive(); });
  const bool is_short = zeta > heavy || (all_free && stops_soon(zeta, share));
  const bool without_friction = found_.parameters[1] <= problem.low[1];
  const std::size_t count = is_short ? 6 : without_friction ? 2 : 0;
  std::vector<Eigen::VectorXd> more(starts.begin(),
                                    starts.begin() + static_cast<std::ptrdiff_t>(std::min(count, starts.size())));
  if (is_short && all_free) std::ranges::copy(starts_beside(found_.parameters), std::back_inserter(more));
  for (const Eigen::VectorXd& start : more) {
    problem.start = start;
    LeastSquaresFit other = fit(problem);
    if (other.outcome.ok() && other.sum_of_squares < found_.sum_of_squares) found_ = std::move(other);
  }
}

std::vector<Eigen::VectorXd> ForwardFit::starts_beside(const Eigen::VectorXd& found) const {
  const double unit = layout_->force(found).k * layout_->length() / layout_->shared()[1].scale;
  std::vector<Eigen::VectorXd> list;
  Eigen::VectorXd r;
  for (const double share : {0.01, 0.02, 0.03, 0.045, 0.07, 0.1, 0.15}) {
    double least = core::infinity;
    Eigen::VectorXd best;
    for (const double damping : {0.7, 0.8, 0.85, 0.9, 0.95, 1.0, 1.1, 1.25}) {
      Eigen::VectorXd p = found;
      p[0] *= damping;
      p[1] = share * unit;
      if (!residuals_->evaluate(p, r, nullptr) || !(r.squaredNorm() < least)) continue;
      least = r.squaredNorm();
      best = std::move(p);
    }
    if (best.size() > 0) list.push_back(std::move(best));
  }
  return list;
}

LeastSquaresProblem ForwardFit::set_up(const KnownConstants& constants, const ForceParameters& start) {
  layout_ = std::make_unique<ForwardLayout>(tests_, constants, start);
  residuals_ = std::make_unique<ForwardResiduals>(tests_, *layout_);
  LeastSquaresProblem problem;
  problem.residuals = residuals_->count();
  problem.low = layout_->low();
  problem.high = layout_->high();
  problem.evaluate = [this](const Eigen::VectorXd& p, Eigen::VectorXd& r, Eigen::MatrixXd* jacobian) {
    return residuals_->evaluate(p, r, jacobian);
  };
  return problem;
}

void ForwardFit::free_speeds(const KnownConstants& constants) {
  std::vector<ForwardTest*> resting;
  for (ForwardTest& test : tests_)
    if (test.starts_at_rest) resting.push_back(&test);
  if (resting.empty()) return;
  const LeastSquaresFit at_rest = std::move(found_);
  std::unique_ptr<ForwardLayout> layout = std::move(layout_);
  std::unique_ptr<ForwardResiduals> residuals = std::move(residuals_);
  for (std::size_t t = 0; t < tests_.size(); ++t) {
    const SampledOscillator::Parameters found = layout->parameters(at_rest.parameters, t, tests_[t]);
    tests_[t].x0 = found.x0;
    tests_[t].places = found.places;
    tests_[t].zero = layout->zero(at_rest.parameters, t);
  }
  for (ForwardTest* test : resting) test->starts_at_rest = false;
  const ForceParameters force = layout->force(at_rest.parameters);
  LeastSquaresProblem problem = set_up(constants, force);
  problem.start = layout_->pack(force, tests_);
  found_ = fit(problem);
  // Four standard errors for each speed.
  constexpr double clear = 16.0;
  const double variance =
      found_.sum_of_squares / static_cast<double>(std::max<Eigen::Index>(1, problem.residuals - layout_->count()));
  const double gain = at_rest.sum_of_squares - found_.sum_of_squares;
  if (found_.outcome.ok() && gain > clear * static_cast<double>(resting.size()) * variance) return;
  for (ForwardTest* test : resting) test->starts_at_rest = true;
  layout_ = std::move(layout);
  residuals_ = std::move(residuals);
  found_ = at_rest;
}

Eigen::VectorXd ForwardFit::as_start(const ForwardLayout& layout, std::vector<ForwardTest>& tests) const {
  for (std::size_t t = 0; t < tests.size(); ++t) {
    const SampledOscillator::Parameters begin = layout_->parameters(found_.parameters, t, tests_[t]);
    tests[t].x0 = begin.x0;
    tests[t].v0 = begin.v0;
    tests[t].zero = layout_->zero(found_.parameters, t);
    if (tests[t].places.size() == begin.places.size()) tests[t].places = begin.places;
  }
  return layout.pack(layout_->force(found_.parameters), tests);
}

}  // namespace dualdamp::identify
