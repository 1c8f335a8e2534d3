#include "identify/records/short_blow.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <utility>

#include "identify/ledger/ledger.hpp"
#include "identify/records/derived_records.hpp"
#include "tests/identify/ledger/rig.hpp"
#include "tests/identify/records.hpp"

using namespace dualdamp;
using namespace dualdamp::identify;
using namespace dualdamp::identify::testing;

namespace {

/// A half sine from `start` on.
double half_sine(double t, double start, double duration) {
  const double part = (t - start) / duration;
  return part > 0.0 && part < 1.0 ? std::sin(std::numbers::pi * part) : 0.0;
}

/// The rig at rest, struck to a speed of 0.5 m/s within so many samples. Noise of x and force of `noise`.
History struck(const testing::Rig& rig, double samples, double noise, std::uint64_t seed,
               double rate_in_period = 32.0) {
  const double period = 2.0 * std::numbers::pi / rig.omega();
  History history;
  history.sample_rate = rate_in_period / period;
  Normal normal(seed);
  const double step = 1.0 / history.sample_rate;
  const double duration = samples * step;
  const double start = (10.0 + 0.37 * static_cast<double>(seed % 5)) * step;
  const double peak = 0.5 * rig.m * 0.5 * std::numbers::pi / duration;
  const Drive blow = [=](double t) { return peak * half_sine(t, start, duration); };
  const Motion motion = motion_of(rig, blow, 8.0 * period, history.sample_rate);
  const double range = std::ranges::max(motion.x);
  for (std::size_t i = 0; i < motion.x.size(); ++i) {
    history.x.push_back(motion.x[i] + noise * range * normal());
    history.force.push_back(motion.drive[i] + 0.3 * noise * peak * normal());
  }
  return history;
}

testing::Rig light() {
  testing::Rig rig;
  rig.zeta = 0.04;
  rig.F0 = 0.6;
  return rig;
}

/// The blow of a force that is left out, if it is one blow.
std::optional<Blow> blow_left_out(const std::optional<ShortBlows>& found) {
  if (!found || found->blows.size() != 1 || found->vibrations.empty()) return std::nullopt;
  return found->blows.front();
}

std::optional<Blow> short_blow(const std::vector<double>& force, const std::vector<double>& x) {
  return blow_left_out(short_blows(force, x));
}

int contradicted(const Ledger& ledger) { return ledger.departures.empty() ? 0 : 1; }

}  // namespace

TEST_CASE("A blow of few samples is found, and other forces are not") {
  for (const double samples : {1.3, 2.5, 4.6, 9.0})
    for (const double noise : {0.0, 1e-3, 5e-3}) {
      CAPTURE(samples, noise);
      const History history = struck(light(), samples, noise, 3);
      const std::optional<Blow> blow = short_blow(history.force, history.x);
      REQUIRE(blow);
      CHECK(blow->first >= 11);
      CHECK(blow->first <= 12);
      CHECK(static_cast<double>(blow->last - blow->first) <= samples);
      CHECK(static_cast<double>(blow->end) > 11.0 + samples);
      // The sensor may have a zero, and push the other way.
      std::vector<double> other = history.force;
      for (double& value : other) value = 3.0 - value;
      CHECK(short_blow(other, history.x).has_value());
    }
  // A longer blow is short for an exact motion.
  const auto is_short = [](double samples, double noise) {
    const History history = struck(light(), samples, noise, 3, 160.0);
    return short_blow(history.force, history.x).has_value();
  };
  CHECK(is_short(21.0, 1e-3));
  CHECK_FALSE(is_short(21.0, 5e-2));
  CHECK_FALSE(is_short(75.0, 1e-4));
}

TEST_CASE("A force that is more than a blow is none") {
  std::vector<double> x;
  for (int i = 0; i < 200; ++i) x.push_back(std::sin(0.2 * i));
  const std::vector<double> quiet(x.size(), 0.0);
  CHECK_FALSE(short_blow(quiet, x));
  std::vector<double> force = quiet;
  force[50] = force[51] = 1.0;
  CHECK(short_blow(force, x));
  std::vector<double> step = force;
  for (std::size_t i = 50; i < step.size(); ++i) step[i] = 1.0;
  CHECK_FALSE(short_blow(step, x));
  std::vector<double> at_first = quiet;
  at_first[0] = at_first[1] = 1.0;
  CHECK_FALSE(short_blow(at_first, x));
  std::vector<double> late = quiet;
  late[150] = 1.0;
  CHECK_FALSE(short_blow(late, x));
  CHECK(short_blows(late, x));
  // What goes on beside the blow drives the mass.
  for (const double size : {0.02, 0.3}) {
    std::vector<double> driven = force;
    for (std::size_t i = 0; i < driven.size(); ++i) driven[i] += size * std::sin(0.2 * static_cast<double>(i));
    CHECK_FALSE(short_blow(driven, x));
  }
  std::vector<double> damped = x;  // nothing is left to be read
  for (std::size_t i = 52; i < damped.size(); ++i) damped[i] *= 0.1;
  CHECK_FALSE(short_blow(force, damped));
}

