#include "experiments/output/axis.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string_view>

#include "experiments/output/text.h"

namespace kds {

namespace {

std::string superscript(int exponent) {
  constexpr std::array<std::string_view, 10> digits{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text;
  for (const char c : std::to_string(exponent))
    text += c == '-' ? "⁻" : digits[static_cast<std::size_t>(c - '0')];
  return text;
}

}  // namespace

Axis::Axis(double least, double most, bool logarithmic) : from_(least), to_(most), logarithmic_(logarithmic) {
  constexpr double least_share = 1e-9;  // of the values: steps must be wider than what doubles tell apart
  if (logarithmic_) {
    if (!(to_ > 0)) to_ = 1;
    if (!(from_ > 0)) from_ = to_ / 10;
    if (from_ * (1 + least_share) < to_) return;
    from_ /= 2;
    to_ *= 2;
    return;
  }
  if (from_ + least_share * std::max(std::abs(from_), std::abs(to_)) < to_) return;
  const double around = from_ == 0 ? 1 : std::abs(from_) / 2;
  from_ -= around;
  to_ += around;
}

double Axis::share(double value) const {
  if (!logarithmic_) return (value - from_) / (to_ - from_);
  return (std::log(value) - std::log(from_)) / (std::log(to_) - std::log(from_));
}

// 1, 2 or 5 times a power of ten.
double Axis::step(std::size_t most) const {
  const double wanted = (to_ - from_) / static_cast<double>(std::max<std::size_t>(1, most));
  const double power = std::pow(10, std::floor(std::log10(wanted)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= wanted) return factor * power;
  return 10 * power;
}

std::vector<Tick> Axis::ticks(std::size_t most) const {
  constexpr double slack = 1e-9;  // of the axis: a tick at its very end counts
  std::vector<Tick> ticks;
  const auto add = [&](double value) {
    const double where = share(value);
    if (where > -slack && where < 1 + slack) ticks.push_back({value, tick_label(value)});
  };
  if (!logarithmic_) {
    const double apart = step(most);
    for (double k = std::ceil(from_ / apart - slack); k * apart <= to_ + slack * (to_ - from_); ++k)
      add(k == 0 ? 0 : k * apart);
    return ticks;
  }
  const int first = static_cast<int>(std::floor(std::log10(from_)));
  const int last = static_cast<int>(std::ceil(std::log10(to_)));
  const int every = std::max(1, (last - first) / static_cast<int>(std::max<std::size_t>(1, most)) + 1);
  for (int k = first; k <= last; k += last - first > static_cast<int>(most) ? every : 1) add(std::pow(10, k));
  if (ticks.size() >= 2) return ticks;
  ticks.clear();
  for (int k = first; k <= last; ++k)
    for (const double factor : {1.0, 2.0, 5.0}) add(factor * std::pow(10, k));
  if (ticks.size() >= 2) return ticks;
  return Axis(from_, to_, false).ticks(most);
}

void Axis::widen_to_ticks(std::size_t most) {
  if (logarithmic_) return;
  const double apart = step(most);
  from_ = std::floor(from_ / apart + 1e-9) * apart;
  to_ = std::ceil(to_ / apart - 1e-9) * apart;
}

std::string tick_label(double value) {
  if (value == 0) return "0";
  const double size = std::abs(value);
  if (size >= 1e6 || size < 1e-3) {
    int exponent = static_cast<int>(std::floor(std::log10(size)));
    double mantissa = value / std::pow(10, exponent);
    if (std::abs(mantissa) >= 9.9995) {
      mantissa /= 10;
      ++exponent;
    }
    const std::string power = "10" + superscript(exponent);
    const std::string digits = fmt::format("{:.4g}", mantissa);
    return digits == "1" ? power : digits == "-1" ? "-" + power : digits + "·" + power;
  }
  if (size >= 1000 && value == std::floor(value))
    return (value < 0 ? "-" : "") + with_thousands(static_cast<std::uint64_t>(size));
  return fmt::format("{:.4g}", value);
}

}  // namespace kds
