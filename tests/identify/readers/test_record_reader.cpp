#include "identify/readers/record_reader.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include "core/diagnostics.hpp"
#include "core/provenance.hpp"
#include "tests/identify/readers/data_files.hpp"
#include "tests/identify/readers/refusals.hpp"

using namespace dualdamp;
using namespace dualdamp::identify::testing;
using identify::History;
using identify::MeasuredRecord;
using identify::parse_record;
using identify::read_record;
using identify::ReadOptions;

namespace {

std::string refusal_of(const std::string& text, const ReadOptions& options = {}) {
  return refusal([&] { return parse_record(text, options); });
}

/// `count` rows "t,x" at `rate`, times printed by `format`.
std::string history_text(int count, double rate, const char* format, const std::string& sweep = "") {
  std::string text;
  for (int i = 0; i < count; ++i)
    text += print(format, i / rate) + "," + std::to_string(i % 7) + (sweep.empty() ? "" : "," + sweep) + "\n";
  return text;
}

}  // namespace

TEST_CASE("Signals over time make a history") {
  std::string text = "force [N];t [ms];x [mm];acceleration [m/s^2]\n";
  for (int i = 0; i < 20; ++i) text += print("%d;%d;%d;%d\n", 7 + i % 2, 5 + 2 * i, i, -1 - i % 2);
  const MeasuredRecord file = parse_record(text, "data.csv");
  CHECK(file.warnings.empty());
  CHECK(file.sha256 == core::sha256(text));
  CHECK_FALSE(file.record.pairs.has_value());
  CHECK_FALSE(file.record.decay.has_value());
  REQUIRE(file.record.histories.size() == 1);
  const History& history = file.record.histories.front();
  CHECK(history.start == Approx(5e-3).epsilon(1e-15));
  CHECK(history.sample_rate == Approx(500.0).epsilon(1e-14));
  REQUIRE(history.x.size() == 20);
  CHECK(history.x[3] == Approx(3e-3).epsilon(1e-15));
  REQUIRE(history.a.size() == 20);
  CHECK(history.a[2] == -1.0);
  CHECK(history.a[3] == -2.0);
  REQUIRE(history.force.size() == 20);
  CHECK(history.force[2] == 7.0);
  CHECK(history.force[3] == 8.0);
  CHECK(history.y.empty());
  CHECK(history.v.empty());
}

TEST_CASE("A label for each test splits a file into histories") {
  const std::string text =
      "t,x,sweep\n" + history_text(20, 100.0, "%.2f", "up") + history_text(30, 50.0, "%.2f", "down");
  const auto histories = parse_record(text, "data.csv").record.histories;
  REQUIRE(histories.size() == 2);
  CHECK(histories[0].sweep == "up");
  CHECK(histories[0].x.size() == 20);
  CHECK(histories[0].sample_rate == Approx(100.0).epsilon(1e-14));
  CHECK(histories[1].sweep == "down");
  CHECK(histories[1].x.size() == 30);
  CHECK(histories[1].sample_rate == Approx(50.0).epsilon(1e-14));
  CHECK(mentions(refusal_of(text + history_text(20, 100.0, "%.2f", "up")), "are not together"));
  // Without labels a test begins where the time does, or where the header stands again.
  for (const char* between : {"", "t [s],x [mm]\n"}) {
    CAPTURE(between);
    const MeasuredRecord two = parse_record(
        "t [s],x [mm]\n" + history_text(20, 9.0, "%.3f") + between + history_text(30, 9.0, "%.3f"), "two");
    REQUIRE(two.record.histories.size() == 2);
    CHECK(two.record.histories[0].sweep == "1");
    CHECK(two.record.histories[1].x.size() == 30);
    REQUIRE(two.warnings.size() == 1);
    CHECK(mentions(two.warnings[0], "the file is read as 2 tests, labelled 1 to 2"));
  }
}

