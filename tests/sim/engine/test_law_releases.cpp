/// After every release the next event: nothing missed, nothing invented, of the right kind and of the right
/// element, for every exact law.
///
/// A release here is any event at which something lets go: a contact, an element or a bond breaks away, a bristle
/// snaps, the mass starts from rest, or it starts again after a reversal at which a slider stopped. The engine's
/// next event is compared with the closed form of the interval, from the engine's x, v and t at the release and the
/// places of all sliders that the test keeps itself, by the oracle's rigorous search
/// (tests/support/plain_interval).

#include <fmt/format.h>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "sim/engine/exact_engine.hpp"
#include "tests/support/numbers.hpp"
#include "tests/support/plain_interval.hpp"
#include "tests/support/random_oscillations.hpp"

namespace {

using namespace dualdamp;
using sim::EventKind;
using test::epsilon;
using test::LawKind;
using test::MassState;
using test::NextEvent;
using test::PlainInterval;

struct ReleaseTally {
  long oscillators = 0;
  long releases = 0;
  long compared = 0;      ///< next events
  long sharp = 0;         ///< number of these with a time that is known to 1e-10 of the time from the release
  long double_roots = 0;  ///< intervals after a release with a guard that begins with one
  double shortest = 1.0;  ///< from a release to the next event, in periods
  double worst = 0.0;     ///< relative error of that time, of the sharp ones
  std::vector<std::string> failures;
};

struct Found {
  double t = 0.0;
  EventKind kind = EventKind::reversal;
  double force = 0.0;  ///< of friction, just before
};

std::optional<Found> next_event(sim::ExactEngine& engine, double horizon) {
  while (const sim::Interval* interval = engine.next(horizon)) {
    if (interval->ending) return Found{interval->end(), *interval->ending, interval->at(interval->duration).force};
  }
  return std::nullopt;
}

/// Follows one motion of the engine from event to event.
class Walk {
 public:
  Walk(const test::Oscillation& oscillation, ReleaseTally& tally)
      : o_(oscillation), plain_(oscillation.plain), engine_(oscillation.model), tally_(tally) {
    mass_ = {0.0, o_.model.initial.position, o_.model.initial.velocity, o_.model.initial.velocity > 0.0 ? 1 : -1};
  }

  void run(int events) {
    for (int i = 0; i < events && step(); ++i) {
    }
  }

 private:
  bool step();
  bool fail(const std::string& what);
  bool compare(const NextEvent& expected, const Found& found, const PlainInterval& interval);
  [[nodiscard]] bool is_release(const NextEvent& event) const;

