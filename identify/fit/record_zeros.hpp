#pragma once
/// The zeros of the sensors of a record that a rig predicts.
///
/// A zero that is off by less than the friction can hold is not seen without the rig. It belongs to the record, as
/// its first state does, and not to the law. The zeros are sought in the predicted record if
/// * they were sought in the fit; or
/// * the prediction leaves more than noise, and with the zeros, the rig held fixed, less than half of its sum of
///   squares remains. Of these, the zeros are kept that differ from 0 by more than four standard errors.
///
/// A constant force on the mass moves it as another zero of x does, so the text names both.
///
/// Errors: none thrown. Cost: that of fits with the first state and the zeros as parameters.

#include <string>
#include <vector>

#include "identify/fit/fit.hpp"

namespace dualdamp::identify {

/// A zero of one record.
struct RecordZero {
  std::size_t experiment = 0;
  RecordParameter which = RecordParameter::offset;

  bool operator==(const RecordZero&) const = default;
};

/// The parameters of the records that are fitted to them, with these zeros.
[[nodiscard]] std::vector<FitParameter> parameters_of_records(const Rig& rig, const Experiments& experiments,
                                                              const std::vector<RecordZero>& zeros);

/// The zeros of the records of the same kind as those among the parameters of a fit to other records.
[[nodiscard]] std::vector<RecordZero> zeros_sought_in(const std::vector<FitParameter>& parameters,
                                                      const Experiments& experiments);

/// The zeros that are off, beside those that are sought, by a fit of the rig held fixed. `held`: the same fit with
/// the zeros `sought` alone.
[[nodiscard]] std::vector<RecordZero> zeros_that_are_off(const Rig& rig, const Experiments& experiments,
                                                         const Fit& held, const std::vector<RecordZero>& sought,
                                                         const FitOptions& options);

/// What the zeros are in a fit, and how far the prediction would miss without them.
[[nodiscard]] std::string text_of_zeros(const Rig& rig, const Experiments& experiments, const Fit& held,
                                        const std::vector<RecordZero>& zeros, const FitOptions& options);

}  // namespace dualdamp::identify
