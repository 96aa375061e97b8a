#include "control/external/fmu_description.h"

#include <fmt/format.h>

#include <pugixml.hpp>

#include "core/base/errors.h"

namespace ambrig {

namespace {

char TypeOf(const std::string& element) {
  if (element == "Real" || element == "Float64") return 'r';
  if (element == "Integer" || element == "Int32") return 'i';
  if (element == "Int64") return 'l';
  return element == "Boolean" ? 'b' : '\0';
}

}  // namespace

FmuInterface ReadFmuInterface(const std::string& model_description, const std::string& name) {
  pugi::xml_document document;
  const pugi::xml_parse_result parsed = document.load_file(model_description.c_str());
  if (!parsed)
    throw InputError(
        fmt::format("{}: modelDescription.xml cannot be read: {}", name, parsed.description()));
  const pugi::xml_node root = document.child("fmiModelDescription");
  const std::string version = root.attribute("fmiVersion").as_string();
  if (version != "2.0" && !version.starts_with("3."))
    throw InputError(fmt::format("{}: FMI version \"{}\", allowed: 2.0, 3.0", name, version));
  FmuInterface fmu;
  fmu.fmi = version == "2.0" ? 2 : 3;
  fmu.token = root.attribute(fmu.fmi == 2 ? "guid" : "instantiationToken").as_string();
  fmu.identifier = root.child("CoSimulation").attribute("modelIdentifier").as_string();
  if (fmu.identifier.empty() || fmu.identifier.find('/') != std::string::npos)
    throw InputError(name + ": no FMU for co-simulation, allowed: one with <CoSimulation>");
  for (const pugi::xml_node node : root.child("ModelVariables").children()) {
    const pugi::xml_node typed = fmu.fmi == 2 ? node.first_child() : node;
    const char type = TypeOf(typed.name());
    if (type == '\0' || node.child("Dimension")) continue;
    fmu.variables[node.attribute("name").as_string()] = {
        type, node.attribute("valueReference").as_uint(),
        node.attribute("causality").as_string("local")};
  }
  return fmu;
}

}  // namespace ambrig
