/// Motions on contacts, damped or not, beside other friction: a damped slider with a mass at rest, the limit of no
/// damping, and the events of both engines compared.

#include <fmt/format.h>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "friction_models/laws/contact_compliance.hpp"
#include "friction_models/laws/coulomb.hpp"
#include "friction_models/laws/iwan.hpp"
#include "sim/motion/simulate.hpp"
#include "sim/orbits/steady_state.hpp"
#include "tests/support/make_law.hpp"
#include "tests/support/random.hpp"
#include "tests/support/standard_system.hpp"

namespace {

using namespace dualdamp;
using friction::ContactCompliance;
using friction::Coulomb;
using friction::Law;
using sim::Event;
using sim::EventKind;
using sim::SolverKind;

/// A unit mass on 100 N/m pulled at 0.01 m/s, under Coulomb friction and a contact.
sim::Model pulled(double contact_damping) {
  sim::Model model;
  model.oscillator = {.mass = 1.0, .stiffness = 100.0, .damping = 1.0};
  model.excitation = {.type = sim::ExcitationType::base_ramp, .slope = 0.01};
  model.friction = {Law(Coulomb(1.0, 2.0)), Law(ContactCompliance(1.0, 2.0, 1e4, contact_damping))};
  return model;
}

/// A slow base motion: the mass sticks twice a period.
sim::Model slowly_driven(double contact_damping) {
  sim::Model model;
  model.oscillator = {.mass = 1.0, .stiffness = 1.0, .damping = 0.13};
  model.excitation = {.type = sim::ExcitationType::base_harmonic, .amplitude = 1.0, .frequency = 0.143};
  model.friction = {Law(ContactCompliance(0.15, 0.23, 11.0, contact_damping)), Law(Coulomb(0.05, 0.06))};
  return model;
}

/// Events of the mass, or otherwise the mode changes of the laws, in the order of time. Grazings are left out,
/// because rounding decides them.
std::vector<Event> chosen(const std::vector<Event>& events, bool switching) {
  std::vector<Event> result;
  for (const Event& event : events) {
    if (event.kind == EventKind::grazing) continue;
    if ((event.kind == EventKind::switching) == switching) result.push_back(event);
  }
  return result;
}

/// The first difference, or nothing. A slider that stops with the mass may stop before or after it, so mode changes
/// are compared separately. They may differ by a hundred times as much: a contact at its limit where the mass is
/// released without acceleration breaks away as soon as the cube of time exceeds rounding.
std::string difference(const std::vector<Event>& a, const std::vector<Event>& b, double time) {
  for (const bool switching : {false, true}) {
    const std::vector<Event> left = chosen(a, switching);
    const std::vector<Event> right = chosen(b, switching);
    for (std::size_t i = 0; i < std::max(left.size(), right.size()); ++i) {
      if (i == right.size()) return fmt::format("{} at {:.17g} s is missing", name_of(left[i].kind), left[i].t);
      if (i == left.size()) return fmt::format("{} at {:.17g} s too many", name_of(right[i].kind), right[i].t);
      if (left[i].kind != right[i].kind || !(std::abs(left[i].t - right[i].t) <= (switching ? 100.0 : 1.0) * time))
        return fmt::format("{} at {:.17g} s, {} at {:.17g} s", name_of(left[i].kind), left[i].t,
                           name_of(right[i].kind), right[i].t);
    }
  }
  return {};
}

}  // namespace

TEST_CASE("A damped contact beside a mass at rest sticks again", "[contacts]") {
  // First a release and a stop on the stuck contact; then, four times: release, break-away, the mass stops, the
  // slider stops.
  const sim::History history = sim::simulate(pulled(1.0), {.duration = 12.0});
  REQUIRE(history.outcome.ok());
  CHECK(history.events.size() == 18);
  // At the later releases the contact holds with its kinetic friction, 1 N, and Coulomb friction with 2 N.
  double x = 0.0;
  for (const Event& event : chosen(history.events, false)) {
    if (event.kind == EventKind::release && event.t > 5.0)
      CHECK(100.0 * (0.01 * event.t - event.x) == Approx(3.0).epsilon(1e-11));
    x = event.x;
  }
  CHECK(x > 0.0);
}

