#pragma once
// Writes well-formed XML, which is also HTML5: elements are balanced, and text and attributes are always
// escaped.

#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace ddem::reports {

struct Attribute {
  std::string_view name;
  std::string value;
  Attribute(std::string_view attribute, std::string_view text) : name(attribute), value(text) {}
  Attribute(std::string_view attribute, const std::string& text) : name(attribute), value(text) {}
  Attribute(std::string_view attribute, const char* text) : name(attribute), value(text) {}
  Attribute(std::string_view attribute, double pixels);
};

class Markup {
 public:
  using Attributes = std::initializer_list<Attribute>;

  Markup& open(std::string_view tag, Attributes attributes = {});
  Markup& open(std::string_view tag, std::span<const Attribute> attributes);
  Markup& close();
  /// `<tag .../>`: void elements of HTML, and childless ones of SVG.
  Markup& empty(std::string_view tag, Attributes attributes = {});
  /// `<tag ...>text</tag>`
  Markup& element(std::string_view tag, Attributes attributes, std::string_view text);
  Markup& text(std::string_view content);
  /// Trusted, well-formed markup of ours; not escaped.
  Markup& raw(std::string_view markup);
  Markup& newline() { return raw("\n"); }

  /// The document; std::logic_error if an element is still open.
  std::string take();

 private:
  void begin(std::string_view tag, std::span<const Attribute> attributes);

  std::string out_;
  std::vector<std::string> open_;
};

}  // namespace ddem::reports
