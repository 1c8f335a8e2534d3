// dualdamp-speed: time per forcing period of the standard case, the exact engine beside Boost.Odeint, in one run.

#include <fmt/core.h>

#include <array>
#include <cmath>
#include <exception>
#include <functional>
#include <string_view>

#include "bench/speed/contender.hpp"
#include "bench/speed/timing.hpp"
#include "core/build_info.hpp"

namespace {

using namespace dualdamp::bench::speed;

constexpr int periods_per_start = 50;  // a start costs each contender about one reversal

struct Row {
  std::string_view name;
  std::function<Followed(int)> follow;
};

int compare(int batches) {
  const StandardCase work = standard_case();
  ExactContender exact(work);
  const OdeintContender loose(work, 1e-9, Locator::bisection);
  const OdeintContender tight(work, 1e-12, Locator::bisection);
  const OdeintContender quick(work, 1e-9, Locator::toms748);
  const std::array<Row, 4> rows{{
      {"dualdamp, exact engine", [&](int periods) { return exact.follow(periods); }},
      {"Odeint dopri5 1e-9, bisection", [&](int periods) { return loose.follow(periods); }},
      {"Odeint dopri5 1e-12, bisection", [&](int periods) { return tight.follow(periods); }},
      {"Odeint dopri5 1e-9, TOMS 748", [&](int periods) { return quick.follow(periods); }},
  }};

  std::array<std::function<void(int)>, rows.size()> works;
  double sink = 0.0;  // printed, so that no work can be dropped
  for (std::size_t i = 0; i < rows.size(); ++i) {
    works[i] = [&sink, &row = rows[i]](int starts) {
      for (int start = 0; start < starts; ++start) sink += row.follow(periods_per_start).amplitude;
    };
  }
  const auto times = time_in_turns(works, batches, 0.02);

  const auto& build = dualdamp::core::build_info();
  fmt::print("dualdamp {} ({}), {}, {}; {} batches of 20 ms, in turns; {} periods from each start\n\n",
             build.version, build.commit, build.compiler, build.build_type, batches, periods_per_start);
  fmt::print("{:32}{:>14}{:>22}{:>10}{:>18}\n", "one forcing period", "median [us]", "quartiles [us]", "ratio",
             "amplitude error");
  bool sound = true;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Followed followed = rows[i].follow(periods_per_start);
    const double per_period = 1e6 / periods_per_start;
    fmt::print("{:32}{:>14.3f}{:>22}{:>10.1f}{:>18.1e}\n", rows[i].name, times[i].median * per_period,
               fmt::format("{:.3f} - {:.3f}", times[i].low * per_period, times[i].high * per_period),
               times[i].median / times[0].median, std::abs(followed.amplitude / exact_amplitude - 1.0));
    sound = sound && followed.reversals == 2L * periods_per_start;
  }
  fmt::print(
      "\nratio: median time over that of the exact engine; error: relative, to the closed form (checksum {:.0f})\n",
      sink);
  if (!sound) fmt::print(stderr, "a contender lost a reversal: there are two in each period\n");
  return sound ? 0 : 1;
}

}  // namespace

int main() {
  try {
    return compare(25);
  } catch (const std::exception& error) {
    fmt::print(stderr, "dualdamp-speed: {}\n", error.what());
    return 70;
  }
}
