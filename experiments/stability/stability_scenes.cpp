#include "experiments/stability/stability_scenes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <utility>

namespace kds {

Instance BeadCurves::instance(std::string name) const {
  bool weighted = false;
  for (std::size_t bead = 0; bead < beads_; ++bead)
    for (int k = 0; k <= degree_; ++k) weighted |= dimension_ == 3 && weight(bead, k) != 0;
  Instance instance;
  instance.file = std::move(name);
  instance.columns = dimension_ + (weighted ? 1 : 0);
  instance.degree = degree_;
  for (std::size_t bead = 0; bead < beads_; ++bead)
    for (int column = 0; column < instance.columns; ++column)
      for (int k = 0; k <= degree_; ++k) instance.control_points.push_back(numbers_[at(bead, k, column)]);
  return instance;
}

std::string instance_text(const Instance& instance) {
  std::string text = fmt::format("{} {} {}\n", instance.point_count(), instance.columns, instance.degree);
  const auto a_line = static_cast<std::size_t>(instance.columns * (instance.degree + 1));
  for (std::size_t i = 0; i < instance.control_points.size(); ++i)
    text += fmt::format("{}{}", instance.control_points[i], (i + 1) % a_line == 0 ? '\n' : ' ');
  return text;
}

namespace {

// The distributions of the standard library differ between implementations, hence this function.
double uniform(SceneRandom& random, double low = -1, double high = 1) {
  return low + (high - low) * (static_cast<double>(random() >> 11U) * 0x1p-53);
}
int pick(SceneRandom& random, int low, int high) {
  return low + static_cast<int>(random() % static_cast<std::uint64_t>(high - low + 1));
}
bool toss(SceneRandom& random) { return (random() >> 20U) % 2 == 0; }

template <class Change>
void for_all(BeadCurves& beads, Change change) {
  for (std::size_t b = 0; b < beads.bead_count(); ++b)
    for (int k = 0; k <= beads.degree(); ++k)
      for (int axis = 0; axis < beads.dimension(); ++axis) change(beads.coordinate(b, k, axis), b, k, axis);
}

BeadCurves empty(const SceneShape& shape) { return {shape.dimension, shape.degree, shape.beads}; }

// Places every control point at random in the unit box.
BeadCurves generic(const SceneShape& shape, SceneRandom& random) {
  BeadCurves beads = empty(shape);
  for_all(beads, [&](double& x, auto...) { x = uniform(random); });
  return beads;
}

// Small integer coordinates, which give coplanar, cospherical and coincident beads and simultaneous events.
BeadCurves grid(const SceneShape& shape, SceneRandom& random, int reach = 2) {
  BeadCurves beads = empty(shape);
  for_all(beads, [&](double& x, auto...) { x = pick(random, -reach, reach); });
  return beads;
}

BeadCurves generic_or_grid(const SceneShape& shape, SceneRandom& random) {
  return toss(random) ? generic(shape, random) : grid(shape, random);
}

template <int Exponent>
BeadCurves scaled(const SceneShape& shape, SceneRandom& random) {
  BeadCurves beads = generic_or_grid(shape, random);
  for_all(beads, [](double& x, auto...) { x = std::ldexp(x, Exponent); });
  return beads;
}

// Even differences of coordinates overflow.
BeadCurves largest(const SceneShape& shape, SceneRandom& random) {
  BeadCurves beads = generic(shape, random);
  for_all(beads, [](double& x, auto...) { x *= std::numeric_limits<double>::max(); });
  return beads;
}

template <int Exponent>
BeadCurves far_away(const SceneShape& shape, SceneRandom& random) {
  BeadCurves beads = generic(shape, random);
  for_all(beads, [](double& x, auto...) { x += std::ldexp(1.0, Exponent); });
  return beads;
}

// Near zero, where a step by a subnormal number has an effect.
BeadCurves subnormal_steps(const SceneShape& shape, SceneRandom& random) {
  BeadCurves beads = empty(shape);
  const double unit = toss(random) ? 0x1p-1060 : 1;
  for_all(beads, [&](double& x, std::size_t b, int k, int axis) {
    x = k == 0 ? pick(random, -2, 2) * unit
               : beads.coordinate(b, k - 1, axis) + pick(random, -3, 3) * 0x1p-1074;
  });
  return beads;
}

BeadCurves at_rest(const SceneShape& shape, SceneRandom& random) {
  BeadCurves beads = generic_or_grid(shape, random);
  for_all(beads, [&](double& x, std::size_t b, int, int axis) { x = beads.coordinate(b, 0, axis); });
  return beads;
}

BeadCurves out_and_back(const SceneShape& shape, SceneRandom& random) {
  BeadCurves beads = generic_or_grid(shape, random);
  for_all(beads, [&](double& x, std::size_t b, int k, int axis) {
    if (k == shape.degree) x = beads.coordinate(b, 0, axis);
  });
  return beads;
}

// Returns a number at most `most` units in the last place from `x`. Next to 0 the unit is that of numbers
// next to 1/2.
double beside(SceneRandom& random, double x, int most) {
  if (x == 0) return pick(random, -most, most) * 0x1p-53;
  for (int i = pick(random, 0, most); i > 0; --i) x = std::nextafter(x, toss(random) ? 1e300 : -1e300);
  return x;
}

BeadCurves ulp_steps(const SceneShape& shape, SceneRandom& random) {
  BeadCurves beads = at_rest(shape, random);
  for_all(beads, [&](double& x, std::size_t, int k, int) {
    if (k > 0) x = beside(random, x, 1);
  });
  return beads;
}

BeadCurves thousandfold_steps(const SceneShape& shape, SceneRandom& random) {
  BeadCurves beads = generic_or_grid(shape, random);
  for_all(beads, [](double& x, std::size_t, int k, int) { x *= k > 0 ? 1000 : 1; });
  return beads;
}

void set_radius(BeadCurves& beads, std::size_t b, double radius) {
  for (int k = 0; k <= beads.degree(); ++k) {
    beads.radius(b, k) = radius;
    beads.weight(b, k) = radius * radius;
  }
}

template <int Decimals>
BeadCurves unlike_radii(const SceneShape& shape, SceneRandom& random) {
  BeadCurves beads = generic(shape, random);
  const double ratio = std::pow(10.0, Decimals);
  for (std::size_t b = 0; b < shape.beads; ++b)
    set_radius(beads, b,
               b == 0 ? 1 : (b == 1 ? 1 : std::exp(uniform(random, 0, 1) * std::log(ratio))) / ratio);
  return beads;
}

BeadCurves ulp_apart(const SceneShape& shape, SceneRandom& random) {
  BeadCurves beads = generic_or_grid(shape, random);
  for_all(beads, [&](double& x, std::size_t b, int k, int axis) {
    if (b % 2 == 1) x = beside(random, beads.coordinate(b - 1, k, axis), 1);
  });
  return beads;
}

BeadCurves coincident(const SceneShape& shape, SceneRandom& random) {
  BeadCurves beads = generic_or_grid(shape, random);
  for_all(beads, [&](double& x, std::size_t b, int k, int axis) {
    if (b % 2 == 1) x = beads.coordinate(b - 1, k, axis);
  });
  return beads;
}

// Adds a motion to every bead that is zero at one moment: w (1-2u) for the middle of the step, w u for its
// start, w (1-u) for its end. w is a multiple of 6, so that the control points are integers for degrees up to
// 3.
enum class Moment { start, middle, end };
double share(Moment moment, int k, int degree) {
  if (moment == Moment::middle) return 6.0 * (degree - 2 * k) / degree;
  return 6.0 * (moment == Moment::start ? k : degree - k) / degree;
}
void pass_through(BeadCurves& beads, SceneRandom& random, Moment moment, std::size_t every = 1) {
  for (std::size_t b = every - 1; b < beads.bead_count(); b += every) {
    for (int axis = 0; axis < beads.dimension(); ++axis) {
      const int velocity = pick(random, -3, 3);
      for (int k = 0; k <= beads.degree(); ++k)
        beads.coordinate(b, k, axis) += velocity * share(moment, k, beads.degree());
    }
  }
}

BeadCurves coincident_midstep(const SceneShape& shape, SceneRandom& random) {
  BeadCurves beads = grid(shape, random, 9);
  for_all(beads, [&](double& x, std::size_t b, int k, int axis) {
    if (b % 2 == 1) x = beads.coordinate(b - 1, k, axis);
  });
  pass_through(beads, random, Moment::middle, 2);
  return beads;
}

// Integer multiples of one moving difference, so that the beads are exactly collinear.
BeadCurves collinear(const SceneShape& shape, SceneRandom& random) {
  BeadCurves beads = grid(shape, random, 9);
  constexpr double factors[] = {-1, 2, -2, 3, -3, 4, -4, 5};  // distinct for up to ten beads
  const auto first = static_cast<std::size_t>(pick(random, 0, 7));
  for_all(beads, [&](double& x, std::size_t b, int k, int axis) {
    if (b < 2) return;
    const double from = beads.coordinate(0, k, axis);
    x = from + factors[(first + b) % 8] * (beads.coordinate(1, k, axis) - from);
  });
  return beads;
}

BeadCurves collinear_midstep(const SceneShape& shape, SceneRandom& random) {
  BeadCurves beads = collinear(shape, random);
  pass_through(beads, random, Moment::middle);
  return beads;
}

BeadCurves coplanar(const SceneShape& shape, SceneRandom& random) {
  BeadCurves beads = grid(shape, random, 9);
  const int a = pick(random, -2, 2), b = pick(random, -2, 2);
  for_all(beads, [&](double& x, std::size_t bead, int k, int axis) {
    if (axis == 2) x = a * beads.coordinate(bead, k, 0) + b * beads.coordinate(bead, k, 1);
  });
  return beads;
}

BeadCurves coplanar_midstep(const SceneShape& shape, SceneRandom& random) {
  BeadCurves beads = coplanar(shape, random);
  pass_through(beads, random, Moment::middle);
  return beads;
}

using Point = std::array<double, 3>;

// Returns a point with integer coordinates on the circle or sphere of radius 5.
Point on_sphere(SceneRandom& random, int dimension) {
  constexpr double legs[3][2] = {{5, 0}, {3, 4}, {4, 3}};
  Point point{};
  const auto& [one, other] = legs[pick(random, 0, 2)];
  const int first = pick(random, 0, dimension - 1);
  const int second = (first + pick(random, 1, dimension - 1)) % dimension;
  point[static_cast<std::size_t>(first)] = toss(random) ? one : -one;
  point[static_cast<std::size_t>(second)] = toss(random) ? other : -other;
  return point;
}

// Returns distinct points. There are 12 in the plane and 30 in space.
std::vector<Point> points_on_sphere(SceneRandom& random, const SceneShape& shape) {
  std::vector<Point> points;
  while (points.size() < shape.beads) {
    const Point point = on_sphere(random, shape.dimension);
    if (points.size() >= 12 || std::find(points.begin(), points.end(), point) == points.end())
      points.push_back(point);
  }
  return points;
}

// Beads on a sphere that moves and grows.
BeadCurves cospherical(const SceneShape& shape, SceneRandom& random) {
  BeadCurves beads = empty(shape);
  std::array<double, 4> size{};
  std::array<std::array<double, 3>, 4> center{};
  for (std::size_t k = 0; k < size.size(); ++k) {
    size[k] = pick(random, 1, 4);
    for (double& x : center[k]) x = pick(random, -9, 9);
  }
  const std::vector<Point> points = points_on_sphere(random, shape);
  for (std::size_t b = 0; b < shape.beads; ++b) {
    for (int k = 0; k <= shape.degree; ++k) {
      const auto index = static_cast<std::size_t>(k);
      for (int axis = 0; axis < shape.dimension; ++axis) {
        const auto along = static_cast<std::size_t>(axis);
        beads.coordinate(b, k, axis) = center[index][along] + size[index] * points[b][along];
      }
    }
  }
  return beads;
}

BeadCurves cospherical_midstep(const SceneShape& shape, SceneRandom& random) {
  BeadCurves beads = cospherical(shape, random);
  pass_through(beads, random, Moment::middle, toss(random) ? 1 : shape.beads);
  return beads;
}

// Returns a vector perpendicular to a point.
Point tangent_at(const Point& point, SceneRandom& random, int dimension) {
  const Point w{double(pick(random, -2, 2)), double(pick(random, -2, 2)), double(pick(random, 1, 2))};
  if (dimension == 2) return {-point[1] * w[2], point[0] * w[2], 0};
  return {point[1] * w[2] - point[2] * w[1], point[2] * w[0] - point[0] * w[2],
          point[0] * w[1] - point[1] * w[0]};
}

// All beads except the last are at rest on a sphere; the first one may be at its centre. The last bead moves
// along a tangent and touches the sphere at u = 1/2. All beads have half the sphere's radius, so the last
// bead also touches the bead at the centre.
BeadCurves tangent(const SceneShape& shape, SceneRandom& random) {
  BeadCurves beads = empty(shape);
  std::vector<Point> points = points_on_sphere(random, shape);
  if (shape.beads == 2 || toss(random)) points.front() = {};
  const Point velocity = tangent_at(points.back(), random, shape.dimension);
  for_all(beads, [&](double& x, std::size_t b, int k, int axis) {
    const auto along = static_cast<std::size_t>(axis);
    x = points[b][along];
    if (b + 1 == shape.beads) x += velocity[along] * share(Moment::middle, k, shape.degree);
  });
  for (std::size_t b = 0; b < shape.beads; ++b) set_radius(beads, b, 2.5);
  return beads;
}

// Balls at rest that touch one sphere from inside; the first one may be as large as the sphere. The last ball
// moves along a tangent and touches the sphere at u = 1/2.
BeadCurves inner_contact(const SceneShape& shape, SceneRandom& random) {
  constexpr double sphere = 20;
  BeadCurves beads = empty(shape);
  const std::vector<Point> points = points_on_sphere(random, shape);
  const Point velocity = tangent_at(points.back(), random, shape.dimension);
  const bool large = shape.beads == 2 || toss(random);
  for (std::size_t b = 0; b < shape.beads; ++b) {
    const double times = b == 0 && large ? 0 : pick(random, 1, 4);
    set_radius(beads, b, sphere - 5 * times);
    for (int k = 0; k <= shape.degree; ++k) {
      for (int axis = 0; axis < shape.dimension; ++axis) {
        const auto along = static_cast<std::size_t>(axis);
        beads.coordinate(b, k, axis) = times * points[b][along];
        if (b + 1 == shape.beads)
          beads.coordinate(b, k, axis) += velocity[along] * share(Moment::middle, k, shape.degree);
      }
    }
  }
  return beads;
}

// Many certificates are zero at one moment, at which the beads lie on a small grid or on a sphere.
template <Moment At>
BeadCurves tied(const SceneShape& shape, SceneRandom& random) {
  const bool sphere = shape.dimension > 1 && toss(random);
  BeadCurves beads = sphere ? cospherical(shape, random) : grid(shape, random, 1);
  if (!sphere)
    for_all(beads, [&](double& x, std::size_t b, int, int axis) { x = beads.coordinate(b, 0, axis); });
  pass_through(beads, random, At);
  return beads;
}

// Balls that touch the first ball from inside up to a few units in the last place. The leading coefficient a
// of the sphere's quadratic vanishes.
BeadCurves inner_tangent(const SceneShape& shape, SceneRandom& random) {
  BeadCurves beads = empty(shape);
  const double smallest = pick(random, 1, 3);
  for (std::size_t b = 0; b < shape.beads; ++b) {
    const double times = b == 0 ? 0 : pick(random, 1, 6);
    set_radius(beads, b, smallest + 5 * times);
    const Point point =
        shape.dimension > 1 ? on_sphere(random, shape.dimension) : Point{toss(random) ? 5.0 : -5.0, 0, 0};
    for (int k = 0; k <= shape.degree; ++k)
      for (int axis = 0; axis < shape.dimension; ++axis)
        beads.coordinate(b, k, axis) = beside(random, times * point[static_cast<std::size_t>(axis)], 2);
  }
  return beads;
}

// Beads nearly in one plane, or in the plane nearly on one line.
BeadCurves nearly_flat(const SceneShape& shape, SceneRandom& random) {
  BeadCurves beads = generic_or_grid(shape, random);
  const double height = std::ldexp(1.0, -pick(random, 20, 50));
  const int last = shape.dimension - 1;
  for_all(beads, [&](double& x, std::size_t b, int k, int axis) {
    if (axis == last) x = beads.coordinate(b, k, 0) + height * pick(random, -3, 3);
  });
  return beads;
}

// Control points that alternate between far positions: functions of the highest degree with many roots.
BeadCurves winding(const SceneShape& shape, SceneRandom& random) {
  BeadCurves beads = generic(shape, random);
  for_all(beads, [&](double& x, std::size_t, int k, int) {
    if (k > 0 && k < shape.degree) x *= 8;
  });
  return beads;
}

BeadCurves with_wrong_number(const SceneShape& shape, SceneRandom& random, double wrong) {
  BeadCurves beads = generic(shape, random);
  // One draw per line, since the evaluation order of arguments is unspecified.
  const std::size_t bead = random() % shape.beads;
  const int k = pick(random, 0, shape.degree);
  const int axis = pick(random, 0, shape.dimension - 1);
  beads.coordinate(bead, k, axis) = wrong;
  return beads;
}
BeadCurves not_a_number(const SceneShape& shape, SceneRandom& random) {
  return with_wrong_number(shape, random, std::numeric_limits<double>::quiet_NaN());
}
BeadCurves infinite(const SceneShape& shape, SceneRandom& random) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  return with_wrong_number(shape, random, toss(random) ? infinity : -infinity);
}

constexpr bool unequal = true, must_refuse = true;
constexpr Extreme kExtremes[] = {
    {"scale:2^-1000", "coordinates times 2^-1000", scaled<-1000>},
    {"scale:2^-300", "coordinates times 2^-300: products vanish", scaled<-300>},
    {"scale:2^300", "coordinates times 2^300: products overflow", scaled<300>},
    {"scale:2^1000", "coordinates times 2^1000", scaled<1000>},
    {"scale:largest", "coordinates up to the largest double: differences overflow", largest},
    {"offset:2^20", "2^20 radii from the origin", far_away<20>},
    {"offset:2^35", "2^35 radii from the origin", far_away<35>},
    {"offset:2^50", "2^50 radii from the origin", far_away<50>},
    {"step:subnormal", "moves by subnormal numbers", subnormal_steps},
    {"step:zero", "no motion", at_rest},
    {"step:identical", "frames alike, motion between them", out_and_back, 1, 2},
    {"step:ulp", "moves by one unit in the last place", ulp_steps},
    {"step:thousandfold", "a step a thousand times longer than the chain", thousandfold_steps},
    {"radii:10^3", "radii of ratio 10^3", unlike_radii<3>, 1, 1, unequal},
    {"radii:10^6", "radii of ratio 10^6", unlike_radii<6>, 1, 1, unequal},
    {"radii:10^9", "radii of ratio 10^9", unlike_radii<9>, 1, 1, unequal},
    {"beads:ulp-apart", "pairs of beads a last place apart", ulp_apart},
    {"beads:coincident", "pairs of beads at one position", coincident},
    {"beads:coincident-mid", "the same at u = 1/2", coincident_midstep},
    {"beads:collinear", "all on one moving line", collinear, 2},
    {"beads:collinear-mid", "the same at u = 1/2", collinear_midstep, 2},
    {"beads:coplanar", "all in one moving plane", coplanar, 3},
    {"beads:coplanar-mid", "the same at u = 1/2", coplanar_midstep, 3},
    {"beads:cospherical", "all on one moving sphere", cospherical, 2},
    {"beads:cospherical-mid", "the same at u = 1/2", cospherical_midstep, 2},
    {"contact:tangent", "a bead touches a sphere, and a bead, at u = 1/2", tangent, 2},
    {"contact:inner", "unequal balls touch a sphere from inside at u = 1/2", inner_contact, 2, 1, unequal},
    {"ties:start", "many certificates are zero at u = 0", tied<Moment::start>},
    {"ties:middle", "many certificates are zero at u = 1/2", tied<Moment::middle>},
    {"ties:end", "many certificates are zero at u = 1", tied<Moment::end>},
    {"basis:a-near-0", "balls touch one from inside, nearly", inner_tangent, 1, 1, unequal},
    {"basis:flat", "nearly in one plane (on one line)", nearly_flat, 2},
    {"degree:18", "cubic motion that winds: degrees up to 18", winding, 1, 3},
    {"refused:nan", "a control point is no number", not_a_number, 1, 1, false, must_refuse},
    {"refused:infinity", "a control point is infinite", infinite, 1, 1, false, must_refuse},
};

}  // namespace

