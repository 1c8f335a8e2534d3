#include "identify/conclusion.hpp"

#include <cmath>
#include <utility>

#include "core/outcome.hpp"

namespace dualdamp::identify {

namespace {

/// What rounding alone makes of a parameter that is zero, by its scale: from exact data 1e-16 times the condition
/// of the fit, with room for conditions up to a million; no sensor resolves as little.
constexpr double rounding_share = 1e-9;

}  // namespace

std::string lacks_constants(const KnownConstants& constants) {
  const auto positive = [](double value) { return value > 0.0 && std::isfinite(value); };
  if (std::isnan(constants.mass)) return "the method needs the mass";
  if (std::isnan(constants.stiffness)) return "the method needs the stiffness";
  if (!positive(constants.mass)) return "the mass must be positive and finite";
  if (!positive(constants.stiffness)) return "the stiffness must be positive and finite";
  return {};
}

void refuse(Estimate& estimate, std::string reason) {
  estimate.outcome = {core::OutcomeKind::not_identifiable, reason};
  estimate.usable = false;
  estimate.reason = std::move(reason);
}

void judge_sign(double value, double scale, const Interval* interval, const std::string& name, Estimate& estimate,
                std::vector<std::string>& faults) {
  const double least = rounding_share * scale;
  const bool negative = value < -least;
  if (interval == nullptr) {
    if (negative) faults.push_back(name + " came out negative");
    return;
  }
  const auto& [low, high] = *interval;
  // The interval has been corrected for bias, where the value may not be.
  if (high < 0.0 && (negative || high < -least)) {
    faults.push_back(name + " came out negative by more than its uncertainty");
  } else if (low <= 0.0 && high >= 0.0 && high - low > least) {
    estimate.warnings.push_back(name + " cannot be distinguished from zero: its 95 % interval contains it");
  }
}

void judge_signs(Estimate& estimate, double scale_x_f, std::vector<std::string>& faults) {
  const bool known = estimate.interval95.has_value();
  judge_sign(estimate.value.zeta, 1.0, known ? &estimate.interval95->zeta : nullptr, "the damping ratio", estimate,
             faults);
  judge_sign(estimate.value.x_f, scale_x_f, known ? &estimate.interval95->x_f : nullptr, "the Coulomb friction",
             estimate, faults);
}

void conclude(Estimate& estimate, const std::vector<std::string>& faults, std::string basis) {
  estimate.sound = faults.empty();
  estimate.usable = faults.empty() && estimate.findings.empty();
  if (estimate.usable) {
    estimate.reason = std::move(basis);
    return;
  }
  estimate.reason.clear();
  for (const auto* list : {&faults, static_cast<const std::vector<std::string>*>(&estimate.findings)})
    for (const std::string& fault : *list) estimate.reason += (estimate.reason.empty() ? "" : "; ") + fault;
}

}  // namespace dualdamp::identify
