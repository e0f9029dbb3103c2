#include "reports/markup.h"

#include <stdexcept>
#include <utility>

#include "reports/number.h"
#include "reports/text.h"

namespace ddem::reports {

Attribute::Attribute(std::string_view attribute, double pixels)
    : name(attribute), value(coordinate(pixels)) {}

void Markup::begin(std::string_view tag, std::span<const Attribute> attributes) {
  out_.append("<").append(tag);
  for (const Attribute& a : attributes)
    out_.append(" ").append(a.name).append("=\"").append(escape(a.value)).append("\"");
}

Markup& Markup::open(std::string_view tag, Attributes attributes) {
  return open(tag, std::span(attributes.begin(), attributes.size()));
}

Markup& Markup::open(std::string_view tag, std::span<const Attribute> attributes) {
  begin(tag, attributes);
  out_ += '>';
  open_.emplace_back(tag);
  return *this;
}

Markup& Markup::close() {
  if (open_.empty()) throw std::logic_error("markup: nothing is open");
  out_.append("</").append(open_.back()).append(">");
  open_.pop_back();
  return *this;
}

Markup& Markup::empty(std::string_view tag, Attributes attributes) {
  begin(tag, std::span(attributes.begin(), attributes.size()));
  out_ += "/>";
  return *this;
}

Markup& Markup::element(std::string_view tag, Attributes attributes, std::string_view content) {
  return open(tag, attributes).text(content).close();
}

Markup& Markup::text(std::string_view content) {
  out_ += escape(content);
  return *this;
}

Markup& Markup::raw(std::string_view markup) {
  out_ += markup;
  return *this;
}

std::string Markup::take() {
  if (!open_.empty()) throw std::logic_error("markup: <" + open_.back() + "> is still open");
  return std::exchange(out_, {});
}

}  // namespace ddem::reports
