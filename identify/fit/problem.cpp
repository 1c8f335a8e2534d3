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

std::vector<const Experiment*> pointers_to(const Experiments& experiments) {
  std::vector<const Experiment*> pointers;
  for (const auto& experiment : experiments) pointers.push_back(experiment.get());
  return pointers;
}

/// `whole` with those parts that there are in the place of the experiments that they are made from.
std::vector<const Experiment*> with_parts_replaced(std::vector<const Experiment*> whole, const Experiments& parts) {
  for (std::size_t e = 0; e < parts.size(); ++e)
    if (parts[e]) whole[e] = parts[e].get();
  return whole;
}

}  // namespace

FitProblem::FitProblem(const Rig& rig, const std::vector<FitParameter>& parameters, const Experiments& experiments,
                       const std::vector<double>& sizes, std::vector<RecordValues> known)
    : rig_(rig),
      holds_mass_(holds_mass(rig, parameters)),
      space_(parameters, sizes),
      readings_(pointers_to(experiments), holds_mass_),
      known_(std::move(known)) {
  if (known_.empty())
    for (const Experiment* experiment : readings_.experiments()) known_.push_back(experiment->record_start);
}

FitProblem::FitProblem(const FitProblem& whole, Experiments parts)
    : rig_(whole.rig_),
      holds_mass_(whole.holds_mass_),
      accuracy_(whole.accuracy_),
      parts_(std::move(parts)),
      space_(whole.space_),
      readings_(with_parts_replaced(whole.readings_.experiments(), parts_), holds_mass_),
      stepped_(whole.stepped_),
      known_(whole.known_),
      limit_(whole.limit_) {}

FitProblem FitProblem::roughly(const Accuracy& accuracy) const {
  Experiments parts;
  for (const Experiment* experiment : readings_.experiments()) parts.push_back(experiment->thinned());
  FitProblem rough(*this, std::move(parts));
  rough.accuracy_ = accuracy;
  return rough;
}

std::optional<FitProblem> FitProblem::with_parts(const PartOf& part_of) const {
  Experiments parts;
  for (const Experiment* experiment : readings_.experiments()) parts.push_back(part_of(*experiment));
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
  result.stepped_.resize(space_.parameters().size(), false);
  result.stepped_[number] = true;
  return result;
}

bool FitProblem::has_stepped() const { return std::ranges::count(stepped_, true) > 0; }

bool FitProblem::has_loops_only() const {
  return std::ranges::all_of(readings_.experiments(),
                             [](const Experiment* experiment) { return experiment->kind == ExperimentKind::loop; });
}

bool FitProblem::has_steady_states() const {
  return std::ranges::any_of(readings_.experiments(), [](const Experiment* experiment) {
    return experiment->kind == ExperimentKind::steady_states;
  });
}

bool FitProblem::has_jumps() const {
  return std::ranges::any_of(readings_.signals(),
                             [&](const SignalRows& rows) { return readings_.signal(rows).name == "a"; });
}

long FitProblem::work() const {
  long sum = 0;
  for (const Experiment* experiment : readings_.experiments()) sum += *experiment->work;
  return sum;
}

bool FitProblem::within_limit(std::size_t e, const std::function<bool()>& motions) const {
  const long left = std::max(0L, limit_->most - work());
  const sim::WorkLimit limit(left);
  const bool ok = guarded(motions);
  if (!limit.is_exceeded()) return ok;
  // Not every kind of experiment counts all of its work.
  *readings_.experiments()[e]->work += left + 1;
  return false;
}

void FitProblem::limit(long most, long spent) const {
  constexpr long largest = std::numeric_limits<long>::max();
  const long begun = work() - spent;
  *limit_ = {begun, most < largest - begun ? begun + most : largest};
}

void FitProblem::extend(double share) const {
  limit_->most = work() + static_cast<long>(share * static_cast<double>(limit_->most - limit_->begun));
}

std::vector<RecordValues> FitProblem::of_records(const Eigen::VectorXd& values) const {
  std::vector<RecordValues> result = known_;
  const std::vector<FitParameter>& parameters = space_.parameters();
  for (std::size_t i = 0; i < parameters.size(); ++i)
    if (parameters[i].owner == Owner::record)
      result[parameters[i].index][parameters[i].record_parameter] = values[static_cast<Eigen::Index>(i)];
  return result;
}

std::optional<sim::Model> FitProblem::model_at(const Eigen::VectorXd& values) const {
  std::optional<Rig> rig = with_values(rig_, space_.parameters(), values);
  if (!rig) return std::nullopt;
  double& tolerance = rig->known.solver.tolerance;
  tolerance = std::max(tolerance, accuracy_.tolerance);
  return model_of(std::move(*rig));
}

