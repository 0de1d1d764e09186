#pragma once
// A result cannot be written although the request was valid, for instance because the disk or the pipe is
// full. The program prints the message and exits with code 1.

#include <stdexcept>
#include <string>

namespace kds {

class OutputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Throws an error with the message "`subject`: reason", where the reason is the system's text for `error` (a
/// value of errno). A place that cannot be written to is an InputError. Every other reason is an OutputError.
[[noreturn]] void fail_to_write(const std::string& subject, int error);

}  // namespace kds
