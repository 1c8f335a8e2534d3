#include "scenarios/analyses/shared/long_run.hpp"

#include <algorithm>
#include <atomic>
#include <memory>
#include <thread>

#include "core/build_info.hpp"
#include "core/provenance.hpp"
#include "sim/parallel.hpp"

namespace dualdamp::scenarios {

std::string fingerprint(const std::string& inputs) {
  const core::BuildInfo build = core::build_info();
  return core::sha256(inputs + "\n" + std::string(build.version) + "\n" + std::string(build.commit));
}

bool open_cases(CaseFile& file, std::size_t cases, const RunOptions& options) {
  ProcessGroup& processes = *options.processes;
  // Parts of an earlier run are removed before any process begins a new one.
  if (processes.rank() == 0) file.prepare(options.found);
  processes.wait();
  file.open();
  const bool is_complete = file.finished() == cases;
  processes.wait();
  return is_complete;
}

void share_out(std::size_t count, const RunOptions& options, const std::function<void(std::size_t)>& work) {
  const std::unique_ptr<ItemCounter> items = options.processes->share_items();
  std::atomic<bool> failed{false};  // of any thread: the others stop
  const auto take_items = [&] {
    for (std::size_t item = items->next(); item < count && !failed; item = items->next()) {
      try {
        work(item);
      } catch (...) {
        failed = true;
        throw;
      }
    }
  };
  const int threads = options.threads > 0 ? options.threads : static_cast<int>(std::thread::hardware_concurrency());
  sim::in_parts(static_cast<std::size_t>(threads), 1, threads, [&](std::size_t, std::size_t) { take_items(); });
}

Meter::Meter(std::size_t done, std::size_t all, const RunOptions& options)
    : first_(done), done_(done), all_(all), options_(options), start_(Clock::now()), told_(start_) {}

void Meter::add() {
  const auto since = [](Clock::time_point time) {
    return std::chrono::duration<double>(Clock::now() - time).count();
  };
  const std::lock_guard lock(mutex_);
  ++done_;
  constexpr double pause = 0.2;
  if (!options_.progress || (since(told_) < pause && done_ < all_)) return;
  told_ = Clock::now();
  const double rate = static_cast<double>(done_ - first_) / std::max(since(start_), 1e-9);
  options_.progress({done_, all_, rate, static_cast<double>(all_ - done_) / rate});
}

}  // namespace dualdamp::scenarios