TEST_CASE("Rows that turn back are extremes, rows that do not are samples") {
  // A wave of 20 samples a period turns back at two rows in ten.
  std::string wave = "t,x\n";
  for (int i = 0; i < 40; ++i) wave += print("%.2f,%.6f\n", 0.01 * i, std::cos(0.1 * M_PI * i));
  CHECK(parse_record(wave, "w").record.histories.size() == 1);
  std::string decay = "t,x\n";
  for (int i = 0; i < 40; ++i) decay += print("%.2f,%.6f\n", 0.01 * i, (i % 2 == 0 ? 1 : -1) * (1.0 - 0.02 * i));
  CHECK(parse_record(decay, "d").record.decay.has_value());
  // The last of seven rows is noise, or the fourth is missing: the methods say which row does not lie across.
  const std::string noisy = "t,x\n0,6\n1,-5\n2,4\n3,-3\n4,2\n5,-0.3\n6,-0.4\n";
  CHECK(parse_record(noisy, "n").record.decay.has_value());
  const std::string lacking = "t,x\n0,9\n1,-8\n2,7\n4,5\n5,-4\n6,3\n7,-2\n8,1\n9,-0.5\n10,0.3\n11,-0.2\n12,0.1\n";
  CHECK(parse_record(lacking, "l").record.decay.has_value());
}

TEST_CASE("Times as instruments print them are evenly spaced") {
  // Rounding to the last printed digit moves a time by half a unit of it, at most; the digits of %.6g grow coarser
  // as the time grows, and 1/1024 s has no short decimal form.
  for (const char* format : {"%.4f", "%.6f", "%.5e", "%.17g", "%.6g"}) {
    CAPTURE(format);
    const auto record = parse_record("t,x\n" + history_text(5000, 1024.0, format), "data.csv").record;
    REQUIRE(record.histories.size() == 1);
    CHECK(record.histories[0].x.size() == 5000);
    // Both ends are off by 5e-5 s at most: relative to 4.88 s, 2e-5.
    CHECK(record.histories[0].sample_rate == Approx(1024.0).epsilon(2.1e-5));
  }
  // 5 % of jitter printed with all digits is no rounding: the samples, smooth without it, are even.
  std::string text = "t [s],x [mm]\n";
  for (int i = 0; i < 50; ++i) text += print("%.9f,%d\n", 1e-3 * (i + (i % 3 == 1 ? 0.05 : 0.0)), i);
  const MeasuredRecord jittered = parse_record(text, "data.csv");
  REQUIRE(jittered.warnings.size() == 1);
  CHECK(mentions(jittered.warnings[0], "the time stamps jitter (steps from 0.00095 s to 0.00105 s)"));
  CHECK(jittered.record.histories.at(0).x[7] == Approx(7e-3).epsilon(1e-15));
}

TEST_CASE("The rate of even samples is that of all their stamps, however coarse these are") {
  // Stamps at the ends are off by a step of the clock or a burst: by them the rate would be off by 2e-3 and 1e-4.
  const auto rate_of = [](const char* format, auto stamp) {
    std::string text = "t [s],x [mm]\n";
    for (int i = 0; i < 1250; ++i) text += print(format, stamp(i)) + print(",%.6f\n", std::cos(0.05 * i));
    return parse_record(text, "data.csv").record.histories.at(0).sample_rate;
  };
  constexpr double exact = 50.0;
  CHECK(rate_of("%.1f", [](int i) { return 0.1 * std::floor(0.2 * i + 0.5); }) == Approx(exact).epsilon(1e-5));
  CHECK(rate_of("%.0f", [](int i) { return std::floor(0.02 * i); }) == Approx(exact).epsilon(5e-5));
  CHECK(rate_of("%.2f", [](int i) { return 0.06 * (i / 3 + 1); }) == Approx(exact).epsilon(1e-5));
}

