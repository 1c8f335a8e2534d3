#include "identify/records/plausibility.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <complex>
#include <numbers>
#include <random>

#include "sim/analytic/den_hartog.hpp"
#include "tests/identify/readers/refusals.hpp"

using namespace dualdamp;
using namespace dualdamp::identify;
using identify::testing::mentions;
using std::numbers::pi;

namespace {

struct Rig {
  KnownConstants constants;
  PairRecord record;
};

/// Six pairs with phases by Den Hartog's law, 2 % of noise in the amplitudes and 2 degrees in the phases.
Rig random_rig(std::mt19937_64& random, double lowest_r, double highest_r) {
  const auto uniform = [&random](double low, double high) {
    return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
  };
  Rig rig;
  const double zeta = uniform(0.01, 0.3);
  const double r = uniform(lowest_r, highest_r);
  rig.constants = {uniform(0.5, 5.0), uniform(100.0, 1e4), unknown};
  rig.constants.frequency = r * std::sqrt(rig.constants.stiffness / rig.constants.mass);
  const auto functions = sim::analytic::den_hartog(zeta, r);
  const double Y = uniform(1e-4, 1e-2);
  const double x_f = uniform(0.1, 0.5) * Y * sim::analytic::non_sticking_boundary(functions);
  for (int i = 0; i < 6; ++i) {
    const double level = Y * (1.0 + 0.2 * i);
    const auto state = sim::analytic::non_sticking_state(functions, level, x_f);
    REQUIRE(state.has_value());
    Pair pair{level * uniform(0.98, 1.02), state->amplitude * uniform(0.98, 1.02), "", i + 1};
    pair.phase = state->phase + uniform(-2.0, 2.0) * pi / 180.0;
    pair.fundamental = state->fundamental;
    rig.record.pairs.push_back(pair);
  }
  return rig;
}

std::string faults_in(const PairRecord& pairs, const KnownConstants& constants,
                      const std::vector<std::string>& assumed = {}) {
  std::string text;
  for (const core::Diagnostic& fault : gross_faults({.pairs = pairs}, constants, assumed, "data.csv"))
    text += core::format(fault) + "\n";
  return text;
}

}  // namespace

TEST_CASE("No sound record is refused, wherever its frequency lies") {
  std::mt19937_64 random(15);
  for (int i = 0; i < 2000; ++i) {
    const Rig rig = random_rig(random, 0.3, 3.0);
    CHECK(faults_in(rig.record, rig.constants, {"x", "Y"}) == "");
    Rig plain = rig;  // without phases
    for (Pair& pair : plain.record.pairs) pair.phase = unknown;
    CHECK(faults_in(plain.record, plain.constants) == "");
  }
}

TEST_CASE("Exchanged columns are found near resonance and by phases") {
  std::mt19937_64 random(16);
  int by_line = 0;
  int by_phase = 0;
  constexpr int rigs = 500;
  for (int i = 0; i < rigs; ++i) {
    Rig rig = random_rig(random, 0.95, 1.05);
    for (Pair& pair : rig.record.pairs) {
      std::swap(pair.x, pair.Y);
      pair.fundamental = unknown;
      pair.phase = 2.0 * pi - pair.phase;  // the lag of the base behind the mass
    }
    by_phase += faults_in(rig.record, rig.constants).empty() ? 0 : 1;
    for (Pair& pair : rig.record.pairs) pair.phase = unknown;
    by_line += faults_in(rig.record, rig.constants).find("swapped") == std::string::npos ? 0 : 1;
  }
  CHECK(by_phase > 0.95 * rigs);
  // Those whose damping hides friction's intercept in 2 % of noise, or is above a quarter, pass.
  CHECK(by_line > 0.5 * rigs);
}

TEST_CASE("A column that has changed its place with Y is found by the fundamental") {
  std::mt19937_64 random(18);
  for (int i = 0; i < 200; ++i) {
    const Rig rig = random_rig(random, 0.9, 1.05);
    const Pair& first = rig.record.pairs.front();
    if (std::abs(std::log(first.x / first.Y)) < 0.5) continue;
    Rig other = rig;
    for (Pair& pair : other.record.pairs) std::swap(pair.Y, pair.fundamental);
    CHECK(mentions(faults_in(other.record, other.constants), "columns Y and fundamental seem to be swapped"));
    other = rig;
    for (Pair& pair : other.record.pairs) std::swap(pair.Y, pair.x);
    CHECK(mentions(faults_in(other.record, other.constants), "columns x and Y seem to be swapped"));
  }
}

