#pragma once
/// modelDescription.xml of a rig's FMU (FMI 2.0 section 2.2 and 4.3, FMI 3.0 section 2.4 and 4.3).
#include <string>
#include <vector>

#include "fmu/variables.h"

namespace ambrig {

struct FmuDescription {
  int fmi = 2;             // 2: FMI 2.0; 3: FMI 3.0
  std::string name;        // of the rig
  std::string identifier;  // a C identifier, the name of the library
  std::string token;       // tells this FMU from others
  std::string made_by;     // program and version
  double period = 0;       // switching period [s]
  double step = 0;         // proposed communication step [s]
  std::vector<FmuVariable> variables;
};

std::string ModelDescription(const FmuDescription& d);

}  // namespace ambrig
