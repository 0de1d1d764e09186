#pragma once
// Builds messages of tests. (String concatenation with + triggers a false warning of g++ 12.)

#include <sstream>
#include <string>

namespace kds::test {

/// Prints the parts one after another.
template <class... Parts>
std::string text_of(const Parts&... parts) {
  std::ostringstream out;
  (out << ... << parts);
  return out.str();
}

}  // namespace kds::test
