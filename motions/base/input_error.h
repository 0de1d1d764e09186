#pragma once
// An error in the user's input, and the names of arguments in messages and help. The message of an error is
// one line that names the file, frame, bead or argument and says what was expected. The program prints it and
// exits with code 2.

#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>

namespace kds {

/// How users of this process give arguments.
enum class Interface {
  program,  ///< options of the command line, such as --until-damage
  python    ///< arguments of functions, such as until_damage
};
/// Sets the interface of this process. By default it is `program`. The Python module calls this when it is
/// loaded.
void set_interface(Interface interface);

/// Returns the text for the interface of this process.
[[nodiscard]] std::string_view words(std::string_view of_program, std::string_view of_python);
/// Returns an option, which has its dashes, as users write it. Returns other words as they are.
[[nodiscard]] std::string argument(std::string_view option);
[[nodiscard]] inline std::string operator""_arg(const char* option, std::size_t size) {
  return argument({option, size});
}
/// Returns the arguments that choose frames of an input.
[[nodiscard]] inline std::string_view frames_argument() { return words("--frames", "start, stop, step"); }

class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
  /// An error in an argument: the message begins with the argument's name. `option` has its dashes.
  InputError(std::string_view option, const std::string& message)
      : std::runtime_error(argument(option) + ": " + message) {}
};

}  // namespace kds