TEST_CASE("Centimetres for millimetres of the base are found by phases on both sides of resonance") {
  std::mt19937_64 random(19);
  int sound = 0;
  int found = 0;
  constexpr int rigs = 200;
  for (int i = 0; i < rigs; ++i) {
    Rig rig = random_rig(random, 0.85, 0.93);
    const double natural = rig.constants.natural_frequency();
    std::mt19937_64 again = random;
    const Rig above = random_rig(again, 1.07, 1.15);
    for (Pair& pair : rig.record.pairs) pair.omega = rig.constants.frequency;
    // The other side, of a rig with the same constants but its own damping and friction: only the phases count.
    for (Pair pair : above.record.pairs) {
      pair.omega = above.constants.frequency / above.constants.natural_frequency() * natural;
      rig.record.pairs.push_back(pair);
    }
    sound += faults_in(rig.record, rig.constants).empty() ? 1 : 0;
    for (Pair& pair : rig.record.pairs) pair.Y *= 10.0;
    found += mentions(faults_in(rig.record, rig.constants), "column Y is about 10 times too large") ? 1 : 0;
  }
  CHECK(sound == rigs);
  CHECK(found > 0.9 * rigs);
}

TEST_CASE("Amplitudes off by 1000, degrees for radians, and readings that do not fit") {
  std::mt19937_64 random(17);
  Rig rig = random_rig(random, 1.5, 2.0);
  REQUIRE(faults_in(rig.record, rig.constants) == "");
  const auto changed = [&rig](auto change) {
    Rig other = rig;
    for (Pair& pair : other.record.pairs) change(pair);
    return faults_in(other.record, other.constants);
  };
  CHECK(mentions(changed([](Pair& p) { p.x *= 1000.0, p.fundamental *= 1000.0; }),
                 "need more force than the base gives"));
  CHECK(mentions(changed([](Pair& p) { p.fundamental *= 1000.0; }),
                 "column fundamental is about 1000 times too large"));
  CHECK(mentions(
      changed([&](Pair& p) { p.mean_square_speed = 1e6 * 0.5 * std::pow(rig.constants.frequency * p.x, 2); }),
      "column mean_square_speed is about 1000 times too large"));
  CHECK(mentions(changed([](Pair& p) { p.phase *= 180.0 / pi; }), "the phases may be degrees"));
  CHECK(mentions(changed([](Pair& p) { p.phase *= pi / 180.0; }), "the phases may be radians"));
}

TEST_CASE("Degrees read as radians are called degrees, though their sines are those of a wrong sign") {
  // Lags of 92 to 94 degrees: as radians, their sines are -0.78, 0.23 and -0.97.
  const KnownConstants constants{1.0, 1000.0, std::sqrt(1000.0)};
  PairRecord record;
  for (const double phase : {92.0, 94.1, 98.2}) {
    Pair pair{1e-3, 8e-3, "", static_cast<int>(record.pairs.size()) + 1};
    pair.phase = phase;
    record.pairs.push_back(pair);
  }
  CHECK(mentions(faults_in(record, constants), "the phases may be degrees"));
}

TEST_CASE("One phase that is no lag is named with its pair") {
  // -999 stands for a phase that was not measured.
  const KnownConstants constants{1.0, 1000.0, std::sqrt(1000.0)};
  PairRecord record;
  for (const double phase : {92.0, 91.0, -999.0, 90.5}) {
    Pair pair{1e-3, 8e-3, "", static_cast<int>(record.pairs.size()) + 1};
    pair.phase = phase * pi / 180.0;
    record.pairs.push_back(pair);
  }
  CHECK(mentions(faults_in(record, constants), "the phase of pair 3, -999 deg, is no lag"));
}

TEST_CASE("Of the causes of a wrong phase all that fit are named, and no others") {
  const auto turned = [](double phase, const KnownConstants& constants, double x) {
    PairRecord record;
    for (int i = 0; i < 4; ++i) {
      Pair pair{1e-3 * (1 + i), x * (1 + i), "", i + 1};
      pair.phase = phase;
      record.pairs.push_back(pair);
    }
    return faults_in(record, constants);
  };
  const double natural = std::sqrt(1000.0);
  // r = 1.5, x = 0.75 Y, cos(phase) = -0.94.
  const KnownConstants above{1.0, 1000.0, 1.5 * natural};
  const double lag = std::acos(-1.25 * 0.75);
  CHECK(turned(lag, above, 0.75e-3).empty());
  const std::string sign = turned(-lag, above, 0.75e-3);
  CHECK(mentions(sign, "the phase has the wrong sign"));
  CHECK_FALSE(mentions(sign, "x or Y (x or y) has the wrong sign"));
  const std::string reversed = turned(lag - pi, above, 0.75e-3);
  CHECK(mentions(reversed, "x or Y (x or y) has the wrong sign"));
  CHECK_FALSE(mentions(reversed, "the phase has the wrong sign"));
}

