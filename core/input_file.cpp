#include "core/input_file.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <system_error>

#include "core/diagnostics.hpp"

namespace dualdamp::core {

bool is_fault_of_name(int error) {
  constexpr std::array faults = {ENOENT, ENOTDIR, EISDIR, ELOOP, ENAMETOOLONG, EINVAL, ENXIO, ENODEV};
  return std::ranges::find(faults, error) != faults.end();
}

void fail_to_read(const std::string& path, const std::string& what, int error) {
  if (!is_fault_of_name(error)) throw std::system_error(error, std::generic_category(), path + ": " + what);
  throw InputError(Diagnostic{{path, 0, 0, {}}, what + ": " + std::generic_category().message(error), {}, {}, {}});
}

}  // namespace dualdamp::core
