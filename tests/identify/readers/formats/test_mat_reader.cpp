#include <hdf5.h>
#include <matio.h>

#include <catch2/catch.hpp>
#include <fstream>
#include <iterator>
#include <limits>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "core/diagnostics.hpp"
#include "identify/readers/record_reader.hpp"
#include "tests/identify/readers/data_files.hpp"
#include "tests/identify/readers/refusals.hpp"

using namespace dualdamp;
using namespace dualdamp::identify::testing;
using identify::History;
using identify::MeasuredRecord;
using identify::read_record;

namespace {

/// A MATLAB 5 or 7.3 file with vectors, and a struct array with vectors as fields, by matio's own writer.
class Matlab {
 public:
  Matlab(const std::string& name, mat_ft version) : file_(name, "") {
    mat_.reset(Mat_CreateVer(file_.path().c_str(), nullptr, version));
  }

  Matlab& add(const std::string& name, std::vector<double> values, std::size_t columns = 1,
              matio_classes type = MAT_C_DOUBLE) {
    return put(create(name, values, columns, type));
  }
  Matlab& add_text(const std::string& name, std::string text) {
    std::array<std::size_t, 2> size = {1, text.size()};
    return put(Mat_VarCreate(name.c_str(), MAT_C_CHAR, MAT_T_UINT8, 2, size.data(), text.data(), 0));
  }
  /// A char array of the given type of units, column by column.
  template <typename Unit>
  Matlab& add_chars(const std::string& name, matio_types type, std::vector<Unit> units, std::size_t rows = 1) {
    std::array<std::size_t, 2> size = {rows, units.size() / rows};
    return put(Mat_VarCreate(name.c_str(), MAT_C_CHAR, type, 2, size.data(), units.data(), 0));
  }
  Matlab& add_cells(const std::string& name, std::vector<std::string> texts) {
    std::vector<matvar_t*> cells;
    for (std::string& text : texts) {
      std::array<std::size_t, 2> size = {1, text.size()};
      cells.push_back(Mat_VarCreate("", MAT_C_CHAR, MAT_T_UTF8, 2, size.data(), text.data(), 0));
    }
    std::array<std::size_t, 2> size = {cells.size(), 1};
    return put(Mat_VarCreate(name.c_str(), MAT_C_CELL, MAT_T_CELL, 2, size.data(), cells.data(), 0));
  }
  Matlab& add_complex(const std::string& name, std::vector<double> values) {
    std::array<std::size_t, 2> size = {values.size(), 1};
    mat_complex_split_t parts{values.data(), values.data()};
    return put(Mat_VarCreate(name.c_str(), MAT_C_DOUBLE, MAT_T_DOUBLE, 2, size.data(), &parts, MAT_F_COMPLEX));
  }
  /// One element for each list of values, with fields x and dt.
  Matlab& add_struct(const std::string& name, const std::vector<std::vector<double>>& elements) {
    std::array<std::size_t, 2> size = {1, elements.size()};
    std::array<const char*, 2> fields = {"x", "dt"};
    matvar_t* record = Mat_VarCreateStruct(name.c_str(), 2, size.data(), fields.data(), 2);
    for (std::size_t i = 0; i < elements.size(); ++i) {
      Mat_VarSetStructFieldByName(record, "x", i, create("x", elements[i], 1, MAT_C_DOUBLE));
      Mat_VarSetStructFieldByName(record, "dt", i, create("dt", {0.01}, 1, MAT_C_DOUBLE));
    }
    return put(record);
  }
  /// A struct with a matrix `data` and a sample rate `fs`.
  Matlab& add_struct_of_matrix(const std::string& name, const std::vector<double>& values, std::size_t columns,
                               double rate) {
    std::array<std::size_t, 2> size = {1, 1};
    std::array<const char*, 2> fields = {"data", "fs"};
    matvar_t* record = Mat_VarCreateStruct(name.c_str(), 2, size.data(), fields.data(), 2);
    Mat_VarSetStructFieldByName(record, "data", 0, create("data", values, columns, MAT_C_DOUBLE));
    Mat_VarSetStructFieldByName(record, "fs", 0, create("fs", {rate}, 1, MAT_C_DOUBLE));
    return put(record);
  }
  [[nodiscard]] std::string path() {
    mat_.reset();
    return file_.path();
  }

