#pragma once
/// The findings of a campaign as text: verdicts, worst errors of every comparison, refusals and exceptions by
/// reason, what was drawn, and every disagreement.

#include <map>
#include <string>

#include "bench/crosscheck/case.hpp"
#include "bench/crosscheck/children.hpp"

namespace dualdamp::crosscheck {

class Summary {
 public:
  void add(const CaseReport& report);
  /// A case without a report.
  void add_failure(const Ending& ending);
  void add_time(double seconds);

  /// Whether there was no disagreement, crash or hang.
  [[nodiscard]] bool holds() const { return faults_.empty(); }
  [[nodiscard]] std::string text(std::uint64_t seed) const;
  /// "12: exact against smooth engine: apart by ..."
  [[nodiscard]] const std::map<std::uint32_t, std::string>& faults() const { return faults_; }

 private:
  struct Comparison {
    long agreed = 0;
    long exceptions = 0;
    long not_compared = 0;
    long refused = 0;
    long disagreed = 0;
    double worst = 0.0;  ///< of those that agreed
  };

  long cases_ = 0;
  double seconds_ = 0.0;
  double longest_ = 0.0;
  std::map<std::string, long> verdicts_;
  std::map<std::string, Comparison> comparisons_;
  std::map<std::string, long> refusals_;
  std::map<std::string, long> exceptions_;
  std::map<std::string, long> drawn_;
  std::map<std::uint32_t, std::string> faults_;
};

}  // namespace dualdamp::crosscheck
