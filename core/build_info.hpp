#pragma once
/// What this program was built from and with: the part of provenance that is fixed when it is compiled.

#include <string_view>

namespace dualdamp::core {

struct BuildInfo {
  std::string_view version;     ///< "0.1.0"
  std::string_view commit;      ///< git commit, "-dirty" appended when the tree had changes; "unknown" without git
  std::string_view compiler;    ///< "GNU 12.2.0"
  std::string_view build_type;  ///< "Release", ...
};

[[nodiscard]] const BuildInfo& build_info();

}  // namespace dualdamp::core
