#pragma once
/// The list of identification methods: explicit, sorted by name, one line a method.

#include <string_view>
#include <vector>

#include "identify/estimate.hpp"
#include "identify/record.hpp"

namespace dualdamp::identify {

enum class RecordKind { pairs, decay };

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
};

struct MethodEntry {
  std::string_view name;      ///< contract
  std::string_view summary;   ///< one line
  std::string_view assumes;   ///< what must hold, and how the method checks it
  std::string_view equation;  ///< plain text
  RecordKind needs;
  /// A record without the kind it needs, or without enough usable data: `outcome` not ok() with the reason.
  Estimate (*run)(const Record&, const KnownConstants&, const MethodOptions&);
};

[[nodiscard]] const std::vector<MethodEntry>& methods();

/// nullptr when there is no such method.
[[nodiscard]] const MethodEntry* find_method(std::string_view name);

}  // namespace dualdamp::identify
