#pragma once
// Kinetic spanner of the beads: a graph whose shortest paths are at most `stretch` times as long as straight
// lines, while the beads move. Built on a hierarchy of discrete centres. After Gao, Guibas, Nguyen,
// Deformable spanners and applications (2004).
//
// Level i has a scale u 2^i. All beads are centres of level 0. Centres of level i > 0 are centres of level
// i - 1 that are at least the scale apart. Each centre of level i - 1 has a parent among them within the
// scale; a centre of level i is its own parent. The root is a centre of all levels. Two centres of a level
// are joined while they are nearer than c u 2^i, with c = 4 + 16 / (stretch - 1), and not while they are
// farther; at equality either. The spanner's edges are the pairs that are joined at some level.
//
// Proof of the stretch: let p and q be beads, and let i be the lowest level at which their ancestors are
// equal or joined. A bead's ancestor at level i is within 2 u 2^i of it, on a path of edges, because c > 2.
// So the path over the ancestors is at most 8 u 2^i longer than |pq|. If i = 0, p and q are an edge.
// Otherwise the ancestors at level i - 1 are not joined, so they are at least c u 2^(i-1) apart, and |pq| >=
// (c - 4) u 2^(i-1). So the path is at most 1 + 16 / (c - 4) = stretch times as long as |pq|.
//
// Four conditions on distances certify the spanner (in the source: parent-child, separation, edge and
// potential-edge certificates): a parent covers its child, centres of a level stay apart, joined centres stay
// near, and cousins (centres that are not joined, but whose parents are equal or joined) stay far. Centres
// whose parents are not joined are far by the triangle inequality, because c > 4. A pair is joined at all
// levels from its lowest one on at which both are centres, so a pair has at most three certificates, and a
// child and its parent a fourth.
//
// If a parent loses a child, the child takes another parent; if none covers it, it becomes a centre of the
// next level. If two centres get too near, one of them leaves the level, and its children there take other
// parents. A centre that covers a bead is within three scales of a parent that the bead has lost, so the two
// are joined, and the search along edges finds it. Each repair makes its conditions hold just after the
// present time and breaks no other, so repairs end. The hierarchy depends on earlier events, so equal
// positions may have different spanners. Each one meets the definition.
//
// u is 2^-30 of the extent at the first frame, rounded down to a power of two, but at least 2^-1000, and 1 if
// all beads are together then. The scale does not follow the extent later. All beads within c u are joined,
// so the cost is quadratic in the number of beads that are together.
//
// A centre is joined with up to (2c + 1)^3 centres of its level in space, 15,625 at a stretch of 3, where c
// is
// 12. So spanners of fewer than some thousand beads have a large share of all pairs as edges. Memory grows
// with the tracked pairs, and each step searches all certificates anew.
//
// All results are exact. Radii do not enter.

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "certificates/types/distances.h"
#include "kds/certificate_table.h"
#include "kds/structure_base.h"
#include "motions/curves/motion_ref.h"
#include "structures/necklace/bead_pairs.h"

namespace kds {

template <int Dimension>
class Spanner final : public EditableBase {
 public:
  /// Kinds of events and their ids:
  ///
  ///   join, part   the beads of an edge, ascending
  ///   rise, fall   the bead, its parent, and the highest level of which it is now a centre; the root has
  ///                no_bead and root_level
  ///   adopt        the same, of a bead that has another parent on the same level
  ///   rescale      the beads of an edge, and the lowest level at which they are now joined
  ///   inserts      the ids of `rise`
  enum Kind : std::uint8_t { join, part, rise, fall, adopt, rescale, inserts, erases, changes };

  static constexpr BeadId root_level = 1U << 20U;

  struct Centre {
    BeadId bead, parent, level;  ///< the highest level; no_bead and root_level for the root
    friend auto operator<=>(const Centre&, const Centre&) = default;
  };

  /// Throws std::invalid_argument unless stretch > 1.
  Spanner(Simulator& simulator, const MotionRef<Dimension>& motion, double stretch);

  /// Returns the edges, ascending.
  [[nodiscard]] std::vector<BeadPair> edges() const;
  /// Returns the beads that are present, ascending.
  [[nodiscard]] std::vector<Centre> centres() const;
  /// Returns the scale u of level 0.
  [[nodiscard]] double unit() const { return unit_; }
  /// Returns c, rounded up.
  [[nodiscard]] double reach() const { return reach_; }

  void build() override;
  void start_step() override;
  void fail(unsigned table, std::uint32_t slot) override;
  void apply(const Change& change) override;
  [[nodiscard]] std::optional<std::string> audit(const Dyadic& time) override;

 private:
  using Table = CertificateTable<DistanceBeyond>;
  using Key = std::uint64_t;
  static constexpr CertificateHandle none = CertificateHandle::violated;
  static constexpr int levels_below_extent = 30;

  /// The lengths of level i with which distances are compared: c u 2^i and u 2^i.
  enum class Length : std::uint8_t { reach, scale };
  struct Guard {
    CertificateHandle handle = none;
    Length length{};
    int level = 0;
  };
  /// A pair of beads whose ancestors at the next level above `common` are equal or joined.
  struct Pair {
    std::array<BeadId, 2> beads{};  // ascending
    int common = 0;                 // the highest level of which both are centres
    int lowest = 0;                 // level at which they are joined; common + 1 if they are not joined
    Guard near{}, far{};            // joined at `lowest`, not joined at the level below
    Guard apart{};                  // at least the scale of `common` apart

