#include "fem_reference/cases.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <utility>

#include "fem_reference/kernel/gauss_lobatto.h"

namespace ddem::fem {
namespace {

using Json = nlohmann::json;

// What one process can hold: about 200 bytes a degree of freedom while a case is set up.
constexpr double most_degrees_of_freedom = 5e7;

class Problems {
 public:
  void add(const std::string& where, const std::string& what) { lines_.push_back(where + ": " + what); }
  void throw_if_any() const {
    if (!lines_.empty()) throw CaseError(fmt::format("{}", fmt::join(lines_, "\n")));
  }

 private:
  std::vector<std::string> lines_;
};

template <typename Value>
using Choices = std::vector<std::pair<std::string, Value>>;

const Choices<Wave> waves{{"longitudinal", Wave::longitudinal}, {"shear", Wave::shear}};
const Choices<Shape> shapes{
    {"column", Shape::column}, {"cosine", Shape::cosine}, {"gaussian", Shape::gaussian}, {"standing", Shape::standing}};
const Choices<Field> fields{{"displacement", Field::displacement}, {"velocity", Field::velocity}};
const Choices<Integrator> integrators{{"verlet", Integrator::verlet}, {"exact", Integrator::exact}};
const Choices<End> ends{{"free", End::free}, {"fixed_x", End::fixed_x}, {"fixed", End::fixed}};
const Choices<Plane> planes{{"stress", Plane::stress}, {"strain", Plane::strain}};
const Choices<bool> top_bottoms{{"free", false}, {"periodic", true}};

enum class Sign { any, not_negative, positive };

// One JSON object, read key by key. A key that is absent, null or wrong is a problem and reads as a default
// value.
class Table {
 public:
  Table(const Json& object, std::string where, Problems& problems)
      : object_(object), where_(std::move(where)), problems_(problems) {
    if (!object_.is_object()) problem("must be an object {...}");
  }

  // Says which keys of the table nobody asked for.
  void finish() const {
    if (!object_.is_object()) return;
    for (const auto& item : object_.items()) {
      if (!known_.contains(item.key())) {
        problems_.add(key(item.key()), fmt::format("unknown key; known are {}", fmt::join(known_, ", ")));
      }
    }
  }

  // nullptr where the key is absent or null.
  const Json* optional(const std::string& name) {
    known_.insert(name);
    if (!object_.is_object()) return nullptr;
    const auto found = object_.find(name);
    return found == object_.end() || found->is_null() ? nullptr : &*found;
  }

  const Json* required(const std::string& name) {
    const Json* value = optional(name);
    if (value == nullptr && object_.is_object()) problems_.add(key(name), "is missing");
    return value;
  }

  double number(const std::string& name, Sign sign) { return number(required(name), name, sign); }

  double number(const Json* value, const std::string& name, Sign sign) {
    if (value == nullptr) return 1.0;
    if (!value->is_number()) return complain(name, *value, "must be a number", 1.0);
    const double result = value->get<double>();
    if (sign == Sign::positive && !(result > 0.0)) return complain(name, *value, "must be positive", 1.0);
    if (sign == Sign::not_negative && !(result >= 0.0)) {
      return complain(name, *value, "must not be negative", 1.0);
    }
    return result;
  }

  std::uint64_t count(const Json* value, const std::string& name, std::uint64_t most) {
    if (value == nullptr) return 1;
    if (!value->is_number_unsigned() || value->get<std::uint64_t>() < 1 ||
        value->get<std::uint64_t>() > most) {
      return complain(name, *value, fmt::format("must be a whole number from 1 to {}", most),
                      std::uint64_t{1});
    }
    return value->get<std::uint64_t>();
  }

  template <typename Value>
  Value choice(const std::string& name, const Choices<Value>& choices) {
    return choice(required(name), name, choices);
  }

  /// The first of `choices` where the key may be absent, and is.
  template <typename Value>
  Value optional_choice(const std::string& name, const Choices<Value>& choices) {
    return choice(optional(name), name, choices);
  }

