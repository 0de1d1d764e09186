#pragma once
// A hash of the order of events and their combinatorial changes, never of doubles. Equal histories have equal
// fingerprints on every kernel, run and machine. Computed by FNV-1a over 32-bit words with the final mix of
// splitmix64.

#include <cstdint>

#include "kds/change.h"

namespace kds {

class Fingerprint {
 public:
  void add(std::uint32_t word) { hash_ = (hash_ ^ word) * 0x100000001b3ULL; }
  void add(std::uint32_t step, std::uint32_t structure, const Change& change) {
    add(step);
    add(structure);
    add(change.kind);
    for (std::uint8_t i = 0; i < change.size; ++i) add(change.ids[i]);
  }
  [[nodiscard]] std::uint64_t value() const {
    std::uint64_t x = hash_ + 0x9e3779b97f4a7c15ULL;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
    return x ^ (x >> 31);
  }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325ULL;
};

}  // namespace kds
