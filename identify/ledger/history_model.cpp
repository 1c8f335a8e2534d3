#include "identify/ledger/history_model.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "identify/ledger/history_terms.hpp"
#include "identify/ledger/innovations.hpp"
#include "identify/methods/histories/forward_fit.hpp"
#include "identify/records/derived_records.hpp"
#include "identify/statistics/autoregression.hpp"
#include "identify/statistics/linear_least_squares.hpp"
#include "identify/statistics/noise_level.hpp"
#include "identify/statistics/statistics.hpp"

namespace dualdamp::identify {

namespace {

using By = SampledOscillator::By;

/// Rows of one sensor over all tests: the residual first, then the base columns, then the relaxations.
struct Channel {
  Eigen::MatrixXd rows;
  std::vector<Eigen::Index> blocks;
  int most_lags = 0;  ///< over which its errors may still be alike

  void add(const Eigen::MatrixXd& more) {
    blocks.push_back(rows.rows());
    Eigen::MatrixXd all(rows.rows() + more.rows(), more.cols());
    if (rows.rows() > 0) all.topRows(rows.rows()) = rows;
    all.bottomRows(more.rows()) = more;
    rows = std::move(all);
  }
};

double noise_of(const std::vector<double>& signal) {
  RobustNoiseLevel level;
  level.add(signal);
  return level.deviation();
}

/// Means of `width` rows each; what is left over at the end is dropped.
Eigen::MatrixXd averaged(const Eigen::MatrixXd& rows, Eigen::Index width) {
  Eigen::MatrixXd means(rows.rows() / width, rows.cols());
  for (Eigen::Index i = 0; i < means.rows(); ++i) means.row(i) = rows.middleRows(i * width, width).colwise().mean();
  return means;
}

/// d/dt of every column by central differences.
Eigen::MatrixXd differentiated(const Eigen::MatrixXd& columns, double rate) {
  Eigen::MatrixXd slopes = Eigen::MatrixXd::Zero(columns.rows(), columns.cols());
  const Eigen::Index inner = columns.rows() - 2;
  slopes.middleRows(1, inner) = 0.5 * rate * (columns.bottomRows(inner) - columns.topRows(inner));
  return slopes;
}

class Histories {
 public:
  Histories(ForwardFit& fit, const KnownConstants& constants) : fit_(fit), constants_(constants) {
    const ForceParameters force = fit.layout().force(fit.found().parameters);
    scale_ = {fit.layout().length(), fit.layout().length() * std::sqrt(force.k / force.m)};
    natural_ = std::sqrt(force.k / force.m);
    unit_force_ = force.k * scale_.length;
    list_relaxations();
  }

  JointModel model() {
    for (std::size_t t = 0; t < fit_.tests().size(); ++t) add_test(t);
    JointModel model;
    model.relaxations = relaxations_;
    std::vector<Eigen::MatrixXd> white;
    for (const Channel* channel : {&x_, &v_, &a_})
      if (channel->rows.rows() > 0) white.push_back(made_white(*channel));
    Eigen::Index rows = 0;
    for (const Eigen::MatrixXd& part : white) rows += part.rows();
    const Eigen::Index base = fit_.layout().count();
    model.residuals.resize(rows);
    model.base.resize(rows, base);
    model.relaxed.resize(rows, static_cast<Eigen::Index>(relaxations_.size()));
    Eigen::Index at = 0;
    for (const Eigen::MatrixXd& part : white) {
      model.residuals.segment(at, part.rows()) = part.col(0);
      model.base.middleRows(at, part.rows()) = part.middleCols(1, base);
      model.relaxed.middleRows(at, part.rows()) = part.rightCols(model.relaxed.cols());
      at += part.rows();
    }
    return model;
  }

 private:
  void list_relaxations() {
    if (!std::isnan(constants_.mass)) stated_.push_back(By::mass);
    if (!std::isnan(constants_.stiffness)) stated_.push_back(By::stiffness);
    for (const By by : stated_)
      relaxations_.push_back({Assumption::constants, by == By::mass ? "mass free" : "stiffness free"});
    for (const HistoryTerm& term : history_terms()) {
      relaxations_.push_back({term.assumption, std::string(term.test)});
      forces_.emplace_back(
          [&term, scale = scale_, unit = term.assumption == Assumption::sensors ? 1.0 : unit_force_](
              const SampledOscillator::Instant& at) { return unit * term.force(at, scale); });
    }
    const std::size_t tests = fit_.tests().size();
    constexpr std::size_t most = 8;
    contrasts_ = tests < 2 ? 0 : tests == 2 ? 1 : std::min(tests, most);
    for (std::size_t t = 0; t < contrasts_; ++t)
      relaxations_.push_back(
          {Assumption::stationarity, "friction force of history " + std::to_string(t + 1) + " free"});
    readings_ = relaxations_.size();
    const auto has = [&](std::vector<double> History::* signal) {
      return std::ranges::any_of(fit_.tests(),
                                 [&](const ForwardTest& test) { return !(test.history->*signal).empty(); });
    };
    add_readings("x", true);
    relaxations_.push_back({Assumption::sensors, "zero of x free"});
    add_readings("v", has(&History::v));
    add_readings("a", has(&History::a));
  }

