#pragma once
// Text that others give (titles, paths, error messages) made safe for XML and HTML.

#include <string>
#include <string_view>
#include <vector>

namespace ddem::reports {

/// Valid UTF-8 without the code points that XML 1.0 forbids: each bad byte, control character (except tab and
/// line feed; carriage returns become line feeds) or non-character is replaced by U+FFFD.
std::string clean_utf8(std::string_view text);

/// clean_utf8 with & < > " ' escaped: usable as element content and as a quoted attribute.
std::string escape(std::string_view text);

/// Letters, digits and hyphens of `text` in lower case, safe as an id and a file name; never empty.
std::string slug(std::string_view text);

/// Percent-encoding for the payload of a data: URI.
std::string percent_encode(std::string_view text);

/// Width in pixels that `text` may take in a wide sans-serif font: an upper estimate, as nothing here can
/// measure.
double text_width(std::string_view text, double font_size);

/// Lines of at most `width` pixels, broken at spaces; a longer word gets a line of its own.
std::vector<std::string> wrap_text(std::string_view text, double width, double font_size);

}  // namespace ddem::reports
