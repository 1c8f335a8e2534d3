#pragma once
/// The rig of a fit: an oscillator and its friction laws, some of whose numbers are known and some are sought.
///
/// A number that is sought has a name. Those of the oscillator and its drive are mass, stiffness, cubic_stiffness,
/// damping, damping_ratio, phase, force_offset; those of a law are the ones of its table, with their way into lists
/// and records ("elements[1].stiffness", "warming.power"). Where a name stands for two numbers they are told apart
/// by "system." and "friction." (of laws in parallel "friction[1].") before it. Each record adds its own: position
/// and velocity at its first sample, offset (the reading of x at rest), release (the time of the first extreme).
///
/// Ranges are those of the laws' tables. The last `share` of a list of elements is what the others leave of 1.

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "friction_models/law_entry.hpp"
#include "friction_models/parameters.hpp"
#include "identify/record.hpp"
#include "sim/model.hpp"

namespace dualdamp::identify {

struct RigLaw {
  const friction::LawEntry* entry = nullptr;
  friction::ParameterValues values;  ///< those that are stated
};

/// What a record has of its own, in this order.
enum class Own { position, velocity, offset, release };
inline constexpr std::size_t own_count = 4;
/// m, m/s, m, s
using OwnValues = std::array<double, own_count>;

/// Where a number belongs.
enum class Owner {
  mass,
  stiffness,
  cubic_stiffness,
  damping,
  damping_ratio,
  phase,
  force_offset,
  law,
  record,
};

struct FitParameter {
  std::string name;
  std::string unit;  ///< SI; "1" of a plain number
  Owner owner = Owner::law;
  std::size_t index = 0;                  ///< of the law, or of the record
  std::string path = {};                  ///< in the values of a law
  Own own = Own::position;                ///< of a record
  friction::Range range = {};             ///< allowed by the law, and by the caller
  double stated = unknown;                ///< where the search begins, if someone said so
  std::optional<std::size_t> above = {};  ///< the number of the parameter that this one is at least
  std::string at_least = {};              ///< its name in the table of the law
};

struct Rig {
  sim::Model known;  ///< without friction; `unknown` mass, stiffness or damping: sought
  std::vector<RigLaw> laws;
};

/// All numbers of the rig that may be sought, in the order of the tables. What the laws hold in lists and records
/// that are not stated is not among them.
[[nodiscard]] std::vector<FitParameter> parameters_of(const Rig& rig);

/// Those without a value that the rig cannot do without: mass, stiffness, damping and required numbers of laws. The
/// static level of a law that falls with speed counts as one. `faults`: what is missing and no number.
[[nodiscard]] std::vector<FitParameter> unstated_parameters(const Rig& rig, std::vector<std::string>& faults);

/// The one of this name among `all`, which may also be part of a name: "elements" of "elements[0].stiffness". Empty
/// with a fault where there is none, or more than one of the same name.
[[nodiscard]] std::vector<FitParameter> named(const std::vector<FitParameter>& all, const std::string& name,
                                              std::string& fault);

/// Links parameters to those that they are at least, takes the last share out of each list whose shares are all
/// sought, and makes names as short as they can be.
void arrange(const Rig& rig, std::vector<FitParameter>& parameters);

/// The rig with these values of its parameters; those of records are left alone. Nothing where a law refuses them.
[[nodiscard]] std::optional<Rig> with_values(const Rig& rig, const std::vector<FitParameter>& parameters,
                                             const Eigen::VectorXd& values);

/// Its model; nothing where a law refuses its values.
[[nodiscard]] std::optional<sim::Model> model_of(Rig rig);

}  // namespace dualdamp::identify
