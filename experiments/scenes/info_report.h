#pragma once
// A scene's description as text: parts that `kds info` and `kds generate` share.

#include <string>

#include "experiments/output/result_json.h"
#include "experiments/scenes/scene_info.h"

namespace kds {

/// `input`, `necklaces`, `rows` (one a condition) and `proper`.
void add_scene(Json& json, const SceneInfo& info);

/// One line a condition, with a header.
[[nodiscard]] std::string conditions_csv(const SceneInfo& info);

/// The scene, its necklaces, then a table of the conditions.
[[nodiscard]] std::string scene_table(const SceneInfo& info);

}  // namespace kds
