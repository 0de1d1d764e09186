#include "structures/necklace/necklace.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "motions/base/input_error.h"
#include "motions/scene/near_pairs.h"
#include "structures/necklace/ball_distance.h"

namespace kds {

namespace {

// Counts all violations and keeps the smallest few.
class Collector {
 public:
  explicit Collector(std::size_t most) : most_(most) {}

  void add(Violation violation) {
    ++found_.count;
    if (most_ == 0 || (found_.listed.size() >= most_ && cut_ && !(violation < last_))) return;
    found_.listed.push_back(violation);
    if (most_ <= found_.listed.max_size() / 2 && found_.listed.size() == 2 * most_) cut();
  }
  [[nodiscard]] Violations result() && {
    std::sort(found_.listed.begin(), found_.listed.end());
    if (found_.listed.size() > most_) found_.listed.resize(most_);
    return std::move(found_);
  }

 private:
  void cut() {
    const auto end = found_.listed.begin() + static_cast<std::ptrdiff_t>(most_);
    std::nth_element(found_.listed.begin(), end - 1, found_.listed.end());
    found_.listed.erase(end, found_.listed.end());
    last_ = found_.listed.back();
    cut_ = true;
  }

  std::size_t most_;
  bool cut_ = false;
  Violation last_;  // the largest violation that the last cut kept
  Violations found_;
};

class Validation {
 public:
  explicit Validation(const ValidateOptions& options)
      : options_(options),
        collectors_{Collector(options.most_listed), Collector(options.most_listed),
                    Collector(options.most_listed), Collector(options.most_listed),
                    Collector(options.most_listed)} {}

  void check_alone(const Necklace& necklace) {
    check_connected(necklace);
    check_radii(necklace);
    check_bonds(necklace);
  }

  void check_pairs(std::span<const Necklace> necklaces) {
    std::size_t count = 0;
    for (const Necklace& necklace : necklaces) count += necklace.bead_count();
    Eigen::Matrix3Xd centers(3, static_cast<Eigen::Index>(count));
    std::vector<double> radii;
    std::vector<BeadId> beads;  // beads of the scene
    std::vector<std::size_t> necklace_of;
    for (std::size_t n = 0; n < necklaces.size(); ++n) {
      const BeadRange& range = necklaces[n].beads();
      for (BeadId bead = range.first; bead <= range.last; ++bead) {
        centers.col(static_cast<Eigen::Index>(beads.size())) = necklaces[n].center(bead);
        radii.push_back(necklaces[n].radius(bead));
        beads.push_back(bead);
        necklace_of.push_back(n);
      }
    }
    visit_near_pairs(centers, radii, [&](BeadId i, BeadId j) {
      const Eigen::Vector3d a = centers.col(Eigen::Index{i}), b = centers.col(Eigen::Index{j});
      const double r = radii[i], s = radii[j];
      const bool adjacent = j == i + 1 && necklace_of[i] == necklace_of[j];
      if (compare_distance(a, b, r, s) > 0) return;
      if (!adjacent) add(Condition::disjoint, {std::min(beads[i], beads[j]), std::max(beads[i], beads[j])});
      if (compare_distance(a, b, r, -s) > 0) return;
      const bool first_inside = r < s || (r == s && beads[i] > beads[j]);
      add(Condition::uncontained, {beads[first_inside ? i : j], beads[first_inside ? j : i]});
    });
  }

  [[nodiscard]] NecklaceReport report() && {
    NecklaceReport report;
    for (std::size_t c = 0; c < kConditions.size(); ++c)
      report.conditions[c] = std::move(collectors_[c]).result();
    return report;
  }

 private:
  void add(Condition condition, Violation violation) {
    collectors_[static_cast<std::size_t>(condition)].add(violation);
  }

  void check_connected(const Necklace& n) {
    for (BeadId b = n.beads().first; b < n.beads().last; ++b)
      if (compare_distance(n.center(b), n.center(b + 1), n.radius(b), n.radius(b + 1)) > 0)
        add(Condition::connected, {b, b + 1});
  }

