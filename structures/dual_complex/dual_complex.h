#pragma once
// Kinetic dual complex of a power diagram (the weighted alpha complex at alpha = 0): the beads are closed
// balls whose squared radii are the weights, and a simplex of the regular triangulation belongs to the
// complex iff the balls of its beads meet within their power cells. The complex has the homotopy type of the
// union of the balls: the same components, tunnels and voids (Edelsbrunner, "The union of balls and its dual
// shape", 1995).
//
// A simplex belongs to the complex iff
//
//   it is small        the size of the simplex (simplex_size.h) is not positive, and
//   it is unattached   no bead conflicts with its smallest orthogonal sphere (its power to the centre is less
//                      than the size), or else a simplex of one dimension more that contains it belongs
//
// Sizes grow from faces to simplices, so small simplices form a complex too, and only its boundary has
// certificates, on sizes: small simplices that are in no other small one, and large simplices whose facets
// are all small. Whether a simplex is attached needs no certificate: when that changes, the simplex has the
// size of the one that contains it, and the complex stays as it is. After a certificate has failed or cells
// were exchanged, signs just after that time decide about all simplices around.
//
// Works in space and in the plane, with any weights: a bead of negative weight has no ball, so no simplex
// with it belongs to the complex. The complex is exact: just after every time at which an event happens, the
// complex is the one of the diagram's cells. Simplices that belong to the complex at a single instant only,
// because balls touch there, have no event. If cells tie (degenerate positions), the complex is that of the
// cells that the diagram has.
//
// While all beads lie in one plane (on one line), there are no cells: at a first frame of this kind the
// complex is empty; a step of this kind throws InputError.

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "certificates/search/moment.h"
#include "certificates/types/simplex_size.h"
#include "kds/certificate_table.h"
#include "kds/structure_base.h"
#include "structures/dual_complex/complex_follower.h"
#include "structures/dual_complex/triangulation_faces.h"
#include "structures/power_diagram/power_diagram.h"
#include "structures/triangulation/cell_follower.h"
#include "structures/triangulation/complex_simplices.h"

namespace kds {

template <int Dimension>
class DualComplex final : public StructureBase, public BeadEdits, private CellFollower {
 public:
  /// Kinds of events: a simplex of k + 1 beads begins to belong to the complex (kind 2 k), or ends
  /// (2 k + 1). The ids are its beads, ascending. At one time, simplices end before their faces and begin
  /// after them, so that the complex is closed after each event.
  [[nodiscard]] static constexpr std::uint8_t begins(int dimension) {
    return static_cast<std::uint8_t>(2 * dimension);
  }

  /// `diagram` is a structure of the same run, added before this one, over the same motion. It must outlive
  /// the complex. Throws std::invalid_argument if the motion is lifted or its degree is above 7 (in the
  /// plane: 10).
  DualComplex(Simulator& simulator, const MotionRef<Dimension>& motion, PowerDiagram<Dimension>& diagram);

  /// From now on, tells `follower` what changes. `follower` must outlive the last change.
  void set_follower(ComplexFollower* follower) { follower_ = follower; }
  /// The triangulation of the diagram, and the names of its simplices.
  [[nodiscard]] const RegularTriangulation<Dimension>& triangulation() const {
    return diagram_.triangulation();
  }
  [[nodiscard]] const TriangulationFaces<Dimension>& faces() const { return faces_; }
  /// Returns whether a live simplex belongs to the complex.
  [[nodiscard]] bool has(SimplexName simplex) const { return of(simplex).belongs; }
  /// Returns whether `faces` and `has` describe the present complex. Returns false in a replay, and while the
  /// triangulation has no cells; the complex is then empty.
  [[nodiscard]] bool knows_faces() const { return diagram_.is_solid() && !replayed_ && !must_read_all_; }
  /// Returns the simplices of the complex of this dimension, each with its beads ascending, in lexicographic
  /// order. Takes time m log m for m simplices.
  [[nodiscard]] std::vector<SimplexBeads> simplices(int dimension) const;
  /// Returns the complex as lists of simplices with their faces, which union_measures.h measures. Empty while
  /// all beads lie in one plane. Takes linear time. Throws std::logic_error during a replay, which knows no
  /// faces.
  [[nodiscard]] ComplexSimplices simplices_with_faces() const requires(Dimension == 3);
  /// Returns all simplices, by dimension, each list followed by no_bead (RunningStructure::state).
  [[nodiscard]] std::vector<BeadId> state() const;

