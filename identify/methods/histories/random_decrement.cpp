#include "identify/methods/histories/random_decrement.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "core/constants.hpp"
#include "core/numbers.hpp"
#include "identify/conclusion.hpp"
#include "identify/models/force_parameters.hpp"
#include "identify/records/usable_histories.hpp"
#include "identify/statistics/statistics.hpp"

namespace dualdamp::identify {

namespace {

constexpr int bands = 6;
constexpr int extremes_used = 4;  ///< of a signature: one and a half periods; later noise dominates

/// An extreme of the response: its place and its magnitude.
struct Start {
  std::size_t at = 0;
  double amplitude = 0.0;
  double sign = 1.0;
};

/// Outer turning points: |x[i]| is larger than at the neighbours. There is no condition on later samples, because
/// it would select stretches by their future.
std::vector<Start> starts_of(const std::vector<double>& x, std::size_t period) {
  std::vector<Start> starts;
  for (std::size_t i = 1; i + 2 * period < x.size(); ++i) {
    const double sign = x[i] > 0.0 ? 1.0 : -1.0;
    if (sign * x[i] > sign * x[i - 1] && sign * x[i] >= sign * x[i + 1])
      starts.push_back({i, std::abs(x[i]), sign});
  }
  return starts;
}

/// Mean of the stretches; those that begin on the negative side change their sign.
std::vector<double> signature_of(const std::vector<double>& x, const std::vector<Start>& starts, std::size_t begin,
                                 std::size_t end, std::size_t length) {
  std::vector<double> mean(length);
  for (std::size_t s = begin; s < end; ++s)
    for (std::size_t i = 0; i < length; ++i)
      mean[i] += starts[s].sign * x[starts[s].at + i] / static_cast<double>(end - begin);
  return mean;
}

/// Damping ratio and mean amplitude of a signature.
struct Decrement {
  double zeta = 0.0;
  double amplitude = 0.0;
};

/// From the logarithms of the first extremes of a signature; nothing when they do not decrease.
std::optional<Decrement> decrement_of(const std::vector<double>& signature, std::size_t period) {
  double sum_log = 0.0, sum_index_log = 0.0;
  for (int e = 0; e < extremes_used; ++e) {
    const auto middle = static_cast<std::size_t>(static_cast<double>(period) * 0.5 * e);
    const std::size_t reach = period / 6;
    double extreme = 0.0;
    for (std::size_t i = middle > reach ? middle - reach : 0; i <= std::min(middle + reach, signature.size() - 1);
         ++i)
      extreme = std::max(extreme, (e % 2 == 0 ? 1.0 : -1.0) * signature[i]);
    if (!(extreme > 0.0)) return std::nullopt;
    sum_log += std::log(extreme);
    sum_index_log += (e - 0.5 * (extremes_used - 1)) * std::log(extreme);
  }
  constexpr double index_square = extremes_used * (extremes_used * extremes_used - 1) / 12.0;
  const double L = -sum_index_log / index_square / std::numbers::pi;
  return Decrement{L / std::sqrt(1.0 + L * L), std::exp(sum_log / extremes_used)};
}

/// zeta and F0 of the straight line over 1/a.
ForceParameters line_through(const EstimateCurve& curve, const KnownConstants& constants) {
  const std::vector<double>& a = curve.columns[0].values;
  const std::vector<double>& zeta = curve.columns[1].values;
  double mean_u = 0.0, mean_zeta = 0.0, S_uu = 0.0, S_uz = 0.0, n = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    n += 1.0;
    const double du = 1.0 / a[i] - mean_u;
    mean_u += du / n;
    mean_zeta += (zeta[i] - mean_zeta) / n;
    S_uu += du * (1.0 / a[i] - mean_u);
    S_uz += du * (zeta[i] - mean_zeta);
  }
  const double slope = S_uz / S_uu;
  return {constants.mass, constants.critical_damping() * (mean_zeta - slope * mean_u), constants.stiffness,
          0.5 * std::numbers::pi * constants.stiffness * slope};
}

}  // namespace

Estimate random_decrement(const Record& record, const KnownConstants& constants) {
  Estimate estimate;
  estimate.method = random_decrement_method.name;
  const std::optional<NumberedHistory> longest =
      longest_history(record, constants, estimate, UnmeasuredDrive::noise);
  if (!longest) return estimate;
  const auto& [number, history] = *longest;
  const double W = constants.natural_frequency();
  const auto period = static_cast<std::size_t>(std::lround(core::two_pi / W * history->sample_rate));
  std::vector<Start> starts;
  if (period >= 12) starts = starts_of(history->x, period);
  constexpr std::size_t fewest = 100;  // stretches in a band: the random part of the mean is then a tenth
  if (starts.size() < bands * fewest) {
    refuse(estimate, "at least 600 extremes, twelve samples a period or finer, are needed, and there are " +
                         std::to_string(starts.size()));
    return estimate;
  }
  std::ranges::sort(starts, {}, &Start::amplitude);
  EstimateCurve damping{"equivalent_damping", {{"a", "m", {}}, {"zeta_eq", "", {}}}};
  EstimateCurve signature{"signature", {{"t", "s", {}}, {"x", "m", {}}}};
  for (std::size_t b = 0; b < bands; ++b) {
    const std::vector<double> mean =
        signature_of(history->x, starts, b * starts.size() / bands, (b + 1) * starts.size() / bands, 2 * period);
    if (b == bands / 2) {
      for (std::size_t i = 0; i < mean.size(); ++i)
        signature.columns[0].values.push_back(static_cast<double>(i) / history->sample_rate);
      signature.columns[1].values = mean;
    }
    const std::optional<Decrement> decrement = decrement_of(mean, period);
    if (!decrement) continue;
    damping.columns[0].values.push_back(decrement->amplitude);
    damping.columns[1].values.push_back(decrement->zeta);
  }
  if (damping.columns[0].values.size() < 3) {
    refuse(estimate, "the averaged stretches do not decay");
    return estimate;
  }
  estimate.value = parameters(line_through(damping, constants));
  const std::size_t middle = damping.columns[0].values.size() / 2;
  estimate.others.push_back(
      {"equivalent_damping_ratio", "", damping.columns[1].values[middle], std::nullopt, std::nullopt});
  estimate.others.push_back({"amplitude", "m", damping.columns[0].values[middle], std::nullopt, std::nullopt});
  estimate.used = {number};
  estimate.curves = {std::move(damping), std::move(signature)};
  estimate.warnings.emplace_back(
      "no interval is claimed: the scatter of the mean stretches says nothing of how far zeta and F0 are off");
  conclude(estimate,
           {"random decrement does not separate Coulomb from viscous friction: read the equivalent damping alone"},
           {});
  return estimate;
}

constinit const MethodEntry random_decrement_method{
    .name = "random_decrement",
    .summary =
        "equivalent damping of a random response over its amplitude; not to be used for the Coulomb friction",
    .assumes =
        "long stationary response to a white excitation; the averaged stretches are taken for a free decay, which they "
        "are not where there is dry friction: never usable",
    .equation = "zeta_eq(a) = zeta + 2 F0/(pi k a) of the mean of stretches that begin at an extreme near a",
    .sources = "cole1973",
    .needs = RecordKind::history,
    .lacks = lacks_histories,
    .call = call_of<random_decrement>,
    .rests_on = AssumptionSet::all_but(Assumption::drive),
};

}  // namespace dualdamp::identify
