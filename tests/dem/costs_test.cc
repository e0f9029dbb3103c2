// What a run costs, in numbers that a busy machine does not change: instructions (counted by valgrind, which
// knows AVX2 but not AVX-512) and bytes of the solver's arrays. Bounds of instructions are what g++ 12 makes
// of the kernels, and a tenth: a slower kernel is to be noticed, and a faster one to lower its bound.

#include <gtest/gtest.h>
#include <malloc.h>

#include <array>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <new>
#include <string>

#include "dem/simulation/stepper.h"
#include "tests/support/assemblies.h"

namespace {

std::atomic<long> live_bytes{0}, allocations{0};

void* counted(void* p) {
  if (p == nullptr) throw std::bad_alloc();
  live_bytes += static_cast<long>(malloc_usable_size(p));
  ++allocations;
  return p;
}
void release(void* p) noexcept {
  if (p != nullptr) live_bytes -= static_cast<long>(malloc_usable_size(p));
  std::free(p);
}
std::size_t padded(std::size_t size, std::align_val_t alignment) {
  const auto a = static_cast<std::size_t>(alignment);
  return (size + a - 1) / a * a;
}

}  // namespace

void* operator new(std::size_t size) {
  return counted(std::malloc(size == 0 ? 1 : size));
}
void* operator new(std::size_t size, std::align_val_t a) {
  return counted(std::aligned_alloc(static_cast<std::size_t>(a), padded(size, a)));
}
void operator delete(void* p) noexcept {
  release(p);
}
void operator delete(void* p, std::size_t) noexcept {
  release(p);
}
void operator delete(void* p, std::align_val_t) noexcept {
  release(p);
}
void operator delete(void* p, std::size_t, std::align_val_t) noexcept {
  release(p);
}

namespace ddem {
namespace {

/// All of a stepper: bonds, motion, velocities, and whatever else lives as long as it.
double bytes_per_disc(const Assembly& a, const SimulationInput& in) {
  const long before = live_bytes;
  const auto stepper = std::make_unique<Stepper>(a, in, best_instruction_set());
  return static_cast<double>(live_bytes - before) / static_cast<double>(a.size());
}

SimulationInput shear_input(const Assembly& a) {
  SimulationInput in;
  in.contact = {test::kNormalStiffness, 0.25, Kinematics::linear};
  in.initial.uy = test::Noise(2).vector(a.size(), 1e-9);
  in.time_step = 1e-8;
  return in;
}

TEST(SolverArrays, BytesADisc) {
  const Assembly a = test::hexagonal_assembly(
      {.columns = 100, .rows = 100, .radius = 1e-4, .periodic_x = true, .periodic_y = true});
  SimulationInput in = shear_input(a);
  // Six half-bonds of 20 bytes (normal, neighbour), a motion of 32, velocities of 24, a kick of 8, a place in
  // the order of 4: 188, and 1 % for slices and the object itself.
  EXPECT_LT(bytes_per_disc(a, in), 1.01 * 188.0);
  // Stretch and stiffness of every half-bond.
  in.contact.contact_modulus = test::kNormalStiffness;
  EXPECT_LT(bytes_per_disc(a, in), 1.01 * 284.0);
  in.contact.contact_modulus = 0.0;
  in.contact.stiffness_ratio = 0.0;
  EXPECT_LT(bytes_per_disc(a, in), 1.01 * 180.0);
}

TEST(SolverArrays, AreNotAllocatedInSteps) {
  const Assembly a = test::random_free_strip();
  for (const Scheme scheme : {Scheme::none, Scheme::lagged, Scheme::implicit}) {
    SimulationInput in = shear_input(a);
    in.deformation = {scheme, Correction::full, 4.0 * test::kNormalStiffness, 0.3, Plane::stress};
    in.new_contacts = ContactWatch::bound;
    Stepper stepper(a, in, best_instruction_set());
    const long before = allocations;
    for (long done = 0; done < 50; done += stepper.finish_stage() ? 1 : 0)
      stepper.advance(0);
    EXPECT_EQ(allocations - before, 0) << static_cast<int>(scheme);
  }
}

struct Load {
  const char* law;
  const char* function;
  double bound;  ///< instructions a bond and step; of the wave: all, in millions
};

class Instructions : public testing::TestWithParam<Load> {};

std::string output_of(const std::string& command) {
  std::string text;
  std::array<char, 4096> part;
  FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return text;
  while (std::fgets(part.data(), part.size(), pipe) != nullptr) text += part.data();
  pclose(pipe);
  return text;
}

TEST_P(Instructions, OfAFixedLoad) {
#if !defined(NDEBUG)
  GTEST_SKIP() << "the bounds are those of an optimised build";
#endif
  const std::string valgrind = DDEM_VALGRIND;
  if (valgrind.empty()) GTEST_SKIP() << "valgrind is not installed: instructions are not counted";
  if (best_instruction_set() == InstructionSet::baseline) GTEST_SKIP() << "the bounds are those of AVX2";
  const std::string counter =
      valgrind + " --tool=callgrind --callgrind-out-file=/dev/null --toggle-collect=" + GetParam().function;
  const std::string text = output_of(counter + " '" DDEM_KERNEL_LOAD "' " + GetParam().law + " 2>&1");
  const std::string marker = "Collected : ";
  const std::size_t at = text.find(marker);
  ASSERT_NE(at, std::string::npos) << text;
  const double instructions = std::atof(text.c_str() + at + marker.size());
  // The load's own line is the one that valgrind has not marked.
  std::size_t line = 0;
  while (text.compare(line, 2, "==") == 0) line = text.find('\n', line) + 1;
  const double work = std::atof(text.c_str() + line);
  ASSERT_GT(work, 0.0) << text;
  const double measured = GetParam().law == std::string("wave") ? 1e-6 * instructions : instructions / work;
  RecordProperty("instructions", std::to_string(measured));
  EXPECT_LT(measured, GetParam().bound);
  // Much less would be a load that did not run. The bounds are those of g++ 12; g++ 14 takes 0.59 to 0.69 of them.
#if defined(__GNUC__) && __GNUC__ >= 14
  constexpr double kLeast = 0.5;
#else
  constexpr double kLeast = 0.7;
#endif
  EXPECT_GT(measured, kLeast * GetParam().bound);
}

INSTANTIATE_TEST_SUITE_P(
    Loads, Instructions,
    testing::Values(Load{"dem", "counted_steps", 38.5}, Load{"dem_shear", "counted_steps", 57.7},
                    Load{"dem_shear_per_bond", "counted_steps", 59.6}, Load{"lagged", "counted_steps", 67.7},
                    Load{"lagged_shear", "counted_steps", 104.0}, Load{"implicit", "counted_steps", 168.6},
                    Load{"implicit_shear", "counted_steps", 252.0}, Load{"dem_shear_random", "counted_steps", 60.1},
                    Load{"lagged_shear_random", "counted_steps", 115.5}, Load{"implicit_shear_random", "counted_steps", 272.4},
                    Load{"wave", "counted_wave", 21.3}),
    [](const auto& p) { return std::string(p.param.law); });

}  // namespace
}  // namespace ddem
