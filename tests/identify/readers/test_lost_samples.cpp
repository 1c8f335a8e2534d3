#include "identify/readers/lost_samples.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <random>

#include "identify/readers/record_reader.hpp"
#include "tests/identify/readers/data_files.hpp"
#include "tests/identify/readers/refusals.hpp"

using namespace dualdamp;
using namespace dualdamp::identify;
using identify::testing::mentions;
using identify::testing::print;

namespace {

using Signal = std::function<double(double)>;

/// The rows of t, x and, if given, force at 500 Hz; those that are lost have no row.
MeasuredRecord record_without(const std::function<bool(int)>& is_lost, const Signal& x, const Signal& force = {}) {
  std::string text = force ? "t [s],x [m],force [N]\n" : "t [s],x [m]\n";
  for (int i = 0; i < 1000; ++i) {
    if (is_lost(i)) continue;
    const double t = 0.002 * i;
    text += print("%.3f,%.9f", t, x(t)) + (force ? print(",%.9f", force(t)) : "") + "\n";
  }
  return parse_record(text, "data.csv");
}

double ring_down(double t) { return 0.02 * std::exp(-1.2 * t) * std::cos(38.0 * t); }

}  // namespace

TEST_CASE("Lost samples of a smooth motion are filled, and said so") {
  const auto lost = [](int i) { return i == 130 || i == 291 || i == 292 || i == 468 || i == 469 || i == 470; };
  const MeasuredRecord file = record_without(lost, ring_down);
  REQUIRE(file.record.histories.size() == 1);
  const History& history = file.record.histories.front();
  REQUIRE(history.x.size() == 1000);
  CHECK(history.sample_rate == Approx(500.0).epsilon(1e-9));
  for (std::size_t i = 0; i < history.x.size(); ++i)
    CHECK(std::abs(history.x[i] - ring_down(0.002 * static_cast<double>(i))) < 1e-8);
  REQUIRE(file.warnings.size() == 1);
  CHECK(mentions(file.warnings.front(), "6 samples are missing between the times, at most 3 in a row: filled"));
  CHECK(history.gaps.empty());
}

TEST_CASE("Noise does not prevent that lost samples are filled, and the clock may be rounded") {
  std::mt19937_64 random(4);
  std::normal_distribution<double> noise(0.0, 1e-4);
  const auto noisy = [&](double t) { return ring_down(t) + noise(random); };
  CHECK(record_without([](int i) { return i % 97 == 50; }, noisy).record.histories.front().x.size() == 1000);
  // A step of 10/3 ms, printed to a tenth of a millisecond.
  std::string text = "t [s],x [m]\n";
  for (int i = 0; i < 3000; ++i)
    if (i % 400 != 200) text += print("%.4f,%.9f\n", i / 300.0, ring_down(i / 300.0));
  const History history = parse_record(text, "data.csv").record.histories.front();
  CHECK(history.x.size() == 3000);
  CHECK(history.sample_rate == Approx(300.0).epsilon(1e-6));
}

TEST_CASE("Signals that tell nothing about a lost sample are not filled") {
  std::mt19937_64 random(4);
  std::normal_distribution<double> noise(0.0, 1.0);
  const auto lost = [](int i) { return i == 400; };
  const auto rows = [&](const MeasuredRecord& file) { return file.record.histories.front().x.size(); };
  // A random force; four samples in a period.
  CHECK(rows(record_without(lost, ring_down, [&](double) { return noise(random); })) < 1000);
  CHECK(rows(record_without(lost, [](double t) { return 0.01 * std::cos(790.0 * t); })) < 1000);
  // A force that is smooth too.
  CHECK(rows(record_without(lost, ring_down, [](double t) { return 3.0 * std::sin(50.0 * t); })) == 1000);
  // Four samples in a row, and many.
  CHECK(rows(record_without([](int i) { return i >= 400 && i < 404; }, ring_down)) < 1000);
  CHECK(record_without([](int i) { return i > 500 && i % 8 == 0; }, ring_down).record.histories.front().x.size() <
        1000);
}

TEST_CASE("Of the parts between gaps the one that moves most is used, not the longest one") {
  const auto rests = [](double t) { return t < 0.9 ? (0.9 - t) * std::cos(38.0 * t) : 0.0; };
  const MeasuredRecord file = record_without([](int i) { return i >= 400 && i < 430; }, rests);
  CHECK(file.record.histories.front().x.size() == 400);
  CHECK(file.record.histories.front().start == 0.0);
  CHECK(mentions(file.warnings.front(), "only the uninterrupted stretch with the most motion is used, 400 rows"));
}
