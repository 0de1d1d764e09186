#pragma once
// Text describing a scene. `kds info` and `kds generate` share it.

#include <string>

#include "experiments/output/result_json.h"
#include "experiments/scenes/scene_info.h"

namespace kds {

/// Adds `input`, `necklaces`, `rows` (one per condition) and `proper`.
void add_scene(Json& json, const SceneInfo& info);

/// Returns a header and one line per condition.
[[nodiscard]] std::string conditions_csv(const SceneInfo& info);

/// Returns the scene, its necklaces, and a table of the conditions.
[[nodiscard]] std::string scene_table(const SceneInfo& info);

}  // namespace kds
