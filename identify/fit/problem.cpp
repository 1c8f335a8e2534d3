#include "identify/fit/problem.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <utility>

#include "core/diagnostics.hpp"
#include "friction_models/law_fault.hpp"
#include "sim/parallel.hpp"
#include "sim/work_limit.hpp"

namespace dualdamp::identify {

namespace {

/// Largest factor between a parameter with a logarithmic coordinate and its size. A contact a thousand times
/// stiffer than the data could show would need a thousand times the steps.
constexpr double reach = 1e4;
/// Largest value of a parameter in units of its size; plausible values are far below.
constexpr double far = 1e6;

/// A bound, of the law or of the caller, takes the place of these two.
SearchCoordinate coordinate_of(const FitParameter& parameter, double size) {
  const auto& [low, high, low_open, high_open] = parameter.range;
  if (!parameter.above && low >= 0.0 && (low_open || low > 0.0))
    return {true, size, std::log(low > 0.0 ? low / size : 1.0 / reach),
            std::log(std::isfinite(high) ? high / size : reach)};
  if (parameter.above) return {false, size, 0.0, far};
  return {false, size, std::isfinite(low) ? low / size : -far, std::isfinite(high) ? high / size : far};
}

/// A force over the force that is sought in its place; 1 for any other parameter.
double over_force_sought(const FitParameter& parameter, const Eigen::VectorXd& values) {
  return parameter.at_speed && parameter.at_speed->sought_at > 0.0
             ? over_force_at(parameter.at_speed->sought_at, parameter, values)
             : 1.0;
}

/// Calls `work`. False if a law or an engine refuses the values.
template <typename Work>
bool guarded(const Work& work) {
  try {
    return work();
  } catch (const friction::LawFault&) {
    return false;
  } catch (const core::InputError&) {
    return false;
  }
}

}  // namespace

std::vector<double> sizes_of_stated(const std::vector<FitParameter>& parameters) {
  std::vector<double> sizes;
  for (const FitParameter& parameter : parameters) {
    const double size = std::abs(parameter.stated);
    sizes.push_back(size > 0.0 && std::isfinite(size) ? size : 1.0);
  }
  return sizes;
}

FitProblem::FitProblem(const Rig& rig, const std::vector<FitParameter>& parameters, const Experiments& experiments,
                       const std::vector<double>& sizes, std::vector<RecordValues> known)
    : rig_(rig), holds_mass_(holds_mass(rig, parameters)), parameters_(parameters), known_(std::move(known)) {
  for (std::size_t i = 0; i < parameters.size(); ++i)
    coordinates_.push_back(coordinate_of(parameters[i], sizes[i]));
  const Eigen::VectorXd middle =
      Eigen::Map<const Eigen::VectorXd>(sizes.data(), static_cast<Eigen::Index>(sizes.size()));
  for (const FitParameter& parameter : parameters) units_.push_back(over_force_sought(parameter, middle));
  for (const auto& experiment : experiments) experiments_.push_back(experiment.get());
  if (known_.empty())
    for (const Experiment* experiment : experiments_) known_.push_back(experiment->record_start);
  number_rows();
}

FitProblem::FitProblem(const FitProblem& whole, Experiments parts)
    : rig_(whole.rig_),
      holds_mass_(whole.holds_mass_),
      accuracy_(whole.accuracy_),
      parameters_(whole.parameters_),
      parts_(std::move(parts)),
      experiments_(whole.experiments_),
      coordinates_(whole.coordinates_),
      stepped_(whole.stepped_),
      units_(whole.units_),
      known_(whole.known_),
      limit_(whole.limit_) {
  for (std::size_t e = 0; e < parts_.size(); ++e)
    if (parts_[e]) experiments_[e] = parts_[e].get();
  number_rows();
}

FitProblem FitProblem::roughly(const Accuracy& accuracy) const {
  Experiments parts;
  for (const Experiment* experiment : experiments_) parts.push_back(experiment->thinned());
  FitProblem rough(*this, std::move(parts));
  rough.accuracy_ = accuracy;
  return rough;
}

std::optional<FitProblem> FitProblem::with_parts(const PartOf& part_of) const {
  Experiments parts;
  for (const Experiment* experiment : experiments_) parts.push_back(part_of(*experiment));
  if (std::ranges::none_of(parts, [](const auto& part) { return part != nullptr; })) return std::nullopt;
  return FitProblem(*this, std::move(parts));
}

std::optional<FitProblem> FitProblem::first_part(double share) const {
  return with_parts([share](const Experiment& experiment) { return experiment.first_part(share); });
}

std::optional<FitProblem> FitProblem::tied(double strength) const {
  return with_parts([strength](const Experiment& experiment) { return experiment.tied(strength); });
}

std::optional<FitProblem> FitProblem::balanced() const {
  return with_parts([](const Experiment& experiment) { return experiment.balanced(); });
}

FitProblem FitProblem::holding(std::size_t number) const {
  FitProblem result(*this, {});
  result.stepped_.resize(parameters_.size(), false);
  result.stepped_[number] = true;
  return result;
}

void FitProblem::number_rows() {
  for (std::size_t e = 0; e < experiments_.size(); ++e) {
    begins_.push_back(rows_);
    for (std::size_t s = 0; s < experiments_[e]->signals.size(); ++s) {
      const auto count = static_cast<Eigen::Index>(experiments_[e]->signals[s].measured.size());
      signals_.push_back({e, s, rows_, rows_ + count});
      rows_ += count;
    }
  }
  measured_.resize(rows_);
  counted_ = Eigen::VectorXd::Ones(rows_);
  for (const SignalRows& rows : signals_) {
    measured_.segment(rows.begin, rows.size()) =
        Eigen::Map<const Eigen::VectorXd>(signal(rows).measured.data(), rows.size());
    for (const std::size_t i : signal(rows).unsure) counted_[rows.begin + static_cast<Eigen::Index>(i)] = 0.0;
    if (!holds_mass_) continue;
    for (const std::size_t i : signal(rows).stuck) counted_[rows.begin + static_cast<Eigen::Index>(i)] = 0.0;
  }
}

bool FitProblem::has_stepped() const { return std::ranges::count(stepped_, true) > 0; }

bool FitProblem::has_loops_only() const {
  return std::ranges::all_of(experiments_,
                             [](const Experiment* experiment) { return experiment->kind == ExperimentKind::loop; });
}

bool FitProblem::has_steady_states() const {
  return std::ranges::any_of(
      experiments_, [](const Experiment* experiment) { return experiment->kind == ExperimentKind::steady_states; });
}

long FitProblem::work() const {
  long sum = 0;
  for (const Experiment* experiment : experiments_) sum += *experiment->work;
  return sum;
}

bool FitProblem::within_limit(std::size_t e, const std::function<bool()>& motions) const {
  const long left = std::max(0L, limit_->most - work());
  const sim::WorkLimit limit(left);
  const bool ok = guarded(motions);
  if (!limit.is_exceeded()) return ok;
  // Not every kind of experiment counts all of its work.
  *experiments_[e]->work += left + 1;
  return false;
}

void FitProblem::limit(long most) const {
  constexpr long largest = std::numeric_limits<long>::max();
  const long begun = work();
  *limit_ = {begun, most < largest - begun ? begun + most : largest};
}

void FitProblem::extend(double share) const {
  limit_->most = work() + static_cast<long>(share * static_cast<double>(limit_->most - limit_->begun));
}

Eigen::VectorXd FitProblem::counted(const Eigen::VectorXd& misses, const SignalRows& rows) const {
  std::vector<Eigen::Index> those;
  for (Eigen::Index r = rows.begin; r < rows.end; ++r)
    if (counted_[r] > 0.0) those.push_back(r);
  return misses(those);
}

double FitProblem::rms(const Eigen::VectorXd& misses, const SignalRows& rows) const {
  return misses.segment(rows.begin, rows.size()).norm() / std::sqrt(std::max(1.0, count(rows)));
}

const Signal& FitProblem::signal(const SignalRows& rows) const {
  return experiments_[rows.experiment]->signals[rows.signal];
}

Eigen::VectorXd FitProblem::values(const Eigen::VectorXd& q) const {
  Eigen::VectorXd result(q.size());
  for (std::size_t i = 0; i < coordinates_.size(); ++i) {
    const SearchCoordinate& c = coordinates_[i];
    const auto at = static_cast<Eigen::Index>(i);
    result[at] = c.size * (c.logarithmic ? std::exp(q[at]) : q[at]);
  }
  for (std::size_t i = 0; i < parameters_.size(); ++i)
    if (parameters_[i].above)
      result[static_cast<Eigen::Index>(i)] += result[static_cast<Eigen::Index>(*parameters_[i].above)];
  for (std::size_t i = 0; i < parameters_.size(); ++i)
    result[static_cast<Eigen::Index>(i)] *= over_force_sought(parameters_[i], result) / units_[i];
  return result;
}

Eigen::VectorXd FitProblem::coordinates(const Eigen::VectorXd& values) const {
  Eigen::VectorXd result(values.size());
  for (std::size_t i = 0; i < coordinates_.size(); ++i) {
    const SearchCoordinate& c = coordinates_[i];
    const auto at = static_cast<Eigen::Index>(i);
    double value = values[at];
    if (parameters_[i].above) value -= values[static_cast<Eigen::Index>(*parameters_[i].above)];
    value *= units_[i] / over_force_sought(parameters_[i], values);
    const double q = c.logarithmic ? std::log(std::max(value, 0.0) / c.size) : value / c.size;
    result[at] = std::clamp(q, c.low, c.high);
  }
  return result;
}

Eigen::MatrixXd FitProblem::slope(const Eigen::VectorXd& q) const {
  const Eigen::Index count = q.size();
  const Eigen::VectorXd at = values(q);
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(count, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const SearchCoordinate& c = coordinates_[static_cast<std::size_t>(i)];
    result(i, i) = c.size * (c.logarithmic ? std::exp(q[i]) : 1.0);
  }
  for (Eigen::Index i = 0; i < count; ++i) {
    const FitParameter& parameter = parameters_[static_cast<std::size_t>(i)];
    const auto add = [&](const std::optional<std::size_t>& other, double by_other) {
      if (!other) return;
      const auto j = static_cast<Eigen::Index>(*other);
      result(i, j) += by_other * result(j, j);
    };
    add(parameter.above, 1.0);
    if (!parameter.at_speed || !(parameter.at_speed->sought_at > 0.0)) continue;
    // value = sought (v0/v)^n
    result(i, i) *= over_force_sought(parameter, at) / units_[static_cast<std::size_t>(i)];
    const auto& [speed, power, sought_at] = *parameter.at_speed;
    add(power.sought, at[i] * std::log(speed.value(at) / sought_at));
    add(speed.sought, at[i] * power.value(at) / speed.value(at));
  }
  return result;
}

std::vector<RecordValues> FitProblem::of_records(const Eigen::VectorXd& values) const {
  std::vector<RecordValues> result = known_;
  for (std::size_t i = 0; i < parameters_.size(); ++i)
    if (parameters_[i].owner == Owner::record)
      result[parameters_[i].index][parameters_[i].record_parameter] = values[static_cast<Eigen::Index>(i)];
  return result;
}

std::optional<sim::Model> FitProblem::model_at(const Eigen::VectorXd& values) const {
  std::optional<Rig> rig = with_values(rig_, parameters_, values);
  if (!rig) return std::nullopt;
  double& tolerance = rig->known.solver.tolerance;
  tolerance = std::max(tolerance, accuracy_.tolerance);
  return model_of(std::move(*rig));
}

bool FitProblem::predict_each(const Eigen::VectorXd& q, Eigen::VectorXd& result, const Predictor& predict) const {
  if (is_exhausted()) return false;
  const Eigen::VectorXd p = values(q);
  return guarded([&] {
    const std::optional<sim::Model> model = model_at(p);
    if (!model) return false;
    const std::vector<RecordValues> of_each = of_records(p);
    result.resize(rows_);
    std::atomic<bool> ok = true;
    sim::in_parts(experiments_.size(), 1, 0, [&](std::size_t e, std::size_t) {
      Eigen::VectorXd part;
      if (!within_limit(e, [&] { return predict(e, *model, of_each[e], part); }))
        ok = false;
      else
        result.segment(begins_[e], part.size()) = part;
    });
    return ok.load();
  });
}

bool FitProblem::outputs(const Eigen::VectorXd& q, Eigen::VectorXd& result, const LastMotions* last) const {
  return predict_each(q, result,
                      [&](std::size_t e, const sim::Model& model, const RecordValues& of_record, auto& part) {
                        const Neighbours* near = start_for(last, e);
                        return near != nullptr ? near->predict(model, of_record, part)
                                               : experiments_[e]->predict(model, of_record, part);
                      });
}

/// A jump of the acceleration within a step of a difference passes over a reading on one side of it only. Such a
/// difference would count as information about the parameter that the record does not hold, and is the larger, the
/// shorter the step is.
void FitProblem::mend_jumps(const Eigen::VectorXd& below, const Eigen::VectorXd& above,
                            Eigen::VectorXd& slope) const {
  for (const SignalRows& rows : signals_) {
    if (signal(rows).name != "a") continue;
    for (Eigen::Index r = rows.begin; r < rows.end; ++r)
      if (std::abs(above[r] - below[r]) > std::abs(slope[r]))
        slope[r] = std::abs(above[r]) < std::abs(below[r]) ? above[r] : below[r];
  }
}

bool FitProblem::column(const Eigen::VectorXd& q, const Eigen::VectorXd& middle, const All& neighbours,
                        Eigen::Index i, double step, bool seeks, Eigen::VectorXd& slope) const {
  const SearchCoordinate& c = coordinates_[static_cast<std::size_t>(i)];
  const FitParameter& parameter = parameters_[static_cast<std::size_t>(i)];
  const double h = step * (c.logarithmic ? 1.0 : std::max(1.0, std::abs(q[i])));
  std::array<double, 2> at = {std::max(q[i] - h, c.low), std::min(q[i] + h, c.high)};
  std::array<Eigen::VectorXd, 2> outputs = {middle, middle};
  for (std::size_t side = 0; side < 2; ++side) {
    if (side == 0 && accuracy_.is_one_sided && at[1] > q[i]) {
      at[side] = q[i];
      continue;
    }
    Eigen::VectorXd there = q;
    there[i] = at[side];
    const Eigen::VectorXd p = values(there);
    const bool ok = guarded([&] {
      const std::optional<sim::Model> model = model_at(p);
      if (!model) return false;
      const std::vector<RecordValues> of_each = of_records(p);
      Eigen::VectorXd part;
      for (std::size_t e = 0; e < experiments_.size(); ++e) {
        if (parameter.owner == Owner::record && parameter.index != e) continue;
        if (!within_limit(e, [&] { return neighbours[e]->predict(*model, of_each[e], part); })) return false;
        outputs[side].segment(begins_[e], part.size()) = part;
      }
      return true;
    });
    // If there is no model on one side, a one-sided difference is used.
    if (!ok) {
      outputs[side] = middle;
      at[side] = q[i];
    }
  }
  if (!(at[1] > at[0])) return false;
  slope = (outputs[1] - outputs[0]) / (at[1] - at[0]);
  if (at[0] < q[i] && q[i] < at[1] && !seeks)
    mend_jumps((middle - outputs[0]) / (q[i] - at[0]), (outputs[1] - middle) / (at[1] - q[i]), slope);
  return slope.allFinite();
}

const Neighbours* FitProblem::start_for(const LastMotions* last, std::size_t e) {
  if (last == nullptr || last->neighbours_.empty() || !last->neighbours_[e]->is_worth_using()) return nullptr;
  return last->neighbours_[e].get();
}

std::optional<FitProblem::All> FitProblem::neighbours(const Eigen::VectorXd& q, const LastMotions* last,
                                                      Eigen::VectorXd& result) const {
  All found(experiments_.size());
  const bool is_possible = predict_each(
      q, result, [&](std::size_t e, const sim::Model& model, const RecordValues& of_record, auto& part) {
        found[e] = experiments_[e]->neighbours(model, of_record, start_for(last, e), part);
        return found[e] != nullptr;
      });
  if (!is_possible) return std::nullopt;
  return found;
}

bool FitProblem::derivatives(const Eigen::VectorXd& q, Eigen::VectorXd& result, Eigen::MatrixXd& jacobian,
                             bool seeks, LastMotions* last) const {
  std::optional<All> found = neighbours(q, last, result);
  if (!found) return false;
  const All& neighbours = *found;
  jacobian.resize(rows_, q.size());
  std::atomic<bool> ok = true;
  sim::in_parts(static_cast<std::size_t>(q.size()), 1, 0, [&](std::size_t number, std::size_t) {
    const auto i = static_cast<Eigen::Index>(number);
    if (is_stepped(i)) {
      jacobian.col(i).setZero();
      return;
    }
    Eigen::VectorXd slope;
    constexpr double farthest = 0.1;
    constexpr double farther = 10.0;
    double step = accuracy_.step;
    bool has_slope = column(q, result, neighbours, i, step, seeks, slope);
    while (seeks && has_slope && slope.squaredNorm() == 0.0 && (step *= farther) < 1.01 * farthest)
      has_slope = column(q, result, neighbours, i, step, seeks, slope);
    if (has_slope)
      jacobian.col(i) = slope;
    else
      ok = false;
  });
  if (last != nullptr) last->neighbours_ = std::move(*found);
  return ok.load();
}

}  // namespace dualdamp::identify