TEST_CASE("Stamps in bursts of any size are read as even samples, and refused where samples are missing") {
  const auto text_of = [](int burst, double missing) {
    std::string text = "t [s],x [mm]\n";
    for (int i = 0; i < 4000; ++i)
      text += print("%.4f,%.6f\n", 1e-3 * burst * (i / burst + 1 + (i < 2000 ? 0.0 : missing)), std::cos(0.03 * i));
    return text;
  };
  for (const int burst : {2, 10, 19, 20, 21, 32, 100}) {
    CAPTURE(burst);
    const MeasuredRecord file = parse_record(text_of(burst, 0.0), "data.csv");
    REQUIRE(file.record.histories.size() == 1);
    CHECK(file.record.histories[0].x.size() == 4000);
    CHECK(file.record.histories[0].sample_rate == Approx(1000.0).epsilon(1e-5));
    REQUIRE(file.warnings.size() == 1);
    CHECK(mentions(file.warnings[0], "the time stamps come in bursts"));
    CHECK(mentions(refusal_of(text_of(burst, 15.0)), "samples are missing between them"));
  }
}

TEST_CASE("Gaps: the uninterrupted stretch with the most motion is used, and said so") {
  const auto swing = [](int i) { return std::cos(0.1 * i); };
  std::string text = "t [s],x [m]\n";
  for (int i = 0; i < 1000; ++i)
    if ((i < 198 || i > 201) && (i < 900 || i > 904)) text += print("%.3f,%.9f\n", 1e-3 * i, swing(i));
  const MeasuredRecord file = parse_record(text, "data.csv");
  REQUIRE(file.record.histories.size() == 1);
  const History& history = file.record.histories[0];
  CHECK(history.start == Approx(0.202).epsilon(1e-12));
  REQUIRE(history.x.size() == 698);
  CHECK(history.x.front() == Approx(swing(202)).epsilon(1e-8));
  CHECK(history.x.back() == Approx(swing(899)).epsilon(1e-8));
  REQUIRE(file.warnings.size() == 1);
  CHECK(mentions(file.warnings[0],
                 "of 991 rows only the uninterrupted stretch with the most motion is used, 698 rows"));
  CHECK(
      mentions(file.warnings[0], "left out are 198 rows from t = 0 s to 0.197 s and 95 rows from t = 0.905 s to "));
  CHECK(mentions(file.warnings[0], "a label in a column sweep"));
  // Nothing but gaps.
  std::string torn = "t,x\n";
  for (int i = 0; i < 400; ++i)
    if (i % 8 != 7) torn += print("%.4f,%d\n", 1e-3 * i, i);
  CHECK(mentions(refusal_of(torn), "no stretch between them is long enough"));
}

TEST_CASE("Ramps with stops are clipped, unless the velocity or the caller says that the motion stops there") {
  const auto ramps = [](bool with_v) {
    std::string text = with_v ? "t [s],x [mm],force [N],v [mm/s]\n" : "t [s],x [mm],force [N]\n";
    for (int i = 0; i < 400; ++i) {
      const int part = i % 100;
      const double sign = i / 100 % 2 == 0 ? 1.0 : -1.0;
      text += print("%.2f", 0.01 * i) + "," + print("%.3f", sign * std::min(1.0, 0.04 * part - 1.0)) +
              print(",%.0f", sign) + (with_v ? "," + print("%.3f", part < 50 ? sign * 4.0 : 0.0) : "") + "\n";
    }
    return text;
  };
  CHECK(mentions(refusal_of(ramps(false)), "column x is clipped"));
  CHECK(parse_record(ramps(true), "data.csv").record.histories.size() == 1);
  const MeasuredRecord imposed = parse_record(ramps(false), ReadOptions{.is_imposed = true});
  CHECK(imposed.record.histories.size() == 1);
  REQUIRE(imposed.warnings.size() == 1);
  CHECK(mentions(imposed.warnings[0], "column x may be clipped"));
}

