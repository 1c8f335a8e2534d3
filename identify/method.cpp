#include "identify/method.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "identify/conclusion.hpp"
#include "identify/validate.hpp"

namespace dualdamp::identify {

namespace {

/// Why no method can read this input; empty otherwise. The methods themselves leave out histories and extremes that
/// they cannot use.
std::string fault_of_input(const Record& record, const KnownConstants& constants) {
  if (const auto faults = faults_of(constants); !faults.empty()) return faults.front().message;
  if (const auto faults = faults_of(Record{record.pairs, {}, {}}); !faults.empty()) return faults.front().message;
  return {};
}

}  // namespace

std::string_view describe(RecordKind kind) {
  switch (kind) {
    case RecordKind::pairs:
      return "x-Y pairs at one frequency";
    case RecordKind::states:
      return "x-Y pairs";
    case RecordKind::phases:
      return "x-Y pairs with phases";
    case RecordKind::decay:
      return "extremes of a free vibration";
    case RecordKind::readings:
      return "x-Y pairs or extremes of a free vibration";
    case RecordKind::history:
      return "time histories";
  }
  return {};
}

bool MethodEntry::has(const Option& option) const {
  return std::ranges::find(options(), &option) != options().end();
}

OptionValues MethodEntry::own(const OptionValues& values) const {
  OptionValues result;
  for (const Option* option : options())
    if (const auto found = values.find(option->name); found != values.end()) result.insert(*found);
  return result;
}

Estimate MethodEntry::run(const Record& record, const KnownConstants& constants, const OptionValues& values) const {
  if (std::vector<core::Diagnostic> faults = faults_of(values, options()); !faults.empty())
    throw core::InputError(std::move(faults));
  if (std::string fault = fault_of_input(record, constants); !fault.empty()) {
    Estimate estimate;
    estimate.method = name;
    refuse(estimate, std::move(fault));
    return estimate;
  }
  return call.run(record, constants, values);
}

std::string lacks_pairs(const Record& record) {
  return record.pairs && !record.pairs->pairs.empty() ? "" : "the record holds no x-Y pairs";
}

std::string lacks_resonance_pairs(const Record& record) {
  if (std::string lack = lacks_pairs(record); !lack.empty()) return lack;
  const double first = record.pairs->pairs.front().omega;
  const auto differs = [first](const Pair& pair) {
    if (std::isnan(first) || std::isnan(pair.omega)) return std::isnan(first) != std::isnan(pair.omega);
    return !is_same_frequency(pair.omega, first);
  };
  return std::ranges::any_of(record.pairs->pairs, differs) ? "the pairs were measured at several frequencies" : "";
}

std::string lacks_decay(const Record& record) {
  return record.decay && !record.decay->extremes.empty() ? "" : "the record holds no extremes of a free vibration";
}

}  // namespace dualdamp::identify
