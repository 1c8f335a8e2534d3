#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "identify/readers/record_reader.hpp"
#include "tests/identify/readers/refusals.hpp"

using namespace dualdamp;
using identify::History;
using identify::MeasuredRecord;
using identify::ReadOptions;
using identify::testing::mentions;
using identify::testing::refusal;

namespace {

using Signal = std::function<double(double)>;

constexpr double omega = 20.0;
double swing(double t) { return 5.0 * std::sin(omega * t + 0.3); }
double drive(double t) { return 3.0 * std::sin(omega * t); }
double speed(double t) { return 5.0 * omega * std::cos(omega * t + 0.3); }
double pull(double t) { return -5.0 * omega * omega * std::sin(omega * t + 0.3); }

Signal level(double value) {
  return [value](double) { return value; };
}

/// The signal until a time, and a level from then on: its cable falls off.
Signal until(double end, const Signal& signal, double value) {
  return [=](double t) { return t < end ? signal(t) : value; };
}

/// 600 samples at 100 Hz.
MeasuredRecord read(const std::string& header, const std::vector<Signal>& signals, bool is_imposed = false) {
  std::string text = "t [s]," + header + "\n";
  for (int i = 0; i < 600; ++i) {
    text += std::to_string(0.01 * i);
    for (const Signal& signal : signals) text += "," + std::to_string(signal(0.01 * i));
    text += "\n";
  }
  ReadOptions options;
  options.name = "data.csv";
  options.is_imposed = is_imposed;
  return identify::parse_record(text, options);
}

std::string refused(const std::string& header, const std::vector<Signal>& signals) {
  return refusal([&] { (void)read(header, signals); });
}

bool warns(const MeasuredRecord& record, const std::string& words) {
  std::string all;
  for (const std::string& warning : record.warnings) all += warning + "\n";
  return mentions(all, words);
}

}  // namespace

TEST_CASE("channels: a constant velocity, acceleration or force is left out, whatever its value") {
  for (const double value : {0.0, 3.0}) {
    CAPTURE(value);
    const auto with = [value](const std::string& name) {
      return read("x [mm],y [mm]," + name, {swing, drive, level(value)});
    };
    const MeasuredRecord v = with("v [mm/s]");
    CHECK(warns(v, "column v is constant: its sensor gave no signal, and the column is not used"));
    CHECK(v.record.histories.at(0).v.empty());
    CHECK_FALSE(v.record.histories.at(0).x.empty());
    const MeasuredRecord a = with("a [m/s^2]");
    CHECK(warns(a, "column a is constant"));
    CHECK(a.record.histories.at(0).a.empty());
    const MeasuredRecord force = with("force [N]");
    CHECK(warns(force, "column force is constant: no force drives the mass"));
    CHECK(force.record.histories.at(0).force.empty());
    CHECK(mentions(refused("v [mm/s]", {level(value)}), "column v is constant"));
    CHECK(mentions(refused("v [mm/s],a [m/s^2]", {level(value), level(value)}), "column v is constant"));
  }
  CHECK(read("v [mm/s],a [mm/s^2]", {speed, level(0.0)}).record.histories.at(0).a.empty());
}

TEST_CASE("channels: a loop at constant speed keeps its velocity") {
  const Signal ramp = [](double t) { return 2.0 * t; };
  const MeasuredRecord loop = read("x [mm],v [mm/s],force [N]", {ramp, level(2.0), drive}, true);
  CHECK_FALSE(loop.record.histories.at(0).v.empty());
  CHECK(loop.warnings.empty());
  // In one direction, the force of friction may be constant.
  CHECK_FALSE(read("x [mm],force [N]", {ramp, level(2.0)}, true).record.histories.at(0).force.empty());
  CHECK(mentions(refusal([] { (void)read("x [mm],force [N]", {swing, level(2.0)}, true); }),
                 "column force is constant: its sensor gave no signal"));
}

