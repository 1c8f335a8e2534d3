#include "scenarios/analyses/shared/fit_setup.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>
#include <string_view>
#include <utility>

#include "core/diagnostics.hpp"
#include "core/units.hpp"
#include "friction_models/registry.hpp"
#include "scenarios/analyses/shared/record_drive.hpp"
#include "scenarios/format/law_values.hpp"
#include "scenarios/format/values.hpp"

namespace dualdamp::scenarios {

namespace {

using identify::FitParameter;
using identify::Owner;
using identify::RecordParameter;

identify::RigLaw law_from(const Json& section, core::Coordinate coordinate) {
  const friction::LawEntry* entry = friction::find_law(section.at("law").get<std::string>());
  return {entry, law_values(entry->parameters, section, coordinate)};
}

bool is_loop_alone(const identify::Experiments& experiments) {
  return std::ranges::all_of(
      experiments, [](const auto& experiment) { return experiment->kind == identify::ExperimentKind::loop; });
}

/// "position" means that of all records, "position[1]" that of one.
bool take_of_record(const std::string& name, const identify::Experiments& experiments,
                    std::vector<FitParameter>& parameters) {
  bool found = false;
  for (std::size_t e = 0; e < experiments.size(); ++e)
    for (const auto* list : {&experiments[e]->record_free, &experiments[e]->record_others})
      for (const RecordParameter each : *list) {
        FitParameter parameter = identify::parameter_of_record(*experiments[e], e, each, experiments.size() == 1);
        if (name != parameter.name && name != parameter.name.substr(0, parameter.name.find('['))) continue;
        found = true;
        if (std::ranges::find(parameters, parameter.name, &FitParameter::name) == parameters.end())
          parameters.push_back(std::move(parameter));
      }
  return found;
}

void take_bound(const Bound& bound, core::Coordinate coordinate, std::vector<FitParameter>& parameters,
                std::vector<SetupFault>& faults) {
  const auto parameter = std::ranges::find_if(parameters, [&](const FitParameter& one) {
    return one.name == bound.name || (one.owner == Owner::law && "friction." + one.name == bound.name);
  });
  if (parameter == parameters.end()) {
    faults.push_back({"bounds", "'" + bound.name + "' has bounds and is not sought"});
    return;
  }
  if (bound.low.empty() && bound.high.empty())
    faults.push_back({"bounds", "the entry of '" + bound.name + "' states no bound: low, high or both"});
  if (parameter->above) {
    const std::string& other = parameters[*parameter->above].name;
    faults.push_back({"bounds", "'" + bound.name + "' has bounds, and is sought as its distance above " + other +
                                    ", which is sought too: state one of the two, or leave out the bounds"});
    return;
  }
  for (const auto& [text, end] :
       {std::pair{&bound.low, &parameter->range.low}, {&bound.high, &parameter->range.high}}) {
    if (text->empty()) continue;
    const core::QuantityText quantity = core::parse_quantity(*text, parameter->unit, coordinate);
    if (!quantity.value) {
      faults.push_back({"bounds", "the bound '" + *text + "' of " + bound.name + ": " + quantity.fault});
    } else if (!parameter->range.contains(*quantity.value)) {
      faults.push_back({"bounds", "the bound '" + *text + "' of " + bound.name + " is out of its range, " +
                                      parameter->range.describe(core::unit_for(coordinate, parameter->unit))});
    } else {
      *end = *quantity.value;
      (end == &parameter->range.low ? parameter->range.low_open : parameter->range.high_open) = false;
    }
  }
  if (!(parameter->range.low < parameter->range.high))
    faults.push_back({"bounds", "the bounds of " + bound.name + " leave nothing between them"});
}

void add_new(FitParameter parameter, std::vector<FitParameter>& parameters) {
  const auto same = [&](const FitParameter& other) {
    return other.owner == parameter.owner && other.index == parameter.index && other.path == parameter.path;
  };
  if (std::ranges::none_of(parameters, same)) parameters.push_back(std::move(parameter));
}

/// Motions alone determine forces only relative to the mass or the stiffness.
void refuse_without_scale(const identify::Rig& rig, const std::vector<FitParameter>& parameters,
                          const identify::Experiments& experiments, std::vector<SetupFault>& faults) {
  const auto seeks = [&](Owner owner) {
    return std::ranges::find(parameters, owner, &FitParameter::owner) != parameters.end();
  };
  const auto is_force = [](const sim::Excitation& drive) {
    return drive.type != sim::ExcitationType::none && !drive.moves_base();
  };
  const bool forced =
      is_force(rig.known.excitation) || std::ranges::any_of(experiments, [&](const auto& experiment) {
        return experiment->drive && is_force(*experiment->drive);
      });
  if (seeks(Owner::mass) && seeks(Owner::stiffness) && !forced && !is_loop_alone(experiments))
    faults.push_back({"data",
                      "neither the mass nor the stiffness is known, and no force was measured: a motion "
                      "alone tells no force; state one of the two"});
}

}  // namespace

bool DataItem::takes_drive_of_model() const {
  for (std::size_t h = 0; is_motion() && h < data.record.histories.size(); ++h)
    if (drive_of(h) == nullptr) return true;
  return false;
}

std::vector<DataItem> items_of(const Json& analysis, const std::vector<DataFile>& files, const std::string& key) {
  std::vector<DataItem> items;
  for (const DataFile& file : files) {
    if (file.key != key) continue;
    const Json& list = analysis.at(key);
    items.push_back({file.name, list.is_array() ? list.at(file.item) : list, file.data, file.drives, file.words});
  }
  return items;
}

Sought sought_of(const Json& analysis, bool initial_is_known) {
  Sought sought{.initial_is_known = initial_is_known};
  if (analysis.contains("free")) sought.free = analysis.at("free").get<std::vector<std::string>>();
  if (analysis.contains("bounds"))
    for (const Json& bound : analysis.at("bounds"))
      if (bound.is_object())  // one that could not be read has been reported
        sought.bounds.push_back({bound.value("name", ""), bound.value("low", ""), bound.value("high", "")});
  return sought;
}

sim::Model model_for_fit(const CheckedValues& values) {
  sim::Model model = values.model;
  // The derivatives are differences of motions: a smaller tolerance does not improve them.
  constexpr double accurate = 1e-9;
  if (!values.tolerance_is_stated) model.solver.tolerance = accurate;
  return model;
}

identify::Rig rig_of(const Json& system, const sim::Model& model, const std::string& law) {
  identify::Rig rig{.known = model};
  rig.known.friction.clear();
  if (!system.contains("damping")) rig.known.oscillator.damping = identify::unknown;
  const core::Coordinate coordinate = model.oscillator.coordinate;
  if (!law.empty()) {
    rig.laws.push_back({friction::find_law(law), {}});
    rig.laws.back().values.measure(coordinate);
  } else if (system.contains("friction")) {
    const Json& friction = system.at("friction");
    for (const Json& section : friction.is_array() ? friction : Json::array({friction}))
      rig.laws.push_back(law_from(section, coordinate));
  }
  return rig;
}

std::string laws_text(const identify::Rig& rig) {
  std::string text;
  for (const identify::RigLaw& law : rig.laws) text += (text.empty() ? "" : " + ") + std::string(law.entry->name);
  return text.empty() ? "no friction" : text;
}

void refuse_idle_initial(const std::vector<DataItem>& items, std::vector<SetupFault>& faults) {
  if (std::ranges::none_of(items, &DataItem::is_motion))
    faults.push_back({"data", "'initial' is the state at the first sample of a history: the data hold none"});
}

void refuse_idle_drive(const std::vector<DataItem>& items, const sim::Model& model,
                       std::vector<SetupFault>& faults) {
  const sim::Excitation& drive = model.excitation;
  if (drive.type == sim::ExcitationType::none) return;
  const bool drives = std::ranges::any_of(items, &DataItem::takes_drive_of_model);
  bool needs = false;  // some reading does not state its frequency
  bool differs = false;
  bool has_pairs = false;
  for (const DataItem& item : items) {
    if (!item.data.record.pairs) continue;
    has_pairs = true;
    for (const identify::Pair& pair : item.data.record.pairs->pairs) {
      constexpr double far = 0.01;
      needs = needs || std::isnan(pair.omega);
      differs = differs || std::abs(pair.omega / drive.frequency - 1.0) > far;
    }
  }
  const bool own = std::ranges::any_of(items, &DataItem::is_motion);
  const std::string wanted = own ? ": every history has its own drive" : ": the data hold no history";
  const bool loops = std::ranges::all_of(items, &DataItem::is_loop);
  if (!drives && (loops || !drive.is_harmonic())) {
    faults.push_back({"data", "'excitation' is the drive of histories" + wanted +
                                  (loops ? ", and a loop compares the force along its measured motion" : "")});
    return;
  }
  if (drive.amplitude > 0.0 && !drives)
    faults.push_back({"data", "'excitation.amplitude' is the drive of histories" + wanted});
  if (drive.frequency > 0.0 && !drives && !needs && (differs || !has_pairs))
    faults.push_back({"data", "'excitation.frequency' is for readings without a frequency of their own" + wanted +
                                  (has_pairs ? ", and every reading has its own" : ", and no x-Y pairs")});
}

namespace {

/// Whether some item holds the signal whose noise is stated.
bool holds(const std::vector<DataItem>& items, std::string_view signal) {
  return std::ranges::any_of(items, [signal](const DataItem& item) {
    const identify::Record& record = item.data.record;
    const auto in_histories = [&](auto values) {
      return std::ranges::any_of(record.histories,
                                 [&](const identify::History& h) { return !(h.*values).empty(); });
    };
    if (signal == "v") return in_histories(&identify::History::v);
    if (signal == "a") return in_histories(&identify::History::a);
    if (signal == "force") return in_histories(&identify::History::force);
    if (signal != "phase") return record.pairs || record.decay || in_histories(&identify::History::x);
    return record.pairs && std::ranges::any_of(record.pairs->pairs,
                                               [](const identify::Pair& pair) { return !std::isnan(pair.phase); });
  });
}

constexpr std::array<std::string_view, 5> signals_with_noise = {"x", "v", "a", "force", "phase"};

/// A stated noise of a signal that no record compares would be ignored. One option states the noise for all files.
void refuse_idle_noise(const std::vector<DataItem>& items, const std::string& key,
                       const identify::Experiments& experiments, std::vector<SetupFault>& faults) {
  for (const std::string_view name : signals_with_noise) {
    const std::string sigma = "sigma_" + std::string(name);
    const auto compares = [name](const auto& experiment) {
      return std::ranges::find(experiment->signals, name, &identify::Signal::name) != experiment->signals.end();
    };
    const auto states = [&](const DataItem& item) { return item.keys.is_object() && item.keys.contains(sigma); };
    const auto stated = std::ranges::find_if(items, states);
    if (stated == items.end() || std::ranges::any_of(experiments, compares)) continue;
    if (!holds(items, name))
      faults.push_back({key, stated->file + ": '" + sigma + "' states the noise of " + std::string(name) +
                                 ", and the file has no " + std::string(name)});
    else if (!experiments.empty())  // else the records have faults of their own
      faults.push_back({key, "'" + sigma + "' states the noise of " + std::string(name) +
                                 ", which no record of the fit compares"});
  }
}

}  // namespace

void throw_if_any(const std::vector<SetupFault>& faults) {
  if (faults.empty()) return;
  std::vector<core::Diagnostic> problems;
  for (const SetupFault& fault : faults)
    problems.push_back({.message = "'analysis." + fault.path + "': " + fault.message});
  throw core::InputError(std::move(problems));
}

namespace {

/// Whether the mass is part of the equation of motion. A fit of loops alone goes without one that is neither stated
/// nor sought.
bool has_mass(const sim::Model& model, const std::vector<DataItem>& items, const Sought& sought) {
  const auto is_mass = [](const std::string& name) { return name == "mass" || name == "system.mass"; };
  if (!std::ranges::all_of(items, &DataItem::is_loop)) return true;
  return model.oscillator.mass > 0.0 || std::ranges::any_of(sought.free, is_mass);
}

/// Whether neither the pairs of an item nor the drive say at which frequency they were measured.
bool lacks_frequency(const DataItem& item, double of_drive) {
  const auto& pairs = item.data.record.pairs;
  return pairs && std::isnan(of_drive) &&
         std::ranges::any_of(pairs->pairs, [](const identify::Pair& pair) { return std::isnan(pair.omega); });
}

}  // namespace

identify::Experiments experiments_from(const std::vector<DataItem>& items, const std::string& key,
                                       const sim::Model& model, const Sought& sought,
                                       std::vector<SetupFault>& faults) {
  identify::Experiments all;
  const sim::Excitation& drive = model.excitation;
  for (std::size_t i = 0; i < items.size(); ++i) {
    const Json& keys = items[i].keys;
    identify::ExperimentOptions options{
        .name = items[i].file,
        .loop = items[i].is_loop(),
        .has_mass = has_mass(model, items, sought),
        .frequency = drive.is_harmonic() && drive.frequency > 0.0 ? drive.frequency : identify::unknown,
        .force_driven = drive.type == sim::ExcitationType::force_harmonic};
    for (const auto& [name, value] : {std::pair{"sigma_x", &options.sigma_x},
                                      {"sigma_v", &options.sigma_v},
                                      {"sigma_a", &options.sigma_a},
                                      {"sigma_force", &options.sigma_force},
                                      {"sigma_phase", &options.sigma_phase}})
      *value = number_or(keys, name, 0.0);
    for (std::size_t h = 0; h < items[i].drives.size(); ++h) {
      const RecordDrive* own = items[i].drive_of(h);
      options.drives.push_back(own == nullptr ? std::optional<sim::Excitation>() : own->drive);
    }
    std::string fault;
    identify::Experiments found = identify::experiments_of(items[i].data.record, options, fault);
    const std::string place = key + (items.size() > 1 ? "[" + std::to_string(i) + "]" : "");
    if (!fault.empty() && lacks_frequency(items[i], options.frequency))
      fault += ": " + items[i].words(core::Setting::frequency) + ", or " +
               items[i].words(core::Setting::column, "omega", "NAME");
    if (!fault.empty()) faults.push_back({place, items[i].file + ": " + fault});
    if (std::string idle = idle_drive(items[i], model); !idle.empty()) faults.push_back({place, std::move(idle)});
    if (std::string lack = lacking_spring(items[i], model.oscillator.stiffness); !lack.empty())
      faults.push_back({place, std::move(lack)});
    for (const std::size_t h : items[i].zeroed)
      if (found.size() == items[i].data.record.histories.size())
        found[h]->record_free.push_back(RecordParameter::offset);
    for (auto& experiment : found) {
      const bool is_whole = drive.amplitude > 0.0 && drive.frequency > 0.0;
      if (experiment->kind == identify::ExperimentKind::history && !experiment->drive && drive.is_harmonic() &&
          !is_whole)
        faults.push_back({place, items[i].file + ": a history under a harmonic drive needs 'excitation." +
                                     (drive.frequency > 0.0 ? "amplitude" : "frequency") +
                                     "'; 'drive: none' beside 'file' in a scenario, if nothing drove it"});
      if (sought.initial_is_known && experiment->kind == identify::ExperimentKind::history) {
        experiment->record_start[RecordParameter::position] = model.initial.position;
        experiment->record_start[RecordParameter::velocity] = model.initial.velocity;
        experiment->record_start[RecordParameter::travel] = model.initial.travel;
        experiment->knows_load = true;
      }
      all.push_back(std::move(experiment));
    }
  }
  refuse_idle_noise(items, key, all, faults);
  return all;
}

std::vector<FitParameter> parameters_for(const identify::Rig& rig, const identify::Experiments& experiments,
                                         const Sought& sought, std::vector<SetupFault>& faults) {
  std::vector<std::string> lacking;
  std::vector<FitParameter> parameters;
  const auto is_free = [&](std::string_view name) {
    return std::ranges::find(sought.free, name) != sought.free.end();
  };
  for (FitParameter& parameter : identify::unstated_parameters(rig, lacking)) {
    if (parameter.owner != Owner::law && is_loop_alone(experiments)) continue;
    if (parameter.owner == Owner::damping && is_free("damping_ratio")) continue;
    add_new(std::move(parameter), parameters);
  }
  for (const std::string& lack : lacking) faults.push_back({"laws", lack});
  if (is_free("damping") && is_free("damping_ratio"))
    faults.push_back({"free", "'damping' and 'damping_ratio' are the same constant: free one of them"});
  const std::vector<FitParameter> all = identify::parameters_of(rig);
  std::vector<FitParameter> of_records;
  for (const std::string& name : sought.free) {
    std::string fault;
    std::vector<FitParameter> found = identify::named(all, name, fault);
    if (found.empty() && take_of_record(name, experiments, of_records)) continue;
    if (!fault.empty()) {
      std::vector<std::string> names;
      for (const FitParameter& parameter : all) names.push_back(parameter.name);
      faults.push_back({"free", fault + "; there are " + core::joined(names) +
                                    ", position, velocity, travel, offset, offset_v, offset_a, "
                                    "offset_force"});
    }
    for (FitParameter& parameter : found) add_new(std::move(parameter), parameters);
  }
  refuse_without_scale(rig, parameters, experiments, faults);
  const bool placed = identify::feels_position(rig, parameters);
  for (std::size_t e = 0; e < experiments.size(); ++e)
    for (const RecordParameter free : identify::sought_of_record(*experiments[e], placed)) {
      const bool is_history = experiments[e]->kind == identify::ExperimentKind::history;
      if (sought.initial_is_known && is_history &&
          (free == RecordParameter::position || free == RecordParameter::velocity))
        continue;
      FitParameter parameter = identify::parameter_of_record(*experiments[e], e, free, experiments.size() == 1);
      if (std::ranges::find(of_records, parameter.name, &FitParameter::name) == of_records.end())
        of_records.push_back(std::move(parameter));
    }
  identify::arrange(rig, parameters);
  std::ranges::move(of_records, std::back_inserter(parameters));
  for (const Bound& bound : sought.bounds) take_bound(bound, rig.known.oscillator.coordinate, parameters, faults);
  return parameters;
}

}  // namespace dualdamp::scenarios
