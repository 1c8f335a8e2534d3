#include "identify/readers/record_reader.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <string>

#include "core/diagnostics.hpp"
#include "identify/methods.hpp"
#include "tests/identify/readers/data_files.hpp"
#include "tests/identify/readers/refusals.hpp"

using namespace dualdamp;
using identify::MeasuredRecord;
using identify::parse_record;

namespace {

/// The problems of a text that must be refused.
std::vector<core::Diagnostic> problems(const std::string& text) {
  try {
    (void)parse_record(text, "data.csv");
  } catch (const core::InputError& error) {
    return error.diagnostics();
  }
  FAIL("accepted: " << text);
  return {};
}

/// The only problem, at a line and column, with words in its message.
core::Diagnostic only_problem(const std::string& text, int line, int column, const std::string& words) {
  const auto all = problems(text);
  REQUIRE(all.size() == 1);
  INFO(core::format(all[0]));
  CHECK(all[0].place.file == "data.csv");
  CHECK(all[0].place.line == line);
  CHECK(all[0].place.column == column);
  CHECK(all[0].message.find(words) != std::string::npos);
  return all[0];
}

}  // namespace

TEST_CASE("Pairs with units, and without") {
  const MeasuredRecord csv = parse_record("Y [mm],x [mm],sweep\n4.452,5.117,up 1\n5.027,7.143,up 1\n", "data.csv");
  CHECK(csv.warnings.empty());
  CHECK_FALSE(csv.record.decay.has_value());
  REQUIRE(csv.record.pairs.has_value());
  REQUIRE(csv.record.pairs->pairs.size() == 2);
  const identify::Pair& second = csv.record.pairs->pairs[1];
  CHECK(second.Y == Approx(5.027e-3).epsilon(1e-15));
  CHECK(second.x == Approx(7.143e-3).epsilon(1e-15));
  CHECK(second.sweep == "up 1");
  CHECK(second.number == 2);
  // Without units: SI, to the bit; the order of columns is free and `position` is x.
  const MeasuredRecord si = parse_record("position,Y\n0.186078,0.1\n0.436118,0.2", "data.csv");
  CHECK(si.record.pairs->pairs[0].x == 0.186078);
  CHECK(si.record.pairs->pairs[1].Y == 0.2);
}

TEST_CASE("Extremes of a free decay") {
  const MeasuredRecord csv =
      parse_record("time [ms];x [mm]\n0;13.6\n48.7;-9.1\n97.4;5.6\n146.1;-2.9\n", "data.csv");
  CHECK_FALSE(csv.record.pairs.has_value());
  REQUIRE(csv.record.decay.has_value());
  CHECK(csv.record.decay->extremes.size() == 4);
  CHECK(csv.record.decay->extremes[1] == Approx(-9.1e-3).epsilon(1e-15));
  CHECK(csv.record.decay->times[3] == Approx(0.1461).epsilon(1e-15));
  const MeasuredRecord alone = parse_record("x\n1\n-0.8\n", "data.csv");
  CHECK(alone.record.decay->extremes == std::vector<double>{1.0, -0.8});
  CHECK(alone.record.decay->times.empty());
}

TEST_CASE("What spreadsheets and instruments write around the data") {
  const std::string wanted = "Y,x\n0.1,0.2\n0.3,0.4\n";
  const auto reads_alike = [&](const std::string& text) {
    CAPTURE(text);
    const MeasuredRecord a = parse_record(wanted, "a");
    const MeasuredRecord b = parse_record(text, "b");
    REQUIRE(b.warnings.size() == 1);
    CHECK(b.warnings[0].starts_with("no unit is stated for "));
    REQUIRE(b.record.pairs->pairs.size() == a.record.pairs->pairs.size());
    for (std::size_t i = 0; i < 2; ++i) {
      CHECK(a.record.pairs->pairs[i].Y == b.record.pairs->pairs[i].Y);
      CHECK(a.record.pairs->pairs[i].x == b.record.pairs->pairs[i].x);
    }
  };
  reads_alike("\xEF\xBB\xBFY,x\n0.1,0.2\n0.3,0.4\n");
  reads_alike("Y,x\r\n0.1,0.2\r\n0.3,0.4\r\n");
  reads_alike("Y\tx\n0.1\t0.2\n0.3\t0.4");
  reads_alike("Y;x\n0.1;0.2\n0.3;0.4\n\n  \n\r\n");
  reads_alike("# written by a recorder\n\n# channel 1, channel 2\nY,x\n0.1,0.2\n0.3,0.4\n");
  reads_alike(" Y , x [ m ] \n 0.1 ,0.2\t\n0.3, 0.4\n");
  reads_alike("\"Y [m]\",\"x\"\n\"0.1\",0.2\n0.3,\"0.4\" \n");
  reads_alike("Y,x\n+0.1,.2\n3e-1,+4.0E-01\n");
  reads_alike("Y,x\n0.10,00.2\n.3,0.4\n");
}