TEST_CASE("channels: a channel of the mass that dies within the test is left out, and so in one test of several") {
  for (const double end : {1.0, 3.0, 4.5}) {
    CAPTURE(end);
    const MeasuredRecord v = read("x [mm],y [mm],v [mm/s]", {swing, drive, until(end, speed, 0.2)});
    CHECK(warns(v, "column v stays at one value from "));
    CHECK(v.record.histories.at(0).v.empty());
    const MeasuredRecord a = read("x [mm],y [mm],a [mm/s^2]", {swing, drive, until(end, pull, 0.0)});
    CHECK(warns(a, "column a stays at one value from "));
    CHECK(a.record.histories.at(0).a.empty());
  }
  const Signal label = [](double t) { return t < 2.995 ? 1.0 : 2.0; };
  const MeasuredRecord two = read("x [mm],y [mm],v [mm/s],sweep", {swing, drive, until(2.995, speed, 0.0), label});
  REQUIRE(two.record.histories.size() == 2);
  CHECK_FALSE(two.record.histories[0].v.empty());
  CHECK(two.record.histories[1].v.empty());
  CHECK(warns(two, "test '2.000000': column v stays at one value from 3 s on while x moves"));
}

TEST_CASE("channels: a mass that really rests, in part or at last, keeps its velocity and acceleration") {
  const Signal rest = [](double t) { return t < 2.0 ? std::cos(omega * t) * 5.0 * (2.0 - t) : 0.0; };
  const Signal slowing = [&](double t) { return t < 2.0 ? (rest(t + 1e-5) - rest(t - 1e-5)) / 2e-5 : 0.0; };
  const MeasuredRecord decay = read("x [mm],v [mm/s],a [m/s^2]", {rest, slowing, level(0.0)});
  CHECK_FALSE(decay.record.histories.at(0).v.empty());
  // A mass that is carried for a time, and then rests while the base moves back.
  const Signal carried = [](double t) { return 5.0 * std::max(-0.5, std::sin(omega * t)); };
  const Signal carried_speed = [](double t) {
    return std::sin(omega * t) > -0.5 ? 5.0 * omega * std::cos(omega * t) : 0.0;
  };
  const MeasuredRecord loop = read("x [mm],y [mm],v [mm/s]", {carried, drive, carried_speed}, true);
  CHECK_FALSE(loop.record.histories.at(0).v.empty());
}

TEST_CASE("channels: a base, a force or a mass that stops alone is told, and refused where the mass moves on") {
  CHECK(warns(read("x [mm],y [mm]", {swing, until(1.0, drive, 0.1)}),
              "column y stays at one value from 1 s on while x goes on as before"));
  CHECK(warns(read("x [mm],force [N]", {swing, until(2.0, drive, 0.0)}), "column force stays at one value"));
  CHECK(warns(read("x [mm],y [mm]", {until(1.0, swing, 0.1), drive}),
              "column x stays at one value from 1 s on while y goes on as before"));
  CHECK(mentions(refused("x [mm],y [mm],v [mm/s]", {until(1.0, swing, 0.1), drive, speed}),
                 "column x stays at one value for half of the test or longer while v moves"));
  const Signal decay = [](double t) { return std::exp(-0.5 * t) * swing(t); };
  CHECK(read("x [mm],force [N]", {decay, until(0.1, drive, 0.0)}).warnings.empty());  // a blow
}

