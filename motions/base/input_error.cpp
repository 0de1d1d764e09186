#include "motions/base/input_error.h"

#include <algorithm>

namespace kds {

namespace {

Interface of_process = Interface::program;

}  // namespace

void set_interface(Interface interface) { of_process = interface; }

std::string_view words(std::string_view of_program, std::string_view of_python) {
  return of_process == Interface::program ? of_program : of_python;
}

std::string argument(std::string_view option) {
  std::string name(option);
  if (of_process == Interface::program || !option.starts_with("--")) return name;
  name.erase(0, 2);
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

}  // namespace kds