TEST_CASE(
    "A column of the uncertainty of each reading is ignored, and the warning tells how to state one for all") {
  const auto warning = [](const std::string& heading) {
    return parse_record("Y [mm],x [mm]," + heading + "\n4,9,0.02\n5,12,0.03\n6,16,0.03\n", "data.csv")
        .warnings.at(0);
  };
  for (const std::string heading :
       {"u_x [mm]", "x_err [mm]", "u(x) [mm]", "sigma_x_mm", "x std", "uncertainty of x", "position_sd"}) {
    CAPTURE(heading);
    CHECK(warning(heading).starts_with("column '" + heading + "' is not known and is ignored"));
    const bool told = warning(heading).find(
                          "if it holds the uncertainty of each x, state one for all of them, such as "
                          "its median: sigma_x: ...") != std::string::npos;
    CHECK(told);
  }
  CHECK(warning("u_Y [mm]").find("readings are weighed by their scatter instead") != std::string::npos);
  for (const std::string heading : {"x_set [mm]", "u [mm]", "error", "temperature [K]", "u_z [mm]"})
    CHECK(warning(heading) == "column '" + heading + "' is not known and is ignored");
}

TEST_CASE("Columns that are not known or not used are ignored with a warning") {
  const MeasuredRecord csv =
      parse_record("Y,temperature [K],x,t,\"a \"\"b\"\", c\"\n1,warm,2,0,\n2,hot,5,0,-\n", "data.csv");
  REQUIRE(csv.warnings.size() == 4);
  CHECK(csv.warnings[0] == "column 'temperature [K]' is not known and is ignored");
  CHECK(csv.warnings[1] == "column 'a \"b\", c' is not known and is ignored");
  CHECK(csv.warnings[2] ==
        "no unit is stated for Y, x and t: read Y in m, x in m and t in s; state another one as units: {t: UNIT}");
  CHECK(csv.warnings[3] == "column t is not used");
  CHECK(csv.record.pairs->pairs[1].x == 5.0);
}

TEST_CASE("Many columns that are not known are ignored with one warning, but uncertainties are told apart") {
  std::string header = "Y,x,u_x";
  std::string row = "1,2,3";
  for (int i = 0; i < 40; ++i) {
    header += ",T" + std::to_string(i);
    row += ",7";
  }
  const MeasuredRecord csv = parse_record(header + "\n" + row + "\n" + row + "\n", "data.csv");
  REQUIRE(csv.ignored.size() == 2);
  CHECK(csv.ignored[0].starts_with("column 'u_x' is not known and is ignored; if it holds the uncertainty"));
  CHECK(csv.ignored[1] == "40 columns are not known and are ignored: 'T0', 'T1', 'T2', 'T3', 'T4' and 35 more");
  CHECK(std::ranges::find(csv.warnings, csv.ignored[1]) != csv.warnings.end());
}

