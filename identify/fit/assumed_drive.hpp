#pragma once
/// What a record says against the drive that a prediction assumes for it.
///
/// A record that does not state its drive is predicted under that of the fit. Two observations speak against this:
/// * the rig without a drive explains the record, and misses it by less than half as much;
/// * the fit had no drive, and the record still moves at its end, where the rig comes to rest.

#include <cstddef>
#include <optional>

#include "identify/fit/fit.hpp"

namespace dualdamp::identify {

/// A record that the rig explains without a drive. The errors are those of `relative_errors`.
struct UndrivenRecord {
  std::size_t experiment = 0;
  double with_drive = 0.0;
  double without_drive = 0.0;
};

/// The first such record. `held`: the fit of the records' own parameters under the drive. `data`: the records as
/// those of free vibrations, which begin at their release.
[[nodiscard]] std::optional<UndrivenRecord> undriven_record(const Rig& rig, const Fit& held,
                                                            const Experiments& data);

/// The first record that moves on where the rig without a drive, `held`, comes to rest: the number of its
/// experiment.
[[nodiscard]] std::optional<std::size_t> record_with_unknown_drive(const Fit& held, const Experiments& data);

}  // namespace dualdamp::identify