  void add_readings(const std::string& signal, bool measured) {
    if (!measured) return;
    relaxations_.push_back({Assumption::sensors, "gain of " + signal + " free"});
    relaxations_.push_back({Assumption::sensors, "delay of " + signal + " free"});
  }

  /// The motion of a test and its derivatives by base parameters and relaxations, in the order of the columns.
  void add_test(std::size_t t) {
    ForwardTest& test = fit_.tests()[t];
    const ForwardLayout& layout = fit_.layout();
    const std::vector<ForwardLayout::Column> columns = layout.columns(t, test);
    std::vector<By> by;
    for (const ForwardLayout::Column& column : columns) by.push_back(column.by);
    by.insert(by.end(), stated_.begin(), stated_.end());
    Eigen::VectorXd x;
    Eigen::VectorXd v;
    SampledOscillator::Derivatives derivatives;
    if (!test.model.run(layout.parameters(fit_.found().parameters, t, test), by, x, &derivatives, &v, forces_))
      return;
    const History& history = *test.history;
    const double rate = history.sample_rate;
    const Eigen::MatrixXd in_x = arranged(t, columns, derivatives.x);
    const Eigen::MatrixXd in_v = arranged(t, columns, derivatives.v);
    const auto width = std::max<Eigen::Index>(1, std::lround(rate * 2.0 * std::numbers::pi / natural_ / 24.0));
    std::size_t place = readings_ + 3;
    Eigen::MatrixXd rows_x = rows_of(history.x, x, v, in_x, readings_);
    rows_x.col(1 + fit_.layout().count() + static_cast<Eigen::Index>(readings_) + 2).setConstant(scale_.length);
    Eigen::MatrixXd rows_v;
    if (!history.v.empty()) rows_v = rows_of(history.v, v, differentiated(v, rate), in_v, place);
    make_innovations(derivatives.steps, noise_levels(history), rows_x, rows_v);
    x_.add(averaged(rows_x, width));
    if (!history.v.empty()) v_.add(averaged(rows_v, width));
    const bool any_v = relaxations_.size() > place && relaxations_[place].test == "gain of v free";
    if (any_v) place += 2;
    if (history.a.empty()) return;
    const Eigen::VectorXd a = differentiated(v, rate);
    Eigen::MatrixXd in_a = differentiated(in_v, rate);
    std::vector<double> measured = history.a;
    Eigen::VectorXd modelled = a;
    for (Eigen::Index i = 0; i < v.size(); ++i) {
      const Eigen::Index first = std::max<Eigen::Index>(0, i - 2);
      const Eigen::Index last = std::min<Eigen::Index>(v.size() - 1, i + 2);
      if (v.segment(first, last - first + 1).minCoeff() > 0.0 ||
          v.segment(first, last - first + 1).maxCoeff() < 0.0)
        continue;
      in_a.row(i).setZero();
      measured[static_cast<std::size_t>(i)] = modelled[i] = 0.0;
    }
    Eigen::VectorXd jerk = differentiated(a, rate);
    for (Eigen::Index i = 0; i < v.size(); ++i)
      if (modelled[i] == 0.0) jerk[i] = 0.0;
    a_.add(averaged(rows_of(measured, modelled, jerk, in_a, place), width));
  }

  [[nodiscard]] ReadingNoise noise_levels(const History& history) const {
    const double k = fit_.layout().force(fit_.found().parameters).k;
    // Readings without any noise still round.
    constexpr double rounding = 1e-9;
    return {std::hypot(k * noise_of(history.y), noise_of(history.force)),
            std::max(noise_of(history.x), rounding * scale_.length),
            std::max(noise_of(history.v), rounding * scale_.speed)};
  }

