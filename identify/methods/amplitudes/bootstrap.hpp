#pragma once
/// Bootstrap of an estimate from x-Y pairs: the estimate is made again from data drawn from the data.
///
/// Whole sweeps are drawn: a drift from sweep to sweep is common to the pairs of a sweep, and drawing single pairs
/// would hide it. If there is one sweep, residuals are drawn instead. Draw n of replicate i depends on i and n
/// alone, so results are the same on every machine. Source: efron1993 (chapters 6, 9, 13). Cost: that of the
/// estimates; 1,000 of a straight line through 50 pairs take a few milliseconds.

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "core/random.hpp"
#include "identify/estimate.hpp"
#include "identify/methods/amplitudes/resonance_line.hpp"
#include "identify/record.hpp"

namespace dualdamp::identify {

/// The random numbers of one replicate.
class Draws {
 public:
  explicit Draws(std::uint32_t replicate) : stream_{.seed = 0, .stream = replicate} {}

  /// Uniform in 0 ... size - 1.
  std::size_t below(std::size_t size);

 private:
  core::RandomStream stream_;
  std::uint64_t next_ = 0;
};

/// Indices of the pairs of each sweep.
[[nodiscard]] std::vector<std::vector<std::size_t>> sweep_blocks(const std::vector<Datum>& pairs);

/// (zeta, x_f [m]) of one replicate; nothing if its data allow no estimate.
using Replicate = std::function<std::optional<Eigen::Vector2d>(Draws&)>;

/// Makes the replicates and adds `bootstrap_zeta` and `bootstrap_F0` to the further parameters: mean, standard
/// deviation and the interval between the 2.5 and 97.5 percentiles. `sweeps`: how many were drawn from, 1 for
/// residuals; fewer than ten give a warning.
void add_bootstrap(Estimate& estimate, int replicates, std::size_t sweeps, const KnownConstants& constants,
                   const Replicate& replicate);

}  // namespace dualdamp::identify
