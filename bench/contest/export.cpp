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
#include "core/numbers.hpp"
#include "core/provenance.hpp"
#include "scenarios/results/files.hpp"
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
void write_case(const std::string& directory, const std::string& name, const identify::Record& record,
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
  scenarios::write_files(directory, files);
}

/// "000001.csv", "000001-decay.csv", "000001-random.csv"
bool is_record(const std::string& name) {
  const std::size_t digits = std::min(name.find_first_not_of("0123456789"), name.size());
  const std::string_view rest = std::string_view(name).substr(digits);
  return digits >= 6 && (rest == ".csv" || rest == "-decay.csv" || rest == "-random.csv");
}

/// Refuses or removes the files of an earlier export: without its key its answers could not be scored, and its
/// decays would be read as those of new cases.
void clear(const std::string& directory, scenarios::FoundCases found) {
  const fs::path folder(directory);
  std::vector<fs::path> old;
  for (const char* name : {"constants.csv", "key.json"})
    if (fs::exists(folder / name)) old.push_back(folder / name);
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder / "cases", error))
    if (is_record(entry.path().filename().string())) old.push_back(entry.path());
  if (old.empty()) return;
  if (found != scenarios::FoundCases::overwrite)
    throw scenarios::EarlierFiles(directory + " holds an earlier export", false);
  for (const fs::path& path : old)
    if (!fs::remove(path, error) && error)
      throw scenarios::OutputError("cannot remove " + path.string() + ": " + error.message());
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

std::size_t export_cases(const StressTest& question, const scenarios::RunContext& context,
                         const std::string& directory) {
  const Grid grid(question);
  clear(directory, context.options.found);
  const Key key = key_of(question, context);
  std::vector<std::size_t> file_of(key.numbers.size());
  for (std::size_t i = 0; i < key.numbers.size(); ++i) file_of[key.numbers[i]] = i + 1;
  std::vector<std::string> constants(key.numbers.size());
  sim::in_parts(grid.motions(), 1, context.options.threads, [&](std::size_t motion, std::size_t) {
    measure_motion(
        grid, context.steady_states(), motion, [](std::size_t) { return true; },
        [&](const MeasuredCase& measured) {
          const std::size_t file = file_of[measured.number];
          write_case(directory + "/cases", six_digits(file), measured.record, measured.responses);
          constants[file - 1] = constants_line(measured);
        });
  });
  scenarios::write_files(directory,
                         {{"constants.csv",
                           [&](std::ostream& out) {
                             out << "case,mass [kg],stiffness [N/m],frequency [rad/s],sigma_x [m],sigma_Y [m]\n";
                             for (std::size_t i = 0; i < constants.size(); ++i)
                               out << i + 1 << constants[i] << "\n";
                           }},
                          key_file(key)});
  return grid.cases();
}

}  // namespace dualdamp::bench
