/// Whole motions under one to three laws with modifiers, drawn at random from the registry: each must reach its end
/// and balance its energy. Then single motions with mode changes that could repeat without end.

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "friction_models/registry.hpp"
#include "sim/engine/exact_engine.hpp"
#include "sim/motion/simulate.hpp"
#include "tests/support/random.hpp"

namespace {

using namespace dualdamp;
using friction::ParameterValues;

struct Motion {
  sim::Model model;
  std::string words;  ///< to reproduce it
};

/// Empty: not a number.
std::string describe(const ParameterValues& values) {
  std::string words;
  for (const auto& [name, value] : values.values()) {
    if (const auto* number = std::get_if<double>(&value)) words += fmt::format(" {} {:.17g}", name, *number);
    const auto* records = std::get_if<std::vector<ParameterValues>>(&value);
    for (std::size_t i = 0; records != nullptr && i < records->size(); ++i)
      words += fmt::format(" {} {{{}}}", name, describe((*records)[i]));
  }
  return words;
}

void add_law(Motion& motion, std::string_view name, ParameterValues values) {
  const friction::LawEntry* entry = friction::find_law(name);
  REQUIRE(entry != nullptr);
  REQUIRE(friction::complete(entry->parameters, values).empty());
  for (friction::Law& law : entry->make(values)) motion.model.friction.push_back(std::move(law));
  motion.words += fmt::format("; {}{}", name, describe(values));
}

Motion motion_of(const sim::Oscillator& oscillator, double amplitude, double frequency, double phase = 0.0) {
  Motion motion;
  motion.model.oscillator = oscillator;
  motion.model.excitation = {
      .type = sim::ExcitationType::base_harmonic, .amplitude = amplitude, .frequency = frequency, .phase = phase};
  motion.words =
      fmt::format("m {:.17g}, k {:.17g}, c {:.17g}, Y {:.17g}, w {:.17g}, phase {:.17g}", oscillator.mass,
                  oscillator.stiffness, oscillator.damping, amplitude, frequency, phase);
  return motion;
}

/// Draws laws whose limits are shares of the drive's force, and whose stiffnesses range widely around the
/// oscillator's.
class RandomLaws {
 public:
  RandomLaws(test::Random& random, const Motion& motion) : random_(random) {
    const sim::Oscillator& o = motion.model.oscillator;
    length_ = motion.model.excitation.amplitude;
    stiffness_ = o.stiffness;
    time_ = 1.0 / sim::natural_frequency(o);
  }

  void add(Motion& motion) {
    using Draw = ParameterValues (RandomLaws::*)();
    static constexpr std::array<std::pair<std::string_view, Draw>, 5> kinds = {
        {{"coulomb", &RandomLaws::coulomb},
         {"contact_compliance", &RandomLaws::contact},
         {"reset_integrator", &RandomLaws::reset_integrator},
         {"iwan", &RandomLaws::iwan},
         {"bristle", &RandomLaws::bristle}}};
    const auto& [name, draw] = kinds[static_cast<std::size_t>(random_.pick(5))];
    steepest_ = 2.0 * stiffness_;
    may_fall_ = true;
    ParameterValues values = (this->*draw)();
    add_modifiers(*friction::find_law(name), values);
    add_law(motion, name, std::move(values));
  }

 private:
  double force() { return stiffness_ * length_ * random_.logarithmic(1e-2, 1.0); }
  double number() { return static_cast<double>(random_.pick(1'000'000)); }

  ParameterValues coulomb() {
    ParameterValues values{{"kinetic", force()}};
    if (random_.chance(0.5)) values.set("static", values.number("kinetic") * random_.uniform(1.0, 2.0));
    return values;
  }
  ParameterValues contact() {
    ParameterValues values = coulomb();
    const double stiffness = stiffness_ * random_.logarithmic(0.3, 1e3);
    values.set("contact_stiffness", stiffness);
    if (random_.chance(0.4)) {
      values.set("contact_damping", stiffness_ * time_ * random_.logarithmic(1e-2, 10.0));
      steepest_ = 0.0;
    }
    return values;
  }
  /// Its force jumps when it sticks again: under limits that fall too fast there may be no motion, see below.
  ParameterValues reset_integrator() {
    ParameterValues values{{"kinetic", force()}, {"stiffness", stiffness_ * random_.logarithmic(0.3, 1e3)}};
    if (random_.chance(0.6)) values.set("static_gain", random_.uniform(0.0, 1.0));
    if (random_.chance(0.4)) values.set("damping", stiffness_ * time_ * random_.logarithmic(1e-2, 10.0));
    may_fall_ = !values.has("damping");
    if (values.has("static_gain") || values.has("damping")) steepest_ = 0.99 * values.number("stiffness");
    return values;
  }
  ParameterValues iwan() {
    ParameterValues values{{"limit", force()}, {"stiffness", stiffness_ * random_.logarithmic(0.3, 1e2)}};
    values.set("count", 1.0 + random_.pick(12));
    return values;
  }
  /// Not so short that they snap all the time.
  ParameterValues bristle() {
    ParameterValues values{{"snap_distance", length_ * random_.logarithmic(0.2, 1.0)}, {"seed", number()}};
    values.set("count", 1.0 + random_.pick(5));
    values.set("stiffness", force() / (values.number("count") * values.number("snap_distance")));
    return values;
  }