  void build() override;
  void start_step() override;
  void fail(unsigned table, std::uint32_t slot) override;
  /// Places are numbers of memory, and no two certificates have the same function.
  [[nodiscard]] std::uint64_t tie_of(unsigned, std::uint32_t) const override { return 0; }
  void after_batch() override { settle(Moment::just_after); }
  void finish_step() override { was_flat_ = !diagram_.is_solid(); }
  void apply(const Change& change) override;
  [[nodiscard]] std::optional<std::string> audit(const Dyadic& time) override;

  // Edits: the beads are those of the diagram, so the diagram is edited.
  void leave_out(BeadId bead) override { diagram_.leave_out(bead); }
  void insert(BeadId bead) override { diagram_.insert(bead); }
  void erase(BeadId bead) override { diagram_.erase(bead); }
  [[nodiscard]] bool is_absent(BeadId bead) const override { return diagram_.is_absent(bead); }

 private:
  /// Knowledge about a live simplex.
  struct Knowledge {
    CertificateHandle certificate = CertificateHandle::violated;  ///< `violated`: none
    bool is_small = false;
    bool belongs = false;
    bool is_new = false;       ///< the size is not known yet
    bool is_enqueued = false;  ///< a certificate is being searched
  };
  /// The kind of change since the complex was last up to date. A single event in general position needs few
  /// signs; everything else is settled with care, and so are all events with the kernel `exact`.
  enum class Happened : std::uint8_t { nothing, flip, failure, much };

  void release(std::span<const BeadId> beads) override;
  void take_up(std::span<const BeadId> beads) override;
  void exchanged(std::span<const CellId> gone, std::span<const CellId> made, bool is_flip) override;
  void replaced_all() override;
  void edited() override { settle(Moment::just_after); }

  [[nodiscard]] Knowledge& of(SimplexName s) {
    return known_[static_cast<std::size_t>(s.dimension)][s.number];
  }
  [[nodiscard]] const Knowledge& of(SimplexName s) const {
    return known_[static_cast<std::size_t>(s.dimension)][s.number];
  }
  /// Calls `visit` with each simplex of the dimension.
  template <class Visit>
  void for_all(int dimension, Visit visit) const;
  /// Calls `visit` with all faces of a simplex, and with the simplex itself.
  template <class Visit>
  void for_closure(SimplexName simplex, Visit visit) const;
  /// Calls `use` with the table of the dimension and the number of its certificates' beads as a constant.
  template <class Use>
  decltype(auto) with_table(int dimension, Use use);
  template <std::size_t N>
  [[nodiscard]] SimplexSize<N> size_of(SimplexName simplex, int sign) const;
  [[nodiscard]] int sign_of_size(SimplexName simplex, Moment moment);

  /// Returns the present time, or the start of the step while the complex is built.
  [[nodiscard]] const Instant& time() const { return has_certificates_ ? simulator().now() : start_; }
  void read_all_cells();
  void follow(const typename TriangulationFaces<Dimension>::Exchange& exchange);
  void note(Happened what);

  /// Brings sizes, certificates and the complex up to date after exchanges and failures. Records what begins
  /// and ends, unless the complex is being built (Moment::now).
  void settle(Moment moment);
  /// Settles a flip that is the only event at this time. Returns false, and changes nothing, if it is not in
  /// general position.
  [[nodiscard]] bool settle_flip();
  /// Finds which new simplices are small.
  void find_sizes_of_new(Moment moment);

