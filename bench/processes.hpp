#pragma once
/// The processes that share a campaign: one alone, or those that a launcher (`launcher.hpp`) has started.
///
/// Work is handed out one item at a time to whichever process asks, by a counter that process 0 keeps; which
/// process does what is left to chance and must not matter. Source: the MPI standard, one-sided communication.
///
/// A process that fails while the others work would leave them waiting: it says why and calls `abort`. Failures
/// that come before the work are agreed on by `first_failure`.
///
/// Errors: `std::runtime_error` when MPI fails; `core::InputError` when a launcher starts a program that was built
/// without MPI, or several processes that do not know each other.

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

  /// Whether a launcher started several; without joining.
  [[nodiscard]] static bool several();

 private:
  struct Shared;
  class SharedCounter;

  int rank_ = 0;
  int count_ = 1;
  std::unique_ptr<Shared> shared_;
};

}  // namespace dualdamp::bench