TEST_CASE("A short blow contradicts neither sensors nor friction") {
  int with_force = 0;
  int without = 0;
  int holds = 0;
  int count = 0;
  const testing::Rig rig = light();
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const KnownConstants constants{.mass = rig.m, .stiffness = rig.k};
    Record record;
    record.histories.push_back(struck(rig, 1.2 + 0.5 * static_cast<double>(seed), 2e-3, seed));
    with_force += contradicted(ledger_of(record, constants));
    const std::vector<std::string> warnings = leave_out_short_blows(record.histories);
    REQUIRE(warnings.size() == 2);
    CHECK(warnings[0].find("too few to know its impulse") != std::string::npos);
    CHECK(record.histories[0].force.empty());
    CHECK(complete(record).size() <= 2);
    REQUIRE(record.decay);
    const Ledger ledger = ledger_of(record, constants);
    without += contradicted(ledger);
    if (!ledger.joint) continue;
    ++count;
    REQUIRE(ledger.joint->interval95);
    const auto is_within = [](const Interval& interval, double value) {
      return interval[0] <= value && value <= interval[1];
    };
    holds += is_within(ledger.joint->interval95->zeta, rig.zeta) && is_within(ledger.joint->interval95->F0, rig.F0);
  }
  CHECK(with_force >= 8);
  CHECK(without <= 2);
  CHECK(count >= 10);
  CHECK(holds >= count - 2);
}

TEST_CASE("A history without a short blow is left as it is") {
  std::vector<History> histories;
  histories.push_back(struck(light(), 70.0, 1e-3, 1, 160.0));
  histories.push_back(struck(light(), 4.0, 1e-3, 2));
  histories[1].y = histories[1].x;
  const std::vector<History> before = histories;
  CHECK(leave_out_short_blows(histories).empty());
  for (std::size_t i = 0; i < 2; ++i) {
    CHECK(histories[i].force == before[i].force);
    CHECK(histories[i].x == before[i].x);
  }
}

TEST_CASE("A velocity or an acceleration shows a short blow, and the error of its impulse is told") {
  const History struck_x = struck(light(), 1.6, 1e-3, 3);
  const double step = 1.0 / struck_x.sample_rate;
  History history = struck_x;
  history.x.clear();
  for (std::size_t i = 0; i < struck_x.x.size(); ++i) {
    const std::size_t last = struck_x.x.size() - 1;
    const std::size_t before = i > 0 ? i - 1 : 0;
    const std::size_t after = std::min(i + 1, last);
    history.v.push_back((struck_x.x[after] - struck_x.x[before]) / (step * static_cast<double>(after - before)));
  }
  const std::optional<Blow> by_speed = blow_left_out(short_blows(history));
  REQUIRE(by_speed);
  const testing::Rig rig = light();
  history.v.clear();
  for (std::size_t i = 0; i < struck_x.x.size(); ++i)
    history.a.push_back((struck_x.force[i] - rig.k * struck_x.x[i]) / rig.m);
  // The blow makes the acceleration many times larger than the spring does later.
  CHECK_FALSE(short_blow(history.force, history.a));
  const std::optional<Blow> by_acceleration = blow_left_out(short_blows(history));
  REQUIRE(by_acceleration);
  CHECK(by_acceleration->first == by_speed->first);
  CHECK(by_acceleration->end == by_speed->end);
  const ShortBlows found = *short_blows(history);
  CHECK_THAT(impulse_warning(history, found), Catch::Contains(" s has 1 sample: its impulse may be wrong by 80 %"));
  std::vector<std::string> warnings;
  const std::vector<History> after = without_blows(history, found, warnings);
  CHECK(warnings.size() == 2);
  REQUIRE(after.size() == 1);
  CHECK(after[0].force.empty());
  CHECK(after[0].a.size() == history.a.size() - by_speed->end);
}

namespace {

/// The rig at rest, struck several times by half sines of so many samples; each blow is `next` times the one
/// before.
History struck_again(const testing::Rig& rig, const std::vector<double>& times_in_periods, double samples,
                     double noise, std::uint64_t seed, double next = -0.9) {
  const double period = 2.0 * std::numbers::pi / rig.omega();
  History history;
  history.sample_rate = 40.0 / period;
  const double duration = samples / history.sample_rate;
  const Drive blows = [=](double t) {
    double force = 0.0;
    double peak = 0.5 * rig.m * 0.5 * std::numbers::pi / duration;
    for (const double time : times_in_periods) {
      force += peak * half_sine(t, time * period, duration);
      peak *= next;
    }
    return force;
  };
  const Motion motion = motion_of(rig, blows, (times_in_periods.back() + 7.0) * period, history.sample_rate);
  Normal normal(seed);
  const double range = std::ranges::max(motion.x);
  for (std::size_t i = 0; i < motion.x.size(); ++i) {
    history.x.push_back(motion.x[i] + noise * range * normal());
    history.force.push_back(motion.drive[i] + 0.1 * noise * range * rig.k * normal());
  }
  return history;
}

}  // namespace

