#pragma once
/// `predict`: comparison of a fitted rig with a record that was not fitted.

#include <Eigen/Core>
#include <string>
#include <utility>
#include <vector>

#include "scenarios/analyses/shared/fit_setup.hpp"
#include "scenarios/analysis.hpp"

namespace dualdamp::scenarios {

class PredictQuestion final : public Question {
 public:
  struct Setup {
    identify::Rig rig;
    std::vector<identify::FitParameter> parameters;  ///< those that were fitted
    identify::SharedUncertainty uncertainty;         ///< of these
    identify::Experiments data;
    identify::Experiments undriven_data;  ///< the same without the assumed drive
    std::vector<std::string> warnings;
    std::string assumed_drive;  ///< that of the fit, if nothing states the drive of the records; else empty
    core::SettingWords words;   ///< how messages name what a user may state
  };

  explicit PredictQuestion(Setup setup) : setup_(std::move(setup)) {}

  [[nodiscard]] Answer run(const RunContext& context) const override;

 private:
  Setup setup_;
};

[[nodiscard]] const Analysis& predict_analysis();

}  // namespace dualdamp::scenarios
