#pragma once
// Looks at Python from inside a long computation: lets Ctrl-C end the computation and shows progress. The
// computation runs without the GIL. A look takes the GIL, at most about twenty times a second.

#include <pybind11/pybind11.h>

#include <chrono>
#include <cstddef>

namespace kds::python {

/// Releases the GIL while it lives, for a computation of this thread.
class Watch {
 public:
  /// `progress` is None or a function. It is called with the number of units done, the completed share of the
  /// present unit, and the number of all units. Python handles signals in its main thread only, so Ctrl-C
  /// ends computations of that thread only.
  explicit Watch(const pybind11::object& progress = pybind11::none());
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;
  ~Watch() { present = outer_; }

  /// Looks if the last look is long ago. Throws pybind11::error_already_set if Python has raised an
  /// exception, such as KeyboardInterrupt.
  void look(std::size_t done, double within, std::size_t total);
  /// Looks in any case, at the end of all units.
  void end(std::size_t total);
  /// Looks like `look`, if a computation of this thread is watched. `within` is the completed share of the
  /// present unit.
  static void glance(double within = 0);

 private:
  using Clock = std::chrono::steady_clock;
  void look();
  void call();

  static thread_local inline Watch* present = nullptr;

  Watch* outer_;               // the computation during which this one was called, or null
  pybind11::handle progress_;  // owned by the caller; null for none
  bool main_thread_;
  Clock::time_point next_;
  std::size_t done_ = 0, total_ = 0;
  double within_ = 0;
  pybind11::gil_scoped_release released_;  // the last member: released when all others are set
};

}  // namespace kds::python