  /// Returns whether the size is not positive, for a simplex whose facets are not new.
  [[nodiscard]] bool is_small_now(SimplexName simplex, Moment moment);
  [[nodiscard]] bool has_small_facets(SimplexName simplex) const;
  [[nodiscard]] bool needs_certificate(SimplexName simplex) const;
  void watch_again(SimplexName simplex);
  void enqueue(SimplexName simplex);
  void watch_enqueued();
  void keep(SimplexName simplex, CertificateHandle handle);
  void drop(SimplexName simplex);
  /// Drops the certificate of a removed simplex. If the size may be zero now, notes that the flip is not in
  /// general position.
  void drop_gone(SimplexName simplex);
  /// Changes a simplex from small to large or back; what depends on it is checked later.
  void toggle(SimplexName simplex);
  /// Gives certificates to the simplices in question that need one, and drops those of the others.
  void check_certificates();

  /// Decides whether the changed simplices belong and, if `all_around`, all simplices around them; otherwise
  /// only their faces that are affected.
  void decide_membership(Moment moment, bool all_around);
  void add_all_around(std::vector<SimplexName>& simplices) const;
  void set_membership(SimplexName simplex, bool belongs);
  [[nodiscard]] bool must_belong(SimplexName simplex, Moment moment);
  [[nodiscard]] bool is_attached(SimplexName simplex, Moment moment);
  /// Calls `use` with the query on which side of the simplex the bead's simplex is centred, and its search.
  template <class Use>
  auto with_side(SimplexName simplex, BeadId beyond, Use use) const;
  void record_changes();

  MotionRef<Dimension> motion_;
  PowerDiagram<Dimension>& diagram_;
  ComplexFollower* follower_ = nullptr;
  TriangulationFaces<Dimension> faces_;
  std::array<std::vector<Knowledge>, static_cast<std::size_t>(Dimension) + 1> known_;  // by dimension
  CertificateTable<SimplexSize<1>> vertex_sizes_;
  CertificateTable<SimplexSize<2>> edge_sizes_;
  CertificateTable<SimplexSize<3>> triangle_sizes_;
  std::unique_ptr<CertificateTable<SimplexSize<4>>> tetrahedron_sizes_;  // in space
  std::tuple<std::unique_ptr<CertificateSearch<CentreSide<2>>>,
             std::unique_ptr<CertificateSearch<CentreSide<3>>>,
             std::unique_ptr<CertificateSearch<CentreSide<4>>>>
      sides_;
  Instant start_{0.0};
  bool must_read_all_ = true;      // all cells were replaced
  bool has_certificates_ = false;  // false from a build to the next step
  bool was_flat_ = false;          // whether some cell is flat at the frame just reached
  // The members below collect changes between an exchange or a failure and the next settle(). Simplices may
  // be listed repeatedly, or be gone.
  Happened happened_ = Happened::nothing;
  bool all_changed_ = false;                       // whether all simplices are in question
  bool any_gone_ = false, gone_is_small_ = false;  // of the finite cells that a single flip removed
  bool small_face_is_gone_ = false;                // whether this flip removed a small face
  std::vector<SimplexName> new_, changed_, unchecked_;
  std::vector<SimplexName> around_;  // simplices that bound the exchanged cells
  using Simplex = DimensionAndBeads;
  std::vector<Simplex> lost_;  // simplices of the complex whose cells are gone
  std::vector<Simplex> ends_, begins_;
  std::vector<SimplexName> decided_;  // live simplices that began or ended to belong
  // Simplices whose membership is in question, by dimension; empty outside decide_membership().
  std::array<std::vector<SimplexName>, static_cast<std::size_t>(Dimension) + 1> in_question_;
  // The complex of a replay, which has no certificates; empty until the first change is repeated.
  std::optional<std::set<Simplex>> replayed_;
};

extern template class DualComplex<2>;
extern template class DualComplex<3>;

}  // namespace kds
