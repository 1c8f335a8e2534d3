// The conformance suite must pass a law that keeps the contract and name what is wrong with one that does not.

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "friction_models/laws/coulomb.hpp"
#include "sim/conformance/law_conformance.hpp"

namespace {

using namespace dualdamp;
using friction::Affine;
using friction::Direction;
using friction::Instant;
using friction::Memory;
using friction::Trigger;

enum class Planted {
  nothing,
  wrong_guard,
  endless_jump,
  wrong_advance,
  wrong_speed,
  active,
  lopsided,
  wrong_rate,
  curved,
  choosy,
  unloading,
  moody
};

/// A spring of stiffness kt that slips at F, elastic-perfectly-plastic; state: where the slider stands.
/// Stuck: mode 0, F = kt (x - a). Slipping: mode +-1, F = +-level, a = x - F/kt.
class Slider {
 public:
  explicit Slider(Planted planted) : planted_(planted) {}

  [[nodiscard]] Memory start(const Instant& now) const { return {.state = {now.x}}; }
  [[nodiscard]] double force(const Memory& m, const Instant& now, Direction) const {
    if (m.mode != 0) return m.mode * level(m.mode);
    const double stretched = stiffness * (now.x - m.state[0]);
    if (planted_ == Planted::moody) return (1.0 + 1e-6 * *calls_) * stretched;
    if (planted_ == Planted::curved) return stretched + 1e-3 * m.state[0] * m.state[0];
    return planted_ == Planted::active ? -stretched : stretched;
  }
  void guards(const Memory& m, const Instant& now, Direction, std::vector<double>& values) const {
    if (m.mode != 0) return;
    const double stretched = stiffness * (now.x - m.state[0]);
    values.push_back(level(1) - stretched);
    values.push_back(level(-1) + stretched);
  }
  void jump(Memory& m, Trigger trigger, const Instant& now, Direction direction) const {
    if (trigger.cause != Trigger::direction_change) {
      if (planted_ == Planted::endless_jump) return;
      m.mode = trigger.cause == 0 ? 1 : -1;
    } else if (m.mode != 0 && friction::sign(direction) != m.mode) {
      m.state[0] = now.x - m.mode * level(m.mode) / stiffness;
      if (planted_ == Planted::choosy) m.state[0] = std::abs(m.state[0]);
      if (planted_ == Planted::unloading) m.course.unloaded = m.state[0] > 0.0;
      if (planted_ == Planted::moody) ++*calls_;
      m.mode = 0;
    }
  }
  void rates(const Memory& m, const Instant& now, Direction, std::span<double> rates) const {
    rates[0] = m.mode == 0 ? 0.0 : planted_ == Planted::wrong_speed ? 2.0 * now.v : now.v;
  }
  [[nodiscard]] Affine affine_force(const Memory& m, const Instant& now, Direction direction) const {
    if (m.mode != 0) return {.constant = force(m, now, direction)};
    return {.constant = force(m, {}, direction),
            .rate = planted_ == Planted::wrong_rate ? 1.0 : 0.0,
            .position = planted_ == Planted::active ? -stiffness : stiffness};
  }
  void affine_guards(const Memory& m, const Instant&, Direction, std::vector<Affine>& guards) const {
    if (m.mode != 0) return;
    const double sign = planted_ == Planted::wrong_guard ? -1.0 : 1.0;
    guards.push_back({.constant = level(1) + stiffness * m.state[0], .position = -stiffness});
    guards.push_back({.constant = level(-1) - sign * stiffness * m.state[0], .position = sign * stiffness});
  }
  void advance(Memory& m, const Instant&, const Instant& end, double, Direction) const {
    if (m.mode != 0) m.state[0] = end.x - m.mode * level(m.mode) / stiffness;
    if (planted_ == Planted::wrong_advance) m.state[0] += 1e-3;
  }

 private:
  static constexpr double stiffness = 100.0;
  [[nodiscard]] double level(int side) const { return planted_ == Planted::lopsided && side < 0 ? 1.5 : 1.0; }

  Planted planted_;
  std::shared_ptr<int> calls_ = std::make_shared<int>(0);
};

enum class PlantedInDahl { nothing, modulus, no_number, heat, scale };

/// z' = v - |v| z/z0, F = s0 z: Dahl's law, a smooth one.
class Dahl {
 public:
  explicit Dahl(PlantedInDahl planted) : planted_(planted) {}

