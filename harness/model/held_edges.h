#pragma once
// Which discs the edges of a scene are, what they hold, and that nothing moves it at the start: held means held, from the first instant.

#include "dem/simulation/simulation.h"
#include "harness/scene/csv.h"
#include "harness/scene/scene.h"

namespace ddem::harness {

/// Of the network: rattlers are no part of its edges.
std::vector<int> discs_of_edge(const Scene& scene, const ddem::Assembly& assembly, ddem::Edge edge);

/// Held edges: fixed_x holds u_x, fixed holds u_x, u_y and the rotation.
HeldDofs held_dofs(const Scene& scene, const ddem::Assembly& assembly);

/// `u`: what the pulse displaces, one value a disc. Below a millionth of the amplitude, where the tail of a gaussian ends for
/// any purpose, held discs are put to rest. Throws InputError where they are displaced by more.
void settle_held_discs(const Scene& scene, const ddem::Assembly& assembly, const InitialPulse& pulse, std::vector<double>& u);

/// The same of a state from a file, initial.displacement or initial.velocity, whose numbers mean what they say: only round-off
/// (1e-12 of the column's largest) is put to rest. The error names file, line, disc and edge, for twenty discs at most.
void settle_held_discs(const Scene& scene, const ddem::Assembly& assembly, const std::string& key, const std::filesystem::path& file,
                       StateTable& state);

/// The same of a pulse in the continuum, between ends at s = 0 and `length`; what is below a millionth, fixed nodes leave out.
void check_held_ends(const Scene& scene, const InitialPulse& pulse, double length);

/// Throws InputError where a driven disc is held in the direction of the drive by the other edge, too.
void check_held_drive(const Scene& scene, const ddem::Assembly& assembly, const EdgeDrive& drive);

/// Throws InputError where a pulse lies beside the strip, whose ends are at s = 0 and `length`: nothing would move.
void require_inside(const Scene& scene, const InitialPulse& pulse, double length);

/// Displacement at a distance s from the left end; not of a column, which is made of discs.
double pulse_at(const InitialPulse& pulse, double s);

}  // namespace ddem::harness
