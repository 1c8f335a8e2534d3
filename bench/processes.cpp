#include "bench/processes.hpp"

#include <mpi.h>

#include <chrono>
#include <cstdlib>
#include <limits>
#include <mutex>
#include <stdexcept>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "bench/launcher.hpp"
#include "core/diagnostics.hpp"

namespace dualdamp::bench {

namespace {

constexpr std::chrono::milliseconds pause{1};

void check(int outcome, const char* what) {
  if (outcome != MPI_SUCCESS) throw std::runtime_error(std::string("MPI failed: ") + what);
}

/// Over a network a counter answers only while its own process is inside MPI. Without this loop the other processes
/// would wait while process 0 computes.
void attend(std::mutex& mutex, const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    {
      const std::lock_guard lock(mutex);
      int unused = 0;
      MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &unused, MPI_STATUS_IGNORE);
    }
    std::this_thread::sleep_for(pause);
  }
}

/// With an MPI library that does not belong to the launcher, every process finds itself alone.
void check_count(int count) {
  const std::optional<Launch> started = launch();
  if (!started || started->processes <= 1 || started->processes == count) return;
  throw core::InputError(core::Diagnostic{
      .message = std::string(started->launcher) + " started " + std::to_string(started->processes) +
                 " processes, but the MPI library of this program joins " + std::to_string(count),
      .allowed = "mpirun of Open MPI; or srun with the plugin of that library, such as srun --mpi=pmix",
  });
}

}  // namespace

struct Processes::Shared {
  std::mutex mutex;              ///< only one thread at a time calls MPI
  std::vector<MPI_Win> windows;  ///< of all counters; freed together at the end, not in a failing process
  std::jthread attendant;        ///< of process 0
};

class Processes::SharedCounter final : public scenarios::ItemCounter {
 public:
  SharedCounter(std::mutex& mutex, MPI_Win window) : mutex_(mutex), window_(window) {}

  std::size_t next() override {
    const std::lock_guard lock(mutex_);
    const long one = 1;
    long item = 0;
    check(MPI_Win_lock(MPI_LOCK_EXCLUSIVE, 0, 0, window_), "lock");
    check(MPI_Fetch_and_op(&one, &item, MPI_LONG, 0, 0, MPI_SUM, window_), "next item");
    check(MPI_Win_unlock(0, window_), "unlock");
    return static_cast<std::size_t>(item);
  }

 private:
  std::mutex& mutex_;
  MPI_Win window_;
};

bool Processes::several() { return launch().has_value(); }

Processes::Processes() : shared_(std::make_unique<Shared>()) {
  if (!several()) return;
  int provided = 0;
  check(MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &provided), "start");
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &count_);
  try {
    check_count(count_);
  } catch (...) {
    MPI_Finalize();
    throw;
  }
  if (rank_ == 0 && count_ > 1)
    shared_->attendant = std::jthread([this](const std::stop_token& stop) { attend(shared_->mutex, stop); });
}

Processes::~Processes() {
  shared_->attendant = {};
  for (MPI_Win& window : shared_->windows) MPI_Win_free(&window);
  int initialised = 0;
  MPI_Initialized(&initialised);
  if (initialised != 0) MPI_Finalize();
}

std::unique_ptr<scenarios::ItemCounter> Processes::share_items() {
  if (count_ == 1) return ProcessGroup::share_items();
  MPI_Win window = MPI_WIN_NULL;
  {
    const std::lock_guard lock(shared_->mutex);
    long* counter = nullptr;
    const MPI_Aint size = rank_ == 0 ? sizeof(long) : 0;
    check(
        MPI_Win_allocate(size, sizeof(long), MPI_INFO_NULL, MPI_COMM_WORLD, static_cast<void*>(&counter), &window),
        "shared counter");
    if (rank_ == 0) *counter = 0;
    shared_->windows.push_back(window);
  }
  wait();
  return std::make_unique<SharedCounter>(shared_->mutex, window);
}

void Processes::wait() {
  if (count_ == 1) return;
  // A blocking barrier of MPI would keep a core busy until the slowest process arrives.
  MPI_Request request = MPI_REQUEST_NULL;
  const auto arrived = [&] {
    const std::lock_guard lock(shared_->mutex);
    if (request == MPI_REQUEST_NULL) check(MPI_Ibarrier(MPI_COMM_WORLD, &request), "wait");
    int all = 0;
    check(MPI_Test(&request, &all, MPI_STATUS_IGNORE), "wait");
    return all != 0;
  };
  while (!arrived()) std::this_thread::sleep_for(pause);
}

std::optional<Processes::Failure> Processes::first_failure(int status) {
  constexpr int none = std::numeric_limits<int>::max();
  if (count_ == 1) return status == 0 ? std::nullopt : std::optional(Failure{0, status});
  constexpr int statuses = 256;  // of a process
  const int mine = status == 0 ? none : rank_ * statuses + status;
  int first = none;
  const std::lock_guard lock(shared_->mutex);
  check(MPI_Allreduce(&mine, &first, 1, MPI_INT, MPI_MIN, MPI_COMM_WORLD), "agree");
  if (first == none) return std::nullopt;
  return Failure{first / statuses, first % statuses};
}

void Processes::abort(int status) {
  if (count_ > 1) MPI_Abort(MPI_COMM_WORLD, status);
  std::_Exit(status);
}

}  // namespace dualdamp::bench
