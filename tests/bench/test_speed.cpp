#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>

#include "bench/speed/contender.hpp"
#include "bench/speed/timing.hpp"

using namespace dualdamp::bench::speed;

TEST_CASE("The exact engine and Odeint follow the same motion") {
  const StandardCase work = standard_case();
  const int periods = 50;

  ExactContender exact(work);
  const Followed ours = exact.follow(periods);
  CHECK(ours.reversals == 100);
  // Four turns of rounding at most: the orbit contracts, so errors of single periods do not add up.
  CHECK(std::abs(ours.amplitude / exact_amplitude - 1.0) < 1e-15);

  // The error of an orbit is a few times the tolerance of a step, divided by how much a period forgets (a third).
  for (const double tolerance : {1e-6, 1e-9, 1e-12}) {
    for (const Locator locator : {Locator::bisection, Locator::toms748}) {
      const Followed theirs = OdeintContender(work, tolerance, locator).follow(periods);
      CHECK(theirs.reversals == 100);
      CHECK(std::abs(theirs.amplitude / exact_amplitude - 1.0) < 10.0 * tolerance);
    }
  }
}

TEST_CASE("A contender starts from the same state each time") {
  ExactContender exact(standard_case());
  const double first = exact.follow(3).amplitude;
  CHECK(exact.follow(3).amplitude == first);
}

TEST_CASE("Times are those of one unit of work, and slower work takes longer") {
  double sink = 0.0;
  const auto spin = [&sink](int rounds) {
    for (int i = 0; i < rounds; ++i) sink += std::sin(sink + i);
  };
  const std::array<std::function<void(int)>, 2> works{[&](int units) { spin(100 * units); },
                                                      [&](int units) { spin(1000 * units); }};
  const auto times = time_in_turns(works, 7, 0.005);
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
