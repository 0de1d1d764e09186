#pragma once
// Checks of a kinetic power diagram. At a frame, the diagram is compared with the static build. Between
// events, it is proved regular (regularity_proof.h) or, if the proof fails, compared with a static build from
// exact positions. Degenerate positions have several regular triangulations: if the static build differs, the
// definition decides by exact signs alone (regularity_fault.h).

#include <optional>
#include <string>

#include "structures/power_diagram/diagram_state.h"

namespace kds {

/// Returns whether the diagram is wrong just after the present time, by exact signs. Always returns false
/// with the kernel `fast`, which cannot decide this.
template <int Dimension>
[[nodiscard]] bool is_wrong_just_after(DiagramState<Dimension>& state);

/// See KineticStructure::audit.
template <int Dimension>
[[nodiscard]] std::optional<std::string> audit_of(const DiagramState<Dimension>& state, const Dyadic& time);

}  // namespace kds
