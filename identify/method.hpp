#pragma once
/// The contract of an identification method: a record in, an estimate out. A header of a method defines its
/// `MethodEntry`; `methods.cpp` lists them.

#include <string_view>
#include <vector>

#include "identify/estimate.hpp"
#include "identify/record.hpp"

namespace dualdamp::identify {

/// What a method works on.
enum class RecordKind {
  pairs,    ///< amplitude pairs at one frequency
  states,   ///< amplitude pairs with phases, or at several frequencies
  decay,    ///< extremes of a free vibration
  history,  ///< sampled signals
};

/// "x-Y pairs", "extremes of a free vibration", ...
[[nodiscard]] std::string_view describe(RecordKind kind);

struct MethodOptions {
  /// G from the exact Eq (4) at w = wn, or from the paper's approximation Eq (15) as a named variant.
  bool approximate_G = false;
  /// Numbers of the two pairs used by resonance_two_point; 0: the outermost usable pairs.
  int first_pair = 0;
  int second_pair = 0;
  /// Standard deviations of one measured output and input amplitude (of one extreme: sigma_x) [m]. When either is
  /// positive they replace the scatter of the residuals, so that even two pairs have standard errors.
  double sigma_x = 0.0;
  double sigma_Y = 0.0;
  /// free_decay: the extremes are about zero, so three of them suffice.
  bool zero_offset = false;
  /// den_hartog_fit: the natural frequency is fitted too.
  bool free_natural_frequency = false;
  /// Cut-off frequencies of the low-pass filter that histories are differentiated with [Hz]: the estimate is made
  /// with the first, and made again with the others to show what the choice matters. Empty: the method's own.
  std::vector<double> cutoffs;
  /// Samples slower than this are left out where friction is regressed on speed [m/s]; 0: the method's own choice.
  double least_speed = 0.0;
  /// Replicates of a bootstrap by sweeps (by residuals where there is one sweep); 0: none.
  int bootstrap = 0;
  /// Profiles of the likelihood of zeta and F0, as curves with the intervals that follow from them.
  bool profile = false;
  /// recursive_least_squares: forgetting factor, in (0, 1]; 1 forgets nothing.
  double forgetting = 1.0;
  /// extended_kalman: width of the smoothed sign of the velocity [m/s]; 0: the method's own choice.
  double sign_width = 0.0;
};

struct MethodEntry {
  std::string_view name;      ///< contract
  std::string_view summary;   ///< one line
  std::string_view assumes;   ///< what must hold, and how the method checks it
  std::string_view equation;  ///< plain text
  std::string_view sources;   ///< keys in docs/refs.bib
  RecordKind needs;
  /// Why this record does not hold what the method needs; empty when it does.
  std::string (*lacks)(const Record&);
  /// A record that lacks something, or has not enough usable data: `outcome` not ok() with the reason.
  Estimate (*run)(const Record&, const KnownConstants&, const MethodOptions&);
};

/// `lacks` of the methods that ask for no more: "the record holds no x-Y pairs". `lacks_resonance_pairs` wants them
/// all at one frequency.
[[nodiscard]] std::string lacks_pairs(const Record& record);
[[nodiscard]] std::string lacks_resonance_pairs(const Record& record);
[[nodiscard]] std::string lacks_decay(const Record& record);

}  // namespace dualdamp::identify
