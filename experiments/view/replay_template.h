#pragma once
// The replay page without data. The build makes it from experiments/view/page/dist/replay_page.html.

#include <span>
#include <string_view>

namespace kds {

/// Marks where the data stand in the page.
inline constexpr std::string_view replay_data_mark = "<!--KDS-DATA-->";

/// Returns the page in pieces, which must be joined.
[[nodiscard]] std::span<const std::string_view> replay_template();

}  // namespace kds
