#pragma once
/// Several shafts of one rotor, inside one another or in line. They turn at one speed and
/// are held together by supports between planes of two shafts. So that a place is one number, the
/// nodes of all shafts lie on one axis, shaft after shaft with gaps between; there z = place on the
/// machine's axis + `shift`. Elements across a gap hold nothing.
#include <string>
#include <vector>

namespace ambrig {

struct PlacedShaft {
  std::string name;
  double z = 0;      // left end on the machine's axis [m]
  double start = 0;  // left end on the axis of nodes [m]
  double shift() const { return start - z; }
};

/// The shaft at a place on the axis of nodes, null of a rotor with one shaft.
const PlacedShaft* ShaftAt(const std::vector<PlacedShaft>& shafts, double z);

/// The place on the machine's axis.
double PlaceOf(const std::vector<PlacedShaft>& shafts, double z);

/// "z = 0.3 m", or "z = 0.3 m of outer".
std::string PlaceText(const std::vector<PlacedShaft>& shafts, double z);

struct BeamDefinition;

/// Puts a definition whose parts stand at their places on the machine's axis, each with the name
/// of its shaft, on the axis of nodes. `shafts` has names and left ends. @throws InputError for a
/// shaft without a section.
void LayOutShafts(BeamDefinition& definition);

/// Places on the axis of nodes from a place on a shaft.
double NodePlace(const std::vector<PlacedShaft>& shafts, const std::string& shaft, double z);

}  // namespace ambrig
