// dualdamp-speed: time per forcing period of the standard case, the engines beside general solvers, in one run.
// With --smooth the table of smooth laws alone.

#include <fmt/core.h>

#include <cmath>
#include <exception>
#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bench/speed/contender.hpp"
#include "bench/speed/fits.hpp"
#include "bench/speed/identification.hpp"
#include "bench/speed/sampled_drive.hpp"
#include "bench/speed/smooth_table.hpp"
#include "bench/speed/steady_states.hpp"
#include "bench/speed/timing.hpp"
#include "core/build_info.hpp"

namespace {

using namespace dualdamp::bench::speed;

constexpr int periods_per_start = 50;  // a start costs each contender about one reversal

/// One line of the table; the time is that of one period of one oscillator [s].
struct Row {
  std::string name;
  Time time;
  IntegratedMotion motion;
};

Time divided(const Time& time, double parts) { return {time.median / parts, time.low / parts, time.high / parts}; }

std::vector<Contender> contenders_in_process(const StandardCase& work) {
  std::vector<Contender> contenders{exact_contender(work)};
  for (const auto& list : {batch_contenders(work), odeint_contenders(work), cvode_contenders(work)})
    contenders.insert(contenders.end(), list.begin(), list.end());
  return contenders;
}

std::vector<Row> in_process(const StandardCase& work, int batches) {
  const std::vector<Contender> contenders = contenders_in_process(work);
  std::vector<std::function<void(int)>> works;
  double sink = 0.0;  // used below, so that no work can be dropped
  for (const Contender& contender : contenders) {
    works.emplace_back([&sink, &contender](int starts) {
      for (int start = 0; start < starts; ++start) sink += contender.integrate(periods_per_start).amplitude;
    });
  }
  const std::vector<Time> times = time_alternately(works, batches, 0.02);
  if (!std::isfinite(sink)) throw std::runtime_error("a contender returned no number");
  std::vector<Row> rows;
  for (std::size_t i = 0; i < contenders.size(); ++i) {
    rows.push_back({contenders[i].name, divided(times[i], periods_per_start * contenders[i].oscillators),
                    contenders[i].integrate(periods_per_start)});
  }
  return rows;
}

std::vector<Row> by_scipy(const StandardCase& work, int batches) {
  std::vector<Row> rows;
  const std::vector<std::string> names{"SciPy DOP853 1e-9", "SciPy DOP853 1e-12"};
  const auto results = integrate_with_scipy(work, {1e-9, 1e-12}, batches, periods_per_start);
  for (std::size_t i = 0; i < results.size(); ++i)
    rows.push_back({names[i], divided(quartiles(results[i].seconds), periods_per_start), results[i].motion});
  return rows;
}

void print(const Row& row, double unit) {
  fmt::print("{:32}{:>14.3f}{:>22}{:>10.2f}{:>18.1e}\n", row.name, row.time.median * 1e6,
             fmt::format("{:.3f} - {:.3f}", row.time.low * 1e6, row.time.high * 1e6), row.time.median / unit,
             std::abs(row.motion.amplitude / exact_amplitude - 1.0));
}

/// Median time of the row with this name, or 0.
double median_of(const std::vector<Row>& rows, std::string_view name) {
  for (const Row& row : rows) {
    if (row.name == name) return row.time.median;
  }
  return 0.0;
}

void print_figures(const StandardCase& work, const std::vector<Row>& rows) {
  const auto print_ratio = [&](std::string_view ours, std::string_view theirs, double target) {
    const double time = median_of(rows, theirs);
    const double measured = time > 0.0 ? time / median_of(rows, ours) : 0.0;
    if (measured > 0.0)
      fmt::print("{:60}{:>14.0f}{:>14.0f}\n", fmt::format("{} over {}", theirs, ours), measured, target);
  };
  fmt::print("\n{:60}{:>14}{:>14}\n", "figure", "measured", "target");
  const std::string& engine = rows.front().name;
  const std::string widest = batch_contenders(work).back().name;
  print_ratio(engine, "Odeint dopri5 1e-9, bisection", 40.0);
  print_ratio(engine, "CVODE Adams 1e-9", 450.0);
  print_ratio(widest, "Odeint dopri5 1e-9, bisection", 100.0);
  print_ratio(widest, "CVODE Adams 1e-9", 1000.0);
  fmt::print("{:60}{:>14.2f}{:>14.2f}\n", "millions of steady states a second in batches, all cores, at least",
             1e-6 * steady_states_per_second(work, 200'000), 2.0);
  fmt::print("{:60}{:>14.0f}{:>14.0f}\n", "one steady state from nothing, in periods of the engine, at most",
             seconds_for_steady_state(work) / rows.front().time.median, 25.0);
  fmt::print("{:60}{:>14.3f}{:>14.3f}\n", "seconds for an x-Y curve of 10,000 points, one core, at most",
             seconds_for_curve(work, 10'000), 0.1);
  for (const auto& [name, interpolation] :
       {std::pair{"linear", dualdamp::sim::Interpolation::linear}, {"cubic", dualdamp::sim::Interpolation::cubic}})
    fmt::print("{:60}{:>14.2f}{:>14.2f}\n",
               fmt::format("seconds for 1,000,000 samples of a drive, {}, at most", name),
               seconds_for_sampled_drive(work, 1'000'000, interpolation), 2.0);
}

void print_identification() {
  const auto print_time = [](std::string_view what, double seconds, const std::string& target) {
    fmt::print("{:60}{:>14.4f}{:>14}\n", what, seconds, target);
  };
  fmt::print("\n{:60}{:>14}{:>14}\n", "seconds of identification, one core, at most", "measured", "target");
  print_time("1,000 bootstrap replicates of 50 pairs", seconds_for_bootstrap(), "0.1");
  print_time("output_error with intervals, 10 s at 1 kHz", seconds_for_output_error(), "1");
  print_time("law_selection of 50 pairs", seconds_for_law_selection(), "");
  fmt::print("\n{:60}{:>14}{:>14}\n", "processor seconds, all threads, at most", "measured", "target");
  print_time("any_law of 8 states with phases", seconds_for_any_law(AnyLawRecord::states), "20");
  print_time("any_law of a response, 21 states with phases", seconds_for_any_law(AnyLawRecord::response), "120");
  print_time("any_law of 24 extremes", seconds_for_any_law(AnyLawRecord::decay), "");
  print_time("any_law of a free vibration, 12 s at 2 kHz", seconds_for_any_law(AnyLawRecord::history), "");
  print_time("what to measure after 8 amplitudes", seconds_for_design(), "");
  print_time("ledger of assumptions, 12 s of y, x, v, a at 2 kHz", seconds_for_ledger(), "");
  print_time("the most memory of all of these [MB]", peak_megabytes(), "500");
  print_time("fit of coulomb and damping, 10 s at 1 kHz", seconds_for_coulomb_fit(), "");
  print_time("fit of lugre (five numbers) and damping, 10 s at 1 kHz", seconds_for_lugre_fit(), "60");
  print_time("fit of dahl and damping, 16 amplitudes and phases", seconds_for_dahl_fit(), "");
  print_time("prediction of such a record", seconds_for_prediction(), "");
  print_time("sweep of 100 by 100 steady states", seconds_for_sweep(), "");
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
    sound = sound && row.motion.reversals == 2L * periods_per_start;
  }
  if (cvode_contenders(work).empty())
    fmt::print("skipped: CVODE; libsundials-dev was not there when this was built\n");
  if (scipy.empty()) fmt::print("skipped: SciPy; python3-scipy is not there\n");
  fmt::print("\nratio: median time over that of the exact engine; error: relative, to the closed form\n");
  print_figures(work, rows);
  print_smooth_table(batches);
  print_identification();
  if (!sound) fmt::print(stderr, "a contender lost a reversal: there are two in each period\n");
  return sound ? 0 : 1;
}

}  // namespace

int main(int count, char** words) {
  try {
    if (count > 1 && std::string_view(words[1]) == "--smooth") {
      print_smooth_table(25);
      return 0;
    }
    return compare(25);
  } catch (const std::exception& error) {
    fmt::print(stderr, "dualdamp-speed: {}\n", error.what());
    return 70;
  }
}