TEST_CASE("A contact tends to the undamped one as its damping vanishes", "[contacts]") {
  const sim::History limit = sim::simulate(pulled(0.0), {.duration = 12.0});
  const double peak = sim::steady_state(slowly_driven(0.0)).peak;
  for (const SolverKind kind : {SolverKind::automatic, SolverKind::implicit_steps}) {
    for (const double damping : {1e-3, 1e-6, 1e-9, 1e-12, 1e-15}) {
      CAPTURE(damping, static_cast<int>(kind));
      sim::Model ramp = pulled(damping);
      ramp.solver.kind = kind;
      const sim::History history = sim::simulate(ramp, {.duration = 12.0});
      REQUIRE(history.outcome.ok());
      const std::vector<Event> found = chosen(history.events, false);
      const std::vector<Event> expected = chosen(limit.events, false);
      CHECK(difference(expected, found, 1e-9 + 10.0 * damping) == "");
      sim::Model driven = slowly_driven(damping);
      driven.solver.kind = kind;
      const sim::SteadyState state = sim::steady_state(driven);
      REQUIRE(state.outcome.ok());
      CHECK(std::abs(state.peak - peak) < 1e-9 + 10.0 * damping);
    }
  }
}

namespace {

/// Laws in parallel drawn at random, among them at least one contact.
class RandomContacts {
 public:
  RandomContacts(test::Random& random, sim::Model& model) : random_(random), model_(model) {
    const sim::Oscillator& o = model.oscillator;
    force_ = o.stiffness * model.excitation.amplitude;
    time_ = 1.0 / sim::natural_frequency(o);
  }

  void add() {
    contact();
    const int more = random_.pick(3);
    for (int i = 0; i < more; ++i) {
      const int kind = random_.pick(4);
      kind == 0 ? contact() : kind == 1 ? iwan() : coulomb();
    }
  }
  /// To reproduce it.
  [[nodiscard]] const std::string& words() const { return words_; }

 private:
  double kinetic() { return force_ * random_.logarithmic(1e-3, 1.0); }
  double static_level(double kinetic) {
    return random_.chance(0.4) ? kinetic : kinetic * random_.uniform(1.0, 3.0);
  }

  void coulomb() {
    const double level = kinetic();
    const double limit = static_level(level);
    model_.friction.push_back(Law(Coulomb(level, limit)));
    words_ += fmt::format("; coulomb {:.17g} {:.17g}", level, limit);
  }
  void contact() {
    const double level = kinetic();
    const double limit = static_level(level);
    // In the smooth engine the error of a contact's force is its stiffness times 1e-13 of the motion.
    const double stiffest = std::min(1e8, 3e3 * level / force_);
    const double stiffness = model_.oscillator.stiffness * random_.logarithmic(1e-3, stiffest);
    const double damping = random_.chance(0.3) ? 0.0 : stiffness * time_ * random_.logarithmic(1e-12, 10.0);
    model_.friction.push_back(Law(ContactCompliance(level, limit, stiffness, damping)));
    words_ += fmt::format("; contact {:.17g} {:.17g} {:.17g} {:.17g}", level, limit, stiffness, damping);
  }
  void iwan() {
    const double stiffness = model_.oscillator.stiffness * random_.logarithmic(1e-1, 1e2);
    const double limit = kinetic();
    const int count = 1 + random_.pick(8);
    model_.friction.push_back(Law(friction::Iwan(friction::Iwan::uniform(stiffness, limit, count))));
    words_ += fmt::format("; iwan {:.17g} {:.17g} {}", stiffness, limit, count);
  }

