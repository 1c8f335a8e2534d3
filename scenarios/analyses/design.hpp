#pragma once
/// `design`: what to measure next, so that the ranges over friction laws narrow.

#include "identify/design/design.hpp"
#include "identify/methods/any_law/any_law.hpp"
#include "scenarios/analyses/identify.hpp"

namespace dualdamp::scenarios {

class DesignQuestion final : public Question {
 public:
  /// `record`: the record as `identify` would read it. `limits`: of the drive.
  DesignQuestion(std::unique_ptr<const IdentifyQuestion> record, identify::AnyLawOptions options,
                 identify::DriveLimits limits)
      : record_(std::move(record)), options_(std::move(options)), limits_(limits) {}

  [[nodiscard]] Answer run(const RunContext& context) const override;

 private:
  std::unique_ptr<const IdentifyQuestion> record_;
  identify::AnyLawOptions options_;
  identify::DriveLimits limits_;
};

[[nodiscard]] const Analysis& design_analysis();

}  // namespace dualdamp::scenarios
