#pragma once
/// `design`: what to measure next, so that the ranges over friction laws narrow.

#include "identify/design/design.hpp"
#include "scenarios/analyses/identify.hpp"

namespace dualdamp::scenarios {

class DesignQuestion final : public Question {
 public:
  /// `record`: how `identify` would read it.
  DesignQuestion(std::unique_ptr<const IdentifyQuestion> record, identify::KnownDeviations known,
                 identify::LawIntervalOptions options)
      : record_(std::move(record)), known_(known), options_(std::move(options)) {}

  [[nodiscard]] Answer run(const RunContext& context) const override;

 private:
  std::unique_ptr<const IdentifyQuestion> record_;
  identify::KnownDeviations known_;
  identify::LawIntervalOptions options_;
};

[[nodiscard]] const Analysis& design_analysis();

}  // namespace dualdamp::scenarios
