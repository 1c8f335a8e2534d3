#pragma once
/// The list of identification methods: explicit, one line a method.

#include <string_view>
#include <vector>

#include "core/outcome.hpp"
#include "identify/estimate.hpp"
#include "identify/record.hpp"

namespace dualdamp::identify {

enum class RecordKind { pairs, decay };

struct MethodOptions {
  /// G from the exact Eq (4), or from the paper's approximation Eq (15) as a named variant.
  bool approximate_G = false;
  /// Numbers of the two pairs used by resonance_two_point; 0: the outermost usable pairs.
  int first_pair = 0;
  int second_pair = 0;
};

struct MethodEntry {
  std::string_view name;      ///< contract
  std::string_view summary;   ///< one line
  std::string_view assumes;   ///< what must hold, and how the method checks it
  std::string_view equation;  ///< plain text
  RecordKind needs;
  /// When no estimate is possible: an Estimate with usable = false and the reason.
  Estimate (*run)(const Record&, const KnownConstants&, const MethodOptions&);
};

[[nodiscard]] const std::vector<MethodEntry>& methods();
[[nodiscard]] const MethodEntry* find_method(std::string_view name);

}  // namespace dualdamp::identify