  [[nodiscard]] Memory start(const Instant&) const { return {.state = {0.0}}; }
  [[nodiscard]] double respond(const Memory& m, const Instant& now, Direction direction,
                               std::span<double> rates) const {
    const double speed = planted_ == PlantedInDahl::modulus ? std::abs(now.v) : friction::sign(direction) * now.v;
    rates[0] = now.v - speed * m.state[0] / 0.01;
    if (planted_ == PlantedInDahl::no_number) rates[0] += std::sqrt(m.state[0]);
    return 100.0 * m.state[0];
  }
  void scales(const Memory&, std::span<double> scales) const {
    scales[0] = planted_ == PlantedInDahl::scale ? -1.0 : 0.01;
  }
  [[nodiscard]] double dissipation(const Memory& m, const Instant& now, Direction direction) const {
    const double heat = 1e4 * m.state[0] * m.state[0] * friction::sign(direction) * now.v;
    return planted_ == PlantedInDahl::heat ? -heat : heat;
  }

 private:
  PlantedInDahl planted_;
};

bool named(const std::vector<std::string>& faults, const std::string& part) {
  return std::any_of(faults.begin(), faults.end(),
                     [&](const std::string& fault) { return fault.find(part) != std::string::npos; });
}

std::vector<std::string> faults_with(Planted planted) {
  return sim::nonconformities({.law = friction::Law(Slider(planted))});
}

std::vector<std::string> faults_with(PlantedInDahl planted) {
  return sim::nonconformities({.law = friction::Law(Dahl(planted))});
}

}  // namespace

TEST_CASE("laws that keep the contract conform", "[friction][conformance]") {
  CHECK(faults_with(Planted::nothing) == std::vector<std::string>{});
  CHECK(faults_with(PlantedInDahl::nothing) == std::vector<std::string>{});
}

TEST_CASE("the conformance suite names planted faults", "[friction][conformance]") {
  CHECK(named(faults_with(Planted::wrong_guard), "affine guards differ"));
  CHECK(named(faults_with(Planted::endless_jump), "jumps do not end"));
  CHECK(named(faults_with(Planted::wrong_advance), "after advance"));
  CHECK(named(faults_with(Planted::wrong_rate), "affine force differs"));
  CHECK(named(faults_with(Planted::active), "more work"));
  CHECK(named(faults_with(Planted::lopsided), "mirrored"));
  CHECK(named(faults_with(Planted::wrong_speed), "derivative of advance"));
  CHECK(named(faults_with(Planted::curved), "not affine in the states"));
  CHECK(named(faults_with(Planted::choosy), "a jump is not affine"));
  CHECK(named(faults_with(Planted::unloading), "a jump is not affine"));
  CHECK(named(faults_with(Planted::moody), "second time"));
  const friction::Law coulomb(friction::Coulomb(2.0, 2.0));
  const auto unscaled = [&](double) { return coulomb; };
  CHECK(named(sim::nonconformities({.law = coulomb, .scaled = unscaled}), "a factor on its limits"));
}

TEST_CASE("the conformance suite names planted faults of laws that are not affine", "[friction][conformance]") {
  CHECK(named(faults_with(PlantedInDahl::modulus), "kink at v = 0"));
  CHECK(named(faults_with(PlantedInDahl::no_number), "not finite"));
  CHECK(named(faults_with(PlantedInDahl::heat), "the dissipation is negative"));
  CHECK(named(faults_with(PlantedInDahl::scale), "the scale of a state"));
}

TEST_CASE("the conformance suite names faults of parameter tables", "[friction][conformance]") {
  // 'limit' has no lower end, though the law needs one; 'length' says nothing about itself.
  const std::vector<friction::Parameter> table = {
      {.name = "limit", .unit = "N", .range = {.low = 0.0}, .meaning = "level"}, {.name = "length", .unit = "m"}};
  const auto faults = sim::nonconformities({.law = friction::Law(Slider(Planted::nothing)),
                                            .parameters = &table,
                                            .values = {{"limit", 1.0}, {"length", 1.0}}});
  CHECK(faults == std::vector<std::string>{"'length' has no meaning or no unit"});
}
