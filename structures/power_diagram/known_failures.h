#pragma once
// Search results at one moment, stored by certificate. A rebuild builds the diagram at several times until
// one is correct, and most facets are the same each time. If their functions would be zero but for the
// rounding of coordinates, each search needs exact integers, so reusing its result pays.

#include <cstddef>
#include <cstdint>
#include <unordered_map>

#include "certificates/base/certificate.h"
#include "certificates/base/failure_time.h"

namespace kds {

class KnownFailures {
 public:
  template <NamedCertificate Certificate>
  void add(const Certificate& certificate, const Failure& failure) {
    failures_.insert_or_assign(Key{certificate.identity(), certificate.side()}, failure);
  }
  /// Returns null if the result was never added.
  template <NamedCertificate Certificate>
  [[nodiscard]] const Failure* of(const Certificate& certificate) const {
    const auto found = failures_.find(Key{certificate.identity(), certificate.side()});
    return found == failures_.end() ? nullptr : &found->second;
  }

 private:
  struct Key {
    Identity identity;
    bool side;
    friend bool operator==(const Key&, const Key&) = default;
  };
  struct Hash {
    std::size_t operator()(const Key& key) const {
      constexpr std::uint64_t odd = 0x9e3779b97f4a7c15U;
      std::uint64_t hash = key.identity.type * 2 + (key.side ? 1 : 0);
      for (const BeadId bead : key.identity.beads) hash = (hash ^ hash >> 29U ^ bead) * odd;
      return static_cast<std::size_t>(hash ^ hash >> 32U);
    }
  };

  std::unordered_map<Key, Failure, Hash> failures_;
};

}  // namespace kds
