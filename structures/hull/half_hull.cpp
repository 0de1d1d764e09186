#include "structures/hull/half_hull.h"

#include <algorithm>
#include <initializer_list>

namespace kds {

void HalfHull::assign(std::size_t beads, std::span<const char> absent, const std::vector<BeadId>& chain) {
  beads_.assign(beads, {});
  for (std::size_t b = 0; b < absent.size(); ++b) beads_[b].present = absent[b] == 0;
  first_ = chain.empty() ? no_bead : chain.front();
  for (std::size_t i = 0; i < chain.size(); ++i) {
    Bead& bead = beads_[chain[i]];
    bead.in_chain = true;
    if (i > 0) bead.left = chain[i - 1];
    if (i + 1 < chain.size()) bead.right = chain[i + 1];
  }
  for (Bead& bead : beads_)
    if (!bead.in_chain) bead.left = first_;
}

void HalfHull::start() {
  for (BeadId b = static_cast<BeadId>(beads_.size()); b-- > 0;) {
    Bead& bead = beads_[b];
    bead.after_left = bead.before_right = {};
    bead.turn = CertificateHandle::violated;
    bead.under.clear();
    bead.index_under = not_under;
    if (bead.present) (bead.in_chain ? unheld_ : displaced_).push_back(b);
  }
  hold_all();
}

void HalfHull::fail(unsigned table, std::uint32_t place) {
  const BeadId b = place / 4;
  Bead& bead = beads_[b];
  OrderHandles& order = place % 2 == 1 ? bead.before_right : bead.after_left;
  CertificateHandle& failed = table == HullCertificates::turns         ? bead.turn
                              : table == HullCertificates::orders_in_x ? order.x
                                                                       : order.y;
  failed = CertificateHandle::violated;
  if (table == HullCertificates::orders_in_y) certificates_.drop(order);
  if (bead.in_chain) {
    unheld_.push_back(b);
  } else {
    take_away(b);
    displace(b);
  }
  hold_all();
}

void HalfHull::insert(BeadId b) {
  beads_[b].present = true;
  beads_[b].left = first_;
  displaced_.push_back(b);
  hold_all();
}

void HalfHull::erase(BeadId b) {
  if (beads_[b].in_chain) {
    take_out(b);
  } else {
    take_away(b);
    release(b);
  }
  beads_[b].present = false;
  hold_all();
}

void HalfHull::give_up(BeadId b) {
  if (beads_[b].in_chain) {
    const auto [left, right] = std::pair{beads_[b].left, beads_[b].right};
    open_edge(b, b);
    loosen(b);
    if (left != no_bead) {
      open_edge(left, left);
      loosen(left);
    }
    if (right != no_bead) loosen(right);
  } else if (beads_[b].index_under != not_under) {  // otherwise it is displaced already
    take_away(b);
    displace(b);
  }
}

/// Creates missing certificates and places displaced beads until there are none.
void HalfHull::hold_all() {
  while (!unheld_.empty() || !displaced_.empty()) {
    auto& waiting = unheld_.empty() ? displaced_ : unheld_;
    const bool in_chain = !unheld_.empty();
    const BeadId b = waiting.back();
    waiting.pop_back();
    if (beads_[b].in_chain != in_chain) continue;  // it has moved into or out of the chain meanwhile
    in_chain ? hold(b) : put(b);
  }
}

/// Creates the certificates missing at a bead of the chain. If one does not hold, removes this bead or the
/// next one from the chain.
void HalfHull::hold(BeadId v) {
  Bead& vertex = beads_[v];
  if (vertex.left != no_bead && vertex.right != no_bead && vertex.turn == CertificateHandle::violated) {
    vertex.turn = certificates_.watch_turn({vertex.left, v, vertex.right}, upper_ ? -1 : 1, place_of(v));
    if (vertex.turn == CertificateHandle::zero) certificates_.drop(vertex.turn);
    if (vertex.turn == CertificateHandle::violated) return remove(v);
  }
  const BeadId right = vertex.right;
  if (right == no_bead || vertex.after_left.is_held()) return;
  const Ordered ordered = certificates_.watch_order(v, right, place_of(v), vertex.after_left);
  if (ordered == Ordered::together) remove(std::max(v, right));
  if (ordered == Ordered::after) remove(beads_[right].right == no_bead && v != first_ ? right : v);
}

/// Finds where a bead belongs, and puts it under an edge or into the chain.
void HalfHull::put(BeadId b) {
  if (first_ == no_bead) return put_in(b, no_bead);
  Bead& bead = beads_[b];
  BeadId left = bead.left != no_bead && beads_[bead.left].in_chain ? bead.left : first_;
  while (true) {
    const Ordered ordered = certificates_.watch_order(left, b, place_of(b), bead.after_left);
    if (ordered == Ordered::after) {
      if (left == first_) return put_in(b, no_bead);
      left = beads_[left].left;
      continue;
    }
    if (ordered == Ordered::together && b < left) return stand_in(b, left);
    const BeadId right = beads_[left].right;
    if (right == no_bead) {
      if (ordered == Ordered::together) return put_under(b, left);
      return put_in(b, left);
    }
    const Ordered ordered_right = certificates_.watch_order(b, right, place_of(b, true), bead.before_right);
    if (ordered_right == Ordered::after) {
      certificates_.drop(bead.after_left);
      left = right;
      continue;
    }
    if (ordered_right == Ordered::together && b < right) return stand_in(b, right);
    bead.turn = certificates_.watch_turn({left, right, b}, upper_ ? -1 : 1, place_of(b));
    if (bead.turn == CertificateHandle::violated) return put_in(b, left);
    return put_under(b, left);
  }
}

void HalfHull::put_under(BeadId b, BeadId left) {
  Bead& bead = beads_[b];
  bead.left = left;
  bead.index_under = static_cast<std::uint32_t>(beads_[left].under.size());
  beads_[left].under.push_back(b);
}

/// Puts a bead into the chain after `after`, or at the front if `after` is no_bead.
void HalfHull::put_in(BeadId b, BeadId after) {
  release(b);
  const BeadId right = after == no_bead ? first_ : beads_[after].right;
  beads_[b].in_chain = true;
  beads_[b].left = after;
  beads_[b].right = right;
  changed_ = true;
  if (after == no_bead) {
    first_ = b;
  } else {
    open_edge(after, after);
    beads_[after].right = b;
    loosen(after);
  }
  if (right != no_bead) {
    beads_[right].left = b;
    loosen(right);
  }
  unheld_.push_back(b);
}

/// Takes a bead out of the chain; certificates around it are then missing.
void HalfHull::take_out(BeadId v) {
  const BeadId left = beads_[v].left, right = beads_[v].right;
  open_edge(v, left != no_bead ? left : right);
  changed_ = true;
  if (left == no_bead) {
    first_ = right;
  } else {
    open_edge(left, left);
    beads_[left].right = right;
    loosen(left);
  }
  if (right != no_bead) {
    beads_[right].left = left;
    loosen(right);
  }
  beads_[v].in_chain = false;
  beads_[v].left = left != no_bead ? left : right;
  beads_[v].right = no_bead;
  release(v);
}

/// Takes a bead out of the chain and marks it as displaced.
void HalfHull::remove(BeadId v) {
  take_out(v);
  displaced_.push_back(v);
}

/// Replaces a bead of the chain by the bead `b` that is together with it.
void HalfHull::stand_in(BeadId b, BeadId vertex) {
  const BeadId left = beads_[vertex].left;
  remove(vertex);
  put_in(b, left);
}

/// Drops the certificate of an edge and displaces the beads under it. These beads will search for their
/// places from `look_from`, a bead of the chain.
void HalfHull::open_edge(BeadId left, BeadId look_from) {
  certificates_.drop(beads_[left].after_left);
  for (const BeadId b : beads_[left].under) {
    displace(b);
    beads_[b].left = look_from;
  }
  beads_[left].under.clear();
}

/// Drops the turn at a bead of the chain, so that this certificate, and the one of the following edge if
/// missing, are created anew.
void HalfHull::loosen(BeadId v) {
  certificates_.drop(beads_[v].turn);
  unheld_.push_back(v);
}

/// Removes a bead from under its edge.
void HalfHull::take_away(BeadId b) {
  std::vector<BeadId>& under = beads_[beads_[b].left].under;
  beads_[under.back()].index_under = beads_[b].index_under;
  under[beads_[b].index_under] = under.back();
  under.pop_back();
}

void HalfHull::displace(BeadId b) {
  release(b);
  displaced_.push_back(b);
}

/// Drops all certificates of the bead.
void HalfHull::release(BeadId b) {
  beads_[b].index_under = not_under;
  certificates_.drop(beads_[b].after_left);
  certificates_.drop(beads_[b].before_right);
  certificates_.drop(beads_[b].turn);
}

std::vector<BeadId> HalfHull::chain() const {
  std::vector<BeadId> chain;
  for (BeadId b = first_; b != no_bead; b = beads_[b].right) chain.push_back(b);
  return chain;
}

void HalfHull::count_certificates(CertificatesPerBead& per_bead) const {
  const auto count = [&](std::initializer_list<BeadId> named) {
    for (const BeadId b : named) per_bead.add(b);
  };
  for (BeadId b = 0; b < beads_.size(); ++b) {
    const Bead& bead = beads_[b];
    if (!bead.present) continue;
    const BeadId left = bead.left, right = bead.in_chain ? bead.right : beads_[left].right;
    if (!bead.in_chain) count({left, b});
    if (right != no_bead) count({b, right});
    if (left != no_bead && right != no_bead) count({left, b, right});
  }
}

}  // namespace kds
