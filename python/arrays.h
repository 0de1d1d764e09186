#pragma once
// Arrays of NumPy that own what C++ computed. An array outlives the object that made it.

#include <pybind11/numpy.h>

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

namespace kds::python {

/// Returns an array that takes over the memory of `values`. `shape` has as many elements.
template <class T>
[[nodiscard]] pybind11::array_t<T> array_of(std::vector<T> values, std::vector<pybind11::ssize_t> shape) {
  auto kept = std::make_unique<std::vector<T>>(std::move(values));
  T* const data = kept->data();
  const pybind11::capsule owner(kept.get(),
                                [](void* vector) { delete static_cast<std::vector<T>*>(vector); });
  static_cast<void>(kept.release());
  return pybind11::array_t<T>(std::move(shape), data, owner);
}
template <class T>
[[nodiscard]] pybind11::array_t<T> array_of(std::vector<T> values) {
  const auto size = static_cast<pybind11::ssize_t>(values.size());
  return array_of(std::move(values), {size});
}

}  // namespace kds::python
