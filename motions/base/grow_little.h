#pragma once
// Functions for arrays that grow by an eighth instead of doubling, so that little memory is unused.

#include <cstddef>
#include <vector>

namespace kds {

/// Makes the array at least this long.
template <class T>
void grow_little(std::vector<T>& array, std::size_t size) {
  if (size > array.capacity()) array.reserve(size + size / 8 + 16);
  if (size > array.size()) array.resize(size);
}

/// Appends the value.
template <class T>
void append_little(std::vector<T>& array, const T& value) {
  if (array.size() == array.capacity()) array.reserve(array.size() + array.size() / 8 + 16);
  array.push_back(value);
}

/// Appends a new value and returns it.
template <class T>
T& extend_little(std::vector<T>& array) {
  if (array.size() == array.capacity()) array.reserve(array.size() + array.size() / 8 + 16);
  return array.emplace_back();
}

}  // namespace kds
