#include "scenarios/result_fields.hpp"

#include <map>

#include "scenarios/formulas.hpp"

namespace dualdamp::scenarios {

namespace {

using Fields = std::vector<ResultField>;

Fields joined(Fields first, const Fields& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

Fields energy() {
  return {{"energy.input", "J", "work of the excitation"},
          {"energy.friction", "J", "work dissipated by the friction laws"},
          {"energy.viscous", "J", "work dissipated by the damper"},
          {"energy.stored", "J", "change of kinetic and elastic energy"},
          {"energy.defect", "J", "input - friction - viscous - stored"}};
}

/// How the search for events was certified.
Fields certificate() {
  return {{"certificate.searches", "1", "searches for the next event"},
          {"certificate.panels", "1", "stretches of time examined"},
          {"certificate.splits", "1", "how many of them had to be divided"},
          {"certificate.grazings", "1", "limits touched and not crossed"}};
}

Fields history() {
  return joined({{"events[].t", "s", "time"},
                 {"events[].kind", "", "reversal, stop, release, grazing, switching"},
                 {"events[].x", "m", "position"},
                 {"events[].v", "m/s", "velocity"},
                 {"final.t", "s", "time at the end"},
                 {"final.x", "m", "position at the end"},
                 {"final.v", "m/s", "velocity at the end"}},
                joined(energy(), certificate()));
}

Fields steady_state() {
  return joined({{"peak", "m", "max x"},
                 {"trough", "m", "min x"},
                 {"amplitude", "m", "(peak - trough)/2"},
                 {"phase", "rad", "lag of x's fundamental behind the excitation, in [0, 2 pi)"},
                 {"period", "s", "forcing period"},
                 {"max_speed", "m/s", "max |v|"},
                 {"stops_per_cycle", "1", "times a period the mass comes to rest and stays"},
                 {"sticks[].start", "s", "begin of a rest, modulo one period"},
                 {"sticks[].duration", "s", "its duration"},
                 {"sticks[].position", "m", "its position"},
                 {"multipliers[][]", "1", "Floquet multipliers of the full period, [re, im]"},
                 {"stable", "", "all multipliers inside the unit circle"}},
                joined(energy(), certificate()));
}

Fields curve(const Fields& own) {
  return joined(joined(own, certificate()),
                {{"points[].x", "m", "output amplitude (peak - trough)/2"},
                 {"points[].stops", "1", "times a period the mass comes to rest and stays"},
                 {"points[].sticks", "1", "rests a period"},
                 {"points[].stable", "", "all multipliers inside the unit circle"},
                 {"points[].reason", "", "only of a point without numbers: why"}});
}

Fields regime_map() {
  return joined({{"points[].omega", "rad/s", "forcing frequency"},
                 {"points[].Y", "m or N", "input amplitude"},
                 {"points[].x", "m", "output amplitude (peak - trough)/2"},
                 {"points[].stops", "1", "times a period the mass comes to rest and stays"},
                 {"points[].sticks", "1", "rests a period; 1 without a stop: the mass never moves"},
                 {"points[].reason", "", "only of a point without numbers: why"},
                 {"regimes[].stops", "1", "times a period the mass comes to rest and stays"},
                 {"regimes[].sticks", "1", "rests a period"},
                 {"regimes[].points", "1", "points of the map in this regime"},
                 {"regimes[].omega_from", "rad/s", "their lowest frequency"},
                 {"regimes[].omega_to", "rad/s", "their highest frequency"},
                 {"regimes[].Y_from", "m or N", "their smallest input amplitude"},
                 {"regimes[].Y_to", "m or N", "their largest input amplitude"},
                 {"boundary[].omega", "rad/s", "forcing frequency"},
                 {"boundary[].Y", "m or N", "smallest input amplitude whose steady state never sticks"},
                 {"boundary[].x", "m", "output amplitude there"},
                 {"boundary[].Y_closed_form", "m", "the same from Den Hartog's closed form, where it holds"},
                 {"boundary[].reason", "", "only where no boundary was found: why"}},
                certificate());
}

Fields free_decay() {
  return {{"peaks[].t", "s", "time of the extreme"},
          {"peaks[].x", "m", "its position, signed"},
          {"came_to_rest", "", "fewer extremes than wanted because the mass stuck"}};
}

/// The four parameters under `prefix`.
Fields parameters(const std::string& prefix, const std::string& suffix, const std::string& what) {
  return {{prefix + "zeta" + suffix, "1", what + "damping ratio"},
          {prefix + "c" + suffix, "N.s/m", what + "damping"},
          {prefix + "x_f" + suffix, "m", what + "friction displacement F0/k"},
          {prefix + "F0" + suffix, "N", what + "friction force"}};
}

Fields diagnostics() {
  const std::string at = "estimates[].diagnostics.";
  return joined({{at + "reason", "", "why it is not usable, or what it rests on"},
                 {at + "used[]", "1", "numbers of the data used"},
                 {at + "excluded[].number", "1", "number of a datum left out"},
                 {at + "excluded[].reason", "", "why it was left out"},
                 {at + "covariance[][]", "", "of (zeta, F0)"},
                 {at + "correlation", "1", "of (zeta, F0)"},
                 {at + "lack_of_fit.statistic", "1", "F statistic"},
                 {at + "lack_of_fit.freedom", "1", "degrees of freedom left"},
                 {at + "lack_of_fit.p_value", "1", "its probability when the model holds"},
                 {at + "lack_of_fit.effect", "1", "rms of the added term over the range of the data"},
                 {at + "lack_of_fit.level", "1", "p_value below which it fires"},
                 {at + "lack_of_fit.least_effect", "1", "effect above which it fires"},
                 {at + "lack_of_fit.fired", "", "the model does not hold"},
                 {at + "subsets[].label", "", "which part"},
                 {at + "subsets[].used", "1", "data of the part"},
                 {at + "line.slope", "1", "of x over Y"},
                 {at + "line.intercept", "m", "x at Y = 0"},
                 {at + "line.residual_deviation", "m", "standard deviation of the residuals"},
                 {at + "line.G", "1", "parameter function G at the estimate"},
                 {at + "line.residuals[]", "m", "residuals of the data used"},
                 {at + "decay.R", "1", "decay of a half swing without friction"},
                 {at + "decay.first_amplitude", "m", "first extreme without offset"},
                 {at + "decay.offset", "m", "position the extremes are about"},
                 {at + "decay.residual_deviation", "m", "standard deviation of the residuals"},
                 {at + "decay.residuals[]", "m", "residuals of the data used"},
                 {at + "others[].name", "", "a further parameter, such as mass or contact_stiffness"},
                 {at + "others[].unit", "", "its unit"},
                 {at + "others[].value", "", "its value"},
                 {at + "others[].std", "", "its standard error"},
                 {at + "others[].interval95[]", "", "its 95 % interval"},
                 {at + "subsets[].others[].name", "", "a further parameter from that part"},
                 {at + "subsets[].others[].value", "", "its value"},
                 {at + "candidates[].law", "", "a law that was compared, best first"},
                 {at + "candidates[].parameters[].name", "", "a parameter of it"},
                 {at + "candidates[].parameters[].value", "", "its value"},
                 {at + "candidates[].parameters[].std", "", "its standard error"},
                 {at + "candidates[].parameters[].interval95[]", "", "its 95 % interval"},
                 {at + "candidates[].residual_deviation", "m", "standard deviation of its residuals"},
                 {at + "candidates[].AICc", "1", "Akaike's criterion, corrected for few data"},
                 {at + "candidates[].BIC", "1", "Bayesian criterion"},
                 {at + "candidates[].weight", "1", "Akaike weight"},
                 {at + "warnings[]", "", "doubts"}},
                parameters(at + "subsets[].", "", "from a part of the data: "));
}

Fields branch(const ResultField& parameter) {
  return joined({{"points[]." + parameter.path, parameter.unit, parameter.meaning},
                 {"points[].x", "m", "output amplitude (peak - trough)/2"},
                 {"points[].peak", "m", "max x"},
                 {"points[].trough", "m", "min x"},
                 {"points[].stops", "1", "times a period the mass comes to rest and stays"},
                 {"points[].sticks", "1", "rests a period"},
                 {"points[].stable", "", "no multiplier outside the unit circle"},
                 {"changes[].kind", "", "sequence, sticking, stops, fold, stability, end"},
                 {"changes[]." + parameter.path, parameter.unit, parameter.meaning},
                 {"changes[].x", "m", "output amplitude there"},
                 {"changes[].stops_before", "1", "stops before"},
                 {"changes[].stops_after", "1", "stops behind"}},
                certificate());
}

Fields identify() {
  Fields fields = {{"estimates[].method", "", "name of the method"},
                   {"estimates[].usable", "", "the method stands by its number"}};
  fields = joined(fields, parameters("estimates[].", "", ""));
  fields = joined(fields, parameters("estimates[].std.", "", "standard error of the "));
  fields = joined(fields, parameters("estimates[].interval95.", "[]", "95 % interval of the "));
  fields = joined(fields, diagnostics());
  return joined(fields, {{"verdict", "", "what all estimates say together"},
                         {"fit.method", "", "the method of the fit: the first usable one"},
                         {"fit.points[].number", "1", "number of the datum"},
                         {"fit.points[].Y", "m", "measured input amplitude"},
                         {"fit.points[].x", "m", "measured output amplitude or extreme"},
                         {"fit.points[].fitted", "m", "x by the fit"}});
}

Fields stress_test() {
  return {{"cases.all", "1", "cases of the grid"},
          {"cases.failed", "1", "cases without an estimate by any method"},
          {"cases.motions", "1", "motions behind them"},
          {"cases.estimates", "1", "cases times methods"},
          {"ranking[].method", "", "a method, best first"},
          {"ranking[].unwarned", "1", "share of cases that are wrong and not doubted"},
          {"ranking[].wrong", "1", "share of cases that are off by more than 5 %"},
          {"ranking[].knew", "1", "share of the wrong ones that the method doubted"},
          {"ranking[].false_alarm", "1", "share doubted where friction is Coulomb + viscous"},
          {"ranking[].coverage", "1", "share of 95 % intervals that hold the true F0 there"},
          {"breakdown[].law", "", "departure"},
          {"breakdown[].range", "", "range of excitation"},
          {"breakdown[].sensors", "", "sensors"},
          {"breakdown[].method", "", "method"},
          {"breakdown[].zeta_5", "1", "severity from which zeta is off by more than 5 %"},
          {"breakdown[].zeta_20", "1", "or by more than 20 %"},
          {"breakdown[].F0_5", "1", "severity from which F0 is off by more than 5 %"},
          {"breakdown[].F0_20", "1", "or by more than 20 %"},
          {"breakdown[].wrong", "1", "share of cases that are off by more than 5 %"},
          {"breakdown[].knew", "1", "share of the wrong ones that the method doubted"},
          {"scores[].law", "", "departure, or coulomb_viscous"},
          {"scores[].severity", "1", "its size"},
          {"scores[].range", "", "range of excitation"},
          {"scores[].sensors", "", "sensors"},
          {"scores[].method", "", "method"},
          {"scores[].cases", "1", "seeds"},
          {"scores[].estimates", "1", "seeds with a number"},
          {"scores[].zeta_bias", "1", "mean error of zeta, relative"},
          {"scores[].zeta_spread", "1", "standard deviation of it"},
          {"scores[].zeta_error", "1", "median of its modulus"},
          {"scores[].zeta_coverage", "1", "share of 95 % intervals that hold the truth"},
          {"scores[].F0_bias", "1", "mean error of F0, relative"},
          {"scores[].F0_spread", "1", "standard deviation of it"},
          {"scores[].F0_error", "1", "median of its modulus"},
          {"scores[].F0_coverage", "1", "share of 95 % intervals that hold the truth"},
          {"scores[].wrong", "1", "share of cases that are off by more than 5 %"},
          {"scores[].knew", "1", "share of the wrong ones that the method doubted"},
          {"scores[].false_alarm", "1", "share of the right ones that the method doubted"}};
}

/// Estimates, levels and decay under `prefix`.
Fields reading(const std::string& prefix, const std::string& of) {
  return {{prefix + "bend", "1", "zeta of the smallest part over that of the largest, less 1" + of},
          {prefix + "estimates[].share", "1", "part of the data"},
          {prefix + "estimates[].zeta", "1", "damping ratio by the line through it" + of},
          {prefix + "estimates[].F0", "N", "friction force by it" + of}};
}

Fields levels_and_decay(const std::string& prefix) {
  return {{prefix + "levels[].Y", "m", "input level"},
          {prefix + "levels[].x", "m", "output amplitude"},
          {prefix + "decay.high.zeta", "1", "damping ratio from the first four extremes of the free decay"},
          {prefix + "decay.high.x_f", "m", "friction displacement from them"},
          {prefix + "decay.low.zeta", "1", "damping ratio from the last four"},
          {prefix + "decay.low.x_f", "m", "friction displacement from them"},
          {prefix + "decay.bend", "1", "decay.high.zeta over decay.low.zeta, less 1"}};
}

Fields mechanisms() {
  const std::string fit = "mechanisms[].";
  Fields fields =
      joined({{"verdict", "", "what the study says, and what it does not"}}, reading("explained.", ", measured"));
  fields =
      joined(joined(fields, levels_and_decay("explained.")),
             {{fit + "mechanism", "", "name, closest first"},
              {fit + "meaning", "", "what happens in the rig"},
              {fit + "unknowns", "1", "unknowns of the fit"},
              {fit + "reason", "", "only without a fit: why"},
              {fit + "chi2", "1", "sum of squares of the misfits over their standard errors"},
              {fit + "misfit", "1", "largest relative misfit of all numbers"},
              {fit + "stretch", "1", "largest ratio between a parameter and its plausible value, either way"},
              {fit + "F0", "N", "Coulomb friction of the fit"},
              {fit + "c", "N.s/m", "its damping"},
              {fit + "parameters[].name", "", "a parameter of the mechanism"},
              {fit + "parameters[].unit", "", "its unit"},
              {fit + "parameters[].value", "", "its value"},
              {fit + "parameters[].at_bound", "", "the search would have gone on"},
              {fit + "aliases[]", "", "mechanisms that differ from this one by less than the standard errors"}});
  fields = joined(joined(fields, reading(fit, " of the fit")), levels_and_decay(fit));
  const std::string effect = "effects[].";
  return joined(joined(fields, {{effect + "mechanism", "", "a mechanism at plausible values"},
                                {effect + "case", "", "which of several"},
                                {effect + "because", "", "where the values come from"},
                                {effect + "parameters[].name", "", "a parameter"},
                                {effect + "parameters[].unit", "", "its unit"},
                                {effect + "parameters[].value", "", "its value"},
                                {effect + "sticks", "", "the mass rests at one of the levels"},
                                {effect + "reason", "", "only without estimates: why"}}),
                reading(effect, ""));
}

}  // namespace

std::vector<ResultField> result_fields(const std::string& analysis, const std::string& formula) {
  static const std::map<std::string, Fields> table = {
      {"simulate", history()},
      {"steady_state", steady_state()},
      {"xy_curve", curve({{"points[].Y", "m or N", "excitation amplitude"}})},
      {"regime_map", regime_map()},
      {"frequency_response", curve({{"points[].omega", "rad/s", "forcing frequency"},
                                    {"points[].phase", "rad", "lag of x's fundamental behind the excitation"}})},
      {"xy_branch", branch({"Y", "m or N", "excitation amplitude"})},
      {"frequency_branch", branch({"omega", "rad/s", "forcing frequency"})},
      {"free_decay", free_decay()},
      {"identify", identify()},
      {"stress_test", stress_test()},
      {"mechanisms", mechanisms()}};
  if (const auto found = table.find(analysis); found != table.end()) return found->second;
  const FormulaEntry* entry = find_formula(formula);
  return entry == nullptr ? Fields{} : entry->results;
}

}  // namespace dualdamp::scenarios
