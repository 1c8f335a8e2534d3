#include "sim/engine/smooth/reasons.hpp"

#include <cmath>
#include <complex>
#include <cstddef>

#include "core/constants.hpp"
#include "core/numbers.hpp"
#include "sim/engine/eigenvalues.hpp"
#include "sim/engine/law_name.hpp"

namespace dualdamp::sim {

namespace {

/// Swings of a vibration in one of the shortest periods that a steady state can follow one by one. Damped as much
/// as this, a vibration is soon gone.
constexpr double many_swings = 1'000.0;
constexpr double soon_gone = 0.01;

}  // namespace

std::string too_fast_vibration(const Flow& flow, std::span<const double> X, double t, double shortest_period) {
  if (X.empty()) return {};
  const auto n = static_cast<Eigen::Index>(X.size());
  std::vector<double> columns(X.size() * X.size());
  flow.jacobian(X, t, columns);
  std::complex<double> fastest = 0.0;
  for (const std::complex<double>& value : eigenvalues_of(Eigen::Map<const Eigen::MatrixXd>(columns.data(), n, n)))
    if (std::abs(value.imag()) > fastest.imag()) fastest = {value.real(), std::abs(value.imag())};
  const double rate = std::abs(fastest);
  const double swings = rate * shortest_period / core::two_pi;
  const bool is_damped = !(std::abs(fastest.real()) < soon_gone * rate);
  if (is_damped || !(swings > many_swings) || !std::isfinite(rate)) return {};
  const double slower = swings / many_swings;
  return "a second vibration at " + core::format_number(rate, 3) +
         " rad/s, which hardly anything damps, swings too often to be followed; it can be up to " +
         core::format_number(rate / slower, 3) + " rad/s (its mass " + core::format_number(slower * slower, 2) +
         " times as heavy, or its stiffness as many times smaller), or with a damping ratio of " +
         core::format_number(soon_gone, 2) + " or more";
}

std::string infinite_force(const Model& model, const Flow& flow, std::span<const double> X, double t, double reach,
                           friction::Instant now, std::vector<friction::Memory> memories) {
  std::vector<double> rates(X.size());
  flow.evaluate(X, t, rates);
  std::vector<double> there(X.size());
  const double begin = now.t;
  // First here, where an infinite force makes the rates infinite too; then ahead.
  for (double s = 0.0; s < reach; s = s > 0.0 ? 10.0 * s : 1e-15 * reach) {
    for (std::size_t k = 0; k < X.size(); ++k) there[k] = s > 0.0 ? X[k] + s * rates[k] : X[k];
    flow.scatter(there, memories);
    now.t = begin + s;
    now.x = there[0];
    now.v = there[1];
    for (std::size_t i = 0; i < memories.size(); ++i) {
      if (!std::isfinite(now.v) || std::isfinite(model.friction[i].force(memories[i], now, flow.direction())))
        continue;
      return "the force of " + name_in_list(model, i) + " is not finite at x = " + core::format_number(now.x, 6) +
             " " + model.unit("m") + ", v = " + core::format_number(now.v, 6) + " " + model.unit("m/s");
    }
  }
  return {};
}

}  // namespace dualdamp::sim
