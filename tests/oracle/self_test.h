#pragma once
// A test that cannot fail is worthless: right dumps must pass, spoiled ones must not.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "scene.h"

namespace oracle {

/// Made scenes, and `given` if there is one. 0 where every dump was judged as it should be, else 1.
[[nodiscard]] int self_test(const std::optional<Scene>& given);

/// The same numbers on every machine, which the distributions of the library do not promise.
class Dice {
 public:
  explicit Dice(std::uint32_t seed) : engine_(seed) {}
  std::size_t below(std::size_t n) { return engine_() % n; }
  double unit() { return engine_() / 4294967296.0; }  ///< in [0, 1), exact

 private:
  std::mt19937 engine_;
};

struct NamedScene {
  std::string name;
  Scene scene;
  bool generic = true;  ///< general position at frame 0
};

/// Writes files of every format into `dir` and reads them again. What a reader gets wrong goes to `failures`.
[[nodiscard]] std::vector<NamedScene> made_scenes(const std::filesystem::path& dir,
                                                  std::vector<std::string>& failures);

}  // namespace oracle