TEST_CASE("The caller names columns and units") {
  std::string text = "Zeit (s),LVDT 1 [mm],LVDT 2 [mm],x\n";
  for (int i = 0; i < 20; ++i) text += print("%.2f,%d,%d,9\n", 0.01 * i, i, 2 * i);
  ReadOptions options{.name = "data.csv"};
  options.columns = {{"t", "Zeit"}, {"y", "LVDT 1 [mm]"}, {"position", "3"}};
  const MeasuredRecord file = parse_record(text, options);
  const History& history = file.record.histories.at(0);
  CHECK(history.y[5] == Approx(5e-3).epsilon(1e-15));
  CHECK(history.x[5] == Approx(10e-3).epsilon(1e-15));
  REQUIRE(file.warnings.size() == 1);
  CHECK(mentions(file.warnings[0], "another one is used in its place"));

  options.units = {{"y", "um"}};
  const MeasuredRecord other = parse_record(text, options);
  CHECK(other.record.histories.at(0).y[5] == Approx(5e-6).epsilon(1e-15));
  CHECK(mentions(other.warnings.at(0) + other.warnings.at(1), "is read in um, not in mm"));

  const auto with = [&](std::map<std::string, std::string> columns, std::map<std::string, std::string> units) {
    return refusal_of(text, {.units = std::move(units), .columns = std::move(columns), .name = "data.csv"});
  };
  CHECK(mentions(with({{"y", "LVDT 3"}}, {}), "there is no column 'LVDT 3' to be used as y"));
  CHECK(mentions(with({{"y", "LVDT 1"}, {"v", "LVDT 1"}}, {}), "asked for twice"));
  CHECK(mentions(with({{"x", "2"}, {"position", "3"}}, {}), "asked for twice"));
  CHECK(mentions(with({{"z", "LVDT 1"}}, {}), "there is no column 'z'"));
  CHECK(mentions(with({}, {{"x", "kg"}}), "the unit of column x"));
}

TEST_CASE("Pairs with all that was read of them") {
  const auto record = parse_record(
                          "Y [mm],x [mm],frequency [Hz],phase [deg],fundamental [mm],mean_square_speed,sweep\n"
                          "4,5,6.5,90,4.9,0.02,up\n5,7,6.5,80,6.9,0.04,up\n",
                          "data.csv")
                          .record;
  const identify::Pair& pair = record.pairs.value().pairs[1];
  CHECK(pair.omega == Approx(2.0 * M_PI * 6.5).epsilon(1e-14));
  CHECK(pair.phase == Approx(80.0 * M_PI / 180.0).epsilon(1e-14));
  CHECK(pair.fundamental == Approx(6.9e-3).epsilon(1e-14));
  CHECK(pair.mean_square_speed == 0.04);
  CHECK(mentions(refusal_of("Y,x,frequency\n1,2,3\n"), "Hz and rad/s differ by 2 pi"));
  CHECK(mentions(refusal_of("Y,x,omega [rad/s]\n1,2,0\n"), "the frequency of column omega is zero"));
}

TEST_CASE("A phase that was not measured for a state is no fault, and no number") {
  for (const char* word : {"", " ", "nan", "NaN", "-nan", "NA", "None", "<NA>", "\"\""}) {
    CAPTURE(word);
    const std::string rows = std::string("4,5,") + word + "\n5,7,80\n6,9," + word + "\n";
    const auto found = parse_record("Y [mm],x [mm],phase [deg]\n" + rows, "data.csv");
    const auto& pairs = found.record.pairs.value().pairs;
    REQUIRE(pairs.size() == 3);
    CHECK(std::isnan(pairs[0].phase));
    CHECK(pairs[1].phase == Approx(80.0 * M_PI / 180.0).epsilon(1e-14));
    CHECK(std::isnan(pairs[2].phase));
    CHECK(pairs[2].x == Approx(9e-3));
    CHECK(found.warnings.empty());
    // Other columns have no such rows, and a column of phases has a number.
    const std::string cell = word;
    CHECK(mentions(refusal_of("Y,x,phase [rad]\n1," + cell + ",0.3\n2,3,0.4\n"), "the field of column x is not"));
    CHECK(mentions(refusal_of("Y,x,phase [rad]\n" + cell + ",1,0.3\n2,3,0.4\n"), "the field of column Y is not"));
    CHECK(mentions(refusal_of("Y,x,phase [rad]\n1,2," + cell + "\n2,3," + cell + "\n"),
                   "the field of column phase is not"));
  }
  CHECK(mentions(refusal_of("Y,x,phase [rad]\n1,2,0.3\n2,3,inf\n"), "the field of column phase is not"));
  CHECK(mentions(refusal_of("Y,x,phase [rad]\n1,2,0.3\n2,3,broken\n"), "the field of column phase is not"));
}

