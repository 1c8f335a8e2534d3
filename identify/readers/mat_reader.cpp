#include "identify/readers/mat_reader.hpp"

#include <hdf5.h>
#include <matio.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <iterator>
#include <memory>
#include <numeric>
#include <optional>
#include <utility>

#include "core/numbers.hpp"
#include "identify/readers/isolated.hpp"
#include "identify/readers/mat_content.hpp"
#include "identify/readers/mat_structure.hpp"
#include "identify/readers/text.hpp"

namespace dualdamp::identify {

namespace {

constexpr std::size_t most_values = 20'000'000;

using MatFile = std::unique_ptr<mat_t, decltype([](mat_t* file) { Mat_Close(file); })>;
using Variable = std::unique_ptr<matvar_t, decltype([](matvar_t* variable) { Mat_VarFree(variable); })>;

/// What is wrong with a file is said by us, not on stderr by the libraries.
void silence() {
  Mat_LogInitFunc("dualdamp", [](int, char*) {});
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

/// HDF5 knows where its files end; matio takes one that cannot be opened for one without variables.
bool is_whole_hdf5(const std::string& path) {
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  if (file >= 0) H5Fclose(file);
  return file >= 0;
}

std::string describe(const matvar_t& variable) {
  std::string text;
  for (int i = 0; i < variable.rank; ++i) text += (i == 0 ? "" : " x ") + std::to_string(variable.dims[i]);
  return text;
}

std::size_t size_of(const matvar_t& variable) {
  std::size_t size = 1;
  for (int i = 0; i < variable.rank; ++i) size *= std::min(variable.dims[i], most_values + 1);
  return variable.rank == 0 ? 0 : size;
}

template <typename Stored>
std::vector<double> converted(const matvar_t& variable, std::size_t size) {
  const auto* from = static_cast<const Stored*>(variable.data);
  std::vector<double> values(size);
  std::transform(from, from + size, values.begin(), [](Stored value) { return static_cast<double>(value); });
  return values;
}

std::optional<std::vector<double>> numbers(const matvar_t& variable) {
  const std::size_t size = size_of(variable);
  if (variable.data == nullptr || variable.nbytes < size * Mat_SizeOf(variable.data_type)) return std::nullopt;
  switch (variable.data_type) {
    case MAT_T_DOUBLE:
      return converted<double>(variable, size);
    case MAT_T_SINGLE:
      return converted<float>(variable, size);
    case MAT_T_INT8:
      return converted<std::int8_t>(variable, size);
    case MAT_T_UINT8:
      return converted<std::uint8_t>(variable, size);
    case MAT_T_INT16:
      return converted<std::int16_t>(variable, size);
    case MAT_T_UINT16:
      return converted<std::uint16_t>(variable, size);
    case MAT_T_INT32:
      return converted<std::int32_t>(variable, size);
    case MAT_T_UINT32:
      return converted<std::uint32_t>(variable, size);
    case MAT_T_INT64:
      return converted<std::int64_t>(variable, size);
    case MAT_T_UINT64:
      return converted<std::uint64_t>(variable, size);
    default:
      return std::nullopt;
  }
}

/// Named variables of one test: those of the file, or the fields of an element of a struct.
using Scope = std::vector<std::pair<std::string, const matvar_t*>>;

class Reader {
 public:
  Reader(std::string path, const ReadOptions& options)
      : path_(std::move(path)), file_(options.name), options_(options) {}

  MatContent run() {
    read_variables();
    MatContent content;
    const std::vector<Scope> scopes = find_scopes();
    for (std::size_t i = 0; i < scopes.size(); ++i) {
      content.tests.push_back(test(scopes[i]));
      if (scopes.size() > 1 && content.tests.back().label.empty())
        content.tests.back().label = std::to_string(i + 1);
    }
    problems_.throw_if_any();
    content.row_labels = std::move(row_labels_);
    content.warnings = std::move(warnings_);
    return content;
  }

 private:
  void complain(std::string message, std::string allowed = {}, std::string found = {}) {
    problems_.add({{file_, 0, 0, {}}, std::move(message), std::move(allowed), std::move(found), {}});
  }

  /// The variables that are asked for, and structs; others are not read into memory.
  void read_variables() {
    const MatFile file(Mat_Open(path_.c_str(), MAT_ACC_RDONLY));
    if (!file || (Mat_GetVersion(file.get()) == MAT_FT_MAT73 && !is_whole_hdf5(path_))) refuse_damaged_mat(file_);
    while (true) {
      Variable variable(Mat_VarReadNextInfo(file.get()));
      if (!variable) break;
      const bool is_struct = variable->class_type == MAT_C_STRUCT;
      if (variable->name == nullptr || (!is_struct && !is_wanted(variable->name))) {
        warnings_.push_back("variable '" + to_utf8(variable->name == nullptr ? "" : variable->name) +
                            "' is not known and is ignored");
        continue;
      }
      if (size_of(*variable) > most_values)
        refuse_file(file_, "variable '" + std::string(variable->name) + "' holds more than 20 million numbers");
      if (size_of(*variable) > 0 && Mat_VarReadDataAll(file.get(), variable.get()) != 0) refuse_damaged_mat(file_);
      variables_.push_back(std::move(variable));
    }
  }

  /// The column that a name of the file stands for; dt and fs stand for none and are wanted all the same.
  [[nodiscard]] const KnownColumn* column_of(const std::string& name) const {
    for (const auto& [column, called] : options_.columns)
      if (called == name) return known_column(column);
    const KnownColumn* known = known_column(name);
    if (known == nullptr) return nullptr;
    const bool replaced =
        options_.columns.contains(std::string(known->name)) || options_.columns.contains(std::string(known->alias));
    return replaced ? nullptr : known;
  }

  [[nodiscard]] bool is_wanted(const std::string& name) const {
    return name == "dt" || name == "fs" || column_of(name) != nullptr;
  }

  [[nodiscard]] bool holds_data(const Scope& scope) const {
    return std::ranges::any_of(scope, [this](const auto& entry) {
      const KnownColumn* known = column_of(entry.first);
      return known != nullptr && (known->is_signal || known->name == "Y");
    });
  }

  std::vector<Scope> find_scopes() {
    Scope whole;
    std::vector<std::vector<Scope>> structs;
    for (const Variable& variable : variables_) {
      if (variable->class_type != MAT_C_STRUCT) {
        whole.emplace_back(variable->name, variable.get());
        continue;
      }
      std::vector<Scope> elements = elements_of(*variable);
      if (!elements.empty() && holds_data(elements.front())) structs.push_back(std::move(elements));
    }
    if (holds_data(whole)) return {whole};
    if (structs.size() == 1) return std::move(structs.front());
    refuse_file(file_,
                structs.empty() ? "the MATLAB file holds no vector x and nothing else that could be used"
                                : "several structs of the MATLAB file hold signals",
                "vectors named like the columns, or one struct that holds them: " + std::string(allowed_columns));
  }

  [[nodiscard]] static std::vector<Scope> elements_of(const matvar_t& variable) {
    auto* const record = const_cast<matvar_t*>(&variable);  // matio's readers take no const
    const unsigned fields = Mat_VarGetNumberOfFields(record);
    char* const* const names = Mat_VarGetStructFieldnames(record);
    std::vector<Scope> elements;
    if (variable.data == nullptr || names == nullptr) return elements;
    for (std::size_t i = 0; i < size_of(variable); ++i) {
      Scope scope;
      for (unsigned field = 0; field < fields; ++field)
        if (const matvar_t* value = Mat_VarGetStructFieldByIndex(record, field, i))
          scope.emplace_back(names[field], value);
      elements.push_back(std::move(scope));
    }
    return elements;
  }

  TestColumns test(const Scope& scope) {
    TestColumns result;
    std::optional<double> step;
    for (const auto& [name, variable] : scope) {
      const KnownColumn* known = column_of(name);
      if (name == "dt" || name == "fs") {
        if (const auto value = scalar(name, *variable)) step = name == "dt" ? *value : 1.0 / *value;
      } else if (known != nullptr && known->unit.empty()) {
        take_label(name, *variable, result);
      } else if (known != nullptr) {
        take(name, *variable, *known, result);
      } else {
        warnings_.push_back("field '" + to_utf8(name) + "' is not known and is ignored");
      }
    }
    problems_.throw_if_any();
    check_lengths(result);
    add_times(result, step);
    return result;
  }

  /// Real numbers in a row or column; nothing after a problem.
  std::optional<std::vector<double>> vector(const std::string& name, const matvar_t& variable) {
    const std::string subject = "variable '" + name + "'";
    const bool numeric = variable.class_type >= MAT_C_DOUBLE && variable.class_type <= MAT_C_UINT64;
    const auto long_sides =
        std::count_if(variable.dims, variable.dims + variable.rank, [](std::size_t side) { return side > 1; });
    std::string fault;
    if (variable.class_type == MAT_C_EMPTY || size_of(variable) == 0)
      fault = " is empty";
    else if (variable.class_type == MAT_C_CHAR)
      fault = " is text";
    else if (!numeric)
      fault = " is no vector of numbers";
    else if (variable.isComplex != 0)
      fault = " holds complex numbers";
    else if (long_sides > 1)
      fault = " is a matrix";
    if (!fault.empty()) {
      complain(subject + fault, "a vector of real numbers", variable.rank > 0 ? describe(variable) : std::string());
      return std::nullopt;
    }
    auto values = numbers(variable);
    if (!values) refuse_damaged_mat(file_);
    const auto bad = std::ranges::find_if(*values, [](double value) { return !std::isfinite(value); });
    if (bad == values->end()) return values;
    complain("element " + std::to_string(bad - values->begin() + 1) + " of variable '" + name +
                 "' is not a finite number",
             "finite numbers");
    return std::nullopt;
  }

  std::optional<double> scalar(const std::string& name, const matvar_t& variable) {
    const auto values = vector(name, variable);
    if (!values) return std::nullopt;
    if (values->size() == 1 && values->front() > 0.0) return values->front();
    complain("variable '" + name + "' is not one number above zero");
    return std::nullopt;
  }

  void take(const std::string& name, const matvar_t& variable, const KnownColumn& known, TestColumns& test) {
    auto values = vector(name, variable);
    if (!values) return;
    const auto factor = factor_of_caller(options_.units, known, file_, problems_);
    if (!factor && name == "frequency")
      complain("variable 'frequency' needs its unit, because Hz and rad/s differ by 2 pi",
               "omega in rad/s, or the caller's unit");
    if (std::ranges::any_of(test.columns, [&](const DataColumn& column) { return column.known == &known; }))
      complain("column " + std::string(known.name) + " stands there twice");
    if (factor)
      for (double& value : *values) value *= *factor;
    test.columns.push_back({&known, std::move(*values)});
  }

  /// A text or a number labels the test, a vector of numbers each row.
  void take_label(const std::string& name, const matvar_t& variable, TestColumns& test) {
    if (variable.class_type == MAT_C_CHAR && variable.data_type == MAT_T_UINT8 && variable.data != nullptr) {
      test.label = to_utf8({static_cast<const char*>(variable.data), size_of(variable)});
      return;
    }
    const auto values = vector(name, variable);
    if (!values) return;
    if (values->size() == 1) {
      test.label = core::format_number(values->front());
      return;
    }
    row_labels_.emplace();
    label_count_ = values->size();
    for (std::size_t row = 0; row < values->size(); ++row)
      if (row == 0 || (*values)[row] != (*values)[row - 1])
        row_labels_->push_back({core::format_number((*values)[row]), row});
  }

  void check_lengths(const TestColumns& test) {
    const auto length = [](const DataColumn& column) { return column.values.size(); };
    bool alike = !row_labels_ || label_count_ == length(test.columns.front());
    std::string lengths = row_labels_ ? "sweep " + std::to_string(label_count_) : "";
    for (const DataColumn& column : test.columns) {
      alike = alike && length(column) == length(test.columns.front());
      lengths +=
          (lengths.empty() ? "" : ", ") + std::string(column.known->name) + " " + std::to_string(length(column));
    }
    if (!alike) complain("the vectors are not of the same length", "vectors of equal length", lengths);
    problems_.throw_if_any();
  }

  void add_times(TestColumns& test, const std::optional<double>& step) {
    const auto has = [&test](std::string_view name) {
      return std::ranges::any_of(test.columns, [name](const DataColumn& c) { return c.known->name == name; });
    };
    if (!step || has("Y")) return;
    if (has("t")) {
      warnings_.emplace_back("dt and fs are not used: there are times t");
      return;
    }
    std::vector<double> times(test.columns.front().values.size());
    for (std::size_t i = 0; i < times.size(); ++i) times[i] = static_cast<double>(i) * *step;
    test.columns.push_back({known_column("t"), std::move(times)});
  }

  std::string path_;
  std::string file_;
  const ReadOptions& options_;
  Problems problems_;
  std::vector<std::string> warnings_;
  std::vector<Variable> variables_;
  std::optional<std::vector<LabelRun>> row_labels_;
  std::size_t label_count_ = 0;
};

/// A file of a gigabyte in two minutes, whatever is compressed in it, and one of no size in some seconds. Under
/// load the clock on the wall runs faster than the processor's.
IsolationLimits limits_of(const std::string& path) {
  constexpr std::chrono::seconds least{2};
  constexpr std::uintmax_t bytes_a_second = std::uintmax_t{8} << 20U;
  constexpr int load = 8;
  constexpr std::size_t memory = std::size_t{4} << 30U;
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  const std::chrono::seconds time = least + std::chrono::seconds(error ? 0 : size / bytes_a_second);
  return {time, load * time, memory};
}

[[noreturn]] void refuse_unread(const std::string& file, IsolatedEnd end) {
  switch (end) {
    case IsolatedEnd::out_of_time:
      refuse_file(file, "the MATLAB file is damaged: reading it comes to no end", "the whole file");
    case IsolatedEnd::out_of_memory:
      refuse_file(file, "reading the MATLAB file takes more than 4 GiB of memory: it is damaged or too large",
                  "the whole file, or a part of the record");
    case IsolatedEnd::not_started:
      refuse_file(file, "the MATLAB file cannot be read: the system starts no process for it");
    case IsolatedEnd::crashed:
    case IsolatedEnd::done:
      break;
  }
  refuse_damaged_mat(file);
}

}  // namespace

DataTable read_mat(const std::string& path, const ReadOptions& options, Problems& problems,
                   std::vector<std::string>& warnings) {
  check_names(options.units, "unit", options.name, problems);
  check_names(options.columns, "column", options.name, problems);
  problems.throw_if_any();
  const IsolatedResult result = run_isolated(limits_of(path), [&](const ByteSink& sink) {
    silence();
    try {
      send(Reader(path, options).run(), sink);
    } catch (const core::InputError& error) {
      send(error.diagnostics(), sink);
    }
  });
  std::optional<MatContent> content = result.end == IsolatedEnd::done ? receive(result.bytes) : std::nullopt;
  if (!content) refuse_unread(options.name, result.end);
  DataTable table = join(options.name, content->tests);
  if (content->row_labels) table.sweeps = std::move(*content->row_labels);
  std::ranges::move(content->warnings, std::back_inserter(warnings));
  return table;
}

}  // namespace dualdamp::identify
