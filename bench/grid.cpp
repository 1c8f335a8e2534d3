#include "bench/grid.hpp"

namespace dualdamp::bench {

Grid::Grid(const StressTest& question)
    : question_(question),
      motions_per_range_(1 + question.laws.size() * question.severities.size()),
      cases_per_motion_(question.sensors.size() * static_cast<std::size_t>(question.seeds)) {}

Grid::Motion Grid::motion(std::size_t number) const {
  Motion motion{.range = &question_.ranges[number / motions_per_range_]};
  const std::size_t place = number % motions_per_range_;
  if (place == 0) return motion;
  motion.law = question_.laws[(place - 1) / question_.severities.size()];
  motion.severity = question_.severities[(place - 1) % question_.severities.size()];
  return motion;
}

Grid::Case Grid::at(std::size_t number) const {
  const std::size_t place = number % cases_per_motion_;
  const auto seeds = static_cast<std::size_t>(question_.seeds);
  return {number / cases_per_motion_, place / seeds, place % seeds};
}

}  // namespace dualdamp::bench
