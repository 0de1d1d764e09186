#pragma once
// What gnuplot drew as an element of a page: in the page's colours and font, without ids that two drawings
// would share, and with texts where the pointer rests.

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace kds {

/// A drawing and the margins around its axes, in pixels.
struct DrawingSize {
  double width, height, left, right, top, bottom;
};

/// What a text of a drawing belongs to.
enum class TextsOf {
  marks,   ///< hypertext K, a label with a point
  strips,  ///< as `marks`, for the whole height from halfway to the one before to halfway to the next
  squares  ///< the K-th filled polygon
};

/// What colour #0000KK of a script stands for: variables of the page's style.
inline constexpr std::array<std::string_view, 10> page_colours{"s0", "s1", "s2", "s3",   "s4",
                                                               "s5", "s6", "s7", "soft", "line"};
inline constexpr std::size_t series_colours = 8;

/// What a number is printed with so that the page shows it as tick_label() does.
inline constexpr std::string_view number_format = "\x02%.12g";

/// `drawing`: one SVG document of gnuplot, up to its </svg>. `attributes`: of the element. Throws
/// std::runtime_error where it is none or texts found no place.
[[nodiscard]] std::string page_svg(std::string_view drawing, const DrawingSize& size, TextsOf of,
                                   const std::vector<std::string>& texts, std::string_view attributes);

}  // namespace kds
