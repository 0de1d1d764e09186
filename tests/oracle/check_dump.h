#pragma once
// Compares a whole dump directory with the scene that it shows.

#include <cstddef>
#include <filesystem>

#include "report.h"
#include "scene.h"

namespace oracle {

/// Every node is proved; every `every`-th node is also compared with CGAL's exact sphere (0: none).
[[nodiscard]] Report check_dump(const Scene& scene, const std::filesystem::path& dir, std::size_t every);

/// Writes a correct dump, from static structures only.
void write_static_dump(const Scene& scene, const std::filesystem::path& dir);

}  // namespace oracle
