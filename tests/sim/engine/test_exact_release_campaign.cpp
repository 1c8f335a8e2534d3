#include "sim/engine/exact_engine.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <optional>

#include "tests/sim/engine/exact_motions.hpp"
#include "tests/support/exponential_sum.hpp"
#include "tests/support/random.hpp"

using namespace dualdamp;
using namespace dualdamp::sim;
using namespace dualdamp::test;
using friction::Direction;

// Random releases from rest against the closed form in 50 digits and a search in long double.

namespace {

/// A mass at rest on a driven base.
struct Candidate {
  Model model;
  double kinetic = 0.0;
  double static_level = 0.0;

  [[nodiscard]] bool has_equal_limits() const { return static_level == kinetic; }
};

/// Nothing near critical damping or near an undamped resonance.
std::optional<Candidate> random_candidate(Random& random) {
  const double wn = random.logarithmic(1.0, 100.0);
  const double m = random.logarithmic(0.1, 10.0);
  const double zeta = random.chance(0.2) ? 0.0 : random.logarithmic(1e-3, 3.0);
  const double r = random.logarithmic(0.05, 5.0);
  if (std::abs(zeta - 1.0) < 1e-3 || (zeta < 1e-2 && std::abs(r - 1.0) < 1e-2)) return std::nullopt;
  const double k = m * wn * wn;
  Candidate candidate;
  candidate.model = base_driven({.m = m,
                                 .k = k,
                                 .c = 2.0 * zeta * m * wn,
                                 .Y = random.logarithmic(1e-3, 1.0),
                                 .w = r * wn,
                                 .phase = random.angle()});
  const double drive = candidate.model.excitation.amplitude;
  const bool equal = random.chance(0.5);
  candidate.kinetic = k * drive * random.logarithmic(1e-3, 0.99);
  candidate.static_level = equal ? candidate.kinetic : candidate.kinetic * random.uniform(1.0, 2.0);
  candidate.model.friction.push_back(coulomb(candidate.kinetic, candidate.static_level));
  const double start = drive * std::cos(candidate.model.excitation.phase);
  // A third of the force limits are reached just before the pull has its extreme: slips from 1e-3 periods on.
  double room = random.uniform(-1.0, 1.0) * candidate.static_level / k;
  if (random.chance(0.33))
    room = drive * (1.0 - random.logarithmic(1e-6, 1e-1)) - start - candidate.static_level / k;
  candidate.model.initial.position = start + room;
  return candidate;
}

/// The release of a candidate: at it cos(angle) = level = (x0 + sign static/k)/Y with the pull growing.
struct ReleaseAngle {
  double sign = 0.0;  ///< of the slip
  long double level = 0.0L;
  long double sine = 0.0L;
};

ReleaseAngle release_angle(const Candidate& candidate, double sign) {
  const Model& model = candidate.model;
  const long double level = (static_cast<long double>(model.initial.position) +
                             static_cast<long double>(sign) * static_cast<long double>(candidate.static_level) /
                                 model.oscillator.stiffness) /
                            model.excitation.amplitude;
  return {sign, level, -static_cast<long double>(sign) * std::sqrt(1.0L - level * level)};
}

/// Duration of the slip by the closed form; nothing when it is longer than three periods.
std::optional<long double> slip_duration(const Candidate& candidate, const ReleaseAngle& release, double period) {
  const Oscillator& oscillator = candidate.model.oscillator;
  const Excitation& base = candidate.model.excitation;
  const oracle::Complex phasor(static_cast<double>(release.level), static_cast<double>(release.sine));
  const oracle::LinearProblem slip{.mass = oscillator.mass,
                                   .damping = oscillator.damping,
                                   .stiffness = oscillator.stiffness,
                                   .constant = -release.sign * candidate.kinetic,
                                   .harmonics = {{base.frequency, oscillator.stiffness * base.amplitude * phasor}},
                                   .x0 = candidate.model.initial.position};
  oracle::ExponentialSum velocity;
  for (const oracle::Exponential& e : oracle::slip_velocity(slip))
    velocity.add(e.exponent, static_cast<long double>(release.sign) * e.coefficient);
  velocity.finish(candidate.has_equal_limits() ? 2 : 1);
  return velocity.first_crossing(3.0L * static_cast<long double>(period));
}

struct CampaignTally {
  long releases = 0;
  long double_roots = 0;
  long short_slips = 0;
  double worst = 0.0;
  double shortest = 1.0;
};

/// The slip from the release at t = `from`: its end against the closed form.
void check_slip(ExactEngine& engine, const Candidate& candidate, const ReleaseAngle& release, double from,
                CampaignTally& tally) {
  const double period = engine.period();
  const std::optional<long double> expected = slip_duration(candidate, release, period);
  const auto next = events_of(engine, from + 2.9 * period, 1);
  const Model& model = candidate.model;
  CAPTURE(model.oscillator.mass, model.oscillator.stiffness, model.oscillator.damping, model.excitation.amplitude,
          model.excitation.frequency, model.excitation.phase, candidate.kinetic, candidate.static_level,
          model.initial.position);
  if (!expected || *expected > 2.9L * static_cast<long double>(period)) {
    CHECK(next.empty());
    return;
  }
  REQUIRE(next.size() == 1);
  const auto s = static_cast<double>(*expected);
  const double error = std::abs(next[0].t - from - s) / s;
  // Time itself rounds at eps t; a release close to the extreme of the drive is known to eps/sine.
  const double allowed = 1e-11 + 64 * epsilon * next[0].t / s +
                         1e-14 / static_cast<double>(std::abs(release.sine)) / (model.excitation.frequency * s);
  CHECK(error <= allowed);
  CHECK((next[0].kind == EventKind::stop || next[0].kind == EventKind::reversal));
  tally.worst = std::max(tally.worst, error);
  tally.shortest = std::min(tally.shortest, s / period);
  tally.short_slips += s < 0.05 * period ? 1 : 0;
}

}  // namespace

TEST_CASE("After every release from exact stick the next event is found, and none is invented", "[exact]") {
  // DUALDAMP_RELEASE_CASES for a longer run.
  const long cases = test::case_count("DUALDAMP_RELEASE_CASES", 2000);
  Random random(24);
  CampaignTally tally;
  while (tally.releases < cases) {
    const std::optional<Candidate> candidate = random_candidate(random);
    if (!candidate) continue;
    ExactEngine engine(candidate->model);
    if (engine.direction() != Direction::none) continue;
    const auto first = events_of(engine, 1.5 * engine.period(), 1);
    if (first.empty()) continue;  // the pull never reaches the force limit
    REQUIRE(first[0].kind == EventKind::release);
    const ReleaseAngle release = release_angle(*candidate, friction::sign(engine.direction()));
    // Not too near the extreme of the pull.
    if (!(std::abs(release.level) < 1.0L - 0.9e-6L)) continue;
    ++tally.releases;
    tally.double_roots += candidate->has_equal_limits() ? 1 : 0;
    check_slip(engine, *candidate, release, first[0].t, tally);
  }
  WARN(tally.releases << " releases, " << tally.double_roots << " of them with static = kinetic, "
                      << tally.short_slips << " slips below a twentieth of the period, the shortest "
                      << tally.shortest << " periods; largest relative error of a slip's duration " << tally.worst);
}