 private:
  static matvar_t* create(const std::string& name, std::vector<double> values, std::size_t columns,
                          matio_classes type) {
    std::array<std::size_t, 2> size = {values.size() / columns, columns};
    if (type == MAT_C_SINGLE) {
      std::vector<float> singles(values.begin(), values.end());
      return Mat_VarCreate(name.c_str(), type, MAT_T_SINGLE, 2, size.data(), singles.data(), 0);
    }
    return Mat_VarCreate(name.c_str(), type, MAT_T_DOUBLE, 2, size.data(), values.data(), 0);
  }
  Matlab& put(matvar_t* variable) {
    REQUIRE(Mat_VarWrite(mat_.get(), variable, MAT_COMPRESSION_NONE) == 0);
    Mat_VarFree(variable);
    return *this;
  }

  TemporaryFile file_;
  std::unique_ptr<mat_t, decltype([](mat_t* file) { Mat_Close(file); })> mat_;
};

}  // namespace

TEST_CASE("MATLAB 4 files, of both byte orders") {
  for (const bool big_endian : {false, true}) {
    CAPTURE(big_endian);
    const TemporaryFile file("v4.mat", mat4("fs", {250.0}, big_endian) + mat4("x", ramp(40), big_endian) +
                                           mat4("velocity", ramp(40), big_endian) + mat4("note", {1}, big_endian));
    const MeasuredRecord read = read_record(file.path());
    REQUIRE(read.record.histories.size() == 1);
    CHECK(read.record.histories[0].sample_rate == Approx(250.0).epsilon(1e-14));
    CHECK(read.record.histories[0].x == ramp(40));
    CHECK(read.record.histories[0].v == ramp(40));
    REQUIRE(read.warnings.size() == 2);
    CHECK(read.warnings[0] == "variable 'note' is not known and is ignored");
    CHECK(mentions(read.warnings[1], "no unit is stated for x and v: read x in m and v in m/s"));
  }
}

TEST_CASE("MATLAB 5 and 7.3 files") {
  for (const mat_ft version : {MAT_FT_MAT5, MAT_FT_MAT73}) {
    CAPTURE(version);
    Matlab signals("signals.mat", version);
    signals.add("x", ramp(40)).add("dt", {0.01}).add("y", ramp(40), 40, MAT_C_SINGLE);
    const History history = read_record(signals.path(), {.units = {{"y", "mm"}}}).record.histories.at(0);
    CHECK(history.sample_rate == Approx(100.0).epsilon(1e-14));
    CHECK(history.x == ramp(40));
    CHECK(history.y[39] == Approx(0.04).epsilon(1e-15));

    Matlab pairs("pairs.mat", version);
    pairs.add("Y", {1, 2, 3, 4}).add("x", {2, 4, 6, 8}).add("omega", {9, 9, 9, 9}).add("sweep", {1, 1, 2, 2});
    const auto record = read_record(pairs.path()).record;
    CHECK(record.pairs.value().pairs[2].x == 6.0);
    CHECK(record.pairs.value().pairs[2].omega == 9.0);
    CHECK(record.pairs.value().pairs[2].sweep == "2");

    Matlab tests("tests.mat", version);
    const auto histories = read_record(tests.add_struct("run", {ramp(20), ramp(30)}).path()).record.histories;
    REQUIRE(histories.size() == 2);
    CHECK(histories[1].x == ramp(30));
    CHECK(histories[1].sweep == "2");
  }
}

