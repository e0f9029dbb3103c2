#include "meshes/user_mesh.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <string>

#include "meshes/mesh_draft.h"
#include "meshes/msh_file.h"
#include "meshes/msh_source.h"
#include "meshes/outline.h"
#include "meshes/periodic_edges.h"
#include "meshes/quad_shapes.h"

namespace ddem::meshes {
namespace {

constexpr std::string_view first_word = "$MeshFormat";
constexpr off_t largest_file = off_t{1} << 31;

class Descriptor {
 public:
  // Not to wait for the other end of a pipe.
  explicit Descriptor(const std::filesystem::path& file) : id_(::open(file.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC)) {}
  ~Descriptor() {
    if (id_ >= 0) ::close(id_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int id() const { return id_; }

 private:
  int id_;
};

// No more than its first word of what is no mesh.
std::string read_bytes(const std::filesystem::path& file) {
  const Descriptor descriptor(file);
  if (descriptor.id() < 0) throw MeshError(errno == ENOENT ? "is no file" : fmt::format("cannot be read: {}", std::strerror(errno)));
  struct stat status {};
  if (::fstat(descriptor.id(), &status) != 0 || !S_ISREG(status.st_mode)) throw MeshError("is no file");
  if (status.st_size == 0) throw MeshError("is empty");
  if (status.st_size > largest_file) throw MeshError("is larger than 2 GiB");
  std::string bytes;
  std::size_t wanted = first_word.size();
  for (ssize_t got = 1; got > 0 && bytes.size() < wanted;) {
    const std::size_t have = bytes.size();
    bytes.resize(wanted);
    got = ::read(descriptor.id(), bytes.data() + have, wanted - have);
    if (got < 0) throw MeshError(fmt::format("cannot be read: {}", std::strerror(errno)));
    bytes.resize(have + static_cast<std::size_t>(got));
    if (bytes == first_word) wanted = static_cast<std::size_t>(status.st_size);
  }
  return bytes;
}

// Of the nodes that elements have; others are points of construction.
MeshDraft draft_of(const MshFile& file) {
  MeshDraft draft;
  std::map<MshFile::Tag, unsigned> number;
  for (const MshFile::Quad& quad : file.quads) {
    auto& corners = draft.mesh.quads.emplace_back();
    for (int k = 0; k < 4; ++k) {
      const auto [entry, fresh] = number.try_emplace(quad.corners[k], static_cast<unsigned>(draft.mesh.vertices.size()));
      corners[k] = entry->second;
      if (!fresh) continue;
      const auto& place = file.nodes.at(quad.corners[k]);
      draft.node_tags.push_back(quad.corners[k]);
      draft.mesh.vertices.push_back({place[0], place[1]});
    }
    draft.quad_tags.push_back(quad.tag);
    draft.surfaces.push_back(quad.surface);
  }
  return draft;
}

std::string size_remedy(const QuadMesh& mesh, const StripSpec& strip) {
  const double factor = mesh.width / strip.width;
  const auto near = [](double a, double b) { return std::abs(a - b) <= 1e-3 * std::abs(b); };
  if (!near(mesh.length / strip.length, factor) || near(factor, 1.0)) return "";
  return fmt::format("; all of it is {:.3g} times as large: coordinates are metres (gmsh: Mesh.ScalingFactor = {:.3g})", factor, 1.0 / factor);
}

// Coordinates from the lower left corner, and those on a side exactly so.
void place_on_strip(MeshDraft& draft, const StripSpec& strip) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  QuadMesh& mesh = draft.mesh;
  std::array<double, 2> low{infinity, infinity}, high{-infinity, -infinity};
  for (const auto& vertex : mesh.vertices) {
    for (int c = 0; c < 2; ++c) {
      low[c] = std::min(low[c], vertex[c]);
      high[c] = std::max(high[c], vertex[c]);
    }
  }
  draft.origin = low;
  mesh.length = high[0] - low[0];
  mesh.width = high[1] - low[1];
  const bool fits = std::abs(mesh.length - strip.length) <= side_tolerance * strip.length &&
                    std::abs(mesh.width - strip.width) <= side_tolerance * strip.width;
  if (!fits) {
    throw MeshError(fmt::format("is {:.9g} m long and {:.9g} m wide, the strip {:.9g} m and {:.9g} m{}", mesh.length, mesh.width,
                                strip.length, strip.width, size_remedy(mesh, strip)));
  }
  const double tolerance = side_tolerance * mesh.width;
  for (auto& vertex : mesh.vertices) {
    for (int c = 0; c < 2; ++c) {
      const double size = c == 0 ? mesh.length : mesh.width;
      vertex[c] -= low[c];
      if (vertex[c] <= tolerance) vertex[c] = 0.0;
      if (vertex[c] >= size - tolerance) vertex[c] = size;
    }
  }
}

void check_plane(const MeshDraft& draft, const MshFile& file, const StripSpec& strip) {
  Findings findings;
  for (unsigned v = 0; v < draft.node_tags.size(); ++v) {
    const double z = file.nodes.at(draft.node_tags[v])[2];
    if (std::abs(z) <= side_tolerance * strip.width) continue;
    findings.add("z", [&] { return fmt::format("node {} at {} has z = {:.6g} m: the strip lies in the plane z = 0", draft.node_tags[v], draft.place(v), z); });
  }
  findings.throw_if_any();
}

}  // namespace

QuadMesh parse_user_mesh(std::string_view bytes, const StripSpec& strip) {
  if (!bytes.starts_with(first_word)) {
    throw MeshError(fmt::format("begins with \"{}\" instead of {}: this is no mesh of gmsh (of a .geo file, gmsh -2 makes one)",
                                printable(bytes.substr(0, first_word.size())), first_word));
  }
  const MshFile file = parse_msh(bytes);
  if (file.quads.empty()) throw MeshError("holds no quadrilaterals (where there are physical groups gmsh saves no more than them: make the surface one, too)");
  MeshDraft draft = draft_of(file);
  check_plane(draft, file, strip);
  place_on_strip(draft, strip);
  check_quads(draft);
  check_outline(draft, file);
  if (strip.periodic) match_periodic_edges(draft);
  return std::move(draft.mesh);
}

QuadMesh read_user_mesh(const std::filesystem::path& file, const StripSpec& strip) {
  return parse_user_mesh(read_bytes(file), strip);
}

}  // namespace ddem::meshes
