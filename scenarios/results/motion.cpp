#include "scenarios/results/motion.hpp"

#include "scenarios/results/table.hpp"
#include "sim/engine/engine.hpp"

namespace dualdamp::scenarios {

void add_certificate(Json& result, const sim::Model& model, const core::SearchCount& count) {
  // The smooth engine looks for events at points of its steps, so it has no certificate.
  if (!sim::is_exact(model)) return;
  result["certificate"] = {{"searches", count.searches},
                           {"panels", count.panels},
                           {"splits", count.splits},
                           {"grazings", count.grazings}};
}

Json energy_json(const sim::Energy& energy) {
  return {{"input", energy.input},
          {"friction", energy.friction},
          {"viscous", energy.viscous},
          {"stored", energy.stored},
          {"defect", energy.defect}};
}

Table history_table(std::string name, const std::vector<sim::Sample>& samples, const sim::Excitation& excitation) {
  Table table{.name = std::move(name),
              .columns = {column("t", "s", samples, &sim::Sample::t)},
              .is_long = true,
              .is_complete = true};
  if (excitation.moves_base()) table.columns.push_back(column("y", "m", samples, &sim::Sample::y));
  table.columns.push_back(column("x", "m", samples, &sim::Sample::x));
  table.columns.push_back(column("v", "m/s", samples, &sim::Sample::v));
  table.columns.push_back(column("a", "m/s^2", samples, &sim::Sample::a));
  table.columns.push_back(column("friction", "N", samples, &sim::Sample::force));
  if (excitation.type != sim::ExcitationType::none && !excitation.moves_base())
    table.columns.push_back(column("force", "N", samples, &sim::Sample::external));
  return table;
}

std::string why_no_phase(const sim::Model& model, bool never_moves) {
  if (never_moves) return "the mass never moves";
  if (model.excitation.amplitude == 0.0) return "the excitation has no fundamental, only further harmonics";
  return "x has no fundamental that is clear of the accuracy of the motion";
}

ResultFields joined(ResultFields first, const ResultFields& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

ResultFields energy_fields() {
  return {{"energy.input", "J", "work of the excitation"},
          {"energy.friction", "J", "work dissipated by the friction laws"},
          {"energy.viscous", "J", "work dissipated by the damper"},
          {"energy.stored", "J", "change of kinetic and elastic energy"},
          {"energy.defect", "J", "input - friction - viscous - stored"}};
}

ResultFields certificate_fields() {
  return {{"certificate.searches", "1", "searches for the next event; the smooth engine gives no certificate"},
          {"certificate.panels", "1", "panels: stretches of time that were examined"},
          {"certificate.splits", "1", "panels that were divided"},
          {"certificate.grazings", "1", "guards that touch zero and do not cross it"}};
}

std::string amplitude_unit(const sim::Excitation& excitation) {
  return excitation.type == sim::ExcitationType::force_harmonic ? "N" : "m";
}

}  // namespace dualdamp::scenarios
