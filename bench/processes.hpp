#pragma once
/// The processes that share a campaign: one alone, or those that `mpirun -n N` has started.
///
/// Work is handed out one item at a time to whichever process asks, by a counter that process 0 keeps; which
/// process does what is left to chance and must not matter. Source: the MPI standard, one-sided communication.
/// Errors: `std::runtime_error` when MPI fails; `core::InputError` when `mpirun` starts a program that was built
/// without MPI.

#include <cstddef>
#include <memory>

#include "scenarios/analyses/run_options.hpp"

namespace dualdamp::bench {

class Processes final : public scenarios::ProcessGroup {
 public:
  /// Joins the others when this process is one of several.
  Processes();
  ~Processes() override;
  Processes(const Processes&) = delete;
  Processes& operator=(const Processes&) = delete;

  [[nodiscard]] int rank() const override { return rank_; }
  [[nodiscard]] int count() const { return count_; }
  [[nodiscard]] std::size_t next() override;
  void wait() override;

  /// Whether mpirun started this process; without joining.
  [[nodiscard]] static bool several();

 private:
  struct Shared;

  int rank_ = 0;
  int count_ = 1;
  std::unique_ptr<Shared> shared_;
};

}  // namespace dualdamp::bench