TEST_CASE("Faults of the header") {
  CHECK(only_problem("Y,X\n1,2\n", 1, 1, "no column x").found == "Y,X");
  CHECK(only_problem("time,Y\n1,2\n", 1, 1, "no column x").allowed.find("Y and x") != std::string::npos);
  CHECK(only_problem("Y,x, position\n1,2,3\n", 1, 6, "twice").found == "position");
  only_problem("Y,x [mm\n1,2\n", 1, 3, "square brackets");
  only_problem("Y,x [mm] peak\n1,2\n", 1, 3, "square brackets");
  only_problem("Y,x,sweep [m]\n1,2,3\n", 1, 5, "a label");
  CHECK(only_problem("Y,x,phase\n1,2,90\n", 1, 5, "an angle needs its unit").found == "phase");
  only_problem("frequency [Hz],x,phase [deg]\n5,1,60\n6,2,90\n", 0, 0, "no column Y");
  const core::Diagnostic dimension = only_problem("Y,x [kg]\n1,2\n", 1, 3, "the unit of column x");
  CHECK_FALSE(dimension.allowed.empty());
  CHECK(dimension.found == "x [kg]");
  CHECK(dimension.place.text == "Y,x [kg]");
  only_problem("Y,x [furlongs per]\n1,2\n", 1, 3, "the unit of column x");
  // A known column that is not used must still make sense.
  only_problem("Y,x,v [mm]\n1,2,3\n", 1, 5, "the unit of column v");
  only_problem("\"Y,x\n1,2\n", 1, 1, "quote");
}

TEST_CASE("Faults of the data, several at once") {
  CHECK(only_problem("Y,x\n1,2\n3\n", 3, 1, "as many fields").found == "1 fields");
  CHECK(only_problem("Y,x\n1,2,3\n4,5\n", 2, 1, "as many fields").allowed == "2 fields");
  for (const char* word : {"nan", "NaN", "inf", "-inf", "infinity", "1e999", "+nan"})
    only_problem(std::string("Y,x\n1,") + word + "\n", 2, 3, "is not a finite number");
  CHECK(only_problem("Y,x\n1,nan\n", 2, 3, "is not a finite number").allowed.find("leave out rows") !=
        std::string::npos);
  for (const char* word : {"", "one", "1.0.0", "0x1p3", "--1", "+-1", "1e", "1 2", "1_000", "\xC2\xB5"})
    only_problem(std::string("Y,x\n1,") + word + "\n", 2, 3, "is not a number");
  only_problem("Y,x\n1,-2\n", 2, 3, "negative");
  only_problem("x,t\n1,0.1\n-1,0.1\n", 3, 4, "does not increase");
  only_problem("Y,x\n1,\"2\n", 2, 3, "quote");
  // A scale may leave the range of double precision though the number does not.
  only_problem("Y [Ym],x\n1e300,2\n", 2, 1, "is not a finite number");

  const auto several = problems("Y,x [mm]\n1,two\n3\n-4,nan\n");
  REQUIRE(several.size() == 3);
  CHECK(several[0].place.line == 2);
  CHECK(several[1].place.line == 3);
  CHECK(several[2].place.line == 4);
  CHECK(several[2].place.column == 4);

  // A decimal comma is refused, whatever the separator: 1,234 is two numbers to two readers.
  CHECK(only_problem("Y;x\n0,1;2\n", 2, 1, "is not a number").allowed.find("point") != std::string::npos);
  CHECK(only_problem("Y,x\n4,50,5,36\n", 2, 1, "as many fields").allowed.find("point") != std::string::npos);
}

TEST_CASE("Rows that a spreadsheet left empty at the end are no rows") {
  for (const char* end : {"\r\n;;\r\n;;\r\n", "\n;;", "\n ; ;\n\n;;\n"}) {
    const MeasuredRecord csv = parse_record("Y;x;\n4;5;\n5;8;" + std::string(end), "data.csv");
    REQUIRE(csv.record.pairs->pairs.size() == 2);
    CHECK(csv.record.pairs->pairs[1].x == 8.0);
  }
  only_problem("Y,x\n,\n,\n", 1, 0, "no data");
  // Between the others they are left out, with a warning; a last row with anything in it is a row.
  const MeasuredRecord hole = parse_record("Y [m],x [m]\n1,2\n,\n\n3,4\n", "data.csv");
  CHECK(hole.record.pairs->pairs.size() == 2);
  CHECK(hole.warnings == std::vector<std::string>{"1 row of empty fields between the others is left out"});
  CHECK(only_problem("Y,x\n1,2\n3,\n", 3, 3, "is not a number").found == "an empty field");
}