  /// Base columns, then relaxations but for readings, from the derivatives of one test.
  [[nodiscard]] Eigen::MatrixXd arranged(std::size_t t, const std::vector<ForwardLayout::Column>& columns,
                                         const Eigen::MatrixXd& derivatives) const {
    const Eigen::Index base = fit_.layout().count();
    Eigen::MatrixXd result =
        Eigen::MatrixXd::Zero(derivatives.rows(), base + static_cast<Eigen::Index>(relaxations_.size()));
    Eigen::Index from = 0;
    for (const ForwardLayout::Column& column : columns)
      result.col(column.column) = derivatives.col(from++) * column.scale;
    Eigen::Index to = base;
    while (from < derivatives.cols()) result.col(to++) = derivatives.col(from++);
    if (t < contrasts_) result.col(to + static_cast<Eigen::Index>(t)) = result.col(1);
    return result;
  }

  /// Rows of one reading; its gain and delay are the relaxations from `place` on.
  [[nodiscard]] Eigen::MatrixXd rows_of(std::span<const double> measured, const Eigen::VectorXd& modelled,
                                        const Eigen::VectorXd& slope, const Eigen::MatrixXd& columns,
                                        std::size_t place) const {
    Eigen::MatrixXd rows(modelled.size(), columns.cols() + 1);
    rows.col(0) = Eigen::Map<const Eigen::VectorXd>(measured.data(), modelled.size()) - modelled;
    rows.rightCols(columns.cols()) = columns;
    const Eigen::Index gain = 1 + fit_.layout().count() + static_cast<Eigen::Index>(place);
    rows.col(gain) = modelled;
    rows.col(gain + 1) = -slope;
    return rows;
  }

  /// A channel with independent errors of unit variance, by what is left of it beside all columns.
  [[nodiscard]] static Eigen::MatrixXd made_white(const Channel& channel) {
    const Eigen::MatrixXd columns = channel.rows.rightCols(channel.rows.cols() - 1);
    const Eigen::VectorXd target = channel.rows.col(0);
    const Eigen::VectorXd left = target - columns * pivoted_least_squares(columns, target);
    const auto count = static_cast<double>(left.size());
    const int most = std::clamp(static_cast<int>(count / 20.0), 0, channel.most_lags);
    const double freedom = std::max(1.0, count - static_cast<double>(columns.cols()));
    Autoregression errors = autoregression_of(covariances_of(left, channel.blocks, most, freedom), count);
    errors.deviation = std::max(errors.deviation, 1e-13 * target.cwiseAbs().maxCoeff() + 1e-300);
    return whitened(channel.rows, channel.blocks, errors);
  }

  ForwardFit& fit_;
  const KnownConstants& constants_;
  MotionScale scale_;
  double natural_ = 1.0;     ///< rad/s
  double unit_force_ = 1.0;  ///< N
  std::vector<By> stated_;
  std::vector<SampledOscillator::Force> forces_;
  std::size_t contrasts_ = 0;
  std::size_t readings_ = 0;  ///< place of the first relaxation of a sensor
  std::vector<Relaxation> relaxations_;
  // Innovations are white but for what the levels of noise leave; of a, noise of the drive may last for a period.
  Channel x_{.most_lags = 4};
  Channel v_{.most_lags = 4};
  Channel a_{.most_lags = 24};
};

/// Why the motion cannot be simulated; empty when it can.
std::string fault_of(const Record& record) {
  constexpr std::size_t most_samples = 60'000;  // a second or two of work
  std::size_t samples = 0;
  for (const History& history : record.histories) {
    samples += history.x.size();
    const bool free = history.y.empty() && history.force.empty();
    if (free && decay_of(history).record.extremes.empty()) return "the drive of the motion was not recorded";
  }
  return samples > most_samples ? "tests take at most 60,000 samples: give a part, or every n-th sample" : "";
}

}  // namespace

std::variant<JointModel, std::string> history_model(const Record& record, const KnownConstants& constants) {
  if (std::string fault = fault_of(record); !fault.empty()) return fault;
  Estimate taken;
  ForwardFit fit(record, constants, {}, taken);
  if (!fit.problem().empty()) return fit.problem();
  JointModel model = Histories(fit, constants).model();
  const ForceParameters force = fit.layout().force(fit.found().parameters);
  const std::vector<ForwardLayout::Entry>& shared = fit.layout().shared();
  // From the scales of the fit to zeta and F0.
  model.base.col(0) *= 2.0 * std::sqrt(force.m * force.k) / shared[0].scale;
  model.base.col(1) /= shared[1].scale;
  model.value = parameters(force);
  model.scale_freedom = static_cast<double>(model.residuals.size());
  model.data = std::to_string(fit.residuals().count()) + " samples of " + std::to_string(fit.tests().size()) +
               (fit.tests().size() == 1 ? " history" : " histories");
  for (const Exclusion& exclusion : taken.excluded)
    model.left_out.push_back("history " + std::to_string(exclusion.number) + ": " + exclusion.reason);
  return model;
}

}  // namespace dualdamp::identify
