#include "scenarios/format.hpp"

#include "friction_models/parameters.hpp"
#include "friction_models/registry.hpp"
#include "identify/methods.hpp"
#include "identify/readers/record_reader.hpp"
#include "scenarios/formulas.hpp"
#include "sim/excitation.hpp"
#include "sim/orbits/steady_state.hpp"
#include "sim/rigs/rigs.hpp"

namespace dualdamp::scenarios {

namespace {

constexpr auto max_items = static_cast<std::size_t>(max_points);
constexpr std::size_t max_sets = 100;

/// The harmonic excitations differ in the unit of their amplitudes.
std::vector<Field> harmonic_fields(const std::string& unit) {
  const Section harmonic = {{integer("order", "multiple of the frequency").required().at_least(2).at_most(1000),
                             quantity("amplitude", {unit}, "its amplitude").required().at_least(0),
                             quantity("phase", {"rad"}, "its phase").with_fallback(0.0)}};
  return {
      quantity("amplitude", {unit}, "amplitude A of A cos(w t + phase)").at_least(0),
      quantity("frequency", {"rad/s"}, "forcing frequency w; natural: sqrt(k/m); damped: natural sqrt(1 - zeta^2)")
          .above(0)
          .or_words({"natural", "damped"}),
      quantity("phase", {"rad"}, "phase at t = 0").with_fallback(0.0),
      section_list("harmonics", harmonic, "further harmonics of a distorted drive")
          .items(1, static_cast<std::size_t>(sim::max_harmonics))};
}

Field seed() {
  return integer("seed", "of the random values").with_fallback(0).at_least(0).at_most(friction::seed_range.high);
}

std::vector<Field> noise_fields(const std::string& unit) {
  return {quantity("intensity", {unit}, "spectral density at low frequencies, two-sided").required().at_least(0),
          quantity("bandwidth", {"rad/s"}, "linear between random values at the rate of twice this")
              .required()
              .above(0),
          seed()};
}

Choice make_excitations() {
  std::vector<Field> force = harmonic_fields("N");
  force.push_back(quantity("offset", {"N"}, "constant force added").with_fallback(0.0));
  return {"type",
          {{"none", "no excitation: free vibration", {}},
           {"base_harmonic", "base motion y(t) = A cos(w t + phase)", {harmonic_fields("m")}, "m"},
           {"force_harmonic", "force on the mass f(t) = A cos(w t + phase) + offset", {std::move(force)}, "N"},
           {"base_ramp",
            "base moving at constant velocity, y(t) = V t",
            {{quantity("velocity", {"m/s"}, "velocity V").required()}}},
           {"force_ramp",
            "force growing at constant rate, f(t) = R t",
            {{quantity("rate", {"N/s"}, "rate R").required()}}},
           {"base_noise", "base in random motion y(t), band-limited white", {noise_fields("m^2.s")}},
           {"force_noise", "random force on the mass f(t), band-limited white", {noise_fields("N^2.s")}}}};
}

Choice make_laws() {
  Choice result{"law", {}};
  for (const friction::LawEntry& law : friction::laws()) {
    result.variants.push_back({std::string(law.name), std::string(law.summary), {fields_of(law.parameters)}});
  }
  return result;
}

Section system_section() {
  Field friction =
      choice("friction", friction_laws(), "friction law; laws of a list act in parallel, their forces add");
  friction.listed = true;
  friction.max_items = 16;
  return {
      {quantity("mass", {"kg"}, "sliding mass m; may be left out where measured data are to tell it").above(0),
       quantity("stiffness", {"N/m"},
                "spring k between mass and base; of measured data it may be left out, or 0 for a mass on a rail")
           .at_least(0),
       quantity("damping", {"N.s/m"}, "viscous damping c, of any sign"),
       quantity("damping_ratio", {"1"}, "zeta, which gives c = 2 zeta sqrt(m k)"),
       quantity("cubic_stiffness", {"N/m^3"}, "of the spring's elongation cubed; any sign").with_fallback(0.0),
       words("damper_to", {"ground", "base"}, "other end of the damper").with_fallback("ground"),
       std::move(friction)},
      {{{"damping", "damping_ratio"}, false}}};
}

Field amplitudes() {
  return grid("amplitudes", {"m", "N"}, "excitation amplitudes, each in place of the excitation's own")
      .required()
      .at_least(0)
      .items(1, max_items);
}

Field frequencies() {
  return grid("frequencies", {"rad/s"}, "forcing frequencies, each in place of the excitation's own")
      .required()
      .above(0)
      .items(1, max_items);
}

/// Where a branch begins and where it is left.
Field range(std::string name, const std::vector<std::string>& units, std::string meaning) {
  return section(std::move(name),
                 {{quantity("from", units, "value at the first point").required().above(0),
                   quantity("to", units, "the branch is followed until it leaves the range").required().above(0)}},
                 std::move(meaning))
      .required();
}

Field peaks() {
  return integer("peaks", "number of extremes wanted, the initial one included")
      .required()
      .at_least(1)
      .at_most(max_points);
}

std::vector<std::string> method_names() {
  std::vector<std::string> names;
  for (const identify::MethodEntry& method : identify::methods()) names.emplace_back(method.name);
  return names;
}

/// A text for each column that a data file may hold.
Field for_columns(std::string name, std::string meaning, bool numbers_only) {
  Section columns;
  for (const std::string_view column : identify::column_names(numbers_only))
    columns.fields.push_back(text(std::string(column), "for the column " + std::string(column)));
  return section(std::move(name), std::move(columns), std::move(meaning));
}

/// How often the tests of a measurement are repeated, and what friction does in between.
std::vector<Field> repetition() {
  return {
      integer("sweeps", "times that all tests are made, one sweep after the other")
          .with_fallback(1)
          .at_least(1)
          .at_most(10'000),
      section(
          "friction_drift",
          {{quantity("rate", {"1"}, "change of all forces of friction from sweep to sweep, relative to the first")
                .with_fallback(0.0),
            quantity("walk", {"1"}, "standard deviation of a random change from sweep to sweep, likewise")
                .with_fallback(0.0)
                .at_least(0),
            seed()}},
          "friction that differs from sweep to sweep")};
}

Field optional(Field field) {
  field.is_required = false;
  return field;
}

Choice measurements() {
  std::vector<Field> curve = {amplitudes(), optional(frequencies())};
  std::vector<Field> response = {frequencies()};
  std::vector<Field> histories = {
      optional(amplitudes()), quantity("duration", {"s"}, "length of a record").above(0),
      quantity("cycles", {"1"}, "length of a record in forcing periods").above(0).at_most(max_cycles),
      quantity("settle", {"s"}, "time from the initial state that is not recorded").with_fallback(0.0).at_least(0),
      word_list("signals", {"x", "v", "a"}, "signals recorded beside that of the drive; default: all")};
  for (std::vector<Field>* fields : {&curve, &response, &histories})
    for (Field& field : repetition()) fields->push_back(std::move(field));
  return {"type",
          {{"xy_curve", "steady states at several amplitudes, at one frequency or several", {std::move(curve)}},
           {"frequency_response", "steady states at several frequencies", {std::move(response)}},
           {"free_decay", "extremes of a free vibration", {{peaks()}}},
           {"simulate",
            "time histories from the initial state, one for each amplitude",
            {std::move(histories), {{{"duration", "cycles"}, true}}}}}};
}

Field sensor(const std::string& name, const std::string& unit, const std::string& what) {
  return section(name,
                 {{quantity("noise", {unit}, "standard deviation of a reading").with_fallback(0.0).at_least(0),
                   quantity("resolution", {unit}, "step between readings; 0: none").with_fallback(0.0).at_least(0),
                   quantity("gain_error", {"1"}, "relative").with_fallback(0.0).above(-1),
                   quantity("phase_lag", {"rad"}, "by which it comes late, at the forcing frequency").at_least(0),
                   quantity("delay", {"s"}, "by which it comes late").at_least(0),
                   quantity("clipping", {unit}, "readings beyond this are cut off, on either side").above(0)},
                  {{{"phase_lag", "delay"}, false}}},
                 "sensor of " + what);
}

std::vector<Field> sensor_fields() {
  return {quantity("sample_rate", {"1/s"}, "signals are sampled, and amplitudes taken from the samples").above(0),
          integer("average_cycles", "forcing periods that an amplitude is averaged over")
              .with_fallback(1)
              .at_least(1)
              .at_most(10'000),
          seed(),
          sensor("y", "m", "the base's displacement"),
          sensor("x", "m", "the mass's displacement"),
          sensor("v", "m/s", "its velocity"),
          sensor("a", "m/s^2", "its acceleration"),
          sensor("force", "N", "the force on it")};
}

Field sensors() {
  return section("sensors", {sensor_fields()},
                 "what the sensors make of a synthetic measurement; default: perfect ones");
}

std::vector<std::string> departure_names() {
  std::vector<std::string> names;
  for (const sim::Departure& departure : sim::departures()) names.emplace_back(departure.name);
  return names;
}

Variant stress_test_variant() {
  constexpr int max_seeds = 1'000'000;
  std::vector<Field> set = {text("name", "what the results call it").required()};
  for (Field& field : sensor_fields())
    if (field.name != "seed") set.push_back(std::move(field));
  const Section range = {
      {text("name", "what the results call it").required(), amplitudes(), optional(frequencies())}};
  const Section decay = {
      {quantity("displacement", {"m"}, "from which the mass is released at rest").required().above(0), peaks()}};
  return {
      "stress_test",
      "how wrong each method is under friction that is not Coulomb + viscous, and whether it knew",
      {{word_list("laws", departure_names(), "departures from Coulomb + viscous friction; default: all"),
        grid("severities", {"1"}, "their sizes, in the sense of each").required().above(0).items(1, max_sets),
        section_list("ranges", range, "input amplitudes, and frequencies, of the steady states that are measured")
            .required()
            .items(1, max_sets),
        section_list("sensors", Section{std::move(set)},
                     "what the curves are measured with; default: perfect sensors")
            .items(1, max_sets),
        integer("seeds", "of the sensors' noise: 0 to seeds - 1").with_fallback(1).at_least(1).at_most(max_seeds),
        section("decay", decay, "a free vibration beside each curve, for the methods that need one"),
        word_list("methods", method_names(), "identification methods; default: all that the measurements allow")}}};
}

std::vector<std::string> mechanism_names() {
  std::vector<std::string> names;
  for (const sim::Mechanism& mechanism : sim::mechanisms()) names.emplace_back(mechanism.name);
  return names;
}

/// Values of each mechanism's own parameters.
Field plausible_values() {
  Choice choice{"mechanism", {}};
  for (const sim::Mechanism& mechanism : sim::mechanisms()) {
    std::vector<Field> fields = {text("case", "what the results call these values").with_fallback(""),
                                 text("because", "where they come from").with_fallback("")};
    for (const sim::MechanismParameter& parameter : mechanism.parameters) {
      Field field =
          quantity(std::string(parameter.name), {std::string(parameter.unit)}, std::string(parameter.meaning))
              .required();
      field.range = parameter.range;
      fields.push_back(std::move(field));
    }
    choice.variants.push_back({std::string(mechanism.name), std::string(mechanism.meaning), {std::move(fields)}});
  }
  Field field =
      scenarios::choice("plausible", std::move(choice),
                        "values that the rig may well have, in place of the known ones of that mechanism");
  field.listed = field.only_listed = true;
  return std::move(field).items(1, max_sets);
}

Variant mechanisms_variant() {
  const auto error = [](const char* name, const char* unit, const char* what) {
    return quantity(name, {unit}, std::string("standard error of this ") + what + ", rounding included")
        .required()
        .above(0);
  };
  const Section estimate = {
      {quantity("share", {"1"}, "which part of the data, the lower one").required().above(0).at_most(1),
       quantity("zeta", {"1"}, "damping ratio that it gave").required().above(0),
       quantity("F0", {"N"}, "friction force that it gave").required().above(0),
       error("zeta_std", "1", "damping ratio"), error("F0_std", "N", "friction force")}};
  const auto segment = [](const char* name, const char* which) {
    return section(name,
                   {{quantity("zeta", {"1"}, "damping ratio").required().above(0),
                     quantity("x_f", {"m"}, "friction displacement").required().above(0)}},
                   std::string("what the ") + which + " four of five extremes gave")
        .required();
  };
  const Section decay = {
      {quantity("stiffness", {"N/m"}, "of the spring in this test").required().above(0),
       quantity("displacement", {"m"}, "from which the mass is released at rest").required().above(0),
       segment("high", "first"), segment("low", "last")}};
  return {
      "mechanisms",
      "which mechanism explains that estimates change as the upper x-Y data are left out",
      {{section_list("estimates", estimate, "what straight lines through the data and their lower parts gave")
            .required()
            .items(2, max_sets),
        integer("levels", "number of input levels, equally spaced at unknown places").at_least(4).at_most(max_sets),
        optional(grid("amplitudes", {"m"}, "input levels, where they are known").above(0).items(3, max_sets)),
        word_list("mechanisms", mechanism_names(), "mechanisms that are tried; default: all"), plausible_values(),
        section("decay", decay, "a free decay of the same mass and friction, to compare")},
       {{{"levels", "amplitudes"}, true}}}};
}

Variant identify_variant() {
  return {
      "identify",
      "what the identification methods make of measured or simulated data",
      {{text("data",
             "file with the measured data (CSV, MATLAB, universal file), in the scenario's directory or below"),
        for_columns("units", "units of the columns of the data file where it does not state them: {x: mm}", true),
        for_columns("columns", "what the data file calls the columns, or their numbers: {x: LVDT 2}", false),
        choice("measurement", measurements(), "a synthetic measurement of this scenario's system"), sensors(),
        word_list("methods", method_names(), "identification methods; default: all that fit the data"),
        boolean("approximate_G", "G from the approximation Eq (15) instead of Eq (4)").with_fallback(false),
        integers("pairs", "numbers of the two pairs that resonance_two_point uses; default: the outermost")
            .at_least(1)
            .items(2, 2),
        quantity("sigma_x", {"m"}, "known standard deviation of a measured output amplitude or extreme")
            .at_least(0),
        quantity("sigma_Y", {"m"}, "known standard deviation of a measured input amplitude").at_least(0),
        boolean("zero_offset", "the extremes of a free vibration are known to be about zero").with_fallback(false),
        boolean("free_natural_frequency", "den_hartog_fit fits the natural frequency too").with_fallback(false),
        quantities(
            "cutoffs", {"rad/s"},
            "cut-off frequencies of the filter that histories are differentiated with; the first one counts, "
            "the others show what the choice matters")
            .above(0)
            .items(1, 16),
        quantity("least_speed", {"m/s"}, "slower samples are left out where friction is regressed on speed")
            .at_least(0),
        integer("bootstrap", "replicates of a bootstrap by sweeps").at_least(0).at_most(1'000'000),
        boolean("profile", "profiles of the likelihood of zeta and F0").with_fallback(false),
        quantity("forgetting", {"1"}, "forgetting factor of recursive_least_squares; 1 forgets nothing")
            .above(0)
            .at_most(1),
        quantity("sign_width", {"m/s"}, "width of the smoothed sign of the velocity in extended_kalman").above(0)},
       {{{"data", "measurement"}, true}}}};
}

Variant formula_variant() {
  Choice choice{"name", {}};
  for (const FormulaEntry& entry : formulas())
    choice.variants.push_back({std::string(entry.name), std::string(entry.summary), entry.arguments});
  Field formula = scenarios::choice("formula", std::move(choice), "the formula and its arguments");
  return {"formula", "a closed form of the paper", {{std::move(formula).required()}}};
}

Choice make_analyses() {
  return {"type",
          {{"simulate",
            "the motion from its initial state",
            {{quantity("duration", {"s"}, "time to simulate").above(0),
              quantity("cycles", {"1"}, "time to simulate, in forcing periods").above(0).at_most(max_cycles),
              quantity("sample_rate", {"1/s"}, "rows a second in history.csv; without it there is none").above(0)},
             {{{"duration", "cycles"}, true}}}},
           {"steady_state", "the periodic motion approached from the initial state", {}},
           {"xy_curve", "output amplitude over input amplitude", {{amplitudes()}}},
           {"frequency_response", "output amplitude over frequency", {{frequencies()}}},
           {"regime_map",
            "output amplitude, stops and rests over frequency and input amplitude",
            {{frequencies(), amplitudes(),
              boolean("sticking_boundary",
                      "also find, at each frequency, the smallest amplitude whose steady state never sticks")
                  .with_fallback(false)}}},
           {"xy_branch",
            "one orbit followed in amplitude by arc length, past folds and through orbits that do not attract",
            {{range("amplitudes", {"m", "N"}, "excitation amplitudes, in place of the excitation's own")}}},
           {"frequency_branch",
            "one orbit followed in frequency likewise",
            {{range("frequencies", {"rad/s"}, "forcing frequencies, in place of the excitation's own")}}},
           {"free_decay", "extremes of the free vibration from the initial state", {{peaks()}}},
           identify_variant(),
           stress_test_variant(),
           mechanisms_variant(),
           formula_variant()}};
}

Section expect_section() {
  return {{text("value", "path into the result, such as points[0].x").required(),
           scalar("equals", "expected value, SI").required(),
           quantity("within", {"1"}, "largest absolute difference, SI").at_least(0),
           quantity("within_relative", {"1"}, "largest difference relative to the expected value").at_least(0),
           text("source", "where the expected value comes from")},
          {{{"within", "within_relative"}, false}}};
}

Section make_format() {
  return {
      {words("schema", {std::string(schema_name)}, "version of this format").required(),
       text("title", "one line for people"), section("system", system_section(), "the oscillator"),
       choice("excitation", excitations(), "what drives it; default: none"),
       section("initial",
               {{quantity("position", {"m"}, "x at t = 0").with_fallback(0.0),
                 quantity("velocity", {"m/s"}, "v at t = 0").with_fallback(0.0)}},
               "the state at t = 0"),
       choice("analysis", analyses(), "the question").required(),
       section_list("expect", expect_section(), "checks of the result; one that is off ends the run with status 1")
           .items(1, 10'000),
       section("numerics",
               {{quantity("tolerance", {"1"},
                          "closure of a steady state relative to its size, and error of a step where friction is "
                          "not piecewise linear; default: 1e-14, or 1e-11 in that case")
                     .at_least(1e-15)
                     .at_most(1e-3),
                 words("solver", {"automatic", "explicit", "implicit"},
                       "steps of the smooth engine; automatic: the exact engine where every law allows it, else "
                       "explicit steps until the motion is stiff")
                     .with_fallback("automatic")}},
               "settings of the numerics")}};
}

}  // namespace

const Section& scenario_format() {
  static const Section format = make_format();
  return format;
}

const Choice& analyses() {
  static const Choice choice = make_analyses();
  return choice;
}

const Choice& excitations() {
  static const Choice choice = make_excitations();
  return choice;
}

const Choice& friction_laws() {
  static const Choice choice = make_laws();
  return choice;
}

const std::vector<Needs>& needs() {
  static const std::vector<std::string> harmonic = {"base_harmonic", "force_harmonic"};
  static const std::string periodic = "a steady state needs a harmonic excitation";
  static const std::string free = "a free vibration has no excitation";
  static const std::vector<Needs> table = {
      {"simulate", "", excitations().names(), {"amplitude", "frequency"}, true, ""},
      {"steady_state", "", harmonic, {"amplitude", "frequency"}, true, periodic},
      {"xy_curve", "", harmonic, {"frequency"}, true, periodic},
      {"frequency_response", "", harmonic, {"amplitude"}, true, periodic},
      {"regime_map", "", harmonic, {}, true, periodic},
      {"xy_branch", "", harmonic, {"frequency"}, true, periodic},
      {"frequency_branch", "", harmonic, {"amplitude"}, true, periodic},
      {"free_decay", "", {"none"}, {}, true, free},
      {"identify", "xy_curve", {"base_harmonic"}, {}, true, "the methods need the amplitude of the base"},
      {"identify",
       "frequency_response",
       {"base_harmonic"},
       {"amplitude"},
       true,
       "the methods need the amplitude of the base"},
      {"identify", "simulate", excitations().names(), {"frequency"}, true, ""},
      {"identify", "free_decay", {"none"}, {}, true, free},
      {"identify",
       "data",
       {"base_harmonic", "none"},
       {"frequency"},
       false,
       "the methods need the amplitude of the base"},
      {"stress_test", "", {"base_harmonic"}, {"frequency"}, true, "the methods need the amplitude of the base"},
      {"mechanisms", "", {"base_harmonic"}, {"frequency"}, true, "the lines are of the amplitude of the base"},
      {"formula", "", {}, {}, false, ""},
  };
  return table;
}

}  // namespace dualdamp::scenarios
