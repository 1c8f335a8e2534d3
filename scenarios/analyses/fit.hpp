#pragma once
/// `fit`: laws and constants of a rig fitted to measured records.

#include <utility>
#include <vector>

#include "scenarios/analyses/shared/fit_setup.hpp"
#include "scenarios/analysis.hpp"

namespace dualdamp::scenarios {

class FitQuestion final : public Question {
 public:
  struct Candidate {
    identify::Rig rig;
    std::vector<identify::FitParameter> parameters;
  };

  FitQuestion(std::vector<Candidate> candidates, identify::Experiments data, identify::Experiments validation,
              identify::FitOptions options, Json excitation, std::vector<Json> excitations,
              std::vector<double> marks, std::vector<std::string> warnings)
      : candidates_(std::move(candidates)),
        data_(std::move(data)),
        validation_(std::move(validation)),
        options_(std::move(options)),
        excitation_(std::move(excitation)),
        excitations_(std::move(excitations)),
        marks_(std::move(marks)),
        warnings_(std::move(warnings)) {}

  [[nodiscard]] Answer run(const RunContext& context) const override;

 private:
  std::vector<Candidate> candidates_;  ///< one for each law that is compared
  identify::Experiments data_;
  identify::Experiments validation_;
  identify::FitOptions options_;
  Json excitation_;                ///< of the scenario: the drive of records without their own
  std::vector<Json> excitations_;  ///< of scenarios of each experiment of `data_`
  std::vector<double> marks_;      ///< of the readings that are fitted (`identify::marks_of`)
  std::vector<std::string> warnings_;
};

[[nodiscard]] const Analysis& fit_analysis();

}  // namespace dualdamp::scenarios
