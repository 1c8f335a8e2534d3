#include "scenarios/results/mat_file.hpp"

#include <matio.h>
#include <sys/mman.h>
#include <unistd.h>

#include <array>
#include <cctype>
#include <cstddef>
#include <limits>
#include <memory>
#include <ostream>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scenarios/results/files.hpp"

namespace dualdamp::scenarios {

namespace {

using Variable = std::unique_ptr<matvar_t, decltype(&Mat_VarFree)>;

[[noreturn]] void fail(const std::string& what) { throw OutputError("a MATLAB file cannot hold " + what); }

Variable owned(matvar_t* variable, const std::string& what) {
  if (variable == nullptr) fail(what);
  return {variable, Mat_VarFree};
}

/// Names that MATLAB accepts, each of them once.
class Names {
 public:
  std::string valid(std::string_view name) {
    std::string result;
    for (const char c : name.substr(0, longest))
      result += std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
    if (result.empty() || std::isalpha(static_cast<unsigned char>(result.front())) == 0) result.insert(0, "x");
    const std::string first = result;
    for (int number = 2; !taken_.insert(result).second; ++number) result = first + "_" + std::to_string(number);
    return result;
  }

 private:
  static constexpr std::size_t longest = 55;  // MATLAB's limit is 63
  std::set<std::string> taken_;
};

Variable text(const char* name, std::string value) {
  std::array<std::size_t, 2> size = {1, value.size()};
  return owned(Mat_VarCreate(name, MAT_C_CHAR, MAT_T_UTF8, 2, size.data(), value.data(), 0), "a text");
}

Variable numbers(const Column& column) {
  std::array<std::size_t, 2> size = {column.numbers.size(), 1};
  constexpr std::size_t most = std::numeric_limits<std::int32_t>::max();
  if (sizeof(double) * column.numbers.size() > most)
    fail("the " + std::to_string(size[0]) + " rows of " + column.name);
  std::vector<double> values = column.numbers;  // matio takes no constants
  return owned(Mat_VarCreate(nullptr, MAT_C_DOUBLE, MAT_T_DOUBLE, 2, size.data(), values.data(), 0), column.name);
}

Variable texts(const Column& column) {
  std::array<std::size_t, 2> size = {column.size(), 1};
  std::vector<matvar_t*> cells;
  for (std::size_t row = 0; row < column.size(); ++row) cells.push_back(text(nullptr, column.text(row)).release());
  return owned(Mat_VarCreate(nullptr, MAT_C_CELL, MAT_T_CELL, 2, size.data(), static_cast<void*>(cells.data()), 0),
               column.name);
}

/// A struct to which fields are added.
class Struct {
 public:
  explicit Struct(const std::string& name)
      : variable_(owned(Mat_VarCreateStruct(name.c_str(), 2, one_.data(), nullptr, 0), name)) {}

  void add(const std::string& name, Variable value) {
    if (Mat_VarAddStructField(variable_.get(), name.c_str()) != 0) fail(name);
    Mat_VarSetStructFieldByName(variable_.get(), name.c_str(), 0, value.release());
  }
  [[nodiscard]] Variable take() { return std::move(variable_); }

 private:
  std::array<std::size_t, 2> one_ = {1, 1};
  Variable variable_;
};

/// A file in memory: matio writes to names only, and does not tell when a disk is full.
class MemoryFile {
 public:
  MemoryFile() : descriptor_(::memfd_create("dualdamp.mat", MFD_CLOEXEC)) {
    if (descriptor_ < 0) fail("anything: there is no memory for it");
  }
  ~MemoryFile() { ::close(descriptor_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  [[nodiscard]] std::string path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

  void copy_to(std::ostream& out) const {
    constexpr std::size_t block = 1 << 16;
    std::vector<char> bytes(block);
    off_t at = 0;
    for (ssize_t count = 0; (count = ::pread(descriptor_, bytes.data(), bytes.size(), at)) > 0; at += count)
      out.write(bytes.data(), count);
  }

 private:
  int descriptor_;
};

/// The table and its units.
std::pair<Variable, Variable> structs_of(const Table& table, const std::string& name) {
  Struct columns(name);
  Struct units(name);
  Names names;
  for (const Column& column : table.columns) {
    const std::string field = names.valid(column.name);
    columns.add(field, column.kind == CellKind::text ? texts(column) : numbers(column));
    units.add(field, text(nullptr, column.unit));
  }
  return {columns.take(), units.take()};
}

/// The file is whole when this returns.
void write_to(const std::string& path, const std::vector<Table>& tables, const std::string& provenance) {
  const std::unique_ptr<mat_t, decltype(&Mat_Close)> file(Mat_CreateVer(path.c_str(), mat_heading, MAT_FT_MAT5),
                                                          Mat_Close);
  if (!file) fail("anything: there is no memory for it");
  const auto write = [&](const Variable& variable) {
    if (Mat_VarWrite(file.get(), variable.get(), MAT_COMPRESSION_ZLIB) != 0) fail(variable->name);
  };
  Struct units("units");
  Names names;
  for (const char* const taken : {"units", "provenance"}) names.valid(taken);
  for (const Table& table : tables) {
    const std::string name = names.valid(table.name);
    auto [columns, their_units] = structs_of(table, name);
    write(columns);
    units.add(name, std::move(their_units));
  }
  write(units.take());
  write(text("provenance", provenance));
}

}  // namespace

void write_mat(std::ostream& out, const std::vector<Table>& tables, const std::string& provenance) {
  const MemoryFile memory;
  write_to(memory.path(), tables, provenance);
  memory.copy_to(out);
}

}  // namespace dualdamp::scenarios
