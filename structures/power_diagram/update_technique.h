#pragma once
// Names of the techniques in diagram_update.h.

#include <array>
#include <cstdint>
#include <string_view>

namespace kds {

enum class UpdateTechnique : std::uint8_t { rebuild, reinsert, greedy, kinetic, lifted, activate, automatic };
/// Names of the techniques, in the order of the enumerators.
inline constexpr std::array<std::string_view, 7> update_technique_names{
    "rebuild", "reinsert", "greedy", "kinetic", "lifted", "activate", "auto"};
[[nodiscard]] constexpr std::string_view name_of(UpdateTechnique technique) {
  return update_technique_names[static_cast<std::size_t>(technique)];
}

}  // namespace kds
