#pragma once
/// Nodes and elements of a beam definition: every section end, sleeve end, disk, support and
/// station is a node, shaft pieces are split evenly in between. Elements of three nodes stand
/// here as their two halves, one after the other.
#include "rotor/shaft/beam.h"

namespace ambrig {

/// Every mode of a beam is looked for in dense matrices, whose time grows with the cube of the
/// elements: so many take minutes, six times as many took hours and more memory than machines have.
inline constexpr std::size_t kMostElements = 500;

struct BeamMesh {
  std::vector<double> z;
  std::vector<ShaftElement> elements;
};

/// Checks of one section. Empty when sound, else what is wrong.
std::string SectionProblem(const ShaftSection& section);

/// @throws InputError as BuildBeam, and for more than kMostElements (elements of three nodes count
/// twice).
BeamMesh MakeMesh(const BeamDefinition& definition);

}  // namespace ambrig
