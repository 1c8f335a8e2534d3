#include "identify/methods/amplitudes/bootstrap.hpp"

#include <algorithm>
#include <boost/math/statistics/univariate_statistics.hpp>
#include <cmath>

#include "core/cancellation.hpp"

namespace dualdamp::identify {

std::size_t Draws::below(std::size_t size) {
  return static_cast<std::size_t>(stream_.uniform(next_++) * static_cast<double>(size));
}

std::vector<std::vector<std::size_t>> sweep_blocks(const std::vector<Datum>& pairs) {
  int last = 0;
  for (const Datum& datum : pairs) last = std::max(last, datum.sweep);
  std::vector<std::vector<std::size_t>> blocks(static_cast<std::size_t>(last) + 1);
  for (std::size_t i = 0; i < pairs.size(); ++i) blocks[static_cast<std::size_t>(pairs[i].sweep)].push_back(i);
  std::erase_if(blocks, [](const auto& block) { return block.empty(); });
  return blocks;
}

namespace {

/// The p-quantile of sorted values, linear between them.
double quantile(const std::vector<double>& sorted, double p) {
  const double place = p * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (place - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

FurtherParameter summary(std::string name, std::string unit, std::vector<double> values) {
  FurtherParameter parameter{std::move(name), std::move(unit), boost::math::statistics::mean(values), std::nullopt,
                             std::nullopt};
  parameter.std = std::sqrt(boost::math::statistics::sample_variance(values));
  std::ranges::sort(values);
  parameter.interval95 = {quantile(values, 0.025), quantile(values, 0.975)};
  return parameter;
}

}  // namespace

void add_bootstrap(Estimate& estimate, int replicates, std::size_t sweeps, const KnownConstants& constants,
                   const Replicate& replicate) {
  std::vector<double> zeta;
  std::vector<double> F0;
  zeta.reserve(static_cast<std::size_t>(replicates));
  F0.reserve(static_cast<std::size_t>(replicates));
  for (int i = 0; i < replicates; ++i) {
    core::stop_if_cancelled();
    Draws draws(static_cast<std::uint32_t>(i));
    const std::optional<Eigen::Vector2d> value = replicate(draws);
    if (!value) continue;
    zeta.push_back((*value)[0]);
    F0.push_back(constants.stiffness * (*value)[1]);
  }
  const std::size_t failed = static_cast<std::size_t>(replicates) - zeta.size();
  const std::string of_all = " of " + std::to_string(replicates) + " bootstrap replicates";
  if (zeta.size() < 2) {
    estimate.warnings.push_back("there is no bootstrap: " + std::to_string(failed) + of_all + " gave no estimate");
    return;
  }
  estimate.others.push_back(summary("bootstrap_zeta", "", std::move(zeta)));
  estimate.others.push_back(summary("bootstrap_F0", "N", std::move(F0)));
  if (20 * failed > static_cast<std::size_t>(replicates))
    estimate.warnings.push_back(std::to_string(failed) + of_all +
                                " gave no estimate and are missing in its intervals");
  constexpr std::size_t enough_sweeps = 10;
  if (sweeps == 1)
    estimate.warnings.emplace_back(
        "the bootstrap drew residuals, since the record is one sweep: drift between "
        "sweeps is not in its intervals");
  else if (sweeps < enough_sweeps)
    estimate.warnings.push_back("the bootstrap drew from " + std::to_string(sweeps) +
                                " sweeps only: its intervals are too short");
}

}  // namespace dualdamp::identify
