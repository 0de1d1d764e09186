#pragma once
// Messages of tests. (Sums of strings trip a false warning of g++ 12.)

#include <sstream>
#include <string>

namespace kds::test {

/// The parts one after another, as they print.
template <class... Parts>
std::string text_of(const Parts&... parts) {
  std::ostringstream out;
  (out << ... << parts);
  return out.str();
}

}  // namespace kds::test
