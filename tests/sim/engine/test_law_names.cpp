// Answers that blame a law of a plugin name it, and its place in the list.

#include <catch2/catch.hpp>
#include <limits>
#include <memory>
#include <string>
#include <string_view>

#include "friction_models/laws/coulomb.hpp"
#include "sim/motion/simulate.hpp"
#include "tests/support/standard_system.hpp"

using namespace dualdamp;

namespace {

/// A dashpot whose force is infinite beyond a place, as a plugin gives it.
class Blocked final : public friction::LawModel {
 public:
  explicit Blocked(double place = 0.05) : place_(place) {}

  [[nodiscard]] double force(const friction::Memory&, const friction::Instant& now,
                             friction::Direction) const override {
    return now.x > place_ ? std::numeric_limits<double>::infinity() : now.v;
  }
  [[nodiscard]] std::string_view name() const override { return "blocked"; }

 private:
  double place_;
};

std::string reason(const sim::Model& model) { return sim::simulate(model, {.duration = 5.0}).outcome.reason; }

}  // namespace

TEST_CASE("an infinite force names the plugin's law, its place in the list, x and v") {
  sim::Model model = test::standard_system(friction::Law(std::make_shared<const Blocked>()));
  CHECK_THAT(reason(model),
             Catch::Contains("the force of friction (law 'blocked' of a plugin) is not finite at x = 0.05"));
  CHECK_THAT(reason(model), Catch::Matches(".* m, v = [^ ]* m/s"));
  model.oscillator.coordinate = core::Coordinate::angle;
  CHECK_THAT(reason(model), Catch::Matches(".* rad, v = [^ ]* rad/s"));
  model.friction.insert(model.friction.begin(), friction::Law(friction::Coulomb(0.1, 0.1)));
  CHECK_THAT(reason(model), Catch::Contains("item 2 of system.friction (law 'blocked' of a plugin) is not finite"));
}

TEST_CASE("a force that is infinite from the start on names its law too") {
  const sim::Model model = test::standard_system(friction::Law(std::make_shared<const Blocked>(-1.0)));
  CHECK_THAT(reason(model), Catch::Contains("t = 0.000000 s") &&
                                Catch::Contains("the force of friction (law 'blocked' of a plugin) is not finite"));
}
