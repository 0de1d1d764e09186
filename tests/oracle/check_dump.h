#pragma once
// A whole dump directory against the scene it claims to show.

#include <cstddef>
#include <filesystem>

#include "report.h"
#include "scene.h"

namespace oracle {

/// Every `every`-th node is compared with CGAL's exact sphere besides its proof (0: none).
[[nodiscard]] Report check_dump(const Scene& scene, const std::filesystem::path& dir, std::size_t every);

/// A dump that is right, from static structures only.
void write_static_dump(const Scene& scene, const std::filesystem::path& dir);

}  // namespace oracle
