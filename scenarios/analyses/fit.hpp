#pragma once
/// `fit`: laws and constants of a rig fitted to measured records.

#include <string>
#include <utility>
#include <vector>

#include "scenarios/analyses/shared/fit_setup.hpp"
#include "scenarios/analysis.hpp"

namespace dualdamp::scenarios {

class FitQuestion final : public Question {
 public:
  using Candidate = identify::RigToFit;

  /// What is fitted to what.
  struct Setup {
    std::vector<Candidate> candidates;  ///< one for each law that is compared
    identify::Experiments data;
    identify::Experiments validation;
    identify::FitOptions options;
    Json excitation;                ///< of the scenario: the drive of records without their own
    std::vector<Json> excitations;  ///< of scenarios of each experiment of `data`
    std::vector<double> marks;      ///< of the readings that are fitted (`identify::marks_of`)
    std::vector<std::string> warnings;
  };

  explicit FitQuestion(Setup setup) : setup_(std::move(setup)) {}

  [[nodiscard]] Answer run(const RunContext& context) const override;

 private:
  Setup setup_;
};

[[nodiscard]] const Analysis& fit_analysis();

}  // namespace dualdamp::scenarios
