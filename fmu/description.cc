#include "fmu/description.h"

#include <fmt/format.h>

#include <cmath>
#include <pugixml.hpp>
#include <set>
#include <sstream>

namespace ambrig {

namespace {

using Type = FmuVariable::Type;
using Role = FmuVariable::Role;

/// As xs:double writes it.
std::string Xml(double value) {
  if (std::isinf(value)) return value > 0 ? "INF" : "-INF";
  return fmt::format("{}", value);
}

std::string StartText(const FmuVariable& v) {
  if (v.type == Type::kBoolean) return v.start != 0 ? "true" : "false";
  if (v.type == Type::kInteger) return fmt::format("{}", static_cast<long long>(v.start));
  return Xml(v.start);
}

const char* Causality(const FmuVariable& v) {
  if (v.role == Role::kTime) return "independent";
  return v.IsParameter() ? "parameter" : v.IsInput() ? "input" : "output";
}

/// Real quantities flow; what acts at a communication point only is discrete, and so is what is no
/// Real. FMI 2.0 lets importers give derivatives of continuous inputs: the speed has one.
const char* Variability(const FmuVariable& v, int fmi) {
  if (v.IsParameter()) return "fixed";
  if (v.type != Type::kReal) return "discrete";
  if (v.IsInput() && (fmi == 2 ? v.role != Role::kSpeed : v.role == Role::kFaultNumber))
    return "discrete";
  return "continuous";
}

void AddUnits(pugi::xml_node root, const std::vector<FmuVariable>& variables) {
  std::set<std::string> names;
  for (const FmuVariable& v : variables)
    if (v.type == Type::kReal && v.unit != "-" && !v.unit.empty()) names.insert(v.unit);
  pugi::xml_node units = root.append_child("UnitDefinitions");
  for (const std::string& name : names)
    units.append_child("Unit").append_attribute("name") = name.c_str();
}

void AddNumbers(pugi::xml_node to, const FmuVariable& v) {
  if (v.type == Type::kReal && v.unit != "-" && !v.unit.empty())
    to.append_attribute("unit") = v.unit.c_str();
  if (v.type != Type::kBoolean) {
    const bool whole = v.type == Type::kInteger;
    const auto text = [&](double x) {
      return whole ? fmt::format("{}", static_cast<long long>(x)) : Xml(x);
    };
    if (std::isfinite(v.lo)) to.append_attribute("min") = text(v.lo).c_str();
    if (std::isfinite(v.hi)) to.append_attribute("max") = text(v.hi).c_str();
  }
  if (!v.IsOutput() && v.role != Role::kTime) to.append_attribute("start") = StartText(v).c_str();
}

void AddNames(pugi::xml_node to, const FmuVariable& v, std::size_t reference, int fmi) {
  to.append_attribute("name") = v.name.c_str();
  to.append_attribute("valueReference") = static_cast<unsigned>(reference);
  to.append_attribute("description") = v.words.c_str();
  to.append_attribute("causality") = Causality(v);
  to.append_attribute("variability") = Variability(v, fmi);
}

void AddVariables2(pugi::xml_node root, const FmuDescription& d) {
  pugi::xml_node list = root.append_child("ModelVariables");
  for (std::size_t k = 1; k < d.variables.size(); ++k) {
    const FmuVariable& v = d.variables[k];
    pugi::xml_node scalar = list.append_child("ScalarVariable");
    AddNames(scalar, v, k, 2);
    if (v.IsParameter()) scalar.append_attribute("initial") = "exact";
    if (v.IsOutput()) scalar.append_attribute("initial") = "calculated";
    AddNumbers(scalar.append_child(v.type == Type::kReal      ? "Real"
                                   : v.type == Type::kInteger ? "Integer"
                                                              : "Boolean"),
               v);
  }
  pugi::xml_node structure = root.append_child("ModelStructure");
  for (const char* part : {"Outputs", "InitialUnknowns"}) {
    pugi::xml_node unknowns = structure.append_child(part);
    for (std::size_t k = 1; k < d.variables.size(); ++k)
      if (d.variables[k].IsOutput())
        unknowns.append_child("Unknown").append_attribute("index") = static_cast<unsigned>(k);
  }
}

void AddVariables3(pugi::xml_node root, const FmuDescription& d) {
  pugi::xml_node list = root.append_child("ModelVariables");
  for (std::size_t k = 0; k < d.variables.size(); ++k) {
    const FmuVariable& v = d.variables[k];
    pugi::xml_node variable = list.append_child(v.type == Type::kReal      ? "Float64"
                                                : v.type == Type::kInteger ? "Int64"
                                                                           : "Boolean");
    AddNames(variable, v, k, 3);
    if (v.IsParameter()) variable.append_attribute("initial") = "exact";
    if (v.IsOutput()) variable.append_attribute("initial") = "calculated";
    AddNumbers(variable, v);
  }
  pugi::xml_node structure = root.append_child("ModelStructure");
  for (const char* part : {"Output", "InitialUnknown"})
    for (std::size_t k = 0; k < d.variables.size(); ++k)
      if (d.variables[k].IsOutput())
        structure.append_child(part).append_attribute("valueReference") = static_cast<unsigned>(k);
}

void AddCoSimulation(pugi::xml_node root, const FmuDescription& d) {
  pugi::xml_node cs = root.append_child("CoSimulation");
  cs.append_attribute("modelIdentifier") = d.identifier.c_str();
  cs.append_attribute("canHandleVariableCommunicationStepSize") = true;
  if (d.fmi == 2) {
    cs.append_attribute("canInterpolateInputs") = true;
    cs.append_attribute("maxOutputDerivativeOrder") = 0;
    cs.append_attribute("canNotUseMemoryManagementFunctions") = true;
    cs.append_attribute("canGetAndSetFMUstate") = true;
    cs.append_attribute("canSerializeFMUstate") = true;
    cs.append_attribute("providesDirectionalDerivative") = false;
  } else {
    cs.append_attribute("canGetAndSetFMUState") = true;
    cs.append_attribute("canSerializeFMUState") = true;
    cs.append_attribute("fixedInternalStepSize") = Xml(d.period).c_str();
    cs.append_attribute("hasEventMode") = false;
  }
}

void AddLogCategories(pugi::xml_node root) {
  pugi::xml_node categories = root.append_child("LogCategories");
  for (const char* name : {"logStatusError", "logEvents"})
    categories.append_child("Category").append_attribute("name") = name;
}

}  // namespace

std::string ModelDescription(const FmuDescription& d) {
  pugi::xml_document document;
  pugi::xml_node declaration = document.append_child(pugi::node_declaration);
  declaration.append_attribute("version") = "1.0";
  declaration.append_attribute("encoding") = "UTF-8";
  pugi::xml_node root = document.append_child("fmiModelDescription");
  root.append_attribute("fmiVersion") = d.fmi == 2 ? "2.0" : "3.0";
  root.append_attribute("modelName") = d.name.c_str();
  root.append_attribute(d.fmi == 2 ? "guid" : "instantiationToken") = d.token.c_str();
  root.append_attribute("description") = "rig with active magnetic bearings";
  root.append_attribute("generationTool") = d.made_by.c_str();
  root.append_attribute("variableNamingConvention") = "flat";
  if (d.fmi == 2) root.append_attribute("numberOfEventIndicators") = 0;
  AddCoSimulation(root, d);
  AddUnits(root, d.variables);
  AddLogCategories(root);
  pugi::xml_node experiment = root.append_child("DefaultExperiment");
  experiment.append_attribute("startTime") = "0";
  experiment.append_attribute("stopTime") = "0.1";
  experiment.append_attribute("stepSize") = Xml(d.step).c_str();
  d.fmi == 2 ? AddVariables2(root, d) : AddVariables3(root, d);
  std::ostringstream out;
  document.save(out, "  ");
  return out.str();
}

}  // namespace ambrig
