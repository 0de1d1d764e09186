#pragma once
// A result cannot be written although nothing is wrong with what was asked for: the disk or the pipe is full.
// The program prints it and exits with code 1.

#include <stdexcept>
#include <string>

namespace kds {

class OutputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Throws `subject`: the system's reason. A place where nothing can be written is wrong input (InputError),
/// all else is an OutputError. `error` as in errno.
[[noreturn]] void fail_to_write(const std::string& subject, int error);

}  // namespace kds
