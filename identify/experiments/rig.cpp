#include "identify/experiments/rig.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "friction_models/law_fault.hpp"
#include "friction_models/registry.hpp"
#include "sim/law_host/law_host.hpp"

namespace dualdamp::identify {

namespace {

using friction::Parameter;
using friction::ParameterKind;
using friction::ParameterValues;

/// The number at `path` of the values. A missing number on the last level is created as `unknown`; nullptr if a
/// record or an item on the way is missing.
double* number_at(ParameterValues& values, std::string_view path) {
  const std::size_t cut = path.find('.');
  std::string_view head = path.substr(0, cut);
  if (cut == std::string_view::npos) {
    if (!values.has(head)) values.set(head, unknown);
    return std::get_if<double>(values.find(head));
  }
  std::size_t item = 0;
  if (const std::size_t bracket = head.find('['); bracket != std::string_view::npos) {
    item = static_cast<std::size_t>(std::stoul(std::string(head.substr(bracket + 1))));
    head = head.substr(0, bracket);
  }
  ParameterValues::Value* value = values.find(head);
  auto* list = value == nullptr ? nullptr : std::get_if<std::vector<ParameterValues>>(value);
  if (list == nullptr || item >= list->size()) return nullptr;
  return number_at((*list)[item], path.substr(cut + 1));
}

double stated_number(ParameterValues values, const std::string& path) {
  const double* number = number_at(values, path);
  return number == nullptr ? unknown : *number;
}

class LawNumbers {
 public:
  LawNumbers(const RigLaw& law, std::size_t index) : law_(law), index_(index) {}

  [[nodiscard]] std::vector<FitParameter> all() {
    walk(law_.entry->parameters, law_.values, "");
    return std::move(found_);
  }

 private:
  [[nodiscard]] static std::optional<ForceAtSpeed> speed_of(const Parameter& parameter, const std::string& prefix) {
    if (parameter.at_speed.empty()) return std::nullopt;
    return ForceAtSpeed{.speed = {.path = prefix + std::string(parameter.at_speed)},
                        .power = {.path = prefix + std::string(parameter.power)}};
  }

  void walk(const std::vector<Parameter>& table, const ParameterValues& values, const std::string& prefix) {
    for (const Parameter& parameter : table) {
      const std::string path = prefix + std::string(parameter.name);
      if (parameter.kind == ParameterKind::number) {
        // The law is stated in its other form.
        if (!parameter.instead_of.empty() && values.has(parameter.instead_of)) continue;
        found_.push_back({.name = path,
                          .unit = std::string(parameter.unit.empty() ? "1" : parameter.unit),
                          .owner = Owner::law,
                          .index = index_,
                          .path = path,
                          .range = parameter.range,
                          .stated = stated_number(law_.values, path),
                          .at_least = parameter.at_least.empty() ? "" : prefix + std::string(parameter.at_least),
                          .share_of = parameter.sums_to_one ? path.substr(0, path.find('[')) : "",
                          .at_speed = speed_of(parameter, prefix)});
      } else if (values.has(parameter.name) &&
                 (parameter.kind == ParameterKind::record || parameter.kind == ParameterKind::list)) {
        const std::vector<ParameterValues>& items = values.list(parameter.name);
        for (std::size_t i = 0; i < items.size(); ++i)
          walk(parameter.fields, items[i],
               path + (parameter.kind == ParameterKind::list ? "[" + std::to_string(i) + "]." : "."));
      }
    }
  }

