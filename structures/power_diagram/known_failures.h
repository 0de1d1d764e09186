#pragma once
// What searches of one moment have found, by certificate. A diagram that is rebuilt is built at several times
// until one is right, and most facets are the same each time: where their functions are zero but for what
// coordinates were rounded by, each search is one on integers.

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
  /// Null where it was never added.
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
