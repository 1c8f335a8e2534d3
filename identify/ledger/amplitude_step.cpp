#include "identify/ledger/amplitude_step.hpp"

#include <algorithm>
#include <cmath>

namespace dualdamp::identify {

void take_step(const Eigen::VectorXd& step, const Taken& taken, SteadyParameters& at) {
  const double most = 0.5 * at.friction.zeta;
  at.friction.zeta = std::max(1e-5, at.friction.zeta + std::clamp(step[0], -most, most));
  at.friction.x_f += std::clamp(step[1], -0.3, 0.3);
  constexpr double most_relaxed = 0.2;
  for (std::size_t j = 0; j < taken.size(); ++j)
    at.g[static_cast<Eigen::Index>(taken[j])] +=
        std::clamp(step[2 + static_cast<Eigen::Index>(j)], -most_relaxed, most_relaxed);
}

bool is_settled(const SteadyParameters& before, const SteadyParameters& after) {
  constexpr double little = 1e-3;
  return std::abs(after.friction.zeta - before.friction.zeta) <= little * before.friction.zeta &&
         std::abs(after.friction.x_f - before.friction.x_f) <= little &&
         (after.g - before.g).lpNorm<Eigen::Infinity>() <= little;
}

}  // namespace dualdamp::identify