TEST_CASE("The same fault of many rows is one problem") {
  std::string text = "Y,x\n";
  for (int i = 0; i < 1000; ++i) text += "a,b\n";
  const auto all = problems(text);
  REQUIRE(all.size() == 1);
  CHECK(all[0].place.line == 2);
  CHECK(all[0].message ==
        "the field of column Y is not a number; the same in 999 more rows (lines 3, 4, 5, 6, 7, ...)");
  const auto negative = problems("Y,x\n1,-2\n2,-3\n3,4\n4,-5\n");
  REQUIRE(negative.size() == 1);
  CHECK(negative[0].message == "the amplitude of column x is negative; the same in 2 more rows (lines 3, 5)");
}

TEST_CASE("Texts without data") {
  only_problem("", 0, 0, "no header");
  only_problem("\n\n# nothing\n", 0, 0, "no header");
  only_problem("\xEF\xBB\xBF", 0, 0, "no header");
  only_problem("Y,x\n", 1, 0, "no data");
  only_problem("Y,x\n\n\r\n", 1, 0, "no data");
}

TEST_CASE("Bytes that are not text") {
  only_problem(std::string("Y,x\n1,\0 2\n", 11), 2, 3, "control character");
  only_problem("\xFF\xFEY", 0, 0, "not valid UTF-16");
  // What is no UTF-8 is Windows-1252, whose letters are no numbers: a surrogate, an overlong form, one cut off.
  for (const char* bytes : {"\xED\xA0\x80", "\xC0\xAF", "\xF5\x80\x80\x80", "2\xC3"})
    only_problem(std::string("Y,x\n1,") + bytes, 2, 3, "is not a number");
  only_problem("Y,x\n\x01,\xB5\n", 2, 1, "control character");
  const MeasuredRecord western = parse_record("Y [m],x [\xB5m]\n1,2\n", "data.csv");
  CHECK(western.record.pairs->pairs[0].x == Approx(2e-6).epsilon(1e-15));
  REQUIRE(western.warnings.size() == 1);
  CHECK(western.warnings[0].find("is read as Windows-1252 (Latin-1); the first such letter is in line 1") !=
        std::string::npos);
  // Well-formed text in other scripts is text.
  const MeasuredRecord csv =
      parse_record("Y,x [\xC2\xB5m],\xE6\xB8\xA9\xE5\xBA\xA6\n1,2,\xF0\x9F\x98\x80\n", "data.csv");
  CHECK(csv.record.pairs->pairs[0].x == Approx(2e-6).epsilon(1e-15));
}

