#include "motions/base/one_line.h"

namespace kds {

std::string one_line_message(std::string_view message) {
  std::string line;
  for (const char c : message.substr(0, 300)) {
    const bool blank = c == ' ' || (c >= '\0' && c < ' ');
    if (!blank)
      line += c;
    else if (!line.empty() && line.back() != ' ')
      line += ' ';
  }
  while (line.ends_with(' ')) line.pop_back();
  return line;
}

}  // namespace kds