std::span<const Extreme> all_extremes() { return kExtremes; }

SceneRandom scene_random(std::uint64_t seed, std::string_view extreme, std::size_t number) {
  std::uint64_t hash = 0xcbf29ce484222325ULL ^ seed;
  for (const char c : extreme) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL;
  return SceneRandom(hash + number * 0x9e3779b97f4a7c15ULL);
}

namespace {

bool has_radii(const BeadCurves& beads) {
  for (std::size_t b = 0; b < beads.bead_count(); ++b)
    for (int k = 0; k <= beads.degree(); ++k)
      if (beads.radius(b, k) != 0) return true;
  return false;
}

// Returns a power of two that is at most an eighth of the distance between beads at the start.
double unit_of(const BeadCurves& beads) {
  double apart = 0;
  for (std::size_t b = 1; b < beads.bead_count(); ++b)
    for (int axis = 0; axis < beads.dimension(); ++axis)
      apart = std::max(apart, std::abs(beads.coordinate(b, 0, axis) - beads.coordinate(0, 0, axis)));
  if (apart == 0) return 1;
  const int exponent = std::isfinite(apart) ? std::ilogb(apart) : 1023;
  return std::max(std::ldexp(1.0, exponent - 3), std::numeric_limits<double>::denorm_min());
}

}  // namespace

void give_radii(BeadCurves& beads, SceneRandom& random) {
  if (has_radii(beads)) return;
  const double unit = unit_of(beads);
  const auto kind = random() % 4;
  const bool equal = kind == 0, changing = kind >= 2, any = kind == 3;
  const auto draw = [&] {
    return unit *
           (any ? 8 * static_cast<double>(random() >> 11U) * 0x1p-53 : static_cast<double>(random() % 9));
  };
  const double common = draw();
  for (std::size_t b = 0; b < beads.bead_count(); ++b) {
    const double radius = equal ? common : draw();
    for (int k = 0; k <= beads.degree(); ++k) beads.radius(b, k) = changing && k > 0 ? draw() : radius;
  }
}

}  // namespace kds
