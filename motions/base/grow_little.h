#pragma once
// Flat arrays that grow by an eighth, not to twice their size: their memory is what they hold, nearly.

#include <cstddef>
#include <vector>

namespace kds {

/// At least this size.
template <class T>
void grow_little(std::vector<T>& array, std::size_t size) {
  if (size > array.capacity()) array.reserve(size + size / 8 + 16);
  if (size > array.size()) array.resize(size);
}

template <class T>
void append_little(std::vector<T>& array, const T& value) {
  if (array.size() == array.capacity()) array.reserve(array.size() + array.size() / 8 + 16);
  array.push_back(value);
}

/// The same of a new one, in place.
template <class T>
T& extend_little(std::vector<T>& array) {
  if (array.size() == array.capacity()) array.reserve(array.size() + array.size() / 8 + 16);
  return array.emplace_back();
}

}  // namespace kds