  void check_radii(const Necklace& n) {
    BeadId largest = n.beads().first;
    for (BeadId b = largest; b <= n.beads().last; ++b)
      if (n.radius(b) > n.radius(largest)) largest = b;
    for (BeadId b = n.beads().first; b <= n.beads().last; ++b) {
      const double r = n.radius(b), most = n.radius(largest);
      const bool too_small =
          r < most && (std::isinf(options_.rho) ? r == 0 : compare_products(r, options_.rho, most) < 0);
      if (too_small) add(Condition::uniform_radii, {b, largest});
    }
  }

  void check_bonds(const Necklace& n) {
    if (n.bead_count() < 2) return;
    const auto compare = [&](BeadId a, double factor, BeadId b) {
      return compare_lengths(n.center(a), n.center(a + 1), factor, n.center(b), n.center(b + 1));
    };
    BeadId longest = n.beads().first;
    for (BeadId b = longest; b < n.beads().last; ++b)
      if (compare(b, 1, longest) > 0) longest = b;
    if (n.center(longest) == n.center(longest + 1)) return;  // all beads coincide
    for (BeadId b = n.beads().first; b < n.beads().last; ++b) {
      const bool too_short =
          std::isinf(options_.rho) ? n.center(b) == n.center(b + 1) : compare(b, options_.rho, longest) < 0;
      if (too_short) add(Condition::uniform_bonds, {b, longest});
    }
  }

  ValidateOptions options_;
  std::array<Collector, kConditions.size()> collectors_;
};

}  // namespace

std::string_view name_of(Condition condition) {
  switch (condition) {
    case Condition::connected:
      return "connected";
    case Condition::disjoint:
      return "disjoint";
    case Condition::uncontained:
      return "uncontained";
    case Condition::uniform_radii:
      return "uniform_radii";
    case Condition::uniform_bonds:
      break;
  }
  return "uniform_bonds";
}

bool NecklaceReport::proper() const {
  return std::all_of(conditions.begin(), conditions.end(), [](const Violations& v) { return v.count == 0; });
}

Necklace::Necklace(BeadRange beads, const Eigen::Matrix3Xd& scene_centers,
                   std::span<const double> scene_radii)
    : beads_(beads), centers_(&scene_centers), radii_(scene_radii) {
  for (BeadId b = beads_.first; b <= beads_.last; ++b) {
    if (!center(b).allFinite())
      throw InputError(fmt::format("bead {}: expected finite coordinates, found {}, {}, {}", b, center(b)[0],
                                   center(b)[1], center(b)[2]));
    if (!std::isfinite(radius(b)) || radius(b) < 0)
      throw InputError(
          fmt::format("bead {}: expected a radius (finite, not negative), found {}", b, radius(b)));
  }
}

Necklace::Extent Necklace::radii() const {
  const auto begin = radii_.begin() + beads_.first;
  const auto [least, most] = std::minmax_element(begin, begin + static_cast<std::ptrdiff_t>(bead_count()));
  return {*least, *most};
}

Necklace::Extent Necklace::bonds() const {
  Extent extent{0, 0};
  for (BeadId b = beads_.first; b < beads_.last; ++b) {
    const double bond = (center(b + 1) - center(b)).stableNorm();
    extent.least = b == beads_.first ? bond : std::min(extent.least, bond);
    extent.most = std::max(extent.most, bond);
  }
  return extent;
}

NecklaceReport Necklace::validate(const ValidateOptions& options) const {
  return kds::validate({this, 1}, options);
}

NecklaceReport validate(std::span<const Necklace> necklaces, const ValidateOptions& options) {
  Validation validation(options);
  for (const Necklace& necklace : necklaces) validation.check_alone(necklace);
  validation.check_pairs(necklaces);
  return std::move(validation).report();
}

}  // namespace kds
