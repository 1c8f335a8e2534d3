#pragma once
/// A model tied to the motion that was measured, for the begin of a search.
///
///   m x'' + c x' + k x + F + k_t (x - x_m) + c_t (x' - v_m) = drive,   k_t = s k,   c_t = 2 sqrt(s m k)
///
/// x_m and v_m are the measured motion. A motion of its own falls behind the measured one, sticks where that slips,
/// and the sum of squares has a false minimum for each swing and each stick it may lose or win. A tied one follows
/// the measured motion swing by swing, and misses it by what the friction force is off there: its sum of squares
/// falls from afar towards numbers near the true ones. The tie is then made weaker and taken away.
///
/// The measured motion is laid through nodes, about 24 in a swing to and fro, as parabolas through the samples
/// about each. Where x was not measured there is no k_t; an acceleration is summed up from the velocity that the
/// record is to begin with.
///
/// Holds for springs that follow Hooke's law, and for any spring on a base at rest. Source: abarbanel2009. Cost: a
/// motion under a sampled force.

#include <optional>
#include <vector>

#include "identify/fit/rig.hpp"
#include "sim/model.hpp"

namespace dualdamp::identify {

/// Samples of a motion; those that were not measured are empty.
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

  /// The model with a force in place of its drive; nothing if its spring is not linear and its base moves.
  [[nodiscard]] std::optional<sim::Model> tied(const sim::Model& model, const OwnValues& own) const;

 private:
  double strength_;
  bool follows_x_;
  bool begins_with_v_;  ///< v_m is how the velocity changes since the first sample
  std::vector<double> times_;
  std::vector<double> x_;
  std::vector<double> v_;
};

}  // namespace dualdamp::identify