bool FitProblem::predict_each(const Eigen::VectorXd& q, Eigen::VectorXd& result, const Predictor& predict) const {
  if (is_exhausted()) return false;
  const Eigen::VectorXd p = space_.values(q);
  return guarded([&] {
    const std::optional<sim::Model> model = model_at(p);
    if (!model) return false;
    const std::vector<RecordValues> of_each = of_records(p);
    result.resize(readings_.size());
    std::atomic<bool> ok = true;
    sim::in_parts(readings_.experiments().size(), 1, 0, [&](std::size_t e, std::size_t) {
      Eigen::VectorXd part;
      if (!within_limit(e, [&] { return predict(e, *model, of_each[e], part); }))
        ok = false;
      else
        result.segment(readings_.begin_of(e), part.size()) = part;
    });
    return ok.load();
  });
}

bool FitProblem::outputs(const Eigen::VectorXd& q, Eigen::VectorXd& result, const LastMotions* last) const {
  return predict_each(q, result,
                      [&](std::size_t e, const sim::Model& model, const RecordValues& of_record, auto& part) {
                        const Neighbours* near = start_for(last, e);
                        return near != nullptr ? near->predict(model, of_record, 0.0, part)
                                               : readings_.experiments()[e]->predict(model, of_record, part);
                      });
}

/// A jump of the acceleration within a step of a difference passes over a reading on one side of it only. Such a
/// difference would count as information about the parameter that the record does not hold, and is the larger, the
/// shorter the step is.
void FitProblem::mend_jumps(const Eigen::VectorXd& below, const Eigen::VectorXd& above,
                            Eigen::VectorXd& slope) const {
  for (const SignalRows& rows : readings_.signals()) {
    if (readings_.signal(rows).name != "a") continue;
    for (Eigen::Index r = rows.begin; r < rows.end; ++r)
      if (std::abs(above[r] - below[r]) > std::abs(slope[r]))
        slope[r] = std::abs(above[r]) < std::abs(below[r]) ? above[r] : below[r];
  }
}

bool FitProblem::column(const Eigen::VectorXd& q, const Eigen::VectorXd& middle, const All& neighbours,
                        Eigen::Index i, const Difference& difference, Eigen::VectorXd& slope) const {
  const SearchCoordinate& c = space_[i];
  const FitParameter& parameter = space_.parameters()[static_cast<std::size_t>(i)];
  constexpr double of_difference = 1e-3;
  const double h = difference.step * (c.logarithmic ? 1.0 : std::max(1.0, std::abs(q[i])));
  std::array<double, 2> at = {std::max(q[i] - h, c.low), std::min(q[i] + h, c.high)};
  std::array<Eigen::VectorXd, 2> outputs = {middle, middle};
  for (std::size_t side = 0; side < 2; ++side) {
    if (side == 0 && difference.is_one_sided && at[1] > q[i]) {
      at[side] = q[i];
      continue;
    }
    Eigen::VectorXd there = q;
    there[i] = at[side];
    const Eigen::VectorXd p = space_.values(there);
    const bool ok = guarded([&] {
      const std::optional<sim::Model> model = model_at(p);
      if (!model) return false;
      const std::vector<RecordValues> of_each = of_records(p);
      Eigen::VectorXd part;
      for (std::size_t e = 0; e < readings_.experiments().size(); ++e) {
        if (parameter.owner == Owner::record && parameter.index != e) continue;
        if (!within_limit(e, [&] { return neighbours[e]->predict(*model, of_each[e], of_difference, part); }))
          return false;
        outputs[side].segment(readings_.begin_of(e), part.size()) = part;
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
  if (at[0] < q[i] && q[i] < at[1] && !difference.seeks)
    mend_jumps((middle - outputs[0]) / (q[i] - at[0]), (outputs[1] - middle) / (at[1] - q[i]), slope);
  return slope.allFinite();
}

const Neighbours* FitProblem::start_for(const LastMotions* last, std::size_t e) {
  if (last == nullptr || last->neighbours_.empty() || !last->neighbours_[e]->is_worth_using()) return nullptr;
  return last->neighbours_[e].get();
}

std::optional<FitProblem::All> FitProblem::neighbours(const Eigen::VectorXd& q, const LastMotions* last,
                                                      Eigen::VectorXd& result) const {
  All found(readings_.experiments().size());
  const bool is_possible = predict_each(
      q, result, [&](std::size_t e, const sim::Model& model, const RecordValues& of_record, auto& part) {
        found[e] = readings_.experiments()[e]->neighbours(model, of_record, start_for(last, e), part);
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
  jacobian.resize(readings_.size(), q.size());
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
    Difference difference{accuracy_.step, seeks, accuracy_.is_one_sided || (seeks && !has_jumps())};
    bool has_slope = column(q, result, neighbours, i, difference, slope);
    while (seeks && has_slope && slope.squaredNorm() == 0.0 && (difference.step *= farther) < 1.01 * farthest) {
      difference.is_one_sided = accuracy_.is_one_sided;
      has_slope = column(q, result, neighbours, i, difference, slope);
    }
    if (has_slope)
      jacobian.col(i) = slope;
    else
      ok = false;
  });
  if (last != nullptr) last->neighbours_ = std::move(*found);
  return ok.load();
}

}  // namespace dualdamp::identify
