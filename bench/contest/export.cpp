#include "bench/contest/export.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <ostream>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "bench/case.hpp"
#include "bench/grid.hpp"
#include "core/diagnostics.hpp"
#include "core/numbers.hpp"
#include "core/provenance.hpp"
#include "scenarios/results/staged_files.hpp"
#include "sim/parallel.hpp"

namespace dualdamp::bench {

namespace fs = std::filesystem;

namespace {

using identify::Pair;
using scenarios::OutputFile;

/// Columns of equal length under their headings; those that were not measured are left out.
struct Columns {
  std::vector<std::string> names;
  std::vector<std::vector<double>> values;

  void add(std::string name, std::vector<double> column) {
    if (column.empty() || std::ranges::any_of(column, [](double v) { return std::isnan(v); })) return;
    names.push_back(std::move(name));
    values.push_back(std::move(column));
  }

  void write_header(std::ostream& out, bool has_sweeps) const {
    for (std::size_t i = 0; i < names.size(); ++i) out << (i == 0 ? "" : ",") << names[i];
    out << (has_sweeps ? ",sweep\n" : "\n");
  }
  /// `sweep_of`: label of a row; empty: there is no such column.
  void write_rows(std::ostream& out, const std::function<std::string(std::size_t row)>& sweep_of) const {
    for (std::size_t row = 0; !values.empty() && row < values.front().size(); ++row) {
      for (std::size_t i = 0; i < values.size(); ++i)
        out << (i == 0 ? "" : ",") << core::format_number(values[i][row]);
      const std::string sweep = sweep_of(row);
      out << (sweep.empty() ? "" : ",") << sweep << "\n";
    }
  }
};

void write_pairs(std::ostream& out, const std::vector<Pair>& pairs) {
  if (pairs.empty()) {  // nothing could be measured
    out << "Y [m],x [m]\n";
    return;
  }
  Columns columns;
  for (const auto& [name, member] :
       {std::pair("Y [m]", &Pair::Y), std::pair("x [m]", &Pair::x), std::pair("omega [rad/s]", &Pair::omega),
        std::pair("phase [rad]", &Pair::phase), std::pair("fundamental [m]", &Pair::fundamental),
        std::pair("mean_square_speed [m^2/s^2]", &Pair::mean_square_speed)}) {
    std::vector<double> column;
    for (const Pair& pair : pairs) column.push_back(pair.*member);
    columns.add(name, std::move(column));
  }
  columns.write_header(out, !pairs.front().sweep.empty());
  columns.write_rows(out, [&](std::size_t row) { return pairs[row].sweep; });
}

Columns columns_of(const identify::History& history) {
  Columns columns;
  std::vector<double> times(history.x.size());
  for (std::size_t i = 0; i < times.size(); ++i)
    times[i] = history.start + static_cast<double>(i) / history.sample_rate;
  columns.add("t [s]", std::move(times));
  columns.add("x [m]", history.x);
  columns.add("y [m]", history.y);
  columns.add("v [m/s]", history.v);
  columns.add("a [m/s^2]", history.a);
  columns.add("force [N]", history.force);
  return columns;
}

void write_alone(std::ostream& out, const Columns& columns) {
  columns.write_header(out, false);
  columns.write_rows(out, [](std::size_t) { return std::string(); });
}

void write_histories(std::ostream& out, std::span<const identify::History> histories) {
  for (std::size_t i = 0; i < histories.size(); ++i) {
    const Columns columns = columns_of(histories[i]);
    if (i == 0) columns.write_header(out, true);
    columns.write_rows(out, [&](std::size_t) { return std::to_string(i + 1); });
  }
}

void write_decay(std::ostream& out, const identify::DecayRecord& decay) {
  Columns columns;
  columns.add("t [s]", decay.times);
  columns.add("x [m]", decay.extremes);
  write_alone(out, columns);
}

std::string six_digits(std::size_t number) {
  const std::string text = std::to_string(number);
  return std::string(text.size() < 6 ? 6 - text.size() : 0, '0') + text;
}

/// `responses`: how many histories at the end of the record are responses to a random drive, none or one.
void write_case(scenarios::StagedFiles& cases, const std::string& name, const identify::Record& record,
                std::size_t responses) {
  std::vector<OutputFile> files;
  const std::span histories(record.histories);
  const std::span sampled = histories.first(histories.size() - responses);
  files.push_back({name + ".csv", [&record, sampled](std::ostream& out) {
                     if (!sampled.empty())
                       write_histories(out, sampled);
                     else if (record.pairs)
                       write_pairs(out, record.pairs->pairs);
                   }});
  for (const identify::History& response : histories.last(responses))
    files.push_back(
        {name + "-random.csv", [&response](std::ostream& out) { write_alone(out, columns_of(response)); }});
  if (record.decay)
    files.push_back({name + "-decay.csv", [&record](std::ostream& out) { write_decay(out, *record.decay); }});
  for (const OutputFile& file : files) cases.write(file);
}

constexpr const char* head_of_constants =
    "case,mass [kg],stiffness [N/m],frequency [rad/s],sigma_x [m],sigma_Y [m]";

/// "000001.csv", "000001-decay.csv", "000001-random.csv"
bool is_name_of_record(const std::string& name) {
  const std::size_t digits = std::min(name.find_first_not_of("0123456789"), name.size());
  const std::string_view rest = std::string_view(name).substr(digits);
  return digits >= 6 && (rest == ".csv" || rest == "-decay.csv" || rest == "-random.csv");
}

/// As far as it may tell a file of an export from others; empty if there is no file.
std::string first_line(const fs::path& path) {
  constexpr std::size_t enough = 200;
  if (std::error_code error; !fs::is_regular_file(path, error)) return {};
  const std::string beginning = scenarios::beginning_of(path.string(), enough);
  return beginning.substr(0, beginning.find('\n'));
}

bool is_key(const fs::path& path) {
  try {
    return !read_key(path.string()).numbers.empty();
  } catch (const core::InputError&) {
    return false;
  }
}

/// Files whose names an export needs, or that would be read as records of its cases.
struct FoundFiles {
  std::vector<fs::path> exported;
  std::vector<fs::path> others;
};

/// Records hold no mark, so that they do not tell from which case they are: they are taken for exported ones where
/// the constants of an export lie beside them, and the first line is that of a record.
FoundFiles found_files(const fs::path& folder) {
  FoundFiles found;
  const auto add = [&](const fs::path& path, bool is_exported) {
    (is_exported ? found.exported : found.others).push_back(path);
  };
  const bool has_constants = first_line(folder / "constants.csv") == head_of_constants;
  if (fs::exists(folder / "constants.csv")) add(folder / "constants.csv", has_constants);
  if (fs::exists(folder / "key.json")) add(folder / "key.json", is_key(folder / "key.json"));
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder / "cases", error)) {
    if (!is_name_of_record(entry.path().filename().string())) continue;
    const std::string line = first_line(entry.path());
    add(entry.path(), has_constants && (line.starts_with("Y [m],x [m]") || line.starts_with("t [s],x [m]")));
  }
  return found;
}