TEST_CASE("channels: copies of a column are refused, and both are named") {
  CHECK(mentions(refused("x [mm],y [mm]", {swing, swing}), "columns x and y hold the same numbers"));
  CHECK(mentions(refused("x [mm],y [um]", {swing, swing}), "columns x and y hold the same numbers"));
  CHECK(
      mentions(refused("x [mm],y [mm],v [mm/s]", {swing, drive, swing}), "columns x and v hold the same numbers"));
  CHECK(mentions(refused("x [mm],y [mm],v [mm/s],a [mm/s^2]", {swing, drive, speed, speed}),
                 "columns v and a hold the same numbers"));
  CHECK(mentions(refused("x [mm],y [mm],force [N]", {swing, drive, drive}),
                 "columns y and force hold the same numbers"));
  const auto pairs = [](const std::string& text) {
    return refusal([&] { (void)identify::parse_record(text, "data.csv"); });
  };
  CHECK(mentions(pairs("Y [mm],x [mm]\n4.5,4.5\n5,5\n5.5,5.5\n"), "columns Y and x hold the same numbers"));
  CHECK(mentions(pairs("Y [um],x [mm]\n4.5,4.5\n5,5\n5.5,5.5\n"), "columns Y and x hold the same numbers"));
  CHECK(mentions(pairs("Y [mm],x [mm],fundamental [mm]\n4,9,4\n5,11,5\n6,13,6\n"),
                 "columns Y and fundamental hold the same numbers"));
  CHECK(pairs("Y [mm],x [mm]\n4.5,4.5\n5,5\n5.5,5.51\n") == "accepted");
  CHECK(pairs("Y [mm],x [mm]\n4.5,9\n5,10\n5.5,11\n") == "accepted");  // without friction
}

TEST_CASE("channels: what cannot be constant among pairs is left out, or refused if it is x") {
  const auto read = [](const std::string& text) { return identify::parse_record(text, "data.csv"); };
  CHECK(mentions(refusal([&] { (void)read("Y [mm],x [mm]\n4,5\n5,5\n6,5\n"); }),
                 "column x is constant while Y changes"));
  // A controller may hold the amplitude of the mass.
  CHECK(read("Y [mm],x [mm],f [Hz]\n4,5,5\n5,5,4.8\n6,5,4.6\n").record.pairs->pairs.size() == 3);
  const auto phase_of = [&](const std::string& phase, const std::string& frequencies) {
    const bool sweeps = frequencies == "sweeps";
    std::string text = "Y [mm],x [mm],phase [deg],f [Hz]\n";
    for (int i = 0; i < 4; ++i)
      text += std::to_string(4 + i) + "," + std::to_string(6 + 3 * i) + "," + phase + "," +
              (sweeps ? std::to_string(5 + i) : "6") + "\n";
    const MeasuredRecord record = read(text);
    const bool is_left_out = std::isnan(record.record.pairs->pairs[0].phase);
    if (is_left_out) CHECK(warns(record, "column phase is constant"));
    return std::string(is_left_out ? "left out" : "used");
  };
  CHECK(phase_of("0", "one") == "left out");
  CHECK(phase_of("180", "one") == "left out");
  CHECK(phase_of("90", "sweeps") == "left out");
  CHECK(phase_of("90", "one") == "used");  // at resonance
  CHECK(warns(read("Y [mm],x [mm],fundamental [mm]\n4,9,2\n5,11,2\n6,13,2\n"), "column fundamental is constant"));
  CHECK(warns(read("Y [mm],x [mm],mean_square_speed [m^2/s^2]\n4,9,0\n5,11,0\n6,13,0\n"),
              "column mean_square_speed is constant"));
}

TEST_CASE("channels: a record that may be clipped says so, and another test of its file does not") {
  // Of an imposed motion it is not certain: it may stop there.
  const Signal cut = [](double t) { return t < 2.995 ? std::min(4.0, swing(t)) : 0.6 * swing(t); };
  const Signal friction = [](double t) { return std::copysign(2.0, speed(t)); };
  const Signal label = [](double t) { return t < 2.995 ? 1.0 : 2.0; };
  const MeasuredRecord once = read("x [mm],force [N],sweep", {cut, friction, label}, true);
  CHECK(warns(once, "column x may be clipped"));
  REQUIRE(once.record.histories.size() == 2);
  CHECK(once.record.histories[0].is_clipped);
  CHECK_FALSE(once.record.histories[1].is_clipped);
}
