#pragma once
/// `design`: what to measure next, so that the ranges over friction laws narrow.

#include "identify/design/design.hpp"
#include "identify/methods/any_law/any_law.hpp"
#include "scenarios/analyses/identify.hpp"

namespace dualdamp::scenarios {

class DesignQuestion final : public Question {
 public:
  /// `record`: the record as `identify` would read it.
  DesignQuestion(std::unique_ptr<const IdentifyQuestion> record, identify::AnyLawOptions options)
      : record_(std::move(record)), options_(std::move(options)) {}

  [[nodiscard]] Answer run(const RunContext& context) const override;

 private:
  std::unique_ptr<const IdentifyQuestion> record_;
  identify::AnyLawOptions options_;
};

[[nodiscard]] const Analysis& design_analysis();

}  // namespace dualdamp::scenarios
