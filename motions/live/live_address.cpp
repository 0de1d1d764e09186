#include "motions/live/live_address.h"

#include <fmt/format.h>

#include <optional>
#include <string_view>

#include "motions/base/input_error.h"
#include "motions/base/text_input.h"

namespace kds {

namespace {

constexpr std::string_view live_scheme = "imd://";

}  // namespace

bool is_live_address(const std::filesystem::path& path) {
  std::string start = path.string().substr(0, live_scheme.size());
  for (char& letter : start)
    if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
  return start == live_scheme;
}

LiveAddress parse_live_address(const std::filesystem::path& path) {
  const std::string text = path.string();
  const auto refuse = [&](std::string_view what) {
    return InputError(
        fmt::format("{}: {}; expected {}, such as imd://localhost:8888", text, what, live_example));
  };
  if (!is_live_address(path)) throw refuse("is not the address of a simulation");
  const std::string rest = text.substr(live_scheme.size());
  if (rest.find('@') != std::string::npos) throw refuse("has a user, which IMD does not know");
  const std::size_t colon = rest.rfind(':');
  if (colon == std::string::npos || rest.ends_with(']')) throw refuse("has no port");
  std::string host = rest.substr(0, colon);
  const bool in_brackets = host.starts_with('[') && host.ends_with(']');
  if (in_brackets) host = host.substr(1, host.size() - 2);
  if (host.empty()) throw refuse("has no host");
  if (!in_brackets && host.find(':') != std::string::npos)
    throw refuse("an IPv6 address needs brackets, as in imd://[::1]:8888");
  if (host.find_first_of("[]/@ ") != std::string::npos)
    throw refuse(fmt::format("{} is no host", in_quotes(host)));
  const std::string port = rest.substr(colon + 1);
  const std::optional<std::size_t> number = parse_count(port);
  if (!number || *number == 0 || *number > 65'535)
    throw refuse(fmt::format("{} is no port from 1 to 65535", in_quotes(port)));
  return {text, host, port};
}

}  // namespace kds
