// Without MPI there is one process.

#include <atomic>
#include <cstdlib>

#include "bench/processes.hpp"
#include "core/diagnostics.hpp"

namespace dualdamp::bench {

struct Processes::Shared {
  std::atomic<std::size_t> counter{0};
};

bool Processes::several() { return std::getenv("OMPI_COMM_WORLD_SIZE") != nullptr; }

Processes::Processes() : shared_(std::make_unique<Shared>()) {
  if (several())
    throw core::InputError(core::Diagnostic{
        .message = "mpirun started this process, but this program was built without MPI",
        .allowed = "one process, or a program built anew after: sudo apt-get install libopenmpi-dev",
    });
}

Processes::~Processes() = default;

std::size_t Processes::next() { return shared_->counter++; }

void Processes::wait() {}

}  // namespace dualdamp::bench