  void add_modifiers(const friction::LawEntry& law, ParameterValues& values) {
    for (const std::string_view modifier : law.modifiers) {
      if (!random_.chance(0.25)) continue;
      if (modifier == "drift") {
        values.set("drift", random_.uniform(may_fall_ ? -0.03 : 0.0, 0.03) / time_);
      } else if (modifier == "position_slope" && steepest_ > 0.0) {
        values.set("position_slope",
                   random_.sign() * std::min(steepest_, stiffness_ * random_.logarithmic(1e-3, 2.0)));
      } else if (modifier == "fluctuation") {
        // Bristles of almost no length snap without end.
        const double ratio = random_.uniform(0.05, law.is_random ? 0.2 : 0.9);
        const double correlation_time = time_ * random_.logarithmic(0.5, 50.0);
        values.set("fluctuation",
                   std::vector<ParameterValues>{
                       {{"ratio", ratio}, {"correlation_time", correlation_time}, {"seed", number()}}});
      }
    }
  }

  test::Random& random_;
  double length_ = 0.0;     ///< m, of the drive
  double stiffness_ = 0.0;  ///< N/m, of the oscillator
  double time_ = 0.0;       ///< s, of the oscillator
  // For the law that is drawn.
  double steepest_ = 0.0;  ///< N/m, largest slope of its limits over position
  bool may_fall_ = true;   ///< its limits, with time
};

Motion random_motion(test::Random& random) {
  const double wn = random.logarithmic(1.0, 100.0);
  const double mass = random.logarithmic(0.1, 10.0);
  const double zeta = random.logarithmic(0.01, 0.5);
  const double amplitude = random.logarithmic(1e-3, 1.0);
  const double frequency = wn * random.logarithmic(0.2, 3.0);
  const double phase = random.chance(0.5) ? 0.0 : random.angle();
  Motion motion = motion_of({mass, mass * wn * wn, 2.0 * zeta * mass * wn}, amplitude, frequency, phase);
  RandomLaws laws(random, motion);
  const int count = 1 + random.pick(3);
  for (int i = 0; i < count; ++i) laws.add(motion);
  if (random.chance(0.3)) {
    motion.model.initial.position = amplitude * random.uniform(-1.0, 1.0);
    motion.model.initial.velocity = wn * amplitude * random.uniform(-1.0, 1.0);
    motion.words +=
        fmt::format("; x0 {:.17g}, v0 {:.17g}", motion.model.initial.position, motion.model.initial.velocity);
  }
  return motion;
}

/// Mode changes of laws, and how many of them followed another at the same instant.
struct Switchings {
  int all = 0;
  int at_once = 0;
};

/// Adds those of a motion, which must reach its end.
void count_switchings(const Motion& motion, double periods, Switchings& count) {
  const double duration = periods * 2.0 * std::numbers::pi / motion.model.excitation.frequency;
  const sim::History history = sim::simulate(motion.model, {.duration = duration});
  double last = -1.0;
  for (const sim::Event& event : history.events) {
    if (event.kind != sim::EventKind::switching) continue;
    ++count.all;
    count.at_once += event.t == last ? 1 : 0;
    last = event.t;
  }
  INFO(history.outcome.reason << "; " << motion.words);
  CHECK(history.outcome.ok());
}

/// Of motions that start at rest at x = 0, with the base away from there, under a law that `draw` gives.
template <class Draw>
Switchings count_switchings(std::string_view law, std::uint64_t seed, double periods, const Draw& draw) {
  test::Random random(seed);
  Switchings count;
  for (int i = 0; i < 300; ++i) {
    const double damping = random.logarithmic(0.1, 10.0);
    const double amplitude = random.logarithmic(0.01, 0.3);
    Motion motion = motion_of({1.0, 100.0, damping}, amplitude, random.logarithmic(2.0, 30.0));
    add_law(motion, law, draw(random));
    count_switchings(motion, periods, count);
  }
  return count;
}

/// Every work is a sum over intervals, with the rounding of its terms: some 10 eps of the sum of their magnitudes.
/// This sum is more than the net work: the support spring takes k Y^2 and returns it in every period.
double relative_defect(const sim::Model& model, const sim::Energy& energy, double periods) {
  const double drive = model.excitation.amplitude;
  const double swapped = model.oscillator.stiffness * drive * drive * periods;
  return std::abs(energy.defect) /
         (swapped + std::abs(energy.input) + std::abs(energy.friction) + std::abs(energy.viscous));
}

}  // namespace

