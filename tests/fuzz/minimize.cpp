#include "tests/fuzz/minimize.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <utility>

namespace kds::test {

namespace {

/// A number is simpler if it has fewer digits or, with as many, if it is nearer to zero.
std::pair<std::size_t, double> complexity(double x) { return {fmt::to_string(x).size(), std::abs(x)}; }

double rounded(double x, int digits) {
  return std::strtod(fmt::format("{:.{}g}", x, digits).c_str(), nullptr);
}

class Minimizer {
 public:
  Minimizer(SmallScene scene, const std::function<bool(const SmallScene&)>& is_faulty)
      : scene_(std::move(scene)), is_faulty_(is_faulty) {}

  SmallScene run() {
    while (drop_beads() || drop_places() || drop_columns() || join() || simplify_all() || simplify())
      continue;
    return scene_;
  }

 private:
  /// Takes the scene that `change` makes if it keeps the fault.
  template <class Change>
  bool take(const Change& change) {
    SmallScene smaller = scene_;
    change(smaller);
    if (!is_faulty_(smaller)) return false;
    scene_ = std::move(smaller);
    return true;
  }

  bool drop_beads() {
    bool any = false;
    for (std::size_t length = scene_.beads.size() / 2; length > 0; length /= 2)
      for (std::size_t first = 0; first + length <= scene_.beads.size() && scene_.beads.size() > length;)
        if (take([&](SmallScene& s) {
              const auto begin = s.beads.begin() + static_cast<std::ptrdiff_t>(first);
              s.beads.erase(begin, begin + static_cast<std::ptrdiff_t>(length));
            })) {
          any = true;
        } else {
          first += length;
        }
    return any;
  }

  bool drop_places() {
    bool any = false;
    for (std::size_t k = scene_.place_count(); k-- > 0 && scene_.place_count() > 2;)
      any |= take([&](SmallScene& s) {
        for (auto& bead : s.beads) bead.places.erase(bead.places.begin() + static_cast<std::ptrdiff_t>(k));
      });
    return any;
  }

  bool drop_columns() {
    bool any = false;
    while (!scene_.of_frames && scene_.columns() > 1 && take([](SmallScene& s) {
      for (auto& bead : s.beads)
        for (auto& place : bead.places) place.pop_back();
    }))
      any = true;
    return any;
  }

  bool join() {
    bool any = scene_.hermite && take([](SmallScene& s) { s.hermite = false; });
    for (std::size_t b = 0; b < scene_.beads.size(); ++b)
      any |= scene_.beads[b].begins && take([&](SmallScene& s) { s.beads[b].begins = false; });
    return any;
  }

  /// Rounds all numbers to a few digits at once, which saves most of the work for scenes from files.
  bool simplify_all() {
    for (const int digits : {1, 2, 4}) {
      bool simpler = false;
      const bool is_kept = take([&](SmallScene& s) {
        each_number(s, [&](double& x) {
          const double shorter = rounded(x, digits);
          if (!(complexity(shorter) < complexity(x))) return;
          x = shorter;
          simpler = true;
        });
      });
      if (is_kept && simpler) return true;
    }
    return false;
  }

  bool simplify() {
    bool any = false;
    std::size_t numbers = 0;
    each_number(scene_, [&](double&) { ++numbers; });
    for (std::size_t i = 0; i < numbers; ++i) {
      const double now = *number(scene_, i);
      std::vector<double> candidates{0, 1, -1, 2, std::trunc(now / 2), std::trunc(now)};
      for (int digits = 1; digits < 17; ++digits) candidates.push_back(rounded(now, digits));
      for (const double simpler : candidates)
        if (complexity(simpler) < complexity(now) && take([&](SmallScene& s) { *number(s, i) = simpler; })) {
          any = true;
          break;
        }
    }
    return any;
  }

  /// Calls visit(x) for each radius and coordinate.
  template <class Visit>
  static void each_number(SmallScene& scene, const Visit& visit) {
    for (auto& bead : scene.beads) {
      visit(bead.radius);
      for (auto& place : bead.places)
        for (double& x : place) visit(x);
    }
  }
  [[nodiscard]] static double* number(SmallScene& scene, std::size_t i) {
    double* found = nullptr;
    each_number(scene, [&](double& x) {
      if (i-- == 0) found = &x;
    });
    return found;
  }

  SmallScene scene_;
  const std::function<bool(const SmallScene&)>& is_faulty_;
};

}  // namespace

SmallScene minimized(SmallScene scene, const std::function<bool(const SmallScene&)>& is_faulty) {
  return Minimizer(std::move(scene), is_faulty).run();
}

}  // namespace kds::test