TEST_CASE("Large files are read, too large ones are refused") {
  std::string text = "t,x,y\n";
  constexpr int rows = 300'000;
  for (int i = 0; i < rows; ++i) text += print("%.4f,%.6f,%.6f\n", 1e-4 * i, 1e-6 * i, -1e-6 * i);
  const auto record = parse_record(text, "data.csv").record;
  CHECK(record.histories.at(0).y.size() == rows);

  // 10^8 rows in 200 MB: the lines are counted before they are read. In several GB: the size is enough.
  CHECK(mentions(refusal_of("x\n" + std::string(100'000'000, '\n') + "1\n"), "more than 20 million rows"));
  const TemporaryFile sparse("sparse.csv", "Y,x\n1,2\n");
  std::filesystem::resize_file(sparse.path(), std::uintmax_t{5} << 30U);
  CHECK(mentions(refusal([&] { return read_record(sparse.path()); }), "larger than 1 GiB: 5120 MiB"));
}

TEST_CASE("Universal files: signals by name, label and kind") {
  const std::vector<double> up = ramp(17);
  UniversalFunction base{.label = "y", .unit = "mm", .values = up};
  UniversalFunction mass{.entity = "x", .unit = "NONE", .values = up};
  UniversalFunction acceleration{.title = "1x : m/s\xB2", .unit = "m/s\xB2", .quantity = 12, .values = up};
  const std::string text = uff58(base) + uff58(mass) + uff58(acceleration);
  const MeasuredRecord file = parse_record(text, "data.uff");
  REQUIRE(file.warnings.size() == 1);
  CHECK(mentions(file.warnings[0], "no unit is stated for x: read x in m"));
  REQUIRE(file.record.histories.size() == 1);
  const History& history = file.record.histories[0];
  CHECK(history.sample_rate == Approx(1000.0).epsilon(1e-12));
  CHECK(history.y[16] == Approx(17e-3).epsilon(1e-15));
  CHECK(history.x == up);
  CHECK(history.a == up);

  // A repeated signal begins the next test. Values of six digits, E13.5.
  const auto tests = parse_record(text + text, "data.uff").record.histories;
  REQUIRE(tests.size() == 2);
  CHECK(tests[1].sweep == "2");
  CHECK(tests[1].x == up);

  // Two displacements without a name: somebody has to say which is which.
  UniversalFunction first{.title = "LVDT 1", .values = up};
  UniversalFunction second{.title = "LVDT 2", .values = up};
  const std::string unnamed = uff58(first) + uff58(second);
  CHECK(mentions(refusal_of(unnamed), "nothing shows which of them is x"));
  // Nor with one name at two nodes, as of an analyser that numbers its channels.
  const UniversalFunction other{.values = up, .node = 13};
  CHECK(mentions(refusal_of(uff58({.values = up}) + uff58(other)), "nothing shows which of them is x"));
  ReadOptions options{.name = "data.uff"};
  options.columns = {{"x", "LVDT 2"}, {"y", "1"}};
  options.units = {{"y", "cm"}};
  const auto named = parse_record(unnamed, options).record.histories;
  CHECK(named.at(0).x == up);
  CHECK(named.at(0).y[0] == Approx(0.01).epsilon(1e-15));
}

