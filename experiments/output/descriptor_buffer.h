#pragma once
// A stream buffer over an open file descriptor. Unlike std::ofstream, it remembers why a write failed.

#include <cstddef>
#include <streambuf>
#include <vector>

namespace kds {

class DescriptorBuffer final : public std::streambuf {
 public:
  /// The caller keeps ownership of the descriptor.
  explicit DescriptorBuffer(int descriptor);

  /// Returns errno of the first write that failed, or 0 if none failed. After a failure no further writes are
  /// attempted.
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
