/// Two answers to one question compared (`scenarios/verification/answer_comparison.hpp`).

#include "scenarios/verification/answer_comparison.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

using namespace dualdamp;
using scenarios::Answer;
using scenarios::Json;
using scenarios::Verification;

namespace {

const std::vector<scenarios::ResultField> compared_fields = {
    {"peak", "m", ""}, {"phase", "rad", ""}, {"stops", "1", ""}};

Answer answer_with(double peak, double phase) {
  Answer result;
  result.result = {{"peak", peak}, {"phase", phase}, {"stops", 2}, {"certificate", {{"searches", 17}}}};
  return result;
}

Answer curve_answer(double x) {
  Answer result;
  result.result["points"] = nullptr;
  result.tables.push_back(
      {.name = "curve",
       .columns = {{.name = "x", .unit = "m", .numbers = {x, 1.0}},
                   {.name = "stops", .numbers = {0.0, 2.0}, .kind = scenarios::CellKind::count}},
       .key = "points"});
  return result;
}

}  // namespace

TEST_CASE("comparison of answers: the quantity that is off is named", "[scenarios][verification]") {
  const Verification same =
      scenarios::compare_answers(answer_with(0.1, 1.0), answer_with(0.1, 1.0), compared_fields);
  CHECK(same.agrees);
  CHECK(same.largest_difference == 0.0);
  CHECK(same.quantities == 3);

  const Verification off =
      scenarios::compare_answers(answer_with(0.1, 1.0), answer_with(0.1 + 1e-7, 1.0), compared_fields);
  CHECK_FALSE(off.agrees);
  CHECK(off.quantity == "peak");
  CHECK(off.largest_difference == Approx(1e-6));
  CHECK(off.tolerance == scenarios::verification_tolerance("m"));
  CHECK_THAT(off.reason, Catch::Contains("peak") && Catch::Contains("0.1"));

  const double turn = 2.0 * std::numbers::pi;
  CHECK(scenarios::compare_answers(answer_with(0.1, 1e-9), answer_with(0.1, turn - 1e-9), compared_fields).agrees);
  CHECK_FALSE(scenarios::compare_answers(answer_with(0.1, 1.0), answer_with(0.1, 1.001), compared_fields).agrees);
}

TEST_CASE("comparison of answers: counts are equal, and a missing number is a difference",
          "[scenarios][verification]") {
  Answer other = answer_with(0.1, 1.0);
  other.result["stops"] = 3;
  CHECK(scenarios::compare_answers(answer_with(0.1, 1.0), other, compared_fields).quantity == "stops");
  other = answer_with(0.1, 1.0);
  other.result["peak"] = nullptr;
  CHECK(scenarios::compare_answers(answer_with(0.1, 1.0), other, compared_fields).quantity == "peak");
  CHECK(scenarios::compare_answers(other, answer_with(0.1, 1.0), compared_fields).quantity == "peak");
}

TEST_CASE("comparison of answers: other steady states are compared where both computations know them",
          "[scenarios][verification]") {
  const auto with_others = [](std::vector<double> peaks) {
    Answer result = answer_with(0.1, 1.0);
    result.result["others"] = scenarios::Json::array();
    for (const double peak : peaks)
      result.result["others"].push_back({{"peak", peak}, {"trough", -0.1}, {"period_ratio", 3}});
    return result;
  };
  const Verification same =
      scenarios::compare_answers(with_others({0.1, 0.2}), with_others({0.2, 0.1}), compared_fields);
  CHECK(same.agrees);
  CHECK(same.others_left_out == 0);
  const Verification one = scenarios::compare_answers(with_others({0.2}), with_others({0.1, 0.3}), compared_fields);
  CHECK(one.agrees);
  CHECK(one.others_left_out == 3);
  const Verification off =
      scenarios::compare_answers(with_others({0.2}), with_others({0.1, 0.2 + 1e-6}), compared_fields);
  CHECK_FALSE(off.agrees);
  CHECK(off.quantity == "others[0].peak");
  CHECK(off.others_left_out == 1);
}

TEST_CASE("comparison of answers: a phase that one computation does not have is not compared",
          "[scenarios][verification]") {
  Answer without = answer_with(0.1, 1.0);
  without.result["phase"] = nullptr;
  without.result["phase_reason"] = "x has no fundamental";
  CHECK(scenarios::compare_answers(answer_with(0.1, 1.0), without, compared_fields).agrees);
  CHECK(scenarios::compare_answers(without, answer_with(0.1, 1.0), compared_fields).agrees);
  CHECK_FALSE(scenarios::compare_answers(without, answer_with(0.2, 1.0), compared_fields).agrees);
  const auto curve = [](double phase) {
    Answer result = curve_answer(1.0);
    result.tables[0].columns.push_back({.name = "phase", .unit = "rad", .numbers = {phase, 1.0}});
    return result;
  };
  CHECK(scenarios::compare_answers(curve(2.0), curve(scenarios::none), {}).agrees);
  CHECK_FALSE(scenarios::compare_answers(curve(2.0), curve(3.0), {}).agrees);
}

