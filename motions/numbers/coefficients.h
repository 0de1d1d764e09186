#pragma once
// A row of numbers whose length is known only when the program runs. Short rows of plain numbers lie in the
// object itself and cost no allocation; a copy costs as many numbers as there are.

#include <algorithm>
#include <cstddef>
#include <memory>
#include <new>
#include <type_traits>
#include <vector>

namespace kds {

template <class Number>
class PlainCoefficients {
  static_assert(std::is_trivially_copyable_v<Number>);

 public:
  static constexpr std::size_t room = 48;  ///< norms of cubic motion have 37

  PlainCoefficients() {}
  PlainCoefficients(const PlainCoefficients& other) { *this = other; }
  [[gnu::noinline]] PlainCoefficients& operator=(const PlainCoefficients& other) {
    if (this == &other) return *this;
    resize(other.size_);
    std::copy_n(other.begin(), size_, begin());
    return *this;
  }
  ~PlainCoefficients() = default;

  /// Keeps the numbers there are; new ones are not set to anything.
  [[gnu::noinline]] void resize(std::size_t size) {
    if (size > room && size > size_) {
      auto more = std::make_unique<Number[]>(size);
      std::copy_n(begin(), size_, more.get());
      more_ = std::move(more);
    }
    size_ = size;
  }
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] Number* begin() {
    return more_ ? more_.get() : std::launder(reinterpret_cast<Number*>(few_));
  }
  [[nodiscard]] const Number* begin() const {
    return more_ ? more_.get() : std::launder(reinterpret_cast<const Number*>(few_));
  }
  [[nodiscard]] Number* end() { return begin() + size_; }
  [[nodiscard]] const Number* end() const { return begin() + size_; }
  [[nodiscard]] Number& operator[](std::size_t i) { return begin()[i]; }
  [[nodiscard]] const Number& operator[](std::size_t i) const { return begin()[i]; }
  [[nodiscard]] const Number& back() const { return begin()[size_ - 1]; }

 private:
  std::size_t size_ = 0;
  std::unique_ptr<Number[]> more_;
  alignas(Number) std::byte few_[room * sizeof(Number)];  // not initialized
};

template <class Number>
using Coefficients =
    std::conditional_t<std::is_trivially_copyable_v<Number>, PlainCoefficients<Number>, std::vector<Number>>;

}  // namespace kds
