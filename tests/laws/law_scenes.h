#pragma once
// The scenes on which all structures must obey the laws, one row for each family of scenes.

#include <cstdint>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "motions/scene/scene.h"

namespace kds::test {

struct LawScene {
  std::string name;
  std::uint64_t seeds = 1;                   ///< scenes of the family that are run by default
  std::function<Scene(std::uint64_t)> make;  ///< makes the scene of a seed
  std::vector<std::string> structures = {};  ///< the structures that run, by name; empty: all that fit
  bool refused = false;                      ///< whether every scene must be refused
  bool judged = true;  ///< whether brute force judges, which takes minutes for numbers of thousands of digits
};
/// Prints the name, for GoogleTest.
inline void PrintTo(const LawScene& scene, std::ostream* out) { *out << scene.name; }

[[nodiscard]] const std::vector<LawScene>& law_scenes();

}  // namespace kds::test
