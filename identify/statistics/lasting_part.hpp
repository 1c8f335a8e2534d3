#pragma once
/// The part of a signal that lasts from one sample to the next. White noise has none.

#include <span>

namespace dualdamp::identify {

/// Over one signal or several.
class LastingPart {
 public:
  void add(std::span<const double> signal);

  /// Mean product of neighbours: the mean square of the lasting part. May be negative by chance.
  [[nodiscard]] double mean_product() const { return products_ / pairs_; }
  /// The mean product over the mean square; 0 for a signal of zeros.
  [[nodiscard]] double correlation() const;
  /// Upper bound of the mean product: white noise of this level may hide a part of it by chance.
  [[nodiscard]] double at_most(double noise) const;

 private:
  double products_ = 0.0;
  double pairs_ = 0.0;
  double squares_ = 0.0;
  double samples_ = 0.0;
};

}  // namespace dualdamp::identify
