/// kind = "transfer-function": one transfer function per axis, force from position error.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>
#include <utility>

#include "control/kinds/read_system.h"
#include "control/position/state_space_controller.h"
#include "core/base/counted.h"

namespace ambrig {

namespace {

std::vector<double> Polynomial(const TomlTable& t, const char* key) {
  const auto p = t.Numbers(key);
  if (p.empty() || p.size() > 41)
    t.Fail(key,
           fmt::format("has {}, allowed: 1 to 41, descending powers", Counted(p.size(), "entry")));
  for (const double v : p)
    if (!std::isfinite(v)) t.Fail(key, "allowed: finite numbers");
  return p;
}

AxisSystem ReadTransfer(const TomlTable& t, const std::vector<std::string>& axes, double rate) {
  AxisSystem a;
  const auto num = Polynomial(t, "numerator"), den = Polynomial(t, "denominator");
  const auto order = [](const std::vector<double>& p) {
    return p.end() - std::find_if(p.begin(), p.end(), [](double v) { return v != 0; });
  };
  if (order(den) == 0) t.Fail("denominator", "is zero, allowed: a number other than 0 in it");
  if (order(num) > order(den))
    t.Fail("numerator",
           "is of a higher power than the denominator, allowed: a proper transfer function");
  a.system = SampledSystem(t, FromTransferFunction(num, den), rate, "s");
  if (t.Has("axes")) a.axes = t.Strings("axes");
  for (const std::string& name : a.axes)
    if (std::find(axes.begin(), axes.end(), name) == axes.end())
      t.Fail("axes", fmt::format("= \"{}\", allowed: {}", name, fmt::join(axes, ", ")));
  t.RejectUnknownKeys();
  return a;
}

void ReadTransferFunction(const TomlTable& t, const ControllerNames& names,
                          ControllerParameters& c) {
  std::set<std::string> named;
  bool rest = false;
  for (const TomlTable& k : t.Tables("transfer")) {
    const AxisSystem a = ReadTransfer(k, names.axes, c.rate);
    if (a.axes.empty() && std::exchange(rest, true))
      k.Fail("axes", "is missing in two of them, allowed: in one, for the axes left");
    for (const std::string& name : a.axes)
      if (!named.insert(name).second)
        k.Fail("axes", fmt::format("= \"{}\" stands twice, allowed: once", name));
    c.transfers.push_back(a);
  }
  for (const std::string& name : names.axes)
    if (!rest && !named.contains(name))
      t.Fail("transfer", fmt::format("has none for axis {}, allowed: [[controller.transfer]] with "
                                     "numerator and denominator for every axis",
                                     name));
}

StateSpace TransfersOf(const ControllerParameters& c, const std::vector<std::string>& names) {
  std::vector<StateSpace> parts;
  for (const std::string& name : names) {
    const AxisSystem* found = nullptr;
    for (const AxisSystem& a : c.transfers)
      if (std::find(a.axes.begin(), a.axes.end(), name) != a.axes.end() ||
          (a.axes.empty() && !found))
        found = &a;
    Require(found != nullptr, "a transfer function for every axis");
    parts.push_back(found->system);
  }
  return Append(parts);
}

std::unique_ptr<PositionController> MakeTransferFunction(const ControllerParameters& c,
                                                         const ControllerSite& site) {
  return std::make_unique<StateSpaceController>(
      std::vector<double>{0}, std::vector<StateSpace>{TransfersOf(c, site.axes)}, site.f_max);
}

}  // namespace

const ControllerKind& TransferFunctionKind() {
  static constexpr ControllerKind kind{
      .name = "transfer-function",
      .doc = "one transfer function per axis",
      .read = ReadTransferFunction,
      .make = MakeTransferFunction,
  };
  return kind;
}

}  // namespace ambrig
