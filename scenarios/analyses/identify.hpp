#pragma once
/// `identify`: estimates by the identification methods from measured or simulated data.

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "identify/answer/answer.hpp"
#include "identify/ledger/ledger.hpp"
#include "identify/methods.hpp"
#include "identify/outliers/outliers.hpp"
#include "identify/records/sensors.hpp"
#include "identify/uncertainty/uncertain_constants.hpp"
#include "scenarios/analysis.hpp"
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
    bool robust = false;  ///< limits the influence of readings that do not agree with the others
  };

  IdentifyQuestion(identify::MeasuredRecord data, Methods methods)
      : source_(std::move(data)), methods_(std::move(methods)) {}
  IdentifyQuestion(Synthetic measurement, Methods methods)
      : source_(std::move(measurement)), methods_(std::move(methods)) {}

  /// The measured record; nullptr for a synthetic one.
  [[nodiscard]] const identify::Record* measured() const;
  [[nodiscard]] const Methods& methods() const { return methods_; }

  /// The record as the methods read it.
  [[nodiscard]] identify::Record record(const RunContext& context, std::vector<std::string>& warnings) const;

  [[nodiscard]] Answer run(const RunContext& context) const override;

 private:
  identify::Estimate slow_estimate(const identify::Reader& reader, const identify::Record& record) const;
  identify::Identification conclude(const identify::Record& data, const identify::BoundedInfluence& bounded) const;
  std::vector<identify::Sensitivity> sensitivities(const identify::Identification& found,
                                                   const identify::Record& record) const;

  std::variant<identify::MeasuredRecord, Synthetic> source_;
  Methods methods_;
};

/// A record of the same kind as the methods will read; nothing when the file is too faulty for it.
[[nodiscard]] std::optional<identify::Record> outlined_record(const CheckedFile& file);

/// Uncertainties of the sensors' gains, which remain after calibration and do not appear as noise.
[[nodiscard]] Field gain_uncertainty_field();

/// Keys that an analysis of a data file by the methods does not use.
[[nodiscard]] std::vector<IdleKey> idle_beside_data();

/// Warns of a property of a simulated rig that the methods do not know, and that no test of the ledger frees.
void warn_of_unknown_damper(CheckedFile& file);

/// Complains about gains of sensors that are not in `record`, because they would be ignored.
void check_gains(CheckedFile& file, const identify::Record& record);

/// The record that a checked section `analysis` describes, without methods.
[[nodiscard]] std::unique_ptr<const IdentifyQuestion> record_question(CheckedValues&& values);

[[nodiscard]] const Analysis& identify_analysis();

}  // namespace dualdamp::scenarios
