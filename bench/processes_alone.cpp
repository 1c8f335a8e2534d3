// Without MPI there is one process.

#include <cstdlib>

#include "bench/launcher.hpp"
#include "bench/processes.hpp"
#include "core/diagnostics.hpp"

namespace dualdamp::bench {

struct Processes::Shared {};

bool Processes::several() { return launch().has_value(); }

Processes::Processes() {
  if (const std::optional<Launch> started = launch())
    throw core::InputError(core::Diagnostic{
        .message = std::string(started->launcher) + " started this process, but this program was built without MPI",
        .allowed = "one process, or a program built anew after: sudo apt-get install libopenmpi-dev",
    });
}

Processes::~Processes() = default;

std::unique_ptr<scenarios::ItemCounter> Processes::share_items() { return ProcessGroup::share_items(); }

void Processes::wait() {}

std::optional<Processes::Failure> Processes::first_failure(int status) {
  return status == 0 ? std::nullopt : std::optional(Failure{0, status});
}

void Processes::abort(int status) { std::_Exit(status); }

}  // namespace dualdamp::bench
