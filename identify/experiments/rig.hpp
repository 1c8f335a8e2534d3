#pragma once
/// The rig of a fit: an oscillator and its friction laws. Some of their parameters are known, others are sought.
///
/// A parameter that is sought has a name. The names of the oscillator and its drive are mass, stiffness,
/// cubic_stiffness, loss_factor, damping, damping_ratio, phase, force_offset. The names of a law are those of its
/// table, with a path into lists and records ("elements[1].stiffness", "warming.power"). If two parameters have the
/// same name, "system." or "friction." ("friction[1]." for laws in parallel) is put before it. Each record adds its
/// own parameters: position and velocity at its first sample, offset, offset_v and offset_a (the readings of x, v
/// and a at rest), offset_force (the reading of the force without one), release (the time of the first extreme),
/// travel (the path of the mass that has loaded the contacts before the first sample). A law's parameter with such
/// a name also gets "friction." before it.
///
/// Ranges are those of the laws' tables. The last `share` of a list of elements is 1 minus the sum of the others.

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "friction_models/law_entry.hpp"
#include "friction_models/parameters.hpp"
#include "identify/experiments/record_parameter.hpp"
#include "identify/record.hpp"
#include "sim/model.hpp"

namespace dualdamp::identify {

struct RigLaw {
  const friction::LawEntry* entry = nullptr;
  friction::ParameterValues values;  ///< those that are stated
};

/// What a parameter belongs to.
enum class Owner {
  mass,
  stiffness,
  cubic_stiffness,
  loss_factor,
  damping,
  damping_ratio,
  phase,
  force_offset,
  law,
  record,
};

/// A number of the law of a parameter, beside it: sought too, or known.
struct NumberBeside {
  std::string path = {};
  std::optional<std::size_t> sought = {};  ///< index of the parameter
  double known = unknown;

  [[nodiscard]] bool is_found() const { return sought || !std::isnan(known); }
  /// `values`: of all sought parameters.
  [[nodiscard]] double value(const Eigen::VectorXd& values) const {
    return sought ? values[static_cast<Eigen::Index>(*sought)] : known;
  }
};

/// Of a force at a speed v0 that grows as F(v) = force (v/v0)^power: the size of `force` follows from that of F
/// only with v0 and the power.
struct ForceAtSpeed {
  NumberBeside speed = {};
  NumberBeside power = {};
  /// Speed at which the force is sought, in place of v0; `unknown`: v0. At a speed of the data, the data show the
  /// force; at v0 far from these, a small change of the power changes it by decades.
  double sought_at = unknown;

  [[nodiscard]] bool is_found() const { return speed.is_found() && power.is_found(); }
};

struct FitParameter {
  std::string name;
  std::string unit;  ///< SI; "1" for a number without unit
  Owner owner = Owner::law;
  std::size_t index = 0;  ///< of the law or of the record
  std::string path = {};  ///< if it belongs to a law: path in the values of the law
  RecordParameter record_parameter = RecordParameter::position;  ///< if it belongs to a record
  friction::Range range = {};                                    ///< allowed by the law, and by the caller
  double stated = unknown;                                       ///< stated value, at which the search begins
  std::optional<std::size_t> above = {};  ///< index of the parameter that this one must not be below
  std::string at_least = {};              ///< name of that parameter in the table of the law
  std::string share_of = {};              ///< name of a list of the law whose values of this kind add to 1
  std::optional<ForceAtSpeed> at_speed = {};

  /// Whether it is this parameter of this record.
  [[nodiscard]] bool is_of_record(std::size_t record, RecordParameter which) const {
    return owner == Owner::record && index == record && record_parameter == which;
  }
  /// Whether its range has an end beside zero.
  [[nodiscard]] bool is_bounded() const { return std::isfinite(range.high) || range.low > 0.0; }
};

/// (v0/v)^power of a force at v0: the force over that at `speed`. 1 for any other parameter. `values`: of all
/// sought parameters.
[[nodiscard]] double over_force_at(double speed, const FitParameter& parameter, const Eigen::VectorXd& values);

struct Rig {
  sim::Model known;  ///< without friction; mass, stiffness or damping may be `unknown`
  std::vector<RigLaw> laws;
};

/// All parameters of the rig that may be sought, in the order of the tables. Parameters in lists and records of
/// laws are included only if the list or the record is stated.
[[nodiscard]] std::vector<FitParameter> parameters_of(const Rig& rig);

/// Parameters that are required and have no value: mass, stiffness, damping and the required parameters of laws.
/// The static level of a law that falls with speed counts as required. `faults`: missing values that are no
/// numbers.
[[nodiscard]] std::vector<FitParameter> unstated_parameters(const Rig& rig, std::vector<std::string>& faults);

/// The parameters among `all` with this name, or with this name as the first part of theirs: "elements" selects
/// "elements[0].stiffness". Empty, with a fault, if there is none, or if two parameters have this very name.
[[nodiscard]] std::vector<FitParameter> named(const std::vector<FitParameter>& all, const std::string& name,
                                              std::string& fault);

/// Sets `above` and `at_speed` of the parameters, removes the last share of each list whose shares are all sought,
/// and makes names as short as possible.
void arrange(const Rig& rig, std::vector<FitParameter>& parameters);

/// The rig with these values; parameters of records are ignored. Numbers that are neither stated nor sought are
/// left out: if their default is the value of another number, it has to follow that number in later fits. Nothing
/// if the shares of a list leave nothing for its last item.
[[nodiscard]] std::optional<Rig> with_values(const Rig& rig, const std::vector<FitParameter>& parameters,
                                             const Eigen::VectorXd& values);

/// Whether a force of the rig depends on the position itself, as that of a spring, and not only on the path. Sought
/// numbers count as they are stated, but those that are unknown or zero as 1.
[[nodiscard]] bool feels_position(const Rig& rig, const std::vector<FitParameter>& sought);

/// Whether a law of the rig remembers the path of the mass, so that a travel before the first sample can load it.
/// Yes if a law cannot be made of these numbers.
[[nodiscard]] bool remembers_path(const Rig& rig, const std::vector<FitParameter>& sought);

/// Whether a law of the rig can make the mass stick.
[[nodiscard]] bool holds_mass(const Rig& rig, const std::vector<FitParameter>& sought);

/// The model of a rig. Nothing if a law refuses its values.
[[nodiscard]] std::optional<sim::Model> model_of(Rig rig);

}  // namespace dualdamp::identify