/// Without its key the answers to an earlier export could not be scored.
void refuse_exported(const std::string& directory, scenarios::FoundCases found) {
  if (found != scenarios::FoundCases::overwrite && !found_files(directory).exported.empty())
    throw scenarios::EarlierFiles(directory + " holds an earlier export", false);
}

/// The decays of an earlier export would be read as those of new cases. Returns messages about files of others.
std::vector<std::string> clear(const std::string& directory) {
  const FoundFiles found = found_files(directory);
  std::vector<std::string> messages;
  for (const fs::path& path : found.others) messages.push_back(scenarios::set_aside(path.string()));
  std::error_code error;
  for (const fs::path& path : found.exported)
    if (!fs::remove(path, error) && error)
      throw scenarios::OutputError("cannot remove " + path.string() + ": " + error.message());
  return messages;
}

/// One line of constants.csv.
std::string constants_line(const MeasuredCase& measured) {
  const identify::Sensors& sensors = measured.sensors.sensors;
  const double periods = sensors.average_cycles;
  std::string line;
  for (const double value :
       {measured.constants.mass, measured.constants.stiffness, measured.constants.frequency,
        sensors.x.noise / std::sqrt(2.0 * periods), sensors.y.noise / std::sqrt(2.0 * periods)})
    line += "," + core::format_number(value);
  return line;
}

}  // namespace

Key key_of(const StressTest& question, const scenarios::RunContext& context) {
  return make_key(core::sha256(context.resolved), question.seed, Grid(question).cases());
}

Exported export_cases(const StressTest& question, const scenarios::RunContext& context,
                      const std::string& directory) {
  const Grid grid(question);
  refuse_exported(directory, context.options.found);
  scenarios::StagedFiles staged(directory);
  scenarios::StagedFiles cases(directory + "/cases");
  const Key key = key_of(question, context);
  std::vector<std::size_t> file_of(key.numbers.size());
  for (std::size_t i = 0; i < key.numbers.size(); ++i) file_of[key.numbers[i]] = i + 1;
  std::vector<std::string> constants(key.numbers.size());
  sim::in_parts(grid.motions(), 1, context.options.threads, [&](std::size_t motion, std::size_t) {
    measure_motion(
        grid, context.steady_states(), motion, [](std::size_t) { return true; },
        [&](const MeasuredCase& measured) {
          const std::size_t file = file_of[measured.number];
          write_case(cases, six_digits(file), measured.record, measured.responses);
          constants[file - 1] = constants_line(measured);
        });
  });
  staged.write({"constants.csv", [&](std::ostream& out) {
                  out << head_of_constants << "\n";
                  for (std::size_t i = 0; i < constants.size(); ++i) out << i + 1 << constants[i] << "\n";
                }});
  staged.write(key_file(key));
  Exported exported{grid.cases(), clear(directory)};
  cases.publish();
  staged.publish();
  return exported;
}

}  // namespace dualdamp::bench