  const RigLaw& law_;
  std::size_t index_;
  std::vector<FitParameter> found_;
};

/// A number of the rig beside its laws, and where it stands in the model.
struct SystemNumber {
  const char* name;
  const char* unit;
  Owner owner;
  friction::Range range;
  double (*stated)(const sim::Model& model);
  void (*set)(sim::Model& model, double value);
};

template <auto part, auto member>
SystemNumber plain(const char* name, const char* unit, Owner owner, const friction::Range& range) {
  return {name,
          unit,
          owner,
          range,
          [](const sim::Model& model) { return (model.*part).*member; },
          [](sim::Model& model, double value) { (model.*part).*member = value; }};
}

/// In the order in which they are set: the damping ratio needs mass and stiffness, and counts before the damping.
const std::vector<SystemNumber>& system_numbers() {
  using sim::Excitation;
  using sim::Model;
  using sim::Oscillator;
  static const std::vector<SystemNumber> list = {
      plain<&Model::oscillator, &Oscillator::mass>("mass", "kg", Owner::mass, friction::positive),
      plain<&Model::oscillator, &Oscillator::stiffness>("stiffness", "N/m", Owner::stiffness, friction::positive),
      plain<&Model::oscillator, &Oscillator::cubic_stiffness>("cubic_stiffness", "N/m^3", Owner::cubic_stiffness,
                                                              {}),
      plain<&Model::oscillator, &Oscillator::loss_factor>("loss_factor", "1", Owner::loss_factor,
                                                          friction::not_negative),
      plain<&Model::oscillator, &Oscillator::damping>("damping", "N.s/m", Owner::damping, friction::not_negative),
      {"damping_ratio", "1", Owner::damping_ratio, friction::not_negative,
       [](const Model& model) { return sim::damping_ratio(model.oscillator); },
       [](Model& model, double ratio) {
         model.oscillator.damping = 2.0 * ratio * std::sqrt(model.oscillator.mass * model.oscillator.stiffness);
       }},
      plain<&Model::excitation, &Excitation::phase>("phase", "rad", Owner::phase, {}),
      plain<&Model::excitation, &Excitation::offset>("force_offset", "N", Owner::force_offset, {})};
  return list;
}

std::string qualified(const FitParameter& parameter, std::size_t laws) {
  if (parameter.owner == Owner::record) return parameter.name;
  if (parameter.owner != Owner::law) return "system." + parameter.name;
  return (laws > 1 ? "friction[" + std::to_string(parameter.index) + "]." : "friction.") + parameter.path;
}

void add_missing(const RigLaw& law, std::size_t index, const std::vector<FitParameter>& all,
                 std::vector<FitParameter>& missing, std::vector<std::string>& faults) {
  ParameterValues completed = law.values;
  std::vector<std::string> names;
  const auto need = [&](const Parameter& parameter) {
    if (parameter.kind == ParameterKind::number) {
      names.emplace_back(parameter.name);
      return;
    }
    const std::string name(parameter.name);
    const std::string law_name(law.entry->name);
    faults.push_back("'" + name + "' of " + law_name + " is missing: " +
                     (parameter.kind == ParameterKind::list
                          ? "state the list, such as [{}, {}]; a fit does not choose its length"
                          : "state '" + law_name + "." + name + "'; a fit seeks numbers only"));
  };
  for (const friction::ParameterFault& fault : friction::complete(*law.entry, completed)) {
    if (!fault.is_missing) continue;
    if (fault.name.find('.') != std::string::npos) names.push_back(fault.name);  // of an item of a list
    const std::vector<std::string> instead = names_instead_of(law.entry->parameters, fault.name);
    const auto stated = std::ranges::find(law.entry->parameters, fault.name, &Parameter::name);
    const bool is_known = stated != law.entry->parameters.end();
    if (is_known && (stated->kind == ParameterKind::number || instead.empty())) {
      need(*stated);
      continue;
    }
    for (const Parameter& parameter : law.entry->parameters)
      if (std::ranges::find(instead, parameter.name) != instead.end() && parameter.required()) need(parameter);
  }
  for (const Parameter& parameter : law.entry->parameters)
    if (parameter.needed_in_fit && !law.values.has(parameter.name)) names.emplace_back(parameter.name);
  for (const FitParameter& parameter : all)
    if (parameter.owner == Owner::law && parameter.index == index &&
        std::ranges::find(names, parameter.path) != names.end())
      missing.push_back(parameter);
}

/// Sets the last share of each list to 1 minus the sum of the others. False if that is not positive.
bool complete_shares(const friction::LawEntry& law, ParameterValues& values) {
  for (const Parameter& list : law.parameters) {
    if (list.kind != ParameterKind::list || !values.has(list.name)) continue;
    const std::vector<ParameterValues>& items = values.list(list.name);
    for (const Parameter& field : list.fields) {
      if (!field.sums_to_one || items.size() < 2 || !items.front().has(field.name)) continue;
      double left = 1.0;
      for (std::size_t i = 0; i + 1 < items.size(); ++i) left -= items[i].number(field.name);
      if (!(left > 0.0)) return false;
      const std::string last = std::string(list.name) + "[" + std::to_string(items.size() - 1) + "].";
      *number_at(values, last + std::string(field.name)) = left;
    }
  }
  return true;
}

/// Finds a number of the law of `parameter` among those that are sought, or its stated or default value.
void find_beside(const FitParameter& parameter, const Rig& rig, const std::vector<FitParameter>& sought,
                 NumberBeside& number) {
  for (std::size_t j = 0; j < sought.size(); ++j)
    if (sought[j].owner == Owner::law && sought[j].index == parameter.index && sought[j].path == number.path)
      number.sought = j;
  const RigLaw& law = rig.laws[parameter.index];
  ParameterValues completed = law.values;
  static_cast<void>(friction::complete(*law.entry, completed));  // what is missing is sought
  number.known = stated_number(completed, number.path);
}

/// No start may have more friction in motion than a stated level at rest.
void keep_below_stated(FitParameter& parameter, const std::vector<FitParameter>& all,
                       const std::vector<FitParameter>& sought) {
  for (const FitParameter& other : all) {
    if (other.owner != Owner::law || other.index != parameter.index || other.at_least != parameter.path) continue;
    const bool is_sought = std::ranges::any_of(sought, [&other](const FitParameter& each) {
      return each.owner == Owner::law && each.index == other.index && each.path == other.path;
    });
    if (is_sought || !(other.stated < parameter.range.high)) continue;
    parameter.range.high = other.stated;
    parameter.range.high_open = false;
  }
}

}  // namespace

double over_force_at(double speed, const FitParameter& parameter, const Eigen::VectorXd& values) {
  if (!parameter.at_speed || !parameter.at_speed->is_found()) return 1.0;
  const auto& [v0, power, sought_at] = *parameter.at_speed;
  constexpr double largest = 1e300;
  return std::clamp(std::pow(v0.value(values) / speed, power.value(values)), 1.0 / largest, largest);
}

std::vector<FitParameter> parameters_of(const Rig& rig) {
  std::vector<FitParameter> all;
  for (const SystemNumber& number : system_numbers()) {
    if (number.owner == Owner::phase && !rig.known.excitation.is_harmonic()) continue;
    if (number.owner == Owner::force_offset && rig.known.excitation.type != sim::ExcitationType::force_harmonic)
      continue;
    all.push_back({.name = number.name,
                   .unit = number.unit,
                   .owner = number.owner,
                   .range = number.range,
                   .stated = number.stated(rig.known)});
  }
  for (std::size_t i = 0; i < rig.laws.size(); ++i)
    for (FitParameter& parameter : LawNumbers(rig.laws[i], i).all()) all.push_back(std::move(parameter));
  return all;
}

std::vector<FitParameter> unstated_parameters(const Rig& rig, std::vector<std::string>& faults) {
  const std::vector<FitParameter> all = parameters_of(rig);
  std::vector<FitParameter> missing;
  for (const FitParameter& parameter : all)
    if ((parameter.owner == Owner::mass || parameter.owner == Owner::stiffness ||
         parameter.owner == Owner::damping) &&
        std::isnan(parameter.stated))
      missing.push_back(parameter);
  for (std::size_t i = 0; i < rig.laws.size(); ++i) add_missing(rig.laws[i], i, all, missing, faults);
  return missing;
}

std::vector<FitParameter> named(const std::vector<FitParameter>& all, const std::string& name, std::string& fault) {
  std::size_t laws = 0;
  for (const FitParameter& parameter : all)
    if (parameter.owner == Owner::law) laws = std::max(laws, parameter.index + 1);
  const auto is_below = [&](const std::string& path) {
    return path == name || path.starts_with(name + "[") || path.starts_with(name + ".");
  };
  std::vector<FitParameter> found;
  for (const FitParameter& parameter : all)
    if (is_below(parameter.name) || is_below(qualified(parameter, laws))) found.push_back(parameter);
  if (found.empty()) {
    fault = "there is no number '" + name + "' to fit";
    return {};
  }
  const auto different = [&](const FitParameter& other) {
    return other.owner != found.front().owner || other.index != found.front().index;
  };
  if (std::ranges::any_of(found, different)) {
    fault = "'" + name + "' may be ";
    for (std::size_t i = 0; i < found.size(); ++i) fault += (i == 0 ? "" : " or ") + qualified(found[i], laws);
    return {};
  }
  return found;
}

void arrange(const Rig& rig, std::vector<FitParameter>& parameters) {
  std::map<std::pair<std::size_t, std::string>, std::pair<std::size_t, std::size_t>> shares;  // last, count
  for (std::size_t i = 0; i < parameters.size(); ++i)
    if (!parameters[i].share_of.empty()) {
      auto& [last, count] = shares[{parameters[i].index, parameters[i].share_of}];
      last = i;
      ++count;
    }
  std::vector<std::size_t> left_out;
  for (const auto& [key, share] : shares)
    if (share.second == rig.laws[key.first].values.list(key.second).size()) left_out.push_back(share.first);
  std::ranges::sort(left_out, std::greater<>());
  for (const std::size_t i : left_out) parameters.erase(parameters.begin() + static_cast<std::ptrdiff_t>(i));

  const std::vector<FitParameter> all = parameters_of(rig);
  for (FitParameter& parameter : parameters) {
    if (parameter.owner == Owner::record) continue;
    const auto same = std::ranges::count(all, parameter.name, &FitParameter::name);
    const std::string_view head = std::string_view(parameter.name).substr(0, parameter.name.find_first_of(".["));
    const bool is_like_one_of_a_record = parameter.owner == Owner::law && find_record_parameter(head);
    if (same > 1 || is_like_one_of_a_record) parameter.name = qualified(parameter, rig.laws.size());
    if (parameter.at_speed) {
      find_beside(parameter, rig, parameters, parameter.at_speed->speed);
      find_beside(parameter, rig, parameters, parameter.at_speed->power);
    }
    if (parameter.owner == Owner::law) keep_below_stated(parameter, all, parameters);
    if (parameter.at_least.empty()) continue;
    for (std::size_t j = 0; j < parameters.size(); ++j)
      if (parameters[j].owner == Owner::law && parameters[j].index == parameter.index &&
          parameters[j].path == parameter.at_least)
        parameter.above = j;
    if (parameter.above) continue;
    const double other = stated_number(rig.laws[parameter.index].values, parameter.at_least);
    if (!std::isnan(other)) parameter.range.low = std::max(parameter.range.low, other);
  }
}

std::optional<Rig> with_values(const Rig& rig, const std::vector<FitParameter>& parameters,
                               const Eigen::VectorXd& values) {
  Rig result = rig;
  const auto value_of = [&](std::size_t i) { return values[static_cast<Eigen::Index>(i)]; };
  for (const SystemNumber& number : system_numbers())
    for (std::size_t i = 0; i < parameters.size(); ++i)
      if (parameters[i].owner == number.owner) number.set(result.known, value_of(i));
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (parameters[i].owner != Owner::law) continue;
    double* number = number_at(result.laws[parameters[i].index].values, parameters[i].path);
    if (number == nullptr) return std::nullopt;
    *number = value_of(i);
  }
  for (std::size_t i = 0; i < result.laws.size(); ++i) {
    const bool sought = std::ranges::any_of(parameters, [&](const FitParameter& parameter) {
      return parameter.owner == Owner::law && parameter.index == i && !parameter.share_of.empty();
    });
    RigLaw& law = result.laws[i];
    if (sought && !complete_shares(*law.entry, law.values)) return std::nullopt;
    // A default that follows another value, such as static = kinetic, is not stated here: it keeps following.
    ParameterValues completed = law.values;
    if (!friction::complete(*law.entry, completed).empty()) return std::nullopt;
  }
  return result;
}

