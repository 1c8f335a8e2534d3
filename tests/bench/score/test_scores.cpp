// Scores of a stress test whose marks are made up, so that each can be computed by hand.
#include "bench/score/scores.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <string>

#include "bench/score/spread.hpp"
#include "tests/bench/campaign.hpp"

using namespace dualdamp;
using namespace dualdamp::bench;

namespace {

const std::string text =
    "schema: dualdamp/1\nsystem: {mass: 1, stiffness: 1600, damping: 4, friction: {law: coulomb, kinetic: 1}}\n"
    "excitation: {type: base_harmonic, frequency: natural}\n"
    "analysis: {type: stress_test, laws: [detuning, late_displacement], severities: [0.1], seeds: 100,\n"
    "  ranges: [{name: one, amplitudes: [4 mm, 5 mm]}], sensors: [{name: noisy, x: {noise: 10 um}}],\n"
    "  methods: [resonance_two_point, resonance_least_squares]}\n";
constexpr std::size_t seeds = 100;

Mark mark(double zeta_score, double F0_score, double confidence, double loss) {
  Mark made;
  made.given = true;
  made.rejected = false;
  made.zeta = {.score = static_cast<float>(zeta_score), .has_interval = true, .covers = true};
  made.F0 = {.score = static_cast<float>(F0_score), .has_interval = true, .covers = false};
  made.confidence = static_cast<float>(confidence);
  made.loss = static_cast<float>(loss);
  return made;
}

/// Motions: the truth, detuning of family drive, late_displacement of family sensors. Of the first method the
/// scores, errors and rejections of the cases of detuning alternate, and the last quarter of those of
/// late_displacement has no answer. The second method scores 4 everywhere, and knows half of the cases of detuning.
MarkedCases made_up() {
  MarkedCases cases;
  cases.marks.resize(2);
  for (std::size_t i = 0; i < seeds; ++i) cases.marks[0].push_back(mark(1.0, 1.0, 1.0, 0.0));
  for (std::size_t i = 0; i < seeds; ++i) {
    const bool even = i % 2 == 0;
    Mark made = mark(even ? 1.0 : 3.0, 2.0, 1.0, even ? 0.2 : 0.3);
    made.rejected = even;
    made.zeta.error = even ? 0.1F : -0.3F;
    made.F0.error = 0.2F;
    cases.marks[0].push_back(made);
  }
  for (std::size_t i = 0; i < seeds; ++i) {
    cases.marks[0].push_back(mark(3.0, 3.0, 1.0, 0.5));
    cases.marks[0].back().given = i < 75;
  }
  for (std::size_t i = 0; i < 3 * seeds; ++i) cases.marks[1].push_back(mark(4.0, 4.0, 0.5, 1.0));
  for (std::size_t i = 0; i < seeds; ++i) {
    const bool known = i < seeds / 2;
    cases.marks[1][seeds + i] = mark(4.0, 4.0, known ? 0.9 : 0.1, known ? 0.0 : 1.0);
  }
  cases.consequences = {{.distance = 0.0, .harm = 0.0, .attainable_power = 0.05},
                        {.distance = 1.5, .harm = 0.005, .attainable_power = 0.4},
                        {.distance = 400.0, .attainable_power = 0.9}};
  return cases;
}

struct ScoredMarks : testing::Campaign {
  ScoredMarks() : Campaign(text) {}
  MarkedCases cases = made_up();
  Scores scores = score(cases, grid);
};

}  // namespace

TEST_CASE("scores: means over cases, families and all are those by hand") {
  const ScoredMarks made;
  const Scores& scores = made.scores;
  REQUIRE(scores.cells.size() == 6);
  const CellScore& detuned = scores.cells[2];
  CHECK(detuned.cases == 100);
  CHECK(detuned.estimates == 100);
  CHECK(detuned.zeta_bias == Approx(-0.1));
  CHECK(detuned.zeta_error == Approx(0.3));  // of 50 times 0.1 and 50 times 0.3 the upper median
  CHECK(detuned.F0_bias == Approx(0.2));
  CHECK(detuned.distance == 1.5);
  CHECK(detuned.harm == 0.005);
  CHECK(detuned.value[Metric::interval_score_zeta] == Approx(2.0));
  CHECK(detuned.value[Metric::power] == Approx(0.5));
  CHECK(detuned.value[Metric::selective_risk_area] == Approx(0.25));  // equal confidence: the mean loss
  CHECK(scores.cells[3].value[Metric::selective_risk_area] == Approx(0.5 * 0.5));
  CHECK(scores.cells[4].estimates == 75);
  CHECK(std::isnan(scores.cells[4].harm));

  REQUIRE(scores.families.size() == 6);
  CHECK(scores.families[0].family == Family::none);
  CHECK(scores.families[0].value.interval_score() == Approx(1.0));
  CHECK(std::isnan(scores.families[0].value[Metric::power]));
  CHECK(scores.families[2].family == Family::sensors);
  CHECK(scores.families[2].value.interval_score() == Approx(3.0));
  CHECK(scores.families[4].family == Family::drive);
  CHECK(scores.families[4].value.interval_score() == Approx(2.0));

  REQUIRE(scores.ranking.size() == 2);
  CHECK(scores.ranking[0].entrant == 0);
  CHECK(scores.ranking[0].interval_score == Approx((1.0 + 2.0 + 3.0) / 3.0));
  CHECK(scores.ranking[1].interval_score == Approx(4.0));
  CHECK(scores.ranking[0].value[Metric::attainable_power] == Approx(0.5 * (0.4 + 0.9)));
  CHECK(scores.ranking[0].value[Metric::false_alarm] == 0.0);
  // Half a family has confidence 0.9 and no loss, two have 0.5 and half a one 0.1, with loss 1.
  CHECK(scores.ranking[1].value[Metric::selective_risk_area] == Approx((2.0 * 2.0 / 2.5 + 0.5 * 2.5 / 3.0) / 3.0));
}

