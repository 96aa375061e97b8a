#pragma once
/// Nodes and elements of a beam definition: every section end, sleeve end, disk, support and
/// station is a node, shaft pieces are split evenly in between. Elements of three nodes stand here as their
/// two halves, one after the other.
#include "rotor/shaft/beam.h"

namespace ambrig {

struct BeamMesh {
  std::vector<double> z;
  std::vector<ShaftElement> elements;
};

/// Checks of one section. Empty when sound, else what is wrong.
std::string SectionProblem(const ShaftSection& section);

/// @throws InputError as BuildBeam.
BeamMesh MakeMesh(const BeamDefinition& definition);

}  // namespace ambrig
