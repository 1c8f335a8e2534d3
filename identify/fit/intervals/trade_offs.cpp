#include "identify/fit/intervals/trade_offs.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/diagnostics.hpp"
#include "core/numbers.hpp"

namespace dualdamp::identify {

namespace {

std::string percent_of_size(double share) { return core::percent(std::abs(share), 2); }

/// A parameter that must not be below another one is sought as its distance from it.
std::string sought(const std::vector<FitParameter>& parameters, Eigen::Index i) {
  const FitParameter& parameter = parameters[static_cast<std::size_t>(i)];
  return parameter.above ? parameter.name + " - " + parameters[*parameter.above].name : parameter.name;
}

/// "sigma1 and damping trade off one to one".
std::string pair_text(const WeakDirection& direction, const std::vector<FitParameter>& parameters, Eigen::Index a,
                      Eigen::Index b) {
  const FitParameter& first = parameters[static_cast<std::size_t>(a)];
  const FitParameter& second = parameters[static_cast<std::size_t>(b)];
  const double ratio = direction.change[a] / direction.change[b];
  const std::string both =
      sought(parameters, a) + " and " + sought(parameters, b) + (ratio < 0.0 ? " trade off" : " go together");
  constexpr double equal = 0.1;
  if (first.unit == second.unit && std::abs(std::abs(ratio) - 1.0) < equal) return both + " one to one";
  constexpr double small = 0.1;
  const double shares = direction.share[b] / direction.share[a];
  return both + ": 10 % more of " + sought(parameters, a) + " with " + percent_of_size(small * shares) +
         (shares < 0.0 ? " less of " : " more of ") + sought(parameters, b);
}

}  // namespace

Eigen::VectorXd reaches(const std::vector<FittedParameter>& parameters) {
  Eigen::VectorXd all = Eigen::VectorXd::Constant(static_cast<Eigen::Index>(parameters.size()), unknown);
  for (Eigen::Index i = 0; i < all.size(); ++i) {
    const FittedParameter& fitted = parameters[static_cast<std::size_t>(i)];
    const double below = fitted.value - fitted.profile95[0];
    const double above = fitted.profile95[1] - fitted.value;
    all[i] = fitted.at_bound ? std::fmax(below, above) : std::max(below, above);
    if (!fitted.at_bound && std::isnan(below)) all[i] = unknown;
  }
  return all;
}

TradeOff known_further_off(const FittedParameter& fitted, core::Coordinate coordinate) {
  const auto& [low, high] = fitted.interval95;
  const std::string unit =
      fitted.parameter.unit == "1" ? "" : " " + core::unit_for(coordinate, fitted.parameter.unit);
  const std::string above = "above " + core::format_number(low, 3) + unit;
  const std::string below = "below " + core::format_number(high, 3) + unit;
  const bool has_low = low > fitted.parameter.range.low;
  const bool has_high = high < fitted.parameter.range.high;
  return {{fitted.parameter.name},
          "the data show of " + fitted.parameter.name + " only that it is " +
              (has_low && has_high ? above + " and " + below
               : has_low           ? above
                                   : below)};
}

std::optional<TradeOff> trade_off(const WeakDirection& direction, const std::vector<FitParameter>& parameters,
                                  core::Coordinate coordinate) {
  std::vector<Eigen::Index> order(parameters.size());
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  std::ranges::sort(order, std::greater<>(), [&](Eigen::Index i) { return std::abs(direction.share[i]); });
  constexpr double part = 0.3;
  const Eigen::Index first = order.front();
  const double largest = std::abs(direction.share[first]);
  // A parameter of the same unit that changes by as much is named too, even if this is a small share of its value.
  const auto changes_alike = [&](Eigen::Index i) {
    return parameters[static_cast<std::size_t>(i)].unit == parameters[static_cast<std::size_t>(first)].unit &&
           std::abs(direction.change[i]) > part * std::abs(direction.change[first]);
  };
  // If the data do not determine the direction, all parameters with large effects that cancel are named.
  const auto makes_up = [&](Eigen::Index i) {
    return !std::isfinite(direction.deviation) &&
           direction.effect[i] > std::max(direction.rounding, part * direction.effect.maxCoeff());
  };
  std::erase_if(order, [&](Eigen::Index i) {
    return std::abs(direction.share[i]) < part * largest && !changes_alike(i) && !makes_up(i);
  });
  TradeOff found;
  for (const Eigen::Index i : order) found.parameters.push_back(parameters[static_cast<std::size_t>(i)].name);
  const double reach = direction.reach[first];
  const double open = std::isfinite(reach) ? reach * std::abs(direction.share[first] / direction.change[first])
                                           : 2.0 * direction.deviation * largest;
  const double near_zero = direction.near_zero[first];
  // The deviation near the end of a range says nothing of a parameter that its profile bounds well.
  constexpr double all = 1.0;
  if (order.size() == 1 && std::isfinite(direction.deviation) && std::isfinite(reach) && open < all &&
      !(near_zero > 0.0))
    return std::nullopt;
  const std::string quantity = core::format_number(open * near_zero, 2) + " " +
                               core::unit_for(coordinate, parameters[static_cast<std::size_t>(first)].unit);
  // The deviation along a direction holds near the estimate; a profile without an end goes on beyond.
  const bool is_endless = std::isinf(reach);
  const std::string known = std::isfinite(direction.deviation) && is_endless
                                ? "; the profile of " + sought(parameters, first) + " has no end"
                            : std::isfinite(direction.deviation)
                                ? "; the data leave " + (near_zero > 0.0 ? quantity : percent_of_size(open)) +
                                      " of " + sought(parameters, first) + " open"
                                : "; the data do not determine them";
  if (order.size() == 1)
    found.text = std::isfinite(direction.deviation) && is_endless
                     ? "the data hardly show " + sought(parameters, first) + ": its profile has no end"
                 : std::isfinite(direction.deviation)
                     ? "the data hardly show " + sought(parameters, first) + ": it is known to " +
                           (near_zero > 0.0 ? quantity + ", and is zero within that"
                                            : percent_of_size(open) + " of its value")
                     : "the data do not show " + found.parameters.front() + " at all";
  else if (order.size() == 2)
    found.text = pair_text(direction, parameters, order[0], order[1]) + known;
  else
    found.text = core::joined(found.parameters, " and ") + " trade off against each other" + known;
  return found;
}

}  // namespace dualdamp::identify
