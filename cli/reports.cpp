#include "cli/reports.hpp"

#include <algorithm>
#include <iostream>
#include <utility>

namespace dualdamp::cli {

void print(const Report& report, const Style& style) {
  if (!style.json && !report.text.empty()) std::cout << report.text << std::flush;
  std::cerr << report.errors;
  if (!style.quiet) std::cerr << report.messages;
}

InOrder::InOrder(std::size_t count, Style style, bool silent)
    : reports_(count), ready_(count, false), style_(style), silent_(silent) {}

void InOrder::put(std::size_t index, Report report) {
  const std::lock_guard lock(mutex_);
  reports_[index] = std::move(report);
  ready_[index] = true;
  for (; next_ < reports_.size() && ready_[next_]; ++next_) {
    if (next_ > 0 && !style_.json && !silent_) std::cout << "\n";
    print(reports_[next_], style_);
  }
}

void InOrder::write_json(std::ostream& out) const {
  if (reports_.size() == 1) return reports_.front().json(out);
  out << "[\n";
  for (std::size_t i = 0; i < reports_.size(); ++i) {
    out << (i == 0 ? "" : ",\n");
    reports_[i].json(out);
  }
  out << "]\n";
}

core::ExitStatus InOrder::worst() const { return std::ranges::max_element(reports_, {}, &Report::status)->status; }

}  // namespace dualdamp::cli