TEST_CASE("comparison of answers: rows without numbers in one computation are told from those in both",
          "[scenarios][verification]") {
  const auto with_reasons = [](std::vector<std::string> reasons) {
    Answer curve = curve_answer(1.0);
    curve.tables[0].columns.push_back(
        {.name = "reason", .texts = std::move(reasons), .kind = scenarios::CellKind::text});
    return curve;
  };
  const Verification found =
      scenarios::compare_answers(with_reasons({"none", "none"}), with_reasons({"none", ""}), {});
  CHECK(found.rows_left_out == 1);
  CHECK(found.rows_without_numbers == 1);
  CHECK(found.agrees);
}

TEST_CASE("comparison of answers: a column that only one answer has counts where a compared row fills it",
          "[scenarios][verification]") {
  const auto with_column = [](std::vector<double> numbers, std::vector<std::string> reasons) {
    Answer curve = curve_answer(1.0);
    curve.tables[0].columns.push_back({.name = "Y_sticks", .unit = "m", .numbers = std::move(numbers)});
    curve.tables[0].columns.push_back(
        {.name = "reason", .texts = std::move(reasons), .kind = scenarios::CellKind::text});
    return curve;
  };
  CHECK(scenarios::compare_answers(with_column({0.1, NAN}, {"open", ""}), curve_answer(1.0), {}).agrees);
  const Verification found = scenarios::compare_answers(with_column({0.1, NAN}, {"", ""}), curve_answer(1.0), {});
  CHECK_FALSE(found.agrees);
  CHECK(found.quantity == "points[].Y_sticks");
}

TEST_CASE("comparison of answers: each point of a curve is measured by its own amplitude",
          "[scenarios][verification]") {
  // Relative to an amplitude of 1 m an error of 1e-12 m would not count.
  const Verification off = scenarios::compare_answers(curve_answer(1e-6), curve_answer(1e-6 + 1e-12), {});
  CHECK_FALSE(off.agrees);
  CHECK(off.quantity == "points[0].x");
  Answer other = curve_answer(1e-6);
  other.tables[0].columns[1].numbers[1] = 4.0;
  CHECK(scenarios::compare_answers(curve_answer(1e-6), other, {}).quantity == "points[1].stops");
}

TEST_CASE("comparison of answers: Floquet multipliers are a set", "[scenarios][verification]") {
  Answer mine;
  Answer theirs;
  mine.result["multipliers"] = Json::parse("[[0.5, 0.1], [0.5, -0.1], [0.0, 0.0]]");
  theirs.result["multipliers"] = Json::parse("[[0.0, 0.0], [0.5, -0.1], [0.5, 0.1]]");
  CHECK(scenarios::compare_answers(mine, theirs, {}).agrees);
  theirs.result["multipliers"] = Json::parse("[[0.0, 0.0], [0.5, -0.1], [0.6, 0.1]]");
  CHECK(scenarios::compare_answers(mine, theirs, {}).quantity == "multipliers");
}

TEST_CASE("comparison of answers: a Floquet multiplier of 1 and one of 0 are of a slider at its limit",
          "[scenarios][verification]") {
  const auto with_multipliers = [](const std::string& list) {
    Answer result;
    result.result["multipliers"] = Json::parse(list);
    return result;
  };
  const Answer slips = with_multipliers("[[0.4, 0.0], [0.0, 0.0], [0.0, 0.0]]");
  const Answer sticks = with_multipliers("[[1.0, 0.0], [0.0, 0.0], [0.5, 0.0]]");
  for (const auto& [one, two] : {std::pair{slips, sticks}, {sticks, slips}}) {
    const Verification found = scenarios::compare_answers(one, two, {});
    CHECK(found.agrees);
    CHECK(found.multipliers_left_out == 2);
  }
  CHECK_FALSE(
      scenarios::compare_answers(sticks, with_multipliers("[[0.5, 0.0], [0.1, 0.0], [0.0, 0.0]]"), {}).agrees);
}

