#pragma once
// Looks at Python from inside a long computation: lets Ctrl-C end the computation and shows progress. The
// computation runs without the GIL. A look takes the GIL, at most fifty times a second.

#include <pybind11/pybind11.h>

#include <chrono>
#include <cstddef>
#include <exception>

#include "motions/base/interruption.h"

namespace kds::python {

/// Releases the GIL while it lives, for a computation of this thread. Looks when the computation asks whether
/// to go on (InterruptionCheck::ask).
class Watch {
 public:
  /// `progress` is None or a function. It is called with the number of units done, the completed share of the
  /// present unit, and the number of all units. Python handles signals in its main thread only, so Ctrl-C
  /// ends computations of that thread only.
  ///
  /// If the computation `reads_live` frames, the first Ctrl-C ends these frames (request_live_end), and the
  /// computation goes on to its results.
  explicit Watch(const pybind11::object& progress = pybind11::none(), bool reads_live = false);
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;

  /// Looks if the last look is long ago. Throws pybind11::error_already_set if Python has raised an
  /// exception, such as KeyboardInterrupt, and throws that exception again at each later look.
  void look(std::size_t done, double within, std::size_t total);
  /// Looks in any case, at the end of all units.
  void end(std::size_t total);
  /// Sets the completed share of the present unit, for the next look.
  void set_within(double within) { within_ = within; }

 private:
  /// The kernel's clock of its ticks, every few milliseconds. To read it takes a fourth of the time of
  /// std::chrono::steady_clock, and each event reads it.
  struct Clock {
    using duration = std::chrono::nanoseconds;
    using rep = duration::rep;
    using period = duration::period;
    using time_point = std::chrono::time_point<Clock>;
    static constexpr bool is_steady = true;
    static time_point now();
  };
  void look();
  void call();

  pybind11::handle progress_;  // owned by the caller; null for none
  bool main_thread_, reads_live_;
  Clock::time_point next_;
  std::size_t done_ = 0, total_ = 0;
  double within_ = 0;
  std::exception_ptr raised_;
  InterruptionCheck check_;
  pybind11::gil_scoped_release released_;  // the last member: released when all others are set
};

}  // namespace kds::python
