// The paper's first row through the installed headers and libraries: what a consumer would write.
#include <cstdio>

#include "core/build_info.hpp"
#include "friction_models/registry.hpp"
#include "identify/methods.hpp"

int main() {
  const auto& build = dualdamp::core::build_info();
  std::printf("dualdamp %.*s\n", static_cast<int>(build.version.size()), build.version.data());
  return dualdamp::friction::find_law("coulomb") != nullptr && !dualdamp::identify::methods().empty() ? 0 : 1;
}
