#pragma once
/// Samples that a logger lost: a few rows that are missing among even ones.
///
/// A lost sample is filled by the polynomial of fifth degree through three samples on each side. Whether that
/// serves is tried on samples that are there: as many in a row are left out and filled, and half of them must come
/// within four deviations of the signal's noise, or within a thousandth of its root mean square. So a random drive,
/// or a motion with six samples a period, is not filled.

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace dualdamp::identify {

/// Where the rows lie among even samples.
struct RowPlaces {
  std::vector<std::size_t> of_row;  ///< increasing from 0; a place that no row has is a lost sample
  std::size_t lost = 0;
  std::size_t lost_in_a_row = 0;  ///< at most
};

/// `step` [s]: the usual one. Nothing if a step is no multiple of it to an eighth, if more than three samples are
/// lost in a row, or more than one in twenty.
[[nodiscard]] std::optional<RowPlaces> row_places(std::span<const double> t, double step);

/// Whether the lost samples of a signal with one value for each row can be filled.
[[nodiscard]] bool can_be_filled(const RowPlaces& places, std::span<const double> signal);

/// The signal at all places. At least six rows.
[[nodiscard]] std::vector<double> filled(const RowPlaces& places, std::span<const double> signal);

}  // namespace dualdamp::identify
