#pragma once
// gmsh as long as it is needed: no user's configuration, no output, signals and exit left to the program.

#include <gmsh.h>

#include <stdexcept>
#include <string>

namespace ddem::meshes {

class GmshSession {
 public:
  GmshSession() {
    gmsh::initialize(0, nullptr, false);
    gmsh::option::setNumber("General.Terminal", 0);
    gmsh::option::setNumber("General.AbortOnError", 2);
    gmsh::option::setNumber("Mesh.MshFileVersion", 4.1);
    gmsh::option::setNumber("Mesh.Binary", 0);
  }
  ~GmshSession() { gmsh::finalize(); }
  GmshSession(const GmshSession&) = delete;
  GmshSession& operator=(const GmshSession&) = delete;
};

/// Calls `work` in a session; what gmsh throws becomes an `Error` with its reason. Errors of `work` itself pass.
template <typename Error, typename Work>
auto with_gmsh(const Work& work) {
  try {
    const GmshSession session;
    return work();
  } catch (const Error&) {
    throw;
  } catch (const std::exception& error) {
    throw Error(std::string("gmsh: ") + error.what());
  } catch (const std::string& reason) {  // older interfaces throw strings
    throw Error("gmsh: " + reason);
  } catch (int code) {
    throw Error("gmsh failed with code " + std::to_string(code));
  }
}

}  // namespace ddem::meshes
