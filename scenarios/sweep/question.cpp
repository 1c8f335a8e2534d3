#include "scenarios/sweep/question.hpp"

#include <cerrno>
#include <fstream>
#include <utility>

#include "core/diagnostics.hpp"
#include "core/input_file.hpp"
#include "core/provenance.hpp"
#include "scenarios/analyses/shared/long_run.hpp"
#include "scenarios/results/files.hpp"
#include "scenarios/run.hpp"

namespace dualdamp::scenarios {

std::string SweepQuestion::size(const RunContext& /*context*/) const {
  std::string text = std::to_string(points_.size()) + " points: ";
  const char* separator = "";
  for (const SweptKey& key : points_.swept().keys) {
    text += separator + key.path + " (" + std::to_string(key.values.size()) + " values)";
    separator = ", ";
  }
  return text;
}

Answer SweepQuestion::run(const RunContext& context) const {
  const RunOptions& options = context.options;
  std::vector<std::string> lines(points_.size());
  std::string damage;
  if (options.directory.empty()) {
    Meter meter(0, points_.size(), options);
    share_out(points_.size(), options, [&](std::size_t point) {
      lines[point] = line(point, options);
      meter.add();
    });
  } else if (!run_with_file(context, lines, damage)) {
    return {};
  }
  try {
    Answer answer = answer_of_sweep(lines, columns_, fields_, main_);
    if (!damage.empty()) answer.warnings.push_back(std::move(damage));
    return answer;
  } catch (const Json::exception&) {
    // Lines of an earlier run, which may have been changed.
    core::Diagnostic problem{.message = "a line does not hold a point of this sweep",
                             .allowed = "the lines that this sweep wrote; or overwrite them"};
    problem.place.file = options.directory + "/points.jsonl";
    throw core::InputError(std::move(problem));
  }
}

std::string SweepQuestion::line(std::size_t point, const RunOptions& options) const {
  return line_of(point, columns_, scenarios::run(points_.scenario(point), {.threads = options.threads}));
}

bool SweepQuestion::run_with_file(const RunContext& context, std::vector<std::string>& lines,
                                  std::string& damage) const {
  const RunOptions& options = context.options;
  ProcessGroup& processes = *options.processes;
  CaseFile file(options.directory, "points", fingerprint(context.resolved + "\n" + inputs_), points_.size(),
                processes.rank());
  open_cases(file, points_.size(), options);
  Meter meter(file.finished(), points_.size(), options);
  share_out(points_.size(), options, [&](std::size_t point) {
    if (file.is_finished(point)) return;
    file.add(line(point, options));
    meter.add();
  });
  if (processes.rank() != 0) file.close();
  processes.wait();
  if (processes.rank() != 0) return false;
  file.finish();
  damage = file.damage();
  std::ifstream finished(file.path());
  if (!finished) core::fail_to_read(file.path(), "cannot be opened", errno);
  std::string head;
  std::getline(finished, head);
  for (std::string& line : lines) std::getline(finished, line);
  if (!finished) throw OutputError("points of the sweep are missing in " + file.path());
  return true;
}

}  // namespace dualdamp::scenarios