TEST_CASE("Messages do not quote more than a line of text") {
  const std::string longest(100'000, 'z');
  const auto all = problems("Y,x\n1," + longest + "\n");
  CHECK(all[0].place.text.size() <= 200);
  CHECK(all[0].found.size() <= 210);
  // Cut between characters: what is quoted stays UTF-8.
  std::string wide = "a";
  for (int i = 0; i < 300; ++i) wide += "\xC2\xB5";
  const auto cut = problems("Y,x\n1," + wide + "\n");
  CHECK((static_cast<unsigned char>(cut[0].found[cut[0].found.size() - 2]) == 0xB5));
  std::string header = "Y,x";
  for (int i = 0; i < 2000; ++i) header += ",u" + std::to_string(i);
  only_problem(header + "\n", 1, 1, "more than 1000 fields");
}

TEST_CASE("Files") {
  const std::string path = "test_csv_reader_data.csv";
  {
    std::ofstream file(path, std::ios::binary);
    file << "Y [mm],x [mm]\n";
    for (int i = 1; i <= 200'000; ++i) file << 1.0 + 1e-5 * i << ',' << 2.0 + 5e-5 * i << '\n';
  }
  const MeasuredRecord csv = identify::read_record(path);
  CHECK(csv.record.pairs->pairs.size() == 200'000);
  CHECK(csv.record.pairs->pairs.back().number == 200'000);
  std::remove(path.c_str());
  const auto refused = [](const std::string& name, const std::string& words) {
    try {
      (void)identify::read_record(name);
      FAIL("read " << name);
    } catch (const core::InputError& error) {
      REQUIRE(error.diagnostics().size() == 1);
      CHECK(error.diagnostics()[0].place.file == name);
      CHECK(error.diagnostics()[0].message.find(words) != std::string::npos);
    }
  };
  refused("no/such/file.csv", "cannot be opened");
  refused("/", "cannot be read");
}

TEST_CASE("A column f is a frequency in hertz or a force in newtons, and nothing without a unit") {
  for (const char* heading : {"f_Hz", "f [Hz]", "F (Hz)", "freq / Hz", "Freq [Hz]"}) {
    CAPTURE(heading);
    const auto read = parse_record(std::string(heading) + ",Y_mm,x_mm\n5,1,2\n6,1,3\n", "data.csv").record;
    REQUIRE(read.pairs);
    CHECK(read.pairs->pairs.at(0).omega == Approx(2.0 * 3.14159265358979 * 5.0));
  }
  for (const char* heading : {"F [N]", "f_N", "F (kN)"}) {
    CAPTURE(heading);
    std::string text = std::string("t_s,x_mm,") + heading + "\n";
    for (int i = 0; i < 40; ++i)
      text += std::to_string(0.01 * i) + "," + std::to_string(std::sin(0.3 * i)) + (i % 2 == 0 ? ",1\n" : ",2\n");
    const auto read = parse_record(text, "data.csv").record;
    REQUIRE(read.histories.size() == 1);
    CHECK(read.histories[0].force.at(5) == Approx(text.find("kN") == std::string::npos ? 2.0 : 2000.0));
  }
  for (const char* heading : {"f", "freq", "f [mm]"}) {
    CAPTURE(heading);
    const auto read = parse_record(std::string(heading) + ",Y_mm,x_mm\n5,1,2\n6,1,3\n", "data.csv");
    CHECK(std::isnan(read.record.pairs->pairs.at(0).omega));
    REQUIRE_FALSE(read.warnings.empty());
    CHECK(read.warnings[0].find("is not known and is ignored") != std::string::npos);
  }
}

TEST_CASE("The caller may name a column by the words before its unit") {
  const auto first_of = [](const std::string& header, const std::string& called) {
    std::string text = header + "\n";
    for (int i = 0; i < 20; ++i)
      text += std::to_string(i) + ";" + std::to_string(40 + i) +
              (std::count(header.begin(), std::find(header.begin(), header.end(), '\n'), ';') > 1 ? ";1\n" : "\n");
    return identify::read_record(identify::testing::TemporaryFile("named.csv", text).path(),
                                 {.columns = {{"x", called}, {"t", "Zeit"}}})
        .record.histories.at(0)
        .x.at(0);
  };
  for (const char* heading : {"Weg in mm", "Weg [mm]", "Weg (mm)", "Weg/mm", "Weg / mm", "Weg_mm", "Weg_[mm]",
                              "Weg, mm", "Weg [in mm]"}) {
    CAPTURE(heading);
    CHECK(first_of("Zeit in s;" + std::string(heading), "Weg") == Approx(0.04).epsilon(1e-12));
    CHECK(first_of("Zeit in s;" + std::string(heading), heading) == Approx(0.04).epsilon(1e-12));
  }
  CHECK(first_of("Zeit;Weg\ns;mm", "Weg") == Approx(0.04).epsilon(1e-12));
  CHECK(first_of("Zeit;Weg A\ns;mm", "Weg A") == Approx(0.04).epsilon(1e-12));
  CHECK(first_of("Zeit in s;Weg in mm;Weg", "Weg in mm") == Approx(0.04).epsilon(1e-12));
  const auto refused = [&](const std::string& header, const std::string& called) {
    return identify::testing::refusal([&] { (void)first_of(header, called); });
  };
  CHECK(
      identify::testing::mentions(refused("Zeit;Weg A in mm", "Weg"), "there is no column 'Weg' to be used as x"));
  CHECK(identify::testing::mentions(refused("Zeit;Weg in mm;Weg_mm", "Weg"), "there are several columns 'Weg'"));
}
