#pragma once
/// The nodes of a ROSS file and where they lie. A shaft's elements are numbered by their left node;
/// where a number is missing a shaft ends and another begins: after a coupling element in line with
/// it, else where a bearing between both (n, n_link) puts it, else with its left end at 0.
#include <string>
#include <vector>

#include "rotor/shaft/ross_elements.h"
#include "rotor/shaft/several_shafts.h"

namespace ambrig {

bool IsRossShaft(const RossElement& e);
bool IsRossCoupling(const RossElement& e);
/// Disks and gears, which are disks here.
bool IsRossDisk(const RossElement& e);

class RossNodes {
 public:
  /// @throws InputError naming file and node.
  RossNodes(const std::vector<RossElement>& elements, const std::string& file);

  /// Place on the machine's axis [m]. @throws InputError when the node is not on a shaft.
  double At(const RossElement& e) const { return At(e, e.Node()); }
  double At(const RossElement& e, int node) const;
  /// Name of the node's shaft, "" where there is one alone.
  std::string ShaftOf(int node) const;
  int size() const { return static_cast<int>(z_.size()); }
  bool on_shaft(int node) const { return node < size(); }
  std::vector<PlacedShaft> shafts() const;

 private:
  std::vector<double> z_;
  std::vector<int> shaft_;  // index, per node
};

}  // namespace ambrig
