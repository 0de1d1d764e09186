#pragma once
// A stream's buffer over an open file that remembers why writing failed, which std::ofstream does not tell.

#include <cstddef>
#include <streambuf>
#include <vector>

namespace kds {

class DescriptorBuffer final : public std::streambuf {
 public:
  /// The descriptor stays the caller's.
  explicit DescriptorBuffer(int descriptor);

  /// errno of the first write that failed; 0: none did. Later ones are not tried.
  [[nodiscard]] int error() const { return error_; }

 protected:
  int_type overflow(int_type c) override;
  int sync() override { return write_out() ? 0 : -1; }

 private:
  bool write_out();

  int descriptor_;
  int error_ = 0;
  std::vector<char> bytes_;
};

}  // namespace kds
