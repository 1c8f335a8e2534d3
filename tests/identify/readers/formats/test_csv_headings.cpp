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

TEST_CASE("headings: a first row of numbers is no header, whatever the columns are called") {
  const ReadOptions numbered{.columns = {{"t", "1"}, {"x", "2"}}, .name = "data.csv"};
  std::string rows;
  for (int i = 0; i < 20; ++i) rows += std::to_string(i) + "," + std::to_string(40 + i) + "\n";
  for (const std::string above : {"", "# t,x\n# s,mm\n"}) {
    CAPTURE(above);
    CHECK(mentions(refusal([&] { (void)identify::parse_record(above + rows, numbered); }),
                   "the first row holds numbers instead of the names of the columns"));
    CHECK(mentions(refusal([&] { (void)identify::parse_signal(above + rows, "x", numbered); }),
                   "the first row holds numbers"));
  }
  ReadOptions told = numbered;
  told.no_header = true;
  CHECK(identify::parse_record(rows, told).record.histories.at(0).x.size() == 20);
}

TEST_CASE("headings: a number that is the heading of another column is refused") {
  std::string text = "t,1,2\n";
  for (int i = 0; i < 20; ++i) text += std::to_string(i) + "," + std::to_string(40 + i) + ",7\n";
  const ReadOptions second{.columns = {{"x", "2"}}, .name = "data.csv"};
  CHECK(mentions(refusal([&] { (void)identify::parse_record(text, second); }),
                 "'2' is the heading of a column and the number of another one"));
}

TEST_CASE("headings: the end of x_in and x_m may be no unit") {
  const auto told = [](const std::string& heading, const ReadOptions& options = {}) {
    return read(heading, options).warnings;
  };
  REQUIRE(told("x_in").size() == 1);
  CHECK(mentions(told("x_in")[0], "the end of 'x_in' is read as the unit of column x, inches"));
  CHECK(mentions(told("x_m").at(0), "the end of 'x_m' is read as the unit of column x, metres"));
  CHECK(told("x_mm").empty());
  CHECK(told("x in mm").empty());
  std::string text = "t [s],x_in,x_out\n";
  for (int i = 0; i < 20; ++i) text += std::to_string(i) + "," + std::to_string(40 + i) + ",7\n";
  ReadOptions options{.name = "data.csv"};
  CHECK(mentions(refusal([&] { (void)identify::parse_record(text, options); }), "may mean inches or an input"));
  options.columns = {{"x", "x_out"}};
  CHECK(refusal([&] { (void)identify::parse_record(text, options); }) != "accepted");  // x_out is constant
  options.columns.clear();
  options.units = {{"x", "mm"}};
  CHECK(first(identify::parse_record(text, options)) == Approx(0.04));
}

TEST_CASE("headings: a header below a thousand lines is found") {
  std::string text;
  for (int i = 0; i < 1000; ++i) text += "Channel " + std::to_string(i) + ": sensor info\n";
  text += "t [s],x [mm]\n";
  for (int i = 0; i < 20; ++i) text += std::to_string(i) + "," + std::to_string(40 + i) + "\n";
  CHECK(first(identify::parse_record(text, "data.csv")) == Approx(0.04));
  std::string above;
  for (int i = 0; i < 10; ++i) above += text.substr(0, text.find("t [s]"));
  CHECK(mentions(refusal([&] { (void)identify::parse_record(above + text, "data.csv"); }),
                 "and no other header in the first 10000 lines of the file"));
}

TEST_CASE("headings: a title that a spreadsheet fills with separators is no header") {
  const std::string rows = "1,2;3,678;ok\n1,9;9,558;ok\n2,6;15,36;ok\n3,3;21,16;ok\n";
  for (const auto& [Y, x] : {std::pair{"Erregung", "Weg"}, {"Erregung in mm", "Weg in mm"}, {"1", "2"}})
    for (const char* title : {"Messung vom 12.03.2026;;\n", "Messung;;\nOrt;Halle 2;\n"}) {
      CAPTURE(Y, title);
      const std::string text = std::string(title) + "Erregung in mm;Weg in mm;Kommentar\n" + rows;
      const ReadOptions options{.columns = {{"Y", Y}, {"x", x}}, .decimal = ','};
      CHECK(identify::parse_record(text, options).record.pairs->pairs.at(0).x == Approx(3.678e-3).epsilon(1e-12));
    }
  // With numbers alone below, the title may not take the place of the header either.
  const MeasuredRecord bare = identify::parse_record(
      "Messung;\nErregung in mm;Weg in mm\n1.2;3.6\n1.9;9.5\n2.6;15.3\n", {.columns = {{"Y", "1"}, {"x", "2"}}});
  CHECK(bare.record.pairs->pairs.at(0).x == Approx(3.6e-3).epsilon(1e-12));
}