TEST_CASE("The phase of a history has no sign of its own to be wrong") {
  const KnownConstants above{1.0, 1000.0, 1.5 * std::sqrt(1000.0)};
  Record record;
  record.pairs.emplace();
  record.pairs->pairs.push_back({1e-3, 0.75e-3, "", 1});
  record.pairs->pairs[0].phase = -std::acos(-1.25 * 0.75);
  const auto said = [&] { return core::format(gross_faults(record, above, {}, "data.csv").at(0)); };
  CHECK(mentions(said(), "the phase has the wrong sign"));
  record.histories.emplace_back();
  CHECK_FALSE(mentions(said(), "the phase has the wrong sign"));
}

TEST_CASE("A phase that a wrong stiffness makes is not called one of another unit alone") {
  // The lag of 113 degrees of a rig beyond its resonance; the stiffness is 20 % too high. Read as radians, 113
  // fits.
  const KnownConstants constants{1.0, 1200.0, std::sqrt(1000.0)};
  Record record;
  record.pairs.emplace();
  for (int i = 0; i < 4; ++i) {
    Pair pair{1e-3 * (1 + i), 6e-3 * (1 + i), "", i + 1};
    pair.phase = 113.0 * pi / 180.0;
    record.pairs->pairs.push_back(pair);
  }
  const std::string said = faults_in(*record.pairs, constants);
  CHECK(mentions(said, "the phases may be radians"));
  CHECK(mentions(said, "the mass, the stiffness or the frequency is wrong"));
  // From a history the phase was computed, and has no other unit.
  record.histories.emplace_back();
  CHECK(gross_faults(record, constants, {}, "data.csv").empty());
}

TEST_CASE("An angle without unit is refused in the words of angles") {
  std::mt19937_64 random(18);
  Rig rig = random_rig(random, 0.9, 1.1);
  rig.constants.coordinate = core::Coordinate::angle;
  Record record;
  record.decay.emplace();
  for (int i = 0; i < 8; ++i) record.decay->extremes.push_back((i % 2 == 0 ? 1e6 : -1e6) * std::pow(0.9, i));
  std::string text;
  for (const core::Diagnostic& fault : gross_faults(record, rig.constants, {"x"}, "data.csv"))
    text += core::format(fault);
  CHECK(mentions(text, "in radians it would reach"));
  CHECK(mentions(text, "units: {x: deg}"));
  CHECK_FALSE(text.find("metres") != std::string::npos);
}

TEST_CASE("Numbers of samples for times, hertz for rad/s, and damping that hardly a rig has") {
  std::mt19937_64 random(19);
  Rig rig = random_rig(random, 0.95, 1.05);
  while (rig.record.pairs[0].x < 8.0 * rig.record.pairs[0].Y) rig = random_rig(random, 0.95, 1.05);
  const double half_period = pi / std::sqrt(rig.constants.stiffness / rig.constants.mass);
  const auto faults_at = [&](double factor) {
    Record record;
    record.decay.emplace();
    for (int i = 0; i < 8; ++i) {
      record.decay->extremes.push_back((i % 2 == 0 ? 0.01 : -0.01) * std::pow(0.9, i));
      record.decay->times.push_back(i * half_period * factor);
    }
    std::string text;
    for (const core::Diagnostic& fault : gross_faults(record, rig.constants, {}, "data.csv"))
      text += core::format(fault);
    return text;
  };
  CHECK(faults_at(1.0).empty());
  CHECK(faults_at(2.0).empty());  // damping may do that
  CHECK(mentions(faults_at(500.0), "not numbers of samples"));
  CHECK(mentions(faults_at(1.0 / 86400.0), "units: {t: day}"));

  Rig turned = rig;
  turned.constants.frequency *= 2.0 * pi;
  CHECK(mentions(faults_in(turned.record, turned.constants), "it may be in rad/s, not Hz"));
  turned.constants.frequency = rig.constants.frequency / (2.0 * pi);
  CHECK(mentions(faults_in(turned.record, turned.constants), "it may be in Hz, not rad/s"));
  turned.constants.frequency = 60.0 * rig.constants.frequency;
  CHECK(mentions(faults_in(turned.record, turned.constants), "it may be in rpm, not Hz"));
  turned.constants.frequency = 30.0 / pi * rig.constants.frequency;
  CHECK(mentions(faults_in(turned.record, turned.constants), "it may be in rpm, not rad/s"));

  CHECK(odd_readings({.pairs = rig.record}, rig.constants).empty());
  for (Pair& pair : rig.record.pairs) pair.Y *= 1e-4;
  CHECK(odd_readings({.pairs = rig.record}, rig.constants).size() == 1);
}

