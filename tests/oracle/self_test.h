#pragma once
// Tests the oracle itself: it must accept correct dumps and reject corrupted ones.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "scene.h"

namespace oracle {

/// Tests generated scenes, and `given` if present. Returns 0 if every dump was judged correctly, else 1.
[[nodiscard]] int self_test(const std::optional<Scene>& given);

/// Random numbers that are equal on every machine, which the distributions of the standard library do not
/// guarantee.
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
  bool generic = true;  ///< frame 0 is in general position
};

/// Writes files of every format into `dir` and reads them back. Appends each error of a reader to `failures`.
[[nodiscard]] std::vector<NamedScene> made_scenes(const std::filesystem::path& dir,
                                                  std::vector<std::string>& failures);

}  // namespace oracle