  test::Random& random_;
  sim::Model& model_;
  double force_ = 0.0;  ///< N, of the drive
  double time_ = 0.0;   ///< s, of the oscillator
  std::string words_;
};

/// Time at which the mass first slips by less than 1e-7 of `length`. The smooth engine is not accurate enough for
/// the duration of such slips. Infinite: never.
double first_short_slip(const std::vector<Event>& events, double length) {
  const std::vector<Event> motion = chosen(events, false);
  for (std::size_t i = 1; i < motion.size(); ++i) {
    const bool slips = motion[i].kind != EventKind::release;
    if (slips && std::abs(motion[i].x - motion[i - 1].x) < 1e-7 * length) return motion[i - 1].t;
  }
  return std::numeric_limits<double>::infinity();
}

/// The events before a time.
std::vector<Event> before(std::vector<Event> events, double time) {
  std::erase_if(events, [&](const Event& event) { return event.t >= time; });
  return events;
}

sim::Model random_oscillator(test::Random& random) {
  sim::Model model;
  const double wn = random.logarithmic(1.0, 100.0);
  const double mass = random.logarithmic(0.1, 10.0);
  const double zeta = random.logarithmic(0.01, 1.0);
  model.oscillator = {.mass = mass, .stiffness = mass * wn * wn, .damping = 2.0 * zeta * mass * wn};
  const double amplitude = random.logarithmic(1e-3, 1.0);
  const double frequency = wn * random.logarithmic(0.05, 5.0);
  model.excitation = {.type = sim::ExcitationType::base_harmonic,
                      .amplitude = amplitude,
                      .frequency = frequency,
                      .phase = random.angle()};
  if (random.chance(0.2)) {
    model.excitation.type = sim::ExcitationType::base_ramp;
    model.excitation.slope = amplitude * frequency;
  }
  return model;
}

}  // namespace

TEST_CASE("Random contacts beside other friction move alike under both engines, event by event", "[contacts]") {
  // DUALDAMP_CONTACT_CASES for a longer run, DUALDAMP_CONTACT_SEED for other motions: the number of the first.
  const long cases = test::case_count("DUALDAMP_CONTACT_CASES", 60);
  const long seed = test::case_count("DUALDAMP_CONTACT_SEED", 1);
  long events = 0;
  long cut_short = 0;
  double worst = 0.0;
  for (long i = 0; i < cases; ++i) {
    test::Random random(static_cast<std::uint64_t>(seed + i));
    sim::Model model = random_oscillator(random);
    RandomContacts contacts(random, model);
    contacts.add();
    const double period = 2.0 * std::numbers::pi / model.excitation.frequency;
    const sim::History exact = sim::simulate(model, {.duration = 4.3 * period});
    model.solver = {SolverKind::implicit_steps, 1e-13};
    const sim::History smooth = sim::simulate(model, {.duration = 4.3 * period});
    const sim::Oscillator& o = model.oscillator;
    const sim::Excitation& e = model.excitation;
    INFO(seed + i << ": m "
                  << fmt::format("{:.17g}, k {:.17g}, c {:.17g}, Y {:.17g}, w {:.17g}, phase {:.17g}", o.mass,
                                 o.stiffness, o.damping, e.amplitude, e.frequency, e.phase)
                  << contacts.words() << "; " << smooth.outcome.reason << exact.outcome.reason);
    CHECK(exact.outcome.ok());
    CHECK(smooth.outcome.ok());
    const double end = first_short_slip(exact.events, e.amplitude) - 1e-6 * period;
    CHECK(difference(before(exact.events, end), before(smooth.events, end), 1e-7 * period) == "");
    const double error = std::abs(exact.final.x - smooth.final.x) / e.amplitude;
    if (std::isfinite(end)) {
      ++cut_short;
    } else {
      CHECK(error < 1e-10 * (10.0 + static_cast<double>(exact.events.size())));
      worst = std::max(worst, error);
    }
    events += static_cast<long>(before(exact.events, end).size());
  }
  CHECK(5 * cut_short < cases);
  WARN(fmt::format("{} motions, {} events compared, {} motions cut short; largest error {:.2g} of the drive", cases,
                   events, cut_short, worst));
}

