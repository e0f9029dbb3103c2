#include "meshes/msh_file.h"

#include <fmt/format.h>

#include <cstdlib>
#include <utility>

#include "meshes/msh_source.h"

namespace ddem::meshes {
namespace {

using Tag = MshFile::Tag;
enum class Version { v2_2, v4_0, v4_1 };

struct ElementType {
  std::int64_t id;  ///< gmsh's
  unsigned corners, nodes;
};
constexpr ElementType known_types[] = {{15, 1, 1}, {1, 2, 2},  {8, 2, 3},  {26, 2, 4},  {27, 2, 5},
                                       {3, 4, 4},  {16, 4, 8}, {10, 4, 9}, {36, 4, 16}, {37, 4, 25}};

class Parser {
 public:
  explicit Parser(std::string_view bytes) : source_(bytes) {}

  MshFile parse() {
    read_format();
    while (!source_.at_end()) read_section(std::string(source_.word()));
    for (const char* name : {"$Nodes", "$Elements"}) {
      if (!seen_.contains(name)) source_.fail(fmt::format("the file ends without {}", name));
    }
    for (const auto& [curve, groups] : curve_groups_) {
      for (const std::int64_t group : groups) {
        if (names_.contains(group)) file_.curve_names[curve].insert(names_[group]);
      }
    }
    return std::move(file_);
  }

 private:
  void read_format() {
    source_.expect("$MeshFormat");
    const std::string version(source_.word());
    if (version == "2.2") {
      version_ = Version::v2_2;
    } else if (version == "4" || version == "4.0") {
      version_ = Version::v4_0;
    } else if (version != "4.1") {
      source_.fail(fmt::format("format {}: formats 4.1, 4 and 2.2 are read; save it with gmsh -save -format msh41", printable(version)));
    }
    const std::int64_t binary = source_.whole();
    if (binary != 0 && binary != 1) source_.fail("the file type is 0 (text) or 1 (bytes)");
    if (binary == 1 && version_ == Version::v4_0) source_.fail("format 4 in bytes: save it as text, or in format 4.1");
    if (source_.whole() != 8) source_.fail("numbers must be of 8 bytes");
    if (binary == 1) {
      source_.use_bytes();
      source_.begin_data();
      if (source_.data_int() != 1) source_.fail("written by a machine with another order of bytes: save it as text");
    }
    source_.expect("$EndMeshFormat");
  }

  void read_section(const std::string& name) {
    if (!name.starts_with('$')) source_.fail(fmt::format("\"{}\" stands where a section such as $Nodes should", printable(name)));
    const std::string end = "$End" + name.substr(1);
    const bool first = seen_.insert(name).second;
    if (name == "$PartitionedEntities") source_.fail("the mesh is in partitions: save it whole");
    if (name == "$ParametricNodes") source_.fail("nodes with parameters: save it with Mesh.SaveParametric = 0");
    const std::pair<const char*, void (Parser::*)()> readers[] = {{"$PhysicalNames", &Parser::read_names},
                                                                  {"$Entities", &Parser::read_entities},
                                                                  {"$Nodes", &Parser::read_nodes},
                                                                  {"$Elements", &Parser::read_elements}};
    for (const auto& [section, read] : readers) {
      if (name != section) continue;
      if (!first) source_.fail(fmt::format("a second {}", name));
      (this->*read)();
      return source_.expect(end);
    }
    source_.skip_past(end);
  }

  void read_names() {
    const std::int64_t count = source_.whole();
    for (std::int64_t k = 0; k < count; ++k) {
      const std::int64_t dimension = source_.whole(), group = source_.whole();
      const std::string_view text = source_.rest_of_line();
      const std::size_t first = text.find('"'), last = text.rfind('"');
      if (first == last) source_.fail("a name in quotes is missing");
      if (dimension == 1) names_[group] = std::string(text.substr(first + 1, last - first - 1));
    }
  }

  void skip_reals(unsigned count) {
    for (unsigned k = 0; k < count; ++k) source_.data_real();
  }

  // Points, curves, surfaces and volumes of the geometry, each with its physical groups.
  void read_entities() {
    source_.begin_data();
    std::array<std::uint64_t, 4> counts{};
    for (auto& count : counts) count = source_.data_size();
    for (unsigned dimension = 0; dimension < 4; ++dimension) {
      for (std::uint64_t k = 0; k < counts[dimension]; ++k) {
        const std::int64_t entity = source_.data_int();
        skip_reals(dimension == 0 && version_ == Version::v4_1 ? 3 : 6);
        const std::uint64_t groups = source_.data_size();
        for (std::uint64_t g = 0; g < groups; ++g) {
          const std::int64_t group = std::abs(source_.data_int());  // negative: the curve runs the other way
          if (dimension == 1) curve_groups_[entity].insert(group);
        }
        if (dimension == 0) continue;
        const std::uint64_t bounds = source_.data_size();
        for (std::uint64_t b = 0; b < bounds; ++b) source_.data_int();
      }
    }
  }

  void add_node(Tag tag) {
    std::array<double, 3> place{};
    for (double& coordinate : place) coordinate = source_.data_real();
    if (!file_.nodes.emplace(tag, place).second) source_.fail(fmt::format("a second node {}", tag));
  }