namespace {

/// A model of the rig. Sought numbers are as they are stated, but those that are unknown or zero are 1. Nothing if
/// a law refuses them: the fit reports that.
std::optional<sim::Model> example_of(const Rig& rig, const std::vector<FitParameter>& sought) {
  Eigen::VectorXd values(static_cast<Eigen::Index>(sought.size()));
  for (std::size_t i = 0; i < sought.size(); ++i) {
    const double stated = sought[i].stated;
    const bool counts = stated < 0.0 || stated > 0.0;
    values[static_cast<Eigen::Index>(i)] =
        counts ? stated : std::clamp(1.0, sought[i].range.low, sought[i].range.high);
  }
  try {
    const std::optional<Rig> whole = with_values(rig, sought, values);
    return whole ? model_of(*whole) : std::nullopt;
  } catch (const friction::LawFault&) {
    return std::nullopt;
  }
}

/// The force of a law without a path behind it, and the size of its terms, which measures its rounding: the force
/// of an unstretched contact is the small difference of k x and k a.
struct ForceAt {
  double force = 0.0;
  double size = 0.0;

  ForceAt(const friction::Law& law, double x) {
    sim::LawHost host(law, {.x = x});
    host.change_direction(friction::Direction::forward);
    force = host.force();
    size = std::abs(force);
    if (!law.is_affine()) return;
    const friction::Affine form = law.affine_force(host.memory(), host.now(), host.direction());
    size += std::abs(form.constant) + std::abs(form.position * x);
  }
};

bool depends_on_position(const friction::Law& law) {
  constexpr double far = 100.0;  // m: beyond the gap of every stop
  constexpr double rounding = 1e-12;
  const ForceAt here(law, 0.0);
  const ForceAt there(law, far);
  return std::abs(here.force - there.force) > rounding * std::max(here.size, there.size);
}

}  // namespace

bool holds_mass(const Rig& rig, const std::vector<FitParameter>& sought) {
  const std::optional<sim::Model> model = example_of(rig, sought);
  return model && std::ranges::any_of(model->friction, &friction::Law::holds_mass);
}

bool feels_position(const Rig& rig, const std::vector<FitParameter>& sought) {
  const std::optional<sim::Model> model = example_of(rig, sought);
  if (!model) return false;
  try {
    return model->oscillator.stiffness > 0.0 || std::ranges::any_of(model->friction, depends_on_position);
  } catch (const friction::LawFault&) {
    return false;  // a law that cannot be computed is reported by the fit
  }
}

bool remembers_path(const Rig& rig, const std::vector<FitParameter>& sought) {
  const std::optional<sim::Model> model = example_of(rig, sought);
  return !model || std::ranges::any_of(model->friction, &friction::Law::remembers_path);
}

std::optional<sim::Model> model_of(Rig rig) {
  sim::Model model = std::move(rig.known);
  for (RigLaw& law : rig.laws) {
    if (!friction::complete(*law.entry, law.values).empty()) return std::nullopt;
    for (friction::Law& made : law.entry->make(law.values)) model.friction.push_back(std::move(made));
  }
  return model;
}

}  // namespace dualdamp::identify
