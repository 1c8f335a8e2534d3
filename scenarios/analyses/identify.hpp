#pragma once
/// `identify`: estimates by the identification methods from measured or simulated data.

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "identify/ledger/answer.hpp"
#include "identify/ledger/ledger.hpp"
#include "identify/methods.hpp"
#include "identify/records/sensors.hpp"
#include "identify/uncertainty/uncertain_constants.hpp"
#include "scenarios/analyses/analysis.hpp"
#include "scenarios/measurements/measure.hpp"

namespace dualdamp::scenarios {

class IdentifyQuestion final : public Question {
 public:
  /// A synthetic measurement of the scenario's system.
  struct Synthetic {
    Measurement measurement;
    identify::Sensors sensors;
    std::uint64_t seed = 0;
  };
  struct Methods {
    std::vector<const identify::MethodEntry*> list;
    identify::KnownConstants constants;
    identify::ConstantUncertainties uncertainties;
    identify::OptionValues options;
    identify::LedgerOptions ledger;
    bool robust = false;  ///< bounds the influence of readings that do not belong to the others
  };

  IdentifyQuestion(identify::MeasuredRecord data, Methods methods)
      : source_(std::move(data)), methods_(std::move(methods)) {}
  IdentifyQuestion(Synthetic measurement, Methods methods)
      : source_(std::move(measurement)), methods_(std::move(methods)) {}

  /// The measured record; nullptr when it is a synthetic one.
  [[nodiscard]] const identify::Record* measured() const;
  [[nodiscard]] const Methods& methods() const { return methods_; }

  /// The record as the methods read it.
  [[nodiscard]] identify::Record record(const RunContext& context, std::vector<std::string>& warnings) const;

  [[nodiscard]] Answer run(const RunContext& context) const override;

 private:
  identify::Estimate slow_estimate(const identify::Reader& reader, const identify::Record& record) const;
  identify::Identification conclude(const identify::Record& record, double within) const;
  std::vector<identify::Sensitivity> sensitivities(const identify::Identification& found,
                                                   const identify::Record& record) const;

  std::variant<identify::MeasuredRecord, Synthetic> source_;
  Methods methods_;
};

/// A record like the one that the methods will read; nothing when the file is too faulty to know.
[[nodiscard]] std::optional<identify::Record> outlined_record(const CheckedFile& file);

/// Of the gains of sensors: calibration leaves one, which noise does not show.
[[nodiscard]] Field gain_uncertainty_field();

/// The gain of a sensor that `record` has not would be ignored.
void check_gains(CheckedFile& file, const identify::Record& record);

/// The record that a checked section `analysis` speaks of, without methods.
[[nodiscard]] std::unique_ptr<const IdentifyQuestion> record_question(CheckedValues&& values);

[[nodiscard]] const Analysis& identify_analysis();

}  // namespace dualdamp::scenarios
