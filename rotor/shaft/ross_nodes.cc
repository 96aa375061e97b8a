#include "rotor/shaft/ross_nodes.h"

#include <map>

namespace ambrig {

namespace {

constexpr double kRossCouplingLength = 0.2;  // [m], ROSS's own where none is given

std::string RossShaftName(int index) { return fmt::format("shaft{}", index + 1); }

/// Length of the shaft elements by their left node.
std::map<int, double> LengthsByNode(const std::vector<RossElement>& elements,
                                    const std::string& file) {
  std::map<int, double> length;
  for (const RossElement& e : elements) {
    if (!IsRossShaft(e)) continue;
    const auto [it, fresh] = length.emplace(e.Node(), e.Get("L"));
    if (!fresh && std::abs(it->second - e.Get("L")) > 1e-9 * it->second)
      e.Fail("L differs from another shaft element at the same n");
  }
  if (length.empty())
    throw InputError(
        fmt::format("{}: no shaft element, allowed: a file saved by ROSS's Rotor.save", file));
  return length;
}

}  // namespace

bool IsRossShaft(const RossElement& e) {
  return e.kind == "ShaftElement" || e.kind == "ShaftElement6DoF";
}

bool IsRossCoupling(const RossElement& e) { return e.kind.find("CouplingElement") == 0; }

bool IsRossDisk(const RossElement& e) {
  return e.kind == "DiskElement" || e.kind == "DiskElement6DoF" || e.kind.find("GearElement") == 0;
}

RossNodes::RossNodes(const std::vector<RossElement>& elements, const std::string& file) {
  const std::map<int, double> length = LengthsByNode(elements, file);
  std::map<int, const RossElement*> couplings;
  for (const RossElement& e : elements)
    if (IsRossCoupling(e)) couplings[e.Node()] = &e;
  const int last = length.rbegin()->first + 1;  // couplings that no shaft follows lie beyond
  if (!length.count(0)) throw InputError(fmt::format("{}: no shaft element with n = 0", file));
  z_ = {0};
  shaft_ = {0};
  std::vector<bool> placed = {true};
  for (int n = 0; n < last; ++n) {
    const auto element = length.find(n);
    const auto coupling = couplings.find(n);
    const bool joined = element != length.end();
    shaft_.push_back(shaft_.back() + (joined ? 0 : 1));
    if (!joined) placed.push_back(coupling != couplings.end());
    z_.push_back(joined ? z_.back() + element->second
                 : coupling != couplings.end()
                     ? z_.back() + coupling->second->Get("L", kRossCouplingLength)
                     : 0.0);
    if (!joined && !length.count(n + 1))
      throw InputError(fmt::format("{}: no shaft element with n = {}", file, n));
  }
  for (int shaft = 1; shaft <= shaft_.back(); ++shaft) {
    if (placed[static_cast<std::size_t>(shaft)]) continue;
    double shift = 0;
    for (const RossElement& e : elements) {
      if (!e.Has("n_link") || !e.Has("n")) continue;
      const int a = e.Node(), b = static_cast<int>(e.Get("n_link"));
      if (!on_shaft(a) || !on_shaft(b)) continue;
      const auto i = static_cast<std::size_t>(a), k = static_cast<std::size_t>(b);
      if (shaft_[k] == shaft && shaft_[i] < shaft) shift = z_[i] - z_[k];
      if (shaft_[i] == shaft && shaft_[k] < shaft) shift = z_[k] - z_[i];
    }
    for (std::size_t k = 0; k < z_.size(); ++k)
      if (shaft_[k] == shaft) z_[k] += shift;
  }
}

double RossNodes::At(const RossElement& e, int node) const {
  if (!on_shaft(node))
    e.Fail(fmt::format("n = {}, allowed 0 to {} (nodes of the shaft)", node, size() - 1));
  return z_[static_cast<std::size_t>(node)];
}

std::string RossNodes::ShaftOf(int node) const {
  if (shaft_.back() == 0 || !on_shaft(node)) return "";
  return RossShaftName(shaft_[static_cast<std::size_t>(node)]);
}

std::vector<PlacedShaft> RossNodes::shafts() const {
  std::vector<PlacedShaft> out;
  for (int k = 0; k <= shaft_.back() && shaft_.back() > 0; ++k)
    out.push_back({RossShaftName(k), 0, 0});
  return out;
}

}  // namespace ambrig
