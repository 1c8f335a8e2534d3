#include "bench/score/case_answer.hpp"

#include <catch2/catch.hpp>
#include <cmath>

using namespace dualdamp::bench;

namespace {

CaseAnswer answer(double zeta, double F0) {
  CaseAnswer result;
  result.zeta = zeta;
  result.F0 = F0;
  return result;
}

constexpr TrueParameters truth{0.1, 10.0};

}  // namespace

TEST_CASE("interval score: width, and forty times what the truth lies outside") {
  CHECK(interval_score(9.0, 11.0, 10.0) == Approx(0.2));
  CHECK(interval_score(10.5, 11.0, 10.0) == Approx(0.05 + 40.0 * 0.05));
  CHECK(interval_score(8.0, 9.9, 10.0) == Approx(0.19 + 40.0 * 0.01));
  CHECK(interval_score(0.0, 20.0, 10.0) == Approx(ignorance_score));
  CHECK(interval_score(100.0, 101.0, 10.0) == worst_score);
  // The score is proper: of all intervals the central one of a normal distribution has the smallest mean score.
  const auto mean_score = [](double half) {
    double sum = 0.0;
    double weights = 0.0;
    for (int i = -4000; i <= 4000; ++i) {
      const double z = 1e-3 * i;
      const double weight = std::exp(-0.5 * z * z);
      sum += weight * interval_score(1.0 + 0.01 * (z - half), 1.0 + 0.01 * (z + half), 1.0);
      weights += weight;
    }
    return sum / weights;
  };
  CHECK(mean_score(1.96) < mean_score(1.8));
  CHECK(mean_score(1.96) < mean_score(2.1));
}

TEST_CASE("rejected: what is stated counts, else the p-value, else silence is none") {
  CaseAnswer given = answer(0.1, 10.0);
  CHECK_FALSE(mark_of(given, truth).rejected);
  given.p_value = 0.04;
  CHECK(mark_of(given, truth).rejected);
  given.usable = CaseAnswer::Usable::yes;
  CHECK_FALSE(mark_of(given, truth).rejected);
  given.p_value = 0.9;
  given.usable = CaseAnswer::Usable::no;
  CHECK(mark_of(given, truth).rejected);
  CHECK(mark_of({}, truth).rejected);
}

TEST_CASE("a small p-value withdraws an answer whose method says nothing else, as usable = no does") {
  CaseAnswer silent = answer(0.1, 10.0);
  silent.zeta95 = {0.09, 0.11};
  silent.p_value = 0.01;
  CaseAnswer stated = silent;
  stated.usable = CaseAnswer::Usable::no;
  CHECK(mark_of(silent, truth).zeta.score == Approx(ignorance_score));
  CHECK_FALSE(mark_of(silent, truth).zeta.has_interval);
  CHECK(mark_of(silent, truth).confidence == mark_of(stated, truth).confidence);
  silent.p_value = 0.06;
  CHECK(mark_of(silent, truth).zeta.has_interval);
}

TEST_CASE("loss: none where there is no truth to err from, with an answer and without") {
  CHECK(std::isnan(mark_of(answer(0.1, 10.0), {}).loss));
  CHECK(std::isnan(mark_of({}, {}).loss));
  CHECK(mark_of({}, {not_stated, 10.0}).loss == 1.0F);
}

TEST_CASE("confidence: usable before not usable before none, then by the p-value") {
  const auto confidence = [](double p, CaseAnswer::Usable usable) {
    CaseAnswer given = answer(0.1, 10.0);
    given.p_value = p;
    given.usable = usable;
    return mark_of(given, truth).confidence;
  };
  using enum CaseAnswer::Usable;
  CHECK(confidence(not_stated, missing) > confidence(0.9, yes));
  CHECK(confidence(0.9, yes) > confidence(0.1, yes));
  CHECK(confidence(0.0, yes) > confidence(1.0, no));
  CHECK(confidence(0.0, no) > mark_of({}, truth).confidence);
}

TEST_CASE("mark: errors, loss, and no score where there is no truth") {
  CaseAnswer given = answer(0.11, 9.0);
  given.F095 = {8.0, 10.0};
  const Mark mark = mark_of(given, truth);
  CHECK(mark.zeta.error == Approx(0.1));
  CHECK(mark.loss == Approx(0.1));
  CHECK_FALSE(mark.zeta.has_interval);
  CHECK(mark.zeta.score == Approx(ignorance_score));
  CHECK(mark.F0.covers);
  CHECK(mark.F0.score == Approx(0.2));
  const Mark partly = mark_of(given, {0.1, not_stated});
  CHECK(std::isnan(partly.F0.score));
  CHECK_FALSE(partly.F0.has_interval);
  CHECK(partly.loss == Approx(0.1));
  given.usable = CaseAnswer::Usable::no;  // its interval is withdrawn
  CHECK(mark_of(given, truth).F0.score == Approx(ignorance_score));
  CHECK(mark_of({}, truth).loss == 1.0F);
  CHECK(mark_of(answer(0.5, 9.0), truth).loss == 1.0F);
}