TEST_CASE("Milliseconds read as seconds under a drive are refused near resonance, a slow drive is not") {
  KnownConstants constants;
  constants.mass = 1.0;
  constants.stiffness = 4000.0;
  const double natural = constants.natural_frequency();
  // At resonance, x = F/(2 zeta k); below it, x = F/k.
  for (const double amplification : {10.0, 1.0}) {
    CAPTURE(amplification);
    History history;
    history.sample_rate = 1e-3 * 50.0 * natural / (2.0 * pi);
    for (int i = 0; i < 2000; ++i) {
      const double phase = 2.0 * pi * i / 50.0;
      history.force.push_back(3.0 * std::cos(phase));
      history.x.push_back(amplification * 3.0 / constants.stiffness *
                          std::cos(phase - (amplification > 1.0 ? 1.57 : 0.1)));
    }
    const auto faults = gross_faults({.histories = {history}}, constants, {}, "data.csv");
    REQUIRE(faults.size() == (amplification > 1.0 ? 1U : 0U));
    if (amplification > 1.0) CHECK(mentions(faults.front().allowed, {"ms"}));
  }
}

namespace {

/// A frequency response of twelve pairs from `lowest` to `highest` times the natural frequency.
Rig response(double lowest, double highest, bool has_phases, double zeta = 0.08) {
  Rig rig{.constants = {1.0, 1421.223, unknown}};
  const auto functions_at = [&](double r) { return sim::analytic::den_hartog(zeta, r); };
  for (int i = 0; i < 12; ++i) {
    const double r = lowest + (highest - lowest) * i / 11.0;
    const double Y = 8e-3 * (1.0 + 0.005 * (i % 3 - 1));
    const auto state = sim::analytic::non_sticking_state(functions_at(r), Y, 1e-3);
    if (!state) continue;
    Pair pair{Y, state->amplitude, "", i + 1};
    pair.omega = r * rig.constants.natural_frequency();
    if (has_phases) pair.phase = state->phase;
    rig.record.pairs.push_back(pair);
  }
  REQUIRE(rig.record.pairs.size() > 4);
  return rig;
}

}  // namespace

TEST_CASE("A column of hertz that is read as rad/s is refused, and no sound response is") {
  for (const bool has_phases : {true, false})
    for (const auto& [lowest, highest] : {std::pair{0.85, 1.2}, {0.85, 0.98}, {0.6, 1.8}, {1.02, 1.4}}) {
      CAPTURE(has_phases, lowest, highest);
      Rig rig = response(lowest, highest, has_phases);
      CHECK(faults_in(rig.record, rig.constants).empty());
      // A stiffness that is wrong by a factor is for the ledger, or has another name.
      for (const double factor : {0.1, 0.3, 0.5, 2.0, 4.0, 10.0}) {
        KnownConstants wrong = rig.constants;
        wrong.stiffness *= factor;
        CHECK_FALSE(mentions(faults_in(rig.record, wrong), "it may be in Hz, not rad/s"));
      }
      for (Pair& pair : rig.record.pairs) pair.omega /= 2.0 * pi;
      CHECK(mentions(faults_in(rig.record, rig.constants), "it may be in Hz, not rad/s"));
    }
  for (const double r : {0.14, 0.2, 6.0, 9.0}) {  // as hertz, two of these are at resonance
    CAPTURE(r);
    Rig far = response(0.85, 1.2, false);
    for (Pair& pair : far.record.pairs) {
      pair.omega = r * (1.0 + 0.01 * pair.number) * far.constants.natural_frequency();
      pair.x = pair.Y / std::abs(1.0 - r * r);
    }
    CHECK(faults_in(far.record, far.constants).empty());
  }
}

TEST_CASE("A motion faster than 1000 m/s in its stated unit gets a warning") {
  const KnownConstants constants{1.0, 1500.0, unknown};
  const DecayRecord decay{{0.04, -0.03, 0.02}, {}};
  CHECK(odd_readings({.decay = decay}, constants).empty());
  DecayRecord in_megametres = decay;
  for (double& x : in_megametres.extremes) x *= 1e9;
  REQUIRE(odd_readings({.decay = in_megametres}, constants).size() == 1);
  CHECK(mentions(odd_readings({.decay = in_megametres}, constants)[0], "its unit or its scale may be wrong"));
  History history{.sample_rate = 1000.0};
  history.x = in_megametres.extremes;
  CHECK(odd_readings({.histories = {history}}, constants).size() == 1);
}

