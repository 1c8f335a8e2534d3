#include <cstdint>

#include "core/build_info.hpp"
#include "core/provenance.hpp"
#include "friction_models/plugin.hpp"
#include "friction_models/registry.hpp"
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
  module.def("load_plugin", &friction::load_plugin, pybind11::arg("file"));
  module.def(
      "add_law",
      [](std::uintptr_t table, const std::string& origin, const std::string& source) {
        // The address of a table that the caller keeps (dualdamp/_python_laws.py).
        const auto* const law =
            reinterpret_cast<const dualdamp_law_table*>(table);  // NOLINT(performance-no-int-to-ptr)
        friction::remove_added_law(law->name == nullptr ? "" : law->name);
        friction::add_plugin(*law, origin, core::sha256(source));
      },
      pybind11::arg("table"), pybind11::arg("origin"), pybind11::arg("source"));
  module.def("remove_law", &friction::remove_added_law, pybind11::arg("name"));
  python::end_computations_at_exit();
  python::add_errors(module);
  python::add_runs(module);
  python::add_tables(module);
  python::add_batches(module);
}
