#pragma once
// Counts words in a text.

#include <string>

namespace kds::test {

inline std::size_t count_of(const std::string& text, const std::string& word) {
  std::size_t times = 0;
  for (std::size_t place = 0; (place = text.find(word, place)) != std::string::npos; place += word.size())
    ++times;
  return times;
}

}  // namespace kds::test
