#pragma once
// Whether a kinetic power diagram is right: compared with the static one, or, where that is not the only one,
// by the definition (regularity_fault.h).

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