TEST_CASE("A record of several short blows is cut into the free vibrations after them") {
  const std::vector<double> times = {0.613, 6.28, 11.41};
  std::vector<History> histories = {struck_again(light(), times, 2.7, 3e-3, 1)};
  const History record = histories[0];
  const std::optional<ShortBlows> found = short_blows(record);
  REQUIRE(found);
  REQUIRE(found->blows.size() == 3);
  REQUIRE(found->vibrations.size() == 3);
  for (std::size_t i = 0; i < 3; ++i) {
    const double begin = 40.0 * times[i];
    CHECK(static_cast<double>(found->blows[i].first) >= begin);
    CHECK(static_cast<double>(found->blows[i].last) <= begin + 2.7);
    CHECK(static_cast<double>(found->vibrations[i].first) > begin + 2.7);
    if (i > 0) CHECK(static_cast<double>(found->vibrations[i - 1].last) <= begin + 1.0);
  }
  CHECK_THAT(impulse_warning(record, *found), Catch::Contains("the 3 blows of force at t = "));
  CHECK_THAT(impulse_warning(record, *found), Catch::Contains(": an impulse may be wrong by "));
  const std::vector<std::string> warnings = leave_out_short_blows(histories);
  REQUIRE(warnings.size() == 1);
  CHECK_THAT(warnings[0], Catch::Contains("the motion after them is read as 3 free vibrations"));
  REQUIRE(histories.size() == 3);
  CHECK(histories[1].sweep == "blow 2");
  CHECK(histories[1].force.empty());
  CHECK(histories[1].start == Approx(static_cast<double>(found->vibrations[1].first) / record.sample_rate));
  CHECK(histories[1].x.front() == record.x[found->vibrations[1].first]);
}

TEST_CASE("A vibration between blows that is too short is not used, and nothing is cut where most are") {
  const History bounced = struck_again(light(), {0.6, 0.72, 5.0}, 2.2, 1e-3, 2);
  std::optional<ShortBlows> found = short_blows(bounced);
  REQUIRE(found);
  CHECK(found->blows.size() == 2);
  CHECK(found->vibrations.size() == 2);
  const History twice = struck_again(light(), {0.6, 1.4, 7.0}, 2.2, 1e-3, 2);
  found = short_blows(twice);
  REQUIRE(found);
  CHECK(found->blows.size() == 3);
  CHECK(found->vibrations.size() == 2);
  REQUIRE(found->unused.size() == 1);
  std::vector<std::string> warnings;
  CHECK(without_blows(twice, *found, warnings).size() == 2);
  REQUIRE(warnings.size() == 2);
  CHECK_THAT(warnings[1], Catch::Contains("is too short or too small beside the others, and is not used"));
  // A hammer that strikes every few samples leaves no vibration.
  History often = twice;
  for (std::size_t i = 20; i < often.force.size(); i += 16) often.force[i] = 5.0;
  std::vector<History> histories = {often};
  warnings = leave_out_short_blows(histories);
  REQUIRE(warnings.size() == 1);
  CHECK_THAT(warnings[0], Catch::Contains(": an impulse may be wrong by 80 %"));
  CHECK(histories[0].force == often.force);
}

TEST_CASE("Several short blows contradict neither sensors nor friction") {
  const testing::Rig rig = light();
  int with_force = 0;
  int without = 0;
  int holds = 0;
  int count = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const KnownConstants constants{.mass = rig.m, .stiffness = rig.k};
    const double shift = 0.11 * static_cast<double>(seed);
    Record record;
    record.histories.push_back(
        struck_again(rig, {0.5 + shift, 6.1 + 2.0 * shift, 11.7 + shift}, 1.3 + shift, 3e-3, seed));
    with_force += contradicted(ledger_of(record, constants));
    CHECK(leave_out_short_blows(record.histories).size() == 1);
    static_cast<void>(complete(record));
    const Ledger ledger = ledger_of(record, constants);
    without += contradicted(ledger);
    if (!ledger.joint || !ledger.joint->interval95) continue;
    ++count;
    const auto is_within = [](const Interval& interval, double value) {
      return interval[0] <= value && value <= interval[1];
    };
    holds += is_within(ledger.joint->interval95->zeta, rig.zeta) && is_within(ledger.joint->interval95->F0, rig.F0);
  }
  CHECK(with_force >= 3);
  CHECK(without <= 1);
  CHECK(count >= 3);
  CHECK(holds >= count - 1);
}

