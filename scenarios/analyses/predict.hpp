#pragma once
/// `predict`: comparison of a fitted rig with a record that was not fitted.

#include <Eigen/Core>
#include <string>
#include <vector>

#include "scenarios/analyses/shared/fit_setup.hpp"
#include "scenarios/analysis.hpp"

namespace dualdamp::scenarios {

class PredictQuestion final : public Question {
 public:
  PredictQuestion(identify::Rig rig, std::vector<identify::FitParameter> parameters,
                  identify::SharedUncertainty uncertainty, identify::Experiments data,
                  identify::Experiments undriven_data, std::vector<std::string> warnings, std::string assumed_drive,
                  core::SettingWords words)
      : rig_(std::move(rig)),
        parameters_(std::move(parameters)),
        uncertainty_(std::move(uncertainty)),
        data_(std::move(data)),
        undriven_data_(std::move(undriven_data)),
        warnings_(std::move(warnings)),
        assumed_drive_(std::move(assumed_drive)),
        words_(words) {}

  [[nodiscard]] Answer run(const RunContext& context) const override;

 private:
  identify::Rig rig_;
  std::vector<identify::FitParameter> parameters_;  ///< those that were fitted
  identify::SharedUncertainty uncertainty_;         ///< of these
  identify::Experiments data_;
  identify::Experiments undriven_data_;  ///< the same without the assumed drive
  std::vector<std::string> warnings_;
  std::string assumed_drive_;  ///< that of the fit, if nothing states the drive of the records; else empty
  core::SettingWords words_;   ///< how messages name what a user may state
};

[[nodiscard]] const Analysis& predict_analysis();

}  // namespace dualdamp::scenarios
