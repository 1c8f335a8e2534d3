#include <catch2/catch.hpp>
#include <string>

#include "identify/readers/brackets.hpp"
#include "identify/readers/record_reader.hpp"
#include "tests/identify/readers/refusals.hpp"

using namespace dualdamp;
using identify::MeasuredRecord;
using identify::ReadOptions;
using identify::testing::mentions;
using identify::testing::refusal;

namespace {

/// A record of 20 samples whose second column has this heading; `below`: the row of units.
MeasuredRecord read(const std::string& heading, ReadOptions options = {}, const std::string& below = {}) {
  options.name = "data.csv";
  std::string text = "t [s];" + heading + "\n" + below;
  for (int i = 0; i < 20; ++i) text += std::to_string(i) + ";" + std::to_string(40 + i) + "\n";
  return identify::parse_record(text, options);
}

double first(const MeasuredRecord& read) { return read.record.histories.at(0).x.at(0); }

ReadOptions called(const std::string& name) { return {.columns = {{"x", name}}}; }

}  // namespace

TEST_CASE("headings: brackets within brackets belong to the outer ones, and an open one is told") {
  const identify::Brackets nested = identify::brackets_of("Weg (LVDT (2)) [ mm ]");
  REQUIRE(nested.pairs.size() == 2);
  CHECK(nested.pairs[0].content == "LVDT (2)");
  CHECK(nested.pairs[1].content == "mm");
  CHECK(nested.are_closed);
  CHECK_FALSE(identify::brackets_of("x [mm] (2").are_closed);
  CHECK_FALSE(identify::brackets_of("x mm]").are_closed);
  CHECK(identify::brackets_of("x").pairs.empty());
}

TEST_CASE("headings: of several brackets the one with a unit of the column states it, and the others are words") {
  for (const char* heading : {"x (LVDT 2) [mm]", "x (ch 2) [mm]",
                              "x (s) [mm]",      "x (g) [mm]",
                              "x(t) [mm]",       "X (LVDT 2) [mm]",
                              "x <b> [mm]",      "x {fett} [mm]",
                              "x [mm] (raw)",    "x [mm] [2]",
                              "x [2] [mm]",      "x (mm) (raw)",
                              "x (raw) (mm)",    "x (LVDT (2)) [mm]",
                              "x (mm) [mm]",     "x (Kanal 2) in mm",
                              "x_mm (LVDT 2)",   "x (mm)",
                              "x {mm}",          "x <mm>"}) {
    CAPTURE(heading);
    const MeasuredRecord record = read(heading);
    CHECK(first(record) == Approx(0.04).epsilon(1e-12));
    CHECK(record.warnings.empty());
  }
  for (const char* heading : {"Weg (Kanal 2) in mm", "Weg (s) [mm]", "Weg (LVDT 2) [mm]", "Weg_mm (LVDT 2)",
                              "Weg in mm (roh)", "Weg [mm] (roh)"}) {
    CAPTURE(heading);
    const std::string text(heading);
    CHECK(first(read(text, called("Weg"))) == Approx(0.04).epsilon(1e-12));
    CHECK(first(read(text, called(text))) == Approx(0.04).epsilon(1e-12));
    CHECK(first(read(text, called("2"))) == Approx(0.04).epsilon(1e-12));
  }
  CHECK(first(read("Weg (LVDT 2) [mm]", called("Weg (LVDT 2)"))) == Approx(0.04).epsilon(1e-12));
  CHECK(first(read("<b>Weg</b> [mm]", called("<b>Weg</b>"))) == Approx(0.04).epsilon(1e-12));
}

TEST_CASE("headings: two units of one dimension are refused, unless the caller states one") {
  for (const auto& [heading, unit] :
       {std::pair{"Weg (m) [mm]", "m"}, {"Weg (in) [mm]", "in"}, {"Weg [m] [mm]", "m"}, {"Weg (m) in mm", "m"}}) {
    CAPTURE(heading);
    const std::string text = refusal([&] { (void)read(heading, called("Weg")); });
    CHECK(mentions(text, "states two units"));
    CHECK(mentions(text, "'" + std::string(unit) + "' and 'mm'"));
    ReadOptions told = called("Weg");
    told.units = {{"x", "mm"}};
    CHECK(first(read(heading, told)) == Approx(0.04).epsilon(1e-12));
  }
  CHECK(first(read("x (mm) [millimeter]")) == Approx(0.04).epsilon(1e-12));
}

TEST_CASE("headings: words in brackets need a unit from elsewhere, and may be a signal that is scaled") {
  CHECK(mentions(refusal([] { (void)read("x (LVDT 2)"); }), "'LVDT 2' is not a unit"));
  CHECK(mentions(refusal([] { (void)read("x [mmm]"); }), "'mmm' is not known"));
  const MeasuredRecord told = read("x (LVDT 2)", {.units = {{"x", "mm"}}});
  CHECK(first(told) == Approx(0.04).epsilon(1e-12));
  CHECK(told.warnings.empty());
  CHECK(first(read("x (LVDT 2)", {}, "s;mm\n")) == Approx(0.04).epsilon(1e-12));
  for (const char* heading : {"x (LVDT 2) [V]", "x (V) (LVDT 2)", "x [V] (2)", "x (V)"}) {
    CAPTURE(heading);
    CHECK(first(read(heading, {.scales = {{"x", "1 mm/V"}}})) == Approx(0.04).epsilon(1e-12));
  }
  CHECK(mentions(refusal([] { (void)read("x [mm] peak"); }), "words behind its square brackets"));
}
