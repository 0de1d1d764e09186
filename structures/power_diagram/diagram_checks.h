#pragma once
// Whether a kinetic power diagram is right. At a frame it is compared with the static build. Between events
// it is proved regular (regularity_proof.h) or, where the proof fails, compared with a static build from exact
// positions. Degenerate positions have several regular triangulations: where the static build differs, the
// definition decides by exact signs alone (regularity_fault.h).

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