TEST_CASE("A force or a base of the wrong sign takes work out of the motion, and is refused") {
  const double m = 2.0;
  const double w = 2.0 * pi * 5.0;
  const KnownConstants constants{m, m * w * w, unknown};
  const auto faults_with = [&](double sign, double ratio, double released, bool base = false) {
    // x lags the force by a quarter period at resonance; beside it a free vibration that dies.
    History history{.sample_rate = 400.0};
    const double c = 2.0 * 0.03 * m * w;
    const std::complex<double> response =
        10.0 / std::complex<double>(constants.stiffness - m * ratio * ratio * w * w, c * ratio * w);
    for (int i = 0; i < 2000; ++i) {
      const double t = i / history.sample_rate;
      const auto phase = std::polar(1.0, ratio * w * t);
      history.x.push_back(std::imag(response * phase) + released * std::exp(-0.03 * w * t) * std::cos(w * t));
      history.force.push_back(sign * 10.0 * std::imag(phase));
    }
    for (const double force : history.force)
      if (base) history.y.push_back(force / constants.stiffness);
    if (base) history.force.clear();
    Record record;
    record.histories.push_back(history);
    std::string text;
    for (const core::Diagnostic& fault : gross_faults(record, constants, {}, "data.csv"))
      text += core::format(fault) + "\n";
    return text;
  };
  for (const double ratio : {0.8, 0.95, 1.0, 1.05}) {
    CAPTURE(ratio);
    CHECK(faults_with(1.0, ratio, 0.0).empty());
    CHECK(faults_with(1.0, ratio, 0.05).empty());
    CHECK(faults_with(1.0, ratio, 0.05, true).empty());
  }
  for (const double ratio : {0.8, 0.95, 1.0, 1.05, 1.4}) {
    CAPTURE(ratio);
    CHECK(mentions(faults_with(-1.0, ratio, 0.0), "one of them has the wrong sign"));
    const std::string of_base = faults_with(-1.0, ratio, 0.0, true);
    CHECK(mentions(of_base, "the base takes "));
    CHECK(mentions(of_base, "y and x positive in one direction: "));
    CHECK(mentions(of_base, "x and y are swapped"));
  }
}

namespace {

/// Faults of a free vibration of 1.5 swings, then rest, with v and a times these factors.
std::string faults_of_decay(double of_v, double of_a) {
  const double w = 2.0 * pi * 3.7;
  std::mt19937_64 random(3);
  const auto noise = [&random] { return 2.0 * (static_cast<double>(random() >> 11) * 0x1p-53) - 1.0; };
  History history{.sample_rate = 370.0};
  for (int i = 0; i < 400; ++i) {
    const double t = i / history.sample_rate;
    const bool moves = t < 1.5 * 2.0 * pi / w;
    const double size = moves ? 0.02 * (1.0 - w * t / (3.2 * pi)) : 0.0;
    const double rest = moves ? 0.0 : -0.00125;
    history.x.push_back(size * std::cos(w * t) + rest + 1e-4 * noise());
    history.v.push_back(of_v * (-w * size * std::sin(w * t) + 0.01 * noise()));
    history.a.push_back(of_a * (-w * w * size * std::cos(w * t) + 0.3 * noise()));
  }
  Record record;
  record.histories.push_back(history);
  std::string text;
  for (const core::Diagnostic& fault : gross_faults(record, {1.0, w * w, unknown}, {}, "data.csv"))
    text += core::format(fault) + "\n";
  return text;
}

}  // namespace

TEST_CASE("Wrong units and signs of v and a are refused in a free vibration of a few swings") {
  CHECK(faults_of_decay(1.0, 1.0).empty());
  CHECK(faults_of_decay(3.0, 0.9).empty());
  CHECK(mentions(faults_of_decay(1.0 / 25.4, 1.0), "column v is about 25.4 times too small"));
  CHECK(mentions(faults_of_decay(1000.0, 1.0), "column v is about 1000 times too large"));
  CHECK(mentions(faults_of_decay(1.0, 1.0 / 9.80665), "column a is about 9.807 times too small"));
  CHECK(mentions(faults_of_decay(-1.0, 1.0), "column v is the first derivative of column x with the wrong sign"));
  CHECK(mentions(faults_of_decay(1.0, -1.0), "column a is the second derivative of column x with the wrong sign"));
}