TEST_CASE("comparison of answers: grazings are left out, other events are not", "[scenarios][verification]") {
  const auto events = [](std::vector<double> t, std::vector<std::string> kinds) {
    Answer result;
    result.result["events"] = nullptr;
    result.tables.push_back(
        {.name = "events",
         .columns = {{.name = "t", .unit = "s", .numbers = std::move(t)},
                     {.name = "kind", .texts = std::move(kinds), .kind = scenarios::CellKind::text}},
         .key = "events"});
    return result;
  };
  const Answer all = events({1.0, 1.5, 2.0}, {"stop", "grazing", "release"});
  CHECK(scenarios::compare_answers(all, events({1.0, 2.0}, {"stop", "release"}), {}).agrees);
  CHECK(scenarios::compare_answers(all, events({1.0}, {"stop"}), {}).quantity == "events");
  CHECK(scenarios::compare_answers(all, events({1.0, 2.0}, {"stop", "reversal"}), {}).quantity == "events[1].kind");
}

TEST_CASE("comparison of answers: a creep has places, and no times of its turns", "[scenarios][verification]") {
  const auto turning_at = [](double time, double place) {
    Answer result;
    result.result["events"] = nullptr;
    result.tables.push_back({.name = "events",
                             .columns = {{.name = "t", .unit = "s", .numbers = {1.0, time, 3.0, 4.0}},
                                         {.name = "kind",
                                          .texts = {"reversal", "reversal", "reversal", "reversal"},
                                          .kind = scenarios::CellKind::text},
                                         {.name = "x", .unit = "m", .numbers = {0.0, place, 0.0, place}}},
                             .key = "events"});
    return result;
  };
  const scenarios::SizesOfUnits finest = {{"m", 0.1}};
  const Verification creep = scenarios::compare_answers(turning_at(2.0, 0.09), turning_at(2.1, 0.09), {}, finest);
  CHECK(creep.agrees);
  CHECK(creep.times_left_out == 3);
  const auto differs = [&](double time, double place, double other) {
    return scenarios::compare_answers(turning_at(2.0, place), turning_at(time, other), {}, finest).quantity;
  };
  CHECK(differs(2.1, 0.11, 0.11) == "events[1].t");
  CHECK(differs(2.1, 0.09, 0.0901) == "events[1].x");
  CHECK_FALSE(scenarios::compare_answers(turning_at(2.0, 0.09), turning_at(2.1, 0.09), {}).agrees);
}

TEST_CASE("comparison of answers: errors of events that add up shift a motion in time, a single one does not",
          "[scenarios][verification]") {
  // A mass that turns once a second, v = sin(pi t) m/s, and a second computation of it: the shift of each event.
  constexpr int count = 1000;
  const std::vector<scenarios::ResultField> kinds = {{"final.v", "m/s", ""}};
  const auto motion = [](const std::function<double(int)>& shift, double end, double error) {
    constexpr double pi = std::numbers::pi;
    std::vector<double> t;
    std::vector<double> x;
    for (int i = 1; i <= count; ++i) {
      t.push_back(i + shift(i));
      x.push_back((1.0 - std::cos(pi * i)) / pi);
    }
    Answer result;
    const double s = end - shift(count);
    result.result = {{"events", nullptr}, {"final", {{"t", end}, {"v", std::sin(pi * s) + error}}}};
    result.final_acceleration = pi * std::cos(pi * s);
    result.tables.push_back({.name = "events",
                             .columns = {{.name = "t", .unit = "s", .numbers = t},
                                         {.name = "kind",
                                          .texts = std::vector<std::string>(count, "reversal"),
                                          .kind = scenarios::CellKind::text},
                                         {.name = "x", .unit = "m", .numbers = x}},
                             .key = "events"});
    result.tables.push_back({.name = "history",
                             .columns = {{.name = "t", .unit = "s", .numbers = {end}},
                                         {.name = "x", .unit = "m", .numbers = {(1.0 - std::cos(pi * s)) / pi}},
                                         {.name = "v", .unit = "m/s", .numbers = {std::sin(pi * s) + error}},
                                         {.name = "a", .unit = "m/s^2", .numbers = {result.final_acceleration}}}});
    return result;
  };
  const auto none = [](int) { return 0.0; };
  const auto small = [](int i) { return 2e-8 * i; };
  const auto single = [](int i) { return i < 500 ? 0.0 : 2e-5; };
  const double end = count + 0.2;
  const Verification sum = scenarios::compare_answers(motion(none, end, 0.0), motion(small, end, 0.0), kinds);
  CHECK(sum.agrees);
  CHECK(sum.time_shift == Approx(2e-5));
  const Verification one = scenarios::compare_answers(motion(none, end, 0.0), motion(single, end, 0.0), kinds);
  CHECK_FALSE(one.agrees);
  CHECK(one.time_shift == 0.0);
  // What the shift does not explain is a difference, and so are events that are late by too much.
  CHECK(scenarios::compare_answers(motion(none, end, 0.0), motion(small, end, 5e-7), kinds).quantity == "final.v");
  const auto late = [](int i) { return i < 950 ? 0.0 : 3e-8 * (i - 950.0) * 1e3; };
  CHECK_FALSE(scenarios::compare_answers(motion(none, end, 0.0), motion(late, end, 0.0), kinds).agrees);
}

