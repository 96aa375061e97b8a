#pragma once
/// What modelDescription.xml of a Functional Mock-up Unit says, as far as a controller needs it
/// (FMI 2.0 and 3.0, co-simulation).
#include <map>
#include <string>

namespace ambrig {

struct FmuInterface {
  /// 'r': Real or Float64; 'i': Integer or Int32; 'l': Int64; 'b': Boolean.
  struct Variable {
    char type = 'r';
    unsigned reference = 0;
    std::string causality;  // input, output, parameter, ...
  };
  int fmi = 2;
  std::string token, identifier;              // guid or instantiationToken; name of the library
  std::map<std::string, Variable> variables;  // scalars of the types above, by name
};

/// @throws InputError "FILE: ..." for what is no FMU for co-simulation.
FmuInterface ReadFmuInterface(const std::string& model_description, const std::string& name);

}  // namespace ambrig
