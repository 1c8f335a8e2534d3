#include "scenarios/scenario_format.hpp"

#include "scenarios/format/excitations.hpp"

namespace dualdamp::scenarios {

namespace {

Section system_section() {
  Field friction = choice(
      "friction", friction_laws(),
      "friction law; laws of a list act in parallel, their forces add; with elements that modifiers make laws of their own at most 256");
  friction.listed = true;
  friction.max_items = 16;
  return {
      {words("coordinate", {"displacement", "angle"},
             "what x is; for an angle every mass is a moment of inertia [kg.m^2], every force a torque [N.m] and "
             "every displacement an angle [rad]; default: it follows from the units"),
       quantity("mass", {"kg"}, "sliding mass m; optional with measured data").above(0).with_uncertainty(),
       uncertainty_of("mass", {"kg"}),
       quantity("stiffness", {"N/m"},
                "spring k between mass and base; with measured data it is optional, or 0 for a mass on a rail")
           .at_least(0)
           .with_uncertainty(),
       uncertainty_of("stiffness", {"N/m"}),
       quantity("damping", {"N.s/m"}, "viscous damping c, of any sign; a motion needs it or 'damping_ratio'"),
       quantity("damping_ratio", {"1"}, "zeta, which gives c = 2 zeta sqrt(m k)"),
       quantity("cubic_stiffness", {"N/m^3"}, "coefficient of the cube of the spring's elongation; any sign")
           .with_fallback(0.0),
       quantity("gravity_stiffness", {"N.m"},
                "m g l of a pendulum: the part of the stiffness whose torque is m g l sin(x); without 'stiffness' "
                "it is the whole stiffness. Only for an angle x without excitation or under a torque")
           .above(0),
       quantity("loss_factor", {"1"},
                "structural damping eta: stiffness k (1 + i eta); only for steady vibrations under a single "
                "harmonic")
           .at_least(0),
       words("damper_to", {"ground", "base"}, "what the other end of the damper is fixed to")
           .with_fallback("ground"),
       std::move(friction)},
      {{{"damping", "damping_ratio"}, false}}};
}

Section expect_section() {
  return {{text("value", "path into the result, such as points[0].x").required(),
           scalar("equals", "expected value, SI").required(),
           quantity("within", {"1"}, "largest absolute difference, SI").at_least(0),
           quantity("within_relative", {"1"}, "largest difference relative to the expected value").at_least(0),
           text("source", "where the expected value comes from")},
          {{{"within", "within_relative"}, false}}};
}

Choice choice_of(const AnalysisList& analyses) {
  Choice choice{"type", {}};
  for (const Analysis* analysis : analyses)
    choice.variants.push_back({.name = std::string(analysis->name),
                               .summary = std::string(analysis->summary),
                               .section = analysis->keys,
                               .results = analysis->results,
                               .seeks_laws = analysis->seeks_laws});
  return choice;
}

}  // namespace

Section scenario_format(const AnalysisList& analyses) {
  Field sweep;
  sweep.name = "sweep";
  sweep.kind = Kind::sweep;
  sweep.meaning =
      "repeats the analysis for each value of one number of this file, or for each pair of values of two numbers";
  return {
      {words("schema", {std::string(schema_name)}, "version of this format").required(),
       text("title", "title in one line"), section("system", system_section(), "the oscillator"),
       choice("excitation", excitations(), "what drives the oscillator; default: nothing"),
       section(
           "initial",
           {{quantity("position", {"m"}, "x at t = 0").with_fallback(0.0),
             quantity("velocity", {"m/s"}, "v at t = 0").with_fallback(0.0),
             quantity("travel", {"m"},
                      "way that the mass has moved before t = 0, from a place where the contacts were unloaded: "
                      "it loads the laws that remember their way, such as contact_compliance or dahl")
                 .with_fallback(0.0)}},
           "the state at t = 0"),
       choice("analysis", choice_of(analyses), "the question: what is computed").required(), std::move(sweep),
       section_list("expect", expect_section(), "checks of the result; if a value differs, the exit status is 1")
           .items(1, 10'000),
       section(
           "numerics",
           {{quantity("tolerance", {"1"},
                      "closure error of a steady state relative to its size, and error of a step if friction is "
                      "not piecewise linear; default: 1e-14, or 1e-11 for such friction. Above 1e-6 amplitudes may "
                      "be off by 20 %, and a warning says so")
                 .at_least(1e-15)
                 .at_most(1e-3),
             words("solver", {"automatic", "explicit", "implicit"},
                   "steps of the smooth engine; automatic: the exact engine if every law allows it, otherwise "
                   "explicit steps until the motion is stiff")
                 .with_fallback("automatic"),
             boolean("verify",
                     "compute the result again by the other engine, or by other steps, at a tight tolerance and "
                     "compare every quantity; if one differs, the exit status is 1")}},
           "numerical settings")}};
}

}  // namespace dualdamp::scenarios
