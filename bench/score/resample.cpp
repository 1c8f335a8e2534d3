#include "bench/score/resample.hpp"

#include <array>
#include <map>

#include "core/random.hpp"

namespace dualdamp::bench {

namespace {

constexpr std::uint32_t stream = 129;

/// `count` draws among `places`, as counts for each place.
template <typename Draw>
void draw_with_replacement(const std::vector<std::size_t>& places, std::vector<double>& counts, Draw draw) {
  for (const std::size_t place : places) counts[place] = 0.0;
  for (std::size_t i = 0; i < places.size(); ++i)
    counts[places[static_cast<std::size_t>(draw() * static_cast<double>(places.size()))]] += 1.0;
}

std::uint64_t mixed(std::uint64_t z) {
  z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9U;
  z = (z ^ (z >> 27U)) * 0x94D049BB133111EBU;
  return z ^ (z >> 31U);
}

}  // namespace

Resample::Resample(const Grid& grid, std::size_t number)
    : number_(number),
      seed_(mixed(number * 0x9E3779B97F4A7C15U)),
      rigs_(grid.question().rigs.size(), 1.0),
      departures_(grid.question().departures.size(), 1.0) {
  if (number == 0) return;
  const core::RandomStream draws{.seed = number, .stream = stream};
  std::uint64_t next = 0;
  const auto draw = [&] { return draws.uniform(next++); };
  std::vector<std::size_t> all;
  for (std::size_t i = 0; i < rigs_.size(); ++i) all.push_back(i);
  draw_with_replacement(all, rigs_, draw);
  std::map<Family, std::vector<std::size_t>> families;
  for (std::size_t i = 0; i < departures_.size(); ++i)
    families[grid.question().departures[i].family()].push_back(i);
  for (const auto& [family, members] : families) draw_with_replacement(members, departures_, draw);
}

std::vector<double> Resample::case_weights(const Grid& grid) const {
  std::vector<double> weights(grid.cases(), 1.0);
  if (number_ == 0) return weights;
  for (std::size_t motion = 0; motion < grid.motions(); ++motion) {
    const double of_rig = rigs_[grid.motion(motion).rig];
    for (std::size_t i = 0; i < grid.cases_per_motion(); ++i) {
      const std::size_t number = motion * grid.cases_per_motion() + i;
      weights[number] = of_rig * times(number);
    }
  }
  return weights;
}

double Resample::times(std::size_t number) const {
  // Cumulated Poisson probabilities of 0, 1, 2, ...
  static constexpr std::array<double, 7> below = {0.36787944117144233, 0.73575888234288467, 0.91969860292860584,
                                                  0.98101184312384626, 0.99634015317265634, 0.99940581518241833,
                                                  0.99991675885071196};
  constexpr double unit = 0x1.0p-53;
  const double u = static_cast<double>(mixed(seed_ + number * 0x9E3779B97F4A7C15U) >> 11U) * unit;
  double times = 0.0;
  for (const double bound : below) times += u >= bound ? 1.0 : 0.0;
  return times;
}

}  // namespace dualdamp::bench
