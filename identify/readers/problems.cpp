#include "identify/readers/problems.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

namespace dualdamp::identify {

namespace {

constexpr std::size_t most_problems = 20;

}  // namespace

void Problems::add(core::Diagnostic diagnostic) {
  const std::string kind = diagnostic.place.line > 0 ? diagnostic.message : std::string();
  add(std::move(diagnostic), kind);
}

void Problems::add(core::Diagnostic diagnostic, const std::string& kind) {
  if (repeats(kind, diagnostic.place.line)) return;
  add(std::move(diagnostic), 0, {});
  groups_.back().kind = kind;
}

bool Problems::repeats(std::string_view kind, int line) {
  const auto same = kind.empty() ? groups_.end() : std::ranges::find(groups_, kind, &Group::kind);
  if (same == groups_.end()) return false;
  // Problems of two fields in one row count as one row.
  if (line == same->last_line) return true;
  same->last_line = line;
  ++same->others;
  if (same->lines.size() < most_lines) same->lines.push_back(line);
  return true;
}

void Problems::add(core::Diagnostic diagnostic, std::size_t others, std::vector<int> lines) {
  const int line = diagnostic.place.line;
  groups_.push_back({diagnostic.message, std::move(diagnostic), line, others, std::move(lines)});
  if (groups_.size() < most_problems) return;
  core::Diagnostic end;
  end.place.file = groups_.back().first.place.file;
  end.message = "too many problems; those after the first " + std::to_string(most_problems) + " are not listed";
  std::vector<core::Diagnostic> all = diagnostics();
  all.push_back(std::move(end));
  throw core::InputError(std::move(all));
}

std::vector<core::Diagnostic> Problems::diagnostics() const {
  std::vector<core::Diagnostic> all;
  for (const Group& group : groups_) {
    all.push_back(group.first);
    if (group.others == 0) continue;
    std::vector<std::string> lines;
    for (const int line : group.lines) lines.push_back(std::to_string(line));
    all.back().message +=
        "; the same in " + std::to_string(group.others) + " more row" + (group.others == 1 ? "" : "s");
    if (group.first.place.line > 0 && !group.lines.empty())
      all.back().message += " (line" + std::string(group.others == 1 ? " " : "s ") + core::joined(lines) +
                            (group.others > group.lines.size() ? ", ...)" : ")");
  }
  std::ranges::sort(all, {},
                    [](const core::Diagnostic& d) { return std::tuple(d.place.line, d.place.column, d.message); });
  return all;
}

void Problems::throw_if_any() const {
  if (!groups_.empty()) throw core::InputError(diagnostics());
}

}  // namespace dualdamp::identify
