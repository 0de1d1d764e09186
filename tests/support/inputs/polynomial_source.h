#pragma once
// A failure source whose functions are handwritten polynomials. The source gives the engine everything that
// certificates give it.

#include <algorithm>
#include <cstdint>
#include <vector>

#include "certificates/exact/exact_polynomial.h"
#include "certificates/search/exact_search.h"
#include "kds/simulator.h"
#include "tests/support/inputs/polynomials.h"

namespace kds::test {

/// p - q u: becomes negative at p/q.
inline Scaled falling(std::int64_t p, std::int64_t q) { return {Integer(p), Integer(p - q)}; }

/// 1 - k u^2: becomes negative at sqrt(1/k).
inline Scaled falling_at_root_of_one_over(std::int64_t k) { return {1, 2, Integer(1 - k)}; }

inline Identity named(BeadId bead, std::uint32_t type = 0) {
  return identity_of({type, {}}, std::array{bead});
}

/// Holds entries by slot. A failure has no effect.
class PolynomialSource : public FailureSource {
 public:
  struct Entry {
    Scaled function;
    Identity identity;
    std::uint64_t place = 0;
  };

  explicit PolynomialSource(std::size_t structure = 0) : structure_(structure) {}

  std::uint32_t add(Scaled function, const Identity& identity, std::uint64_t place = 0) {
    entries_.push_back({std::move(function), identity, place});
    return static_cast<std::uint32_t>(entries_.size() - 1);
  }

  /// Returns the first failure of an entry after the start of the step, as the exact stage finds it.
  [[nodiscard]] FailureTime first_time(std::uint32_t slot) const {
    StageCounts stages;
    return exact_first_failure(*exact_function(slot), Instant(0), stages).time;
  }

  [[nodiscard]] ExactFunction exact_function(std::uint32_t slot) const override {
    return std::make_shared<const ExactPolynomial>(entries_[slot].function);
  }
  [[nodiscard]] Identity identity(std::uint32_t slot) const override { return entries_[slot].identity; }
  [[nodiscard]] TiePlace place(std::uint32_t slot) const override { return {0, entries_[slot].place}; }
  [[nodiscard]] std::size_t structure() const override { return structure_; }
  void fail(std::uint32_t) override {}
  void retire(std::uint32_t) override {}
  void clear() override { entries_.clear(); }

 private:
  std::size_t structure_;
  std::vector<Entry> entries_;
};

}  // namespace kds::test
