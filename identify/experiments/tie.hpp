#pragma once
/// A model that is tied to the measured motion, for the first steps of a search.
///
///   m x'' + c x' + k x + F + k_t (x - x_m) + c_t (x' - v_m) = drive,   k_t = s k,   c_t = 2 sqrt(s m k)
///
/// x_m and v_m are the measured motion. Without a tie, a motion may fall behind the measured one or stick where
/// that one slips, and the sum of squares has a false minimum for each swing and each stick more or less. A tied
/// motion follows the measured one swing by swing, and its deviation shows the error of the friction force there.
/// Its sum of squares therefore leads from distant starts to parameters near the true ones. The search then weakens
/// the tie and removes it.
///
/// The measured motion is interpolated between nodes, about 24 in a period; the value at a node comes from a
/// parabola through the samples around it. Without a measured x there is no k_t. An acceleration is integrated from
/// the first velocity of the record.
///
/// Holds for linear springs, and for any spring on a base at rest. Source: abarbanel2009. Cost: a motion under a
/// sampled force.

#include <optional>
#include <vector>

#include "identify/experiments/rig.hpp"
#include "sim/model.hpp"

namespace dualdamp::identify {

/// Samples of a motion. Signals that were not measured are empty.
struct MeasuredSamples {
  double rate = 0.0;  ///< Hz
  const std::vector<double>& x;
  const std::vector<double>& v;
  const std::vector<double>& a;
};

class Tie {
 public:
  /// `frequency`: of the motion [rad/s]. `strength`: s > 0.
  Tie(const MeasuredSamples& samples, double frequency, double strength);

  /// The model with the tie, and with a force in place of its drive. Nothing if its spring is not linear and its
  /// base moves.
  [[nodiscard]] std::optional<sim::Model> tied(const sim::Model& model, const RecordValues& of_record) const;

 private:
  double strength_;
  bool follows_x_;
  bool begins_with_v_;  ///< v_m is the change of the velocity since the first sample
  std::vector<double> times_;
  std::vector<double> x_;
  std::vector<double> v_;
};

}  // namespace dualdamp::identify
