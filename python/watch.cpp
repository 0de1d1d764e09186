#include "python/watch.h"

namespace kds::python {

namespace py = pybind11;

namespace {

constexpr std::chrono::milliseconds between_looks{50};

bool is_main_thread() {
  const py::module_ threading = py::module_::import("threading");
  return threading.attr("current_thread")().is(threading.attr("main_thread")());
}

}  // namespace

Watch::Watch(const py::object& progress)
    : outer_(present),
      progress_(progress.is_none() ? py::handle() : py::handle(progress)),
      main_thread_(is_main_thread()),
      next_(Clock::now() + between_looks) {
  present = this;
}

void Watch::look() {
  if (!main_thread_ && !progress_) return;
  if (Clock::now() < next_) return;
  call();
  next_ = Clock::now() + between_looks;
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

void Watch::glance(double within) {
  if (present == nullptr) return;
  present->within_ = within;
  present->look();
}

void Watch::call() {
  const py::gil_scoped_acquire gil;
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  if (progress_) progress_(done_, within_, total_);
}

}  // namespace kds::python
