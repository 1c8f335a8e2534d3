#include "bench/crosscheck/summary.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace dualdamp::crosscheck {

namespace {

const char* name(Verdict verdict) {
  switch (verdict) {
    case Verdict::agreed:
      return "agreed";
    case Verdict::not_compared:
      return "not compared";
    case Verdict::refused:
      return "refused with a message";
    case Verdict::exception:
      return "named exception";
    case Verdict::disagree:
      return "DISAGREE";
  }
  return "";
}

/// A reason without its numbers, so that equal reasons are counted together.
std::string kind_of(const std::string& reason) {
  std::string result;
  bool in_number = false;
  for (const char c : reason) {
    const bool is_digit = c >= '0' && c <= '9';
    const bool goes_on = in_number && (c == '.' || c == 'e' || c == '-' || c == '+');
    if (is_digit && !in_number) result += '#';
    in_number = is_digit || goes_on;
    if (!in_number) result += c;
  }
  return result;
}

std::string counts(const std::string& title, const std::map<std::string, long>& table) {
  if (table.empty()) return {};
  std::string text = "\n" + title + "\n";
  for (const auto& [key, count] : table) text += fmt::format("  {:7}  {}\n", count, key);
  return text;
}

}  // namespace

void Summary::add(const CaseReport& report) {
  ++cases_;
  ++verdicts_[name(report.verdict())];
  for (const std::string& feature : report.features) ++drawn_[feature];
  for (const Finding& finding : report.findings) {
    Comparison& comparison = comparisons_[finding.comparison];
    switch (finding.verdict) {
      case Verdict::agreed:
        ++comparison.agreed;
        comparison.worst = std::max(comparison.worst, finding.worst);
        break;
      case Verdict::not_compared:
        ++comparison.not_compared;
        break;
      case Verdict::refused:
        ++comparison.refused;
        ++refusals_[kind_of(finding.comparison + ": " + finding.text)];
        break;
      case Verdict::exception:
        ++comparison.exceptions;
        ++exceptions_[finding.comparison + ": " + finding.text.substr(0, finding.text.find(':'))];
        break;
      case Verdict::disagree:
        ++comparison.disagreed;
        std::string& fault = faults_[report.index];
        fault += (fault.empty() ? "" : "\n    ") + finding.comparison + ": " + finding.text;
        break;
    }
  }
}

void Summary::add_failure(const Ending& ending) {
  ++cases_;
  ++verdicts_["no answer"];
  faults_[ending.index] = ending.failure;
}

void Summary::add_time(double seconds) {
  seconds_ += seconds;
  longest_ = std::max(longest_, seconds);
}

std::string Summary::text(std::uint64_t seed) const {
  std::string text = fmt::format("{} cases, seed {}; processor time {:.0f} s, the longest case {:.1f} s\n", cases_,
                                 seed, seconds_, longest_);
  text += counts("verdicts", verdicts_);
  text += fmt::format("\n  {:34} {:>8} {:>10} {:>9} {:>8} {:>9}  {}\n", "comparison", "agreed", "exceptions",
                      "not comp.", "refused", "DISAGREE", "worst of those that agreed");
  for (const auto& [key, c] : comparisons_)
    text += fmt::format("  {:34} {:8} {:10} {:9} {:8} {:9}  {:.1e}\n", key, c.agreed, c.exceptions, c.not_compared,
                        c.refused, c.disagreed, c.worst);
  text += counts("refusals by reason", refusals_);
  text += counts("named exceptions", exceptions_);
  text += counts("drawn", drawn_);
  if (!faults_.empty()) text += "\ndisagreements, crashes and hangs\n";
  for (const auto& [index, fault] : faults_) text += fmt::format("  {}:{}  {}\n", seed, index, fault);
  return text;
}

}  // namespace dualdamp::crosscheck
