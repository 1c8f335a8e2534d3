#include "identify/readers/formats/mat_reader.hpp"

#include <hdf5.h>
#include <matio.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <optional>
#include <utility>

#include "core/numbers.hpp"
#include "identify/readers/column_factors.hpp"
#include "identify/readers/formats/mat_content.hpp"
#include "identify/readers/formats/mat_structure.hpp"
#include "identify/readers/formats/mat_text.hpp"
#include "identify/readers/formats/mat_variable.hpp"
#include "identify/readers/isolated.hpp"
#include "identify/readers/text.hpp"

namespace dualdamp::identify {

namespace {

using MatFile = std::unique_ptr<mat_t, decltype([](mat_t* file) { Mat_Close(file); })>;
using Variable = std::unique_ptr<matvar_t, decltype([](matvar_t* variable) { Mat_VarFree(variable); })>;

/// Turns off the messages of the libraries on stderr. This program reports the faults of a file itself.
void silence() {
  Mat_LogInitFunc("dualdamp", [](int, char*) {});
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

/// A variable, a field of a struct, or a part of a matrix, with its name in the file or in the caller's options.
struct Entry {
  std::string name;
  const matvar_t* variable = nullptr;
  std::optional<Slice> slice = {};
};

/// The items of one test: the variables of the file, or the fields of an element of a struct.
using Scope = std::vector<Entry>;

bool is_number(const std::string& text) {
  return !text.empty() && text.size() < 7 && text != "0" &&
         std::ranges::all_of(text, [](char c) { return c >= '0' && c <= '9'; });
}

class Reader {
 public:
  Reader(std::string path, const ReadOptions& options)
      : path_(std::move(path)), file_(options.name), options_(options), factors_(options, problems_, warnings_) {}

  MatContent run() {
    read_variables();
    problems_.throw_if_any();
    MatContent content;
    const std::vector<Scope> scopes = find_scopes();
    for (std::size_t i = 0; i < scopes.size(); ++i) {
      content.tests.push_back(test(scopes[i]));
      if (scopes.size() > 1 && content.tests.back().label.empty())
        content.tests.back().label = std::to_string(i + 1);
    }
    report_missing(content);
    problems_.throw_if_any();
    content.units = factors_.take_units();
    content.row_labels = std::move(row_labels_);
    content.ignored = take_ignored();
    content.warnings = std::move(warnings_);
    return content;
  }

 private:
  [[nodiscard]] std::string column_words(std::string_view name) const {
    return options_.words(core::Setting::column, "x", name);
  }

  /// The warnings about unknown variables and fields.
  std::vector<std::string> take_ignored() {
    std::vector<std::string> ignored = all_ignored("variable", unknown_variables_, options_.words);
    std::ranges::move(all_ignored("field", unknown_fields_, options_.words), std::back_inserter(ignored));
    warnings_.insert(warnings_.begin(), ignored.begin(), ignored.end());
    return ignored;
  }

  void complain(std::string message, std::string allowed = {}, std::string found = {}) {
    problems_.add({{file_, 0, 0, {}}, std::move(message), std::move(allowed), std::move(found), {}});
  }

  /// Reads the variables that are needed, and structs. Others are not read into memory.
  void read_variables() {
    const MatFile file(Mat_Open(path_.c_str(), MAT_ACC_RDONLY));
    const bool is_73 = file && Mat_GetVersion(file.get()) == MAT_FT_MAT73;
    if (!file || (is_73 && !is_whole_hdf5(path_))) refuse_damaged_mat(file_);
    while (true) {
      Variable variable(Mat_VarReadNextInfo(file.get()));
      if (!variable) break;
      const std::string name = to_utf8(variable->name == nullptr ? "" : variable->name);
      listing_.push_back(name + " (" + describe(*variable) + ")");
      has_output_ = has_output_ || is_output(name);
      if (variable->class_type != MAT_C_STRUCT && !is_wanted(name) && !(is_matrix(*variable) && wants_numbered())) {
        if (options_.only.empty()) unknown_variables_.push_back(name);
        continue;
      }
      if (is_73 && variable->class_type == MAT_C_EMPTY && lacks_class(path_, variable->name)) {
        problems_.add(foreign_variable(file_, name));
        continue;
      }
      if (size_of(*variable) > most_mat_values)
        core::refuse({.file = file_}, "variable '" + name + "' holds more than 20 million numbers");
      if (size_of(*variable) > 0 && Mat_VarReadDataAll(file.get(), variable.get()) != 0) refuse_damaged_mat(file_);
      if (matvar_t* again = with_signed_texts(file.get(), *variable)) variable.reset(again);
      variables_.push_back(std::move(variable));
    }
  }

  /// The unit that the name states, if it is used as this column: `x_mm`, `weg_mm`.
  [[nodiscard]] static std::string unit_of(const std::string& name, const KnownColumn& known) {
    Heading named{name, name, {}};
    if (named_column(named) == &known) return named.unit;
    Heading chosen{name, name, {}};
    split_unit(chosen, known);
    return chosen.unit;
  }

  /// The column of a name in the file, and the unit if the name has one: `x_mm`.
  [[nodiscard]] std::pair<const KnownColumn*, std::string> column_of(const std::string& name) const {
    Heading heading{name, name, {}};
    const KnownColumn* known = named_column(heading);
    for (const auto& [column, called] : options_.columns)
      if (called == name) return {known_column(column), unit_of(name, *known_column(column))};
    if (known == nullptr || find_for(options_.columns, *known) != nullptr || !identify::is_wanted(options_, *known))
      return {nullptr, {}};
    return {known, heading.unit};
  }

  /// `dt` or a sample rate beside the vectors.
  [[nodiscard]] static bool is_sampling(const std::string& name) {
    return name == "dt" || name == "fs" || name == "Fs";
  }

  [[nodiscard]] bool is_wanted(const std::string& name) const {
    const auto holds = [&name](const auto& entry) {
      const auto slice = parse_slice(entry.second);
      return slice && slice->variable == name;
    };
    return is_sampling(name) || column_of(name).first != nullptr || std::ranges::any_of(options_.columns, holds);
  }

  /// Columns of the only matrix, which the caller names by their numbers.
  [[nodiscard]] bool wants_numbered() const {
    return std::ranges::any_of(options_.columns, [](const auto& entry) { return is_number(entry.second); });
  }

  /// The parts of matrices that the caller asks for. `prefix`: `run.` for the fields of a struct `run`.
  void add_slices(Scope& scope, const std::string& prefix = {}) {
    std::vector<const matvar_t*> matrices;
    for (const Entry& entry : scope)
      if (is_matrix(*entry.variable)) matrices.push_back(entry.variable);
    Scope slices;
    for (const auto& [column, called] : options_.columns) {
      if (const auto slice = parse_slice(called)) {
        const auto of = std::ranges::find_if(scope, [&](const Entry& entry) {
          return entry.name == slice->variable || prefix + entry.name == slice->variable;
        });
        if (of != scope.end()) slices.push_back({called, of->variable, slice->slice});
      } else if (is_number(called) && matrices.size() == 1) {
        slices.push_back({called, matrices.front(), Slice{false, std::stoul(called) - 1}});
      }
    }
    std::erase_if(scope, [this](const Entry& entry) {
      return is_matrix(*entry.variable) && column_of(entry.name).first == nullptr;
    });
    scope.insert(scope.end(), slices.begin(), slices.end());
  }

  /// Adds a problem for each column that the caller states and the file does not have.
  void report_missing(const MatContent& content) {
    for (const auto& [column, called] : options_.columns) {
      const KnownColumn* known = known_column(column);
      const bool found = std::ranges::any_of(content.tests, [known](const TestColumns& test) {
        return std::ranges::any_of(test.columns, [known](const DataColumn& c) { return c.known == known; });
      });
      if (!found && !known->unit.empty())
        complain("there is no variable '" + called + "' to be used as " + column,
                 "a vector of the file, a field of its struct, or a part of a matrix such as 'data(:,2)'",
                 excerpt(core::joined(listing_, " and ")));
    }
  }

  /// Whether the caller names it as a column.
  [[nodiscard]] bool is_called(const std::string& name) const {
    return std::ranges::any_of(options_.columns, [&name](const auto& entry) { return entry.second == name; });
  }

  [[nodiscard]] bool holds_data(const Scope& scope) const {
    return std::ranges::any_of(scope, [this](const Entry& entry) {
      const KnownColumn* known = column_of(entry.name).first;
      return known != nullptr && (known->is_signal || known->name == "Y");
    });
  }

  std::vector<Scope> find_scopes() {
    Scope whole;
    Scope fields;  // of single structs that the caller names, as `run.x`
    std::vector<std::vector<Scope>> structs;
    for (const Variable& variable : variables_) {
      if (variable->class_type != MAT_C_STRUCT) {
        whole.push_back({variable->name, variable.get()});
        continue;
      }
      std::vector<Scope> elements = elements_of(*variable);
      const std::string prefix = std::string(variable->name) + ".";
      for (Scope& element : elements) {
        for (Entry& entry : element)
          if (is_called(prefix + entry.name)) entry.name = prefix + entry.name;
        add_slices(element, prefix);
        if (elements.size() == 1)
          std::ranges::copy_if(element, std::back_inserter(fields),
                               [this](const Entry& entry) { return is_called(entry.name); });
      }
      if (!elements.empty() && holds_data(elements.front())) structs.push_back(std::move(elements));
    }
    add_slices(whole);
    // A struct that has all that is asked for has its own times, too.
    const bool is_whole = structs.size() == 1 && std::ranges::all_of(fields, [&](const Entry& asked) {
                            return std::ranges::find(structs.front().front(), asked.name, &Entry::name) !=
                                   structs.front().front().end();
                          });
    if (is_whole && whole.empty()) return std::move(structs.front());
    std::ranges::move(fields, std::back_inserter(whole));
    if (holds_data(whole)) return {whole};
    if (structs.size() == 1) return std::move(structs.front());
    core::refuse({.file = file_},
                 structs.empty() ? "the MATLAB file holds no vector with the name of a column"
                                 : "several structs of the MATLAB file hold signals",
                 "vectors named like the columns, or one struct that holds them: " + std::string(allowed_columns) +
                     "; others by " + column_words("NAME") + ", " + column_words("'data(:,2)'") + ", " +
                     column_words("run.x"),
                 listing_.empty() ? "no variables" : excerpt(core::joined(listing_, " and ")));
  }

  [[nodiscard]] static std::vector<Scope> elements_of(const matvar_t& variable) {
    auto* const record = const_cast<matvar_t*>(&variable);  // matio's functions take no const pointer
    const unsigned fields = Mat_VarGetNumberOfFields(record);
    char* const* const names = Mat_VarGetStructFieldnames(record);
    std::vector<Scope> elements;
    if (variable.data == nullptr || names == nullptr) return elements;
    for (std::size_t i = 0; i < size_of(variable); ++i) {
      Scope scope;
      for (unsigned field = 0; field < fields; ++field)
        if (const matvar_t* value = Mat_VarGetStructFieldByIndex(record, field, i))
          scope.push_back({names[field], value});
      elements.push_back(std::move(scope));
    }
    return elements;
  }

  TestColumns test(const Scope& scope) {
    TestColumns result;
    std::optional<double> step;
    has_output_ = has_output_ || std::ranges::any_of(scope, is_output, &Entry::name);
    for (const Entry& entry : scope) {
      const auto& [known, unit] = column_of(entry.name);
      if (is_sampling(entry.name)) {
        take_step(entry, step);
      } else if (known == nullptr) {
        const std::string name = to_utf8(entry.name);  // the same in each element of a struct
        if (options_.only.empty() && std::ranges::find(unknown_fields_, name) == unknown_fields_.end())
          unknown_fields_.push_back(name);
      } else if (known->unit.empty()) {
        take_label(entry, result);
      } else {
        take(entry, *known, unit, result);
      }
    }
    problems_.throw_if_any();
    check_lengths(result);
    add_times(result, step);
    return result;
  }

  /// The real numbers of a row or column; `gaps`: it may hold NaN. Nothing after a problem.
  std::optional<std::vector<double>> vector(const Entry& entry, bool gaps = false) {
    const matvar_t& variable = *entry.variable;
    const std::string subject = "variable '" + to_utf8(entry.name) + "'";
    const bool numeric = variable.class_type >= MAT_C_DOUBLE && variable.class_type <= MAT_C_UINT64;
    const auto long_sides =
        std::count_if(variable.dims, variable.dims + variable.rank, [](std::size_t side) { return side > 1; });
    std::string fault;
    if (variable.class_type == MAT_C_EMPTY || size_of(variable) == 0)
      fault = " is empty";
    else if (variable.class_type == MAT_C_CHAR)
      fault = " is text";
    else if (variable.class_type == MAT_C_STRUCT)
      fault = " is a struct: fields of one level are read, as run.x";
    else if (!numeric)
      fault = " is not a vector of numbers";
    else if (variable.isComplex != 0)
      fault = " holds complex numbers";
    else if (long_sides > 1 && !entry.slice)
      fault = " is a matrix";
    else if (entry.slice && entry.slice->index >= variable.dims[entry.slice->is_row ? 0 : 1])
      fault = " is beyond the last " + std::string(entry.slice->is_row ? "row" : "column");
    if (!fault.empty()) {
      complain(subject + fault,
               "a vector of real numbers" +
                   (long_sides > 1 ? ", such as " + column_words("'data(:,2)'") : std::string()),
               variable.rank > 0 ? describe(variable) : std::string());
      return std::nullopt;
    }
    auto values = numbers(variable);
    if (!values) refuse_damaged_mat(file_);
    if (entry.slice) values = part_of(*values, variable, *entry.slice);
    const auto bad = std::ranges::find_if(
        *values, [gaps](double value) { return !std::isfinite(value) && !(gaps && std::isnan(value)); });
    if (bad == values->end()) return values;
    complain("element " + std::to_string(bad - values->begin() + 1) + " of " + subject + " is not a finite number",
             "finite numbers");
    return std::nullopt;
  }

  std::optional<double> scalar(const Entry& entry) {
    const auto values = vector(entry);
    if (!values) return std::nullopt;
    if (values->size() == 1 && values->front() > 0.0) return values->front();
    complain("variable '" + entry.name + "' is not one number above zero");
    return std::nullopt;
  }

  /// The file may have both `dt` and a rate, if they agree.
  void take_step(const Entry& entry, std::optional<double>& step) {
    const auto value = scalar(entry);
    if (!value) return;
    const double stated = entry.name == "dt" ? *value : 1.0 / *value;
    constexpr double rounding = 1e-6;
    if (step && !(std::abs(stated - *step) <= rounding * *step))
      complain("dt and the sample rate contradict each other", "one of them, or equal values",
               "steps of " + core::format_number(*step, 6) + " s and " + core::format_number(stated, 6) + " s");
    step = stated;
  }

  void take(const Entry& entry, const KnownColumn& known, const std::string& unit, TestColumns& test) {
    auto values = vector(entry, known.may_lack);
    if (!values) return;
    core::Diagnostic where;
    where.place.file = file_;
    where.found = "variable '" + to_utf8(entry.name) + "'";
    if (std::ranges::any_of(test.columns, [&](const DataColumn& column) { return column.known == &known; }))
      return complain("column " + std::string(known.name) + " appears twice", {}, where.found);
    factors_.check_suffix(known, to_utf8(entry.name), unit, has_output_, where);
    factors_.check_amplitude(known, to_utf8(entry.name), unit, where);
    // `omega` means rad/s; the word "frequency" does not state a unit.
    const double factor = factors_.factor_of(known, unit.empty() && entry.name == "omega" ? "rad/s" : unit, where);
    for (double& value : *values) value *= factor;
    test.columns.push_back({&known, std::move(*values)});
  }

  /// One text or number is the label of the test; several are the labels of its rows.
  void take_label(const Entry& entry, TestColumns& test) {
    auto labels = texts(*entry.variable);
    const matio_classes type = entry.variable->class_type;
    if (!labels && (type == MAT_C_CHAR || type == MAT_C_CELL))
      return complain("variable '" + to_utf8(entry.name) + "' holds no text that can be read",
                      instead_of_labels(*entry.variable), describe(*entry.variable));
    if (!labels) {
      const auto values = vector(entry);
      if (!values) return;
      labels.emplace();
      for (const double value : *values) labels->push_back(core::format_number(value));
    }
    if (labels->size() == 1) {
      test.label = labels->front();
      return;
    }
    label_count_ = labels->size();
    row_labels_ = runs_of(*labels);
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
      warnings_.emplace_back("dt and Fs are not used: there are times t");
      return;
    }
    std::vector<double> times(test.columns.front().values.size());
    const KnownColumn& t = *known_column("t");
    core::Diagnostic where;
    where.place.file = file_;
    const double unit = factors_.factor_of(t, "s", where);
    for (std::size_t i = 0; i < times.size(); ++i) times[i] = static_cast<double>(i) * *step * unit;
    test.columns.push_back({&t, std::move(times)});
  }

  std::string path_;
  std::string file_;
  const ReadOptions& options_;
  Problems problems_;
  std::vector<std::string> warnings_;
  std::vector<std::string> unknown_variables_, unknown_fields_;
  ColumnFactors factors_;
  std::vector<std::string> listing_;  ///< all variables with their sizes
  std::vector<Variable> variables_;
  std::optional<std::vector<LabelRun>> row_labels_;
  std::size_t label_count_ = 0;
  bool has_output_ = false;  ///< a variable or field is named `x_out`
};

}  // namespace

DataTable read_mat(const std::string& path, const ReadOptions& options, Problems& problems,
                   std::vector<std::string>& warnings) {
  check_names(options, problems);
  problems.throw_if_any();
  const IsolatedResult result = run_isolated(mat_limits(path), [&](const ByteSink& sink) {
    silence();
    try {
      send(Reader(path, options).run(), sink);
    } catch (const core::InputError& error) {
      send(error.diagnostics(), sink);
    }
  });
  std::optional<MatContent> content = result.end == IsolatedEnd::done ? receive(result.bytes) : std::nullopt;
  if (!content) refuse_unread_mat(options.name, result.end);
  DataTable table = join(options.name, content->tests);
  table.units = std::move(content->units);
  table.ignored = std::move(content->ignored);
  if (content->row_labels) table.sweeps = std::move(*content->row_labels);
  std::ranges::move(content->warnings, std::back_inserter(warnings));
  return table;
}

}  // namespace dualdamp::identify
