#include "core/build_info.hpp"
#include "core/provenance.hpp"
#include "friction_models/plugin.hpp"
#include "python/src/parts.hpp"

PYBIND11_MODULE(_core, module) {
  using namespace dualdamp;
  module.doc() = "The libraries of dualdamp. Use the package dualdamp, not this module.";
  const core::BuildInfo build = core::build_info();
  module.attr("version") = std::string(build.version);
  module.attr("commit") = std::string(build.commit);
  module.def("load_plugin", &friction::load_plugin, pybind11::arg("file"));
  python::add_errors(module);
  python::add_runs(module);
  python::add_tables(module);
  python::add_batches(module);
}
