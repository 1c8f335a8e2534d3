#pragma once
/// Detects a launcher of parallel programs by the environment variables that it sets.

#include <optional>

namespace dualdamp::bench {

struct Launch {
  const char* launcher;  ///< "mpirun of Open MPI", ...
  int processes = 0;     ///< that it started; 0 where it does not say how many
};

/// Nothing where no launcher is known to have started this process. Known are Open MPI (OMPI_COMM_WORLD_SIZE),
/// MPICH and Intel MPI (PMI_SIZE), MVAPICH (MV2_COMM_WORLD_SIZE), Slurm's srun (SLURM_STEP_NUM_TASKS), and any
/// launcher with PMIx (PMIX_RANK). A launcher of a single process does not count.
[[nodiscard]] std::optional<Launch> launch();

}  // namespace dualdamp::bench
