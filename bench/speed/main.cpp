// dualdamp-speed: time per forcing period of the standard case, the exact engine beside general solvers, in one
// run.

#include <fmt/core.h>

#include <cmath>
#include <exception>
#include <functional>
#include <string>
#include <vector>

#include "bench/speed/contender.hpp"
#include "bench/speed/timing.hpp"
#include "core/build_info.hpp"

namespace {

using namespace dualdamp::bench::speed;

constexpr int periods_per_start = 50;  // a start costs each contender about one reversal

/// One line of the table; the time is that of one start.
struct Row {
  std::string name;
  Time time;
  Followed followed;
};

std::vector<Row> in_process(const StandardCase& work, int batches) {
  std::vector<Contender> contenders{exact_contender(work)};
  for (Contender& contender : odeint_contenders(work)) contenders.push_back(std::move(contender));
  for (Contender& contender : cvode_contenders(work)) contenders.push_back(std::move(contender));

  std::vector<Row> rows;
  std::vector<std::function<void(int)>> works;
  double sink = 0.0;  // used below, so that no work can be dropped
  for (const Contender& contender : contenders) {
    works.emplace_back([&sink, &contender](int starts) {
      for (int start = 0; start < starts; ++start) sink += contender.follow(periods_per_start).amplitude;
    });
  }
  const std::vector<Time> times = time_in_turns(works, batches, 0.02);
  for (std::size_t i = 0; i < contenders.size(); ++i)
    rows.push_back({contenders[i].name, times[i], contenders[i].follow(periods_per_start)});
  if (!std::isfinite(sink)) throw std::runtime_error("a contender returned no number");
  return rows;
}

std::vector<Row> by_scipy(const StandardCase& work, int batches) {
  std::vector<Row> rows;
  const std::vector<std::string> names{"SciPy DOP853 1e-9", "SciPy DOP853 1e-12"};
  const auto results = follow_with_scipy(work, {1e-9, 1e-12}, batches, periods_per_start);
  for (std::size_t i = 0; i < results.size(); ++i)
    rows.push_back({names[i], quartiles(results[i].seconds), results[i].followed});
  return rows;
}

void print(const Row& row, double unit) {
  const double per_period = 1e6 / periods_per_start;
  fmt::print("{:32}{:>14.3f}{:>22}{:>10.1f}{:>18.1e}\n", row.name, row.time.median * per_period,
             fmt::format("{:.3f} - {:.3f}", row.time.low * per_period, row.time.high * per_period),
             row.time.median / unit, std::abs(row.followed.amplitude / exact_amplitude - 1.0));
}

int compare(int batches) {
  const StandardCase work = standard_case();
  std::vector<Row> rows = in_process(work, batches);
  const std::vector<Row> scipy = by_scipy(work, 5);
  rows.insert(rows.end(), scipy.begin(), scipy.end());

  const auto& build = dualdamp::core::build_info();
  fmt::print("dualdamp {} ({}), {}, {}; {} batches of 20 ms, in turns; {} periods from each start\n\n",
             build.version, build.commit, build.compiler, build.build_type, batches, periods_per_start);
  fmt::print("{:32}{:>14}{:>22}{:>10}{:>18}\n", "one forcing period", "median [us]", "quartiles [us]", "ratio",
             "amplitude error");
  bool sound = true;
  for (const Row& row : rows) {
    print(row, rows.front().time.median);
    sound = sound && row.followed.reversals == 2L * periods_per_start;
  }
  if (cvode_contenders(work).empty())
    fmt::print("skipped: CVODE; libsundials-dev was not there when this was built\n");
  if (scipy.empty()) fmt::print("skipped: SciPy; python3-scipy is not there\n");
  fmt::print("\nratio: median time over that of the exact engine; error: relative, to the closed form\n");
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
