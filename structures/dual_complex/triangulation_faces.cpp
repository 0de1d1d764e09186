#include "structures/dual_complex/triangulation_faces.h"

#include <algorithm>
#include <bit>
#include <numeric>

namespace kds {

template <int Dimension>
unsigned TriangulationFaces<Dimension>::mask_in(CellId cell, SimplexName simplex) const {
  if (simplex.dimension == Dimension) return (1U << (Dimension + 1U)) - 1;
  const auto& vertex = triangulation_.cells()[cell].vertex;
  if (simplex.dimension == 0)
    return 1U << static_cast<unsigned>(std::find(vertex.begin(), vertex.end(), simplex.number) -
                                       vertex.begin());
  for (std::size_t slot = 0; slot < faces_of_cell; ++slot)
    if (dimension_of(slot) == simplex.dimension && of_cell_[cell][slot] == simplex.number) return masks[slot];
  return 0;
}

template <int Dimension>
void TriangulationFaces<Dimension>::make_room() {
  const std::size_t beads = triangulation_.cells_at().size(), cells = triangulation_.cells().size();
  for (auto bead = static_cast<BeadId>(simplices_[0].size()); bead < beads; ++bead)
    simplices_[0].push_back({{bead, no_bead, no_bead, no_bead}, no_cell, 0});
  if (of_cell_.size() >= cells) return;
  std::array<std::uint32_t, faces_of_cell> none;
  none.fill(no_face);
  of_cell_.resize(cells, none);
  vertices_of_.resize(cells);
  seen_.resize(cells, 0);
  simplices_[Dimension].resize(cells);
}

template <int Dimension>
SimplexBeads TriangulationFaces<Dimension>::beads_at(const CellVertices& vertices, unsigned mask) {
  SimplexBeads beads{no_bead, no_bead, no_bead, no_bead};
  std::size_t count = 0;
  for (unsigned i = 0; i <= Dimension; ++i) {
    if ((mask >> i & 1U) == 0) continue;
    std::size_t at = count++;
    for (; at > 0 && beads[at - 1] > vertices[i]; --at) beads[at] = beads[at - 1];
    beads[at] = vertices[i];
  }
  return beads;
}

template <int Dimension>
std::size_t TriangulationFaces<Dimension>::hashed(const SimplexBeads& beads) const {
  constexpr std::uint64_t odd = 0x9e3779b97f4a7c15U;
  const std::uint64_t hash = ((std::uint64_t{beads[0]} << 32U | beads[1]) * odd ^ beads[2]) * odd;
  std::size_t index = static_cast<std::size_t>(hash >> 32U) & (table_size_ - 1);
  while (table_[index] != 0 && entries_[table_[index] - 1].beads != beads)
    index = (index + 1) & (table_size_ - 1);
  return index;
}

template <int Dimension>
template <class Visit>
void TriangulationFaces<Dimension>::for_entries(const CellVertices& vertices, Visit visit) {
  const bool are_few = beads_.size() <= few;
  std::array<unsigned, static_cast<std::size_t>(Dimension) + 1> place{};  // as a bit
  unsigned infinite = 0;                                                  // the bit of the infinite vertex
  for (unsigned i = 0; i <= Dimension; ++i) {
    if (vertices[i] == infinite_bead) {
      infinite = 1U << i;
    } else if (are_few) {
      unsigned at = 0;
      while (beads_[at] != vertices[i]) ++at;
      place[i] = 1U << at;
    }
  }
  for (std::size_t slot = 0; slot < faces_of_cell; ++slot) {
    if ((masks[slot] & infinite) != 0) continue;
    std::size_t index = 0;
    SimplexBeads beads{};  // not needed for few
    if (are_few) {
      for (const unsigned i : vertices_of_slot[slot]) index |= place[i];
    } else {
      beads = beads_at(vertices, masks[slot]);
      index = hashed(beads);
    }
    if (table_[index] == 0) {
      entries_.push_back({{dimension_of(slot), no_face}, beads, false, false});
      table_[index] = static_cast<std::uint32_t>(entries_.size());
    }
    visit(slot, entries_[table_[index] - 1]);
  }
}

template <int Dimension>
void TriangulationFaces<Dimension>::remove(CellId cell) {
  const SimplexName name{Dimension, cell};
  if (vertices_of_[cell] == CellVertices{}) return;  // never read
  for_entries(vertices_of_[cell], [&](std::size_t slot, Entry& face) {
    face.name = {dimension_of(slot), of_cell_[cell][slot]};
    face.is_old = true;
  });
  of_cell_[cell].fill(no_face);
  vertices_of_[cell] = {};
  if (!is_live(name)) return;
  exchange_.removed.emplace_back(name, at(name).beads);
  at(name).cell = no_cell;
}

template <int Dimension>
void TriangulationFaces<Dimension>::add(CellId cell) {
  const CellVertices& vertices = triangulation_.cells()[cell].vertex;
  vertices_of_[cell] = vertices;
  for_entries(vertices, [&](std::size_t slot, Entry& face) {
    if (face.name.number == no_face) {
      face.name = new_face(face.name.dimension, beads_at(vertices, masks[slot]));
      exchange_.added.push_back(face.name);
    }
    face.stays = true;
    at(face.name).cell = cell;
    at(face.name).mask = static_cast<std::uint8_t>(masks[slot]);
    of_cell_[cell][slot] = face.name.number;
  });
  if (std::find(vertices.begin(), vertices.end(), infinite_bead) != vertices.end()) return;
  const SimplexName name{Dimension, cell};
  constexpr unsigned all = (1U << (Dimension + 1U)) - 1;
  at(name) = {beads_at(vertices, all), cell, all};
  exchange_.added.push_back(name);
}

template <int Dimension>
SimplexName TriangulationFaces<Dimension>::new_face(int dimension, const SimplexBeads& beads) {
  auto& faces = simplices_[static_cast<std::size_t>(dimension)];
  auto& free = free_[static_cast<std::size_t>(dimension)];
  auto number = static_cast<std::uint32_t>(faces.size());
  if (free.empty()) {
    faces.emplace_back();
  } else {
    number = free.back();
    free.pop_back();
  }
  faces[number].beads = beads;
  return {dimension, number};
}

template <int Dimension>
void TriangulationFaces<Dimension>::match_vertices(std::span<const CellId> made) {
  for (const BeadId bead : beads_) {
    const SimplexName name{0, bead};
    const bool is_vertex = triangulation_.cells_at()[bead] > 0;
    if (is_vertex == is_live(name)) {
      if (is_vertex) exchange_.kept.push_back(name);
      continue;
    }
    if (is_vertex) {
      exchange_.added.push_back(name);
      at(name).cell = made[0];  // replaced below
    } else {
      exchange_.removed.emplace_back(name, at(name).beads);
      at(name).cell = no_cell;
    }
  }
  for (const CellId cell : made)
    for (const BeadId bead : triangulation_.cells()[cell].vertex)
      if (bead != infinite_bead) at({0, bead}).cell = cell;
}

template <int Dimension>
auto TriangulationFaces<Dimension>::exchange(std::span<const CellId> gone, std::span<const CellId> made)
    -> const Exchange& {
  make_room();
  exchange_.removed.clear();
  exchange_.added.clear();
  exchange_.kept.clear();
  beads_.clear();
  entries_.clear();
  const auto note_beads = [this](const CellVertices& vertices) {
    for (const BeadId bead : vertices)  // many beads may be noted repeatedly
      if (bead != infinite_bead &&
          (beads_.size() > few || std::find(beads_.begin(), beads_.end(), bead) == beads_.end()))
        beads_.push_back(bead);
  };
  for (const CellId cell : gone)
    if (vertices_of_[cell] != CellVertices{}) note_beads(vertices_of_[cell]);
  for (const CellId cell : made) note_beads(triangulation_.cells()[cell].vertex);
  const std::size_t most =
      beads_.size() <= few ? std::size_t{1} << few : 2 * (gone.size() + made.size()) * faces_of_cell;
  table_size_ = std::bit_ceil(most);
  if (table_.size() < table_size_) table_.resize(table_size_);
  std::fill_n(table_.begin(), table_size_, 0);
  for (const CellId cell : gone) remove(cell);
  for (const CellId cell : made) add(cell);
  for (const Entry& face : entries_) {
    if (face.stays) {
      if (face.is_old) exchange_.kept.push_back(face.name);
      continue;
    }
    exchange_.removed.emplace_back(face.name, at(face.name).beads);
    at(face.name).cell = no_cell;
    free_[static_cast<std::size_t>(face.name.dimension)].push_back(face.name.number);
  }
  match_vertices(made);
  return exchange_;
}

template <int Dimension>
auto TriangulationFaces<Dimension>::read_all() -> const Exchange& {
  std::vector<CellId> made;
  for (CellId cell = 0; cell < triangulation_.cells().size(); ++cell)
    if (triangulation_.is_live(cell)) made.push_back(cell);
  std::vector<CellId> gone(of_cell_.size());
  std::iota(gone.begin(), gone.end(), CellId{0});
  const Exchange& exchange = this->exchange(gone, made);
  table_ = {};  // later exchanges are small
  entries_ = {};
  beads_ = {};
  return exchange;
}

template class TriangulationFaces<2>;
template class TriangulationFaces<3>;

}  // namespace kds
