#pragma once
// Runs gnuplot, and converts its drawings into elements of a page: with the page's colours and font, with
// texts under the pointer, and without ids, which could clash between two drawings. Coordinates are rounded
// to a tenth of a pixel, because pages have many of them.

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace kds {

/// Throws an InputError which says that `option` needs gnuplot if gnuplot cannot be started or cannot draw
/// SVG.
void require_gnuplot(std::string_view option);
/// Throws an InputError which says that `option` needs gnuplot's terminal pdfcairo if gnuplot cannot draw
/// PDF.
void require_gnuplot_pdf(std::string_view option);

/// Throws std::runtime_error with gnuplot's message.
[[nodiscard]] std::string run_gnuplot(const std::string& script);

/// The size of a drawing and the margins around its axes, in pixels.
struct DrawingSize {
  double width, height, left, right, top, bottom;
  bool for_print = false;
  double head = 0;        ///< room above the top margin for title and key of a drawing for print
  bool has_texts = true;  ///< whether texts lie under the pointer: not in print, nor on telephones
};

/// The kind of element to which the texts of a drawing belong.
enum class TextsOf {
  marks,   ///< text K belongs to hypertext label K, which has a point
  strips,  ///< as `marks`, but over the full height and halfway to both neighbours
  squares  ///< the K-th filled polygon; all have the colour of series 0. Without texts, they are joined
};

/// The page's style variables. A script names the colour of variable `soft` c_soft.
inline constexpr std::array<std::string_view, 10> page_colours{"s0", "s1", "s2", "s3",   "s4",
                                                               "s5", "s6", "s7", "soft", "line"};
inline constexpr std::size_t series_colours = 8;
/// The values of these variables on light pages and in print. Colour-blind readers can tell the colours of
/// the series apart.
inline constexpr std::array<std::string_view, 10> light_colours{"#2563a8", "#c2600a", "#2b7a4b", "#8a3f8f",
                                                                "#c0392b", "#5b6570", "#0b7f92", "#8a6d00",
                                                                "#5b6570", "#dfe4ea"};
/// Returns the beginning of a script whose drawings page_svg converts: colour K is #0000KK.
[[nodiscard]] std::string page_colours_script();

/// Returns the SVG element. `drawing` is one SVG document of gnuplot up to its </svg>. `attributes` are the
/// attributes of the element. Throws std::runtime_error if `drawing` is not such a document or if texts are
/// left over.
[[nodiscard]] std::string page_svg(std::string_view drawing, const DrawingSize& size, TextsOf of,
                                   const std::vector<std::string>& texts, std::string_view attributes);

}  // namespace kds
