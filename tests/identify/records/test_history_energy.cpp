#include "identify/records/history_energy.hpp"

#include <catch2/catch.hpp>

#include "tests/identify/histories.hpp"

using namespace dualdamp::identify;
using namespace dualdamp::identify::testing;

TEST_CASE("The account of a history closes, with and without sticks, whatever the window") {
  const double c = 11.0;
  const double F0 = 3.7;
  for (const double omega : {38.79, 20.0}) {
    const History history = sampled(driven_bearing(c, F0, 4e-3, omega), 3.0, 2000.0);
    for (const int windows : {1, 7}) {
      for (const WindowEnergy& w : energy_of(prepared_history(history, 0.0), bearing_constants, windows)) {
        // Turns are known to (w T)^2 = 4e-4 of themselves, a small part of the way.
        CHECK(w.input - w.stored == Approx(c * w.square_speed + F0 * w.path).epsilon(2e-4));
      }
    }
  }
}
