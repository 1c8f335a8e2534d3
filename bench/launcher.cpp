#include "bench/launcher.hpp"

#include <array>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <utility>

namespace dualdamp::bench {

std::optional<Launch> launch() {
  static constexpr std::array<std::pair<const char*, const char*>, 4> counts = {
      {{"OMPI_COMM_WORLD_SIZE", "mpirun of Open MPI"},
       {"PMI_SIZE", "mpiexec of MPICH or Intel MPI"},
       {"MV2_COMM_WORLD_SIZE", "mpirun of MVAPICH"},
       {"SLURM_STEP_NUM_TASKS", "srun"}}};
  bool alone = false;
  for (const auto& [variable, launcher] : counts) {
    const char* text = std::getenv(variable);
    if (text == nullptr) continue;
    int processes = 0;
    std::from_chars(text, text + std::strlen(text), processes);
    if (processes > 1) return Launch{launcher, processes};
    alone = alone || processes == 1;
  }
  if (!alone && std::getenv("PMIX_RANK") != nullptr) return Launch{"a launcher that speaks PMIx", 0};
  return std::nullopt;
}

}  // namespace dualdamp::bench
