#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "identify/readers/record_reader.hpp"
#include "tests/identify/readers/data_files.hpp"
#include "tests/identify/readers/refusals.hpp"
#include "tests/identify/records.hpp"

using namespace dualdamp;
using namespace dualdamp::identify::testing;
using identify::MeasuredRecord;
using identify::parse_record;
using identify::parse_signal;
using identify::ReadOptions;

namespace {

double vibration(double t) { return 40.0 * std::exp(-t) * std::cos(38.8 * t); }

std::string row(double t, double x, int decimals = 3) { return print("%.*f,%.6f\n", decimals, t, x); }

/// 2000 samples at `rate` [Hz]. `also`: what follows each row.
std::string recorded(double rate, const std::function<std::string(int, double)>& also) {
  std::string text = "t [s],x [mm]\n";
  for (int i = 0; i < 2000; ++i) {
    const double t = i / rate;
    text += row(t, vibration(t)) + also(i, t);
  }
  return text;
}

std::string nothing(int, double) { return {}; }

MeasuredRecord read(const std::string& text) { return parse_record(text, "data.csv"); }

}  // namespace

TEST_CASE("time stamps: a time that appears twice with other values is refused at the resolution of the step") {
  for (const int twice : {50, 1000, 1990}) {
    const std::string text = recorded(
        1000.0, [twice](int i, double t) { return i == twice ? row(t, vibration(t) + 0.05) : std::string(); });
    const std::string said = refusal([&] { (void)read(text); });
    CHECK(mentions(said, "it appears twice, with other values"));
    CHECK(mentions(said, "data.csv:" + std::to_string(twice + 3)));
  }
}

TEST_CASE("time stamps: a coarse clock that repeats itself is read as even samples") {
  for (const double rate : {1000.5, 1024.0, 1100.0, 2000.0, 4000.0}) {
    CAPTURE(rate);
    const MeasuredRecord file = read(recorded(rate, nothing));
    REQUIRE(file.record.histories.size() == 1);
    CHECK(file.record.histories[0].x.size() == 2000);
    // 1 ms over the record, shared by both ends
    CHECK(file.record.histories[0].sample_rate == Approx(rate).epsilon(1e-3 * rate / 2000.0));
    for (const std::string& warning : file.warnings) CHECK(warning.find("other values") == std::string::npos);
  }
}

TEST_CASE("time stamps: rows that are written twice are used once, however many they are") {
  for (const int share : {1, 10, 400}) {
    CAPTURE(share);
    const MeasuredRecord file = read(recorded(
        1000.0, [share](int i, double t) { return i % share == 0 ? row(t, vibration(t)) : std::string(); }));
    REQUIRE(file.record.histories.size() == 1);
    CHECK(file.record.histories[0].x.size() == 2000);
    CHECK(file.record.histories[0].sample_rate == Approx(1000.0));
    REQUIRE(file.warnings.size() == 1);
    CHECK(mentions(file.warnings[0], std::to_string(2000 / share) + " rows appear twice"));
  }
}

TEST_CASE("time stamps: a unit or a scale of times of day is refused") {
  const auto text = [](const std::string& heading) {
    std::string rows = heading + ",x [mm]\n";
    for (int i = 0; i < 40; ++i) rows += print("2026-11-22T12:30:%06.3f,%.6f\n", 0.01 * i, vibration(0.01 * i));
    return rows;
  };
  const auto refused = [&](const std::string& heading, ReadOptions options) {
    options.name = "data.csv";
    return refusal([&] { (void)parse_record(text(heading), options); });
  };
  CHECK(mentions(refused("t [ms]", {}), "column t holds time stamps"));
  CHECK(mentions(refused("t", {.units = {{"t", "ms"}}}), "column t holds time stamps"));
  CHECK(mentions(refused("t", {.scales = {{"t", "2"}}}), "column t holds time stamps"));
  CHECK(refused("t [s]", {}) == "accepted");
  CHECK(refused("t [ms]", {.units = {{"t", "s"}}}) == "accepted");
  CHECK(read(text("t")).warnings.empty());  // no unit is assumed
}

TEST_CASE("time stamps: times that run backwards are refused") {
  std::string text = "t [s],x [mm]\n";
  for (int i = 100; i > 0; --i) text += row(0.01 * i, vibration(0.01 * i));
  CHECK(mentions(refusal([&] { (void)read(text); }), "the time runs backwards"));
  CHECK(mentions(refusal([&] { (void)parse_signal(text, "x", {.name = "data.csv"}); }), "does not increase"));
}

