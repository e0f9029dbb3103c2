#include "reports/report_json.h"

#include <array>
#include <cmath>
#include <concepts>
#include <limits>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace ddem::reports {
namespace {

// Every struct's members are listed once, in fields(), for writing and reading alike.

template <class T, class Struct>
concept Is = std::same_as<std::remove_const_t<T>, Struct>;

void fields(auto& archive, Is<Headline> auto& h) {
  archive("label", h.label);
  archive("value", h.value);
  archive("note", h.note);
}

void fields(auto& archive, Is<Spark> auto& s) {
  archive("spark", s.values);
}

void fields(auto& archive, Is<NightTile> auto& n) {
  archive("label", n.label);
  archive("state", n.state);
}

void fields(auto& archive, Is<Limits> auto& l) {
  archive("lower", l.lower);
  archive("upper", l.upper);
}

void fields(auto& archive, Is<Axis> auto& a) {
  archive("label", a.label);
  archive("unit", a.unit);
  archive("scale", a.scale);
  archive("limits", a.limits);
}

void fields(auto& archive, Is<Series> auto& s) {
  archive("name", s.name);
  archive("kind", s.kind);
  archive("x", s.x);
  archive("y", s.y);
  archive("error", s.error);
  archive("color", s.color);
  archive("dash", s.dash);
}

void fields(auto& archive, Is<Band> auto& b) {
  archive("name", b.name);
  archive("x", b.x);
  archive("lower", b.lower);
  archive("upper", b.upper);
  archive("color", b.color);
}

void fields(auto& archive, Is<ReferenceLine> auto& r) {
  archive("direction", r.direction);
  archive("value", r.value);
  archive("label", r.label);
  archive("dash", r.dash);
}

void fields(auto& archive, Is<Pick> auto& p) {
  archive("x", p.x);
  archive("y", p.y);
  archive("label", p.label);
  archive("series", p.series);
}

void fields(auto& archive, Is<HeatMap> auto& m) {
  archive("x", m.x);
  archive("y", m.y);
  archive("value", m.value);
  archive("value_axis", m.value_axis);
  archive("color_scale", m.scale);
}

void fields(auto& archive, Is<Plot> auto& p) {
  archive("title", p.title);
  archive("x", p.x);
  archive("y", p.y);
  archive("map", p.map);
  archive("series", p.series);
  archive("bands", p.bands);
  archive("references", p.references);
  archive("picks", p.picks);
}

void fields(auto& archive, Is<Probe> auto& p) {
  archive("x", p.x);
  archive("y", p.y);
  archive("label", p.label);
}

void fields(auto& archive, Is<StripField> auto& f) {
  archive("axis", f.axis);
  archive("values", f.values);
}

void fields(auto& archive, Is<Strip> auto& s) {
  archive("title", s.title);
  archive("x", s.x);
  archive("y", s.y);
  archive("radius", s.radius);
  archive("value", s.value);
  archive("value_axis", s.value_axis);
  archive("probes", s.probes);
  archive("times", s.times);
  archive("fields", s.fields);
}

void fields(auto& archive, Is<Figure> auto& f) {
  archive("id", f.id);
  archive("title", f.title);
  archive("caption", f.caption);
  archive("made_by", f.made_by);
  archive("panels", f.panels);
  archive("columns", f.columns);
}

void fields(auto& archive, Is<Column> auto& c) {
  archive("heading", c.heading);
  archive("unit", c.unit);
  archive("digits", c.digits);
}

void fields(auto& archive, Is<Table> auto& t) {
  archive("caption", t.caption);
  archive("columns", t.columns);
  archive("rows", t.rows);
}

void fields(auto& archive, Is<Criterion> auto& c) {
  archive("metric", c.metric);
  archive("actual", c.actual);
  archive("target", c.target);
  archive("lower", c.lower);
  archive("upper", c.upper);
  archive("unit", c.unit);
  archive("derivation", c.derivation);
  archive("state", c.state);
}

void fields(auto& archive, Is<Verdict> auto& v) {
  archive("case_id", v.case_id);
  archive("title", v.title);
  archive("state", v.state);
  archive("reason", v.reason);
  archive("criteria", v.criteria);
  archive("reproduce", v.reproduce);
  archive("facets", v.facets);
}

void fields(auto& archive, Is<Section> auto& s) {
  archive("heading", s.heading);
  archive("paragraphs", s.paragraphs);
  archive("figures", s.figures);
  archive("tables", s.tables);
}

void fields(auto& archive, Is<Report> auto& r) {
  archive("title", r.title);
  archive("findings", r.findings);
  archive("summary", r.summary);
  archive("headlines", r.headlines);
  archive("nights", r.nights);
  archive("verdicts", r.verdicts);
  archive("sections", r.sections);
  archive("provenance", r.provenance);
}

template <class E>
struct Name {
  E value;
  std::string_view name;
};
template <class E>
Name(E, const char*) -> Name<E>;  // Clang 14 finds none of its own for an aggregate

constexpr auto names(Scale) {
  return std::array{Name{Scale::linear, "linear"}, Name{Scale::log, "log"}};
}
constexpr auto names(SeriesKind) {
  return std::array{Name{SeriesKind::line, "line"}, Name{SeriesKind::markers, "markers"},
                    Name{SeriesKind::line_markers, "line_markers"}};
}
constexpr auto names(Dash) {
  return std::array{Name{Dash::solid, "solid"}, Name{Dash::dashed, "dashed"}, Name{Dash::dotted, "dotted"}};
}
constexpr auto names(Direction) {
  return std::array{Name{Direction::horizontal, "horizontal"}, Name{Direction::vertical, "vertical"}};
}
constexpr auto names(Color) {
  return std::array{Name{Color::automatic, "automatic"},
                    Name{Color::blue, "blue"},
                    Name{Color::vermilion, "vermilion"},
                    Name{Color::green, "green"},
                    Name{Color::orange, "orange"},
                    Name{Color::purple, "purple"},
                    Name{Color::sky, "sky"},
                    Name{Color::black, "black"},
                    Name{Color::yellow, "yellow"},
                    Name{Color::grey, "grey"}};
}
constexpr auto names(ColorScale) {
  return std::array{Name{ColorScale::linear, "linear"}, Name{ColorScale::log, "log"},
                    Name{ColorScale::signed_log, "signed_log"}};
}
constexpr auto names(State) {
  return std::array{Name{State::error, "error"},
                    Name{State::fail, "fail"},
                    Name{State::unstable, "unstable"},
                    Name{State::regressed, "regressed"},
                    Name{State::missing, "missing"},
                    Name{State::no_baseline, "no_baseline"},
                    Name{State::skipped, "skipped"},
                    Name{State::unstable_as_expected, "unstable_as_expected"},
                    Name{State::pass, "pass"}};
}

class Writer {
 public:
  Writer(Json& object, const PutArray& put) : object_(object), put_(put) {}

