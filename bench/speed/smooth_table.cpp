#include "bench/speed/smooth_table.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "bench/speed/smooth_contender.hpp"
#include "bench/speed/steady_states.hpp"
#include "bench/speed/timing.hpp"

namespace dualdamp::bench::speed {
namespace {

constexpr int periods_per_start = 10;
constexpr std::size_t reversals = 2UL * periods_per_start;
constexpr double error_wanted = 1e-8;

/// Tolerances from 1e-5 to 1e-12.
constexpr std::array<double, 22> tolerances = {1e-5,  5e-6,  2e-6,  1e-6,  5e-7,  2e-7,  1e-7,  5e-8,
                                               2e-8,  1e-8,  5e-9,  2e-9,  1e-9,  5e-10, 2e-10, 1e-10,
                                               5e-11, 2e-11, 1e-11, 5e-12, 2e-12, 1e-12};

struct Entry {
  std::string law;
  SmoothContender contender;
  double error = 0.0;
  Time time{};
};

/// Error of a contender; infinite where it fails or loses a reversal.
double error_of(const SmoothCase& work, const SmoothContender& contender) {
  std::vector<double> turning_points;
  try {
    contender.integrate(periods_per_start, turning_points);
    // In the first run the engine chose between explicit and implicit steps.
    turning_points.clear();
    contender.integrate(periods_per_start, turning_points);
  } catch (const std::runtime_error&) {
    return std::numeric_limits<double>::infinity();
  }
  if (turning_points.size() != reversals) return std::numeric_limits<double>::infinity();
  return amplitude_error(turning_points, work.amplitude);
}

/// Times all entries, one batch of each in turn.
void time(std::span<Entry> entries, int batches, double batch_seconds) {
  std::vector<std::function<void(int)>> works;
  double sink = 0.0;  // used below, so that no work can be dropped
  for (const Entry& entry : entries) {
    works.emplace_back([&sink, &entry](int starts) {
      std::vector<double> turning_points;
      for (int i = 0; i < starts; ++i) entry.contender.integrate(periods_per_start, turning_points);
      sink += turning_points.back();
    });
  }
  const std::vector<Time> times = time_alternately(works, batches, batch_seconds);
  if (!std::isfinite(sink)) throw std::runtime_error("a contender returned no number");
  for (std::size_t i = 0; i < entries.size(); ++i)
    entries[i].time = {times[i].median / periods_per_start, times[i].low / periods_per_start,
                       times[i].high / periods_per_start};
}

/// The fastest entry that reaches the wanted error.
std::optional<Entry> fastest(const SmoothCase& work,
                             const std::function<std::vector<SmoothContender>(double tolerance)>& settings) {
  std::vector<Entry> good;
  for (const double tolerance : tolerances) {
    for (SmoothContender& contender : settings(tolerance)) {
      const double error = error_of(work, contender);
      if (error <= error_wanted) good.push_back({work.law, std::move(contender), error});
    }
  }
  if (good.empty()) return std::nullopt;
  time(good, 3, 0.01);
  return *std::ranges::min_element(good, {}, [](const Entry& entry) { return entry.time.median; });
}

void print(const Entry& entry, const char* who, const Entry& ours) {
  fmt::print("{:16}{:10}{:>13.1f}{:>20}{:>8.1f}{:>10.1e}  {}\n", entry.law, who, entry.time.median * 1e6,
             fmt::format("{:.1f} - {:.1f}", entry.time.low * 1e6, entry.time.high * 1e6),
             entry.time.median / ours.time.median, entry.error, entry.contender.setting);
}

}  // namespace

void print_smooth_table(int batches) {
  fmt::print("\n{:16}{:10}{:>13}{:>20}{:>8}{:>10}  {}\n", "one forcing", "period", "median [us]", "quartiles [us]",
             "ratio", "error", "tolerance and setting");
  double ratio_of_lugre = 0.0;
  for (const SmoothCase& work : smooth_cases()) {
    std::vector<Entry> entries;
    for (const auto& settings :
         {std::function([&](double tolerance) { return std::vector{smooth_engine(work, tolerance)}; }),
          std::function([&](double tolerance) { return cvode_smooth(work, tolerance); })}) {
      if (const auto best = fastest(work, settings)) entries.push_back(*best);
    }
    if (entries.empty()) throw std::runtime_error(work.law + " is not integrated to the error wanted");
    time(entries, batches, 0.02);
    print(entries.front(), "dualdamp", entries.front());
    if (entries.size() == 1) continue;
    print(entries.back(), "CVODE", entries.front());
    if (work.law == "lugre") ratio_of_lugre = entries.back().time.median / entries.front().time.median;
  }
  fmt::print("\nratio: median time over that of dualdamp; error: largest of 20 turning points, relative\n");
  fmt::print("\n{:60}{:>14}{:>14}\n", "figure", "measured", "target");
  if (ratio_of_lugre > 0.0)
    fmt::print("{:60}{:>14.0f}{:>14.0f}\n", "lugre: CVODE over dualdamp", ratio_of_lugre, 10.0);
  fmt::print("{:60}{:>14.3f}{:>14.3f}\n", "seconds for a lugre x-Y curve of 50 points, one core, at most",
             seconds_for_smooth_curve(50), 1.0);
}

}  // namespace dualdamp::bench::speed