TEST_CASE(
    "time stamps: times of a drive that are equal and times that go back are two problems, with their lines") {
  const std::string text = "t [s],y [mm]\n0,1\n0.1,2\n0.1,3\n0.2,1\n0.15,2\n0.15,2\n0.3,1\n";
  const std::string message = refusal([&] { (void)parse_signal(text, "y", {.name = "data.csv"}); });
  CHECK(mentions(message, "it appears twice; the same in 1 more row (line 7)"));
  CHECK(mentions(message, "the time does not increase\n"));
}

TEST_CASE("time stamps: a gap in the samples of a drive is told") {
  const auto gaps_of = [](const std::function<bool(int)>& is_there, double jitter) {
    std::string text = "t [s],y [mm]\n";
    for (int i = 0; i < 400; ++i)
      if (is_there(i)) text += row(0.002 * i + jitter * std::sin(i), vibration(0.002 * i), 5);
    return parse_signal(text, "y", {.name = "data.csv"}).warnings;
  };
  const auto all = [](int) { return true; };
  CHECK(gaps_of(all, 0.0).empty());
  CHECK(gaps_of(all, 0.0005).empty());
  CHECK(gaps_of([](int i) { return i < 20 || i % 8 == 0; }, 0.0).empty());  // another rate, not a gap
  const auto one = gaps_of([](int i) { return i < 100 || i > 103; }, 0.0);
  REQUIRE(one.size() == 1);
  CHECK(mentions(one[0], "the samples have 1 gap from t = 0.198 s to 0.208 s, 5 usual steps"));
  CHECK(gaps_of([](int i) { return i < 100 || i > 140; }, 0.0005).size() == 1);
}

TEST_CASE("time stamps: a stated sample rate takes the place of times that the file lacks") {
  const auto rows = [](const std::string& ahead, int from) {
    std::string text;
    for (int i = from; i < from + 100; ++i) text += ahead + print("%.6f\n", vibration(i / 50.0));
    return text;
  };
  const ReadOptions options{.sample_rate = 50.0, .name = "data.csv"};
  const auto read_all = [&](const std::string& text) { return parse_record(text, options).record; };

  const identify::Record one = read_all("x [mm]\n" + rows("", 0));
  REQUIRE(one.histories.size() == 1);
  CHECK(one.histories[0].start == 0.0);
  CHECK(one.histories[0].sample_rate == Approx(50.0));
  CHECK(one.histories[0].x.size() == 100);

  const identify::Record two = read_all("sweep,x [mm]\n" + rows("a,", 0) + rows("b,", 30));
  REQUIRE(two.histories.size() == 2);
  for (const identify::History& history : two.histories) CHECK(history.start == 0.0);
  CHECK(two.histories[1].x[0] == Approx(1e-3 * vibration(30 / 50.0)).margin(1e-9));

  const identify::MeasuredSignal drive = parse_signal("y [mm]\n" + rows("", 0), "y", options);
  CHECK(drive.times[99] == Approx(99 / 50.0));

  CHECK(mentions(refusal([&] { (void)read_all(recorded(50.0, nothing)); }), "the file has times t"));
  CHECK(mentions(refusal([&] { (void)read_all("Y [mm],x [mm]\n1,5\n2,9\n"); }), "the file has amplitudes Y"));
  CHECK(mentions(refusal([&] { (void)parse_signal("t [s],y [mm]\n0,1\n1,2\n", "y", options); }), "times t"));
  CHECK(mentions(refusal([&] { (void)read("x [mm]\n" + rows("", 0)); }),
                 "or with their rate, as sample_rate: 1 kHz"));
  std::string at_rest;  // a noise that turns back at two rows of three
  for (int i = 0; i < 300; ++i) at_rest += print("%.6f\n", 1e-3 * std::sin(7.0 * i * i));
  CHECK(mentions(refusal([&] { (void)read("x [mm]\n" + rows("", 0) + at_rest); }), "or with their rate"));
}

TEST_CASE(
    "time stamps: steps that vary slowly, as those of a solver, are interpolated, also where noise hides which times are smoother") {
  for (const double noise : {0.0, 0.05}) {
    CAPTURE(noise);
    Normal normal(3);
    std::string text = "t [s],x [mm]\n";
    double t = 0.0;
    for (int i = 0; i < 700; ++i) {
      text += row(t, vibration(t) + noise * normal(), 9);
      t += 3e-3 * (1.0 + 0.6 * std::sin(0.05 * i));
    }
    const MeasuredRecord file = read(text);
    REQUIRE(file.record.histories.size() == 1);
    const identify::History& history = file.record.histories.front();
    REQUIRE(file.warnings.size() == 1);
    CHECK(mentions(file.warnings.front(), "they are interpolated at even times"));
    for (std::size_t i = 0; i < history.x.size(); ++i)
      CHECK(history.x[i] ==
            Approx(1e-3 * vibration(static_cast<double>(i) / history.sample_rate)).margin(2e-6 + 6e-3 * noise));
  }
}
