#pragma once
// The upper or the lower half of a kinetic convex hull: a chain of beads in their order (hull_guards.h), and
// every other bead under one of its edges. Three kinds of certificates:
//
//   each bead of the chain comes before the next                            (1)
//   the chain turns strictly, always to the same side, at each inner bead   (2)
//   a bead under an edge comes between its ends, and not beyond its line    (3)
//
// Why they imply the answer, of the upper half: by (1) and (2) the chain is the graph of a concave function,
// which has a corner at each inner bead, over the first axis, turned by an angle as small as one likes so
// that no two beads are level. By (3) no bead lies above the graph, or before or after it. So the chain is
// the upper hull, and its beads are the corners.
//
// When a certificate fails, a bead of the chain leaves it, or a bead goes to the next edge, or into the
// chain, and what is held around is held anew. Why this ends however many fail at one time: a step takes a
// pair of beads in the chain that are in the wrong order away, and none ever makes one, or the function grows
// between such pairs.
//
// Beads that stay together count as one, by the least of them: the others may lie under an edge at it, or,
// where the chain is one bead, under that.
//
// Beads come and go as they go into the chain and leave it. Those that change course stay where they are, in
// the chain or not, until what is held around them is held anew: in whatever order the chain is then, beads
// leave it until (1) and (2) hold, before others are looked at.

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "structures/hull/hull_guards.h"

namespace kds {

class HalfHull {
 public:
  HalfHull(HullGuards& guards, bool upper) : guards_(guards), upper_(upper) {}

  /// Of beads of which some may be marked as absent: a chain of some of the others, for start() to begin
  /// with.
  void assign(std::size_t beads, std::span<const char> absent, const std::vector<BeadId>& chain);
  /// When a step starts.
  void start();
  /// The certificate at this place of this table fails now.
  void fail(unsigned table, std::uint32_t place);
  // While time stands still within a step:
  void insert(BeadId bead);
  void erase(BeadId bead);
  /// All that is held of a bead that is present is given up, until hold_all().
  void give_up(BeadId bead);
  void hold_all();
  [[nodiscard]] static bool is_upper(std::uint32_t place) { return place / 2 % 2 == 1; }

  /// From the first to the last bead.
  [[nodiscard]] std::vector<BeadId> chain() const;
  /// Beads went into the chain or left it since this was last asked.
  [[nodiscard]] bool take_changed() { return std::exchange(changed_, false); }
  /// Adds to each bead how many certificates name it.
  void count_certificates(std::vector<std::uint32_t>& of_bead) const;

 private:
  static constexpr std::uint32_t not_under = 0xffffffffU;

  struct Bead {
    bool present = true;
    bool in_chain = false;
    BeadId left = no_bead;   // the bead before it in the chain; or the left end of the edge it is under
    BeadId right = no_bead;  // the bead after it in the chain
    OrderGuard after_left;   // in the chain: of it and the bead after it; else: of the left end and it
    OrderGuard before_right;
    CertificateHandle turn = CertificateHandle::violated;  // in the chain: at it; else: it is not beyond
    std::vector<BeadId> under;                             // of the edge that begins at it
    std::uint32_t place_under = not_under;
  };

  void hold(BeadId vertex);
  void place(BeadId bead);
  void put_under(BeadId bead, BeadId left);
  void put_in(BeadId bead, BeadId after);
  void take_out(BeadId vertex);
  void remove(BeadId vertex);
  void stand_in(BeadId bead, BeadId vertex);
  void open_edge(BeadId left, BeadId look_from);
  void loosen(BeadId vertex);
  void take_away(BeadId bead);
  void displace(BeadId bead);
  void release(BeadId bead);
  [[nodiscard]] std::uint32_t place_of(BeadId bead, bool right = false) const {
    return 4 * bead + (upper_ ? 2 : 0) + (right ? 1 : 0);
  }

  HullGuards& guards_;
  bool upper_;
  BeadId first_ = no_bead;
  std::vector<Bead> beads_;
  std::vector<BeadId> unheld_;     // in the chain, some of their certificates missing
  std::vector<BeadId> displaced_;  // neither in the chain nor under it
  bool changed_ = false;
};

}  // namespace kds
