/// Whole motions with one to three laws in parallel, against brute-force integration of an independent version of
/// the laws' equations; and their energy balance.

#include <fmt/format.h>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "sim/motion/simulate.hpp"
#include "tests/support/brute_force.hpp"
#include "tests/support/random_oscillations.hpp"

namespace {

using namespace dualdamp;
using sim::EventKind;
using test::LawKind;

struct Timed {
  double t = 0.0;
  EventKind kind = EventKind::reversal;
};

/// Reversals, stops and releases, or otherwise switchings; if both are within rounding, their order is not
/// compared.
template <class Events>
std::vector<Timed> timed(const Events& events, bool switching) {
  std::vector<Timed> result;
  for (const auto& event : events) {
    if ((event.kind == EventKind::switching) == switching) result.push_back({event.t, event.kind});
  }
  return result;
}

struct MotionTally {
  long motions = 0;
  long events = 0;
  long cut_short = 0;
  double worst_time = 0.0;   ///< in periods of the drive
  double worst_state = 0.0;  ///< relative
  double worst_defect = 0.0;
};

/// Two events of one kind that are closer than the steps of brute force: it may have missed both.
bool is_blinded(const std::vector<Timed>& events, double blind) {
  return std::ranges::adjacent_find(events, [&](const Timed& a, const Timed& b) { return b.t - a.t < blind; }) !=
         events.end();
}

bool agree(const std::vector<Timed>& found, const std::vector<Timed>& expected, double period, MotionTally& tally) {
  if (found.size() != expected.size()) return false;
  double worst = 0.0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (found[i].kind != expected[i].kind) return false;
    worst = std::max(worst, std::abs(found[i].t - expected[i].t) / period);
  }
  if (!(worst <= 1e-8)) return false;
  tally.worst_time = std::max(tally.worst_time, worst);
  return true;
}

void compare(const test::Oscillation& o, MotionTally& tally) {
  const double w = o.model.excitation.frequency;
  const double period = 2.0 * std::numbers::pi / w;
  const sim::History history = sim::simulate(o.model, {.duration = 5.0 * period});
  REQUIRE(history.outcome.ok());
  const sim::Energy& energy = history.energy;
  const double turnover =
      std::abs(energy.input) + std::abs(energy.friction) + std::abs(energy.viscous) + std::abs(energy.stored);
  CHECK(std::abs(energy.defect) <= 1e-12 * turnover);
  tally.worst_defect = std::max(tally.worst_defect, std::abs(energy.defect) / turnover);

  const test::BruteForce expected = test::follow(o.model, o.plain, 5.0 * period);
  const double wn = sim::natural_frequency(o.model.oscillator);
  const double blind = 0.02 * 2.0 * std::numbers::pi / std::max(wn, w);
  bool same = true;
  bool blinded = false;
  for (const bool switching : {false, true}) {
    const std::vector<Timed> found = timed(history.events, switching);
    same = agree(found, timed(expected.events, switching), period, tally) && same;
    blinded = blinded || is_blinded(found, blind);
  }
  ++tally.motions;
  if (!same && blinded) {
    ++tally.cut_short;
    return;
  }
  CHECK(same);
  tally.events += static_cast<long>(history.events.size());
  const double amplitude = o.model.excitation.amplitude;
  const double error = std::max(std::abs(history.final.x - expected.x) / amplitude,
                                std::abs(history.final.v - expected.v) / (amplitude * std::max(w, wn)));
  CHECK(error <= 1e-8);
  tally.worst_state = std::max(tally.worst_state, error);
}

void check_mixtures(const std::vector<std::vector<LawKind>>& mixtures, std::uint64_t seed) {
  // DUALDAMP_WALK_CASES for a longer run.
  const long cases = test::case_count("DUALDAMP_WALK_CASES", 150);
  const test::Ranges ranges{.frequency_ratio = {0.3, 3.0}, .damping_ratio = {1e-3, 1.0}, .stiffest = 30.0};
  test::Random random(seed);
  MotionTally tally;
  for (long i = 0; i < cases; ++i) {
    test::Oscillation oscillation = test::random_oscillator(random, ranges);
    const auto& mixture = mixtures[static_cast<std::size_t>(i) % mixtures.size()];
    for (const LawKind law : mixture) test::add_law(oscillation, law, random, ranges);
    test::start(oscillation);
    INFO(i << ": " << name(mixture.front()) << " of " << mixture.size() << ", " << oscillation.describe());
    compare(oscillation, tally);
  }
  CHECK(5 * tally.cut_short < tally.motions);
  WARN(fmt::format(
      "{} motions, {} events compared, {} motions cut short; largest errors: {:.2g} periods, {:.2g} of "
      "the state, {:.2g} of the energy",
      tally.motions, tally.events, tally.cut_short, tally.worst_time, tally.worst_state, tally.worst_defect));
}

}  // namespace

TEST_CASE("Random motions with laws in parallel follow brute force and balance their energy", "[motions]") {
  check_mixtures({{LawKind::coulomb, LawKind::contact},
                  {LawKind::contact, LawKind::contact_static},
                  {LawKind::iwan, LawKind::coulomb},
                  {LawKind::contact_damped, LawKind::reset_integrator},
                  {LawKind::contact_damped},
                  {LawKind::reset_integrator, LawKind::contact, LawKind::coulomb},
                  {LawKind::bristle},
                  {LawKind::bristle, LawKind::contact_static}},
                 71);
}

TEST_CASE("Random motions on damped contacts beside other friction follow brute force", "[motions]") {
  check_mixtures({{LawKind::contact_damped, LawKind::coulomb}, {LawKind::contact_damped, LawKind::iwan}}, 72);
}
