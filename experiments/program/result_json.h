#pragma once
// What the JSON of all commands shares.

#include <nlohmann/json.hpp>
#include <string>

namespace kds {

using Json = nlohmann::ordered_json;

/// `version` and `machine`.
void add_provenance(Json& json);

/// Indented, ends with a newline. File names need not be UTF-8, JSON must be: wrong bytes are replaced.
[[nodiscard]] std::string text_of(const Json& json);

}  // namespace kds
