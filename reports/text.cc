#include "reports/text.h"

#include <fmt/format.h>

#include <cstdint>

namespace ddem::reports {
namespace {

constexpr std::string_view kReplacement = "\xEF\xBF\xBD";

struct Decoded {
  std::uint32_t code = 0;
  std::size_t length = 0;  // 0: not valid UTF-8
};

// One code point by the well-formed sequences of RFC 3629: no overlong forms, no surrogates, at most
// U+10FFFF.
Decoded decode(std::string_view s) {
  const auto byte = [&](std::size_t i) {
    return static_cast<std::uint32_t>(static_cast<unsigned char>(s[i]));
  };
  const std::uint32_t lead = byte(0);
  if (lead < 0x80) return {lead, 1};
  const std::size_t length = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
  if (lead < 0xC2 || lead > 0xF4 || s.size() < length) return {};
  std::uint32_t code = lead & (0xFFu >> (length + 1));
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0u) != 0x80u) return {};
    code = (code << 6) | (byte(i) & 0x3Fu);
  }
  const bool overlong = (length == 3 && code < 0x800) || (length == 4 && code < 0x10000);
  const bool surrogate = code >= 0xD800 && code <= 0xDFFF;
  if (overlong || surrogate || code > 0x10FFFF) return {};
  return {code, length};
}

bool allowed_in_xml(std::uint32_t code) {
  if (code == '\t' || code == '\n') return true;
  return code >= 0x20 && !(code >= 0x7F && code <= 0x9F) && (code & 0xFFFE) != 0xFFFE &&
         !(code >= 0xFDD0 && code <= 0xFDEF);
}

// Advance widths of DejaVu Sans in em, by class: the widest of the usual system fonts.
double advance(std::uint32_t code) {
  constexpr std::string_view narrow = "ijlft.,:;'|!()[]/ -";
  constexpr std::string_view wide = "mwMW@%&";
  if (code >= 0x80) return code >= 0x2E80 ? 1.0 : 0.62;
  const char c = static_cast<char>(code);
  if (narrow.find(c) != std::string_view::npos) return 0.38;
  if (wide.find(c) != std::string_view::npos) return 0.96;
  return c >= 'A' && c <= 'Z' ? 0.70 : 0.63;
}

}  // namespace

std::string clean_utf8(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  while (!text.empty()) {
    if (text.front() == '\r') {
      out += '\n';
      text.remove_prefix(text.substr(0, 2) == "\r\n" ? 2 : 1);
      continue;
    }
    const Decoded d = decode(text);
    const std::size_t length = d.length == 0 ? 1 : d.length;
    out += d.length != 0 && allowed_in_xml(d.code) ? text.substr(0, length) : kReplacement;
    text.remove_prefix(length);
  }
  return out;
}

std::string escape(std::string_view text) {
  const std::string clean = clean_utf8(text);
  std::string out;
  out.reserve(clean.size());
  for (const char c : clean) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\'':
        out += "&#39;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

std::string slug(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if ((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9'))
      out += c;
    else if (c >= 'A' && c <= 'Z')
      out += static_cast<char>(c - 'A' + 'a');
    else if (!out.empty() && out.back() != '-')
      out += '-';
  }
  while (!out.empty() && out.back() == '-') out.pop_back();
  return out.empty() ? "unnamed" : out;
}

std::string percent_encode(std::string_view text) {
  constexpr std::string_view plain = "-._~,:;()+/@";
  std::string out;
  out.reserve(text.size() + text.size() / 4);
  for (const char c : text) {
    const bool alphanumeric = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    if (alphanumeric || plain.find(c) != std::string_view::npos)
      out += c;
    else
      fmt::format_to(std::back_inserter(out), "%{:02X}",
                     static_cast<unsigned>(static_cast<unsigned char>(c)));
  }
  return out;
}

double text_width(std::string_view text, double font_size) {
  double em = 0.0;
  while (!text.empty()) {
    const Decoded d = decode(text);
    em += advance(d.length == 0 ? 0xFFFD : d.code);
    text.remove_prefix(d.length == 0 ? 1 : d.length);
  }
  return em * font_size;
}

std::vector<std::string> wrap_text(std::string_view text, double width, double font_size) {
  std::vector<std::string> lines;
  while (!text.empty()) {
    const std::size_t end = text.find_first_of(" \n\t");
    const std::string_view word = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    if (word.empty()) continue;
    const bool fits = !lines.empty() && text_width(lines.back(), font_size) + text_width(" ", font_size) +
                                                text_width(word, font_size) <=
                                            width;
    if (fits)
      lines.back().append(" ").append(word);
    else
      lines.emplace_back(word);
  }
  return lines;
}

}  // namespace ddem::reports
