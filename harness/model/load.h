#pragma once
// From a scene's initial state and drive to initial displacements and driven discs.

#include <optional>

#include "harness/model/held_edges.h"

namespace ddem::harness {

/// Initial displacements and velocities; distances s of a pulse count from the outermost centre on the left.
/// Throws InputError if a state file has not one row a disc, or where the start moves what an edge holds (held_edges.h).
ddem::InitialState initial_state(const Scene& scene, const ddem::Assembly& assembly);

std::optional<EdgeDrive> edge_drive(const Scene& scene, const ddem::Assembly& assembly);

/// Which wave the load sends; empty for a state from files.
std::optional<Wave> wave_of(const Scene& scene);

/// How long the source acts, s: the drive's duration, 0 for an initial state.
double source_duration(const Scene& scene);
/// Where the source's maximum is at time 0, m from the left end (the centre of a gaussian; else 0).
double source_centre(const Scene& scene);
/// How far from that place the source displaces what it acts on, m: three standard widths of a gaussian, the width of a
/// cosine; empty for what displaces the discs of the edge.
std::optional<double> source_reach(const Scene& scene);
/// With its sign, m.
double source_amplitude(const Scene& scene);
/// Half the time in which the pulse passes a place at that speed, s: half the drive's duration, or the profile's half
/// width over the speed (three standard widths of a gaussian). 0 for a released column, which sends no pulse of its own width.
double pulse_half_width(const Scene& scene, double speed);
/// Of the same pulse at half its height, s: half the drive's duration, a cosine's width or 2.35 standard widths over the speed.
double pulse_width(const Scene& scene, double speed);
/// The part of the amplitude that must arrive for a peak to be believed. A released column is a few discs only, whose
/// wave disperses as it travels: the cube root of the distance on the lattice, a twentieth of the amplitude over the
/// strip on random packings without shear stiffness.
double smallest_arrival(const Scene& scene);

}  // namespace ddem::harness
