#pragma once
/// `regime_map`: steady states over frequency and input amplitude, and where they begin to stick.

#include "scenarios/analysis.hpp"

namespace dualdamp::scenarios {

class RegimeMapQuestion final : public Question {
 public:
  /// Frequencies in rad/s, amplitudes in m or N.
  RegimeMapQuestion(std::vector<double> frequencies, const std::vector<double>& amplitudes, bool with_boundary)
      : RegimeMapQuestion(std::move(frequencies), amplitudes, with_boundary, amplitudes) {}
  /// `scanned`: amplitudes at which the search for the boundary looks, in place of those of the map.
  RegimeMapQuestion(std::vector<double> frequencies, std::vector<double> amplitudes, bool with_boundary,
                    std::vector<double> scanned)
      : frequencies_(std::move(frequencies)),
        amplitudes_(std::move(amplitudes)),
        scanned_(std::move(scanned)),
        with_boundary_(with_boundary) {}

  [[nodiscard]] Answer run(const RunContext& context) const override;
  /// Four frequencies times four amplitudes, evenly spaced in their lists, first and last included.
  [[nodiscard]] std::optional<Sampled> sampled() const override;

 private:
  std::vector<double> frequencies_;
  std::vector<double> amplitudes_;
  std::vector<double> scanned_;
  bool with_boundary_;  ///< find the sticking boundary too
};

[[nodiscard]] const Analysis& regime_map_analysis();

}  // namespace dualdamp::scenarios
