// Users' meshes: refused, or a mesh of the strip.
#include "tests/fuzz/fuzz.h"
#include "tests/support/strip_meshes.h"

void fuzz(std::string_view text) {
  using namespace ddem;
  for (const meshes::StripSpec& strip : {test::test_strip, test::periodic_test_strip}) {
    try {
      require(test::is_mesh_of(meshes::parse_user_mesh(text, strip), strip));
    } catch (const meshes::MeshError&) {
    }
  }
}