TEST_CASE("Universal files: lines above the first data set are not read, with a warning") {
  const std::string file =
      data_set("   151", "a model\n") + uff58({.entity = "x", .unit = "mm", .values = ramp(17)});
  for (const auto& [above, words] : {std::pair<std::string, std::string>{"exported by ACME 3.1\n", "1 line above"},
                                     {"exported by\nACME 3.1\n\n\n", "4 lines above"},
                                     {"t [s],x [mm]\n", "1 line above"}}) {
    CAPTURE(above);
    const MeasuredRecord read = parse_record(above + file, "data.uff");
    CHECK(read.record.histories.at(0).x[16] == Approx(17e-3).epsilon(1e-12));
    REQUIRE(read.warnings.size() == 1);
    CHECK(mentions(read.warnings[0], words + " the first data set of the universal file"));
  }
  // Numbers of a table that begin like the marks of a data set.
  const MeasuredRecord csv = parse_record("x\n-1\n58\n-40\n", "data.csv");
  CHECK(csv.record.decay->extremes.size() == 3);
}

TEST_CASE("Universal files: SI is assumed with a warning where neither the axis nor data set 164 states a unit") {
  const std::vector<double> up = ramp(17);
  const std::string units =
      data_set("   164", "         5mm-N                          2\n" +
                             print("%25.17E%25.17E%25.17E\n%25.17E\n", 1000.0, 1.0, 1.0, 273.15));
  const UniversalFunction f{.values = up};
  for (const std::string unit : {"NONE", "", "mm"}) {
    CAPTURE(unit);
    UniversalFunction known = f;
    known.unit = unit;
    const MeasuredRecord file = parse_record(uff58(known), "data.uff");
    CHECK((file.units.assumed == std::vector<std::string>{"x"}) == (unit != "mm"));
    CHECK(file.warnings.size() == (unit == "mm" ? 0 : 1));
    const MeasuredRecord stated = parse_record(units + uff58(known), "data.uff");
    CHECK(stated.units.assumed.empty());
    CHECK(stated.record.histories.at(0).x[16] == Approx(17e-3).epsilon(1e-12));
  }
  // Data set 164 has no factor for an ordinate of an unknown kind.
  const UniversalFunction unknown_kind{.entity = "x", .quantity = 0, .values = up};
  CHECK(parse_record(units + uff58(unknown_kind), "data.uff").units.assumed == std::vector<std::string>{"x"});
}

TEST_CASE("Universal files: units of data set 164, both precisions, text and binary") {
  // Millimetres and newtons: 1000 of the file's units of length are one metre.
  const std::string units =
      data_set("   164", "         5mm-N                          2\n" +
                             print("%25.17E%25.17E%25.17E\n%25.17E\n", 1000.0, 1.0, 1.0, 273.15));
  std::vector<double> values = ramp(20);
  for (double& value : values) value *= -1e-3 / 3.0;
  for (const int kind : {2, 4}) {
    const UniversalFunction f{.values = values, .kind = kind};
    // What is printed: six or thirteen digits. What is stored: 24 bits, or all.
    const double printed = kind == 4 ? 1e-12 : 1e-5;
    const double stored = kind == 4 ? 1e-15 : 1.2e-7;
    CAPTURE(kind);
    const auto text = parse_record(units + uff58(f), "data.uff").record.histories.at(0).x;
    const auto little = parse_record(units + uff58b(f), "data.uff").record.histories.at(0).x;
    const auto big = parse_record(units + uff58b(f, true) + uff58b(f, true), "data.uff").record.histories.at(1).x;
    for (std::size_t i = 0; i < values.size(); ++i) {
      CHECK(text[i] == Approx(values[i] * 1e-3).epsilon(printed));
      CHECK(little[i] == Approx(values[i] * 1e-3).epsilon(stored));
      CHECK(big[i] == little[i]);
    }
  }
}

