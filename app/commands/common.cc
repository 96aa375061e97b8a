#include <unistd.h>

#include "app/commands/commands.h"
#include "core/base/atomic_file.h"

namespace ambrig {

void CommonOptions::AddTo(CLI::App& command) {
  command.add_option("--json", json, "write the result as JSON to FILE")->type_name("FILE");
  command.add_option("--html", html, "write the report as one HTML file to FILE")->type_name("FILE");
}

void CommonOptions::WriteJson(const nlohmann::ordered_json& document) const {
  if (!json.empty()) WriteFileAtomically(json, document.dump(2) + "\n");
}

bool ColourTerminal() { return isatty(STDOUT_FILENO) != 0 && std::getenv("NO_COLOR") == nullptr; }

std::string Coloured(const std::string& text, const char* colour) {
  if (!ColourTerminal()) return text;
  const std::string c = colour;
  const char* code = c == "green" ? "32" : c == "red" ? "31" : c == "yellow" ? "33" : "1";
  return std::string("\033[") + code + "m" + text + "\033[0m";
}

}  // namespace ambrig
