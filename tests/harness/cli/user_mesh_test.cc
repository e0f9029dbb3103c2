// [continuum] mesh: a file of the user's, which is read, not run, and stays.

#include <sys/stat.h>

#include "tests/harness/cli/program.h"
#include "tests/support/strip_meshes.h"

namespace ddem::harness::test {
namespace {

class UserMeshes : public Cli {
 protected:
  void write_scene(const std::string& packing = "", const std::string& more = "") const {
    write("scene.toml", "[assembly]\n" + packing + "length = 0.01\nwidth = 0.002\n[boundary]\ntop_bottom = \"periodic\"\n[drive]\nwave = \"shear\"\n"
                        "duration = 1e-6\namplitude = 1e-6\n[continuum]\nyoung_modulus = 1e10\npoisson_ratio = 0.25\ndensity = 1700\n"
                        "mesh = \"strip.msh\"\n" + more);
  }
  void write_mesh(const std::string& more = "") const { write("strip.msh", ddem::test::msh_text(ddem::test::strip_mesh(20, 4)) + more); }
};

TEST_F(UserMeshes, CarryTheWaveOfEqualElements) {
  write_scene();
  write("strip.msh", ddem::test::msh_text(ddem::test::strip_mesh(20, 4, 0.0)));
  write("elements.toml", replaced(read("scene.toml"), "mesh = \"strip.msh\"", "elements = [20, 4]"));
  const auto speed = [&](const std::string& scene) {
    const SubprocessResult r = ddem({"fem", path(scene)});
    EXPECT_EQ(r.exit_code, 0) << r.standard_error;
    return r.standard_output.substr(std::min(r.standard_output.find("wave speed "), r.standard_output.size()));
  };
  const std::string of_mesh = speed("scene.toml");
  EXPECT_EQ(of_mesh, speed("elements.toml"));
  EXPECT_NE(of_mesh, "");
}

TEST_F(UserMeshes, AreNoOutputs) {
  write_scene("packing = \"random\"\ndiscs = 40\n", "[material]\ndensity = 2000\n[contact]\nnormal_stiffness = 1e9\nstiffness_ratio = 0.3\n");
  write_mesh();
  std::filesystem::create_symlink("strip.msh", in_folder("link"));
  const auto before = contents();
  for (const std::string victim : {"strip.msh", "link"}) {
    for (const std::vector<std::string>& command : {std::vector<std::string>{"fem", "--signals"}, {"fem", "-o"}, {"run", "--signals"}, {"run", "-o"}, {"pack", "-o"}}) {
      const SubprocessResult r = ddem({command[0], path("scene.toml"), command[1], path(victim)});
      EXPECT_EQ(r.exit_code, 2) << command[0] << command[1] << victim;
      EXPECT_THAT(r.standard_error, testing::HasSubstr("would overwrite")) << command[0] << command[1] << victim;
    }
  }
  expect_contents(before);
}

TEST_F(UserMeshes, AreNotRun) {
  const std::string command = "SystemCall \"touch " + path("EXECUTED") + "\";\n";
  write_scene();
  for (const std::string& text : {command, "// $MeshFormat\n" + command}) {
    write("strip.msh", text);
    const SubprocessResult r = ddem({"fem", path("scene.toml")});
    EXPECT_EQ(r.exit_code, 2);
    EXPECT_THAT(r.standard_error, testing::HasSubstr("strip.msh: begins with"));
  }
  // Options beside a mesh with a view; text that pretends to be a section.
  write("strip.msh.opt", command);
  for (const std::string& more : {std::string("$NodeData\n1\n\"T\"\n1\n0.0\n3\n0\n1\n1\n1 0.5\n$EndNodeData\n"), "$Comments\n" + command + "$EndComments\n"}) {
    write_mesh(more);
    EXPECT_EQ(ddem({"fem", path("scene.toml")}).exit_code, 0);
  }
  write_mesh(command);
  EXPECT_EQ(ddem({"fem", path("scene.toml")}).exit_code, 2);
  EXPECT_FALSE(std::filesystem::exists(in_folder("EXECUTED")));
}

TEST_F(UserMeshes, AreRefusedInOneLineThatNamesThem) {
  write_scene();
  write("strip.msh", "");
  const auto expect_line = [&](const char* reason) {
    const SubprocessResult r = ddem({"fem", path("scene.toml"), "--signals", path("signals.csv")});
    EXPECT_EQ(r.exit_code, 2);
    EXPECT_THAT(r.standard_error, testing::HasSubstr("strip.msh: "));
    EXPECT_THAT(r.standard_error, testing::HasSubstr(reason));
    EXPECT_EQ(std::count(r.standard_error.begin(), r.standard_error.end(), '\n'), 1) << r.standard_error;
    EXPECT_EQ(r.standard_output, "");
  };
  expect_line("is empty");
  auto mesh = ddem::test::strip_mesh(20, 4);
  std::swap(mesh.names[7], mesh.names[9]);
  write("strip.msh", ddem::test::msh_text(mesh));
  expect_line("which lies on the");
  std::filesystem::remove(in_folder("strip.msh"));
  ASSERT_EQ(::mkfifo(in_folder("strip.msh").c_str(), 0600), 0);
  const SubprocessResult pipe = ddem({"fem", path("scene.toml")});
  EXPECT_EQ(pipe.exit_code, 2);
  EXPECT_THAT(pipe.standard_error, testing::HasSubstr("strip.msh is a device or a pipe"));
  std::filesystem::remove(in_folder("strip.msh"));
  EXPECT_FALSE(std::filesystem::exists(in_folder("signals.csv")));
}

}  // namespace
}  // namespace ddem::harness::test