TEST_CASE("scores: standard errors are those of means, and only a difference beyond two of them ranks") {
  const ScoredMarks made;
  const Scores& scores = made.scores;
  // 100 scores with a standard deviation of 1, of zeta alone. 200 resamples tell a deviation to 5 %.
  const double error = 1.0 / std::sqrt(100.0);
  CHECK(scores.cells[2].se[Metric::interval_score_zeta] == Approx(error).epsilon(0.2));
  CHECK(scores.cells[2].se[Metric::power] == Approx(0.5 * error).epsilon(0.2));
  CHECK(scores.cells[2].se[Metric::interval_score_F0] == Approx(0.0).margin(1e-12));
  CHECK(scores.families[4].se[Metric::interval_score_zeta] == Approx(error).epsilon(0.2));
  CHECK(scores.ranking[0].se[Metric::interval_score_zeta] == Approx(error / 3.0).epsilon(0.2));
  CHECK(scores.ranking[0].interval_score_se == Approx(error / 6.0).epsilon(0.2));
  REQUIRE(scores.differences.size() == 1);
  const Difference& difference = scores.differences.front();
  CHECK(difference.better == 0);
  CHECK(difference.worse == 1);
  CHECK(difference.value == Approx(2.0));
  CHECK(difference.se == Approx(error / 6.0).epsilon(0.2));
  CHECK(difference.is_significant);
  CHECK(scores.ranking[0].from == 1);
  CHECK(scores.ranking[0].to == 1);
  CHECK(scores.ranking[1].from == 2);
  CHECK(scores.ranking[1].to == 2);

  // A difference of a quarter of its standard error ranks none before the other.
  MarkedCases near = made.cases;
  near.marks[1] = near.marks[0];
  for (std::size_t i = seeds; i < 2 * seeds; ++i) near.marks[1][i].zeta.score = i % 2 == 0 ? 3.05F : 1.05F;
  const Scores equal = score(near, made.grid);
  CHECK_FALSE(equal.differences.front().is_significant);
  for (const Rank& rank : equal.ranking) {
    CHECK(rank.from == 1);
    CHECK(rank.to == 2);
  }
}

TEST_CASE("scores: intervals of distance and harm hold the departures that lie in them, and not the truth") {
  const ScoredMarks made;
  const std::vector<ConsequenceScore>& list = made.scores.by_consequence;
  REQUIRE(list.size() == 6);
  CHECK(list[0].axis == "distance");
  CHECK(list[0].from == 1.0);
  CHECK(list[0].to == 2.0);
  CHECK(list[0].departures == 1);
  CHECK(list[0].cases == 100);
  CHECK(list[0].value.interval_score() == Approx(2.0));
  CHECK(list[0].se[Metric::interval_score_zeta] == Approx(0.1).epsilon(0.2));
  CHECK(list[1].entrant == 1);
  CHECK(list[1].value.interval_score() == Approx(4.0));
  CHECK(list[2].from == 300.0);
  CHECK(std::isnan(list[2].to));
  CHECK(list[2].value.interval_score() == Approx(3.0));
  CHECK(list[4].axis == "harm");
  CHECK(list[4].from == 0.003);
  CHECK(list[4].to == 0.01);
  CHECK(list[4].value[Metric::power] == Approx(0.5));
}

TEST_CASE("spread: the standard deviation of a sample, where half of the resamples have a value") {
  Spread few;
  for (std::size_t i = 1; i < resamples / 2; ++i) few.add(static_cast<double>(i));
  CHECK(std::isnan(few.se()));
  few.add(not_stated);
  CHECK(std::isnan(few.se()));
  few.add(static_cast<double>(resamples / 2));
  // Of 1, 2, ..., n the variance with the divisor n - 1 is n (n + 1)/12.
  const double n = static_cast<double>(resamples) / 2.0;
  CHECK(few.se() == Approx(std::sqrt(n * (n + 1.0) / 12.0)).epsilon(1e-12));
}