  template <class T>
  void operator()(const char* key, const T& member) {
    Json value = of(member);
    if (!(value.is_array() || value.is_string() || value.is_object()) || !value.empty())
      object_[key] = std::move(value);
  }

 private:
  Json of(const std::string& text) { return text; }
  Json of(double number) { return std::isfinite(number) ? Json(number) : Json(nullptr); }
  Json of(std::size_t number) { return number; }
  Json of(int number) { return number; }
  Json of(const std::vector<double>& values) { return values.empty() ? Json::array() : put_(values); }
  Json of(const Cell& cell) {
    return std::visit([&](const auto& v) { return of(v); }, cell.value);
  }
  Json of(const std::pair<std::string, std::string>& entry) {
    return Json::array({entry.first, entry.second});
  }
  Json of(const Panel& panel) {
    Json object = std::visit([&](const auto& p) { return of(p); }, panel);
    object["type"] = std::holds_alternative<Plot>(panel) ? "plot" : "strip";
    return object;
  }
  template <class T>
  Json of(const std::optional<T>& value) {
    return value ? of(*value) : Json::array();
  }
  template <class T>
  Json of(const std::vector<T>& values) {
    Json array = Json::array();
    for (const T& v : values) array.push_back(of(v));
    return array;
  }
  template <class T>
  Json of(const T& value) {
    if constexpr (std::is_enum_v<T>) {
      for (const auto& n : names(T{}))
        if (n.value == value) return std::string(n.name);
      throw std::logic_error("a report holds an enumerator without a name");
    } else {
      Json object = Json::object();
      Writer writer(object, put_);
      fields(writer, value);
      return object;
    }
  }

