#pragma once
/// Readings that disagree with the others, and estimates in which their influence is bounded.
///
/// Huber's estimate: a reading further than k = 2 standard deviations from the joint model of the record counts as
/// if it were k deviations off. It equals least squares on readings moved to that bound, so every method gives it
/// when it reads the record that `bounded_influence` returns. Standard deviations are estimated from the median,
/// channel by channel; the model is fitted again until no reading moves. Standard errors are divided by the share
/// of readings within the bound. Readings are amplitudes x, phases, extremes and their times; spikes in histories:
/// records/spikes.hpp.
///
/// Of up to 24 readings a gross error (gross_error.hpp) is left out before: it counts nothing.
/// Source: huber1981, chapter 7.8 (modified residuals). Cost: some fits of the joint model.

#include <optional>
#include <string>
#include <vector>

#include "identify/estimate.hpp"
#include "identify/outliers/gross_error.hpp"
#include "identify/record.hpp"

namespace dualdamp::identify {

/// A reading that counts half or less: further than 2 k deviations off.
struct Outlier {
  std::string reading;      ///< "x of pair 7", "extreme 3"
  double deviations = 0.0;  ///< how far off, in standard deviations of the others; with its sign
  double weight = 1.0;      ///< that it still has
};

struct BoundedInfluence {
  Record record;                    ///< with the readings beyond the bound moved to it
  std::vector<Outlier> outliers;    ///< a gross error among few readings, then in the order of the record
  std::optional<GrossError> gross;  ///< a reading that all others exclude
  double within = 1.0;              ///< share of the readings within the bound
};

/// The record unchanged if there is no joint model of it.
[[nodiscard]] BoundedInfluence bounded_influence(const Record& record, const KnownConstants& constants);

/// Divides standard errors and half widths of intervals by `within`, the share of readings that were not moved.
void widen(Estimate& estimate, double within);

}  // namespace dualdamp::identify