TEST_CASE("MATLAB labels are texts of any encoding, char arrays and cell arrays") {
  const auto label = [](Matlab& file) {
    return read_record(file.add("x", ramp(20)).add("dt", {0.01}).path()).record.histories.at(0).sweep;
  };
  for (const mat_ft version : {MAT_FT_MAT5, MAT_FT_MAT73}) {
    CAPTURE(version);
    for (const matio_types type : {MAT_T_UINT8, MAT_T_UTF8}) {
      Matlab file("bytes.mat", version);
      CHECK(label(file.add_chars<char>("sweep", type, {'u', 'p', ' ', '1'})) == "up 1");
    }
    for (const matio_types type : {MAT_T_UINT16, MAT_T_UTF16}) {
      Matlab file("units.mat", version);
      // o with two dots, and a character beyond the first 65536
      CHECK(label(file.add_chars<char16_t>("sweep", type, {u'\xf6', u'1', 0xD83D, 0xDE00})) ==
            "\xc3\xb6"
            "1\xf0\x9f\x98\x80");
    }
    Matlab rows("rows.mat", version);
    rows.add("Y", {1, 2, 3, 4}).add("x", {2, 4, 6, 8}).add("omega", {9, 9, 9, 9});
    rows.add_chars<char16_t>("sweep", MAT_T_UINT16, {'u', 'u', 'd', 'd', 'p', 'p', 'o', 'o', ' ', ' ', 'w', 'w'},
                             4);
    const auto pairs = read_record(rows.path()).record.pairs.value().pairs;
    CHECK(pairs[1].sweep == "up");
    CHECK(pairs[2].sweep == "dow");
    Matlab cells("cells.mat", version);
    cells.add("Y", {1, 2, 3, 4}).add("x", {2, 4, 6, 8}).add("omega", {9, 9, 9, 9});
    cells.add_cells("sweep", {"up", "up", "down", "down"});
    CHECK(read_record(cells.path()).record.pairs.value().pairs[2].sweep == "down");
  }
  Matlab bytes("int8.mat", MAT_FT_MAT5);
  bytes.add_cells("sweep", {"a", ""}).add("x", ramp(20)).add("dt", {0.01});
  CHECK(mentions(refusal([&] { (void)read_record(bytes.path()); }),
                 "variable 'sweep' holds no text that can be read"));
}

TEST_CASE("MATLAB labels may be stored as signed numbers") {
  // The type of the content is in the word eight bytes before it.
  const auto retyped = [](Matlab& file, const std::string& content, char type) {
    const std::string path = file.path();
    std::ifstream in(path, std::ios::binary);
    std::string bytes{std::istreambuf_iterator<char>(in), {}};
    constexpr std::size_t tag = 8;
    const std::size_t at = bytes.find(content);
    REQUIRE(at != std::string::npos);
    bytes[at - tag] = type;
    std::ofstream(path, std::ios::binary) << bytes;
    return read_record(path).record.histories.at(0).sweep;
  };
  constexpr char int8 = 1;
  constexpr char int16 = 3;
  Matlab bytes("signed.mat", MAT_FT_MAT5);
  bytes.add_chars<char>("sweep", MAT_T_UINT8, {'u', 'p', '-', '1', '2', '3', '4', '5'});
  CHECK(retyped(bytes.add("x", ramp(20)).add("dt", {0.01}), "up-12345", int8) == "up-12345");
  Matlab units("signed16.mat", MAT_FT_MAT5);
  units.add_chars<char16_t>("sweep", MAT_T_UINT16, {'u', 'p', '-', '1', u'\xf6'});
  using namespace std::string_literals;
  CHECK(retyped(units.add("x", ramp(20)).add("dt", {0.01}), "u\0p\0-\0"s, int16) == "up-1\xc3\xb6");
  Matlab cells("signed_cells.mat", MAT_FT_MAT5);
  cells.add_cells("sweep", {"up-12345"});
  CHECK(retyped(cells.add("x", ramp(20)).add("dt", {0.01}), "up-12345", int8) == "up-12345");
}