  void read_nodes() {
    if (version_ == Version::v2_2) {
      const std::int64_t count = source_.whole();
      source_.begin_data();
      for (std::int64_t k = 0; k < count; ++k) add_node(static_cast<Tag>(source_.data_int()));
      return;
    }
    source_.begin_data();
    const std::uint64_t blocks = source_.data_size(), count = source_.data_size();
    if (version_ == Version::v4_1) skip_sizes(2);
    for (std::uint64_t b = 0; b < blocks; ++b) read_node_block();
    if (file_.nodes.size() != count) source_.fail(fmt::format("{} nodes instead of {}", file_.nodes.size(), count));
  }

  void read_node_block() {
    std::int64_t dimension = source_.data_int(), entity = source_.data_int();
    if (version_ == Version::v4_0) std::swap(dimension, entity);
    const std::int64_t parametric = source_.data_int();
    const std::uint64_t count = source_.data_size();
    if (dimension < 0 || dimension > 3) source_.fail(fmt::format("an entity of dimension {}", dimension));
    const unsigned parameters = parametric != 0 ? static_cast<unsigned>(dimension) : 0;
    std::vector<Tag> tags;
    if (version_ == Version::v4_1) {
      for (std::uint64_t k = 0; k < count; ++k) tags.push_back(source_.data_size());
    }
    for (std::uint64_t k = 0; k < count; ++k) {
      add_node(version_ == Version::v4_1 ? tags[k] : static_cast<Tag>(source_.data_int()));
      skip_reals(parameters);
    }
  }

  void skip_sizes(unsigned count) {
    for (unsigned k = 0; k < count; ++k) source_.data_size();
  }

  void read_elements() {
    if (version_ == Version::v2_2) return read_old_elements();
    source_.begin_data();
    const std::uint64_t blocks = source_.data_size(), count = source_.data_size();
    if (version_ == Version::v4_1) skip_sizes(2);
    std::uint64_t found = 0;
    for (std::uint64_t b = 0; b < blocks; ++b) {
      std::int64_t dimension = source_.data_int(), entity = source_.data_int();
      if (version_ == Version::v4_0) std::swap(dimension, entity);
      const std::int64_t type = source_.data_int();
      const std::uint64_t in_block = source_.data_size();
      for (std::uint64_t k = 0; k < in_block; ++k, ++found) {
        const Tag tag = element_node();
        add_element(tag, type, entity, entity);
      }
    }
    if (found != count) source_.fail(fmt::format("{} elements instead of {}", found, count));
  }

  // Each with its own groups: the first of its tags is the physical one, the second the geometry's.
  void read_old_elements() {
    const std::int64_t count = source_.whole();
    source_.begin_data();
    const auto read_one = [&](Tag tag, std::int64_t type, std::int64_t tags) {
      std::int64_t group = 0, entity = 0;
      for (std::int64_t k = 0; k < tags; ++k) {
        const std::int64_t value = source_.data_int();
        if (k == 0) group = std::abs(value);
        if (k == 1) entity = value;
      }
      curve_groups_[group].insert(group);
      add_element(tag, type, group, entity);
    };
    for (std::int64_t done = 0; done < count;) {
      if (source_.binary()) {
        const std::int64_t type = source_.data_int(), in_block = source_.data_int(), tags = source_.data_int();
        if (in_block < 1 || in_block > count - done) source_.fail(fmt::format("a block of {} elements", in_block));
        for (std::int64_t k = 0; k < in_block; ++k) read_one(static_cast<Tag>(source_.data_int()), type, tags);
        done += in_block;
      } else {
        const std::int64_t tag = source_.whole(), type = source_.whole();
        read_one(static_cast<Tag>(tag), type, source_.whole());
        ++done;
      }
    }
  }

  Tag element_node() { return version_ == Version::v4_1 ? source_.data_size() : static_cast<Tag>(source_.data_int()); }

  void add_element(Tag tag, std::int64_t id, std::int64_t curve, std::int64_t surface) {
    const ElementType* type = nullptr;
    for (const ElementType& known : known_types) {
      if (known.id == id) type = &known;
    }
    if (type == nullptr) {
      const char* what = id == 2 || id == 9 ? "is a triangle" : "is neither a line nor a quadrilateral";
      source_.fail(fmt::format("element {} (gmsh's type {}) {}: a mesh must consist of quadrilaterals (gmsh: Recombine Surface)", tag, id, what));
    }
    std::array<Tag, 4> corners{};
    for (unsigned k = 0; k < type->nodes; ++k) {
      const Tag node = element_node();
      if (!file_.nodes.contains(node)) source_.fail(fmt::format("element {} has a node {}, which the file does not hold", tag, node));
      if (k < type->corners) corners[k] = node;
    }
    if (type->corners == 2) file_.lines.push_back({tag, {corners[0], corners[1]}, curve});
    if (type->corners == 4) file_.quads.push_back({tag, corners, surface});
  }

  MshSource source_;
  Version version_ = Version::v4_1;
  std::set<std::string> seen_;
  std::map<std::int64_t, std::string> names_;                     ///< of physical curves
  std::map<std::int64_t, std::set<std::int64_t>> curve_groups_;  ///< of a curve; of format 2.2 a group is its curve
  MshFile file_;
};

}  // namespace

MshFile parse_msh(std::string_view bytes) {
  return Parser(bytes).parse();
}

}  // namespace ddem::meshes
