#include <string>

#include "core/build_info.hpp"
#include "python/src/interruptible.hpp"
#include "python/src/parts.hpp"

PYBIND11_MODULE(_core, module) {
  using namespace dualdamp;
  module.doc() = "The libraries of dualdamp. Use the package dualdamp, not this module.";
  const core::BuildInfo build = core::build_info();
  module.attr("version") = std::string(build.version);
  module.attr("commit") = std::string(build.commit);
  // Older versions misread the size of a number in NumPy 2, and then take the first row of a table for every row.
  module.attr("knows_numpy_2") = PYBIND11_VERSION_HEX >= 0x020C0000;
  python::end_computations_at_exit();
  python::add_errors(module);
  python::add_laws(module);
  python::add_runs(module);
  python::add_tables(module);
  python::add_batches(module);
}