TEST_CASE("The unit in the name of a MATLAB variable of the caller's choice is used") {
  Matlab file("named.mat", MAT_FT_MAT5);
  const std::string path = file.add("weg_mm", ramp(20)).add("dt", {0.01}).path();
  CHECK(read_record(path, {.columns = {{"x", "weg_mm"}}}).record.histories.at(0).x[1] == Approx(0.002));
}

TEST_CASE("Parts of matrices, fields of structs and names of the caller's are columns") {
  for (const mat_ft version : {MAT_FT_MAT5, MAT_FT_MAT73}) {
    CAPTURE(version);
    Matlab file("parts.mat", version);
    std::vector<double> table = ramp(40);
    for (double& value : table) value *= 0.01;
    const std::vector<double> numbers = ramp(40);
    table.insert(table.end(), numbers.begin(), numbers.end());
    file.add("data", table, 2).add("vir", ramp(40)).add("Fs", {100.0}).add_struct("run", {ramp(40)});
    const std::string path = file.path();
    using Columns = std::map<std::string, std::string>;
    for (const Columns& columns : {Columns{{"x", "data(:,2)"}}, {{"x", "2"}}, {{"x", "vir"}}, {{"x", "run.x"}}}) {
      CAPTURE(columns.at("x"));
      const History history =
          read_record(path, {.columns = columns, .scales = {{"x", "2.5 mm/V"}}}).record.histories.at(0);
      CHECK(history.sample_rate == Approx(100.0).epsilon(1e-14));
      CHECK(history.x.size() == 40);
      CHECK(history.x[3] == Approx(4 * 2.5e-3).epsilon(1e-15));
    }
    const auto says = [&path](const std::string& x) {
      return refusal([&] { return read_record(path, {.columns = {{"x", x}}}); });
    };
    CHECK(mentions(says("data(:,3)"), "beyond the last column"));
    CHECK(mentions(says("y"), "data (40 x 2)"));
  }
}

TEST_CASE("A motion in one struct and its times in another one are read together") {
  std::vector<double> times = ramp(40);
  for (double& t : times) t *= 0.02;
  Matlab file("two_structs.mat", MAT_FT_MAT5);
  const std::string path = file.add_struct("run", {ramp(40)}).add_struct("clock", {times}).path();
  const History history = read_record(path, {.columns = {{"x", "run.x"}, {"t", "clock.x"}}}).record.histories.at(0);
  CHECK(history.x == ramp(40));
  CHECK(history.sample_rate == Approx(50.0));
}

TEST_CASE("Parts of a matrix within a struct are columns, beside the sample rate in the struct or in the file") {
  std::vector<double> table = ramp(40);
  std::vector<double> second = ramp(40);
  for (double& value : second) value *= -0.5;
  table.insert(table.end(), second.begin(), second.end());
  for (const mat_ft version : {MAT_FT_MAT5, MAT_FT_MAT73}) {
    CAPTURE(version);
    Matlab file("within.mat", version);
    const std::string path = file.add_struct_of_matrix("rec", table, 2, 100.0).path();
    for (const std::string prefix : {"rec.", ""}) {
      CAPTURE(prefix);
      const History history =
          read_record(path, {.columns = {{"x", prefix + "data(:,1)"}, {"y", prefix + "data(:,2)"}}})
              .record.histories.at(0);
      CHECK(history.sample_rate == Approx(100.0).epsilon(1e-14));
      CHECK(history.x == ramp(40));
      CHECK(history.y == second);
    }
    CHECK(mentions(refusal([&] { return read_record(path, {.columns = {{"x", "rec.data(:,3)"}}}); }),
                   "beyond the last column"));
    CHECK(mentions(refusal([&] { return read_record(path, {.columns = {{"x", "other.data(:,1)"}}}); }),
                   "no vector with the name of a column"));

    Matlab beside("beside.mat", version);
    beside.add("y", second).add("Fs", {50.0}).add_struct_of_matrix("rec", table, 2, 100.0);
    const History other = read_record(beside.path(), {.columns = {{"x", "rec.data(:,1)"}}}).record.histories.at(0);
    CHECK(other.sample_rate == Approx(50.0).epsilon(1e-14));
    CHECK(other.x == ramp(40));
    CHECK(other.y == second);

    Matlab field("field.mat", version);
    const History run = read_record(field.add_struct("run", {ramp(40)}).path(), {.columns = {{"x", "run.x"}}})
                            .record.histories.at(0);
    CHECK(run.sample_rate == Approx(100.0).epsilon(1e-14));
    CHECK(run.x == ramp(40));
  }
}

