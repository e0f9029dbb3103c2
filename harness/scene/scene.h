#pragma once
// A scene: everything that a user's scene file says, as plain data in SI units. See keys.cc for every key.

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "dem/core/material.h"

namespace ddem::harness {

// The enumerators stand in the order of the choices in keys.cc.

enum class Axis { x, y };
enum class Walls { periodic, flat };
enum class Cell { copies, whole };
enum class Grading { uniform, log_normal, sieve };

/// [assembly] packing = "random": jammed polydisperse discs in a rectangle.
struct RandomPacking {
  double length = 0.0, width = 0.0;  ///< m
  std::int64_t discs = 682;          ///< given by the file wherever discs are simulated
  std::int64_t seed = 1;
  double radius_ratio = 1.67;  ///< largest over smallest radius
  Walls walls = Walls::periodic;
  Cell cell = Cell::copies;  ///< of more discs than are jammed in a moment
  Grading grading = Grading::uniform;
  std::filesystem::path sieve = {};      ///< CSV radius,passing
  std::optional<double> porosity = {};  ///< without it that at which the discs jam
};

/// Hexagonal packing by its lattice.
struct HexagonalLattice {
  std::int64_t columns = 0, rows = 0;  ///< discs in a row, rows
  double radius = 0.0;                 ///< m
};

/// Hexagonal packing by the rectangle to be filled with about so many discs.
struct HexagonalRectangle {
  double length = 0.0, width = 0.0;  ///< m
  std::int64_t discs = 0;
};

/// [assembly] packing = "hexagonal": touching discs of equal size.
struct HexagonalPacking {
  Axis close_packed_along = Axis::x;
  std::variant<HexagonalLattice, HexagonalRectangle> size;
};

/// [assembly] packing = "file".
struct FilePacking {
  std::filesystem::path discs;          ///< CSV x,y,radius
  std::optional<double> length, width;  ///< m; given wherever they are periods
};

struct BondGap {
  double mean_radii = 0.3;  ///< bonded when gap <= this times the mean radius of the packing
};
struct BondCoordination {
  double bonds_per_disc = 5.8;  ///< the gap is chosen so that a disc has so many bonds on average
};
struct BondFile {
  std::filesystem::path path;  ///< CSV i,j, 0-based
};

struct Periodicity {
  bool x = false, y = false;
};

struct Assembly {
  std::variant<RandomPacking, HexagonalPacking, FilePacking> packing;
  std::variant<BondGap, BondCoordination, BondFile> bonding;
  Periodicity periodic;    ///< assembly.periodic where given, else boundary.top_bottom
  double edge_band = 1.2;  ///< an edge's discs: centre within so many mean radii of the outermost centre
  double thickness = 1.0;  ///< m
};

struct Material {
  double density = 0.0;  ///< of a disc, kg/m3
};

struct NormalStiffness {
  double k_n = 0.0;  ///< N/m, the same for every bond
};
struct ContactModulus {
  double pascal = 0.0;  ///< k_n of a bond in proportion to its size
};

enum class NewContacts { automatic, off };

struct Contact {
  std::variant<NormalStiffness, ContactModulus> stiffness;
  double stiffness_ratio = 0.0;  ///< k_t / k_n
  Kinematics kinematics = Kinematics::linear;
  NewContacts new_contacts = NewContacts::automatic;
};

enum class Edge { free, fixed_x, fixed };

/// The edges at the ends; both free where the assembly is periodic in x.
struct Boundary {
  Edge right = Edge::fixed_x, left = Edge::free;
};

enum class Wave { longitudinal, shear };
enum class PulseShape { column, cosine, gaussian };

/// [initial]: displacement of the discs at the start.
struct InitialPulse {
  Wave wave = Wave::longitudinal;
  PulseShape shape = PulseShape::column;
  double width = 0.0;      ///< m; 0 for a column
  double center = 0.0;     ///< m, from the left end; gaussian only
  double amplitude = 0.0;  ///< m
};

/// [initial]: any state. CSV ux,uy,theta, one row a disc; what is absent is zero.
struct InitialState {
  std::optional<std::filesystem::path> displacement, velocity;
};

enum class DriveShape { sin2 };

/// [drive]: prescribed motion of the left edge.
struct Drive {
  Wave wave = Wave::longitudinal;
  DriveShape shape = DriveShape::sin2;
  double duration = 0.0;   ///< s
  double amplitude = 0.0;  ///< m
};

/// What sets the discs in motion; monostate: nothing (a scene for its moduli).
using Load = std::variant<std::monostate, InitialPulse, InitialState, Drive>;

/// [continuum]: what is absent comes from the assembly's static moduli.
struct Continuum {
  std::optional<double> young_modulus;  ///< Pa
  std::optional<double> poisson_ratio;
  std::optional<double> density;  ///< bulk, kg/m3
  std::int64_t degree = 4;
  std::array<std::int64_t, 2> elements{66, 8};  ///< along x, along y
  Plane plane = Plane::stress;                  ///< strain: E and nu are given, and those of a solid
  std::optional<std::filesystem::path> mesh;    ///< instead of elements
};

enum class Integrator { verlet, exact };

struct StepFraction {
  double of_critical = 0.2;
};
struct StepSeconds {
  double seconds = 0.0;
};
struct UntilLastPeak {};
struct EndTime {
  double seconds = 0.0;
};
struct EndSteps {
  std::int64_t steps = 0;
};

struct Time {
  Integrator integrator = Integrator::verlet;
  std::variant<StepFraction, StepSeconds> step;
  std::variant<UntilLastPeak, EndTime, EndSteps> end;
  std::int64_t sample_every = 1;
  bool allow_above_critical = false;
};

struct ProbePairs {
  std::int64_t pairs = 5;
  bool section = false;  ///< average the discs of a cross-section
};
struct ProbeDiscs {
  std::vector<std::int64_t> discs;  ///< 0-based
};
struct ProbePoints {
  std::vector<std::array<double, 2>> points;  ///< m, from the lower left corner
};
using Probes = std::variant<ProbePairs, ProbeDiscs, ProbePoints>;

struct Run {
  std::int64_t threads = 1;
};

/// Where a key stands in the scene file, and how its value is written.
struct Place {
  int line = 0;
  std::string text;
};

struct Scene {
  std::string title;
  Assembly assembly;
  std::optional<Material> material;        ///< set wherever discs are more than a packing (see Purpose)
  std::optional<Contact> contact;          ///< likewise
  std::optional<DeformationParameters> deformation;  ///< none: plain DEM; its scheme is never Scheme::none
  Boundary boundary;
  Load load;
  std::optional<Continuum> continuum;
  Time time;
  Probes probes;
  Run run;

  std::filesystem::path path;  ///< of the scene file
  std::string source_text;     ///< the scene file itself
  std::map<std::string, Place> places;  ///< by dotted key, of what is written
};

}  // namespace ddem::harness
