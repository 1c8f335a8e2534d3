#include "friction_models/modifiers/force_limits.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/constants.hpp"

namespace dualdamp::friction {

namespace {

using core::infinity;

}  // namespace

ModifierSettings::ModifierSettings(const ParameterValues& values) {
  if (values.has("drift")) drift = values.number("drift");
  if (values.has("position_slope")) slope = values.number("position_slope");
  if (values.has("load_gradient")) load_gradient = values.number("load_gradient");
  if (values.has("load_modulation")) {
    const ParameterValues& record = values.record("load_modulation");
    modulation = record.number("ratio");
    modulation_order = static_cast<double>(record.count("order"));
    modulation_phase = record.number("phase");
  }
  if (values.has("fluctuation")) {
    const ParameterValues& fluctuation = values.record("fluctuation");
    ratio = fluctuation.number("ratio");
    seed = fluctuation.seed("seed");
    const bool over_position = fluctuation.has("correlation_length");
    if (fluctuates() && over_position) correlation_length = fluctuation.number("correlation_length");
    if (fluctuates() && !over_position) correlation_time = fluctuation.number("correlation_time");
  }
  if (values.has("warming")) {
    const ParameterValues& warming = values.record("warming");
    warming_power = warming.number("power");
    warming_time = warming.number("time_constant");
  }
}

ForceLimits::ForceLimits(const ModifierSettings& settings, std::vector<double> nominal)
    : settings_(settings), nominal_(std::move(nominal)), fluctuation_(settings.seed) {
  std::ranges::sort(nominal_);
  const auto repeated = std::ranges::unique(nominal_);
  nominal_.erase(repeated.begin(), repeated.end());
}

ModifierCourse ForceLimits::start(const Instant& now) const {
  ModifierCourse course{
      .level = fluctuation_.first(), .side = now.x < 0.0 ? -1 : 1, .unloaded = load(now.x) <= 0.0};
  if (settings_.fluctuates_over_position()) {
    constexpr double farthest = 1e9;  // an int holds this and many cells beyond it
    course.cell = static_cast<int>(std::clamp(std::round(now.x / cell_width()), -farthest, farthest));
    course.level = fluctuation_.at(course.cell);
  }
  return course;
}

double ForceLimits::fluctuation(const ModifierCourse& course) const {
  return std::max(0.0, 1.0 + settings_.ratio * course.level);
}

Instant ForceLimits::at(const ModifierCourse& course, double power, const Instant& now) const {
  double factor = course.drift_ended ? 0.0 : fluctuation(course);
  if (settings_.warms()) factor *= std::exp(-power / settings_.warming_power);
  const double drifted = 1.0 + settings_.drift * now.t;
  double modulated = 1.0;
  double modulated_rate = 0.0;
  if (settings_.modulates()) {
    const double angle = settings_.modulation_order * now.angle + settings_.modulation_phase;
    modulated += settings_.modulation * std::cos(angle);
    modulated_rate = -settings_.modulation * settings_.modulation_order * now.angle_rate * std::sin(angle);
  }
  double factor_rate = (settings_.drift * modulated + drifted * modulated_rate) * factor * load(now.x);
  if (factor != 0.0 && (settings_.drift != 0.0 || settings_.modulates())) factor_rate = varying_rate(factor_rate);
  double vanished = course.vanished == 0 ? -1.0 : nominal_[static_cast<std::size_t>(course.vanished) - 1];
  if (course.unloaded) vanished = infinity;
  // Called at every evaluation of a law: each number is stored once, where the caller reads it.
  Instant modified = now;
  modified.modification.factor = drifted * modulated * factor;
  modified.modification.factor_rate = factor_rate;
  modified.modification.factor_slope = drifted * modulated * factor * settings_.load_gradient;
  modified.modification.slope = course.side * settings_.slope;
  modified.modification.vanished = vanished;
  return modified;
}

bool ForceLimits::are_gone(const ModifierCourse& course) const {
  if (course.unloaded) return true;
  if (settings_.slope == 0.0) return course.drift_ended || fluctuation(course) == 0.0;
  return !nominal_.empty() && static_cast<std::size_t>(course.vanished) == nominal_.size();
}

double ForceLimits::drift_end(const ModifierCourse& course) const {
  return settings_.drift < 0.0 && !course.drift_ended ? -1.0 / settings_.drift : infinity;
}

double ForceLimits::cell_end(const ModifierCourse& course) const {
  if (settings_.fluctuates_over_position()) return infinity;
  return (course.cell + 1) * (settings_.correlation_time / Fluctuation::cells_per_correlation);
}

/// The middle of cell 0 is x = 0.
double ForceLimits::cell_width() const { return settings_.correlation_length / Fluctuation::cells_per_correlation; }

double ForceLimits::next_change(const ModifierCourse& course) const {
  return std::min(drift_end(course), cell_end(course));
}

ModifierCourse ForceLimits::after_change(const ModifierCourse& course, double due) const {
  ModifierCourse next = course;
  if (drift_end(course) == due) next.drift_ended = true;
  if (cell_end(course) == due) {
    ++next.cell;
    next.level = fluctuation_.after(course.level, next.cell);
  }
  return next;
}

Instant ForceLimits::before_vanishing(ModifierCourse course, double power, const Instant& now) const {
  course.vanished = 0;
  return at(course, power, now);
}

std::vector<Affine> ForceLimits::guards(const ModifierCourse& course, double power, const Instant& now) const {
  std::vector<Affine> guards;
  if (load_guards() > 0) {
    const double sign = course.unloaded ? -1.0 : 1.0;
    guards.push_back({.constant = sign, .position = sign * settings_.load_gradient});
  }
  if (settings_.fluctuates_over_position()) {
    const double high = (course.cell + 0.5) * cell_width();
    const double low = (course.cell - 0.5) * cell_width();
    guards.push_back({.constant = high, .position = -1.0});
    guards.push_back({.constant = -low, .position = 1.0});
  }
  if (settings_.slope == 0.0) return guards;
  guards.push_back({.position = static_cast<double>(course.side)});
  if (settings_.slope > 0.0) return guards;
  const Instant all = before_vanishing(course, power, now);
  const auto zero = static_cast<std::size_t>(course.vanished);
  if (zero < nominal_.size()) guards.push_back(all.force_limit(nominal_[zero]));
  if (zero > 0) guards.push_back(-1.0 * all.force_limit(nominal_[zero - 1]));
  return guards;
}

ForceLimits::Ending ForceLimits::ending(int guard) const {
  if (guard < load_guards()) return Ending::load;
  if (guard < guards_before_side()) return Ending::cell;
  return guard == guards_before_side() ? Ending::side : Ending::force_limit;
}

ModifierCourse ForceLimits::after_guard(const ModifierCourse& course, int guard) const {
  ModifierCourse next = course;
  switch (ending(guard)) {
    case Ending::load:
      next.unloaded = !course.unloaded;
      break;
    case Ending::cell:
      next.cell += guard == load_guards() ? 1 : -1;
      next.level = fluctuation_.at(next.cell);
      break;
    case Ending::side:
      next.side = -course.side;
      break;
    case Ending::force_limit:
      const bool falls =
          guard == guards_before_side() + 1 && static_cast<std::size_t>(course.vanished) < nominal_.size();
      next.vanished += falls ? 1 : -1;
      break;
  }
  return next;
}

int ForceLimits::vanished(const ModifierCourse& course, double power, const Instant& now) const {
  if (settings_.slope >= 0.0) return course.vanished;
  const Instant all = before_vanishing(course, power, now);
  return static_cast<int>(
      std::ranges::count_if(nominal_, [&](double nominal) { return all.force_limit_now(nominal) <= 0.0; }));
}

}  // namespace dualdamp::friction
