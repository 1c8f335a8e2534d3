#include "scenarios/analyses/shared/long_run.hpp"

#include <algorithm>
#include <thread>

#include "core/build_info.hpp"
#include "core/provenance.hpp"
#include "sim/parallel.hpp"

namespace dualdamp::scenarios {

std::string fingerprint(const std::string& inputs) {
  const core::BuildInfo build = core::build_info();
  return core::sha256(inputs + "\n" + std::string(build.version) + "\n" + std::string(build.commit));
}

void open_cases(CaseFile& file, const RunOptions& options) {
  ProcessGroup& processes = *options.processes;
  // Parts of an earlier run are gone before anybody begins a new one.
  if (processes.rank() == 0 && !options.resume) file.begin();
  processes.wait();
  if (options.resume)
    file.resume();
  else if (processes.rank() != 0)
    file.begin();
  processes.wait();
}

void share_out(std::size_t count, const RunOptions& options, const std::function<void(std::size_t)>& work) {
  const int threads = options.threads > 0 ? options.threads : static_cast<int>(std::thread::hardware_concurrency());
  sim::in_parts(static_cast<std::size_t>(threads), 1, threads, [&](std::size_t, std::size_t) {
    for (std::size_t item = options.processes->next(); item < count; item = options.processes->next()) work(item);
  });
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
