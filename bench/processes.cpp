#include "bench/processes.hpp"

#include <mpi.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <mutex>
#include <stdexcept>
#include <stop_token>
#include <thread>

namespace dualdamp::bench {

namespace {

void check(int outcome, const char* what) {
  if (outcome != MPI_SUCCESS) throw std::runtime_error(std::string("MPI failed: ") + what);
}

}  // namespace

struct Processes::Shared {
  std::atomic<std::size_t> alone{0};  ///< the counter of a process without others
  std::mutex mutex;                   ///< MPI is called by one thread at a time
  MPI_Win window = MPI_WIN_NULL;
  long* counter = nullptr;
  std::jthread attendant;  ///< of process 0
};

namespace {

constexpr std::chrono::milliseconds pause{1};

/// Over a network the counter answers only while its own process is inside MPI: without this the others would wait
/// for as long as process 0 computes.
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

}  // namespace

bool Processes::several() { return std::getenv("OMPI_COMM_WORLD_SIZE") != nullptr; }

Processes::Processes() : shared_(std::make_unique<Shared>()) {
  if (!several()) return;
  int provided = 0;
  check(MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &provided), "start");
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &count_);
  const MPI_Aint size = rank_ == 0 ? sizeof(long) : 0;
  check(MPI_Win_allocate(size, sizeof(long), MPI_INFO_NULL, MPI_COMM_WORLD, static_cast<void*>(&shared_->counter),
                         &shared_->window),
        "shared counter");
  if (rank_ == 0) *shared_->counter = 0;
  wait();
  if (rank_ == 0 && count_ > 1)
    shared_->attendant = std::jthread([this](const std::stop_token& stop) { attend(shared_->mutex, stop); });
}

Processes::~Processes() {
  if (shared_->window == MPI_WIN_NULL) return;
  shared_->attendant = {};
  MPI_Win_free(&shared_->window);
  MPI_Finalize();
}

std::size_t Processes::next() {
  if (shared_->window == MPI_WIN_NULL) return shared_->alone++;
  const std::lock_guard lock(shared_->mutex);
  const long one = 1;
  long item = 0;
  check(MPI_Win_lock(MPI_LOCK_EXCLUSIVE, 0, 0, shared_->window), "lock");
  check(MPI_Fetch_and_op(&one, &item, MPI_LONG, 0, 0, MPI_SUM, shared_->window), "next item");
  check(MPI_Win_unlock(0, shared_->window), "unlock");
  return static_cast<std::size_t>(item);
}

void Processes::wait() {
  if (shared_->window == MPI_WIN_NULL) return;
  // A barrier of MPI's own would keep a core busy for as long as the slowest process works.
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

}  // namespace dualdamp::bench