    [[nodiscard]] bool is_joined() const { return lowest <= common; }
    [[nodiscard]] bool is_joined_at(int level) const { return lowest <= level && level <= common; }
    [[nodiscard]] BeadId other(BeadId bead) const { return beads[0] == bead ? beads[1] : beads[0]; }
  };
  struct Node {
    BeadId parent = no_bead;
    int top = 0;                   // the highest level of which the bead is a centre
    Guard cover{};                 // within the parent's scale
    std::vector<BeadId> children;  // other beads, at all levels
    std::vector<Pair*> pairs;
  };
  /// A certificate that is searched together with others at the start of a step.
  struct Gathered {
    Guard* guard;
    Guard made;
    std::array<BeadId, 2> beads;
  };
  /// A pair before the event that is being handled.
  struct Before {
    bool was_joined;
    int lowest;
  };

  /// A certificate that has failed at the present time.
  struct Failed {
    Length length{};
    int level = 0;
    Key beads = 0;
    int sign = 0;
    friend bool operator==(const Failed&, const Failed&) = default;
  };

  [[nodiscard]] static Key key_of(BeadId a, BeadId b) {
    return a < b ? (Key{a} << 32U) | b : (Key{b} << 32U) | a;
  }

  [[nodiscard]] Table& table(Length length, int level);
  void set_constants(std::size_t table);
  /// Returns the sign of |ab| less the length: just after the present time, or at the first frame while the
  /// structure is being built.
  [[nodiscard]] int sign(Length length, int level, BeadId a, BeadId b);
  /// Makes the certificate unless it exists: that the beads are at least (`wanted` 1) or at most (-1) the
  /// length apart. Returns false if that does not hold. Makes no certificates while the structure is being
  /// built. At the start of a step, leaves the certificate to a search of all together and returns true.
  [[nodiscard]] bool hold(Guard& guard, Length length, int level, std::array<BeadId, 2> beads, int wanted);
  void keep(Guard& guard, const Guard& made, const std::array<BeadId, 2>& beads);
  void drop(Guard& guard, const std::array<BeadId, 2>& beads);
  /// Forgets a certificate that has failed, which its table has removed.
  void forget(Guard& guard, const std::array<BeadId, 2>& beads);

  /// Returns null if the pair is not tracked.
  [[nodiscard]] Pair* find(BeadId a, BeadId b);
  [[nodiscard]] BeadId ancestor(BeadId bead, int level) const;
  /// Returns the centre and all that are joined with it at the level, ascending.
  [[nodiscard]] std::vector<BeadId> joined_with(BeadId centre, int level) const;
  /// Returns the centres of the level below whose parent is the centre; the first is the centre itself.
  [[nodiscard]] std::vector<BeadId> children(BeadId centre, int level) const;
  /// Returns whether two beads are to be tracked: their ancestors above their common level are equal or
  /// joined.
  [[nodiscard]] bool are_cousins(BeadId a, BeadId b);

  void remember(const Pair& pair);
  void record_edges();
  void record_centre(Kind kind, BeadId bead);
  void track(BeadId a, BeadId b);
  void untrack(Pair& pair);
  /// Finds the lowest level at which the pair is joined, from the present one on, and makes its certificates.
  void certify(Pair& pair);
  void certify_apart(Pair& pair);
  void lower(Pair& pair);
  void lift(Pair& pair);
  /// Tracks the children of two centres that are now joined at a level.
  void join_at(const Pair& pair, int level);
  void set_common(Pair& pair, int common);
  void settle(BeadId bead);

  void unlink(BeadId bead);
  void link(BeadId bead, BeadId parent, int top);
  void cover(BeadId bead);
  void find_parent(BeadId bead, BeadId near);
  void leave_level(BeadId centre, BeadId parent);
  void replace_root();
  void put(BeadId bead);
  void take_out(BeadId bead);
  void resolve();
  /// Throws std::logic_error if an exception has ended an earlier edit.
  void begin_edit();

  void edit(std::uint8_t kind, BeadId bead) override;
  void release(std::span<const BeadId> beads) override;
  void follow(std::span<const BeadId> beads) override;

  MotionRef<Dimension> motion_;
  double reach_, unit_ = 1;
  std::vector<std::unique_ptr<Table>> tables_;  // by level, reach before scale; null until used
  std::vector<Node> nodes_;
  BeadId root_ = no_bead;
  std::unordered_map<Key, Pair> pairs_;
  std::map<Key, Before> before_;  // of pairs that the present event may have changed
  std::vector<std::array<BeadId, 2>>
      broken_;                    // beads of certificates that do not hold and are not yet repaired
  std::optional<Failed> failed_;  // the event that is being handled
  BeadId leaving_ = no_bead;      // a centre whose children take other parents
  bool editing_ = false;          // stays true if an exception ended an edit
  bool gathering_ = false;
  std::vector<Gathered> gathered_;
  bool building_ = false;
  bool knows_pairs_ = false;          // not after changes from a log, which names edges only
  std::vector<std::uint32_t> named_;  // the number of certificates on each bead
};

static_assert(EditableStructure<Spanner<2>>);

}  // namespace kds
