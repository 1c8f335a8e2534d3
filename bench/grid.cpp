#include "bench/grid.hpp"

namespace dualdamp::bench {

namespace {

/// Makes unrelated seeds from neighbouring numbers: the finalizer of SplitMix64 (steele2014fast).
std::uint64_t mixed(std::uint64_t z) {
  z += 0x9E3779B97F4A7C15U;
  z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9U;
  z = (z ^ (z >> 27U)) * 0x94D049BB133111EBU;
  return z ^ (z >> 31U);
}

}  // namespace

Grid::Grid(const StressTest& question)
    : question_(question),
      motions_per_range_(1 + question.departures.size() * question.severities.size()),
      cases_per_motion_(question.sensors.size() * static_cast<std::size_t>(question.seeds)) {}

Grid::Motion Grid::motion(std::size_t number) const {
  const std::size_t ranges = question_.ranges.size();
  Motion motion{.rig = number / motions_per_range_ / ranges,
                .range = number / motions_per_range_ % ranges,
                .place = number % motions_per_range_};
  if (motion.place == 0) return motion;
  motion.departure = question_.departures[(motion.place - 1) / question_.severities.size()];
  motion.severity = question_.severities[(motion.place - 1) % question_.severities.size()];
  return motion;
}

Grid::Case Grid::at(std::size_t number) const {
  const std::size_t place = number % cases_per_motion_;
  const auto seeds = static_cast<std::size_t>(question_.seeds);
  return {number / cases_per_motion_, place / seeds, place % seeds};
}

TrueParameters Grid::parameters(const Motion& motion) const {
  TrueParameters truth = question_.rigs[motion.rig].parameters();
  if (!motion.departure.has_F0()) truth.F0 = not_stated;
  if (!motion.departure.has_zeta()) truth.zeta = not_stated;
  return truth;
}

std::uint64_t Grid::drive_seed(std::size_t motion) const {
  constexpr std::uint64_t of_drives = 0x8CB92BA72F3D8DD7U;  // other seeds than those of the cases
  return mixed(mixed(static_cast<std::uint64_t>(question_.seed) ^ of_drives) + motion);
}

std::uint64_t Grid::seed(std::size_t number) const {
  return mixed(mixed(static_cast<std::uint64_t>(question_.seed)) + number);
}

}  // namespace dualdamp::bench
