#include "identify/statistics/drive_steps.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <numbers>

#include "core/random.hpp"

using namespace dualdamp::identify;

namespace {

std::vector<std::size_t> steps_of(const std::function<double(double)>& force, double deviation = 0.001) {
  const dualdamp::core::RandomStream noise{3, 1};
  History history{.sample_rate = 1.0};
  history.x.resize(2000);
  for (std::size_t i = 0; i < history.x.size(); ++i)
    history.force.push_back(force(static_cast<double>(i)) + deviation * noise.normal(i));
  return drive_steps(history);
}

double sine(double t, double samples) { return std::sin(2.0 * std::numbers::pi * t / samples); }

}  // namespace

TEST_CASE("A drive that is switched on or off between two samples steps there") {
  CHECK(steps_of([](double t) { return t < 758.7 ? sine(t, 60.0) : 0.0; }) == std::vector<std::size_t>{758});
  CHECK(steps_of([](double t) { return t < 300.2 ? 0.0 : sine(t + 5.0, 30.0); }) == std::vector<std::size_t>{300});
  CHECK(steps_of([](double t) { return t > 100.5 && t < 112.5 ? 1.0 : 0.0; }) ==
        std::vector<std::size_t>{100, 112});
}

TEST_CASE("Smooth drives, kinks, blows, noise and square waves have no steps") {
  CHECK(steps_of([](double t) { return sine(t, 8.0); }).empty());
  CHECK(steps_of([](double t) { return t < 600.0 ? sine(t, 30.0) : 0.0; }).empty());
  CHECK(steps_of([](double t) { return sine(t * t / 2000.0, 20.0); }).empty());
  for (const double width : {1.5, 3.0, 4.0, 6.0, 10.0, 20.0})
    for (const double begin : {100.0, 100.3, 100.8})
      CHECK(steps_of([&](double t) {
              return t > begin && t < begin + width ? std::sin(std::numbers::pi * (t - begin) / width) : 0.0;
            }).empty());
  CHECK(steps_of([](double) { return 0.0; }, 1.0).empty());
  CHECK(steps_of([](double t) { return std::fmod(t, 100.0) < 50.5 ? 1.0 : -1.0; }).empty());
}
