#pragma once
// How data stand in a page: compressed, as text.

#include <string>
#include <string_view>

namespace kds {

/// Returns the bytes compressed in zlib format.
[[nodiscard]] std::string compressed(std::string_view bytes);
/// Returns the bytes in base64, with padding (RFC 4648).
[[nodiscard]] std::string base64(std::string_view bytes);

/// Returns a JSON text in which no tag begins, so that it can stand in a script element.
[[nodiscard]] std::string without_tags(const std::string& text);

}  // namespace kds
