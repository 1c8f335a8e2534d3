#include "scenarios/format/excitations.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "friction_models/modifiers/modifiers.hpp"
#include "friction_models/parameters.hpp"
#include "friction_models/registry.hpp"
#include "scenarios/format/common_keys.hpp"
#include "scenarios/format/limits.hpp"

namespace dualdamp::scenarios {

namespace {

Field phase(std::string meaning) {
  return quantity("phase", {"rad"}, std::move(meaning))
      .at_least(-friction::largest_phase)
      .at_most(friction::largest_phase)
      .with_fallback(0.0);
}

/// The harmonic excitations differ in the unit of their amplitudes.
std::vector<Field> harmonic_fields(const std::string& unit) {
  const Section harmonic = {{integer("order", "multiple of the frequency").required().at_least(2).at_most(1000),
                             quantity("amplitude", {unit}, "amplitude of the harmonic").required().at_least(0),
                             phase("phase of the harmonic")}};
  return {quantity("amplitude", {unit}, "amplitude A of A cos(w t + phase)").at_least(0),
          quantity("frequency", {"rad/s"},
                   "forcing frequency w; natural: sqrt(k/m); damped: sqrt(k/m) sqrt(1 - zeta^2)")
              .above(0)
              .or_words({"natural", "damped"})
              .with_uncertainty(),
          uncertainty_of("frequency", {"rad/s"}), phase("phase at t = 0"),
          section_list("harmonics", harmonic, "further harmonics of a distorted drive")
              .items(1, static_cast<std::size_t>(sim::max_harmonics))};
}

std::vector<Field> noise_fields(const std::string& unit) {
  return {quantity("intensity", {unit}, "spectral density at low frequencies, two-sided").required().at_least(0),
          quantity("bandwidth", {"rad/s"},
                   "bandwidth: the signal is linear between random values that follow at twice this rate")
              .required()
              .above(0),
          seed()};
}

std::vector<Field> chirp_fields(const std::string& unit) {
  return {quantity("amplitude", {unit}, "amplitude A").required().at_least(0),
          quantity("from", {"rad/s"}, "frequency at t = 0").required().above(0),
          quantity("to", {"rad/s"}, "frequency at the end").required().above(0),
          quantity("duration", {"s"}, "duration of the sweep; after it the drive keeps its last value")
              .required()
              .above(0),
          words("spacing", {"linear", "log"},
                "in equal times the frequency changes by equal steps (linear) or by equal ratios (log)")
              .with_fallback("linear"),
          phase("phase at t = 0")};
}

Field interpolation() {
  return words("interpolation", {"linear", "cubic", "step"},
               "what joins the samples: straight lines, a cubic spline, or steps that hold the last sample")
      .with_fallback("linear");
}

Field repeat() {
  return boolean("repeat",
                 "true: the drive starts again at its last sample; false: it keeps the value of the last sample")
      .with_fallback(false);
}

std::vector<Field> measured_fields(const std::string& column, const std::string& unit) {
  std::vector<Field> fields = signal_file(column, unit);
  fields.push_back(interpolation());
  fields.push_back(repeat());
  fields.push_back(
      words("detrend", {"none", "mean", "line"},
            "what is subtracted from the samples: nothing, their mean, or the straight line that fits them best")
          .with_fallback("none"));
  fields.push_back(quantity("offset", {unit}, "constant that is then added to the samples").with_fallback(0.0));
  return fields;
}

std::vector<Field> table_fields(const std::string& unit) {
  const auto most = static_cast<std::size_t>(max_table);
  return {quantities("times", {"s"}, "times of the values; they begin at 0 and increase")
              .required()
              .at_least(0)
              .items(2, most),
          quantities("values", {unit}, "the drive at these times").required().items(2, most), interpolation(),
          repeat()};
}

/// An excitation type: its name in a file, what it is in a model, and its keys.
struct ExcitationRow {
  sim::ExcitationType type = sim::ExcitationType::none;
  Variant variant;
  SamplesIn samples = SamplesIn::nowhere;
};

std::vector<ExcitationRow> make_rows() {
  using enum sim::ExcitationType;
  std::vector<Field> force = harmonic_fields("N");
  force.push_back(quantity("offset", {"N"}, "constant force added").with_fallback(0.0));
  return {
      {none, {"none", "no excitation: free vibration", {}}},
      {base_harmonic, {"base_harmonic", "base motion y(t) = A cos(w t + phase)", {harmonic_fields("m")}, "m"}},
      {force_harmonic,
       {"force_harmonic", "force on the mass f(t) = A cos(w t + phase) + offset", {std::move(force)}, "N"}},
      {base_ramp,
       {"base_ramp",
        "base moving at constant velocity, y(t) = V t",
        {{quantity("velocity", {"m/s"}, "velocity V").required()}}}},
      {force_ramp,
       {"force_ramp",
        "force growing at constant rate, f(t) = R t",
        {{quantity("rate", {"N/s"}, "rate R").required()}}}},
      {base_noise, {"base_noise", "base in random motion y(t), band-limited white", {noise_fields("m^2.s")}}},
      {force_noise, {"force_noise", "random force on the mass f(t), band-limited white", {noise_fields("N^2.s")}}},
      {base_chirp, {"base_chirp", "base motion A cos(phi(t)) with a frequency sweep", {chirp_fields("m")}, "m"}},
      {force_chirp,
       {"force_chirp", "force A cos(phi(t)) on the mass with a frequency sweep", {chirp_fields("N")}, "N"}},
      {base_samples,
       {"base_table", "base motion y(t) given by a list of times and values", {table_fields("m")}},
       SamplesIn::scenario},
      {force_samples,
       {"force_table", "force on the mass f(t) given by a list of times and values", {table_fields("N")}},
       SamplesIn::scenario},
      {base_samples,
       {"measured_base", "base motion y(t) from a data file", {measured_fields("y", "m")}},
       SamplesIn::data_file},
      {force_samples,
       {"measured_force", "force on the mass f(t) from a data file", {measured_fields("force", "N")}},
       SamplesIn::data_file}};
}

const std::vector<ExcitationRow>& rows() {
  static const std::vector<ExcitationRow> list = make_rows();
  return list;
}

const ExcitationRow* find_row(std::string_view name) {
  const auto row =
      std::ranges::find_if(rows(), [name](const ExcitationRow& one) { return one.variant.name == name; });
  return row == rows().end() ? nullptr : &*row;
}

}  // namespace

const Choice& excitations() {
  static const Choice choice = [] {
    Choice result{"type", {}};
    for (const ExcitationRow& row : rows()) result.variants.push_back(row.variant);
    return result;
  }();
  return choice;
}

std::optional<sim::ExcitationType> excitation_type(std::string_view name) {
  const ExcitationRow* row = find_row(name);
  return row == nullptr ? std::nullopt : std::optional(row->type);
}

sim::Excitation excitation_named(std::string_view name) {
  return {.type = excitation_type(name).value_or(sim::ExcitationType::none)};
}

SamplesIn samples_of(std::string_view name) {
  const ExcitationRow* row = find_row(name);
  return row == nullptr ? SamplesIn::nowhere : row->samples;
}

bool moves_base(std::string_view name) { return excitation_named(name).moves_base(); }

std::vector<std::string> harmonic_excitations() {
  std::vector<std::string> names;
  for (const ExcitationRow& row : rows())
    if (excitation_named(row.variant.name).is_harmonic()) names.push_back(row.variant.name);
  return names;
}

Choice friction_laws() {
  Choice result{.key = "law", .variants = {}, .names_laws = true};
  for (const friction::LawEntry& law : friction::laws()) {
    result.variants.push_back({std::string(law.name), std::string(law.summary), {fields_of(law.parameters)}});
  }
  return result;
}

}  // namespace dualdamp::scenarios
