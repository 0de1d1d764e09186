#include "python/watch.h"

#include <ctime>

namespace kds::python {

namespace py = pybind11;

namespace {

constexpr std::chrono::milliseconds between_looks{20};

bool is_main_thread() {
  const py::module_ threading = py::module_::import("threading");
  return threading.attr("current_thread")().is(threading.attr("main_thread")());
}

}  // namespace

auto Watch::Clock::now() -> time_point {
  timespec time{};
  ::clock_gettime(CLOCK_MONOTONIC_COARSE, &time);
  return time_point(std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec));
}

Watch::Watch(const py::object& progress, bool reads_live)
    : progress_(progress.is_none() ? py::handle() : py::handle(progress)),
      main_thread_(is_main_thread()),
      reads_live_(reads_live),
      next_(Clock::now() + between_looks),
      check_([this] { look(); }) {}

void Watch::look() {
  if (raised_) std::rethrow_exception(raised_);
  if (!main_thread_ && !progress_) return;
  if (Clock::now() < next_) return;
  call();
}

void Watch::look(std::size_t done, double within, std::size_t total) {
  done_ = done;
  within_ = within;
  total_ = total;
  look();
}

void Watch::end(std::size_t total) {
  done_ = total_ = total;
  within_ = 0;
  call();
}

void Watch::call() {
  next_ = Clock::time_point::max();  // the function may start a computation, which asks this watch too
  try {
    const py::gil_scoped_acquire gil;
    if (PyErr_CheckSignals() != 0) {
      if (!reads_live_ || live_end_requested() || PyErr_ExceptionMatches(PyExc_KeyboardInterrupt) == 0)
        throw py::error_already_set();
      PyErr_Clear();
      request_live_end();
    }
    if (progress_) progress_(done_, within_, total_);
  } catch (...) {
    raised_ = std::current_exception();
    throw;
  }
  next_ = Clock::now() + between_looks;
}

}  // namespace kds::python
