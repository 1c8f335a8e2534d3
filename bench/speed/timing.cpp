#include "bench/speed/timing.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>

namespace dualdamp::bench::speed {
namespace {

/// Processor time: other programs on the machine affect it only through shared caches and clock rates.
double seconds(const std::function<void(int)>& work, int units) {
  const std::clock_t begin = std::clock();
  work(units);
  return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
}

int batch_size(const std::function<void(int)>& work, double batch_seconds) {
  int units = 1;
  for (;;) {
    const double taken = seconds(work, units);
    if (taken >= 0.25 * batch_seconds)
      return std::max(1, static_cast<int>(std::lround(units * batch_seconds / taken)));
    units *= 2;
  }
}

}  // namespace

Time quartiles(std::vector<double> times) {
  std::sort(times.begin(), times.end());
  const std::size_t last = times.size() - 1;
  return {.median = times[last / 2], .low = times[last / 4], .high = times[last - last / 4]};
}

std::vector<Time> time_alternately(std::span<const std::function<void(int)>> works, int batches,
                                   double batch_seconds) {
  std::vector<int> units;
  for (const auto& work : works) units.push_back(batch_size(work, batch_seconds));
  std::vector<std::vector<double>> times(works.size());
  for (int batch = 0; batch < batches; ++batch) {
    for (std::size_t i = 0; i < works.size(); ++i) times[i].push_back(seconds(works[i], units[i]) / units[i]);
  }
  std::vector<Time> result;
  for (auto& list : times) result.push_back(quartiles(std::move(list)));
  return result;
}

}  // namespace dualdamp::bench::speed
