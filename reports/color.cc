#include "reports/color.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace ddem::reports {

namespace {

Rgb between(std::uint32_t from, std::uint32_t to, double f) {
  Rgb out{};
  for (int channel = 0; channel < 3; ++channel) {
    const int shift = 16 - 8 * channel;
    const double a = (from >> shift) & 0xFFu, b = (to >> shift) & 0xFFu;
    out[channel] = static_cast<std::uint8_t>(std::lround(a + f * (b - a)));
  }
  return out;
}

}  // namespace

std::string_view color_hex(Color color) {
  switch (color) {
    case Color::blue:
      return "#0072b2";
    case Color::vermilion:
      return "#d55e00";
    case Color::green:
      return "#009e73";
    case Color::orange:
      return "#e69f00";
    case Color::purple:
      return "#cc79a7";
    case Color::sky:
      return "#56b4e9";
    case Color::black:
      return "#000000";
    case Color::yellow:
      return "#f0e442";
    case Color::grey:
      return "#767676";
    case Color::automatic:
      break;
  }
  return "#333333";
}

Color automatic_color(std::size_t index) {
  constexpr std::array order = {Color::blue,   Color::vermilion, Color::green, Color::orange,
                                Color::purple, Color::sky,       Color::black};
  return order[index % order.size()];
}

Rgb viridis(double t) {
  // Sixteen equidistant colours of the published map; between them it is linear to within one level or two.
  static constexpr std::uint32_t anchors[] = {0x440154, 0x481a6c, 0x472f7d, 0x414487, 0x39568c, 0x31688e,
                                              0x2a788e, 0x23888e, 0x1f988b, 0x22a884, 0x35b779, 0x54c568,
                                              0x7ad151, 0xa5db36, 0xd2e21b, 0xfde725};
  constexpr int last = static_cast<int>(std::size(anchors)) - 1;
  const double position = (t > 0.0 ? std::min(t, 1.0) : 0.0) * last;
  const int left = std::min(static_cast<int>(position), last - 1);
  return between(anchors[left], anchors[left + 1], position - left);
}

Rgb diverging(double t) {
  static constexpr std::uint32_t blues[] = {0xf7f7f7, 0xd1e5f0, 0x92c5de, 0x4393c3, 0x2166ac, 0x053061};
  static constexpr std::uint32_t reds[] = {0xf7f7f7, 0xfddbc7, 0xf4a582, 0xd6604d, 0xb2182b, 0x67001f};
  constexpr int last = static_cast<int>(std::size(reds)) - 1;
  const double position = std::min(std::abs(t), 1.0) * last;
  const int left = std::min(static_cast<int>(position), last - 1);
  const auto& anchors = t < 0.0 ? blues : reds;
  return between(anchors[left], anchors[left + 1], position - left);
}

std::string hex(Rgb color) {
  return fmt::format("#{:02x}{:02x}{:02x}", color[0], color[1], color[2]);
}

}  // namespace ddem::reports
