#pragma once
// Pages without data. The build makes these functions from experiments/pages/dist/*.html.

#include <span>
#include <string_view>

namespace kds {

/// Marks where the data stand in a page.
inline constexpr std::string_view page_data_mark = "<!--KDS-DATA-->";

/// Each returns a page in pieces, which must be joined.
[[nodiscard]] std::span<const std::string_view> replay_template();
[[nodiscard]] std::span<const std::string_view> report_template();

}  // namespace kds
