#include "identify/ledger/freed_constants.hpp"

#include <algorithm>
#include <cmath>

#include "core/numbers.hpp"
#include "identify/ledger/history_rows.hpp"

namespace dualdamp::identify {

namespace {

/// Deviation of what a fit leaves over that of x from its mean, over all histories. Noise of x does not count.
double share_missed(ForwardFit& fit) {
  double moved = 0.0;
  double noise = 0.0;
  for (const ForwardTest& test : fit.tests()) {
    const std::vector<double>& measured = test.history->x;
    const Eigen::Map<const Eigen::ArrayXd> x(measured.data(), static_cast<Eigen::Index>(measured.size()));
    const double deviation = sensor_noise_of(measured);
    moved += (x - x.mean()).square().sum();
    noise += deviation * deviation * static_cast<double>(x.size());
  }
  const double length = fit.layout().length();
  const double left = fit.found().sum_of_squares * length * length;
  return moved > 0.0 ? std::sqrt(std::max(0.0, left - noise) / moved) : 0.0;
}

}  // namespace

const FreedFit* FreedConstants::with(By by) {
  const auto [item, is_new] = found_.try_emplace(by);
  std::optional<FreedFit>& found = item->second;
  const bool is_mass = by == By::mass;
  KnownConstants constants = constants_;
  double& own = is_mass ? constants.mass : constants.stiffness;
  if (is_new && !std::isnan(own)) {
    own = unknown;
    Estimate unused;
    ForwardFit fit(record_, constants, {}, unused);
    if (fit.problem().empty()) {
      const ForceParameters force = fit.layout().force(fit.found().parameters);
      std::vector<ForwardTest> tests = stated_.tests();
      found = FreedFit{fit.as_start(stated_.layout(), tests),
                       is_mass ? force.m - constants_.mass : force.k - constants_.stiffness, share_missed(fit)};
    }
  }
  return found ? &*found : nullptr;
}

const FreedFit* FreedConstants::best() {
  const FreedFit* best = nullptr;
  for (const By by : {By::mass, By::stiffness})
    if (const FreedFit* other = with(by); other != nullptr && (best == nullptr || other->missed < best->missed))
      best = other;
  return best;
}

const FreedFit* FreedConstants::much_nearer() {
  constexpr double good_part = 0.2;
  constexpr double much = 0.5;
  const double stated = share_missed(stated_);
  const FreedFit* other = stated < good_part ? nullptr : best();
  return other != nullptr && other->missed < much * stated ? other : nullptr;
}

std::string FreedConstants::fault() {
  constexpr double most = 0.5;
  double least = share_missed(stated_);
  if (least < most) return {};
  if (const FreedFit* other = best()) least = std::min(least, other->missed);
  if (least < most) return {};
  constexpr int digits = 2;
  return "the simulated motion misses " + core::percent(least, digits) +
         " of the measured one, whatever the mass and the stiffness";
}

}  // namespace dualdamp::identify