TEST_CASE("Universal files: what is no time response is left out, what is damaged is refused") {
  const UniversalFunction good{.values = ramp(20)};
  UniversalFunction spectrum = good;
  spectrum.type = 4;
  spectrum.abscissa = 18;
  const MeasuredRecord file = parse_record(uff58(spectrum) + uff58b(spectrum) + uff58(good), "data.uff");
  CHECK(file.record.histories.at(0).x == good.values);
  CHECK(file.warnings.size() == 3);  // and that of the unit
  CHECK(mentions(refusal_of(uff58(spectrum)), "holds no time response"));
  CHECK(mentions(refusal_of(data_set("   151", "model\n")), "holds no time response"));
  UniversalFunction complex = good;
  complex.kind = 5;
  CHECK(mentions(refusal_of(uff58(complex)), "complex numbers"));
  const std::string whole = uff58(good);
  CHECK(mentions(refusal_of(whole.substr(0, whole.size() - 40)), "the data set ends after"));
  CHECK(mentions(refusal_of(whole.substr(0, 300)), "no number in columns"));
  std::string fewer = whole;
  fewer.replace(fewer.find("        20"), 10, "        19");
  CHECK(mentions(refusal_of(fewer), "the data set continues after its 19 values"));
  const std::string binary = uff58b(good);
  CHECK(mentions(refusal_of(binary.substr(0, binary.size() - 40)), "ends before its 20 values"));
  std::string letters = whole;
  letters.replace(letters.find("1.00000E+00\n") == std::string::npos ? letters.rfind("E+01") - 3 : 0, 3, "abc");
  CHECK(mentions(refusal_of(letters), "no number in columns"));
  UniversalFunction later = good;
  later.label = "y";
  later.start = 1.0;
  CHECK(mentions(refusal_of(uff58(UniversalFunction{.label = "x", .values = ramp(20)}) + uff58(later)),
                 "not sampled at the times"));
}

TEST_CASE("One signal is read as it stands, whatever else the file holds") {
  const std::string csv = "clock [ms],way,remark,v [kg]\n0,1,up,x\n7,3,,x\n10,2,down,x\n";
  const ReadOptions named{.units = {{"y", "mm"}}, .columns = {{"t", "clock"}, {"y", "way"}}, .name = "data.csv"};
  const auto signal = identify::parse_signal(csv, "y", named);
  CHECK(signal.warnings.empty());
  CHECK(signal.sha256 == core::sha256(csv));
  CHECK(signal.times == std::vector<double>{0.0, 7e-3, 10e-3});
  CHECK(signal.values == std::vector<double>{1e-3, 3e-3, 2e-3});
  // A vector x of another length, and data sets of other signals.
  const TemporaryFile matlab("drive.mat", mat4("t", ramp(20)) + mat4("force", ramp(20)) + mat4("x", ramp(30)));
  CHECK(identify::read_signal(matlab.path(), "force").values == ramp(20));
  UniversalFunction later{.label = "x", .start = 1.0, .values = ramp(20)};
  const std::string universal = uff58({.label = "y", .values = ramp(20)}) + uff58(later);
  CHECK(identify::parse_signal(universal, "y", {.name = "data.uff"}).values == ramp(20));
}

TEST_CASE("Signals that drive nothing are refused") {
  const auto refused = [](const std::string& text) {
    return refusal([&] { return identify::parse_signal(text, "y", ReadOptions{.name = "data.csv"}); });
  };
  CHECK(mentions(refused("t,x\n0,1\n1,2\n"), "there is no column y"));
  CHECK(mentions(refused("x,y\n0,1\n1,2\n"), "there is no column t"));
  CHECK(mentions(refused("t,y\n0,1\n"), "too few samples"));
  CHECK(mentions(refused("t,y\n0,1\n2,1\n1,2\n0.5,3\n"), "data.csv:4"));
  CHECK(mentions(refused("t,y\n0,1\n1,2\nt,y\n2,1\n3,2\n"), "several tests"));
}

TEST_CASE("What is said of a column that is not there is refused") {
  ReadOptions options{.name = "data.csv"};
  options.units = {{"phase", "deg"}};
  const std::string text = "Y [mm],x [mm]\n1,2\n2,3\n";
  CHECK_THROWS_AS(parse_record(text, options), core::InputError);
  options.units = {{"x", "mm"}};
  CHECK_NOTHROW(parse_record(text, options));
  options.scales = {{"v", "2"}};
  CHECK_THROWS_AS(parse_record(text, options), core::InputError);
}
