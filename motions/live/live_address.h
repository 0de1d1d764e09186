#pragma once
// Addresses of running simulations, imd://HOST:PORT. They stand where other inputs have a path.

#include <filesystem>
#include <string>
#include <string_view>

namespace kds {

struct LiveAddress {
  std::string text;  ///< as it was given, for messages
  std::string host;  ///< a name or a number; an IPv6 number without its brackets
  std::string port;  ///< 1 to 65535
};

/// The form of an address, for messages.
inline constexpr std::string_view live_example = "imd://HOST:PORT";

/// Returns whether the path is an address rather than a file: it begins with "imd://". Looks at nothing else.
[[nodiscard]] bool is_live_address(const std::filesystem::path& path);

/// Parses imd://HOST:PORT. An IPv6 number has brackets: imd://[::1]:8888. Throws InputError that names the
/// address and the form expected.
[[nodiscard]] LiveAddress parse_live_address(const std::filesystem::path& path);

}  // namespace kds
