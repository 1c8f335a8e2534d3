#pragma once
/// The section `sweep` of a scenario file: which numbers of the file take which values.
///
///     sweep: {system.friction.kinetic: {from: 1 N, to: 5 N, count: 9}, excitation.frequency: [5 Hz, 6 Hz]}
///
/// Values stay text, as the user wrote them; between the ends of a range they are written in the unit of the ends.
/// So the strict reader treats each value like that of an override PATH=VALUE, with its place in the file.

#include <optional>
#include <string>
#include <vector>

#include "core/diagnostics.hpp"
#include "scenarios/format/tree.hpp"

namespace dualdamp::scenarios {

struct SweptKey {
  std::string path;          ///< as of an override
  Place place;               ///< of the path
  std::string unit;          ///< of all its values; empty: bare numbers
  std::vector<Node> values;  ///< scalars

  /// Value number `i`, without its unit.
  [[nodiscard]] double number(std::size_t i) const;
};

struct SweptKeys {
  Place place;                 ///< of the section
  std::vector<SweptKey> keys;  ///< one or two
};

/// Takes the section out of a document; nothing when there is none. Its faults are added to `problems`. The reader
/// of the other sections checks whether the paths exist and can have these values.
[[nodiscard]] std::optional<SweptKeys> take_swept_keys(Document& document, std::vector<core::Diagnostic>& problems);

}  // namespace dualdamp::scenarios