TEST_CASE("Random motions under laws with modifiers come to their end and balance their energy", "[mixtures]") {
  // DUALDAMP_WALK_CASES for a longer run, DUALDAMP_WALK_SEED for other motions: the number of the first.
  const long cases = test::case_count("DUALDAMP_WALK_CASES", 150);
  const long seed = test::case_count("DUALDAMP_WALK_SEED", 1);
  constexpr double periods = 30.0;
  long events = 0;
  double worst_defect = 0.0;
  for (long i = 0; i < cases; ++i) {
    test::Random random(static_cast<std::uint64_t>(seed + i));
    const Motion motion = random_motion(random);
    INFO(seed + i << ": " << motion.words);
    const double duration = periods * 2.0 * std::numbers::pi / motion.model.excitation.frequency;
    const sim::History history = sim::simulate(motion.model, {.duration = duration, .max_events = 1'000'000});
    INFO(history.outcome.reason);
    CHECK(history.outcome.ok());
    CHECK(std::isfinite(history.final.x));
    const double defect = relative_defect(motion.model, history.energy, periods);
    CHECK(defect <= 1e-12);
    events += static_cast<long>(history.events.size());
    worst_defect = std::max(worst_defect, defect);
  }
  WARN(fmt::format("{} motions, {} events, largest defect of the energy {:.2g}", cases, events, worst_defect));
}

TEST_CASE("A damped contact that breaks away does not hold on again by rounding", "[mixtures]") {
  // In stick its guard is kinetic - (k u + c v); in slip it is the same over c, computed from another stretch. Both
  // are zero at break-away. The mass has just started, so the rounding of amplitudes thousands of times larger
  // decides.
  const Switchings count = count_switchings("contact_compliance", 29, 3.0, [](test::Random& random) {
    return ParameterValues{{"kinetic", random.logarithmic(0.1, 1.0)},
                           {"contact_stiffness", random.logarithmic(1e4, 1e5)},
                           {"contact_damping", random.logarithmic(0.1, 10.0)}};
  });
  CHECK(count.all > 1000);
  CHECK(count.at_once == 0);
}

TEST_CASE("A damped contact that lets go at a release does not hold on again by rounding", "[mixtures]") {
  // It has relaxed to its limit while the mass was at rest: with static = kinetic the mass then starts without
  // acceleration, and both guards of the contact begin with a zero of second order.
  test::Random random(30);
  Switchings count;
  for (int i = 0; i < 200; ++i) {
    Motion motion = motion_of({1.0, 100.0, random.logarithmic(0.1, 5.0)}, 0.1, random.uniform(1.0, 8.0));
    motion.model.excitation.phase = random.angle();
    motion.model.initial.velocity = 0.3;
    const double level = random.uniform(1.0, 5.0);
    const double stiffness = random.logarithmic(1e4, 1e6);
    add_law(motion, "coulomb", {{"kinetic", level}, {"static", i % 2 == 0 ? level : 1.2 * level}});
    add_law(motion, "contact_compliance",
            {{"kinetic", random.uniform(0.01, 2.0)},
             {"contact_stiffness", stiffness},
             {"contact_damping", stiffness * random.logarithmic(1e-5, 1e-3)}});
    count_switchings(motion, 10.0, count);
  }
  CHECK(count.all > 1000);
  CHECK(count.at_once == 0);
}

TEST_CASE("A bond under a limit that falls as steeply as its spring does not break by rounding", "[mixtures]") {
  // Its guard limit - spring then hardly depends on x: a small difference of large numbers.
  const Switchings count = count_switchings("reset_integrator", 31, 10.0, [](test::Random& random) {
    const double stiffness = random.logarithmic(50.0, 500.0);
    return ParameterValues{{"kinetic", random.uniform(0.5, 5.0)},
                           {"stiffness", stiffness},
                           {"static_gain", random.uniform(0.1, 1.0)},
                           {"position_slope", -(1.0 - random.logarithmic(1e-6, 1e-2)) * stiffness}};
  });
  CHECK(count.all > 1000);
}

TEST_CASE("A damped bond under a falling limit may have no motion, which is an outcome", "[mixtures]") {
  // The bond is dragged on the left while the mass moves right; its end stops when v = rate/stiffness. If the bond
  // slides, the mass is accelerated there. If it holds, the damper slows the mass down, v falls behind the limit,
  // and the bond slides again.
  const double kinetic = 2.0;
  const double stiffness = 20.0;
  const double damping = 40.0;
  const double drift = -0.5;
  Motion motion = motion_of({1.0, 100.0, 2.0}, 0.05, 3.0);
  add_law(motion, "reset_integrator",
          {{"kinetic", kinetic}, {"stiffness", stiffness}, {"damping", damping}, {"drift", drift}});
  sim::ExactEngine engine(motion.model);
  while (engine.next(2.0) != nullptr) {
  }
  REQUIRE(engine.outcome().kind == core::OutcomeKind::jump_cycle);
  const double v = engine.velocity();
  CHECK(v == Approx(-drift * kinetic / stiffness).epsilon(1e-12));
  const double limit = kinetic * (1.0 + drift * engine.time());
  const double others = 100.0 * (0.05 * std::cos(3.0 * engine.time()) - engine.position()) - 2.0 * v;
  CHECK(others + limit > 0.0);
  CHECK(others + limit - damping * v < 0.0);
}
