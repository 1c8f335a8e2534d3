#pragma once
/// The processes that share a campaign: one alone, or those that a launcher (`launcher.hpp`) has started.
///
/// A counter in process 0 gives out work, one item at a time, to the process that asks next. Which process does
/// which item is random and must not affect results. Source: the MPI standard, one-sided communication.
///
/// If a process failed during the work, the others would wait for it; so it prints the reason and calls `abort`.
/// For failures before the work, `first_failure` tells all processes.
///
/// Errors: `std::runtime_error` when MPI fails; `core::InputError` when a launcher starts a program that was built
/// without MPI, or several processes that the MPI library does not connect.

#include <memory>
#include <optional>

#include "scenarios/analyses/shared/run_options.hpp"

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
  [[nodiscard]] std::unique_ptr<scenarios::ItemCounter> share_items() override;
  void wait() override;

  struct Failure {
    int rank = 0;
    int status = 0;
  };
  /// The process of lowest rank that has failed, that is, whose `status` is not 0; called by all.
  [[nodiscard]] std::optional<Failure> first_failure(int status);

  /// Ends all processes, this one with them.
  [[noreturn]] void abort(int status);

  /// Whether a launcher started several processes; does not join them.
  [[nodiscard]] static bool several();

 private:
  struct Shared;
  class SharedCounter;

  int rank_ = 0;
  int count_ = 1;
  std::unique_ptr<Shared> shared_;
};

}  // namespace dualdamp::bench