TEST_CASE("MATLAB files that hold something else") {
  for (const mat_ft version : {MAT_FT_MAT5, MAT_FT_MAT73}) {
    CAPTURE(version);
    const auto says = [version](auto fill, const std::string& words) {
      Matlab file("bad.mat", version);
      fill(file);
      const std::string path = file.path();
      return mentions(refusal([&] { return read_record(path); }), words);
    };
    CHECK(says([](Matlab& m) { m.add("z", ramp(20)); }, "no vector with the name of a column"));
    CHECK(says([](Matlab& m) { m.add_struct_of_matrix("rec", ramp(40), 2, 100.0); }, "rec (1 x 1 with data, fs)"));
    CHECK(says([](Matlab& m) { m.add("x", {}); }, "variable 'x' is empty"));
    CHECK(says([](Matlab& m) { m.add_text("x", "no number"); }, "variable 'x' is text"));
    CHECK(says([](Matlab& m) { m.add_complex("x", ramp(20)); }, "holds complex numbers"));
    CHECK(says([](Matlab& m) { m.add("x", ramp(20), 2); }, "variable 'x' is a matrix"));
    CHECK(says([](Matlab& m) { m.add("x", ramp(20)).add("y", ramp(21)).add("dt", {1.0}); },
               "not of the same length"));
    CHECK(says([](Matlab& m) { m.add("x", ramp(20)).add("y", ramp(20)); }, "there is no column t"));
    CHECK(says([](Matlab& m) { m.add("x", ramp(20)).add("fs", {0.0}); }, "not one number above zero"));
    CHECK(says([](Matlab& m) { m.add("Y", {1, 2}).add("x", {1, std::nan("")}); }, "element 2 of variable 'x'"));
    CHECK(says([](Matlab& m) { m.add("Y", {1}).add("x", {1}).add("frequency", {6}); }, "differ by 2 pi"));
    CHECK(says([](Matlab& m) { m.add("Y", {1}).add("x", {1}).add("phase", {1.5}); }, "an angle needs its unit"));
    CHECK(says([](Matlab& m) { m.add_struct("a", {ramp(20)}).add_struct("b", {ramp(20)}); }, "several structs"));
  }
}

TEST_CASE("NaN among the phases of a MATLAB file is a phase that was not measured") {
  const double none = std::nan("");
  for (const mat_ft version : {MAT_FT_MAT5, MAT_FT_MAT73}) {
    CAPTURE(version);
    const auto with = [version, none](std::vector<double> phases) {
      Matlab file("gaps.mat", version);
      file.add("Y", {1, 2, 3}).add("x", {2, 4, 6}).add("phase_rad", std::move(phases));
      return read_record(file.path()).record.pairs.value().pairs;
    };
    const auto pairs = with({none, 0.5, none});
    REQUIRE(pairs.size() == 3);
    CHECK(std::isnan(pairs[0].phase));
    CHECK(pairs[1].phase == 0.5);
    CHECK(std::isnan(pairs[2].phase));
    CHECK(mentions(refusal([&] { return with({none, none, none}); }), "is not a finite number"));
    CHECK(mentions(refusal([&] { return with({0.5, std::numeric_limits<double>::infinity(), none}); }),
                   "element 2 of variable 'phase_rad' is not a finite number"));
  }
}

