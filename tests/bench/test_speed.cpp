#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>

#include "bench/speed/contender.hpp"
#include "bench/speed/steady_states.hpp"
#include "bench/speed/timing.hpp"

using namespace dualdamp::bench::speed;

namespace {

constexpr int periods = 50;

double error_of(const IntegratedMotion& motion) { return std::abs(motion.amplitude / exact_amplitude - 1.0); }

}  // namespace

TEST_CASE("The exact engine integrates the standard case to the last bits") {
  const IntegratedMotion ours = exact_contender(standard_case()).integrate(periods);
  CHECK(ours.reversals == 100);
  // Four periods of rounding at most: the orbit contracts, so errors of single periods do not add up.
  CHECK(error_of(ours) < 1e-15);
}

TEST_CASE("Batches integrate the standard case to the last bits") {
  const auto contenders = batch_contenders(standard_case());
  REQUIRE(!contenders.empty());
  for (const Contender& batch : contenders) {
    const IntegratedMotion ours = batch.integrate(periods);
    CHECK(ours.reversals == 100);
    CHECK(error_of(ours) < 1e-15);
  }
}

TEST_CASE("The general solvers find the same motion") {
  // The error of an orbit is that of a step times the number of steps, over the share by which a period reduces
  // deviations (a third). Odeint keeps closely to its tolerance; CVODE takes few steps of high order, with
  // different constants.
  for (const Contender& odeint : odeint_contenders(standard_case())) {
    const IntegratedMotion theirs = odeint.integrate(periods);
    CHECK(theirs.reversals == 100);
    CHECK(error_of(theirs) < 10.0 * odeint.tolerance);
  }
  for (const Contender& cvode : cvode_contenders(standard_case())) {
    INFO(cvode.name);
    const IntegratedMotion theirs = cvode.integrate(periods);
    CHECK(theirs.reversals == 100);
    CHECK(error_of(theirs) < 1000.0 * cvode.tolerance);
  }
}

TEST_CASE("SciPy finds the same motion and times each batch") {
  const std::vector<double> tolerances{1e-6, 1e-9};
  const auto results = integrate_with_scipy(standard_case(), tolerances, 2, 10);
  if (results.empty()) return;  // SciPy is not installed
  REQUIRE(results.size() == tolerances.size());
  for (std::size_t i = 0; i < tolerances.size(); ++i) {
    CHECK(results[i].motion.reversals == 20);
    CHECK(error_of(results[i].motion) < 1000.0 * tolerances[i]);
    REQUIRE(results[i].seconds.size() == 2);
    CHECK(results[i].seconds.front() > 0.0);
  }
}

TEST_CASE("Steady states are counted by the second") {
  const StandardCase work = standard_case();
  CHECK(steady_states_per_second(work, 2'000) > 1e3);
  const double seconds = seconds_for_steady_state(work);
  CHECK(seconds > 0.0);
  CHECK(seconds < 0.1);
}

TEST_CASE("A contender starts from the same state each time") {
  const Contender exact = exact_contender(standard_case());
  const double first = exact.integrate(3).amplitude;
  CHECK(exact.integrate(3).amplitude == first);
}

TEST_CASE("Times are those of one unit of work, and slower work takes longer") {
  double sink = 0.0;
  const auto spin = [&sink](int rounds) {
    for (int i = 0; i < rounds; ++i) sink += std::sin(sink + i);
  };
  const std::array<std::function<void(int)>, 2> works{[&](int units) { spin(100 * units); },
                                                      [&](int units) { spin(1000 * units); }};
  const auto times = time_alternately(works, 7, 0.005);
  REQUIRE(times.size() == 2);
  for (const Time& time : times) {
    CHECK(time.low > 0.0);
    CHECK(time.low <= time.median);
    CHECK(time.median <= time.high);
  }
  // Ten times the work; a factor of two leaves room for a busy machine.
  CHECK(times[1].median / times[0].median == Approx(10.0).epsilon(0.5));
  CHECK(std::isfinite(sink));
}