  Json& object_;
  const PutArray& put_;
};

class Reader {
 public:
  Reader(const Json& object, const GetArray& get) : object_(object), get_(get) {
    if (!object.is_object()) throw std::invalid_argument("not an object");
  }

  template <class T>
  void operator()(const char* key, T& member) {
    const auto found = object_.find(key);
    if (found == object_.end()) return;
    try {
      take(*found, member);
    } catch (const Json::exception&) {
      throw std::invalid_argument(std::string(key) + ": of another type, or too short");
    } catch (const std::invalid_argument& e) {
      throw std::invalid_argument(std::string(key) + ": " + e.what());
    }
  }

 private:
  void take(const Json& j, std::string& text) { text = j.get<std::string>(); }
  void take(const Json& j, double& number) {
    number = j.is_null() ? std::numeric_limits<double>::quiet_NaN() : j.get<double>();
  }
  void take(const Json& j, std::size_t& number) { number = j.get<std::size_t>(); }
  void take(const Json& j, int& number) { number = j.get<int>(); }
  void take(const Json& j, std::vector<double>& values) { values = get_(j); }
  void take(const Json& j, Cell& cell) {
    if (j.is_string())
      cell = Cell(j.get<std::string>());
    else if (j.is_object())
      take(j, cell.value.emplace<Spark>());
    else
      take(j, cell.value.emplace<double>());
  }
  void take(const Json& j, std::pair<std::string, std::string>& entry) {
    take(j.at(0), entry.first);
    take(j.at(1), entry.second);
  }
  void take(const Json& j, Panel& panel) {
    const std::string type = j.at("type").get<std::string>();
    if (type == "plot")
      take(j, panel.emplace<Plot>());
    else if (type == "strip")
      take(j, panel.emplace<Strip>());
    else
      throw std::invalid_argument("unknown panel '" + type + "'");
  }
  template <class T>
  void take(const Json& j, std::optional<T>& value) {
    take(j, value.emplace());
  }
  template <class T>
  void take(const Json& j, std::vector<T>& values) {
    if (!j.is_array()) throw std::invalid_argument("not an array");
    for (const Json& element : j) take(element, values.emplace_back());
  }
  template <class T>
  void take(const Json& j, T& value) {
    if constexpr (std::is_enum_v<T>) {
      const std::string text = j.get<std::string>();
      for (const auto& n : names(T{}))
        if (n.name == text) return void(value = n.value);
      throw std::invalid_argument("unknown word '" + text + "'");
    } else {
      Reader reader(j, get_);
      fields(reader, value);
    }
  }

  const Json& object_;
  const GetArray& get_;
};

template <class T>
Json written(const T& value, const PutArray& put) {
  Json object = Json::object();
  Writer writer(object, put);
  fields(writer, value);
  return object;
}

}  // namespace

Json to_json(const Report& report, const PutArray& put) {
  return written(report, put);
}

Json to_json(const Figure& figure, const PutArray& put) {
  return written(figure, put);
}

Report report_from_json(const Json& document, const GetArray& get) {
  Report report;
  Reader reader(document, get);
  fields(reader, report);
  return report;
}

}  // namespace ddem::reports
