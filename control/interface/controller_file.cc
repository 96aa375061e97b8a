#include "control/interface/controller_file.h"

#include <fmt/format.h>

#include "control/interface/controller_kind.h"

namespace ambrig {

void ReadControllerKind(const TomlTable& t, const std::vector<std::string>& axes,
                        const std::vector<std::string>& planes, ControllerParameters& c) {
  c.kind = t.Choice("kind", "pid", ControllerKindNames());
  c.where = t.Where("kind");
  const ControllerKind& kind = ControllerKindByName(c.kind);
  if (!kind.per_axis) {
    c.pid = PidParameters{0, 0, 0, 0, kRequired};
    t.Read(c.pid, kForceLimitField);
    if (axes.empty())
      t.Fail("kind", fmt::format("= \"{}\", but every bearing has its own controller; allowed: pid",
                                 c.kind));
  }
  kind.read(t, {axes, planes}, c);
  if (const auto u = t.Table("unbalance")) {
    UnbalanceControlParameters p;
    u->Read(p, kUnbalanceControlFields);
    u->RejectUnknownKeys();
    c.unbalance = p;
  }
}

}  // namespace ambrig
