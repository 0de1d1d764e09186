#pragma once
// An error in the user's input. The message of the error is one line that names the file, frame, bead or
// option and says what was expected. The program prints it and exits with code 2.

#include <stdexcept>

namespace kds {

class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace kds
