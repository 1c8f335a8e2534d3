#include "identify/experiments/record_parameter.hpp"

#include <algorithm>

namespace dualdamp::identify {

namespace {

struct RecordParameterEntry {
  RecordParameter which;
  std::string_view name;
  std::string_view unit;  ///< SI
};

constexpr std::array<RecordParameterEntry, record_parameter_count> record_parameters = {
    {{RecordParameter::position, "position", "m"},
     {RecordParameter::velocity, "velocity", "m/s"},
     {RecordParameter::offset, "offset", "m"},
     {RecordParameter::release, "release", "s"},
     {RecordParameter::offset_v, "offset_v", "m/s"},
     {RecordParameter::offset_a, "offset_a", "m/s^2"},
     {RecordParameter::travel, "travel", "m"},
     {RecordParameter::offset_force, "offset_force", "N"}}};

const RecordParameterEntry& entry_of(RecordParameter which) {
  return *std::ranges::find(record_parameters, which, &RecordParameterEntry::which);
}

}  // namespace

std::string name_of(RecordParameter which) { return std::string(entry_of(which).name); }

std::string unit_of(RecordParameter which) { return std::string(entry_of(which).unit); }

std::optional<RecordParameter> find_record_parameter(std::string_view name) {
  const auto* const found = std::ranges::find(record_parameters, name, &RecordParameterEntry::name);
  return found == record_parameters.end() ? std::nullopt : std::optional(found->which);
}

}  // namespace dualdamp::identify