TEST_CASE("A contact at its limit where the mass is released lets go once, however small its damping",
          "[contacts]") {
  // The slider starts with the speed of the mass, 1e-13 m/s by rounding; with steps longer than its decay it would
  // stop.
  sim::Model model;
  model.oscillator = {.mass = 1.282452635681383, .stiffness = 21.131695874858067, .damping = 0.37715124127075184};
  model.excitation = {.type = sim::ExcitationType::base_harmonic,
                      .amplitude = 0.0039983627435413328,
                      .frequency = 0.3603045063860365,
                      .phase = 1.0799864916022299};
  model.friction = {Law(ContactCompliance(0.00012915960799080197, 0.00012915960799080197, 180.49573081002723,
                                          1.4743035489893026e-09)),
                    Law(Coulomb(0.020362237583380665, 0.020362237583380665))};
  const double duration = 6.0;
  const sim::History exact = sim::simulate(model, {.duration = duration});
  model.solver = {SolverKind::implicit_steps, 1e-13};
  const sim::History smooth = sim::simulate(model, {.duration = duration});
  REQUIRE(smooth.outcome.ok());
  CHECK(difference(exact.events, smooth.events, 1e-6) == "");
}

TEST_CASE("The slider of a damped contact beside a mass at rest creeps on while its limit falls", "[contacts]") {
  // It starts with speed 0, and ends at the speed at which its spring relaxes.
  sim::Model model;
  model.oscillator = {.mass = 1.0, .stiffness = 100.0, .damping = 1.0};
  model.friction = {
      Law(Coulomb(2.0, 2.0)),
      test::law("contact_compliance",
                {{"kinetic", 1.0}, {"contact_stiffness", 1e4}, {"contact_damping", 1.0}, {"drift", -0.1}})};
  model.initial = {.position = 0.022, .velocity = 0.0};
  for (const SolverKind kind : {SolverKind::automatic, SolverKind::explicit_steps, SolverKind::implicit_steps}) {
    model.solver = {kind, 1e-13};
    const sim::History history = sim::simulate(model, {.duration = 9.9});
    INFO(history.outcome.reason);
    REQUIRE(history.outcome.ok());
    REQUIRE(history.events.size() == 3);
    const double rest = history.events[0].x;
    CHECK(history.events[1].kind == EventKind::switching);
    CHECK(history.events[1].t == Approx(10.0 * (1.0 - 1e4 * (0.022 - rest))).epsilon(1e-9));
    // The slider's force is its limit again, less that of the damper at the speed 1e-5 m/s.
    CHECK(history.events[2].kind == EventKind::release);
    CHECK(history.events[2].t == Approx(10.0 * (3.0 - 100.0 * rest)).epsilon(1e-9));
  }
}

TEST_CASE("A stiff bond at its limit that the mass relieves before it stretches again holds", "[contacts]") {
  // The limit falls at t = 0.890793 s while the bond, which yields within 1e-10 m, is stretched backward and the
  // mass moves forward. It turns back 3.6e-5 s later, before the guard has changed by more than the accuracy with
  // which a step ends.
  sim::Model model;
  model.oscillator = {.mass = 124.04029354253345, .stiffness = 156061.5231458529, .damping = 11530.58816591984};
  const friction::ParameterValues fluctuation{
      {"ratio", 0.3317359499913974}, {"correlation_time", 0.24075481556181189}, {"seed", 61.0}};
  model.friction = {
      test::law("reset_integrator", {{"kinetic", 1.169698657403106},
                                     {"stiffness", 10758974877.351212},
                                     {"fluctuation", std::vector<friction::ParameterValues>{fluctuation}}})};
  model.initial = {.position = 0.3401401717867331, .velocity = 0.0};
  const sim::History exact = sim::simulate(model, {.duration = 1.77});
  for (const SolverKind kind : {SolverKind::explicit_steps, SolverKind::implicit_steps}) {
    model.solver = {kind, 1e-13};
    const sim::History smooth = sim::simulate(model, {.duration = 1.77});
    INFO(smooth.outcome.reason);
    REQUIRE(smooth.outcome.ok());
    CHECK(smooth.final.x == Approx(exact.final.x).margin(1e-11));
  }
}

