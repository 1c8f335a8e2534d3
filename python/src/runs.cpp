#include <pybind11/functional.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <sstream>
#include <variant>

#include "bench/analyses.hpp"
#include "bench/contest/contest.hpp"
#include "bench/contest/export.hpp"
#include "bench/stress_test.hpp"
#include "cli/report/result_directory.hpp"
#include "core/numbers.hpp"
#include "python/src/interruptible.hpp"
#include "python/src/parts.hpp"
#include "scenarios/format/json_text.hpp"
#include "scenarios/output.hpp"
#include "scenarios/results/prediction_keys.hpp"
#include "scenarios/results/shown_units.hpp"
#include "scenarios/run.hpp"
#include "scenarios/scenario.hpp"
#include "sim/parallel.hpp"

namespace dualdamp::python {

namespace py = pybind11;

namespace {

/// The source of a scenario, and the values that replace its own.
struct Source {
  std::string text;  ///< of the scenario; empty if it is the file `name`
  std::string name;  ///< of the file, or for messages
  bool is_file = false;
  bool data_anywhere = false;                    ///< data files may be outside the scenario's directory
  std::map<std::string, std::string> data = {};  ///< data in memory
  std::vector<std::string> set = {};             ///< PATH=VALUE
};

struct Settings {
  std::string directory = {};
  int threads = 0;
  scenarios::FoundCases found = scenarios::FoundCases::refuse;  ///< what to do with cases of an earlier run
  std::string key = {};  ///< of an exported stress test whose answers are scored; empty: an ordinary run
  std::vector<std::pair<std::string, std::string>> answers = {};  ///< name and file
};

/// The keys of a scenario, and the function that loads a plugin.
std::string words_of_python(core::Setting setting, std::string_view name, std::string_view value) {
  return setting == core::Setting::plugin ? "with load_plugin(LIB)" : core::key_of_setting(setting, name, value);
}

scenarios::Scenario load(const Source& source, const std::vector<scenarios::Override>& values = {}) {
  scenarios::LoadOptions options{
      .data_anywhere = source.data_anywhere, .words = words_of_python, .analyses = bench::analyses()};
  for (const auto& [name, text] : source.data) options.data_texts.emplace(name, text);
  for (const std::string& assignment : source.set) options.set.push_back({assignment, "set"});
  options.set.insert(options.set.end(), values.begin(), values.end());
  if (source.is_file) return scenarios::load_scenario(source.name, options);
  return scenarios::parse_scenario(source.text, source.name, options);
}

bench::ContestLoader loader(const Source& source) {
  return [&source](const std::vector<scenarios::Override>& values) { return load(source, values); };
}

scenarios::Scenario load(const Source& source, const Settings& settings) {
  if (settings.key.empty()) return load(source);
  std::vector<bench::Answers> answers;
  for (const auto& [name, file] : settings.answers) answers.push_back({name, file});
  return bench::scored_scenario(loader(source), settings.key, answers);
}

/// A temporary directory for the cases that a stress test or sweep writes while it runs, if no directory is stated.
class TemporaryDirectory {
 public:
  TemporaryDirectory() : path_((std::filesystem::temp_directory_path() / "dualdamp-XXXXXX").string()) {
    if (::mkdtemp(path_.data()) == nullptr) throw scenarios::OutputError("cannot make a directory " + path_);
  }
  ~TemporaryDirectory() {
    std::error_code error;
    std::filesystem::remove_all(path_, error);
  }
  TemporaryDirectory(const TemporaryDirectory&) = delete;
  TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;

  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  std::string path_;
};

/// A scenario with its result.
struct Run {
  std::shared_ptr<const scenarios::Scenario> scenario;
  std::shared_ptr<const scenarios::RunResult> result;
};

/// If the number is not stated, one for laws written in Python: threads would wait for the interpreter's lock, and
/// take longer than one.
int threads_for(const scenarios::Scenario& scenario, int stated) {
  return stated == 0 && names_a_law_of_python(scenario.resolved) ? 1 : stated;
}

/// Runs on a limited number of threads. Runs of other threads of Python keep theirs.
scenarios::RunResult run_limited(const scenarios::Scenario& scenario, const scenarios::RunOptions& options) {
  if (options.threads == 0) return scenarios::run(scenario, options);
  scenarios::RunResult result;
  const auto work = [&](std::size_t, std::size_t) { result = scenarios::run(scenario, options); };
  sim::in_parts(1, 1, options.threads, work);
  return result;
}

scenarios::RunResult compute(const scenarios::Scenario& scenario, const Settings& settings, ProgressCall& told) {
  const bool is_campaign = dynamic_cast<const scenarios::Campaign*>(scenario.question.get()) != nullptr;
  if (!is_campaign && settings.found != scenarios::FoundCases::refuse)
    throw py::type_error("resume and overwrite are for a stress test or a sweep; this scenario is neither");
  scenarios::RunOptions options{
      .directory = settings.directory, .threads = threads_for(scenario, settings.threads), .found = settings.found};
  if (told.is_wanted())
    options.progress = [&](const scenarios::Progress& progress) { told(progress.done, progress.all); };
  std::optional<TemporaryDirectory> temporary;
  if (options.directory.empty() && is_campaign) options.directory = temporary.emplace().path();
  return run_limited(scenario, options);
}

Run run(const Source& source, const Settings& settings, std::optional<ProgressCall::Function> progress) {
  ProgressCall told(std::move(progress));
  Run done;
  interruptible(
      [&] {
        done.scenario = std::make_shared<const scenarios::Scenario>(load(source, settings));
        done.result = std::make_shared<const scenarios::RunResult>(compute(*done.scenario, settings, told));
        return true;
      },
      &told);
  return done;
}

/// Exports a stress test. Returns the number of cases, and messages. `seed`: empty for a hidden one.
py::tuple export_cases(const Source& source, const std::string& directory, const std::string& seed, int threads,
                       bool overwrite) {
  const bench::Exported exported = interruptible([&] {
    const scenarios::Scenario scenario =
        bench::contest_scenario(loader(source), seed.empty() ? bench::hidden_seed() : seed, "seed");
    scenarios::RunOptions options{.directory = directory, .threads = threads_for(scenario, threads)};
    if (overwrite) options.found = scenarios::FoundCases::overwrite;
    return bench::export_cases(*bench::stress_test_of(*scenario.question), scenarios::context_of(scenario, options),
                               directory);
  });
  return py::make_tuple(exported.cases, exported.messages);
}

std::string document(const Run& run) {
  std::ostringstream out;
  scenarios::json_document(run.scenario, run.result)(out);
  return std::move(out).str();
}

/// Writes the files that the program writes. Returns its messages.
std::vector<std::string> save(const Run& run, const std::string& directory) {
  const core::Provenance& provenance = run.result->provenance;
  scenarios::StagedFiles staged(directory);
  return cli::write_results(staged, provenance.source, provenance.data_sha256,
                            scenarios::output_files(run.scenario, run.result));
}

/// The numbers of a column without a copy; or its texts, as the distinct texts and the index of the text of each
/// row.
py::object cells_of(const scenarios::Column& column, const py::object& owner) {
  if (column.kind != scenarios::CellKind::text) {
    py::array_t<double> cells(static_cast<py::ssize_t>(column.numbers.size()), column.numbers.data(), owner);
    cells.attr("setflags")(py::arg("write") = false);
    return cells;
  }
  if (column.choices.empty()) return py::make_tuple(column.texts, py::none());
  return py::make_tuple(column.texts, py::array_t<std::uint32_t>(static_cast<py::ssize_t>(column.choices.size()),
                                                                 column.choices.data()));
}

/// [(name, key in the result, [(column, unit, kind, cells)])], without the tables that are only printed.
py::list tables_of(const py::object& self) {
  static constexpr const char* kinds[] = {"number", "count", "truth", "text"};
  py::list tables;
  for (const scenarios::Table& table : self.cast<const Run&>().result->tables) {
    if (!table.is_file) continue;
    py::list columns;
    for (const scenarios::Column& column : table.columns)
      columns.append(py::make_tuple(column.name, column.unit, kinds[static_cast<std::size_t>(column.kind)],
                                    cells_of(column, self)));
    tables.append(py::make_tuple(table.name, table.key, columns));
  }
  return tables;
}

/// The unit in which each column is shown, and the factor from SI, by table and column.
py::dict shown_units_of(const Run& run) {
  const scenarios::ShownUnits units = scenarios::shown_units(run.scenario->written_units);
  py::dict tables;
  for (const scenarios::Table& table : run.result->tables) {
    py::dict columns;
    for (const scenarios::Column& column : table.columns) {
      double largest = 0.0;
      for (const double number : column.numbers)
        if (std::isfinite(number)) largest = std::max(largest, std::abs(number));
      const auto shown = scenarios::shown_unit(units, scenarios::kind_of(column.unit, column.name), largest);
      columns[py::str(column.name)] =
          shown ? py::make_tuple(shown->unit, shown->factor) : py::make_tuple(column.unit, 1.0);
    }
    tables[py::str(table.name)] = columns;
  }
  return tables;
}

using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;
/// A column of data: its heading, and numbers or texts as fields of a CSV file.
using DataColumn = std::pair<std::string, std::variant<Numbers, std::vector<std::string>>>;

/// The text of a CSV file, whose numbers read back to the same bits.
std::string csv_text(const std::vector<DataColumn>& columns, std::size_t rows) {
  std::string text;
  for (const auto& [head, cells] : columns) text += (text.empty() ? "" : ",") + head;
  for (std::size_t row = 0; row < rows; ++row) {
    const char* separator = "\n";
    for (const auto& [head, cells] : columns) {
      text += separator;
      if (const auto* texts = std::get_if<std::vector<std::string>>(&cells))
        text += texts->at(row);
      else
        text += core::format_number(std::get<Numbers>(cells).at(row));
      separator = ",";
    }
  }
  return text + "\n";
}

void add_run_class(py::module_& module) {
  py::class_<Run>(module, "Run")
      .def_property_readonly("status", [](const Run& run) { return static_cast<int>(run.result->status); })
      .def_property_readonly("analysis", [](const Run& run) { return run.scenario->analysis_name; })
      .def_property_readonly("failure", [](const Run& run) { return run.result->failure; })
      .def_property_readonly("warnings", [](const Run& run) { return run.result->warnings; })
      .def_property_readonly("scenario", [](const Run& run) { return run.scenario->resolved; })
      .def_property_readonly("numbers", [](const Run& run) { return run.result->result; })
      .def_property_readonly("shown_units", &shown_units_of)
      .def("tables", &tables_of)
      .def("document", &document, py::call_guard<Unlocked>())
      .def("save", &save, py::arg("directory"), py::call_guard<Unlocked>());
}

}  // namespace

void add_runs(py::module_& module) {
  py::class_<Source>(module, "Source")
      .def(py::init<std::string, std::string, bool, bool, std::map<std::string, std::string>,
                    std::vector<std::string>>(),
           py::arg("text"), py::arg("name"), py::arg("is_file") = false, py::arg("data_anywhere") = false,
           py::arg("data") = std::map<std::string, std::string>{}, py::arg("set") = std::vector<std::string>{});
  add_run_class(module);
  module.def(
      "run",
      [](const Source& source, const std::string& directory, int threads, bool resume, bool overwrite,
         std::optional<ProgressCall::Function> progress, const std::string& key,
         std::vector<std::pair<std::string, std::string>> answers) {
        return run(source,
                   {directory, threads,
                    resume      ? scenarios::FoundCases::resume
                    : overwrite ? scenarios::FoundCases::overwrite
                                : scenarios::FoundCases::refuse,
                    key, std::move(answers)},
                   std::move(progress));
      },
      py::arg("source"), py::arg("directory") = "", py::arg("threads") = 0, py::arg("resume") = false,
      py::arg("overwrite") = false, py::arg("progress") = py::none(), py::arg("key") = "",
      py::arg("answers") = std::vector<std::pair<std::string, std::string>>{});
  module.def("export_cases", &export_cases, py::arg("source"), py::arg("directory"), py::arg("seed"),
             py::arg("threads"), py::arg("overwrite"));
  module.def(
      "prediction_keys",
      [](const Run& fit) {
        return scenarios::prediction_keys(scenarios::parse_json(document(fit)).at("result")).dump();
      },
      py::arg("fit"));
  module.def("resolved", [](const Source& source) { return load(source).resolved; }, py::arg("source"));
  module.def("csv_text", &csv_text, py::arg("columns"), py::arg("rows"));
}

}  // namespace dualdamp::python