TEST_CASE("comparison of answers: events at one time may come in another order, others not",
          "[scenarios][verification]") {
  const auto events = [](double second, const std::string& first_kind, const std::string& second_kind) {
    Answer result;
    result.result = {{"events", nullptr}};
    result.tables.push_back({.name = "events",
                             .columns = {{.name = "t", .unit = "s", .numbers = {1.0, second, 10.0}},
                                         {.name = "kind",
                                          .texts = {first_kind, second_kind, "stop"},
                                          .kind = scenarios::CellKind::text},
                                         {.name = "x", .unit = "m", .numbers = {1.0, 1.0, 2.0}}},
                             .key = "events"});
    return result;
  };
  CHECK(scenarios::compare_answers(events(1.0, "stop", "switching"), events(1.0, "switching", "stop"), {}).agrees);
  CHECK_FALSE(
      scenarios::compare_answers(events(1.1, "stop", "switching"), events(1.1, "switching", "stop"), {}).agrees);
  CHECK_FALSE(scenarios::compare_answers(events(1.0, "stop", "stop"), events(1.0, "switching", "stop"), {}).agrees);
}

TEST_CASE("comparison of answers: a subharmonic motion may begin with another period",
          "[scenarios][verification]") {
  const auto orbit = [](const std::vector<double>& x, double start) {
    Answer result;
    result.result = {{"period_ratio", 2}, {"period", 2.0}, {"sticks", Json::array({{{"start", start}}})}};
    result.tables.push_back({.name = "orbit",
                             .columns = {{.name = "t", .unit = "s", .numbers = {0.0, 0.5, 1.0, 1.5, 2.0}},
                                         {.name = "x", .unit = "m", .numbers = x}}});
    return result;
  };
  const Answer one = orbit({1.0, 2.0, 3.0, 4.0, 1.0}, 0.2);
  CHECK(scenarios::compare_answers(one, orbit({3.0, 4.0, 1.0, 2.0, 3.0}, 1.2), {}).agrees);
  CHECK_FALSE(scenarios::compare_answers(one, orbit({3.0, 4.0, 1.0, 2.0, 3.0}, 0.2), {}).agrees);
  CHECK_FALSE(scenarios::compare_answers(one, orbit({2.0, 3.0, 4.0, 1.0, 2.0}, 0.2), {}).agrees);
}

TEST_CASE(
    "comparison of answers: a stop from which the mass goes on at once may be a grazing, a slip may not be lost",
    "[scenarios][verification]") {
  using Event = std::tuple<double, std::string, double>;
  const auto events = [](const std::vector<Event>& list) {
    Answer result;
    result.result["events"] = nullptr;
    scenarios::Column t{.name = "t", .unit = "s"};
    scenarios::Column kind{.name = "kind", .kind = scenarios::CellKind::text};
    scenarios::Column x{.name = "x", .unit = "m"};
    for (const auto& [time, name, place] : list) {
      t.numbers.push_back(time);
      kind.texts.push_back(name);
      x.numbers.push_back(place);
    }
    result.tables.push_back({.name = "events", .columns = {t, kind, x}, .key = "events"});
    return result;
  };
  const auto agree = [&](const std::vector<Event>& a, const std::vector<Event>& b) {
    return scenarios::compare_answers(events(a), events(b), {}).agrees &&
           scenarios::compare_answers(events(b), events(a), {}).agrees;
  };
  const Event first = {0.0, "reversal", -1.0};
  const Event last = {10.0, "reversal", 1.0};
  CHECK(agree({first, last}, {first, {4.0, "stop", 0.5}, {4.00001, "release", 0.5}, last}));
  CHECK(agree({first, {4.0, "grazing", 0.5}, last},
              {first, {4.0, "reversal", 0.5}, {4.00001, "reversal", 0.5}, last}));
  // It rests too long, or goes back.
  CHECK_FALSE(agree({first, last}, {first, {4.0, "stop", 0.5}, {4.001, "release", 0.5}, last}));
  CHECK_FALSE(agree({first, {10.0, "reversal", -2.0}},
                    {first, {4.0, "stop", 0.5}, {4.00001, "release", 0.5}, {10.0, "reversal", -2.0}}));
  // A slip of rounding, and one that counts.
  const Event stop = {4.0, "stop", 0.5};
  const Event release = {8.0, "release", 0.5};
  CHECK(agree({first, stop, release, last},
              {first, stop, {5.0, "release", 0.5}, {5.1, "stop", 0.5 + 1e-12}, release, last}));
  CHECK_FALSE(agree({first, stop, release, last},
                    {first, stop, {5.0, "release", 0.5}, {5.1, "stop", 0.5 + 1e-7}, release, last}));
}