TEST_CASE("A mass that comes to rest on stiff contacts, with no force beyond rounding, goes the way of its jerk",
          "[contacts]") {
  // At t = 1.912197 s, after 16,600 events, all contacts stick. The sum of forces, within rounding, pointed in the
  // direction of a slip that takes no time.
  sim::Model model;
  model.oscillator = {.mass = 776.7553416653757, .stiffness = 32190205.64196484, .damping = 101.17306020097054};
  model.friction = {
      test::law("contact_compliance", {{"kinetic", 65.14695308531381},
                                       {"contact_stiffness", 118797530275453.58},
                                       {"load_gradient", 0.9026503499738614}}),
      test::law("contact_compliance", {{"kinetic", 1.9100548862219504},
                                       {"static", 9.53241540777489},
                                       {"contact_stiffness", 3066066223.725392}}),
      test::law("contact_compliance", {{"kinetic", 4647770.021987614}, {"contact_stiffness", 245619412598.4142}})};
  model.excitation = {.type = sim::ExcitationType::base_harmonic,
                      .amplitude = 0.04644284130635965,
                      .frequency = 0.21738849522211742,
                      .phase = 2.268952420802238};
  model.excitation.harmonics = {{3, 0.0006928329502128752, 3.0511975518590697}};
  model.initial = {.position = 0.04335789458443854, .velocity = 30.358506398540896};
  const sim::History history = sim::simulate(model, {.duration = 2.6});
  INFO(history.outcome.reason);
  CHECK(history.outcome.ok());
  CHECK(history.final.t == Approx(2.6));
}

TEST_CASE("A contact too stiff for double precision is refused, with a stiffness that would do", "[contacts]") {
  // Of the standard system: a spring of 1e17 N/m is stretched by 2e-17 m at 0.2 m.
  const auto state = [](double stiffness, SolverKind kind) {
    sim::Model model = test::standard_system(Law(ContactCompliance(2.0, 2.0, stiffness, 0.0)));
    model.solver.kind = kind;
    return sim::steady_state(model);
  };
  for (const SolverKind kind : {SolverKind::automatic, SolverKind::implicit_steps}) {
    const sim::SteadyState refused = state(1e17, kind);
    REQUIRE(!refused.outcome.ok());
    CHECK(refused.outcome.reason.find("friction law 1 is too stiff for double precision") != std::string::npos);
    CHECK(refused.outcome.reason.find("times smaller would do") != std::string::npos);
  }
  // The largest stiffness that is accepted: above the peak of rigid friction by 0.02161 m
  // (N/m)^(1/2)/sqrt(stiffness), a constant found at 1e10 and 1e12 N/m.
  const sim::SteadyState taken = state(1e13, SolverKind::automatic);
  REQUIRE(taken.outcome.ok());
  CHECK(taken.peak - 0.18607809795678620 == Approx(0.02161 / std::sqrt(1e13)).epsilon(1e-3));
  CHECK(std::abs(taken.multipliers[0]) < 0.3);
}

TEST_CASE("a stiff contact that lets go at little speed slides until that speed is used up", "[sim][exact]") {
  // A limit of 4e4 N that falls a little, behind 1e10 N/m on a spring of 1e-3 N/m: the speed at the release is
  // small, but it is not rounding of the contact's force. Only friction stops the mass.
  constexpr double limit = 4e4;
  constexpr double stiffness = 1e10;
  sim::Model model;
  model.oscillator = {.mass = 1.0, .stiffness = 1e-3};
  model.friction = {
      test::law("contact_compliance", {{"kinetic", limit}, {"contact_stiffness", stiffness}, {"drift", -0.01}})};
  const double held = limit / std::sqrt(stiffness);
  model.initial = {.position = 0.3, .velocity = std::hypot(held, 2e-4)};
  const sim::History history = sim::simulate(model, {.duration = 2e-5});
  INFO(history.outcome.reason);
  REQUIRE(history.outcome.ok());
  REQUIRE(history.events.size() >= 2);
  const Event& release = history.events[0];
  CHECK(release.kind == EventKind::switching);
  // By the energy: the limit has fallen by 0.01/s times a quarter of the period, 1.57e-5 s; the spring has
  // slowed the mass.
  const double fallen = 1.0 - 0.01 * release.t;
  const double spring = 2.0 * model.oscillator.stiffness * 0.3 * limit / stiffness;
  const double speed = std::sqrt(2e-4 * 2e-4 + held * held * (1.0 - fallen * fallen) - spring);
  CHECK(release.v == Approx(speed).epsilon(1e-3));
  CHECK(history.events[1].kind == EventKind::reversal);
  CHECK(history.events[1].t - release.t == Approx(release.v / limit).epsilon(1e-3));
}
