#pragma once
// Whether a kinetic power diagram is right. At a frame it is compared with the static build. Between events
// it is proved to be the only regular triangulation of its beads (strict_regularity.h), or, where doubles do
// not prove that, compared with a static build from exact positions. Where there are several, the definition
// decides (regularity_fault.h).

#include <optional>
#include <string>

#include "structures/power_diagram/diagram_state.h"

namespace kds {

/// Just after the present time, by exact signs. With `fast` no one knows, and nothing is said.
template <int Dimension>
[[nodiscard]] bool is_wrong_just_after(DiagramState<Dimension>& state);

/// See KineticStructure::audit.
template <int Dimension>
[[nodiscard]] std::optional<std::string> audit_of(const DiagramState<Dimension>& state, const Dyadic& time);

}  // namespace kds