TEST_CASE("The motion after a blow is tested with few samples in a period, and with few extremes") {
  const auto [rate, zeta] = GENERATE(std::pair(13.0, 0.04), std::pair(40.0, 0.5));
  int exact = 0;
  int seen = 0;
  int holds = 0;
  for (std::uint64_t seed = 1; seed <= 5; ++seed)
    for (const double drag : {0.0, 3.0}) {
      testing::Rig rig = light();
      rig.zeta = zeta;
      rig.drag = drag;
      rig.V = 0.5;
      Record record;
      record.histories.push_back(struck(rig, 2.2, 2e-3, seed, rate));
      REQUIRE(leave_out_short_blows(record.histories).size() == 2);
      static_cast<void>(complete(record));
      CHECK_FALSE(record.decay);
      const Ledger ledger = ledger_of(record, {.mass = rig.m, .stiffness = rig.k});
      CHECK_THAT(ledger.data, Catch::Contains("samples of 1 history"));
      (drag > 0.0 ? seen : exact) += contradicted(ledger);
      if (drag == 0.0 && ledger.joint && ledger.joint->interval95) {
        const auto [low, high] = ledger.joint->interval95->zeta;
        holds += low <= zeta && zeta <= high;
      }
    }
  CAPTURE(rate, zeta);
  CHECK(exact <= 1);
  CHECK(seen >= 4);
  CHECK(holds >= 4);
}

TEST_CASE("The motion after a measured blow begins where the blow ends, not at its first extreme") {
  testing::Rig rig = light();
  rig.zeta = 0.15;
  std::vector<History> histories = {struck(rig, 3.0, 1e-3, 2, 40.0)};
  static_cast<void>(leave_out_short_blows(histories));
  REQUIRE(histories.size() == 1);
  const double end_of_blow = histories[0].start;
  const auto begin = [&](bool begins_free) {
    Record record;
    record.histories = histories;
    record.histories[0].begins_free = begins_free;
    static_cast<void>(complete(record));
    REQUIRE(record.decay);
    return record.histories[0].start;
  };
  CHECK(histories[0].begins_free);
  CHECK(begin(true) == end_of_blow);
  const double period = 2.0 * std::numbers::pi / rig.omega();
  CHECK(begin(false) > end_of_blow + 0.1 * period);
}

TEST_CASE("A fit of a motion of few half swings finds how many there are") {
  // Each number of half swings until the mass stops has a minimum of its own.
  int wrong = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const double place = std::fmod(0.618034 * static_cast<double>(seed), 1.0);
    testing::Rig rig;
    rig.zeta = 0.1 + 0.0125 * static_cast<double>(seed);
    rig.F0 = (0.02 + 0.03 * place) * 0.5 * std::sqrt(rig.m * rig.k);
    Record record;
    record.histories.push_back(struck(rig, 2.2, 1e-3, seed, 30.0));
    static_cast<void>(leave_out_short_blows(record.histories));
    static_cast<void>(complete(record));
    const Ledger ledger = ledger_of(record, {.mass = rig.m, .stiffness = rig.k});
    constexpr double apart = 0.15;
    wrong += std::abs(ledger.plain.F0 / rig.F0 - 1.0) > apart ? 1 : 0;
  }
  CHECK(wrong <= 1);
}

TEST_CASE("Two blows of different size test what one cannot: friction over speed, as the ledger advises") {
  int untested = 0;
  int tested = 0;
  int seen = 0;
  constexpr int records = 6;
  for (std::uint64_t seed = 1; seed <= records; ++seed)
    for (const bool is_once : {true, false}) {
      testing::Rig rig = light();
      rig.zeta = 0.35 + 0.02 * static_cast<double>(seed);
      rig.drag = 0.3;
      rig.V = 0.5;
      const std::vector<double> times = is_once ? std::vector{0.613} : std::vector{0.613, 7.2};
      Record record;
      record.histories.push_back(struck_again(rig, times, 2.3, 4e-3, seed, 2.2));
      static_cast<void>(leave_out_short_blows(record.histories));
      static_cast<void>(complete(record));
      const LedgerEntry entry =
          ledger_of(record, {.mass = rig.m, .stiffness = rig.k}).entry(Assumption::friction_velocity);
      const bool is_untested = entry.standing == Standing::untested;
      if (is_once && is_untested) CHECK_THAT(entry.reason, Catch::Contains("free vibrations of several sizes"));
      untested += is_once && is_untested ? 1 : 0;
      tested += !is_once && !is_untested ? 1 : 0;
      seen += !is_once && entry.standing == Standing::violated ? 1 : 0;
    }
  CHECK(untested >= records / 2);
  CHECK(tested == records);
  CHECK(seen >= records - 1);
}