TEST_CASE("MATLAB files cut off anywhere are refused") {
  for (const mat_ft version : {MAT_FT_MAT5, MAT_FT_MAT73}) {
    Matlab whole("whole.mat", version);
    const std::string path = whole.add("x", ramp(40)).add("dt", {0.01}).path();
    std::ifstream file(path, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    for (std::size_t size = 1; size < bytes.size(); size += 1 + bytes.size() / 60) {
      CAPTURE(version, size);
      const TemporaryFile cut("cut.mat", bytes.substr(0, size));
      CHECK(refusal([&] { return read_record(cut.path()); }) != "accepted");
    }
  }
}

TEST_CASE("MATLAB 5 files changed anywhere are read or refused") {
  Matlab whole("whole.mat", MAT_FT_MAT5);
  const std::string path = whole.add("x", ramp(40)).add("dt", {0.01}).add_struct("run", {ramp(20)}).path();
  std::ifstream file(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  std::mt19937_64 random(5);
  int refused = 0;
  for (int i = 0; i < 1000; ++i) {
    std::string damaged = bytes;
    for (int k = 0; k < 3; ++k) damaged[random() % damaged.size()] = static_cast<char>(random());
    const TemporaryFile changed("changed.mat", damaged);
    // What is read has the numbers that are there, and no more.
    const std::string words = refusal([&] {
      for (const History& history : read_record(changed.path()).record.histories)
        CHECK((history.x.size() == 40 || history.x.size() == 20));
    });
    refused += words == "accepted" ? 0 : 1;
  }
  CHECK(refused > 0);
}

TEST_CASE("MATLAB 7.3 files damaged on purpose are read or refused, and in time") {
  // Of 10,000 such damages 16 made HDF5 run without end, and others crashed it: what a process of its own is for.
  Matlab whole("whole.mat", MAT_FT_MAT73);
  const std::string path = whole.add("x", ramp(40)).add("dt", {0.01}).add_struct("run", {ramp(20)}).path();
  std::ifstream file(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  std::mt19937_64 random(7301);
  int refused = 0;
  constexpr int damages = 400;
  for (int i = 0; i < damages; ++i) {
    std::string damaged = bytes;
    // Behind the header of MATLAB; in every other file one bit alone, in the others up to eight bytes.
    const auto place = [&] { return 512 + random() % (damaged.size() - 512); };
    if (i % 2 == 0)
      damaged[place()] ^= static_cast<char>(1 << random() % 8);
    else
      for (std::uint64_t k = 1 + random() % 8; k > 0; --k) damaged[place()] = static_cast<char>(random());
    const TemporaryFile changed("changed.mat", damaged);
    const auto begin = std::chrono::steady_clock::now();
    const std::string words = refusal([&] {
      for (const History& history : read_record(changed.path()).record.histories)
        CHECK(history.x.size() <= 40);  // a stated length may be damaged too, and be shorter
    });
    refused += words == "accepted" ? 0 : 1;
    // The limit on the wall clock, which is eight times that of the processor's, and some room.
    CHECK(std::chrono::steady_clock::now() - begin < std::chrono::seconds(20));
  }
  CHECK(refused > 0);
  CHECK(refused < damages);
}

TEST_CASE("A vector that another program wrote into the HDF5 file is refused by what it lacks") {
  // h5py writes data without the attributes by which MATLAB knows them.
  Matlab file("h5py.mat", MAT_FT_MAT73);
  file.add("dt", {0.01}).add("x", {1e-3, 2e-3, 1e-3, -1e-3});
  const std::string path = file.path();
  const hid_t hdf5 = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  REQUIRE(hdf5 >= 0);
  REQUIRE(H5Adelete_by_name(hdf5, "x", "MATLAB_class", H5P_DEFAULT) >= 0);
  H5Fclose(hdf5);
  const std::string said = refusal([&] { return read_record(path); });
  CHECK(mentions(said, "variable 'x' has no attribute MATLAB_class"));
  CHECK(mentions(said, "scipy.io.savemat"));
}
