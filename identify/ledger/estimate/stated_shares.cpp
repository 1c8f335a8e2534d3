#include "identify/ledger/estimate/stated_shares.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "identify/ledger/estimate/stated_errors.hpp"
#include "identify/ledger/estimate/unstated_constants.hpp"
#include "identify/statistics/statistics.hpp"

namespace dualdamp::identify {

double allowed_error(const ConstantUncertainties& uncertainties, const KnownConstants& constants) {
  const ConstantUncertainties& u = uncertainties;
  const double of_gains = std::hypot(std::hypot(u.gain_x, u.gain_y, u.gain_force), std::hypot(u.gain_v, u.gain_a));
  return counted_deviations * std::hypot(relative_of_inertia(u, constants), of_gains);
}

StatedShares::StatedShares(const KnownConstants& stated, const ConstantUncertainties& uncertainties)
    : stated_(stated), allowed_(allowed_error(uncertainties, stated)) {
  for (const StatedNumber& number : stated_numbers)
    relative_.*number.uncertainty = number.relative(uncertainties, stated);
  if (!(stated.mass > 0.0) || !(stated.stiffness > 0.0)) return;
  mass_ = uncertainties.mass / stated.mass;
  stiffness_ = uncertainties.stiffness / stated.stiffness;
  inertia_ = relative_of_inertia(uncertainties, stated);
}

bool StatedShares::is_shared(const Relaxation& relaxation) {
  return relaxation.freed == Freed::mass || relaxation.freed == Freed::stiffness;
}

bool StatedShares::apply_to(const JointModel& model, const FoundDeparture& departure) const {
  const auto explains = [&](Freed freed) {
    return std::ranges::any_of(departure.explanations, [&](const RelaxationTest& test) {
      return model.relaxations[test.index].freed == freed;
    });
  };
  return !knows_stated_errors(model) && inertia_ > 0.0 && explains(Freed::mass) && explains(Freed::stiffness);
}

double StatedShares::departure_of(const KnownConstants& fitted) const {
  return std::log(fitted.stiffness / stated_.stiffness) - std::log(fitted.mass / stated_.mass);
}

bool StatedShares::allow(const KnownConstants& fitted) const { return std::abs(departure_of(fitted)) < allowed_; }

KnownConstants StatedShares::of(const KnownConstants& fitted) const {
  const double unstated = allow(fitted) ? 0.0 : unstated_uncertainty;
  const auto square = [&](double stated) { return std::pow(stated > 0.0 ? stated : unstated, 2); };
  const double of_mass = square(mass_);
  const double of_stiffness = square(stiffness_);
  const double of_frequency = std::max(0.0, inertia_ * inertia_ - mass_ * mass_ - stiffness_ * stiffness_);
  const double unit = departure_of(fitted) / (of_mass + of_stiffness + of_frequency);
  KnownConstants shared = fitted;
  shared.mass = stated_.mass * std::exp(-unit * of_mass);
  shared.stiffness = stated_.stiffness * std::exp(unit * of_stiffness);
  return shared;
}

JointModel with_constants(JointModel model, const KnownConstants& constants) {
  const double ratio = constants.stiffness / model.constants.stiffness;
  model.base.col(1) /= ratio;
  if (model.shaken.size() > 0) model.shaken.col(2) /= ratio;
  model.F0_parts *= ratio;
  model.value = parameters(model.value.zeta, model.value.x_f, constants);
  model.constants = constants;
  return model;
}

void share_out(const JointModel& model, const StatedShares& shares, RelaxationTests& tests) {
  if (!tests.relaxed) return;
  double F0 = model.value.F0;
  for (FoundDeparture& departure : tests.departures) {
    RelaxationTest& best = departure.explanations.front();
    const double before = F0;
    F0 += best.F0_change;
    if (!shares.apply_to(model, departure) || !StatedShares::is_shared(model.relaxations[best.index])) continue;
    const KnownConstants shared = shares.of(best.constants);
    F0 *= shared.stiffness / best.constants.stiffness;
    best.F0_change = F0 - before;
    tests.relaxed = with_constants(std::move(*tests.relaxed), shares.of(tests.relaxed->constants));
  }
}

}  // namespace dualdamp::identify