  const test::Oscillation& o_;
  test::PlainFriction plain_;
  sim::ExactEngine engine_;
  ReleaseTally& tally_;
  MassState mass_;
  bool released_ = false;
};

bool Walk::fail(const std::string& what) {
  tally_.failures.push_back(fmt::format("{} after {:.17g} s; {}", what, mass_.t, o_.describe()));
  return false;
}

/// From one event to the next; false at the end of the walk.
bool Walk::step() {
  const PlainInterval interval(o_.model, plain_, mass_);
  if (!interval.is_regular()) return false;
  const double period = engine_.period();
  const std::vector<NextEvent> expected = interval.next_events(3.0 * period);
  const auto found = next_event(engine_, mass_.t + 2.9 * period);
  if (released_) {
    ++tally_.releases;
    if (interval.begins_with_double_root()) ++tally_.double_roots;
  }
  if (expected.empty() || expected.front().s > 2.9 * period) return found ? fail("invented") : false;
  if (!found) return fail(fmt::format("missed at {:.17g}", expected.front().s));
  // Of events within rounding of each other the engine may take any.
  const bool turns = found->kind == EventKind::reversal || found->kind == EventKind::stop;
  const auto same = std::ranges::find_if(
      expected, [&](const NextEvent& event) { return turns == (event.what == NextEvent::What::reversal); });
  return compare(same == expected.end() ? expected.front() : *same, *found, interval);
}

bool Walk::compare(const NextEvent& expected, const Found& found, const PlainInterval& interval) {
  const double s = found.t - mass_.t;
  const double error = std::abs(s - expected.s);
  // The time itself rounds.
  const double rounding = 4 * epsilon * found.t + expected.uncertainty;
  if (!(error <= 1e-10 * s + rounding))
    return fail(fmt::format("after {:.17g} instead of {:.17g} (+-{:.2g}), {}", s, expected.s, rounding,
                            sim::name_of(found.kind)));
  const double length = std::abs(mass_.x) + o_.model.excitation.amplitude;
  if (!(std::abs(engine_.position() - interval.position(s)) <= 1e-12 * length)) return fail("at the wrong place");
  const test::LinearForce f = plain_.force(mass_.direction);
  const double force_before = f.constant + f.stiffness * engine_.position() + f.damping * engine_.velocity();
  if (mass_.direction != 0 && !(std::abs(found.force - force_before) <= 1e-11 * interval.force_scale()))
    return fail(fmt::format("under a friction of {:.17g} N instead of {:.17g} N", found.force, force_before));
  if (released_) {
    ++tally_.compared;
    if (s > 0.0 && rounding <= 1e-10 * s) {
      ++tally_.sharp;
      tally_.shortest = std::min(tally_.shortest, s / engine_.period());
      tally_.worst = std::max(tally_.worst, error / s);
    }
  }
  plain_.relax(expected.s);
  mass_ = {found.t, engine_.position(), engine_.velocity(), mass_.direction, interval.velocity_error()};
  released_ = is_release(expected);
  const EventKind kind = take_place(o_.model, expected, plain_, mass_);
  released_ = released_ && kind != EventKind::stop;
  if (kind != found.kind)
    return fail(fmt::format("{} instead of {}", sim::name_of(found.kind), sim::name_of(kind)));
  if (mass_.direction != static_cast<int>(engine_.direction())) return fail("goes on in the wrong direction");
  return true;
}

/// Whether the event lets something go, or lets the mass start again after a slider came to stand.
bool Walk::is_release(const NextEvent& event) const {
  switch (event.what) {
    case NextEvent::What::release:
    case NextEvent::What::spring:
      return true;
    case NextEvent::What::contact:
      return plain_.contacts[event.contact].side == 0;
    case NextEvent::What::reversal:
      break;
  }
  return std::ranges::any_of(plain_.springs, [](const test::Spring& spring) { return spring.side != 0; });
}

void check_releases(const std::vector<LawKind>& laws, std::uint64_t seed) {
  // DUALDAMP_RELEASE_CASES for a longer run.
  const long cases = test::case_count("DUALDAMP_RELEASE_CASES", 2000);
  test::Random random(seed);
  const test::Ranges ranges;
  ReleaseTally tally;
  std::string what;
  for (const LawKind law : laws) what += fmt::format("{}{}", what.empty() ? "" : " + ", name(law));
  while (tally.releases < cases) {
    test::Oscillation oscillation = test::random_oscillator(random, ranges);
    for (const LawKind law : laws) test::add_law(oscillation, law, random, ranges);
    test::start(oscillation);
    ++tally.oscillators;
    Walk(oscillation, tally).run(4 + random.pick(16));
  }
  for (std::size_t i = 0; i < std::min<std::size_t>(tally.failures.size(), 5); ++i)
    UNSCOPED_INFO(tally.failures[i]);
  CHECK(tally.failures.empty());
  CHECK(5 * tally.sharp > 4 * tally.compared);
  WARN(fmt::format(
      "{}: {} releases of {} oscillators, {} next events, {} of them known to 1e-10, {} intervals with a "
      "double root at the start\nshortest {:.2g} periods, largest relative error {:.2g}, {} wrong",
      what, tally.releases, tally.oscillators, tally.compared, tally.sharp, tally.double_roots, tally.shortest,
      tally.worst, tally.failures.size()));
}

}  // namespace

TEST_CASE("contact_compliance: after every release the next event is found, and none is invented", "[releases]") {
  check_releases({LawKind::contact}, 61);
}

TEST_CASE("contact_compliance with static above kinetic: after every release the next event", "[releases]") {
  check_releases({LawKind::contact_static}, 62);
}

TEST_CASE("contact_compliance with damping: after every release the next event", "[releases]") {
  check_releases({LawKind::contact_damped}, 63);
}

TEST_CASE("iwan: after every release the next event", "[releases]") { check_releases({LawKind::iwan}, 64); }

TEST_CASE("reset_integrator: after every release the next event", "[releases]") {
  check_releases({LawKind::reset_integrator}, 65);
}

TEST_CASE("bristle: after every release the next event", "[releases]") { check_releases({LawKind::bristle}, 66); }

TEST_CASE("coulomb beside a contact: after every release the next event", "[releases]") {
  check_releases({LawKind::coulomb, LawKind::contact}, 67);
}

TEST_CASE("coulomb beside a damped contact: after every release the next event", "[releases]") {
  check_releases({LawKind::coulomb, LawKind::contact_damped}, 68);
}
