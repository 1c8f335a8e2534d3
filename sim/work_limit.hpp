#pragma once
/// A limit of the work of motions: while the object lives, a motion of the calling thread whose engine has done
/// more work (`Engine::work`) ends with an outcome that says so. A search that has a limit of its own sets it, so
/// that no single motion runs past that limit. Of nested limits the inner one counts.

namespace dualdamp::sim {

class WorkLimit {
 public:
  explicit WorkLimit(long most);
  WorkLimit(const WorkLimit&) = delete;
  WorkLimit& operator=(const WorkLimit&) = delete;
  ~WorkLimit();

  /// Whether a motion has ended here.
  [[nodiscard]] bool is_exceeded() const { return is_exceeded_; }

  /// For engines: whether a motion that has done this work may go on. If not, the limit is exceeded.
  [[nodiscard]] static bool allows(long work);
  /// The limit of the calling thread.
  [[nodiscard]] static long most();

 private:
  WorkLimit* outer_;
  long most_;
  bool is_exceeded_ = false;
};

}  // namespace dualdamp::sim