  template <typename Value>
  Value choice(const Json* value, const std::string& name, const Choices<Value>& choices) {
    if (value == nullptr) return choices.front().second;
    std::vector<std::string> names;
    for (const auto& [spelling, result] : choices) {
      if (*value == spelling) return result;
      names.push_back('"' + spelling + '"');
    }
    return complain(name, *value, fmt::format("must be one of {}", fmt::join(names, ", ")),
                    choices.front().second);
  }

  std::string key(const std::string& name) const { return where_ + ", " + name; }
  void problem(const std::string& what) const { problems_.add(where_, what); }

  template <typename Value>
  Value complain(const std::string& name, const Json& value, const std::string& what,
                 Value substitute) const {
    std::string shown = value.dump(-1, ' ', false, Json::error_handler_t::replace);
    if (shown.size() > 60) shown = shown.substr(0, 60) + "...";
    problems_.add(key(name), fmt::format("{} {}", shown, what));
    return substitute;
  }

 private:
  const Json& object_;
  std::string where_;
  Problems& problems_;
  std::set<std::string> known_;
};

InitialPulse read_initial(const Json& json, const std::string& where, Problems& problems) {
  Table table(json, where, problems);
  InitialPulse pulse;
  pulse.wave = table.choice("wave", waves);
  pulse.shape = table.choice("shape", shapes);
  pulse.amplitude = table.number("amplitude", Sign::any);
  // A caller may write all keys for every shape; a shape demands only those that it has.
  const auto needs = [&](const char* name, bool needed, Sign sign, double otherwise) {
    const Json* value = needed ? table.required(name) : table.optional(name);
    return value == nullptr ? otherwise : table.number(value, name, needed ? sign : Sign::any);
  };
  pulse.field = table.optional_choice("field", fields);
  pulse.width = needs("width", pulse.shape == Shape::cosine || pulse.shape == Shape::gaussian, Sign::positive, 1.0);
  pulse.spacing = needs("spacing", pulse.shape == Shape::column, Sign::positive, 1.0);
  pulse.center = needs("center", false, Sign::any, 0.0);
  const bool standing = pulse.shape == Shape::standing;
  pulse.phase_speed = needs("phase_speed", standing, Sign::positive, 1.0);
  const Json* half_waves = standing ? table.required("half_waves") : table.optional("half_waves");
  pulse.half_waves = static_cast<unsigned>(table.count(half_waves, "half_waves", 10'000));
  if (standing && pulse.wave != Wave::longitudinal) table.problem("a standing wave is longitudinal");
  if (pulse.amplitude == 0.0) table.problem("amplitude 0: nothing would move");
  table.finish();
  return pulse;
}

EdgeDrive read_drive(const Json& json, const std::string& where, Problems& problems) {
  Table table(json, where, problems);
  EdgeDrive drive;
  drive.wave = table.choice("wave", waves);
  table.choice("shape", Choices<bool>{{"sin2", true}});
  drive.duration = table.number("duration", Sign::positive);
  drive.amplitude = table.number("amplitude", Sign::any);
  if (drive.amplitude == 0.0) table.problem("amplitude 0: nothing would move");
  table.finish();
  return drive;
}

TimeSpan read_time(const Json& json, const std::string& where, Problems& problems) {
  Table table(json, where, problems);
  TimeSpan time;
  time.integrator = table.optional_choice("integrator", integrators);
  const Json* step = table.optional("step");
  const Json* fraction = table.optional("step_fraction");
  if ((step == nullptr) == (fraction == nullptr)) table.problem("needs either step_fraction or step");
  if (step != nullptr) time.step = table.number(step, "step", Sign::positive);
  if (fraction != nullptr) time.step_fraction = table.number(fraction, "step_fraction", Sign::positive);
  if (time.step_fraction > 2.0) {
    table.complain("step_fraction", time.step_fraction, "must be at most 2 (stable up to 1)", 0);
  }
  const Json* end = table.optional("end");
  const Json* steps = table.optional("steps");
  if ((end == nullptr) == (steps == nullptr)) table.problem("needs either end or steps");
  if (end != nullptr) time.end = table.number(end, "end", Sign::positive);
  if (steps != nullptr) time.steps = table.count(steps, "steps", 1'000'000'000);
  table.finish();
  return time;
}

bool lies_within(double value, double size) {
  return value >= 0.0 && value <= size;
}

Receivers read_receivers(const Json& json, const StripCase& strip, const std::string& where,
                         Problems& problems) {
  Table table(json, where, problems);
  Receivers receivers;
  if (const Json* points = table.optional("points")) {
    if (!points->is_array()) table.complain("points", *points, "must be a list of [x, y]", 0);
    for (const Json& point : points->is_array() ? *points : Json::array()) {
      const bool pair = point.is_array() && point.size() == 2 && point[0].is_number() && point[1].is_number();
      if (!pair || !lies_within(point[0].get<double>(), strip.length) ||
          !lies_within(point[1].get<double>(), strip.width)) {
        table.complain("points", point, "must be [x, y] in the strip", 0);
        continue;
      }
      receivers.points.push_back({point[0].get<double>(), point[1].get<double>()});
    }
  }
  if (const Json* sections = table.optional("sections")) {
    if (!sections->is_array()) table.complain("sections", *sections, "must be a list of x", 0);
    for (const Json& x : sections->is_array() ? *sections : Json::array()) {
      if (!x.is_number() || !lies_within(x.get<double>(), strip.length)) {
        table.complain("sections", x, "must be an x in the strip", 0);
        continue;
      }
      receivers.sections.push_back(x.get<double>());
    }
  }
  table.finish();
  return receivers;
}

void read_mesh(Table& table, StripCase& strip) {
  strip.length = table.number("length", Sign::positive);
  strip.width = table.number("width", Sign::positive);
  strip.degree = static_cast<int>(table.count(table.required("degree"), "degree", max_degree));
  strip.elements = {1, 1};
  const Json* elements = table.optional("elements");
  const Json* mesh = table.optional("mesh");
  if ((elements == nullptr) == (mesh == nullptr)) table.problem("needs either elements or mesh");
  if (mesh != nullptr && !mesh->is_string()) table.complain("mesh", *mesh, "must be the name of a file", 0);
  if (mesh != nullptr && mesh->is_string()) strip.mesh = mesh->get<std::string>();
  if (elements == nullptr) return;
  if (!elements->is_array() || elements->size() != 2) {
    table.complain("elements", *elements, "must be [nx, ny]", 0);
    return;
  }
  for (int k = 0; k < 2; ++k) {
    strip.elements[k] = static_cast<unsigned>(table.count(&(*elements)[k], "elements", 1'000'000));
  }
  const std::string excess = excess_of(1.0 * strip.elements[0] * strip.elements[1], strip.degree);
  if (!excess.empty()) table.complain("elements", *elements, excess, 0);
}

void read_material(Table& table, StripCase& strip) {
  strip.young_modulus = table.number("young_modulus", Sign::positive);
  strip.poisson_ratio = table.number("poisson_ratio", Sign::any);
  strip.density = table.number("density", Sign::positive);
  strip.plane = table.choice("plane", planes);
  try {
    plane_material(strip.young_modulus, strip.poisson_ratio, strip.density, strip.plane);
  } catch (const std::invalid_argument& error) {
    table.complain("poisson_ratio", strip.poisson_ratio, error.what(), 0);
  }
}

std::string read_id(Table& table, const std::set<std::string>& taken) {
  const Json* id = table.required("id");
  if (id == nullptr) return {};
  if (!id->is_string()) return table.complain("id", *id, "must be a string", std::string());
  const auto text = id->get<std::string>();
  if (text.empty() || text.find('/') != std::string::npos || text.find('\0') != std::string::npos ||
      text == ".") {
    return table.complain("id", *id, "must be a name without /: it names a group of the signals file", text);
  }
  if (taken.contains(text)) return table.complain("id", *id, "is the id of an earlier case, too", text);
  return text;
}

StripCase read_case(const Json& json, std::size_t index, std::set<std::string>& taken, Problems& problems) {
  std::string name = fmt::format("case {}", index);
  if (json.is_object() && json.contains("id") && json["id"].is_string()) name = "case " + json["id"].dump();
  Table table(json, name, problems);
  StripCase strip;
  strip.id = read_id(table, taken);
  taken.insert(strip.id);
  read_mesh(table, strip);
  read_material(table, strip);
  strip.periodic = table.choice("top_bottom", top_bottoms);
  strip.left = table.optional_choice("left", ends);
  strip.right = table.choice("right", ends);
  const Json* initial = table.optional("initial");
  const Json* drive = table.optional("drive");
  if (initial != nullptr) strip.initial = read_initial(*initial, table.key("initial"), problems);
  if (drive != nullptr) strip.drive = read_drive(*drive, table.key("drive"), problems);
  if (json.is_object() && (initial == nullptr) == (drive == nullptr)) {
    table.problem("needs either initial or drive");
  }
  if (strip.drive && strip.left != End::free) table.problem("left must be \"free\" where a drive moves it");
  if (strip.initial && strip.initial->shape == Shape::standing) {
    const bool own_edges = strip.left == End::fixed_x && strip.right == End::fixed_x && !strip.periodic;
    if (!own_edges) table.problem("a standing wave needs left and right \"fixed_x\" and top_bottom \"free\"");
  }
  if (const Json* time = table.required("time")) strip.time = read_time(*time, table.key("time"), problems);
  if (const Json* receivers = table.required("receivers")) {
    strip.receivers = read_receivers(*receivers, strip, table.key("receivers"), problems);
  }
  strip.sample_every = table.count(table.optional("sample_every"), "sample_every", 1'000'000'000'000);
  if (const Json* snapshots = table.optional("snapshots")) strip.snapshots = table.count(snapshots, "snapshots", 10'000);
  if (strip.snapshots > 0 && strip.time.integrator == Integrator::exact) {
    table.problem("snapshots need the integrator \"verlet\": only receivers are exact in time");
  }
  table.finish();
  return strip;
}

}  // namespace

std::string excess_of(double elements, int degree) {
  const double unknowns = 2.0 * degree * degree * elements;
  if (unknowns <= most_degrees_of_freedom) return {};
  return fmt::format("of degree {} makes {:.2g} degrees of freedom; {:.2g} are the most", degree, unknowns, most_degrees_of_freedom);
}

std::vector<StripCase> parse_cases(const std::string& text) {
  Json json;
  try {
    // What reads and prints a value calls itself for each value inside.
    json = Json::parse(text, [](int depth, Json::parse_event_t, const Json&) {
      if (depth > 100) throw CaseError("not a case file: nested too deeply");
      return true;
    });
  } catch (const Json::parse_error& error) {
    const auto before = text.begin() + static_cast<std::ptrdiff_t>(std::min(error.byte, text.size()));
    throw CaseError(fmt::format("line {}: no JSON", 1 + std::count(text.begin(), before, '\n')));
  } catch (const Json::exception&) {
    throw CaseError("holds a number that is too large");
  }
  Problems problems;
  Table table(json, "case file", problems);
  const Json* schema = table.required("schema");
  if (schema != nullptr && *schema != 1) table.complain("schema", *schema, "must be 1", 0);
  std::vector<StripCase> cases;
  if (const Json* list = table.required("cases")) {
    if (!list->is_array() || list->empty()) table.complain("cases", *list, "must be a list of cases", 0);
    std::set<std::string> taken;
    for (const Json& item : list->is_array() ? *list : Json::array()) {
      cases.push_back(read_case(item, cases.size(), taken, problems));
    }
  }
  table.finish();
  problems.throw_if_any();
  return cases;
}

std::vector<StripCase> read_cases(const std::filesystem::path& file) {
  std::error_code status;
  if (std::filesystem::is_directory(file, status)) throw CaseError("is a directory");
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw CaseError("cannot be read");
  std::ostringstream text;
  text << stream.rdbuf();
  if (stream.bad()) throw CaseError("cannot be read to its end");
  return parse_cases(text.str());
}

}  // namespace ddem::fem
